"""The drawing so far: what it holds, and how it tells the current step from the former ones."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

import graphcam as gc
from graphcam.drafting.hand import Hand
from graphcam.drafting.ink import Part, Row, Step, View, say
from graphcam.drafting.marks import Role
from graphcam.drafting.meaning import Meaning
from graphcam.notebooks.construction_stages import Stage, drawing, show_steps, stages
from graphcam.notebooks.explore import changed
from graphcam.plots.step_board import board_of
from graphcam.report.documents import contents_of
from graphcam.report.sheet_contents import all_constructions
from graphcam.sheets.model import Circles, Stroke, Strokes, Text
from graphcam.tasks.task import SpringTable

SPRING = SpringTable(mass=0.5, stiffness=3.0)


@pytest.fixture(scope="module")
def drawn():
    return gc.solve(gc.builtin_task()).drawn


def said(role):
    stage, _, _ = role.partition(" ")
    return stage


def test_only_the_last_step_is_in_colour(drawn):
    for name, construction in drawn.items():
        for stage in stages(construction):
            if stage.page is not None:
                *former, current = stage.page.groups
                assert {said(e.role) for e in current.entities} <= {"current"}, name
                assert {said(e.role) for group in former for e in group.entities} <= {"former"}, name


def test_nothing_moves_from_step_to_step(drawn):
    """What a step draws stands at the same place, letters too, in every later drawing."""
    first, *_, last = [s for s in stages(drawn["minimum_radius"]) if s.page is not None]
    before = [(e.text, e.at) for e in first.page.groups[-1].entities if isinstance(e, Text)]
    after = [(e.text, e.at) for e in last.page.groups[len(first.page.groups) - 1].entities if isinstance(e, Text)]
    assert before == after
    assert before


def test_a_drawing_stands_on_what_was_drawn_before_in_its_view(drawn):
    """The poles of the first integration are set in the acceleration diagram, over its four steps."""
    board = board_of(drawn["integration"]).by_view["acceleration"]
    assert [str(step.title) for step in board.former] == [str(s.title) for s in drawn["acceleration"].steps()]
    assert len(board.page(0).groups) == 5


def test_the_finished_drawing_has_the_ink_of_the_sheet(drawn):
    page = board_of(drawn["minimum_radius"]).by_view["combined"].page()
    assert {e.role for group in page.groups for e in group.entities} <= {*Role, "text"}


def test_a_step_of_words_has_no_drawing():
    knife_edge = gc.solve(changed(gc.builtin_task(), {"follower.roller_radius": 0.0}))
    (words,) = stages(knife_edge.drawn["roller"])
    assert words.picture is None
    assert "<img" not in words.html
    assert "roller radius" in words.html.lower()


def test_readings_are_told_as_millimetres_times_a_scale(drawn):
    *_, last = stages(drawn["minimum_radius"])
    assert "prime radius r₀ = 72.13 mm × 0.6 mm/mm = 43.28 mm" in last.html


def test_words_of_the_task_are_no_markup(drawn):
    *_, last = stages(drawn["minimum_radius"])
    assert "<script" not in last.html
    assert last.picture.html.count('"') == 4


def test_an_unknown_view_is_named(drawn):
    with pytest.raises(gc.DesignError, match="view is 'profile', but must be one of combined"):
        drawing(drawn["minimum_radius"], "profile")


@pytest.mark.slow
def test_chosen_steps_are_shown(drawn, monkeypatch):
    import IPython.display

    shown = []
    monkeypatch.setattr(IPython.display, "display", shown.append)
    show_steps(drawn["minimum_radius"], 2, 4)
    assert [stage.number for stage in shown] == ["2.", "4."]


TASKS = {"coursework": gc.builtin_task(), "spring": replace(gc.builtin_task(), speed_rpm=300.0, spring=SPRING)}


@pytest.mark.parametrize("name", TASKS)
def test_steps_bear_the_numbers_that_they_have_on_the_sheet(name):
    solution = gc.solve(TASKS[name])
    contents = contents_of(solution)
    shown = {
        (c.name, str(s.step.title)): s.number
        for c in all_constructions(solution).values()
        for s in numbered(c, solution)
    }
    assert shown == {(by, str(step.title)): contents.numbers[k] for k, by, step in contents.steps}
    assert shown["scheme", "Kinematic diagram and data"] == "1.1"


def numbered(construction, solution):
    """The stages without their pictures."""
    return stages(replace(construction, draw=partial(undrawn, construction)), within=solution)


def undrawn(construction, _):
    return [replace(step, marks=(), given=()) for step in construction.steps()]


# --- the strip -------------------------------------------------------------------------------------------------------

MEANING = Meaning("fan", say("A fan"), say("Rays from a pole."))
ENDS = 10j * np.arange(1, 7) + 40


def fan():
    """Rays to six points, drawn one by one, and a line through their ends."""
    hand = Hand(gc.Pencil(), MEANING)
    pole, ends = hand.given("pole"), hand.given("ends", ENDS)
    hand.join("rays", pole, ends)
    return hand.finished(SimpleNamespace(), fan_steps, {})


def fan_steps(drawn):
    pole, ends, rays = (drawn.acts[name] for name in ("pole", "ends", "rays"))
    given = (pole.dots(),)
    marks = (*given, rays.segments(Role.CONSTRUCTION), ends.line(Role.CURVE), pole.label("P"))
    one = say("Join P to the point {k}.")
    parts = tuple(Part(one.with_values(k=k + 1), (rays[k], ends[k])) for k in range(6))
    why = say("Because this is a toy.")
    view = View("fan", say("Fan"), "fan x", "fan y")
    return [Step(say("Rays"), parts, view, marks, given=given, why=why)]


def lines_of(page, stage):
    """The ends of what is drawn in thin and medium lines, up to a shift."""
    return [
        complex(end - PAGE_ORIGIN)
        for group in page.groups
        for entity in group.entities
        if isinstance(entity, Strokes) and entity.role == f"{stage} construction"
        for end in entity.ends
    ]


PAGE_ORIGIN = board_of(fan()).origin


def test_up_to_a_part_its_rays_are_in_colour_and_those_before_it_are_not():
    board = board_of(fan())
    for part in range(6):
        page = board.page(0, part)
        np.testing.assert_allclose(lines_of(page, "part"), [ENDS[part]])
        np.testing.assert_allclose(lines_of(page, "former"), ENDS[:part])
    np.testing.assert_allclose(lines_of(board.page(0), "current"), ENDS)


def test_a_line_grows_piece_by_piece_and_what_no_part_draws_comes_last():
    board = board_of(fan())
    for part in range(6):
        *_, before, own = board.page(0, part).groups
        curves = [sum(isinstance(e, Stroke) and "curve" in e.role for e in group.entities) for group in (before, own)]
        assert curves == [max(0, part - 1), int(part > 0)]
        given = [e for e in before.entities if isinstance(e, Circles)]
        assert len(given) == 1, "the pole lies there before the first ray"


def test_a_strip_shows_the_first_part_and_the_middle_one_and_the_whole_follows():
    (stage,) = stages(fan())
    assert list(stage.strip) == [0, 3]
    assert [picture.caption for picture in stage.pictures] == ["Part 1 of 6", "Part 4 of 6"]
    assert all(f"Join P to the point {k}." in picture.alt for k, picture in zip((1, 4), stage.pictures, strict=True))
    html = stage.html
    assert html.count("<img") == 3
    told = [f"<li>Join P to the point {k}.</li>" for k in range(1, 7)]
    places = [
        html.index(text) for text in ("<ol>", *told, "Because this is a toy.", "stills", "Part 1 of 6", "Part 4 of 6")
    ]
    assert places == sorted(places)
    assert html.rindex("<figure>") > places[-1], "the whole comes last"


def test_the_rays_of_the_pressure_angles_are_drawn_over_the_combined_diagram(drawn):
    before = len(board_of(drawn["minimum_radius"]).by_view["combined"].steps)
    alone, over = (
        board_of(drawn["pressure_angle"], on=on).by_view["combined"] for on in (None, drawn["minimum_radius"])
    )
    assert len(over.page().groups) == before + len(alone.page().groups)
    assert [str(step.title) for step in over.steps] == [str(step.title) for step in alone.steps]


def test_a_step_of_words_has_a_picture_only_where_something_stands(drawn):
    adopted = drawn["pressure_angle"]
    alone, over = (next(iter(stages(adopted, on=on))) for on in (None, drawn["minimum_radius"]))
    assert not alone.step.marks
    assert alone.picture is None
    assert "<img" not in alone.html
    assert over.picture is not None


def test_a_run_is_told_once_with_its_table_and_no_sentence_twice():
    (old,) = fan_steps(fan())
    rows = tuple(
        Row(say("Ray {k}", k=k + 1), say("{mm:.1f} mm", mm=10.0 * (k + 1)), part.draws)
        for k, part in enumerate(old.parts)
    )
    pole = Part(say("Mark the pole P."))
    step = replace(old, parts=(pole, Part(say("Draw rays 1 to 6 from P: ray 2 rises 20.0 mm."), rows=rows)))
    stage = Stage("1.", step, None, (), str, dict.fromkeys((0, 3), board_of(fan()).page(0)))
    html = re.sub(r'alt="[^"]*"', "", stage.html)
    for told in ("Mark the pole P.", "Draw rays 1 to 6 from P: ray 2 rises 20.0 mm.", "<b>2</b> 20.0 mm"):
        assert html.count(told) == 1
    assert "<p>Ray</p>" in html
    assert "details" not in html
    assert html.index("<ol>") < html.index('class="why"') < html.index("stills")
    assert [picture.caption for picture in stage.pictures] == ["Part 1 of 7", "Part 4 of 7: Ray 3: 30.0 mm."]

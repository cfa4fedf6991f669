"""The drawing so far: what it holds, and how it tells the current step from the former ones."""

from __future__ import annotations

import pytest

import graphcam as gc
from graphcam.drafting.marks import Role
from graphcam.notebooks.stages import drawing, show_steps, stages
from graphcam.plots.step_board import board_of
from graphcam.sheets.model import Text


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


def test_a_step_of_words_has_no_drawing(drawn):
    (words,) = stages(drawn["roller"])
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


def test_chosen_steps_are_shown(drawn, monkeypatch):
    import IPython.display

    shown = []
    monkeypatch.setattr(IPython.display, "display", shown.append)
    show_steps(drawn["minimum_radius"], 2, 4)
    assert [stage.number for stage in shown] == [2, 4]


def test_the_rays_of_the_pressure_angles_are_drawn_over_the_combined_diagram(drawn):
    # Alone they say nothing, and are not drawn.
    assert "combined" not in board_of(drawn["pressure_angle"]).by_view
    over = board_of(drawn["pressure_angle"], on=drawn["minimum_radius"]).by_view["combined"].page()
    assert len(over.groups) == 1 + len(board_of(drawn["minimum_radius"]).by_view["combined"].steps)

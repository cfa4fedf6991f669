"""Views keep their axes in line, nothing is lost, nothing overlaps, and nothing is too large."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from overlaps import overlaps
from scene import TABLE, TITLE, drawing, steps

import graphcam as gc
from graphcam.drafting.ink import Step, View, say
from graphcam.drafting.marks import Line, Role
from graphcam.report.documents import sheet_of
from graphcam.sheets.formats import MARGINS, SIZES, Format
from graphcam.sheets.layout import compose, profile_room
from graphcam.sheets.model import ArcEntity, Circles, Curve, Drawing, Stroke, Strokes, Text
from graphcam.sheets.sampling import box_of
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import TranslatingTable
from graphcam.tasks.task_file import builtin_task

EVERY = [(paper, frame) for paper in SIZES for frame in MARGINS]


def corners_of(drawn: Drawing, name: str) -> list[tuple[int, complex]]:
    """Pages and lower left corners of what a construction draws."""
    return [
        (number, box.corner)
        for number, page in enumerate(drawn.pages)
        for group in page.groups
        if group.name.endswith(" " + name) and (box := box_of(e for e in group.entities if isinstance(e, Stroke)))
    ]


def line_at(name: str, across: str, up: str) -> tuple[str, Step]:
    """A step that draws one line from the origin of its view."""
    view = View(name, say(name), across, up)
    return name, Step(say("."), say("."), view, (Line(np.array([0, 50 + 20j]), Role.CURVE),))


@pytest.mark.parametrize(("paper", "frame"), EVERY)
def test_views_that_share_an_axis_stand_in_line(paper: str, frame: str) -> None:
    shared = [line_at("a", "phi", "a"), line_at("s", "phi", "s"), line_at("combined", "e", "s"), line_at("p", "x", "y")]
    drawn = compose(shared, [], TITLE, paper, frame)
    ((page_a, a),) = corners_of(drawn, "a")
    ((page_s, s),) = corners_of(drawn, "s")
    ((page_c, c),) = corners_of(drawn, "combined")
    assert page_a == page_s == page_c
    assert a.real == pytest.approx(s.real, abs=1e-9)
    assert a.imag > s.imag
    assert c.imag == pytest.approx(s.imag, abs=1e-9)
    assert c.real > s.real


@pytest.mark.parametrize(("paper", "frame"), EVERY)
def test_every_step_and_table_is_drawn_once(paper: str, frame: str) -> None:
    drawn = drawing(paper, frame)
    names = [group.name for page in drawn.pages for group in page.groups if group.key.startswith("step")]
    assert sorted(names) == [f"step-{k:02d} {name}" for k, (name, _) in enumerate(steps(), 1)]
    texts = [e.text for page in drawn.pages for group in page.groups for e in group.entities if isinstance(e, Text)]
    assert all(texts.count(cell) == 1 for row in TABLE.rows for cell in row)


@pytest.mark.parametrize(("paper", "frame"), EVERY)
def test_scene_has_no_text_in_the_way(paper: str, frame: str) -> None:
    assert overlaps(drawing(paper, frame)) == []


def test_a1_takes_the_scene_on_one_page_at_full_size() -> None:
    drawn = drawing("A1")
    assert len(drawn.pages) == 1
    assert not any("reduced" in e.text for g in drawn.pages[0].groups for e in g.entities if isinstance(e, Text))


@pytest.mark.parametrize("ordinate", [800.0, 50000.0])
@pytest.mark.parametrize("paper", SIZES)
def test_what_is_too_large_is_reduced_with_its_neighbours(paper: str, ordinate: float) -> None:
    # Acceleration, displacement and combined diagram share axes; the profile does not.
    shared = [(name, step) for name, step in steps(ordinate) if name != "profile"]
    drawn = compose(shared, [TABLE], TITLE, paper)
    assert overlaps(drawn) == []
    titles = [e.text for page in drawn.pages for g in page.groups if g.key == "titles" for e in g.entities]
    reduced = [title.split("reduced ")[1] for title in titles if "reduced" in title]
    assert len(reduced) == 3
    assert len(set(reduced)) == 1
    for page in drawn.pages:
        for group in page.groups:
            box = box_of(e for e in group.entities if isinstance(e, Stroke | Strokes | ArcEntity | Circles | Curve))
            assert group.key == "frame" or box is None or page.frame.holds(box)


@pytest.mark.parametrize(("paper", "frame"), EVERY)
def test_profile_room_is_room_for_a_profile(paper: str, frame: str) -> None:
    width, height = profile_room(paper, frame)
    inside = Format(paper, frame).content
    assert 0 < width < inside.width
    assert 0 < height < inside.height


def test_notes_are_numbered_and_broken_into_lines() -> None:
    long = (
        "The readings are those of a perfect pencil, so the error that is left is that of the construction alone. " * 2
    )
    drawn = compose(steps(), [], TITLE, notes=[long, "Second."])
    texts = [e.text for g in drawn.pages[0].groups if g.key == "tables" for e in g.entities if isinstance(e, Text)]
    assert texts[0].startswith("1. The readings")
    assert texts[-1] == "2. Second."
    assert len(texts) > 3


@pytest.mark.parametrize("frame", MARGINS)
def test_built_in_task_on_a1(frame: str) -> None:
    """One page, full size, no text in the way, and the profile the largest thing drawn."""
    task = builtin_task()
    drawn = sheet_of(gc.solve(replace(task, drawing=replace(task.drawing, format="A1", frame=frame))))
    assert len(drawn.pages) == 1
    assert overlaps(drawn) == []
    texts = [e.text for g in drawn.pages[0].groups for e in g.entities if isinstance(e, Text)]
    assert not any("reduced" in text for text in texts)
    assert all(e.height >= 2.5 for g in drawn.pages[0].groups for e in g.entities
               if isinstance(e, Text) and g.key != "frame")  # fmt: skip
    areas: dict[str, float] = {}
    for group in drawn.pages[0].groups:
        box = box_of(e for e in group.entities if not isinstance(e, Text))
        if box and group.key.startswith("step"):
            name = group.name.split(" ")[1]
            areas[name] = max(areas.get(name, 0.0), box.width * box.height)
    assert max(areas, key=lambda name: areas[name]) == "inversion"


def test_a1_parts_the_combined_diagram_before_it_reduces() -> None:
    """A limit on the return makes the combined diagram too tall to stand beside the displacement."""
    task = builtin_task()
    drawn = sheet_of(gc.solve(replace(task, limits=replace(task.limits, pressure_angle_return=60.0))))
    texts = [e.text for page in drawn.pages for g in page.groups for e in g.entities if isinstance(e, Text)]
    assert not any("reduced" in text for text in texts)
    assert overlaps(drawn) == []
    axes = {
        (number, round(float(e.starts[0].real), 6))
        for number, page in enumerate(drawn.pages)
        for group in page.groups
        for e in group.entities
        if isinstance(e, Strokes) and e.role == Role.SCALE and (e.ends - e.starts)[0].real > 360
    }
    assert len(axes) == 1


@pytest.mark.parametrize(("seed", "paper"), [(k, list(SIZES)[k % 4]) for k in range(12)])
def test_random_tasks_have_no_text_in_the_way(seed: int, paper: str) -> None:
    random = np.random.default_rng(seed)
    angles = np.round(20 + 280 * random.dirichlet([3, 2, 3, 3]))
    lift = float(np.round(10 ** random.uniform(0.3, 2), 1))
    rise, back = (str(name) for name in random.choice(list(gc.LAWS), 2))
    phases = (
        RiseTable(float(angles[0]), lift, rise),
        DwellTable(float(angles[1])),
        ReturnTable(float(angles[2]), lift, back),
        DwellTable(float(360 - angles[:3].sum())),
    )
    task = builtin_task()
    drawing_table = replace(
        task.drawing, format=paper, frame=str(random.choice(["gost", "iso"])), divisions=int(random.integers(4, 17))
    )
    task = replace(
        task, rotation=str(random.choice(["cw", "ccw"])), motion=MotionTable(phases), follower=TranslatingTable(),
        drawing=drawing_table,
    )  # fmt: skip
    drawn = sheet_of(gc.solve(task))
    assert overlaps(drawn) == []
    for page in drawn.pages:
        tables = [e for g in page.groups if g.key == "tables" for e in g.entities if isinstance(e, Strokes)]
        boxes = [box for e in tables if e.role == "table" and (box := box_of([e]))]
        assert not any(a.meets(b) for a, b in combinations(boxes, 2))


def test_a_wide_title_in_a_later_row_moves_the_next_column_aside() -> None:
    """The last view of the first column has the widest title; the second column hangs down beside it."""

    def titled(name: str, title: str, across: str, up: str, end: complex) -> tuple[str, Step]:
        line = Line(np.array([0, end]), Role.CURVE)
        return name, Step(say("."), say("."), View(name, say(title), across, up), (line,))

    shared = [
        titled("s", "s", "phi", "s", 20 + 20j),
        titled("combined", "combined", "e", "s", 20 - 60j),
        titled("alpha", "A title wider than its view", "phi", "alpha", 20 + 20j),
    ]
    drawn = compose(shared, [], TITLE, "A1")
    assert overlaps(drawn) == []
    ((page_s, s),) = corners_of(drawn, "s")
    ((page_c, c),) = corners_of(drawn, "combined")
    assert page_s == page_c
    assert c.imag + 60 == pytest.approx(s.imag, abs=1e-9)
    titles = [e.text for p in drawn.pages for g in p.groups if g.key == "titles" for e in g.entities]
    assert not any("reduced" in title for title in titles)

"""Views keep their axes in line, nothing is lost, nothing overlaps, and nothing is too large."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from overlaps import overlaps
from scene import DRAWN_AT, TABLE, TITLE, drawing, steps

import graphcam as gc
from graphcam.drafting.ink import Part, Step, View, say
from graphcam.drafting.marks import Line, Role
from graphcam.drafting.scale import ratio_text
from graphcam.report.documents import contents_of, sheet_of
from graphcam.sheets.formats import FRAME_MARGINS, SHEET_SIZES, Format
from graphcam.sheets.layout import compose, profile_room
from graphcam.sheets.model import Drawing, Stroke, Strokes, Text
from graphcam.sheets.sampling import box_of
from graphcam.tasks.task_file import builtin_task

EVERY = [(paper, frame) for paper in SHEET_SIZES for frame in FRAME_MARGINS]


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
    return name, Step(say("."), (Part(say(".")),), view, (Line(np.array([0, 50 + 20j]), Role.CURVE),))


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


def test_a1_takes_the_scene_on_one_page() -> None:
    assert len(drawing("A1").pages) == 1


@pytest.mark.parametrize("ordinate", [800.0, 50000.0])
@pytest.mark.parametrize("paper", SHEET_SIZES)
def test_what_fits_no_page_is_refused_with_its_size(paper: str, ordinate: float) -> None:
    with pytest.raises(gc.DesignError) as raised:
        compose(steps(ordinate, DRAWN_AT[paper]), [TABLE], TITLE, paper)
    assert str(raised.value.quantity).startswith("the view 'Acceleration a, ")
    assert f"on {Format(paper, 'gost').description}" in raised.value.limit
    wide, high = map(float, str(raised.value.value).removesuffix(" mm").split(" × "))
    drawn = 2 * ordinate * DRAWN_AT[paper]
    assert drawn < high < drawn + 40
    assert 360 * DRAWN_AT[paper] < wide < 360 * DRAWN_AT[paper] + 80


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


@pytest.mark.parametrize("frame", FRAME_MARGINS)
def test_built_in_task_on_a1(frame: str) -> None:
    """One page, no text in the way, and the profile the largest thing drawn."""
    task = builtin_task()
    drawn = sheet_of(gc.solve(replace(task, drawing=replace(task.drawing, format="A1", frame=frame))))
    assert len(drawn.pages) == 1
    assert overlaps(drawn) == []
    assert all(e.height >= 2.5 for g in drawn.pages[0].groups for e in g.entities
               if isinstance(e, Text) and g.key != "frame")  # fmt: skip
    areas: dict[str, float] = {}
    for group in drawn.pages[0].groups:
        box = box_of(e for e in group.entities if not isinstance(e, Text))
        if box and group.key.startswith("step"):
            name = group.name.split(" ")[1]
            areas[name] = max(areas.get(name, 0.0), box.width * box.height)
    assert max(areas, key=lambda name: areas[name]) in ("inversion", "working_profile")


def test_a1_parts_the_combined_diagram_from_the_others() -> None:
    """A limit on the return makes the combined diagram too tall to stand beside the displacement."""
    task = builtin_task()
    drawn = sheet_of(gc.solve(replace(task, limits=replace(task.limits, pressure_angle_return=60.0))))
    assert overlaps(drawn) == []
    axes = {
        (number, round(float(e.starts[0].real), 6))
        for number, page in enumerate(drawn.pages)
        for group in page.groups
        for e in group.entities
        if isinstance(e, Strokes) and e.role == Role.SCALE and (e.ends - e.starts)[0].real > 360
    }
    assert len(axes) == 1


def test_a_wide_title_in_a_later_row_moves_the_next_column_aside() -> None:
    """The last view of the first column has the widest title; the second column hangs down beside it."""

    def titled(name: str, title: str, across: str, up: str, end: complex) -> tuple[str, Step]:
        line = Line(np.array([0, end]), Role.CURVE)
        return name, Step(say("."), (Part(say(".")),), View(name, say(title), across, up), (line,))

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


def scales(drawn: Drawing) -> list[str]:
    """What the field of the title block says, page by page."""
    fields = [[e.text for g in page.groups for e in g.entities if isinstance(e, Text) and e.field == "scale"]
              for page in drawn.pages]  # fmt: skip
    return [" ".join(texts) for texts in fields]


def scaled(name: str, size: complex, mu_l: float | None, *, main: bool = False) -> tuple[str, Step]:
    view = View(name, say(name), f"{name} x", f"{name} y", mu_l=mu_l, main=main)
    box = np.array([0, size.real, size, 1j * size.imag])
    return name, Step(say("."), (Part(say(".")),), view, (Line(box, Role.CURVE, closed=True),))


def test_the_title_block_bears_the_scale_of_what_is_drawn_on_its_sheet() -> None:
    """That of the cam where it stands, or of the largest other view; a sheet of diagrams has none."""
    own, given = replace(TITLE, scale=None), replace(TITLE, scale="as shown")
    cam, plan, detail = (
        scaled("cam", 100 + 60j, 0.5, main=True), scaled("plan", 160 + 80j, 2.0), scaled("detail", 50 + 40j, 0.1)
    )  # fmt: skip
    assert scales(compose([plan, cam, detail], [], own, "A2")) == ["2:1"]
    assert scales(compose([plan, detail], [], own, "A2")) == ["1:2"]
    assert scales(compose([detail, plan], [], own, "A2")) == ["1:2"]
    diagram = scaled("diagram", 240 + 80j, None)
    assert scales(compose([diagram], [], own, "A4", "iso")) == [""]
    assert scales(compose([diagram, plan, cam], [], own, "A4", "iso")) == ["", "1:2", "2:1"]
    assert scales(compose([diagram, plan], [], given, "A4", "iso")) == ["as shown"] * 2


@pytest.mark.parametrize("name", ["arm", "coursework"])
def test_a_view_at_another_scale_than_the_title_block_says_carries_its_own(name: str) -> None:
    task = builtin_task(name)
    solution = gc.solve(replace(task, drawing=task.drawing.on("A3")))
    views = {step.view.name: step.view for _, _, step in contents_of(solution).steps}
    drawn = sheet_of(solution)
    differing = 0
    for page, said in zip(drawn.pages, scales(drawn), strict=True):
        ratios = {name: str(ratio_text(mu_l)) for name in page.origins if (mu_l := views[name].mu_l)}
        assert said in (ratios.values() or [""])
        texts = [e for group in page.groups for e in group.entities if isinstance(e, Text)]
        for view, ratio in ratios.items():
            assert ratio in " ".join(text.text for text in texts if text.view == view)
            differing += ratio != said
    assert differing > 0

"""Paper millimetres are paper millimetres: what is printed on a sheet measures itself, by the scales it prints."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest
from over_all import over_all
from random_sheets import NAMES, on_sheet
from scene import SHEETS

import graphcam as gc
from graphcam.constructions.axes import BROKEN_DWELL, MIN_SHORTENED
from graphcam.report.documents import contents_of, drawing_of
from graphcam.sheets.model import ArcEntity, Circles, Drawing, Length, Text
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.solution import Solution
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import CamTable, DrawingTable, FlatFacedTable, OscillatingTable, Task, TranslatingTable
from graphcam.tasks.task_file import builtin_task

RULER = 0.005
"""A length on the sheet is true within this, mm."""
SKETCH = "scheme"
PRINTED = re.compile(r"(?:(?P<symbol>[^\d=]+?) ?(?:= ?)?)??(?P<number>-?\d+(?:[.,](?P<digits>\d+))?)(?P<degrees>°?)")


@dataclass(frozen=True)
class Printed:
    """A dimension as it is printed: its view, what it says, and how far apart its ends are on the page."""

    view: str
    symbol: str
    number: float
    half: float
    degrees: bool
    length: float


def dimensions(solution: AnySolution, drawn: Drawing) -> Iterator[Printed]:
    """The lengths that are printed, each with the view of its step."""
    views = {f"step-{number:02d}": step.view.name for number, _, step in contents_of(solution).steps}
    for page in drawn.pages:
        for group in page.groups:
            for text in group.entities:
                if isinstance(text, Text) and isinstance(text.of, Length) and (read := PRINTED.fullmatch(text.text)):
                    # Of "= 40" only as many digits are written as it has.
                    half = 0.5 * 10.0 ** -len(read["digits"] or "") if not (read["symbol"] or "").startswith("H") else 0
                    length = abs(text.of.end - text.of.start)
                    number, symbol = float(read["number"].replace(",", ".")), (read["symbol"] or "").strip()
                    yield Printed(views[group.key], symbol, number, half, bool(read["degrees"]), length)


def scales(drawn: Drawing) -> dict[str, float]:
    """What each view's title says that a millimetre of paper is worth, or that one of the machine is drawn as."""
    titles: dict[str, list[str]] = {}
    for page in drawn.pages:
        for text in (e for group in page.groups for e in group.entities if isinstance(e, Text) and e.view):
            titles.setdefault(text.view, []).append(text.text)
    found = dict[str, float]()
    for view, texts in titles.items():
        said = " ".join(texts).replace(",", ".")
        if ratio := re.search(r"([\d.]+):([\d.]*\d)", said):
            found[view] = float(ratio[2]) / float(ratio[1])
        elif mu := re.search(r"= ([\d.e−-]*\d)", said):
            found[view] = float(mu[1])
    return found


def check(solution: AnySolution) -> None:
    contents = contents_of(solution)
    check_drawing(contents.solution, drawing_of(contents))


def check_drawing(solution: AnySolution, drawn: Drawing) -> None:
    """Every printed length is that of its ends: in mm, in degrees of the axis, or in the view's scale."""
    said, printed = scales(drawn), list(dimensions(solution, drawn))
    assert len(printed) >= 4
    for each in printed:
        if each.view == SKETCH:
            continue
        if each.degrees:
            mu_phi = solution.chain.board.mu_phi
            if mu_phi.middles and abs(each.length - BROKEN_DWELL) <= RULER:
                assert each.number >= math.degrees(mu_phi.per_mm) * (BROKEN_DWELL + MIN_SHORTENED)
                continue
            worth = math.degrees(mu_phi.per_mm)
        elif not each.symbol or each.symbol.startswith("H"):
            worth = 1.0
        else:
            worth = said[each.view]
        # Titles say four digits of a scale.
        rounding = 0.0 if worth == 1.0 else 6e-4 * abs(each.number)
        assert abs(worth * each.length - abs(each.number)) <= each.half + RULER + rounding, each
    if isinstance(solution, Solution):
        _check_scales(solution, drawn, said, printed)
    _check_title_blocks(drawn)


def _check_scales(solution: Solution, drawn: Drawing, said: dict[str, float], printed: list[Printed]) -> None:
    """The scales in the titles are true: lift, acceleration and prime circle come out as the task has them."""
    heights = {view: [each.length for each in printed if each.view == view and not each.symbol] for view in said}
    (top,) = heights["displacement"]
    assert said["displacement"] * top == pytest.approx(solution.cam.motion.lift, rel=6e-4)
    rise = next(p for p in solution.cam.motion.phases if isinstance(p, gc.Rise))
    peak = rise.normalised.peak_acceleration * rise.lift / rise.angle**2
    # Of few parts the greatest middle ordinate is less than the peak, and the drawn lift a little off.
    assert said["acceleration"] * max(heights["acceleration"]) >= 0.7 * peak
    own = solution.chain.board.paper.held.get("combined")
    assert said["combined"] == (own or said["displacement"]) if "combined" in said else "region" in said
    circles = [
        np.atleast_1d(e.radius) if isinstance(e, Circles) else np.array([e.radius])
        for page in drawn.pages
        for group in page.groups
        if group.name.split(" ")[1:2] == ["inversion"]
        for e in group.entities
        if isinstance(e, Circles | ArcEntity)
    ]
    radii = np.concatenate(circles)
    assert np.abs(radii - solution.cam.prime_radius / said["profile"]).min() < RULER


def _check_title_blocks(drawn: Drawing) -> None:
    """The title block says a scale that is that of a view on its page, of the cam where it stands there."""
    of_views = scales(drawn)
    for page in drawn.pages:
        texts = [e for group in page.groups for e in group.entities if isinstance(e, Text)]
        field = "".join(text.text for text in texts if text.field == "scale").replace(",", ".")
        shown = {text.view for text in texts if text.view}
        ratios = {view for view in shown if any(":" in text.text for text in texts if text.view == view)}
        if not field:
            continue
        drawn_as, machine = map(float, field.split(":"))
        assert machine / drawn_as in [of_views[view] for view in shown & {"profile", "arcs", "roller"} or ratios]


def task_of(angles: tuple[float, float], lift: float, follower: object, cam: float | None, sheet: tuple[str, str, str]):
    """A rise and a return of these angles, with dwells between."""
    rest = (360 - sum(angles)) / 2
    rise, back = RiseTable(angles[0], lift, "cycloidal"), ReturnTable(angles[1], lift, "3-4-5")
    phases = (rise, DwellTable(rest), back, DwellTable(rest))
    paper, frame, lie = sheet
    drawing = DrawingTable(paper, frame, orientation=lie)
    return Task("cw", MotionTable(phases), follower, cam=CamTable(cam), drawing=drawing)


HARD = {
    "a return ten times as steep": ((300.0, 30.0), 30.0, TranslatingTable(offset=0.0), None),
    "a rise ten times as steep": ((30.0, 300.0), 30.0, TranslatingTable(), None),
    "a large offset": ((120.0, 120.0), 10.0, TranslatingTable(offset=60.0), None),
    "a large cam": ((120.0, 120.0), 10.0, TranslatingTable(offset=0.0), 300.0),
    "a steep flat face": ((40.0, 40.0), 20.0, FlatFacedTable(), None),
    "a small cam under a steep face": ((40.0, 40.0), 20.0, FlatFacedTable(), 20.0),
    "a long arm far away": ((90.0, 90.0), 10.0, OscillatingTable(arm=400.0, distance=1200.0), None),
    "a fast arm": ((30.0, 40.0), 20.0, OscillatingTable(arm=150.0), None),
}


@pytest.mark.slow
@over_all(("name", "paper"), zip(HARD, ("A4", "A3", "A4", "A1", "A4", "A3", "A4", "A3"), strict=True))
def test_what_is_hard_to_place_is_drawn_to_scales_at_which_it_fits(name: str, paper: str) -> None:
    sheet = next(each for each in SHEETS[len(name) % len(SHEETS) :] + SHEETS if each[0] == paper)
    check(gc.solve(task_of(*HARD[name], sheet)))


@pytest.mark.parametrize(
    ("given", "field"),
    [({"ordinate": 300.0}, "drawing.ordinate"), ({"poles": (20.0, 400.0)}, "drawing.poles[1]")],
    ids=["ordinate", "pole"],
)
def test_a_given_size_that_fits_no_page_is_named_when_the_sheet_is_drawn(given: dict, field: str) -> None:
    """The task itself is solved: only the sheet cannot be drawn."""
    task = builtin_task()
    solution = gc.solve(replace(task, drawing=replace(task.drawing.on("A3"), **given)))
    assert solution.comparison.quantities["roller_radius"].drawn > 0
    with pytest.raises(gc.DesignError, match=r"a larger format, or leave it out") as raised:
        solution.plot()
    assert raised.value.quantity == field
    largest = float(re.search(r"at most ([\d.]+) mm on A3 landscape", raised.value.limit)[1])
    fitting = {"ordinate": largest} if "ordinate" in given else {"poles": (20.0, largest)}
    check(gc.solve(replace(task, drawing=replace(task.drawing.on("A3"), **fitting))))


@pytest.mark.slow
@over_all(("given", "paper"), [("10:1", "A1"), ("100:1", "A3")])
def test_a_profile_scale_that_fits_no_page_is_refused_with_the_largest_that_does(given: str, paper: str) -> None:
    task = builtin_task()
    drawing = replace(task.drawing.on(paper), profile_scale=given)
    with pytest.raises(gc.DesignError, match=r"a larger format, or leave it out") as raised:
        gc.solve(replace(task, drawing=drawing)).plot()
    assert raised.value.quantity == "drawing.profile_scale"
    largest = re.search(rf"at most (\S+) on {paper} landscape", raised.value.limit)[1]
    fitting = gc.solve(replace(task, drawing=replace(drawing, profile_scale=largest)))
    check(fitting)
    page = next(page for page in drawing_of(contents_of(fitting)).pages if "profile" in page.origins)
    assert largest in {e.text for group in page.groups for e in group.entities if isinstance(e, Text)}


def test_sizes_that_are_beyond_all_measure_are_named_before_anything_is_drawn(tmp_path) -> None:
    """A pole of a hundredth of a millimetre makes a diagram of 50 km, whose strokes alone would fill the memory."""
    task = builtin_task()
    solution = gc.solve(replace(task, drawing=replace(task.drawing, poles=(0.01, 0.01))))
    with pytest.raises(gc.DesignError, match=r"take larger poles or a larger format, or leave it out") as raised:
        solution.write(tmp_path / "out")
    assert raised.value.quantity == "drawing.ordinate"
    assert list(tmp_path.iterdir()) == []


def test_poles_that_are_given_are_kept_and_the_ordinate_suits_them() -> None:
    """With short poles the diagrams would be too high: the ordinate that is left open is taken smaller."""
    task = builtin_task()
    solution = gc.solve(replace(task, drawing=replace(task.drawing.on("A4"), poles=(3.0, 3.0))))
    assert solution.chain.board.poles == (3.0, 3.0)
    assert solution.chain.board.ordinate < 5.0
    check(solution)


@pytest.mark.slow
@pytest.mark.parametrize("frame", ["gost", "iso"])
def test_drawing_scales_are_those_of_the_frame_s_standard(frame: str) -> None:
    """The built-in flat face stands at 2.5:1 in a GOST frame; ISO 5455 has 2:1."""
    ratios = set[float]()
    for name in NAMES:
        drawn = drawing_of(contents_of(on_sheet(name, ("A1", frame, "landscape"))))
        said = scales(drawn)
        ratios |= {said[view] for view in ("profile", "plan", "curvature", "region", "arcs", "roller") if view in said}
    allowed = {0.5, 1.0, 2.0} | ({0.4} if frame == "gost" else set())
    assert ratios <= allowed
    assert (0.4 in ratios) == (frame == "gost")

"""Pages of many tasks, formats and frames: well used, no view in another's way, in the order of the work."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
import shapely
from scene import SHEETS
from test_random_sheets import solved

import graphcam as gc
from graphcam.drafting.marks import Points
from graphcam.report.documents import contents_of, drawing_of
from graphcam.sheets.formats import Format
from graphcam.sheets.model import Box, Page, Strokes, Text
from graphcam.sheets.page_filling import ONE_PAGE
from graphcam.sheets.sampling import box_around, box_of, pieces
from graphcam.sheets.sheet_frame import taken_boxes
from graphcam.solving.arcs_solution import AnySolution
from graphcam.tasks.task_file import builtin_arcs_task, builtin_task

AIR = 3.0
"""About what is drawn, which belongs to it [mm]."""
LEADER = 1.0
"""A line that leads to a label may reach so far towards another view [mm]."""


def points_of_views(solution: AnySolution, page: Page, *, labels: bool) -> dict[str, Points]:
    """What the views of a page draw, with their titles and perhaps their labels, by the view."""
    view_of = {number: step.view.name for number, _, step in contents_of(solution).steps}
    found: dict[str, list[Points]] = {}
    for group in page.groups:
        for entity in group.entities:
            if group.key == "titles":
                assert isinstance(entity, Text)
                found.setdefault(str(entity.view), []).append(np.concatenate(pieces(entity)))
            elif group.key.startswith("step") and (labels or not isinstance(entity, Text)):
                found.setdefault(view_of[int(group.key[5:])], []).append(np.concatenate(pieces(entity)))
    return {name: np.concatenate(points) for name, points in found.items()}


def hull(points: Points) -> shapely.Geometry:
    return shapely.convex_hull(shapely.MultiPoint(np.stack([points.real, points.imag], axis=1)))


def area(box: Box) -> shapely.Geometry:
    return shapely.box(box.left, box.bottom, box.right, box.top)


def used(sheet: Format, page: Page, views: dict[str, Points]) -> float:
    """The part of the frame's inside that the boxes of views and tables and what every sheet carries cover."""
    boxes = [box_around(points).grown(AIR) for points in views.values()] + taken_boxes(sheet, 0.0)
    for group in page.groups:
        if group.key == "tables":
            outlines = (e for e in group.entities if isinstance(e, Strokes) and e.role == "table")
            boxes += [box for e in outlines if (box := box_of([e]))]
    return float(shapely.area(shapely.union_all([area(box) for box in boxes])) / sheet.content.area)


def check(solution: AnySolution) -> list[float]:
    """No view is in another's way, and the first view is on the first page; returns how far the pages are used."""
    asked = solution.task.drawing
    sheet = Format(asked.format, asked.frame, asked.orientation)
    contents = contents_of(solution)
    pages = drawing_of(contents).pages
    views = [points_of_views(solution, page, labels=False) for page in pages]
    for standing in views:
        for one, other in combinations(standing.values(), 2):
            common = shapely.intersection(hull(one), hull(other))
            assert shapely.is_empty(shapely.buffer(common, -LEADER)), "a straight line can be drawn between two views"
            assert sheet.name in ONE_PAGE or not box_around(one).grown(-LEADER).meets(box_around(other).grown(-LEADER))
    assert contents.steps[0][2].view.name in views[0]
    return [used(sheet, page, points_of_views(solution, page, labels=True)) for page in pages]


def on_sheet(name: str, paper: str, frame: str, lie: str | None) -> AnySolution:
    """A built-in task on another sheet."""
    task = builtin_arcs_task() if name == "arcs" else builtin_task(name)
    return gc.solve(replace(task, drawing=replace(task.drawing.on(paper), frame=frame, orientation=lie)))


TASKS = "coursework", "arm", "flat", "measured", "arcs"
LEAST_USED = 0.55
"""Of a page but the last."""
SPARSE = {("arcs", "A4", "iso", "landscape"): 0.5, ("arcs", "A4", "iso", "portrait"): 0.53}
"""Where two large views of a small sheet leave strips in which nothing has room."""


@pytest.mark.slow
@pytest.mark.parametrize("number", range(8))
def test_pages_are_well_used_and_views_keep_off_each_other(number: int) -> None:
    """The tasks in turn, each on other sheets."""
    shares = check(on_sheet(TASKS[number % len(TASKS)], *SHEETS[(4 * number) % len(SHEETS)]))
    assert all(share >= LEAST_USED for share in shares[:-1]), shares


@pytest.mark.slow
@pytest.mark.parametrize("name", TASKS)
def test_the_pages_of_every_sheet_of_a_built_in_task_are_well_used(name: str) -> None:
    shares = {each: check(on_sheet(name, *each))[:-1] for each in SHEETS}
    least = {each: SPARSE.get((name, *each), LEAST_USED) for each in SHEETS}
    assert {each: found for each, found in shares.items() if min(found, default=1.0) < least[each]} == {}


@pytest.mark.slow
def test_hardly_any_page_of_a_random_task_is_not_well_used() -> None:
    """Where the views of a page fill it badly and no other has room for them."""
    shares = [share for number in range(0, 48, 2) for share in check(solved(number))[:-1]]
    # Two of 37 pages; it was one before a warning of two lines made another choice of pages for the task 32.
    assert np.mean(np.array(shares) < LEAST_USED) <= 0.055
    assert min(shares) > 0.4


@pytest.mark.parametrize("name", ["coursework", "flat"])
def test_displacements_are_carried_level_across_to_the_combined_diagram(name):
    (page,) = drawing_of(contents_of(gc.solve(builtin_task(name)))).pages
    assert page.origins["combined"].imag == pytest.approx(page.origins["displacement"].imag)

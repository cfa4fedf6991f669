"""Pages of many tasks, formats and frames: well used, no view in another's way, in the order of the work."""

from __future__ import annotations

from itertools import combinations, permutations

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

import graphcam as gc
from graphcam.drafting.marks import Points
from graphcam.report.documents import contents_of, drawing_of
from graphcam.sheets.formats import Format
from graphcam.sheets.model import Box, Page, Strokes, Text, bounding_box
from graphcam.sheets.page_filling import ONE_PAGE
from graphcam.sheets.sampling import box_around, box_of, pieces
from graphcam.sheets.sheet_frame import taken_boxes
from graphcam.sheets.view_panels import are_disjoint, panels
from graphcam.solving.arcs_solution import AnySolution
from graphcam.tasks.task_file import builtin_task

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


def inside(box: Box, points: Points) -> NDArray[np.bool_]:
    """Which points lie inside a box, its sides left out."""
    across = (box.left < points.real) & (points.real < box.right)
    return across & (box.bottom < points.imag) & (points.imag < box.top)


def used(sheet: Format, page: Page, views: dict[str, Points]) -> float:
    """The part of the frame's inside that the boxes of views and tables and what every sheet carries cover."""
    boxes = [box_around(points).grown(AIR) for points in views.values()] + taken_boxes(sheet, 0.0)
    for group in page.groups:
        if group.key == "tables":
            outlines = (e for e in group.entities if isinstance(e, Strokes) and e.role == "table")
            boxes += [box for e in outlines if (box := box_of([e]))]
    return float(shapely.area(shapely.union_all([area(box) for box in boxes])) / sheet.content.area)


def check_pages(solution: AnySolution, pages: tuple[Page, ...]) -> list[float]:
    """No view is in another's way, and the first view is on the first page; returns how far the pages are used."""
    asked = solution.task.drawing
    sheet = Format(asked.format, asked.frame, asked.orientation)
    contents = contents_of(solution)
    of_views = {panel.view.name: panel for panel in panels((step for _, _, step in contents.steps), sheet.lettering)}
    views = [points_of_views(solution, page, labels=False) for page in pages]
    for standing, page in zip(views, pages, strict=True):
        for one, other in combinations(standing.values(), 2):
            common = shapely.intersection(hull(one), hull(other))
            assert shapely.is_empty(shapely.buffer(common, -LEADER)), "a straight line can be drawn between two views"
        if sheet.name in ONE_PAGE:
            continue
        # The boxes of what is drawn and of the titles stand apart; only the leaders of labels go beyond their own
        # view's box, and they keep out of what another view draws and of its title.
        kept = {n: [box.moved(page.origins[n]) for box in (of_views[n].drawn, of_views[n].title_box)] for n in standing}
        assert are_disjoint([bounding_box(boxes).grown(-LEADER) for boxes in kept.values()])
        for name, other in permutations(standing, 2):
            assert not any(inside(box, standing[name]).any() for box in kept[other])
    assert contents.steps[0][2].view.name in views[0]
    return [used(sheet, page, points_of_views(solution, page, labels=True)) for page in pages]


def test_displacements_can_be_carried_level_across_where_the_profile_leaves_room():
    """The combined diagram of a flat face has the scale of s."""
    (page,) = drawing_of(contents_of(gc.solve(builtin_task("flat")))).pages
    assert page.origins["combined"].imag == pytest.approx(page.origins["displacement"].imag)

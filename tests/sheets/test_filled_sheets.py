"""The sheets of the built-in tasks are full: on few pages, the drawings as large as the paper allows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from layout_goals import empty_share
from over_all import over_all
from overlaps import overlaps

import graphcam as gc
from graphcam.report.documents import sheet_of
from graphcam.sheets.model import Page, Text
from graphcam.sheets.sampling import pieces, sampled
from graphcam.solving.arcs_solution import AnySolution
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import builtin_task

pytestmark = pytest.mark.slow

CELL = 10.0
"""Side of the cells by which a page is measured [mm]."""


def filled(page: Page) -> float:
    """The part of the squares of 1 cm inside the frame that something is drawn in, the title block left out."""
    inside = page.frame
    full = np.zeros((int(inside.height // CELL), int(inside.width // CELL)), dtype=bool)
    for group in page.groups:
        for entity in group.entities if group.key != "frame" else ():
            cells = (sampled(*pieces(entity), 1.0) - inside.corner) / CELL
            x, y = cells.real.astype(int), cells.imag.astype(int)
            held = (x >= 0) & (y >= 0) & (x < full.shape[1]) & (y < full.shape[0])
            full[y[held], x[held]] = True
    return float(full.mean())


def solved(name: str, paper: str, frame: str, orientation: str) -> AnySolution:
    """The built-in task on another sheet, whose diagrams are drawn for it."""
    task = builtin_task(name)
    drawing = replace(task.drawing.on(paper), frame=frame, orientation=orientation)
    return gc.solve(replace(task, drawing=drawing))


TASKS = {"coursework": (2.0, 0.3), "arm": (1.0, 0.27), "flat": (2.5, 0.23)}
"""The scale of the profile, and how full every page is: a flat face has three diagrams and no velocity plan."""
BY_ISO = {"flat": (2.0, 0.2)}
"""ISO 5455 has no 2.5:1, so that cam is drawn smaller."""


IN_ORDER = {"coursework": (3, 0.26, 0.21), "arm": (3, 0.22, 0.21), "flat": (2, 0.17, 0.21)}
"""Pages of A2 that lies, how full each is, and the largest part that may be empty: views in the order of the work stand
apart where two pages hold less."""
STANDING = {"coursework": (2, 0.3, 0.15), "arm": (2, 0.26, 0.15), "flat": (2, 0.22, 0.15)}
"""The same of A2 that stands: of all cuts that is taken whose largest empty part is smallest, so one page is fuller."""


def expected(name: str, frame: str) -> tuple[float, float]:
    return BY_ISO.get(name, TASKS[name]) if frame == "iso" else TASKS[name]


HALVES = [[("gost", "landscape"), ("iso", "portrait")], [("gost", "portrait"), ("iso", "landscape")]]
"""Of frames and ways to lie; both are tried on each format with each task."""


@over_all("name", TASKS)
@over_all(("frame", "orientation"), HALVES[0])
def test_a1_takes_everything_on_one_full_page_lying_and_standing(name: str, frame: str, orientation: str) -> None:
    solution, (scale, full) = solved(name, "A1", frame, orientation), expected(name, frame)
    assert 1 / solution.chain.profile_scale.per_mm == scale
    (page,) = (drawing := sheet_of(solution)).pages
    assert overlaps(drawing) == []
    assert filled(page) >= full
    letters = [e.height for g in page.groups for e in g.entities if isinstance(e, Text) and g.key == "tables"]
    assert min(letters) >= 2.5


@over_all("name", TASKS)
@over_all(("frame", "orientation"), HALVES[1])
def test_a2_takes_full_pages_in_order_with_the_profile_as_large_as_on_a1(
    name: str, frame: str, orientation: str
) -> None:
    solution, (scale, _) = solved(name, "A2", frame, orientation), expected(name, frame)
    assert 1 / solution.chain.profile_scale.per_mm == scale
    drawing = sheet_of(solution)
    pages, full, empty = (IN_ORDER if orientation == "landscape" else STANDING)[name]
    assert len(drawing.pages) == pages
    assert min(filled(page) for page in drawing.pages) >= full
    assert max(empty_share(page) for page in drawing.pages) <= empty


def test_an_empty_page_would_be_noticed() -> None:
    page = sheet_of(solved("coursework", "A1", "gost", "landscape")).pages[0]
    bare = replace(page, groups=tuple(g for g in page.groups if "inversion" not in g.name and "profile" not in g.name))
    assert filled(page) - filled(bare) > 0.05


def test_what_was_chosen_for_a_large_sheet_does_not_make_the_diagrams_of_a_small_one_tiny() -> None:
    """The ordinate and poles of A1 on A3 would leave a lift of 30 mm only 12 mm of paper."""
    task = builtin_task()
    assert isinstance(task, Task)
    small = gc.solve(replace(task, drawing=task.drawing.on("A3")))
    assert 30 / float(small.drawn["integration"].readings["s"].scale) >= 25 - 1e-9

"""Sheets of tasks drawn at random, over all followers, frames, formats and orientations: nothing is in the way."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from overlaps import overlaps
from random_tasks import random_arm_task, random_flat_task, random_task

import graphcam as gc
from graphcam.report.documents import sheet_of
from graphcam.sheets.formats import MARGINS, ORIENTATIONS, SIZES
from graphcam.sheets.model import Drawing, Strokes, Text
from graphcam.sheets.sampling import box_of
from graphcam.solving.arcs_solution import AnySolution
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import SpringTable, Task
from graphcam.tasks.task_file import builtin_arcs_task, builtin_task

SHEETS = [(paper, frame, lie) for lie in ORIENTATIONS for paper in SIZES for frame in MARGINS]


def arcs_task(seed: int) -> ArcsTask:
    """The built-in cam of arcs with another dwell and roller."""
    random, task = np.random.default_rng([seed, 3]), builtin_arcs_task()
    return replace(
        task,
        arcs=replace(task.arcs, dwell=round(random.uniform(0, 90))),
        follower=replace(task.follower, roller_radius=random.choice([0.0, 5.0, 12.0]).item()),
        drawing=replace(task.drawing, divisions=int(random.integers(2, 9))),
    )


def measured_task(seed: int) -> Task:
    random, task = np.random.default_rng([seed, 4]), builtin_task("measured")
    return replace(
        task,
        follower=replace(task.follower, offset=random.choice([None, 0.0, 8.0])),
        drawing=replace(task.drawing, divisions=int(random.integers(6, 17))),
    )


def spring_task(seed: int) -> Task:
    random, task = np.random.default_rng([seed, 5]), random_task(seed)
    spring = SpringTable(round(random.uniform(0.1, 0.5), 2), round(random.uniform(1, 8), 1))
    return replace(task, speed_rpm=round(random.uniform(50, 300)), spring=spring)


KINDS: dict[str, Callable[[int], Task | ArcsTask]] = {
    "translating": random_task,
    "arm": random_arm_task,
    "flat": random_flat_task,
    "arcs": arcs_task,
    "measured": measured_task,
    "spring": spring_task,
}


def drawn_task(number: int, seed: int) -> Task | ArcsTask:
    """The number-th task: the kinds in turn, each on another sheet; ordinates and poles given or left to the sheet."""
    task = list(KINDS.values())[number % len(KINDS)](seed)
    paper, frame, lie = SHEETS[(7 * number) % len(SHEETS)]
    drawing = replace(task.drawing, format=paper, frame=frame, orientation=lie)
    if isinstance(task, Task) and number % 3:
        drawing = replace(drawing, ordinate=None, poles=None)
    return replace(task, drawing=drawing)


def solved(number: int) -> AnySolution:
    """The number-th task that some cam solves."""
    for seed in range(number, number + 5000, 1000):
        with suppress(gc.DesignError):
            return gc.solve(drawn_task(number, seed))
    raise AssertionError("five tasks in a row without a cam")


def check(drawing: Drawing) -> None:
    assert overlaps(drawing) == []
    for page in drawing.pages:
        tables = [e for g in page.groups if g.key == "tables" for e in g.entities if isinstance(e, Strokes)]
        boxes = [box for e in tables if e.role == "table" and (box := box_of([e]))]
        assert not any(a.meets(b) for a, b in combinations(boxes, 2))
        for group in page.groups:
            if group.key != "frame" and (box := box_of(e for e in group.entities if not isinstance(e, Text))):
                assert page.frame.holds(box), "nothing is drawn outside the frame"


@pytest.mark.slow
@pytest.mark.parametrize("number", range(48))
def test_nothing_is_in_the_way_on_the_sheet_of_a_random_task(number: int) -> None:
    """Neither on the finished sheet, nor on the blank one, nor on those of one construction each."""
    solution = solved(number)
    check(sheet_of(solution))
    if number % 8 == 0:
        check(sheet_of(solution, 0))
        check(sheet_of(solution, per_construction=True))

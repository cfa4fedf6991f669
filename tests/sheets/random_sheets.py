"""A corpus of tasks drawn at random, over all followers, frames, formats, orientations and languages."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

import numpy as np
from random_tasks import random_arm_task, random_flat_task, random_task
from scene import SHEETS

import graphcam as gc
from graphcam.solving.arcs_solution import AnySolution
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import SpringTable, Task
from graphcam.tasks.task_file import builtin_arcs_task, builtin_task

LANGUAGES = "en", "ru"
GIVEN = {"A1": 60.0, "A2": 30.0, "A3": 12.0, "A4": 3.0}
"""Ordinates that fit the format whatever the return is like, mm."""


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
    language = LANGUAGES[number // len(SHEETS) % 2]
    drawing = replace(task.drawing, format=paper, frame=frame, orientation=lie, language=language)
    if isinstance(task, Task):
        drawing = replace(drawing, ordinate=None if number % 3 else GIVEN[paper], poles=None)
    return replace(task, drawing=drawing)


def solved(number: int) -> AnySolution:
    """The number-th task that some cam solves."""
    for seed in range(number, number + 5000, 1000):
        with suppress(gc.DesignError):
            return gc.solve(drawn_task(number, seed))
    raise AssertionError("five tasks in a row without a cam")


NAMES = ("coursework", "arm", "flat", "measured", "arcs")


def on_sheet(name: str, sheet: tuple[str, str, str | None]) -> AnySolution:
    """A built-in task on another sheet."""
    task, (paper, frame, lie) = builtin_arcs_task() if name == "arcs" else builtin_task(name), sheet
    return gc.solve(replace(task, drawing=replace(task.drawing.on(paper), frame=frame, orientation=lie)))


def built_in(number: int) -> tuple[str, tuple[str, str, str]]:
    """A built-in task and a sheet: of 15 numbers in a row every sheet is one, of 75 every task on every sheet."""
    return NAMES[number % len(NAMES)], SHEETS[(4 * number + number // len(SHEETS)) % len(SHEETS)]

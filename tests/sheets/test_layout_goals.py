"""The goals of the layout, on other people's tasks: order, empty room, labels, leaders, numbers of rays."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from layout_goals import LayoutMeasures, empty_share, measured
from over_all import over_all
from random_sheets import solved

import graphcam as gc
from graphcam.drafting.marks import Role
from graphcam.sheets.model import Box, Group, Page, Stroke
from graphcam.tasks.task_file import BUILTIN_TASK_NAMES, builtin_task

COURSEWORK = sorted(Path(__file__).with_name("coursework").glob("*.toml"))
SOME = ["k_02", "k_05", "n14", "t_tr"]
"""The beginnings of the names of four of them."""


@over_all("start", SOME)
def test_four_tasks_keep_to_the_goals(start: str) -> None:
    (file,) = (each for each in COURSEWORK if each.name.startswith(start))
    assert measured(gc.solve(gc.load_task(file))).missed() == {}


@pytest.mark.slow
@over_all("file", COURSEWORK)
def test_all_tasks_keep_to_the_goals(file: Path) -> None:
    assert measured(gc.solve(gc.load_task(file))).missed() == {}


@pytest.mark.slow
@over_all("name", BUILTIN_TASK_NAMES)
def test_built_in_tasks_keep_to_the_goals(name: str) -> None:
    assert measured(gc.solve(builtin_task(name))).missed() == {}


@pytest.mark.slow
@over_all("number", [*range(0, 40, 8), 919])
def test_random_tasks_keep_to_the_goals(number: int) -> None:
    assert measured(solved(number)).missed() == {}


def test_a_miss_is_found() -> None:
    good = LayoutMeasures([], [0.5], 5.0, [], [], [], [], 24, narrow_allowed=False)
    assert good.missed() == {"empty": [0.5]}
    assert LayoutMeasures([], [0.1, 0.5], 3.0, [], [], [], ["1 (v)"], 24, narrow_allowed=False).missed() == {
        "parts": 3.0,
        "rays": ["1 (v)"],
    }


def test_the_largest_empty_rectangle_is_measured() -> None:
    frame = Box(0, 0, 400, 280)
    upright = Stroke(np.array([100, 100 + 280j]), Role.CURVE)
    page = Page(400, 280, frame, (Group("step-01 a", (upright,)),))
    assert empty_share(page) == pytest.approx(300 / 400, abs=0.02)

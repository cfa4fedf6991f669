"""What a user waits for: that the view drawn anew is the one a whole solution has, and what the rows are."""

from __future__ import annotations

import re

import pytest

import graphcam as gc
from graphcam.bench.rows import Gauge
from graphcam.bench.solve_rows import resized, solve_rows, view_svg
from graphcam.bench.timing import Timer
from graphcam.plots.step_board import StepBoard
from graphcam.sheets.player import group_svg

VIEWS = {
    "acceleration": ["acceleration", "integration"],
    "profile": ["inversion", "curvature", "working_profile"],
    "combined": ["minimum_radius", "pressure_angle"],
}


@pytest.mark.parametrize(("view", "names"), VIEWS.items())
def test_a_view_drawn_alone_is_that_of_the_whole_solution(view, names):
    task = resized(gc.solve(gc.builtin_task()))
    steps = [step for drawn in gc.solve(task).drawn.values() for step in drawn.steps()]
    every = [step for step in steps if step.marks and step.view.name == view]
    page = StepBoard((), tuple(every)).page()
    svg = view_svg(task, view, names)
    assert re.findall(r'<g id="(.*?)">', svg) == [group.key for group in page.groups]
    assert all(group_svg(group, page.height) in svg for group in page.groups)
    # Of these the roller is drawn in the profile alone.
    assert (svg != view_svg(gc.builtin_task(), view, names)) == (view == "profile")


@pytest.mark.slow
def test_the_rows_name_what_is_waited_for_with_a_unit_and_a_goal_each():
    rows = list(solve_rows(Gauge(Timer(0.0, least_runs=1), 0, 0)))
    whole, *others = rows
    assert (whole.name, whole.goal, whole.seconds > whole.ratio) == ("solve, all files", "<= 1", True)
    assert {row.name: row.goal for row in others} == {
        "layout": "<= 250",
        "step player": "<= 150",
        "view after a size changed": "<= 30",
    }
    assert all(row.unit == "ms" and row.ratio == 1e3 * row.seconds > 0 for row in others)
    assert len(others) == 3 * len({row.what.partition(",")[0] for row in others})

"""What a user waits for: that the view drawn anew is the one a whole solution has, and what the rows are."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

import graphcam as gc
from graphcam.bench.bench_report import QUICK_EFFORT
from graphcam.bench.waiting_rows import built_in, dragging, resized, solve_rows, studio_rows, view_svg
from graphcam.plots.step_board import StepBoard
from graphcam.sheets.player import group_svg
from graphcam.studio.task_text import plain_task

ONCE = replace(QUICK_EFFORT, budget=0.0, least_runs=1)
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


def test_every_picture_of_a_drag_is_another_one():
    again = dragging(plain_task(gc.builtin_task()), "combined")
    first, second = (again()["sizes"]["offset"] for _ in range(2))
    assert first != second


@pytest.mark.slow
def test_the_rows_name_what_is_waited_for_with_a_unit_and_a_goal_each():
    whole, *others = solve_rows(ONCE)
    assert (whole.name, whole.goal, whole.ratio > 1) == ("solve, all files", "<= 2.2", True)
    goals = {"layout": "<= 250", "step player": "<= 150", "view after a size changed": "<= 30"}
    assert {row.name: row.goal for row in others} == goals
    dragged = list(studio_rows(ONCE))
    assert len(dragged) == 9 + 10 + 6 + 7 + 12 + 9
    for rows in (others, dragged):
        assert all(row.unit == "ms" and row.ratio == pytest.approx(1e3 * row.seconds) and row.ratio > 0 for row in rows)
        assert {row.what.partition(",")[0] for row in rows} == {*built_in()}
    assert len(others) == 3 * len(built_in())

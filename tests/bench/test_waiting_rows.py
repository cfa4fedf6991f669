"""What a user waits for: that the view drawn anew is the one a whole solution has."""

from __future__ import annotations

import re

import pytest

import graphcam as gc
from graphcam.bench.waiting_rows import dragging, resized, view_svg
from graphcam.plots.step_board import StepBoard
from graphcam.sheets.player import group_svg
from graphcam.studio.task_text import plain_task

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

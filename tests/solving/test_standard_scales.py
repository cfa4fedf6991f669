"""Every view is drawn at a scale of the standard that its sheet is framed by."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

import pytest

import graphcam as gc
from graphcam.drafting.ink import Construction
from graphcam.drafting.scale import STANDARD_RATIOS
from graphcam.solving.arcs_solution import solve_arcs

ARM = gc.builtin_task("arm")


def of_the_standard(scales: Iterable[float], frame: str) -> bool:
    return all(any(abs(mu * ratio - 1) < 1e-12 for ratio in STANDARD_RATIOS[frame]) for mu in scales)


def scales_of(drawn: Mapping[str, Construction]) -> dict[str, float]:
    views = [step.view for construction in drawn.values() for step in construction.steps()]
    return {view.name: view.mu_l for view in views if view.mu_l is not None}


def open_arm(arm: float, frame: str) -> gc.Task:
    """The built-in arm with another length, its cam's size and place left open."""
    return replace(
        ARM,
        cam=replace(ARM.cam, prime_radius=None),
        follower=replace(ARM.follower, arm=arm, distance=None),
        drawing=replace(ARM.drawing, frame=frame),
    )


@pytest.mark.parametrize("frame", STANDARD_RATIOS)
@pytest.mark.parametrize("arm", [110.0, 900.0])
def test_the_views_of_an_arm_have_scales_of_the_sheet_s_standard(arm, frame):
    scales = scales_of(gc.solve(open_arm(arm, frame)).drawn)
    assert {"region", "cam centre"} <= scales.keys()
    assert of_the_standard(scales.values(), frame)


@pytest.mark.parametrize("frame", STANDARD_RATIOS)
def test_the_views_of_a_cam_of_arcs_have_scales_of_the_sheet_s_standard(frame):
    task = gc.builtin_arcs_task()
    scales = scales_of(solve_arcs(replace(task, drawing=replace(task.drawing, frame=frame))).drawn)
    assert scales
    assert of_the_standard(scales.values(), frame)

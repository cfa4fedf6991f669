"""A sample of the command ``three_points.py``: how near many hands come to the least radius of curvature."""

from __future__ import annotations

import numpy as np
import pytest
from boards import board_of, coursework, motion_of
from over_all import over_all
from three_points import BEFORE, LINES, SMALL, chains, measured

import graphcam as gc
from graphcam.constructions.chain import Chain
from graphcam.constructions.sharpest_bend import share_of_phase

SHEETS = 100
LARGE = ("coursework", "arm", "measured", "cycloidal", "eighteen parts", "in stages", "small lift")


@pytest.fixture(scope="module")
def found():
    drawn = chains()
    return {(name, line): measured(drawn[name], line, SHEETS, seed=2) for name in LARGE for line in LINES}


def test_many_hands_are_off_by_half_of_what_the_smallest_circle_was_off(found):
    """By the root of the mean square of all sheets, and nearly so of each."""
    ratios = {key: f.rms / BEFORE[key[0]][LINES.index(key[1])] for key, f in found.items()}
    assert {key: ratio for key, ratio in ratios.items() if ratio > 0.6} == {}
    now, then = (
        np.array([pair[k] for pair in ((f.rms, f.rms / ratios[key]) for key, f in found.items())]) for k in (0, 1)
    )
    assert np.sqrt(np.mean(now**2) / np.mean(then**2)) < 0.5


def test_a_hand_without_error_is_not_farther_off_than_before(found):
    for (name, _), f in found.items():
        assert abs(f.perfect) <= abs(BEFORE[name][2]), name
        assert f.paper > SMALL


@over_all("line", [0.1, 0.2, 0.4])
def test_a_thicker_line_steps_farther_by_its_fourth_root(line):
    assert share_of_phase(16 * line) == pytest.approx(2 * share_of_phase(line))
    alone = Chain(coursework("3-4-5"), gc.Pencil.of(line, seed=1))["curvature"].acts["triple"].act.takes["which"]
    parts = np.diff(alone) / 8
    assert parts == pytest.approx(np.full(2, 12 * share_of_phase(line)), abs=1 / 16)


@over_all("law", ["3-4-5", "cycloidal", "modified-sine", "rectangular"])
def test_an_arc_of_a_dwell_is_taken_only_where_the_cam_is_sharpest_there(law):
    """On a cam of a long lift the lower dwell is the sharpest, else a moving phase or its end is.

    At a jump inside a phase the points lie on one side of it, a chord from the sharpest place.
    """
    near = 0.06 if law == "rectangular" else 0.02
    for lift, r0 in ((30, 15.0), (30, 45.0), (10, 45.0), (20, 80.0)):
        board = board_of(motion_of((lift, 150, law), (0, 30), (-lift, 120, law)), offset=0.0, prime_radius=r0)
        cam = gc.Cam(board.motion, gc.Translating(0.0, 1.0), r0, board.rotation)
        moving, resting = Chain(board)["curvature"].value("rho_candidates")
        exact, least = cam.extremes().min_convex_radius_moving[0], cam.extremes().min_convex_radius[0]
        if abs(exact - r0) > near * r0:
            assert (moving < resting) == (exact < r0 * (1 - 1e-9)), (lift, r0)
        assert min(moving, resting) == pytest.approx(least, rel=0.06), (lift, r0)

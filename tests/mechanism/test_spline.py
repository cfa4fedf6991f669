"""The B-spline of the profile: how far it lies off, measured apart from its own measurement, and how smooth it is."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial import cKDTree
from test_undercut import one_loop, random_cam, with_roller

from graphcam.errors import DesignError
from graphcam.given.follower import Translating
from graphcam.given.motion import Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.spline import ProfileSpline, profile_spline

DEG = math.pi / 180


def greatest_distance(points: np.ndarray, curve: np.ndarray) -> float:
    """From points to the closed polygon through dense points of a curve [mm]."""
    _, k = cKDTree(curve).query(points)
    return float(np.minimum(to_side(points, curve, k - 1), to_side(points, curve, k)).max())


def to_side(points: np.ndarray, curve: np.ndarray, k: np.ndarray) -> np.ndarray:
    start, side = curve[k], curve[(k + 1) % len(curve)] - curve[k]
    share = np.sum((points - start) * side, axis=1) / np.maximum(np.sum(side**2, axis=1), 1e-300)
    return np.linalg.norm(start + np.clip(share, 0, 1)[:, None] * side - points, axis=1)


def along(spline: ProfileSpline) -> np.ndarray:
    """20 times as many points as control points."""
    return spline(np.linspace(0, spline.knots[-1], 20 * len(spline.control), endpoint=False))


@pytest.mark.parametrize("seed", range(20))
def test_random_profiles_are_met_within_a_micrometre_by_few_control_points(seed):
    cam = random_cam(seed)
    spline = profile_spline(cam, trimmed=True)
    exact = cam.trimmed_profile(200_000)
    measured = greatest_distance(along(spline), exact)
    assert measured <= 0.001
    assert measured <= spline.deviation * 1.02 + 1e-6  # as reported; the polygon itself is 1e-6 off at most
    assert spline.deviation <= 0.001
    assert len(spline.control) <= 100
    # And no part of the profile is left out.
    assert greatest_distance(exact[::50], spline(np.linspace(0, spline.knots[-1], 40_000, endpoint=False))) <= 0.00101


@pytest.mark.parametrize("seed", range(20))
def test_it_is_one_clamped_closed_cubic(seed):
    spline = profile_spline(random_cam(seed), trimmed=True)
    knots, control = spline.knots, spline.control
    assert len(knots) == len(control) + 4
    assert np.all(np.diff(knots) >= 0)
    assert np.all(knots[:4] == 0)
    assert np.all(knots[-4:] == knots[-1])
    assert_allclose(control[0], control[-1], atol=1e-12)
    _, multiplicity = np.unique(knots[4:-4], return_counts=True)
    assert multiplicity.max(initial=1) <= 3


def gap(spline: ProfileSpline, derivative: int) -> float:
    """By how much a derivative misses itself where the ends meet."""
    start, end = spline(0.0, derivative), spline(spline.knots[-1], derivative)
    return float(np.abs(end - start).max())


@pytest.mark.parametrize("law", ["3-4-5", "cycloidal", "modified-sine", "triangular", "trapezoidal"])
@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_a_cam_without_jumps_is_curvature_continuous_all_around(law, rotation):
    cam = one_loop(law, rotation, -0.3)
    spline = profile_spline(cam)
    assert gap(spline, 1) <= 1e-12
    assert gap(spline, 2) <= 1e-12
    inner = spline.knots[4:-4]
    assert len(np.unique(inner)) == len(inner)  # simple knots: a cubic spline is C2 there


def test_only_where_the_acceleration_jumps_are_knots_double():
    motion = Motion([
        Rise(30, 100 * DEG, "rectangular"), Dwell(80 * DEG), Return(30, 120 * DEG, "cycloidal"), Dwell(60 * DEG),
    ])  # fmt: skip
    cam = Cam(motion, Translating(8, 10), 60)
    spline = profile_spline(cam)
    places, multiplicity = np.unique(spline.knots[4:-4], return_counts=True)
    doubled = spline(places[multiplicity == 2])
    # Start, middle and end of the rise; one of the three is the seam.
    jumps = cam.profile(np.array([0, 50, 100]) * DEG)
    met = [np.linalg.norm(doubled - jump, axis=1).min() < 1e-9 for jump in jumps]
    seam = [np.linalg.norm(spline(0.0) - jump) < 1e-9 for jump in jumps]
    assert len(doubled) == 2
    assert np.logical_or(met, seam).all()
    assert multiplicity.max() == 2
    # Unit speed and the exact tangent on both sides, the curvature of either side.
    step = 1e-9 * spline.knots[-1]
    for place in places[multiplicity == 2]:
        before, after = spline(place - step, 1), spline(place + step, 1)
        assert_allclose(before, after, atol=1e-8)
        assert np.linalg.norm(after) == pytest.approx(1, abs=1e-8)
        assert np.linalg.norm(spline(place + step, 2) - spline(place - step, 2)) > 1e-3


@pytest.mark.parametrize("excess", [1e-6, 1e-3, 0.1, 0.3])
def test_a_corner_is_met_exactly(excess):
    cam = one_loop("3-4-5", "ccw", excess)
    (loop,) = cam.undercuts()
    with pytest.raises(DesignError, match=r"profile is 'undercut from .* degrees'.*without undercut.*trimmed=True"):
        profile_spline(cam)
    spline = profile_spline(cam, trimmed=True)
    assert_allclose(spline(0.0), loop.crossing[2:], atol=1e-12)  # the seam is at the corner
    assert greatest_distance(along(spline), cam.trimmed_profile(200_000)) <= 0.001


@pytest.mark.parametrize("share", [1.0, 1 - 1e-9, 1 - 1e-4])
def test_a_cusp_and_all_but_a_cusp_are_met(share):
    cam = with_roller(one_loop("cycloidal", "cw", 0.0), share)
    spline = profile_spline(cam)
    assert greatest_distance(along(spline), cam.trimmed_profile(400_000)) <= 0.001


def test_the_error_falls_by_the_fourth_power():
    """Sixteen times the accuracy costs twice the parts."""
    cam = one_loop("3-4-5", "ccw", -0.3)
    sizes = [len(profile_spline(cam, deviation).control) for deviation in (1e-2, 1e-2 / 16, 1e-2 / 256, 1e-2 / 4096)]
    ratios = np.array(sizes[1:]) / sizes[:-1]
    assert np.all((ratios > 1.5) & (ratios < 2.5))
    assert profile_spline(cam, 1e-7).deviation <= 1e-7


@pytest.mark.parametrize("deviation", [0.0, -1.0, 1e-10, math.nan])
def test_a_deviation_that_cannot_be_kept_is_refused(deviation):
    with pytest.raises(DesignError, match="deviation is"):
        profile_spline(one_loop("3-4-5", "ccw", -0.3), deviation)

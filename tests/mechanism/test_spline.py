"""The B-spline of the profile: how far it lies off, measured apart from its own measurement, and how smooth it is."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from over_all import over_all, over_seeds, pairs
from scipy.spatial import cKDTree
from test_undercut import one_loop, random_cam, with_roller

from graphcam.errors import DesignError
from graphcam.given.follower import FlatFaced, Oscillating, Translating
from graphcam.given.motion import Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.profile_spline import ProfileSpline, profile_spline

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
    """Points of all of it, 41 between two knots."""
    ends = np.unique(spline.knots)
    return spline((ends[:-1, None] + np.diff(ends)[:, None] * np.linspace(0, 1, 41, endpoint=False)).ravel())


@over_seeds(2)
def test_random_profiles_are_met_within_half_a_micrometre_by_few_control_points(seed):
    cam = random_cam(seed)
    spline = profile_spline(cam, trimmed=True)
    exact = cam.trimmed_profile(200_000)
    measured = greatest_distance(along(spline), exact)
    assert measured <= 0.0005
    assert measured <= spline.deviation * 1.03 + 1e-6  # as reported; the polygon itself is 1e-6 off at most
    assert len(spline.control) <= 75
    # And no part of the profile is left out.
    assert greatest_distance(exact[::50], spline(np.linspace(0, spline.knots[-1], 40_000, endpoint=False))) <= 0.00051


@over_seeds(2)
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


@over_all("law", ["3-4-5", "cycloidal", "modified-sine", "triangular", "trapezoidal"])
@over_all("rotation", ["ccw", "cw"])
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


@over_all("excess", [1e-6, 1e-3, 0.1, 0.3])
def test_a_corner_is_met_exactly(excess):
    cam = one_loop("3-4-5", "ccw", excess)
    (loop,) = cam.undercuts()
    with pytest.raises(DesignError, match=r"profile is undercut from .* degrees.*without undercut.*trimmed=True"):
        profile_spline(cam)
    spline = profile_spline(cam, trimmed=True)
    assert_allclose(spline(0.0), loop.crossing[2:], atol=1e-12)  # the seam is at the corner
    assert greatest_distance(along(spline), cam.trimmed_profile(200_000)) <= 0.0005


@over_all("share", [1.0, 1 - 1e-9, 1 - 1e-4])
def test_a_cusp_and_all_but_a_cusp_are_met(share):
    cam = with_roller(one_loop("cycloidal", "cw", 0.0), share)
    spline = profile_spline(cam)
    assert greatest_distance(along(spline), cam.trimmed_profile(400_000)) <= 0.0005


def sized(size: float, follower) -> Cam:
    """A cam of one shape in any size."""
    lift = 0.4 if isinstance(follower, Oscillating) else 25 * size
    moving = Rise(lift, 70 * DEG, "modified-sine"), Dwell(60 * DEG), Return(lift, 90 * DEG, "3-4-5"), Dwell(140 * DEG)
    return Cam(Motion(moving), follower, 45 * size)


@over_all(("case", "degree"), pairs(["tiny", "large", "flat", "arm", "far offset", "cusp", "corner"], [2, 3, 4, 5], 2))
def test_every_degree_meets_hard_profiles_within_half_a_micrometre(case, degree):
    cam = {
        "tiny": lambda: sized(0.02, Translating(0.1, 0.3)),
        "large": lambda: sized(50.0, Translating(400.0, 500.0)),
        "flat": lambda: sized(1.0, FlatFaced()),
        "arm": lambda: sized(1.0, Oscillating(80.0, 100.0, 10.0)),
        "far offset": lambda: sized(1.0, Translating(-44.9, 5.0)),
        "cusp": lambda: with_roller(one_loop("cycloidal", "cw", 0.0), 1.0),
        "corner": lambda: one_loop("3-4-5", "ccw", 0.1),
    }[case]()
    spline = profile_spline(cam, degree=degree, trimmed=True)
    _, times = np.unique(spline.knots, return_counts=True)
    assert len(spline.knots) == len(spline.control) + degree + 1
    assert times[0] == times[-1] == degree + 1
    assert times[1:-1].max(initial=1) <= degree
    assert spline.control[0].tolist() == spline.control[-1].tolist()
    exact = cam.trimmed_profile(200_000)
    size = float(np.abs(exact).max())
    measured = greatest_distance(along(spline), exact)
    assert measured <= 0.0005
    assert measured == pytest.approx(spline.deviation, rel=0.05, abs=1e-9 * size)


@over_all("degree", [2, 3, 4, 5])
def test_as_many_control_points_as_asked_for_with_the_error_they_leave(degree):
    """Twice as many leave less by about the power p + 1 of two; a corner takes some, and still the number is kept."""
    for cam in (one_loop("3-4-5", "ccw", -0.3), one_loop("3-4-5", "ccw", 0.1)):
        exact = cam.trimmed_profile(200_000)
        errors = []
        for count in (40, 80):
            spline = profile_spline(cam, degree=degree, control_points=count, trimmed=True)
            assert len(spline.control) == count
            measured = greatest_distance(along(spline), exact)
            # A bad fit slides along the curve too, which its own measure leaves out.
            assert measured == pytest.approx(spline.deviation, rel=0.03, abs=2e-8)
            errors.append(measured)
        assert errors[0] / errors[1] > 0.8 * 2 ** (degree + 1)


def test_so_few_control_points_that_the_profile_is_missed_are_no_error():
    cam = one_loop("3-4-5", "ccw", -0.3)
    assert profile_spline(cam, control_points=12).deviation > 0.05


@over_all("count", [-1, 3, 2001])
def test_what_no_spline_can_have_is_refused(count):
    with pytest.raises(DesignError, match=rf"control_points is {count}, but must be \d+ to 2000 for this profile"):
        profile_spline(one_loop("3-4-5", "ccw", -0.3), control_points=count)
    with pytest.raises(DesignError, match="degree is 6, but must be 2, 3, 4 or 5"):
        profile_spline(one_loop("3-4-5", "ccw", -0.3), degree=6)  # pyright: ignore[reportArgumentType]


@over_all("degree", [2, 3, 4, 5])
def test_the_error_falls_by_the_power_of_the_degree_and_one(degree):
    """2^(p + 1) times the accuracy costs twice the parts."""
    cam = one_loop("3-4-5", "ccw", -0.3)
    steps = [1e-2 / 2 ** (k * (degree + 1)) for k in range(4)]
    parts = [len(profile_spline(cam, deviation, degree=degree).control) - degree for deviation in steps]
    ratios = np.array(parts[1:]) / parts[:-1]
    assert np.all((ratios > 1.4) & (ratios < 2.5))


def test_the_least_deviations_are_kept():
    cam = one_loop("3-4-5", "ccw", -0.3)
    spline = profile_spline(cam, 1e-7)
    assert spline.deviation <= 1e-7
    # Between where it was measured too: against the exact normal at places of its own.
    phi = np.random.default_rng(1).uniform(0, 2 * math.pi, 500)
    exact = cam.profile(phi)
    assert greatest_distance(exact, spline(np.linspace(0, spline.knots[-1], 400_000, endpoint=False))) <= 1.1e-7
    assert profile_spline(cam, 1e-9, degree=5).deviation <= 1e-9


@over_all("deviation", [0.0, -1.0, 1e-10, math.nan])
def test_a_deviation_that_cannot_be_kept_is_refused(deviation):
    with pytest.raises(DesignError, match="deviation is"):
        profile_spline(one_loop("3-4-5", "ccw", -0.3), deviation)

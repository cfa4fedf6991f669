"""The translating cam against its definition at 50 digits, differentiated numerically (see ``reference``)."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import diff, findroot, mp, mpf
from numpy.testing import assert_allclose, assert_array_equal
from over_all import over_all, over_seeds
from reference import EPS, ReferenceCam

from graphcam.errors import DesignError
from graphcam.given.follower import FlatFaced, Oscillating, Translating
from graphcam.given.laws import LAWS
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.given.piecewise import CHUNK_SIZE
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.turn_extremes import max_acceleration, max_velocity

DEG = math.pi / 180


def random_cam(seed: int) -> Cam:
    """All laws come up in turn; rotation, offset, roller and angles are drawn."""
    rng = np.random.default_rng(seed)
    rise, back = LAWS[seed % 10], LAWS[(3 * seed + seed // 10) % 10]
    angles = rng.uniform(0.5, 1.5, 4)
    angles *= FULL_TURN / angles.sum()
    h, r0 = rng.uniform(5, 60), rng.uniform(20, 120)
    ratios = [float(rng.uniform(0.3, 3)) if name == "rectangular" else 1.0 for name in (rise, back)]
    phases = [
        Rise(h, angles[0], rise, ratios[0]),
        Dwell(angles[1]),
        Return(h, angles[2], back, ratios[1]),
        Dwell(angles[3]),
    ]
    follower = Translating(offset=rng.uniform(-0.9, 0.9) * r0, roller_radius=float(rng.choice([0, 0.1, 0.4]) * r0))
    return Cam(Motion(phases), follower, float(r0), "ccw" if rng.random() < 0.5 else "cw")


def points(values: list) -> np.ndarray:
    return np.array([[float(x), float(y)] for x, y in values])


@over_seeds(6)
def test_random_cams_agree_with_the_differentiated_definition(seed):
    cam, phi = random_cam(seed), np.random.default_rng(seed + 1000).random(8) * FULL_TURN
    exact = ReferenceCam(cam)
    angles = [mpf(float(x)) for x in phi]
    pitch, profile = points([exact.pitch(x) for x in angles]), points([exact.profile(x) for x in angles])
    size = np.linalg.norm(pitch, axis=1, keepdims=True)
    assert np.abs((cam.pitch_curve(phi) - pitch) / size).max() <= 1e-14
    assert np.abs((cam.profile(phi) - profile) / size).max() <= 1e-13
    assert_allclose(cam.pressure_angle(phi), [float(exact.pressure_angle(x)) for x in angles], rtol=1e-12, atol=1e-14)
    kappa = np.array([float(exact.curvature(x)) for x in angles])
    # Near an inflection the curvature is a small difference: there the size of its terms, 1/|p|, is the measure.
    assert np.all(np.abs(cam.pitch_curvature(phi) - kappa) <= 1e-12 * np.maximum(np.abs(kappa), 1 / size[:, 0]))


@over_all("rotation", ["ccw", "cw"])
@over_all("e", [0.0, 7.0, -7.0])
def test_coordinates_to_four_eps(rotation, e):
    """Through the phase and its fraction, which are known exactly, so that only the cam's own rounding counts."""
    motion = Motion([Rise(32, FULL_TURN / 4, "3-4-5"), Return(32, FULL_TURN / 4, "3-4-5"), Dwell(FULL_TURN / 2)])
    cam = Cam(motion, Translating(offset=e), 40.0, rotation)
    u = np.arange(65) / 64
    computed, exact = cam.at(0, u), ReferenceCam(cam)
    for point, fraction in zip(computed.pitch, u, strict=True):
        wanted = exact.pitch(mpf(float(fraction)) * mpf(FULL_TURN / 4))
        assert max(abs(mpf(float(x)) - w) for x, w in zip(point, wanted, strict=True)) <= 4 * EPS * mp.norm(wanted)


def test_offset_near_the_prime_radius_keeps_its_digits():
    cam = Cam(random_cam(8).motion, Translating(offset=50 * (1 - 1e-12)), 50.0)
    assert cam.pitch_curve(0.0)[1] == pytest.approx(7.07113090781193565e-5, rel=4 * EPS)
    exact = ReferenceCam(cam)
    for phi in (0.05, 0.4, 1.0):
        curvature = float(exact.curvature(mpf(phi)))
        assert float(cam.pitch_curvature(phi)) == pytest.approx(curvature, rel=500 * EPS)


# --- what must hold for every cam ------------------------------------------------------------------------------------


@over_seeds(8)
def test_the_turned_cam_lifts_the_follower_by_s(seed):
    cam, phi = random_cam(seed), np.linspace(0, FULL_TURN, 100)
    x, y = cam.pitch_curve(phi).T
    frame = (x + 1j * y) * np.exp(1j * cam.sigma * phi)
    e, r0 = cam.follower.offset, cam.prime_radius
    assert_allclose(frame.real, e, atol=1e-13 * r0)
    assert_allclose(frame.imag - math.sqrt(r0**2 - e**2), cam.motion(phi)[0], atol=1e-13 * r0)


@over_seeds(8)
def test_the_roller_touches_its_profile_in_one_point(seed):
    """The profile lies at the roller radius, and its tangent is the pitch curve's: it is the envelope."""
    cam, step = random_cam(seed), 1e-5
    phi = np.setdiff1d(np.linspace(0.01, 6.2, 50), cam.motion.breaks)
    pitch, profile = cam.pitch_curve(phi), cam.profile(phi)
    spoke = pitch - profile
    assert_allclose(np.linalg.norm(spoke, axis=1), cam.follower.roller_radius, atol=1e-13 * cam.prime_radius)
    assert np.all(np.linalg.norm(profile, axis=1) <= np.linalg.norm(pitch, axis=1))
    along = (cam.profile(phi + step) - cam.profile(phi - step)) / (2 * step)
    of_the_difference = 1e-7
    assert np.abs(np.sum(spoke * along, axis=1)).max() <= of_the_difference * cam.prime_radius**2


@over_seeds(6)
def test_a_mirror_turns_ccw_into_cw_and_the_offset_to_the_other_side(seed):
    cam, phi = random_cam(seed), np.linspace(0, FULL_TURN, 50)
    f = cam.follower
    other = Cam(
        cam.motion, Translating(-f.offset, f.roller_radius), cam.prime_radius, {"ccw": "cw", "cw": "ccw"}[cam.rotation]
    )
    assert_allclose(other.profile(phi) * [-1, 1], cam.profile(phi), atol=1e-13)
    assert_allclose(other.pressure_angle(phi), cam.pressure_angle(phi), atol=1e-15)
    assert_allclose(other.pitch_curvature(phi), cam.pitch_curvature(phi), rtol=1e-12)
    assert_allclose(other.extremes().pressure_angle_rise, cam.extremes().pressure_angle_rise, rtol=1e-12)


def test_a_dwell_is_a_circle_about_the_cam_centre():
    cam = Cam(Motion([Rise(30, 2.0), Dwell(1.0), Return(30, 2.0), Dwell(FULL_TURN - 5)]), Translating(12, 5), 50)
    high = math.hypot(12, math.sqrt(50**2 - 12**2) + 30)
    for phi, radius in ((2.5, high), (5.5, 50)):
        assert float(cam.pitch_curvature(phi)) == pytest.approx(1 / radius, rel=4 * EPS)
        assert np.linalg.norm(cam.pitch_curve(phi)) == pytest.approx(radius, rel=4 * EPS)


def test_values_by_phase_are_the_values_by_angle_and_take_the_named_side():
    cam = random_cam(10)
    phase, u = np.array([0, 0, 2, 3]), np.array([0.25, 0.6, 0.3, 0.5])
    here = cam.at(phase, u)
    assert_allclose(here.phi, cam.motion.angle_at(phase, u))
    for by_phase, by_angle in (
        (here.pitch, cam.pitch_curve(here.phi)), (here.profile, cam.profile(here.phi)),
        (here.pressure_angle, cam.pressure_angle(here.phi)), (here.curvature, cam.pitch_curvature(here.phi)),
        (np.array(here.values), np.array(cam.motion(here.phi))),
    ):  # fmt: skip
        assert_allclose(by_phase, by_angle, rtol=1e-12, atol=1e-12)
    end = cam.motion.starts[1]
    assert cam.at(0, 1.0).curvature == pytest.approx(float(cam.pitch_curvature(end, side="left")), rel=1e-12)
    assert cam.at(1, 0.0).curvature == pytest.approx(float(cam.pitch_curvature(end, side="right")), rel=1e-12)
    assert cam.at(0, 1.0).curvature != pytest.approx(float(cam.at(1, 0.0).curvature), rel=1e-3)


def test_shapes_and_nan():
    cam = random_cam(3)
    assert cam.pitch_curve(0.5).shape == cam.profile(0.5).shape == (2,)
    assert cam.pitch_curve(np.zeros((4, 3))).shape == cam.profile(np.zeros((4, 3))).shape == (4, 3, 2)
    assert cam.pressure_angle(0.5).shape == cam.pitch_curvature(0.5).shape == ()
    for values in (cam.pitch_curve, cam.profile, cam.pressure_angle, cam.pitch_curvature):
        result = values([np.nan, 1.0, np.inf])
        assert np.isnan(result[0]).all()
        assert np.isfinite(result[1]).all()
        assert np.isnan(result[2]).all()


# --- extremes --------------------------------------------------------------------------------------------------------


@over_seeds(6)
def test_extremes_are_the_greatest_and_their_angles_are_roots(seed):
    cam = random_cam(seed)
    extremes, exact = cam.extremes(), ReferenceCam(cam)
    u = np.linspace(0, 1, 4001)
    for phase, found in ((0, extremes.pressure_angle_rise), (2, extremes.pressure_angle_return)):
        alpha = cam.at(phase, u).pressure_angle
        assert np.abs(alpha).max() <= abs(found[0]) * (1 + 4 * EPS)
        assert abs(found[0]) <= np.abs(alpha).max() + 1e-3
        check_extreme(cam, exact.pressure_angle, found)
    kappa = [cam.at(phase, u, side).curvature for phase in range(4) for side in ("left", "right")]
    value, phi = extremes.min_convex_radius
    assert value <= 1 / np.max(kappa) * (1 + 16 * EPS)
    assert 1 / value <= np.max(kappa) * (1 + 1e-3)
    check_extreme(cam, exact.curvature, (1 / value, phi))


def check_extreme(cam: Cam, function, found: tuple[float, float]) -> None:
    value, phi = found
    distance = np.abs(cam.motion.breaks - phi).min()
    if distance < 1e-9 or FULL_TURN - phi < 1e-9:  # at an end of a piece: from the side where the extreme lies
        nearby = [function(mpf(phi) + side * mpf(10) ** -14) for side in (1, -1) if phi + side * 1e-9 >= 0]
        assert min(abs(float(x) - value) for x in nearby) <= 1e-11 * max(1.0, abs(value))
        return
    root = findroot(lambda x: diff(function, x), mpf(phi), tol=1e-20)
    assert phi == pytest.approx(float(root), abs=1e-11)
    assert value == pytest.approx(float(function(root)), rel=1e-13)


@over_all("small", [1e-3, 1e-6])
def test_extremes_close_to_an_end_of_a_phase_are_not_missed(small):
    """With a tiny height of the cam centre below the start, the greatest angle lies in the first instants."""
    r0 = 1e3 * small
    cam = Cam(Motion([Rise(30, 2.0, "2-3"), Return(30, FULL_TURN - 2, "2-3")]), Translating(0), r0)
    value, phi = cam.extremes().pressure_angle_rise
    fine = np.abs(cam.at(0, np.logspace(-12, 0, 20001)).pressure_angle).max()
    assert value >= fine
    assert value == pytest.approx(fine, abs=1e-7)
    assert phi < 0.3


def test_extremes_look_at_all_phases():
    """The steepest of two rises, not the first; the sharpest place in a return that starts the motion."""
    motion = Motion([Return(20, 1.0), Rise(8, 1.0), Rise(12, 0.6), Dwell(FULL_TURN - 2.6)])
    cam = Cam(motion, Translating(0), 40)
    extremes = cam.extremes()
    assert 2.0 < extremes.pressure_angle_rise[1] < 2.6
    assert extremes.pressure_angle_return[0] < 0 < extremes.pressure_angle_return[1] < 1
    assert extremes.min_convex_radius == extremes.min_convex_radius_moving


def test_the_least_radius_of_the_moving_phases_leaves_out_the_dwells():
    """A small lift on a large cam: the low dwell, a circle of the prime radius, is the sharpest place or nearly so."""
    motion = Motion([Rise(1, 3.0, "rectangular"), Dwell(0.2), Return(1, 3.0, "rectangular"), Dwell(FULL_TURN - 6.2)])
    extremes = Cam(motion, Translating(0), 30).extremes()
    assert extremes.min_convex_radius[0] <= extremes.min_convex_radius_moving[0]
    slow = Motion([Rise(90, 3.0, "rectangular", 0.02), Return(90, FULL_TURN - 3.0, "rectangular", 50.0)])
    assert Cam(slow, Translating(0), 5).extremes().min_convex_radius_moving[0] > 0


def test_greatest_velocity_and_acceleration_are_those_of_the_sharpest_phase():
    motion = Motion([Rise(50, 120 * DEG, "cosine"), Dwell(30 * DEG), Return(50, 60 * DEG, "cosine"), Dwell(150 * DEG)])
    phi = np.linspace(0, FULL_TURN, 7201)
    for side in ("left", "right"):
        _, v, a, _ = motion(phi, side)
        assert np.abs(v).max() <= max_velocity(motion) * (1 + 4 * EPS)
        assert np.abs(a).max() <= max_acceleration(motion) * (1 + 4 * EPS)
    assert max_velocity(motion) == pytest.approx(math.pi / 2 * 50 / (60 * DEG), rel=4 * EPS)
    assert max_acceleration(motion) == pytest.approx(math.pi**2 / 2 * 50 / (60 * DEG) ** 2, rel=4 * EPS)


# --- what cannot be --------------------------------------------------------------------------------------------------

MOTION = Motion([Rise(30, 2.0), Return(30, FULL_TURN - 2)])


@over_all(
    ("make", "message"),
    [
        (
            lambda: Cam(MOTION, Translating(50.0), 50.0),
            "offset is 50.0, but must be smaller than the prime radius of 50",
        ),
        (lambda: Cam(MOTION, Translating(-60.0), 50.0), "offset is -60.0"),
        (lambda: Cam(MOTION, Translating(), 0.0), "prime radius is 0.0, but must be a finite length of more than 0 mm"),
        (lambda: Cam(MOTION, Translating(), -5.0), "prime radius is -5.0"),
        (lambda: Cam(MOTION, Translating(), math.nan), "prime radius is nan"),
        (lambda: Cam(MOTION, Translating(), math.inf), "prime radius is inf"),
        (
            lambda: Cam(MOTION, Translating(0, 50.0), 50.0),
            "roller radius is 50.0, but must be smaller than the prime radius",
        ),
        (lambda: Cam(MOTION, Translating(0, -1.0), 50.0), "roller radius is -1.0"),
        (lambda: Cam(MOTION, Translating(math.nan), 50.0), "offset is nan"),
        (lambda: Cam(MOTION, Translating(), 50.0, "left"), "rotation is 'left', but must be 'ccw' or 'cw'"),
    ],
)
def test_cams_that_cannot_be_are_refused_with_reason(make, message):
    with pytest.raises(DesignError, match=message):
        make()


@over_all("follower", [Translating(10, 12), Oscillating(80, 100, roller_radius=9), FlatFaced()])
def test_curves_together_are_the_curves_one_by_one_in_any_order_and_chunks(follower):
    swing = 0.4 if isinstance(follower, Oscillating) else 30
    cam = Cam(
        Motion([Rise(swing, 2.0), Dwell(1.0), Return(swing, 2.0, "modified-sine"), Dwell(FULL_TURN - 5)]), follower, 50
    )
    phi = np.linspace(0, FULL_TURN, 3 * CHUNK_SIZE + 5, endpoint=False)
    together = cam.curves(phi)
    for rows, one in zip(together, (cam.pitch_curve, cam.profile, cam.pitch_curvature), strict=True):
        assert_array_equal(one(phi), rows)
        assert_array_equal(one(phi[::-1]), rows[::-1])
        for part in (slice(3, 4), slice(7, 900), slice(CHUNK_SIZE - 1, CHUNK_SIZE + 2)):
            assert_array_equal(one(phi[part]), rows[part])
    assert [rows.shape for rows in cam.curves(1.0)] == [(2,), (2,), ()]
    assert [rows.shape for rows in cam.curves(np.ones((2, 3)))] == [(2, 3, 2), (2, 3, 2), (2, 3)]

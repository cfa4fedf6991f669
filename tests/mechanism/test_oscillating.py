"""The arm's cam against its definition at 50 digits, differentiated numerically (see ``reference``)."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from mpmath import acos, mpf
from numpy.testing import assert_allclose
from over_all import over_all, over_seeds
from reference import EPS, ReferenceArm

from graphcam.errors import DesignError
from graphcam.given.follower import Oscillating
from graphcam.given.laws import LAWS
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.oscillating import OscillatingKinematics, angle_between

CASES = tomllib.loads((Path(__file__).parents[1] / "data" / "cases.toml").read_text(encoding="utf-8"))
DEG = math.pi / 180


def random_cam(seed: int) -> Cam:
    """All laws come up in turn; rotation, arm, distance, swing, roller and angles are drawn."""
    rng = np.random.default_rng(seed)
    rise, back = LAWS[seed % 10], LAWS[(3 * seed + seed // 10) % 10]
    angles = rng.uniform(0.5, 1.5, 4)
    angles *= FULL_TURN / angles.sum()
    swing, arm = float(rng.uniform(5, 40)) * DEG, float(rng.uniform(40, 150))
    distance, psi0 = float(rng.uniform(0.6, 1.6)) * arm, float(rng.uniform(15, 110)) * DEG
    r0 = math.sqrt((distance - arm) ** 2 + 4 * distance * arm * math.sin(psi0 / 2) ** 2)
    phases = [Rise(swing, angles[0], rise), Dwell(angles[1]), Return(swing, angles[2], back), Dwell(angles[3])]
    follower = Oscillating(arm, distance, roller_radius=float(rng.choice([0, 0.1, 0.4])) * r0)
    return Cam(Motion(phases), follower, r0, "ccw" if rng.random() < 0.5 else "cw")


def points(values: list) -> np.ndarray:
    return np.array([[float(x), float(y)] for x, y in values])


@over_seeds(6)
def test_random_cams_agree_with_the_differentiated_definition(seed):
    cam, phi = random_cam(seed), np.random.default_rng(seed + 1000).random(8) * FULL_TURN
    exact = ReferenceArm(cam)
    angles = [mpf(float(x)) for x in phi]
    pitch, profile = points([exact.pitch(x) for x in angles]), points([exact.profile(x) for x in angles])
    size = np.linalg.norm(pitch, axis=1, keepdims=True)
    assert np.abs((cam.pitch_curve(phi) - pitch) / size).max() <= 1e-14
    assert np.abs((cam.profile(phi) - profile) / size).max() <= 1e-13
    assert_allclose(cam.pressure_angle(phi), [float(exact.pressure_angle(x)) for x in angles], rtol=1e-12, atol=1e-14)
    kappa = np.array([float(exact.curvature(x)) for x in angles])
    # Near an inflection the curvature is a small difference: there the size of its terms, 1/|p|, is the measure.
    assert np.all(np.abs(cam.pitch_curvature(phi) - kappa) <= 1e-12 * np.maximum(np.abs(kappa), 1 / size[:, 0]))


@over_all("excess", [1e-14, 1e-9, 1e-3])
def test_nearly_folded_and_nearly_stretched_arms_keep_the_digits_of_their_angle(excess):
    arm, distance = 100.0, 80.0
    for r0 in (20 * (1 + excess), 180 * (1 - excess)):
        a, b, opposite = mpf(distance), mpf(arm), mpf(r0)
        wanted = float(acos((a * a + b * b - opposite * opposite) / (2 * a * b)))
        assert angle_between(distance, arm, r0) == pytest.approx(wanted, rel=8 * EPS)


def test_the_angle_of_sides_that_do_not_close_is_nan():
    assert math.isnan(angle_between(100, 80, 19))
    assert math.isnan(angle_between(80, 100, 181))
    assert angle_between(80, 100, 20) == 0
    assert angle_between(80, 100, 180) == pytest.approx(math.pi, rel=EPS)


def test_a_published_coursework_arm():
    case = CASES["arm"]
    rise, dwell, back, rest = (angle * DEG for angle in case["phases"])
    swing = case["lift_deg"] * DEG
    motion = Motion([Rise(swing, rise, case["law"]), Dwell(dwell), Return(swing, back, case["law"]), Dwell(rest)])
    r0, arm, distance = case["prime_radius"], case["arm"], case["distance"]
    psi0 = OscillatingKinematics(+1, r0, arm, distance, swing).psi0
    assert math.degrees(psi0) == pytest.approx(case["psi0"], abs=0.005)
    for rotation, angle in case["rise"].items():
        extremes = Cam(motion, Oscillating(arm, distance), r0, rotation).extremes()
        assert math.degrees(extremes.pressure_angle_rise[0]) == pytest.approx(angle, abs=0.005)


def test_a_hand_s_table_of_arc_lifts_scatters_as_a_hand_does():
    """Arc lift is arm times angle; the table adds it to the prime radius, which is not the pitch curve's radius."""
    case, arm = CASES["arm_radii"], 100.0
    rise, dwell, back, rest = (angle * DEG for angle in case["phases"])
    swing = case["arc_lift"] / arm
    laws = case["law"]
    motion = Motion([Rise(swing, rise, laws[0]), Dwell(dwell), Return(swing, back, laws[1]), Dwell(rest)])
    cam = Cam(motion, Oscillating(arm, 100.0), case["prime_radius"])
    for phase, table, scatter in ((0, case["rise"], case["scatter"][0]), (2, case["return"], case["scatter"][1])):
        here = cam.at(phase, np.arange(9) / 8)
        off = np.sort(np.abs(case["prime_radius"] + arm * here.values[0] - table))
        assert off[-2] <= scatter
        assert off[-1] <= (scatter if phase == 0 else case["slip"])
        polar = np.linalg.norm(here.pitch, axis=1)
        assert np.abs(polar - table).max() > 2 * scatter


# --- what must hold for every cam ------------------------------------------------------------------------------------


@over_seeds(8)
def test_the_turned_cam_swings_the_arm_by_s(seed):
    cam, phi = random_cam(seed), np.linspace(0, FULL_TURN, 100)
    x, y = cam.pitch_curve(phi).T
    arm = (x + 1j * y) * np.exp(1j * cam.sigma * phi) - cam.follower.distance
    assert_allclose(np.abs(arm), cam.follower.arm, rtol=1e-14)
    psi = math.pi - np.angle(arm)
    assert_allclose(psi - psi[0], cam.motion(phi)[0], atol=1e-13)
    assert np.linalg.norm(cam.pitch_curve(0.0)) == pytest.approx(cam.prime_radius, rel=1e-14)


@over_seeds(8)
def test_the_roller_touches_its_profile_in_one_point(seed):
    """The profile lies at the roller radius, inside, and its tangent is the pitch curve's: it is the envelope."""
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
def test_the_same_disk_turned_the_other_way_gives_the_motion_backwards(seed):
    cam, phi = random_cam(seed), np.linspace(0.1, 6.1, 50)
    mirrored = {"rise": Return, "return": Rise}
    phases = [
        p if isinstance(p, Dwell) else mirrored[p.kind](p.lift, p.angle, p.law, 1 / p.ratio)
        for p in reversed(cam.motion.phases)
    ]
    other = Cam(Motion(phases), cam.follower, cam.prime_radius, {"ccw": "cw", "cw": "ccw"}[cam.rotation])
    assert_allclose(other.profile(-phi), cam.profile(phi), atol=1e-12 * cam.prime_radius)
    assert_allclose(other.pressure_angle(-phi), cam.pressure_angle(phi), atol=1e-13)
    assert_allclose(other.pitch_curvature(-phi), cam.pitch_curvature(phi), rtol=1e-11)


@over_seeds(6)
def test_extremes_are_not_exceeded_and_are_reached(seed):
    cam = random_cam(seed)
    extremes, u = cam.extremes(), np.linspace(0, 1, 4001)
    for phase, found in ((0, extremes.pressure_angle_rise), (2, extremes.pressure_angle_return)):
        alpha = cam.at(phase, u).pressure_angle
        assert np.abs(alpha).max() <= abs(found[0]) * (1 + 8 * EPS)
        assert abs(found[0]) <= np.abs(alpha).max() + 1e-4
    kappa = np.array([cam.at(phase, u, side).curvature for phase in range(4) for side in ("left", "right")])
    value, phi = extremes.min_convex_radius
    assert 1 / value >= kappa.max() * (1 - 16 * EPS)
    assert 1 / value <= kappa.max() * (1 + 1e-3)
    nearby = [float(cam.pitch_curvature(phi, side)) for side in ("left", "right")]
    assert min(abs(k * value - 1) for k in nearby) <= 1e-9


def test_shapes_and_nan():
    cam = random_cam(3)
    assert cam.pitch_curve(0.5).shape == cam.profile(0.5).shape == (2,)
    assert cam.pitch_curve(np.zeros((4, 3))).shape == cam.profile(np.zeros((4, 3))).shape == (4, 3, 2)
    for values in (cam.pitch_curve, cam.profile, cam.pressure_angle, cam.pitch_curvature):
        result = values([np.nan, 1.0])
        assert np.isnan(result[0]).all()
        assert np.isfinite(result[1]).all()


# --- what cannot be --------------------------------------------------------------------------------------------------

SWING = Motion([Rise(30 * DEG, 2.0), Return(30 * DEG, FULL_TURN - 2)])


@over_all(
    ("make", "message"),
    [
        (lambda: Cam(SWING, Oscillating(100), 50.0), "centre distance is left open, but must be given for a cam"),
        (lambda: Cam(SWING, Oscillating(100, 160), 60.0), "prime radius is 60.0, but must be between 60 and 260 mm"),
        (lambda: Cam(SWING, Oscillating(160, 100), 50.0), "prime radius is 50.0, but must be between 60 and 260 mm"),
        (lambda: Cam(SWING, Oscillating(100, 120), 220.0), "prime radius is 220.0, but must be between 20 and 220 mm"),
        (lambda: Cam(SWING, Oscillating(100, 120), 215.0), "lift is 30 degrees, but must be less than the 24"),
        (lambda: Cam(SWING, Oscillating(0.0, 120), 50.0), "arm is 0.0"),
        (lambda: Cam(SWING, Oscillating(100, -120), 50.0), "centre distance is -120"),
        (lambda: Cam(SWING, Oscillating(100, math.inf), 50.0), "centre distance is inf"),
        (lambda: Cam(SWING, Oscillating(math.nan, 100), 50.0), "arm is nan"),
        (lambda: Cam(SWING, Oscillating(100, 120, 50.0), 50.0), "roller radius is 50.0, but must be smaller"),
        (lambda: Cam(SWING, Oscillating(100, 120, -1.0), 50.0), "roller radius is -1.0"),
        (lambda: Cam(SWING, Oscillating(100, 120), 50.0, "up"), "rotation is 'up'"),
    ],
)
def test_cams_that_cannot_be_are_refused_with_reason(make, message):
    with pytest.raises(DesignError, match=message):
        make()


def test_an_arm_may_swing_until_it_is_almost_stretched():
    nearly = 180 - math.degrees(angle_between(120, 100, 50)) - 1e-6
    motion = Motion([Rise(nearly * DEG, 3.0), Return(nearly * DEG, FULL_TURN - 3.0)])
    cam = Cam(motion, Oscillating(100, 120), 50.0)
    assert np.linalg.norm(cam.pitch_curve(3.0)) == pytest.approx(220, rel=1e-12)

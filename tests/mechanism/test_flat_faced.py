"""The flat face's cam against its definition at 50 digits: the envelope of the face's lines."""

from __future__ import annotations

import math
import tomllib
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from mpmath import mpf
from numpy.testing import assert_allclose
from over_all import over_all, over_seeds, pairs
from reference import EPS, ReferenceFace, maximum

from graphcam.errors import DesignError
from graphcam.given.follower import FlatFaced
from graphcam.given.laws import LAWS
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.flat_faced import face_width
from graphcam.mechanism.least_radius import minimum_radius

CASES = tomllib.loads((Path(__file__).parents[1] / "data" / "cases.toml").read_text(encoding="utf-8"))
DEG = math.pi / 180


def random_cam(seed: int) -> Cam:
    """All laws come up in turn; rotation, lift, radius and angles are drawn; some radii are too small to be cut."""
    rng = np.random.default_rng(seed)
    rise, back = LAWS[seed % 10], LAWS[(3 * seed + seed // 10) % 10]
    angles = rng.uniform(0.5, 1.5, 4)
    angles *= FULL_TURN / angles.sum()
    h, r0 = float(rng.uniform(5, 60)), float(rng.uniform(20, 120))
    phases = [Rise(h, angles[0], rise), Dwell(angles[1]), Return(h, angles[2], back), Dwell(angles[3])]
    return Cam(Motion(phases), FlatFaced(), r0, "ccw" if rng.random() < 0.5 else "cw")


@over_seeds(5)
def test_random_cams_agree_with_the_differentiated_definition(seed):
    cam, phi = random_cam(seed), np.random.default_rng(seed + 1000).random(8) * FULL_TURN
    exact = ReferenceFace(cam)
    angles = [mpf(float(x)) for x in phi]
    profile = np.array([[float(x) for x in exact.profile(angle)] for angle in angles])
    assert np.abs(cam.profile(phi) - profile).max() <= 1e-14 * np.abs(profile).max()
    rho = np.array([float(exact.radius_of_curvature(angle)) for angle in angles])
    assert_allclose(1 / cam.pitch_curvature(phi), rho, atol=1e-12 * np.abs(rho).max())
    assert np.array_equal(cam.pitch_curve(phi), cam.profile(phi))
    assert np.array_equal(cam.pressure_angle(phi), np.zeros(8))


def test_the_published_digits():
    case = CASES["flat"]
    rest = Dwell(60 * DEG)
    motion = Motion([Rise(case["lift"], case["rise"] * DEG, case["law"]), rest, Return(30, 180 * DEG, case["law"])])
    least = minimum_radius(motion, FlatFaced())
    assert least.prime_radius == pytest.approx(case["cusp_prime_radius"], rel=4 * EPS)
    radius, at = Cam(motion, FlatFaced(), 20.0).extremes().min_convex_radius
    assert math.degrees(at) == pytest.approx(case["at"], rel=1e-14)
    assert radius == pytest.approx(20 - case["cusp_prime_radius"], rel=1e-14)
    for rotation, side in (("ccw", "right"), ("cw", "left")):
        assert getattr(face_width(motion, rotation), side) == pytest.approx(case["face_half_width"], rel=2 * EPS)


# --- what must hold for every cam ------------------------------------------------------------------------------------


@over_seeds(8)
def test_no_point_of_a_sound_profile_lies_beyond_the_face(seed):
    """The support function: in every position of the cam its highest point just touches the face at r0 + s."""
    cam = random_cam(seed)
    least = minimum_radius(cam.motion, FlatFaced(), curvature=1.0).prime_radius
    cam = Cam(cam.motion, FlatFaced(), least, cam.rotation)
    fine = np.linspace(0, FULL_TURN, 4000)
    body = np.concatenate([cam.profile(fine) @ [1, 1j], cam.profile(cam.motion.breaks, "left") @ [1, 1j]])
    for phi in np.linspace(0, FULL_TURN, 40):
        turned, face = body * np.exp(1j * cam.sigma * phi), least + float(cam.motion(phi)[0])
        assert turned.imag.max() <= face * (1 + 4 * EPS)
        assert turned.imag.max() >= face * (1 - 1e-5)


@over_seeds(8)
def test_the_contact_stays_on_the_face_and_reaches_its_edges(seed):
    cam, u = random_cam(seed), np.linspace(0, 1, 2001)
    width = face_width(cam.motion, cam.rotation)
    places = [cam.at(phase, u) for phase in (0, 2)]
    contact = np.concatenate([(p.profile @ [1, 1j] * np.exp(1j * cam.sigma * p.phi)).real for p in places])
    assert contact.max() == pytest.approx(width.right, rel=1e-5)
    assert contact.min() == pytest.approx(-width.left, rel=1e-5)
    assert contact.max() <= width.right * (1 + 1e-13)
    assert contact.min() >= -width.left * (1 + 1e-13)


def test_the_faces_of_several_rises_and_returns():
    motion = Motion(
        [Rise(10, 1.0, "cosine"), Rise(10, 0.5, "cosine"), Return(20, 2.0, "cosine"), Dwell(FULL_TURN - 3.5)]
    )
    ccw, cw = face_width(motion), face_width(motion, "cw")
    assert (ccw.left, ccw.right) == (cw.right, cw.left) == pytest.approx((5 * math.pi, 10 * math.pi), rel=4 * EPS)


def test_a_radius_below_zero_is_told_and_drawn_as_two_cusps():
    """The envelope runs backwards between the places where rho = 0."""
    motion = Motion([Rise(30, 120 * DEG), Dwell(20 * DEG), Return(30, 220 * DEG)])
    cam = Cam(motion, FlatFaced(), 10.0)
    radius, at = cam.extremes().min_convex_radius
    assert -2 < radius < 0
    assert float(cam.pitch_curvature(at)) == pytest.approx(1 / radius)
    phi = np.linspace(60 * DEG, 119 * DEG, 20001)
    rho = 1 / cam.pitch_curvature(phi)
    assert np.count_nonzero(np.diff(np.sign(rho))) == 2
    step = np.diff(cam.profile(phi) @ [1, 1j]) * np.exp(1j * (phi[1:] + phi[:-1]) / 2)
    away_from_cusps = np.abs(rho[1:] + rho[:-1]) > 1e-2
    assert np.array_equal(np.sign(step.real)[away_from_cusps], np.sign(rho[1:])[away_from_cusps])


def test_a_cusp_is_finite_and_its_curvature_infinite():
    motion = Motion([Rise(30, 2.0, "rectangular"), Return(30, FULL_TURN - 2, "rectangular")])
    cam = Cam(motion, FlatFaced(), 15.0)  # just after the middle s = 15 and a = -30
    here = cam.at(0, 0.5, "right")
    assert float(here.curvature) == math.inf
    assert np.isfinite(here.profile).all()
    assert float(cam.at(0, 0.5, "left").curvature) == pytest.approx(1 / 60)


def test_shapes_and_nan():
    cam = random_cam(3)
    assert cam.profile(0.5).shape == (2,)
    assert cam.pressure_angle(0.5).shape == cam.pitch_curvature(0.5).shape == ()
    assert cam.profile(np.zeros((4, 3))).shape == (4, 3, 2)
    for values in (cam.pitch_curve, cam.profile, cam.pressure_angle, cam.pitch_curvature):
        result = values([np.nan, 1.0])
        assert np.isnan(result[0]).all()
        assert np.isfinite(result[1]).all()


def test_extremes_of_a_flat_face():
    cam = random_cam(10)
    extremes = cam.extremes()
    assert extremes.pressure_angle_rise[0] == extremes.pressure_angle_return[0] == 0.0
    u = np.linspace(0, 1, 4001)
    rho = np.concatenate([1 / cam.at(phase, u, side).curvature for phase in range(4) for side in ("left", "right")])
    assert extremes.min_convex_radius[0] == pytest.approx(rho.min(), rel=1e-6)
    assert extremes.min_convex_radius[0] <= rho.min() + 8 * EPS * cam.prime_radius


# --- least radius ----------------------------------------------------------------------------------------------------


@over_all(("name", "curvature"), pairs(LAWS, [0.0, 8.0], 2))
def test_least_radius_against_the_definition(name, curvature):
    """The least of s + a, by differences of the textbook's displacement; at a jump its values on either side."""
    motion = Motion([Rise(30, 1.7, name), Dwell(0.6), Return(30, 1.4, name), Dwell(FULL_TURN - 3.7)])
    least = minimum_radius(motion, FlatFaced(), curvature=curvature)
    exact = ReferenceFace(Cam(motion, FlatFaced(), 1.0))
    step = mpf(10) ** -12

    def missing(phi):
        s = [exact.height(phi + k * step) - 1 for k in (-1, 0, 1)]
        return -s[1] - (s[0] - 2 * s[1] + s[2]) / step**2

    inside = 10 * step
    pieces = [(mpf(float(a)) + inside, mpf(float(b)) - inside) for a, b in pairwise([*motion.breaks, FULL_TURN])]
    wanted = max(max(maximum(missing, a, b), missing(a), missing(b)) for a, b in pieces) + mpf(curvature)
    assert least.prime_radius == pytest.approx(float(wanted), rel=1e-8)  # a jump is seen from 1e-11 beside it
    assert least.active == ("curvature",)
    assert Cam(motion, FlatFaced(), least.prime_radius).extremes().min_convex_radius[0] == pytest.approx(
        curvature, abs=1e-13
    )


def test_a_slow_motion_needs_no_radius():
    """Half a turn up and down by the cosine: s + a is half the lift everywhere."""
    motion = Motion([Rise(30, math.pi, "cosine"), Return(30, math.pi, "cosine")])
    least = minimum_radius(motion, FlatFaced(), curvature=8.0)
    assert (least.prime_radius, least.active) == (0.0, ())
    assert minimum_radius(motion, FlatFaced(), curvature=20.0).prime_radius == pytest.approx(5.0, rel=1e-13)


@over_all("curvature", [-1.0, math.nan, math.inf])
def test_a_curvature_that_cannot_be_is_refused(curvature):
    motion = Motion([Rise(30, 2.0), Return(30, FULL_TURN - 2)])
    with pytest.raises(DesignError, match=r"minimum radius of curvature is .* 0 mm or more"):
        minimum_radius(motion, FlatFaced(), curvature=curvature)

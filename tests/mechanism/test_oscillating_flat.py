"""The cam under an oscillating flat face, against envelopes, statics and differences."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from swinging_faces import TOLERANCE, random_cam, worst_errors

import graphcam as gc
from graphcam.errors import DesignError

DEG = math.pi / 180


def motion_of(swing: float = 12.0, law: str = "3-4-5") -> gc.Motion:
    """A rise of 110 and a return of 100 degrees between dwells."""
    lift = swing * DEG
    return gc.Motion(
        [gc.Rise(lift, 110 * DEG, law), gc.Dwell(50 * DEG), gc.Return(lift, 100 * DEG, law), gc.Dwell(100 * DEG)]
    )


def sound_cam(rotation: str = "ccw", offset: float = 12.0) -> gc.Cam:
    return gc.Cam(motion_of(), gc.OscillatingFlat(180.0, offset), 90.0, rotation)


FOLLOWED = [(rotation, offset) for rotation in ("ccw", "cw") for offset in (12.0, 0.0, -15.0)]


# --- the profile -----------------------------------------------------------------------------------------------------


def test_random_cams_agree_with_the_envelope_at_50_digits():
    assert max(worst_errors(7, 12).values()) <= TOLERANCE


@pytest.mark.slow
def test_more_random_cams_agree_with_the_envelope_at_50_digits():
    assert max(worst_errors(10_000, 60).values()) <= TOLERANCE


@pytest.mark.parametrize(("rotation", "offset"), FOLLOWED)
def test_no_point_of_a_sound_profile_lies_beyond_the_face(rotation, offset):
    cam = sound_cam(rotation, offset)
    assert cam.undercuts() == []
    body = cam.profile(np.linspace(0, 2 * math.pi, 8001)) @ [1, 1j]
    psi0 = math.asin((90 + offset) / 180)
    for phi in np.linspace(0, 2 * math.pi, 25):
        psi = psi0 + float(cam.motion(phi)[0])
        turned = body * np.exp(1j * cam.sigma * phi)
        beyond = (turned * np.conj(1j * np.exp(-1j * psi))).real.max() - (180 * math.sin(psi) - offset)
        assert -1e-4 < beyond < 1e-11


@pytest.mark.parametrize(("rotation", "offset"), FOLLOWED)
def test_the_face_of_the_reach_is_touched_from_end_to_end(rotation, offset):
    cam = sound_cam(rotation, offset)
    reach, u = gc.face_reach(cam.motion, cam.follower, 90.0, rotation), np.linspace(0, 1, 4001)
    touched = np.concatenate([cam.kinematics.contact(cam.motion.at(phase, u)) for phase in range(4)])
    assert (reach.near, reach.far) == pytest.approx((touched.min(), touched.max()), rel=1e-6)
    assert reach.near <= touched.min() * (1 + 1e-14)
    assert reach.far >= touched.max() * (1 - 1e-14)
    assert reach.length == reach.far - reach.near


@pytest.mark.parametrize("seed", range(20))
def test_the_extremes_are_the_least_of_dense_places(seed):
    cam, u = random_cam(seed), np.linspace(0, 1, 2001)
    found = cam.extremes().min_convex_radius[0]
    sides = [(phase, side) for phase in range(4) for side in ("left", "right")]
    rho = np.concatenate([cam.kinematics.convex_radius(cam.motion.at(phase, u, side)) for phase, side in sides])
    assert found <= rho.min() + 1e-12 * abs(rho.min())
    assert found == pytest.approx(rho.min(), rel=1e-4, abs=1e-3)


def test_the_slope_of_the_sharpness_is_its_derivative():
    cam, phi, h = sound_cam(), np.linspace(0.2, 1.7, 7), 1e-5
    kin, motion = cam.kinematics, cam.motion
    apart = (kin.sharpness(motion(phi + h)) - kin.sharpness(motion(phi - h))) / (2 * h)
    value, slope = kin.sharpness_and_slope(motion(phi))
    assert slope == pytest.approx(apart, rel=1e-6)
    assert value == pytest.approx(-1 / cam.pitch_curvature(phi))


# --- the minimum radius ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("rotation", "offset"), FOLLOWED)
@pytest.mark.parametrize("law", ["3-4-5", "cosine", "rectangular"])
def test_the_minimum_radius_is_where_the_sharpest_place_has_the_permitted_radius(rotation, offset, law):
    motion, follower = motion_of(12.0, law), gc.OscillatingFlat(160.0, offset)

    def surplus(radius: float) -> float:
        return gc.Cam(motion, follower, radius, rotation).extremes().min_convex_radius[0] - 9.0

    least = gc.minimum_radius(motion, follower, rotation, curvature=9.0)
    assert least.active == ("curvature",)
    assert least.prime_radius == pytest.approx(brentq(surplus, 5.0, 110.0, xtol=1e-12), rel=1e-9)


def test_without_a_permitted_radius_the_minimum_has_a_cusp():
    motion, follower = motion_of(), gc.OscillatingFlat(140.0)
    cam = gc.Cam(motion, follower, gc.minimum_radius(motion, follower).prime_radius)
    assert cam.extremes().min_convex_radius[0] == pytest.approx(0, abs=1e-9)


def test_a_short_centre_distance_has_no_radius():
    with pytest.raises(DesignError, match="lengthen the centre distance"):
        gc.minimum_radius(motion_of(30.0), gc.OscillatingFlat(60.0), curvature=30.0)


def test_the_minimum_radius_changes_as_its_derivatives_say():
    motion, follower, h = motion_of(), gc.OscillatingFlat(140.0, 12.0), 1e-4

    def radius(distance=140.0, offset=12.0, rho=9.0, swing=12.0):
        return gc.minimum_radius(motion_of(swing), gc.OscillatingFlat(distance, offset), curvature=rho).prime_radius

    found = gc.radius_sensitivity(motion, follower, curvature=9.0)
    apart = {
        "distance": (radius(distance=140 + h) - radius(distance=140 - h)) / (2 * h),
        "face_offset": (radius(offset=12 + h) - radius(offset=12 - h)) / (2 * h),
        "curvature": (radius(rho=9 + h) - radius(rho=9 - h)) / (2 * h),
        "lift": (radius(swing=12 + h) - radius(swing=12 - h)) / (2 * h * DEG),
    }
    assert found == pytest.approx(apart, rel=1e-5)


# --- what is refused -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("distance", "offset", "radius", "swing", "rotation", "message"),
    [
        (80.0, 0.0, 80.0, 10.0, "ccw", "prime radius is 80.0, but must be less than 80 mm"),
        (80.0, 30.0, 55.0, 10.0, "ccw", "less than 50 mm, the centre distance of 80 mm less the face offset of 30 mm"),
        (80.0, -130.0, 50.0, 10.0, "ccw", "face offset is -130.0, but must be more than -130 mm"),
        (80.0, 0.0, 70.0, 35.0, "ccw", "lift is 35 degrees, but must be less than the 28.955 degrees"),
        (200.0, 0.0, 40.0, 65.0, "ccw", "the face turns with the cam"),
        (200.0, 0.0, 40.0, 65.0, "cw", "let the cam turn the other way"),
        (0.0, 0.0, 40.0, 10.0, "ccw", "centre distance is 0.0"),
        (math.nan, 0.0, 40.0, 10.0, "ccw", "centre distance is nan"),
        (90.0, math.inf, 40.0, 10.0, "ccw", "face offset is inf"),
        (90.0, 0.0, 40.0, 15 / DEG, "ccw", "math.radians"),
    ],
)
def test_impossible_sizes_are_refused(distance, offset, radius, swing, rotation, message):
    with pytest.raises(DesignError, match=message):
        gc.Cam(motion_of(swing), gc.OscillatingFlat(distance, offset), radius, rotation)


def test_the_sense_in_which_a_fast_swing_is_possible():
    """A rise turns the face clockwise: beside a cam that turns the other way it may be as fast as it likes."""
    quick, slow = gc.Rise(60 * DEG, 100 * DEG), gc.Return(60 * DEG, 260 * DEG)
    motion = gc.Motion([quick, slow])
    assert gc.Cam(motion, gc.OscillatingFlat(200.0), 40.0, "ccw").extremes()
    with pytest.raises(DesignError, match="angular velocity of the face"):
        gc.Cam(motion, gc.OscillatingFlat(200.0), 40.0, "cw")


# --- forces ----------------------------------------------------------------------------------------------------------

LOAD = gc.ArmLoad(inertia=1500, speed_rpm=200, stiffness=3000, preload=9000)


@pytest.mark.parametrize(("rotation", "offset"), FOLLOWED)
@pytest.mark.parametrize("friction", [0.0, 0.15])
def test_the_forces_balance_about_pivot_and_shaft(rotation, offset, friction):
    cam = sound_cam(rotation, offset)
    phi = np.linspace(0, 6.2, 40)
    found = gc.CamForces(cam, LOAD, friction=friction).at(phi)
    s = cam.motion(phi)[0]
    normal = 1j * np.exp(-1j * (math.asin((90 + offset) / 180) + s))
    touch = (cam.profile(phi) @ [1, 1j]) * np.exp(1j * cam.sigma * phi)
    # The cam drags the face along in its own sense: 1j * sigma * touch, past the face.
    along = normal * (-1j * cam.sigma) * -1
    force = found.normal * (normal + friction * along)
    about_pivot = (np.conj(touch - 180) * force).imag
    assert -about_pivot == pytest.approx(found.load, rel=1e-12)
    about_shaft = (np.conj(touch) * -force).imag
    assert -cam.sigma * about_shaft == pytest.approx(found.torque, rel=1e-9, abs=1e-6)


def test_a_sound_spring_keeps_the_face_on_its_cam():
    quick = gc.ArmLoad(inertia=9000, speed_rpm=500, stiffness=3000)
    least = gc.spring_preload(sound_cam(), quick)
    assert least.preload > 0
    kept = gc.ArmLoad(inertia=9000, speed_rpm=500, stiffness=3000, preload=least.preload)
    assert gc.CamForces(sound_cam(), kept).min_normal().value == pytest.approx(0, abs=1e-6)


def test_loads_of_other_followers_are_refused():
    with pytest.raises(DesignError, match="an ArmLoad, for the follower swings"):
        gc.CamForces(sound_cam(), gc.SpringLoad(0.5, 300, 4))
    with pytest.raises(DesignError, match="no end of an arm"):
        gc.CamForces(sound_cam(), gc.ArmLoad(1500, 200, 3000, 9000, load=20.0))


# --- as it is designed, and as it is made ----------------------------------------------------------------------------


@pytest.mark.parametrize(("rotation", "offset"), FOLLOWED)
def test_sensitivities_are_derivatives(rotation, offset):
    phi, h = np.linspace(0.1, 6.0, 9), 1e-4

    def cam(radius=90.0, distance=180.0, face=offset, stretch=1.0):
        return gc.Cam(motion_of(12.0 * stretch), gc.OscillatingFlat(distance, face), radius, rotation)

    def apart(quantity, **by):
        (name, step), nominal = (
            next(iter(by.items())),
            {"radius": 90.0, "distance": 180.0, "face": offset, "stretch": 1},
        )
        high, low = (quantity(cam(**{name: nominal[name] + sign * step})) for sign in (1, -1))
        return (high - low) / (2 * step)

    found = gc.sensitivities(cam())
    names = {"prime_radius": "radius", "distance": "distance", "face_offset": "face"}
    swing = 12 * DEG
    for by, quantity in (
        (found.pressure_angle(phi), lambda cam: cam.pressure_angle(phi)),
        (found.curvature_radius(phi), lambda cam: 1 / cam.pitch_curvature(phi)),
    ):
        assert by.keys() == {*names, "lift"}
        for name, key in names.items():
            assert by[name] == pytest.approx(apart(quantity, **{key: h}), rel=1e-5, abs=1e-8)
        assert by["lift"] * swing == pytest.approx(apart(quantity, stretch=h), rel=1e-5, abs=1e-6)


@pytest.mark.parametrize(("rotation", "offset"), FOLLOWED)
@pytest.mark.parametrize("name", ["distance", "face_offset"])
def test_a_face_that_is_made_otherwise_moves_as_its_derivatives_say(rotation, offset, name):
    cam, phi, error = sound_cam(rotation, offset), np.linspace(0.05, 6.2, 30), 1e-3
    made = gc.MadeCam(cam, gc.Deviations((), np.zeros(0), {name: error}))(phi)
    by = gc.sensitivities(cam).motion(phi)[name]
    for k, (value, nominal) in enumerate(zip(made, cam.motion(phi), strict=False)):
        assert (value - nominal) / error == pytest.approx(by[k], rel=1e-3, abs=2e-3 * np.abs(by[k]).max())


def test_a_nominal_face_does_the_nominal_motion():
    cam, phi = sound_cam(), np.linspace(0, 6.2, 30)
    made = gc.MadeCam(cam, gc.Deviations((), np.zeros(0), {}))(phi)
    for value, nominal in zip(made, cam.motion(phi), strict=False):
        assert value == pytest.approx(nominal, abs=1e-9)


def test_the_whole_is_shown_as_text():
    assert "oscillating-flat follower, distance 180 mm, face offset 12 mm" in repr(sound_cam())

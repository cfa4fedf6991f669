"""The motion of a cam as it is made: against an independent solution at 40 digits, and against the first order."""

from __future__ import annotations

from math import radians

import mpmath as mp
import numpy as np
import pytest
from over_all import over_all

import graphcam as gc
from graphcam.mechanism.made_cam import lifts_by_error

WAVES = (2, 9), np.array([0.02, 0.004 * np.exp(1j)])
SIZES = {
    "translating": {"roller_radius": 0.05, "offset": 0.08},
    "oscillating": {"roller_radius": 0.05, "distance": 0.08, "arm": -0.06},
    "flat-faced": {},
}
SECOND_ORDER = 0.02
"""How far the fitted order may be off 2."""


def linear_off(cam: gc.Cam, phi: np.ndarray, deviations: gc.Deviations) -> tuple[np.ndarray, ...]:
    """How far (s, v, a) are off to the first order, of the same deviations at cam angles phi [rad]."""
    lifted = lifts_by_error(cam.kinematics, cam.motion(phi))
    delta, slope, bend = deviations.waviness(phi)
    profile = lifted["profile"]
    s = profile.value * delta
    v = profile.slope * delta + profile.value * slope
    a = profile.bend * delta + 2 * profile.slope * slope + profile.value * bend
    for name, off in deviations.sizes.items():
        s, v, a = s + off * lifted[name].value, v + off * lifted[name].slope, a + off * lifted[name].bend
    return s, v, a


def motion(lift: float, rise: str = "3-4-5") -> gc.Motion:
    phases = gc.Rise(lift, radians(100), rise), gc.Dwell(radians(60)), gc.Return(lift, radians(110), "4-5-6-7")
    return gc.Motion([*phases, gc.Dwell(radians(90))])


def cam(kind: str, rotation: str) -> gc.Cam:
    if kind == "translating":
        return gc.Cam(motion(20), gc.Translating(offset=8, roller_radius=10), 40, rotation)
    if kind == "oscillating":
        return gc.Cam(motion(0.3), gc.Oscillating(arm=80, distance=100, roller_radius=10), 45, rotation)
    return gc.Cam(motion(20), gc.FlatFaced(), 45, rotation)


BOTH = [(kind, rotation) for kind in SIZES for rotation in ("ccw", "cw")]


@over_all(("kind", "rotation"), BOTH)
def test_a_cam_without_errors_gives_the_motion_that_it_was_designed_for(kind, rotation):
    designed, phi = cam(kind, rotation), np.linspace(-3.0, 9.0, 200)
    made = gc.MadeCam(designed, gc.Deviations(*WAVES, SIZES[kind]).times(0))(phi)
    for found, exact in zip(made, designed.motion(phi)[:3], strict=True):
        assert found == pytest.approx(exact, abs=1e-13 * max(1, np.abs(exact).max()))


@over_all(("kind", "rotation"), BOTH)
def test_what_the_first_order_leaves_is_of_the_second_order(kind, rotation):
    designed, phi = cam(kind, rotation), np.linspace(0.1, 6.2, 60)
    nominal, off = np.array(designed.motion(phi)[:3]), gc.Deviations(*WAVES, SIZES[kind])
    shares, left = 0.5 ** np.arange(5), []
    for share in shares:
        exact = np.array(gc.MadeCam(designed, off.times(share))(phi)) - nominal
        left.append(np.abs(exact - np.array(linear_off(designed, phi, off.times(share)))).max(axis=1))
    orders = np.polyfit(np.log(shares), np.log(left), 1)[0]
    assert orders == pytest.approx([2.0, 2.0, 2.0], abs=SECOND_ORDER)
    assert (left[0] < 0.02 * np.abs(np.array(linear_off(designed, phi, off))).max(axis=1)).all()


# --- the same at 40 digits, derived anew -----------------------------------------------------------------------------


def rise_345(phi: mp.mpf, lift: mp.mpf, angle: mp.mpf) -> mp.mpf:
    u = phi / angle
    return lift * (10 * u**3 - 15 * u**4 + 6 * u**5)


def nominal_trace(kind: str, phi: mp.mpf, sigma: int) -> mp.mpc:
    """The trace point as seen from the cam, from the pictures of the follower alone."""
    if kind == "translating":
        z = mp.mpc(8, mp.sqrt(mp.mpf(40) ** 2 - 64) + rise_345(phi, mp.mpf(20), mp.mpf(radians(100))))
    else:
        psi0 = mp.acos((mp.mpf(100) ** 2 + mp.mpf(80) ** 2 - mp.mpf(45) ** 2) / (2 * 100 * 80))
        psi = psi0 + rise_345(phi, mp.mpf(0.3), mp.mpf(radians(100)))
        z = 100 - 80 * mp.exp(-1j * psi)
    return z * mp.exp(-1j * sigma * phi)


def wavy_profile(kind: str, theta: mp.mpf, sigma: int) -> mp.mpc:
    """The working profile with its waves; the normal from the derivative of the pitch curve that mpmath takes."""
    p, along = nominal_trace(kind, theta, sigma), mp.diff(lambda x: nominal_trace(kind, x, sigma), theta)
    normal = 1j * sigma * along / abs(along)
    wave = sum(mp.re(mp.mpmathify(complex(w)) * mp.exp(1j * n * theta)) for n, w in zip(*WAVES, strict=True))
    return p + (wave - 10) * normal


def solved_at_forty_digits(kind: str, phi: mp.mpf, sigma: int) -> mp.mpf:
    """s where the distance from the roller's centre to the profile is stationary, and its radius."""
    off = {name: mp.mpf(value) for name, value in SIZES[kind].items()}

    def centre(s: mp.mpf) -> mp.mpc:
        if kind == "translating":
            z = mp.mpc(8 + off["offset"], mp.sqrt(mp.mpf(40) ** 2 - 64) + s)
        else:
            psi0 = mp.acos((mp.mpf(100) ** 2 + mp.mpf(80) ** 2 - mp.mpf(45) ** 2) / (2 * 100 * 80))
            z = 100 + off["distance"] - (80 + off["arm"]) * mp.exp(-1j * (psi0 + s))
        return z * mp.exp(-1j * sigma * phi)

    def contact(theta: mp.mpf, s: mp.mpf) -> list[mp.mpf]:
        apart = centre(s) - wavy_profile(kind, theta, sigma)
        along = mp.diff(lambda x: wavy_profile(kind, x, sigma), theta)
        return [abs(apart) - 10 - off["roller_radius"], mp.re(apart * mp.conj(along))]

    start = float(
        gc.MadeCam(cam(kind, "ccw" if sigma > 0 else "cw"), gc.Deviations(*WAVES, SIZES[kind]))(float(phi))[0]
    )
    return mp.findroot(contact, (phi, mp.mpf(start)), tol=1e-28)[1]


@over_all(("kind", "sigma"), [("translating", +1), ("translating", -1), ("oscillating", +1)])
def test_the_motion_is_that_of_a_roller_that_touches_the_wavy_profile(kind, sigma):
    """Two circles' worth of geometry at 40 digits knows neither pressure angles nor curvatures nor parallel curves."""
    with mp.workdps(40):
        phi, h = mp.mpf("0.9"), mp.mpf("1e-4")
        before, s, after = (solved_at_forty_digits(kind, phi + k * h, sigma) for k in (-1, 0, 1))
        v, a = (after - before) / (2 * h), (after - 2 * s + before) / h**2
    made = gc.MadeCam(cam(kind, "ccw" if sigma > 0 else "cw"), gc.Deviations(*WAVES, SIZES[kind]))
    found = [float(value) for value in made(0.9)]
    assert found[0] == pytest.approx(float(s), rel=1e-14)
    # The differences err by h^2/6 s''' and h^2/12 s'''', with waves of n = 9 in them.
    assert found[1:] == pytest.approx([float(v), float(a)], rel=2e-7)


def test_a_flat_face_lies_on_the_farthest_point_of_the_wavy_profile():
    """The support function, by a dense search that knows no derivatives but the profile's normal."""
    designed, off = cam("flat-faced", "ccw"), gc.Deviations(*WAVES, {})
    phi, theta = np.linspace(0.2, 6.0, 12), np.linspace(0, 2 * np.pi, 400_001)
    profile = designed.profile(theta) @ np.array([1, 1j]) + off.waviness(theta)[0] * np.exp(1j * (np.pi / 2 - theta))
    highest = [float((profile * np.exp(1j * each)).imag.max()) - 45 for each in phi]
    assert gc.MadeCam(designed, off)(phi)[0] == pytest.approx(highest, abs=1e-8)


@over_all(("kind", "rotation"), BOTH)
def test_velocity_and_acceleration_are_the_derivatives(kind, rotation):
    made, phi, h = gc.MadeCam(cam(kind, rotation), gc.Deviations(*WAVES, SIZES[kind])), np.linspace(0.1, 1.6, 30), 1e-4
    (before, v0, _), (_, v, a), (after, v1, _) = (made(phi + k * h) for k in (-1, 0, 1))
    assert (after - before) / (2 * h) == pytest.approx(v, abs=1e-6 * np.abs(v).max())
    assert (v1 - v0) / (2 * h) == pytest.approx(a, abs=1e-6 * np.abs(a).max())


def test_a_roller_that_bridges_a_hollow_is_a_miss():
    """r n^2 A of more than L M, and only there NaN."""
    designed = cam("translating", "ccw")
    shallow, deep = (gc.Deviations((60,), np.array([amplitude]), {}) for amplitude in (0.01, 0.5))
    phi = np.linspace(0, 6.2, 300)
    assert np.isfinite(gc.MadeCam(designed, shallow)(phi)).all()
    assert np.isnan(gc.MadeCam(designed, deep)(phi)[0]).any()


def test_many_cams_are_solved_as_one_by_one():
    designed, errors = cam("translating", "cw"), gc.MakingErrors((0.01,), (7,), roller_diameter=0.05, offset=0.1)
    many, phi = errors.sample(5, seed=3), np.linspace(0, 6, 11)
    s, _, _ = gc.MadeCam(designed, many)(phi)
    assert s.shape == (5, 11)
    for k in range(5):
        sizes = {name: off[k] for name, off in many.sizes.items()}
        one = gc.Deviations(many.harmonics, many.waves[:, k], sizes)
        assert gc.MadeCam(designed, one)(phi)[0] == pytest.approx(s[k], rel=1e-14)

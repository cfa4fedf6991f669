"""Derivatives by the sizes: of pressure angle and curvature at 40 digits, of the least radius against differences."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import mpmath as mp
import numpy as np
import pytest
from over_all import over_all

import graphcam as gc

LAWS = ("3-4-5", "cycloidal"), ("rectangular", "cosine")
STEP = 1e-5
"""Of central differences; these err by its square, and by rounding over it."""


def motion(lift: float, laws: tuple[str, str] = LAWS[0]) -> gc.Motion:
    rise, back = gc.Rise(lift, radians(100), laws[0]), gc.Return(lift, radians(80), laws[1])
    return gc.Motion([rise, gc.Dwell(radians(60)), back, gc.Dwell(radians(120))])


def pitch(sizes: dict[str, mp.mpf], sigma: int, x: mp.mpf) -> tuple[mp.mpc, mp.mpc]:
    """The trace point in the frame and the direction of its motion, as drawn: of a rise by 3-4-5 over 100 degrees."""
    u = x / mp.mpf(radians(100))
    s = sizes["lift"] * (10 * u**3 - 15 * u**4 + 6 * u**5)
    if "offset" in sizes:
        return mp.mpc(sizes["offset"], mp.sqrt(sizes["prime_radius"] ** 2 - sizes["offset"] ** 2) + s), mp.mpc(0, 1)
    c, arm, r0 = sizes["distance"], sizes["arm"], sizes["prime_radius"]
    psi = mp.acos((c**2 + arm**2 - r0**2) / (2 * c * arm)) + s
    return c - arm * mp.exp(-1j * psi), 1j * mp.exp(-1j * psi)


def angle_and_radius(sizes: dict[str, mp.mpf], sigma: int, phi: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
    """alpha between normal and motion, and rho = |p'|^3/(p' x p''), from derivatives that mpmath takes."""

    def p(x: mp.mpf) -> mp.mpc:
        return pitch(sizes, sigma, x)[0] * mp.exp(-1j * sigma * x)

    p1, p2 = mp.diff(p, phi), mp.diff(p, phi, 2)
    normal = 1j * sigma * p1 * mp.exp(1j * sigma * phi)
    motion_ = pitch(sizes, sigma, phi)[1]
    # A stem's alpha is positive where the cam pushes it against its own sense, an arm's in one sense about the arm.
    lean = sigma if "offset" in sizes else 1
    alpha = lean * mp.arg(normal / motion_)
    return alpha, abs(p1) ** 3 / (-sigma * mp.im(mp.conj(p1) * p2))


@over_all("rotation", ["ccw", "cw"])
@over_all("kind", ["translating", "oscillating"])
def test_pressure_angle_and_curvature_at_forty_digits(kind, rotation):
    sigma = 1 if rotation == "ccw" else -1
    if kind == "translating":
        cam = gc.Cam(motion(20), gc.Translating(offset=8, roller_radius=5), 40, rotation)
        sizes = {"prime_radius": 40, "offset": 8, "lift": 20}
    else:
        cam = gc.Cam(motion(0.3), gc.Oscillating(arm=80, distance=100, roller_radius=5), 45, rotation)
        sizes = {"prime_radius": 45, "distance": 100, "arm": 80, "lift": 0.3}
    phi, found = 0.6, gc.sensitivities(cam)
    angles, radii = found.pressure_angle(phi), found.curvature_radius(phi)
    assert set(angles) == set(sizes)
    assert set(radii) == {*sizes, "roller_radius"}
    with mp.workdps(40):
        exact = {name: mp.mpf(value) for name, value in sizes.items()}
        alpha, rho = angle_and_radius(exact, sigma, mp.mpf(phi))
        assert float(alpha) == pytest.approx(float(cam.pressure_angle(phi)), rel=1e-13)
        assert float(1 / rho) == pytest.approx(float(cam.pitch_curvature(phi)), rel=1e-12)
        for name in sizes:
            h = mp.mpf("1e-12")
            low, high = (angle_and_radius(exact | {name: exact[name] + k * h}, sigma, mp.mpf(phi)) for k in (-1, 1))
            by_alpha, by_rho = ((b - a) / (2 * h) for a, b in zip(low, high, strict=True))
            assert float(angles[name]) == pytest.approx(float(by_alpha), rel=1e-12, abs=1e-16)
            assert float(radii[name]) == pytest.approx(float(by_rho), rel=1e-11, abs=1e-14)
    assert float(radii["roller_radius"]) == -1.0


def test_a_flat_face_changes_its_radius_by_the_prime_radius_and_the_lift_alone():
    cam, phi = gc.Cam(motion(20), gc.FlatFaced(), 45), np.linspace(0, 6, 7)
    found = gc.sensitivities(cam)
    s, _, a, _ = cam.motion(phi)
    assert found.curvature_radius(phi)["lift"] == pytest.approx((s + a) / 20)
    assert found.curvature_radius(phi)["prime_radius"].tolist() == [1.0] * 7
    assert not np.any([*found.pressure_angle(phi).values()])


def test_motion_of_a_changed_mechanism_is_that_of_the_made_cam():
    cam, phi, h = gc.Cam(motion(0.3), gc.Oscillating(80, 100, 5), 45), np.linspace(0.1, 1.6, 9), 1e-4
    for name, by in gc.sensitivities(cam).motion(phi).items():
        if name == "profile":
            continue
        low, high = (np.array(gc.MadeCam(cam, gc.Deviations((), np.zeros(0), {name: k * h}))(phi)) for k in (-1, 1))
        assert (high - low) / (2 * h) == pytest.approx(by, rel=1e-5, abs=1e-9)


def radius_cases():
    for laws in LAWS:
        for rotation in ("ccw", "cw"):
            for back in (None, 0.6, 0.2):
                for offset in (None, 3.0, -6.0):
                    yield laws, gc.Translating(), rotation, {"rise": 0.5, "return_": back, "offset": offset}
                yield laws, gc.Oscillating(80), rotation, {"rise": 0.7, "return_": back and back + 0.3}
                yield laws, gc.Oscillating(80, 110), rotation, {"rise": 0.7, "return_": back and back + 0.3}
        yield laws, gc.Translating(), "ccw", {"rise": 0.5, "rest": False}
        yield laws, gc.FlatFaced(), "ccw", {"curvature": 5.0}


@over_all(("laws", "follower", "rotation", "given"), list(radius_cases()))
def test_the_least_radius_changes_as_differences_say(laws, follower, rotation, given):
    lift = 0.3 if isinstance(follower, gc.Oscillating) else 20.0

    def radius(follower=follower, lift=lift, **changed) -> float:
        return gc.minimum_radius(motion(lift, laws), follower, rotation, **{**given, **changed}).prime_radius

    def moved(name: str, by: float) -> float:
        if name == "lift":
            return radius(lift=lift + by)
        if name in ("arm", "distance"):
            return radius(follower=replace(follower, **{name: getattr(follower, name) + by}))
        key = "return_" if name == "return" else name
        return radius(**{key: given[key] + by})

    found = gc.radius_sensitivity(motion(lift, laws), follower, rotation, **given)
    assert set(found) >= {"lift"}
    for name, by in found.items():
        step = STEP / 20 if name in ("lift", "rise", "return") else STEP
        difference = (moved(name, step) - moved(name, -step)) / (2 * step)
        assert by == pytest.approx(difference, rel=1e-6, abs=1e-6), name


def test_a_radius_that_nothing_holds_has_no_derivatives():
    with pytest.raises(gc.DesignError, match="minimum prime radius is 30 mm, but must be held by a limit"):
        gc.radius_sensitivity(motion(0.3), gc.Oscillating(80, 110), "ccw", rise=0.7, rest=False)


def test_a_permitted_angle_that_does_not_hold_the_radius_does_not_change_it():
    """One degree more on the return changes nothing where the rise and the rest line hold."""
    found = gc.radius_sensitivity(motion(20), gc.Translating(), "ccw", rise=0.5, return_=1.2)
    assert found["return"] == 0.0
    assert found["rise"] < 0

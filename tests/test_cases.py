"""Published problems and computed cases, one test each; givens, answers and sources stand in data/cases.toml."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest

from graphcam.given.follower import Translating
from graphcam.given.motion import Dwell, Motion, Return, Rise
from graphcam.given.roller_rule import roller_rule
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import minimum_radius

CASES = tomllib.loads(Path(__file__).with_name("data").joinpath("cases.toml").read_text(encoding="utf-8"))
DEG = math.pi / 180
ALL_DIGITS = 1e-14
"""of a computed value"""


def printed(digits: int) -> float:
    """Half of the last printed digit."""
    return 0.5 * 10.0**-digits


def motion_of(lift: float, phases: list[float], laws: list[str]) -> Motion:
    rise, dwell, back, rest = (angle * DEG for angle in phases)
    return Motion([Rise(lift, rise, laws[0]), Dwell(dwell), Return(lift, back, laws[1]), Dwell(rest)])


def test_pressure_angle_at_the_low_rest():
    case = CASES["rest_pressure_angle"]
    motion = motion_of(12, [120, 60, 120, 60], ["cosine", "cosine"])
    cam = Cam(motion, Translating(case["offset"], case["roller_radius"]), case["prime_radius"], "cw")
    at_rest = math.degrees(cam.pressure_angle(0.0))
    assert at_rest == pytest.approx(case["angle"], rel=ALL_DIGITS)
    assert at_rest == pytest.approx(case["printed"], abs=printed(2))


@pytest.mark.parametrize("name", ["valve", "knife"])
def test_greatest_velocities_and_accelerations_of_solved_problems(name):
    case = CASES[name]
    motion, omega = motion_of(case["lift"], case["phases"], case["law"]), case["speed_rpm"] * math.tau / 60
    for phase, velocity, acceleration in zip((0, 2), case["velocity_m_s"], case["acceleration_m_s2"], strict=True):
        _, v, a, _ = (np.abs(x).max() for x in motion.at(phase, np.linspace(0, 1, 1001)))
        velocity_digits, acceleration_digits = (2, 2) if name == "valve" else (3, 1)
        assert v * omega / 1000 == pytest.approx(velocity, abs=printed(velocity_digits))
        assert a * omega**2 / 1000 == pytest.approx(acceleration, abs=printed(acceleration_digits))


def test_offset_roller_follower_of_a_lecture():
    case = CASES["offset_roller"]
    motion = motion_of(case["lift"], case["phases"], case["law"])
    follower = Translating(case["offset"], case["roller_radius"])
    extremes = Cam(motion, follower, case["prime_radius"], "ccw").extremes()
    for found, (angle, at), digits in (
        (extremes.pressure_angle_rise, case["rise"], 1),
        (extremes.pressure_angle_return, case["return"], 0),
    ):
        assert math.degrees(found[0]) == pytest.approx(angle, abs=printed(2))
        assert math.degrees(found[1]) == pytest.approx(at, abs=printed(digits))
    wrong_side = Cam(motion, follower, case["prime_radius"], "cw").extremes()
    assert math.degrees(wrong_side.pressure_angle_rise[0]) == pytest.approx(case["wrong_side_rise"], abs=printed(2))


@pytest.mark.parametrize("name", ["rectangular", "cosine", "cycloidal", "3-4-5"])
def test_least_radius_of_the_coursework(name):
    case = CASES["coursework_radius"]
    motion = motion_of(case["lift"], case["phases"], [name, name])
    for rotation, offset in (("cw", -case["offset"]), ("ccw", case["offset"])):
        force = minimum_radius(motion, Translating(), rotation, offset=offset)
        form = minimum_radius(motion, Translating(), rotation, offset=offset, return_=30 * DEG)
        assert force.prime_radius == pytest.approx(case["force_closed"][name], abs=printed(2))
        assert form.prime_radius == pytest.approx(case["form_closed_30"][name], abs=printed(2))


def test_roller_radii_of_the_coursework():
    case = CASES["rollers"]
    terms = roller_rule("min(0.4 r0, 0.65 rho)")
    radii = [term(rho=case["least_curvature_radius"], r0=case["prime_radius"]) for term in terms]
    assert radii == pytest.approx([case["by_prime_radius"], case["by_curvature"]], abs=printed(2))


def test_extremes_to_all_digits():
    case = CASES["extremes"]
    motion = motion_of(case["lift"], [case["rise"], 60, 120, 60], ["3-4-5", "3-4-5"])
    extremes = Cam(motion, Translating(case["offset"]), case["prime_radius"], "ccw").extremes()
    angle, at = extremes.pressure_angle_rise
    assert [math.degrees(angle), math.degrees(at)] == pytest.approx(case["pressure_angle"], rel=ALL_DIGITS)
    motion = Motion([Rise(case["lift"], case["rise"] * DEG), Return(case["lift"], 240 * DEG)])
    radius, at = Cam(motion, Translating(case["offset"]), case["prime_radius"], "ccw").extremes().min_convex_radius
    exact, place = case["convex_radius"]
    assert radius == pytest.approx(exact, rel=ALL_DIGITS)
    # The place is a zero of the slope, which is known to fewer digits than the value.
    assert math.degrees(at) == pytest.approx(place, rel=10 * ALL_DIGITS)


@pytest.mark.parametrize("name", ["3-4-5", "rectangular"])
def test_least_radius_for_two_limits_to_all_digits(name):
    case = CASES["least_radius"]
    motion = motion_of(case["lift"], [case["rise"], 60, case["return"], 90], [name, name])
    limits = {"rise": case["limits"][0] * DEG, "return_": case["limits"][1] * DEG}
    least = minimum_radius(motion, Translating(), **limits)
    assert least.prime_radius == pytest.approx(case[name]["prime_radius"], rel=ALL_DIGITS)
    assert least.offset == pytest.approx(case[name]["offset"], rel=5 * ALL_DIGITS)  # a difference of larger numbers
    if "central" in case[name]:
        central = minimum_radius(motion, Translating(), offset=0, **limits)
        assert central.prime_radius == pytest.approx(case[name]["central"], rel=ALL_DIGITS)


def test_the_apex_of_the_region_is_not_always_its_nearest_point():
    case = CASES["apex_is_not_least"]
    rise, back = (angle * DEG for angle in case["phases"])
    motion = Motion([Rise(case["lift"], rise, case["law"]), Return(case["lift"], back, case["law"]), Dwell(60 * DEG)])
    limits = {"rise": case["limits"][0] * DEG, "return_": case["limits"][1] * DEG}
    least = minimum_radius(motion, Translating(), **limits)
    assert least.prime_radius == pytest.approx(case["with_rest"], rel=ALL_DIGITS)
    assert least.offset == pytest.approx(case["offset_with_rest"], rel=ALL_DIGITS)
    without_rest = minimum_radius(motion, Translating(), rest=False, **limits)
    assert without_rest.prime_radius == pytest.approx(case["without_rest"], rel=ALL_DIGITS)


def test_undercut_to_all_digits():
    case = CASES["undercut"]
    motion = motion_of(case["lift"], case["phases"], [case["law"]] * 2)
    cam = Cam(motion, Translating(case["offset"], case["roller_radius"]), case["prime_radius"], "ccw")
    for loop, cusps, (phi1, phi2, x, y) in zip(cam.undercuts(), case["cusps"], case["crossings"], strict=True):
        assert np.degrees(loop.cusps) == pytest.approx(cusps, abs=1e-12)
        assert np.degrees(loop.crossing[:2]) == pytest.approx([phi1, phi2], abs=1e-12)
        assert loop.crossing[2:] == pytest.approx((x, y), abs=1e-13)

"""The exact side of the built-in task, from formulas written out here."""

from __future__ import annotations

from math import atan, degrees, hypot, radians, sqrt, tan

import pytest

from graphcam.solving.solve import solve
from graphcam.tasks.task_file import builtin_task

LIFT, RISE, RETURN, OFFSET, PRIME_RADIUS = 30.0, radians(80), radians(60), 10.0, 44.0
ALL_DIGITS = 1e-13
S0 = sqrt(PRIME_RADIUS**2 - OFFSET**2)
FASTEST = {"rise": 2 * LIFT / RISE, "return": -2 * LIFT / RETURN}
STRONGEST = 4 * LIFT / RETURN**2


def least_radius() -> float:
    """The rise's tangent touches where the acceleration jumps, at half the lift."""
    s0 = (FASTEST["rise"] - OFFSET) / tan(radians(30)) - LIFT / 2
    return hypot(s0, OFFSET)


def pressure_angle(phase: str) -> float:
    """At half the lift, with the offset on the favourable side."""
    return degrees(atan((FASTEST[phase] - OFFSET) / (S0 + LIFT / 2)))


def radius_of_curvature() -> float:
    """At the start of the return, where v = 0: rho = R^3/(R^2 - a y) with a = -4h/F^2 and y the height of B."""
    height = S0 + LIFT
    radius = hypot(height, OFFSET)
    return radius**3 / (radius**2 + STRONGEST * height)


EXPECTED = {
    "max_v": 2 * LIFT / RETURN,
    "max_a": STRONGEST,
    "minimum_prime_radius": least_radius(),
    "minimum_offset": -OFFSET,
    "max_pressure_angle_rise_deg": pressure_angle("rise"),
    "max_pressure_angle_return_deg": pressure_angle("return"),
    "min_pitch_curvature_radius": radius_of_curvature(),
    "roller_radius": 0.4 * PRIME_RADIUS,
}
"""For a clockwise cam with r0 = 44 mm and the follower 10 mm to the left."""


@pytest.fixture(scope="module")
def quantities():
    return solve(builtin_task()).comparison.quantities


@pytest.mark.parametrize("name", EXPECTED)
def test_exact_value(quantities, name):
    assert quantities[name].exact == pytest.approx(EXPECTED[name], rel=ALL_DIGITS)


@pytest.mark.parametrize("name", sorted(EXPECTED.keys() - {"min_pitch_curvature_radius"}))
def test_constant_acceleration_is_drawn_exactly(quantities, name):
    """Parabolas are drawn exactly by chords, whatever the number of parts."""
    assert quantities[name].drawn == pytest.approx(EXPECTED[name], rel=1e-12)


def test_published_least_radius(quantities):
    """Assignment of the built-in task: 43.28 mm under force closure."""
    assert quantities["minimum_prime_radius"].exact == pytest.approx(43.28, abs=0.005)

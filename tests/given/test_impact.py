"""The kind of impact that each law is known for."""

from __future__ import annotations

from math import pi

import pytest
from over_all import over_all

from graphcam.given.impact import acceleration_jumps, velocity_jumps
from graphcam.given.laws import DWELL_TO_DWELL_LAWS, RISE_FALL_LAWS, law
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise

SOFT = {"rectangular", "cosine", "2-3"}
"""Between dwells; the others begin and end without acceleration.  Source: any textbook's table of laws."""

ENDS = [0.0, 1.4, 2.2, 3.3]


def motion_of(name: str) -> Motion:
    return Motion([Rise(30, 1.4, name), Dwell(0.8), Return(30, 1.1, name), Dwell(FULL_TURN - 3.3)])


@over_all("name", DWELL_TO_DWELL_LAWS)
def test_kind_of_impact_between_dwells(name):
    motion = motion_of(name)
    assert velocity_jumps(motion) == []
    jumps = acceleration_jumps(motion)
    assert bool(jumps) == (name in SOFT)
    if jumps:
        places = ENDS + ([0.7, 2.75] if name == "rectangular" else [])
        assert [jump.phi for jump in jumps] == pytest.approx(sorted(places))
        # At the ends of the phases it jumps from the dwell's nothing to the law's first value, and from its last.
        first, last = (float(law(name)(u)[2]) for u in (0.0, 1.0))
        at_ends = [(jump.before, jump.after) for jump in jumps if min(abs(jump.phi - phi) for phi in ENDS) < 1e-9]
        rise, back = 30 / 1.4**2, -30 / 1.1**2
        expected = [(0, rise * first), (rise * last, 0), (0, back * first), (back * last, 0)]
        assert at_ends == [pytest.approx(pair, abs=1e-9) for pair in expected]


@over_all("ratio", [1e-12, 1e-9, 1e-6, 1e6, 1e12])
def test_unequal_parts_of_a_rectangular_law_meet_without_a_rigid_impact(ratio):
    rise, back = Rise(30, 1.4, "rectangular", ratio), Return(30, FULL_TURN - 3.4, "rectangular", ratio)
    motion = Motion([Dwell(2.0), rise, back])
    assert velocity_jumps(motion) == []
    assert len(acceleration_jumps(motion)) == 5


def test_harmonic_rise_and_return_without_dwells_have_no_impact():
    """The eccentric: equal phases of the cosine law make one harmonic over the whole turn."""
    assert acceleration_jumps(Motion([Rise(30, pi, "cosine"), Return(30, pi, "cosine")])) == []


def test_unequal_harmonic_phases_meet_in_a_jump():
    jumps = acceleration_jumps(Motion([Rise(30, 2.0, "cosine"), Return(30, FULL_TURN - 2.0, "cosine")]))
    rise, back = 15 * pi**2 / 4, 15 * pi**2 / (FULL_TURN - 2) ** 2
    assert [(jump.before, jump.after) for jump in jumps] == [
        pytest.approx((back, rise)),
        pytest.approx((-rise, -back)),
    ]


@over_all("name", RISE_FALL_LAWS)
def test_a_rise_and_a_fall_without_a_dwell_between_are_free_of_impact(name):
    """Equal angles: what the rise's acceleration ends with, the fall's begins with."""
    motion = Motion([Rise(30, 1.4, name), Return(30, 1.4, name), Dwell(FULL_TURN - 2.8)])
    assert velocity_jumps(motion) == acceleration_jumps(motion) == []
    assert motion(1.4)[2] == pytest.approx(30 / 1.4**2 * float(law(name)(1.0)[2]), rel=1e-14)
    (jump,) = acceleration_jumps(Motion([Rise(30, 1.4, name), Return(30, 1.1, name), Dwell(FULL_TURN - 2.5)]))
    assert jump.phi == 1.4

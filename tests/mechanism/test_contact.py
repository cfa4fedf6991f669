"""Springs and contact: the published case, 50-digit definitions, and what no dense sampling may beat."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import diff, mp, mpf
from over_all import over_all, over_seeds
from reference import EPS, displacement
from test_translating import random_cam

import graphcam as gc
from graphcam.given.spring_load import SpringLoad
from graphcam.mechanism.contact import Contact

DEG = math.pi / 180
FULL_TURN = math.tau


def coursework(law: str = "cosine") -> gc.Motion:
    """Of the published case: 30 mm up in 45 degrees, rest 45, down in 45, rest 225."""
    return gc.Motion(
        [gc.Rise(30, 45 * DEG, law), gc.Dwell(45 * DEG), gc.Return(30, 45 * DEG, law), gc.Dwell(225 * DEG)]
    )


def test_the_published_preload():
    """Voloder, Cohodar, Karic 2007; with omega rounded to 57.5958 rad/s 69.22926 N, printed cut: 69.2292."""
    preload, phi = gc.spring_preload(coursework(), mass=0.2, speed_rpm=550, stiffness=3)
    assert preload == pytest.approx(69.229617670908319, rel=1e-14)
    assert phi == 45 * DEG
    rounded_rpm = 57.5958 * 30 / math.pi
    assert gc.spring_preload(coursework(), 0.2, rounded_rpm, 3).preload == pytest.approx(69.2292, abs=1e-4)


def test_the_preload_is_needed_before_one_jump_and_after_the_next():
    """At the end of the rise just before the dwell, and again at the start of the return: one-sided limits."""
    contact = Contact(coursework(), SpringLoad(0.2, 550, 3))
    least = contact.min_force()
    assert (least.phi, least.side) == (45 * DEG, "left")
    for phi, side in ((45 * DEG, "left"), (90 * DEG, "right")):
        assert float(contact.load.force(contact.motion(phi, side))) == pytest.approx(least.value, rel=1e-13)
    for phi, side in ((45 * DEG, "right"), (90 * DEG, "left")):
        assert float(contact.load.force(contact.motion(phi, side))) == 90.0


def exact_force(motion: gc.Motion, load: SpringLoad, phi):
    """By its definition from the textbook displacement, with the mechanical units of mass, length and time."""
    phi, metre, omega = mpf(phi), mpf(1000), mpf(load.speed_rpm) * 2 * mp.pi / 60
    s, v, a = (diff(lambda x: displacement(motion, x), phi, n) / metre for n in range(3))
    second_derivative_by_time = a * omega**2 + v * mpf(load.acceleration)
    return mpf(load.mass) * second_derivative_by_time + mpf(load.preload) + mpf(load.stiffness) * metre * s


@over_seeds(5)
def test_no_place_needs_more_than_the_least_preload(seed):
    """Ten thousand places and both sides of all breaks; and the extreme is reached where it is said to be."""
    motion, rng = random_cam(seed).motion, np.random.default_rng(seed)
    mass, rpm, stiffness = 10 ** rng.uniform(-1.5, 1), rng.uniform(50, 900), 10 ** rng.uniform(-1, 1.5)
    load = SpringLoad(mass, rpm, stiffness, acceleration=float(rng.choice([0.0, 400.0, -900.0])))
    contact = Contact(motion, load)
    least, greatest = contact.min_force(), contact.max_force()
    phi = np.linspace(0, FULL_TURN, 10001)
    sampled = np.concatenate([load.force(motion(np.append(phi, motion.breaks), side)) for side in ("left", "right")])
    slack = 200 * EPS * load.size(motion(phi)).max()
    assert least.value <= sampled.min() + slack
    assert greatest.value >= sampled.max() - slack
    assert least.value == pytest.approx(sampled.min(), rel=1e-3, abs=1e-3 * abs(sampled).max())
    for found in (least, greatest):
        inwards = {"left": -1, "right": 1}[found.side] * mpf(10) ** -15
        there = exact_force(motion, load, (mpf(found.phi) + inwards) % (2 * mp.pi))
        assert float(there) == pytest.approx(found.value, abs=1e-10 * load.size(motion(phi)).max())


def test_varying_speed_adds_the_velocity_times_the_angular_acceleration():
    """A term m v eps; a cam that speeds up needs on the return what one that slows down needs on the mirrored rise."""
    motion = coursework()
    steady, faster, slower = (gc.spring_preload(motion, 0.2, 550, 3, x) for x in (0.0, 5000.0, -5000.0))
    assert steady.preload < slower.preload == pytest.approx(faster.preload, rel=1e-12)
    assert 22.5 * DEG < slower.phi < 45 * DEG < 90 * DEG < faster.phi < 112.5 * DEG
    load = SpringLoad(0.2, 550, 3, acceleration=100.0)
    difference = load.force(motion(0.5)) - SpringLoad(0.2, 550, 3).force(motion(0.5))
    assert float(difference) == pytest.approx(0.2 * 100.0 * float(motion(0.5)[1]) / 1000, rel=1e-12)


def test_contact_is_lost_between_the_roots_of_the_contact_function():
    contact = Contact(coursework("3-4-5"), SpringLoad(0.2, 550, 3, preload=20))
    lost = contact.lost()
    assert len(lost) == 2
    for phi in np.ravel(lost):
        assert float(exact_force(contact.motion, contact.load, phi)) == pytest.approx(0, abs=1e-10)
    phi = np.linspace(0, FULL_TURN, 20001)
    negative = contact.load.force(contact.motion(phi)) < 0
    inside = np.any([(start < phi) & (phi < end) for start, end in lost], axis=0)
    assert np.array_equal(negative, inside)


def test_contact_is_kept_by_the_least_preload_and_lost_below_it():
    motion = coursework()
    preload = gc.spring_preload(motion, 0.2, 550, 3).preload
    assert Contact(motion, SpringLoad(0.2, 550, 3, preload)).lost() == []
    assert len(Contact(motion, SpringLoad(0.2, 550, 3, preload * (1 - 1e-9))).lost()) == 2
    whole = Contact(motion, SpringLoad(0.2, 550, 3, -1000)).lost()
    assert whole == [pytest.approx((0, FULL_TURN))]


def test_a_loss_over_the_end_of_the_turn_is_one_interval():
    """A motion that begins in the middle of its upper rest: contact is lost on either side of the count's beginning."""
    motion = gc.Motion([gc.Return(30, 1, "cosine"), gc.Dwell(FULL_TURN - 2), gc.Rise(30, 1, "cosine")])
    (interval,) = Contact(motion, SpringLoad(0.2, 550, 3, preload=0)).lost()
    start, end = interval
    assert FULL_TURN - 1 < start < FULL_TURN < end < FULL_TURN + 1
    assert end - FULL_TURN == pytest.approx(FULL_TURN - start, rel=1e-12)  # the motion is its own mirror image


def test_a_law_that_jumps_inside_loses_contact_from_the_jump_on():
    contact = Contact(coursework("rectangular"), SpringLoad(0.2, 550, 3, preload=0))
    (start, end), *_ = contact.lost()
    assert start == pytest.approx(22.5 * DEG, rel=1e-14)
    assert start < end <= 45 * DEG


def test_friction_loads_the_cam_on_a_rise_and_relieves_it_on_a_return():
    motion = coursework()
    without, with_friction = (Contact(motion, SpringLoad(0.2, 550, 3, friction=f)) for f in (0.0, 5.0))
    assert with_friction.max_force().value == pytest.approx(without.max_force().value + 5, rel=1e-13)
    least = with_friction.min_force()
    assert least.value == pytest.approx(without.min_force().value - 5, rel=1e-13)
    assert (least.phi, least.side) == (90 * DEG, "right")


def test_the_curve_holds_both_sides_of_every_jump():
    contact = Contact(coursework("rectangular"), SpringLoad(0.2, 550, 3))
    curve = contact.curve(parts=10)
    assert np.all(np.diff(curve.phi) >= 0)
    assert curve.phi[[0, -1]] == pytest.approx([0, FULL_TURN])
    twice = curve.phi[1:][np.diff(curve.phi) <= 4 * EPS * FULL_TURN]
    assert twice == pytest.approx(contact.motion.breaks[1:])
    assert curve.force.min() == pytest.approx(contact.min_force().value, rel=1e-12)


@over_all(
    ("change", "message"),
    [
        ({"mass": -1.0}, "mass is -1.0, but must be a finite number of 0 kg or more"),
        ({"stiffness": math.nan}, "stiffness is nan"),
        ({"speed_rpm": -550.0}, "speed_rpm is -550.0"),
        ({"acceleration": math.inf}, "acceleration is inf"),
    ],
)
def test_loads_that_cannot_be_are_refused_with_reason(change, message):
    given = {"mass": 0.2, "speed_rpm": 550.0, "stiffness": 3.0} | change
    with pytest.raises(gc.DesignError, match=message):
        gc.spring_preload(coursework(), **given)

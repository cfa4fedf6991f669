"""An extreme that lies between the samples of any grid is found by all who look for one; of equal ones the first."""

from __future__ import annotations

import math

import numpy as np
import pytest
from over_all import over_all
from test_proved_extremes import waving_law

import graphcam as gc
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.mechanism.turn_extremes import max_acceleration, max_jerk, max_velocity, places_in, turn_maximum

FINE = 40_001
LOAD = gc.SpringLoad(mass=0.2, speed_rpm=60, stiffness=4, preload=300)


def waving_motion() -> Motion:
    """A motion with 60 waves on its rise and on its return."""
    law, _ = waving_law(60, 2e-6)
    return Motion([Rise(20, 2.0, law), Dwell(0.5), Return(20, 1.5, law), Dwell(FULL_TURN - 4.0)])


def motion_by_conditions() -> Motion:
    """A polynomial through a point on its way up, and one down."""
    up = [gc.MotionPoint(0, s=0, v=0, a=0), gc.MotionPoint(1.0, s=9), gc.MotionPoint(2.0, s=20, v=0, a=0)]
    down = [gc.MotionPoint(2.5, s=20, v=0, a=0), gc.MotionPoint(4.5, s=0, v=0, a=0)]
    return gc.boundary_motion([gc.PolynomialPart(up), gc.PolynomialPart(down)])


def motion_with_jumps() -> Motion:
    """Accelerations that jump inside of both phases and at their ends."""
    back = Return(20, FULL_TURN - 3.0, "rectangular")
    return Motion([Rise(20, 2.0, "rectangular", 3.0), Dwell(1.0), back])


MAKERS = {
    "waving": waving_motion,
    "measured": lambda: gc.builtin_task("measured").motion(),
    "by conditions": motion_by_conditions,
    "rectangular": motion_with_jumps,
}


def quantities(motion: Motion):
    """What is told of a cam with that motion, and the quantity of places that it must be the greatest of."""
    cam = gc.Cam(motion, gc.Translating(4.0, 5.0), 60.0)
    rubbing = gc.CamForces(cam, LOAD, friction=0.2)
    kin, forces = cam.kinematics, gc.CamForces(cam, LOAD, friction=0.05)
    guided = gc.CamForces(cam, LOAD, gc.Guide(friction=0.1, overhang=70, length=80), friction=0.05)
    stress, contact = gc.ContactStress(forces, gc.RollerContact(width=15)), gc.Contact(motion, LOAD)
    extremes, preload = cam.extremes(), gc.spring_preload(cam, LOAD).preload
    steepest = max(abs(extremes.pressure_angle_rise[0]), abs(extremes.pressure_angle_return[0]))
    flat = gc.minimum_radius(motion, gc.FlatFaced(), curvature=8.0).prime_radius
    yield "pressure angle", steepest, lambda at: np.abs(np.arctan(kin.steepness(at.values)))
    yield "curvature", 1 / extremes.min_convex_radius[0], lambda at: kin.curvature(at.values)
    yield "largest roller", 1 / gc.largest_roller(cam), lambda at: np.maximum(kin.curvature(at.values), 1 / 60)
    yield "normal force", forces.max_normal().value, forces.normal
    yield "least normal force", -forces.min_normal().value, lambda at: -forces.normal(at)
    yield "torque", forces.max_torque().value, forces.torque
    yield "normal force in a guide", guided.max_normal().value, guided.normal
    yield (
        "jamming",
        -gc.jamming_margin(cam, 0.2).value,
        lambda at: -rubbing.of(at).transmission,
    )
    yield "stress", stress.max_pressure().value, lambda at: stress.of(at).peak_pressure
    yield "contact", contact.max_force().value, contact.force
    yield "preload", preload, lambda at: LOAD.preload - contact.force(at)
    yield "flat face", flat, lambda at: 8 - at.values[0] - at.values[2]
    yield "velocity", max_velocity(motion), lambda at: np.abs(at.values[1])
    yield "acceleration", max_acceleration(motion), lambda at: np.abs(at.values[2])
    yield "jerk", max_jerk(motion), lambda at: np.abs(at.values[3])


@over_all("maker", MAKERS)
def test_no_sample_exceeds_what_is_told(maker):
    motion = MAKERS[maker]()
    phase, u = np.arange(len(motion.phases))[:, None], np.linspace(0, 1, FINE)
    sides = [places_in(motion, phase, u, side) for side in ("left", "right")]
    failures: list[str] = []
    for name, told, quantity in quantities(motion):
        sampled = max(float(np.nanmax(quantity(places))) for places in sides)
        # Samples come near: they are off by the square of their distance, that of waves 60 times as short included.
        if not sampled * (1 - math.copysign(1e-12, sampled)) <= told <= sampled + 1e-4 * abs(sampled):
            failures.append(f"{name}: told {told!r}, sampled {sampled!r}")
    assert not failures, "\n".join(failures)


def test_a_maximum_between_the_samples_of_a_usual_grid_is_told():
    """The greatest of 97 samples a phase is visibly less than what is told: this test can fail."""
    motion = waving_motion()
    coarse = places_in(motion, np.arange(4)[:, None], np.linspace(0, 1, 97))
    told = turn_maximum(motion, lambda places: places.values[2])
    assert told.value > 1.001 * coarse.values[2].max()


def test_at_a_jump_the_side_is_told():
    motion = Motion([Rise(20, math.pi, "rectangular"), Return(20, math.pi, "rectangular")])
    most = turn_maximum(motion, lambda places: places.values[2])
    least = turn_maximum(motion, lambda places: -places.values[2])
    assert (most.phi, most.side) == (0.0, "right")
    assert (least.phi, least.side) == (pytest.approx(math.pi / 2, abs=1e-15), "right")
    rate = turn_maximum(motion, lambda places: places.values[0] + places.values[2])
    assert (rate.phi, rate.side) == (pytest.approx(math.pi / 2, abs=1e-15), "left")


@over_all("name", ["cycloidal", "3-4-5", "modified-sine", "cosine", "2-3"])
def test_of_equal_maxima_the_first_is_told(name):
    """Two lifts a turn, the same twice over."""
    half = [Rise(20, 1.0, name), Dwell(0.5), Return(20, 1.0, name), Dwell(math.pi - 2.5)]
    cam = gc.Cam(Motion([*half, *half]), gc.Translating(0.0, 5.0), 40.0)
    forces, extremes = gc.CamForces(cam, LOAD, friction=0.05), cam.extremes()
    for phi in (
        extremes.pressure_angle_rise[1], extremes.pressure_angle_return[1], extremes.min_convex_radius_moving[1],
        forces.max_normal().phi, forces.max_torque().phi, gc.jamming_margin(cam, 0.1).phi,
        gc.Contact(cam.motion, LOAD).min_force().phi,
    ):  # fmt: skip
        assert phi < math.pi - 1e-9

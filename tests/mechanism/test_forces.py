"""Forces on a follower in its guide: against the equations of equilibrium, solved as they stand."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from over_all import over_all, over_seeds
from test_translating import random_cam

import graphcam as gc
from graphcam.mechanism.forces import grip, jamming_angle

DEG = math.pi / 180


def steady_cam(seed: int) -> gc.Cam:
    """A random cam whose pressure angles a guide can bear: four times as large."""
    cam = random_cam(seed)
    return gc.Cam(cam.motion, gc.Translating(cam.follower.offset, 5.0), 4 * cam.prime_radius, cam.rotation)


def load(seed: int) -> gc.SpringLoad:
    rng = np.random.default_rng(seed + 50)
    return gc.SpringLoad(rng.uniform(0.1, 1), rng.uniform(50, 300), rng.uniform(1, 20), preload=rng.uniform(50, 300))


GUIDE = gc.Guide(friction=0.12, overhang=70.0, length=90.0)


@over_seeds(4)
def test_the_follower_is_in_equilibrium(seed):
    """Forces across and along the motion and moments about the roller's centre, each bearing with its own friction."""
    cam, spring = steady_cam(seed), load(seed)
    forces = gc.CamForces(cam, spring, GUIDE)
    for k, phase in enumerate(cam.motion.phases):
        if not phase.direction:
            continue
        u = np.linspace(0.05, 0.95, 7)
        found, values = forces.at(k, u), cam.motion.at(k, u)
        alpha, q = cam.at(k, u).pressure_angle, spring.force(values)
        for i in range(u.size):
            b = GUIDE.overhang - values[0][i]
            sign = math.copysign(1, alpha[i])  # the bearing reactions press on one side or the other
            friction = phase.direction * GUIDE.friction * sign
            matrix = [
                [math.sin(alpha[i]), -1, 1],
                [math.cos(alpha[i]), -friction, -friction],
                [0, b, -(b + GUIDE.length)],
            ]
            normal, near, far = np.linalg.solve(matrix, [0, q[i], 0])
            assert found.normal[i] == pytest.approx(normal, rel=1e-12)
            assert found.near[i] == pytest.approx(near, rel=1e-10, abs=1e-10 * normal)
            assert found.far[i] == pytest.approx(far, rel=1e-10, abs=1e-10 * normal)
            assert found.friction[i] == pytest.approx(GUIDE.friction * (abs(near) + abs(far)), rel=1e-10, abs=1e-9)


@over_all("side", ["left", "right"])
def test_forces_are_told_at_cam_angles_as_at_fractions_of_phases(side):
    """At any angle, one turn on or back; where phases meet, the named side is that of the one phase or the other."""
    forces = gc.CamForces(steady_cam(3), load(3), GUIDE)
    motion = forces.cam.motion
    inside = np.array([[0.1], [0.5], [0.9]])
    ends = np.full((1, len(motion.phases)), 1.0 if side == "left" else 0.0)
    phases, u = np.arange(len(motion.phases)), np.concatenate([inside + np.zeros_like(ends), ends])
    told = forces.at(phases, u, side)
    for turns in (0.0, 2 * math.pi, -2 * math.pi):
        found = forces.at(told.phi[:-1] + turns, side=side)
        for name in ("load", "normal", "side", "near", "far", "friction", "torque", "efficiency", "transmission"):
            value, expected = getattr(found, name), getattr(told, name)[:-1]
            np.testing.assert_allclose(value, expected, rtol=1e-9, atol=1e-9, err_msg=name)
    # Where phases begin and end the angles themselves are met.
    found = forces.at(np.append(motion.starts[1:], 2 * math.pi) if side == "left" else motion.starts, side=side)
    np.testing.assert_allclose(found.normal, told.normal[-1], rtol=1e-9)
    np.testing.assert_array_equal(np.isnan(found.efficiency), np.isnan(told.efficiency[-1]))
    assert np.isnan(forces.at(math.nan).normal)


@over_all("guide", [gc.Guide(0.0, 0.0, 1.0), GUIDE])
@over_all("seed", range(10))
def test_dense_sampling_never_exceeds_the_greatest_normal_force(seed, guide):
    forces = gc.CamForces(steady_cam(seed), load(seed), guide)
    greatest = forces.max_normal()
    phases = np.arange(len(forces.cam.motion.phases))[:, None]
    sampled = np.concatenate([forces.at(phases, np.linspace(0, 1, 4001), side).normal for side in ("left", "right")])
    assert sampled.max() <= greatest.value * (1 + 1e-13)
    assert sampled.max() == pytest.approx(greatest.value, rel=1e-5)
    places = np.isclose(forces.at(phases, np.linspace(0, 1, 4001)).phi, greatest.phi, atol=1e-2)
    assert sampled[: phases.size][places].max() == pytest.approx(greatest.value, rel=1e-2)


@over_seeds(6)
def test_the_torque_does_the_work_of_the_load(seed):
    """Without friction a whole turn takes no work: the integral of the torque over phi is zero, phase by phase Q ds."""
    forces = gc.CamForces(steady_cam(seed), load(seed))
    nodes, weights = np.polynomial.legendre.leggauss(40)
    for k, phase in enumerate(forces.cam.motion.phases):
        edges = np.unique([0.0, *(() if phase.kind == "dwell" else phase.normalised.breaks), 1.0])
        work, stored = 0.0, 0.0
        for low, high in pairwise(edges):
            at = forces.at(k, (low + high) / 2 + (high - low) / 2 * nodes)
            work += phase.angle * (high - low) / 2 * float(weights @ at.torque)
        s, v, _, _ = forces.cam.motion.at(k, [0.0, 1.0])
        spring = forces.load
        for place, sign in ((1, 1), (0, -1)):
            kinetic = spring.mass / 2 * (v[place] * spring.omega / 1000) ** 2 * 1000
            stored += sign * (spring.preload * s[place] + spring.stiffness * s[place] ** 2 / 2 + kinetic)
        assert work == pytest.approx(stored, abs=1e-9 * spring.preload * forces.cam.motion.lift)


def test_jamming_of_the_handbook():
    """Rothbart, Cam Design Handbook, chapter 6: tan(alpha_m) = B/(mu (2 A + B))."""
    guide = gc.Guide(friction=0.15, overhang=60, length=100)
    assert math.tan(float(jamming_angle(guide))) == pytest.approx(100 / (0.15 * (2 * 60 + 100)), rel=1e-14)
    assert float(jamming_angle(gc.Guide(0.0, 60, 100))) == math.pi / 2
    assert float(grip(guide, 60.0)) == 0.15  # the roller between the bearings: each unit of side force slips once


def test_the_efficiency_falls_to_zero_at_the_jamming_angle():
    motion = gc.Motion([gc.Rise(30, 60 * DEG), gc.Return(30, 100 * DEG), gc.Dwell(200 * DEG)])
    spring = gc.SpringLoad(mass=0.2, speed_rpm=60, stiffness=2, preload=100)
    loose = gc.CamForces(gc.Cam(motion, gc.Translating(0, 5), 40), spring, gc.Guide(0.1, 40, 60))
    efficiency, phi, _ = loose.min_efficiency()
    at = loose.at(0, np.linspace(0, 1, 5001))
    assert at.efficiency.min() == pytest.approx(efficiency, abs=1e-6)
    assert efficiency <= at.efficiency.min() + 1e-14
    alpha, s = float(loose.cam.pressure_angle(phi)), float(motion(phi)[0])
    jam = float(jamming_angle(loose.guide, s))
    assert efficiency == pytest.approx(1 - math.tan(alpha) / math.tan(jam), rel=1e-12)
    assert np.nanmax(np.abs(at.efficiency - at.load / at.along)) <= 1e-13

    steep = gc.CamForces(gc.Cam(motion, gc.Translating(0, 5), 18), spring, gc.Guide(0.5, 40, 60))
    with pytest.raises(gc.DesignError, match=r"pressure angle is .* degrees at which the guide jams"):
        steep.max_normal()
    jammed = steep.at(0, np.linspace(0, 1, 101))
    assert np.isnan(jammed.normal).any()
    assert jammed.efficiency.min() == 0


def test_the_guide_holds_the_spring_back_on_a_return():
    """The cam is pressed with less than the load: the rest is taken by friction."""
    forces = gc.CamForces(steady_cam(3), load(3), GUIDE)
    down = next(k for k, phase in enumerate(forces.cam.motion.phases) if phase.direction < 0)
    at = forces.at(down, np.linspace(0.1, 0.9, 9))
    assert np.all(at.along + at.friction == pytest.approx(at.load, rel=1e-13))
    assert np.all(at.along / at.load == pytest.approx(at.efficiency, rel=1e-13))


def test_forces_that_are_not_worked_out_are_refused_with_reason():
    motion = gc.Motion([gc.Rise(30, 60 * DEG), gc.Return(30, 300 * DEG)])
    with pytest.raises(gc.DesignError, match="overhang is 20, but must be the lift of 30 mm or more"):
        gc.CamForces(gc.Cam(motion, gc.Translating(), 50), load(0), gc.Guide(0.1, 20, 50))
    with pytest.raises(gc.DesignError, match="length is 0, but must be a finite number greater than 0 mm"):
        gc.Guide(0.1, 20, 0)
    with pytest.raises(gc.DesignError, match=r"friction is -0\.1"):
        gc.Guide(-0.1, 20, 50)

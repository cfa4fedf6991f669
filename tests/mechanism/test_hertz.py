"""Contact stress: the computed case, Hertz's pressure as a distribution, and exact extremes over the revolution."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import mp, mpf
from over_all import over_all, over_seeds
from reference import ReferenceCam
from test_forces import load, steady_cam

import graphcam as gc

DEG = math.pi / 180
CASE = {"force": 1000, "width": 20, "young1": 206000, "young2": 206000, "poisson1": 0.3, "poisson2": 0.3}


def test_hertz_to_all_digits():
    found = gc.hertz_line_contact(**CASE, radius1=30, radius2=15)
    assert found.peak_pressure == pytest.approx(424.43186510322527, rel=1e-15)
    assert found.half_width == pytest.approx(0.07499669849396796, rel=1e-15)
    assert gc.hertz_line_contact(**CASE, radius1=-20, radius2=15)[0] == pytest.approx(173.27358334678064, rel=1e-15)


def test_the_pressure_carries_the_force():
    """Half an ellipse of pressure over the strip: pi/2 p0 b w = F.  So the two results hold each other."""
    for r1, r2, e2, nu2 in ((30, 15, 70000, 0.33), (math.inf, 12, 210000, 0.3), (-40, 15, 100000, 0.0)):
        pressure, half_width = gc.hertz_line_contact(800, 12, r1, r2, 206000, e2, 0.3, nu2)
        assert math.pi / 2 * pressure * half_width * 12 == pytest.approx(800, rel=1e-14)


def test_the_flattened_surfaces_meet():
    """Half an ellipse of pressure bends the surfaces by the gap that they had: p0 = b E'/(2 R) (Johnson, chapter 4)."""
    pressure, half_width = gc.hertz_line_contact(1000, 20, 30, 15, 206000, 206000, 0.3, 0.3)
    modulus = 206000 / (2 * (1 - 0.3**2))
    assert pressure == pytest.approx(modulus * half_width / (2 * 10), rel=1e-14)


def test_planes_and_nearly_fitting_hollows_keep_their_digits():
    flat = gc.hertz_line_contact(1000, 20, math.inf, 15)
    large = gc.hertz_line_contact(1000, 20, 1e12, 15)
    assert flat.peak_pressure == pytest.approx(large.peak_pressure, rel=1e-10)
    gap = 2.0**-40
    found = gc.hertz_line_contact(1000, 20, -(15 + gap), 15).peak_pressure
    bend = 1 / mpf(15) - 1 / (mpf(15) + mpf(gap))
    exact = mp.sqrt(mpf(1000) / 20 / mp.pi * bend * mpf(206000) / (2 * (1 - mpf("0.3") ** 2)))
    assert found == pytest.approx(float(exact), rel=1e-14)


@over_all(
    ("change", "message"),
    [
        ({"radius1": -15.0}, "pair of radii is -15 and 15 mm, but must be such that they touch along one line"),
        ({"radius1": -10.0}, "a hollow must be wider than what lies in it"),
        ({"radius1": math.inf, "radius2": math.inf}, "touch along one line"),
        ({"radius1": 0.0}, "radius1 is 0.0"),
        ({"radius2": math.nan}, "radius2 is nan"),
        ({"force": -1.0}, "force is -1.0"),
        ({"width": 0.0}, "width is 0.0"),
        ({"young1": 0.0}, "young1 is 0.0"),
        ({"poisson2": 0.6}, "poisson2 is 0.6, but must be from 0 to 0.5"),
    ],
)
def test_contacts_that_cannot_be_are_refused_with_reason(change, message):
    with pytest.raises(gc.DesignError, match=message):
        gc.hertz_line_contact(**(CASE | {"radius1": 30.0, "radius2": 15.0} | change))


# --- over the revolution ---------------------------------------------------------------------------------------------


def stress_of(seed: int, guide: gc.Guide | None = None) -> gc.ContactStress:
    forces = gc.CamForces(steady_cam(seed), load(seed), *([guide] if guide else []))
    return gc.ContactStress(forces, gc.RollerContact(width=12, young_follower=70000, poisson_follower=0.33))


@over_seeds(6)
def test_the_profile_is_curved_as_the_pitch_curve_less_the_roller(seed):
    """Each place for itself by hertz_line_contact, with the radius of the 50-digit reference's working profile."""
    stress = stress_of(seed)
    cam, u = stress.forces.cam, np.array([0.13, 0.52, 0.81])
    exact = ReferenceCam(cam)
    for k, phase in enumerate(cam.motion.phases):
        if not phase.direction:
            continue
        at = stress.at(k, u)
        for i, phi in enumerate(at.phi):
            radius = 1 / exact.curvature(mpf(float(phi))) - cam.roller_radius
            assert at.profile_radius[i] == pytest.approx(float(radius), rel=1e-9)
            one = gc.hertz_line_contact(
                max(at.force[i], 0), 12, float(radius), cam.roller_radius, 206000, 70000, 0.3, 0.33
            )
            assert at.peak_pressure[i] == pytest.approx(one.peak_pressure, rel=1e-9)
            assert at.half_width[i] == pytest.approx(one.half_width, rel=1e-9)


@over_all("guide", [None, gc.Guide(0.12, 70.0, 90.0)])
@over_all("seed", range(10))
def test_dense_sampling_never_exceeds_the_greatest_stress(seed, guide):
    stress = stress_of(seed, guide)
    greatest = stress.max_pressure()
    phases = np.arange(len(stress.forces.cam.motion.phases))[:, None]
    sampled = [stress.at(phases, np.linspace(0, 1, 4001), side).peak_pressure.max() for side in ("left", "right")]
    assert max(sampled) <= greatest.value * (1 + 1e-12)
    assert max(sampled) == pytest.approx(greatest.value, rel=1e-5)


def test_flat_and_hollow_profiles():
    """A cam so large for its lift that the profile is hollow in places: kappa changes its sign."""
    motion = gc.Motion([gc.Rise(60, 60 * DEG), gc.Dwell(60 * DEG), gc.Return(60, 60 * DEG), gc.Dwell(math.pi)])
    cam = gc.Cam(motion, gc.Translating(0, 10), 100)
    stress = gc.ContactStress(gc.CamForces(cam, gc.SpringLoad(0.0, 0.0, 0.0, preload=500)), gc.RollerContact(10))
    at = stress.at(0, np.linspace(0, 1, 201))
    hollow = at.profile_radius < 0
    assert 0 < hollow.sum() < 201
    assert np.all(at.profile_radius[hollow] < -10)
    flat = gc.hertz_line_contact(float(at.force[hollow].max()), 10, math.inf, 10).peak_pressure
    assert at.peak_pressure[hollow].max() < flat


def test_the_least_width_is_where_the_stress_is_the_permitted_one():
    stress = stress_of(2)
    width = stress.min_width(permitted=300.0)
    there = gc.ContactStress(stress.forces, gc.RollerContact(width, young_follower=70000, poisson_follower=0.33))
    assert there.max_pressure().value == pytest.approx(300.0, rel=1e-13)


def test_no_stress_without_contact_and_none_on_an_undercut_profile():
    cam = steady_cam(1)
    slack = gc.ContactStress(gc.CamForces(cam, gc.SpringLoad(0.0, 0.0, 0.0, preload=-5)), gc.RollerContact(10))
    assert slack.at(0, 0.5).peak_pressure == 0
    with pytest.raises(gc.DesignError, match="contact force is nowhere positive"):
        slack.max_pressure()
    motion = gc.Motion([gc.Rise(30, 60 * DEG), gc.Dwell(30 * DEG), gc.Return(30, 60 * DEG), gc.Dwell(210 * DEG)])
    undercut = gc.Cam(motion, gc.Translating(5, 20), 30)
    stress = gc.ContactStress(gc.CamForces(undercut, gc.SpringLoad(0.2, 100, 5, 50)), gc.RollerContact(10))
    assert np.isnan(stress.at(0, np.linspace(0, 1, 101)).peak_pressure).any()
    with pytest.raises(gc.DesignError, match="roller radius is 20, but must be less than the minimum radius"):
        stress.max_pressure()
    knife = gc.CamForces(gc.Cam(motion, gc.Translating(5), 30), gc.SpringLoad(0.2, 100, 5, 50))
    with pytest.raises(gc.DesignError, match="a knife edge has no line contact"):
        gc.ContactStress(knife, gc.RollerContact(10))

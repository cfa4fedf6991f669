"""A sweep of cams under oscillating flat faces against single cams."""

import math

import numpy as np
import pytest

import graphcam as gc
from graphcam.errors import DesignError

DEG = math.pi / 180


def designs(**changed) -> gc.Designs:
    sizes = {
        "lift": np.array([8.0, 12.0, 15.0, 30.0]) * DEG,
        "rise_angle": 100 * DEG,
        "dwell_angle": 40 * DEG,
        "return_angle": 90 * DEG,
        "prime_radius": np.array([60.0, 80.0, 90.0, 130.0]),
        "distance": 150.0,
        "face_offset": np.array([-10.0, 0.0, 12.0, 15.0]),
        "rotation": np.array(["ccw", "cw", "ccw", "cw"]),
    }
    return gc.Designs(**sizes | changed, follower="oscillating-flat")


def test_every_design_is_the_cam_with_its_sizes():
    swept = designs()
    load = gc.ArmLoad(inertia=1500, speed_rpm=200, stiffness=3000, preload=9000)
    names = ("max_normal_force", "min_normal_force", "max_torque", "jamming_margin")
    found = gc.sweep(swept, ("min_pitch_curvature_radius", "max_pressure_angle_rise", *names), load=load, friction=0.1)
    for k in range(3):
        cam = swept.cam(k)
        extremes, forces = cam.extremes(), gc.CamForces(cam, load, friction=0.1)
        expected = (
            *(extremes.min_convex_radius[0], extremes.pressure_angle_rise[0]),
            *(forces.max_normal().value, forces.min_normal().value, forces.max_torque().value),
            gc.jamming_margin(cam, 0.1).value,
        )
        assert [found[name][k] for name in found] == pytest.approx(expected, rel=1e-9, abs=1e-12)
    assert all(np.isnan(found[name][3]) for name in found)  # beyond a right angle to the line of centres


def test_a_face_that_turns_with_the_cam_as_fast_as_the_cam_makes_no_cam():
    quick = designs(lift=40 * DEG, return_angle=30 * DEG, prime_radius=40.0, face_offset=0.0)
    found = gc.sweep(quick, ["min_pitch_curvature_radius", "feasible"])
    assert np.isnan(found["min_pitch_curvature_radius"]).tolist() == [True, False, True, False]
    assert not found["feasible"][[0, 2]].any()
    with pytest.raises(DesignError, match="angular velocity of the face"):
        quick.cam(0)


def test_feasible_is_a_profile_without_undercut():
    found = gc.sweep(designs(), ["feasible", "min_pitch_curvature_radius"])
    assert found["feasible"].tolist() == [bool(rho > 0) for rho in found["min_pitch_curvature_radius"]]


def test_a_distance_is_needed_and_an_arm_refused():
    with pytest.raises(DesignError, match="distance is left out"):
        designs(distance=0.0)
    with pytest.raises(DesignError, match="left out for an oscillating-flat follower"):
        designs(arm=100.0)

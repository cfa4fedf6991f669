"""What is given in place of something else is told by name, with what it must be: no error of Python's own."""

from __future__ import annotations

from math import inf, nan, radians

import numpy as np
import pytest
from over_all import over_all

import graphcam as gc

MOTION = gc.Motion(
    [gc.Rise(12, radians(60)), gc.Dwell(radians(60)), gc.Return(12, radians(60)), gc.Dwell(radians(180))]
)
CAM = gc.Cam(MOTION, gc.Translating(0, 10), 60)
LOAD = gc.SpringLoad(0, 0, 0, preload=6000)
FORCES = gc.CamForces(CAM, LOAD)
CONTACT = gc.RollerContact(width=10)
DESIGNS = gc.Designs(lift=12, rise_angle=1.0, return_angle=1.0, prime_radius=[50, 60])
POINTS = [gc.MotionPoint(0, s=0, v=0, a=0), gc.MotionPoint(1, s=1, v=0, a=0)]
NONE = np.zeros(0)
WRONG = {
    "cam angle is '60 deg', but must be a number, or an array of numbers": lambda: gc.cam_angle("60 deg"),
    r"cam angle is \[0, 'b'\], but must be a number, or an array": lambda: CAM.profile([0, "b"]),
    "cam angle is 'a', but must be a number, or an array": lambda: CAM.pressure_angle("a"),
    "cam angle is 1j, but must be a number, or an array": lambda: MOTION(1j),
    "task is of the kind str, but must be a Task or ArcsTask": lambda: gc.size_task("cam.toml"),
    r"parts\[1\] is of the kind int, but must be a PolynomialPart or SplinePart": lambda: gc.boundary_motion(
        [gc.PolynomialPart(POINTS), 2]
    ),
    "forces is of the kind Cam, but must be a CamForces$": lambda: gc.mean_torque(CAM),
    "cam is of the kind NoneType, but must be a Cam": lambda: gc.profile_spline(None),
    "deviation is 'x', but must be": lambda: gc.profile_spline(CAM, "x"),
    r"blends\[0\] is 'a', but must be from 0 to less than 1": lambda: gc.constant_velocity_law("a", 0),
    "pencil seed is 'x', but must be 0 or more": lambda: gc.Pencil(0.1, seed="x"),
    "follower is of the kind int, but must be a Translating, Oscillating, FlatFaced or OscillatingFlat": lambda: gc.Cam(
        MOTION, 40, 10
    ),
    "the rise is of the kind str, but must be an angle in rad; 30 degrees are": lambda: gc.Limits("30"),
    "load is an ArmLoad, but must be that load in its place beside the cam; take": lambda: gc.Contact(
        MOTION, gc.ArmLoad(2000, 300, 5000)
    ),
    "lift is -25.0, but must be a finite number greater than 0": lambda: gc.sweep(
        gc.Designs(lift=-25, rise_angle=1.0, return_angle=1.0, prime_radius=[50, 60])
    ),
    "prime_radius is -5.0, but must be a finite number greater than 0 mm": lambda: gc.sweep(
        gc.Designs(lift=12, rise_angle=1.0, return_angle=1.0, prime_radius=[-50, -5])
    ),
    "phase is of the kind int, but must be a Rise, Dwell or Return": lambda: gc.Motion([1, 2]),
    "phases is of the kind Dwell, but must be a list of rises, dwells and returns": lambda: gc.Motion(gc.Dwell(1)),
    "table is not of numbers, but must be a list of cam angles": lambda: gc.measured_motion("a", "b", 0.1),
    "motion is of the kind Cam, but must be a Motion": lambda: gc.Cam(CAM, gc.Translating(), 40),
    "cam is of the kind Motion, but must be a Cam": lambda: gc.CamForces(MOTION, LOAD),
    "guide is of the kind float, but must be a Guide; friction": lambda: gc.CamForces(CAM, LOAD, 0.1),
    "load is of the kind int, but must be a SpringLoad, for": lambda: gc.CamForces(CAM, 5),
    "forces is of the kind Cam, but must be a CamForces": lambda: gc.ContactStress(CAM, CONTACT),
    "contact is of the kind int, but must be a RollerContact": lambda: gc.ContactStress(FORCES, 10),
    "task is of the kind Cam, but must be a Task or ArcsTask": lambda: gc.solve(CAM),
    "load is of the kind float, but must be a SpringLoad or ArmLoad": lambda: gc.spring_preload(CAM, 0.8, 600, 5),
    "mass is of the kind SpringLoad, but must be a number of kg; under a load": lambda: gc.spring_preload(MOTION, LOAD),
    "deviations is of the kind MakingErrors": lambda: gc.MadeCam(CAM, gc.MakingErrors(offset=0.1)),
    "limits is of the kind tuple, but must be a Limits": lambda: gc.sweep(DESIGNS, limits=(0.5, 0.5)),
    "load is of the kind int, but must be a SpringLoad or ArmLoad": lambda: gc.sweep(DESIGNS, "max_torque", load=5),
    r"parts\[0\] is of the kind str, but must be a MotionPoint": lambda: gc.boundary_law("mine", POINTS),
    "preload is of the kind SpringPreload, but must be a number of N; write spring_preload": lambda: gc.SpringLoad(
        0.8, 600, 5, gc.spring_preload(MOTION, 0.8, 600, 5)
    ),
    "pencil is of the kind float, but must be a Pencil; write graphcam.Pencil.of": lambda: gc.solve(
        gc.builtin_task(), 0.2
    ),
    "errors is of the kind float, but must be a MakingErrors": lambda: gc.motion_bands(CAM, 0.1),
    "cam is of the kind Motion, but must be a Cam$": lambda: gc.largest_roller(MOTION),
    "path is of the kind int, but must be a str or Path": lambda: gc.load_task(3),
    "follower is of the kind str, but must be a Translating": lambda: gc.minimum_radius(MOTION, "flat-faced"),
    "sizes is 'ofset', but must be one of roller_radius, offset, distance, .*; did you mean 'offset'": lambda: (
        gc.Deviations((), NONE, {"ofset": 0.05})
    ),
    "sizes is 'arm', but must be a size of the translating follower; known are offset, roller_radius": lambda: (
        gc.MadeCam(CAM, gc.Deviations((), NONE, {"arm": 0.05}))
    ),
}


@over_all("said", WRONG)
def test_a_wrong_kind_is_told_by_name(said):
    with pytest.raises(gc.DesignError, match=said):
        WRONG[said]()


def test_a_number_in_place_of_a_range_fixes_a_size():
    """As two equal ends do."""
    sizes = {"roller_radius": (10, 15), "width": (10, 20), "permitted_stress": 1500}
    fixed, range_ = (gc.size_cam(MOTION, LOAD, prime_radius=(60, 120), offset=e, **sizes) for e in (0, (0, 0)))
    assert fixed.sizes == range_.sizes
    assert gc.size_cam(MOTION, LOAD, prime_radius=np.float64(70), offset=0, **sizes).radius == 70
    with pytest.raises(gc.DesignError, match="range of the offset is of the kind str"):
        gc.size_cam(MOTION, LOAD, prime_radius=(60, 120), offset="0", **sizes)


def test_an_arm_with_a_lift_in_another_unit_is_told_the_unit():
    dwell = gc.Dwell(radians(90))
    motion = gc.Motion([gc.Rise(15, radians(90)), dwell, gc.Return(15, radians(90)), dwell])
    said = r"an arm's lift is an angle in radians: math.radians\(15\)"
    with pytest.raises(gc.DesignError, match=said):
        gc.Cam(motion, gc.Oscillating(120, 130, 12), 50)
    with pytest.raises(gc.DesignError, match=said):
        gc.minimum_radius(motion, gc.Oscillating(120))


NUMBERS = {
    "lift": lambda x: gc.Rise(x, 1.0),
    "angle": lambda x: gc.Return(10, x),
    "prime radius": lambda x: gc.Cam(MOTION, gc.Translating(0, 10), x),
    "offset": lambda x: gc.Translating(offset=x),
    "roller radius": lambda x: gc.Translating(roller_radius=x),
    "arm": lambda x: gc.Oscillating(arm=x, distance=100),
    "mass": lambda x: gc.SpringLoad(x, 600, 5),
    "stiffness": lambda x: gc.ArmLoad(2000, 300, x),
    "overhang": lambda x: gc.Guide(0.1, x, 40),
    "friction": lambda x: gc.CamForces(CAM, LOAD, friction=x),
    "width": gc.RollerContact,
    "permitted stress": lambda x: gc.ContactStress(FORCES, CONTACT).min_width(x),
    "pencil line": lambda x: gc.Pencil(line=x),
    "damping": lambda x: gc.FollowerTrain(1, 1000, damping=x),
    "poisson_cam": lambda x: gc.RollerContact(10, poisson_cam=x),
    "tolerance": lambda x: gc.measured_motion(np.linspace(0, 6, 60), np.zeros(60), x),
}


@over_all("value", ["20", [1, 2], np.array([1.0, 2.0]), 1j, nan, inf])
@over_all("quantity", NUMBERS)
def test_what_is_no_finite_number_is_told_by_name(quantity, value):
    with pytest.raises(gc.DesignError, match=f"^{quantity} is ") as told:
        NUMBERS[quantity](value)
    assert str(value) in str(told.value)

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from mpmath import diff, mpf
from numpy.testing import assert_allclose, assert_array_equal
from over_all import over_all
from reference import EPS, displacement

import graphcam as gc
from graphcam.errors import DesignError
from graphcam.given import motion as motion_module
from graphcam.given.laws import LAWS
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise, cam_angle, wrap

DEG = math.pi / 180


def rise_dwell_return_dwell(name: str = "3-4-5", h: float = 30.0) -> Motion:
    return Motion([Rise(h, 80 * DEG, name), Dwell(45 * DEG), Return(h, 60 * DEG, name), Dwell(175 * DEG)])


def steps() -> Motion:
    """Two rises, two returns, and a motion that starts on its way down."""
    angles = [1.1, 0.7, 0.9, 0.4, 1.3]
    rest = FULL_TURN - math.fsum(angles)
    return Motion(
        [
            Return(12.0, angles[0], "cycloidal"), Rise(20.0, angles[1], "2-3"), Dwell(angles[2]),
            Return(25.0, angles[3], "rectangular", 3.0), Rise(17.0, angles[4], "modified-sine"), Dwell(rest),
        ]
    )  # fmt: skip


@over_all("name", LAWS)
@over_all("turned", [False, True])
def test_velocity_acceleration_and_jerk_are_derivatives_of_the_displacement(name, turned):
    motion = rise_dwell_return_dwell(name)
    if turned:
        motion = Motion((*motion.phases[2:], *motion.phases[:2]))
    phi = np.random.default_rng(3).random(25) * FULL_TURN
    computed = np.array(motion(phi)).T
    for angle, values in zip(phi, computed, strict=True):
        exact = [diff(lambda x: displacement(motion, x), mpf(float(angle)), order) for order in range(4)]
        assert_allclose(values, [float(x) for x in exact], rtol=1e-13, atol=1e-11)


def test_several_rises_and_a_motion_that_begins_with_a_return():
    motion = steps()
    assert motion.levels.tolist() == [17, 5, 25, 25, 0, 17, 17]  # the lowest is 0
    assert motion.lift == 25
    for angle in (0.3, 1.2, 2.0, 3.0, 3.9, 6.1):
        assert float(motion(angle)[0]) == pytest.approx(float(displacement(motion, mpf(angle))), rel=4 * EPS, abs=1e-14)


def test_the_lift_still_missing_keeps_its_digits_at_the_end_of_a_return():
    """s = h (1 - f(1 - w)) for w = 2^-30: 8.08e-27 of the lift, which 1 - f would lose."""
    motion = Motion([Return(1.0, 1.0, "3-4-5"), Rise(1.0, FULL_TURN - 1)])
    s, v, a, _ = (float(x) for x in motion.at(0, 1 - 2.0**-30))
    assert s == pytest.approx(8.0779356581784151e-27, rel=4 * EPS)
    assert v == pytest.approx(-2.6020852091184492e-17, rel=4 * EPS)
    assert a == pytest.approx(5.5879354320803598e-8, rel=4 * EPS)


# --- angles and sides ------------------------------------------------------------------------------------------------


@given(st.floats(-1e6, 1e6, allow_nan=False))
@settings(derandomize=True, max_examples=100)
def test_the_cam_angle_may_be_any_real_number(phi):
    motion = rise_dwell_return_dwell("cycloidal")
    turned = phi + FULL_TURN
    rounding = 4 * np.spacing(abs(phi) + FULL_TURN)
    assert 0 <= float(wrap(phi)) < FULL_TURN
    assert math.cos(wrap(phi)) == pytest.approx(math.cos(phi), abs=rounding + 1e-10)  # 1e6/2pi turns of a rounded 2 pi
    assert float(motion(phi)[0]) == pytest.approx(float(motion(turned)[0]), abs=100 * rounding + 1e-13)


def test_degrees_of_many_turns_are_those_of_one_bit_for_bit():
    """In radians the same 1e9 turns are rounded to 1e-6, and 37.5 degrees with them."""
    motion, degrees = rise_dwell_return_dwell("cycloidal"), np.array([0.0, 37.5, 80.0, 125.5, 359.75])
    for turns in (1, -1, 1e3, 1e9, -1e9):
        assert_array_equal(motion(cam_angle(degrees + 360 * turns)), motion(cam_angle(degrees)))
    assert_array_equal(cam_angle(degrees), np.radians(degrees))
    assert np.isnan(cam_angle([np.nan, np.inf])).all()


def test_a_turn_begins_again_where_it_ends():
    motion = rise_dwell_return_dwell("rectangular")
    ends = np.array([0.0, -0.0, FULL_TURN, -FULL_TURN, 7 * FULL_TURN, -1e-20])
    assert_array_equal(motion(ends), np.repeat(np.array(motion(0.0))[:, None], ends.size, axis=1))
    assert float(motion(0.0)[2]) > 0
    assert [float(x) for x in motion(0.0, side="left")] == [0, 0, 0, 0]
    assert [float(x) for x in motion(FULL_TURN, side="left")] == [0, 0, 0, 0]


def test_scalars_give_scalars_and_arrays_their_own_shape():
    motion = steps()
    for values in (motion(1.0), motion.at(0, 0.5)):
        assert all(x.shape == () and x.dtype == np.float64 for x in values)
    assert [x.shape for x in motion(np.ones((2, 3), dtype=int))] == [(2, 3)] * 4
    assert [x.shape for x in motion([])] == [(0,)] * 4
    assert [x.shape for x in motion.at([0, 1], np.ones((3, 1)))] == [(3, 2)] * 4


def test_nan_stays_nan_in_rises_and_dwells_and_infinity_is_no_angle():
    for motion in (rise_dwell_return_dwell(), steps()):
        values = np.array(motion([np.nan, np.inf, -np.inf, 1.0]))
        assert np.isnan(values[:, :3]).all()
        assert np.isfinite(values[:, 3]).all()
        for phase in range(len(motion.phases)):
            assert np.isnan(np.array(motion.at(phase, [np.nan, -0.1, 1.1]))).all()


@over_all("ratio", [0.3, 1.0, 1 / 3, 2.7, 7.0])
def test_the_named_side_holds_at_every_break(ratio):
    """Whatever rounding does to the fraction of a phase, the left value at a jump belongs to the part before it."""
    for k in range(1, 40):
        angle = 0.01 + 0.07 * k
        motion = Motion(
            [Dwell(0.3), Rise(10, angle, "rectangular", ratio), Return(10, FULL_TURN - angle - 0.3, "cosine")]
        )
        jump = motion.breaks[2]
        assert jump == pytest.approx(0.3 + angle / (1 + ratio))
        left, right = float(motion(jump, side="left")[2]), float(motion(jump, side="right")[2])
        assert left == pytest.approx(2 * (1 + ratio) * 10 / angle**2)
        assert right == pytest.approx(-2 * (1 + 1 / ratio) * 10 / angle**2)


@over_all("name", LAWS)
def test_sides_agree_except_where_a_derivative_jumps(name):
    motion = rise_dwell_return_dwell(name)
    inside = np.random.default_rng(5).random(500) * FULL_TURN
    assert_array_equal(motion(inside, side="left"), motion(inside, side="right"))
    s, v, *_ = np.array(motion(motion.breaks, side="left")) - np.array(motion(motion.breaks, side="right"))
    rounding_of_the_angle = 2 * np.spacing(FULL_TURN)
    assert np.abs(s).max() <= 60 * rounding_of_the_angle
    assert np.abs(v).max() <= 600 * rounding_of_the_angle
    assert motion.breaks[0] == 0
    assert motion.breaks[-1] < FULL_TURN


def test_an_end_of_a_phase_belongs_to_it_when_asked_by_phase():
    motion = rise_dwell_return_dwell("rectangular")
    acceleration = motion.at(np.array([0, 1, 2]), np.array([1.0, 0.0, 0.0]))[2]
    assert acceleration == pytest.approx([-4 * 30 / (80 * DEG) ** 2, 0, -4 * 30 / (60 * DEG) ** 2])
    assert motion.at(0, 0.5, side="left")[2] == -motion.at(0, 0.5, side="right")[2] > 0
    assert motion.angle_at([0, 2], [1.0, 0.0]) == pytest.approx([80 * DEG, 125 * DEG])


def test_the_rounding_of_an_angle_reaches_into_no_other_phase():
    """Where a derivative jumps, the value on the left is the one before the jump."""
    draw = np.random.default_rng(1)
    for angles in draw.dirichlet(np.ones(4), 200) * FULL_TURN:
        phases = [Rise(20, angles[0], "rectangular"), Dwell(angles[1]), Return(20, angles[2], "cosine")]
        motion = Motion([*phases, Dwell(FULL_TURN - angles[:3].sum())])
        every = np.arange(4)
        ends = motion.angle_at(every, 1.0)
        assert (ends <= np.append(motion.starts[1:], FULL_TURN)).all()
        assert_allclose(motion(ends, side="left"), motion.at(every, 1.0, "left"), rtol=1e-9, atol=1e-9)


def test_tiny_phases_keep_their_values():
    tiny = 1e-7
    motion = Motion([Rise(5, tiny, "modified-trapezoidal"), Dwell(3.0), Return(5, FULL_TURN - 3.0 - tiny)])
    assert [float(x) for x in motion.at(0, 0.5)[:2]] == pytest.approx([2.5, 2.0 * 5 / tiny], rel=4 * EPS)
    assert float(motion(tiny / 2)[0]) == pytest.approx(2.5, rel=1e-8)
    assert float(motion(tiny)[0]) == 5
    assert np.all(np.diff(motion(np.linspace(0, tiny, 1001))[0]) >= 0)


@over_all("tiny", [1e-300, 1e-17, 1e-12])
@over_all("place", [1, 3])
def test_a_phase_that_rounding_swallows_is_refused(tiny, place):
    phases = [Rise(30, math.pi / 2), Return(30, FULL_TURN - math.pi / 2)]
    phases.insert(place, Dwell(tiny))
    told = r"angle is .* rad, but must be long enough to be told from rounding, 1e-10 rad; leave the phase out"
    with pytest.raises(DesignError, match=told):
        Motion(phases)


# --- what cannot be --------------------------------------------------------------------------------------------------


@over_all(
    ("make", "message"),
    [
        (lambda: Rise(0.0, 1.0), "lift is 0.0, but must be a finite number greater than 0 mm"),
        (lambda: Rise(-3.0, 1.0), "lift is -3.0"),
        (lambda: Rise(math.nan, 1.0), "lift is nan"),
        (lambda: Return(math.inf, 1.0), "lift is inf"),
        (lambda: Return(3.0, 0.0), "angle is 0.0, but must be a finite number greater than 0 rad"),
        (lambda: Dwell(-1.0), "angle is -1.0"),
        (lambda: Dwell(math.nan), "angle is nan"),
        (lambda: Rise(3.0, 1.0, "cosinn"), "did you mean 'cosine'"),
        (lambda: Motion([]), "motion is without a rise, but must be one with a rise and a return; add a rise"),
        (lambda: Motion([Dwell(FULL_TURN)]), "motion is without a rise"),
        (lambda: Motion([Rise(1e-10, FULL_TURN)]), "motion is without a return"),  # whose lift alone would close
        (
            lambda: Motion([Rise(3, 1.0), Return(3, 1.0)]),
            r"sum of the phase angles is 2 rad \(114.591559 degrees\), .* 2 pi rad .*; lengthen a dwell by 245.4",
        ),
        (lambda: Motion([Rise(3, 3.0), Return(2, FULL_TURN - 3)]), "sum of rises less returns is 1 mm.*0 mm"),
        (lambda: Motion([Rise(3, 3.0), Return(3, FULL_TURN - 3)])(0.0, side="up"), "side is 'up'"),
        (
            lambda: Motion([Rise(30, 120), Dwell(60), Return(30, 180)]),
            r"angle is 120 rad, .* at most a full turn, 2 pi rad; write math.radians\(120\) if it is in degrees",
        ),
        (lambda: Dwell(60), r"angle is 60 rad.*write math.radians\(60\)"),
        (
            lambda: Rise(math.pi / 2, 30),
            r"angle is 30 rad.*math.radians\(30\).*, or Rise\(lift=30, angle=1.5708\) if the two are swapped",
        ),
        (
            lambda: Motion([Rise(math.pi / 2, 5), Dwell(math.pi / 2), Return(math.pi, 5)]),
            r"sum .* is 11.5708 rad .*; the lifts make a turn: name the arguments, Rise\(lift=5, angle=1.5708\)",
        ),
    ],
)
def test_motions_that_cannot_be_are_refused_with_reason(make, message):
    with pytest.raises(DesignError, match=message):
        make()


@over_all(("miss", "closes"), [(0.9e-9, True), (-0.9e-9, True), (1.2e-9, False), (-1.2e-9, False)])
def test_closure_is_judged_to_1e_9(miss, closes):
    def motion():
        return Motion([Rise(3, 3.0), Return(3, FULL_TURN - 3 + miss)])

    if closes:
        s, *_ = motion()(np.linspace(0, FULL_TURN, 1000))
        assert s.min() >= 0
        assert s.max() <= 3
    else:
        with pytest.raises(DesignError, match="sum of the phase angles"):
            motion()


@pytest.mark.parametrize("asked", ["motion", "pressure angle", "forces", "stress"])
def test_degrees_for_radians_are_warned_of_once(asked):
    motion = gc.Motion([gc.Rise(30, 2.0), gc.Dwell(1.0), gc.Return(30, 2.0), gc.Dwell(2 * np.pi - 5)])
    cam = gc.Cam(motion, gc.Translating(10, 12), prime_radius=50)
    forces = gc.CamForces(cam, gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=100))
    stress = gc.ContactStress(forces, gc.RollerContact(10))
    ask = {"motion": motion, "pressure angle": cam.pressure_angle, "forces": forces.at, "stress": stress.at}[asked]
    motion_module._warn_of_degrees.cache_clear()
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        for angle in (1, 6, 6.2, 7.5, -0.5, np.array([60.0, 90.0]), gc.cam_angle(60)):
            ask(angle)
        assert not told
        ask(60)
        ask(90)
    assert [each.category for each in told] == [gc.DegreesWarning]
    assert "write gc.cam_angle(60)" in str(told[0].message)
    assert told[0].filename == __file__

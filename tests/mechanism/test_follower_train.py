"""The elastic follower over a turn: its equation of motion, the rigid limit, harmonics, the work, and lost contact."""

from __future__ import annotations

import math

import numpy as np
import pytest
from over_all import over_all
from scipy.integrate import solve_ivp

import graphcam as gc
from graphcam.given.follower import omega_of

DEG = math.pi / 180
FULL_TURN = math.tau
TRAIN = gc.FollowerTrain(mass=0.5, stiffness=2000, damping=0.05, spring=20, preload=200)


def motion_of(law: str) -> gc.Motion:
    phases = [gc.Rise(30, 80 * DEG, law), gc.Dwell(45 * DEG), gc.Return(30, 60 * DEG, law), gc.Dwell(175 * DEG)]
    return gc.Motion(phases)


def changed(**sizes) -> gc.FollowerTrain:
    given = {"mass": 0.5, "stiffness": 2000.0, "damping": 0.05, "spring": 20.0, "preload": 200.0} | sizes
    return gc.FollowerTrain(**given)


@over_all("damping", [0.0, 0.05, 1.5])
@over_all("law", ["rectangular", "modified-sine", "4-5-6-7"])
def test_the_mass_moves_by_its_equation_of_motion(law, damping):
    """m x'' + c (x' - s') + k (x - s) + c_s x = 0 in time, and the two forms of the force on the cam, in SI units."""
    train, motion = changed(damping=damping), motion_of(law)
    follower = gc.VibratingFollower(motion, train, 590)
    omega, phi = omega_of(590), np.linspace(0, FULL_TURN, 2001)
    found, (s, v, *_) = follower(phi), motion(phi)
    inertia = train.mass * omega**2 * found.a / 1000
    damper = train.damper * omega * (found.v - v)
    spring, back = train.stiffness * (found.x - s), train.spring * found.x
    size = np.abs(spring).max() + np.abs(back).max()
    np.testing.assert_allclose(inertia + damper + spring + back, 0, atol=1e-10 * size)
    np.testing.assert_allclose(found.force, train.preload - spring - damper, atol=1e-10 * size)
    np.testing.assert_allclose(found.force, train.preload + back + inertia, atol=1e-10 * size)
    np.testing.assert_allclose(found.deviation, found.x - train.share * s, atol=1e-12)
    # v is the slope of x, and a of v: by differences inside the smooth pieces.
    h = 1e-6
    inside = phi[np.abs(phi[:, None] - np.append(motion.breaks, FULL_TURN)).min(axis=1) > 2 * h]
    before, now, after = (follower(inside + k * h) for k in (-1, 0, 1))
    np.testing.assert_allclose((after.x - before.x) / (2 * h), now.v, atol=1e-6 * np.abs(now.v).max())
    np.testing.assert_allclose((after.v - before.v) / (2 * h), now.a, atol=1e-6 * np.abs(now.a).max())


@over_all("damping", [0.0, 0.02, 3.0])
def test_turn_after_turn_is_the_same(damping):
    """Position and velocity close over the turn, in any turn, whatever the damping."""
    follower = gc.VibratingFollower(motion_of("cosine"), changed(damping=damping), 613.0)
    near = 1e-9
    first, last, later = follower(0.0), follower(FULL_TURN - near), follower(2 * FULL_TURN + 1.0)
    assert float(last.x) == pytest.approx(float(first.x), abs=1e-6)
    assert float(last.v) == pytest.approx(float(first.v), abs=1e-5)
    assert float(later.force) == pytest.approx(float(follower(1.0).force), rel=1e-10)


def test_from_rest_it_settles_into_the_steady_motion():
    """scipy's steps over ten turns in time, from rest: the start is forgotten, exp(-zeta nu phi) of it is left."""
    train, motion, omega = changed(damping=0.1), motion_of("3-4-5"), omega_of(600)

    def slope(t, z):
        s, v, *_ = (float(each) for each in motion(omega * t))
        x, speed = z
        force = train.stiffness * (x - s) + train.damper * (speed - omega * v) + train.spring * x
        return [speed, -force * 1000 / train.mass]

    turns, per_turn = 3, FULL_TURN / omega
    t = (turns - 1 + np.linspace(0.02, 0.98, 13)) * per_turn
    longest = per_turn / 100
    x, speed = solve_ivp(slope, (0, t[-1]), [0, 0], "DOP853", t, rtol=1e-9, atol=1e-11, max_step=longest).y
    found = gc.VibratingFollower(motion, train, 600)(omega * t)
    np.testing.assert_allclose(x, found.x, atol=1e-6)
    np.testing.assert_allclose(speed / omega, found.v, atol=1e-5)


def test_every_harmonic_is_magnified_as_the_textbooks_say():
    """Fourier series of s by quadrature, each harmonic times (k + i c w)/(k + c_s - m w^2 + i c w)."""
    train, motion, omega = TRAIN, motion_of("4-5-6-7"), omega_of(480)
    count = 4096
    s = motion(FULL_TURN * np.arange(count) / count)[0]
    harmonic = omega * np.arange(count // 2 + 1)
    damped, inertia = 1j * train.damper * harmonic, train.mass * harmonic**2 / 1000
    passed = (train.stiffness + damped) / (train.stiffness + train.spring - inertia + damped)
    x = np.fft.irfft(passed * np.fft.rfft(s), count)
    found = gc.VibratingFollower(motion, train, 480)(FULL_TURN * np.arange(count) / count).x
    np.testing.assert_allclose(x, found, atol=1e-8)


def test_what_the_cam_does_in_a_turn_the_damper_takes():
    """The work of N over s is what c (s' - x')^2 turns into heat: spring and inertia give back what they took."""
    motion, train = motion_of("cycloidal"), TRAIN
    follower, omega = gc.VibratingFollower(motion, train, 700), omega_of(700)
    places, weights = np.polynomial.legendre.leggauss(12)
    ends = np.unique(np.concatenate([np.linspace(0, FULL_TURN, 400), motion.breaks]))
    half = np.diff(ends)[:, None] / 2
    phi = ((ends[:-1] + ends[1:])[:, None] / 2 + half * places).ravel()
    found, (_, v, *_) = follower(phi), motion(phi)
    work, heat = (
        np.sum((half * weights).ravel() * power)
        for power in (found.force * v, train.damper * omega * (v - found.v) ** 2)
    )
    assert work == pytest.approx(heat, rel=1e-9)
    assert heat > 0


def test_as_the_train_grows_stiff_the_force_comes_to_that_of_a_rigid_follower():
    """Of a law without jumps the difference falls as 1/k: the order is 1."""
    motion = motion_of("4-5-6-7")
    rigid = gc.Contact(motion, gc.SpringLoad(mass=0.5, speed_rpm=450, stiffness=20, preload=200))
    stiff = np.array([1e5, 1e6, 1e7])
    forces = [gc.VibratingFollower(motion, changed(stiffness=k), 450).max_force().value for k in stiff]
    off = np.abs(np.array(forces) - rigid.max_force().value)
    assert np.polyfit(np.log(stiff), np.log(off), 1)[0] == pytest.approx(-1, abs=0.02)
    assert off[-1] < 0.01


def test_at_low_speed_the_force_is_the_spring_s_alone():
    motion = motion_of("cycloidal")
    follower = gc.VibratingFollower(motion, changed(damping=0.5), 3)
    (least, *_), greatest = follower.min_force(), follower.max_force()
    assert least == pytest.approx(200, abs=0.01)
    # At rest the train and the return spring share the lift as springs in series do.
    assert greatest.value == pytest.approx(200 + 30 / (1 / 2000 + 1 / 20), abs=0.01)


# --- contact ---------------------------------------------------------------------------------------------------------


HEAVY = {"spring": 700.0, "damping": 0.4}
"""A return spring and a damper so strong that they pass the cam's velocity on."""


@over_all("law", ["rectangular", "cosine", "cycloidal", "modified-sine"])
@over_all(("rpm", "sizes"), [(240, {}), (611, {}), (1403, {}), (1403, HEAVY)])
def test_no_sample_of_the_force_is_beyond_its_extremes_and_lost_is_where_it_is_negative(law, rpm, sizes):
    follower = gc.VibratingFollower(motion_of(law), changed(preload=120.0, **sizes), rpm)
    least, greatest, lost = follower.min_force(), follower.max_force(), follower.lost()
    phi = np.linspace(0, FULL_TURN, 20_001)
    force = follower(phi).force
    size = np.abs(force).max()
    assert least.value <= force.min() + 1e-12 * size
    assert greatest.value >= force.max() - 1e-12 * size
    assert least.value == pytest.approx(force.min(), abs=1e-3 * size)
    assert greatest.value == pytest.approx(force.max(), abs=1e-3 * size)
    for found, sign in ((least, 1), (greatest, -1)):
        assert float(follower(found.phi).force) == pytest.approx(found.value, abs=1e-10 * size)
        near = follower(found.phi + np.array([-1, 1]) * np.geomspace(1e-6, 1e-2, 40)[:, None]).force
        assert np.all(sign * (near - found.value) >= -1e-11 * size)
    inside = np.any([(a < p) & (p < b) for a, b in lost for p in (phi, phi + FULL_TURN)] or [phi < 0], axis=0)
    assert np.array_equal(inside, force < 0)
    for end in np.ravel(lost):
        assert float(follower(end).force) == pytest.approx(0, abs=1e-9 * size)


@over_all("law", ["rectangular", "cycloidal"])
def test_the_least_preload_just_keeps_the_follower_on_its_cam(law):
    motion = motion_of(law)
    preload = gc.VibratingFollower(motion, TRAIN, 900).least_preload()
    kept, lost = (gc.VibratingFollower(motion, changed(preload=preload * times), 900) for times in (1.0, 0.99))
    assert kept.min_force().value == pytest.approx(0, abs=1e-9 * preload)
    assert kept.lost() == []
    assert len(lost.lost()) >= 1
    whole = gc.VibratingFollower(motion, changed(preload=-1e6), 900)
    assert whole.lost() == [pytest.approx((0, FULL_TURN))]


def test_a_loss_over_the_end_of_the_turn_is_one_interval():
    """The same motion counted from another place, so that contact is lost where the turn ends."""
    plain = motion_of("rectangular")
    start = gc.VibratingFollower(plain, TRAIN, 600).lost()[0][0] + 0.02
    rise, high, back, low = plain.phases
    until = start - (185 * DEG)
    turned = gc.Motion([gc.Dwell(low.angle - until), rise, high, back, gc.Dwell(until)])
    intervals = gc.VibratingFollower(turned, TRAIN, 600).lost()
    assert intervals[-1][0] < FULL_TURN < intervals[-1][1]
    plain_lost = gc.VibratingFollower(plain, TRAIN, 600).lost()
    assert [b - a for a, b in sorted(intervals, key=lambda ends: ends[1] - ends[0])] == pytest.approx(
        sorted(b - a for a, b in plain_lost), rel=1e-7
    )


def test_at_speed_the_cycloidal_law_needs_less_preload_than_the_rectangular_one():
    """The lesson of notebook 12: without vibrations the smaller acceleration, with them the smoother one."""
    needed = {
        law: gc.VibratingFollower(motion_of(law), TRAIN, 900).least_preload() for law in ("rectangular", "cycloidal")
    }
    rigid = {law: gc.spring_preload(motion_of(law), 0.5, 900, 20).preload for law in needed}
    assert rigid["rectangular"] < rigid["cycloidal"]
    assert needed["cycloidal"] < needed["rectangular"]


def test_a_cam_of_arcs_and_a_measured_motion_are_followed_too():
    arcs = gc.three_arc_cam(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, A=(0, 40))[0]
    for motion in (gc.ArcMotion(arcs, 10.0, 0.5), gc.builtin_task("measured").motion()):
        follower = gc.VibratingFollower(motion, TRAIN, 300)
        phi = np.linspace(0.01, 6.2, 501)
        found, (s, v, *_) = follower(phi), motion(phi)
        elastic = TRAIN.stiffness * (s - found.x) + TRAIN.damper * omega_of(300) * (v - found.v)
        np.testing.assert_allclose(found.force, TRAIN.preload + elastic, atol=1e-9 * np.abs(found.force).max())
        assert follower.min_force().value <= found.force.min()


def test_the_ratio_of_a_rise_is_its_time_over_the_natural_period():
    """80 degrees at 1200 rpm take 80/360/20 s; the period is that of mass and both springs."""
    period = math.tau * math.sqrt(0.5 / (2020 * 1000))
    assert TRAIN.rise_ratio(80 * DEG, 1200) == pytest.approx(80 / 360 / 20 / period, rel=1e-14)
    assert TRAIN.natural_frequency == pytest.approx(1 / period, rel=1e-14)
    with pytest.raises(gc.DesignError, match="angle is 0, but must be a finite number greater than 0 rad"):
        TRAIN.rise_ratio(0, 1200)
    # The logarithmic decrement of what is left in the long dwell is that of the given damping ratio.
    follower = gc.VibratingFollower(motion_of("rectangular"), TRAIN, 600)
    turning = FULL_TURN / follower.vibrations / math.sqrt(1 - 0.05**2)
    first, second = follower([190 * DEG, 190 * DEG + turning]).x
    assert math.log(first / second) == pytest.approx(2 * math.pi * 0.05 / math.sqrt(1 - 0.05**2), rel=1e-9)


def test_shapes_and_nan():
    follower = gc.VibratingFollower(motion_of("3-4-5"), TRAIN, 600)
    assert follower(1.0).x.shape == follower(1.0).force.shape == ()
    assert follower(np.zeros((2, 3))).a.shape == (2, 3)
    found = follower([0.5, math.nan])
    assert np.isnan([found.x, found.force, found.a]).tolist() == [[False, True]] * 3


def test_few_lines_tell_what_was_found():
    assert repr(gc.VibratingFollower(motion_of("cycloidal"), TRAIN, 600)).splitlines() == [
        "VibratingFollower at 600 rpm",
        "  train of 0.5 kg and 2000 N/mm, damping ratio 0.05",
        "  natural frequency 319.9 Hz, 31.99 vibrations in a turn",
        "  least force on the cam 134.2 N at 188°",
        "  keeps contact",
        "follower(phi) gives x, v, a, deviation and force at phi in rad; .plot() draws them",
    ]
    assert "leaves the cam at 187" in repr(gc.VibratingFollower(motion_of("rectangular"), TRAIN, 600))


# --- what cannot be --------------------------------------------------------------------------------------------------


@over_all(
    ("change", "message"),
    [
        ({"mass": -0.5}, "mass is -0.5, but must be a finite number greater than 0 kg"),
        ({"mass": 0.0}, "mass is 0.0"),
        ({"stiffness": 0.0}, "stiffness is 0.0, but .* greater than 0 N/mm; a rigid follower is gc.Contact"),
        ({"stiffness": math.inf}, "stiffness is inf"),
        ({"damping": -0.05}, "damping is -0.05, but must be a ratio to the critical damping from 0 to 10; 2 % is 0.02"),
        ({"damping": 50}, "damping is 50"),
        ({"spring": -1.0}, "spring is -1.0, but must be a finite number of 0 N/mm or more"),
        ({"preload": math.nan}, "preload is nan, but must be a finite number of N"),
    ],
)
def test_trains_that_cannot_be_are_refused_with_reason(change, message):
    with pytest.raises(gc.DesignError, match=message):
        changed(**change)


@over_all(
    ("train", "rpm", "message"),
    [
        (TRAIN, 0.0, "speed_rpm is 0.0, but must be a finite number greater than 0 rpm"),
        (TRAIN, -600.0, "speed_rpm is -600.0"),
        (TRAIN, math.nan, "speed_rpm is nan"),
        (TRAIN, 0.1, "at most 10000 natural vibrations fit into a turn; a rigid follower is gc.Contact"),
        (changed(damping=0.0), TRAIN.natural_frequency * 3, "off resonance: 20 natural .* give the train damping"),
    ],
)
def test_speeds_that_cannot_be_are_refused_with_reason(train, rpm, message):
    with pytest.raises(gc.DesignError, match=message):
        gc.VibratingFollower(motion_of("cosine"), train, rpm)

"""Friction between cam and follower, for every follower: against statics of the contact, powers, and known cases."""

from __future__ import annotations

import math
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from numpy.testing import assert_allclose
from over_all import over_all

import graphcam as gc
from graphcam.mechanism.forces import transmission
from graphcam.mechanism.turn_extremes import places_in, smooth_pieces

DEG = math.pi / 180
MU = 0.12
KINDS = ("translating", "knife edge", "oscillating", "long roller", "flat-faced")
ROTATIONS = ("ccw", "cw")
EVERY = pytest.mark.parametrize(("kind", "rotation"), [(kind, way) for kind in KINDS for way in ROTATIONS])
TABLE = gc.LoadCurve(np.radians([0, 50, 130, 140, 360]), [20, 20, 60, 25, 20])


def cam_of(kind: str, rotation: str = "ccw") -> gc.Cam:
    arm = kind in ("oscillating", "long roller")
    lift = 18 * DEG if arm else 22.0
    laws = ("3-4-5", "cycloidal")
    motion = gc.Motion([gc.Rise(lift, 110 * DEG, laws[0]), gc.Dwell(40 * DEG), gc.Return(lift, 130 * DEG, laws[1]),
                        gc.Dwell(80 * DEG)])  # fmt: skip
    follower = {
        "translating": gc.Translating(6.0 if rotation == "ccw" else -6.0, 9.0),
        "knife edge": gc.Translating(0.0, 0.0),
        "oscillating": gc.Oscillating(90.0, 110.0, 9.0),
        "long roller": gc.Oscillating(60.0, 95.0, 25.0),
        "flat-faced": gc.FlatFaced(),
    }[kind]
    return gc.Cam(motion, follower, 55.0, rotation)


def load_of(kind: str, **changes) -> gc.SpringLoad | gc.ArmLoad:
    if kind in ("oscillating", "long roller"):
        return gc.ArmLoad(**{"inertia": 1500, "speed_rpm": 200, "stiffness": 9000, "preload": 9000} | changes)
    return gc.SpringLoad(**{"mass": 0.4, "speed_rpm": 200, "stiffness": 4, "preload": 150} | changes)


def places_of(cam: gc.Cam, n: int = 9):
    phases = np.arange(len(cam.motion.phases))[:, None]
    return places_in(cam.motion, phases, np.linspace(0.02, 0.98, n))


def contact_of(cam: gc.Cam, values) -> tuple[np.ndarray, np.ndarray]:
    """The point of contact in the frame, and the normal from the cam into the follower, as complex numbers."""
    z, normal = cam.kinematics.point(values), cam.kinematics.normal(values)
    return z - cam.roller_radius * normal, normal


@EVERY
def test_the_follower_moves_under_the_forces_at_its_point_of_contact(kind, rotation):
    """Statics as they stand: N along the normal, mu N along the profile in the cam's sense; of an arm, moments."""
    cam, load = cam_of(kind, rotation), load_of(kind, acceleration=-30.0, load=TABLE)
    forces, places = gc.CamForces(cam, load, friction=MU), places_of(cam)
    found, (at, normal) = forces.of(places), contact_of(cam, places.values)
    push = found.normal * normal * (1 + 1j * cam.sigma * MU)
    s, v, a, _ = places.values
    omega = 200 * math.tau / 60
    if isinstance(cam.follower, gc.Oscillating):
        lever = at - cam.follower.distance
        turned = -(np.conj(lever) * push).imag  # s grows clockwise
        inertia = 1.5 * (a * omega**2 - 30 * v)
        assert_allclose(turned, inertia + 9000 + 9000 * s + cam.follower.arm * TABLE(places.phi), rtol=1e-12)
    else:
        inertia = 4e-4 * (a * omega**2 - 30 * v)
        assert_allclose(push.imag, inertia + 150 + 4 * s + TABLE(places.phi), rtol=1e-12)
    assert_allclose(found.along**2 + found.side**2, found.normal**2, rtol=1e-13)
    assert_allclose(found.contact_friction, MU * found.normal, rtol=1e-15)


@EVERY
def test_the_torque_is_the_moment_of_the_contact_forces_about_the_cam_centre(kind, rotation):
    """Found by virtual power; here by statics of the cam: what drives it balances what the follower does to it."""
    cam = cam_of(kind, rotation)
    forces, places = gc.CamForces(cam, load_of(kind, load=TABLE), friction=MU), places_of(cam)
    found, (at, normal) = forces.of(places), contact_of(cam, places.values)
    push = found.normal * normal * (1 + 1j * cam.sigma * MU)
    moment = cam.sigma * (np.conj(at) * push).imag
    assert_allclose(found.torque, moment, rtol=1e-11, atol=1e-10 * np.abs(moment).max())


@EVERY
def test_the_friction_always_takes_power(kind, rotation):
    """The cam slides past the follower in its own sense: of the driving power friction takes mu N times that speed."""
    cam = cam_of(kind, rotation)
    places = places_of(cam, 31)
    rubbing, smooth = (gc.CamForces(cam, load_of(kind), friction=mu).of(places) for mu in (MU, 0.0))
    passed = rubbing.load * places.values[1]
    assert np.all(rubbing.torque > passed)
    assert_allclose(smooth.torque, smooth.load * places.values[1], rtol=1e-12, atol=1e-9)
    speed, slope = cam.kinematics.sliding(places.values, cam.roller_radius)
    assert np.all(speed > 0)
    assert_allclose(rubbing.torque - passed, MU * rubbing.normal * speed, rtol=1e-10)
    step = 1e-5
    inner = places_in(cam.motion, 0, np.linspace(0.1, 0.9, 7))
    ahead, behind = (cam.kinematics.sliding(cam.motion(inner.phi + d), cam.roller_radius)[0] for d in (step, -step))
    _, slope = cam.kinematics.sliding(inner.values, cam.roller_radius)
    assert_allclose((ahead - behind) / (2 * step), slope, rtol=1e-6, atol=1e-5)


@EVERY
def test_a_conservative_load_takes_no_work_over_the_turn_without_friction(kind, rotation):
    """Inertia at a constant speed, springs and a constant load give back on the return what they took on the rise."""
    cam, load = cam_of(kind, rotation), load_of(kind, load=30.0)
    free = gc.CamForces(cam, load)
    peak = free.max_torque().value
    assert abs(gc.mean_torque(free)) <= 1e-12 * peak
    rubbing = gc.CamForces(cam, load, friction=MU)
    assert gc.mean_torque(rubbing) > 1e-3 * peak
    assert rubbing.min_torque().value < gc.mean_torque(rubbing) < rubbing.max_torque().value


@over_all("kind", ["translating", "oscillating", "flat-faced"])
def test_the_mean_torque_is_the_integral_by_another_rule(kind):
    """Romberg's sums over every smooth piece, knots of the load among their ends; with a guide, its corners blur."""
    cam, load = cam_of(kind), load_of(kind, load=TABLE, acceleration=40.0)
    guide = gc.Guide(0.1, 80, 90) if kind != "oscillating" else gc.Guide(0.0, 0.0, 1.0)
    for given, close in ((gc.Guide(0.0, 0.0, 1.0), 1e-10), (guide, 1e-6)):
        forces = gc.CamForces(cam, load, given, friction=MU)
        phase, low, high = smooth_pieces(cam.motion, forces.pressing.knots)
        total = 0.0
        share = np.linspace(0, 1, 1025)
        for k, a, b in zip(phase, low, high, strict=True):
            u = a + (b - a) * share
            torque = np.append(forces.at(k, u[:-1]).torque, forces.at(k, u[-1:], "left").torque)
            rows = [np.trapezoid(torque[:: 2**n], dx=2.0**n / 1024) for n in range(5)]
            for order in range(1, 5):
                rows = [fine + (fine - coarse) / (4**order - 1) for fine, coarse in pairwise(rows)]
            total += rows[0] * (b - a) * cam.motion.phases[k].angle
        assert gc.mean_torque(forces) == pytest.approx(total / math.tau, rel=close)


@EVERY
def test_dense_sampling_never_exceeds_the_extremes(kind, rotation):
    cam = cam_of(kind, rotation)
    for load in (load_of(kind), load_of(kind, load=TABLE, acceleration=60.0)):
        forces = gc.CamForces(cam, load, friction=MU)
        phases = np.arange(len(cam.motion.phases))[:, None]
        sampled = [forces.at(phases, np.linspace(0, 1, 2001), side) for side in ("left", "right")]
        for name in ("normal", "torque"):
            values = np.concatenate([getattr(each, name) for each in sampled])
            size = np.abs(values).max()
            greatest, least = (getattr(forces, f"{which}_{name}")().value for which in ("max", "min"))
            assert least - 1e-12 * size <= values.min() <= least + 1e-5 * size
            assert greatest - 1e-5 * size <= values.max() <= greatest + 1e-12 * size


@EVERY
def test_the_margin_of_jamming_is_the_least_transmission(kind, rotation):
    """Just below the friction that the message names the follower moves, just above it jams; the place is told."""
    cam = cam_of(kind, rotation)
    margin = gc.jamming_margin(cam, 0.3)
    sampled = transmission(cam, cam.motion(np.linspace(0, math.tau, 5001)), 0.3)[0]
    assert margin.value <= sampled.min() + 1e-14
    assert margin.value == pytest.approx(sampled.min(), abs=1e-6)
    assert float(transmission(cam, cam.motion(margin.phi, margin.side), 0.3)[0]) == pytest.approx(margin.value)
    if kind in ("flat-faced", "long roller"):
        assert gc.jamming_margin(cam, 50.0).value > 0 or kind == "long roller"
        return
    with pytest.raises(gc.DesignError, match=r"friction is 50.*at a cam angle of [\d.]+ degrees") as caught:
        gc.CamForces(cam, load_of(kind), friction=50.0).max_normal()
    alpha = np.abs(cam.pressure_angle(np.linspace(0, 110 * DEG, 20001))).max()
    most = float(caught.value.limit.split()[3])
    if cam.roller_radius == 0 or kind == "translating":
        assert most == pytest.approx(1 / math.tan(alpha), rel=1e-3)
    assert gc.jamming_margin(cam, most * 0.999).value > 0 > gc.jamming_margin(cam, most * 1.001).value


def test_friction_with_a_guide_is_in_equilibrium():
    """Two bearings, friction in both and at the cam: three equations solved as they stand, of roller and face."""
    guide = gc.Guide(0.1, 80.0, 90.0)
    for kind in ("translating", "flat-faced"):
        cam = cam_of(kind)
        forces = gc.CamForces(cam, load_of(kind), guide, friction=MU)
        for k, direction in ((0, 1), (2, -1)):
            places = places_in(cam.motion, k, np.linspace(0.05, 0.95, 9))
            found, (at, normal) = forces.of(places), contact_of(cam, places.values)
            for i in range(9):
                middle = 1j * cam.kinematics.point(tuple(each[i] for each in places.values)).imag + getattr(
                    cam.follower, "offset", 0.0
                )
                push, lever = normal[i] * (1 + 1j * MU), at[i] - middle
                signs = np.sign([found.near[i], found.far[i]])
                b = guide.overhang - places.values[0][i]
                # The bearings press across: near to the right (against the cam's drag to the left), far to the left.
                across, along = (
                    [push.real, 1, -1],
                    [push.imag, -direction * 0.1 * signs[0], -direction * 0.1 * signs[1]],
                )
                moment = [(np.conj(lever) * push).imag, -b, b + 90]
                solved = np.linalg.solve([across, along, moment], [0, found.load[i], 0])
                assert_allclose([found.normal[i], found.near[i], found.far[i]], solved, rtol=1e-10)


def test_forty_digits_confirm_the_normal_force_of_an_arm():
    """N and M of an arm with a spring at a point, from the geometry alone, its derivatives by mpmath."""
    cam = cam_of("oscillating", "cw")
    spring = gc.ArmSpring(arm=70.0, anchor=(100.0, -30.0))
    load = gc.ArmLoad(1500, 200, stiffness=6, preload=140, acceleration=25.0, load=12.0, at=spring)
    forces = gc.CamForces(cam, load, friction=MU)
    with mpmath.workdps(40):
        arm, c, r = mpmath.mpf(90), mpmath.mpf(110), 9
        lift, angle = mpmath.mpf(18 * DEG), mpmath.mpf(110 * DEG)
        psi0 = mpmath.acos((c**2 + arm**2 - mpmath.mpf(55) ** 2) / (2 * c * arm))

        def s(phi):
            u = phi / angle
            return lift * u**3 * (10 - 15 * u + 6 * u**2)

        def trace(phi):
            return c - arm * mpmath.expj(-(psi0 + s(phi)))

        def length(phi):
            return abs(c - 70 * mpmath.expj(-(psi0 + s(phi))) - mpmath.mpc(100, -30))

        omega = 200 * 2 * mpmath.pi / 60
        for u in (0.2, 0.5, 0.8):
            phi = mpmath.mpf(u * 110 * DEG)
            v, a = mpmath.diff(s, phi), mpmath.diff(s, phi, 2)
            tangent = mpmath.diff(trace, phi) + 1j * trace(phi)  # of the pitch curve, seen in the frame; sigma = -1
            normal = -1j * tangent / abs(tangent)
            assert mpmath.re(normal * mpmath.conj(trace(phi))) > 0
            push, at = normal * (1 - 1j * mpmath.mpf(MU)), trace(phi) - r * normal
            lever = -mpmath.im(mpmath.conj(at - c) * push)
            stretch = length(phi) - length(0)
            way = 1 if stretch > 0 else -1
            spring_torque = (140 + 6 * way * stretch) * way * mpmath.diff(length, phi) / v
            torque = mpmath.mpf(1500) / 1000 * (a * omega**2 + v * 25) + spring_torque + 12 * arm
            found = forces.at(0, u)
            assert abs(float(torque / lever / mpmath.mpf(float(found.normal)) - 1)) < 1e-13
            moment = -mpmath.im(mpmath.conj(at) * push) * torque / lever
            assert abs(float(moment / mpmath.mpf(float(found.torque)) - 1)) < 1e-12


@over_all("anchor", [(100.0, -30.0), (60.0, 200.0)])
def test_a_spring_at_a_point_keeps_its_energy(anchor):
    """Its torque is the derivative of F0 x + c x^2/2, whether it is drawn out or pressed together; slopes follow."""
    cam = cam_of("oscillating")
    load = gc.ArmLoad(0, 0, stiffness=6, preload=140, at=gc.ArmSpring(70.0, anchor))
    placed = cam.kinematics.pressed_by(load)
    start = cam.kinematics.psi0
    tip = lambda s: np.abs(110 - 70 * np.exp(-1j * (start + s)) - complex(*anchor))  # noqa: E731
    x = lambda s: np.abs(tip(s) - tip(0.0))  # noqa: E731
    energy = lambda s: 140 * x(s) + 3 * x(s) ** 2  # noqa: E731
    s, step = np.linspace(0.05, 0.25, 6), 1e-5
    values = (s, np.ones(6), 0 * s, 0 * s)
    assert_allclose(placed.force(values), (energy(s + step) - energy(s - step)) / (2 * step), rtol=1e-7)
    shifted = [placed.force((s + d, *values[1:])) for d in (step, -step)]
    assert_allclose(placed.slope(values), (shifted[0] - shifted[1]) / (2 * step), rtol=1e-7)
    weight, weight_slope = placed.leverage(values)
    assert_allclose(placed.force(values), (140 + 6 * x(s)) * weight, rtol=1e-12)
    shifted = [placed.leverage((s + d, *values[1:]))[0] for d in (step, -step)]
    assert_allclose(weight_slope, (shifted[0] - shifted[1]) / (2 * step), rtol=1e-6)
    assert_allclose(placed.spring_force(values), 140 + 6 * x(s), rtol=1e-12)


@EVERY
def test_with_the_least_preload_the_normal_force_just_reaches_zero(kind, rotation):
    cam = cam_of(kind, rotation)
    springs = [None, gc.ArmSpring(70.0, (100.0, -30.0))] if isinstance(cam.follower, gc.Oscillating) else [None]
    for spring in springs:
        given = {"speed_rpm": 900, "load": TABLE, "acceleration": 90.0}
        if spring:
            given |= {"stiffness": 6.0, "at": spring}
        least = gc.spring_preload(cam, load_of(kind, **given))
        assert least.preload > 0
        forces = gc.CamForces(cam, load_of(kind, **given, preload=least.preload), friction=MU)
        lowest = forces.min_normal()
        assert abs(lowest.value) <= 1e-10 * forces.max_normal().value
        assert lowest.phi == pytest.approx(least.phi, abs=1e-6)
        slack = gc.CamForces(cam, load_of(kind, **given, preload=0.99 * least.preload), friction=MU)
        assert slack.min_normal().value < 0


def test_the_least_preload_of_the_publication_does_not_depend_on_friction():
    """Voloder, Cohodar and Karic 2007 print 69.2292 N with omega rounded to 57.5958; 69.2296177 N unrounded."""
    motion = gc.Motion([gc.Rise(30, 45 * DEG, "cosine"), gc.Dwell(45 * DEG), gc.Return(30, 45 * DEG, "cosine"),
                        gc.Dwell(225 * DEG)])  # fmt: skip
    cam = gc.Cam(motion, gc.Translating(), 90)
    load = gc.SpringLoad(0.2, 550, 3)
    assert gc.spring_preload(cam, load).preload == pytest.approx(69.229617670908319, rel=1e-13)
    assert gc.spring_preload(cam, load) == gc.spring_preload(motion, 0.2, 550, 3)


def test_the_middle_of_the_rise_of_the_published_cam_with_preload_and_friction():
    """The published cam at 22.5 degrees, F0 = 80 N, mu = 0.1.  By hand the cosine law gives s = 15, v = 60, a = 0: the
    load is 80 + 3 * 15 = 125 N, and under a central knife edge tan(alpha) = 60/(r0 + 15).  The prime radius stands in
    no reference case: 45 mm is assumed, so that alpha is 45 degrees; then N = 125/(0.9 cos 45)."""
    motion = gc.Motion([gc.Rise(30, 45 * DEG, "cosine"), gc.Dwell(45 * DEG), gc.Return(30, 45 * DEG, "cosine"),
                        gc.Dwell(225 * DEG)])  # fmt: skip
    cam = gc.Cam(motion, gc.Translating(), prime_radius=45)
    at = gc.CamForces(cam, gc.SpringLoad(0.2, 550, 3, preload=80), friction=0.1).at(0, 0.5)
    assert math.degrees(at.phi) == pytest.approx(22.5)
    assert math.degrees(cam.pressure_angle(22.5 * DEG)) == pytest.approx(45, abs=1e-12)
    assert float(at.load) == pytest.approx(125, rel=1e-14)
    assert float(at.transmission) == pytest.approx(0.9 * math.sqrt(0.5), rel=1e-14)
    assert float(at.normal) == pytest.approx(125 / 0.9 * math.sqrt(2), rel=1e-14)
    assert float(at.torque) == pytest.approx(125 * 60 + 0.1 * float(at.normal) * math.hypot(60, 60), rel=1e-13)


def test_without_friction_nothing_but_the_normal_acts():
    """CamForces of a translating follower is what it was before it knew friction at the cam."""
    cam, load = cam_of("translating"), load_of("translating")
    places = places_of(cam)
    found = gc.CamForces(cam, load).of(places)
    alpha = cam.pressure_angle(places.phi)
    assert_allclose(found.normal, load.force(places.values) / np.cos(alpha), rtol=1e-13)
    assert_allclose(found.transmission, np.cos(alpha), rtol=1e-13)
    assert not found.contact_friction.any()


@over_all(
    ("make", "words"),
    [
        (lambda: gc.CamForces(cam_of("flat-faced"), load_of("flat-faced"), friction=-0.1), "friction -0.1 0 or more"),
        (lambda: gc.CamForces(cam_of("oscillating"), load_of("translating")), "load SpringLoad an ArmLoad inertia"),
        (lambda: gc.CamForces(cam_of("flat-faced"), load_of("oscillating")), "load ArmLoad a SpringLoad slides"),
        (
            lambda: gc.CamForces(cam_of("oscillating"), load_of("oscillating"), gc.Guide(0.1, 50, 50)),
            "follower oscillating guide leave the guide out",
        ),
        (lambda: gc.ArmLoad(-1, 100, 5), "inertia is -1 0 kg mm^2 or more"),
        (lambda: gc.SpringLoad(-1, 100, 5), "mass is -1 0 kg or more"),
        (lambda: gc.ArmLoad(1, 100, -5, at=gc.ArmSpring(5, (1, 1))), "stiffness is -5 N/mm"),
        (lambda: gc.ArmLoad(1, 100, 5, preload=math.inf), "preload inf N mm"),
        (lambda: gc.ArmSpring(0, (1, 1)), "at.arm is 0 pivot turns nothing"),
        (lambda: gc.ArmSpring(5, (math.nan, 1)), "at.anchor finite"),
        (lambda: gc.SpringLoad(1, 1, 1, load=math.inf), "load is inf table over the turn"),
        (lambda: gc.LoadCurve([0, 3], [1, 1]), "load 171.887 degrees covers the turn 360"),
        (lambda: gc.LoadCurve([], []), "load without a row covers the turn"),
        (lambda: gc.LoadCurve([0, 2, 2, math.tau], [1, 2, 3, 1]), "load grow from row to row steep"),
        (lambda: gc.LoadCurve([0, math.tau], [1, 2]), "load 1 N 2 N the same at both"),
        (lambda: gc.LoadCurve([0, math.nan, math.tau], [1, 2, 1]), "load finite"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_named(make, words):
    with pytest.raises(gc.DesignError) as caught:
        make()
    message = str(caught.value)
    assert all(word in message for word in words.split()), message


def test_a_spring_that_passes_over_the_pivot_is_refused_with_the_angle():
    """Point, pivot and anchor on one line: the spring turns nothing there, and past it lifts the arm off the cam."""
    cam = cam_of("oscillating")
    psi0 = cam.kinematics.psi0
    for swung, refused in ((0.0, True), (10.0, True), (17.9, True), (18.5, False), (-0.5, False)):
        anchor = 110 + 80 * np.exp(-1j * (psi0 + swung * DEG))
        load = gc.ArmLoad(1, 100, 5, at=gc.ArmSpring(40, (anchor.real, anchor.imag)))
        if not refused:
            assert gc.CamForces(cam, load).pressing.leverage(cam.motion(0.5))[0] > 0
            continue
        with pytest.raises(gc.DesignError, match=r"at\.anchor is .* passes over the pivot, after") as caught:
            gc.CamForces(cam, load)
        assert float(caught.value.limit.split()[-2]) == pytest.approx(swung, abs=1e-3)


def test_a_table_of_loads_is_straight_between_its_rows_and_repeats():
    """np.interp is the reference."""
    phi = np.linspace(-1, 9, 301)
    assert_allclose(TABLE(phi), np.interp(phi % math.tau, TABLE.phi, TABLE.force), rtol=1e-14)
    assert math.isnan(float(TABLE(math.nan)))
    assert gc.SpringLoad(1, 0, 0, load=TABLE).knots == TABLE.phi
    assert math.isnan(float(gc.SpringLoad(1, 0, 0, load=TABLE).force(gc.builtin_task().motion()(1.0))))  # no angle


@EVERY
def test_the_mean_power_is_what_damping_takes(kind, rotation):
    """Of a constant speed and no friction: inertia and spring give back what they take, and d v^2 is lost."""
    damping = 4000.0 if kind in ("oscillating", "long roller") else 30.0
    cam = cam_of(kind, rotation)
    load = load_of(kind, damping=damping)
    taken = gc.mean_torque(gc.CamForces(cam, load)) * load.omega
    nodes, weights = np.polynomial.legendre.leggauss(16)
    places = places_in(cam.motion, np.arange(len(cam.motion.phases))[:, None], (nodes + 1) / 2)
    speed = places.values[1] * load.omega
    per_turn = np.sum(cam.motion.angles[:, None] / 2 * weights * speed**2) / math.tau
    # Of an arm N mm s/rad, else N s/m with mm/s.
    lost = damping * per_turn * (1.0 if cam.kinematics.swings else 1e-3)
    assert taken == pytest.approx(lost, rel=1e-12)


@EVERY
def test_the_slope_of_a_damped_load_is_its_derivative(kind, rotation):
    cam = cam_of(kind, rotation)
    pressing = cam.kinematics.pressed_by(load_of(kind, damping=50.0, acceleration=-30.0))
    u, step = np.linspace(0.1, 0.9, 9), 1e-6
    for k, angle in enumerate(cam.motion.angles):
        after, before = (pressing.force(cam.motion.at(k, u + d)) for d in (step, -step))
        slope = pressing.slope(cam.motion.at(k, u))
        assert_allclose(slope, (after - before) / (2 * step * angle), rtol=1e-6, atol=1e-5 * np.abs(slope).max() + 1e-6)


def test_damping_asks_for_preload_where_the_follower_goes_down():
    """With it the least preload is that of a dense search, and more than without."""
    cam = cam_of("translating")
    without, damped = load_of("translating"), load_of("translating", damping=200.0)
    found = gc.spring_preload(cam, damped).preload
    places = places_of(cam, 20001)
    assert found == pytest.approx(np.max(150 - damped.force(places.values)), rel=1e-7)
    assert found > gc.spring_preload(cam, without).preload

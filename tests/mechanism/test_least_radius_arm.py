"""The least radius of an arm against its definition at 50 digits, against SLSQP, and against the cam that it promises.

The definition here is by the centre of relative rotation: cam and arm turn about it against each other, it lies on the
line of centres, and the normal of the contact passes through it.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import acos, atan2, cos, diff, findroot, matrix, mpf, sin
from over_all import over_all, pairs
from reference import lift_of, maximum, turned
from scipy.optimize import minimize

from graphcam.errors import DesignError
from graphcam.given.follower import Oscillating
from graphcam.given.laws import LAWS
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import minimum_radius

DEG = math.pi / 180
SENSE = {"ccw": 1, "cw": -1}
ARM = 100.0


def motion_of(name: str, swing: float = 20, rise: float = 80, back: float = 70, ratio: float = 1.0) -> Motion:
    rest = 360 - rise - 45 - back
    up, down = Rise(swing * DEG, rise * DEG, name, ratio), Return(swing * DEG, back * DEG, name, ratio)
    return Motion([up, Dwell(45 * DEG), down, Dwell(rest * DEG)])


def stairs() -> Motion:
    """Levels above zero, several rises and returns, different laws; it begins on its way down."""
    angles = [0.9, 0.5, 0.8, 0.4, 1.3]
    return Motion(
        [
            Return(0.12, angles[0], "cycloidal"), Rise(0.2, angles[1], "trapezoidal"), Dwell(angles[2]),
            Return(0.25, angles[3], "rectangular", 3.0), Rise(0.17, angles[4], "modified-sine"),
            Dwell(FULL_TURN - math.fsum(angles)),
        ]
    )  # fmt: skip


MOTIONS = [*(motion_of(name) for name in LAWS), motion_of("rectangular", ratio=2.5), stairs()]
LIMITS = [(45, None, True), (45, None, False), (45, 45, True), (35, 60, False), (50, 30, True)]


def pressure_angle(s, v, distance, r0, sigma):
    """Between the arm's normal and the common normal, which passes through the centre of relative rotation."""
    c, arm = mpf(distance), mpf(ARM)
    psi = acos((c * c + arm * arm - mpf(r0) ** 2) / (2 * c * arm)) + s
    x, y = c - arm * cos(psi), arm * sin(psi)
    centre = v * c / (sigma + v)  # there the cam's speed sigma x is the arm's, v (c - x)
    nx, ny = x - centre, y
    mx, my = sin(psi), cos(psi)
    side = 1 if nx * mx + ny * my > 0 else -1
    return atan2(side * (mx * ny - my * nx), side * (mx * nx + my * ny))


def velocity_and_lift(phase, level):
    """s and v of a phase as functions of its fraction u."""

    def s(u):
        return level + phase.direction * mpf(phase.lift) * lift_of(phase, u)

    return s, lambda u: diff(s, u) / mpf(phase.angle)


INSIDE = mpf(10) ** -18, 1 - mpf(10) ** -18


def over_the_limits(motion, distance, r0, sigma, limits) -> dict[str, mpf]:
    """How far the angle comes over its limit, on the side that the velocity drives it to, and at the rests."""
    rise, back, rest = limits
    found: dict[str, list] = {"rise": [], "return": [], "rest": []}
    level = -min_level(motion)
    for phase in motion.phases:
        if (limit := {1: rise, 0: None, -1: back}[phase.direction]) is not None:
            s, v = velocity_and_lift(phase, level)
            drives = sigma * phase.direction

            def driven(u, s=s, v=v, drives=drives):
                return drives * pressure_angle(s(u), v(u), distance, r0, sigma)

            ends = [drives * pressure_angle(s(u), mpf(0), distance, r0, sigma) for u in (0, 1)]
            found[phase.kind].append(max(maximum(driven, *INSIDE), *ends) - mpf(limit * DEG))
            if rest:
                found["rest"].append(-min(ends) - mpf(limit * DEG))
        level += phase.direction * mpf(phase.lift)
    return {name: max(values) for name, values in found.items() if values}


def min_level(motion):
    levels = np.cumsum([0.0, *(p.direction * p.lift for p in motion.phases)])
    return mpf(float(levels.min()))


def least(motion, rotation, limits, distance=None):
    rise, back, rest = limits
    return minimum_radius(
        motion, Oscillating(ARM, distance), rotation, rise=rise * DEG,
        return_=None if back is None else back * DEG, rest=rest,
    )  # fmt: skip


@pytest.mark.slow
@over_all(("k", "limits"), pairs(range(len(MOTIONS)), LIMITS))
def test_the_pressure_angle_just_reaches_its_limit(k, limits):
    """What binds is at its limit to rounding, nothing is beyond; for the free distance and for one beside it."""
    motion, rotation = MOTIONS[k], ("ccw", "cw")[k % 2]
    free = least(motion, rotation, limits)
    for found in (free, least(motion, rotation, limits, 1.3 * free.distance)):
        if not found.active:
            assert found.prime_radius == abs(found.distance - ARM)
            continue
        over = over_the_limits(motion, found.distance, found.prime_radius, SENSE[rotation], limits)
        assert max(over.values()) <= 1e-14
        assert all(abs(over[name]) <= 1e-14 for name in found.active)


@over_all("name", ["rectangular", "3-4-5", "modified-sine"])
def test_least_radius_and_distance_to_50_digits_where_rise_and_return_bind(name):
    motion, limits = motion_of(name), (45, 45, True)
    found = least(motion, "ccw", limits)
    assert found.active == ("rise", "return")

    def over(distance, r0):
        at = over_the_limits(motion, distance, r0, +1, limits)
        return [at["rise"], at["return"]]

    distance, r0 = findroot(over, (mpf(found.distance), mpf(found.prime_radius)), tol=1e-40)
    assert abs(found.prime_radius / r0 - 1) <= 1e-14
    assert abs(found.distance / distance - 1) <= 1e-14


@over_all("name", LAWS)
@over_all("rotation", ["ccw", "cw"])
def test_least_radius_to_50_digits_where_the_rise_alone_binds(name, rotation):
    """The foot of the perpendicular on the farthest line: each goes through an end of l v, at the limit to a normal."""
    motion, limit = motion_of(name), 45
    found = least(motion, rotation, (limit, None, False))
    assert found.active == ("rise",)
    s, v = velocity_and_lift(motion.phases[0], mpf(0))
    sigma, start = SENSE[rotation], matrix([ARM, 0])

    def away(u):
        along, across = turned(matrix([1, 0]), -s(u)), turned(matrix([0, 1]), -s(u))
        line = turned(across, sigma * mpf(limit * DEG))
        to_start = start - ARM * (1 + sigma * v(u)) * along
        return sigma * (line[0] * to_start[1] - line[1] * to_start[0])

    assert abs(found.prime_radius / maximum(away, *INSIDE) - 1) <= 1e-14


# --- against brute force ---------------------------------------------------------------------------------------------


def stations(motion, direction, n):
    phases = [k for k, phase in enumerate(motion.phases) if phase.direction == direction]
    s, v, _, _ = (np.concatenate(x) for x in zip(*(motion.at(k, np.linspace(0, 1, n)) for k in phases), strict=True))
    return s, v


def slopes(motion, sigma, distance, psi0, direction, n=41):
    """tan(alpha) by the convention, at the stations of all rises or all returns, in the last axis."""
    s, v = stations(motion, direction, n)
    psi = np.asarray(psi0)[..., None] + s
    c = np.asarray(distance)[..., None]
    return (ARM * (1 + sigma * v) - c * np.cos(psi)) / (c * np.sin(psi))


def kept(motion, sigma, limits, distance, psi0):
    rise, back, rest = limits
    ok = psi0 + motion.lift < math.pi
    for direction, limit in ((1, rise), (-1, back)):
        if limit is not None:
            slope = sigma * direction * slopes(motion, sigma, distance, psi0, direction)
            ok &= (np.abs(slope) if rest else slope).max(axis=-1) <= math.tan(limit * DEG)
    return ok


def prime_radius(distance, psi0):
    return np.sqrt((distance - ARM) ** 2 + 4 * distance * ARM * np.sin(psi0 / 2) ** 2)


@pytest.mark.slow
@over_all("limits", LIMITS)
@over_all("rotation", ["ccw", "cw"])
@over_all("motion", [motion_of("cosine"), stairs()])
def test_no_cam_of_a_grid_is_smaller(motion, rotation, limits):
    found = least(motion, rotation, limits)
    distance, psi0 = np.meshgrid(np.linspace(40, 260, 111), np.linspace(0, math.pi, 242)[1:-1], indexing="ij")
    radii = np.where(kept(motion, SENSE[rotation], limits, distance, psi0), prime_radius(distance, psi0), np.inf)
    between_stations, between_nodes = 5e-3, 0.08
    assert found.prime_radius * (1 - between_stations) <= radii.min() <= found.prime_radius * (1 + between_nodes)
    for row, c in zip(radii[::10], distance[::10, 0], strict=True):
        if np.isinf(row.min()):
            with pytest.raises(DesignError, match=r"centre distance is .* leave it open"):
                least(motion, rotation, limits, float(c))
        else:
            fixed = least(motion, rotation, limits, float(c)).prime_radius
            assert fixed * (1 - between_stations) <= row.min() <= fixed + 1.3 * ARM * math.pi / 241


@over_all("rotation", ["ccw", "cw"])
@over_all("name", ["rectangular", "cycloidal", "3-4-5"])
def test_slsqp_on_stations_finds_the_same_and_oversteps_the_limit_between_them(name, rotation):
    motion, limits, sigma = motion_of(name), (45, 40, True), SENSE[rotation]
    found = least(motion, rotation, limits)

    def room(x):
        parts = [
            math.tan(limit * DEG) - sign * slopes(motion, sigma, x[0], x[1], direction, 360)
            for direction, limit in ((1, 45), (-1, 40))
            for sign in (1, -1)
        ]
        return np.concatenate(parts)

    best = minimize(
        lambda x: prime_radius(*x) / ARM, (1.5 * ARM, 1.0), constraints={"type": "ineq", "fun": room}, method="SLSQP",
        options={"ftol": 1e-12, "maxiter": 200},
    )  # fmt: skip
    assert best.success
    assert best.fun * ARM <= found.prime_radius * (1 + 1e-9)
    between_stations = 3e-3
    assert best.fun * ARM == pytest.approx(found.prime_radius, rel=between_stations)
    assert best.x[0] == pytest.approx(found.distance, rel=between_stations)


# --- what must hold for every arm ------------------------------------------------------------------------------------


@over_all("motion", MOTIONS)
@over_all("rotation", ["ccw", "cw"])
def test_a_cam_of_the_least_radius_keeps_its_limits(motion, rotation):
    for distance in (None, 150.0, 260.0):
        found = least(motion, rotation, (45, 60, True), distance)
        cam = Cam(motion, Oscillating(ARM, found.distance, 3.0), found.prime_radius, rotation)
        extremes = cam.extremes()
        reached = abs(extremes.pressure_angle_rise[0]) / (45 * DEG), abs(extremes.pressure_angle_return[0]) / (60 * DEG)
        assert max(reached) == pytest.approx(1, abs=1e-13)


def test_arms_of_random_motions_and_limits_just_keep_them():
    """Several laws, limits of 1 to 86 degrees, distances free and given: lines touch at starts, breaks and inside."""
    random, sized = np.random.default_rng(7), 0
    for _ in range(150):
        turns = random.uniform(0.3, 1.5, 3)
        swing, (up, down) = random.uniform(0.02, 0.6), random.choice(LAWS, 2).tolist()
        phases = [Rise(swing, turns[0], up), Return(swing, turns[1], down), Dwell(FULL_TURN - turns[0] - turns[1])]
        rise, back = random.uniform(0.02, 1.5, 2)
        distance = float(random.uniform(60, 300)) if random.random() < 0.5 else None
        try:
            found = minimum_radius(Motion(phases), Oscillating(ARM, distance), "cw", rise, back)
        except DesignError:
            continue
        sized += 1
        extremes = Cam(Motion(phases), Oscillating(ARM, found.distance), found.prime_radius, "cw").extremes()
        reached = extremes.pressure_angle_rise[0] / rise, extremes.pressure_angle_return[0] / back
        assert max(map(abs, reached)) == pytest.approx(1, abs=1e-12)
    assert sized > 80


@over_all("motion", MOTIONS)
def test_the_motion_backwards_on_the_disk_turned_back_has_the_same_least_radius(motion):
    mirrored = {"rise": Return, "return": Rise}
    phases = [
        p if isinstance(p, Dwell) else mirrored[p.kind](p.lift, p.angle, p.law, 1 / p.ratio)
        for p in reversed(motion.phases)
    ]
    there, back = least(motion, "ccw", (40, 55, True)), least(Motion(phases), "cw", (55, 40, True))
    assert back.prime_radius == pytest.approx(there.prime_radius, rel=1e-13)
    assert back.distance == pytest.approx(there.distance, rel=1e-13)


@over_all("limits", LIMITS)
@over_all("rotation", ["ccw", "cw"])
def test_given_the_least_distance_the_radius_is_the_same_and_beside_it_larger(rotation, limits):
    motion = motion_of("modified-sine")
    free = least(motion, rotation, limits)
    assert least(motion, rotation, limits, free.distance).prime_radius == pytest.approx(free.prime_radius, rel=1e-7)
    for factor in (1.001, 1.01, 1.1, 2.0):
        assert least(motion, rotation, limits, factor * free.distance).prime_radius > free.prime_radius


def test_a_longer_arm_with_the_same_swing_is_the_same_cam_enlarged():
    motion = motion_of("2-3")
    small, large = (minimum_radius(motion, Oscillating(arm), return_=50 * DEG) for arm in (40, 400))
    assert large.prime_radius == pytest.approx(10 * small.prime_radius, rel=1e-13)
    assert large.distance == pytest.approx(10 * small.distance, rel=1e-13)


def test_the_names_of_the_lines_that_bind():
    motion = motion_of("cycloidal")
    assert least(motion, "ccw", (45, None, True)).active == ("rise", "rest")
    assert least(motion, "cw", (45, None, True)).active == ("rise",)
    assert least(motion, "ccw", (45, None, False)).active == ("rise",)
    assert least(motion, "ccw", (45, 45, True)).active == ("rise", "return")
    assert least(motion, "ccw", (45, None, True), 400.0).active == ("rest",)
    assert least(motion, "ccw", (45, 20, True), 200.0).active == ("return",)


def test_45_degrees_is_the_usual_limit_of_an_arm():
    motion = motion_of("cosine")
    assert minimum_radius(motion, Oscillating(ARM)) == least(motion, "ccw", (45, None, True))


def test_without_the_rest_condition_a_large_distance_needs_no_angle_between_arm_and_centres():
    found = least(motion_of("3-4-5"), "ccw", (45, None, False), 400.0)
    assert (found.prime_radius, found.distance, found.active) == (300.0, 400.0, ())


@pytest.mark.slow
@over_all(("name", "limit"), pairs(LAWS, [0.01, 1.0, 10.0, 80.0, 89.9, 90 - 1e-6]))
def test_limits_near_0_and_90_degrees(name, limit):
    """The cam keeps the limit, and one at the same distance of a radius smaller by 1e-6 does not."""
    motion = motion_of(name, swing=min(20, 1.5 * limit))
    found = least(motion, "ccw", (limit, None, True))
    at_limit = mpf(limit * DEG)
    over = over_the_limits(motion, found.distance, found.prime_radius, +1, (limit, None, True))
    assert all(abs(over[name]) <= 1e-13 * max(at_limit, 1) for name in found.active)
    smaller = over_the_limits(motion, found.distance, found.prime_radius * (1 - 1e-6), +1, (limit, None, True))
    assert max(smaller.values()) > 0


@over_all(
    ("make", "message"),
    [
        (lambda: least(motion_of("cosine", swing=90), "ccw", (45, None, True)), "lift is 90 degrees, but .* 90 degr"),
        (lambda: least(motion_of("cosine", swing=70), "ccw", (45, 30, True)), "less than 60 degrees for these limits"),
        (lambda: least(motion_of("cosine", swing=80), "ccw", (45, 30, False)), "less than 75 degrees for these limits"),
        (lambda: least(motion_of("cosine"), "ccw", (45, None, True), 10.0), "centre distance is 10 mm, but must be"),
        (lambda: least(motion_of("cosine"), "ccw", (90, None, True)), "between 0 and 90 degrees"),
        (lambda: least(motion_of("cosine"), "ccw", (45, 0, True)), "between 0 and 90 degrees"),
        (lambda: least(motion_of("cosine"), "ccw", (math.nan, None, True)), "between 0 and 90 degrees"),
        (lambda: least(motion_of("cosine"), "ccw", (45, None, True), -10.0), "centre distance is -10"),
    ],
)
def test_what_cannot_be_is_refused_with_reason(make, message):
    with pytest.raises(DesignError, match=message):
        make()


@pytest.mark.parametrize(
    ("lift", "angles", "laws", "arm", "permitted", "curvature"),
    [
        (17.195, (73.185, 42.733, 54.48), ("cycloidal", "3-4-5"), (66.49, 83.986, 3.787), (32.138, 43.537), 26.076),
        (15.439, (75.066, 43.782, 59.577), ("3-4-5", "3-4-5"), (67.523, 83.043, 10.318), (33.473, 48.18), 26.214),
        (18.425, (116.524, 85.572, 55.723), ("cosine", "cosine"), (75.659, 84.246, 14.148), (36.977, 42.116), 28.204),
    ],
)
def test_a_radius_that_the_curvature_needs_is_refused_where_it_exceeds_a_permitted_angle(
    lift, angles, laws, arm, permitted, curvature
):
    """Of an arm a larger cam may have larger pressure angles: what the curvature needs is found here by trial."""
    rise, dwell, back = np.radians(angles)
    phases = [Rise(np.radians(lift), rise, laws[0]), Dwell(dwell), Return(np.radians(lift), back, laws[1])]
    motion = Motion([*phases, Dwell(2 * math.pi - rise - dwell - back)])
    follower, limits = Oscillating(*arm), dict(zip(("rise", "return_"), np.radians(permitted), strict=True))

    def sharpest(radius: float) -> float:
        return Cam(motion, follower, radius).extremes().min_convex_radius[0]

    # So curved is the pitch curve that its working profile has the radius of curvature asked for.
    needed = curvature + follower.roller_radius
    low = high = minimum_radius(motion, follower, **limits).prime_radius
    assert sharpest(low) < needed
    while sharpest(high) < needed:
        low, high = high, 1.02 * high
    while high - low > 1e-6:
        low, high = ((low + high) / 2, high) if sharpest((low + high) / 2) < needed else (low, (low + high) / 2)
    extremes = Cam(motion, follower, high).extremes()
    worst = extremes.pressure_angle_rise[0] - limits["rise"], abs(extremes.pressure_angle_return[0]) - limits["return_"]
    assert max(worst) > math.radians(0.05)
    with pytest.raises(DesignError, match="lengthen the centre distance"):
        minimum_radius(motion, follower, curvature=curvature, **limits)

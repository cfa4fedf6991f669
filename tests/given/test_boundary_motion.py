"""Motions by conditions against 40 digits and other programs, their soundness, and every message."""

from __future__ import annotations

import math
import pickle
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from mpmath import mp, mpf
from over_all import over_all
from scipy.interpolate import BSpline, make_interp_spline
from scipy.spatial import cKDTree

import graphcam as gc
from graphcam.given.exact_conditions import as_series, solve_exactly, value_at
from graphcam.given.impact import acceleration_jumps, velocity_jumps
from graphcam.given.piecewise_polynomial import PiecewisePolynomial
from graphcam.given.stations import divide

P, Poly, Spline = gc.MotionPoint, gc.PolynomialPart, gc.SplinePart
DEG, TURN, EPS = math.pi / 180, 2 * math.pi, 2.0**-52
REST = {"v": 0, "a": 0}


def at(degrees: float, **given: float) -> gc.MotionPoint:
    return P(degrees * DEG, **given)


def moving_at_0(v: float, a: float = 0, top: float = 90) -> list[gc.PolynomialPart]:
    """A turn of one polynomial that moves at 0 degrees, so that a phase reaches over 0."""
    joint = {"s": 10, "v": v, "a": a}
    return [Poly([at(0, **joint), at(top, s=20), at(250, s=0), at(360, **joint)])]


# --- 40 digits -------------------------------------------------------------------------------------------------------


def decimal(number: float) -> mpf:
    """A short decimal stands for itself, anything longer for the number of the machine."""
    return mpf(repr(number) if len(repr(number)) < 12 else number)


def solved_at_40_digits(points: list[tuple[float, dict[int, float]]]):
    """The polynomial through points, angles in degrees, by mpmath's solver: its Taylor coefficients in radians."""
    with mp.workdps(120):
        start = decimal(points[0][0]) * mp.pi / 180
        rows, right = [], []
        n = sum(len(given) for _, given in points)
        for degrees, given in points:
            x = decimal(degrees) * mp.pi / 180 - start
            for order, number in given.items():
                rows.append([mp.ff(k, order) * x ** (k - order) if k >= order else mpf(0) for k in range(n)])
                right.append(decimal(number))
        return start, list(mp.lu_solve(mp.matrix(rows), mp.matrix(right)))


def value_at_40_digits(start, c, phi: float, order: int):
    with mp.workdps(120):
        x = mpf(phi) - start
        return mp.fsum(mp.ff(k, order) * c[k] * x ** (k - order) for k in range(order, len(c)))


def made(points: list[tuple[float, dict[int, float]]]) -> gc.PolynomialPart:
    return Poly([P(degrees * DEG, **{"svaj"[k]: x for k, x in given.items()}) for degrees, given in points])


def sixteen(s: float) -> dict[int, float]:
    return {0: s, 1: 0, 2: 0, 3: 0}


def cycloidal(u: float) -> dict[int, float]:
    """s, v, a, j of the cycloidal rise by 30 over half a turn."""
    sine, cosine = math.sin(2 * math.pi * u), math.cos(2 * math.pi * u)
    return {
        0: 30 * (u - sine / (2 * math.pi)),
        1: 30 / math.pi * (1 - cosine),
        2: 60 / math.pi * sine,
        3: 120 / math.pi * cosine,
    }


HARD = {
    "a rise and a return": [
        [(0, {0: 0, 1: 0, 2: 0}), (70, {0: 12.3, 2: 1.5}), (100, {0: 30, 1: 0, 2: 0})],
        [(160, {0: 30, 1: 0, 2: 0, 3: 0}), (251.7, {0: 0, 1: 0, 2: 0, 3: 0})],
    ],
    "a part of a thousandth of a degree": [
        [(0, {0: 0, 1: 0, 2: 0}), (100, {0: 10, 1: 3, 2: 0})],
        [(100, {0: 10, 1: 3, 2: 0}), (100.001, {0: 10.00005, 1: 3, 2: 0})],
        [(100.001, {0: 10.00005, 1: 3, 2: 0}), (200, {0: 17, 1: 0, 2: 0})],
        [(200, {0: 17, 1: 0, 2: 0}), (360, {0: 0, 1: 0, 2: 0})],
    ],
    "degree 31": [
        [(degrees, cycloidal(degrees / 180)) for degrees in (0, 20, 45, 70, 95, 120, 150, 180)],
        [(200, sixteen(30)), (340, sixteen(0))],
    ],
}  # fmt: skip


JOINT = 2 * EPS
"""Joints lie at the machine's angles, off the exact ones by half a unit of the last digit at most [rad]."""


@over_all("name", HARD)
def test_values_to_four_eps_of_each_function_at_40_digits(name):
    motion = gc.boundary_motion([made(part) for part in HARD[name]])
    assert motion.zero == 0
    random = np.random.default_rng(5)
    values, exact = [], []
    for part in HARD[name]:
        low, high = part[0][0] * DEG, part[-1][0] * DEG
        start, c = solved_at_40_digits(part)
        phi = low + (high - low) * np.append(random.random(60), [1e-9, 1 - 1e-9, 0.5])
        values.append(motion(phi))
        exact.append([[value_at_40_digits(start, c, x, order) for x in phi] for order in range(5)])
    ours, theirs = np.hstack(values), np.hstack(exact)
    theirs[0] -= motion.lowest
    for order in range(4):
        permitted = 4 * EPS * abs(theirs[order]).max() + JOINT * abs(theirs[order + 1])
        assert np.all(abs(ours[order] - theirs[order]) <= permitted), order


def test_the_lift_keeps_its_digits_where_it_begins_and_ends():
    law = gc.boundary_law([P(0, s=0, v=0, a=0, j=0), P(0.5, s=0.5), P(1, s=1, v=0, a=0, j=0)])
    with mp.workdps(40):
        c = solved_at_40_digits([(0, sixteen(0)), (0.5 / DEG, {0: 0.5}), (1 / DEG, sixteen(1))])[1]
    for u in (1e-8, 1e-3, 0.1):
        f = mp.fsum(x * mpf(u) ** k for k, x in enumerate(c) if k > 3)
        assert abs(law(u)[0] / f - 1) <= 4 * EPS
        assert abs(law.pieces[-1].formula(np.array(u))[0] / f - 1) <= 16 * EPS  # by symmetry


def test_random_conditions_are_met_to_the_last_digits():
    random = np.random.default_rng(11)
    for _ in range(12):
        angles = np.sort(random.choice(np.arange(10, 350), 3, replace=False)).tolist()
        heights = np.sort(random.uniform(1, 20, 3)).tolist()
        points = [at(0, s=0, **REST), *(at(k, s=h) for k, h in zip(angles, heights, strict=True)), at(355, s=25, v=0)]
        try:
            part = Poly(points)
        except gc.DesignError:
            continue
        for point in points:
            for order, number in point.given.items():
                [(_, _, p)], width = part.solution, part.end - part.start
                found = value_at(p, (point.place - part.start) / width, order) / width**order
                assert float(found) == pytest.approx(number, rel=1e-15, abs=1e-30)


# --- splines ---------------------------------------------------------------------------------------------------------

HEIGHTS = [0, 1.0, 4.5, 11.0, 18.0, 24.0, 28.0, 30]
ANGLES = [0, 20, 45, 70, 95, 120, 150, 180]


def spline_points() -> list[gc.MotionPoint]:
    ends = {0: REST, 180: REST}
    return [at(k, s=s, **ends.get(k, {})) for k, s in zip(ANGLES, HEIGHTS, strict=True)]


@over_all("degree", [3, 4, 5, 7])
def test_a_spline_is_that_of_scipy_on_the_same_knots(degree):
    part = Spline(spline_points(), degree)
    width = part.end - part.start
    inner = [float(part.start + low * width) for low, _, _ in part.solution[1:]]
    knots = np.array([0.0] * (degree + 1) + inner + [math.pi] * (degree + 1))
    zero = [(1, 0.0), (2, 0.0)]
    theirs = make_interp_spline(np.radians(ANGLES), HEIGHTS, degree, knots, (zero, zero))
    for low, high, p in part.solution:
        for y in (0.1, 0.5, 0.9):
            place = float(part.start + (low + Fraction(y) * (high - low)) * width)
            for order in range(4):
                ours = float(value_at(p, Fraction(y), order) / ((high - low) * width) ** order)
                assert ours == pytest.approx(float(theirs(place, order)), rel=1e-9, abs=1e-9)
                assert part.polynomials(place)[order] == pytest.approx(ours, rel=1e-12, abs=1e-12)


@over_all("degree", [2, 3, 5])
def test_all_derivatives_below_the_degree_are_continuous_at_the_knots(degree):
    points = spline_points()
    if degree == 2:
        points = [at(0, s=0, v=0), *points[1:-1], at(180, s=30)]
    part = Spline(points, degree)
    for before, after in pairwise(part.solution):
        for order in range(degree + 1):
            at_knot = [
                float(value_at(p, y, order) / ((high - low) * (part.end - part.start)) ** order)
                for (low, high, p), y in ((before, Fraction(1)), (after, Fraction(0)))
            ]
            if order < degree:
                assert at_knot[0] == pytest.approx(at_knot[1], abs=1e-12)
            else:
                assert abs(at_knot[1] - at_knot[0]) > 1e-9


def test_without_inner_knots_a_spline_is_the_polynomial():
    points = [at(0, s=0, **REST), at(180, s=30, **REST)]
    assert Spline(points, 5).solution == Poly(points).solution


def test_knots_that_are_given_are_where_the_pieces_join():
    points = spline_points()
    part = Spline(points, 5, np.radians([40, 60, 75, 90, 110, 135]).tolist())
    assert [round(180 * float(low), 9) for low, _, _ in part.solution] == [0, 40, 60, 75, 90, 110, 135]
    motion = gc.boundary_motion([part, Poly([at(200, s=30, **REST), at(350, s=0, **REST)])])
    assert np.isin(np.radians([40, 60, 75, 90, 110, 135]).round(12), motion.breaks.round(12)).all()


def test_a_cubic_spline_bends_at_its_knots_and_stations_may_fall_there():
    motion = gc.boundary_motion([Spline(spline_points(), 3), Poly([at(200, s=30, **REST), at(350, s=0, **REST)])])
    corners = motion.phases[0].normalised.corners
    assert len(corners) == 8
    stations = divide(motion, 24, at_corners=True)
    assert np.isin(corners, stations.u).all()


# --- the turn --------------------------------------------------------------------------------------------------------


def whole() -> gc.BoundaryMotion:
    rise = Poly([at(0, s=0, **REST), at(60, s=17), at(110, s=30, **REST)])
    back = Spline([at(150, s=30, **REST), at(190, s=20), at(230, s=7), at(270, s=0, **REST)], 5)
    return gc.boundary_motion([rise, back])


def test_the_follower_rests_between_the_parts():
    motion = whole()
    assert [phase.kind for phase in motion.phases] == ["rise", "dwell", "return", "dwell"]
    assert [round(phase.angle / DEG, 9) for phase in motion.phases] == [110, 40, 120, 90]
    s, v, a, j = motion(np.radians([110, 130, 149.99, 270, 300, 359]))
    np.testing.assert_allclose(s, [30, 30, 30, 0, 0, 0], atol=1e-13)
    assert not np.any(np.abs([v, a])[:, [1, 4, 5]])
    assert not np.any(j[[1, 2, 4, 5]])
    assert (velocity_jumps(motion), acceleration_jumps(motion)) == ([], [])


def test_every_way_of_computing_gives_the_same_bits():
    motion, phi = whole(), np.linspace(-3, 12, 20_001)
    known = np.array(motion(phi))
    order = np.random.default_rng(3).permutation(phi.size)
    assert np.array_equal(np.array(motion(phi[order])), known[:, order])
    some = slice(None, None, 997)
    assert np.array_equal(np.array(motion(phi[some])), known[:, some])
    assert np.array_equal([float(x) for x in motion(phi[777])], known[:, 777])
    growing = np.sort(np.mod(phi, TURN))
    sampled = np.array([[float(x) for x in motion(g)] for g in growing[::500]]).T
    assert np.array_equal(np.array(motion(growing))[:, ::500], sampled)


def test_nan_stays_nan_and_sides_differ_where_the_acceleration_jumps():
    rise = Poly([at(0, s=0, v=0), at(90, s=30, v=0)])
    motion = gc.boundary_motion([rise, Poly([at(180, s=30, v=0), at(300, s=0, v=0)])])
    values = np.array(motion([np.nan, 0.5, np.inf]))
    assert np.isnan(values[:, [0, 2]]).all()
    assert np.isnan(np.array(motion(np.append(np.linspace(0, 6, 9000), np.nan)))[:, -1]).all()
    jump = 6 * 30 / (math.pi / 2) ** 2
    assert [float(motion(90 * DEG, side)[2]) for side in ("left", "right")] == pytest.approx([-jump, 0])
    assert [float(motion(0, side)[2]) for side in ("left", "right")] == pytest.approx([0, jump])
    assert [jump.phi for jump in acceleration_jumps(motion)] == pytest.approx(np.radians([0, 90, 180, 300]))


def test_the_phases_are_the_motion():
    motion = whole()
    u = np.linspace(0, 1, 101)
    for k in range(4):
        inside = motion(motion.angle_at(k, u[1:-1]))
        for one, other, size in zip(inside, motion.at(k, u[1:-1]), (30, 40, 150, 900), strict=True):
            np.testing.assert_allclose(one, other, atol=1e-13 * size)


def test_the_derivatives_are_one_another_s():
    motion, h = whole(), 1e-5
    phi = np.linspace(0.01, 6.27, 797)
    phi = phi[np.min(np.abs(phi[:, None] - motion.breaks), axis=1) > 2 * h]
    for order, values in enumerate(motion(phi)[1:]):
        difference = (motion(phi + h)[order] - motion(phi - h)[order]) / (2 * h)
        np.testing.assert_allclose(values, difference, atol=2e-6 * np.abs(values).max())


def test_a_motion_that_moves_where_the_turn_begins_begins_elsewhere():
    points = [
        at(30 * k, s=10 * math.sin(30 * k * DEG), **({"v": 10, "a": 0} if k in (0, 12) else {})) for k in range(13)
    ]
    motion = gc.boundary_motion([Spline(points)])
    assert [phase.kind for phase in motion.phases] == ["rise", "return"]
    assert motion.zero / DEG == pytest.approx(-90, abs=1e-3)
    assert motion.lowest == pytest.approx(-10, abs=1e-9)
    phi = np.linspace(0, TURN, 50)
    np.testing.assert_allclose(motion(phi - motion.zero)[0] + motion.lowest, 10 * np.sin(phi), atol=1e-4)


def test_a_stop_on_the_way_is_no_turning():
    part = Poly([at(0, s=0, **REST), at(60, s=10, **REST), at(120, s=20, **REST)])
    motion = gc.boundary_motion([part, Poly([at(180, s=20, **REST), at(300, s=0, **REST)])])
    assert [phase.kind for phase in motion.phases] == ["rise", "dwell", "return", "dwell"]
    assert float(motion(60 * DEG)[1]) == pytest.approx(0, abs=1e-12)


def test_it_travels_to_other_processes_and_tells_itself():
    motion, phi = whole(), np.linspace(0, 6, 100)
    again = pickle.loads(pickle.dumps(motion))
    assert [x.tobytes() for x in again(phi)] == [x.tobytes() for x in motion(phi)]
    assert "by conditions: polynomial of degree 6, spline of degree 5" in repr(motion)


@over_all("follower", [gc.Translating(5), gc.FlatFaced()])
def test_it_stands_wherever_a_motion_does(follower):
    motion = whole()
    cam = gc.Cam(motion, follower, prime_radius=80)
    extremes = cam.extremes()
    phi = np.linspace(0, TURN, 20_001)
    if isinstance(follower, gc.Translating):
        assert extremes.pressure_angle_rise[0] == pytest.approx(cam.pressure_angle(phi).max(), rel=1e-6)
        assert gc.minimum_radius(motion, follower, rise=0.5).prime_radius > 0
    assert np.isfinite(cam.profile(phi)).all()


# --- laws ------------------------------------------------------------------------------------------------------------


@over_all("smooth", [1, 2, 3])
@over_all("blends", [(0.25, 0.25), (0.1, 0.4), (1e-6, 0.3)])
def test_the_law_of_constant_velocity_passes_the_check_of_laws(blends, smooth):
    law = gc.constant_velocity_law(*blends, smooth)
    assert law.peak_velocity == pytest.approx(2 / (2 - sum(blends)), rel=1e-14)
    law._check()
    assert len(law.jumps) == (2 if smooth == 1 else 0)
    assert law.reversed(0.5)[1] == pytest.approx(law(0.5)[1], rel=1e-14)


def test_the_peaks_of_constant_velocity_are_those_of_its_curves_to_the_last_digits():
    random = np.random.default_rng(4)
    for start, end in random.uniform(0.02, 0.45, (20, 2)).tolist():
        for smooth in (1, 2, 3):
            law = gc.constant_velocity_law(start, end, smooth)
            assert law.peak_velocity == pytest.approx(2 / (2 - start - end), rel=2e-16)
            u = np.concatenate([np.linspace(0, start, 2001), np.linspace(1 - end, 1, 2001)])
            highest = max(np.abs(law(u, side=side)[2]).max() for side in ("left", "right"))
            assert law.peak_acceleration == pytest.approx(highest, rel=1e-12)


def test_a_law_of_several_parts_and_of_a_return():
    parts = [Poly([P(0, s=5, v=0, a=0), P(1, s=3, v=-3)]), Poly([P(1, s=3, v=-3), P(2, s=0, v=0, a=0)])]
    law = gc.boundary_law(parts, "down")
    assert law.name == "down"
    assert law(0.5)[:2] == (pytest.approx(0.4), pytest.approx(1.2))
    assert law.jumps == (0.5,)


def test_a_law_of_parts_with_a_gap_between_them_rests_there():
    parts = [Poly([P(k, s=k / 2, **REST), P(k + 1, s=k / 2 + 1, **REST)]) for k in (0, 2)]
    f, *derivatives = gc.boundary_law(parts)([1 / 6, 0.4, 0.5, 0.6, 5 / 6])
    np.testing.assert_allclose(f, [0.25, 0.5, 0.5, 0.5, 0.75], rtol=1e-14)
    assert not np.any(np.array(derivatives)[:, 1:4])


# --- what it is made of ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("size", [1e-30, 1.0, 1e30])
def test_every_turning_is_found(size):
    for roots in (
        [0.5],
        [1 / 3, 0.5],
        [1 / 3, 1 / 3, 0.5],
        [1e-6, 1 - 1e-6],
        [0.2, 0.201, 0.7],
        [0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 0.9],
    ):
        velocity = size * np.polynomial.polynomial.polyfromroots(roots)
        found = PiecewisePolynomial.of(velocity.tolist(), 0.0, 1.0).integral()
        simple = [root for root in sorted(set(roots)) if roots.count(root) % 2]
        assert found.turnings() == pytest.approx(simple, abs=1e-12)
        (start, sign), *_ = found.runs()
        assert (start, sign) == (0.0, (-1) ** len(roots))


@pytest.mark.parametrize("power", range(1, 17))
def test_a_stop_from_which_the_motion_leaves_slowly_is_a_turning_or_none(power):
    # (y - 1/3)^power over [0, 1]: beside the stop velocity is lost in the rounding of any other series.
    p = [Fraction(1)]
    for _ in range(power):
        p = [low - high / 3 for low, high in zip([Fraction(0), *p], [*p, Fraction(0)], strict=True)]
    found = as_series([(Fraction(0), Fraction(1), p)], rests=[Fraction(1, 3)])
    assert found.turnings() == ([pytest.approx(1 / 3, abs=1e-15)] if power % 2 == 0 else [])
    beside = np.array([1 / 3 - 1e-5, 1 / 3 + 1e-3])
    assert found(beside)[0] == pytest.approx((beside - 1 / 3) ** power, rel=1e-9)


def test_equations_that_contradict_have_no_solution():
    one = Fraction(1)
    assert solve_exactly([[one, one], [one, one]], [one, 2 * one]) is None
    assert solve_exactly([[Fraction(0), one], [one, one]], [one, 3 * one]) == [2, 1]


# --- messages --------------------------------------------------------------------------------------------------------

RISE = Poly([at(0, s=0, **REST), at(90, s=30, **REST)])
BACK = Poly([at(180, s=30, **REST), at(270, s=0, **REST)])
close = 90 + 1e-9
many = [at(2 * k, s=float(k), v=0.0, a=0.0, j=0.0) for k in range(9)]

PARTS = {
    "no condition": (lambda: P(1.5707963267948966), "s is missing at 90 degrees, but must be given with v, a or j"),
    "not a number": (lambda: P(0, s=math.nan), "s is nan, but must be a finite number"),
    "no angle": (lambda: P(math.inf, s=0), "angle is inf, but must be a finite number"),
    "one point": (lambda: Poly([at(0, s=0)]), "points is 1, but must be 2 to 100 points"),
    "too many points": (lambda: Spline([at(k, s=0) for k in range(101)]), "points is 101, but must be 2 to 100"),
    "out of order": (
        lambda: Poly([at(0, s=0), at(90, s=1), at(60, s=2)]),
        r"points\[2\].angle is 60 degrees, but must be greater than 90 degrees.*sort the points",
    ),
    "given twice": (lambda: Poly([at(0, s=0), at(0, s=1)]), r"points\[1\].angle is 0 degrees.*give each one once"),
    "too many conditions": (
        lambda: Poly(many),
        "points is 36 conditions, but must be at most 32, for a degree of 31",
    ),
    "degree too low": (
        lambda: Poly([at(0, s=0, v=0), at(90, s=1, v=0)], 2),
        "degree is 2, but must be 3, one less than the 4 conditions; they are too many",
    ),
    "degree too high": (lambda: Poly([at(0, s=0, v=0), at(90, s=1, v=0)], 5), "degree is 5, but must be 3.*too few"),
    "nothing says how high": (
        lambda: Poly([at(0, v=0), at(45, v=3), at(90, v=0)]),
        "points is without any s.*say how high the motion is",
    ),
    "conditions that depend on each other": (  # s' of the middle follows from the ends for every parabola
        lambda: Poly([at(0, s=0), at(45, v=3), at(90, s=1)]),
        "points is 3 conditions that depend on each other.*leave it open or contradict each other",
    ),
    "a wild polynomial": (
        lambda: Poly([at(10 * k, s=1 / (1 + 25 * (k / 9 - 1) ** 2)) for k in range(19)]),
        r"points\[.*\] \((s|turns) behind it\).*swings",
    ),
    "many turns": (
        lambda: Poly([at(0, s=0, v=5), at(90, s=0.001, v=-40, a=500, j=9000), at(180, s=0, v=5, a=-900, j=-9000)]),
        r"points\[.\].*swings",
    ),
    "hangs on the last digits": (
        lambda: Poly([at(0, s=0, v=0), at(90, s=30), P(90 * DEG + 1e-13, s=30.0000001), at(180, s=31, v=0)]),
        "decided by the last digits of the numbers",
    ),
    "degree of a spline": (lambda: Spline(spline_points(), 1), "degree is 1, but must be from 2 to 9"),
    "too few for a spline": (
        lambda: Spline([at(0, s=0), at(90, s=1)], 3),
        "points is 2 conditions, but must be 4 or more for a degree of 3",
    ),
    "number of knots": (
        lambda: Spline(spline_points(), 5, [1.0]),
        "knots is 1, but must be 6, one for each of 12 conditions but the degree and one",
    ),
    "knots out of order": (
        lambda: Spline(spline_points(), 5, np.radians([40, 60, 50, 90, 110, 135]).tolist()),
        r"knots\[2\] is 50 degrees, but must be greater than 60 degrees",
    ),
    "knots beyond the part": (
        lambda: Spline(spline_points(), 5, np.radians([40, 60, 70, 90, 110, 190]).tolist()),
        r"knots\[5\] is 180 degrees|inside the part",
    ),
    "knots without points": (
        lambda: Spline(spline_points(), 5, np.radians([171, 172, 173, 174, 175, 176]).tolist()),
        "depend on each other",
    ),
}
TURNS = {
    "no parts": (list, "parts is empty, but must be one part or more"),
    "at rest": (lambda: [Poly([at(0, s=5, v=0), at(90, s=5, v=0)])], "motion is at rest at 5 over the whole turn"),
    "parts out of order": (
        lambda: [BACK, RISE],
        r"parts\[1\].points\[0\].angle is 0 degrees, but must be 270 degrees",
    ),
    "parts that overlap": (
        lambda: [RISE, Poly([at(80, s=30, **REST), at(270, s=0, **REST)])],
        r"parts\[1\].points\[0\].angle is 80 degrees, but must be 90 degrees or more",
    ),
    "s of a joint": (
        lambda: [RISE, Poly([at(90, s=31, **REST), at(270, s=0, **REST)])],
        r"parts\[1\] \(s where it begins\) is 31, but must be 30, as the part before ends; give one s at 90 degrees",
    ),
    "v of a joint": (
        lambda: [Poly([at(0, s=0, v=0), at(90, s=30, v=4)]), Poly([at(90, s=30, v=3), at(270, s=0, v=0)])],
        r"parts\[1\] \(v where it begins\) is 3, but must be 4.*give v, the same in both, at 90 degrees",
    ),
    "s over a gap": (
        lambda: [RISE, Poly([at(180, s=29, **REST), at(270, s=0, **REST)])],
        r"parts\[1\] \(s before it\) is 30 and 29, but must be equal: the follower dwells from 90 degrees to 180",
    ),
    "v at a gap": (
        lambda: [RISE, Poly([at(180, s=30, v=1), at(270, s=0, v=0)])],
        r"parts\[1\] \(v before it\) is 0 and 1, but must be 0: the follower dwells",
    ),
    "s of the turn": (
        lambda: [RISE, Poly([at(180, s=30, **REST), at(270, s=1, **REST)])],
        r"parts \(s at their end\) is 1, but must be 0, as the first part begins",
    ),
    "v of the turn": (
        lambda: [RISE, Poly([at(180, s=30, **REST), at(360, s=0, v=-2)])],
        r"parts \(v at their end\) is -2, and 0 where they begin, but must be the same at both",
    ),
    "v at the last gap": (
        lambda: [RISE, Poly([at(180, s=30, **REST), at(350, s=0, v=-2)])],
        r"parts \(v at their end\) is .* must be 0 at both: the follower dwells between them",
    ),
    "more than a turn": (
        lambda: [RISE, Poly([at(180, s=30, **REST), at(370, s=0, **REST)])],
        r"parts \(turn\) is 370 degrees, but must be 360 degrees or less",
    ),
    "a beginning beyond the turn": (
        lambda: [Poly([at(400, s=0, v=0), at(500, s=3, v=0), at(600, s=0, v=0)])],
        r"parts\[0\].points\[0\].angle is 400 degrees, but must be from 0 to less than 360 degrees",
    ),
}
LAWS = {
    "no parts": (lambda: gc.boundary_law([]), "parts is empty"),
    "points and parts": (lambda: gc.boundary_law([RISE, at(0, s=0)]), "parts is points and parts"),
    "no rest": (
        lambda: gc.boundary_law([P(0, s=0, v=1), P(1, s=1, v=0)]),
        r"f'\(0\) of the law .* is 1.0, but must be 0",
    ),
    "back again": (lambda: gc.boundary_law([P(0, s=0, v=0), P(0.5, s=1), P(1, s=0, v=0)]), "lift of the law .* is 0"),
    "falls on its way": (
        lambda: gc.boundary_law([P(0, s=0, v=0), P(0.5, s=0.5, v=-0.5), P(1, s=1, v=0)]),
        "f' at u = .* 0 or more; what falls on its way is a motion of several phases",
    ),
    "parts that do not join": (
        lambda: gc.boundary_law([RISE, Poly([at(90, s=31, v=0), at(120, s=40, v=0)])]),
        r"parts\[1\] \(s where it begins\) is 31",
    ),
    "a negative blend": (
        lambda: gc.constant_velocity_law(-0.1),
        r"blends\[0\] is -0.1, but must be from 0 to less",
    ),
    "a whole blend": (lambda: gc.constant_velocity_law(0.2, 1.0), r"blends\[1\] is 1.0"),
    "no way between": (lambda: gc.constant_velocity_law(0.5, 0.5), "blends is 0.5 and 0.5, but must be less than 1"),
    "smoothness": (lambda: gc.constant_velocity_law(0.2, 0.2, 4), r"smooth is 4, but must be 1 \(velocity\), 2"),
}


@over_all("name", PARTS)
def test_a_part_that_cannot_be_is_told(name):
    make, message = PARTS[name]
    with pytest.raises(gc.DesignError, match=message):
        make()


@over_all("name", TURNS)
def test_a_turn_that_cannot_be_is_told(name):
    make, message = TURNS[name]
    with pytest.raises(gc.DesignError, match=message):
        gc.boundary_motion(make())


@over_all("name", LAWS)
def test_a_law_that_cannot_be_is_told(name):
    make, message = LAWS[name]
    with pytest.raises(gc.DesignError, match=message):
        make()


# --- a follower that moves at 0 degrees -------------------------------------------------------------------------------

RISING = Poly([at(20, s=0, **REST), at(170, s=20, **REST)])
AROUND_0 = {
    # What was seen: a first phase of 2e-16 rad, and a last one that begins at 2 pi.
    **{f"v = {v}, a = {a}": moving_at_0(v, a) for v in (-19.5, -14, 5, 14, 19.5) for a in (0, 20)},
    "a return over 0": [RISING, Poly([at(210, s=20, **REST), at(380, s=0, **REST)])],
    "a dwell over 0": [RISING, Poly([at(210, s=20, **REST), at(310, s=0, **REST)])],
    "a spline": [
        Spline(
            [
                at(0, s=10, v=8, a=0),
                *(at(60 * k, s=s) for k, s in enumerate((18, 16, 8, 0, 4), 1)),
                at(360, s=10, v=8, a=0),
            ]
        )
    ],
    **{
        f"a turning with a jump of a at {b} degrees": [
            Poly([at(b, s=0, v=0, a=5), at(b + 100, s=10, v=0, a=-10)]),
            Poly([at(b + 100, s=10, v=0, a=-30), at(b + 360, s=0, v=0, a=20)]),
        ]
        for b in (7.3, 33.3, 200, 359.999)
    },
    **{
        f"a dwell of {off:g} rad beside 0": [
            Poly([P(off, s=0, **REST), at(170, s=20, **REST)]),
            Poly([at(210, s=20, **REST), P(TURN - off, s=0, **REST)]),
        ]
        for off in (1e-10, 1e-8, 1e-6)
    },
}


@over_all("name", AROUND_0)
def test_phases_and_starts_of_what_moves_at_0_are_those_of_the_motion(name):
    motion = gc.boundary_motion(AROUND_0[name])
    starts = np.append(motion.starts, TURN)
    assert starts.size == len(motion.phases) + 1
    assert starts[0] == 0
    assert np.diff(starts) == pytest.approx(motion.angles, abs=2e-9)
    number = np.arange(len(motion.phases))
    for side, at_ends in (("right", motion.at(number, 0.0)), ("left", motion.at(np.roll(number, 1), 1.0, "left"))):
        for here, there in zip(motion(motion.starts, side)[:3], at_ends, strict=False):
            assert here == pytest.approx(there, abs=1e-6 * float(np.abs(motion(starts)).max()))
    phi = np.linspace(0, TURN, 1009)[1:-1]
    phase = motion.starts.searchsorted(phi, "right") - 1
    in_phase = motion.at(phase, (phi - motion.starts[phase]) / motion.angles[phase])
    for here, there in zip(motion(phi)[:2], in_phase, strict=False):
        assert here == pytest.approx(there, abs=1e-8 * float(np.abs(here).max()))


@pytest.mark.parametrize("name", ["v = -19.5, a = 0", "v = 14, a = 20", "a return over 0", "a spline"])
def test_the_cam_of_what_moves_at_0_is_written_as_it_is(name, tmp_path):
    cam = gc.Cam(gc.boundary_motion(AROUND_0[name]), gc.Translating(offset=3, roller_radius=5), prime_radius=60)
    phi = np.linspace(0, TURN, 40_001)
    curve, v, alpha = cam.profile(phi), cam.motion(phi)[1], cam.pressure_angle(phi)
    nearest = cKDTree(curve)
    spline = gc.profile_spline(cam)
    drawn = BSpline(spline.knots, np.asarray(spline.control), spline.degree)(np.linspace(0, spline.knots[-1], 9001))
    for points in (drawn, cam.trimmed_profile(2000)):
        assert nearest.query(points)[0].max() < 0.008
    file = gc.write_profile(cam, tmp_path, ["csv"])["csv"]
    rows = np.loadtxt(file, delimiter=",", skiprows=1)
    # Cam angle 0 of the file is that of the conditions, for which the cam stands turned.
    there = cam.profile(np.radians(rows[:, 0]) - cam.motion.zero) @ [1, 1j] * np.exp(-1j * cam.motion.zero)
    assert rows[:, 1:3] @ [1, 1j] == pytest.approx(there, abs=1e-3)
    extremes = cam.extremes()
    assert extremes.pressure_angle_rise[0] == pytest.approx(np.abs(alpha[v > 0]).max(), abs=1e-7)
    assert abs(extremes.pressure_angle_return[0]) == pytest.approx(np.abs(alpha[v < 0]).max(), abs=1e-7)
    assert cam.undercuts() == []


@over_all("v", [-19.5, -14])
def test_where_the_profile_of_what_moves_at_0_crosses_itself_both_branches_pass(v):
    cam = gc.Cam(gc.boundary_motion(moving_at_0(v)), gc.Translating(offset=3, roller_radius=25), prime_radius=30)
    loops = cam.undercuts()
    assert loops
    for loop in loops:
        for phi in loop.crossing[:2]:
            assert cam.profile(phi) == pytest.approx(np.array(loop.crossing[2:]), abs=1e-6)

"""The exact side as ratios: its cost in sine-cosine pairs or beside a general optimiser, and its rounding in eps.

It also has running sums, in memory copies, and the order of the curvature through three points.
"""

import math
import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from graphcam.bench import reference, rivals
from graphcam.bench.rows import BenchRow, Gauge, Section, Unit
from graphcam.bench.scenes import ARM, FOLLOWERS, LIMIT, free_scene, scene
from graphcam.bench.timing import Timer
from graphcam.bench.tradeoff import INSIDE, exact_profile_error, inner_places, turn
from graphcam.comparison.integrals import accurate_cumsum
from graphcam.given.follower import Oscillating, Translating
from graphcam.given.laws import Floats, law
from graphcam.given.motion import FULL_TURN, Motion, Return, Rise
from graphcam.given.pieces import CHUNK
from graphcam.mechanism.cam import Cam, largest_roller
from graphcam.mechanism.least_radius import LeastRadius, minimum_radius
from graphcam.mechanism.three_points import circumradius
from graphcam.sweeps.designs import Designs
from graphcam.sweeps.sweep import CHUNK_OF_DESIGNS, sweep
from graphcam.sweeps.sweep_quantities import QUANTITIES

STATIONS = 181
"""Stations of one design, whose sines and cosines are the unit."""
LOOPED = 8
"""Designs of the loop, in which every cam takes as long as the other."""
RUNS = 12
"""Runs of a sweep, the best of which counts: beside other work most of them lose the cache."""
SWEEPS = (
    *(("translating", law) for law in ("3-4-5", "cycloidal", "modified-trapezoidal")),
    ("arm", "3-4-5"),
)
"""Followers and laws."""
RIVAL_STATIONS = 360
RIVAL_RUNS = 40
GOALS = (
    dict.fromkeys(("3-4-5", "4-5-6-7"), "<= 0.7")
    | dict.fromkeys(("cosine", "cycloidal"), "<= 1.3")
    | dict.fromkeys(("rectangular", "modified-sine", "modified-trapezoidal"), "<= 1.6")
)
"""Goals of the laws: polynomial, trigonometric, piecewise."""
PASSES, QUOTIENTS = 60, 4
"""Passes over a block of values, and quotients of it, that cam points take; see :func:`_bare_cam_points`."""
LOBES, POINTS = 200, 2000
"""Phases of a cam on which a large roller leaves many loops, and points of what is left of its profile."""
SUMMED = 10_000_000
"""Values of the running sums."""
HALVINGS = 8
"""Halvings of the chords between three points of a curve, from 0.1 rad on."""


def designs(follower: str, law: str, n: int) -> Designs:
    """Cams of random sizes, always the same: with a translating follower or an arm.

    >>> len(designs("arm", "3-4-5", 10))
    10
    """
    random = np.random.default_rng(1)
    lift, place = random.uniform(10, 40, n), random.uniform(-20, 20, n)
    own: dict[str, Any] = {"lift": lift, "offset": place}
    if follower == "arm":
        own = {"follower": "oscillating", "lift": lift / ARM, "arm": ARM, "distance": 1.2 * ARM + place / 2}
    up, down, dwell = (random.uniform(*limits, n) for limits in ((1, 2.5), (1, 2), (0, 1.2)))
    angles, radius = {"rise_angle": up, "return_angle": down, "dwell_angle": dwell}, random.uniform(40, 80, n)
    return Designs(prime_radius=radius, rise_law=law, return_law=law, **angles, **own)


def exact_rows(gauge: Gauge) -> Iterator[BenchRow]:
    """Laws, cam points, extremes, sweeps, and minimum radii beside their rivals."""
    timer, few = gauge.timer, gauge.unit(RIVAL_STATIONS)
    yield from _laws(gauge.unit(gauge.stations), timer)
    yield from _cam_points(gauge.unit(gauge.points), few, timer)
    yield from _extremes(few, timer)
    yield from _undercuts(timer)
    yield from _sweeps(timer)
    yield from _least_radii(few, timer)
    yield from _sums(timer)
    yield from _three_points(timer)


def _laws(unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    u, what = np.linspace(0, 1, unit.n), f"f, f', f'', f''' at {unit.n} places"
    for name, goal in GOALS.items():
        growing, mixed = timer.seconds(partial(law(name), u)), timer.seconds(partial(law(name), _mixed(u)))
        yield unit.row(f"law {name}", what, growing, goal, _law_error(name))
        yield _in_any_order(f"law {name}", mixed, growing)
    yield unit.row(
        "law, any order, floor", "seven sizes of a piece looked up", timer.seconds(partial(_looked_up, unit.n))
    )


def _looked_up(n: int) -> None:
    """What places in any order take on top: the number of each one's piece, its origin, length, base and factors."""
    places, sizes, out = np.random.default_rng(2).random(CHUNK), np.ones(2), np.empty(CHUNK)
    for _ in range(0, n, CHUNK):
        number = (places >= 0.5).astype(np.intp)
        for _ in range(7):
            sizes.take(number, out=out, mode="clip")


def _mixed(places: Floats) -> Floats:
    """The places in a random order, which is always the same."""
    return np.random.default_rng(2).permutation(places)


def _in_any_order(name: str, mixed: float, growing: float) -> BenchRow:
    """The time at places in any order beside that at the same places in growing order."""
    return BenchRow(name, "places in any order", mixed / growing, "times sorted", "<= 1.5", None, mixed)


def _law_error(name: str) -> float | None:
    """The maximum rounding of a law and its derivatives [eps], each relative to its maximum value."""
    if name not in reference.REFERENCED or not reference.available():
        return None
    checked, the_law = inner_places(), law(name)
    off = np.abs(np.array(the_law(checked)) - reference.law_values(name, checked)).max(axis=1)
    greatest = np.abs(np.array(the_law(np.linspace(0, 1, 1001)))).max(axis=1)
    return float((off[greatest > 0] / greatest[greatest > 0]).max()) / reference.EPS


def _cam_points(unit: Unit, few: Unit, timer: Timer) -> Iterator[BenchRow]:
    where, phi = scene("translating", "3-4-5"), turn(unit.n)
    motion, cam, at = where.board.motion, where.cam, f"at {unit.n} stations"
    growing, mixed = timer.seconds(partial(motion, phi)), _mixed(phi)
    yield unit.row("motion", f"s, v, a, j {at}", growing)
    yield _in_any_order("motion", timer.seconds(partial(motion, mixed)), growing)
    # As many as of one drawing: the overhead of a call counts.
    yield few.row("motion", f"s, v, a, j at {few.n} stations", timer.seconds(partial(motion, turn(few.n))), "<= 100 µs")
    error_eps = exact_profile_error(where) / reference.EPS if reference.available() else None
    yield unit.row("profile", f"working profile {at}", timer.seconds(partial(cam.profile, phi)), "", error_eps)
    what = f"pitch curve, profile and curvature {at}"
    yield unit.row("cam points", what, timer.seconds(partial(cam.curves, phi)), "<= 1.0")
    yield unit.row("cam points", "the same in any order", timer.seconds(partial(cam.curves, mixed)), "<= 1.6")
    yield unit.row(
        "cam points, floor", "their arithmetic alone, in place", timer.seconds(partial(_bare_cam_points, unit.n))
    )


def _bare_cam_points(n: int) -> None:
    """The passes that no order of the computing saves: nothing is new memory, and nothing is chosen.

    Of the 3-4-5 law and its derivatives 21 products and sums and a quotient; of the sine and the cosine 8, a quotient
    and a tangent; of the curves 31, two quotients and a root.
    """
    x, y, out = np.ones(CHUNK), np.ones(CHUNK), np.empty(CHUNK)
    for _ in range(0, n, CHUNK):
        for _ in range(PASSES // 2):
            np.multiply(x, y, out)
            np.add(x, y, out)
        for _ in range(QUOTIENTS):
            np.divide(x, y, out)
        np.sqrt(x, out)
        np.tan(x, out)


def _undercuts(timer: Timer) -> Iterator[BenchRow]:
    """A cam of many loops, which are all sought anew: time and memory."""
    phases = [(Rise, Return)[k % 2](0.5, FULL_TURN / LOBES, "cosine") for k in range(LOBES)]
    knife = Cam(Motion(phases), Translating(), 100.0)
    cam = replace(knife, follower=Translating(roller_radius=1.5 * largest_roller(knife)))
    for name, work in (
        ("undercuts", lambda: replace(cam).undercuts()),
        ("trimmed profile", lambda: replace(cam).trimmed_profile(POINTS)),
    ):
        seconds, what = timer.seconds(work), f"{LOBES} phases, {len(cam.undercuts())} loops"
        yield BenchRow(name, what, 1e3 * seconds, "ms", "<= 500", None, seconds)
        yield BenchRow(name, f"{what}: maximum memory", _peak(work) / 1e6, "MB", "<= 120", None, seconds)


def _peak(work: Callable[[], object]) -> float:
    """The most memory [bytes] that a piece of work holds at once."""
    tracemalloc.start()
    work()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak


def _extremes(unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    for follower in FOLLOWERS:
        seconds = timer.seconds(scene(follower, "3-4-5").cam.extremes)
        yield unit.row(f"extremes, {follower}", "pressure angles and minimum convex radius", seconds)


def _sweeps(timer: Timer) -> Iterator[BenchRow]:
    """All quantities of a chunk of designs, beside a loop over some of them."""
    unit = Unit(STATIONS, timer.pairs(STATIONS * LOOPED) / LOOPED)
    patient = Timer(timer.budget, max(timer.least_runs, RUNS))
    for follower, law_name in SWEEPS:
        many, name = designs(follower, law_name, CHUNK_OF_DESIGNS), f"sweep, {follower}, {law_name}"
        some = many.part(slice(0, LOOPED))
        seconds = patient.seconds(partial(sweep, many)) / CHUNK_OF_DESIGNS
        plain, looped = (
            timer.seconds(partial(loop, some)) / LOOPED for loop in (partial(rivals.by_stations, n=STATIONS), _by_loop)
        )
        swept = sweep(some, QUANTITIES[:3])
        exact = np.stack([swept[quantity] for quantity in QUANTITIES[:3]], axis=1)
        error_eps = float(np.abs(exact / _by_loop(some) - 1).max()) / reference.EPS
        yield unit.row(name, "all quantities of a design", seconds, "<= 1.6", error_eps)
        off = np.abs(rivals.by_stations(some, STATIONS) / exact - 1).max()
        what = f"beside a loop in plain NumPy, {STATIONS} stations a phase: off by {off:.1e}"
        yield BenchRow(name, what, plain / seconds, "times faster", ">= 8", None, plain)
        what = "beside a loop over Cam.extremes, which finds the places too"
        yield BenchRow(name, what, looped / seconds, "times faster", "", None, looped)


def _by_loop(some: Designs) -> list[list[float]]:
    """The maximum pressure angles and the minimum convex radius, one cam after another."""
    extremes = [some.cam(k).extremes() for k in range(len(some))]
    return [[e.pressure_angle_rise[0], e.pressure_angle_return[0], e.min_convex_radius[0]] for e in extremes]


def _least_radii(unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    free, arm, n = free_scene("3-4-5"), scene("arm", "3-4-5"), unit.n
    # The cams alone: what a scene takes to say its limits is not in it.
    sized: list[Callable[[], LeastRadius]] = [
        partial(minimum_radius, free.board.motion, Translating(), "cw", LIMIT, LIMIT)
    ]
    sized.append(partial(minimum_radius, arm.board.motion, Oscillating(ARM), "ccw", arm.board.limits.rise))
    closed, exchange = map(timer.seconds, sized)
    least, arm_least = (work().prime_radius for work in sized)
    error = reference.in_eps(least, reference.least_radius(free)) if reference.available() else None
    yield unit.row("minimum prime radius, translating", "closed form", closed, "<= 5 µs", error)
    yield unit.row("minimum prime radius, arm", "exchange of half-planes", exchange)
    lines = rivals.translating_lines(free.board.motion, LIMIT, n)
    arms = rivals.arm_lines(arm.board.motion, arm.board.limits.rise, ARM, n)
    inside = 0.2 * ARM, 0.9 * ARM
    by_angles = partial(rivals.by_pressure_angles, free.board.motion, LIMIT, n, (INSIDE[1], 0.0))
    # The optimiser as one would first use it, then with graphcam's own formulation and exact derivatives.
    beside: list[tuple[str, str, Callable[[], float], str]] = [
        ("translating", "SLSQP on pressure angles", by_angles, ">= 100"),
        ("translating", "SLSQP given the half-planes", partial(rivals.by_optimiser, lines, INSIDE), ">= 100"),
        ("translating", "HalfspaceIntersection", partial(rivals.by_half_planes, lines, INSIDE), ""),
        ("arm", "SLSQP given the half-planes", partial(rivals.by_optimiser, arms, inside), ">= 10"),
        ("arm", "SLSQP, linear constraints", partial(rivals.by_linear_constraints, arms, inside), ">= 10"),
    ]
    # A matrix routine that meets other work on its processors takes many times as long: only the best of many runs is
    # the rival's own time.
    patient = Timer(timer.budget, max(timer.least_runs, RIVAL_RUNS))
    for follower, rival, work, goal in beside:
        ours, exact = (exchange, arm_least) if follower == "arm" else (closed, least)
        seconds, what = patient.seconds(work), f"beside {rival}, {n} stations: off by {work() / exact - 1:+.1e}"
        yield BenchRow(f"minimum prime radius, {follower}", what, seconds / ours, "times faster", goal, None, seconds)


def _sums(timer: Timer) -> Iterator[BenchRow]:
    """Running sums of values of one sign, beside numpy's own, against the correctly rounded sum."""
    values = np.random.default_rng(0).uniform(0.0, 1.0, SUMMED)
    copied = np.empty_like(values)
    copy, exact, what = timer.seconds(partial(np.copyto, copied, values)), math.fsum(values), f"{SUMMED} values"
    for name, goal, work in (("accurate", "<= 4", accurate_cumsum), ("plain", "", np.cumsum)):
        seconds, error = timer.seconds(partial(work, values)), abs(float(work(values)[-1]) - exact) / exact
        eps = error / reference.EPS
        yield BenchRow(f"running sum, {name}", what, seconds / copy, "memory copies", goal, eps, seconds)
    filled = timer.seconds(lambda: np.empty_like(values).fill(0.0))
    yield BenchRow("running sum, floor", "new memory for the result", filled / copy, "memory copies", "", None, filled)


def _three_points(timer: Timer) -> Iterator[BenchRow]:
    """The order of the curvature through three points of the pitch curve, at equal and at unequal chords."""
    cam, at, steps = scene("translating", "3-4-5").cam, 0.6, 0.1 / 2 ** np.arange(HALVINGS)

    def curvature(share: float) -> Floats:
        """By the circle through three points [1/mm]."""
        return 1 / circumradius(*(cam.pitch_curve(at + turn) for turn in (-share * steps, 0 * steps, steps)))

    for name, goal, share in (("equal", "2.00 ± 0.05", 1.0), ("unequal", "1.00 ± 0.05", 2.0)):
        errors = np.abs(curvature(share) - float(cam.pitch_curvature(at)))
        order = float(np.polyfit(np.log(steps), np.log(errors), 1)[0])
        seconds, what = timer.seconds(partial(curvature, share)), f"curvature, {name} chords"
        yield BenchRow("three points", what, order, "order", goal, None, seconds)


EXACT = Section(
    "exact",
    "The exact side",
    "Times are processor times; SC(N) is the time of N sines and N cosines in the same run. Rounding is in units of "
    "2.2e-16 of the maximum value, against 50 digits if mpmath is installed. Matrix routines share their processors "
    "badly: if other work runs, set OPENBLAS_NUM_THREADS=1.",
    exact_rows,
)

"""The exact side as ratios: its cost in sine-cosine pairs or beside a general optimiser, and its rounding in eps.

It also has running sums, beside plain ones, and the order of the curvature through three points.
"""

import math
import tracemalloc
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from graphcam.bench import reference, rivals
from graphcam.bench.bench_followers import ARM, FOLLOWER_KINDS, PERMITTED_ANGLE, free_scene, scene
from graphcam.bench.rows import MILLISECONDS, BenchRow, Effort, Section, Unit, faster_than
from graphcam.bench.timing import Timer
from graphcam.bench.tradeoff import ARM_INNER_POINT, INNER_POINT, turn
from graphcam.comparison.integrals import accurate_cumsum
from graphcam.given.follower import Oscillating, Translating
from graphcam.given.laws import LAWS, Floats, canonical_law, law
from graphcam.given.motion import FULL_TURN, Motion, Return, Rise
from graphcam.given.piecewise import CHUNK_SIZE
from graphcam.mechanism.cam import Cam, largest_roller
from graphcam.mechanism.least_radius import LeastRadius, minimum_radius
from graphcam.mechanism.three_point_circle import circumradius
from graphcam.sweeps.designs import Designs
from graphcam.sweeps.sweep import CHUNK_OF_DESIGNS, sweep
from graphcam.sweeps.sweep_quantities import QUANTITIES
from graphcam.words import say

STATIONS = 181
"""Stations of one design, whose sines and cosines are the unit."""
LOOPED_DESIGNS = 8
"""Designs of the loop, in which every cam takes as long as the other."""
SWEEP_RUNS = 12
"""Runs of a sweep, the best of which counts: beside other work most of them lose the cache."""
SWEPT_CASES = (*(("translating", law) for law in ("3-4-5", "cycloidal", "modified-trapezoidal")), ("arm", "3-4-5"))
"""The swept cases, each a follower with a law."""
RIVAL_STATIONS = 360
RIVAL_RUNS = 40
LAW_GOALS: Mapping[str, str] = {
    **dict.fromkeys(("3-4-5", "4-5-6-7"), "<= 0.7"),
    **dict.fromkeys(("cosine", "cycloidal"), "<= 1.3"),
    **dict.fromkeys(("rectangular", "modified-sine", "modified-trapezoidal"), "<= 1.6"),
}
"""Goals of some laws: polynomial, trigonometric, piecewise."""
FLOOR_FACTOR = 1.15
"""How many times the least that can be done, measured in the same run, is permitted."""
LOBE_PHASES = 200
"""Phases of a cam on which a large roller leaves many loops."""


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
    return Designs(prime_radius=radius, rise_law=(named := canonical_law(law)), return_law=named, **angles, **own)


def exact_rows(effort: Effort) -> Iterator[BenchRow]:
    """Laws, cam points, extremes, sweeps, and minimum radii beside their rivals."""
    timer, few = effort.timer, effort.unit(RIVAL_STATIONS)
    yield from _laws(effort.law_stations, effort.unit(effort.law_stations), timer)
    yield from _cam_points(effort.cam_stations, effort.unit(effort.cam_stations), few, timer)
    for follower in FOLLOWER_KINDS:
        seconds = timer.seconds(scene(follower, "3-4-5").cam.extremes)
        yield few.row(f"extremes, {follower}", "pressure angles and minimum convex radius", seconds)
    yield from _undercuts(timer)
    yield from _sweeps(effort.unit(STATIONS, LOOPED_DESIGNS), timer)
    yield from _least_radii(few, timer)
    yield from _sums(timer)
    yield from _three_points(timer)


def _mixed(places: Floats) -> Floats:
    """The places in a random order, which is always the same."""
    return np.random.default_rng(2).permutation(places)


def _in_any_order(name: str, mixed: float, growing: float, floor: float) -> BenchRow:
    """The time at places in any order beside that at the same places in growing order.

    floor : the time that finding each one's piece takes alone [s], of which a missed goal is told
    """
    missing = f"with finding each one's piece it is {1 + floor / growing:.3g} at least"
    return Unit("times sorted", growing).row(name, "places in any order", mixed, "<= 1.5", missing=missing)


def _laws(n: int, unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    u = np.linspace(0, 1, n)
    looked_up, in_order = timer.seconds(_look_up_places, n), timer.seconds(_bring_places_in_order, n)
    for name in LAWS:
        growing, mixed, goal = timer.seconds(law(name), u), timer.seconds(law(name), _mixed(u)), LAW_GOALS.get(name, "")
        yield unit.row(f"law {name}", f"f, f', f'', f''' at {n} places", growing, goal, reference.law_eps(name))
        alike = len({piece.formula for piece in law(name).pieces}) == 1
        yield _in_any_order(f"law {name}", mixed, growing, looked_up if alike else in_order)
    yield unit.row("law, any order, floor", "four sizes of a piece looked up", looked_up)
    yield unit.row("law, any order, floor", "brought in the order of the pieces, and back", in_order)


def _look_up_places(n: int) -> None:
    """What pieces of one formula take on top: the number of each place's piece, its origin, base and two factors."""
    places, sizes = np.random.default_rng(2).random(CHUNK_SIZE), np.ones(2)
    for _ in range(0, n, CHUNK_SIZE):
        number = (places >= 0.5).astype(np.intp)
        for _ in range(4):
            sizes.take(number)


def _bring_places_in_order(n: int) -> None:
    """What pieces of several formulas take on top: a radix sort of their numbers, and four values taken back."""
    places, out = np.random.default_rng(2).random(CHUNK_SIZE), np.empty(CHUNK_SIZE)
    back, count = np.empty(CHUNK_SIZE, dtype=np.intp), np.arange(CHUNK_SIZE)
    for _ in range(0, n, CHUNK_SIZE):
        number = (places >= 0.5).view(np.uint8) + (places >= 0.75).view(np.uint8)
        order = np.argsort(number, kind="stable")
        back[order] = count
        ordered = places.take(order)
        for _ in range(4):
            ordered.take(back, out=out, mode="clip")


def _cam_points(n: int, unit: Unit, few: Unit, timer: Timer) -> Iterator[BenchRow]:
    where, phi, some = scene("translating", "3-4-5"), turn(n), turn(RIVAL_STATIONS)
    motion, cam, mixed, at = where.board.motion, where.cam, _mixed(phi), f"at {n} stations"
    growing, in_order = timer.seconds(motion, phi), timer.seconds(_bring_places_in_order, n)
    yield unit.row("motion", f"s, v, a, j {at}", growing)
    yield _in_any_order("motion", timer.seconds(motion, mixed), growing, in_order)
    # As many as of one drawing: the overhead of a call counts.
    yield few.row("motion", f"s, v, a, j at {some.size} stations", timer.seconds(motion, some), "<= 100 µs")
    eps = reference.profile_eps(where)
    yield unit.row("profile", f"working profile {at}", timer.seconds(cam.profile, phi), error_eps=eps)
    what = f"pitch curve, profile and curvature {at}"
    bare = timer.seconds(_bare_cam_points, n)
    missing = f"{bare / unit.seconds:.2g} {unit.name} are the arithmetic alone, most of the rest new memory"
    yield unit.row("cam points", what, timer.seconds(cam.curves, phi), "<= 1.0", missing=missing)
    yield unit.row("cam points", "the same in any order", timer.seconds(cam.curves, mixed), "<= 1.6")
    yield unit.row("cam points, floor", "their arithmetic alone, in place", bare)


def _bare_cam_points(n: int) -> None:
    """The passes that no order of the computing saves: nothing is new memory, and nothing is chosen.

    Of the 3-4-5 law and its derivatives 21 products and sums and a quotient; of the sine and the cosine 8, a quotient
    and a tangent; of the curves 31, two quotients and a root.
    """
    x, y, out = np.ones(CHUNK_SIZE), np.ones(CHUNK_SIZE), np.empty(CHUNK_SIZE)
    for _ in range(0, n, CHUNK_SIZE):
        for _ in range(30):
            np.multiply(x, y, out)
            np.add(x, y, out)
        for _ in range(4):
            np.divide(x, y, out)
        np.sqrt(x, out)
        np.tan(x, out)


def _undercuts(timer: Timer) -> Iterator[BenchRow]:
    """A cam of many loops, which are all sought anew: time and memory."""
    phases = [(Rise, Return)[k % 2](0.5, FULL_TURN / LOBE_PHASES, "cosine") for k in range(LOBE_PHASES)]
    knife = Cam(Motion(phases), Translating(), 100.0)
    cam = replace(knife, follower=Translating(roller_radius=1.5 * largest_roller(knife)))
    what = f"{LOBE_PHASES} phases, {len(cam.undercuts())} loops"
    for name, work in (
        ("undercuts", lambda: replace(cam).undercuts()),
        ("trimmed profile", lambda: replace(cam).trimmed_profile(2000)),
    ):
        seconds = timer.seconds(work)
        yield MILLISECONDS.row(name, what, seconds, "<= 500")
        tracemalloc.start()
        work()
        memory = tracemalloc.get_traced_memory()[1] / 1e6
        tracemalloc.stop()
        yield BenchRow(name, f"{what}: maximum memory", memory, "MB", "<= 120", seconds=seconds)


def _sweeps(unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    """All quantities of a chunk of designs, beside a loop over some of them."""
    for follower, law_name in SWEPT_CASES:
        many, name = designs(follower, law_name, CHUNK_OF_DESIGNS), f"sweep, {follower}, {law_name}"
        some = many.part(slice(0, LOOPED_DESIGNS))
        seconds = timer.patient(SWEEP_RUNS).seconds(sweep, many) / CHUNK_OF_DESIGNS
        plain, looped = (timer.seconds(loop, some) / LOOPED_DESIGNS for loop in (_by_stations, _by_loop))
        swept = sweep(some, QUANTITIES[:3])
        exact = np.stack([swept[quantity] for quantity in QUANTITIES[:3]], axis=1)
        eps = float(np.abs(exact / _by_loop(some) - 1).max()) / reference.EPS
        yield unit.row(name, "all quantities of a design", seconds, "<= 1.6", eps)
        off = np.abs(_by_stations(some) / exact - 1).max()
        what = f"beside a loop in plain NumPy, {STATIONS} stations a phase: off by {off:.1e}"
        yield faster_than(seconds).row(name, what, plain, ">= 8")
        yield faster_than(seconds).row(name, "beside a loop over Cam.extremes, which finds the places too", looped)


_by_stations = partial(rivals.by_stations, n=STATIONS)


def _by_loop(some: Designs) -> list[list[float]]:
    """The maximum pressure angles and the minimum convex radius, one cam after another."""
    extremes = [some.cam(k).extremes() for k in range(len(some))]
    return [[e.pressure_angle_rise[0], e.pressure_angle_return[0], e.min_convex_radius[0]] for e in extremes]


def _least_radii(unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    free, arm, n = free_scene("3-4-5"), scene("arm", "3-4-5"), RIVAL_STATIONS
    motion, arm_motion, arm_limit = free.board.motion, arm.board.motion, arm.board.limits.rise
    # The cams alone: what a scene takes to say its limits is not in it.
    sized: dict[str, Callable[[], LeastRadius]] = {
        "translating": partial(minimum_radius, motion, Translating(), "cw", PERMITTED_ANGLE, PERMITTED_ANGLE),
        "arm": partial(minimum_radius, arm_motion, Oscillating(ARM), "ccw", arm_limit),
    }
    ours = {follower: timer.seconds(work) for follower, work in sized.items()}
    name, eps = "minimum prime radius", reference.least_radius_eps(free)
    yield unit.row(f"{name}, translating", "closed form", ours["translating"], "<= 5 µs", eps)
    yield unit.row(f"{name}, arm", "exchange of half-planes", ours["arm"])
    lines, arms = rivals.translating_lines(motion, PERMITTED_ANGLE, n), rivals.arm_lines(arm_motion, arm_limit, ARM, n)
    inside, given = ARM_INNER_POINT, "SLSQP given the half-planes"
    by_angles = partial(rivals.by_pressure_angles, motion, PERMITTED_ANGLE, n, (INNER_POINT[1], 0.0))
    # The optimiser as one would first use it, then with graphcam's own formulation and exact derivatives.
    beside: list[tuple[str, str, Callable[[], float], str]] = [
        ("translating", "SLSQP on pressure angles", by_angles, ">= 100"),
        ("translating", given, partial(rivals.by_optimiser, lines, INNER_POINT), ">= 100"),
        ("translating", "HalfspaceIntersection", partial(rivals.by_half_planes, lines, INNER_POINT), ""),
        ("arm", given, partial(rivals.by_optimiser, arms, inside), ">= 10"),
        ("arm", "SLSQP, linear constraints", partial(rivals.by_linear_constraints, arms, inside), ">= 10"),
    ]
    for follower, rival, work, goal in beside:
        what = f"beside {rival}, {n} stations: off by {work() / sized[follower]().prime_radius - 1:+.1e}"
        # A matrix routine that meets other work on its processors takes many times as long.
        seconds = timer.patient(RIVAL_RUNS).seconds(work)
        yield faster_than(ours[follower]).row(f"{name}, {follower}", what, seconds, goal)


def _sums(timer: Timer) -> Iterator[BenchRow]:
    """Running sums of values of one sign, beside numpy's own, against the correctly rounded sum."""
    values = np.random.default_rng(0).uniform(0.0, 1.0, 10_000_000)
    plain, exact = Unit("plain sums", timer.seconds(np.cumsum, values)), math.fsum(values)
    for name, goal, work in (("accurate", f"<= {FLOOR_FACTOR}", accurate_cumsum), ("plain", "", np.cumsum)):
        eps = abs(float(work(values)[-1]) - exact) / exact / reference.EPS
        yield plain.row(f"running sum, {name}", f"{values.size} values", timer.seconds(work, values), goal, eps)
    filled = timer.seconds(lambda: np.empty_like(values).fill(0.0))
    yield plain.row("running sum, floor", "new memory for the result", filled)


def _three_points(timer: Timer) -> Iterator[BenchRow]:
    """The order of the curvature through three points of the pitch curve, at equal and at unequal chords."""
    cam, at, steps = scene("translating", "3-4-5").cam, 0.6, 0.1 / 2 ** np.arange(8)

    def curvature(share: float) -> Floats:
        """The drawn curvatures [1/mm], the first chord so many times the second."""
        return 1 / circumradius(*(cam.pitch_curve(at + turned) for turned in (-share * steps, 0 * steps, steps)))

    for name, goal, share in (("equal", "2.00 ± 0.05", 1.0), ("unequal", "1.00 ± 0.05", 2.0)):
        errors = np.abs(curvature(share) - float(cam.pitch_curvature(at)))
        order, what = float(np.polyfit(np.log(steps), np.log(errors), 1)[0]), f"curvature, {name} chords"
        yield BenchRow("three points", what, order, "order", goal, seconds=timer.seconds(curvature, share))


EXACT_SECTION = Section(
    "exact",
    say("The exact side"),
    "Times are processor times; SC(N) is the time of N sines and N cosines in the same run. Rounding is in units of "
    "2.2e-16 of the maximum value, against 50 digits if mpmath is installed. Matrix routines share their processors "
    "badly: if other work runs, set OPENBLAS_NUM_THREADS=1.",
    exact_rows,
)

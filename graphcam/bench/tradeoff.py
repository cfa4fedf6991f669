"""Error against time, from the task to the result, for graphical, sampled and exact methods of six questions."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Literal

import numpy as np

from graphcam.bench import reference, rivals
from graphcam.bench.bench_followers import ARM, LIFT, PERMITTED_ANGLE, BenchFollower
from graphcam.bench.convergence import (
    BenchQuestion,
    as_complex,
    distance_from_profile,
    error_of,
    nearest_angles,
    questions,
)
from graphcam.bench.rows import Effort, Line, Parts, Section
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.words import say

INNER_POINT, ARM_INNER_POINT = (0.0, 3 * LIFT), (0.2 * ARM, 0.9 * ARM)
"""Points well inside the region for the cam centre [mm]."""
STATION_COUNT = 360
"""Stations of one turn at which the exact side is asked."""
TIMING_ROUNDS = 2
"""How often all points of a method are timed; the minimum time of each counts."""
Work = Callable[[int], object]
"""What a method does in n parts or stations."""


@dataclass(frozen=True)
class Method:
    """One way to answer a question.

    n : parts or stations, for each point;  pairs : times in sine-cosine pairs;  errors : relative
    """

    question: str
    name: str
    kind: Literal["graphical", "sampled", "exact"]
    n: Parts
    pairs: tuple[float, ...] = ()
    errors: tuple[float, ...] = ()


def methods(effort: Effort) -> Iterator[Method]:
    """All methods of all questions, each in the numbers of parts or stations that the effort gives for its kind."""
    asked = questions()
    for name, asks in asked.items():
        graphical = Method(name, "graphical", "graphical", effort.sizes[asks.kind])
        yield _timed_method(effort, graphical, partial(_drawn, asks), partial(_drawn_error, asks))
        for rival, kind, work, error in _rivals(name, asks.where):
            yield _timed_method(effort, Method(name, rival, "sampled", effort.sizes[kind]), work, error)
    for name, work, eps in _exact(asked):
        # Without a reference of more digits its own rounding cannot be seen: one eps stands for it.
        rounded = reference.EPS * (1.0 if eps is None else eps)
        exact = Method(name, "exact", "exact", (STATION_COUNT,))
        yield _timed_method(effort, exact, work, lambda _, rounded=rounded: rounded)


def _drawn(asks: BenchQuestion, n: int) -> object:
    return asks.where.chain(n)[asks.construction]


def _drawn_error(asks: BenchQuestion, n: int) -> float:
    return error_of(asks.where, asks.construction, asks.reading, asks.where.chain(n))


def _rivals(question: str, where: BenchFollower) -> Iterator[tuple[str, str, Work, Callable[[int], float]]]:
    """The usual alternatives to a question: name, kind, work, and relative error."""
    motion, cam = where.board.motion, where.cam

    def beside(work: Callable[[int], Any], exact: Callable[[int], Any]) -> tuple[Work, Callable[[int], float]]:
        """The work, and its maximum error, as a part of the maximum exact value."""
        return work, lambda n: float(np.max(np.abs(np.subtract(work(n), exact(n)))) / np.max(np.abs(exact(n))))

    match question:
        case "displacement":
            for name, integrator in rivals.INTEGRATORS.items():
                s = beside(partial(rivals.integrated, motion, integrator), partial(rivals.rises, motion))
                yield name, "integrators", *s
        case "minimum prime radius" | "minimum prime radius, arm":
            lines, inside = partial(rivals.translating_lines, motion, PERMITTED_ANGLE), INNER_POINT
            if question.endswith("arm"):
                lines, inside = partial(rivals.arm_lines, motion, where.board.limits.rise, ARM), ARM_INNER_POINT
            radius = where.exact_least_radius().prime_radius
            for name, kind, solve in (
                ("HalfspaceIntersection", "half_planes", rivals.by_half_planes),
                ("SLSQP", "optimiser", rivals.by_optimiser),
            ):
                yield name, kind, *beside(lambda n, solve=solve: solve(lines(n), inside), lambda _: radius)
        case "pressure angle":
            e, s0 = cam.sigma * where.sizes.place, math.sqrt(where.sizes.prime_radius**2 - where.sizes.place**2)
            angles = beside(
                lambda n: rivals.pressure_angles(motion(turn(n))[0], turn(n), s0, e),
                lambda n: cam.pressure_angle(turn(n)),
            )
            yield "np.gradient", "integrators", *angles
        case "curvature":
            radius = cam.extremes().min_convex_radius[0]
            sharpest = beside(lambda n: rivals.min_convex_radius(cam.pitch_curve(turn(n)), turn(n)), lambda _: radius)
            yield "np.gradient", "integrators", *sharpest
        case _:
            if rivals.optional("shapely"):
                yield "shapely buffer", "buffer", partial(_buffered, where), partial(_buffered_error, where)


def _exact(asked: Mapping[str, BenchQuestion]) -> Iterator[tuple[str, Work, float | None]]:
    """Every question's exact answer, with its rounding [eps]."""
    fixed, free, arm, *_ = (asks.where for asks in asked.values())
    cam, motion = fixed.cam, fixed.board.motion
    yield "displacement", lambda n: motion(turn(n)), reference.displacement_eps(fixed)
    yield "minimum prime radius", lambda _: free.exact_least_radius(), reference.least_radius_eps(free)
    yield "minimum prime radius, arm", lambda _: arm.exact_least_radius(), reference.arm_radius_eps(arm)
    yield "pressure angle", lambda n: cam.pressure_angle(turn(n)), reference.pressure_angle_eps(fixed)
    yield "curvature", lambda _: cam.extremes(), reference.curvature_eps(fixed)
    yield "profile", lambda n: cam.profile(turn(n)), reference.profile_eps(fixed)


def _timed_method(effort: Effort, method: Method, work: Work, error: Callable[[int], float]) -> Method:
    # In rounds, so that a disturbance of the machine spoils no point in all of them.
    rounds = [[effort.timer.seconds(work, n) / effort.pair for n in method.n] for _ in range(TIMING_ROUNDS)]
    return replace(method, pairs=tuple(np.min(rounds, axis=0).tolist()), errors=tuple(map(error, method.n)))


def _buffered(where: BenchFollower, n: int) -> Floats:
    """The corners of the profile about n points of the pitch curve [mm]."""
    return rivals.buffered(where.cam.pitch_curve(turn(n)), where.sizes.roller_radius)


def _buffered_error(where: BenchFollower, n: int) -> float:
    """How far corners lie off the profile at most, as a part of the prime radius."""
    corners = as_complex(_buffered(where, n))
    some = corners[:: max(1, corners.size // 2000)]
    off = distance_from_profile(where.cam, some, nearest_angles(where.cam, some))
    return float(np.abs(off).max()) / where.sizes.prime_radius


def turn(n: int) -> Floats:
    """(n,) equal steps of one turn [rad]."""
    return np.linspace(0, FULL_TURN, n, endpoint=False)


def _texts(found: Sequence[Method], _: float) -> Iterator[list[str]]:
    yield ["question", "method", "n", "time, pairs", "relative error"]
    for m in found:
        for n, pairs, error in zip(m.n, m.pairs, m.errors, strict=True):
            yield [m.question, m.name, str(n), f"{pairs:.3g}", f"{error:.1e}"]


def _lines(m: Method) -> Iterator[Line]:
    of = {"section": "time", "subject": m.name, "quantity": m.question, "remark": m.kind}
    for n, pairs, error in zip(m.n, m.pairs, m.errors, strict=True):
        times = {"ratio": pairs, "ratio_unit": "sine-cosine pairs"}
        yield {**of, "n": n, "error": error, "error_unit": "relative", **times}


METHODS = Section(
    "error_against_time",
    say("Error against time"),
    "From the task to the result, including everything in between. Times are in pairs of a sine and a cosine: one pair "
    "took {pair_ns:.1f} ns on this machine.",
    methods,
    _texts,
    _lines,
    derived=(),
    brief=False,
)

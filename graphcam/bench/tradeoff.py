"""Error against time, from the task to the result, for graphical, sampled and exact methods of three questions."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np

from graphcam.bench import reference, rivals
from graphcam.bench.bench_followers import LIFT, MAIN_LAW, PERMITTED_ANGLE, BenchFollower, free_scene, scene
from graphcam.bench.convergence import as_complex, distance_from_profile, error_of, nearest_angles
from graphcam.bench.rows import Effort, Line, Parts, Section
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.words import say

INNER_POINT = (0.0, 3 * LIFT)
"""A point well inside the region for the cam centre [mm]."""
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
    fixed, free, sizes = scene("translating", MAIN_LAW), free_scene(MAIN_LAW), effort.sizes
    motion, cam, free_motion, least = (
        fixed.board.motion,
        fixed.cam,
        free.board.motion,
        free.exact_least_radius().prime_radius,
    )
    displacement, radius, profile = "displacement", "minimum prime radius", "profile"

    def sampled(question: str, name: str, kind: str, work: Work, error: Callable[[int], float]) -> Method:
        """A method that takes samples, timed."""
        return _timed_method(effort, Method(question, name, "sampled", sizes[kind]), work, error)

    def drawn(question: str, kind: str, where: BenchFollower, construction: str, reading: str) -> Method:
        """A row of a reading of a construction, by the number of parts of a phase."""
        method, error = Method(question, "graphical", "graphical", sizes[kind]), partial(error_of, where, construction)
        return _timed_method(
            effort, method, lambda n: where.chain(n)[construction], lambda n: error(reading, where.chain(n))
        )

    def exact(question: str, work: Work, eps: float | None) -> Method:
        """Without a reference of more digits its own rounding cannot be seen: one eps stands for it."""
        error = reference.EPS * (1.0 if eps is None else eps)
        return _timed_method(effort, Method(question, "exact", "exact", (STATION_COUNT,)), work, lambda _: error)

    yield drawn(displacement, "graphical", fixed, "integration", "s")
    for name, integrator in rivals.INTEGRATORS.items():
        error = partial(rivals.integrated_error, motion, integrator)
        yield sampled(displacement, name, "integrators", partial(rivals.integrated, motion, integrator), error)
    yield drawn(radius, "graphical", free, "minimum_radius", "prime_radius")
    for name, kind, solve in (
        ("HalfspaceIntersection", "half_planes", rivals.by_half_planes),
        ("SLSQP", "optimiser", rivals.by_optimiser),
    ):

        def found(n: int, solve: Callable[[rivals.Lines, rivals.Point], float] = solve) -> float:
            """The minimum prime radius [mm] by n lines."""
            return solve(rivals.translating_lines(free_motion, PERMITTED_ANGLE, n), INNER_POINT)

        yield sampled(radius, name, kind, found, lambda n, found=found: abs(found(n) / least - 1))
    yield drawn(profile, "profile", fixed, "working_profile", "radius")
    if rivals.optional("shapely"):
        buffered = partial(_buffered, fixed)
        yield sampled(profile, "shapely buffer", "buffer", buffered, partial(_buffered_error, fixed))
    yield exact(displacement, lambda n: motion(turn(n)), reference.displacement_eps(fixed))
    yield exact(radius, lambda _: free.exact_least_radius(), reference.least_radius_eps(free))
    yield exact(profile, lambda n: cam.profile(turn(n)), reference.profile_eps(fixed))


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
    return float(off.max()) / where.sizes.prime_radius


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

"""Error against time, from the task to the result, for graphical, sampled and exact methods of three questions."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np

from graphcam.bench import convergence, reference, rivals
from graphcam.bench.scenes import LIFT, LIMIT, TestScene, free_scene, scene
from graphcam.bench.timing import Timer
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN

LAW = "cycloidal"
INSIDE = (0.0, 3 * LIFT)
"""A point well inside the region for the cam centre [mm]."""
STATIONS = 360
"""Stations of one turn at which the exact side is asked."""
ROUNDS = 2
"""How often all points of a method are timed; the minimum time of each counts."""
CHECKED = 24
"""Places at which the exact side is held against 50 digits."""
Kind = Literal["graphical", "sampled", "exact"]
Parts = tuple[int, ...]
"""Numbers of parts a phase, or of stations."""


@dataclass(frozen=True)
class Method:
    """One way to answer a question.

    n : parts or stations, for each point;  pairs : times in sine-cosine pairs;  errors : relative
    """

    question: str
    name: str
    kind: Kind
    n: Parts
    pairs: tuple[float, ...]
    errors: tuple[float, ...]


@dataclass(frozen=True)
class TimedSizes:
    """The numbers of parts or stations up to which the methods are taken."""

    graphical: Parts
    profile: Parts
    integrators: Parts
    half_planes: Parts
    optimiser: Parts
    buffer: Parts


@dataclass(frozen=True)
class Trial:
    """A method before it is timed: its work in n parts or stations, and the error of what comes out."""

    question: str
    name: str
    kind: Kind
    counts: Parts
    work: Callable[[int], object]
    error: Callable[[int], float]


def tradeoff(sizes: TimedSizes, timer: Timer, pair: float) -> list[Method]:
    """All methods of all questions; ``pair`` is the time of one sine and one cosine [s]."""
    fixed, free = scene("translating", LAW), free_scene(LAW)
    ways = [*_displacement(fixed, sizes), *_least_radius(free, sizes), *_profile(fixed, sizes), *_exact(fixed, free)]
    return [_timed(way, timer, pair) for way in ways]


def _timed(way: Trial, timer: Timer, pair: float) -> Method:
    # In rounds, so that a disturbance of the machine spoils no point in all of them.
    rounds = [[timer.seconds(partial(way.work, n)) / pair for n in way.counts] for _ in range(ROUNDS)]
    times, errors = np.min(rounds, axis=0).tolist(), map(way.error, way.counts)
    return Method(way.question, way.name, way.kind, way.counts, tuple(times), tuple(errors))


def _drawn(question: str, counts: Parts, where: TestScene, construction: str, reading: str) -> Trial:
    """The trial of a construction, drawn anew with all that it starts from."""

    def work(n: int) -> object:
        """The construction in n parts."""
        return where.chain(n)[construction]

    error = partial(convergence.error_of, where, construction, reading)
    return Trial(question, "graphical", "graphical", counts, work, lambda n: error(where.chain(n)))


def _displacement(where: TestScene, sizes: TimedSizes) -> Iterator[Trial]:
    motion = where.board.motion
    yield _drawn("displacement", sizes.graphical, where, "integration", "s")
    for name, method in rivals.INTEGRATORS.items():

        def work(n: int, method: rivals.Integrator = method) -> object:
            """Every phase integrated from n samples."""
            return [method(phi, a) for phi, a in rivals.samples(motion, n)]

        error = partial(rivals.integrated_error, motion, method=method)
        yield Trial("displacement", name, "sampled", sizes.integrators, work, error)


def _least_radius(where: TestScene, sizes: TimedSizes) -> Iterator[Trial]:
    motion, exact = where.board.motion, where.least().prime_radius
    yield _drawn("minimum prime radius", sizes.graphical, where, "minimum_radius", "prime_radius")
    solvers = (
        ("HalfspaceIntersection", rivals.by_half_planes, sizes.half_planes),
        ("SLSQP", rivals.by_optimiser, sizes.optimiser),
    )
    for name, solve, counts in solvers:

        def work(n: int, solve: rivals.Solver = solve) -> float:
            """The minimum radius of n lines [mm]."""
            return solve(rivals.translating_lines(motion, LIMIT, n), INSIDE)

        yield Trial(
            "minimum prime radius", name, "sampled", counts, work, lambda n, work=work: abs(work(n) / exact - 1)
        )


def _profile(where: TestScene, sizes: TimedSizes) -> Iterator[Trial]:
    cam = where.cam
    yield _drawn("profile", sizes.profile, where, "working_profile", "radius")

    def work(n: int) -> Floats:
        """The corners of the profile about n points of the pitch curve [mm]."""
        return rivals.buffered(cam.pitch_curve(turn(n)), where.sizes.roller_radius)

    def error(n: int) -> float:
        """How far corners lie off the profile at most, as a part of the prime radius."""
        corners = convergence.as_complex(work(n))
        some = corners[:: max(1, corners.size // 2000)]
        off = convergence.distance_from_profile(cam, some, convergence.nearest_angles(cam, some))
        return float(off.max()) / where.sizes.prime_radius

    if rivals.optional("shapely"):
        yield Trial("profile", "shapely buffer", "sampled", sizes.buffer, work, error)


def _exact(fixed: TestScene, free: TestScene) -> Iterator[Trial]:
    motion, cam = fixed.board.motion, fixed.cam
    exact: list[tuple[str, Callable[[int], object], Callable[[], float]]] = [
        ("displacement", lambda n: motion(turn(n)), partial(exact_displacement_error, fixed)),
        ("minimum prime radius", lambda _: free.least(), partial(exact_least_radius_error, free)),
        ("profile", lambda n: cam.profile(turn(n)), partial(exact_profile_error, fixed)),
    ]
    for question, work, error in exact:
        # Without a reference of more digits the exact side's own rounding cannot be seen: one eps stands for it.
        shown = error() if reference.available() else reference.EPS
        yield Trial(question, "exact", "exact", (STATIONS,), work, lambda _, shown=shown: shown)


def turn(n: int) -> Floats:
    """(n,) equal steps of one turn [rad]."""
    return np.linspace(0, FULL_TURN, n, endpoint=False)


def exact_displacement_error(where: TestScene) -> float:
    """The maximum error of the exact s on the rise, relative to the lift; needs mpmath."""
    u = inner_places()
    return float(np.abs(where.board.motion.at(0, u)[0] / LIFT - reference.law_values(where.law, u)[0]).max())


def exact_least_radius_error(where: TestScene) -> float:
    """The relative error of the exact minimum radius; needs mpmath."""
    return abs(where.least().prime_radius / reference.least_radius(where) - 1)


def exact_profile_error(where: TestScene) -> float:
    """The maximum error of an exact coordinate on the rise, relative to the prime radius; needs mpmath."""
    u = inner_places()
    exact = where.cam.profile(where.board.motion.angle_at(0, u))
    return float(np.abs(exact - reference.profile_points(where, u)).max()) / where.sizes.prime_radius


def inner_places() -> Floats:
    """Places inside a phase, the same in every run."""
    return np.random.default_rng(0).uniform(0.01, 0.99, CHECKED)

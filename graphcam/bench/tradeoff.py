"""Error against time, from the task to the result, for graphical, sampled and exact methods of three questions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphcam.bench import reference
from graphcam.bench.convergence import (
    as_complex,
    displacement_error,
    distance_from_profile,
    least_radius_error,
    nearest_angles,
    profile_error,
)
from graphcam.bench.rivals import (
    INTEGRATORS,
    buffered,
    by_half_planes,
    by_optimiser,
    integrated_error,
    optional,
    samples,
    translating_lines,
)
from graphcam.bench.scenes import LIFT, LIMIT, TestScene, free_scene, scene
from graphcam.bench.timing import Timer
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN

LAW = "cycloidal"
INSIDE = (0.0, 3 * LIFT)
"""A point well inside the region for the cam centre [mm]."""
STATIONS = 360
"""At which the exact side is asked, of one turn."""
ROUNDS = 2
"""How often all points of a method are timed; the least time of each counts."""
CHECKED = 24
"""Places at which the exact side is held against 50 digits."""
Kind = Literal["graphical", "sampled", "exact"]


@dataclass(frozen=True)
class Method:
    """One way to answer a question.

    n : parts or stations, for each point;  pairs : times in sine-cosine pairs;  errors : relative
    """

    question: str
    name: str
    kind: Kind
    n: tuple[int, ...]
    pairs: tuple[float, ...]
    errors: tuple[float, ...]


@dataclass(frozen=True)
class TimedSizes:
    """The numbers of parts or stations up to which the methods are taken."""

    graphical: tuple[int, ...]
    profile: tuple[int, ...]
    integrators: tuple[int, ...]
    half_planes: tuple[int, ...]
    optimiser: tuple[int, ...]
    buffer: tuple[int, ...]


def tradeoff(sizes: TimedSizes, timer: Timer, pair: float) -> list[Method]:
    """All methods of all questions; ``pair`` is the time of one sine and one cosine [s]."""
    fixed, free = scene("translating", LAW), free_scene(LAW)

    def points(
        question: str, name: str, kind: Kind, counts: Sequence[int], work: Callable[[int], object],
        error: Callable[[int], float],
    ) -> Method:  # fmt: skip
        # In rounds, so that a disturbance of the machine spoils no point in all of them.
        rounds = [[timer.seconds(lambda n=n: work(n)) / pair for n in counts] for _ in range(ROUNDS)]
        times = tuple(np.min(rounds, axis=0).tolist())
        return Method(question, name, kind, tuple(counts), times, tuple(error(n) for n in counts))

    motion = fixed.board.motion
    found = [
        points("displacement", "graphical", "graphical", sizes.graphical,
               lambda n: fixed.chain(n)["integration"], lambda n: displacement_error(fixed, fixed.chain(n))),
        *(
            points("displacement", name, "sampled", sizes.integrators,
                   lambda n, f=method: [f(phi, a) for phi, a in samples(motion, n)],
                   lambda n, f=method: integrated_error(motion, n, f))
            for name, method in INTEGRATORS.items()
        ),
        points("least radius", "graphical", "graphical", sizes.graphical,
               lambda n: free.chain(n)["minimum_radius"], lambda n: least_radius_error(free, free.chain(n))),
        points("least radius", "HalfspaceIntersection", "sampled", sizes.half_planes,
               lambda n: by_half_planes(translating_lines(motion, LIMIT, n), INSIDE),
               lambda n: _half_planes_off(free, n)),
        points("least radius", "SLSQP", "sampled", sizes.optimiser,
               lambda n: by_optimiser(translating_lines(motion, LIMIT, n), INSIDE),
               lambda n: _optimiser_off(free, n)),
        points("profile", "graphical", "graphical", sizes.profile,
               lambda n: fixed.chain(n)["working_profile"], lambda n: profile_error(fixed, fixed.chain(n))),
    ]  # fmt: skip
    if optional("shapely"):
        found.append(
            points("profile", "shapely buffer", "sampled", sizes.buffer,
                   lambda n: buffered(fixed.cam.pitch_curve(turn(n)), fixed.sizes.roller_radius),
                   lambda n: _buffer_off(fixed, n))
        )  # fmt: skip
    phi, cam = turn(STATIONS), fixed.cam
    exact: list[tuple[str, Callable[[], object], float | None]] = [
        ("displacement", lambda: motion(phi), exact_displacement_error(fixed)),
        ("least radius", free.least, exact_least_radius_error(free)),
        ("profile", lambda: cam.profile(phi), exact_profile_error(fixed)),
    ]
    for question, work, error in exact:
        # Without a reference of more digits the exact side's own rounding cannot be seen: one eps stands for it.
        shown = reference.EPS if error is None else error
        found.append(Method(question, "exact", "exact", (STATIONS,), (timer.seconds(work) / pair,), (shown,)))
    return found


def turn(n: int) -> Floats:
    """(n,) equal steps of one turn [rad]."""
    return np.linspace(0, FULL_TURN, n, endpoint=False)


def exact_displacement_error(where: TestScene) -> float | None:
    """The greatest error of the exact s on the rise, relative to the lift; None without mpmath."""
    if not reference.available():
        return None
    u = inner_places()
    return float(np.abs(where.board.motion.at(0, u)[0] / LIFT - reference.law_values(where.law, u)[0]).max())


def exact_least_radius_error(where: TestScene) -> float | None:
    """The relative error of the exact least radius; None without mpmath."""
    return abs(where.least().prime_radius / reference.least_radius(where) - 1) if reference.available() else None


def exact_profile_error(where: TestScene) -> float | None:
    """The greatest error of an exact coordinate on the rise, relative to the prime radius; None without mpmath."""
    if not reference.available():
        return None
    u = inner_places()
    exact = where.cam.profile(where.board.motion.angle_at(0, u))
    return float(np.abs(exact - reference.profile_points(where, u)).max()) / where.sizes.prime_radius


def inner_places() -> Floats:
    """Places inside a phase, the same in every run."""
    return np.random.default_rng(0).uniform(0.01, 0.99, CHECKED)


def _half_planes_off(where: TestScene, n: int) -> float:
    return abs(by_half_planes(translating_lines(where.board.motion, LIMIT, n), INSIDE) / where.least().prime_radius - 1)


def _optimiser_off(where: TestScene, n: int) -> float:
    return abs(by_optimiser(translating_lines(where.board.motion, LIMIT, n), INSIDE) / where.least().prime_radius - 1)


def _buffer_off(where: TestScene, n: int) -> float:
    corners = as_complex(buffered(where.cam.pitch_curve(turn(n)), where.sizes.roller_radius))
    some = corners[:: max(1, corners.size // 2000)]
    return (
        float(distance_from_profile(where.cam, some, nearest_angles(where.cam, some)).max()) / where.sizes.prime_radius
    )

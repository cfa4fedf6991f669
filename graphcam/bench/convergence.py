"""Error against the number of parts: every construction of every scene beside its exact counterpart, and how tight the
bounds of the double integration are: the proved one and the estimate, over the error that is made.

All errors are relative: to the maximum exact value of the quantity, lengths on the cam to the prime radius.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from graphcam.bench.bench_followers import BENCH_LAWS, FOLLOWER_KINDS, MAIN_LAW, BenchFollower, free_scene, scene
from graphcam.bench.rows import EMPTY_CELL, BenchRow, Line, Parts, Section
from graphcam.comparison.double_integration import chord_errors
from graphcam.comparison.quantities import Comparison, side_of
from graphcam.constructions.chain import Chain
from graphcam.given.laws import LAWS, Floats, LawName, law as law_of
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.kinematics import Complexes
from graphcam.words import say

PARTS = (6, 8, 12, 16, 24, 32, 48, 64, 96)
FITTED_PARTS = (12, 24, 48, 96)
"""The numbers of parts through which the order is fitted."""
EXACT_ERROR_LIMIT = 1e-12
"""A relative error below this is rounding: the construction is exact."""
SEARCH_ROUNDS, SEARCH_SAMPLES, SEARCH_NARROWING = 6, 41, 10.0
"""The nested search for the nearest place of the profile ends within 1e-7 rad, 1e-14 of a radius across the profile."""


@dataclass(frozen=True)
class Series:
    """The relative errors of one quantity, by the number of parts."""

    follower: str
    law: str
    construction: str
    quantity: str
    parts: Parts
    errors: tuple[float, ...]

    @property
    def exact(self) -> bool:
        """Whether nothing but rounding is left."""
        return max(self.errors) < EXACT_ERROR_LIMIT

    @property
    def order(self) -> float | None:
        """p of error ~ 1/n^p, fitted by least squares to the logarithms; None for an exact construction."""
        return None if self.exact else fitted_order(self.parts, self.errors)

    @property
    def n2_error(self) -> float:
        """The maximum of n^2 times the error: the error is at most this over n^2, however it oscillates."""
        return max(n * n * error for n, error in zip(self.parts, self.errors, strict=True))


def fitted_order(parts: Sequence[int], errors: Sequence[float]) -> float | None:
    """The order of convergence over n = 12, 24, 48, 96, or over all parts if fewer than two of these are there.

    >>> fitted_order((6, 12, 24), (9.0, 1.0, 0.25))
    2.0
    """
    pairs = [(n, error) for n, error in zip(parts, errors, strict=True) if n in FITTED_PARTS]
    if len(pairs) < 2:
        pairs = list(zip(parts, errors, strict=True))
    if len(pairs) < 2 or not all(error > 0 for _, error in pairs):
        return None
    n, error = np.log(np.array(pairs, dtype=np.float64)).T
    return round(-float(np.polyfit(n, error, 1)[0]), 12)


def convergence(parts: Sequence[int] = PARTS, laws: Sequence[str] = BENCH_LAWS) -> list[Series]:
    """The errors of all constructions of all scenes."""
    scenes = (scene(follower, law) for follower in FOLLOWER_KINDS for law in laws)
    return [series for where in scenes for series in series_of(where, {n: where.chain(n) for n in parts})]


def series_of(where: BenchFollower, chains: Mapping[int, Chain]) -> list[Series]:
    """The errors of every reading whose constructions say how its convergence is measured, by the number of parts."""
    first, parts = next(iter(chains.values())), tuple(chains)
    return [
        Series(where.follower, where.law, name, said.quantity, parts, tuple(map(error, chains.values())))
        for name, construction in first.items()
        for reading, meaning in construction.meaning.readings.items()
        # Without a roller the profile is not the envelope of its circles.
        if (said := meaning.converges) and (said.measured != "from the profile" or where.sizes.roller_radius)
        for error in [partial(error_of, where, name, reading)]
    ]


def error_of(where: BenchFollower, construction: str, reading: str, chain: Chain) -> float:
    """The maximum relative error of a reading, measured as its meaning says.

    >>> where = scene("translating", "cycloidal")
    >>> error_of(where, "integration", "s", where.chain(24)) < error_of(where, "integration", "s", where.chain(12)) / 3
    True
    """
    return float(np.nanmax(np.abs(errors_of(where, construction, reading, chain))))


def errors_of(where: BenchFollower, construction: str, reading: str, chain: Chain) -> Floats:
    """(hands, places) the relative errors of a reading, measured as its meaning says; NaN where nothing is drawn."""
    drawn, phi = chain[construction], chain.board.stations.phi
    said = drawn.meaning.reading(reading).converges
    assert said is not None
    sides = next((compared.sides for compared in drawn.meaning.reading(reading).compared if compared.sides), "")
    read = said.of or sides or reading
    value = np.atleast_2d(drawn.readings[read].value)
    match said.measured:
        case "value":
            # Of several candidates the first, of two sides the exact one's; else one reading of every hand.
            place = side_of(where.exact[said.exact]) if sides else 0
            return (value[:, [place]] if said.of or sides else value.T) / where.exact[said.exact] - 1
        case "at stations":
            at = Comparison(chain, where.cam).exact_stations
            there = {**dict(zip("sva", at.values, strict=False)), "pressure_angle": at.pressure_angle}[said.exact]
            return (value - there) / np.abs(there).max()
        case "from the pitch curve":
            points = drawn.readings["x"].value + 1j * drawn.readings["y"].value
            off = np.abs(np.atleast_2d(points) - as_complex(where.cam.pitch_curve(phi)))
        case "from the profile":
            touch = np.atleast_2d(drawn.points["touch"] * drawn.readings[read].per_mm)
            kept, off = np.isfinite(touch), np.full(touch.shape, np.nan)  # what another circle covers is not drawn
            off[kept] = distance_from_profile(where.cam, touch[kept], np.broadcast_to(phi, touch.shape)[kept])
    return off / where.sizes.prime_radius


class BenchQuestion(NamedTuple):
    """What drawn, sampled and exact methods are asked, each in its own way.

    kind : by which the numbers of parts are chosen
    """

    where: BenchFollower
    construction: str
    reading: str
    kind: str = "graphical"


def questions() -> Mapping[str, BenchQuestion]:
    """The questions by their names.

    >>> [*questions()]
    ['displacement', 'minimum prime radius', 'minimum prime radius, arm', 'pressure angle', 'curvature', 'profile']
    """
    fixed, free, arm = scene("translating", MAIN_LAW), free_scene(MAIN_LAW), scene("arm", MAIN_LAW)
    return {
        "displacement": BenchQuestion(fixed, "integration", "s"),
        "minimum prime radius": BenchQuestion(free, "minimum_radius", "prime_radius"),
        "minimum prime radius, arm": BenchQuestion(arm, "minimum_radius", "prime_radius"),
        "pressure angle": BenchQuestion(fixed, "pressure_angle", "alpha"),
        "curvature": BenchQuestion(fixed, "curvature", "rho", "profile"),
        "profile": BenchQuestion(fixed, "working_profile", "radius", "profile"),
    }


def distance_from_profile(cam: Cam, points: Complexes, near: Floats, reach: float = math.radians(3)) -> Floats:
    """How far points lie outside a roller's exact profile, which passes each within ``reach`` [rad] of its angle."""
    phi = near
    for _ in range(SEARCH_ROUNDS):
        around = phi[:, None] + np.linspace(-reach, reach, SEARCH_SAMPLES)
        best = np.argmin(np.abs(as_complex(cam.profile(around)) - points[:, None]), axis=1)
        phi = around[np.arange(phi.size), best]
        reach /= SEARCH_NARROWING
    # Across the profile, so that what is left of the search along it does not count.
    at = as_complex(cam.profile(phi))
    normal = (as_complex(cam.pitch_curve(phi)) - at) / cam.roller_radius
    return ((points - at) * normal.conj()).real


def nearest_angles(cam: Cam, points: Complexes) -> Floats:
    """The cam angles [rad] at which the profile is seen from the cam centre in the direction of the points."""
    phi = np.linspace(0, 2 * math.pi, 3600, endpoint=False)
    seen = as_complex(cam.profile(phi))
    seen = seen / np.abs(seen)
    directions = points / np.abs(points)
    return phi[[int(np.argmin(np.abs(seen - direction))) for direction in directions]]


def as_complex(points: Floats) -> Complexes:
    """Points (..., 2) as complex numbers."""
    return points[..., 0] + 1j * points[..., 1]


def _texts(found: Sequence[Series], _: float) -> Iterator[list[str]]:
    laws = list(dict.fromkeys(s.law for s in found))
    cells: dict[tuple[str, str], dict[str, str]] = {}
    for s in found:
        n2_error = np.format_float_positional(round(s.n2_error, 3), 2, fractional=False, unique=False, trim="-")
        text = "exact" if s.exact else f"{s.order:.2f} ({n2_error})" if s.order else EMPTY_CELL
        cells.setdefault((s.follower, s.quantity), {})[s.law] = text
    yield ["follower", "quantity", *laws]
    for subject, by_law in cells.items():
        yield [*subject, *(by_law.get(law, EMPTY_CELL) for law in laws)]


def _lines(s: Series) -> Iterator[Line]:
    of = {"subject": s.follower, "law": s.law, "quantity": s.quantity, "error_unit": "relative"}
    for n, error in zip(s.parts, s.errors, strict=True):
        yield {**of, "n": n, "error": error, "remark": "exact" if s.exact else f"order {s.order}"}


CONVERGENCE = Section(
    "convergence",
    say("Error against the number of parts"),
    "Drawn with an ideal pencil: the fitted order p of error ~ 1/n^p over n = 12, 24, 48, 96 parts per phase, and in "
    "brackets the maximum of n² times the relative error. A maximum is read off a faired curve between the stations: "
    "its error stays below the bracket over n² but oscillates, so its order is not a whole number.",
    lambda effort: convergence(effort.parts, effort.laws),
    _texts,
    _lines,
    derived=("exact", "order", "n2_error"),
)

# --- bounds of the double integration ---------------------------------------------------------------------------------


def rows_of_law(name: LawName, parts: int) -> Iterator[BenchRow]:
    """The rows of one law and number of parts, by quantity; not where the drawing is exact.

    >>> for row in rows_of_law("3-4-5", 12):
    ...     print(row.what, round(row.ratio, 2))
    s in 12 parts: off by 4.1e-03, estimate 2.40 times it 1.32
    v in 12 parts: off by 6.1e-03, estimate 2.39 times it 1.42
    a in 12 parts: off by 9.5e-02, estimate 2.40 times it 1.05
    """
    where = scene("translating", name)
    comparison = Comparison(where.chain(parts), where.cam)
    board = comparison.drawn.board
    rise, span = board.motion.phases[0], board.stations.phases[0]
    exact, bounds = comparison.exact_stations.values, chord_errors(law_of(name), board.stations.u[span]).read()
    for power, (quantity, bound) in enumerate(zip("sva", bounds, strict=True)):
        off = comparison.drawn_stations[quantity] - exact[power]
        per_unit = rise.angle**power / board.motion.lift
        error, estimate, peak = (
            float(np.abs(values).max()) * per_unit
            for values in (off[span], comparison.bounds.at_stations("integration", quantity)[span], exact[power])
        )
        if error >= EXACT_ERROR_LIMIT * max(1.0, peak):
            what = f"{quantity} in {parts} parts: off by {error:.1e}, estimate {estimate / error:.2f} times it"
            tight = round(float(bound.max()) / error, 9)  # where it is the error itself, both are rounded
            yield BenchRow(f"proved bound, {name}", what, tight, "times the error", ">= 1")


BOUNDS_SECTION = Section(
    "bounds",
    say("Bounds of the double integration"),
    "The maximum proved bound for a rise's displacement, velocity or acceleration, over the maximum error of the "
    "construction; errors are relative to the lift, and to its derivatives over the phase. Beside it is the estimate "
    "from redrawings. Values that are drawn exactly are omitted.",
    lambda _: [row for name in LAWS for parts in (12, 48) for row in rows_of_law(name, parts)],
)

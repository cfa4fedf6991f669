"""Pencil error against the number of parts: more parts lower the method's error and raise the drawing error."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphcam.bench.bench_followers import FOLLOWER_KINDS, LIFT, MAIN_LAW, BenchFollower, motion_of, scene
from graphcam.bench.convergence import errors_of, questions
from graphcam.bench.rows import Line, Parts, Section
from graphcam.comparison.bounds import ErrorBudget
from graphcam.drafting.pencil import Pencil
from graphcam.given.laws import Floats
from graphcam.words import say

SIGMAS = (0.1, SIGMA := 0.2)
"""The errors of a line, of a setting and at the edge of the protractor, of good and of usual hands [mm]."""
PARTS = (3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 32, 48, 64, 96)
QUANTILES = (5.0, 95.0)
"""A band of drawings is between these percentiles."""
MIN_VARIANCE_SHARE = 0.01
"""The smallest share of the variance that is listed."""


@dataclass(frozen=True)
class Hands:
    """Errors of many drawings of the displacement of one rise, by the number of parts, relative to the lift.

    mean, low, high : the maximum error of a drawing, its mean and its quantiles over the drawings
    method : the same with an ideal pencil
    """

    law: str
    parts: Parts
    mean: tuple[float, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]
    method: tuple[float, ...]
    sigma_mm: float = SIGMA

    @property
    def best_parts(self) -> int:
        """The number of parts with the smallest mean error."""
        return self.parts[int(np.argmin(self.mean))]

    @property
    def floor(self) -> float:
        """The minimum of the mean errors, which drawing by hand does not improve."""
        return min(self.mean)

    @property
    def band(self) -> tuple[float, float]:
        """The quantiles at the best number of parts."""
        best = self.parts.index(self.best_parts)
        return self.low[best], self.high[best]


def by_hand(law: str, hands: int, parts: Sequence[int] = PARTS) -> Hands:
    """Draw one rise on a base of 120 mm, with an ordinate of 50 mm and poles of 40 mm."""
    fixed = scene("translating", law)
    where = replace(fixed, board=replace(fixed.board, motion=motion_of(law, LIFT, 120, 60, 120)))
    pencil = Pencil.of(SIGMA, hands)
    errors = np.array([shape_errors(where, n, pencil) for n in parts])
    mean, low, high = (
        tuple(band.tolist()) for band in (errors.mean(axis=1), *np.percentile(errors, QUANTILES, axis=1))
    )
    method = [float(shape_errors(where, n, Pencil(samples=1))[0]) for n in parts]
    return Hands(law, tuple(parts), mean, low, high, tuple(method))


def shape_errors(where: BenchFollower, parts: int, pencil: Pencil) -> Floats:
    """The maximum error of s on the rise in every drawing, relative to the lift."""
    chain = where.chain(parts, pencil)
    rise = chain.board.stations.phases[0]
    return np.abs(errors_of(where, "integration", "s", chain)[:, rise]).max(axis=1)


@dataclass(frozen=True)
class PencilError:
    """What a pencil leaves of a question in the usual number of parts, relative as the methods' errors.

    bias : how far the mean of many drawings is off, which no repetition removes; it contains the method's own error
    scatter : the standard deviation of one drawing
    """

    question: str
    sigma_mm: float
    bias: float
    scatter: float


def pencil_errors(hands: int, parts: int = 12) -> Iterator[PencilError]:
    """Bias and scatter of every question for every pencil; of a curve the maxima over its places."""
    for name, (where, construction, reading, _) in questions().items():
        for sigma in SIGMAS:
            errors = errors_of(where, construction, reading, where.chain(parts, Pencil.of(sigma, hands)))
            bias, scatter = np.abs(np.nanmean(errors, axis=0)).max(), np.nanstd(errors, axis=0).max()
            yield PencilError(name, sigma, float(bias), float(scatter))


def _texts_of_pencils(found: Sequence[PencilError], _: float) -> Iterator[list[str]]:
    yield ["question", "pencil", "bias", "scatter"]
    for p in found:
        yield [p.question, f"{p.sigma_mm:g} mm", f"{100 * p.bias:.2f} %", f"{100 * p.scatter:.2f} %"]


def _lines_of_pencil(p: PencilError) -> Iterator[Line]:
    of = {"subject": "graphical", "quantity": p.question, "error_unit": "relative"}
    for kind, error in (("bias", p.bias), ("scatter", p.scatter)):
        yield {**of, "error": error, "remark": f"{kind}, pencil {p.sigma_mm:g} mm"}


PENCIL_ERRORS = Section(
    "pencil_errors",
    say("What a pencil leaves"),
    "Drawn in 12 parts per phase by many hands: the bias is how far the mean of all drawings is off, with the method's "
    "own error; the scatter is the standard deviation of one drawing. Both are relative, as in the next table; of a "
    "curve they are the maxima over its places.",
    lambda effort: pencil_errors(effort.hands),
    _texts_of_pencils,
    _lines_of_pencil,
    derived=(),
)


@dataclass(frozen=True)
class BudgetRow:
    """What makes one reading of a construction scatter.

    deviation : standard deviation [mm of paper; an angle that was measured itself: rad]
    parts : of its variance by the kind of act, and what they bring together only
    """

    follower: str
    construction: str
    reading: str
    deviation: float
    parts: Mapping[str, float]


def budgets(law: str = MAIN_LAW, parts: int = 12) -> Iterator[BudgetRow]:
    """The error budget of every reading of every follower."""
    for follower in FOLLOWER_KINDS:
        chain = scene(follower, law).chain(parts)
        budget = ErrorBudget(chain, Pencil.of(SIGMA))
        for name, drawn in chain.items():
            for reading in drawn.meaning.readings:
                shares = budget.of(name, reading)
                brought = {kind.value: share for kind, share in shares.of.items()} | {"together": shares.together}
                yield BudgetRow(follower, name, reading, shares.deviation, brought)


def _texts_of_hands(found: Sequence[Hands], _: float) -> Iterator[list[str]]:
    yield ["law", "best number of parts", "mean error", "nine drawings in ten"]
    for h in found:
        low, high = h.band
        yield [h.law, str(h.best_parts), f"{100 * h.floor:.2f} %", f"{100 * low:.2f} to {100 * high:.2f} %"]


def _lines_of_hands(h: Hands) -> Iterator[Line]:
    of = {"subject": "translating", "law": h.law, "quantity": "displacement", "error_unit": "of the lift"}
    for n, mean, method in zip(h.parts, h.mean, h.method, strict=True):
        yield {**of, "n": n, "error": mean, "remark": f"of the method {method:.3g}" + ", best" * (n == h.best_parts)}


PENCIL_SECTION = Section(
    "pencil",
    say("Drawing error"),
    f"The maximum error of the displacement, as a part of the lift, over many drawings with errors of {SIGMA} mm in "
    "every line, every setting and at the edge of the protractor: the number of parts at which its mean is smallest, "
    "this mean, and the range of nine drawings in ten. If the method draws a law exactly, the smallest number of parts "
    "is the best.",
    lambda effort: [by_hand(law, effort.hands, effort.pencil_parts) for law in effort.laws],
    _texts_of_hands,
    _lines_of_hands,
    derived=("best_parts", "floor", "band"),
    words=1,
)


def _texts_of_budgets(found: Sequence[BudgetRow], _: float) -> Iterator[list[str]]:
    yield ["follower", "reading", "scatter", "due to, %"]
    for b in found:
        largest = sorted(b.parts.items(), key=lambda part: -part[1])
        brought = ", ".join(f"{kind} {100 * part:.0f}" for kind, part in largest if part >= MIN_VARIANCE_SHARE)
        yield [b.follower, f"{b.construction}: {b.reading}", f"{b.deviation:.3g}", brought]


def _lines_of_budget(b: BudgetRow) -> Iterator[Line]:
    of = {"section": "budget", "subject": b.follower, "quantity": f"{b.construction}: {b.reading}"}
    for kind, part in b.parts.items():
        yield {**of, "error": part, "error_unit": "of the variance", "remark": kind}


BUDGETS = Section(
    "error_budgets",
    say("Error budget of the drawing"),
    f"With drawing errors of {SIGMA} mm, 12 parts per phase: the standard deviation in mm of paper (for a measured "
    "angle in radians), and the share of its variance, in percent, that is due to the acts of each kind; "
    '"together" is the share that errors of several kinds have only in combination.',
    lambda _: budgets(),
    _texts_of_budgets,
    _lines_of_budget,
    derived=(),
    words=4,
    brief=False,
)

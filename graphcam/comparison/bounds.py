"""How far a drawn value may be off: by the number of parts, and by the hand.

The number of parts: the same construction is drawn again with every part divided in two, three and five, and a value
may be off by two and a half times the greatest change among these drawings.  An error that falls as 1/n^p changes by
at least (1 - 5^-p) of itself, so that covers it for every p from 1 on; several redrawings catch values whose error does
not fall evenly, such as maxima, or is small in the first of them by chance.

Where the drawings do not settle, that is, where their changes do not fall as those of any such order do (those of the
first are 1/2, 1/6 and 2/15 of its error, and fall more slowly than of a higher one), the spread says less: twice as
much of it is granted, and the quantity says so.

The hand: the same construction is drawn by many hands with the same pencil, and a value may be off by their bias and
three standard deviations.

The same hands draw once with all their errors, and once for every kind of act with those of that kind alone.  What a
hand is off in these drawings adds up to what it is off in the first, as far as a reading follows its errors in
proportion.  The acts err independently of one another, so then the variances add up too; what the sum leaves is what
errors do together, such as making the eye choose another place.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, pairwise
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.acts import Kind
from graphcam.drafting.ink import Construction
from graphcam.drafting.meaning import Rank
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.slips import SLIPS
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.showing import parts_text

REFINEMENTS = (2, 3, 5)
"""The numbers of parts into which every part is divided for the redrawings."""
CHANGE_TO_ERROR_FACTOR = 2.5
"""The bound is this many times the greatest change by a redrawing."""
UNSETTLED_FACTOR = 2.0
"""By so much a bound is wider where the drawings do not settle."""
LARGEST_FALL = 0.5
"""Of drawings that settle the second change is at most this part of the first, which of the first order is a third."""
DEVIATION_COUNT = 3.0
"""A hand is granted so many standard deviations."""
HAND_COUNT = 400
"""How many hands draw for the scatter; its own relative error is 1/sqrt(2 HAND_COUNT), about 4 %."""
ARITHMETIC_ERROR = 1e-9
"""What rounding of the arithmetic may move on the paper [mm]."""
CAREFUL_PENCIL = Pencil.of(0.2, samples=HAND_COUNT)
"""The hands whose answers are called right."""
HONEST_SHARE = 0.99
"""The share of their answers that is."""
HALF_DIVISION, HALF_DEGREE = 0.5, 0.5
"""How far a reading may be off by the rule [mm of paper], and by the protractor [degrees]."""
DEGREES_PER_RADIAN = math.degrees(1.0)


class HonestRange(NamedTuple):
    """Between which values answers lie that were honestly drawn, or computed."""

    low: float
    high: float


def honest_range(drawn: float, hands: Floats, per_mm: float, exact: float = math.nan) -> HonestRange:
    """The range of the honest answers for one reading.

    drawn, hands, exact : the values by a hand without error, by many of :data:`CAREFUL_PENCIL`, and computed
    per_mm : the scale of the paper, or the degrees in a radian for what is measured with a protractor

    >>> honest_range(25.0, np.array([24.0, 24.0, np.nan]), 0.5, exact=25.2)
    HonestRange(low=24.0, high=25.45)
    """
    read = HALF_DEGREE if math.isclose(per_mm, DEGREES_PER_RADIAN) else HALF_DIVISION * abs(per_mm)
    readable, half = hands[np.isfinite(hands)], (1 - HONEST_SHARE) / 2
    ends = np.quantile(readable, [half, 1 - half]) if readable.size else [drawn]
    near = [drawn - read, drawn + read, exact - read, exact + read, *ends]
    return HonestRange(float(np.nanmin(near)), float(np.nanmax(near)))


def turned_near(angles: Floats, angle: float) -> Floats:
    """Angles [rad], less the full turns that part them from one."""
    return angle + np.remainder(angles - angle + FULL_TURN / 2, FULL_TURN) - FULL_TURN / 2


class Redrawable(Protocol):
    """Constructions by name that can be drawn again."""

    @property
    def pencil(self) -> Pencil:
        """The hand that drew."""
        ...

    @property
    def spans(self) -> tuple[slice, ...]:
        """The stations of each phase among all stations."""
        ...

    def __getitem__(self, name: str, /) -> Construction: ...

    def redrawn(self, refine: int = 1, pencil: Pencil | None = None) -> Redrawable:
        """The cam with every part divided in ``refine``, drawn by another hand; by default one without error."""
        ...


@dataclass(frozen=True, eq=False)
class Bounds:
    """The bounds of the readings of one drawing, with its own pencil, at the sizes that were adopted."""

    drawn: Redrawable
    __repr__ = parts_text

    @cached_property
    def perfect(self) -> Redrawable:
        """The drawing by a hand without error."""
        return self.drawn.redrawn()

    @cached_property
    def finer(self) -> list[Redrawable]:
        """The redrawings with more parts, of the same cam."""
        return [self.drawn.redrawn(refine=k) for k in REFINEMENTS]

    @cached_property
    def hands(self) -> Redrawable | None:
        """The drawing by many hands; None for a perfect pencil."""
        pencil = self.drawn.pencil
        if pencil.perfect:
            return None
        return self.drawn.redrawn(pencil=replace(pencil, samples=pencil.samples or HAND_COUNT))

    @cached_property
    def careful(self) -> Redrawable:
        """The drawing by many careful hands, whatever pencil drew."""
        return self.drawn.redrawn(pencil=CAREFUL_PENCIL)

    def by_hands(self, construction: str, reading: str, place: int | None = None) -> Floats:
        """A reading, or one of several, by every careful hand (samples,)."""
        perfect, hands = (by[construction].readings[reading].at(place) for by in (self.perfect, self.careful))
        return turned_near(hands.value, float(perfect.value)) if perfect.unit == "rad" else hands.value

    def of(self, construction: str, reading: str) -> Floats:
        """How far the reading may be off, on the paper it was read from [mm; an angle: rad]."""
        return self._of(construction, reading) / self._per_mm(construction, reading) + ARITHMETIC_ERROR

    def settled(self, construction: str, reading: str) -> NDArray[np.bool_]:
        """Whether the changes of the reading by more and more parts fall, shaped like it."""
        return self._redrawn(construction, reading)[2]

    def of_choice(self, construction: str, candidates: str, ranks: Sequence[Rank]) -> float:
        """The bound for the candidate of highest rank among several that are read as ``candidates`` (..., k).

        The exact one ranks between the highest rank that any candidate surely has and the highest that any may have.
        NaN where a candidate cannot be read, or shows up in a finer redrawing only: how far it would be off is unknown,
        and so is whether it is the one.
        """
        values = np.asarray(self.perfect[construction].value(candidates))
        far: list[Floats] = []
        for rank in ranks:
            off = self._of(construction, candidates, rank)
            with np.errstate(invalid="ignore"):  # of what is infinite here and not in a finer redrawing
                highest = np.array([np.max(rank(values) + sign * off) for sign in (-1, 0, 1)])
            least, chosen, most = rank(highest)
            far.append(np.abs([least - chosen, most - chosen]))
        bound = float(np.max(np.fmin.reduce(far))) / self._per_mm(construction, candidates)
        return bound + ARITHMETIC_ERROR if np.isfinite(bound) else float("nan")

    def at_stations(self, construction: str, reading: str) -> Floats:
        """How far a reading at each station may be off, (m,) in machine units."""
        rounding = ARITHMETIC_ERROR * self._per_mm(construction, reading)
        return self._of(construction, reading, stations=True) + rounding

    def _per_mm(self, construction: str, reading: str) -> float:
        return self.drawn[construction].readings[reading].per_mm

    def _of(self, construction: str, reading: str, rank: Rank = np.positive, *, stations: bool = False) -> Floats:
        """The bound of the ranks in machine units, shaped like one drawing's reading; NaN where nothing is readable."""
        here, spread, settled = self._redrawn(construction, reading, rank, stations=stations)
        change = CHANGE_TO_ERROR_FACTOR * np.where(settled, 1.0, UNSETTLED_FACTOR) * spread
        if self.hands is None:
            return change
        values = np.ma.masked_invalid(rank(self.hands[construction].readings[reading].value))  # unreadable for a hand
        return change + np.ma.filled(np.abs(values.mean(axis=0) - here) + DEVIATION_COUNT * values.std(axis=0), np.nan)

    def _redrawn(
        self, construction: str, reading: str, rank: Rank = np.positive, *, stations: bool = False
    ) -> tuple[Floats, Floats, NDArray[np.bool_]]:
        """The ranks in machine units, how far the drawings lie apart, and whether their changes fall."""
        here: Floats = rank(np.asarray(self.perfect[construction].value(reading)))
        drawings = [here]
        for k, drawing in zip(REFINEMENTS, self.finer, strict=True):
            finer = rank(np.asarray(drawing[construction].value(reading)))
            if stations:  # a phase's stations stand k apart among its finer ones
                finer = np.concatenate([finer[span][::k] for span in drawing.spans])
            drawings.append(finer)
        # Infinite in both is no change.
        changes = [
            np.where(np.isnan(here), np.nan, np.subtract(b, a, out=np.zeros_like(a), where=b != a))
            for a, b in [*pairwise(drawings), *combinations(drawings, 2)]
        ]
        first, second, third = changes[: len(REFINEMENTS)]
        settled = (first * second >= 0) & (second * third >= 0) & (np.abs(third) <= np.abs(second))
        settled &= np.abs(second) <= LARGEST_FALL * np.abs(first)
        # fmax, because too fine parts may leave a reading unreadable: then the other redrawings speak.
        return here, np.fmax.reduce(np.abs(changes)), settled


@dataclass(frozen=True)
class Shares:
    """What makes one reading scatter; of several values, that which scatters most.

    deviation, bias : standard deviation, and how far the mean is off [mm of paper; an angle that was measured: rad]
    of : parts of the variance by the kind of act
    together : the part that errors of several kinds bring together only; with the others it makes 1
    """

    deviation: float
    bias: float
    of: Mapping[Kind, float]
    together: float


@dataclass(frozen=True, eq=False)
class ErrorBudget:
    """The error budget of one drawing, of the sizes that were adopted.

    drawn : the constructions
    pencil : the hand whose errors are told

    >>> import graphcam as gc
    >>> budget = ErrorBudget(gc.solve(gc.builtin_task()).chain, gc.Pencil.of(0.2))
    >>> shares = budget.of("integration", "max_v")
    >>> max(shares.of, key=shares.of.get).value
    'parallel'
    """

    drawn: Redrawable
    pencil: Pencil
    __repr__ = parts_text

    @cached_property
    def perfect(self) -> Redrawable:
        """The drawing by a hand without error."""
        return self.drawn.redrawn()

    @cached_property
    def hands(self) -> Mapping[Kind | None, Redrawable]:
        """The drawings by many hands: with all their errors, and with those of every kind of act in which they err."""
        erring = [kind for kind, slips in SLIPS.items() if any(self.pencil.deviation(kind, what) for what in slips)]
        by = replace(self.pencil, samples=self.pencil.samples or HAND_COUNT)
        alone = {kind: self.drawn.redrawn(pencil=replace(by, only=frozenset({kind}))) for kind in erring}
        return {None: self.drawn.redrawn(pencil=by), **alone}

    def of(self, construction: str, reading: str) -> Shares:
        """What makes a reading scatter; NaN where no hand can read it, or it does not scatter."""
        off = np.ma.masked_invalid([self._deviations(by, construction, reading) for by in self.hands.values()])
        off = np.ma.array(off.data, mask=np.broadcast_to(off.mask.any(axis=0), off.shape))  # in any of its drawings
        variances, rest = off.var(axis=1).filled(0.0), (off[0] - off[1:].sum(axis=0)).var(axis=0).filled(0.0)
        most = int(np.argmax(variances[0]))
        kinds, left = variances[1:, most], rest[most]
        with np.errstate(invalid="ignore"):
            parts, together = kinds / (kinds.sum() + left), left / (kinds.sum() + left)
        per_mm, mean = self.perfect[construction].readings[reading].per_mm, off[0].mean(axis=0).filled(0.0)
        deviation, bias = float(np.sqrt(variances[0, most])) / per_mm, float(mean[most]) / per_mm
        alone = [kind for kind in self.hands if kind]
        return Shares(deviation, bias, dict(zip(alone, parts.tolist(), strict=True)), float(together))

    def _deviations(self, hands: Redrawable, construction: str, reading: str) -> Floats:
        """How far every hand is off (samples, m), in machine units; of angles the turn that is less than half a one."""
        here, read = (each[construction].readings[reading] for each in (self.perfect, hands))
        with np.errstate(invalid="ignore"):
            off: Any = read.value - here.value
        off = off.reshape(len(off), -1)
        return turned_near(off, 0.0) if here.unit == "rad" else off

"""What a hand adds: errors of line, dividers and protractor, and the rounding of readings.

The default pencil is perfect and deterministic.  A pencil may carry many samples at once: then every point and reading
has a leading axis of that length, and one run of the arithmetic gives the scatter of all of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.drafting.acts import Floats, Kind
from graphcam.drafting.slips import PROTRACTOR_RADIUS, SLIPS
from graphcam.errors import DesignError, check_number
from graphcam.words import say


class Stream(Protocol):
    """Where a hand's errors come from, such as NumPy's generators."""

    def standard_normal(self, size: tuple[int, ...], /) -> Floats:
        """The next normal numbers of deviation one, in this shape."""
        ...


@dataclass(frozen=True)
class Pencil:
    """Standard deviations of drawing errors; :mod:`graphcam.drafting.slips` defines the error of each act.

    line : of a drawn line's or point's position [mm]
    dividers : of a length that dividers carry from one place to another [mm]
    division : of the scale that readings are rounded to [mm]; 0 reads exactly
    protractor : of a measured or laid off angle [rad]
    samples : number of drawings made at once; None for one, without a sample axis
    seed : of the random numbers; each construction has its own stream of them
    only : the kinds of acts that have errors, for an error budget; None for all.  The others' random numbers are drawn
        and not used, so pencils that differ only in this have the same errors in the acts that have errors in both

    >>> import graphcam as gc
    >>> gc.Pencil(line=0.2, samples=3).perfect
    False
    """

    line: float = 0.0
    dividers: float = 0.0
    division: float = 0.0
    protractor: float = 0.0
    samples: int | None = None
    seed: int = 0
    only: frozenset[Kind] | None = None

    @classmethod
    def of(cls, sigma: float, samples: int | None = None, seed: int = 0) -> Self:
        """A pencil with one number [mm]: the error of lines and settings, and at the edge of a protractor.

        >>> import graphcam as gc
        >>> hand = gc.Pencil.of(0.2)
        >>> hand.line, hand.dividers, hand.protractor
        (0.2, 0.2, 0.004)
        """
        return cls(sigma, sigma, protractor=sigma / PROTRACTOR_RADIUS, samples=samples, seed=seed)

    def __post_init__(self) -> None:
        for name in ("line", "dividers", "division", "protractor"):
            quantity = say("pencil {name}", name=name)
            check_number(quantity, getattr(self, name), say("a finite number of 0 or more"), least=0)
        if self.samples is not None and self.samples < 1:
            raise DesignError(say("pencil samples"), self.samples, say("1 or more, or None for a single drawing"))
        check_number(say("pencil seed"), self.seed, say("0 or more"), least=0)

    @property
    def perfect(self) -> bool:
        """Whether this pencil adds no error at all."""
        return not any(self.deviation(kind, what) for kind, slips in SLIPS.items() for what in slips)

    def deviation(self, kind: Kind, what: str) -> float:
        """The standard deviation of one error of an act [mm, or rad].

        >>> import graphcam as gc
        >>> from graphcam.drafting.acts import Kind
        >>> gc.Pencil(line=0.2).deviation(Kind.CIRCLE, "across")
        0.1
        """
        slip = SLIPS[kind][what]
        return slip.times * getattr(self, slip.of) if self.only is None or kind in self.only else 0.0

    def slips(self, kind: Kind, what: str, stream: Stream, shape: tuple[int, ...]) -> Floats:
        """The errors of one kind in acts of that shape [mm, or rad], drawn from a construction's random numbers."""
        return self.deviation(kind, what) * stream.standard_normal(shape)

    def read_off(self, lengths: Floats) -> Floats:
        """Lengths [mm] as they are read off a rule, rounded to its divisions.

        >>> import graphcam as gc
        >>> gc.Pencil(division=0.5).read_off(np.array([1.2, 1.3])).tolist()
        [1.0, 1.5]
        """
        division = self.division if self.deviation(Kind.READ, "length") else 0.0
        return np.round(lengths / division) * division if division else lengths

    def sheets(self, paper: ArrayLike) -> NDArray[Any]:
        """Lengths or points repeated on every sample's sheet: shaped ([samples,] ...).

        >>> import graphcam as gc
        >>> gc.Pencil(samples=3).sheets([1.0, 2.0]).shape
        (3, 2)
        """
        paper = np.asarray(paper)
        return paper if self.samples is None else np.broadcast_to(paper, (self.samples, *paper.shape))

    def stream(self, construction: str) -> Stream:
        """The stream of random numbers of one construction.

        They depend on the seed and the construction's name only, so that adding or omitting a construction never
        changes another.
        """
        return np.random.default_rng([self.seed, *construction.encode()])

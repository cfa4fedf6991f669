"""Careful hands whose errors are the same on every machine and with every version of NumPy."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from graphcam.drafting.pencil import Hand, Pencil

if TYPE_CHECKING:
    from graphcam.exercises.exercise import HandTable


@dataclass(frozen=True)
class SteadyPencil(Pencil):
    """A :class:`~graphcam.Pencil` with the stream of random numbers that NumPy promises never to change.

    Marks must not change with the version of a library, and a variant's parameters rest on them too.

    >>> bool(np.all(SteadyPencil(line=1.0, samples=1, seed=1).hand("inversion").line(2) ==
    ...             SteadyPencil(line=1.0, samples=1, seed=1).hand("inversion").line(2)))
    True
    """

    @staticmethod
    def of(hand: HandTable, samples: int, seed: int = 0) -> SteadyPencil:
        """The hands of an exercise."""
        protractor = math.radians(hand.protractor_deg)
        return SteadyPencil(hand.line, hand.dividers, hand.division, protractor, samples, seed)

    def hand(self, construction: str) -> Hand:
        """As of any pencil, but drawn from the frozen generator."""
        stream = np.random.RandomState([self.seed, *construction.encode()])
        return Hand(self, cast("Any", stream))

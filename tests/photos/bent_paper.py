"""Paper that curls or was folded: it bends about parallel lines only, and its lengths stay."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Points = NDArray[np.complex128]
REACH = 900.0
"""From the middle of the paper so far the bend is known, mm: pictures show table beside the paper."""
STEP = 0.5
"""Of the tables, mm."""
CREASE = 1.5
"""A fold that was flattened again is round over so many mm."""


@dataclass(frozen=True, eq=False)
class Bend:
    """How a sheet is bent.

    middle : of the paper, which stays where it is
    towards : unit, the direction on the paper in which the slope changes
    slope : (n,) radians at places from -REACH to REACH along it
    """

    middle: complex
    towards: complex
    slope: Floats

    @staticmethod
    def none(middle: complex) -> Bend:
        """A sheet that lies flat."""
        return Bend(middle, 1 + 0j, np.zeros_like(_along()))

    @staticmethod
    def curl(middle: complex, towards: complex, reach: float, lift: float, power: float = 1.0) -> Bend:
        """Both edges, at ``reach`` from the middle, lift by so much; the greater the power the more at the edge."""
        along = np.clip(_along() / reach, -1.3, 1.3)
        return Bend(middle, towards, np.arctan(np.sign(along) * np.abs(along) ** power * (power + 1) * lift / reach))

    @staticmethod
    def fold(middle: complex, towards: complex, places: tuple[float, ...], degrees: float) -> Bend:
        """Folded at places from the middle, and flattened again up to so many degrees."""
        bends = [np.clip((_along() - place) / CREASE, -1.0, 1.0) for place in places]
        half = np.radians(degrees) / 2
        # One valley, one hill, and so on.
        slope = np.sum([(-1) ** k * half * (1.5 * b - 0.5 * b**3) for k, b in enumerate(bends)], axis=0)
        return Bend(middle, towards, slope)

    @property
    def flat(self) -> bool:
        """Whether it is not bent at all."""
        return not np.any(self.slope)

    @cached_property
    def _tables(self) -> tuple[Floats, Floats]:
        return tuple(_integral(value) for value in (np.cos(self.slope), np.sin(self.slope)))  # type: ignore[return-value]

    def raised(self, points: Points) -> tuple[Points, Floats]:
        """Where points (...) of the paper are: in plan, from the middle, and how high."""
        if self.flat:
            return points - self.middle, np.zeros(points.shape)
        own = (points - self.middle) * np.conj(self.towards)
        plan, height = (np.interp(own.real, _along(), table) for table in self._tables)
        return (plan + 1j * own.imag) * self.towards, height

    def slopes(self, points: Points) -> Floats:
        """The slope at points (...) [radians]."""
        return np.interp(((points - self.middle) * np.conj(self.towards)).real, _along(), self.slope)


def _along() -> Floats:
    return np.arange(-REACH, REACH + STEP / 2, STEP)


def _integral(values: Floats) -> Floats:
    total = np.concatenate([[0.0], np.cumsum((values[1:] + values[:-1]) / 2)]) * STEP
    return np.asarray(total - total[total.size // 2])

"""Where on the paper an answer can lie: a drawing elsewhere counts from another origin, or has another unit."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import UnreadableError
from graphcam.exercises.definition.exercise import Kind
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.reading.answer_values import Points
from graphcam.words import say

MAX_SIZE_RATIO = 5.0
"""A drawing so many times larger or smaller than any that can be meant is in another unit, or is a part only."""
MIN_STRAY = 3.0
"""What is drawn by hand strays less from what is meant, mm, where an answer key permits no more."""
SHIFT_STEP = 0.1
"""The shift of a drawing is looked for as finely as that, mm."""
MAX_VERTICES = 400
"""How many of a curve's vertices are enough to see whether it is moved."""
ELSEWHERE_REMARK = say(
    "the drawing on the layer {layer} lies far from where it should be, counted from the POINT on the layer "
    "ORIGIN; check that it marks the origin of this drawing"
)
ELSEWHERE_UNMARKED_REMARK = say(
    "the drawing on the layer {layer} lies far from where it should be, counted from the drawing's own zero; "
    "mark the origin of the paper by a POINT on the layer ORIGIN"
)
MOVED_UNMARKED_REMARK = say(
    "the drawing on the layer {layer} seems to be moved as a whole, and has no origin marked; mark the origin of "
    "the paper by a POINT on the layer ORIGIN"
)


@dataclass(frozen=True, eq=False)
class PaperArea:
    """What a drawn answer can be: the right one, or what a usual mistake makes of it [mm of paper].

    kind : whether points or a curve;  near : how far a hand strays from them
    """

    kind: Kind
    known: tuple[Expected, ...]
    near: float = MIN_STRAY

    @staticmethod
    def for_answers(kind: Kind, known: Iterable[Expected], tolerance: float) -> PaperArea:
        """The area of the right answer and of wrong ones, where a hand may stray by the tolerance."""
        return PaperArea(kind, tuple(known), max(MIN_STRAY, tolerance))

    def admit(self, name: str, points: Points, *, marked: bool) -> None:
        """Refuse what lies elsewhere, with a remedy; nothing is said of where it should be.

        marked : whether the drawing marks its origin; one that does not must not be marked as if it were drawn wrongly

        Raises
        ------
        UnreadableError : the drawing is not where, or not of the size, that any answer could be

        >>> area = PaperArea("curve", (Expected(np.array([0j, 6 + 8j]), 1.0),))
        >>> area.admit("pitch", np.array([300j, 6 + 308j]), marked=False)
        Traceback (most recent call last):
        ...
        graphcam.errors.UnreadableError: the drawing on the layer pitch lies far from where \
it should be, counted from the drawing's own zero; mark the origin of the paper by a POINT on the layer ORIGIN
        """
        sizes = [_size(_points(each)) for each in self.known]
        if not min(sizes) / MAX_SIZE_RATIO <= _size(points) <= max(sizes) * MAX_SIZE_RATIO:
            why = say(
                "the drawing on the layer {layer} is {size:.3g} mm across, but no answer has this size; draw the "
                "whole of it in mm of paper and set the unit of the drawing ($INSUNITS) to mm",
                layer=name,
                size=_size(points),
            )
            raise UnreadableError(why)
        low, high = _corners(np.concatenate([_points(each) for each in self.known]))
        middle = sum(_corners(points)) / 2
        if not (low.real <= middle.real <= high.real and low.imag <= middle.imag <= high.imag):
            raise UnreadableError(
                replace(ELSEWHERE_REMARK if marked else ELSEWHERE_UNMARKED_REMARK, values={"layer": name})
            )
        if not marked and self.is_moved(points):
            raise UnreadableError(replace(MOVED_UNMARKED_REMARK, values={"layer": name}))

    def is_moved(self, points: Points) -> bool:
        """Whether the drawing is none of what is known where it lies, and is one of them elsewhere.

        >>> area = PaperArea("points", (Expected(np.array([0j, 30 + 40j]), 1.0),))
        >>> area.is_moved(np.array([8 + 0j, 38 + 40j])), area.is_moved(np.array([1 + 0j, 31 + 40j]))
        (True, False)
        """
        if self.kind == "curve":
            points = points[np.unique(np.linspace(0, points.size - 1, MAX_VERTICES).astype(int))]
        if any(self._distance(each, points, 0j) <= self.near for each in self.known):
            return False
        return any(self._distance(each, points, self._shift(each, points)) <= self.near for each in self.known)

    def _distance(self, known: Expected, points: Points, shift: complex) -> float:
        """How far the known points lie at most from the drawing, once that is put back by the shift."""
        return float(known.distances(points - shift, self.kind).max())

    def _shift(self, known: Expected, points: Points) -> complex:
        """The shift after which the drawing comes nearest."""
        from scipy.optimize import minimize

        first = sum(_corners(points)) / 2 - sum(_corners(_points(known))) / 2
        if self._distance(known, points, first) > _size(points):
            return first  # not even the number of points agrees

        def left(shift: NDArray[np.float64]) -> float:
            """How far the points lie off when they are shifted by x, y [mm]."""
            return self._distance(known, points, complex(shift[0], shift[1]))

        fine = {"xatol": SHIFT_STEP, "fatol": SHIFT_STEP}
        best = minimize(left, np.array([first.real, first.imag]), method="Nelder-Mead", options=fine)
        return complex(best.x[0], best.x[1])


def _points(known: Expected) -> Points:
    return np.atleast_1d(np.asarray(known.value))


def _size(points: Points) -> float:
    low, high = _corners(points)
    return abs(high - low)


def _corners(points: Points) -> tuple[complex, complex]:
    return (complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max()))

"""Where on the paper an answer can lie: a drawing elsewhere counts from another origin, or has another unit."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from graphcam.exercises.reading.regular_file import UnreadableError
from graphcam.exercises.reading.values import Points
from graphcam.words import Caption, say

SIZES = 5.0
"""A curve so many times larger or smaller than any that can be meant is drawn in another unit, or is a part only."""


@dataclass(frozen=True)
class Room:
    """The box of all that the answer can be, the usual mistakes among it [mm of paper].

    smallest, largest : diagonals of the boxes of the single ones
    """

    low: complex
    high: complex
    smallest: float
    largest: float

    @staticmethod
    def around(drawings: Iterable[Points]) -> Room:
        """The room of some drawings (n,) each.

        >>> Room.around([np.array([0j, 3 + 4j]), np.array([1j, 6 + 9j])])
        Room(low=0j, high=(6+9j), smallest=5.0, largest=10.0)
        """
        corners = np.array([_corners(points) for points in drawings])
        low, high = _corners(corners.ravel())
        sizes = np.abs(corners[:, 1] - corners[:, 0])
        return Room(low, high, float(sizes.min()), float(sizes.max()))

    def admit(self, name: str, points: Points, *, joined: bool, marked: bool) -> None:
        """Refuse what lies elsewhere, with a remedy; nothing is said of where it should be.

        joined : whether the points are a curve;  marked : whether the drawing marks its origin

        Raises
        ------
        UnreadableError : the drawing is not where, or not of the size, that any answer could be

        >>> Room(0j, 6 + 9j, 5.0, 10.0).admit("pitch", np.array([300j, 3 + 304j]), joined=True, marked=False)
        Traceback (most recent call last):
        ...
        graphcam.exercises.reading.regular_file.UnreadableError: the drawing on the layer pitch lies far from where \
it can be, counted from the drawing's own zero; mark the origin of the paper by a POINT on the layer ORIGIN
        """
        low, high = _corners(points)
        if joined and not self.smallest / SIZES <= abs(high - low) <= self.largest * SIZES:
            raise UnreadableError(say(
                "the curve on the layer {layer} is {size:.3g} mm across, and no answer is of such a size; draw the "
                "whole curve in mm of paper and set the unit of the drawing ($INSUNITS) to mm",
                layer=name, size=abs(high - low),
            ))  # fmt: skip
        middle = (low + high) / 2
        if not (self.low.real <= middle.real <= self.high.real and self.low.imag <= middle.imag <= self.high.imag):
            raise UnreadableError(_elsewhere(name, marked=marked))


def _elsewhere(name: str, *, marked: bool) -> Caption:
    if marked:
        return say(
            "the drawing on the layer {layer} lies far from where it can be, counted from the POINT on the layer "
            "ORIGIN; check that it marks the origin of this drawing",
            layer=name,
        )
    return say(
        "the drawing on the layer {layer} lies far from where it can be, counted from the drawing's own zero; mark the "
        "origin of the paper by a POINT on the layer ORIGIN",
        layer=name,
    )


def _corners(points: Points) -> tuple[complex, complex]:
    return (complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max()))

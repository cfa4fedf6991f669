"""Pictures of a part of the page: values at places, and lines by their directions.

The filters for lines are those of the textbook (second derivative of a Gauss curve across, long along), with the flanks
drawn apart, so that a stroke of a soft pencil is not taken for its own surroundings.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.printed_page import Edges, Points

MAX_COLUMNS = 20_000
"""The maximum number of places that OpenCV looks up in one row; it takes no more than 32767."""


@dataclass(frozen=True, eq=False)
class Raster:
    """Values (rows, columns) over a part of the page, the first row at its top.

    left, top : edges of the first pixel [mm of page]
    per_mm : pixels per mm

    >>> raster = Raster(np.array([[1, 2], [3, 4]], np.float32), 10.0, 20.0, 1.0)
    >>> raster.at(np.array([10.5 + 19.5j, 11 + 19j, 99 + 0j])).tolist()
    [1.0, 2.5, 0.0]
    """

    values: NDArray[Any]
    left: float
    top: float
    per_mm: float

    @property
    def box(self) -> Edges:
        """Left, bottom, right and top of the part [mm of page]."""
        rows, columns = self.values.shape[:2]
        return (self.left, self.top - rows / self.per_mm, self.left + columns / self.per_mm, self.top)

    def pixels(self, points: Points) -> NDArray[np.float32]:
        """Columns and rows (..., 2) of places (...) on the page; whole numbers are the middles of pixels."""
        x = (points.real - self.left) * self.per_mm - 0.5
        y = (self.top - points.imag) * self.per_mm - 0.5
        return np.stack([x, y], -1).astype(np.float32)

    def places(self, columns: NDArray[Any], rows: NDArray[Any]) -> Points:
        """Places (...) on the page of columns and rows (...)."""
        return self.left + (columns + 0.5) / self.per_mm + 1j * (self.top - (rows + 0.5) / self.per_mm)

    def at(self, points: Points, nearest: bool = False) -> NDArray[np.float32]:
        """Values (...) at places (...) on the page, interpolated or of the nearest pixel; zero outside."""
        looked_up = np.atleast_1d(self.pixels(np.asarray(points)).reshape(-1, 2))
        how = cv2.INTER_NEAREST if nearest else cv2.INTER_LINEAR
        pieces = [
            cv2.remap(self.values, piece[None, :, 0], piece[None, :, 1], how, borderMode=cv2.BORDER_CONSTANT)[0]
            for piece in np.array_split(looked_up, looked_up.shape[0] // MAX_COLUMNS + 1)
        ]
        return np.concatenate(pieces).reshape(np.shape(points)).astype(np.float32)

    def with_values(self, values: NDArray[Any]) -> Raster:
        """A raster with other values (rows, columns) over the same part."""
        return Raster(values, self.left, self.top, self.per_mm)

    def reduced(self, per_mm: float) -> Raster:
        """The raster with fewer pixels, each the mean of what it covers."""
        # Filled up at its right and lower edges, so that the new pixels fit a whole number of times.
        whole = Fraction(per_mm / self.per_mm).limit_denominator(64).denominator
        rows, columns = (-length % whole for length in self.values.shape[:2])
        filled = cv2.copyMakeBorder(self.values, 0, rows, 0, columns, cv2.BORDER_REPLICATE)
        size = (round(filled.shape[1] * per_mm / self.per_mm), round(filled.shape[0] * per_mm / self.per_mm))
        return Raster(cv2.resize(filled, size, interpolation=cv2.INTER_AREA), self.left, self.top, per_mm)


PIXELS_PER_MM = 5.0
"""The resolution of the picture in which ridges are looked for [px/mm]: a pencil line is two pixels wide."""
DIRECTION_COUNT = 24
"""The number of directions of the filters, 7.5 degrees apart, a third of what one filter lets through."""
ALONG_DEVIATION = 1.1
"""The standard deviation of the filter along a line [mm]: less than the pieces between stations of a drawing."""
ACROSS_DEVIATION = 0.22
"""The standard deviation across a line [mm]: that of a pencil's stroke as a telephone shows it."""
FLANK_DISTANCE = 1.0
"""The distance of the flanks from the middle [mm]: outside the softest stroke, inside a second one at 2 mm."""
FLANK_DEVIATION = 0.25
"""The standard deviation of the flanks [mm]."""
FILTER_HALF_SIDE = 2.4
"""Half the side of a filter [mm], two deviations along."""


def ridges(picture: Raster) -> Iterator[tuple[float, Raster]]:
    """Each direction [rad from x, 0 to pi] with a raster of how much more ink lies on such a line than beside it.

    >>> blank = Raster(np.ones((60, 60), np.float32), 0.0, 12.0, PIXELS_PER_MM)
    >>> round(max(float(np.abs(answer.values).max()) for _, answer in ridges(blank)), 5)
    0.0
    """
    for angle in np.pi * np.arange(DIRECTION_COUNT) / DIRECTION_COUNT:
        yield float(angle), picture.with_values(cv2.filter2D(picture.values, -1, _filter(float(angle))))


def spread(answers: NDArray[np.float32]) -> float:
    """The standard deviation of noise, from the median, which lines hardly change.

    >>> spread(np.array([-1, 0, 1, 0, 50], np.float32))
    1.4826
    """
    return 1.4826 * float(np.median(np.abs(answers - np.median(answers))))


def _filter(angle: float) -> NDArray[np.float32]:
    """Weights (n, n) of one direction: their sum is zero, and a straight wide stroke answers with its density."""
    side = (
        np.arange(-round(FILTER_HALF_SIDE * PIXELS_PER_MM), round(FILTER_HALF_SIDE * PIXELS_PER_MM) + 1) / PIXELS_PER_MM
    )
    x, y = np.meshgrid(side, -side)
    along, across = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
    lengthwise = np.exp(-((along / ALONG_DEVIATION) ** 2) / 2)
    middle = lengthwise * np.exp(-((across / ACROSS_DEVIATION) ** 2) / 2)
    flanks = lengthwise * np.exp(-(((np.abs(across) - FLANK_DISTANCE) / FLANK_DEVIATION) ** 2) / 2)
    return (middle / middle.sum() - flanks / flanks.sum()).astype(np.float32)

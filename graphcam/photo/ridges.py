"""Lines in a picture, told by their directions: a bright ridge between two darker flanks.

The filters are those of the textbook (second derivative of a Gauss curve across, long along), with the flanks drawn
apart, so that a stroke of a soft pencil is not taken for its own surroundings.
"""

from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.raster import Raster

PER_MM = 5.0
"""Pixels of the picture in which ridges are looked for: a pencil line is two wide."""
DIRECTIONS = 24
"""Directions of the filters; their neighbours lie 7.5 degrees apart, a third of what one filter lets through."""
ALONG = 1.1
"""Deviation of the Gauss curve along a line [mm]: shorter than the pieces between the stations of a drawing."""
ACROSS = 0.22
"""Deviation across a line [mm]: a pencil's stroke as a telephone shows it."""
FLANK = 1.0
"""Distance of the flanks from the middle [mm]: outside the softest stroke, inside a second one at 2 mm."""
FLANK_ACROSS = 0.25
"""Deviation of the flanks [mm]."""
REACH = 2.4
"""Half the side of a filter [mm], two deviations along."""


def ridges(picture: Raster) -> Iterator[tuple[float, Raster]]:
    """For each direction [rad from x, 0 to pi] how much more ink lies everywhere on a line than beside it.

    >>> blank = Raster(np.ones((60, 60), np.float32), 0.0, 12.0, PER_MM)
    >>> round(max(float(np.abs(answer.values).max()) for _, answer in ridges(blank)), 5)
    0.0
    """
    for angle in np.pi * np.arange(DIRECTIONS) / DIRECTIONS:
        yield float(angle), picture.like(cv2.filter2D(picture.values, -1, _filter(float(angle))))


def spread(answers: NDArray[np.float32]) -> float:
    """The standard deviation of noise, from the median, which lines do not disturb.

    >>> spread(np.array([-1, 0, 1, 0, 50], np.float32))
    1.4826
    """
    return 1.4826 * float(np.median(np.abs(answers - np.median(answers))))


def _filter(angle: float) -> NDArray[np.float32]:
    """Weights (n, n) of one direction: they sum to nought, and a straight wide stroke answers with its density."""
    side = np.arange(-round(REACH * PER_MM), round(REACH * PER_MM) + 1) / PER_MM
    x, y = np.meshgrid(side, -side)
    along, across = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
    lengthwise = np.exp(-((along / ALONG) ** 2) / 2)
    middle = lengthwise * np.exp(-((across / ACROSS) ** 2) / 2)
    flanks = lengthwise * np.exp(-(((np.abs(across) - FLANK) / FLANK_ACROSS) ** 2) / 2)
    return (middle / middle.sum() - flanks / flanks.sum()).astype(np.float32)

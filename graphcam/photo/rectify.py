"""A part of the paper as if seen from straight above: even, in millimetres, in linear light."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from graphcam.photo.pictures import LINEAR_LIGHT
from graphcam.photo.printed_page import Edges
from graphcam.photo.registration import Registration

Places = NDArray[np.complex128]
Photograph = NDArray[np.uint8]
Light = NDArray[np.float32]
PIXELS_PER_MM = 8.0
"""The default resolution [px/mm]: a pencil line is three or four pixels wide."""
LOOKUP_SPACING = 8.0
"""The spacing of the places that are looked up [mm]; a lens bends no faster."""
FOLD_LOOKUP_SPACING = 1.0
"""The spacing on folded paper [mm], as no smooth curve follows the fold."""


@dataclass(frozen=True, eq=False)
class EvenPicture:
    """A part of the paper, rectified.

    linear : (rows, columns, 3) red, green, blue as shares of full light; rows go down
    box : of the paper [mm], from edge to edge of the outermost pixels
    per_mm : pixels per mm
    """

    linear: Light
    box: Edges
    per_mm: float

    def pixels(self, points: Places | complex) -> Places:
        """The column and the row, as real and imaginary part, of points of the paper [mm]; whole at pixels' centres."""
        left, _, _, top = self.box
        moved = np.asarray(points, complex) - complex(left, top)
        return np.asarray(moved.conj() * self.per_mm - 0.5 - 0.5j, complex)

    def points(self, places: Places | complex) -> Places:
        """The points of the paper [mm] at places of columns and rows."""
        left, _, _, top = self.box
        moved = (np.asarray(places, complex) + 0.5 + 0.5j) / self.per_mm
        return np.asarray(moved.conj() + complex(left, top), complex)

    def at(self, points: Places | complex) -> Light:
        """The light (..., 3) at points of the paper (...) [mm]; outside of the box that of its edge."""
        return sampled(self.linear, self.pixels(points))


def rectify(picture: Photograph, registration: Registration, box: Edges, per_mm: float = PIXELS_PER_MM) -> EvenPicture:
    """The rectified box of the paper [mm] of a picture (h, w, 3), blue, green, red as OpenCV has it.

    What lies outside of the picture looks like its edge.
    """
    left, _, _, top = box
    column, row = lookup_maps(registration, box, per_mm)
    rows, columns = column.shape
    seen = cv2.remap(picture, column, row, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
    linear = np.asarray(cv2.LUT(cv2.cvtColor(seen, cv2.COLOR_BGR2RGB), LINEAR_LIGHT), np.float32)
    return EvenPicture(linear, (left, top - rows / per_mm, left + columns / per_mm, top), per_mm)


def lookup_maps(registration: Registration, box: Edges, per_mm: float) -> tuple[Light, Light]:
    """Columns and rows (rows, columns) of the picture for the pixels of a box [mm]."""
    left, bottom, right, top = box
    columns, rows = round((right - left) * per_mm), round((top - bottom) * per_mm)
    smooth = registration.kind != "fold"
    step, degree = (LOOKUP_SPACING, 3) if smooth else (FOLD_LOOKUP_SPACING, 1)
    across, across_map = _enlarging(left, columns, per_mm, step, degree)
    down, down_map = _enlarging(-top, rows, per_mm, step, degree)
    coarse = registration.pixels(across - 1j * down[:, None])
    # OpenCV would round places in the coarse map to 1/32 of a step; products with splines do not.
    column, row = (np.asarray(down_map @ part @ across_map.T, np.float32) for part in (coarse.real, coarse.imag))
    return column, row


def sampled(image: Light, places: Places) -> Light:
    """The values (..., channels) of an image (rows, columns, channels) at places (...), between four pixels each."""
    height, width = image.shape[:2]
    across = np.clip(places.real, 0, width - 1.001)
    down = np.clip(places.imag, 0, height - 1.001)
    columns, rows = across.astype(np.intp), down.astype(np.intp)
    right = (across - columns).astype(np.float32)[..., None]
    below = (down - rows).astype(np.float32)[..., None]
    upper = image[rows, columns] * (1 - right) + image[rows, columns + 1] * right
    lower = image[rows + 1, columns] * (1 - right) + image[rows + 1, columns + 1] * right
    return np.asarray(upper * (1 - below) + lower * below, np.float32)


def _enlarging(
    start: float, count: int, per_mm: float, step: float, degree: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places (n,) [mm] about every step, and weights that interpolate values (count,) at the centres of pixels."""
    length = count / per_mm
    coarse = np.linspace(start, start + length, max(degree + 1, round(length / step) + 1))
    fine = start + (np.arange(count) + 0.5) / per_mm
    return coarse, np.asarray(make_interp_spline(coarse, np.eye(len(coarse)), k=degree)(fine))

"""What was read, drawn over the photograph: for the teacher with what is right, for the student without."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.exercises.definition.exercise import Kind
from graphcam.exercises.key.expected_answers import Expected, paired
from graphcam.exercises.photographs.photographed_page import jpeg
from graphcam.exercises.reports.unrolled_drawings import key_line, nearest_places
from graphcam.photo.printed_page import Edges, Points

DEVIATION_MAGNIFICATION = 10.0
"""Deviations are drawn so many times as long, so that tenths of a mm are seen."""
MAX_DEVIATION = 12.0
"""mm off up to which a deviation is drawn: a foreign drawing would be covered by them."""
DEVIATION_SPACING = 4.0
"""mm along the right curve between two deviations that are drawn."""
RIGHT_COLOUR, OWN_COLOUR, DEVIATION_COLOUR = (143, 79, 27), (43, 57, 192), (0, 140, 240)
"""Blue, red and orange, as OpenCV has colours: what is right, what was read, and how far that is off."""
FRACTION_BITS = 4
"""Bits behind the point of a place in pixels."""
RING, DOT = 1.6, 0.5
"""Radii of what shows a point [mm]."""


@dataclass(frozen=True, eq=False)
class OverlaidDrawing:
    """One answer to be drawn over a photograph.

    own : its points (n,), mm of paper from the view's origin; closed : whether they run back to the first
    right : what is right there, None where that is not shown
    """

    kind: Kind
    own: Points
    closed: bool
    right: Expected | None = None


def overlay(picture: bytes, box: Edges, layers: Iterable[OverlaidDrawing]) -> bytes:
    """A picture of a view as JPEG, with answers drawn over it, as JPEG.

    box : what the picture shows, mm of paper from the view's origin
    """
    canvas = cv2.imdecode(np.frombuffer(picture, np.uint8), cv2.IMREAD_COLOR)
    if canvas is None:
        return picture
    board = _Board(np.ascontiguousarray(canvas, dtype=np.uint8), box)
    for layer in layers:
        if layer.right is not None:
            _draw_right(board, layer, layer.right)
        if layer.kind == "curve":
            board.line(_round(layer), OWN_COLOUR)
        else:
            board.rings(layer.own, RING, OWN_COLOUR)
    return jpeg(board.canvas)


def _round(layer: OverlaidDrawing) -> Points:
    return np.append(layer.own, layer.own[:1]) if layer.closed else layer.own


def _draw_right(board: _Board, layer: OverlaidDrawing, right: Expected) -> None:
    places = np.atleast_1d(np.asarray(right.value, dtype=np.complex128))
    if layer.kind == "curve":
        line = key_line(right)
        board.line(line, RIGHT_COLOUR)
        run = np.append(0.0, np.cumsum(np.abs(np.diff(line))))
        places = np.interp(np.arange(0.0, run[-1], DEVIATION_SPACING), run, line).astype(np.complex128)
        nearest = nearest_places(places, _round(layer))
    else:
        board.rings(places, DOT, RIGHT_COLOUR)
        if layer.own.size != places.size:
            return
        nearest = paired(layer.own, places)
    off = nearest - places
    for ends in np.stack([places, places + DEVIATION_MAGNIFICATION * off], -1)[np.abs(off) <= MAX_DEVIATION]:
        board.line(ends, DEVIATION_COLOUR)


@dataclass(frozen=True, eq=False)
class _Board:
    """A picture (rows, columns, 3) to draw on in mm."""

    canvas: NDArray[np.uint8]
    box: Edges

    @property
    def per_mm(self) -> float:
        """The pixels of the canvas to a mm of paper."""
        return self.canvas.shape[1] / (self.box[2] - self.box[0])

    def pixels(self, points: NDArray[np.complexfloating[Any, Any]]) -> NDArray[np.int32]:
        """Columns and rows (n, 2) of places, in fractions of a pixel; what is far outside stays near."""
        x = (points.real - self.box[0]) * self.per_mm - 0.5
        y = (self.box[3] - points.imag) * self.per_mm - 0.5
        places = np.clip(np.stack([x, y], -1), -2 * max(self.canvas.shape), 3 * max(self.canvas.shape))
        return np.round(places * 2**FRACTION_BITS).astype(np.int32)

    def line(self, points: NDArray[np.complexfloating[Any, Any]], colour: tuple[int, int, int]) -> None:
        """Draw a line through places (n,) [mm]."""
        cv2.polylines(self.canvas, [self.pixels(points)], False, colour, 1, cv2.LINE_AA, FRACTION_BITS)

    def rings(self, points: Points, radius: float, colour: tuple[int, int, int]) -> None:
        """Draw a circle of a radius [mm] about each of some places (n,) [mm]."""
        size = round(radius * self.per_mm * 2**FRACTION_BITS)
        for x, y in self.pixels(points).tolist():
            cv2.circle(self.canvas, (x, y), size, colour, 1, cv2.LINE_AA, FRACTION_BITS)

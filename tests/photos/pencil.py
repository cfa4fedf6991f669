"""Pencils, crayons and pens on paper: lines of some pressure, whose graphite stays on the paper's grain."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import cv2
import numpy as np
from bent_paper import Floats, Points
from camera import NDFloat32
from numpy.typing import NDArray

Rng = np.random.Generator
Light = NDArray[np.uint16]
FULL = 255 * 235
"""The light of bare paper: a pencil's tones need finer steps than print."""
FINE = 2
"""Pixels of a stroke to one of the paper, each way."""
PIECE = 1.5
"""A stroke has one pressure over so many mm."""
EDGE = 0.05
"""Standard deviation of how far a line's edge runs out [mm]."""
MARGIN = 1.5
"""About strokes, mm."""
GRAIN = 1024
"""Pixels after which the paper's grain comes again."""


@dataclass(frozen=True)
class Pen:
    """What is drawn with.

    width : of a line of usual pressure [mm]
    through : the light that a full line leaves: blue, green, red
    grain : how much the line shows the paper's grain, 0 not at all
    """

    width: float
    through: tuple[float, float, float]
    grain: float = 0.25

    def lighter(self, part: float, width: float = 1.0) -> Pen:
        """The same with so much less colour, and another width: drawn lightly, or rubbed out."""
        lighter = tuple(1 - part * (1 - each) for each in self.through)
        return Pen(self.width * width, (lighter[0], lighter[1], lighter[2]), self.grain)


PENS = {
    "HB": Pen(0.5, (0.34, 0.33, 0.33)),
    "H": Pen(0.4, (0.46, 0.45, 0.45)),
    "2H": Pen(0.3, (0.57, 0.56, 0.56)),
    "mechanical": Pen(0.45, (0.40, 0.39, 0.39), 0.18),
    "crayon-red": Pen(0.55, (0.28, 0.26, 0.72), 0.35),
    "crayon-green": Pen(0.55, (0.32, 0.50, 0.22), 0.35),
    "biro-blue": Pen(0.4, (0.45, 0.14, 0.10), 0.05),
    "biro-black": Pen(0.4, (0.09, 0.08, 0.08), 0.05),
}


@dataclass(frozen=True, eq=False)
class Stroke:
    """One line of a hand.

    points : (n,) of the page [mm]
    pressure : (n,) about 1; the ends of a line are lighter
    """

    points: Points
    pressure: Floats

    @staticmethod
    def of(points: Points, rng: Rng, *, uneven: float = 0.12, taper: float = 1.5) -> Stroke:
        """Along points with the pressure of a hand: a little uneven over a cm or two, lighter at both ends."""
        points = np.asarray(points, dtype=np.complex128)
        way = np.append(0.0, np.cumsum(np.abs(np.diff(points))))
        knots = np.arange(0.0, way[-1] + 15.0, 15.0)
        pressure = 1 + uneven * np.interp(way, knots, rng.standard_normal(knots.size))
        ends = np.minimum(way, way[-1] - way)
        return Stroke(points, pressure * np.clip(0.55 + 0.45 * ends / taper, 0.0, 1.0) if taper else pressure)


class Leaf:
    """A sheet of paper that is drawn on: light (rows, columns, 3) in parts of FULL, blue, green, red.

    print_ : what is printed on it, in parts of 255;  height : of the page [mm];  per_mm : pixels
    """

    def __init__(self, print_: NDArray[np.uint8], height: float, per_mm: float, rng: Rng) -> None:
        self.light: Light = print_.astype(np.uint16) * np.uint16(FULL // 255)
        self.height, self.per_mm, self.rng = height, per_mm, rng

    def pixels(self, points: Points) -> Floats:
        """Column and row (..., 2) of points (...) of the page."""
        return np.stack([points.real * self.per_mm - 0.5, (self.height - points.imag) * self.per_mm - 0.5], axis=-1)

    def draw(self, strokes: list[Stroke], pen: Pen) -> None:
        """Draw lines; where two of them cross it is one as dark as the other."""
        if not strokes:
            return
        everything = np.concatenate([stroke.points for stroke in strokes])
        with self._box(everything, MARGIN) as box:
            for stroke in strokes:
                self._stroke(box.fine, stroke, pen, box.corner)
            box.lay(pen, EDGE)

    def write(self, text: str, place: complex, size: float, pen: Pen, *, script: bool = False) -> None:
        """Write by hand: letters so high [mm], from their lower left corner."""
        face = cv2.FONT_HERSHEY_SCRIPT_SIMPLEX if script else cv2.FONT_HERSHEY_SIMPLEX
        thick = max(1, round(pen.width * 0.6 * self.per_mm * FINE))
        scale = size * self.per_mm * FINE / 22
        room = place + np.array([0, size * (len(text) + 1) + 1.5j * size])
        with self._box(room, MARGIN) as box:
            at = np.round((self.pixels(np.array(place)) - box.corner) * FINE).astype(int).tolist()
            cv2.putText(box.fine, text, at, face, scale, 255, thick, cv2.LINE_AA)
            box.lay(pen, EDGE)

    def fill(self, outline: Points, pen: Pen, soft: float) -> None:
        """Fill an outline: a stain, or graphite that was smeared; its edge runs out over so many mm."""
        with self._box(outline, MARGIN + 3 * soft) as box:
            corners = np.round((self.pixels(outline) - box.corner) * FINE).astype(np.int32)
            cv2.fillPoly(box.fine, [corners], 255, cv2.LINE_AA)
            box.lay(pen, soft)

    def _stroke(self, fine: NDArray[np.uint8], stroke: Stroke, pen: Pen, corner: Floats) -> None:
        # The middle of a pixel of the paper is that of a square of fine ones.
        places = (self.pixels(stroke.points) - corner) * FINE + (FINE - 1) / 2
        way = np.append(0.0, np.cumsum(np.abs(np.diff(stroke.points))))
        cuts = np.searchsorted(way, np.arange(PIECE, way[-1], PIECE))
        starts = np.unique(np.concatenate([[0], cuts]))
        for start, end in zip(starts, np.append(starts[1:], way.size - 1), strict=True):
            pressure = float(stroke.pressure[start : end + 1].mean())
            width = max(1, round(pen.width * (0.75 + 0.25 * pressure) * self.per_mm * FINE))
            piece = np.round(places[start : end + 1] * 16).astype(np.int32)
            cv2.polylines(fine, [piece], False, min(255.0, 215 * pressure), width, cv2.LINE_AA, 4)

    def _box(self, points: Points, margin: float) -> _Box:
        places, reach = self.pixels(points.ravel()), margin * self.per_mm
        limits = self.light.shape[1::-1]
        low = np.clip(np.floor(places.min(axis=0) - reach), 0, limits).astype(int)
        high = np.clip(np.ceil(places.max(axis=0) + reach), low, limits).astype(int)
        return _Box(self, low, high)


class _Box:
    """A part of a leaf, enlarged, to be drawn on."""

    def __init__(self, leaf: Leaf, low: NDArray[np.int_], high: NDArray[np.int_]) -> None:
        self.leaf, self.corner = leaf, low.astype(np.float64)
        self.part = leaf.light[low[1] : high[1], low[0] : high[0]]
        self.fine = np.zeros((self.part.shape[0] * FINE, self.part.shape[1] * FINE), np.uint8)

    def __enter__(self) -> _Box:
        return self

    def __exit__(self, *_: object) -> None:
        return None

    def lay(self, pen: Pen, soft: float) -> None:
        """Take from the paper's light what was drawn takes."""
        if not self.part.size:
            return
        amount = cv2.resize(self.fine, self.part.shape[1::-1], interpolation=cv2.INTER_AREA)
        amount = cv2.GaussianBlur(amount, (0, 0), max(0.3, soft * self.leaf.per_mm)).astype(np.float32)
        rows, columns = np.flatnonzero(amount.max(axis=1) > 0), np.flatnonzero(amount.max(axis=0) > 0)
        if not rows.size:
            return
        touched = (slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1))
        amount = amount[touched] * np.float32(1 / 215)
        tile, (down, right) = _grain(), self.leaf.rng.integers(GRAIN, size=2)
        places = [(np.arange(n) + shift) % GRAIN for n, shift in zip(amount.shape, (down, right), strict=True)]
        amount *= 1 + pen.grain * tile[places[0][:, None], places[1]]
        amount = np.clip(amount, 0, 1)
        part = self.part[touched]
        for channel, through in enumerate(pen.through):
            part[..., channel] = part[..., channel] * (1 - amount * np.float32(1 - through))


@cache
def _grain() -> NDFloat32:
    """Of drawing paper (GRAIN, GRAIN), its standard deviation 1, joining itself at its edges."""
    noise = np.random.default_rng(18).standard_normal((GRAIN, GRAIN), np.float32)
    found = np.zeros_like(noise)
    for smear, part in ((0.8, 0.7), (1.6, 0.6), (5.0, 0.3)):
        wide = cv2.GaussianBlur(np.pad(noise, 32, mode="wrap"), (0, 0), smear)[32:-32, 32:-32]
        found += part * wide / wide.std()
    return found / found.std()

"""A text without a place yet: where it could stand, and the costs of these places."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.sheets.model import Angle, Length, Source, Text
from graphcam.sheets.text_measures import extent

Floats = NDArray[np.float64]
LABEL_GAPS = np.array([1.2, 1.8, 2.5, 3.4, 4.6, 6.5, 9.0, 12.0, 16.0, 21.0, 27.0, 35.0])
"""The distances between a point and its label that are tried [mm]."""
MIN_LEADER_LENGTH = 6.0
"""The distance from which on a leader joins the label and its point [mm]."""
TEXT_GAP = 1.0
"""The gap between a dimension line and its text above it [mm]."""
LEADER_TEXT_GAP = 2.0
"""The gap between a dimension line and a text on a leader from it [mm]."""
TEXT_FRACTIONS = np.array([0.5, 0.42, 0.58, 0.3, 0.7, 0.18, 0.82])
"""The fractions of a dimension line at which its text may stand, the middle first."""
IN_LINE_GAP, IN_LINE_STEP, IN_LINE_COST = 1.5, 2.0, 0.3
"""The gap between the end of a line and a text in it, the step between its places [mm], and their cost for each mm."""
LABEL_DIRECTIONS: Points = np.exp(1j * np.radians(np.arange(0.0, 360.0, 22.5)))


@dataclass(frozen=True, eq=False)
class LabelText:
    """A text and its possible places, the first one the best if the paper were empty.

    centres : (k,) of the text's box
    angles : (k,) of its base line, rad
    cost : (k,) costs of the places, in lines crossed (see :mod:`graphcam.sheets.labels`)
    anchors : (k,) where a leader ends; NaN where there is none
    bound : whether the text belongs to a line, not to a point: such texts choose first
    of : the dimension to which the text belongs
    source : the act that it names
    barred : (4, b) the left, bottom, right and top of boxes of other views, which neither text nor leader enters
    close : the place that counts for the room of its view: of an arc the one inside it
    """

    text: str
    height: float
    centres: Points
    angles: Floats
    cost: Floats
    anchors: Points
    bound: bool = False
    of: Length | Angle | None = None
    source: Source | None = None
    barred: Floats = field(default_factory=lambda: np.empty((4, 0)))
    close: int = 0

    @property
    def size(self) -> complex:
        """Width and height of the text's box, as x + iy [mm]."""
        return _size(self.text, self.height)

    def set_at(self, k: int) -> Text:
        """The text in its place ``k``."""
        _, below, above = extent(self.text, self.height)
        angle = float(self.angles[k])
        base = self.centres[k] - cmath.rect((above - below) / 2, angle + math.pi / 2)
        return Text(complex(base), self.text, self.height, "center", angle, of=self.of, source=self.source)

    def on_line(self, centres: Points, angle: float, cost: Floats, dearer: float) -> LabelText:
        """The text with places on a line before its own places, which then cost ``dearer`` more."""
        return replace(
            self,
            centres=np.concatenate([centres, self.centres]),
            angles=np.concatenate([np.full(len(centres), angle), self.angles]),
            cost=np.concatenate([cost, dearer + self.cost]),
            anchors=np.concatenate([np.full(len(centres), complex("nan")), self.anchors]),
            bound=True,
        )


def unit(vector: complex) -> complex:
    """The unit vector of a vector; 1 for the zero vector.

    >>> unit(5j), unit(0j)
    (1j, (1+0j))
    """
    return vector / abs(vector) if vector else 1.0 + 0j


def _size(text: str, height: float) -> complex:
    wide, below, above = extent(text, height)
    return complex(wide, below + above)


def label_around(anchor: complex, text: str, height: float, towards: complex) -> LabelText:
    """A text with level places around a point, first near it in the direction ``towards``."""
    half, near = _size(text, height) / 2, _point_label_places(unit(towards))
    side = near.side.real * half.real + 1j * (near.side.imag * half.imag)
    centres, anchors = anchor + near.ways + side, np.where(near.far, anchor, complex("nan"))
    return LabelText(text, height, centres, np.zeros(len(centres)), near.cost, anchors)


@dataclass(frozen=True, eq=False)
class _PointLabelPlaces:
    """The places (k,) of a text about a point, the best first.

    ways : vectors from the point to the text's box
    side : the side of the box that is nearest to the point, from its middle in halves of width and height
    far : whether a leader is needed
    cost : the less, the better
    """

    ways: Points
    side: Points
    far: NDArray[np.bool_]
    cost: Floats


# Labels of one construction look into few directions.
@lru_cache(maxsize=256)
def _point_label_places(favourite: complex) -> _PointLabelPlaces:
    # The preferred direction itself comes first, then the compass.
    directions: Points = np.concatenate([[favourite], LABEL_DIRECTIONS])
    turned = 1.5 + 4.0 * (1.0 - (directions * favourite.conjugate()).real)
    turned[0] = 0.0
    far = LABEL_GAPS >= MIN_LEADER_LENGTH
    distance = 0.9 * (LABEL_GAPS - LABEL_GAPS[0]) + 4.0 * far
    cost = (distance[:, None] + turned).ravel()
    order = np.argsort(cost, kind="stable")
    # The box touches the point with a corner or with the middle of a side, and everything between.
    side = np.clip(1.6 * directions.real, -1, 1) + 1j * np.clip(1.6 * directions.imag, -1, 1)
    ways, sides = (LABEL_GAPS[:, None] * directions).ravel(), np.tile(side, len(LABEL_GAPS))
    return _PointLabelPlaces(ways[order], sides[order], np.repeat(far, len(directions))[order], cost[order])


def label_in_line(label: LabelText, start: complex, length: float) -> LabelText:
    """The text with places in a level line of a length, which it interrupts, the first one near its start."""
    shifts = np.arange(IN_LINE_GAP, length - label.size.real - IN_LINE_GAP, IN_LINE_STEP)
    if not shifts.size:
        return label
    return label.on_line(start + shifts + label.size.real / 2, 0.0, IN_LINE_COST * shifts, dearer=80)


def label_along_arc(centre: complex, radius: float, start: float, end: float, text: str, height: float) -> LabelText:
    """A text with level places along an arc: beyond its middle, elsewhere along it, inside; far away with a leader."""
    half = _size(text, height) / 2
    shares = np.array([0.5, 0.42, 0.58, 0.34, 0.66, 0.25, 0.75])
    rays: Points = np.exp(1j * (start + shares * (end - start)))
    reach = np.abs(half.real * rays.real) + np.abs(half.imag * rays.imag) + 1.2
    spread = 6.0 * np.abs(shares - 0.5)
    middle = label_around(complex(centre + radius * rays[0]), text, height, complex(rays[0]))
    beside = np.concatenate([centre + (radius + reach) * rays, centre + (radius - reach) * rays])
    return replace(middle.on_line(beside, 0.0, np.concatenate([spread, 2 + spread]), dearer=3), close=len(shares))


def label_along(start: complex, end: complex, text: str, height: float) -> LabelText:
    """A text with places along a dimension line, readable from below or from the right, first above the line."""
    direction = unit(end - start)
    # A base line that runs to the left would stand on its head; one that runs straight up is read from the right.
    if direction.real < -1e-9 or (abs(direction.real) <= 1e-9 and direction.imag < 0):
        start, end, direction = end, start, -direction
    on_line, cost = start + TEXT_FRACTIONS * (end - start), 4 * np.abs(TEXT_FRACTIONS - 0.5)
    free = label_around(complex(on_line[0]), text, height, 1j * direction)
    lift = free.size.imag / 2 + TEXT_GAP
    centres = np.concatenate([on_line + 1j * direction * lift, on_line - 1j * direction * lift])
    return free.on_line(centres, cmath.phase(direction), np.concatenate([cost, 3 + cost]), dearer=12)


def label_over(start: complex, end: complex, text: str, height: float) -> LabelText:
    """A text longer than its dimension line, with places over its middle, under it, or on a leader from there.

    Beside the line the text would read as that of the next dimension in a chain.
    """
    line = label_along(start, end, text, height)
    half, direction = line.size / 2, cmath.rect(1.0, float(line.angles[0]))
    # Texts on leaders are level, the line need not be.
    reach = half.real * abs(direction.imag) + half.imag * abs(direction.real) + LEADER_TEXT_GAP
    kept = np.isfinite(line.anchors) & (np.abs(((line.centres - line.anchors) / direction).imag) >= reach)
    # Over the middle, and under it.
    kept[[0, len(TEXT_FRACTIONS)]] = True
    return LabelText(
        text, height, line.centres[kept], line.angles[kept], line.cost[kept], line.anchors[kept], bound=True
    )

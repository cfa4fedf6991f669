"""A text that still looks for its place: where it could stand, and how well."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.ink import Points
from graphcam.sheets.fonts import extent
from graphcam.sheets.model import Angle, Length, Text

Floats = NDArray[np.float64]

GAPS = np.array([1.2, 1.8, 2.5, 3.4, 4.6, 6.5, 9.0, 12.0, 16.0, 21.0, 27.0, 35.0])
"""Distances between a point and its label that are tried, mm."""
LEADER = 6.0
"""From this distance on, a thin line leads from the label to its point, mm."""
CLEAR = 2.0
"""Between a dimension line and a text on a leader from it, mm."""
SHARES = np.array([0.5, 0.42, 0.58, 0.3, 0.7, 0.18, 0.82])
"""Where along a dimension line its text may stand, the middle first."""
DIRECTIONS: Points = np.exp(1j * np.radians(np.arange(0.0, 360.0, 22.5)))


@dataclass(frozen=True, eq=False)
class Writing:
    """A text and its possible places, the first one the best if the paper were empty.

    centres : (k,) of the text's box
    angles : (k,) of its base line, rad
    cost : (k,) what each place costs, in lines crossed (see :mod:`graphcam.sheets.labels`)
    anchors : (k,) where a leader ends; NaN where there is none
    bound : whether the text belongs to a line, not to a point: such texts choose first
    of : the dimension that it is the text of
    """

    text: str
    height: float
    centres: Points
    angles: Floats
    cost: Floats
    anchors: Points
    bound: bool = False
    of: Length | Angle | None = None

    @property
    def size(self) -> complex:
        """Width and height of the text's box, as x + iy."""
        wide, below, above = extent(self.text, self.height)
        return complex(wide, below + above)

    def set_at(self, k: int) -> Text:
        """The text in its place ``k``."""
        _, below, above = extent(self.text, self.height)
        angle = float(self.angles[k])
        base = self.centres[k] - cmath.rect((above - below) / 2, angle + math.pi / 2)
        return Text(complex(base), self.text, self.height, "center", angle, of=self.of)


def around(anchor: complex, text: str, height: float, towards: complex) -> Writing:
    """Level places around a point, first near it in the direction ``towards``."""
    wide, below, above = extent(text, height)
    half = complex(wide, below + above) / 2
    favourite = towards / abs(towards) if towards else 1.0 + 0j
    # The preferred direction itself comes first, then the compass.
    directions: Points = np.concatenate([[favourite], DIRECTIONS])
    # The box touches the point with a corner or with the middle of a side, and everything between.
    side = np.clip(1.6 * directions.real, -1, 1) * half.real + 1j * np.clip(1.6 * directions.imag, -1, 1) * half.imag
    centres = (anchor + GAPS[:, None] * directions + side).ravel()
    turned = 1.5 + 4.0 * (1.0 - (directions * favourite.conjugate()).real)
    turned[0] = 0.0
    far = GAPS >= LEADER
    distance = 0.9 * (GAPS - GAPS[0]) + 4.0 * far
    cost = (distance[:, None] + turned).ravel()
    anchors = np.where(np.repeat(far, len(directions)), anchor, complex("nan"))
    order = np.argsort(cost, kind="stable")
    return Writing(text, height, centres[order], np.zeros(len(order)), cost[order], anchors[order])


def outside(centre: complex, radius: float, start: float, end: float, text: str, height: float) -> Writing:
    """Level places along an arc: beyond its middle, then elsewhere along it, then inside; far away with a leader."""
    wide, below, above = extent(text, height)
    half = complex(wide, below + above) / 2
    shares = np.array([0.5, 0.42, 0.58, 0.34, 0.66, 0.25, 0.75])
    rays: Points = np.exp(1j * (start + shares * (end - start)))
    reach = np.abs(half.real * rays.real) + np.abs(half.imag * rays.imag) + 1.2
    spread = 6.0 * np.abs(shares - 0.5)
    middle = around(complex(centre + radius * rays[0]), text, height, complex(rays[0]))
    return Writing(
        text, height,
        np.concatenate([centre + (radius + reach) * rays, centre + (radius - reach) * rays, middle.centres]),
        np.concatenate([np.zeros(2 * len(rays)), middle.angles]),
        np.concatenate([spread, 2 + spread, 3 + middle.cost]),
        np.concatenate([np.full(2 * len(rays), complex("nan")), middle.anchors]),
        bound=True,
    )  # fmt: skip


def along(start: complex, end: complex, text: str, height: float) -> Writing:
    """Places along a dimension line, readable from below or from the right, above the line before below it."""
    _, below, above = extent(text, height)
    direction = (end - start) / abs(end - start) if end != start else 1.0 + 0j
    # A base line that runs to the left would stand on its head; one that runs straight up is read from the right.
    if direction.real < -1e-9 or (abs(direction.real) <= 1e-9 and direction.imag < 0):
        start, end, direction = end, start, -direction
    lift = (below + above) / 2 + 0.8
    on_line = start + SHARES * (end - start)
    centres = np.concatenate([on_line + 1j * direction * lift, on_line - 1j * direction * lift])
    cost = np.concatenate([4 * np.abs(SHARES - 0.5), 3 + 4 * np.abs(SHARES - 0.5)])
    free = around(complex(on_line[0]), text, height, 1j * direction)
    return Writing(
        text, height,
        np.concatenate([centres, free.centres]),
        np.concatenate([np.full(len(centres), cmath.phase(direction)), free.angles]),
        np.concatenate([cost, 12 + free.cost]),
        np.concatenate([np.full(len(centres), complex("nan")), free.anchors]),
        bound=True,
    )  # fmt: skip


def over(start: complex, end: complex, text: str, height: float) -> Writing:
    """Places for a text that is longer than its dimension line: over its middle, under it, else on a leader from there.

    Beside the line the text would read as that of the next dimension in a chain.
    """
    line = along(start, end, text, height)
    half, direction = line.size / 2, cmath.rect(1.0, float(line.angles[0]))
    # Texts on leaders are level, the line need not be.
    reach = half.real * abs(direction.imag) + half.imag * abs(direction.real) + CLEAR
    kept = np.isfinite(line.anchors) & (np.abs(((line.centres - line.anchors) / direction).imag) >= reach)
    # Over the middle, and under it.
    kept[[0, len(SHARES)]] = True
    return Writing(text, height, line.centres[kept], line.angles[kept], line.cost[kept], line.anchors[kept], bound=True)

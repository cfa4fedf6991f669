"""Tags and codes of square cells as filled polygons, and the bars by which a print is measured."""

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.sheets.model import Entity, Polygons, Strokes
from graphcam.sheets.styles import CODE

RULED = 10.0
"""From one stroke of a bar to the next, mm."""
STROKE, END = 1.5, 3.0
"""Lengths of the strokes of a bar, mm: of all, and of those at its ends."""


def cells(dark: NDArray[np.bool_], corner: complex, cell: float) -> Polygons:
    """The dark cells (rows from above, columns), ``cell`` mm wide, with their lower left ``corner``.

    Neighbours are joined, so that no renderer leaves a seam between them.

    >>> cells(np.array([[True, True], [True, False]]), 0j, 1.0).corners.tolist()
    [[1j, (2+1j), (2+2j), 2j], [0j, (1+0j), (1+1j), 1j]]
    """
    rows = len(dark)
    boxes: list[Points] = []
    for row, bits in enumerate(dark):
        ends = np.flatnonzero(np.diff(np.concatenate([[0], bits.astype(np.int8), [0]])))
        for start, stop in ends.reshape(-1, 2).tolist():
            low, high = 1j * (rows - row - 1), 1j * (rows - row)
            boxes.append(np.array([start + low, stop + low, stop + high, start + high]))
    return Polygons(corner + cell * np.array(boxes), CODE)


def square(corner: complex, side: float, role: str) -> Polygons:
    """A filled square."""
    return Polygons(corner + side * np.array([[0, 1, 1 + 1j, 1j]]), role)


def bar(start: complex, end: complex) -> list[Entity]:
    """A ruled bar of a multiple of 10 mm, its strokes to the left of the way from ``start`` to ``end``."""
    way = (end - start) / abs(end - start)
    at = start + way * np.arange(0.0, abs(end - start) + RULED / 2, RULED)
    long = np.full(len(at), STROKE)
    long[[0, -1]] = END
    return [Strokes(np.array([start]), np.array([end]), "gauge"), Strokes(at, at + 1j * way * long, "ruling")]

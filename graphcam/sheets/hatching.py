"""Hatching as lines: inside a polygon, and broken off around lettering."""

import cmath
import math
from collections.abc import Iterable

import numpy as np

from graphcam.drafting.marks import Points, Role
from graphcam.sheets.model import Entity, Strokes, Text
from graphcam.sheets.sampling import corners, within

SPACING = 3.0
"""Between the lines of hatching, mm."""
AROUND_TEXT = 0.8
"""Free margin in the hatching around a text, mm."""


def hatch(boundary: Points, spacing: float = SPACING) -> Strokes:
    """Lines at 45 degrees inside a polygon (n,), which may have notches.

    Every line runs inside from an odd crossing of the outline to the next one.

    >>> square = np.array([0, 10, 10 + 10j, 10j])
    >>> lines = hatch(square, spacing=5.0)
    >>> bool(np.all(np.abs(lines.ends - lines.starts) < 14.15))
    True
    """
    # Turned by -45 degrees the lines of hatching lie level, at heights that are whole multiples of the spacing.
    turn = cmath.rect(1.0, -math.pi / 4)
    corners = np.asarray(boundary, dtype=np.complex128) * turn
    nexts = np.roll(corners, -1)
    low, high = math.floor(corners.imag.min() / spacing), math.ceil(corners.imag.max() / spacing)
    starts: list[complex] = []
    ends: list[complex] = []
    for level in spacing * np.arange(low, high + 1):
        # A corner on the line belongs to the side above it, so crossings come in pairs.
        cut = (corners.imag <= level) != (nexts.imag <= level)
        a, b = corners[cut], nexts[cut]
        x = np.sort(a.real + (level - a.imag) * (b.real - a.real) / (b.imag - a.imag))
        starts += list(x[::2] + 1j * level)
        ends += list(x[1::2] + 1j * level)
    return Strokes(np.array(starts, dtype=complex) / turn, np.array(ends, dtype=complex) / turn, Role.HATCH)


def interrupted(entity: Entity, texts: Iterable[Text]) -> Entity:
    """Separate lines without the parts that run through texts; other entities as they are.

    >>> line = Strokes(np.array([-10 + 1j]), np.array([20 + 1j]), Role.HATCH)
    >>> len(interrupted(line, [Text(0j, "A", 3.5)]).starts)
    2
    """
    if not isinstance(entity, Strokes):
        return entity
    starts, ends = entity.starts, entity.ends
    for text in texts:
        low, high = within(starts, ends, corners(text), AROUND_TEXT)
        cut = low < high
        steps = ends - starts
        before, after = cut & (low > 0), cut & (high < 1)
        starts, ends = (
            np.concatenate([starts[~cut], starts[before], (starts + high * steps)[after]]),
            np.concatenate([ends[~cut], (starts + low * steps)[before], ends[after]]),
        )
    return Strokes(starts, ends, entity.role)

"""Symbols of part drawings: surface texture, geometrical tolerances and datums, each with the box that it needs.

Roughness by ISO 1302 and GOST 2.309, tolerances by ISO 1101 and GOST 2.308: their shapes are the same.  A symbol is
drawn with the lower left corner of its box at the origin.  The ``height`` of its letters is that of a capital; it,
radii and places are in mm.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from graphcam.drafting.marks import Role
from graphcam.sheets.mark_entities import head
from graphcam.sheets.model import ArcEntity, Box, Entity, Heads, Strokes, Text, moved_entity
from graphcam.sheets.text_measures import width

SYMBOL_ROLE = Role.DIMENSION
"""The role of all lines and letters of symbols."""
LEG_ANGLE = math.radians(60)
"""The angle of the legs of the roughness symbol to the surface."""
SHORT_LEG_HEIGHT, LONG_LEG_HEIGHT = 1.4, 3.0
"""Heights of the legs of the roughness symbol, in heights of the letters."""
LETTER_GAP = 0.6
"""The gap between a line and the letters over or under it [mm]."""
TRIANGLE_HALF_SIDE = 0.577
"""Half the side of a datum's equilateral triangle, in its heights: tan 30°."""
COMPARTMENT_SIZE = 2.0
"""The height of a tolerance frame, and the width of its first compartment, in heights of the letters."""
LINE_PROFILE_TOLERANCE, PERPENDICULARITY_TOLERANCE = "profile of a line", "perpendicular"
SYMMETRY_TOLERANCE = "symmetry"


@dataclass(frozen=True, eq=False)
class PartSymbol:
    """Entities of a symbol and its box, whose lower left corner is the origin."""

    entities: tuple[Entity, ...]
    box: Box

    def drawn(self, corner: complex) -> list[Entity]:
        """The entities with the lower left corner of the symbol's box at ``corner``."""
        return [moved_entity(entity, corner) for entity in self.entities]


def segments(*ends: tuple[complex, complex], role: str = SYMBOL_ROLE) -> Strokes:
    """Separate straight lines."""
    starts, stops = zip(*ends, strict=True)
    return Strokes(np.array(starts), np.array(stops), role)


def roughness(text: str, height: float) -> PartSymbol:
    """The symbol for removed material, with the roughness under its bar; it stands on the bottom of its box.

    >>> symbol = roughness("Ra 0.8", 2.5)
    >>> symbol.box.height, len(symbol.entities)
    (7.5, 2)
    """
    left = SHORT_LEG_HEIGHT * height / math.tan(LEG_ANGLE)
    foot = complex(left, 0.0)
    short = foot + SHORT_LEG_HEIGHT * height * complex(-1 / math.tan(LEG_ANGLE), 1)
    level = foot + SHORT_LEG_HEIGHT * height * complex(1 / math.tan(LEG_ANGLE), 1)
    top = foot + LONG_LEG_HEIGHT * height * complex(1 / math.tan(LEG_ANGLE), 1)
    wide = width(text, height) + 2 * LETTER_GAP + 0.4 * height
    lines = segments((foot, short), (short, level), (foot, top), (top, top + wide))
    letters = Text(complex(top.real + LETTER_GAP, top.imag - LETTER_GAP - height), text, height)
    return PartSymbol((lines, letters), Box(0, 0, top.real + wide, LONG_LEG_HEIGHT * height))


def other_faces(text: str, height: float) -> PartSymbol:
    """The roughness of all faces that bear no symbol: the symbol, and the bare one in brackets behind it."""
    first = roughness(text, height)
    start = first.box.right + 0.6 * height
    bracket = width("(", 1.4 * height)
    foot = complex(start + bracket + 0.5 * height + SHORT_LEG_HEIGHT * height / math.tan(LEG_ANGLE), 0.3 * height)
    short = foot + SHORT_LEG_HEIGHT * height * complex(-1 / math.tan(LEG_ANGLE), 1)
    top = foot + 2.2 * height * complex(1 / math.tan(LEG_ANGLE), 1)
    end = top.real + 0.5 * height
    brackets = (Text(complex(x, 0.5 * height), sign, 1.4 * height) for x, sign in ((start, "("), (end, ")")))
    box = Box(0, 0, end + bracket, first.box.height)
    return PartSymbol((*first.entities, segments((foot, short), (foot, top)), *brackets), box)


def tolerance_frame(kind: str, value: str, datums: Sequence[str], height: float) -> PartSymbol:
    """A frame with the symbol of the tolerance, its value and its datums, the first one first."""
    high = COMPARTMENT_SIZE * height
    ends = np.cumsum([0.0, high, *(width(text, height) + height for text in (value, *datums))]).tolist()
    frame = segments(
        *((complex(x), complex(x, high)) for x in ends), (0j, ends[-1] + 0j), (1j * high, ends[-1] + 1j * high)
    )
    middles = [(a + b) / 2 for a, b in pairwise(ends)]
    base = (high - height) / 2
    letters = [
        Text(complex(x, base), text, height, "center") for x, text in zip(middles[1:], (value, *datums), strict=True)
    ]
    return PartSymbol(
        (frame, *_characteristic(kind, complex(middles[0], high / 2), height), *letters), Box(0, 0, ends[-1], high)
    )


def _characteristic(kind: str, middle: complex, height: float) -> list[Entity]:
    """The sign of a geometrical characteristic, in the middle of its compartment."""
    half = 0.55 * height
    if kind == LINE_PROFILE_TOLERANCE:
        return [ArcEntity(middle - 0.5j * half, half, 0.0, math.pi, SYMBOL_ROLE)]
    if kind == SYMMETRY_TOLERANCE:
        lines = ((0.6, 0.5j), (1.0, 0j), (0.6, -0.5j))
        return [segments(*((middle + half * (up - w), middle + half * (up + w)) for w, up in lines))]
    base = middle - 1j * half
    return [segments((base - half, base + half), (base, base + 2j * half))]


def datum_letter(letter: str, height: float) -> PartSymbol:
    """The letter of a datum in its square.

    >>> lines, _ = datum_letter("A", 2.5).entities
    >>> (lines.starts == 2.5 * COMPARTMENT_SIZE * np.array([0, 1, 1 + 1j, 1j])).all()
    np.True_
    """
    side = COMPARTMENT_SIZE * height
    corners = (0j, side + 0j, side + 1j * side, 1j * side)
    lines = segments(*zip(corners, (*corners[1:], corners[0]), strict=True))
    return PartSymbol(
        (lines, Text(complex(side / 2, (side - height) / 2), letter, height, "center")), Box(0, 0, side, side)
    )


def datum_triangle(at: complex, away: complex, height: float) -> Heads:
    """The filled triangle that stands on a line ``at`` a place and points ``away`` from it."""
    up = height * away / abs(away)
    half = TRIANGLE_HALF_SIDE * 1j * up
    return Heads(np.array([[at + up, at - half, at + half]]), SYMBOL_ROLE)


def nearest_place(box: Box, to: complex) -> complex:
    """The point of a box that is nearest to another point."""
    return complex(np.clip(to.real, box.left, box.right), np.clip(to.imag, box.bottom, box.top))


def leader(symbol: Box, to: complex, *, arrowed: bool = True) -> list[Entity]:
    """A line from the nearest corner or side of a symbol's box to a place, with an arrow there."""
    beside = nearest_place(symbol, to)
    line = segments((beside, to))
    return [line, head(to, to - beside, SYMBOL_ROLE)] if arrowed and to != beside else [line]


def shelf_leader(symbol: Box, to: complex) -> list[Entity]:
    """A shelf under a symbol, and from its nearer end a line with an arrow to a place."""
    ends = [complex(symbol.left, symbol.bottom), complex(symbol.right, symbol.bottom)]
    near, far = sorted(ends, key=lambda end: abs(end - to))
    return [segments((far, near), (near, to)), head(to, to - near, SYMBOL_ROLE)]


def cutting_plane(at: complex, outwards: complex, look: complex, letter: str, height: float) -> list[Entity]:
    """One end of a cutting plane: a bold stroke from ``at`` outwards, an arrow along ``look``, and the letter."""
    stroke, reach = 8.0, 9.0
    end = at + stroke * outwards
    arrow_at = at + 0.7 * stroke * outwards
    beside = arrow_at - (reach / 2) * look + 1.2 * height * outwards
    base = beside - 1j * height / 2
    return [
        segments((at, end), role="frame"),
        segments((arrow_at - reach * look, arrow_at)),
        head(arrow_at - 0.6 * look, look, SYMBOL_ROLE),
        Text(base, letter, height, "center"),
    ]


def sense_arrow(centre: complex, radius: float, start: float, sweep: float) -> list[Entity]:
    """An arc with a head from the direction ``start`` [rad] on, by ``sweep``, clockwise if that is negative."""
    end = start + sweep
    low, high = sorted((start, end))
    tip = centre + cmath.rect(radius, end)
    # On the chord of its own length, so that the head does not leave the arc.
    along = 1j * math.copysign(1, sweep) * cmath.rect(1, end - math.copysign(min(1.0, 1.8 / radius), sweep))
    return [ArcEntity(centre, radius, low, high, SYMBOL_ROLE), head(tip, along, SYMBOL_ROLE)]

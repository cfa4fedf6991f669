"""Marks: what a line, a point or a text on the paper is, by its role, and the act that left it.

Points are complex numbers in mm of paper, in the frame of their view (x right, y up).  How thick a line is drawn, and
where a label finds room, is the sheet's business.
"""

from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from graphcam.words import Words

Points = NDArray[np.complexfloating[Any, Any]]
Places = NDArray[np.intp]
"""Which of the places of its act the pieces of a mark are: of a line its corners, of segments and dots each."""


class Origin(Protocol):
    """What a mark comes from: the act that left it, or, of a dimension, the reading whose number it bears."""

    @property
    def name(self) -> str:
        """The name of the act or reading in its construction."""
        ...


class Role(StrEnum):
    """What a line is for, from thin to bold."""

    CONSTRUCTION = "construction"  # thin: rays, projections, bisectors
    HATCH = "hatch"  # thin: shading of a region
    DIMENSION = "dimension"  # thin: dimension lines, arrows, leaders
    AXIS = "axis"  # thin, dash-dot: centre lines, the line of motion
    HIDDEN = "hidden"  # thin, dashed: alternatives that are not taken
    SCALE = "scale"  # thin: coordinate axes with their divisions
    CURVE = "curve"  # thin and black: plotted and faired curves
    LIMIT = "limit"  # medium, the accent: lines at a limit, and what binds
    RESULT = "result"  # bold: what the construction was drawn for


class LeftPlaces(Protocol):
    """Some of the places that an act left."""

    @property
    def act(self) -> Origin:
        """The act that left them."""
        ...

    @property
    def index(self) -> Places:
        """The numbers of the places among all that the act left, (n,)."""
        ...


@dataclass(frozen=True, kw_only=True)
class Left:
    """What a mark is of: the act that left it, and which of its places the pieces of the mark are.

    spare : whether it can be left out where there is little room, as a second graduation of an axis
    """

    of: Origin | None = field(default=None, compare=False, repr=False)
    index: Places | None = field(default=None, compare=False, repr=False)
    spare: bool = field(default=False, compare=False, repr=False)

    def left_by(self, drawn: LeftPlaces) -> Self:
        """The mark with the places that left it; every corner of a line or dots at one place is of that place."""
        index = drawn.index
        corners = self.points.size if isinstance(self, Line | Dots) and index.size == 1 else 1
        return replace(self, of=drawn.act, index=index.repeat(corners))


@dataclass(frozen=True, eq=False)
class Line(Left):
    """A line through points (n,), straight from one to the next; ``closed`` joins the last to the first."""

    points: Points
    role: Role
    closed: bool = False


@dataclass(frozen=True, eq=False)
class Segments(Left):
    """Many separate segments from ``starts`` (n,) to ``ends`` (n,)."""

    starts: Points
    ends: Points
    role: Role


@dataclass(frozen=True)
class Circle(Left):
    """A whole circle."""

    centre: complex
    radius: float
    role: Role


@dataclass(frozen=True)
class Arc(Left):
    """Part of a circle, counter-clockwise from direction ``start`` to ``end`` [rad]; ``arrow`` at 'start' or 'end'."""

    centre: complex
    radius: float
    start: float
    end: float
    role: Role
    arrow: str = ""


@dataclass(frozen=True, eq=False)
class Dots(Left):
    """Plotted points (n,)."""

    points: Points
    role: Role = Role.CURVE


@dataclass(frozen=True)
class Arrow(Left):
    """A vector with its head at ``end``."""

    start: complex
    end: complex
    role: Role


@dataclass(frozen=True)
class Label(Left):
    """A name or a number beside ``at``; the sheet finds it a free place, first in the direction ``towards``.

    along : how far a line runs level to the right from ``at``, which the text had better interrupt [mm]
    axis : whether it names or numbers an axis
    """

    at: complex
    text: Words
    towards: complex = 1 + 1j
    small: bool = False
    along: float = 0.0
    axis: bool = False


@dataclass(frozen=True)
class Dimension(Left):
    """The length from ``start`` to ``end``, its line moved to the left by ``aside`` mm.

    of_radius : whether it goes from the centre of a circle to it, with a head there alone
    """

    start: complex
    end: complex
    text: Words
    aside: float = 0.0
    of_radius: bool = False


@dataclass(frozen=True)
class AngleMark(Left):
    """An angle at ``centre`` between two directions [rad], drawn as an arc with arrows and its text."""

    centre: complex
    radius: float
    start: float
    end: float
    text: Words


@dataclass(frozen=True, eq=False)
class Region(Left):
    """A shaded region: a polygon (n,) to be hatched."""

    boundary: Points


def angle_at(place: complex, start: float, end: float, radius: float, text: Words, of: Origin | None) -> AngleMark:
    """The smaller of the two angles between two directions [rad], marked at a place; ``of`` as in every mark."""
    turn = (end - start + np.pi) % (2 * np.pi) - np.pi
    first, last = sorted((start, start + turn))
    return AngleMark(place, radius, first, last, text, of=of)


Mark = Line | Segments | Circle | Arc | Dots | Arrow | Label | Dimension | AngleMark | Region

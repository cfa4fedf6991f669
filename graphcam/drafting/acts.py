"""Acts: what a draughtsman does, as values that say with what, from where and to where.

An act is recorded when it is done: its kind, what it takes, and what it leaves on the paper.  Only references to arrays
are kept.  What an act leaves is a :class:`Drawn`: places, lines or circles, for all stations and all hands at once.
Later acts take it, whole or in part, and marks are made of it, so that every mark knows the act that left it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Arrow, Circle, Dots, Label, Line, Places, Points, Role, Segments
from graphcam.words import Words

Floats = NDArray[np.floating[Any]]
Index = int | slice | list[int] | NDArray[np.integer[Any]] | NDArray[np.bool_]


class Kind(StrEnum):
    """What is done, such as "lay off", and with which instrument."""

    GIVEN = "given", ""  # lies on the board before the first line, or is found in a drawing made before
    DIVIDE = "divide", "dividers"  # equal parts
    ERECT = "erect", "set square"  # an upright, or another line of known direction
    PROJECT = "project", "T-square"  # square across to a line
    LAY_OFF = "lay off", "dividers"  # a length from a place
    JOIN = "join", "ruler"  # a line through two places
    PARALLEL = "parallel", "set squares"
    PERPENDICULAR = "perpendicular", "set squares"
    TANGENT = "tangent", "set square"  # or a mirror, moved until it touches
    BISECT = "bisect", "compass"  # two arcs of one setting
    CIRCLE = "circle", "compass"
    PROTRACTOR = "protractor", "protractor"  # an angle laid off
    CROSS = "cross", ""  # where two lines meet
    FAIR = "fair", "curve template"
    TAKE = "take", ""  # of what lies there, what one goes on with
    ENLARGE = "enlarge", ""  # the same places once more, in another view or on the other side of a line
    READ = "read", "ruler"  # or a protractor: a length, an angle; or in the head, from others

    instrument: str

    def __new__(cls, act: str, instrument: str) -> Kind:
        """A kind of act, with its instrument."""
        kind = str.__new__(cls, act)
        kind._value_, kind.instrument = act, instrument
        return kind


@dataclass(frozen=True, eq=False)
class Setting:
    """What dividers or a protractor are set to, or what is read, and where that comes from.

    amount : ([samples,] ...) [mm of paper, or rad]
    ends : the two places that it is taken between, ``along`` a direction if one is given
    reading : that it is carried over from, times ``factor``; or in whose scale the machine ``value`` is laid off
    formula, given : what is reckoned in the head, and from what
    """

    amount: Floats
    ends: tuple[Drawn, Drawn] | None = None
    along: Drawn | complex | None = None
    reading: Any = None
    factor: Floats | float = 1.0
    value: float | None = None
    formula: Callable[..., Floats] | None = None
    given: tuple[Setting, ...] = ()
    sampled: bool = False


@dataclass(frozen=True, eq=False)
class Act:
    """One kind of move at all stations at once.

    takes : by argument: what is drawn already, settings, given numbers and directions
    size : at so many places
    """

    kind: Kind
    construction: str
    name: str
    takes: Mapping[str, Any]
    size: int


@dataclass(frozen=True, eq=False)
class Drawn:
    """What an act left on the paper, or a part of it.

    points : ([samples,] ...) places; of lines a place on each, of circles the centres
    along : directions of lines, of any length; radius : of circles [mm]; None for places
    whole : what it is a part of: the stations ``at``, with the directions turned by ``turn``
    """

    act: Act
    points: Points
    along: Points | None = None
    radius: Floats | None = None
    sampled: bool = False
    whole: Drawn | None = None
    at: Index | None = None
    turn: complex = 1

    def __getitem__(self, at: Index) -> Drawn:
        """The part at some stations, or at one."""
        parts = [None if each is None else each[..., at] for each in (self.points, self.along, self.radius)]
        return Drawn(self.act, *parts, sampled=self.sampled, whole=self, at=at)  # pyright: ignore[reportArgumentType]

    def turned(self, turn: complex) -> Drawn:
        """The same lines with their directions reversed (-1), or as seen square to them (1j, -1j)."""
        return Drawn(self.act, self.points, self.directions * turn, None, self.sampled, self, None, turn)

    @property
    def directions(self) -> Points:
        """The directions of lines (...), of any length; an error for places and circles."""
        assert self.along is not None
        return self.along

    @property
    def first(self) -> Drawn:
        """What is drawn in the first sample, the one that is shown; without an axis of samples."""
        if not self.sampled:
            return self
        parts = [None if each is None else each[0] for each in (self.points, self.along, self.radius)]
        whole = None if self.whole is None else self.whole.first
        return Drawn(self.act, *parts, whole=whole, at=self.at, turn=self.turn)  # pyright: ignore[reportArgumentType]

    @property
    def root(self) -> Drawn:
        """All that the act left, of which this may be a part."""
        return self if self.whole is None else self.whole.root

    @property
    def index(self) -> Places:
        """The numbers of these places among all that the act left, in a row (n,)."""
        if self.whole is None:
            return np.arange(self.shown.size)
        index = self.whole.index
        return index if self.at is None else np.atleast_1d(index[self.at])

    # --- what it looks like, in the first sample ---------------------------------------------------------------------

    @property
    def shown(self) -> Points:
        """The places in the first sample, in a row (n,) [mm of paper]."""
        return np.atleast_1d(self.first.points)

    @property
    def place(self) -> complex:
        """The one place in the first sample [mm of paper]."""
        return complex(self.shown.item())

    def dots(self, role: Role = Role.CURVE) -> Dots:
        """The places as plotted points."""
        return Dots(self.shown, role).left_by(self)

    def line(self, role: Role, *, closed: bool = False) -> Line:
        """A line through the places, one after another; ``closed`` joins the last to the first."""
        return Line(self.shown, role, closed).left_by(self)

    def segments_from(self, start: Drawn | Points | complex, role: Role) -> Segments:
        """A segment to each place from ``start``, one for all or one for each."""
        begin = start.shown if isinstance(start, Drawn) else np.asarray(start)
        ends = self.shown
        return Segments(np.broadcast_to(begin, ends.shape), ends, role).left_by(self)

    def segments(self, role: Role) -> Segments:
        """The joins of pairs of places, as segments from each to the other."""
        first = self.first
        return Segments(self.shown, self.shown + np.atleast_1d(first.directions), role).left_by(self)

    def way(self, role: Role) -> Line:
        """The join of two places, as a line from one to the other."""
        ends = self.place + np.array([0j, complex(self.first.directions)])
        return Line(ends, role, False).left_by(self)

    def line_from(self, start: Drawn | complex, role: Role) -> Line:
        """The line from ``start`` to the one place."""
        ends = np.array([start.place if isinstance(start, Drawn) else start, self.place])
        return Line(ends, role, False).left_by(self)

    def arrow(self, start: Drawn | complex, role: Role) -> Arrow:
        """An arrow from ``start`` to the one place."""
        return Arrow(start.place if isinstance(start, Drawn) else start, self.place, role).left_by(self)

    def drawn_circle(self, role: Role) -> Circle:
        """The one circle as a mark."""
        return Circle(self.place, float(np.asarray(self.first.radius).item()), role).left_by(self)

    def label(self, text: Words, towards: complex = 1 + 1j, *, small: bool = False) -> Label:
        """A name or a number beside the one place, first in the direction ``towards``."""
        return Label(self.place, text, towards, small).left_by(self)

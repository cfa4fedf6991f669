"""The neutral drawing: pages of lines, circles, arcs and texts in millimetres of paper, before any file format.

Everything that has a meaning (dimensions, arrows, hatching, labels) has been turned into these few entities, so that
every output holds the same ones.  Points are complex numbers, x to the right and y up, from the lower left corner.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import groupby, pairwise

import numpy as np

from graphcam.drafting.marks import Origin, Places, Points


@dataclass(frozen=True)
class Box:
    """An upright rectangle [mm].

    >>> Box(0, 0, 30, 20).grown(1).width
    32
    """

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """The distance from left to right [mm]."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """The distance from bottom to top [mm]."""
        return self.top - self.bottom

    @property
    def area(self) -> float:
        """The area of the box [mm²]."""
        return self.width * self.height

    @property
    def corner(self) -> complex:
        """The lower left corner."""
        return complex(self.left, self.bottom)

    @property
    def corners(self) -> tuple[complex, complex, complex, complex]:
        """The four corners, counter-clockwise from the lower left one."""
        right, top = self.right, self.top
        return self.corner, complex(right, self.bottom), complex(right, top), complex(self.left, top)

    def moved(self, by: complex) -> Box:
        """The box moved ``by`` x + iy."""
        return Box(self.left + by.real, self.bottom + by.imag, self.right + by.real, self.top + by.imag)

    def grown(self, by: float) -> Box:
        """The box with ``by`` more on every side (less, if negative)."""
        return Box(self.left - by, self.bottom - by, self.right + by, self.top + by)

    def meets(self, other: Box) -> bool:
        """Whether the two have more than an edge in common.

        >>> Box(0, 0, 2, 2).meets(Box(1, 1, 3, 3)), Box(0, 0, 2, 2).meets(Box(2, 0, 3, 2))
        (True, False)
        """
        across = self.left < other.right and other.left < self.right
        return across and self.bottom < other.top and other.bottom < self.top

    def common(self, other: Box) -> float:
        """The area that two boxes share, mm².

        >>> Box(0, 0, 2, 2).common(Box(1, 1, 3, 3)), Box(0, 0, 2, 2).common(Box(2, 0, 3, 2))
        (1, 0)
        """
        across = min(self.right, other.right) - max(self.left, other.left)
        up = min(self.top, other.top) - max(self.bottom, other.bottom)
        return max(0, across) * max(0, up)

    def holds(self, other: Box) -> bool:
        """Whether the other lies inside, edges included."""
        across = self.left <= other.left and other.right <= self.right
        return across and self.bottom <= other.bottom and other.top <= self.top


def bounding_box(boxes: Iterable[Box]) -> Box:
    """The smallest box that holds all of at least one box.

    >>> bounding_box([Box(0, 0, 1, 1), Box(5, -2, 6, 0)])
    Box(left=0, bottom=-2, right=6, top=1)
    """
    lefts, bottoms, rights, tops = zip(*((box.left, box.bottom, box.right, box.top) for box in boxes), strict=True)
    return Box(min(lefts), min(bottoms), max(rights), max(tops))


@dataclass(frozen=True, eq=False)
class Source:
    """The act that an entity shows, and which of its places; of a polyline one for each corner."""

    of: Origin
    index: Places | None = None

    def by_piece(self, count: int) -> bool:
        """Whether the source has a place for each of ``count`` pieces."""
        return self.index is not None and len(self.index) == count

    def part(self, which: Places | list[int] | slice, count: int) -> Source:
        """The source of some of ``count`` pieces, by their numbers, if it has a place for each; else the same."""
        return replace(self, index=self.index[which]) if self.index is not None and self.by_piece(count) else self


@dataclass(frozen=True, eq=False)
class Stroke:
    """A polyline through points (n,); ``closed`` joins the last to the first."""

    points: Points
    role: str
    closed: bool = False
    source: Source | None = None


@dataclass(frozen=True, eq=False)
class Strokes:
    """Separate straight lines from ``starts`` (n,) to ``ends`` (n,)."""

    starts: Points
    ends: Points
    role: str
    source: Source | None = None


@dataclass(frozen=True, eq=False)
class Curve:
    """A closed smooth curve through dense points (n,), the first not repeated."""

    points: Points
    role: str
    source: Source | None = None


@dataclass(frozen=True, eq=False)
class Circles:
    """Whole circles of one radius about ``centres`` (n,); ``opaque`` ones hide what lies beneath them."""

    centres: Points
    radius: float
    role: str
    opaque: bool = False
    source: Source | None = None


@dataclass(frozen=True)
class ArcEntity:
    """The part of a circle counter-clockwise from ``start`` to ``end`` [rad]."""

    centre: complex
    radius: float
    start: float
    end: float
    role: str
    source: Source | None = None


@dataclass(frozen=True, eq=False)
class Polygons:
    """Filled triangles or quadrangles, all convex, with corners (n, 3) or (n, 4) in order."""

    corners: Points
    role: str
    source: Source | None = None


@dataclass(frozen=True, eq=False)
class Heads(Polygons):
    """Filled triangles with corners (n, 3): the heads of arrows."""


@dataclass(frozen=True, eq=False)
class Length:
    """The length that a dimension measures: from ``start`` to ``end``, its line through ``foot``, by ``lines``.

    of_radius : whether ``start`` is the centre of a circle, and only ``end`` has a head
    """

    start: complex
    end: complex
    foot: complex
    lines: tuple[Entity, ...]
    of_radius: bool = False


@dataclass(frozen=True, eq=False)
class Angle:
    """The angle between two directions [rad] at ``centre`` that a dimension measures, drawn by ``lines``."""

    centre: complex
    radius: float
    start: float
    end: float
    lines: tuple[Entity, ...]


@dataclass(frozen=True)
class Text:
    """A line of text whose base line starts, is centred or ends (``align``) at ``at``.

    height : of a capital letter, mm
    align : "left", "center" or "right"
    angle : of the base line, rad
    of : the dimension to which the text belongs
    field : of the title block, whose entry it is: a name such as "author"
    view : the view whose title it is

    The ``source`` is the act that it shows; texts of a frame and a table have none.
    """

    at: complex
    text: str
    height: float
    align: str = "left"
    angle: float = 0.0
    role: str = "text"
    of: Length | Angle | None = None
    field: str = ""
    view: str = ""
    source: Source | None = None


Entity = Stroke | Strokes | Curve | Circles | ArcEntity | Polygons | Text


@dataclass(frozen=True)
class Group:
    """Entities that appear together: a step of a construction, the frame, the tables.

    name : unique on its page; the first word is an identifier ("step-03 integration")
    """

    name: str
    entities: tuple[Entity, ...]

    @property
    def key(self) -> str:
        """The first word of the name.

        >>> Group("step-03 integration", ()).key
        'step-03'
        """
        return self.name.split(" ", 1)[0]

    def runs(self) -> Iterator[tuple[str, str, list[Entity]]]:
        """Runs of neighbours of one kind ("line", "filled", "opaque" or "text") and role, which one path can draw."""
        for (kind, role), run in groupby(self.entities, key=lambda entity: (kind_of(entity), entity.role)):
            yield kind, role, list(run)


def kind_of(entity: Entity) -> str:
    """The kind of painting of an entity: "line", "filled", "opaque" or "text"."""
    match entity:
        case Text():
            return "text"
        case Polygons():
            return "filled"
        case Circles(opaque=True):
            return "opaque"
        case _:
            return "line"


@dataclass(frozen=True)
class Page:
    """A sheet of paper, ``width`` x ``height`` mm, and its groups, the later ones over the earlier.

    frame : the box that the drawing must not leave
    origins : the origins of its views on the page, by the view's name
    """

    width: float
    height: float
    frame: Box
    groups: tuple[Group, ...]
    origins: Mapping[str, complex] = field(default_factory=dict[str, complex])


@dataclass(frozen=True)
class Drawing:
    """The pages of a drawing and its title."""

    title: str
    pages: tuple[Page, ...]

    @property
    def texts(self) -> list[Text]:
        """The texts of all pages."""
        entities = (entity for page in self.pages for group in page.groups for entity in group.entities)
        return [entity for entity in entities if isinstance(entity, Text)]


def moved_entity(entity: Entity, by: complex) -> Entity:
    """The entity moved ``by`` x + iy."""
    match entity:
        case Strokes():
            return replace(entity, starts=entity.starts + by, ends=entity.ends + by)
        case Stroke() | Curve():
            return replace(entity, points=entity.points + by)
        case Circles():
            return replace(entity, centres=entity.centres + by)
        case ArcEntity():
            return replace(entity, centre=entity.centre + by)
        case Polygons():
            return replace(entity, corners=entity.corners + by)
        case Text():
            return replace(entity, at=entity.at + by)


def by_place(entity: Entity) -> Iterator[tuple[int | None, Entity]]:
    """The pieces of an entity, each with its place in the act, or None for a piece that belongs to all.

    >>> from graphcam.drafting.acts import Act, Kind
    >>> from graphcam.sheets.model import Source
    >>> chords = Source(Act(Kind.PARALLEL, "integration", "chords of v", {}, 3), np.array([0, 1, 2]))
    >>> curve = Stroke(np.array([0j, 1 + 2j, 2 + 3j]), "curve", False, chords)
    >>> [(at, chord.points.tolist()) for at, chord in by_place(curve)]
    [(1, [0j, (1+2j)]), (2, [(1+2j), (2+3j)])]
    """
    source = entity.source
    if source is None or (index := source.index) is None:
        yield None, entity
    elif isinstance(entity, Stroke | Curve):
        points = entity.points
        if isinstance(entity, Curve) or entity.closed:
            points, index = np.append(points, points[0]), np.append(index, index[0])
        # What leads to a corner belongs to its place: of a closed line also what leads back to the first.
        ends = [*(np.flatnonzero(np.diff(index[1:])) + 1), len(index) - 1]
        for start, end in pairwise([0, *ends]):
            yield int(index[end]), Stroke(points[start : end + 1], entity.role, False, entity.source)
    elif isinstance(entity, Strokes) and source.by_piece(len(entity.starts)):
        for k, at in enumerate(index.tolist()):
            yield at, replace(entity, starts=entity.starts[k : k + 1], ends=entity.ends[k : k + 1])
    elif isinstance(entity, Circles) and source.by_piece(len(entity.centres)):
        for k, at in enumerate(index.tolist()):
            yield at, replace(entity, centres=entity.centres[k : k + 1])
    else:
        one_place = len(index) > 0 and bool(np.all(index == index[0]))
        yield int(index[0]) if one_place else None, entity

"""The neutral drawing: pages of lines, circles, arcs and texts in millimetres of paper, before any file format.

Everything that has a meaning (dimensions, arrows, hatching, labels) has been turned into these few entities, so that
every output holds the same ones.  Points are complex numbers, x to the right and y up, from the lower left corner.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import groupby

from graphcam.drafting.marks import Origin, Places, Points
from graphcam.sheets.box import Box


@dataclass(frozen=True, eq=False)
class Source:
    """What an entity is a picture of: an act, and which of its places; of a polyline one for each corner."""

    of: Origin
    index: Places | None = None

    def by_piece(self, count: int) -> bool:
        """Whether it has a place for each of so many pieces."""
        return self.index is not None and len(self.index) == count

    def part(self, which: Places | list[int] | slice, count: int) -> Source:
        """The source of some of ``count`` pieces, by their numbers, where each has its place; else the same."""
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
    """What a dimension measures: from ``start`` to ``end``, its line through ``foot``; the ``lines`` that draw it."""

    start: complex
    end: complex
    foot: complex
    lines: tuple[Entity, ...]


@dataclass(frozen=True, eq=False)
class Angle:
    """An angle that is measured: between two directions [rad] at ``centre``, and the ``lines`` that draw it."""

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
    of : the dimension that it is the text of
    field : of the title block, that it is the entry of: a name such as "author"
    view : that it is the title of

    What an entity shows is its ``source``; a frame and a table have none.
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
        """Neighbours of one kind ("line", "filled", "opaque" or "text") and role, which one path can draw."""
        for (kind, role), run in groupby(self.entities, key=lambda entity: (kind_of(entity), entity.role)):
            yield kind, role, list(run)


def kind_of(entity: Entity) -> str:
    """How an entity is painted: "line", "filled", "opaque" or "text"."""
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
    origins : where the origins of its views lie, by the view's name
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
        """All its texts."""
        entities = (entity for page in self.pages for group in page.groups for entity in group.entities)
        return [entity for entity in entities if isinstance(entity, Text)]


def moved(entity: Entity, by: complex) -> Entity:
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

"""Pages to be photographed: places of tags, bars, patches and captions along the edges of each paper.

All of these stand in strips along the edges, and leave the middle free.  Nothing stands so near to the edge that common
printers cannot print it; the white about a tag is part of the strip.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.photo.tag_family import CELLS_PER_SIDE
from graphcam.sheets.model import Box, Drawing, Entity, Group, Page, Polygons, Strokes, moved_entity
from graphcam.sheets.sampling import box_of
from graphcam.sheets.styles import CODE_ROLE

PATCH_SIDE = 7.0
"""The side of a patch filled with the ink of the givens [mm]."""
BAR_ROOM = 5.5
"""The room of a bar beside a strip [mm]."""
STRIP_GAP = 1.0
"""The gap between a strip and the line of a bar [mm]."""
MAX_ROOM = 420.0
"""The maximum side of a room for a drawing about its centre [mm]: no compass draws a larger circle."""
TITLE_ROOM = 5.0
"""The room beside or above a view for its title [mm]."""
CODE_COLUMN_WIDTH = 24.0
"""The width of a column left of the views of the left tile, for its code [mm]."""


@dataclass(frozen=True)
class MarkedPaper:
    """A paper with its marks [mm].

    width, height : mm
    edge : between the edge of the paper and the tags
    side : of a tag's black square
    across : left edges of the tags along the bottom and the top
    up : lower edges of those along the sides, in between
    bar_across : start and length of the bar along the bottom
    bar_up : the same along the left side; ``up_in_strip`` where no room is to be lost beside the strip
    captions : places between the tags along the top, by number, for the exercise's name and the student's
    patch_gaps : places between the tags along the bottom, by number, in which patches stand
    seam : the x at which two tiles meet
    """

    width: float
    height: float
    edge: float
    side: float
    across: tuple[float, ...]
    up: tuple[float, ...]
    bar_across: tuple[float, float]
    bar_up: tuple[float, float]
    captions: tuple[tuple[int, int], ...]
    patch_gaps: tuple[int, ...]
    up_in_strip: bool = False
    seam: float | None = None

    @property
    def quiet_zone(self) -> float:
        """The width of the white about a tag [mm]: that of a cell."""
        return self.side / CELLS_PER_SIDE

    @property
    def strip(self) -> float:
        """The width of the strips along the edges [mm]."""
        return self.edge + self.side + self.quiet_zone

    @property
    def is_upright(self) -> bool:
        """Whether it is in portrait format."""
        return self.height > self.width

    @property
    def box(self) -> Box:
        """The box of the paper."""
        return Box(0.0, 0.0, self.width, self.height)

    @cached_property
    def free_box(self) -> Box:
        """The box that the marks leave free."""
        beside = 0.0 if self.up_in_strip else BAR_ROOM
        left = self.strip + beside + (CODE_COLUMN_WIDTH if self.seam else 0.0)
        return Box(left, self.strip + BAR_ROOM, self.width - self.strip, self.height - self.strip)

    @property
    def square(self) -> float:
        """The side of the square room for a drawing about its centre, with room for a title above it [mm]."""
        return min(self.free_box.width, self.free_box.height - TITLE_ROOM, MAX_ROOM)

    @cached_property
    def tags(self) -> dict[int, complex]:
        """The lower left corner of each tag's black square, by its number: row by row from below."""
        right, top = self.width - self.edge - self.side, self.height - self.edge - self.side
        bottom_row = [complex(x, self.edge) for x in self.across]
        sides = [complex(x, y) for y in self.up for x in (self.edge, right)]
        return dict(enumerate([*bottom_row, *sides, *(complex(x, top) for x in self.across)]))

    @property
    def bars(self) -> tuple[tuple[complex, complex], tuple[complex, complex]]:
        """Start and end of the bars, across and up."""
        (x, wide), (y, high) = self.bar_across, self.bar_up
        low = self.strip + STRIP_GAP
        left = self.edge + self.side / 2 if self.up_in_strip else low
        return (complex(x, low), complex(x + wide, low)), (complex(left, y), complex(left, y + high))

    def gaps_below(self) -> list[Box]:
        """The boxes between the tags along the bottom."""
        return [Box(low, self.edge, high, self.edge + self.side) for low, high in self._intervals(self.across)]

    def gaps_above(self) -> list[Box]:
        """The boxes between the tags along the top."""
        top = self.height - self.edge
        return [Box(low, top - self.side, high, top) for low, high in self._intervals(self.across)]

    def gaps_beside(self, left: float) -> list[Box]:
        """The boxes between the tags along a side whose tags have that ``left`` edge, from below."""
        ends = self.edge, *self.up, self.height - self.edge - self.side
        return [Box(left, low, left + self.side, high) for low, high in self._intervals(ends)]

    def _intervals(self, starts: Sequence[float]) -> list[tuple[float, float]]:
        return [(low + self.side + self.quiet_zone, high - self.quiet_zone) for low, high in pairwise(starts)]

    @property
    def patches(self) -> tuple[complex, ...]:
        """The lower left corners of the patches: along the bottom, and on the right above."""
        below = [self.gaps_below()[k] for k in self.patch_gaps]
        beside = self.gaps_beside(self.width - self.edge - self.side)[-1]
        half = PATCH_SIDE * (1 + 1j) / 2
        return tuple((box.corner + complex(box.right, box.top)) / 2 - half for box in (*below, beside))

    @property
    def bar_captions(self) -> tuple[Box, Box]:
        """The boxes for the captions of the bars: under the one across, and beside the one up."""
        beside = self.gaps_beside(self.edge)
        return self.gaps_below()[0], beside[1] if self.up_in_strip else beside[0]


def _evenly(length: float, edge: float, side: float, count: int) -> tuple[float, ...]:
    """Starts of so many tags along an edge, the first and the last in the corners."""
    last = length - edge - side
    return tuple(edge + k * (last - edge) / (count - 1) for k in range(count))


def _tiles(width: float, edge: float, side: float) -> tuple[float, ...]:
    """Starts of three tags along the edge of either tile."""
    left = _evenly(width / 2, edge, side, 3)
    return (*left, *(width / 2 + x for x in left))


_EDGE, _SIDE = 8.0, 12.0
_A3 = 420.0, 297.0
MARKED_PAPERS = {
    "A1": MarkedPaper(
        *(841.0, 594.0, _EDGE, _SIDE, _evenly(841.0, _EDGE, _SIDE, 5), _evenly(594.0, _EDGE, _SIDE, 3)[1:-1]),
        *((100.0, 250.0), (200.0, 180.0), ((0, 3),), (3,)),
    ),
    "A3": MarkedPaper(
        *(*_A3, _EDGE, _SIDE, _evenly(420.0, _EDGE, _SIDE, 3), _evenly(297.0, _EDGE, _SIDE, 3)[1:-1]),
        *((85.0, 250.0), (58.0, 180.0), ((0, 1),), (1,)),
    ),
    "A3-tiles": MarkedPaper(
        *(*_A3, _EDGE, _SIDE, _tiles(420.0, _EDGE, _SIDE), _evenly(297.0, _EDGE, _SIDE, 3)[1:-1]),
        *((29.0, 160.0), (58.0, 180.0), ((0, 1), (3, 4)), (1, 3)),
        seam=210.0,
    ),
    # Tags that are smaller and nearer to the edge leave as much width as the scale of the sheet was chosen for.
    "A4": MarkedPaper(
        *(210.0, 297.0, 6.0, 9.0, _evenly(210.0, 6.0, 9.0, 3), _evenly(297.0, 6.0, 9.0, 3)[1:-1]),
        *((20.0, 170.0), (19.0, 120.0), ((0, 1),), (1,)),
        up_in_strip=True,
    ),
}
"""The papers by name."""


BAR_STROKE_SPACING = 10.0
"""The distance between strokes of a bar [mm]."""
BAR_STROKE_LENGTH, BAR_END_LENGTH = 1.5, 3.0
"""The lengths of the strokes of a bar, and of those at its ends [mm]."""


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
    return Polygons(corner + cell * np.array(boxes), CODE_ROLE)


def square(corner: complex, side: float, role: str) -> Polygons:
    """A filled square."""
    return Polygons(corner + side * np.array([[0, 1, 1 + 1j, 1j]]), role)


def bar(start: complex, end: complex) -> list[Entity]:
    """A ruled bar of a multiple of 10 mm, its strokes to the left of the way from ``start`` to ``end``."""
    way = (end - start) / abs(end - start)
    at = start + way * np.arange(0.0, abs(end - start) + BAR_STROKE_SPACING / 2, BAR_STROKE_SPACING)
    long = np.full(len(at), BAR_STROKE_LENGTH)
    long[[0, -1]] = BAR_END_LENGTH
    return [Strokes(np.array([start]), np.array([end]), "gauge"), Strokes(at, at + 1j * way * long, "ruling")]


LINE_REACH = 0.5
"""The maximum reach of a line beyond its middle [mm]."""


def in_tiles(drawing: Drawing, seam: float) -> Drawing:
    """The drawing with two pages for each, left and right of the seam, with the entities that reach into each."""
    pages: list[Page] = []
    for page in drawing.pages:
        for left, right in ((0.0, seam), (seam, page.width)):
            pages.append(_tile(page, Box(left, 0.0, right, page.height)))
    return Drawing(drawing.title, tuple(pages))


def _tile(page: Page, part: Box) -> Page:
    def seen(entity: Entity) -> bool:
        """Whether any of an entity lies on the part."""
        box = box_of([entity])
        return box is not None and box.grown(LINE_REACH).meets(part)

    groups = [
        Group(group.name, tuple(moved_entity(entity, -part.corner) for entity in group.entities if seen(entity)))
        for group in page.groups
    ]
    frame = Box(0.0, 0.0, part.width, part.height).grown(-page.frame.left)
    origins = {name: origin - part.corner for name, origin in page.origins.items()}
    return Page(part.width, part.height, frame, tuple(groups), origins)

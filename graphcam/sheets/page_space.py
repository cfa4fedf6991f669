"""Pages during filling: their free room, and the empty parts of diagrams, where tables may stand."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from itertools import product

import numpy as np

from graphcam.sheets.formats import Format
from graphcam.sheets.model import Box, bounding_box
from graphcam.sheets.packing import MESH, FreeMoves, Preference, Room, middle, prefer_high
from graphcam.sheets.sampling import Floats
from graphcam.sheets.sheet_frame import taken_boxes
from graphcam.sheets.tables import Block
from graphcam.sheets.view_panels import LABEL_MARGIN, Panel, are_disjoint, clusters, panel_origins

FRAME_MARGIN = 4.0
"""The free margin along the frame [mm]; the air about a view is a part of it."""
BOX_MARGIN = FRAME_MARGIN - LABEL_MARGIN
"""The free margin along the frame of boxes with air of their own [mm]."""

MAX_EMPTY_SHARE = 0.12
"""The maximum empty rectangle that is left as it is, as a part of the frame."""
MAX_SPREAD = 5
"""More views and tables than this stand close enough."""
SPREAD_ROUNDS, SPREAD_PARTS, SPREAD_GAIN = 2, (0.5, 0.25, 0.75), 5e-3
"""How often all that stands on a page is moved apart, to which parts of its free way, and the gain that is worth it."""


KnownMoves = dict[Hashable, FreeMoves | None]
"""Where views have room beside others, by both."""


@cache
def free_rooms(sheet: Format) -> tuple[tuple[float, float], ...]:
    """Widths and heights [mm] of the largest boxes of views, with their air, on an empty page, the widest first.

    The boxes are those of views, with their air.

    >>> free_rooms(Format("A3", "gost"))
    ((393.0, 216.0), (323.0, 230.0), (208.0, 258.0), (138.0, 272.0), (96.0, 285.0))
    """
    inside, taken = sheet.content.grown(-BOX_MARGIN), taken_boxes(sheet, BOX_MARGIN)
    rooms = list(zip(*(sides.tolist() for sides in _rooms_between(inside, taken)), strict=True))
    larger = [any(w >= wide and h >= high and (w, h) != (wide, high) for w, h in rooms) for wide, high in rooms]
    return tuple(sorted({room for room, other in zip(rooms, larger, strict=True) if not other}, reverse=True))


def _rooms_between(inside: Box, taken: Sequence[Box]) -> tuple[Floats, Floats]:
    """Widths and heights (k,) [mm] of the highest free boxes between the sides of boxes, of one at least."""
    bottom, top, left, right = np.array(sorted((box.bottom, box.top, box.left, box.right) for box in taken)).T
    starts, ends = np.meshgrid(np.append(right, inside.left), np.append(left, inside.right))
    starts, ends = starts[starts < ends], ends[starts < ends]
    # From below upwards: up to where each strip is taken by the boxes across it.
    across = (left < ends[:, None]) & (starts[:, None] < right)
    levels = np.maximum.accumulate(np.where(across, top, inside.bottom), axis=1)
    below = np.hstack([np.full((starts.size, 1), inside.bottom), levels[:, :-1]])
    gaps = np.where(across, bottom - below, 0.0).max(axis=1)
    return ends - starts, np.maximum(gaps, inside.top - levels[:, -1])


@cache
def _fields(sheet: Format) -> tuple[Box, ...]:
    """The boxes of a sheet's own fields."""
    return tuple(taken_boxes(sheet, 0.0))


@dataclass(frozen=True, eq=False)
class ViewRun:
    """Views that stand together on a page, at their origins.

    gap : between them, mm; half of it is kept free about them where it is more than their air
    closely : whether others may stand within their boxes, in corners beyond their outlines
    """

    views: Sequence[Panel]
    origins: Sequence[complex]
    gap: float = 0.0
    closely: bool = False

    @cached_property
    def boxes(self) -> list[Box]:
        """The boxes that cover the views with their titles: one for each, or many that follow its outline."""
        standing = list(zip(self.views, self.origins, strict=True))
        if self.closely:
            return [box.moved(origin) for panel, origin in standing for box in panel.outline]
        return [panel.box.moved(origin) for panel, origin in standing]


@dataclass(eq=False)
class EmptyPart:
    """The empty parts of a diagram, which are found only when a table is to stand in them.

    seen : the number of boxes on the page that it knows, at first those placed before it
    """

    panel: Panel
    origin: complex
    seen: int
    found: Room | None = None

    def find(self, box: Box, taken: Sequence[Box]) -> complex | None:
        """The move of a box into what the boxes on the page leave of the part; None if there is no room."""
        if self.panel.hollow.find([box], prefer_high) is None:
            return None
        if self.found is None:
            self.found = self.panel.hollow.copy(self.origin)
        for other in taken[self.seen :]:
            self.found.take(other)
        self.seen = len(taken)
        return self.found.find([box], prefer_high)


@dataclass(eq=False)
class OpenPage:
    """A page during filling.

    taken : the boxes of all that stands on it, with the air about it
    """

    sheet: Format
    room: Room
    parts: list[EmptyPart] = field(default_factory=list[EmptyPart])
    taken: list[Box] = field(default_factory=list[Box])
    views: dict[str, tuple[Panel, complex]] = field(default_factory=dict[str, tuple[Panel, complex]])
    blocks: list[tuple[Block, complex]] = field(default_factory=list[tuple[Block, complex]])

    def copy(self) -> OpenPage:
        """A copy of the page that can be filled differently."""
        parts = [replace(part, found=part.found and part.found.copy()) for part in self.parts]
        return OpenPage(self.sheet, self.room.copy(), parts, list(self.taken), dict(self.views), list(self.blocks))

    def put_views(self, run: ViewRun, by: complex) -> None:
        """Put views that stand together, moved ``by`` x + iy."""
        for box in run.boxes:
            self._take(box.moved(by), max(run.gap, 0.0) / 2)
        for panel, origin in zip(run.views, run.origins, strict=True):
            self.views[panel.view.name] = panel, origin + by
            if len(run.views) > 1:
                self.parts.append(EmptyPart(panel, origin + by, len(self.taken)))

    def put_block(self, block: Block, by: complex) -> None:
        """Put a table or notes."""
        self._take(block.box.moved(by).grown(LABEL_MARGIN))
        self.blocks.append((block, by))

    def _take(self, box: Box, margin: float = 0.0) -> None:
        self.taken.append(box)
        self.room.take(box.grown(margin))

    def find(self, boxes: Sequence[Box], preference: Preference) -> complex | None:
        """The move of boxes which stand together into free room; None if there is none."""
        to_grid, boxes = self._on_grid(boxes)
        by = self.room.find(boxes, preference)
        return None if by is None else by + to_grid

    def find_run(self, run: ViewRun, preference: Preference, known: KnownMoves) -> complex | None:
        """The move of views which stand together into free room; None if there is none.

        known : where they have room beside what stands on the page, whatever is preferred: that is asked for often
        """
        to_grid, boxes = self._on_grid(run.boxes)
        standing = tuple((id(panel), origin) for panel, origin in self.views.values())
        key = standing, tuple(map(id, run.views)), run.closely, run.gap
        if key not in known:
            known[key] = self.room.moves(boxes)
        found = known[key]
        return None if found is None else found.best(preference) + to_grid

    def _on_grid(self, boxes: Sequence[Box]) -> tuple[complex, list[Box]]:
        """A move, and the boxes moved: with their corner on the grid of the room they touch the fewest of its cells."""
        to_grid = self.room.corner - bounding_box(boxes).corner
        return to_grid, [box.moved(to_grid) for box in boxes]

    def find_for(self, block: Block, preference: Preference) -> complex | None:
        """The move of a table into an empty part of a diagram or beside the views; None without room."""
        box = block.box.grown(LABEL_MARGIN)
        for part in self.parts:
            if (by := part.find(box, self.taken)) is not None:
                return by
        return self.find([box], preference)

    @property
    def used(self) -> float:
        """The share of the frame's inside that views, tables and the sheet's own fields cover."""
        views = [panel.box.moved(origin) for panel, origin in self.views.values()]
        blocks = [block.box.moved(at) for block, at in self.blocks]
        area = kept_area(self.sheet) + sum(box.area for box in (*views, *blocks))
        # Tables may stand in the empty parts of diagrams.
        area -= sum(view.common(block) for view in views for block in blocks)
        return area / self.sheet.content.area

    @property
    def empty_share(self) -> float:
        """The share of the frame's inside that the largest rectangle without views, tables and fields takes."""
        views = [panel.box.moved(origin) for panel, origin in self.views.values()]
        blocks = [block.box.moved(at) for block, at in self.blocks]
        wide, high = _rooms_between(self.sheet.content, [*views, *blocks, *_fields(self.sheet)])
        return float((wide * high).max()) / self.sheet.content.area

    def centred(self) -> OpenPage:
        """The page with all that stands on it moved together, so that what is left empty lies around it."""
        by = blank_page(self.sheet).find(self.taken, middle) if self.taken else 0j
        if not by:
            return self
        views = {name: (panel, origin + by) for name, (panel, origin) in self.views.items()}
        blocks = [(block, at + by) for block, at in self.blocks]
        return OpenPage(self.sheet, self.room, [], [box.moved(by) for box in self.taken], views, blocks)

    @property
    def final_empty_share(self) -> float:
        """The share of the frame's inside that the largest empty rectangle takes in the end; small ones as they are."""
        share = self.empty_share
        return share if share <= MAX_EMPTY_SHARE else self.spread().empty_share

    def spread(self) -> OpenPage:
        """The page with all that stands on it in the middle, and moved apart where that leaves less room empty."""
        page, fixed = self.centred(), taken_boxes(self.sheet, BOX_MARGIN)
        share = page.empty_share
        if len(self.views) + len(self.blocks) > MAX_SPREAD or share <= MAX_EMPTY_SHARE:
            return page
        inside = self.sheet.content.grown(-BOX_MARGIN)
        for _, group in product(range(SPREAD_ROUNDS), range(len(self._groups()))):
            groups = page._groups()
            own = groups[group].boxes
            others = [*fixed, *(box for each in groups if each is not groups[group] for box in each.boxes)]
            if any(a.meets(b) for a in own for b in others):
                continue
            for way in (1j, 1.0 + 0j):
                low, high = _free_way(own, others, inside, way)
                shifts = (way * (low + part * (high - low)) for part in SPREAD_PARTS)
                tried = [page.moved(groups[group], by) for by in shifts if abs(by) > MESH]
                left = [each.empty_share for each in tried]
                if tried and min(left) < share - SPREAD_GAIN:
                    share = min(left)
                    page = tried[left.index(share)]
                    break
            if share <= MAX_EMPTY_SHARE:
                break
        return page

    def _groups(self) -> list[StandingGroup]:
        """What stands together on the page: views that share axes, and the tables in their empty parts."""
        found = [
            StandingGroup([panel.view.name for panel in cluster], [])
            for cluster in clusters([panel for panel, _ in self.views.values()])
        ]
        for group in found:
            group.boxes.extend(panel.box.moved(origin) for panel, origin in map(self.views.__getitem__, group.views))
        for k, (block, at) in enumerate(self.blocks):
            box = block.box.moved(at)
            of = next((group for group in found if any(each.meets(box) for each in group.boxes)), None)
            if of is None:
                found.append(of := StandingGroup([], []))
                of.boxes.append(box.grown(LABEL_MARGIN))
            of.blocks.append(k)
        return found

    def moved(self, group: StandingGroup, by: complex) -> OpenPage:
        """The page with a group moved."""
        views = {
            name: (panel, origin + by if name in group.views else origin)
            for name, (panel, origin) in self.views.items()
        }
        blocks = [(block, at + by if k in group.blocks else at) for k, (block, at) in enumerate(self.blocks)]
        return OpenPage(self.sheet, self.room, [], self.taken, views, blocks)


@dataclass(frozen=True, eq=False)
class StandingGroup:
    """What moves together on a page: the names of views, the numbers of tables, and their boxes."""

    views: list[str]
    blocks: list[int]
    boxes: list[Box] = field(default_factory=list[Box])


def _free_way(own: Sequence[Box], others: Sequence[Box], inside: Box, way: complex) -> tuple[float, float]:
    """How far boxes may move back and forth along an axis, ``way`` 1 or 1j, before they meet others [mm]."""
    upright = bool(way.imag)

    def span(box: Box, *, along: bool) -> tuple[float, float]:
        """Where a box begins and ends along the axis, or across it."""
        return (box.bottom, box.top) if along == upright else (box.left, box.right)

    spans, (start, end) = [span(box, along=True) for box in own], span(inside, along=True)
    low, high = start - min(a for a, _ in spans), end - max(b for _, b in spans)
    for box, other in product(own, others):
        (a, b), (c, d) = span(box, along=False), span(other, along=False)
        if a < d and c < b:
            (a, b), (c, d) = span(box, along=True), span(other, along=True)
            low, high = (max(low, d - a), high) if d <= a else (low, min(high, c - b))
    return min(low, 0.0), max(high, 0.0)


def blank_page(sheet: Format) -> OpenPage:
    """An empty page."""
    return OpenPage(sheet, _blank_room(sheet).copy())


@cache
def _blank_room(sheet: Format) -> Room:
    """The room of an empty sheet; it is looked into, and copied to be taken."""
    return Room(sheet.content.grown(-BOX_MARGIN), taken_boxes(sheet, BOX_MARGIN))


@cache
def kept_area(sheet: Format) -> float:
    """The area of the boxes inside the frame that every sheet needs [mm²]."""
    return sum(box.area for box in _fields(sheet))


def fits_on_sheet(sheet: Format, views: Sequence[Panel], gap: float) -> bool:
    """Whether views with a gap between them have room on an empty sheet."""
    boxes = ViewRun(views, panel_origins(views, gap)).boxes
    # The air of neighbours may overlap where there is little.
    return (
        are_disjoint([box.grown(min(gap, 0.0)) for box in boxes])
        and blank_page(sheet).find(boxes, prefer_high) is not None
    )

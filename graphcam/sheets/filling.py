"""Filling pages: which views and tables stand on which page, and where."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from itertools import chain, count, product

from graphcam.drafting.scale import STANDARD_RATIOS
from graphcam.sheets.box import Box, around_all
from graphcam.sheets.formats import Format
from graphcam.sheets.frame import taken
from graphcam.sheets.packing import (
    Preference,
    Room,
    bottom_left,
    bottom_right,
    high,
    left,
    middle,
    top,
    top_left,
    top_right,
)
from graphcam.sheets.panels import Panel, apart, clusters, shares, stand
from graphcam.sheets.tables import Block

BORDER = 4.0
"""Free margin along the frame, mm."""
BETWEEN = 6.0
"""Between things that do not belong together, mm."""
GAPS = (24.0, 12.0, 6.0, 2.0, -2.0)
"""Between diagrams that stand together, mm: the widest is taken that needs no further page."""
WITHIN = (0, 1, 3)
"""How many small views may stand in the empty parts of diagrams where that saves a page."""
ONE_PAGE = ("A1",)
"""Formats on which diagrams one under the other are never parted, and those side by side only to keep full size."""


@dataclass(frozen=True, eq=False)
class Run:
    """Views that stand together on a page, at their origins."""

    views: Sequence[Panel]
    origins: Sequence[complex]

    @cached_property
    def footprint(self) -> list[Box]:
        """The boxes that together cover the views."""
        standing = zip(self.views, self.origins, strict=True)
        return [box.moved(origin) for panel, origin in standing for box in panel.footprint]


@dataclass(eq=False)
class EmptyPart:
    """The empty parts of a diagram, which are found when something is to stand in them.

    seen : how many of the boxes on the page it knows, at first those that were there before it
    """

    panel: Panel
    origin: complex
    seen: int
    found: Room | None = None

    def room(self, taken: Sequence[Box]) -> Room:
        """What the boxes on the page leave of it."""
        if self.found is None:
            self.found = self.panel.empty(self.origin)
        for box in taken[self.seen :]:
            self.found.take(box)
        self.seen = len(taken)
        return self.found


@dataclass(eq=False)
class Leaf:
    """A page while it is being filled: its free room, and the empty parts of diagrams, where tables may stand."""

    room: Room
    parts: list[EmptyPart] = field(default_factory=list[EmptyPart])
    taken: list[Box] = field(default_factory=list[Box])
    views: dict[str, tuple[Panel, complex]] = field(default_factory=dict[str, tuple[Panel, complex]])
    blocks: list[tuple[Block, complex]] = field(default_factory=list[tuple[Block, complex]])

    def copy(self) -> Leaf:
        """The same page, to be filled in another way."""
        parts = [replace(part, found=part.room(self.taken).copy()) for part in self.parts]
        return Leaf(self.room.copy(), parts, list(self.taken), dict(self.views), list(self.blocks))

    def put_views(self, run: Run, by: complex) -> None:
        """Put views that stand together, moved ``by`` x + iy."""
        for box in run.footprint:
            self.take(box.moved(by))
        for panel, origin in zip(run.views, run.origins, strict=True):
            self.views[panel.view.name] = panel, origin + by
            if len(run.views) > 1:
                self.parts.append(EmptyPart(panel, origin + by, len(self.taken)))

    def put_block(self, block: Block, by: complex) -> None:
        """Put a table or notes."""
        self.take(block.box.moved(by))
        self.blocks.append((block, by))

    def shares(self, views: Iterable[Panel]) -> bool:
        """Whether one of the views shares an axis with one on the page."""
        return any(shares(view, (panel for panel, _ in self.views.values())) for view in views)

    def inside(self, boxes: Sequence[Box]) -> complex | None:
        """By how much to move boxes into an empty part of a diagram; None if there is none."""
        found = (part.room(self.taken).find(boxes, high) for part in self.parts)
        return next((by for by in found if by is not None), None)

    def take(self, box: Box) -> None:
        """Take a box and a margin about it."""
        self.taken.append(box.grown(BETWEEN))
        self.room.take(self.taken[-1])

    @property
    def empty(self) -> float:
        """The free part of the page."""
        return 1.0 - float(self.room.full.mean())


@dataclass(frozen=True)
class Way:
    """One way to fill pages.

    gaps : between the views of each run [mm]
    pages : so many pages are filled evenly; of 0 the first is filled before the next is begun
    within : how many small views stand in the empty parts of diagrams, as tables do; a lone view stands in the middle,
        unless it is more than 0
    """

    gaps: tuple[float, ...]
    pages: int = 0
    within: int = 0


def fill(sheet: Format, views: Sequence[Panel], ways_of_blocks: Sequence[Sequence[Block]]) -> list[Leaf]:
    """Put all views and blocks on as few pages as they need, in the middle of what is free of each.

    ways_of_blocks : the same tables and notes in letters of different heights and in different orders, the best first
    """
    return [_centred(sheet, leaf) for leaf in _fewest(sheet, views, ways_of_blocks)]


def _centred(sheet: Format, leaf: Leaf) -> Leaf:
    """The page with all that stands on it moved together, so that what is left empty lies around it."""
    views = [Run([panel], [origin]) for panel, origin in leaf.views.values()]
    boxes = [box for view in views for box in view.footprint] + [block.box.moved(at) for block, at in leaf.blocks]
    centred = _blank(sheet)
    by = centred.room.find(boxes, middle) if boxes else None
    if by is None:
        return leaf
    for view in views:
        centred.put_views(view, by)
    for block, at in leaf.blocks:
        centred.put_block(block, at + by)
    return centred


def _fewest(sheet: Format, views: Sequence[Panel], ways_of_blocks: Sequence[Sequence[Block]]) -> list[Leaf]:
    """All views and blocks on as few pages as they need, the emptiest of them as full as it can be."""
    # The largest first; the small ones find room between.
    groups = sorted(clusters(views), key=lambda group: -sum(map(_area, group)))
    runs = [run for group in groups for run in _runs(sheet, group)]
    spreads = _spreads(sheet, runs)

    @cache
    def standing(k: int, gap: float) -> Run:
        return Run(runs[k], stand(runs[k], gap))

    @cache
    def viewed(way: Way, most: float) -> list[Leaf] | None:
        return _with_views(sheet, [standing(k, gap) for k, gap in enumerate(way.gaps)], way, most)

    def tried(blocks: Sequence[Block], way: Way, most: float) -> list[Leaf] | None:
        leaves = viewed(way, most)
        return None if leaves is None else _with_blocks(sheet, leaves, blocks, way, most)

    best: list[Leaf] = []
    for within, blocks, gaps in product(WITHIN, ways_of_blocks, spreads):
        best = tried(blocks, Way(gaps, 0, within), len(best) - 1 if best else math.inf) or best
        if len(best) == 1:
            return best
    for blocks, gaps in product(ways_of_blocks, spreads):
        leaves = tried(blocks, Way(gaps, len(best)), len(best))
        if leaves and _emptiest(leaves) < _emptiest(best) - 1e-9:
            best = leaves
    return best


def _spreads(sheet: Format, runs: Sequence[Sequence[Panel]]) -> list[tuple[float, ...]]:
    """The gaps of all runs, from wide to narrow; a run without room for a gap has the widest that it has room for."""
    fitting = [[gap for gap in GAPS if _fits(sheet, run, gap)] for run in runs]
    # Tries that come to the same are made once.
    return list(dict.fromkeys(tuple(next(g for g in fits if g <= gap) for fits in fitting) for gap in GAPS))


def _area(panel: Panel) -> float:
    return panel.box.width * panel.box.height


def _emptiest(leaves: Sequence[Leaf]) -> float:
    return max(leaf.empty for leaf in leaves)


def _with_views(sheet: Format, runs: Sequence[Run], way: Way, most: float) -> list[Leaf] | None:
    """Put runs of views on as many pages as it takes; None if these are more than ``most``."""
    leaves = [_blank(sheet) for _ in range(way.pages)]
    largest = max((run.views[0] for run in runs if len(run.views) == 1), key=_area, default=None)
    within = way.within
    for run in runs:
        views = run.views
        # Views that share an axis stand on it or on different pages; what was parted on a large page finds room there.
        allowed = [leaf for leaf in leaves if sheet.name in ONE_PAGE or not leaf.shares(views)]
        found = _inside(allowed, run.footprint) if within and len(views) == 1 and views[0] is not largest else None
        if found:
            within -= 1
        else:
            # Aside it leaves more room for tables.
            lone = len(runs) == 1 and not way.within
            preference = middle if lone else _preferred(sheet, views, largest)
            found = _find(sheet, _views_turn(sheet, allowed, way), run.footprint, preference, more=len(leaves) < most)
        if found is None:
            return None
        _taken(leaves, found[0]).put_views(run, found[1])
    return leaves


def _with_blocks(
    sheet: Format, viewed: Sequence[Leaf], blocks: Sequence[Block], way: Way, most: float
) -> list[Leaf] | None:
    """Put blocks on the same pages, and on further ones if it takes them; None if these are more than ``most``."""
    leaves = [leaf.copy() for leaf in viewed]
    for block in blocks:
        found = _place_block(sheet, _in_turn(leaves, way), block, way, more=len(leaves) < most)
        if found is None:
            return None
        _taken(leaves, found[0]).put_block(block, found[1])
    return [leaf for leaf in leaves if leaf.views or leaf.blocks] or [_blank(sheet)]


def _views_turn(sheet: Format, leaves: Sequence[Leaf], way: Way) -> Sequence[Leaf]:
    """The same for views: the first sheet of a large format is the cam's, only tables go where there is more room."""
    return leaves if sheet.name in ONE_PAGE else _in_turn(leaves, way)


def _taken(leaves: list[Leaf], leaf: Leaf) -> Leaf:
    """A page, which is now one of the pages."""
    if leaf not in leaves:
        leaves.append(leaf)
    return leaf


def _in_turn(leaves: Sequence[Leaf], way: Way) -> list[Leaf]:
    """The pages in the order in which they are tried."""
    return sorted(leaves, key=lambda leaf: -leaf.empty) if way.pages else list(leaves)


def _place_block(
    sheet: Format, leaves: Sequence[Leaf], block: Block, way: Way, *, more: bool
) -> tuple[Leaf, complex] | None:
    # Where pages are filled evenly, the emptiest is taken before an empty part of another.
    for some in ([leaf] for leaf in leaves) if way.pages else (leaves,):
        if found := _inside(some, [block.box]):
            return found
        if way.pages and (by := some[0].room.find([block.box], bottom_right)) is not None:
            return some[0], by
    return _find(sheet, leaves, [block.box], bottom_right, more=more)


def _inside(leaves: Sequence[Leaf], boxes: Sequence[Box]) -> tuple[Leaf, complex] | None:
    """The first page with an empty part of a diagram for boxes which stand together, and by how much to move them."""
    found = ((leaf, leaf.inside(boxes)) for leaf in leaves)
    return next(((leaf, by) for leaf, by in found if by is not None), None)


def _find(
    sheet: Format, leaves: Sequence[Leaf], boxes: Sequence[Box], preference: Preference, *, more: bool
) -> tuple[Leaf, complex] | None:
    """The first page that has room for boxes which stand together, and by how much to move them.

    more : whether a new page may be begun; None where it may not and there is no room
    """
    for leaf in leaves:
        if (by := leaf.room.find(boxes, preference)) is not None:
            return leaf, by
    if not more:
        return None
    blank = _blank(sheet)
    by = blank.room.find(boxes, preference)
    # What is larger than a page has been reduced before.
    assert by is not None
    return blank, by


def _blank(sheet: Format) -> Leaf:
    return Leaf(_blank_room(sheet).copy())


@cache
def _blank_room(sheet: Format) -> Room:
    """The room of an empty sheet; it is looked into, and copied to be taken."""
    return Room(sheet.content.grown(-BORDER), taken(sheet, BORDER))


def _preferred(sheet: Format, run: Sequence[Panel], largest: Panel | None) -> Preference:
    """Where views would rather stand: diagrams at the upper left, the largest drawing where it leaves most room."""
    if len(run) > 1:
        return top_left
    if run[0] is not largest:
        return bottom_right
    if sheet.name in ONE_PAGE:
        return bottom_left if sheet.upright else top_right
    return top if sheet.upright else left


# --- what stands together --------------------------------------------------------------------------------------------


def _runs(sheet: Format, group: Sequence[Panel]) -> list[list[Panel]]:
    """The views of each page: with others that they share an axis with, if these fit together, and little reduced."""
    # Beyond the standard series: powers of ten go on for ever.
    for factor in chain((ratio for ratio in STANDARD_RATIOS if ratio <= 1), (10.0**-k for k in count(3))):
        reduced = [replace(panel, factor=factor) for panel in group]
        ways = [[reduced], _columns(reduced)] if sheet.name in ONE_PAGE else [_joined(sheet, reduced)]
        for runs in ways:
            if all(_fits(sheet, run, GAPS[-1]) for run in runs):
                return runs
    raise AssertionError("the reductions never end")


def _columns(group: Sequence[Panel]) -> list[list[Panel]]:
    """The views that stand one under the other, together."""
    columns: dict[str, list[Panel]] = {}
    for panel in group:
        columns.setdefault(panel.view.across, []).append(panel)
    return list(columns.values())


def _joined(sheet: Format, group: Sequence[Panel]) -> list[list[Panel]]:
    """As many views together as fit a page, each with one that it shares an axis with."""
    runs: list[list[Panel]] = []
    for panel in group:
        # The last run first, so that neighbours stay neighbours.
        joined = (run for run in reversed(runs) if shares(panel, run))
        if (run := next((run for run in joined if _fits(sheet, [*run, panel], GAPS[-1])), None)) is not None:
            run.append(panel)
        else:
            runs.append([panel])
    return runs


def _fits(sheet: Format, views: Sequence[Panel], gap: float) -> bool:
    run = Run(views, stand(views, gap))
    # The margins of neighbours may overlap where room is scarce.
    boxes = [panel.box.moved(origin).grown(min(gap, 0.0)) for panel, origin in zip(views, run.origins, strict=True)]
    if not apart(boxes):
        return False
    # Where there is room for a box about the views there is room for them.
    room, footprint = _blank_room(sheet), run.footprint
    return any(room.find(tried, top_left) is not None for tried in ([around_all(footprint)], footprint))

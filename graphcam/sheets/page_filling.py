"""Pages filled with views and tables: which of them stand together, on which page, and where.

Many ways are tried, and the best is taken: on few pages, all but the last well used, in the order of the work.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations, product

from graphcam.errors import DesignError
from graphcam.sheets.formats import Format
from graphcam.sheets.packing import (
    Preference,
    at_left,
    middle,
    prefer_bottom_left,
    prefer_bottom_right,
    prefer_high,
    prefer_top,
    prefer_top_left,
    prefer_top_right,
)
from graphcam.sheets.page_space import OpenPage, ViewRun, blank_page, fits_on_sheet, free_rooms, kept_area
from graphcam.sheets.tables import Block
from graphcam.sheets.view_panels import Panel, clusters, panel_origins, shares, with_lowest
from graphcam.words import say

MIN_FILLED_SHARE = 0.57
"""The minimum filled share of every page but the last, and if possible of the last."""
PAIRS_PER_PAGE = 12
"""The number of pairs of views out of the order of the work that weighs as much as one more page."""
MAX_CHOICES = 8
"""The maximum number of ways to part views that share axes that are tried together."""


DIAGRAM_GAPS = (24.0, 12.0, 6.0, 2.0, -2.0)
"""The gaps between diagrams that stand together [mm]; the widest that needs no further page is taken."""
ONE_PAGE = ("A1",)
"""Formats on which diagrams that share an axis are parted only where a page cannot take them."""
MAX_PARTINGS = 4
"""The maximum number of ways to part views that share axes that are tried."""

Runs = list[list[Panel]]
"""Groups of views, each of which stands together."""


class TooLargeError(DesignError):
    """A view does not fit on a page of its own."""


def partings(sheet: Format, group: Sequence[Panel]) -> list[Runs]:
    """The ways to part views that share axes into groups that each fit a page, those with few groups first.

    Raises
    ------
    TooLargeError : a view does not fit on a page of its own at its scale
    """
    for panel in group:
        if not fits_on_sheet(sheet, [panel], DIAGRAM_GAPS[-1]):
            raise _too_large(sheet, panel)
    return (_columns_kept(sheet, group) if sheet.name in ONE_PAGE else []) or _partings(sheet, group)


def with_lower_views(sheet: Format, run: Sequence[Panel]) -> list[Panel]:
    """The views, with what belongs under the lowest of a column, where a page has room for it."""
    whole = with_lowest(run)
    return whole if fits_on_sheet(sheet, whole, DIAGRAM_GAPS[-1]) else list(run)


def _too_large(sheet: Format, panel: Panel) -> TooLargeError:
    box = panel.box
    best = max(free_rooms(sheet), key=lambda room: min(room[0] / box.width, room[1] / box.height))
    size, most = (f"{wide:.0f} × {high:.0f} mm" for wide, high in ((box.width, box.height), best))
    limit = say("at most about {most} on {said}", most=most, said=sheet.description)
    remedy = say("take a larger format or a smaller scale")
    return TooLargeError(say("the view {name!r}", name=panel.view.name), size, limit, remedy)


def _columns_kept(sheet: Format, group: Sequence[Panel]) -> list[Runs]:
    """Two partings: all views together, and those that stand one under the other together."""
    columns: dict[str, list[Panel]] = {}
    for panel in group:
        columns.setdefault(panel.view.across, []).append(panel)
    ways = [[list(group)], list(columns.values())][: len(columns)]
    return [runs for runs in ways if all(fits_on_sheet(sheet, run, DIAGRAM_GAPS[-1]) for run in runs)]


def _partings(sheet: Format, group: Sequence[Panel]) -> list[Runs]:
    """The ways with the fewest parts, and with one more."""
    ways: list[Runs] = [[]]
    for panel in group:
        ways = [way for former in ways for way in _runs_with(sheet, former, panel)]
        fewest = min(map(len, ways), default=0)
        ways = [way for way in ways if len(way) <= fewest + 1]
    return sorted(ways, key=len)[:MAX_PARTINGS]


def _runs_with(sheet: Format, runs: Runs, panel: Panel) -> Iterator[Runs]:
    """Partings in which the panel joins a part that it shares an axis with, the last first, or stands alone.

    No diagram of a column is passed over: it stands under the one before it, or the column goes on elsewhere.
    """
    column = [k for k, run in enumerate(runs) if any(panel.view.across == other.view.across for other in run)]
    for k in reversed(range(len(runs))):
        if (
            shares(panel, runs[k])
            and k in (column[-1:] or [k])
            and fits_on_sheet(sheet, joined := [*runs[k], panel], DIAGRAM_GAPS[-1])
        ):
            yield [*runs[:k], joined, *runs[k + 1 :]]
    if fits_on_sheet(sheet, [panel], DIAGRAM_GAPS[-1]):
        yield [*runs, [panel]]


@dataclass(frozen=True, eq=False)
class Way:
    """One way to fill pages with views.

    runs : the views that stand together, in the order in which they are put on pages
    preference : the preferred place; None is for each view the place that a draughtsman would choose
    onward : whether a page that has been left is not returned to
    closely : whether views may stand in the corners of one another's boxes, beyond their outlines
    pages : the maximum number of pages with which the way is of use
    bare : what belongs under the lowest view of a column is left out, which is of use if that saves a page
    """

    runs: Runs
    preference: Preference | None = None
    onward: bool = False
    closely: bool = False
    pages: float = math.inf
    bare: bool = False


@dataclass(frozen=True, eq=False)
class BlockSetting:
    """One way to set tables and notes: their letters and order, and whether each goes on the emptiest page."""

    blocks: Sequence[Block]
    emptiest: bool


@dataclass(frozen=True, eq=False)
class FilledPages:
    """Pages that were filled in one way.

    merit : numbers to be minimal, the most important first: how many pages but the last are not well used,
        the number of pages, to which pairs of views in another order than that of the work add, and what all pages lack
    """

    leaves: list[OpenPage]
    way: Way
    setting: BlockSetting
    merit: tuple[float, ...]


def fill(sheet: Format, views: Sequence[Panel], ways_of_blocks: Sequence[Sequence[Block]]) -> list[OpenPage]:
    """The fewest pages with all views and blocks, in the middle of what is free of each.

    views : in the order of the work, which the pages follow
    ways_of_blocks : the same tables and notes in letters of different heights and in different orders, the best first
    """
    settings = [BlockSetting(blocks, emptiest) for blocks, emptiest in product(ways_of_blocks, (False, True))]
    best = _best_filling(sheet, views, settings)
    # The widest gaps at which the pages are as good.
    for gap in DIAGRAM_GAPS[:-1]:
        most = len(best.leaves)
        viewed = _with_views(sheet, views, best.way, gap, most)
        wider = viewed and _with_blocks(sheet, views, viewed, best.way, best.setting, most)
        if isinstance(wider, FilledPages) and wider.merit <= best.merit:
            best = wider
            break
    return [leaf.centred() for leaf in best.leaves]


def _best_filling(sheet: Format, views: Sequence[Panel], settings: Sequence[BlockSetting]) -> FilledPages:
    best: FilledPages | None = None
    goal = 0, min_pages(sheet, views), 0
    for way in _ways(sheet, views):
        most = _page_limit(way, best)
        viewed = _with_views(sheet, views, way, DIAGRAM_GAPS[-1], most)
        # Tables bring neither fewer pages nor more order.
        if viewed is None or (best and (0, len(viewed) + _disorder(viewed, views)) >= best.merit):
            continue
        # On one page all settings of the same tables come to the same.
        for setting in settings if len(viewed) > 1 else settings[::2]:
            filled = _with_blocks(sheet, views, viewed, way, setting, most)
            if filled and (best is None or filled.merit < best.merit):
                best = filled
                if best.merit <= goal:
                    return best
    if best is None:
        raise AssertionError("without a limit pages take everything")
    return best


def _page_limit(way: Way, best: FilledPages | None) -> float:
    """The number of pages with which a way could be better than the best."""
    most = way.pages
    if best and not best.merit[0]:
        # Where pages are well used already, more of them are no better.
        most = min(most, math.floor(best.merit[1]))
    if best and way.bare > best.way.bare:
        most = min(most, len(best.leaves) - 1)
    return most


def min_pages(sheet: Format, views: Sequence[Panel]) -> int:
    """The number of pages that the boxes of views take if they fill them completely, a lower bound."""
    room = sheet.content.area - kept_area(sheet)
    return max(1, math.ceil(sum(panel.box.area for panel in views) / room))


def _ways(sheet: Format, views: Sequence[Panel]) -> Iterator[Way]:
    """Ways to put views on pages, those first that look best or find room most often."""
    choices = product(*(partings(sheet, group) for group in clusters(views)))
    parted = sorted(([run for runs in choice for run in runs] for choice in choices), key=len)[:MAX_CHOICES]
    yield from _ways_of(sheet, views, [[with_lower_views(sheet, run) for run in runs] for runs in parted])
    if any(panel.under for panel in views):
        yield from (replace(way, bare=True) for way in _ways_of(sheet, views, parted))


def _ways_of(sheet: Format, views: Sequence[Panel], parted: Sequence[Runs]) -> Iterator[Way]:
    rank = {panel.view.name: k for k, panel in enumerate(views)}
    by_work = [sorted(runs, key=lambda run: min(rank[panel.view.name] for panel in run)) for runs in parted]
    # The small ones find room between the large ones.
    by_size = [sorted(runs, key=lambda run: -sum(panel.box.area for panel in run)) for runs in parted]
    if sheet.name in ONE_PAGE and min_pages(sheet, views) == 1:
        # Before views leave the axis on which one is carried over to the other, they stand closely.
        for large_first, closely, preference in product(by_size, (False, True), (None, prefer_top_left, prefer_high)):
            yield Way(large_first, preference, closely=closely, pages=1)
    for large_first, onward in zip(by_size, by_work, strict=True):
        yield Way(large_first)
        for preference in (prefer_top_left, prefer_high):
            yield Way(onward, preference)
            yield Way(onward, preference, onward=True)
            yield Way(large_first, preference)


def _in_order(leaves: Sequence[OpenPage], views: Sequence[Panel]) -> list[OpenPage]:
    """The pages in the order of the work: the one with the first view, then by the mean rank of their views."""
    rank = {panel.view.name: k for k, panel in enumerate(views)}

    def place(leaf: OpenPage) -> float:
        """The rank of a page: the mean of its views; first with the first view, last without views."""
        ranks = [rank[name] for name in leaf.views]
        if not ranks:
            return math.inf
        return sum(ranks) / len(ranks) if min(ranks) else 0.0

    return sorted(leaves, key=place)


def _disorder(leaves: Sequence[OpenPage], views: Sequence[Panel]) -> float:
    """The number of pairs of views on pages out of the order of the work, weighed in pages."""
    rank = {panel.view.name: k for k, panel in enumerate(views)}
    pages = [[rank[name] for name in leaf.views] for leaf in leaves]
    return sum(a > b for one, other in combinations(pages, 2) for a, b in product(one, other)) / PAIRS_PER_PAGE


def _with_views(sheet: Format, views: Sequence[Panel], way: Way, gap: float, most: float) -> list[OpenPage] | None:
    """Pages with the views, in the order of the work; None if these are more than ``most``."""
    leaves: list[OpenPage] = []
    alone = (run[0] for run in way.runs if len(run) == 1)
    largest = max(alone, key=lambda panel: panel.box.area, default=None)
    for panels in way.runs:
        run = _standing_run(sheet, panels, gap, way)
        # Views that share an axis stand on it or on different pages; what was parted on a large page finds room there.
        allowed = [
            leaf for leaf in leaves[-1 if way.onward else 0 :] if sheet.name in ONE_PAGE or not leaf.shares(panels)
        ]
        preference = middle if len(way.runs) == 1 else way.preference or _preferred(sheet, panels, largest)
        place = _place(
            sheet, allowed, partial(OpenPage.find, boxes=run.boxes, preference=preference), len(leaves) < most
        )
        if place is None:
            return None
        place.leaf.put_views(run, place.by)
        leaves += [place.leaf] * place.begun
    return _in_order(leaves, views)


def _with_blocks(
    sheet: Format, views: Sequence[Panel], viewed: Sequence[OpenPage], way: Way, setting: BlockSetting, most: float
) -> FilledPages | None:
    """Filled pages: those with views, with the blocks, and further ones if need be; None if more than ``most``."""
    leaves = [leaf.copy() for leaf in viewed]
    for block in setting.blocks:
        allowed = sorted(leaves, key=lambda leaf: leaf.used) if setting.emptiest else leaves
        find = partial(OpenPage.find_for, block=block, preference=prefer_bottom_right)
        place = _place(sheet, allowed, find, len(leaves) < most)
        if place is None:
            return None
        place.leaf.put_block(block, place.by)
        leaves += [place.leaf] * place.begun
    leaves = leaves or [blank_page(sheet)]
    return FilledPages(leaves, way, setting, _merit(leaves, views))


@dataclass(frozen=True, eq=False)
class Place:
    """A place on a page, which may be new: the page, and the move of the boxes there."""

    leaf: OpenPage
    by: complex
    begun: bool


def _place(
    sheet: Format, leaves: Sequence[OpenPage], find: Callable[[OpenPage], complex | None], more: bool
) -> Place | None:
    """A place on the first page that has one, else on a new page; None if no ``more`` pages may be begun."""
    for leaf in leaves:
        if (by := find(leaf)) is not None:
            return Place(leaf, by, begun=False)
    if not more:
        return None
    leaf = blank_page(sheet)
    by = find(leaf)
    # What is larger than a page has been refused before.
    assert by is not None
    return Place(leaf, by, begun=True)


def _merit(leaves: Sequence[OpenPage], views: Sequence[Panel]) -> tuple[float, ...]:
    used = [leaf.used for leaf in leaves]
    sparse = sum(share < MIN_FILLED_SHARE for share in used[:-1])
    lack = sum(max(0.0, MIN_FILLED_SHARE - share) for share in used) if len(leaves) > 1 else 0.0
    return sparse, len(leaves) + _disorder(leaves, views), lack


def _standing_run(sheet: Format, panels: Sequence[Panel], gap: float, way: Way) -> ViewRun:
    """The views together with a gap between them, or with the widest gap for which there is room."""
    gap = next(
        narrow
        for narrow in DIAGRAM_GAPS
        if narrow <= gap and (narrow == DIAGRAM_GAPS[-1] or fits_on_sheet(sheet, panels, narrow))
    )
    return ViewRun(panels, panel_origins(panels, gap), gap, way.closely)


def _preferred(sheet: Format, panels: Sequence[Panel], largest: Panel | None) -> Preference:
    """The preference of views: diagrams at the upper left, the largest drawing where it leaves most room."""
    if len(panels) > 1:
        return prefer_top_left
    if panels[0] is not largest:
        return prefer_bottom_right
    if sheet.name in ONE_PAGE:
        return prefer_bottom_left if sheet.is_upright else prefer_top_right
    return prefer_top if sheet.is_upright else at_left

"""Pages filled with views and tables: which of them stand together, on which page, and where.

The views are cut into pages in the order of the work, so none stands on a page before one that it needs.  Of all cuts
into the fewest pages that is taken whose cost is least, which sums

- over all pages, what the largest empty rectangle takes of the frame beyond ``MAX_EMPTY_SHARE`` when all that stands on
  the page has been moved apart, squared; of the last page, which may be empty, by ``LAST_PAGE_WEIGHT``;
- over all cuts, ``PARTING_COST`` for each axis that views on both sides share.

Then diagrams stand as far apart as no further page is needed for it.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import count, islice, pairwise, product

from graphcam.errors import DesignError
from graphcam.sheets.formats import Format
from graphcam.sheets.packing import (
    Preference,
    at_left,
    prefer_bottom_left,
    prefer_bottom_right,
    prefer_high,
    prefer_top,
    prefer_top_left,
    prefer_top_right,
)
from graphcam.sheets.page_space import (
    MAX_EMPTY_SHARE,
    KnownMoves,
    OpenPage,
    ViewRun,
    blank_page,
    fits_on_sheet,
    free_rooms,
    kept_area,
)
from graphcam.sheets.tables import Block
from graphcam.sheets.view_panels import Panel, are_disjoint, clusters, panel_origins, with_lowest
from graphcam.words import say

LAST_PAGE_WEIGHT = 0.2
"""The weight of the empty rectangle of the last of several pages."""
PARTING_COST = 0.01
"""The cost of views that share an axis on different pages."""
MAX_BOXES_SHARE, MAX_CLOSE_SHARE = 0.95, 1.3
"""The maximum area of the boxes of views, as a part of the page's room; in one another's corners they overlap."""
SAME_COST = 5e-3
"""Costs that differ by less are equal: wider gaps are worth it."""
MAX_CUTS = 4
"""The maximum number of cuts on whose pages tables are set."""
DIAGRAM_GAPS = (24.0, 12.0, 6.0, 2.0, -2.0)
"""The gaps between diagrams that stand together [mm]; the widest that needs no further page is taken."""
ONE_PAGE = ("A1",)
"""Formats whose sheets show all views if a page can take them, even in one another's corners."""

Runs = list[list[Panel]]
"""Groups of views, each of which stands together."""


class TooLargeError(DesignError):
    """A view does not fit on a page of its own."""


def _too_large(sheet: Format, panel: Panel) -> TooLargeError:
    box = panel.box
    best = max(free_rooms(sheet), key=lambda room: min(room[0] / box.width, room[1] / box.height))
    sides = say("{width:.0f} × {height:.0f} mm")
    size, most = (sides.with_values(width=w, height=h) for w, h in ((box.width, box.height), best))
    limit = say("at most about {most} on {said}", most=most, said=sheet.description)
    remedy = say("take a smaller ordinate, longer poles, a smaller profile_scale or, below A1, a larger format")
    return TooLargeError(say("the view '{name}'", name=panel.view.title), size, limit, remedy)


def min_pages(sheet: Format, views: Sequence[Panel]) -> int:
    """The number of pages that the boxes of views take if they fill them completely, a lower bound."""
    room = sheet.content.area - kept_area(sheet)
    return max(1, math.ceil(sum(panel.box.area for panel in views) / room))


# --- one page --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Way:
    """One way to put views on a page.

    runs : the views that stand together, in the order in which they are put there
    preference : the preferred place; None is for each view the place that a draughtsman would choose
    closely : whether views may stand in the corners of one another's boxes, beyond their outlines
    """

    runs: Runs
    preference: Preference | None = None
    closely: bool = False


def _ways(sheet: Format, views: Sequence[Panel], *, closely: bool) -> Iterator[Way]:
    """Ways to put views on a page, those first that look best or find room most often; some ``closely`` if need be."""
    parted = list(_partings(sheet, views))
    # What belongs under the lowest view of a column is left out where it finds no room.
    under = any(panel.under for panel in views)
    for lowest in (True, False) if under else (False,):
        for runs in parted:
            in_order = [with_lowest(run) if lowest else run for run in runs]
            # The small ones find room between the large ones.
            by_size = sorted(in_order, key=lambda run: -sum(panel.box.area for panel in run))
            for close in (False, True) if closely else (False,):
                yield Way(by_size, None, close)
                for preference, whole in product((prefer_top_left, prefer_high), (by_size, in_order)):
                    yield Way(whole, preference, close)


def _partings(sheet: Format, views: Sequence[Panel]) -> Iterator[Runs]:
    """All views that share an axis together; those of each column; narrow columns in two, side by side."""
    groups = clusters(views)
    yield groups
    columns = [column for group in groups for column in _columns(group)]
    if len(columns) > len(groups):
        yield columns
    halves = [half for column in columns for half in _halves(sheet, column)]
    if len(halves) > len(columns):
        yield halves


def _columns(group: Sequence[Panel]) -> Runs:
    columns: dict[str, list[Panel]] = {}
    for panel in group:
        columns.setdefault(panel.view.across, []).append(panel)
    return list(columns.values())


def _halves(sheet: Format, column: list[Panel]) -> Runs:
    """The column in two where these can stand side by side, else as it is."""
    if len(column) < 3 or 2 * max(panel.box.width for panel in column) > sheet.content.width:
        return [column]
    half = (len(column) + 1) // 2
    return [column[:half], column[half:]]


def _page(sheet: Format, views: Sequence[Panel], way: Way, gap: float, known: KnownMoves) -> OpenPage | None:
    """A page with the views; None if they have no room."""
    page = blank_page(sheet)
    alone = (run[0] for run in way.runs if len(run) == 1)
    largest = max(alone, key=lambda panel: panel.box.area, default=None)
    for panels in way.runs:
        run = _standing_run(sheet, panels, gap, way)
        preference = way.preference or _preferred(sheet, panels, largest)
        if run is None or (by := page.find_run(run, preference, known)) is None:
            return None
        page.put_views(run, by)
    # As the work has them, in whatever order they found room.
    page.views = {panel.view.name: page.views[panel.view.name] for panel in views}
    return page


def _standing_run(sheet: Format, panels: Sequence[Panel], gap: float, way: Way) -> ViewRun | None:
    """The views together with a gap between them, or with the widest gap for which there is room."""
    wide = (narrow for narrow in DIAGRAM_GAPS[:-1] if narrow <= gap and fits_on_sheet(sheet, panels, narrow))
    gap = next(wide, DIAGRAM_GAPS[-1])
    origins = panel_origins(panels, gap)
    boxes = [panel.box.moved(origin) for panel, origin in zip(panels, origins, strict=True)]
    # The air of neighbours may overlap where there is little.
    return (
        ViewRun(panels, origins, gap, way.closely) if are_disjoint([box.grown(min(gap, 0)) for box in boxes]) else None
    )


def _preferred(sheet: Format, panels: Sequence[Panel], largest: Panel | None) -> Preference:
    """The preference of views: diagrams at the upper left, the largest drawing where it leaves most room."""
    if len(panels) > 1:
        return prefer_top_left
    if panels[0] is not largest:
        return prefer_bottom_right
    if sheet.name in ONE_PAGE:
        return prefer_bottom_left if sheet.is_upright else prefer_top_right
    return prefer_top if sheet.is_upright else at_left


# --- views cut into pages --------------------------------------------------------------------------------------------


class CutViews:
    """The views in the order of the work, and the pages with some of them in a row, each of which is found once."""

    def __init__(self, sheet: Format, views: Sequence[Panel], *, closely: bool = True) -> None:
        # Views may stand in one another's corners, to come on one page all together.
        self.sheet, self.views, self._close = sheet, views, closely and sheet.name in ONE_PAGE
        self.room = sheet.content.area - kept_area(sheet)
        self._areas = [panel.box.area for panel in views]
        self._found: dict[tuple[int, int], tuple[Way, OpenPage] | None] = {}
        self._shares: dict[tuple[int, int], float] = {}

    def page(self, start: int, end: int) -> tuple[Way, OpenPage] | None:
        """The first way in which the views from one to before another find room, and the page; None without room."""
        if (start, end) not in self._found:
            views = self.views[start:end]
            fits = end - start == 1 or sum(self._areas[start:end]) <= self._most(start, end)
            ways = _ways(self.sheet, views, closely=self._closely(start, end)) if fits else ()
            known = KnownMoves()
            pages = ((way, _page(self.sheet, views, way, DIAGRAM_GAPS[-1], known)) for way in ways)
            self._found[start, end] = next(((way, page) for way, page in pages if page), None)
        return self._found[start, end]

    def _closely(self, start: int, end: int) -> bool:
        return self._close and end - start == len(self.views)

    def _most(self, start: int, end: int) -> float:
        """The area of boxes for which a page may have room."""
        return self.room * (MAX_CLOSE_SHARE if self._closely(start, end) else MAX_BOXES_SHARE)

    def parted(self, cut: int) -> int:
        """The number of axes that views before a cut and behind it share."""
        before, behind = self.views[:cut], self.views[cut:]
        return sum(
            bool({getattr(panel.view, axis) for panel in before} & {getattr(panel.view, axis) for panel in behind})
            for axis in ("across", "up")
        )

    def cuts(self, pages: int) -> list[tuple[int, ...]]:
        """The best cuts into so many pages, the last of which may have no view: where each begins, and the end."""
        end, most = len(self.views), self.room * MAX_BOXES_SHARE
        best: dict[int, list[tuple[float, tuple[int, ...]]]] = {0: [(0.0, (0,))]}
        for number in range(1, pages + 1):
            last = number == pages
            following: dict[int, list[tuple[float, tuple[int, ...]]]] = {}
            for start, found in best.items():
                for stop in range(end if last else min(start + 1, end), end + 1):
                    # Nothing is looked for where the remaining pages could not take the rest.
                    if not last and sum(self._areas[stop:]) > (pages - number) * most:
                        continue
                    # What has no room has none with more.
                    if stop > start and self.page(start, stop) is None:
                        break
                    cost = self._cost(start, stop, last=last and pages > 1)
                    following.setdefault(stop, []).extend((each + cost, (*cut, stop)) for each, cut in found)
            best = {stop: sorted(found)[:MAX_CUTS] for stop, found in following.items()}
        return [cut for _, cut in best.get(end, [])]

    def _cost(self, start: int, stop: int, *, last: bool) -> float:
        if stop == start:
            return 0.0
        parting = PARTING_COST * self.parted(stop) if stop < len(self.views) else 0.0
        return parting + _empty_cost(self._empty_share(start, stop), last=last)

    def _empty_share(self, start: int, stop: int) -> float:
        """The largest empty rectangle of a page, as it will be when what stands on it has been moved apart."""
        if (start, stop) not in self._shares:
            found = self.page(start, stop)
            assert found is not None
            self._shares[start, stop] = found[1].final_empty_share
        return self._shares[start, stop]


def _empty_cost(share: float, *, last: bool) -> float:
    return max(0.0, share - MAX_EMPTY_SHARE) ** 2 * (LAST_PAGE_WEIGHT if last else 1.0)


# --- with tables -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class BlockSetting:
    """One way to set tables and notes: their letters and order, and whether each goes on the emptiest page."""

    blocks: Sequence[Block]
    emptiest: bool


def _with_blocks(pages: Sequence[OpenPage], setting: BlockSetting) -> list[OpenPage] | None:
    """The pages with the blocks too; None if these have no room on them."""
    filled = [page.copy() for page in pages]
    for block in setting.blocks:
        for page in sorted(filled, key=lambda page: page.used) if setting.emptiest else filled:
            if (by := page.find_for(block, prefer_bottom_right)) is not None:
                page.put_block(block, by)
                break
        else:
            return None
    return filled


def fill(sheet: Format, views: Sequence[Panel], ways_of_blocks: Sequence[Sequence[Block]]) -> list[OpenPage]:
    """The fewest pages with all views and blocks, in the middle of what is free of each.

    views : in the order of the work, which the pages follow
    ways_of_blocks : the same tables and notes in letters of different heights and in different orders, the best first

    Raises
    ------
    TooLargeError : a view does not fit on a page of its own at its scale
    """
    for panel in views:
        if not fits_on_sheet(sheet, [panel], DIAGRAM_GAPS[-1]):
            raise _too_large(sheet, panel)
    cut_views = CutViews(sheet, views)
    for pages in count(min_pages(sheet, views)):
        if found := _filled(cut_views, cut_views.cuts(pages), _settings(ways_of_blocks, pages)):
            return [page.spread() for page in found]
    raise AssertionError("pages without end take everything")


def has_room(
    sheet: Format,
    views: Sequence[Panel],
    ways_of_blocks: Sequence[Sequence[Block]],
    pages: int,
    together: tuple[Collection[str], int],
) -> bool:
    """Whether so many pages have room for all views and blocks, beside one another; see :func:`fill`.

    together : the names of views that stand on so many of them at most
    """
    cut_views, (names, most) = CutViews(sheet, views, closely=False), together
    if sum(panel.box.area for panel in views) > pages * cut_views.room * MAX_BOXES_SHARE:
        return False

    def spread(cut: tuple[int, ...]) -> int:
        """The number of pages of a cut with these views."""
        return sum(any(panel.view.name in names for panel in views[start:stop]) for start, stop in pairwise(cut))

    cuts = cut_views.cuts(pages)
    # The first is the best, so that it is likely to be taken.
    return (
        bool(cuts)
        and spread(cuts[0]) <= most
        and any(_with_all_blocks(cut_views, cuts, _settings(ways_of_blocks, pages)))
    )


def _settings(ways_of_blocks: Sequence[Sequence[Block]], pages: int) -> list[BlockSetting]:
    settings = [BlockSetting(blocks, emptiest) for blocks, emptiest in product(ways_of_blocks, (False, True))]
    # On one page all settings of the same tables come to the same.
    return settings if pages > 1 else settings[::2]


def _filled(
    cut_views: CutViews, cuts: Sequence[tuple[int, ...]], settings: Sequence[BlockSetting]
) -> list[OpenPage] | None:
    """The best of the pages into which the views are cut, with tables, and with the widest gaps; None without room."""
    found = [
        (_cost_of(cut_views, cut, pages), k, cut, setting, pages)
        for k, (cut, setting, pages) in enumerate(_with_all_blocks(cut_views, cuts, settings))
    ]
    if not found:
        return None
    least, _, cut, setting, best = min(found, key=lambda each: each[:2])
    for gap in DIAGRAM_GAPS[:-1]:
        wider = _with_blocks(_pages_of(cut_views, cut, gap), setting)
        if wider and _cost_of(cut_views, cut, wider) <= least + SAME_COST:
            return wider
    return best


def _with_all_blocks(
    cut_views: CutViews, cuts: Sequence[tuple[int, ...]], settings: Sequence[BlockSetting]
) -> Iterator[tuple[tuple[int, ...], BlockSetting, list[OpenPage]]]:
    """The pages of cuts with all blocks, in the first setting that has room, on the emptiest page or not."""
    for cut in cuts:
        closest = _pages_of(cut_views, cut, DIAGRAM_GAPS[-1])
        for emptiest in sorted({setting.emptiest for setting in settings}):
            tried = ((each, _with_blocks(closest, each)) for each in settings if each.emptiest == emptiest)
            yield from islice(((cut, setting, pages) for setting, pages in tried if pages), 1)


def _pages_of(cut_views: CutViews, cut: tuple[int, ...], gap: float) -> list[OpenPage]:
    """The pages of a cut; with a gap for which a page has no room it keeps the narrowest."""
    pages: list[OpenPage] = []
    for start, stop in pairwise(cut):
        found = cut_views.page(start, stop) if stop > start else None
        if found is None:
            pages.append(blank_page(cut_views.sheet))
            continue
        way, closest = found
        wider = None if gap == DIAGRAM_GAPS[-1] else _page(cut_views.sheet, cut_views.views[start:stop], way, gap, {})
        pages.append(wider or closest)
    return pages


def _cost_of(cut_views: CutViews, cut: tuple[int, ...], pages: Sequence[OpenPage]) -> float:
    return PARTING_COST * sum(cut_views.parted(stop) for stop in cut[1:-1]) + sum(empty_costs(pages))


def empty_costs(pages: Sequence[OpenPage]) -> Iterator[float]:
    """The costs of the largest empty rectangles of all pages."""
    last = len(pages) - 1
    yield from (_empty_cost(page.final_empty_share, last=k == last > 0) for k, page in enumerate(pages))

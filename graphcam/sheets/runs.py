"""Which views stand together: those that share an axis, as many as a page takes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphcam.errors import DesignError
from graphcam.sheets.formats import Format
from graphcam.sheets.leaves import fits, free_rooms
from graphcam.sheets.panels import Panel, shares, with_lowest
from graphcam.words import say

GAPS = (24.0, 12.0, 6.0, 2.0, -2.0)
"""Gaps between diagrams that stand together, mm: the widest is taken that needs no further page."""
ONE_PAGE = ("A1",)
"""Formats on which diagrams that share an axis are parted only where a page cannot take them."""
PARTINGS = 4
"""The maximum number of ways to part views that share axes that are tried."""

Runs = list[list[Panel]]
"""Views that stand together, several times."""


class TooLargeError(DesignError):
    """A view does not fit on a page of its own."""


def partings(sheet: Format, group: Sequence[Panel]) -> list[Runs]:
    """The ways to part views that share axes, so that those of each part fit a page together; few parts first.

    Raises
    ------
    TooLargeError : a view does not fit on a page of its own: nothing is drawn at another scale than it says
    """
    for panel in group:
        if not fits(sheet, [panel], GAPS[-1]):
            raise _too_large(sheet, panel)
    return (_columns_kept(sheet, group) if sheet.name in ONE_PAGE else []) or _parted(sheet, group)


def numbered(sheet: Format, run: Sequence[Panel]) -> list[Panel]:
    """Views that stand together, what belongs under the lowest of a column with them, where a page has room for it."""
    whole = with_lowest(run)
    return whole if fits(sheet, whole, GAPS[-1]) else list(run)


def _too_large(sheet: Format, panel: Panel) -> TooLargeError:
    box = panel.box
    best = max(free_rooms(sheet), key=lambda room: min(room[0] / box.width, room[1] / box.height))
    size, most = (f"{wide:.0f} × {high:.0f} mm" for wide, high in ((box.width, box.height), best))
    limit = say("at most about {most} on {said}", most=most, said=sheet.said)
    remedy = say("take a larger format or a smaller scale")
    return TooLargeError(say("the view {name!r}", name=panel.view.name), size, limit, remedy)


def _columns_kept(sheet: Format, group: Sequence[Panel]) -> list[Runs]:
    """All views together, and those that stand one under the other."""
    columns: dict[str, list[Panel]] = {}
    for panel in group:
        columns.setdefault(panel.view.across, []).append(panel)
    ways = [[list(group)], list(columns.values())][: len(columns)]
    return [runs for runs in ways if all(fits(sheet, run, GAPS[-1]) for run in runs)]


def _parted(sheet: Format, group: Sequence[Panel]) -> list[Runs]:
    """The ways with the fewest parts, and with one more."""
    ways: list[Runs] = [[]]
    for panel in group:
        ways = [way for former in ways for way in _with(sheet, former, panel)]
        fewest = min(map(len, ways), default=0)
        ways = [way for way in ways if len(way) <= fewest + 1]
    return sorted(ways, key=len)[:PARTINGS]


def _with(sheet: Format, runs: Runs, panel: Panel) -> Iterator[Runs]:
    """The panel with a part that it shares an axis with, the last first, or alone.

    No diagram of a column is passed over: it stands under the one before it, or the column goes on elsewhere.
    """
    column = [k for k, run in enumerate(runs) if any(panel.view.across == other.view.across for other in run)]
    for k in reversed(range(len(runs))):
        if shares(panel, runs[k]) and k in (column[-1:] or [k]) and fits(sheet, joined := [*runs[k], panel], GAPS[-1]):
            yield [*runs[:k], joined, *runs[k + 1 :]]
    if fits(sheet, [panel], GAPS[-1]):
        yield [*runs, [panel]]

"""What would make the sheets of a task better: smaller diagrams on fewer sheets, or a larger format.

The ordinate and the poles count where the task leaves them open.
They are chosen as large as their format suits, without a look at what else stands on the sheets: so a sheet may be left
half empty by a diagram that is a little too high.
"""

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import get_args

from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.constructions.views import ACCELERATION, COMBINED, DISPLACEMENT, VELOCITY
from graphcam.drafting.ink import Caption, say
from graphcam.errors import DesignError
from graphcam.report.sheet_contents import Contents, scaled_steps
from graphcam.sheets.layout import SheetPart, fewest_pages, views_of_pages
from graphcam.sheets.page_filling import ONE_PAGE
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.diagram_sizes import (
    DEFAULT_POLE,
    MIN_POLE,
    NARROW_PART_WIDTH,
    STANDARD_ORDINATES,
    STANDARD_POLES,
    narrowest_part,
)
from graphcam.solving.solution import Solution
from graphcam.solving.task_board import board_of, format_of
from graphcam.tasks.sheet_tables import Format
from graphcam.tasks.task import DrawingTable, Task

PROJECTED_VIEWS = ACCELERATION.name, VELOCITY.name, DISPLACEMENT.name, COMBINED.name
"""The names of the views between which lines are projected."""
MIN_ORDINATE_SHARE = 0.5
"""The minimum ordinate that is suggested, as a part of the chosen one."""
MIN_TRIED_DIVISIONS = 4
"""Fewer parts of a phase are not suggested: the curves would be too coarse."""
MAX_TRIED_ORDINATES = 3
"""The maximum number of ordinates that are tried, since a layout takes its time."""
FEWER_SHEETS_NOTE = say(
    "{before} sheets of format {format}; with ordinate = {ordinate:g} and poles = [{first:g}, {second:g}] in [drawing] "
    "it would be {after}."
)
ONE_SHEET_NOTE = say(
    "The diagrams that are carried over to one another stand on several sheets; with ordinate = {ordinate:g} and "
    "poles = [{first:g}, {second:g}] in [drawing] they would stand on one."
)


@dataclass(frozen=True)
class _PageCounts:
    """The number of pages, and of pages with views between which lines are projected."""

    pages: int
    spread: int


def fewer_sheets(contents: Contents, pages: int) -> Caption | None:
    """A suggestion of sizes with which fewer sheets than ``pages`` are needed, or related diagrams share one; or None.

    On the largest format these are parted only where a page cannot take them, so there only the pages count.

    >>> import graphcam as gc
    >>> from graphcam.report.documents import contents_of
    >>> task = gc.builtin_task("flat")
    >>> fewer_sheets(contents_of(gc.solve(task)), 1) is None
    True
    """
    solution = contents.solution
    if pages < 2 or not isinstance(solution, Solution) or not _open(drawing := solution.task.drawing):
        return None
    now = (
        _PageCounts(pages, 1) if drawing.format in ONE_PAGE else _page_counts(drawing, _part(contents, solution.chain))
    )
    # Where even the smallest is of no use, the others are not laid out.
    tables = _smaller(solution)
    if not tables or (said := _suggestion(contents, solution.task, now, tables[-1])) is None:
        return None
    return next(filter(None, (_suggestion(contents, solution.task, now, tried) for tried in tables[:-1])), said)


WIDER_PARTS_NOTE = say(
    "The narrowest parts are {width:.1f} mm wide on {format}, which is little for a hand; on {larger} they are "
    "{wider:.1f} mm wide."
)
FEWER_PARTS_NOTE = say(
    "The narrowest parts are {width:.1f} mm wide on {format}, which is little for a hand; with divisions = {divisions} "
    "in [drawing] they would be {wider:.1f} mm wide."
)
LONGER_POLES_NOTE = say(
    "A pole is {pole:g} mm long on {format}, which is short for a straightedge; on {larger} no pole is shorter than "
    "{longer:g} mm."
)


def larger_paper(solution: AnySolution) -> Iterator[Caption]:
    """What would make parts of the phases and poles long enough to be drawn by hand: the next format, or fewer parts.

    >>> import graphcam as gc
    >>> from graphcam.report.fewer_sheets import larger_paper
    >>> task = gc.builtin_task("sizing")
    >>> for hint in larger_paper(gc.solve(replace(task, drawing=task.drawing.on("A4")))):
    ...     print(hint)
    The narrowest parts are 3.5 mm wide on A4, which is little for a hand; on A3 they are 5.8 mm wide.
    A pole is 25 mm long on A4, which is short for a straightedge; on A3 no pole is shorter than 40 mm.
    """
    if not isinstance(solution, Solution):
        return
    now, drawing = solution.chain.board, solution.task.drawing
    narrow, short = _narrowest(now) < NARROW_PART_WIDTH, drawing.poles is None and min(now.poles) < MIN_POLE
    larger = get_args(Format)[: get_args(Format).index(drawing.format)] if narrow or short else ()
    tables = {each: replace(drawing.on(each), whole_turn=False) for each in reversed(larger)}
    boards = {each: board_of(replace(solution.task, drawing=table)) for each, table in tables.items()}
    values = {"format": drawing.format, "width": _narrowest(now), "pole": min(now.poles)}
    if narrow:
        wider = ((each, wide) for each, board in boards.items() if (wide := _narrowest(board)) >= NARROW_PART_WIDTH)
        if found := next(wider, None):
            yield WIDER_PARTS_NOTE.with_values(**values, larger=found[0], wider=found[1])
        elif found := next(_fewer_parts(solution), None):
            yield FEWER_PARTS_NOTE.with_values(**values, divisions=found[0], wider=found[1])
    if short:
        longer = ((each, min(board.poles)) for each, board in boards.items() if min(board.poles) >= MIN_POLE)
        if found := next(longer, None):
            yield LONGER_POLES_NOTE.with_values(**values, larger=found[0], longer=found[1])


def _narrowest(board: Board) -> float:
    """How wide the narrowest part is on paper [mm]."""
    return narrowest_part(board.stations) / board.mu_phi.per_mm


def _fewer_parts(solution: Solution) -> Iterator[tuple[int, float]]:
    """The largest number of parts a phase that are wide enough on the same format, and how wide they are [mm]."""
    drawing = solution.task.drawing
    for divisions in range(solution.chain.board.divisions - 1, MIN_TRIED_DIVISIONS - 1, -1):
        wide = _narrowest(board_of(replace(solution.task, drawing=replace(drawing, divisions=divisions))))
        if wide >= NARROW_PART_WIDTH:
            yield divisions, wide


def _suggestion(contents: Contents, task: Task, now: _PageCounts, tried: DrawingTable) -> Caption | None:
    """The gain from a table with an ordinate and poles, as a sentence; None where there is none."""
    # What makes a view too large for the format is no suggestion.
    with suppress(DesignError):
        part = _part(contents, Chain(board_of(replace(task, drawing=tried))))
        if now.spread == 1 and fewest_pages(format_of(tried), part) >= now.pages:
            return None
        found = _page_counts(tried, part)
        (first, second), fewer = tried.poles or (0.0, 0.0), found.pages < now.pages
        if fewer or (found.pages == now.pages and found.spread == 1 < now.spread):
            sizes = {"ordinate": tried.ordinate, "first": first, "second": second}
            known = {"before": now.pages, "after": found.pages, "format": tried.format} if fewer else {}
            return (FEWER_SHEETS_NOTE if fewer else ONE_SHEET_NOTE).with_values(**known, **sizes)
    return None


def _open(drawing: DrawingTable) -> bool:
    return drawing.ordinate is None and drawing.poles is None


def _smaller(solution: Solution) -> list[DrawingTable]:
    """The tables with the next smaller ordinates, the largest first, and the usual poles."""
    board, drawing = solution.chain.board, solution.task.drawing
    usual = DEFAULT_POLE / math.degrees(board.mu_phi.per_mm)
    pole = min(STANDARD_POLES, key=lambda pole: abs(pole - usual))
    below = [y for y in STANDARD_ORDINATES if MIN_ORDINATE_SHARE * board.ordinate <= y < board.ordinate]
    return [replace(drawing, ordinate=y, poles=(pole, pole)) for y in below[:MAX_TRIED_ORDINATES]]


def _part(contents: Contents, chain: Chain) -> SheetPart:
    """The contents of the sheets with the constructions of a chain; additional ones do not depend on its scales."""
    drawn = {name: chain.get(name, each) for name, each in contents.drawn.items()}
    return replace(contents.as_one_part, steps=scaled_steps(drawn)).translated(contents.solution.tell)


def _page_counts(drawing: DrawingTable, part: SheetPart) -> _PageCounts:
    pages = views_of_pages(format_of(drawing), part)
    return _PageCounts(len(pages), sum(any(name in PROJECTED_VIEWS for name in page) for page in pages))

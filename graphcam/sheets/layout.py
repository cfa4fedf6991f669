"""The layout of sheets: places of every view, table and note on a page, and of every label in its view.

Diagrams that share an axis stand exactly one under the other or side by side.  A1 takes everything on one page; on the
smaller formats, and where there is too much, further pages follow.  Everything is drawn at the scale that it says: what
does not fit on a page of its own is refused, so scales are chosen beforehand, by :func:`profile_room` and by what
:func:`~graphcam.sheets.page_space.free_rooms` a page has.

An unfinished sheet is laid out and lettered as the finished one and then drawn in part, so that one laid over the other
agrees line for line.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from graphcam.drafting.ink import Step
from graphcam.drafting.scale import ratio_text
from graphcam.sheets.formats import Format
from graphcam.sheets.labels import lettered_steps, shading_parted
from graphcam.sheets.mark_entities import Drawn, Placement, expand
from graphcam.sheets.model import Drawing, Entity, Group, Page
from graphcam.sheets.packing import MESH
from graphcam.sheets.page_filling import ONE_PAGE, empty_costs, fill, has_room, min_pages
from graphcam.sheets.page_space import FRAME_MARGIN, OpenPage
from graphcam.sheets.sheet_frame import TitleBlock, frame as empty_sheet, taken_boxes, title_box
from graphcam.sheets.tables import Block, Table, notes_block, table_blocks
from graphcam.sheets.view_panels import are_disjoint, panels
from graphcam.words import Tell

NOTES_WIDTH = 180.0
"""The maximum width of the notes, mm."""
HEADING_HEIGHT = 12.0
"""The height of the title of a view [mm]."""
FRAME_GAP = 2.0
"""The gap between a label and the frame, mm."""
FURNITURE_HEIGHT = 30.0
"""The height of gauge, marks and margins of a sheet above its title block [mm]."""


Numbered = tuple[tuple[int, str, Step], ...]
"""(number, name of the construction, step), in order."""


@dataclass(frozen=True, eq=False)
class SheetPart:
    """Steps, tables and notes that stand together on sheets of their own.

    steps : each with the number that stays with it in every part
    notes : sentences, to be numbered on the sheet
    numbers : of steps within the task, such as "3.2", by the number that stays with them
    """

    steps: Numbered
    tables: tuple[Table, ...] = ()
    notes: tuple[str, ...] = ()
    numbers: Mapping[int, str] = field(default_factory=dict[int, str])

    def translated(self, tell: Tell) -> SheetPart:
        """The part with every text translated by ``tell``."""
        steps = tuple((number, name, step.translated(tell)) for number, name, step in self.steps)
        tables, notes = tuple(table.translated(tell) for table in self.tables), tuple(map(tell, self.notes))
        return replace(self, steps=steps, tables=tables, notes=notes)

    def group_name(self, number: int, construction: str) -> str:
        """The name of a step's group: its number on the sheet, the construction, its number within the task."""
        return f"step-{number:02d} {construction} {self.numbers.get(number, '')}".rstrip()


def compose(
    steps: Sequence[tuple[str, Step]],
    tables: Sequence[Table],
    title: TitleBlock,
    paper: str = "A1",
    frame: str = "gost",
    notes: Sequence[str] = (),
    orientation: str | None = None,
    tell: Tell = str,
) -> Drawing:
    """Lay the steps of constructions, tables and notes out on sheets.

    steps : (name of the construction, step), in order
    paper : "A1" to "A4"; frame : "gost" or "iso"; orientation : "landscape" or "portrait"; None as the frame's standard
        has it
    tell : translates all texts into the language of the sheets

    Each page has a group "frame", perhaps "tables" and "titles", and one for every step drawn on it, "step-03 name".

    Raises
    ------
    DesignError : there is no such format, frame or orientation
    """
    numbered = tuple((number, name, step) for number, (name, step) in enumerate(steps, 1))
    part = SheetPart(numbered, tuple(tables), tuple(notes))
    return compose_parts([part], title, Format(paper, frame, orientation), tell=tell)


def compose_parts(
    parts: Sequence[SheetPart], title: TitleBlock, sheet: Format, upto: int | None = None, tell: Tell = str
) -> Drawing:
    """Lay parts out, each on sheets of its own.

    upto : number of the last step that is drawn; of the later ones only what is given is drawn, and neither answers in
        tables nor notes.  None for a finished sheet.
    tell : translates all texts into the language of the sheets
    """
    return compose_pages([PagesOfPart(sheet, part.translated(tell)) for part in parts], title, sheet, upto, tell)


def compose_pages(
    pages: Sequence[PagesOfPart], title: TitleBlock, sheet: Format, upto: int | None = None, tell: Tell = str
) -> Drawing:
    """Lay out parts whose pages may be found already; see :func:`compose_parts`."""
    laid_out = [(each.part, leaf) for each in pages for leaf in each.filled]
    titles = [_with_scale(title, leaf, tell) for _, leaf in laid_out]
    sheets = [empty_sheet(sheet, each, k, len(laid_out), tell) for k, each in enumerate(titles, 1)]
    shown = math.inf if upto is None else upto
    drawn = [_page(sheet, leaf, part, empty, shown) for (part, leaf), empty in zip(laid_out, sheets, strict=True)]
    return Drawing(title.name, tuple(drawn))


def _with_scale(title: TitleBlock, leaf: OpenPage, tell: Tell) -> TitleBlock:
    """The title block of a page; a scale that the task leaves open is that of its main view, or of the largest other.

    Views at other scales carry them in their titles.
    """
    if title.scale is not None:
        return title
    drawn = [panel for panel, _ in leaf.views.values() if panel.view.mu_l]
    shown = [panel for panel in drawn if panel.view.main] or drawn
    mu_l = max(shown, key=lambda panel: panel.box.area).view.mu_l if shown else None
    return replace(title, scale=tell(ratio_text(mu_l)) if mu_l else "")


def profile_room(paper: str, frame: str, orientation: str | None = None) -> tuple[float, float]:
    """Width and height [mm] for the cam's profile, rollers included, labels and title not."""
    sheet = Format(paper, frame, orientation)
    inside, block = sheet.content.grown(-FRAME_MARGIN), title_box(sheet)
    if paper in ONE_PAGE and not sheet.is_upright:
        # To the right of 360 mm of cam angle and the poles; above the combined diagram and the details.
        return inside.width - 424.0, inside.height - 170.0
    if paper in ONE_PAGE:
        # Below the diagrams, left of the title block.
        return inside.width - block.width, inside.height - 445.0
    above = inside.width, inside.height - block.height - HEADING_HEIGHT
    beside = inside.width - block.width, inside.height - HEADING_HEIGHT
    return max(above, beside, key=min)


def views_of_pages(sheet: Format, part: SheetPart) -> list[list[str]]:
    """The names of the views that stand on each page of a part.

    Raises
    ------
    DesignError : a view does not fit on a page of its own
    """
    return [list(leaf.views) for leaf in PagesOfPart(sheet, part).filled]


def fewest_pages(sheet: Format, part: SheetPart) -> int:
    """The number of pages that the views of a part fill; how they stand on pages is not looked for."""
    return min_pages(sheet, panels((step for _, _, step in part.steps), sheet.lettering))


class PagesOfPart:
    """The pages of a part, translated, and what they would have room for.

    >>> from graphcam.drafting.ink import View, say
    >>> from graphcam.drafting.marks import Line, Role
    >>> line = Line(np.array([0j, 100 + 50j]), Role.CURVE)
    >>> step = Step(say("A line"), (), View("line", say("Line"), "x", "y"), (line,), why=say("To see it."))
    >>> pages = PagesOfPart(Format("A4", "iso"), SheetPart(((1, "line", step),)))
    >>> pages.have_room({"line": 1.5}), pages.have_room({"line": 4.0})
    (True, False)
    """

    def __init__(self, sheet: Format, part: SheetPart) -> None:
        self.part, self._sheet = part, sheet
        self._views, self._ways = panels((step for _, _, step in part.steps), sheet.lettering), _blocks(sheet, part)

    @cached_property
    def filled(self) -> list[OpenPage]:
        """The pages with all that stands on them.

        Raises
        ------
        DesignError : a view does not fit on a page of its own
        """
        return fill(self._sheet, self._views, self._ways)

    @property
    def cost(self) -> float:
        """What the empty rectangles of the pages cost."""
        return sum(empty_costs(self.filled))

    def have_room(self, times: Mapping[str, float], together: Collection[str] = ()) -> bool:
        """Whether as many pages have room with views so many times as large, by name, each of them on its own.

        together : the names of views that may not stand on more pages than now
        """
        views = [panel.enlarged(times.get(panel.view.name, 1.0)) for panel in self._views]
        most = sum(not leaf.views.keys().isdisjoint(together) for leaf in self.filled)
        return has_room(self._sheet, views, self._ways, len(self.filled), (together, most))


def _blocks(sheet: Format, part: SheetPart) -> list[list[Block]]:
    """Tables and notes in letters of different heights and in different orders, the best first."""
    # Room is found on a grid: a cell is lost at either edge.
    room = sheet.content.width - 2 * FRAME_MARGIN - 2 * MESH
    tall = sheet.content.height - title_box(sheet).height - FURNITURE_HEIGHT
    ways: list[list[Block]] = []
    for height in sorted({sheet.lettering.label, sheet.lettering.small}, reverse=True):
        blocks = [block for table in part.tables for block in table_blocks(table, height, room, tall)]
        if part.notes:
            blocks.append(notes_block(part.notes, height, min(NOTES_WIDTH, room)))
        # In their own order, and the largest first, which finds room for more.
        ways += [blocks, sorted(blocks, key=lambda block: -block.box.width * block.box.height)]
    return ways


@dataclass(frozen=True, eq=False)
class StepPart:
    """The marks that a step draws at once, and the step from which on they are shown: givens from the start."""

    step: int
    since: int
    drawn: Drawn


def _pieces(part: SheetPart, leaf: OpenPage) -> Iterator[StepPart]:
    """The parts of all steps on a page."""
    standing = leaf.views.items()
    # Where views stand in the corners of one another's boxes, their outlines are what is kept clear of.
    apart = are_disjoint([panel.drawn.moved(origin) for _, (panel, origin) in standing])
    boxes = {
        name: [box.moved(origin) for box in ((panel.drawn, panel.title_box) if apart else panel.outline)]
        for name, (panel, origin) in standing
    }
    fields = [*taken_boxes(leaf.sheet, 0.0), *(block.box.moved(at) for block, at in leaf.blocks)]
    for number, _, step in part.steps:
        if step.view.name in leaf.views:
            panel, origin = leaf.views[step.view.name]
            others = [box for name, own in boxes.items() if name != step.view.name for box in own] + fields
            barred = np.array([(box.left, box.bottom, box.right, box.top) for box in others]).reshape(-1, 4).T
            for marks, since in ((step.given + (step.under if panel.lowest else ()), 0), (step.own_marks, number)):
                if marks or since:
                    entities, writings = expand(marks, Placement(origin), panel.letters)
                    yield StepPart(number, since, (entities, [replace(each, barred=barred) for each in writings]))


def _page(sheet: Format, leaf: OpenPage, part: SheetPart, empty: Group, upto: float) -> Page:
    """The page with all that it holds up to a step; labels are placed as on the finished page."""
    pieces = list(_pieces(part, leaf))
    finished = [*empty.entities, *_tables(leaf, math.inf), *_titles(leaf, part, math.inf)]
    inside = sheet.content.grown(-FRAME_GAP)
    placed = zip(pieces, lettered_steps([piece.drawn for piece in pieces], finished, inside), strict=True)
    shown = [(piece.step, entities) for piece, entities in placed if piece.since <= upto]
    steps: dict[int, list[Entity]] = {}
    for (number, _), entities in zip(shown, shading_parted([some for _, some in shown]), strict=True):
        steps.setdefault(number, []).extend(entities)
    tables = _tables(leaf, upto)
    groups = [empty, *([Group("tables", tables)] if tables else []), Group("titles", _titles(leaf, part, upto))]
    names = {number: part.group_name(number, name) for number, name, _ in part.steps}
    groups += [Group(names[number], tuple(entities)) for number, entities in steps.items()]
    origins = {name: origin for name, (_, origin) in leaf.views.items()}
    return Page(*sheet.size, sheet.content, tuple(groups), origins)


def _tables(leaf: OpenPage, upto: float) -> tuple[Entity, ...]:
    """The tables and notes of a page; those of an unfinished sheet have no answers."""
    return tuple(e for block, at in leaf.blocks for e in block.drawn(at, answered=upto == math.inf))


def _titles(leaf: OpenPage, part: SheetPart, upto: float) -> tuple[Entity, ...]:
    """The titles of the views of a page, with what has been found up to a step.

    Of a view of which nothing is given or drawn yet none stands there: that it will be needed is an answer.
    """
    last = {name: number for number, name, _ in part.steps}
    first = {step.view.name: number for number, _, step in reversed(part.steps) if step.marks}
    first |= {step.view.name: 0 for _, _, step in part.steps if step.given}
    views = [(p, origin) for p, origin in leaf.views.values() if upto >= first.get(p.view.name, 0)]
    return tuple(e for p, origin in views for e in p.title(origin, answered=upto >= last.get(p.view.found_by, 0)))

"""Where on which sheet the views, notes and tables of a working drawing stand, and at which standard scale.

The true view stands at the upper left and the section beside it, the notes over the title block; the bore, the data and
the polar table go where there is room.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import takewhile

from graphcam.errors import DesignError
from graphcam.sheets.formats import Format
from graphcam.sheets.model import Box, Entity
from graphcam.sheets.packing import MESH, Room, least_weighted, prefer_top_left
from graphcam.sheets.part_symbols import PartSymbol, other_faces
from graphcam.sheets.sheet_frame import taken_boxes, title_box
from graphcam.sheets.tables import Block, notes_block, table_block
from graphcam.words import Tell, say
from graphcam.workshop.part_contents import (
    PartContents,
    cam_data,
    polar_rows,
    requirements,
    side_by_side_table,
    tolerance_data,
)
from graphcam.workshop.part_views import ShownPart, bore_box, front_box, section_box

FRAME_MARGIN = 5.0
"""Free along the frame and between what stands on the sheet, mm."""
NUMBER_ROOM = 17.0
"""The room from the border to below the drawing's number in the upper left corner by GOST 2.104, mm."""
MIN_PROFILE = 70.0
"""The profile is not drawn smaller than this, mm on paper ..."""
SHEET_CHOICES = (("A3", MIN_PROFILE), ("A2", MIN_PROFILE), ("A2", 20.0), ("A1", 5.0))
"""The sheets for a part that is much wider than its profile is large. The first one that has room is taken."""
BORE_ROOM = 70.0
"""The enlarged bore is at most so wide, mm on paper."""
ROW_HEIGHT = 1.75
"""Height of a row of the polar table, in heights of its letters."""
RIGHT_PREFERENCE = least_weighted(-10, -1)
"""The preference: at the right, then high."""
SCALE_SERIES = (5.0, 2.0, 1.0)
"""The series of drawing scales that both ISO 5455 and GOST 2.302 have, in every decade."""
MAX_PROFILE = 300.0
"""The maximum size of the drawn profile, mm on paper."""

Placed = list[tuple[Block, complex]]
"""Blocks and where their lower left corners stand."""


@dataclass(frozen=True, eq=False)
class PartLayout:
    """The layout of the views and the notes: places of their axes, and boxes.

    fixed : blocks with their corners: the notes, the roughness of the other faces
    room : what is left free
    """

    shown: ShownPart
    sheet: Format
    front: complex
    section: complex
    bore: complex
    fixed: Placed
    general: tuple[PartSymbol, complex]
    room: Room


@dataclass(frozen=True, eq=False)
class PartTables:
    """The tables in letters of ``height`` mm.

    data : of the cam, and its tolerances if the task has some
    rows : of the polar table, the head first, in the language of the drawing
    """

    data: tuple[Block, ...]
    rows: list[tuple[str, ...]]
    tell: Tell
    height: float

    @property
    def count(self) -> int:
        """The number of the rows without the head."""
        return len(self.rows) - 1

    def polar(self, first: int, last: int, columns: int) -> Block:
        """The polar table from row ``first`` to before ``last``, in so many columns side by side."""
        rows = [self.rows[0], *self.rows[first + 1 : last + 1]]
        return table_block(side_by_side_table(rows, columns, self.tell), self.height, row_height=ROW_HEIGHT)

    def capacity(self, free: Box) -> tuple[int, int]:
        """How many columns of the polar table a box has room for, and how many lines in each."""
        column, head = self._sizes
        return max(1, int(free.width / column)), int((free.height - head) / (ROW_HEIGHT * self.height))

    @cached_property
    def _sizes(self) -> tuple[float, float]:
        """Width of a column and height of title and head, mm on paper."""
        # A column alone is as wide as the title of the table.
        one, two = (self.polar(0, self.count, columns).box for columns in (1, 2))
        return two.width / 2, one.height - self.count * ROW_HEIGHT * self.height


def part_tables(contents: PartContents, sheet: Format) -> PartTables:
    """The tables of a part as a sheet letters them."""
    tell, height = contents.tell, sheet.lettering.small
    told = [cam_data(contents.solution, contents.outline), *tolerance_data(contents.solution)]
    data = tuple(table_block(each.translated(tell), height) for each in told)
    return PartTables(data, polar_rows(contents.table, tell), tell, height)


def standard_ratios(most: float) -> Iterator[float]:
    """Paper over part, by the standards, from ``most`` or the next lower one downwards, without end.

    >>> from itertools import islice
    >>> list(islice(standard_ratios(3.0), 5))
    [2.0, 1.0, 0.5, 0.2, 0.1]
    """
    decade = math.floor(math.log10(most))
    while True:
        yield from (ratio for step in SCALE_SERIES if (ratio := round(step * 10.0**decade, 15)) <= most * (1 + 1e-9))
        decade -= 1


def part_layout(contents: PartContents) -> tuple[PartLayout, Placed | None]:
    """The places of the views on a sheet, and those of the tables; None where the polar table has no room on it."""
    first: PartLayout | None = None
    for name, least_profile in SHEET_CHOICES:
        sheet = Format(name, contents.frame)
        tables = part_tables(contents, sheet)
        for views in _scaled_views(contents, sheet, least_profile):
            first = first or views
            if (placed := _placed_tables(tables, views)) is not None:
                return views, placed
        if first and least_profile < MIN_PROFILE:
            break
    if first is None:
        found = say("{length:g} mm wide", length=contents.part.length)
        limit = say("narrow enough to be drawn beside its profile")
        raise DesignError("part", found, limit, say("give a smaller part.width or part.hub_length"))
    return first, None


def _scaled_views(contents: PartContents, sheet: Format, least_profile: float) -> Iterator[PartLayout]:
    """The views at the standard scales at which they fit and the profile is not too small, the largest first."""
    width = 2 * contents.outline.greatest_radius
    for ratio in standard_ratios(MAX_PROFILE / width):
        if width * ratio < least_profile:
            return
        yield from _views(contents, sheet, ratio)


def _views(contents: PartContents, sheet: Format, ratio: float) -> Iterator[PartLayout]:
    """The views at a scale, where they have room, with the bore the larger the better, but no smaller than in them."""
    shown = ShownPart(contents.part, sheet.frame, contents.outline, ratio, ratio, sheet.lettering, contents.tell)
    inside = sheet.content.grown(-FRAME_MARGIN)
    front, section = front_box(shown), section_box(shown)
    high = max(front.top, section.top)
    at = complex(inside.left - front.left, inside.top - high - (NUMBER_ROOM if sheet.frame == "gost" else 0))
    beside = at + front.right - section.left
    if at.real + front.width > inside.right or (beside + section.right).real > inside.right:
        return
    if at.imag + min(front.bottom, section.bottom) < inside.bottom:
        return
    room = Room(inside, taken_boxes(sheet, FRAME_MARGIN))
    fixed, general = _fixed(contents, sheet, shown)
    for block, corner in fixed:
        room.take(block.box.moved(corner))
    room.take(general[0].box.moved(general[1]).grown(2))
    boxes = [front.moved(at), section.moved(beside)]
    if any(not _is_free(room, box) for box in boxes):
        return
    for box in boxes:
        room.take(box)
    for bore_scale in takewhile(lambda scale: scale >= ratio, standard_ratios(max(ratio, BORE_ROOM / shown.part.bore))):
        enlarged = replace(shown, bore_scale=bore_scale)
        bore = bore_box(enlarged)
        if (by := room.find([bore], prefer_top_left)) is not None:
            left = room.copy()
            left.take(bore.moved(by))
            yield PartLayout(enlarged, sheet, at, beside, by, fixed, general, left)


def _is_free(room: Room, box: Box) -> bool:
    """Whether nothing stands in a box."""
    left, bottom = (max(0, math.floor(x / MESH)) for x in (box.left - room.corner.real, box.bottom - room.corner.imag))
    right, top = (math.ceil(x / MESH) for x in (box.right - room.corner.real, box.top - room.corner.imag))
    return not room.full[bottom:top, left:right].any()


def _fixed(contents: PartContents, sheet: Format, shown: ShownPart) -> tuple[Placed, tuple[PartSymbol, complex]]:
    """The notes over the title block, and the roughness of all other faces where the frame's standard has it."""
    block, letters, inside = title_box(sheet), sheet.lettering, sheet.content.grown(-FRAME_MARGIN)
    said = requirements(contents.solution, contents.part, contents.outline, contents.table, contents.frame)
    notes = notes_block([contents.tell(note) for note in said], letters.small, block.width - FRAME_MARGIN)
    corner = complex(block.left, block.top + FRAME_MARGIN) - notes.box.corner
    symbol = other_faces(contents.tell(say("Ra {ra:g}", ra=contents.part.table.roughness)), letters.label)
    if sheet.frame == "gost":
        at = complex(inside.right - symbol.box.right, inside.top - symbol.box.top)
    else:
        at = complex(block.left, block.top + FRAME_MARGIN + notes.box.height + 3)
    return [(notes, corner)], (symbol, at)


# --- tables ----------------------------------------------------------------------------------------------------------


def _placed_tables(tables: PartTables, views: PartLayout) -> Placed | None:
    """The polar table, in as many columns as it takes, and the data, in what the views leave free."""
    most, lines = tables.capacity(views.sheet.content)
    for columns in range(math.ceil(tables.count / lines), most + 1):
        room, placed = views.room.copy(), Placed()
        given = [(block, prefer_top_left) for block in tables.data]
        for block, where in [(tables.polar(0, tables.count, columns), RIGHT_PREFERENCE), *given]:
            box = block.box.grown(1.5)
            by = room.find([box], where)
            if by is None:
                break
            room.take(box.moved(by))
            placed.append((block, by))
        if len(placed) == 1 + len(given):
            return placed
    return None


def table_pages(contents: PartContents, sheet: Format) -> list[Placed]:
    """The data with the first part of the polar table, and the rest of it, over the title blocks of further pages."""
    tables, inside = part_tables(contents, sheet), sheet.content.grown(-FRAME_MARGIN)
    data, rows = tables.data, tables.count
    top = inside.top - (NUMBER_ROOM if sheet.frame == "gost" else 0.0)
    free = Box(inside.left, title_box(sheet).top + FRAME_MARGIN, inside.right, top)
    first, pages = 0, list[Placed]()
    while first < rows:
        placed: Placed = [] if pages else piled(data, complex(inside.left, top))
        wide = max(block.box.width for block in data)
        beside = free if pages else replace(free, left=free.left + wide + FRAME_MARGIN)
        columns, lines = tables.capacity(beside)
        last = min(rows, first + columns * lines)
        block = tables.polar(first, last, math.ceil((last - first) / lines))
        pages.append([*placed, (block, complex(beside.left, beside.top - block.box.height))])
        first = last
    return pages


def piled(blocks: Sequence[Block], corner: complex) -> Placed:
    """Blocks one under the other from an upper left corner downwards."""
    placed = Placed()
    for block in blocks:
        placed.append((block, corner - 1j * block.box.height))
        corner -= 1j * (block.box.height + FRAME_MARGIN)
    return placed


def drawn_blocks(placed: Placed) -> tuple[Entity, ...]:
    """All that stands in the blocks, on the page."""
    return tuple(entity for block, at in placed for entity in block.drawn(at))

"""The layout of the working drawing: its sheet, its standard scale, and the places of views, notes and tables.

The true view stands at the upper left and the section beside it, the notes over the title block; the bore, the data and
the polar table go where there is room.
"""

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
"""The margin along the frame and between what stands on the sheet [mm]."""
NUMBER_ROOM = 17.0
"""The room from the border to below the drawing's number in the upper left corner by GOST 2.104 [mm]."""
MIN_PROFILE, MIN_ON_A3 = 70.0, 90.0
"""The preferred minimum size of the drawn profile [mm of paper]; if it is smaller on A3, a larger sheet is taken."""
SHEET_CHOICES = (("A3", MIN_ON_A3), ("A2", MIN_PROFILE), ("A2", 20.0), ("A1", 5.0))
"""Sheets, each with the minimum size of the profile on it [mm of paper]; the first that has room is taken."""
BORE_ROOM = 70.0
"""The maximum width of the enlarged bore [mm of paper]."""
ROW_HEIGHT = 1.75
"""The height of a row of the polar table, in heights of its letters."""
RIGHT_PREFERENCE = least_weighted(-10, -1)
"""The preference for a place at the right, then high."""
SCALE_SERIES = (5.0, 2.0, 1.0)
"""The series of drawing scales that both ISO 5455 and GOST 2.302 have, in every decade."""
MAX_PROFILE = 300.0
"""The maximum size of the drawn profile [mm of paper]."""

Placed = list[tuple[Block, complex]]
"""Blocks with the places of their lower left corners."""


@dataclass(frozen=True, eq=False)
class PartLayout:
    """The layout of the views and the notes: places of their axes, and boxes.

    fixed : blocks with their corners: the notes, the roughness of the other faces
    room : the free room
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
    """The tables of a part, in letters of ``height`` mm.

    data : of the cam, and its tolerances if the task has some
    rows : of the polar table, the head first, in the language of the drawing
    """

    data: tuple[Block, ...]
    rows: list[tuple[str, ...]]
    tell: Tell
    height: float

    @property
    def count(self) -> int:
        """The number of rows without the head."""
        return len(self.rows) - 1

    def polar(self, first: int, last: int, columns: int) -> Block:
        """The block of the polar table from row ``first`` to before ``last``, in so many columns side by side."""
        rows = [self.rows[0], *self.rows[first + 1 : last + 1]]
        return table_block(side_by_side_table(rows, columns, self.tell), self.height, row_height=ROW_HEIGHT)

    def capacity(self, free: Box) -> tuple[int, int]:
        """The numbers of columns of the polar table, and of lines in each, for which a box has room."""
        column, head = self._sizes
        return max(1, int(free.width / column)), int((free.height - head) / (ROW_HEIGHT * self.height))

    @cached_property
    def _sizes(self) -> tuple[float, float]:
        """The width of a column, and the height of title and head together [mm of paper]."""
        # A column alone is as wide as the title of the table.
        one, two = (self.polar(0, self.count, columns).box for columns in (1, 2))
        return two.width / 2, one.height - self.count * ROW_HEIGHT * self.height


def part_tables(contents: PartContents, sheet: Format) -> PartTables:
    """The tables of a part in the letters of a sheet."""
    tell, height = contents.tell, sheet.lettering.small
    told = [cam_data(contents), *tolerance_data(contents.solution)]
    data = tuple(table_block(each.translated(tell), height) for each in told)
    return PartTables(data, polar_rows(contents.table, tell), tell, height)


def standard_ratios(most: float) -> Iterator[float]:
    """The standard scales (paper over part) from ``most`` or the next lower one downwards, without end.

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
    """Layouts of the views at the standard scales at which they fit and the profile is large enough, largest first."""
    width = 2 * contents.reach
    for ratio in standard_ratios(MAX_PROFILE / width):
        if width * ratio < least_profile:
            return
        yield from _views(contents, sheet, ratio)


def _views(contents: PartContents, sheet: Format, ratio: float) -> Iterator[PartLayout]:
    """Layouts of the views at a scale, if they have room, with the bore as large as possible."""
    part, outline, groove = contents.part, contents.outline, contents.groove
    shown = ShownPart(part, sheet.frame, outline, groove, ratio, ratio, sheet.lettering, contents.tell)
    inside = sheet.content.grown(-FRAME_MARGIN)
    front, section = front_box(shown), section_box(shown)
    high = max(front.top, section.top)
    at = complex(inside.left - front.left, inside.top - high - (NUMBER_ROOM if sheet.frame == "gost" else 0))
    beside = at + front.right - section.left
    if at.real + front.width > inside.right or (beside + section.right).real > inside.right:
        return
    if at.imag + min(front.bottom, section.bottom) < inside.bottom:
        return
    room = Room(inside, taken_boxes(sheet, FRAME_MARGIN, gauged=False))
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
    left, bottom = (max(0, math.floor(x / MESH)) for x in (box.left - room.corner.real, box.bottom - room.corner.imag))
    right, top = (math.ceil(x / MESH) for x in (box.right - room.corner.real, box.top - room.corner.imag))
    return not room.full[bottom:top, left:right].any()


def _fixed(contents: PartContents, sheet: Format, shown: ShownPart) -> tuple[Placed, tuple[PartSymbol, complex]]:
    """The notes above the title block, and the roughness of all other faces where the frame's standard has it."""
    block, letters, inside = title_box(sheet), sheet.lettering, sheet.content.grown(-FRAME_MARGIN)
    notes = notes_block(
        [contents.tell(note) for note in requirements(contents)], letters.small, block.width - FRAME_MARGIN
    )
    corner = complex(block.left, block.top + FRAME_MARGIN) - notes.box.corner
    symbol = other_faces(contents.tell(say("Ra {ra:g}", ra=contents.part.table.roughness)), letters.label)
    if sheet.frame == "gost":
        at = complex(inside.right - symbol.box.right, inside.top - symbol.box.top)
    else:
        at = complex(block.left, block.top + FRAME_MARGIN + notes.box.height + 3)
    return [(notes, corner)], (symbol, at)


# --- tables ----------------------------------------------------------------------------------------------------------


def _placed_tables(tables: PartTables, views: PartLayout) -> Placed | None:
    """The places of the polar table, in as many columns as it needs, and of the data; None without room for them."""
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
    """Further pages: the data with the first part of the polar table, then the rest of it, above the title blocks."""
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
    """Places of blocks one under the other, downwards from an upper left corner."""
    placed = Placed()
    for block in blocks:
        placed.append((block, corner - 1j * block.box.height))
        corner -= 1j * (block.box.height + FRAME_MARGIN)
    return placed


def drawn_blocks(placed: Placed) -> tuple[Entity, ...]:
    """The entities of all blocks in their places on the page."""
    return tuple(entity for block, at in placed for entity in block.drawn(at))

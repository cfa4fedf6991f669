"""Ruled tables and notes, as blocks of entities."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from graphcam.sheets.model import Box, Entity, Text, moved_entity
from graphcam.sheets.sheet_frame import Ruling, outline, rules, stacked_lines
from graphcam.sheets.text_measures import broken_lines, width, words_of, wrap
from graphcam.words import Tell, Words

ROW_HEIGHT = 2.2
"""The height of a row, in heights of its letters."""
LINE_SPACING = 1.5
"""The distance from line to line in a header, in heights of its letters."""
CELL_MARGIN = 1.5
"""The sum of the margins left and right of the text in a cell, in heights of its letters."""
BASE_DEPTH = 0.44
"""The base line below the middle of a cell, in heights of its letters: an index as of φ_у keeps off the rule."""
WIDTH_ROUNDING = 1e-6
"""The excess of a text over its column that is a rounding error [mm]."""
MAX_NAME_WIDTH = 40.0
"""The width, in heights of its letters, above which a name is broken into lines: it is a question, not a name."""


@dataclass(frozen=True)
class Table:
    """A table: its title, the header's texts and rows of as many.

    answers : row and column of the cells that a worksheet leaves empty
    """

    title: Words
    header: tuple[Words, ...]
    rows: tuple[tuple[Words, ...], ...]
    answers: frozenset[tuple[int, int]] = frozenset()

    def translated(self, tell: Tell) -> Table:
        """The table with every text translated by ``tell``."""
        rows = tuple(tuple(tell(cell) for cell in row) for row in self.rows)
        return Table(tell(self.title), tuple(tell(cell) for cell in self.header), rows, self.answers)


@dataclass(frozen=True, eq=False)
class Block:
    """A table or notes, placed as a whole: entities, answers among them, and the box that they need."""

    entities: tuple[Entity, ...]
    answers: tuple[Entity, ...]
    box: Box

    def drawn(self, by: complex, answered: bool = True) -> list[Entity]:
        """The entities moved ``by`` x + iy, with the answers or without."""
        return [moved_entity(entity, by) for entity in (self.entities + self.answers if answered else self.entities)]


def table_blocks(
    table: Table, height: float, room: float = math.inf, tall: float = math.inf, *, row_height: float = ROW_HEIGHT
) -> list[Block]:
    """A table in letters of ``height`` mm, in a block no wider than ``room`` and no higher than ``tall`` mm.

    Its cells are broken into lines where it takes that, then it is parted, first by its columns.

    row_height : in heights of its letters
    """
    letters = height, row_height
    parts = [part for columns in _by_columns(table, height, room) for part in _by_rows(columns, letters, room, tall)]
    if len(parts) > 1:
        parts = [replace(part, title=f"{part.title}, {k}/{len(parts)}") for k, part in enumerate(parts, 1)]
    return [table_block(part, height, room, row_height=row_height) for part in parts]


def _by_columns(table: Table, height: float, room: float) -> list[Table]:
    """The table, or parts of it by columns, all with its first column."""
    least = [column.least for column in _columns(table, height)]
    kept = 1
    while kept < len(least) and sum(least[: kept + 1]) <= room:
        kept += 1
    if kept == len(least) or len(least) == 2:
        return [table]
    # One column beside the first, whatever its words take.
    kept = max(2, kept)
    first, rest = list(range(kept)), [0, *range(kept, len(least))]
    return [_part(table, columns=first), *_by_columns(_part(table, columns=rest), height, room)]


def _by_rows(table: Table, letters: tuple[float, float], room: float, tall: float) -> list[Table]:
    """The table, or parts of it by rows, all with its header; ``letters`` are their height and that of a row."""
    count, (height, row_height) = len(table.rows), letters
    if count < 2 or table_block(table, height, room, row_height=row_height).box.height <= tall:
        return [table]
    halves = range((count + 1) // 2), range((count + 1) // 2, count)
    return [part for rows in halves for part in _by_rows(_part(table, rows=rows), letters, room, tall)]


def _part(table: Table, columns: Sequence[int] | None = None, rows: Sequence[int] | None = None) -> Table:
    across = range(len(table.header)) if columns is None else columns
    down = range(len(table.rows)) if rows is None else rows
    cells = tuple(tuple(table.rows[j][k] for k in across) for j in down)
    answers = {(y, x) for y, j in enumerate(down) for x, k in enumerate(across) if (j, k) in table.answers}
    return Table(table.title, tuple(table.header[k] for k in across), cells, frozenset(answers))


@dataclass(frozen=True)
class _Column:
    """The texts of a column, the header's first; its natural width, and its minimum width for its words [mm]."""

    cells: tuple[str, ...]
    wanted: float
    least: float


def _columns(table: Table, height: float) -> list[_Column]:
    found: list[_Column] = []
    for k, header in enumerate(table.header):
        cells = (str(header), *(str(row[k]) for row in table.rows))
        longest = math.inf if k else MAX_NAME_WIDTH * height
        below = max((_widest(wrap(cell, height, longest), height) for cell in cells[1:]), default=0.0)
        # A header is as wide as what stands below it, but in no more than two or three lines.
        lines = wrap(cells[0], height, max(below, 0.6 * width(cells[0], height)))
        wanted = max(below, _widest(lines, height))
        # A cell of spaces alone is room to write in.
        least = max(width(word, height) for cell in cells for word in ([w for _, w in words_of(cell)] or [cell]))
        found.append(_Column(cells, max(wanted, least) + CELL_MARGIN * height, least + CELL_MARGIN * height))
    return found


def _widths(columns: Sequence[_Column], room: float) -> list[float]:
    """The columns' widths [mm]: the natural ones, or narrower ones that together fill the room."""
    wanted, least = sum(column.wanted for column in columns), sum(column.least for column in columns)
    if wanted <= room:
        return [column.wanted for column in columns]
    if least <= room:
        share = (room - least) / (wanted - least)
        return [column.least + share * (column.wanted - column.least) for column in columns]
    # Two columns, one of them with a word that is wider than the room.
    narrow = min(min(column.least for column in columns), room / 2)
    return [narrow if column.least <= narrow else room - narrow for column in columns]


def table_block(table: Table, height: float, room: float = math.inf, *, row_height: float = ROW_HEIGHT) -> Block:
    """A table in letters of ``height`` mm, its lower left corner at the origin: names to the left, the rest centred.

    row_height : in heights of its letters
    """
    title, columns = str(table.title), _columns(table, height)
    widths = _widths(columns, room)
    titled = broken_lines(title, height, room) or [""]
    # The title must not stand over the edge.
    widths[-1] += max(0.0, _widest(titled, height) - sum(widths))
    told = [
        [broken_lines(c, height, w - CELL_MARGIN * height + WIDTH_ROUNDING) for c in column.cells]
        for column, w in zip(columns, widths, strict=True)
    ]
    headers, *rows = (list(row) for row in zip(*told, strict=True))
    headed = int(any(headers))
    grid = [headers, *rows][1 - headed :]
    heights = [(row_height + (max(1, *map(len, row)) - 1) * LINE_SPACING) * height for row in grid]
    # Columns end from the left edge on, rows from the upper edge down.
    ends = [sum(widths[:k]) for k in range(len(widths) + 1)]
    levels = [sum(heights[j:]) for j in range(len(grid) + 1)]
    wide, high = ends[-1], levels[0]
    across: list[Ruling] = [(0, y, wide, y) for y in levels[1:]]
    thin = [*across[headed:-1], *((x, 0, x, high) for x in ends[1:-1])]
    entities: list[Entity] = [rules(0j, outline(wide, high) + across[:headed], "table")]
    entities += [rules(0j, thin, "ruling")] if thin else []
    above = high + (len(titled) - 1) * LINE_SPACING * height
    entities += stacked_lines(titled, complex(0, above + 0.7 * height), LINE_SPACING, height, "left")
    answers: list[Entity] = []
    for j, (row, (upper, lower)) in enumerate(zip(grid, pairwise(levels), strict=True), -headed):
        for k, (lines, (left, right)) in enumerate(zip(row, pairwise(ends), strict=True)):
            texts = _cell(lines, Box(left, lower, right, upper), height)
            (answers if (j, k) in table.answers else entities).extend(texts)
    return Block(tuple(entities), tuple(answers), Box(0, 0, wide, above + 2.0 * height))


def _cell(lines: list[str], box: Box, height: float) -> list[Text]:
    y = (box.top + box.bottom) / 2 + ((len(lines) - 1) * LINE_SPACING / 2 - BASE_DEPTH) * height
    x, align = ((box.left + box.right) / 2, "center") if box.left else (CELL_MARGIN / 2 * height, "left")
    return stacked_lines(lines, complex(x, y), LINE_SPACING, height, align)


def _widest(lines: Iterable[str], height: float) -> float:
    return max((width(line, height) for line in lines), default=0.0)


def notes_block(notes: Sequence[str], height: float, room: float) -> Block:
    """Numbered notes in lines of at most ``room`` mm, the lower left corner at the origin; they are all answers."""
    lines = [
        (1.8 * height if k else 0.0, line)
        for number, note in enumerate(notes, 1)
        for k, line in enumerate(wrap(f"{number}. {note}", height, room - 1.8 * height))
    ]
    leading = 1.7 * height
    texts = [Text(complex(x, (len(lines) - 1 - k) * leading), line, height) for k, (x, line) in enumerate(lines)]
    return Block((), tuple(texts), Box(0, -0.4 * height, room, (len(lines) - 1) * leading + 1.3 * height))

"""Ruled tables and notes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from graphcam.sheets.box import Box
from graphcam.sheets.fonts import width, wrap
from graphcam.sheets.model import Entity, Text, moved
from graphcam.sheets.title_block import Ruling, outline, rules, stacked
from graphcam.words import Tell, Words

ROW = 2.2
"""Height of a row, in heights of its letters."""
LEADING = 1.5
"""From line to line in a header, in heights of its letters."""
MARGIN = 1.5
"""Left and right of the text in a cell, in heights of its letters, both together."""
LONGEST = 40.0
"""A name that is longer, in heights of its letters, is broken into lines: a question, not what a quantity is called."""


@dataclass(frozen=True)
class Table:
    """A table: its title, the header's texts and rows of as many.

    answers : row and column of the cells that a worksheet leaves empty, to be filled in
    """

    title: Words
    header: tuple[Words, ...]
    rows: tuple[tuple[Words, ...], ...]
    answers: frozenset[tuple[int, int]] = frozenset()

    def told(self, tell: Tell) -> Table:
        """The same table with every text as ``tell`` says it."""
        rows = tuple(tuple(tell(cell) for cell in row) for row in self.rows)
        return Table(tell(self.title), tuple(tell(cell) for cell in self.header), rows, self.answers)


@dataclass(frozen=True, eq=False)
class Block:
    """Something ready to be put on a page as a whole: entities, answers among them, and the box that they need."""

    entities: tuple[Entity, ...]
    answers: tuple[Entity, ...]
    box: Box

    def drawn(self, by: complex, answered: bool = True) -> list[Entity]:
        """The entities moved ``by`` x + iy, with the answers or without."""
        return [moved(entity, by) for entity in (self.entities + self.answers if answered else self.entities)]


def table_block(table: Table, height: float) -> Block:
    """A table in letters of ``height`` mm, its lower left corner at the origin: names to the left, the rest centred.

    A header that is wider than what stands under it is broken into lines, and so is a long name.
    """
    title, rows = str(table.title), [_broken(row, height) for row in table.rows]
    headers = [_header(str(cell), [row[k] for row in rows], height) for k, cell in enumerate(table.header)]
    headed = int(any(headers))
    widths = [max(_widest(row[k], height) for row in (headers, *rows)) + MARGIN * height for k in range(len(headers))]
    # The title must not stand over the edge.
    widths[-1] += max(0.0, width(title, height) - sum(widths))
    grid = [headers, *rows][1 - headed :]
    heights = [(ROW + (max(map(len, row)) - 1) * LEADING) * height for row in grid]
    # Columns end from the left edge on, rows from the upper edge down.
    ends = [sum(widths[:k]) for k in range(len(widths) + 1)]
    levels = [sum(heights[j:]) for j in range(len(grid) + 1)]
    wide, high = ends[-1], levels[0]
    across: list[Ruling] = [(0, y, wide, y) for y in levels[1:]]
    thin = [*across[headed:-1], *((x, 0, x, high) for x in ends[1:-1])]
    entities: list[Entity] = [rules(0j, outline(wide, high) + across[:headed], "table")]
    entities += [rules(0j, thin, "ruling")] if thin else []
    entities.append(Text(complex(0, high + 0.7 * height), title, height))
    answers: list[Entity] = []
    for j, (row, (upper, lower)) in enumerate(zip(grid, pairwise(levels), strict=True), -headed):
        for k, (lines, (left, right)) in enumerate(zip(row, pairwise(ends), strict=True)):
            texts = _cell(lines, Box(left, lower, right, upper), height)
            (answers if (j, k) in table.answers else entities).extend(texts)
    return Block(tuple(entities), tuple(answers), Box(0, 0, wide, high + 2.0 * height))


def _cell(lines: list[str], box: Box, height: float) -> list[Text]:
    """Lines in the middle of a cell; in the first column they begin at the left."""
    y = (box.top + box.bottom) / 2 + (len(lines) - 1) * LEADING / 2 * height - height / 2
    x, align = ((box.left + box.right) / 2, "center") if box.left else (MARGIN / 2 * height, "left")
    return stacked(lines, complex(x, y), LEADING, height, align)


def _broken(row: Iterable[Words], height: float) -> list[list[str]]:
    """The cells of a row in lines; only a long name, at the left, has more than one."""
    name, *others = map(str, row)
    longest = LONGEST * height
    return [wrap(name, height, longest) if width(name, height) > longest else [name], *([cell] for cell in others)]


def _header(cell: str, below: Iterable[list[str]], height: float) -> list[str]:
    """A header's cell in lines about as wide as what stands below it, but in no more than two or three."""
    widest = max((_widest(lines, height) for lines in below), default=0.0)
    return wrap(cell, height, max(widest, 0.6 * width(cell, height)))


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

"""Ruled tables and notes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from graphcam.sheets.box import Box
from graphcam.sheets.fonts import width, wrap
from graphcam.sheets.model import Entity, Text, moved
from graphcam.sheets.title_block import Ruling, rules
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
    title, header = str(table.title), [str(cell) for cell in table.header]
    rows = [[_lines(str(cell), height, name=k == 0) for k, cell in enumerate(line)] for line in table.rows]
    headed = any(header)
    bodies = [max((width(line, height) for row in rows for line in row[k]), default=0.0) for k in range(len(header))]
    under = zip(header, bodies, strict=True)
    headers = [wrap(cell, height, max(body, 0.6 * width(cell, height))) for cell, body in under]
    widths = [max([body, *(width(line, height) for line in lines)]) + MARGIN * height
              for body, lines in zip(bodies, headers, strict=True)]  # fmt: skip
    # The title must not stand over the edge.
    widths[-1] += max(0.0, width(title, height) - sum(widths))
    ends = [sum(widths[:k]) for k in range(len(widths) + 1)]
    grid = [headers, *rows] if headed else rows
    heights = [(ROW + (max(map(len, row)) - 1) * LEADING) * height for row in grid]
    # From the upper edge down to the lower one.
    levels = [sum(heights[j:]) for j in range(len(grid) + 1)]
    total, top, body_top = ends[-1], levels[0], levels[int(headed)]

    def cells(row: list[list[str]], upper: float, lower: float) -> Iterator[list[Entity]]:
        for k, lines in enumerate(row):
            first = (upper + lower) / 2 + (len(lines) - 1) * LEADING / 2 * height - height / 2
            x, align = (MARGIN / 2 * height, "left") if k == 0 else ((ends[k] + ends[k + 1]) / 2, "center")
            yield [Text(complex(x, first - j * LEADING * height), line, height, align)
                   for j, line in enumerate(lines) if line]  # fmt: skip

    ruled: list[Ruling] = [(0, y, total, y) for y in levels[int(headed) + 1 : -1]]
    ruled += [(x, 0, x, top) for x in ends[1:-1]]
    bold: list[Ruling] = [(0, 0, total, 0), (total, 0, total, top), (total, top, 0, top), (0, top, 0, 0)]
    entities: list[Entity] = [rules(0j, [*bold, (0, body_top, total, body_top)] if headed else bold, "table")]
    entities += [rules(0j, ruled, "ruling")] if ruled else []
    entities.append(Text(complex(0, top + 0.7 * height), title, height))
    answers: list[Entity] = []
    for j, (row, upper, lower) in enumerate(zip(grid, levels, levels[1:], strict=False), -int(headed)):
        for k, texts in enumerate(cells(row, upper, lower)):
            (answers if (j, k) in table.answers else entities).extend(texts)
    return Block(tuple(entities), tuple(answers), Box(0, 0, total, top + 2.0 * height))


def _lines(text: str, height: float, *, name: bool) -> list[str]:
    """What stands in a cell; a long name is broken into lines."""
    longest = LONGEST * height
    return wrap(text, height, longest) if name and width(text, height) > longest else [text]


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

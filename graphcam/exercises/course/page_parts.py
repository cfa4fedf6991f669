"""What stands on a page of a marked worksheet besides what is drawn: marks, captions, text, table and code."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphcam.photo.tag_family import dark_cells
from graphcam.sheets.marked_paper import PATCH_SIDE, MarkedPaper, bar, cells, square
from graphcam.sheets.model import Box, Entity, Group, Stroke, Text
from graphcam.sheets.qr import MIN_MODULE, MIN_TILE_MODULE, QUIET_MODULES, module_size, modules
from graphcam.sheets.sheet_frame import cut_name, fitted_text
from graphcam.sheets.tables import Block
from graphcam.sheets.text_measures import width, wrap
from graphcam.words import Tell, say

STRIP_LETTER_HEIGHT = 2.5
"""Height of the letters in the strips, mm."""
LINE_SPACING = 1.7
"""The distance from line to line of a text, in heights of its letters."""
LENGTH_FIELD_SIZE = 22.0, 8.0
"""Width and height of the box in which a measured length is written, mm."""
STRIP_GAP = 1.0
"""The gap between what is in the strip and the tags, mm."""


def mark_group(paper: MarkedPaper, ink: str) -> Group:
    """Tags, bars and patches; ``ink`` is the role of the givens."""
    tags = [cells(dark_cells(number), corner, paper.side / 8) for number, corner in paper.tags.items()]
    across, up = paper.bars
    # Strokes to the left of the way: from its upper end on those of the bar up point into the page.
    bars = [*bar(*across), *bar(*reversed(up))]
    patches = [square(corner, PATCH_SIDE, ink) for corner in paper.patches]
    return Group("marks", (*tags, *bars, *patches))


def bar_captions(paper: MarkedPaper, tell: Tell) -> list[Entity]:
    """What either bar should measure, and a box for what it does."""
    across, up = paper.bar_captions
    lengths = [round(abs(end - start)) for start, end in paper.bars]
    upright = Box(0.0, 0.0, up.height, up.width)
    turned = [_turned(entity, complex(up.right, up.bottom)) for entity in _bar_caption(upright, lengths[1], tell)]
    return [*_bar_caption(across, lengths[0], tell), *turned]


def _bar_caption(box: Box, length: int, tell: Tell) -> list[Entity]:
    """Two lines of text and an empty box, in the middle of a place."""
    lines = [tell(say("bar of {length} mm,", length=length)), tell(say("measured length, mm:"))]
    wide = max(width(line, STRIP_LETTER_HEIGHT) for line in lines)
    left = (box.left + box.right - wide - 2 * STRIP_GAP - LENGTH_FIELD_SIZE[0]) / 2
    middle = (box.bottom + box.top) / 2
    base = middle + LINE_SPACING * STRIP_LETTER_HEIGHT / 2 - STRIP_LETTER_HEIGHT / 2
    texts = [
        Text(complex(left, base - k * LINE_SPACING * STRIP_LETTER_HEIGHT), line, STRIP_LETTER_HEIGHT)
        for k, line in enumerate(lines)
    ]
    field = Box(0.0, 0.0, *LENGTH_FIELD_SIZE).moved(
        complex(left + wide + 2 * STRIP_GAP, middle - LENGTH_FIELD_SIZE[1] / 2)
    )
    return [*texts, Stroke(np.array(field.corners), "ruling", closed=True)]


def _turned(entity: Entity, corner: complex) -> Entity:
    """An entity by a quarter turn about the origin, which goes to the ``corner``: it is read from the right."""
    match entity:
        case Text():
            return replace(entity, at=corner + 1j * entity.at, angle=entity.angle + math.pi / 2)
        case Stroke():
            return replace(entity, points=corner + 1j * entity.points)
        case _:
            raise TypeError(entity)


def upright_text(text: str, box: Box, height: float) -> list[Text]:
    """A text in the middle of a narrow upright box, read from the right."""
    texts = fitted_text(text, (0.0, 0.0, box.height, box.width), height)
    corner = complex(box.right, box.bottom)
    return [replace(each, at=corner + 1j * each.at, angle=math.pi / 2) for each in texts]


def captions(paper: MarkedPaper, title: str, whose: Sequence[str]) -> list[Text]:
    """The exercise and whose page it is, along the top; of two tiles ``whose`` has what either says."""
    gaps = paper.gaps_above()

    def written(height: float) -> list[Text]:
        """The texts with letters so high [mm], cut and fitted where a gap is too narrow."""
        fields = [
            (k, text)
            for pair, who in zip(paper.captions, whose, strict=True)
            for k, text in zip(pair, (title, who), strict=True)
        ]
        boxes = [(gaps[k].left, gaps[k].bottom, gaps[k].right, gaps[k].top) for k, _ in fields]
        return [
            each
            for (_, text), box in zip(fields, boxes, strict=True)
            for each in fitted_text(cut_name(text, box, height), box, height)
        ]

    return written(min(text.height for text in written(1.4 * STRIP_LETTER_HEIGHT)))


def code_side(text: str, paper: MarkedPaper) -> float:
    """The side of a code with the white about it, mm."""
    count = len(modules(text))
    return module_size(count, _finest(paper)) * (count + 2 * QUIET_MODULES)


def code_group(text: str, corners: Iterable[complex], paper: MarkedPaper) -> Group:
    """A code in each of these places, by the lower left corner of its white."""
    dark = modules(text)
    size = module_size(len(dark), _finest(paper))
    return Group("code", tuple(cells(dark, corner + size * QUIET_MODULES * (1 + 1j), size) for corner in corners))


def _finest(paper: MarkedPaper) -> float:
    return MIN_MODULE if paper.seam is None else MIN_TILE_MODULE


def paragraphs(texts: Sequence[str], height: float, room: float) -> Block:
    """Paragraphs in lines of at most ``room`` mm, the lower left corner at the origin."""
    lines: list[tuple[float, str]] = []
    down = 0.0
    for text in texts:
        for line in wrap(text, height, room):
            lines.append((down, line))
            down += LINE_SPACING * height
        down += 0.7 * height
    high = down - 0.7 * height
    drawn = tuple(Text(complex(0.0, high - y - 1.2 * height), line, height) for y, line in lines)
    return Block(drawn, (), Box(0.0, 0.0, room, high))


@dataclass(frozen=True)
class TextColumn:
    """A place that is filled from above; ``code`` is the side of a code that stands at its end.

    upright : whether the code stands below all, else on the right
    """

    box: Box
    code: float
    upright: bool

    @property
    def room(self) -> Box:
        """What is left beside the code."""
        box = self.box
        if self.upright:
            return Box(box.left, box.bottom + self.code, box.right, box.top)
        return Box(box.left, box.bottom, box.right - self.code - STRIP_GAP, box.top)

    @property
    def code_corner(self) -> complex:
        """The lower left corner of the code's white."""
        box = self.box
        return complex(box.left, box.bottom) if self.upright else complex(box.right - self.code, box.top - self.code)

    def fill(self, blocks: Sequence[Block], between: float) -> tuple[list[Entity], list[Block]]:
        """The blocks that find room, in their order one under the other, and those that do not."""
        level = self.room.top
        drawn: list[Entity] = []
        for k, block in enumerate(blocks):
            if level - block.box.height < self.room.bottom or block.box.width > self.room.width + 1e-6:
                return drawn, list(blocks[k:])
            level -= block.box.height
            drawn += block.drawn(complex(self.room.left, level) - block.box.corner)
            level -= between
        return drawn, []

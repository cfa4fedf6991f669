"""The empty sheet: frame by GOST 2.301 or ISO 5457, title block, gauge."""

import cmath
from collections.abc import Iterable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from graphcam.drafting.marks import Points
from graphcam.sheets.box import Box
from graphcam.sheets.formats import Format
from graphcam.sheets.model import Entity, Group, Stroke, Strokes, Text
from graphcam.sheets.sampling import around
from graphcam.sheets.title_block import SIZES, Ruling, TitleBlock, entry, fitted, rules, title_block
from graphcam.words import Tell, say

LENGTH = 100.0
"""mm"""


def gauge(at: complex, tell: Tell = str) -> list[Entity]:
    """A rule of 100 mm in divisions of 10 mm, its zero at ``at``."""
    marks = at + np.arange(0.0, LENGTH + 1.0, 10.0)
    ticks = np.array([3.0, 1.5, 1.5, 1.5, 1.5, 3.0, 1.5, 1.5, 1.5, 1.5, 3.0])
    return [
        Strokes(np.array([at]), np.array([at + LENGTH]), "gauge"),
        Strokes(marks, marks + 1j * ticks, "ruling"),
        *(Text(at + x + 4j, f"{x:g}", 2.5, "center") for x in (0.0, 50.0, LENGTH)),
        Text(at + 75 + 4j, tell(say("mm, true to scale")), 2.5, "center"),
    ]


def gauge_box(at: complex) -> Box:
    """The room that the gauge takes."""
    return Box(at.real - 4, at.imag - 2, at.real + LENGTH + 5, at.imag + 8)


def title_box(paper: Format) -> Box:
    """The room of the title block, in the lower right corner of the frame."""
    wide, high = SIZES[paper.frame]
    inside = paper.content
    return Box(inside.right - wide, inside.bottom, inside.right, inside.bottom + high)


def _gauge_at(paper: Format) -> complex:
    inside, block = paper.content, title_box(paper)
    at = inside.corner + 7 + 5j
    # On A4 the title block leaves too little beside it.
    return at if gauge_box(at).right < block.left else complex(at.real, block.top + 5)


def _remark_at(paper: Format) -> complex:
    """Where a remark begins: in the margin below the frame, and below the fields of ISO 5457."""
    return paper.content.corner - (3.75j if paper.frame == "gost" else 8.75j)


def taken(paper: Format, border: float) -> list[Box]:
    """The boxes inside the frame that the sheet itself needs, with a border around them."""
    boxes = [title_box(paper).grown(border), gauge_box(_gauge_at(paper)).grown(border)]
    if paper.frame == "gost":
        return [*boxes, _number_box(paper).grown(border)]
    return [*boxes, *(around(np.array(mark)).grown(1.0) for mark in zip(*_centring(paper), strict=True))]


def frame(paper: Format, title: TitleBlock, sheet: int, sheets: int, tell: Tell = str) -> Group:
    """All that a sheet carries before anything is drawn on it."""
    entities: list[Entity] = [Stroke(np.array(paper.content.corners), "frame", closed=True)]
    entities += _binding_column(paper, title, tell) if paper.frame == "gost" else _references(paper)
    entities += title_block(paper.frame, title_box(paper).corner, title, sheet, sheets, tell)
    entities += gauge(_gauge_at(paper), tell)
    entities += [Text(_remark_at(paper), title.remark, 2.5)] if title.remark else []
    return Group("frame", tuple(entities))


def _turned_aside(paper: Format) -> bool:
    """Whether the number of field 26 stands on end: on standing sheets larger than A4, which are filed lying."""
    return paper.upright and paper.name != "A4"


def _number_box(paper: Format) -> Box:
    """Field 26 of GOST 2.104: in the corner that is the upper left one when the sheet lies on its long side."""
    inside = paper.content
    if _turned_aside(paper):
        return Box(inside.right - 14, inside.top - 70, inside.right, inside.top)
    return Box(inside.left, inside.top - 14, inside.left + 70, inside.top)


def _binding_column(paper: Format, title: TitleBlock, tell: Tell) -> list[Entity]:
    """GOST 2.104: fields 19 to 23 in the binding margin, and 26: the number once more, upside down when it is filed."""
    corner = paper.content.corner - 12
    ends = np.cumsum([0.0, 25.0, 35.0, 25.0, 25.0, 35.0])
    captions = (say("Orig. no."), say("Signed, date"), say("Replaces no."), say("Copy no."), say("Signed, date"))
    lines: list[Ruling] = [(0, 0, 0, 145), (5, 0, 5, 145), *((0, y, 12, y) for y in ends)]
    entities: list[Entity] = [rules(corner, lines, "frame")]
    for caption, (low, high) in zip(captions, pairwise(ends), strict=True):
        # Written from below upwards: the field lies on its side.
        entities += _turned(fitted(tell(caption), (0, 0, high - low, 5), 2.5), corner + 5 + 1j * low, 1j)
    box, aside = _number_box(paper), _turned_aside(paper)
    inner: list[Ruling] = [(0, 0, 14, 0), (0, 0, 0, 70)] if aside else [(0, 0, 70, 0), (70, 0, 70, 14)]
    entities.append(rules(box.corner, inner, "frame"))
    start, turn = (box.corner + 14, 1j) if aside else (box.corner + (70 + 14j), -1 + 0j)
    return entities + _turned(entry(title, "number", (0, 0, 70, 14), 5.0), start, turn)


def _turned(texts: Iterable[Text], start: complex, turn: complex) -> list[Entity]:
    return [replace(text, at=start + turn * text.at, angle=cmath.phase(turn)) for text in texts]


def _references(paper: Format) -> list[Entity]:
    """ISO 5457: centring marks, and a border of 5 mm with fields of 50 mm counted from them."""
    inside, (width, height) = paper.content, paper.size
    border = np.array(inside.grown(5).corners)
    entities: list[Entity] = [Stroke(border, "ruling", closed=True), Strokes(*_centring(paper), "frame")]
    across, up = _fields(width / 2, inside.left, inside.right), _fields(height / 2, inside.bottom, inside.top)
    for edge, way in ((inside.bottom, -5), (inside.top, 5)):
        cuts = np.array(across[1:-1]) + 1j * edge
        entities.append(Strokes(cuts, cuts + 1j * way, "ruling"))
        for k, (low, high) in enumerate(pairwise(across), 1):
            entities.append(Text(complex((low + high) / 2, edge + way / 2) - 1.25j, str(k), 2.5, "center"))
    for edge, way in ((inside.left, -5), (inside.right, 5)):
        cuts = edge + 1j * np.array(up[1:-1])
        entities.append(Strokes(cuts, cuts + way, "ruling"))
        # Letters run from above, without I and O.
        for k, (high, low) in enumerate(pairwise(up[::-1])):
            at = complex(edge + way / 2, (low + high) / 2) - 1.25j
            entities.append(Text(at, "ABCDEFGHJKLMNPQRSTUVWXYZ"[k], 2.5, "center"))
    return entities


def _centring(paper: Format) -> tuple[Points, Points]:
    """Starts and ends of the centring marks, from the border of references into the sheet."""
    outer, middle = paper.content.grown(5), complex(*paper.size) / 2
    x, y = middle.real, 1j * middle.imag
    starts = np.array([x + 1j * outer.top, x + 1j * outer.bottom, outer.left + y, outer.right + y])
    return starts, starts + 10 * np.array([-1j, 1j, 1, -1])


def _fields(centre: float, low: float, high: float) -> list[float]:
    """Ends of fields of 50 mm counted from the centre; what is left over goes to the last one at each end."""
    inner = [centre + 50.0 * k for k in range(-10, 11) if low + 25 < centre + 50.0 * k < high - 25]
    return [low, *inner, high]

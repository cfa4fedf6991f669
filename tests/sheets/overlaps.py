"""The check on lettering: texts that overlap, that lie on bold lines or that leave the frame.

It works on the exact boxes and lines, not on the raster by which the texts were placed.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from graphcam.drafting.marks import Points
from graphcam.sheets.label_candidates import LabelText
from graphcam.sheets.labels import chosen_places, placed_label
from graphcam.sheets.model import Box, Drawing, Entity, Group, Page, Text
from graphcam.sheets.sampling import box_around, corners, pieces, spans_in_box
from graphcam.sheets.styles import BOLD, STYLES_BY_ROLE


@dataclass(frozen=True)
class Overlap:
    """A text that is in the way, on a page (counted from 1).  ``kind``: "text", "line" or "frame"."""

    page: int
    kind: str
    text: str
    other: str


def place(writings: Sequence[LabelText], drawn: Iterable[Entity], inside: Box) -> list[list[Entity]]:
    """The texts, and their leaders, in the places that they choose."""
    chosen = chosen_places(writings, drawn, inside)
    return [placed_label(writing, k) for writing, k in zip(writings, chosen, strict=True)]


def overlaps(drawing: Drawing, width: float = BOLD) -> list[Overlap]:
    """Every pair of texts that overlap, text on a line of at least ``width`` mm, and text outside the frame."""
    found: list[Overlap] = []
    for number, page in enumerate(drawing.pages, 1):
        texts = [(group, e) for group in page.groups for e in group.entities if isinstance(e, Text) and e.text]
        boxes = [corners(text) for _, text in texts]
        found += [Overlap(number, "text", texts[j][1].text, texts[k][1].text) for j, k in _pairs(boxes)]
        found += [Overlap(number, "line", texts[k][1].text, role) for k, role in _crossed(page, boxes, width)]
        found += [
            Overlap(number, "frame", text.text, group.name)
            for (group, text), box in zip(texts, boxes, strict=True)
            if not _inside(page, group, box)
        ]
    return found


def _inside(page: Page, group: Group, box: Points) -> bool:
    # The frame itself writes in its margins; the drawing may not.
    limit = Box(0.0, 0.0, page.width, page.height) if group.key == "frame" else page.frame
    return limit.holds(box_around(box))


def _pairs(boxes: list[Points]) -> list[tuple[int, int]]:
    """Which of the boxes (4 corners each) overlap: no side of either has the other wholly beyond it."""
    if len(boxes) < 2:
        return []
    centres = np.array([box.mean() for box in boxes])
    reach = np.array([np.abs(box - box.mean()).max() for box in boxes])
    near = np.abs(centres[:, None] - centres) < reach[:, None] + reach
    pairs = [(j, k) for j, k in combinations(range(len(boxes)), 2) if near[j, k]]
    return [(j, k) for j, k in pairs if not _apart(boxes[j], boxes[k]) and not _apart(boxes[k], boxes[j])]


def _apart(one: Points, other: Points) -> bool:
    sides = np.roll(one, -1) - one
    # Counter-clockwise corners have their inside on the left of every side.
    left = ((other[None, :] - one[:, None]) * sides.conjugate()[:, None]).imag
    return bool(np.any(np.all(left <= 1e-9 * np.abs(sides)[:, None], axis=1)))


def _crossed(page: Page, boxes: list[Points], width: float) -> list[tuple[int, str]]:
    """Which boxes are crossed by a line of at least the width, and the line's role."""
    found: list[tuple[int, str]] = []
    for group in page.groups:
        for entity in group.entities:
            if isinstance(entity, Text) or STYLES_BY_ROLE[entity.role].width < width:
                continue
            starts, ends = pieces(entity)
            half = STYLES_BY_ROLE[entity.role].width / 2
            for k, box in enumerate(boxes):
                low, high = spans_in_box(starts, ends, box, half)
                if np.any(low < high):
                    found.append((k, entity.role))
    return found

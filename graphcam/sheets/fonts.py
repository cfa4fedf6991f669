"""Widths and heights of texts in DejaVu Sans, the typeface that ships with matplotlib (Latin, Greek, Cyrillic, primes).

A text is measured by the height of its capital letters, as on the drawing board.
"""

from __future__ import annotations

from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

FAMILY = "DejaVu Sans"


def font_file() -> Path:
    """The file of the typeface."""
    from matplotlib import get_data_path

    return Path(get_data_path(), "fonts", "ttf", "DejaVuSans.ttf")


@cache
def _font() -> FT2Font:
    from matplotlib.ft2font import FT2Font

    return FT2Font(str(font_file()))


@cache
def _glyph(character: str) -> tuple[float, float, float]:
    """Advance, depth below and height above the base line, in units of the font."""
    from matplotlib.ft2font import LoadFlags

    # What the typeface lacks, such as a name in Chinese, has the width of the box that stands for it: glyph 0.
    glyph = _font().load_glyph(_font().get_char_index(ord(character)), flags=LoadFlags.NO_SCALE)
    return glyph.horiAdvance, -glyph.bbox[1], glyph.bbox[3]


@lru_cache(maxsize=4096)
def extent(text: str, height: float) -> tuple[float, float, float]:
    """Width, depth below the base line and height above it [mm] of a text with capitals of ``height`` mm.

    >>> width, below, above = extent("H", 3.5)
    >>> round(width, 3), below, above
    (3.61, 0.0, 3.5)
    >>> extent("漢", 3.5)[0] > 0
    True
    """
    if not text:
        return 0.0, 0.0, 0.0
    mm = height / _glyph("H")[2]
    glyphs = [_glyph(character) for character in text]
    return mm * sum(g[0] for g in glyphs), mm * max(0, *(g[1] for g in glyphs)), mm * max(g[2] for g in glyphs)


def width(text: str, height: float) -> float:
    """Width [mm] of a text with capitals of ``height`` mm.

    >>> width("10", 2.0) == 2 * width("1", 2.0)
    True
    """
    return extent(text, height)[0]


def points_size(height: float) -> float:
    """The size in points at which capitals are ``height`` mm high.

    >>> round(points_size(3.5), 3)
    13.609
    """
    return height * 72 / 25.4 * _font().units_per_EM / _glyph("H")[2]


def wrap(text: str, height: float, room: float) -> list[str]:
    """The text in lines no wider than ``room`` mm, where its words allow it.

    >>> wrap("one two three", 3.5, 25.0)
    ['one two', 'three']
    """
    lines: list[str] = []
    for word in text.split():
        if lines and width(f"{lines[-1]} {word}", height) <= room:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines

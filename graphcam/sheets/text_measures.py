"""Widths and heights of texts, piece by piece as they are drawn: each in one face, its indices smaller and lowered.

A text is measured by the height of its capital letters, as on the drawing board.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import groupby, pairwise
from pathlib import Path

from graphcam.sheets.model import Text
from graphcam.sheets.typefaces import MISSING_CHARACTER, capital, face_of, glyph, is_chinese, lettering_file
from graphcam.subscripts import parts

LETTER_HEIGHTS = (1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0)
"""The series of heights of capital letters by ISO 3098 and GOST 2.304 [mm]."""
WIDTH_ROUNDING = 1e-6
"""The difference of two widths below which they may be the same [mm]."""
OPENING_SIGNS, CLOSING_SIGNS = "（《“‘「『【〔", "，。、；：？！）》”’」』】〕％"
"""Chinese signs that stand at no end of a line, and those at no start."""
STACKED = re.compile(r"\^\{([^{}]*)\}_\{([^{}]*)\}")
"""Deviations of a size, one over the other: ``20^{+0.021}_{0}``."""
STACK_GAP = 0.25
"""The gap before them, in heights of the letters."""
INDEX_DROP = 0.5
"""The drop of an index below its letter, in heights of the index."""


@dataclass(frozen=True)
class Letters:
    """A piece of a text, in one face and one height.

    height : of capital letters, mm
    start : the start of its base line, from that of the text [mm]
    width : mm
    index : whether it is set lower
    """

    text: str
    face: Path
    height: float
    start: complex
    width: float
    index: bool

    @property
    def ink(self) -> tuple[str, complex, complex]:
        """The letters without blanks around them, and the ends of their part of the base line."""
        bare = self.text.strip() or self.text
        before = self.text[: self.text.index(bare)]
        wide = [self.height * sum(glyph(letter).advance for letter in part) for part in (before, bare)]
        left, right = self.height * glyph(bare[0]).left, self.height * glyph(bare[-1]).right
        return bare, self.start + wide[0] + left, self.start + sum(wide) - right


def points_size(height: float) -> float:
    """The font size [points] at which capitals are ``height`` mm high.

    >>> round(points_size(3.5), 3)
    13.456
    """
    return height / capital() * 72 / 25.4


def index_height(height: float) -> float:
    """The height of an index [mm]: one size of the series smaller than its letter.

    >>> index_height(3.5), index_height(2.5)
    (2.5, 1.8)
    """
    return next((low for low, high in pairwise(LETTER_HEIGHTS) if height == high), height / 2**0.5)


@lru_cache(maxsize=4096)
def letters_of(text: str, height: float) -> tuple[Letters, ...]:
    """The pieces of a text with capitals of ``height`` mm, from left to right.

    >>> [(piece.text, piece.height, piece.index) for piece in letters_of("μₐ = 2", 3.5)]
    [('μ', 3.5, False), ('a', 2.5, True), (' = 2', 3.5, False)]
    >>> [(piece.text, round(piece.start.imag, 2), piece.index) for piece in letters_of("20^{+0.021}_{0}", 3.5)]
    [('20', 0.0, False), ('+0.021', 2.25, True), ('0', -1.25, True)]
    """
    return tuple(_letters_of(text, height))


def _letters_of(text: str, height: float) -> Iterator[Letters]:
    small, x = index_height(height), 0.0
    plain, *stacked = STACKED.split(text)
    for over, under, following in [("", "", plain), *zip(stacked[::3], stacked[1::3], stacked[2::3], strict=True)]:
        begin = complex(x + STACK_GAP * height * bool(over or under))
        for said, level in ((over, height - (1 - INDEX_DROP) * small), (under, -INDEX_DROP * small)):
            for piece in _run(said, small, begin + 1j * level, index=True):
                yield piece
                x = max(x, piece.start.real + piece.width)
        for said, index in parts(following):
            high = small if index else height
            for piece in _run(said, high, complex(x, -INDEX_DROP * high if index else 0.0), index=index):
                yield piece
                x = piece.start.real + piece.width


def _run(said: str, height: float, start: complex, *, index: bool) -> Iterator[Letters]:
    """Letters of one height on one base line, in pieces of one face each."""
    for face, run in groupby(said, face_of):
        letters = "".join(letter if face else MISSING_CHARACTER for letter in run)
        wide = height * sum(glyph(letter).advance for letter in letters)
        yield Letters(letters, face or _box_face(), height, start, wide, index)
        start += wide


def _box_face() -> Path:
    return face_of(MISSING_CHARACTER) or lettering_file()


@lru_cache(maxsize=4096)
def extent(text: str, height: float) -> tuple[float, float, float]:
    """Width, depth below the base line and height above it [mm] of a text with capitals of ``height`` mm.

    >>> width, below, above = extent("H", 3.5)
    >>> round(width, 3), below, above
    (3.389, 0.0, 3.5)
    >>> extent("漢", 3.5)[0] > 0
    True
    """
    wide, low, high = 0.0, 0.0, float("-inf")
    for piece in letters_of(text, height):
        size, y = piece.height, piece.start.imag
        letters = [glyph(letter) for letter in piece.text]
        wide = max(wide, piece.start.real + piece.width)
        low = max(low, size * max(letter.below for letter in letters) - y)
        high = max(high, size * max(letter.above for letter in letters) + y)
    return wide, low, high if wide else 0.0


def width(text: str, height: float) -> float:
    """Width [mm] of a text with capitals of ``height`` mm.

    >>> width("11", 2.0) == 2 * width("1", 2.0), width("−", 2.0) == width("+", 2.0)
    (True, True)
    """
    return extent(text, height)[0]


def start_of(text: Text) -> float:
    """The start of a text along its base line, from its place [mm], by its alignment.

    >>> start_of(Text(8j, "H", 3.5)), start_of(Text(8j, "H", 3.5, "right")) == -width("H", 3.5)
    (0.0, True)
    """
    return {"left": 0.0, "center": -0.5, "right": -1.0}[text.align] * width(text.text, text.height)


def wrap(text: str, height: float, room: float) -> list[str]:
    """The text in lines no wider than ``room`` mm, where its words allow it, or its Chinese characters.

    >>> wrap("one two three", 3.5, 25.0)
    ['one two', 'three']
    >>> wrap("凸轮，机构", 3.5, width("凸轮", 3.5))
    ['凸', '轮，', '机构']
    """
    lines: list[str] = []
    reached, space = 0.0, width(" ", height)
    for gap, word in words_of(text):
        wide = width(word, height)
        together = reached + (space if gap else 0.0) + wide
        # A line is as wide as its words and spaces; it is measured itself only where rounding may decide.
        close = abs(together - room) < WIDTH_ROUNDING
        if lines and (width(f"{lines[-1]}{gap}{word}", height) if close else together) <= room:
            lines[-1] += gap + word
            reached = together
        else:
            lines.append(word)
            reached = wide
    return lines


def words_of(text: str) -> Iterator[tuple[str, str]]:
    """The pieces between which a text may be broken: words, each with the space before it, and Chinese characters.

    >>> list(words_of("to scale"))
    [(' ', 'to'), (' ', 'scale')]
    >>> "|".join(word for _, word in words_of("以（O）为圆心，r₀ = 3 mm。"))
    '以|（O）|为|圆|心，|r₀|=|3|mm。'
    """
    for word in text.split():
        gap = " "
        for part in _characters_of(word):
            yield gap, part
            gap = ""


def _characters_of(word: str) -> Iterator[str]:
    """The pieces of a word between whose Chinese characters a line may end; signs stay with their characters."""
    start = 0
    for k in range(1, len(word)):
        before, after = word[k - 1], word[k]
        if (is_chinese(before) or is_chinese(after)) and before not in OPENING_SIGNS and after not in CLOSING_SIGNS:
            yield word[start:k]
            start = k
    yield word[start:]


def broken_lines(text: str, height: float, room: float) -> list[str]:
    """The text in lines no wider than ``room`` mm; a word that is wider alone is broken, but no letter.

    >>> broken_lines("a counterbalanced cam", 3.5, 25.0)
    ['a counter-', 'balanced', 'cam']
    """
    lines: list[str] = []
    for gap, word in words_of(text):
        begun = f"{lines.pop()}{gap}" if lines else ""
        if width(begun + word, height) <= room:
            lines.append(begun + word)
        elif width(word, height) <= room:
            lines += [begun.rstrip(), word]
        else:
            lines += _parts(begun, word, height, room)
    return lines


def _parts(begun: str, word: str, height: float, room: float) -> Iterator[str]:
    """A long word in lines, the first of them behind what is ``begun`` if more than a letter has room there."""
    if begun and _break_position(word, height, room - width(begun, height)) == 1:
        yield begun.rstrip()
        begun = ""
    while width(begun + word, height) > room and len(word) > 1:
        cut = _break_position(word, height, room - width(begun, height))
        yield begun + word[:cut] + "-" * _hyphenated(word, cut)
        begun, word = "", word[cut:]
    yield begun + word


def _break_position(word: str, height: float, room: float) -> int:
    """The number of letters before the break of a word: behind a sign such as a hyphen if one stands late enough."""
    last = 1
    while last < len(word) and width(word[: last + 1] + "-" * _hyphenated(word, last + 1), height) <= room:
        last += 1
    signs = [k for k in range(1, last + 1) if not word[k - 1].isalnum() and 2 * k >= last]
    return max(signs, default=last)


def _hyphenated(word: str, cut: int) -> bool:
    """Whether the break of a word gets a hyphen; in Chinese or Japanese, and behind a sign, it gets none."""
    return cut < len(word) and word[cut - 1 : cut + 1].isalpha() and word[cut - 1].lower() != word[cut - 1].upper()

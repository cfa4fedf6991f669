"""The measures of every character of the two faces that each machine has, read from a file beside the letters.

So texts are measured without a library that opens fonts; the file follows from the fonts, to the unit of their design.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import NamedTuple

FILE = "glyphs.json"
"""Beside the letters; ``tests/sheets/measured_glyphs.py`` writes it."""


@dataclass(frozen=True)
class Glyph:
    """Advance, depth below and height above the base line, in heights of the family's capitals.

    left, right : what stays blank of the advance at either side
    """

    advance: float
    below: float
    above: float
    left: float
    right: float


class Design(NamedTuple):
    """A character as its face was designed, in the units of the face.

    left, bottom, right, top : of its box
    """

    advance: int
    left: int
    bottom: int
    right: int
    top: int

    def glyph(self, capital: float) -> Glyph:
        """The measures of a character by a height of capitals in the units of the face.

        >>> Design(200, 20, -10, 170, 100).glyph(100)
        Glyph(advance=2.0, below=0.1, above=1.0, left=0.2, right=0.3)
        """
        blank = self.left / capital, (self.advance - self.right) / capital
        return Glyph(self.advance / capital, -self.bottom / capital, self.top / capital, *blank)


@dataclass(frozen=True)
class GlyphTable:
    """The designs of the characters of osifont, and of those that DejaVu Sans has besides.

    ems : units of an em, alike in both faces
    capital : height of the first face's capitals in the same units
    """

    ems: int
    capital: int
    faces: tuple[dict[str, Design], ...]

    def face(self, character: str) -> int | None:
        """Which face has a character; None where neither has it."""
        return next((number for number, designs in enumerate(self.faces) if character in designs), None)


@cache
def glyph_table() -> GlyphTable:
    """The table.

    >>> table = glyph_table()
    >>> table.faces[0]["H"].top == table.capital, table.face("H"), table.face("√"), table.face("漢")
    (True, 0, 1, None)
    """
    said = json.loads((files("graphcam") / "data" / "fonts" / FILE).read_text(encoding="utf-8"))
    faces = ({character: Design(*row) for character, row in face.items()} for face in said["faces"])
    return GlyphTable(said["ems"], said["capital"], tuple(faces))

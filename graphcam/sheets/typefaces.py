"""Typefaces: osifont, lettered by ISO 3098; for characters that it lacks DejaVu Sans, then the machine's own.

Each character has one face, by which it is measured and drawn.  The first two are measured by a table, so that only
what they lack, and drawing in them, needs Matplotlib.

The table is a file beside the letters; it follows from the fonts, to the unit of their design.
"""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

FONT_FAMILY = "osifont"
"""The name of the letters' family in drawings."""
FALLBACK_FAMILY = "DejaVu Sans"
"""The family most like osifont, where that is not installed."""
MISSING_CHARACTER = "□"
"""The sign that stands for a character that no face has."""
ALPHABET = "".join(map(chr, (*range(0x20, 0x7F), *range(0xA0, 0x100), *range(0x391, 0x3CA), *range(0x400, 0x460))))
"""The characters of nearly every sheet, in any language of the program."""
UPRIGHT_STYLES = "regular", "medium", "book", "roman"
"""Words in the names of files with letters that are neither bold nor slanted."""


GLYPHS_FILE = "glyphs.json"
"""The table's file beside the letters; ``tests/sheets/measured_glyphs.py`` writes it."""


@dataclass(frozen=True)
class Glyph:
    """A character's advance, depth below and height above the base line, in heights of the family's capitals.

    left, right : the blank parts of the advance at either side
    """

    advance: float
    below: float
    above: float
    left: float
    right: float


class Design(NamedTuple):
    """A character's design in the units of its face: advance and box.

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

    ems : units per em, alike in both faces
    capital : height of the first face's capitals in the same units
    """

    ems: int
    capital: int
    faces: tuple[dict[str, Design], ...]

    def face(self, character: str) -> int | None:
        """The index of the face that has a character; None where neither has it."""
        return next((number for number, designs in enumerate(self.faces) if character in designs), None)


@cache
def glyph_table() -> GlyphTable:
    """The table of the designs of characters.

    >>> table = glyph_table()
    >>> table.faces[0]["H"].top == table.capital, table.face("H"), table.face("√"), table.face("漢")
    (True, 0, 1, None)
    """
    said = json.loads((files("graphcam") / "data" / "fonts" / GLYPHS_FILE).read_text(encoding="utf-8"))
    faces = ({character: Design(*row) for character, row in face.items()} for face in said["faces"])
    return GlyphTable(said["ems"], said["capital"], tuple(faces))


def lettering_file() -> Path:
    """The path of the file of osifont."""
    return Path(str(files("graphcam") / "data" / "fonts" / "osifont.ttf"))


@cache
def shipped() -> tuple[Path, ...]:
    """The files of the faces that every machine has; the second comes with Matplotlib, which is not loaded for it."""
    found = find_spec("matplotlib")
    beside = Path(found.origin).parent if found and found.origin else Path()
    return lettering_file(), beside / "mpl-data" / "fonts" / "ttf" / "DejaVuSans.ttf"


@cache
def opens_fonts() -> bool:
    """Whether Matplotlib, which opens fonts, is installed."""
    return find_spec("matplotlib") is not None


@cache
def font(face: Path) -> FT2Font:
    """A face, opened."""
    from matplotlib.ft2font import FT2Font

    return FT2Font(str(face))


@cache
def face_of(character: str) -> Path | None:
    """The file of the face that has the character; None where no face of the machine has it.

    >>> face_of("μ").name, face_of("√").name, face_of(chr(0xE000 + 77))
    ('osifont.ttf', 'DejaVuSans.ttf', None)
    """
    face = glyph_table().face(character)
    if face is None:
        return _face_with(character)
    # osifont has a few Chinese characters, thinner than those of the face that has the rest.
    return (_face_with(character) if is_chinese(character) else None) or shipped()[face]


def is_chinese(character: str) -> bool:
    """Whether a character is an ideograph of Chinese or Japanese, or a sign as wide as one.

    >>> [is_chinese(character) for character in "凸（φ"]
    [True, True, False]
    """
    return "\u3000" <= character <= "\u9fff" or "\uff00" <= character <= "\uff60"


def _face_with(character: str) -> Path | None:
    """The machine's first face with a character; characters for private use have none."""
    if not (opens_fonts() and character.isprintable()):
        return None
    return next((face for face in installed() if ord(character) in _characters(face)), None)


@cache
def installed() -> tuple[Path, ...]:
    """The files of the machine's own faces, upright ones first, always in the same order."""
    from matplotlib.font_manager import findSystemFonts

    found = {Path(name) for name in findSystemFonts()}
    # A face whose outlines can stand in a PDF as they are comes before one whose cannot.
    return tuple(sorted(found, key=lambda face: (cubic(face), not _is_upright(face), face.name, str(face))))


def _is_upright(face: Path) -> bool:
    name = face.stem.lower()
    styled = any(style in name for style in ("bold", "italic", "oblique", "light", "black", "thin", "mono"))
    return any(style in name for style in UPRIGHT_STYLES) or not styled


@cache
def _characters(face: Path) -> frozenset[int]:
    """The code points of a face; none if its letters cannot be drawn at any size."""
    try:
        opened = font(face)
    except (OSError, RuntimeError):
        return frozenset()
    return frozenset(opened.get_charmap()) if opened.scalable else frozenset()


@cache
def cubic(face: Path) -> bool:
    """Whether the outlines of a face are cubic, not quadratic as in TrueType."""
    try:
        with face.open("rb") as file:
            start = file.read(16)
            if start[:4] == b"ttcf":
                file.seek(struct.unpack(">I", start[12:16])[0])
                start = file.read(4)
    except OSError:
        return True
    return start[:4] == b"OTTO"


@cache
def glyph(character: str) -> Glyph:
    """The measures of a character in its face; those of a box for one without a face."""
    table = glyph_table()
    number, face = table.face(character), None
    if number is None or is_chinese(character):
        face = face_of(character)
    if number is not None and face in (None, *shipped()):
        return table.faces[number][character].glyph(table.capital)
    return glyph(MISSING_CHARACTER) if face is None else _machine_glyph(face, character)


def _machine_glyph(face: Path, character: str) -> Glyph:
    return design(face, character).glyph(font(face).units_per_EM * capital())


def design(face: Path, character: str) -> Design:
    """The design of a character, read from the file of a face."""
    from matplotlib.ft2font import LoadFlags

    opened = font(face)
    loaded = opened.load_glyph(opened.get_char_index(ord(character)), flags=LoadFlags.NO_SCALE)
    return Design(loaded.horiAdvance, *loaded.bbox)


def capital() -> float:
    """The height of the family's capitals, in ems, alike in all faces."""
    return glyph_table().capital / glyph_table().ems


def missing_characters(texts: Iterable[str]) -> str:
    """The characters that no face of the machine has.

    >>> missing_characters(["φ = 80°", "漢" if face_of("漢") else ""])
    ''
    """
    return "".join(character for character in sorted(set("".join(texts))) if face_of(character) is None)


def font_faces(texts: Iterable[str], alphabet: str = ALPHABET) -> str:
    """The CSS rules with which a page carries the letters of these texts and an alphabet, under the family's name."""
    needed = sorted(set("".join(texts)))
    by_face: dict[Path, str] = {lettering_file(): alphabet}
    for character in needed:
        if (face := face_of(character)) is not None:
            by_face[face] = by_face.get(face, "") + character
    return "\n".join(_rules(by_face))


def _rules(by_face: dict[Path, str]) -> Iterator[str]:
    for face, characters in by_face.items():
        letters = "".join(sorted(set(characters)))
        source = f'url(data:font/woff;base64,{_woff(face, letters)}) format("woff")'
        # A face under the same name has only what the first one lacks.
        only = "" if face == lettering_file() else f" unicode-range: {', '.join(f'U+{ord(c):X}' for c in letters)};"
        yield f'@font-face {{ font-family: "{FONT_FAMILY}"; src: {source};{only} }}'


# The pages of a drawing and its step player have nearly always the same letters.
@lru_cache(maxsize=32)
def _woff(face: Path, characters: str) -> str:
    """A face with these characters alone, as a WOFF in base64."""
    from fontTools import subset

    # Widths are measured without kerning and ligatures.
    options = subset.Options(flavor="woff", layout_features=[], recalc_timestamp=False, notdef_outline=True)
    # Of a collection the first one; and without the dates of the editor that it was drawn with.
    options.font_number, options.hinting = 0, False
    options.drop_tables += ["FFTM"]
    subsetter, written = subset.Subsetter(options), BytesIO()
    subsetter.populate(text=characters)
    with subset.load_font(str(face), options) as opened:
        subsetter.subset(opened)
        subset.save_font(opened, written, options)
    return base64.b64encode(written.getvalue()).decode("ascii")

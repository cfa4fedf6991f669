"""The empty sheet: gauge, frame by GOST 2.301 or ISO 5457, title block by form 1 of GOST 2.104 or ISO 7200."""

import cmath
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NoReturn

import numpy as np

from graphcam.drafting.marks import Points
from graphcam.errors import DesignError
from graphcam.sheets.formats import Format
from graphcam.sheets.model import Box, Entity, Group, Stroke, Strokes, Text
from graphcam.sheets.sampling import box_around
from graphcam.sheets.text_measures import LETTER_HEIGHTS, broken_lines, width, wrap
from graphcam.words import Caption, Tell, say

GAUGE_LENGTH = 100.0
"""The length of the gauge [mm]."""


CAPTION_HEIGHT, NARROW_CAPTION_HEIGHT = 2.5, 1.8
"""Letter heights of the captions of fields, and of narrow ones [mm]; the smaller is used nowhere else."""
LINE_SPACING, TIGHT_LINE_SPACING = 1.5, 1.35
"""The distance of base lines of an entry, in heights of its letters, and that in the smallest letters."""
BLOCK_SIZES = {"gost": (185.0, 55.0), "iso": (180.0, 36.0)}
"""Width and height of the title block of each frame [mm]."""


@dataclass(frozen=True)
class TitleBlock:
    """The entries of the title block; empty ones stay empty.

    scale : None is the scale of what is drawn on the sheet
    remark : text below the frame
    table : the table of the task file that has name and number
    """

    name: str = ""
    number: str = ""
    organisation: str = ""
    group: str = ""
    author: str = ""
    checked: str = ""
    approved: str = ""
    material: str = ""
    mass: str = ""
    scale: str | None = ""
    remark: str = ""
    table: str = "title"


Ruling = tuple[float, float, float, float]
"""A ruled line x1, y1, x2, y2 [mm] from the lower left corner of the block."""
Form = tuple[list[Ruling], list[Ruling], list[Text]]
"""Bold lines, thin lines and texts of a block without its outline."""


def rules(corner: complex, lines: list[Ruling], role: str) -> Strokes:
    """The ruled lines of a block with its lower left ``corner``, as an entity."""
    ends = np.array(lines, dtype=np.float64)
    return Strokes(corner + ends[:, 0] + 1j * ends[:, 1], corner + ends[:, 2] + 1j * ends[:, 3], role)


def outline(wide: float, high: float) -> list[Ruling]:
    """The four sides of a block as ruled lines."""
    return [(0, 0, wide, 0), (wide, 0, wide, high), (wide, high, 0, high), (0, high, 0, 0)]


def stacked_lines(lines: list[str], first: complex, leading: float, height: float, align: str) -> list[Text]:
    """Lines of text one under the other, the base line of the first one at ``first``; empty ones are left out."""
    return [Text(first - 1j * (k * leading * height), line, height, align) for k, line in enumerate(lines) if line]


def fitted_text(text: str, field: Ruling, height: float, align: str = "center", what: str = "caption") -> list[Text]:
    """A text in the middle of a field x1, y1, x2, y2, in capitals of ``height`` mm or of a smaller standard height.

    It is rather broken into lines than made smaller, and rather made smaller than a word is broken; nothing is cut.

    Raises
    ------
    DesignError : the text, which the message calls ``what``, is too long even in the smallest letters
    """
    left, bottom, right, top = field
    lines, height = _set(text, field, height) or _refused(text, field, height, what)
    leading = _leading(height)
    x = (left + right) / 2 if align == "center" else left + 1.0
    # The first base line, so that the block of lines stands in the middle.
    y = (bottom + top) / 2 + (len(lines) - 1) * leading / 2 * height - height / 2
    return stacked_lines(lines, complex(x, y), leading, height, align)


PERSONS = "author", "checked", "approved"
"""Entries of the title block that are somebody's name."""
MAX_NAME_LENGTH = 100
"""A longer text is no name."""
_PATRONYMIC_ENDINGS = "вич", "ич", "вна", "чна", "кызы", "оглы"


def fitting_name(name: str, field: Ruling, height: float) -> str:
    """A name as it fits a field: whole, with initials, or else cut at its end.

    >>> fitting_name("Васильев Константин Иванович", (17, 0, 30, 5), 2.5)
    'Васильев К. И.'
    """
    shorter = [name, *([with_initials(name)] if " " in name else [])]
    return next((each for each in shorter if _set(each, field, height) is not None), cut_name(name, field, height))


def cut_name(name: str, field: Ruling, height: float) -> str:
    """A name, cut at its end if it does not fit a field; what is too long for a name stays as it is."""
    cut = (f"{name[:count].rstrip()}…" for count in range(len(name) - 1, 0, -1))
    shorter = [name] if len(name) > MAX_NAME_LENGTH else [name, *cut]
    return next((each for each in shorter if _set(each, field, height) is not None), name)


def with_initials(name: str) -> str:
    """A surname with initials, in the order of the name: a patronymic at its end tells that the surname is first.

    >>> with_initials("Иван Петрович Сидоров"), with_initials("Maria Fernanda Albuquerque")
    ('И. П. Сидоров', 'M. F. Albuquerque')
    """
    words = name.split()
    first = len(words) > 2 and words[-1].casefold().endswith(_PATRONYMIC_ENDINGS)
    surname, others = (words[0], words[1:]) if first else (words[-1], words[:-1])
    initials = " ".join(f"{word[0]}." for word in others)
    return f"{surname} {initials}" if first else f"{initials} {surname}"


def _set(text: str, field: Ruling, height: float) -> tuple[list[str], float] | None:
    """The lines of a text that fit a field, and their height; None where none do."""
    left, bottom, right, top = field
    room = right - left - 2.0
    lower = [size for size in reversed(LETTER_HEIGHTS) if size <= height]
    for sizes in (lower[:-1], lower[-1:]) if height > NARROW_CAPTION_HEIGHT else (lower,):
        for lines_of in (wrap, broken_lines):
            for size in sizes:
                lines = lines_of(text, size, room)
                # The last line counts with the tails of its letters.
                high = (1.3 + (len(lines) - 1) * _leading(size)) * size
                tall = top - bottom - (0.2 if size == NARROW_CAPTION_HEIGHT else 1.0)
                if high <= tall and all(width(line, size) <= room for line in lines):
                    return lines, size
    return None


def _leading(height: float) -> float:
    return TIGHT_LINE_SPACING if height == NARROW_CAPTION_HEIGHT else LINE_SPACING


def _refused(text: str, field: Ruling, height: float, what: str) -> NoReturn:
    fits = next(count for count in range(len(text) - 1, -1, -1) if _set(text[:count], field, height) is not None)
    limit = say("at most {fits} letters, for which its field of the title block has room", fits=fits)
    raise DesignError(say("length of {what}", what=what), len(text), limit, say("shorten it"))


def entry(title: TitleBlock, name: str, field: Ruling, height: float, align: str = "center") -> list[Text]:
    """The texts of a title's entry ``name`` in a field, with that name."""
    own = name in ("name", "number", "material")
    key = "document" if name == "number" and title.table == "title" else name
    said, what = getattr(title, name) or "", f"{title.table if own else 'title'}.{key}"
    said = fitting_name(said, field, height) if name in PERSONS else said
    return [replace(text, field=name) for text in fitted_text(said, field, height, align, what)]


def title_block(
    frame: str, corner: complex, title: TitleBlock, sheet: int, sheets: int, tell: Tell = str
) -> list[Entity]:
    """The block of a frame ("gost" or "iso") with its lower left ``corner``, on one sheet of several."""
    form = _gost if frame == "gost" else _iso
    bold, thin, texts = form(title, sheet, sheets, tell)
    placed = [replace(text, at=corner + text.at) for text in texts]
    return [rules(corner, outline(*BLOCK_SIZES[frame]) + bold, "frame"), rules(corner, thin, "ruling"), *placed]


def _gost(title: TitleBlock, sheet: int, sheets: int, tell: Tell) -> Form:
    bold: list[Ruling] = [
        *((7, 30, 7, 55), (17, 0, 17, 55), (40, 0, 40, 55), (55, 0, 55, 55), (65, 0, 65, 55), (0, 30, 65, 30)),
        *((0, 35, 65, 35), (65, 15, 185, 15), (65, 40, 185, 40), (135, 0, 135, 40), (135, 35, 185, 35)),
        *((135, 20, 185, 20), (150, 20, 150, 40), (167, 20, 167, 40), (155, 15, 155, 20)),
    ]
    thin: list[Ruling] = [(0, y, 65, y) for y in (5, 10, 15, 20, 25, 40, 45, 50)]
    thin += [(140, 20, 140, 35), (145, 20, 145, 35)]
    texts: list[Text] = []
    columns = (say("Ch."), say("Sheet"), say("Document no."), say("Signed"), say("Date"))
    for (left, right), caption in zip(pairwise((0, 7, 17, 40, 55, 65)), columns, strict=True):
        texts += fitted_text(tell(caption), (left, 30, right, 35), NARROW_CAPTION_HEIGHT)
    captions = (say("Drawn"), say("Checked"), say("Tech."), "", say("Norms"), say("Appr."))
    signers = ("author", "checked", "", "", "", "approved")
    for bottom, caption, name in zip(range(25, -1, -5), captions, signers, strict=True):
        texts += fitted_text(tell(caption), (0, bottom, 17, bottom + 5), CAPTION_HEIGHT, align="left")
        texts += entry(title, name, (17, bottom, 40, bottom + 5), CAPTION_HEIGHT, align="left") if name else []
    for left, right, caption in ((135, 150, say("Stage")), (150, 167, say("Mass")), (167, 185, say("Scale"))):
        texts += fitted_text(tell(caption), (left, 35, right, 40), CAPTION_HEIGHT)
    texts += entry(title, "number", (65, 40, 185, 55), 7.0)
    # A long name does not fill its field from line to line.
    texts += entry(title, "name", (67, 15, 133, 40), 5.0)
    texts += entry(title, "material", (65, 0, 135, 15), 3.5)
    texts += entry(title, "mass", (150, 20, 167, 35), 3.5)
    texts += entry(title, "scale", (167, 20, 185, 35), 3.5)
    # GOST 2.104: the number of the sheet only where there are several, their number on the first alone.
    numbered = say("Sheet {number}", number=sheet) if sheets > 1 else say("Sheet")
    counted = say("Sheets {number}", number=sheets) if sheet == 1 else say("Sheets")
    texts += fitted_text(tell(numbered), (135, 15, 155, 20), CAPTION_HEIGHT)
    texts += fitted_text(tell(counted), (155, 15, 185, 20), CAPTION_HEIGHT)
    owner = replace(title, organisation=" ".join(filter(None, (title.organisation, title.group))))
    return bold, thin, [*texts, *entry(owner, "organisation", (135, 0, 185, 15), 3.5)]


def _iso(title: TitleBlock, sheet: int, sheets: int, tell: Tell) -> Form:
    fields: tuple[tuple[Caption, str, Ruling], ...] = (
        (say("Responsible department"), "", (0, 27, 48, 36)),
        (say("Checked by"), "checked", (48, 27, 84, 36)),
        (say("Material"), "material", (84, 27, 120, 36)),
        (say("Mass"), "mass", (120, 27, 138, 36)),
        (say("Scale"), "scale", (138, 27, 156, 36)),
        (say("Document status"), "", (156, 27, 180, 36)),
        (say("Legal owner"), "organisation", (0, 9, 48, 27)),
        # A field that ISO 7200 leaves to the owner: the group belongs to the school, and answers for nothing.
        (say("Group"), "group", (0, 0, 48, 9)),
        (say("Created by"), "author", (48, 13.5, 84, 27)),
        (say("Approved by"), "approved", (48, 0, 84, 13.5)),
        (say("Title"), "name", (84, 0, 138, 27)),
        (say("Identification number"), "number", (138, 9, 180, 27)),
        (say("Rev."), "", (138, 0, 147, 9)),
        (say("Date"), "", (147, 0, 164, 9)),
        (say("Sheet"), "", (164, 0, 180, 9)),
    )
    thin: list[Ruling] = []
    texts: list[Text] = []
    for caption, name, (left, bottom, right, top) in fields:
        # The outer sides are bold already.
        thin += [(left, bottom, right, bottom)] if bottom else []
        thin += [(left, bottom, left, top)] if left else []
        texts += fitted_text(tell(caption), (left, top - 3.9, right, top - 0.5), NARROW_CAPTION_HEIGHT, align="left")
        height = 5.0 if name == "name" else 3.5
        texts += entry(title, name, (left, bottom, right, top - 3.2), height) if name else []
    texts += fitted_text(f"{sheet}/{sheets}", (164, 0, 180, 9 - 3.2), 3.5)
    return [], thin, texts


def gauge(at: complex, tell: Tell = str) -> list[Entity]:
    """A rule of 100 mm in divisions of 10 mm, its zero at ``at``."""
    marks = at + np.arange(0.0, GAUGE_LENGTH + 1.0, 10.0)
    ticks = np.array([3.0, 1.5, 1.5, 1.5, 1.5, 3.0, 1.5, 1.5, 1.5, 1.5, 3.0])
    return [
        Strokes(np.array([at]), np.array([at + GAUGE_LENGTH]), "gauge"),
        Strokes(marks, marks + 1j * ticks, "ruling"),
        *(Text(at + x + 4j, f"{x:g}", 2.5, "center") for x in (0.0, 50.0, GAUGE_LENGTH)),
        Text(at + 75 + 4j, tell(say("mm, true to scale")), 2.5, "center"),
    ]


def gauge_box(at: complex) -> Box:
    """The box of the gauge."""
    return Box(at.real - 4, at.imag - 2, at.real + GAUGE_LENGTH + 5, at.imag + 8)


def title_box(paper: Format) -> Box:
    """The box of the title block, in the lower right corner of the frame."""
    wide, high = BLOCK_SIZES[paper.frame]
    inside = paper.content
    return Box(inside.right - wide, inside.bottom, inside.right, inside.bottom + high)


def _gauge_at(paper: Format) -> complex:
    inside, block = paper.content, title_box(paper)
    at = inside.corner + 7 + 5j
    # On A4 the title block leaves too little beside it.
    return at if gauge_box(at).right < block.left else complex(at.real, block.top + 5)


def _remark_at(paper: Format) -> complex:
    """The place of a remark: in the margin below the frame, and below the fields of ISO 5457."""
    return paper.content.corner - (3.75j if paper.frame == "gost" else 8.75j)


def taken_boxes(paper: Format, border: float, *, gauged: bool = True) -> list[Box]:
    """The boxes inside the frame that the sheet itself needs, with a margin ``border`` around them."""
    boxes = [title_box(paper).grown(border)] + [gauge_box(_gauge_at(paper)).grown(border)] * gauged
    if paper.frame == "gost":
        return [*boxes, _number_box(paper).grown(border)]
    return [*boxes, *(box_around(np.array(mark)).grown(1.0) for mark in zip(*_centring(paper), strict=True))]


def frame(paper: Format, title: TitleBlock, sheet: int, sheets: int, tell: Tell = str, *, gauged: bool = True) -> Group:
    """The group of all that a sheet carries before anything is drawn on it.

    gauged : whether it has a rule of 100 mm, which a part drawing has not
    """
    entities: list[Entity] = [Stroke(np.array(paper.content.corners), "frame", closed=True)]
    entities += _binding_column(paper, title, sheet, tell) if paper.frame == "gost" else _references(paper)
    entities += title_block(paper.frame, title_box(paper).corner, title, sheet, sheets, tell)
    entities += gauge(_gauge_at(paper), tell) if gauged else []
    entities += [Text(_remark_at(paper), title.remark, 2.5)] if title.remark else []
    return Group("frame", tuple(entities))


def _has_upright_number(paper: Format) -> bool:
    """Whether the number of field 26 is turned: on portrait sheets larger than A4, which are filed in landscape."""
    return paper.is_upright and paper.name != "A4"


def _number_box(paper: Format) -> Box:
    """Field 26 of GOST 2.104, in the corner that is the upper left one when the sheet lies on its long side."""
    inside = paper.content
    if _has_upright_number(paper):
        return Box(inside.right - 14, inside.top - 70, inside.right, inside.top)
    return Box(inside.left, inside.top - 14, inside.left + 70, inside.top)


def _binding_column(paper: Format, title: TitleBlock, sheet: int, tell: Tell) -> list[Entity]:
    """GOST 2.104: fields 19 to 25 in the binding margin, 24 and 25 of the first sheet alone; and field 26.

    26 is the number once more, upside down when the sheet is filed.
    """
    captions = (say("Orig. no."), say("Signed, date"), say("Replaces no."), say("Copy no."), say("Signed, date"))
    fields = [*zip((25.0, 35.0, 25.0, 25.0, 35.0), captions, strict=True)]
    entities = _upright_fields(paper.content.corner - 12, fields, tell)
    if sheet == 1:
        upper = complex(paper.content.left - 12, paper.content.top - 120)
        entities += _upright_fields(upper, [(60.0, say("Reference no.")), (60.0, say("First used in"))], tell)
    box, aside = _number_box(paper), _has_upright_number(paper)
    inner: list[Ruling] = [(0, 0, 14, 0), (0, 0, 0, 70)] if aside else [(0, 0, 70, 0), (70, 0, 70, 14)]
    entities.append(rules(box.corner, inner, "frame"))
    start, turn = (box.corner + 14, 1j) if aside else (box.corner + (70 + 14j), -1 + 0j)
    return entities + _turned_texts(entry(title, "number", (0, 0, 70, 14), 5.0), start, turn)


def _upright_fields(corner: complex, fields: Sequence[tuple[float, Caption]], tell: Tell) -> list[Entity]:
    """Fields of a height [mm] one over another, each with its caption written from below upwards."""
    ends = np.cumsum([0.0, *(height for height, _ in fields)])
    high = float(ends[-1])
    lines: list[Ruling] = [(0, 0, 0, high), (5, 0, 5, high), *((0, y, 12, y) for y in ends)]
    entities: list[Entity] = [rules(corner, lines, "frame")]
    for (_, caption), (low, top) in zip(fields, pairwise(ends), strict=True):
        entities += _turned_texts(fitted_text(tell(caption), (0, 0, top - low, 5), 2.5), corner + 5 + 1j * low, 1j)
    return entities


def _turned_texts(texts: Iterable[Text], start: complex, turn: complex) -> list[Entity]:
    return [replace(text, at=start + turn * text.at, angle=cmath.phase(turn)) for text in texts]


def _references(paper: Format) -> list[Entity]:
    """The entities of ISO 5457: centring marks, and a border of 5 mm with fields of 50 mm counted from them."""
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
    """The ends of fields of 50 mm counted from the centre; the last one at each end takes the rest."""
    inner = [centre + 50.0 * k for k in range(-10, 11) if low + 25 < centre + 50.0 * k < high - 25]
    return [low, *inner, high]

"""The rulings of title blocks and margins enclose the standards' fields, and every text stands in its own."""

from __future__ import annotations

import re
from dataclasses import fields, replace
from itertools import pairwise

import numpy as np
import pytest
import shapely
from overlaps import overlaps
from scene import SHEETS, TITLE

from graphcam.errors import DesignError
from graphcam.language import language, languages
from graphcam.sheets.formats import FRAME_MARGINS, Format
from graphcam.sheets.layout import compose
from graphcam.sheets.model import Box, Entity, Stroke, Strokes, Text
from graphcam.sheets.sampling import box_of, corners, pieces
from graphcam.sheets.sheet_frame import (
    TitleBlock,
    entry,
    fitted_text,
    frame,
    gauge,
    gauge_box,
    stacked_lines,
    taken_boxes,
    title_block,
    title_box,
)
from graphcam.sheets.text_measures import width, wrap

Field = tuple[float, float, float, float]
EVERY = [Format(*each) for each in SHEETS]
NAMED = TitleBlock(**{field.name: field.name[:6].upper() for field in fields(TitleBlock)})


def enclosed(entities: list[Entity], *roles: str) -> set[Field]:
    """The rectangles that lines of these roles enclose: left, bottom, right, top."""
    lines = [
        shapely.LineString([(a.real, a.imag), (b.real, b.imag)])
        for e in entities
        if isinstance(e, Strokes) and e.role in roles
        for a, b in zip(e.starts, e.ends, strict=True)
    ]
    faces = shapely.polygonize(shapely.get_parts(shapely.unary_union(lines)).tolist())
    found = [face for face in faces.geoms if face.area == pytest.approx(shapely.box(*face.bounds).area)]
    return {tuple(round(x, 6) for x in face.bounds) for face in found}


def grid(across: list[float], up: list[float]) -> set[Field]:
    """The fields between lines at these places."""
    return {(a, c, b, d) for a, b in pairwise(across) for c, d in pairwise(up)}


def box_of_text(text: Text) -> Field:
    at = corners(text)
    return at.real.min(), at.imag.min(), at.real.max(), at.imag.max()


def centre(text: Text) -> complex:
    """Of the letters, by their capitals: where the text stands in its field."""
    return complex(corners(text).real.mean(), text.at.imag + text.height / 2)


def in_the_middle(text: Text, field: Field) -> bool:
    left, bottom, right, top = field
    return centre(text) == pytest.approx(complex((left + right) / 2, (bottom + top) / 2), abs=1e-9)


def inside(text: Text, field: Field) -> bool:
    (left, bottom, right, top), box = field, box_of_text(text)
    return left <= box[0] and bottom <= box[1] and box[2] <= right and box[3] <= top


GOST_LEFT = [0.0, 17.0, 40.0, 55.0, 65.0]
GOST = (
    # The table of changes has a column more, and the signatures below its head have none for the sheet.
    grid([0, 7, 17, 40, 55, 65], [30, 35, 40, 45, 50, 55])
    | grid(GOST_LEFT, [0, 5, 10, 15, 20, 25, 30])
    | {(65, 40, 185, 55), (65, 15, 135, 40), (65, 0, 135, 15), (135, 0, 185, 15)}
    # Stage in three parts, mass, scale, and the numbers of sheets below.
    | {(135, 35, 150, 40), (150, 35, 167, 40), (167, 35, 185, 40), (150, 20, 167, 35), (167, 20, 185, 35)}
    | grid([135, 140, 145, 150], [20, 35])
    | {(135, 15, 155, 20), (155, 15, 185, 20)}
)  # fmt: skip
"""Form 1 of GOST 2.104."""
GOST_ENTRIES = {
    "number": ((65, 40, 185, 55), 7.0),
    "name": ((67, 15, 133, 40), 5.0),
    "material": ((65, 0, 135, 15), 3.5),
    "mass": ((150, 20, 167, 35), 3.5),
    "scale": ((167, 20, 185, 35), 3.5),
    "organisation": ((135, 0, 185, 15), 3.5),
}
ISO = {
    "Responsible department": (0, 27, 48, 36),
    "Checked by": (48, 27, 84, 36),
    "Material": (84, 27, 120, 36),
    "Mass": (120, 27, 138, 36),
    "Scale": (138, 27, 156, 36),
    "Document status": (156, 27, 180, 36),
    "Legal owner": (0, 9, 48, 27),
    "Group": (0, 0, 48, 9),
    "Created by": (48, 13.5, 84, 27),
    "Approved by": (48, 0, 84, 13.5),
    "Title": (84, 0, 138, 27),
    "Identification number": (138, 9, 180, 27),
    "Rev.": (138, 0, 147, 9),
    "Date": (147, 0, 164, 9),
    "Sheet": (164, 0, 180, 9),
}
ISO_ENTRIES = {
    "checked": "Checked by",
    "material": "Material",
    "mass": "Mass",
    "scale": "Scale",
    "organisation": "Legal owner",
    "group": "Group",
    "author": "Created by",
    "approved": "Approved by",
    "name": "Title",
    "number": "Identification number",
}


def texts_of(entities: list[Entity]) -> list[Text]:
    return [e for e in entities if isinstance(e, Text)]


def test_the_rulings_of_form_1_enclose_its_fields():
    block = title_block("gost", 0j, NAMED, 1, 1)
    assert enclosed(block, "frame", "ruling") == GOST
    # Bold lines part what GOST 2.104 parts by bold ones: the rows of changes and signatures are thin.
    bold = enclosed(block, "frame")
    assert {(0, 30, 7, 35), (17, 0, 40, 30), (135, 20, 150, 35), (65, 15, 135, 40)} <= bold
    assert {(0, 25, 17, 30), (135, 20, 140, 35)} & bold == set()


def test_the_block_is_as_large_as_its_standard_says_and_stands_where_it_is_put():
    for kind, size in (("gost", (185, 55)), ("iso", (180, 36))):
        for corner in (0j, 100 + 50j):
            block = title_block(kind, corner, NAMED, 1, 1)
            box = box_of([e for e in block if isinstance(e, Strokes)])
            assert (box.corner, box.width, box.height) == (corner, *size)
            assert all(box.holds(box_of([text])) for text in texts_of(block))


def test_captions_of_form_1_stand_in_their_fields():
    texts = {t.text: t for t in texts_of(title_block("gost", 0j, TitleBlock(), 3, 12))}
    head = zip(("Ch.", "Sheet", "Document no.", "Signed", "Date"), pairwise((0, 7, 17, 40, 55, 65)), strict=True)
    for caption, (left, right) in head:
        assert in_the_middle(texts[caption], (left, 30, right, 35))
        assert texts[caption].height <= 2.0
    for bottom, caption in zip((25, 20, 15, 5, 0), ("Drawn", "Checked", "Tech.", "Norms", "Appr."), strict=True):
        field = (0, bottom, 17, bottom + 5)
        assert inside(texts[caption], field)
        assert (texts[caption].at.real, centre(texts[caption]).imag) == (1.0, bottom + 2.5)
        assert texts[caption].align == "left"
    for caption, field in {
        "Stage": (135, 35, 150, 40),
        "Mass": (150, 35, 167, 40),
        "Scale": (167, 35, 185, 40),
        "Sheet 3": (135, 15, 155, 20),
        "Sheets": (155, 15, 185, 20),
    }.items():
        assert in_the_middle(texts[caption], field)
        assert 2.0 < texts[caption].height <= 2.5
    assert len(texts) == 15


def test_entries_of_form_1_stand_in_their_fields():
    texts = {t.field: t for t in texts_of(title_block("gost", 0j, NAMED, 1, 1)) if t.field}
    for name, (field, height) in GOST_ENTRIES.items():
        assert in_the_middle(texts[name], field)
        assert inside(texts[name], field)
        assert texts[name].height == height
    for name, bottom in (("author", 25), ("checked", 20), ("approved", 0)):
        assert texts[name].at.real == 18.0
        assert centre(texts[name]).imag == bottom + 2.5
        assert texts[name].height == 2.5
    # The group has no field of its own, and stands with the school.
    assert set(texts) == {*GOST_ENTRIES, "author", "checked", "approved"}
    assert texts["organisation"].text == "ORGANI GROUP"


def test_the_rulings_of_the_iso_block_enclose_its_fields():
    block = title_block("iso", 0j, NAMED, 1, 1)
    assert enclosed(block, "frame", "ruling") == set(ISO.values())
    assert enclosed(block, "frame") == {(0, 0, 180, 36)}


def test_captions_and_entries_of_the_iso_block_stand_in_their_fields():
    texts = texts_of(title_block("iso", 0j, NAMED, 2, 3))
    captions = {t.text: t for t in texts if not t.field}
    entries = {t.field: t for t in texts if t.field}
    assert set(captions) == {*ISO, "2/3"}
    assert set(entries) == set(ISO_ENTRIES)
    for caption, field in ISO.items():
        assert captions[caption].at.real == field[0] + 1.0
        assert centre(captions[caption]).imag == pytest.approx(field[3] - 2.2, abs=1e-9)
        assert captions[caption].height <= 1.8
        assert inside(captions[caption], field)
    for name, caption in ISO_ENTRIES.items():
        left, bottom, right, top = ISO[caption]
        assert in_the_middle(entries[name], (left, bottom, right, top - 3.2))
        assert entries[name].height == (5.0 if name == "name" else 3.5)
    assert in_the_middle(captions["2/3"], (164, 0, 180, 5.8))
    assert captions["2/3"].height == 3.5


def loose(entities: list[Entity]) -> float:
    """The length of rulings that enclose nothing: ends that stand over, and lines that stand alone [mm]."""
    rulings = [e for e in entities if isinstance(e, Stroke | Strokes) and e.role in ("frame", "ruling")]
    lines = [
        shapely.LineString([(a.real, a.imag), (b.real, b.imag)])
        for ruling in rulings
        for a, b in zip(*pieces(ruling), strict=True)
    ]
    _, cuts, dangles, _ = shapely.polygonize_full(shapely.get_parts(shapely.unary_union(lines)).tolist())
    return cuts.length + dangles.length


@pytest.mark.parametrize("kind", [*FRAME_MARGINS])
def test_no_ruling_of_a_title_block_stands_over(kind):
    assert loose(title_block(kind, 0j, NAMED, 1, 1)) == 0
    over = Strokes(np.array([0j]), np.array([-1 + 0j]), "frame")
    assert loose([*title_block(kind, 0j, NAMED, 1, 1), over]) == 1


@pytest.mark.parametrize("paper", [paper for paper in EVERY if paper.frame == "gost"], ids=repr)
def test_no_ruling_of_a_frame_stands_over(paper):
    """Neither in the binding margin nor about the number in the corner; the marks of the gauge stand for themselves."""
    assert loose([*frame(paper, NAMED, 1, 1).entities]) == pytest.approx(loose(gauge(0j)))


@pytest.mark.parametrize("paper", [paper for paper in EVERY if paper.frame == "gost"], ids=repr)
def test_the_binding_margin_has_five_fields_of_the_standard_lengths_and_two_more_on_the_first_sheet(paper):
    first = [t for t in texts_of([*frame(paper, NAMED, 1, 2).entities]) if t.at.real < 20][5:]
    assert [t.text for t in first] == ["Reference no.", "First used in"]
    for text, low in zip(first, (120, 60), strict=True):
        assert corners(text).imag.mean() == pytest.approx(paper.content.top - low + 30)
    entities = [*frame(paper, NAMED, 2, 2).entities]
    left, bottom = paper.content.left - 12, paper.content.bottom
    ends = [bottom, bottom + 25, bottom + 60, bottom + 85, bottom + 110, bottom + 145]
    assert paper.content.left == 20
    margin = [e for e in entities if isinstance(e, Strokes) and e.role == "frame" and e.starts.real.max() <= 20]
    assert enclosed([*margin, *sides(paper)], "frame") >= grid([left, left + 5, left + 12], ends)
    lying = [t for t in texts_of(entities) if t.at.real < 20]
    captions = ["Orig. no.", "Signed, date", "Replaces no.", "Copy no.", "Signed, date"]
    assert [t.text for t in lying] == captions
    for text, (low, high) in zip(lying, pairwise(ends), strict=True):
        assert text.angle == pytest.approx(np.pi / 2)
        assert corners(text).imag.mean() == pytest.approx((low + high) / 2)
        # Half a capital to the left of the base line is the middle of the column.
        assert text.at.real - text.height / 2 == pytest.approx(left + 2.5)
        assert text.height <= 2.5


def sides(paper: Format) -> list[Entity]:
    """The left side of the frame, as a line beside the margin."""
    inside = paper.content
    return [Strokes(np.array([inside.corner]), np.array([complex(inside.left, inside.top)]), "frame")]


@pytest.mark.parametrize("paper", [paper for paper in EVERY if paper.frame == "gost"], ids=repr)
def test_the_number_stands_once_more_in_the_corner_that_is_filed_on_top(paper):
    entities, inside_frame = [*frame(paper, NAMED, 1, 1).entities], paper.content
    (number,) = (t for t in texts_of(entities) if t.field == "number" and t.angle)
    aside = paper.is_upright and paper.name != "A4"
    # Beside the binding margin where the sheet lies when filed, else at the right.
    field = (
        (inside_frame.right - 14, inside_frame.top - 70, inside_frame.right, inside_frame.top)
        if aside
        else (inside_frame.left, inside_frame.top - 14, inside_frame.left + 70, inside_frame.top)
    )
    assert number.angle == pytest.approx(np.pi / 2 if aside else np.pi)
    assert number.height == 5.0
    up = 1j * np.exp(1j * number.angle)
    middle = complex((field[0] + field[2]) / 2, (field[1] + field[3]) / 2)
    assert number.at + up * number.height / 2 == pytest.approx(middle, abs=1e-9)
    edges = [Stroke(np.array(inside_frame.corners), "frame", closed=True)]
    whole = [*(strokes(edge) for edge in edges), *(e for e in entities if isinstance(e, Strokes))]
    assert field in enclosed(whole, "frame")
    assert Box(*field).grown(4.0) in taken_boxes(paper, 4.0)
    # Two lines part it from the sheet, and end where it ends.
    assert Box(*field) in [box_of([e]) for e in entities if isinstance(e, Strokes) and len(e.starts) == 2]


def strokes(outline: Stroke) -> Strokes:
    return Strokes(outline.points, np.roll(outline.points, -1), outline.role)


@pytest.mark.parametrize("paper", [paper for paper in EVERY if paper.frame == "iso"], ids=repr)
def test_the_border_of_references_is_divided_from_the_centre_in_fields_of_50_mm(paper):
    """ISO 5457: a border of 5 mm, figures across and letters from above, none of them I or O."""
    entities, inner = [*frame(paper, NAMED, 1, 1).entities], paper.content
    outer, middle = inner.grown(5), complex(*paper.size) / 2
    across = ends_of_fields(middle.real, inner.left, inner.right)
    up = ends_of_fields(middle.imag, inner.bottom, inner.top)
    border = [strokes(e) for e in entities if isinstance(e, Stroke)]
    assert {e.role for e in border} == {"frame", "ruling"}
    corner = [Strokes(np.array(inner.corners), np.array(outer.corners), "ruling")]
    cuts = [e for e in entities[1:] if isinstance(e, Strokes) and e.role == "ruling"][:4]
    faces = shapely.polygonize(
        shapely.get_parts(
            shapely.unary_union(
                [
                    shapely.LineString([(a.real, a.imag), (b.real, b.imag)])
                    for e in [*border, *corner, *cuts]
                    for a, b in zip(e.starts, e.ends, strict=True)
                ]
            )
        ).tolist()
    )
    letters = [t for t in texts_of(entities) if t.height == 2.5 and len(t.text) <= 2 and not inner.holds(box_of([t]))]
    # A field and a reference for each, on both sides; the frame itself encloses one more.
    assert len(faces.geoms) == 2 * (len(across) + len(up) - 2) + 1
    figures, names = [str(k + 1) for k in range(len(across) - 1)], "ABCDEFGHJKLMNPQRSTUVWXYZ"[: len(up) - 1]
    for edge in (inner.bottom - 2.5, inner.top + 2.5):
        row = {t.text: t.at for t in letters if t.at.imag == edge - 1.25}
        middles = [complex((a + b) / 2, edge - 1.25) for a, b in pairwise(across)]
        assert row == pytest.approx(dict(zip(figures, middles, strict=True)))
    for edge in (inner.left - 2.5, inner.right + 2.5):
        column = {t.text: t.at for t in letters if t.at.real == edge}
        middles = [complex(edge, (a + b) / 2 - 1.25) for b, a in pairwise(up[::-1])]
        assert column == pytest.approx(dict(zip(names, middles, strict=True)))
    assert {t.align for t in letters} == {"center"}
    assert len(letters) == 2 * (len(across) + len(up) - 2)


def ends_of_fields(centre: float, low: float, high: float) -> list[float]:
    """Every 50 mm from the centre to both sides; what is left at an end is part of the last field if it is short."""
    cuts = [x for x in np.arange(centre - 1000, centre + 1001, 50) if low < x < high]
    return [low, *(x for x in cuts if x - low > 25 and high - x > 25), high]


@pytest.mark.parametrize("paper", [paper for paper in EVERY if paper.frame == "iso"], ids=repr)
def test_centring_marks_run_ten_mm_from_the_border_into_the_sheet(paper):
    marks = next(e for e in frame(paper, NAMED, 1, 1).entities if isinstance(e, Strokes) and e.role == "frame")
    (wide, high), inner = paper.size, paper.content
    expected = {
        (wide / 2, inner.top + 5, wide / 2, inner.top - 5),
        (wide / 2, inner.bottom - 5, wide / 2, inner.bottom + 5),
        (inner.left - 5, high / 2, inner.left + 5, high / 2),
        (inner.right + 5, high / 2, inner.right - 5, high / 2),
    }
    assert {(a.real, a.imag, b.real, b.imag) for a, b in zip(marks.starts, marks.ends, strict=True)} == expected
    kept = taken_boxes(paper, 4.0)[2:]
    for x1, y1, x2, y2 in expected:
        assert any(
            (min(x1, x2) - 1, min(y1, y2) - 1, max(x1, x2) + 1, max(y1, y2) + 1)
            == (box.left, box.bottom, box.right, box.top)
            for box in kept
        )


@pytest.mark.parametrize("paper", EVERY, ids=repr)
def test_nothing_else_stands_on_the_room_of_title_block_and_gauge(paper):
    entities = [*frame(paper, NAMED, 1, 1).entities]
    block, rule = taken_boxes(paper, 4.0)[:2]
    assert block == title_box(paper).grown(4.0)
    assert (title_box(paper).right, title_box(paper).bottom) == (paper.content.right, paper.content.bottom)
    (line,) = (e for e in entities if isinstance(e, Strokes) and e.role == "gauge")
    at = complex(line.starts[0])
    assert rule == gauge_box(at).grown(4.0)
    # In the lower left corner, where the title block leaves room, else above it.
    beside = paper.content.left + 7 + 105 < title_box(paper).left
    assert at == complex(paper.content.left + 7, paper.content.bottom + 5 if beside else title_box(paper).top + 5)
    assert overlaps(compose([], [], NAMED, paper.name, paper.frame, orientation=paper.orientation)) == []


def test_the_gauge_is_a_rule_of_100_mm_with_a_line_every_10():
    line, ticks, *texts = gauge(7 + 5j)
    assert isinstance(line, Strokes)
    assert isinstance(ticks, Strokes)
    assert (line.starts.tolist(), line.ends.tolist()) == ([7 + 5j], [107 + 5j])
    assert ticks.starts.tolist() == [7 + 10 * k + 5j for k in range(11)]
    assert [(z.real, z.imag) for z in ticks.ends - ticks.starts] == [(0, 3.0 if k % 5 == 0 else 1.5) for k in range(11)]
    numbers, (said,) = texts[:3], texts[3:]
    assert [(t.text, t.at) for t in numbers] == [("0", 7 + 9j), ("50", 57 + 9j), ("100", 107 + 9j)]
    assert (said.text, said.at, said.height, said.align) == ("mm, true to scale", 82 + 9j, 2.5, "center")
    assert {(t.height, t.align) for t in numbers} == {(2.5, "center")}
    room = gauge_box(7 + 5j)
    assert room.holds(box_of([line, ticks, *texts]))
    assert (room.left, room.bottom, room.right, room.top) == (3, 3, 112, 13)


@pytest.mark.parametrize("align", ["center", "left"])
def test_a_text_is_broken_into_lines_before_it_is_set_smaller(align):
    text = "two words"
    wide = width(text, 5.0)
    # Width and height of a field, and what fits: the words side by side, one over the other, both in smaller letters.
    for room, tall, lines, height in ((wide, 40, 1, 5.0), (0.9 * wide, 40, 2, 5.0), (0.9 * wide, 9, 1, 3.5)):
        found = fitted_text(text, (10.0, 20.0, 12.0 + room + 1e-9, 20.0 + tall), 5.0, align)
        assert (len(found), {line.height for line in found}) == (lines, {height})
        assert all(inside(line, (11.0 - 1e-9, 20.0, 11.0 + room + 1e-6, 20.0 + tall)) for line in found)
        left, middle = 11.0, (22.0 + room) / 2
        assert [line.at.real for line in found] == pytest.approx([left if align == "left" else middle] * lines)
        assert {line.align for line in found} == {align}


def test_a_broken_text_stands_in_the_middle_of_its_field_in_the_largest_standard_letters_that_fit():
    words = ["cam", "mechanism", "of", "an", "engine"]
    field = (0.0, 0.0, 30.0, 14.0)
    found = fitted_text(" ".join(words), field, 7.0)
    height = found[0].height
    assert height == 2.5
    assert " ".join(line.text for line in found) == " ".join(words)
    assert max(width(line.text, height) for line in found) <= 28.0
    # In letters a size larger the widest word fits, but not all lines.
    assert len(wrap(" ".join(words), 3.5, 28.0)) * 1.5 * 3.5 > 14.0
    assert {round(a.at.imag - b.at.imag, 9) for a, b in pairwise(found)} == {round(1.5 * height, 9)}
    assert (found[0].at.imag + height + found[-1].at.imag) / 2 == pytest.approx(7.0)


def test_a_word_is_broken_only_where_it_fits_no_other_way():
    field = (0.0, 0.0, 22.0, 14.0)
    (whole,) = fitted_text("mechanism", field, 3.5)
    assert (whole.text, whole.height) == ("mechanism", 2.5)
    first, *rest = fitted_text("counterbalanced" * 2, field, 3.5)
    assert first.text.endswith("-")
    assert "".join(line.text.removesuffix("-") for line in (first, *rest)) == "counterbalanced" * 2
    # Behind a sign of its own, no other is set; between ideographs none.
    assert (
        "".join(line.text for line in fitted_text("ТММ.01.02.000-КП-ХХ-00001", field, 3.5))
        == "ТММ.01.02.000-КП-ХХ-00001"
    )
    assert "".join(line.text for line in fitted_text("凸轮机构" * 6, field, 3.5)) == "凸轮机构" * 6


@pytest.mark.slow
@pytest.mark.parametrize("frame_name", ["gost", "iso"])
def test_what_fits_its_field_in_no_standard_letters_is_refused_by_its_name_and_length(frame_name):
    for name in ("author", "name", "document", "organisation"):
        field = "number" if name == "document" else name
        with pytest.raises(
            DesignError, match=rf"length of title\.{name} is 600, but must be at most \d+ letters"
        ) as error:
            title_block(frame_name, 0j, TitleBlock(**{field: "long " * 120}), 1, 1)
        fits = int(re.search(r"most (\d+)", str(error.value))[1])
        assert title_block(frame_name, 0j, TitleBlock(**{field: ("long " * 120)[:fits]}), 1, 1)


@pytest.mark.parametrize("tell", [language(name).text for name in languages()], ids=languages())
@pytest.mark.parametrize("paper", EVERY, ids=repr)
def test_an_empty_sheet_is_lettered_in_standard_heights(paper, tell):
    heights = {e.height for e in frame(paper, NAMED, 1, 1, tell).entities if isinstance(e, Text)}
    assert heights <= {1.8, 2.5, 3.5, 5.0, 7.0}


def test_nothing_is_written_of_what_is_empty():
    assert fitted_text("", (0, 0, 10, 10), 3.5) == []
    assert [t.at for t in stacked_lines(["a", "", "b"], 10 + 10j, 1.5, 2.0, "left")] == [10 + 10j, 10 + 4j]
    (text,) = entry(replace(TITLE, mass="3 kg"), "mass", (0, 0, 20, 10), 3.5)
    assert (text.text, text.field) == ("3 kg", "mass")

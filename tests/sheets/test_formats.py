"""Frames and title blocks have the sizes of ISO 5457, ISO 7200, GOST 2.301 and GOST 2.104."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from overlaps import overlaps
from scene import TITLE

from graphcam.errors import DesignError
from graphcam.sheets.formats import FRAME_MARGINS, SHEET_SIZES, Format
from graphcam.sheets.layout import compose
from graphcam.sheets.model import Stroke, Strokes, Text
from graphcam.sheets.sheet_frame import BLOCK_SIZES as BLOCKS, frame, title_block, title_box
from graphcam.sheets.text_measures import width

EVERY = [(paper, kind) for paper in SHEET_SIZES for kind in FRAME_MARGINS]


@pytest.mark.parametrize(
    ("paper", "kind", "left", "bottom", "wide", "high"),
    [("A3", "iso", 20, 10, 390, 277), ("A1", "iso", 20, 10, 811, 574), ("A1", "gost", 20, 5, 816, 584),
     ("A4", "gost", 20, 5, 185, 287), ("A4", "iso", 20, 10, 267, 190)],
)  # fmt: skip
def test_frame_is_where_the_standard_puts_it(
    paper: str, kind: str, left: float, bottom: float, wide: float, high: float
) -> None:
    outline = frame(Format(paper, kind), TITLE, 1, 1).entities[0]
    assert isinstance(outline, Stroke)
    assert (outline.points.real.min(), outline.points.imag.min()) == (left, bottom)
    assert (np.ptp(outline.points.real), np.ptp(outline.points.imag)) == (wide, high)


def test_gost_block_is_form_1() -> None:
    bold = title_block("gost", 0j, TITLE, 1, 1)[0]
    assert isinstance(bold, Strokes)
    points = np.concatenate([bold.starts, bold.ends])
    assert (np.ptp(points.real), np.ptp(points.imag)) == (185, 55)
    upright = bold.starts.real == bold.ends.real
    assert {7, 17, 40, 55, 65} <= set(bold.starts.real[upright].tolist())


def test_rows_of_the_gost_block_are_5_mm() -> None:
    bold, thin = title_block("gost", 0j, TITLE, 1, 1)[:2]
    assert isinstance(bold, Strokes)
    assert isinstance(thin, Strokes)
    level = [
        y
        for lines in (bold, thin)
        for a, b, y in zip(lines.starts.real, lines.ends.real, lines.starts.imag, strict=True)
        if min(a, b) == 0 and max(a, b) >= 65
    ]
    assert sorted(set(level)) == list(range(0, 56, 5))


@pytest.mark.parametrize("kind", BLOCKS)
def test_block_stands_in_the_corner_and_names_the_sheet(kind: str) -> None:
    paper = Format("A2", kind)
    box = title_box(paper)
    assert (box.right, box.bottom) == (paper.content.right, paper.content.bottom)
    texts = {e.text for e in title_block(kind, box.corner, TITLE, 2, 3) if isinstance(e, Text)}
    assert {"Cam mechanism", "ТММ.01.02", "Ivanova"} <= texts
    # GOST 2.104: the number of sheets stands on the first alone, and a single sheet has no number.
    assert ({"Sheet 2", "Sheets"} if kind == "gost" else {"2/3"}) <= texts
    for of, told in ((3, {"Sheet 1", "Sheets 3"}), (1, {"Sheet", "Sheets 1"})):
        texts = {e.text for e in title_block(kind, box.corner, TITLE, 1, of) if isinstance(e, Text)}
        assert (told if kind == "gost" else {f"1/{of}"}) <= texts


@pytest.mark.parametrize(("paper", "kind"), EVERY)
def test_empty_sheet_has_no_text_on_a_line(paper: str, kind: str) -> None:
    """Long names are broken into lines that fit their fields."""
    title = type(TITLE)(
        name="Cam mechanism of a reciprocating internal combustion engine", number="ТММ.01.02.03.000",
        organisation="Department of the Theory of Machines and Mechanisms", group="ME-31",
        author="Konstantinopolskaya", checked="Ivanov-Petrov", scale="1:2.5",
    )  # fmt: skip
    drawn = compose([], [], title, paper, kind)
    assert len(drawn.pages) == 1
    assert overlaps(drawn) == []


@pytest.mark.parametrize(
    "name",
    [
        "Ivanova M. P.",
        "Dr. Christodoulopoulos",
        "Prof. M. A. von Hohenstein",
    ],
)
def test_names_in_the_gost_block_stand_beside_their_captions_whole(name: str) -> None:
    texts = [e for e in title_block("gost", 0j, replace(TITLE, author=name), 1, 1) if isinstance(e, Text)]
    (drawn,) = (e for e in texts if e.text == "Drawn")
    # The row of "Drawn", in the column from 17 to 40 mm.
    written = [e for e in texts if 17 <= e.at.real < 40 and 25 <= e.at.imag < 30]
    assert 25 < drawn.at.imag < 30
    assert " ".join(e.text for e in written).replace("- ", "") == name
    assert max(e.at.real + width(e.text, e.height) for e in written) <= 40


def test_group_in_the_iso_block_has_a_field_of_its_own() -> None:
    texts = [e for e in title_block("iso", 0j, replace(TITLE, group="ME-31"), 1, 1) if isinstance(e, Text)]
    assert [e.text for e in texts if e.at.real < 48 and e.at.imag > 27] == ["Responsible department"]
    assert [e.text for e in texts if 48 <= e.at.real < 84 and 13.5 < e.at.imag < 27] == ["Created by", "Ivanova"]
    assert [e.text for e in texts if e.at.real < 48 and e.at.imag < 9] == ["Group", "ME-31"]


@pytest.mark.parametrize(("paper", "kind", "quantity"), [("A7", "gost", "format"), ("A3", "din", "frame")])
def test_unknown_paper_is_named(paper: str, kind: str, quantity: str) -> None:
    with pytest.raises(DesignError) as error:
        Format(paper, kind)
    assert error.value.quantity == quantity


def test_a4_of_gost_stands_upright_and_the_title_block_fills_its_short_side() -> None:
    """GOST 2.301: a sheet A4 is used upright only; GOST 2.104: its title block stands along the short side."""
    for asked in (None, "portrait"):
        paper = Format("A4", "gost", asked)
        assert paper.is_upright
        assert paper.size == (210, 297)
        assert (title_box(paper).left, title_box(paper).right) == (paper.content.left, paper.content.right)
    with pytest.raises(DesignError, match=r"GOST 2\.301 uses A4 in portrait only; leave orientation out"):
        Format("A4", "gost", "landscape")
    # Every other sheet lies unless it is to stand.
    assert [sheet for sheet in EVERY if Format(*sheet).is_upright] == [("A4", "gost")]

"""Tables and notes: every cell in its ruled field, no field wider or higher than its texts need."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from graphcam.sheets.model import Strokes, Text
from graphcam.sheets.sampling import box_of
from graphcam.sheets.tables import BASE_DEPTH, Block, Table, notes_block, table_block
from graphcam.sheets.text_measures import width, wrap

HEIGHT = 3.5
PLAIN = Table("Data", ("quantity", "value", "drawn"), (("lift", "30 mm", "1"), ("prime radius r0", "44 mm", "2")))
LONG = "Which of all the rollers that the limits permit is the largest one here?"


def texts(block: Block) -> dict[str, Text]:
    return {e.text: e for e in block.entities + block.answers if isinstance(e, Text)}


def level_and_upright(
    block: Block, role: str
) -> tuple[dict[float, tuple[float, float]], dict[float, tuple[float, float]]]:
    """Level lines by their height and upright ones by their place, each with its two ends."""
    level, upright = {}, {}
    for e in block.entities:
        if isinstance(e, Strokes) and e.role == role:
            for a, b in zip(e.starts, e.ends, strict=True):
                if a.imag == b.imag:
                    level[round(a.imag, 9)] = tuple(sorted((a.real, b.real)))
                else:
                    assert a.real == b.real
                    upright[round(a.real, 9)] = tuple(sorted((a.imag, b.imag)))
    return level, upright


def columns(table: Table, height: float) -> list[float]:
    """Where the columns of cells in one line end: as wide as the widest of them and one and a half heights."""
    rows = [row for row in (table.header, *table.rows) if any(map(str, row))]
    wide = [max(width(str(row[k]), height) for row in rows) + 1.5 * height for k in range(len(table.header))]
    wide[-1] += max(0.0, width(str(table.title), height) - sum(wide))
    return [0.0, *np.cumsum(wide)]


@pytest.mark.parametrize("height", [HEIGHT, 2.5])
def test_a_table_is_ruled_about_its_cells(height):
    block = table_block(PLAIN, height)
    ends, rows = columns(PLAIN, height), [0.0, 2.2 * height, 4.4 * height, 6.6 * height]
    bold_level, bold_upright = level_and_upright(block, "table")
    thin_level, thin_upright = level_and_upright(block, "ruling")
    # Bold about the whole and below the header, thin between.
    assert sorted(bold_level) == pytest.approx([rows[0], rows[2], rows[3]])
    assert sorted(bold_upright) == pytest.approx([ends[0], ends[-1]])
    assert sorted(thin_level) == pytest.approx([rows[1]])
    assert sorted(thin_upright) == pytest.approx(ends[1:-1])
    assert all(each == pytest.approx((0, ends[-1])) for each in [*bold_level.values(), *thin_level.values()])
    assert all(each == pytest.approx((0, rows[-1])) for each in [*bold_upright.values(), *thin_upright.values()])
    assert block.box.corner == 0
    assert (block.box.width, block.box.height) == pytest.approx((ends[-1], 8.6 * height))
    said = texts(block)
    assert (said["Data"].at, said["Data"].align) == (pytest.approx(7.3j * height), "left")
    for row, low in zip((*PLAIN.rows[::-1], PLAIN.header), rows, strict=False):
        for k, cell in enumerate(row):
            text = said[cell]
            assert text.at.imag + BASE_DEPTH * height == pytest.approx(low + 1.1 * height)
            assert text.align == ("center" if k else "left")
            assert text.at.real == pytest.approx((ends[k] + ends[k + 1]) / 2 if k else 0.75 * height)
    assert all(text.height == height for text in said.values())
    assert block.box.holds(box_of(block.entities))


def test_a_table_is_as_wide_as_its_title():
    titled = Table("A title that is wider than the two columns below it", ("a", "b"), (("1", "2"),))
    block = table_block(titled, HEIGHT)
    assert block.box.width == pytest.approx(width(str(titled.title), HEIGHT))
    assert block.box.width == pytest.approx(columns(titled, HEIGHT)[-1])


def test_a_table_without_a_header_has_no_bold_line_inside():
    block = table_block(Table("T", ("", ""), (("1", "a"), ("2", "b"))), HEIGHT)
    bold, _ = level_and_upright(block, "table")
    thin, _ = level_and_upright(block, "ruling")
    assert sorted(bold) == pytest.approx([0.0, 4.4 * HEIGHT])
    assert sorted(thin) == pytest.approx([2.2 * HEIGHT])
    assert texts(block)["1"].at.imag == pytest.approx((2.2 + 1.1 - BASE_DEPTH) * HEIGHT)


def test_a_table_of_one_cell_needs_no_thin_line():
    block = table_block(Table("T", ("",), (("1",),)), HEIGHT)
    assert [e.role for e in block.entities if isinstance(e, Strokes)] == ["table"]


def test_a_long_name_is_broken_and_its_row_is_higher_by_its_lines():
    table = Table("T", ("question", "answer"), ((LONG, "30"), ("short", "1")))
    block = table_block(table, HEIGHT)
    lines = wrap(LONG, HEIGHT, 40 * HEIGHT)
    assert len(lines) == 2
    high = 2.2 * HEIGHT + 1.5 * HEIGHT
    level, _ = level_and_upright(block, "table")
    assert sorted(level) == pytest.approx([0.0, 2.2 * HEIGHT + high, 4.4 * HEIGHT + high])
    said = texts(block)
    middle = 2.2 * HEIGHT + high / 2
    assert said["30"].at.imag + BASE_DEPTH * HEIGHT == pytest.approx(middle)
    first, second = (said[line].at for line in lines)
    assert first.imag - second.imag == pytest.approx(1.5 * HEIGHT)
    assert (first.imag + second.imag) / 2 + BASE_DEPTH * HEIGHT == pytest.approx(middle)
    assert {first.real, second.real} == {0.75 * HEIGHT}
    # As wide as the widest of its lines.
    answers = max(width(cell, HEIGHT) for cell in ("answer", "30"))
    assert block.box.width == pytest.approx(max(width(line, HEIGHT) for line in lines) + answers + 3 * HEIGHT)
    # What is just not longer than 40 letters are high stays whole.
    name = "n" * int(40 * HEIGHT / width("n", HEIGHT))
    assert name in texts(table_block(Table("T", ("", ""), ((name, "1"),)), HEIGHT))


def test_a_header_wider_than_its_column_is_broken_into_lines():
    header = "quantity as it was measured"
    block = table_block(Table("T", (header, "b"), (("lift", "1"),)), HEIGHT)
    lines = wrap(header, HEIGHT, 0.6 * width(header, HEIGHT))
    assert len(lines) == 2
    assert set(lines) <= set(texts(block))
    # As wide as what stands below it, if that is more.
    wide = "w" * 30
    assert header in texts(table_block(Table("T", (header, "b"), ((wide, "1"),)), HEIGHT))
    assert width(wide, HEIGHT) > width(header, HEIGHT)


def test_answers_are_kept_apart_and_left_out_of_a_worksheet():
    table = Table(PLAIN.title, PLAIN.header, PLAIN.rows, frozenset({(0, 1), (1, 2)}))
    block = table_block(table, HEIGHT)
    assert [e.text for e in block.answers] == ["30 mm", "2"]
    whole = {e.text: e.at for e in block.drawn(10 + 5j) if isinstance(e, Text)}
    assert whole == {text: each.at + 10 + 5j for text, each in texts(block).items()}
    unanswered = [e for e in block.drawn(10 + 5j, answered=False) if isinstance(e, Text)]
    assert {e.text for e in unanswered} == set(whole) - {"30 mm", "2"}


def test_a_table_is_told_cell_by_cell():
    told = Table(PLAIN.title, PLAIN.header, PLAIN.rows, frozenset({(0, 1)})).translated(lambda words: f"<{words}>")
    assert (told.title, told.header) == ("<Data>", ("<quantity>", "<value>", "<drawn>"))
    assert told.rows[1] == ("<prime radius r0>", "<44 mm>", "<2>")
    assert told.answers == {(0, 1)}


@pytest.mark.parametrize("height", [HEIGHT, 2.5])
def test_notes_stand_one_under_the_other_with_their_lines_indented(height):
    room = 60.0 * height / 3.5
    block = notes_block(["A long note that does not fit one line of this width.", "Short."], height, room)
    said = [e for e in block.answers if isinstance(e, Text)]
    assert block.entities == ()
    assert [text.text[:2] for text in said if not text.at.real] == ["1.", "2."]
    assert {text.at.real for text in said[1:-1]} == {1.8 * height}
    assert len(said) > 3
    assert all(text.at.real + width(text.text, height) <= room for text in said)
    # A word more would not have fitted.
    for line, following in pairwise(said[:-1]):
        assert width(f"{line.text} {following.text.split()[0]}", height) > room - 1.8 * height
    assert {round(a.at.imag - b.at.imag, 9) for a, b in pairwise(said)} == {round(1.7 * height, 9)}
    assert said[-1].at.imag == 0
    assert {text.height for text in said} == {height}
    top = (len(said) - 1) * 1.7 * height
    assert (block.box.left, block.box.bottom, block.box.right) == (0, -0.4 * height, room)
    assert block.box.top == pytest.approx(top + 1.3 * height)

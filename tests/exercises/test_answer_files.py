"""What a text file answers, against the reader of TOML in the standard library."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st
from issued_variants import issued

from graphcam.errors import UnreadableError
from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.exercises.reading.answer_tables import COMMA_PATTERN, toml_values
from graphcam.exercises.reading.submission_files import from_files, read_files

NUMBERS = st.recursive(
    st.integers(-(10**20), 10**20).map(str) | st.floats(allow_nan=False, allow_infinity=False).map(repr),
    lambda values: st.lists(values, max_size=3).map(lambda items: "[" + ", ".join(items) + "]"),
)
LINES = st.tuples(st.sampled_from("abc"), st.sampled_from(["=", " = ", "\t="]), NUMBERS).map("".join)
SCRAPS = st.text('ab1-+.eE,[]= _#"\n\r\t', max_size=12)
"""Half-written lines, and what only one of the two readers takes."""


@settings(max_examples=400, deadline=None)
@given(st.lists(LINES | LINES | SCRAPS, max_size=4), st.sampled_from(["\n", "\r\n"]))
def test_a_file_says_what_the_standard_library_reads(lines: list[str], end: str):
    agree(end.join(lines))


def agree(text: str) -> None:
    try:
        meant = repr(tomllib.loads(COMMA_PATTERN.sub(r"\1.\2", text)))
    except ValueError:
        try:
            found = toml_values("answers.toml", text.encode())
        except UnreadableError:
            return
        assert any(isinstance(value, UnreadableError | str) for value in found.values())
    else:
        assert repr(toml_values("answers.toml", text.encode())) == meant


@pytest.mark.parametrize(
    "number", ["1_000", "0x10", "+1.5", "01", "1.", "inf", "1e400", "true", "1, 2", "[1 2]", "[1,]"]
)
def test_a_number_is_one_of_toml_not_of_json(number: str):
    agree(f"a = {number}")


FILE = """# by Anna
a = 1.5
b = {bad}
c = [[1, 2],
     [3, 4]]
d = 2,5
"""


@pytest.mark.parametrize("bad", ["2 4", "", "1.2.3", "[1, 2", "1 # one\nhello", "1\nb = 2", "[" * 5000, "9" * 5000])
def test_a_bad_line_loses_its_own_answer_only(bad: str):
    found = toml_values("answers.toml", FILE.format(bad=bad).encode())
    assert (found["a"], found["d"]) == (1.5, 2.5)
    assert found["c"] == [[1, 2], [3, 4]]
    lost = [name for name, value in found.items() if isinstance(value, UnreadableError)]
    assert lost == (["hello"] if "hello" in bad else ["b"])


def test_a_bad_line_of_the_table_of_answers_is_told_with_its_number():
    found = toml_values("answers.toml", b"note = 3\n[answers]\na = 1\nb = 2 4\n")
    assert found.pop("b").why.values["line"] == 4
    assert found == {"a": 1}


def test_a_dotted_key_that_a_text_hid_is_not_read_by_itself():
    """It takes tomllib minutes; in the whole file it stands in a text, by itself it would be a key."""
    hidden = "x" + ".x" * 15_000 + " = 1"
    found = toml_values("answers.toml", f'a = """\n{hidden}\n"""\nb = 2 4\nc = 3'.encode())
    assert found["c"] == 3
    assert isinstance(found["x" + ".x" * 15_000], UnreadableError)


@pytest.mark.parametrize(
    ("there", "read", "said"),
    [
        ({"Answers.toml": "1"}, "1", "Answers.toml is read as answers.toml"),
        ({"answers.toml.txt": "1"}, "1", "answers.toml.txt is read as answers.toml"),
        ({"answers (1).toml": "1"}, "1", "answers (1).toml is read as answers.toml"),
        ({"answers.toml": "1", "answers-1.toml": "2"}, "1", "answers-1.toml is not read, since there is answers.toml"),
        (
            {"answers (1).toml": "1", "answers (2).toml": "2"},
            None,
            "none of answers (1).toml, answers (2).toml is read: rename the right one to answers.toml",
        ),
        ({"my answers.toml": "1"}, None, "there is none of answers.toml, answers.csv, answers.ipynb, answers.dxf"),
    ],
)
def test_a_file_that_is_called_otherwise_is_read_or_told(
    tmp_path: Path, there: dict[str, str], read: str | None, said: str
):
    for name, text in there.items():
        (tmp_path / name).write_text(text)
    files, notes = read_files(tmp_path)
    assert files == ({} if read is None else {"answers.toml": read.encode()})
    assert [str(note) for note in notes] == [said]


def test_a_link_that_is_called_otherwise_is_not_followed(tmp_path: Path):
    (tmp_path / "key").write_text("1")
    (tmp_path / "Answers.toml").symlink_to("key")
    files, notes = read_files(tmp_path)
    assert files == {}
    assert "Answers.toml is a link; hand in the file itself" in map(str, notes)


def test_a_bad_line_that_names_no_answer_is_told():
    asked = issued("acceleration-and-scales")[0].answers
    text = f"{asked[0].name} = 1.5\nhello there\n{asked[1].name} = 2 4\n"
    answers = from_files(asked, {"answers.toml": text.encode()})
    assert answers.values == {asked[0].name: 1.5}
    assert list(answers.problems) == [asked[1].name]
    assert any("line 2 is not valid TOML" in str(note) for note in answers.notes)


def answered(text: str, file: str = "answers.toml"):
    return from_files(ASKED, {file: text.encode()})


ASKED = (
    AskedAnswer("s0", "", "pressure_angle", "s0", unit="mm"),
    AskedAnswer("v_4", "", "integration", "v", unit="mm/rad"),
    AskedAnswer("mu", "", "pressure_angle", "angle", unit="deg"),
)


@pytest.mark.parametrize(
    "text",
    [
        "s0 = 37.1 mm",
        "s0 = 37,1 мм  # измерено",
        "s0=37.1mm",
        's0 = "37.1 mm"',
        "S0 = 37.1",
        "s_0 = 37.1 mm",
        "# s0 = 37.1",
    ],
)
def test_an_answer_is_read_as_people_type_it(text: str):
    found = answered(f"{text}\nv_4 = \u221247,6 (mm/rad)\nmu = 12.5°")
    assert found.values == {"s0": 37.1, "v_4": -47.6, "mu": 12.5}
    assert found.problems == {}


def test_what_is_read_otherwise_than_it_stands_there_is_told():
    found = answered("# s0 = 37.1\nV4 = 2")
    assert [str(note) for note in found.notes] == [
        "the name V4 is read as v_4",
        "s0 is read, though the # was left in before it",
    ]


def test_another_unit_than_is_asked_for_is_no_answer():
    found = answered("s0 = 3.71 cm\nv_4 = 2")
    assert found.values == {"v_4": 2}
    assert str(found.problems["s0"].template) == "{answer} has the unit {given}, but is asked in {unit}"


@pytest.mark.parametrize("text", ["S0 = 1\ns_0 = 2", "# s0 = 1\n# s0 = 2", "# s0 =", "## s0 = 5", "# s0 = 5 is long"])
def test_what_may_mean_either_is_not_read(text: str):
    assert answered(text).values == {}


def test_a_name_of_its_own_comes_before_a_similar_one():
    assert answered("s0 = 1\nS0 = 2\n# s0 = 3").values == {"s0": 1}


def test_a_table_of_a_spreadsheet_may_have_units():
    assert answered("answer;value\ns0;37,1 mm\nV4;\u221247,6", "answers.csv").values == {"s0": 37.1, "v_4": -47.6}


def test_a_notebook_may_have_units():
    cell = {"cell_type": "code", "metadata": {"tags": ["answers"]}, "source": "s0 = 37.1 mm\nv_4 = \u221247.6"}
    assert answered(json.dumps({"cells": [cell]}), "answers.ipynb").values == {"s0": 37.1, "v_4": -47.6}

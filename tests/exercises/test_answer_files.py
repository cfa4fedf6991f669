"""What a text file answers, against the reader of TOML in the standard library."""

from __future__ import annotations

import tomllib

import pytest
from hypothesis import given, settings, strategies as st

from graphcam.exercises.reading.answer_tables import DECIMAL_COMMA, toml_values
from graphcam.exercises.reading.regular_file import UnreadableError

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
        meant = repr(tomllib.loads(DECIMAL_COMMA.sub(r"\1.\2", text)))
    except ValueError:
        with pytest.raises(UnreadableError):
            toml_values("answers.toml", text.encode())
    else:
        assert repr(toml_values("answers.toml", text.encode())) == meant


@pytest.mark.parametrize(
    "number", ["1_000", "0x10", "+1.5", "01", "1.", "inf", "1e400", "true", "1, 2", "[1 2]", "[1,]"]
)
def test_a_number_is_one_of_toml_not_of_json(number: str):
    agree(f"a = {number}")

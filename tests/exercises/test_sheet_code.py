"""The code on a page says whose it is, and to nobody who has not the secret anything else."""

from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from graphcam.errors import TaskError
from graphcam.exercises.course.sheet_code import SheetCode

SECRET = b"secret"
ANNA = SheetCode("inversion-arm", 3, "Anna", 2, 1)
NAMES = st.text(min_size=1, max_size=80)


@given(NAMES, NAMES, st.integers(0, 400), st.integers(1, 9))
def test_what_is_written_is_read(exercise: str, student: str, draw: int, page: int):
    code = SheetCode(exercise, 1, student, draw, page)
    text = code.text(SECRET)
    assert text.isascii()
    # More would take modules finer than a camera sees.
    assert len(text) <= 100
    assert SheetCode.from_text(text, SECRET, ["another", student], exercise) == code


@given(st.text(max_size=60))
def test_what_somebody_writes_is_refused(text: str):
    with pytest.raises(TaskError):
        SheetCode.from_text(text, SECRET, ["Anna"])


def test_a_code_that_is_not_the_course_s_is_refused():
    text = ANNA.text(SECRET)
    assert SheetCode.from_text(text, SECRET, ["Anna"]) == ANNA
    with pytest.raises(TaskError, match="another secret"):
        SheetCode.from_text(text, b"other", ["Anna"])
    with pytest.raises(TaskError, match="of a student of this course"):
        SheetCode.from_text(text, SECRET, ["Ben"])
    with pytest.raises(TaskError, match="of 'inversion-translating'"):
        SheetCode.from_text(text, SECRET, ["Anna"], "inversion-translating")
    with pytest.raises(TaskError, match="none of graphcam's"):
        SheetCode.from_text("https://example.org/a/b/c", SECRET, ["Anna"])


@pytest.mark.parametrize("field", range(1, 7))
def test_a_changed_field_is_a_forgery(field: int):
    fields = ANNA.text(SECRET).split("/")
    fields[field] = {1: "integration", 3: "Ben", 6: "00000000"}.get(field, "7")
    with pytest.raises(TaskError, match="or changed"):
        SheetCode.from_text("/".join(fields), SECRET, ["Anna", "Ben"])

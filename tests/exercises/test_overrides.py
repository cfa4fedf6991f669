"""Marks given by hand: they last over every grading, are shown to the student, and a wrong line is told."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest
from issued_variants import answer_lines, course_of, issued, key

from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import TEACHER_FOLDER
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.grading.overrides import OVERRIDES_FILE

NAME = "acceleration-and-scales"
EXERCISE = find_exercise(NAME)
FIRST = EXERCISE.answers[0].name
HEAD = "student,answer,marks,comment\n"


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """Anna and =Ben have nothing right but Anna's last answer."""
    name, value = list(key(issued(NAME, "Anna")[1]).items())[-1]
    return course_of(tmp_path, NAME, {"Anna": answer_lines({name: value}), "=Ben": ""})


def grade(course: Path, **more: object) -> dict[str, dict[str, object]]:
    out = course / "out" / "grades.csv"
    grade_course(Course(course, course / "secret", out, feedback=course / "pages", **more))  # type: ignore[arg-type]
    records = json.loads(out.with_suffix(".json").read_text(encoding="utf-8"))
    return {record["student"]: record for record in records}


def table(course: Path, name: str) -> list[dict[str, str]]:
    return list(csv.DictReader((course / "out" / name).read_text(encoding="utf-8").splitlines()))


@pytest.mark.slow
def test_marks_given_by_hand_last_and_are_shown(course: Path):
    before = grade(course)
    (course / TEACHER_FOLDER / OVERRIDES_FILE).write_text(
        f"{HEAD}Anna,{FIRST},0.5,see <b>it</b>\n'=Ben,total,3,on paper\n"
    )
    records = grade(course)
    assert records["Anna"]["answers"][0]["marks"] == 0.5  # type: ignore[index]
    assert records["Anna"]["total"] == before["Anna"]["total"] + 0.5  # type: ignore[operator]
    assert records["=Ben"]["total"] == 3
    assert grade(course) == records
    assert [row["total"] for row in table(course, "grades.csv")] == ["3", f"{records['Anna']['total']:g}"]
    long = {(row["student"], row["answer"]): row["marks"] for row in table(course, "grades-long.csv")}
    assert long["Anna", FIRST] == "0.5"
    rows = [tuple(row.values()) for row in table(course, "grades-by-hand.csv")]
    assert rows == [("'=Ben", "total", "0", "3", "on paper"), ("Anna", FIRST, "0", "0.5", "see <b>it</b>")]
    assert "by your teacher: see &lt;b&gt;it&lt;/b&gt;" in (course / "pages" / "Anna.html").read_text(encoding="utf-8")
    assert "marks in total: on paper" in (course / "pages" / "=Ben.html").read_text(encoding="utf-8")
    assert "see &lt;b&gt;it&lt;/b&gt;" in (course / "out" / "grades.html").read_text(encoding="utf-8")
    # A line that is taken back leaves the marks that were found.
    (course / TEACHER_FOLDER / OVERRIDES_FILE).unlink()
    assert grade(course) == before
    assert table(course, "grades-by-hand.csv") == []


def test_a_table_that_is_named_counts_instead_and_may_be_that_of_a_spreadsheet(course: Path):
    (course / TEACHER_FOLDER / OVERRIDES_FILE).write_text(f"{HEAD}Anna,total,1,\n")
    (course / "mine.csv").write_bytes(f"\ufeffStudent;Marks;Answer;Comment\r\nAnna;0,25;{FIRST};\r\n;;;\r\n".encode())
    record = grade(course, overrides=course / "mine.csv")["Anna"]
    assert record["answers"][0]["marks"] == 0.25  # type: ignore[index]
    assert record["total"] != 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (f"{HEAD}Anna,{FIRST},1,\nDora,{FIRST},1,", r"line 3: student is .Dora., but must be one student of"),
        (f"{HEAD}Dora,{FIRST},1,", "line 2: student is 'Dora'.*; check the id"),
        (f"{HEAD}Anna,v,1,", rf"line 2: answer is 'v', but must be one of {FIRST}, .*total"),
        (f"{HEAD}Anna,{FIRST},many,", r"line 2: marks is 'many', but must be a number from 0 to"),
        (f"{HEAD}Anna,{FIRST},nan,", r"line 2: marks is 'nan'"),
        (f"{HEAD}Anna,{FIRST},-1,", r"line 2: marks is '-1'"),
        (f"{HEAD}Anna,total,{EXERCISE.marks + 1},", rf"line 2: marks .* from 0 to {EXERCISE.marks:g}"),
        (f"{HEAD}Anna,{FIRST}", r"line 2: marks is ''"),
        (f"{HEAD}Anna,{FIRST},0,\nAnna,{FIRST},1,", r"line 3: answer is .* give each answer of a student once"),
        ("Anna,total,1,\n", r"the first line is 'anna,total,1,', but must be with student,answer,marks,comment"),
        (b"\xff", "line 1 is in another encoding, .* but must be text in UTF-8"),
        (None, "there is no file .*mine.csv; check the name"),
    ],
)
def test_a_wrong_line_is_told_before_anything_is_graded(course: Path, text: str | bytes | None, message: str):
    if text is not None:
        (course / "mine.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(TaskError, match=message):
        grade(course, overrides=course / "mine.csv")
    assert not (course / "out").exists()
    assert not (course / "pages").exists()

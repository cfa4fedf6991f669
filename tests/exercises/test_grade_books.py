"""Grades for Moodle's and Canvas's grade books: what a reader of CSV finds in them is what was marked."""

from __future__ import annotations

import csv
import io
import json
import re
from html import unescape
from pathlib import Path
from typing import Any

import pytest
from issued_variants import answer_lines, course_of, issued, key

from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.reports.learning_platforms import moodle_grades
from graphcam.exercises.reports.report_files import wide_table

NAME = "acceleration-and-scales"
IDS = ("007", "Анна <b>", '=cmd|"x"', "a;=1", 'said "no", left')
GUARDED = {'=cmd|"x"': '\'=cmd|"x"', "a;=1": "a;'=1"}
"""Ids that a spreadsheet would calculate."""


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The reports on five students, each with one more answer wrong than the one before, the first with none."""
    handed_in: dict[str, str | None] = {}
    for count, student in enumerate(IDS):
        values = {name: float(str(value)) for name, value in key(issued(NAME, student)[1]).items()}
        handed_in[student] = answer_lines(values | {name: 1e4 + 7 * k for k, name in enumerate([*values][:count])})
    place = course_of(tmp_path_factory.mktemp("course"), NAME, handed_in)
    grade_course(Course(place, place / "secret", place / "grades.csv"))
    return place


def records(reports: Path) -> dict[str, dict[str, Any]]:
    """What was marked, by the student's id as a spreadsheet gets it."""
    found: list[dict[str, Any]] = json.loads((reports / "grades.json").read_text())
    return {GUARDED.get(str(one["student"]), str(one["student"])): one for one in found}


def rows(reports: Path, name: str) -> list[list[str]]:
    return list(csv.reader(io.StringIO((reports / name).read_bytes().decode("utf-8"), newline=""), strict=True))


def test_moodle_finds_every_student_with_grade_and_feedback(reports: Path):
    head, *students = rows(reports, "grades-moodle.csv")
    assert head == ["ID number", issued(NAME)[0].title, "Feedback"]
    marked = records(reports)
    assert {row[0] for row in students} == set(marked)
    assert len({row[1] for row in students}) > 2
    for student, grade, feedback in students:
        assert float(grade) == marked[student]["total"]
        # As a page shows it: lines at breaks, and no other markup.
        lines = [unescape(line) for line in feedback.split("<br>")] if feedback else []
        assert lines == marked[student]["feedback"]
        assert re.sub("<br>", "", feedback).count("<") == 0


def test_moodle_shows_feedback_with_markup_in_it_as_it_is():
    said = ["a < b & <i>c</i>;", 'said "no", left', "=1+1"]
    text = moodle_grades(issued(NAME)[0], [{"student": "7", "total": 1.0, "feedback": said}])
    (_, (_, _, feedback)) = csv.reader(io.StringIO(text, newline=""), strict=True)
    assert [unescape(line) for line in feedback.split("<br>")] == said
    assert re.findall("<[^>]*>", feedback) == ["<br>", "<br>"]


def test_canvas_finds_the_points_possible_and_every_students_grade(reports: Path):
    exercise = issued(NAME)[0]
    head, possible, *students = rows(reports, "grades-canvas.csv")
    assert head == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", exercise.title]
    assert possible[:5] == ["    Points Possible", "", "", "", ""]
    assert float(possible[5]) == exercise.marks
    marked = records(reports)
    assert [row[0] for row in students] == list(marked)
    assert max(float(row[5]) for row in students) == exercise.marks
    for name, own_number, user, login, section, grade in students:
        assert (own_number, user, login, section) == ("", name, name, "")
        assert float(grade) == marked[name]["total"]


def test_no_id_in_a_grade_book_is_a_formula(reports: Path):
    for name in ("grades-moodle.csv", "grades-canvas.csv"):
        found = {cell for row in rows(reports, name) for cell in row}
        assert set(GUARDED.values()) <= found
        assert not found & set(GUARDED)


@pytest.mark.parametrize(
    ("roster", "student", "heading"),
    [
        ("First name,Last name,ID number,Email address\nИван,Иванов,,0@univ.ru\n", "0@univ.ru", "Email address"),
        ("First name,Last name,ID number,Email address\nИван,Иванов,17,0@univ.ru\n", "17", "ID number"),
        ("Имя,Фамилия,Индивидуальный номер,Адрес электронной почты\nИван,Иванов,17,\n", "17", "Индивидуальный номер"),
        (
            "Имя,Фамилия,Индивидуальный номер,Адрес электронной почты\nИван,Иванов,,0@univ.ru\n",
            "0@univ.ru",
            "Адрес электронной почты",
        ),
    ],
)
def test_moodle_is_told_the_column_that_the_ids_are_from(tmp_path: Path, roster: str, student: str, heading: str):
    place = course_of(tmp_path, NAME, {student: ""})
    (place / "roster.csv").write_text(roster, encoding="utf-8")
    grade_course(Course(place, place / "secret", place / "grades.csv", exercise=NAME, roster=place / "roster.csv"))
    head, row = rows(place, "grades-moodle.csv")
    assert (head[0], row[0]) == (heading, student)


def test_notes_of_the_table_are_joined_as_a_list(reports: Path):
    record = json.loads((reports / "grades.json").read_text())[0] | {"notes": ["late", "no photograph"]}
    head, row = csv.reader(io.StringIO(wide_table([record], {})))
    assert row[head.index("notes")] == "late; no photograph"

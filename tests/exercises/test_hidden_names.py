"""Anonymous marking: pages and their files name nobody, and the teacher finds everybody again."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from issued_variants import SECRET, answer_lines, course_of, issued

from graphcam.exercises.course.course_folder import ROSTER_FILE, TEACHER_FOLDER
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.grading.overrides import OVERRIDES_FILE
from graphcam.exercises.reports import shown_names
from graphcam.exercises.reports.shown_names import hidden_names
from graphcam.files import OutputError

NAME = "inversion-translating"
IDS = ("anna.berg", "zoe/zimmer", "boris-ivanov", "clara_copy")
NAMES = dict(zip(IDS, ("Anna Berg", "Zoë Zimmer", "Борис Иванов", "Clara Copy"), strict=True))


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """Everything that a page may say of somebody: copies, drawings, mistakes, marks by hand, questions, refusals."""
    handed_in: dict[str, str | None] = {}
    for student in IDS:
        exercise, answer_key = issued(NAME, student)
        wrong = answer_key.hypotheses["offset-sign"]
        values: dict[str, Any] = {asked.name: each.value for asked, each in zip(exercise.answers, wrong, strict=True)}
        if student in ("boris-ivanov", "clara_copy"):
            # The same numbers, which are anybody's.
            values |= {
                asked.name: 11.37 * k + 7.3 for k, asked in enumerate(exercise.answers) if asked.kind == "number"
            }
        values["pitch"] = [[z.real, z.imag] for z in values["pitch"]]
        handed_in[student] = answer_lines({name: np.asarray(one).tolist() for name, one in values.items()})
    place = course_of(tmp_path, NAME, handed_in)
    lines = "".join(f"{student},{name}\n" for student, name in NAMES.items())
    (place / TEACHER_FOLDER / ROSTER_FILE).write_text(f"id,name\n{lines}", encoding="utf-8")
    (place / TEACHER_FOLDER / OVERRIDES_FILE).write_text("student,answer,marks,comment\nanna.berg,s_8,0.5,look\n")
    (place / "students" / "Max Mustermann_12_assignsubmission_file_").mkdir()
    return place


def grade(course: Path, pages: str, *, anonymous: bool) -> str:
    out = course / "out" / "grades.csv"
    grade_course(Course(course, course / "secret", out, feedback=course / pages, anonymous=anonymous))
    return out.with_suffix(".html").read_text(encoding="utf-8")


def identities(text: str) -> set[str]:
    """Ids, names and parts of names that stand in a text."""
    known = {*NAMES, *NAMES.values(), *(folder_name(student) for student in NAMES), "Mustermann"}
    known |= {part for name in NAMES.values() for part in name.split()}
    return {one for one in known if one.lower() in text.lower()}


@pytest.mark.slow
def test_no_page_tells_who_somebody_is_and_the_table_tells_whose_each_is(course: Path):
    group = grade(course, "pages", anonymous=True)
    table = list(csv.DictReader((course / "out" / "grades-ids.csv").read_text(encoding="utf-8").splitlines()))
    whose = {row["student"]: row["name"] for row in table}
    assert set(whose) == set(IDS)
    files = {path.name: path.read_text(encoding="utf-8") for path in (course / "pages").iterdir()}
    assert set(files) == {f"{name}.html" for name in whose.values()}
    for text in (group, *files, *files.values()):
        assert identities(text) == set()
    # What is told of a student is told under the name, on each page of its own.
    records = {record["student"]: record for record in json.loads((course / "out" / "grades.json").read_text())}
    for student, name in whose.items():
        assert f'<p class="under">{name}</p>' in files[f"{name}.html"]
        assert f"{records[student]['total']:g} of {records[student]['of']:g} marks" in files[f"{name}.html"]
        assert name in group
    assert f'<a href="../pages/{whose["zoe/zimmer"]}.html">' in group
    assert "grades-not-graded.csv: it lists what was not graded, 1 in total" in group
    assert "look" in files[f"{whose['anna.berg']}.html"]
    alike = group[group.index("agree more than by chance") :]
    assert whose["clara_copy"] in alike
    assert whose["boris-ivanov"] in alike
    # The group page is in the order of the names, which is not that of the ids.
    students = group[group.index('class="students"') : group.index("Errors step by step")]
    assert sorted(whose.values(), key=students.index) == sorted(whose.values())


@pytest.mark.slow
def test_without_it_the_pages_do_tell_so_the_check_above_would_find_it(course: Path):
    group = grade(course, "pages", anonymous=False)
    assert identities(group) >= {*IDS, "Mustermann"}
    assert not (course / "out" / "grades-ids.csv").exists()
    assert "anna.berg.html" in {path.name for path in (course / "pages").iterdir()}


def test_hidden_pages_do_not_go_beside_pages_under_ids(course: Path):
    grade(course, "pages", anonymous=False)
    before = sorted((course / "pages").iterdir())
    with pytest.raises(OutputError, match=r"it has pages under the students' ids.*; name another folder"):
        grade(course, "pages", anonymous=True)
    assert sorted((course / "pages").iterdir()) == before
    grade(course, "hidden", anonymous=True)
    # A second time into the same one.
    grade(course, "hidden", anonymous=True)
    assert len(list((course / "hidden").iterdir())) == len(IDS)


def test_the_name_depends_on_the_secret_the_exercise_and_the_student():
    name = hidden_names(SECRET, NAME, ["s1"])["s1"]
    assert hidden_names(SECRET, NAME, ["s2", "s1"])["s1"] == name
    assert name not in {
        hidden_names(b"other", NAME, ["s1"])["s1"],
        hidden_names(SECRET, "whole-cam", ["s1"])["s1"],
        hidden_names(SECRET, NAME, ["s2"])["s2"],
    }


def test_names_that_would_be_the_same_become_longer(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(shown_names, "NAME_LENGTH", 1)
    students = [f"s{k}" for k in range(200)]
    names = hidden_names(SECRET, NAME, students)
    assert len(set(names.values())) == 200
    # Of 32 letters one is too few for 200 students, and two for any but the luckiest.
    assert {len(name) for name in names.values()} == {min(map(len, names.values()))}
    assert min(map(len, names.values())) >= 2

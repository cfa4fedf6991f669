"""The course for a lecturer's task: what a student gets and does not get, what is handed in, and its marks."""

from __future__ import annotations

import csv
import json
import re
import shutil
import zipfile
from pathlib import Path
from typing import Any

import nbformat
import pytest
from courses import COURSE, FOLDER
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS
from graphcam.exercises.grading.notebook_marks import course_questions, typed_numbers
from graphcam.notebooks import changed, course_editions
from graphcam.notebooks.notebook_execution import NotebookError, execute
from graphcam.notebooks.question import QUESTIONS_FILE
from graphcam.tasks.task_writer import task_files

pytestmark = pytest.mark.slow

LESSONS = ("02_graphical_integration", "05_inversion", "10_coursework")
ARRAY_CELL = re.compile(r"(your_(?:v|s|pitch_points|rollers)) = None.*\n(\w+)\.check\(\1\)")
"""A cell of these lessons in which lines are to be written."""
TASK = changed(gc.builtin_task(), {"rotation": "ccw", "follower.offset": 6.0, "drawing.divisions": 8})


@pytest.fixture(scope="module")
def course(tmp_path_factory) -> Path:
    """The course of three notebooks for an anticlockwise cam, as the command writes it."""
    place = tmp_path_factory.mktemp("course")
    for name in (*(f"{lesson}.ipynb" for lesson in LESSONS), "hard_cases.toml"):
        (place / "source").mkdir(exist_ok=True)
        shutil.copy(FOLDER / name, place / "source")
    for name, text in task_files(TASK).items():
        (place / name).write_text(text, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(course_editions, "course_source", lambda: place / "source")
        done = CliRunner().invoke(
            app, ["notebook", str(place / "task.toml"), "--course", str(place / "made"), "--html"]
        )
    assert done.exit_code == 0, done.output
    return place / "made"


def cells(notebook: Any, kind: str = "code") -> list[str]:
    return [cell.source for cell in notebook.cells if cell.cell_type == kind]


def test_the_whole_course_is_made_of_the_notebooks_of_the_source():
    found = course_editions.course_source().glob("[0-9][0-9]_*.ipynb")
    assert sorted(path.stem for path in found) == COURSE


def test_both_editions_hold_the_task_and_every_lesson(course):
    for edition in ("student", "teacher"):
        held = {path.name for path in (course / edition).iterdir()}
        lessons = {f"{name}{end}" for name in LESSONS for end in (".ipynb", ".html")}
        assert held - {QUESTIONS_FILE} == {"task.toml", "hard_cases.toml"} | lessons
        assert gc.load_task(course / edition / "task.toml") == TASK
    assert (course / "teacher" / QUESTIONS_FILE).is_file()
    assert not (course / "student" / QUESTIONS_FILE).exists()


@pytest.mark.parametrize("name", LESSONS)
def test_the_students_edition_has_no_answers_and_no_formulas_of_answers(name, course):
    student, teacher = (nbformat.read(course / edition / f"{name}.ipynb", 4) for edition in ("student", "teacher"))
    nbformat.validate(student)
    code, prose = "\n".join(cells(student)), "\n".join(cells(student, "markdown"))
    assert "= Question" not in code
    assert "assert " not in code
    assert "Model answers" not in prose
    assert "Model answers" in "\n".join(cells(teacher, "markdown"))
    page = (course / "student" / f"{name}.html").read_text(encoding="utf-8")
    assert "Model answers" not in page
    # Nor the lines that are to be written, which the teacher has folded.
    assert "Model lines" not in page
    lines = [cell.source for cell in teacher.cells if "hide-input" in cell.metadata.get("tags", ())]
    assert lines
    assert not any(source in code for source in lines)
    page = (course / "teacher" / f"{name}.html").read_text(encoding="utf-8")
    assert page.count("<summary>Model lines</summary>") == len(lines)
    # Every number that is asked for, and every closing question, has its place.
    asked = course_questions(course / "student")[name]
    assert all(f"{answer} = None" in code for answer in asked)
    closing = prose.split("## Questions")[1].split("**Answer ")
    assert len(closing) - 1 == sum(line[:1].isdigit() for line in closing[0].splitlines()) > 0
    assert not any(cell.get("outputs") for cell in student.cells)


@pytest.mark.parametrize("name", LESSONS)
def test_the_students_edition_runs_unanswered_and_its_marks_are_those_of_the_teacher(name, course, tmp_path):
    student = nbformat.read(course / "student" / f"{name}.ipynb", 4)
    questions = course_questions(course / "student")[name]
    ran = execute(student, course / "student")
    marks = [cell.outputs[0].data["text/plain"] for cell in ran.cells if cell.source.startswith("int(")]
    arrays = {"02_graphical_integration": 2}.get(name, 1)
    assert marks == ["0"] * (len(questions) + arrays)
    for cell in student.cells:
        cell.source = ARRAY_CELL.sub(r"\1 = \2.values\n\2.check(\1)", cell.source)
        for answer, question in questions.items():
            cell.source = cell.source.replace(f"{answer} = None", f"{answer} = {question.value + question.bias!r}")
    ran = execute(student, course / "student")
    marks = [cell.outputs[0].data["text/plain"] for cell in ran.cells if cell.source.startswith("int(")]
    assert marks == ["1"] * (len(questions) + arrays)


def test_nbgrader_knows_what_is_graded(course):
    formats = pytest.importorskip("nbgrader.nbgraderformat", reason="nbgrader is an extra")
    for name in LESSONS:
        student = nbformat.read(course / "student" / f"{name}.ipynb", 4)
        formats.MetadataValidator().validate_nb(student)
        graded = [cell.metadata.nbgrader for cell in student.cells if "nbgrader" in cell.metadata]
        assert len({one.grade_id for one in graded}) == len(graded)
        assert {one.grade for one in graded} == {True}
        assert [one for one in graded if one.locked] == [one for one in graded if not one.solution]


def rows_of(path: Path) -> list[dict[str, str]]:
    return [*csv.DictReader(path.read_text(encoding="utf-8").splitlines())]


def handed_in(course: Path, folder: Path, answers: dict[str, str]) -> None:
    """A student's notebooks with these texts in the place of ``None``."""
    folder.mkdir(parents=True)
    for path in (course / "student").glob("*.ipynb"):
        notebook = nbformat.read(path, 4)
        for cell in notebook.cells:
            for name, text in answers.items():
                cell.source = cell.source.replace(f"{name} = None", f"{name} = {text}")
        nbformat.write(notebook, folder / path.name)


def test_marks_are_one_for_every_right_number_and_nothing_is_run(course, tmp_path):
    questions = course_questions(course / "student")
    every = {answer: question for asked in questions.values() for answer, question in asked.items()}
    hands = course / "handed-in"
    handed_in(course, hands / "right", {name: repr(q.value + q.bias) for name, q in every.items()})
    mistakes = {name: next(iter(q.mistakes.values())) for name, q in every.items() if q.mistakes}
    handed_in(course, hands / "mistaken", {name: repr(wrong) for name, wrong in mistakes.items()})
    comma = {name: f'"{q.value + q.bias:.6f}"'.replace(".", ",") for name, q in every.items()}
    handed_in(course, hands / "comma", comma)
    handed_in(course, hands / "formula", {name: f"{q.value + q.bias!r} * 1" for name, q in every.items()})
    handed_in(course, hands / "code", dict.fromkeys(every, '__import__("pathlib").Path("ran").touch()'))
    (hands / "code" / f"{LESSONS[0]}.ipynb").write_text("no notebook", encoding="utf-8")
    (hands / "code" / f"{LESSONS[1]}.ipynb").unlink()
    done = CliRunner().invoke(app, ["exercise", "grade", str(hands), "--out", str(tmp_path / "grades.csv")])
    assert done.exit_code == 0, done.output
    rows = {row["student"]: row for row in rows_of(tmp_path / "grades.csv")}
    most = f"marks of {len(every)}"
    assert {student: int(row[most]) for student, row in rows.items()} == {
        "right": len(every), "comma": len(every), "mistaken": 0, "formula": 0, "code": 0
    }  # fmt: skip
    assert [int(rows["right"][name]) for name in LESSONS] == [len(questions[name]) for name in LESSONS]
    told = rows_of(tmp_path / "grades-answers.csv")
    assert len(told) == 5 * len(every)
    hints = {row["answer"]: row["remark"] for row in told if row["student"] == "mistaken"}
    assert all(next(iter(every[name].mistakes)) in hints[name] for name in mistakes)
    by_code = {row["notebook"]: row["verdict"] for row in told if row["student"] == "code"}
    assert by_code == dict(zip(LESSONS, ("not readable", "not handed in", "wrong"), strict=True))
    assert not Path("ran").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--feedback", "pages"], "--feedback is 'pages', but must be left out: notebooks are marked number by number"),
        ([], "the folder is empty, but must be one with a folder for every student"),
    ],
)
def test_what_notebooks_do_not_have_is_refused(words, message, course, tmp_path):
    (course / "empty").mkdir(exist_ok=True)
    out = tmp_path / "grades.csv"
    done = CliRunner().invoke(app, ["exercise", "grade", str(course / "empty"), "--out", str(out), *words])
    assert done.exit_code == INPUT_ERROR_STATUS
    assert message in done.stderr
    assert not out.exists()


def test_a_zip_of_the_folders_is_read_and_what_is_not_safe_in_it_is_told(course, tmp_path):
    questions = course_questions(course / "student")
    name, asked = next(iter(questions.items()))
    answer, question = next(iter(asked.items()))
    handed_in(course, tmp_path / "anna", {answer: repr(question.value + question.bias)})
    packed = course / "handed-in.zip"
    with zipfile.ZipFile(packed, "w") as archive:
        archive.write(tmp_path / "anna" / f"{name}.ipynb", f"anna/{name}.ipynb")
        archive.writestr("../outside.ipynb", "{}")
    done = CliRunner().invoke(app, ["exercise", "grade", str(packed), "--out", str(tmp_path / "grades.csv")])
    assert done.exit_code == 0, done.output
    (row,) = rows_of(tmp_path / "grades.csv")
    assert (row["student"], row[name]) == ("anna", "1")
    assert "not graded: ../outside.ipynb" in done.output


def test_damaged_questions_are_told_by_their_file(course, tmp_path):
    (tmp_path / "teacher").mkdir()
    (tmp_path / "teacher" / QUESTIONS_FILE).write_text('{"01": {"your_r0": "no text"}}', encoding="utf-8")
    (tmp_path / "handed-in" / "Anna").mkdir(parents=True)
    done = CliRunner().invoke(app, ["exercise", "grade", str(tmp_path / "handed-in"), "--out", str(tmp_path / "g.csv")])
    assert done.exit_code == INPUT_ERROR_STATUS
    assert f"{QUESTIONS_FILE}: the file is damaged" in done.stderr


def test_the_last_line_counts_and_the_comment_does_not():
    source = [
        "your_r0 = None  # mm\n",
        "your_r0 = '42,5 mm'  # measured twice\n",
        "your_e=-10\n",
        "prime_radius.check(your_r0)",
    ]
    data = json.dumps({"cells": [{"cell_type": "code", "source": source}]}).encode()
    assert typed_numbers("a.ipynb", data) == {"your_r0": "42,5 mm", "your_e": "-10"}


def author_checks(folder: Path, *checks: str) -> Path:
    """A lesson whose author checks these things."""
    cells = [nbformat.v4.new_code_cell(check, metadata={"tags": ["remove-cell"]}) for check in checks]
    nbformat.write(nbformat.v4.new_notebook(cells=cells), folder / "99_checks.ipynb")
    return folder / "99_checks.ipynb"


def test_a_check_of_the_author_that_does_not_hold_for_the_task_is_told_and_stops_nothing(tmp_path):
    path = author_checks(tmp_path, "lift = 30\nassert lift == 30\nassert lift == 20  # mm", "assert lift > 20")
    lesson = course_editions.lesson_of(path, tmp_path)
    assert lesson.doubts == ("assert lift == 20  # mm",)
    assert all(cell.outputs == [] and cell.metadata.tags == ["remove-cell"] for cell in lesson.teacher.cells)
    with pytest.raises(NotebookError, match="ZeroDivisionError"):
        course_editions.lesson_of(author_checks(tmp_path, "1 / 0"), tmp_path)


def test_a_task_without_a_cam_is_refused_before_anything_is_executed(tmp_path):
    with pytest.raises(gc.DesignError, match="prime radius"):
        course_editions.write_course(changed(TASK, {"cam.prime_radius": 3.0}), tmp_path / "course")
    assert not (tmp_path / "course").exists()

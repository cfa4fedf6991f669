"""Marks for the notebooks of the course: every number that a student put in, judged by the question that asked for it.

Nothing in a notebook is run: the line that gives a number its name is read as text.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import DesignError, TaskError, UnreadableError
from graphcam.exercises.course.course_folder import TEACHER_FOLDER
from graphcam.exercises.course.roster import student_of
from graphcam.exercises.course.spreadsheet import table
from graphcam.exercises.reading.notebook import cell_source, code_cells
from graphcam.exercises.reading.regular_file import read_regular
from graphcam.files import whole_file
from graphcam.notebooks.question import QUESTIONS_FILE, RIGHT_VERDICT, Question, kept_questions
from graphcam.words import Caption, say

MAX_NOTEBOOK_BYTES = 50_000_000
MAX_FILES = 1000
"""Files that are looked at in a student's folder."""
LINE_PATTERN = re.compile(r"^\s*(your_\w+)\s*=\s*(.*?)\s*(?:#.*)?$", re.MULTILINE)
"""A number that a student put in, with what stands behind the sign of equality."""
MISSING_NOTEBOOK, UNREADABLE_NOTEBOOK = "not handed in", "not readable"
HEADS = "student", "notebook", "answer", "given", "verdict", "remark"
Questions = Mapping[str, Mapping[str, Question]]
"""The questions of the course by notebook and by the name of the student's number."""


@dataclass(frozen=True)
class MarkedNumber:
    """A number of a student: its notebook and name, what was given, its verdict and a remark."""

    notebook: str
    name: str
    given: str
    status: str
    remark: str


def course_questions(folder: Path) -> Questions:
    """The questions of the course of notebooks beside whose teacher's folder a folder of hand-ins stands; else none.

    Raises
    ------
    TaskError : the teacher's file is damaged
    """
    path = folder.resolve().parent / TEACHER_FOLDER / QUESTIONS_FILE
    try:
        kept = json.loads(path.read_bytes())
        return {name: _number_questions(asked) for name, asked in kept.items()}
    except OSError:
        return {}
    except (ValueError, TypeError, AttributeError, IndexError) as error:
        limit = say("as 'graphcam notebook --course' wrote it")
        remedy = say("write the course again into another folder, and copy its teacher's folder")
        raise TaskError(str(path), say("the file"), say("damaged"), limit, remedy) from error


def _number_questions(asked: Mapping[str, str]) -> dict[str, Question]:
    found = {answer: kept_questions(text)[0] for answer, text in asked.items()}
    return {answer: question for answer, question in found.items() if isinstance(question, Question)}


def marked_numbers(folder: Path, questions: Questions) -> list[MarkedNumber]:
    """All numbers of the course with a student's answers, in the folder of that student's notebooks."""
    found = _notebooks_in(folder, questions)
    return [one for name, asked in questions.items() for one in _marked_notebook(found.get(name), name, asked)]


def _notebooks_in(folder: Path, names: Sequence[str] | Questions) -> dict[str, Path]:
    """The files of a folder by the notebook that they are: by its name, or that of a copy; the newest of several."""
    found: dict[str, Path] = {}
    places = (Path(place, name) for place, _, files in os.walk(folder) for name in sorted(files))
    for _, path in zip(range(MAX_FILES), places, strict=False):
        for name in names:
            if path.suffix == ".ipynb" and path.name.startswith(name):
                known = found.get(name)
                if known is None or path.lstat().st_mtime >= known.lstat().st_mtime:
                    found[name] = path
    return found


def _marked_notebook(path: Path | None, name: str, asked: Mapping[str, Question]) -> list[MarkedNumber]:
    given: dict[str, str] = {}
    status, remark = MISSING_NOTEBOOK, ""
    if path is not None:
        try:
            given = typed_numbers(path.name, read_regular(path, MAX_NOTEBOOK_BYTES))
            status = ""
        except UnreadableError as error:
            status, remark = UNREADABLE_NOTEBOOK, str(error)
    if status:
        return [MarkedNumber(name, answer, "", status, remark) for answer in asked]
    marked: list[MarkedNumber] = []
    for answer, question in asked.items():
        verdict = question.check(given.get(answer))
        marked.append(MarkedNumber(name, answer, given.get(answer, ""), verdict.status, verdict.text))
    return marked


def typed_numbers(name: str, data: bytes) -> dict[str, str]:
    """What a student put in the place of ``None`` in a notebook, by the numbers' names; the last line counts.

    Raises
    ------
    UnreadableError : it is no notebook

    >>> cell = {"cell_type": "code", "source": 'your_r0 = "42,5 mm"  # mm\\\\nprime_radius.check(your_r0)'}
    >>> typed_numbers("a.ipynb", json.dumps({"cells": [cell]}).encode())
    {'your_r0': '42,5 mm'}
    """
    lines = (line for cell in code_cells(name, data) for line in LINE_PATTERN.finditer(cell_source(cell)))
    given = {line[1]: line[2].strip("\"'") for line in lines}
    return {answer: text for answer, text in given.items() if text not in ("", "None")}


def grade_notebooks(
    folder: Path, out: Path, questions: Questions, only_exercises: Mapping[str, object]
) -> list[Caption]:
    """Mark the notebooks in the folders of the students, and write two tables; what was done, in lines.

    ``out`` has a line for each student, with the marks of every notebook; a second table beside it every number.

    only_exercises : values of options that notebooks do not have, by name

    Raises
    ------
    DesignError : one of these options is given
    TaskError : the folder holds no student's folder
    OutputError : a table cannot be written
    """
    for option, value in only_exercises.items():
        if value:
            remedy = say("every number's verdict stands in the table beside the grades")
            raise DesignError(option, str(value), say("left out: notebooks are marked number by number"), remedy)
    students = sorted(path for path in folder.iterdir() if path.is_dir() and not path.is_symlink())
    if not students:
        empty, remedy = say("empty"), say("put the notebooks of each student into a folder of that student's name")
        raise TaskError(str(folder), say("the folder"), empty, say("one with a folder for every student"), remedy)
    marked = {student_of(path.name): marked_numbers(path, questions) for path in students}
    answers = out.with_name(f"{out.stem}-answers.csv")
    rows = [[student, one.notebook, one.name, one.given, one.status, one.remark]
            for student, numbers in marked.items() for one in numbers]  # fmt: skip
    sums = [[student, *_marks(numbers, questions)] for student, numbers in marked.items()]
    most = sum(map(len, questions.values()))
    for path, head, lines in ((out, ("student", f"marks of {most}", *questions), sums), (answers, HEADS, rows)):
        with whole_file(path) as draft:
            draft.write_text(table(head, lines), encoding="utf-8", newline="")
    done = say("students whose notebooks were marked: {count}; in {folder}: {files}")
    return [done.with_values(count=len(marked), folder=str(out.parent), files=f"{out.name}, {answers.name}")]


def _marks(numbers: Sequence[MarkedNumber], questions: Questions) -> list[int]:
    """The sum of the marks, and those of every notebook: one for each right number."""
    right = [one.notebook for one in numbers if one.status == RIGHT_VERDICT]
    return [len(right), *(right.count(name) for name in questions)]

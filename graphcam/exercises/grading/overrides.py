"""Marks that a teacher gives by hand: a table that is read at every grading, so that they last."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphcam.drafting.ink import Caption, say
from graphcam.errors import TaskError
from graphcam.exercises.course.spreadsheet import cell, read_table
from graphcam.exercises.definition.exercise import Exercise

OVERRIDES = "overrides.csv"
"""In the teacher's folder, marks given by hand."""
TOTAL = "total"
"""In place of an answer's name: the marks are for the whole hand-in."""
COLUMNS = ("student", "answer", "marks", "comment")


@dataclass(frozen=True)
class Override:
    """Marks for one answer of a student, or for all of it, and what the student is told."""

    student: str
    answer: str
    marks: float
    comment: str


def read_overrides(path: Path, exercise: Exercise, students: Iterable[str]) -> list[Override]:
    """The marks given by hand, from a CSV file with the columns student, answer, marks and comment.

    students : who handed in

    Raises
    ------
    TaskError : the file cannot be read, or a line of it names a student, an answer or marks that there are not
    """
    rows = read_table(path, "the overrides")
    # An id that was copied from the table of grades may have the guard of its cell.
    known = {cell(student): student for student in students}
    known |= {student: student for student in known.values()}
    possible = {asked.name: asked.marks for asked in exercise.answers} | {TOTAL: exercise.marks}
    found: dict[tuple[str, str], Override] = {}
    head = [name.strip().lower() for name in rows[0][1]] if rows else []
    if sorted(head) != sorted(COLUMNS):
        raise TaskError(str(path), "the first line", ",".join(head), ",".join(COLUMNS), "give these columns")
    for line, row in rows[1:]:
        where = f"line {line}"
        one = _override(str(path), where, dict(zip(head, row, strict=False)), known, possible)
        if (one.student, one.answer) in found:
            remedy = "give each answer of a student once"
            raise TaskError(str(path), f"{where}: answer", one.answer, "another one", remedy)
        found[one.student, one.answer] = one
    return list(found.values())


def _override(
    path: str, where: str, row: Mapping[str, str], known: Mapping[str, str], possible: Mapping[str, float]
) -> Override:
    """One line.

    known : ids by how they may be written;  possible : marks by the answer's name
    """
    student, answer = row.get("student", ""), row.get("answer", "").strip()
    if student not in known:
        remedy = "check the id; for work on paper make an empty folder of that name"
        raise TaskError(path, f"{where}: student", student, "one who handed in", remedy)
    if answer not in possible:
        raise TaskError(path, f"{where}: answer", answer, f"one of {', '.join(possible)}", "check the name")
    said = row.get("marks", "").strip()
    try:
        marks = float(said.replace(",", "."))
    except ValueError:
        marks = math.nan
    if not 0 <= marks <= possible[answer]:
        raise TaskError(path, f"{where}: marks", said, f"a number from 0 to {possible[answer]:g}", "correct the line")
    return Override(known[student], answer, marks, " ".join(row.get("comment", "").split()))


def overridden(
    exercise: Exercise, records: Sequence[dict[str, Any]], overrides: Sequence[Override]
) -> list[dict[str, Any]]:
    """The records with the marks given by hand; those that were found stand under "overrides"."""
    by_student: dict[str, list[Override]] = {}
    for one in overrides:
        by_student.setdefault(one.student, []).append(one)
    return [_applied(exercise, record, by_student.get(record["student"], [])) for record in records]


def _applied(exercise: Exercise, record: dict[str, Any], overrides: list[Override]) -> dict[str, Any]:
    if not overrides:
        return record
    marks = {one.answer: one.marks for one in overrides}
    answers: list[dict[str, Any]] = [
        {**answer, "marks": marks.get(answer["name"], answer["marks"])} for answer in record["answers"]
    ]
    former = {answer["name"]: answer["marks"] for answer in record["answers"]} | {TOTAL: record["total"]}
    most = {answer["name"]: answer["of"] for answer in record["answers"]} | {TOTAL: record["of"]}
    total = marks.get(TOTAL, math.fsum(float(answer["marks"]) for answer in answers))
    told = [exercise.tell(_told(one, most[one.answer])) for one in overrides]
    kept = [{**vars(one), "found": former[one.answer]} for one in overrides]
    return {
        **record,
        "answers": answers,
        "total": total,
        "feedback": [*record["feedback"], *told],
        "overrides": kept,
    }


def _told(one: Override, most: float) -> Caption:
    said: dict[str, Any] = {"marks": one.marks, "of": most, "comment": one.comment}
    if one.answer == TOTAL:
        if one.comment:
            return say("Your teacher gives {marks:g} of {of:g} marks in all: {comment}", **said)
        return say("Your teacher gives {marks:g} of {of:g} marks in all.", **said)
    if one.comment:
        return say("{name}: your teacher gives {marks:g} of {of:g} marks: {comment}", name=one.answer, **said)
    return say("{name}: your teacher gives {marks:g} of {of:g} marks.", name=one.answer, **said)

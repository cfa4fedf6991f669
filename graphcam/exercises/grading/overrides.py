"""Marks that a teacher gives by hand: a table that is read at every grading, so that they last."""

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphcam.drafting.ink import Caption, say
from graphcam.errors import TaskError
from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.spreadsheet import cell, read_table
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.marking.record import is_handed_in
from graphcam.words import Words

OVERRIDES_FILE = "overrides.csv"
"""The teacher's table of marks given by hand."""
TOTAL_ANSWER = "total"
"""The word in place of an answer's name: the marks are for the whole hand-in."""
OVERRIDE_COLUMNS = ("student", "answer", "marks", "comment")
ABSENT_REMEDY = say("give the marks as the total")
"""What to do about an answer of a student who did not hand in."""


@dataclass(frozen=True)
class Override:
    """Marks for one answer of a student, or for all of it, and what the student is told."""

    student: str
    answer: str
    marks: float
    comment: str


def read_overrides(path: Path, exercise: Exercise, known: Recognition, handed_in: Collection[str]) -> list[Override]:
    """The marks given by hand, from a CSV file with the columns student, answer, marks and comment.

    known : the students;  handed_in : the ids of those who did; who worked on paper may have a total all the same

    Raises
    ------
    TaskError : the file cannot be read, or a line of it names a student, an answer or marks that there are not
    """
    possible = {asked.name: asked.marks for asked in exercise.answers} | {TOTAL_ANSWER: exercise.marks}
    found: dict[tuple[str, str], Override] = {}
    for line in _lines(path, known):
        one = _override(line, possible, absent=line.student not in handed_in)
        if (one.student, one.answer) in found:
            raise line.wrong("answer", say("another one"), say("give each answer of a student once"))
        found[one.student, one.answer] = one
    return list(found.values())


@dataclass(frozen=True)
class _Line:
    """One line: where it stands, whose it is, and its cells by the heading of their column."""

    path: str
    number: int
    student: str
    cells: Mapping[str, str]

    def __getitem__(self, column: str) -> str:
        """What stands in a column, without spaces around it; empty where the line has no such cell."""
        return self.cells.get(column, "").strip()

    def wrong(self, column: str, expected: Words, remedy: Words) -> TaskError:
        """The error to raise about a cell of this line."""
        what = say("line {number}: {column}", number=self.number, column=column)
        return TaskError(self.path, what, self[column], expected, remedy)


def _lines(path: Path, known: Recognition) -> Iterator[_Line]:
    """The lines of the table, which names students by id, e-mail address or name.

    Raises
    ------
    TaskError : the file cannot be read, lacks a column, or a line names nobody, or may mean several students
    """
    rows = read_table(path, say("the table of overrides"))
    head = [name.strip().lower() for name in rows[0][1]] if rows else []
    if not set(OVERRIDE_COLUMNS) <= set(head):
        remedy = say("name the columns in the first line")
        expected = say("with {names}", names=",".join(OVERRIDE_COLUMNS))
        raise TaskError(str(path), say("the first line"), ",".join(head), expected, remedy)
    for number, row in rows[1:]:
        cells = dict(zip(head, row, strict=False))
        said = cells.get("student", "")
        # An id copied from a table of grades may have the guard of its cell.
        meant = [student for student in known.ids if said in (student, cell(student))] or known.meant([said])
        line = _Line(str(path), number, meant[0] if meant else "", cells)
        if len(meant) != 1:
            severally = say("it may mean {names}; give the id", names=", ".join(meant))
            expected = say("one student of the course by id, address or name")
            raise line.wrong("student", expected, severally if meant else say("check the id"))
        yield line


def _override(line: _Line, possible: Mapping[str, float], *, absent: bool) -> Override:
    """The override in one line of the file.

    possible : marks by the answer's name;  absent : the student has not handed in
    """
    if absent and line["answer"] != TOTAL_ANSWER:
        limit = say("{total}: {student} has not handed in", total=TOTAL_ANSWER, student=line.student)
        raise line.wrong("answer", limit, ABSENT_REMEDY)
    if line["answer"] not in possible:
        raise line.wrong("answer", say("one of {names}", names=", ".join(possible)), say("check the name"))
    most = possible[line["answer"]]
    try:
        marks = float(line["marks"].replace(",", "."))
    except ValueError:
        marks = math.nan
    if not 0 <= marks <= most:
        raise line.wrong("marks", say("a number from 0 to {most:g}", most=most), say("correct the line"))
    return Override(line.student, line["answer"], marks, " ".join(line["comment"].split()))


def overridden(
    exercise: Exercise, records: Sequence[dict[str, Any]], overrides: Sequence[Override]
) -> list[dict[str, Any]]:
    """The records with the marks given by hand; those that were found stand under "overrides"."""
    by_student: dict[str, list[Override]] = {}
    for one in overrides:
        by_student.setdefault(one.student, []).append(one)
    return [_overridden_record(exercise, record, by_student.get(record["student"], [])) for record in records]


def _overridden_record(exercise: Exercise, record: dict[str, Any], overrides: list[Override]) -> dict[str, Any]:
    if not overrides:
        return record
    marks = {one.answer: one.marks for one in overrides}
    answers: list[dict[str, Any]] = [
        {**answer, "marks": marks[answer["name"]], "by_hand": True} if answer["name"] in marks else answer
        for answer in record["answers"]
    ]
    former = {answer["name"]: answer["marks"] for answer in record["answers"]} | {TOTAL_ANSWER: record["total"]}
    most = {answer["name"]: answer["of"] for answer in record["answers"]} | {TOTAL_ANSWER: record["of"]}
    total = marks.get(TOTAL_ANSWER, math.fsum(float(answer["marks"]) for answer in answers))
    told = [exercise.tell(_override_remark(one, most[one.answer])) for one in overrides]
    kept = [{**vars(one), "found": former[one.answer]} for one in overrides]
    return {
        **{name: value for name, value in record.items() if name != "handed_in"},
        "answers": answers,
        "total": total,
        "feedback": [*_remaining_remarks(record, answers, total), *told],
        # Of work on paper nothing is to be said about files.
        "notes": record["notes"] if is_handed_in(record) else [],
        "overrides": kept,
    }


def _remaining_remarks(record: dict[str, Any], answers: Sequence[dict[str, Any]], total: float) -> list[str]:
    """The sentences that still hold: none on an answer that has its marks by hand, no mistake where nothing is lost."""
    if not is_handed_in(record):
        return []
    by_hand = tuple(f"{answer['name']}: " for answer in answers if answer.get("by_hand"))
    said = [each for each in record["feedback"] if not (by_hand and each.startswith(by_hand))]
    if total < record["of"]:
        return said
    # Of a submission with full marks, what is right.
    right = tuple(f"{answer['name']}: " for answer in answers if answer["outcome"] in ("right", "follow-through"))
    return [each for each in said if right and each.startswith(right)]


def _override_remark(one: Override, most: float) -> Caption:
    said: dict[str, Any] = {"marks": one.marks, "of": most, "comment": one.comment}
    if one.answer == TOTAL_ANSWER:
        if one.comment:
            return say("Your teacher gives {marks:g} of {of:g} marks in total: {comment}", **said)
        return say("Your teacher gives {marks:g} of {of:g} marks in total.", **said)
    if one.comment:
        return say("{name}: your teacher gives {marks:g} of {of:g} marks: {comment}", name=one.answer, **said)
    return say("{name}: your teacher gives {marks:g} of {of:g} marks.", name=one.answer, **said)

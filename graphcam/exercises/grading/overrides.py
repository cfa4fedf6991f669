"""Marks that a teacher gives by hand: a table that is read at every grading, so that they last."""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphcam.drafting.ink import Caption, say
from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.student_table import StudentLine, once, student_lines
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.marking.record import is_handed_in

OVERRIDES = "overrides.csv"
"""The teacher's table of marks given by hand."""
TOTAL = "total"
"""The word in place of an answer's name: the marks are for the whole hand-in."""
COLUMNS = ("student", "answer", "marks", "comment")
ABSENT = say("give the marks as the total")
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
    possible = {asked.name: asked.marks for asked in exercise.answers} | {TOTAL: exercise.marks}
    lines = student_lines(path, say("the table of overrides"), COLUMNS, known)
    single = once(lines, ("answer",), say("give each answer of a student once"))
    return [_override(line, possible, absent=line.student not in handed_in) for line in single]


def _override(line: StudentLine, possible: Mapping[str, float], *, absent: bool) -> Override:
    """One line.

    possible : marks by the answer's name;  absent : the student has not handed in
    """
    if absent and line["answer"] != TOTAL:
        limit = say("{total}: {student} has not handed in", total=TOTAL, student=line.student)
        raise line.wrong("answer", limit, ABSENT)
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
    return [_applied(exercise, record, by_student.get(record["student"], [])) for record in records]


def _applied(exercise: Exercise, record: dict[str, Any], overrides: list[Override]) -> dict[str, Any]:
    if not overrides:
        return record
    marks = {one.answer: one.marks for one in overrides}
    answers: list[dict[str, Any]] = [
        {**answer, "marks": marks[answer["name"]], "by_hand": True} if answer["name"] in marks else answer
        for answer in record["answers"]
    ]
    former = {answer["name"]: answer["marks"] for answer in record["answers"]} | {TOTAL: record["total"]}
    most = {answer["name"]: answer["of"] for answer in record["answers"]} | {TOTAL: record["of"]}
    total = marks.get(TOTAL, math.fsum(float(answer["marks"]) for answer in answers))
    told = [exercise.tell(_told(one, most[one.answer])) for one in overrides]
    kept = [{**vars(one), "found": former[one.answer]} for one in overrides]
    return {
        **{name: value for name, value in record.items() if name != "handed_in"},
        "answers": answers,
        "total": total,
        "feedback": [*_left(record, answers, total), *told],
        # Of work on paper nothing is to be said about files.
        "notes": record["notes"] if is_handed_in(record) else [],
        "overrides": kept,
    }


def _left(record: dict[str, Any], answers: Sequence[dict[str, Any]], total: float) -> list[str]:
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


def _told(one: Override, most: float) -> Caption:
    said: dict[str, Any] = {"marks": one.marks, "of": most, "comment": one.comment}
    if one.answer == TOTAL:
        if one.comment:
            return say("Your teacher gives {marks:g} of {of:g} marks in total: {comment}", **said)
        return say("Your teacher gives {marks:g} of {of:g} marks in total.", **said)
    if one.comment:
        return say("{name}: your teacher gives {marks:g} of {of:g} marks: {comment}", name=one.answer, **said)
    return say("{name}: your teacher gives {marks:g} of {of:g} marks.", name=one.answer, **said)

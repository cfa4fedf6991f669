"""Who has handed in, and what a teacher should look at; files without any answer are the handouts, and earn nothing."""

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.course.submissions import HandIn
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.grading.overrides import Override
from graphcam.exercises.marking.copy_detection import AlikePair
from graphcam.exercises.marking.record import is_handed_in
from graphcam.exercises.reading.submission_files import NO_ANSWERS_REMARK, NO_FILES_REMARK
from graphcam.exercises.reports.group_page import is_unanswered
from graphcam.words import Caption, say

MAX_NAMED_STUDENTS = 5
"""Students that a line names; the page names all."""


def not_handed_in(
    called: Mapping[str, str], graded: Sequence[Mapping[str, Any]], unread: Collection[str]
) -> list[Caption]:
    """A line on who of the course has handed nothing in; none where everybody has.

    called : the students of the course by id
    graded : the records of those who have;  unread : who has handed in what cannot be read

    >>> print(*not_handed_in({"s1": "", "s2": "Ben"}, [{"student": "s1"}], []))
    not handed in: s2
    """
    there = {record["student"] for record in graded}
    missing = sorted(student for student in called if student not in there and student not in unread)
    return [say("not handed in: {names}", names=", ".join(missing))] if missing else []


def to_check(
    records: Sequence[Mapping[str, Any]],
    unread: Collection[str],
    pairs: Sequence[AlikePair],
    awaiting: Sequence[str],
    page: str,
) -> list[Caption]:
    """What needs a look, a line each; none where nothing does.

    unread : who has handed in what cannot be read
    pairs : who agrees beyond chance;  awaiting : whose photographs nobody has looked at
    page : the file that tells all

    >>> print(*to_check([], ["s1"], [], [], "grades.html"))
    to check: submissions without readable answers: 1 (s1); see grades.html
    """
    silent = sorted({*unread, *(record["student"] for record in records if is_unanswered(record))})
    exact = [record["student"] for record in records if is_handed_in(record) and record["too_exact"]]
    agree = [f"{pair.student} and {pair.other}" for pair in pairs]
    lines = (
        (silent, say("to check: submissions without readable answers: {count} ({some}); see {page}")),
        (agree, say("to check: pairs that agree too well: {count} ({some}); see {page}")),
        (exact, say("to check: readings as exact as by a program: {count} ({some}); see {page}")),
        (awaiting, say("to check: drawings that await review: {count} ({some}); see {page}")),
    )
    return [line.with_values(count=len(found), some=_some(found), page=page) for found, line in lines if found]


def _some(students: Sequence[str]) -> str:
    """The first ones, and a sign that there are more."""
    return ", ".join([*students[:MAX_NAMED_STUDENTS], *(["..."] if len(students) > MAX_NAMED_STUDENTS else [])])


def with_paper(hand_ins: Sequence[HandIn], by_hand: Sequence[Override], folder: Path) -> list[HandIn]:
    """The hand-ins with those who have a total by hand for work on paper, and handed in no file.

    folder : one that is there, of which no file is theirs
    """
    absent = sorted({one.student for one in by_hand} - {one.student for one in hand_ins})
    paper = [HandIn(student, folder_name(student), folder, {}) for student in absent]
    return sorted([*hand_ins, *paper], key=lambda one: one.student)


def with_absence(
    exercise: Exercise, hand_ins: Sequence[HandIn], records: Sequence[dict[str, Any]]
) -> list[dict[str, Any]]:
    """The records; those of hand-ins that say nothing, or nothing that can be read, have "handed_in" False."""
    quiet = {exercise.tell(said) for said in (NO_FILES_REMARK, NO_ANSWERS_REMARK)}
    found: list[dict[str, Any]] = []
    for one, record in zip(hand_ins, records, strict=True):
        missing = all(answer["outcome"] == "missing" for answer in record["answers"])
        absent = one.unread or (missing and set(record["notes"]) <= quiet)
        found.append({**record, "handed_in": False} if absent else record)
    return found


def unreadable_hand_ins(hand_ins: Sequence[HandIn], records: Sequence[dict[str, Any]]) -> list[HandIn]:
    """The hand-ins of which nothing can be read, of students without marks by hand."""
    absent = {record["student"] for record in records if not is_handed_in(record)}
    return [one for one in hand_ins if one.unread and one.student in absent]

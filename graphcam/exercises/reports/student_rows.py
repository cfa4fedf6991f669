"""All students of a course in one table: marks, marks by hand, what is remarked, a link to the page."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from graphcam.exercises.marking.record import is_handed_in
from graphcam.words import Caption, Words, say


@dataclass(frozen=True)
class StudentRow:
    """One student.

    marks : None of one who has not handed in;  of : possible
    remarks : what a teacher should look at;  link : the student's page; empty where there is none
    """

    student: str
    name: str
    marks: float | None
    of: float
    by_hand: bool = False
    remarks: tuple[Words, ...] = ()
    link: str = ""


NOTHING: Caption = say("not handed in")
UNREAD: Caption = say("no answer can be read; the student's page says why")
UNANSWERED = ("missing", "unreadable")
"""Outcomes of an answer of which nothing can be marked."""


def student_rows(
    records: Sequence[Mapping[str, Any]], names: Mapping[str, str], links: Mapping[str, str], of: float
) -> list[StudentRow]:
    """A row a student: of the records, and of those who have a name and no record, by their ids.

    of : the possible marks
    """
    rows = {one["student"]: _row(one, names.get(one["student"], ""), links.get(one["student"], "")) for one in records}
    missing = {student: StudentRow(student, name, None, of, remarks=(NOTHING,)) for student, name in names.items()}
    return [row for _, row in sorted((missing | rows).items())]


def _row(record: Mapping[str, Any], name: str, link: str) -> StudentRow:
    remarks: list[Words] = list(record["notes"])
    if not is_handed_in(record):
        # The last one says that there is no answer; those before it say why.
        why = tuple(remarks[:-1]) or (NOTHING,)
        return StudentRow(record["student"], name, None, record["of"], remarks=why, link=link)
    if record["too_exact"]:
        remarks.append(say("as exact as a program"))
    if is_unanswered(record):
        remarks.insert(0, UNREAD)
    by_hand = "overrides" in record
    return StudentRow(record["student"], name, record["total"], record["of"], by_hand, tuple(remarks), link)


def is_unanswered(record: Mapping[str, Any]) -> bool:
    """Whether something was handed in and no answer of it can be marked, nor is anything given by hand."""
    nothing = all(answer["outcome"] in UNANSWERED for answer in record["answers"])
    return is_handed_in(record) and nothing and "overrides" not in record

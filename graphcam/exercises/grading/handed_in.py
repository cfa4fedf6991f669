"""Who has handed in: files without any answer are the handouts, and earn no nought but nothing."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from graphcam.exercises.course.hand_ins import HandIn
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.grading.overrides import Override
from graphcam.exercises.marking.record import is_handed_in
from graphcam.exercises.reading.submission_files import NO_FILES, NONE_GIVEN


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
    quiet = {exercise.tell(said) for said in (NO_FILES, NONE_GIVEN)}
    return [
        {**record, "handed_in": False} if one.unread or _is_empty(record, quiet) else record
        for one, record in zip(hand_ins, records, strict=True)
    ]


def _is_empty(record: dict[str, Any], quiet: set[str]) -> bool:
    """Whether nothing is answered, and nothing else is to be said of it than that.

    quiet : the sentences that say so
    """
    return all(answer["outcome"] == "missing" for answer in record["answers"]) and set(record["notes"]) <= quiet


def unread(hand_ins: Sequence[HandIn], records: Sequence[dict[str, Any]]) -> list[HandIn]:
    """The hand-ins of which nothing can be read, of students without marks by hand."""
    absent = {record["student"] for record in records if not is_handed_in(record)}
    return [one for one in hand_ins if one.unread and one.student in absent]

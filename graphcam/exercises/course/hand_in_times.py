"""When something was handed in: by a table of the learning system, by the name it gave, or by the files' own times."""

import os
import re
import stat
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal

from graphcam.exercises.course.hand_ins import HandIn, answers_folder
from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.student_table import StudentLine, once, student_lines
from graphcam.exercises.reading.submission_files import answer_files
from graphcam.words import say

SUBMITTED_TIMES = "submitted.csv"
"""The teacher's table of when each student handed in, as the learning system says."""
TIME_FORM = say("a date and a time such as 2026-12-01T23:59 or 2026-12-01T23:59+01:00")
NAMED = re.compile(r"(\d{4}-\d\d-\d\d)-(\d\d)-(\d\d)-(\d\d)")
"""A time as Blackboard writes it into a name."""
TimeSource = Literal["table", "name", "file", ""]
"""What a time was taken from; empty where none is known."""
TimeTable = Mapping[tuple[str, str], datetime]
"""By student and attempt, which is empty where the table does not say which one it was."""


@dataclass(frozen=True)
class HandInTime:
    """The time of a hand-in, None where nothing tells it, and its source."""

    at: datetime | None
    source: TimeSource


def moment(text: str) -> datetime | None:
    """A time with its zone, that of the machine where the text names none; None of a text that is no date and time.

    >>> moment("2026-12-01T23:59+01:00").isoformat(), moment("2026-12-01 22:59:30 UTC").isoformat()
    ('2026-12-01T23:59:00+01:00', '2026-12-01T22:59:30+00:00')
    >>> moment("2026-12-01"), moment("tomorrow"), moment("0001-01-01T00:00")
    (None, None, None)
    """
    text = text.strip()
    if len(text) <= len("2026-12-01"):
        # Of a date alone nobody knows whether the day belongs to it.
        return None
    try:
        said = datetime.fromisoformat(text.removesuffix(" UTC") + ("+00:00" if text.endswith(" UTC") else ""))
        return said if said.tzinfo else said.astimezone()
    except (ValueError, OverflowError):
        return None


def shown_time(text: str) -> str:
    """A time as people read it, of one in ISO 8601: to the minute, in the zone that it was written in.

    >>> shown_time("2026-11-25 22:02:07+00:00"), shown_time("")
    ('2026-11-25 22:02', '')
    """
    return text[: len("2026-11-25 22:02")]


def read_times(path: Path, known: Recognition) -> dict[tuple[str, str], datetime]:
    """The times of hand-ins from a CSV file with the columns student, submitted and perhaps attempt.

    A line without a time says that nothing was handed in.

    Raises
    ------
    TaskError : the file cannot be read, or a line of it names a student, a time or an attempt that cannot be
    """
    lines = student_lines(path, say("the table of times"), ("student", "submitted"), known)
    remedy = say("give each attempt of a student once, with its number in a column 'attempt'")
    filled = [line for line in once(lines, ("attempt",), remedy) if line["submitted"]]
    return {(line.student, _number(line)): time_in(line, "submitted") for line in filled}


def _number(line: StudentLine) -> str:
    said = line["attempt"]
    if said and not re.fullmatch(r"\d{1,4}", said):
        raise line.wrong("attempt", say("the number of an attempt, or empty"), say("correct the line"))
    return str(int(said)) if said else ""


def time_in(line: StudentLine, column: str) -> datetime:
    """The time in a cell of a table.

    Raises
    ------
    TaskError : it is none
    """
    found = moment(line[column])
    if found is None:
        raise line.wrong(column, TIME_FORM, say("correct the line"))
    return found


def hand_in_times(hand_ins: Sequence[HandIn], table: TimeTable, assignment: str) -> list[HandInTime]:
    """The time of each hand-in: the table counts before the name, and the name before the files.

    A line of the table that names no attempt is about the student's last one.

    assignment : name of the folder in a student's that counts if it is there
    """
    last = {one.student: one.place for one in hand_ins}
    found: list[HandInTime] = []
    for one in hand_ins:
        said = table.get((one.student, str(one.attempt)))
        if said is None and last[one.student] == one.place:
            said = table.get((one.student, ""))
        found.append(HandInTime(said, "table") if said else _own_time(one, assignment))
    return found


def _own_time(one: HandIn, assignment: str) -> HandInTime:
    if named := NAMED.fullmatch(one.time):
        day, *clock = named.groups()
        if said := moment(f"{day}T{':'.join(clock)}"):
            return HandInTime(said, "name")
    newest = _newest(answers_folder(one, assignment), one.names)
    return HandInTime(newest, "file" if newest else "")


def _newest(folder: Path, names: Mapping[str, str] | None) -> datetime | None:
    """The time of the last change of the newest answer file; None where there is none."""
    try:
        there = names if names is not None else {name: name for name in os.listdir(folder)}  # noqa: PTH208
        chosen = [folder / there[name] for name in answer_files(there)[0].values()]
        return _latest(path.lstat() for path in chosen)
    except (OSError, OverflowError, ValueError):
        return None


def _latest(found: Iterable[os.stat_result]) -> datetime | None:
    changed = [each.st_mtime for each in found if stat.S_ISREG(each.st_mode)]
    return datetime.fromtimestamp(max(changed), UTC) if changed else None

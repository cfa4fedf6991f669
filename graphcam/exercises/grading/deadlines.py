"""Until when a hand-in is in time, for whom longer, and what a late one loses."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from pathlib import Path

from graphcam.errors import DesignError
from graphcam.exercises.course.hand_in_times import TIME_FORM, moment, time_in
from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.student_table import once, student_lines
from graphcam.words import say

EXTENSIONS = "extensions.csv"
"""The teacher's table of deadlines of single students."""
PERIODS = {"day": timedelta(days=1), "hour": timedelta(hours=1)}
PENALTY_FORM = say(
    "the part lost per started day or hour, and perhaps the minimum part left, such as 0.1/day or 0.1/day:0.5"
)


@dataclass(frozen=True)
class Deadlines:
    """The deadlines of a course; seconds do not count.

    usual : for all but those who are named in ``extended``, by their ids
    """

    usual: datetime
    extended: Mapping[str, datetime] = field(default_factory=dict[str, datetime])

    def of(self, student: str) -> datetime:
        """The student's deadline."""
        return self.extended.get(student, self.usual)

    @property
    def last(self) -> datetime:
        """The latest deadline of all."""
        return max([self.usual, *self.extended.values()])

    def past(self, now: datetime) -> bool:
        """Whether nobody can hand in in time any more."""
        return now >= self.last.replace(second=0, microsecond=0) + timedelta(minutes=1)

    def late(self, student: str, at: datetime) -> timedelta:
        """How long after the student's deadline a hand-in came; zero where it was in time.

        >>> deadlines = Deadlines(datetime.fromisoformat("2026-12-01T23:59+01:00"))
        >>> times = [datetime.fromisoformat(f"2026-12-{at}Z") for at in ("01T22:59:58", "02T23:00:01")]
        >>> [str(deadlines.late("s1", at)) for at in times]
        ['0:00:00', '1 day, 0:01:00']
        """
        whole = at.replace(second=0, microsecond=0)
        return max(whole - self.of(student).replace(second=0, microsecond=0), timedelta())


@dataclass(frozen=True)
class LatePenalty:
    """What a late hand-in loses of the marks that it earned.

    part : lost for every period that has begun;  period : "day" or "hour";  least : the part that is left however late
    """

    part: float
    period: str = "day"
    least: float = 0.0

    def left(self, late: timedelta) -> float:
        """The part of the marks that is left.

        >>> penalty = LatePenalty(0.1, least=0.5)
        >>> [penalty.left(timedelta(hours=hours)) for hours in (0, 1, 24, 25, 1000)]
        [1.0, 0.9, 0.9, 0.8, 0.5]
        """
        begun = math.ceil(late / PERIODS[self.period])
        # Ten digits, so that three tenths off one are seven tenths.
        return round(max(1.0 - self.part * begun, self.least), 10) if begun else 1.0


def deadline_of(text: str) -> datetime:
    """A deadline as it is written on the command line.

    Raises
    ------
    DesignError : it is no date and time
    """
    found = moment(text)
    if found is None:
        raise DesignError("--deadline", text, TIME_FORM, say("give the time of the day too"))
    return found


def late_penalty_of(text: str) -> LatePenalty:
    """A penalty as it is written on the command line.

    Raises
    ------
    DesignError : it is no part of the marks per period

    >>> late_penalty_of("0.1/day:0.5")
    LatePenalty(part=0.1, period='day', least=0.5)
    """
    found = re.fullmatch(r"(\d*\.?\d+)/(day|hour)(?::(\d*\.?\d+))?", text.strip())
    if not found or not 0 < float(found[1]) <= 1 or float(found[3] or 0) > 1:
        raise DesignError("--late", text, PENALTY_FORM, say("parts go from 0 to 1"))
    return LatePenalty(float(found[1]), found[2], float(found[3] or 0))


def read_extensions(path: Path, known: Recognition) -> dict[str, datetime]:
    """The deadlines of single students, from a CSV file with the columns student and deadline.

    Raises
    ------
    TaskError : the file cannot be read, or a line of it names a student or a deadline that cannot be
    """
    lines = student_lines(path, say("the table of extensions"), ("student", "deadline"), known)
    return {line.student: time_in(line, "deadline") for line in once(lines, (), say("give each student once"))}

"""Who is who on the pages: the students' ids, or names that hide them.

Hidden names are made from the course's secret, so that only its keeper can find who it is.
"""

import base64
import hashlib
import hmac
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from graphcam.exercises.course.submissions import Refused
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.copy_detection import AlikePair
from graphcam.words import say


@dataclass(frozen=True)
class ShownNames:
    """The names by which the pages show the students.

    hidden : a name for each student's id; empty where the ids are shown

    >>> ShownNames({"s1": "k7f2qd"}).name_of("s1"), ShownNames().name_of("s1")
    ('k7f2qd', 's1')
    """

    hidden: Mapping[str, str] = field(default_factory=dict[str, str])

    def name_of(self, student: str) -> str:
        """The student's name on the pages."""
        return self.hidden[student] if self.hidden else student

    def records(self, records: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
        """The records under these names, in their order: that of the ids would tell something of who it is."""
        named = [{**record, "student": self.name_of(record["student"])} for record in records]
        return sorted(named, key=lambda record: record["student"]) if self.hidden else named

    def answer_keys(self, answer_keys: Mapping[str, AnswerKey]) -> Mapping[str, AnswerKey]:
        """The answer keys by these names."""
        if not self.hidden:
            return answer_keys
        return {self.name_of(student): answer_key for student, answer_key in answer_keys.items()}

    def pairs(self, pairs: Sequence[AlikePair]) -> list[AlikePair]:
        """The pairs who agree, under these names."""
        return [replace(pair, student=self.name_of(pair.student), other=self.name_of(pair.other)) for pair in pairs]

    def refused(self, refused: Sequence[Refused], table: str) -> list[Refused]:
        """What is not graded; folders have the names of students, so where those are hidden only their number is told.

        table : name of the file that tells all
        """
        if not self.hidden or not refused:
            return list(refused)
        return [Refused(table, say("it lists what was not graded, {count} in total", count=len(refused)))]


NAME_LENGTH = 6
"""Letters of a name: of 3000 students two agree in so many in one course out of 240."""


def hidden_names(secret: bytes, exercise: str, students: Iterable[str]) -> dict[str, str]:
    """A name of small letters and digits for each student, another one in every exercise; no two are the same.

    >>> names = hidden_names(b"secret", "whole-cam", ["s1", "s2"])
    >>> len(set(names.values())), len(names["s1"])
    (2, 6)
    >>> names["s1"] == hidden_names(b"secret", "integration", ["s1"])["s1"]
    False
    """
    whole = {student: _name(secret, exercise, student) for student in students}
    length = NAME_LENGTH
    # Of the whole digests no two agree.
    while len({name[:length] for name in whole.values()}) < len(whole):
        length += 1
    return {student: name[:length] for student, name in whole.items()}


def _name(secret: bytes, exercise: str, student: str) -> str:
    # No name of an exercise has a zero in it, so the two parts stand apart.
    said = f"graphcam hidden name\0{exercise}\0{student}".encode("utf-8", "surrogatepass")
    return base64.b32encode(hmac.digest(secret, said, hashlib.sha256)).decode("ascii").rstrip("=").lower()

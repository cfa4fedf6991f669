"""Who is who on the pages: the students' ids, or names that hide them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from graphcam.exercises.course.hand_ins import Refused
from graphcam.exercises.course.regrade_requests import RegradeRequest
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.copies import AlikePair
from graphcam.words import say


@dataclass(frozen=True)
class ShownNames:
    """How the pages name the students.

    hidden : a name for each student's id; empty where the ids are shown

    >>> ShownNames({"s1": "k7f2qd"}).of("s1"), ShownNames().of("s1")
    ('k7f2qd', 's1')
    """

    hidden: Mapping[str, str] = field(default_factory=dict[str, str])

    def of(self, student: str) -> str:
        """The student's name on the pages."""
        return self.hidden[student] if self.hidden else student

    def records(self, records: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
        """The records under these names, in their order: that of the ids would tell something of who it is."""
        named = [{**record, "student": self.of(record["student"])} for record in records]
        return sorted(named, key=lambda record: record["student"]) if self.hidden else named

    def answer_keys(self, answer_keys: Mapping[str, AnswerKey]) -> Mapping[str, AnswerKey]:
        """The answer keys by these names."""
        if not self.hidden:
            return answer_keys
        return {self.of(student): answer_key for student, answer_key in answer_keys.items()}

    def pairs(self, pairs: Sequence[AlikePair]) -> list[AlikePair]:
        """The pairs who agree, under these names."""
        return [replace(pair, student=self.of(pair.student), other=self.of(pair.other)) for pair in pairs]

    def requests(self, requests: Sequence[RegradeRequest]) -> list[RegradeRequest]:
        """The questions under these names."""
        return [replace(request, student=self.of(request.student)) for request in requests]

    def refused(self, refused: Sequence[Refused], table: str) -> list[Refused]:
        """What is not graded; folders have the names of students, so where those are hidden only their number is told.

        table : name of the file that tells all
        """
        if not self.hidden or not refused:
            return list(refused)
        return [Refused(table, say("it lists what was not graded, {count} in total", count=len(refused)))]

"""The answer keys of a course, read one by one as they are needed: together they would fill the memory."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import AnswerKeys
from graphcam.exercises.key.answer_key import AnswerKey


@dataclass(frozen=True)
class KeysAsNeeded(Mapping[str, AnswerKey]):
    """Answer keys by student, each read anew whenever it is asked for; who has none that can be read is left out.

    kept : where they are;  students : whose
    """

    kept: AnswerKeys
    students: Sequence[str]

    def __getitem__(self, student: str) -> AnswerKey:
        try:
            return AnswerKey.from_json(self.kept.find(student))
        except TaskError:
            raise KeyError(student) from None

    def __iter__(self) -> Iterator[str]:
        return (student for student in self.students if student in self)

    def __len__(self) -> int:
        return sum(1 for _ in self)

"""The tables that a teacher keeps beside the answer keys, and what they make of marks that were found."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Any

from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import AnswerKeys
from graphcam.exercises.course.hand_in_times import SUBMITTED_TIMES, HandInTime, hand_in_times, read_times
from graphcam.exercises.course.hand_ins import HandIn, course_students
from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.regrade_requests import REQUESTS, RegradeRequest, read_requests
from graphcam.exercises.course.roster import Student, folder_name
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.grading.attempts import AttemptRule, counted
from graphcam.exercises.grading.deadlines import EXTENSIONS, Deadlines, LatePenalty, read_extensions
from graphcam.exercises.grading.handed_in import with_absence
from graphcam.exercises.grading.lateness import NO_PENALTY, LateRules, penalised, timed
from graphcam.exercises.grading.overrides import OVERRIDES, TOTAL, Override, overridden, read_overrides
from graphcam.words import say


@dataclass(frozen=True)
class HandedInCourse:
    """A course as handed in: its students' hand-ins, and where the teacher's tables are.

    roster : of the students, instead of the one that was kept
    """

    kept: AnswerKeys
    exercise: Exercise
    hand_ins: Sequence[HandIn]
    roster: Path | None

    def table(self, name: str) -> Path | None:
        """A table in the teacher's folder; None where there is none."""
        path = self.kept.folder / name
        return path if path.exists() else None

    def students(self) -> Recognition:
        """The students of the course; where nobody said who they are, those who handed in."""
        return course_students(self.kept, self.roster) or Recognition(Student(one.student) for one in self.hand_ins)

    def who_handed_in(self) -> Recognition:
        """The students who handed in."""
        names = self.ids()
        return Recognition(student for student in self.students().ids.values() if student.id in names)

    def with_paper(self, overrides: Path | None) -> "HandedInCourse":
        """The course with those who have a total by hand for work on paper, and handed in no file.

        overrides : marks by hand, instead of those in the teacher's folder

        Raises
        ------
        TaskError : the marks by hand cannot be used
        """
        marks = overrides or self.table(OVERRIDES)
        listed = read_overrides(marks, self.exercise, self.students(), self.ids()) if marks else []
        absent = sorted({one.student for one in listed} - self.ids())
        # A folder that is there, of which no file is theirs.
        paper = [HandIn(student, folder_name(student), self.kept.folder, {}) for student in absent]
        every = sorted([*self.hand_ins, *paper], key=lambda one: (one.student, one.attempt, one.place))
        return replace(self, hand_ins=every if paper else self.hand_ins)

    def ids(self) -> set[str]:
        """Their ids."""
        return {one.student for one in self.hand_ins}


def late_rules(course: HandedInCourse, deadline: datetime | None, penalty: LatePenalty) -> LateRules | None:
    """The deadline, extensions and the penalty; None where there is no deadline.

    Raises
    ------
    TaskError : a penalty without a deadline, or extensions that cannot be used
    """
    if deadline is None:
        if penalty != NO_PENALTY:
            what = say("the deadline")
            raise TaskError("--late", what, say("not given"), say("given"), say("name it with --deadline"))
        return None
    path = course.table(EXTENSIONS)
    return LateRules(Deadlines(deadline, read_extensions(path, course.students()) if path else {}), penalty)


@dataclass(frozen=True)
class TeacherTables:
    """What a teacher said of the hand-ins of a course.

    late : until when they are in time; None where there is no deadline, and then there are no ``times`` either
    """

    course: HandedInCourse
    attempts: AttemptRule
    by_hand: Sequence[Override]
    requests: Sequence[RegradeRequest]
    late: LateRules | None
    times: Sequence[HandInTime]

    @staticmethod
    def read(
        course: HandedInCourse, overrides: Path | None, late: LateRules | None, attempts: AttemptRule
    ) -> "TeacherTables":
        """All tables that are there.

        overrides : marks by hand, instead of those in the teacher's folder

        Raises
        ------
        TaskError : one cannot be used
        """
        exercise = course.exercise
        marks, asked = overrides or course.table(OVERRIDES), course.table(REQUESTS)
        by_hand = read_overrides(marks, exercise, course.students(), course.ids()) if marks else []
        answers = [*(answer.name for answer in exercise.answers), TOTAL]
        requests = read_requests(asked, answers, course.who_handed_in()) if asked else []
        times: list[HandInTime] = []
        if late is not None:
            submitted = course.table(SUBMITTED_TIMES)
            table = read_times(submitted, course.students()) if submitted else {}
            times = hand_in_times(course.hand_ins, table, exercise.name)
        return TeacherTables(course, attempts, by_hand, requests, late, times)

    def settled(self, records: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
        """A record for each student, with the marks that the teacher's tables leave of those that were found.

        records : one a hand-in, in their order
        """
        exercise = self.course.exercise
        records = with_absence(exercise, self.course.hand_ins, records)
        if self.late is not None:
            records = [timed(record, time, self.late) for record, time in zip(records, self.times, strict=True)]
        records = counted(exercise, self.course.hand_ins, records, self.attempts)
        return penalised(exercise, overridden(exercise, records, self.by_hand))

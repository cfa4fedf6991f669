"""How long a student's papers take to make, and how many hand-ins a second a whole course takes, files and all."""

import json
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import cycle, islice
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from graphcam.bench.timing import Timer
from graphcam.constructions.chain import Chain
from graphcam.exercises.course.course_folder import STUDENTS_FOLDER, TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.course_making import papers
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Exercise, Given
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.grading.grade_one import Assignment, Submission, grade
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import answers_of
from graphcam.exercises.key.key_making import issue
from graphcam.exercises.marking.course_variants import course_variants
from graphcam.exercises.reading.submission_files import TOML

STUDENT_NAME, SECRET = "speed", b"speed"
HANDS = 60
"""Students of each kind."""
POINT_DECIMALS = 2
"""Decimals of drawn points, mm of paper: nobody measures finer."""


@dataclass(frozen=True)
class MarkingSpeed:
    """Submissions that are read and marked in a second of the processor's time, from their bytes to their records.

    careful : of careful students
    wrong : of students with every mistake of the catalogue, as many with each; there the mistake is looked for
    """

    exercise: str
    careful: float
    wrong: float


def marking_speed(exercise: Exercise, timer: Timer | None = None) -> MarkingSpeed:
    """The speed of marking simulated students, whose answers are read from an ``answers.toml``, points of a curve too.

    Raises
    ------
    DesignError : no variant can be diagnosed
    """
    timer, assignment = timer or Timer(), Assignment(exercise, SECRET)
    careful, wrong = simulated(exercise)

    def graded(submissions: list[Submission]) -> Callable[[], object]:
        """What grades submissions, one after the other."""
        return lambda: [grade(assignment, submission) for submission in submissions]

    speeds = (len(each) / timer.seconds(graded(each)) for each in (careful, wrong))
    return MarkingSpeed(exercise.name, *speeds)


def simulated(exercise: Exercise) -> tuple[list[Submission], list[Submission]]:
    """Submissions of one variant: of careful students, and of others with every mistake."""
    variant, answer_key = issue(exercise, STUDENT_NAME, SECRET)
    chain = board_chain(variant.task, exercise.hand.pencil(HANDS, seed=1))
    wrong = (_submissions(exercise, answer_key, misconception(name).change(chain)) for name in exercise.misconceptions)
    return _submissions(exercise, answer_key, chain), [one for some in wrong for one in some]


def _submissions(exercise: Exercise, answer_key: AnswerKey, chain: Chain) -> list[Submission]:
    text, drawn = answer_key.to_json(), answers_of(exercise, chain)
    found: list[Submission] = []
    for hand in range(HANDS):
        given = {asked.name: _given(answers[hand]) for asked, answers in zip(exercise.answers, drawn, strict=True)}
        # As a student fills it in, every answer on a line.
        lines = "".join(f"{name} = {json.dumps(answer)}\n" for name, answer in given.items())
        found.append(Submission(STUDENT_NAME, STUDENT_NAME, {TOML: lines.encode()}, (), text))
    return found


def _given(answer: Given) -> float | list[list[float]]:
    if not isinstance(answer, np.ndarray):
        return float(answer)
    return np.round(np.column_stack([answer.real, answer.imag]), POINT_DECIMALS).tolist()


MADE_STUDENTS = 4
"""Students whose papers are made; those of the first, for which the libraries are loaded, do not count."""
GRADED_STUDENTS = 500
"""Students of the course that is graded."""


@dataclass(frozen=True)
class CourseSpeed:
    """What a course costs, in time of the processor.

    papers : seconds for the papers of a student, the variant included
    graded : hand-ins a second, from their folders to the files with the grades, start of the worker included
    """

    papers: float
    graded: float


def course_speed(name: str) -> CourseSpeed:
    """Measured with an exercise, by its name or its file.

    Raises
    ------
    GraphcamError : there is no such exercise, or no variant can be diagnosed
    """
    exercise = find_exercise(name)
    with TemporaryDirectory(prefix="graphcam-") as scratch:
        course = course_at(Path(scratch), name, exercise)
        before = os.times()
        grade_course(course)
        # The worker has ended, so its time counts.
        spent = sum(os.times()[:4]) - sum(before[:4])
    return CourseSpeed(_papers_seconds(exercise), GRADED_STUDENTS / spent)


def course_at(place: Path, name: str, exercise: Exercise) -> Course:
    """A course of careful students with an ``answers.toml`` each.

    The answers and keys are those of one variant, written for every student: to issue as many takes minutes.
    """
    careful, _ = simulated(exercise)
    kept = AnswerKeys(place / TEACHER_FOLDER)
    kept.keep_course(exercise_path(name), SECRET, version=exercise.version)
    (place / "secret").write_bytes(SECRET)
    issued = AnswerKey.from_json(careful[0].answer_key)
    for k, submission in enumerate(islice(cycle(careful), GRADED_STUDENTS)):
        student = f"student-{k}"
        own = drawn(exercise, student, SECRET, issued.draw).parameters
        kept.keep(student, replace(issued, student=student, parameters=own).to_json())
        folder = place / STUDENTS_FOLDER / student
        folder.mkdir(parents=True)
        for file, data in submission.files.items():
            (folder / file).write_bytes(data)
    return Course(place, place / "secret", place / "grades" / "grades.csv")


def _papers_seconds(exercise: Exercise) -> float:
    students = [Student(f"student-{k}") for k in range(MADE_STUDENTS)]
    jobs = zip(students, course_variants(exercise, (each.id for each in students), SECRET), strict=True)
    papers(next(jobs))
    start = time.process_time()
    for job in jobs:
        papers(job)
    return (time.process_time() - start) / (MADE_STUDENTS - 1)

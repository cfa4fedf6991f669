"""How long a student's papers take to make, and how many hand-ins a second a whole course takes, files and all."""

import os
import time
from dataclasses import dataclass, replace
from itertools import cycle, islice
from pathlib import Path
from tempfile import TemporaryDirectory

from graphcam.exercises.course.course_folder import STUDENTS, TEACHER, AnswerKeys
from graphcam.exercises.course.make import papers
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.grading.marking_speed import SECRET, simulated
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.course_variants import course_variants

MADE = 4
"""Students whose papers are made; those of the first, for which the libraries are loaded, do not count."""
GRADED = 500
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
    return CourseSpeed(_papers_seconds(exercise), GRADED / spent)


def course_at(place: Path, name: str, exercise: Exercise) -> Course:
    """A course of careful students with an ``answers.toml`` each.

    The answers and keys are those of one variant, written for every student: to issue as many takes minutes.
    """
    careful, _ = simulated(exercise)
    kept = AnswerKeys(place / TEACHER)
    kept.keep_course(exercise_path(name), SECRET, version=exercise.version)
    (place / "secret").write_bytes(SECRET)
    issued = AnswerKey.from_json(careful[0].answer_key)
    for k, submission in enumerate(islice(cycle(careful), GRADED)):
        student = f"student-{k}"
        own = drawn(exercise, student, SECRET, issued.draw).parameters
        kept.keep(student, replace(issued, student=student, parameters=own).to_json())
        folder = place / STUDENTS / student
        folder.mkdir(parents=True)
        for file, data in submission.files.items():
            (folder / file).write_bytes(data)
    return Course(place, place / "secret", place / "grades" / "grades.csv")


def _papers_seconds(exercise: Exercise) -> float:
    students = [Student(f"student-{k}") for k in range(MADE)]
    jobs = zip(students, course_variants(exercise, (each.id for each in students), SECRET), strict=True)
    papers(next(jobs))
    start = time.process_time()
    for job in jobs:
        papers(job)
    return (time.process_time() - start) / (MADE - 1)

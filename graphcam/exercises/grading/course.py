"""What ``graphcam exercise grade`` does: one course, from its folder to its reports."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing, suppress
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import GraphcamError, TaskError
from graphcam.exercises.certificate import Certificate
from graphcam.exercises.course_folder import Certificates, read_secret
from graphcam.exercises.exercise import Exercise
from graphcam.exercises.exercise_file import find_exercise
from graphcam.exercises.grading.crew import Crew, cluster, processes
from graphcam.exercises.grading.run import Records, grade_folder
from graphcam.exercises.grading.store import Store
from graphcam.exercises.grading.work import Assignment
from graphcam.exercises.reports.files import write_feedback, write_reports
from graphcam.exercises.running.levels import Level
from graphcam.exercises.running.limits import Limits
from graphcam.exercises.running.probe import require
from graphcam.files import OutputError


@dataclass(frozen=True)
class Course:
    """An order to grade.

    folder : with a folder for every student
    out : the file for the grades
    exercise : its name; empty where the folder says it
    level, seconds : where and how long the code of notebooks runs
    workers, cluster : processes here, or the address of a dask scheduler
    feedback : folder for the students' pages
    gradebook : database of nbgrader that the scores go into too
    """

    folder: Path
    secret_file: Path
    out: Path
    exercise: str = ""
    level: Level = Level.L0
    seconds: float = 10.0
    workers: int = 1
    cluster: str = ""
    feedback: Path | None = None
    gradebook: str = ""


def grade_course(course: Course, step: Callable[[int, int], None] = lambda done, total: None) -> str:
    """Grade a course and write its reports; what was done, in a sentence.

    Raises
    ------
    GraphcamError : wrong input, or a level of isolation that there is not here
    """
    if course.out.is_dir():
        raise OutputError(course.out, "it is a folder", "name a file, grades.csv")
    folder, kept = Certificates.of(course.folder)
    exercise = find_exercise(course.exercise or _noted(course.folder, kept), kept.language())
    require(course.level, (course.folder, course.secret_file, course.out))
    assignment = Assignment(exercise, read_secret(course.secret_file), course.level, Limits(seconds=course.seconds))
    store = Store.beside(course.out, assignment)
    with store.held():
        with closing(_crew(course)) as crew:
            records = grade_folder(folder, assignment, crew, store, kept, step)
        certificates = _certificates(kept, records)
        names = write_reports(course.out, exercise, records, certificates)
        if course.feedback is not None:
            write_feedback(course.feedback, exercise, records, certificates)
        if course.gradebook:
            _enter(course.gradebook, exercise, records)
        store.clear()
    return f"{len(records)} hand-ins, graded at level {course.level}, in {course.out.parent}: {', '.join(names)}"


def _noted(folder: Path, kept: Certificates) -> str:
    if not (noted := kept.exercise()):
        raise TaskError(str(folder), "the exercise", "not noted there", "known", "name it with --exercise")
    return noted


def _crew(course: Course) -> Crew:
    if not course.cluster:
        return processes(course.workers)
    try:
        return cluster(course.cluster)
    except ImportError:
        raise TaskError("--cluster", "dask's distributed", "not installed", "installed",
                        "pip install 'graphcam[cluster]'") from None  # fmt: skip


def _enter(gradebook: str, exercise: Exercise, records: Records) -> None:
    from graphcam.exercises.exports.nbgrader import enter_scores

    try:
        enter_scores(gradebook, exercise, records)
    except ImportError:
        raise TaskError("--gradebook", "nbgrader", "not installed", "installed",
                        "pip install 'graphcam[nbgrader]'") from None  # fmt: skip


def _certificates(kept: Certificates, records: Records) -> dict[str, Certificate]:
    found: dict[str, Certificate] = {}
    for record in records:
        with suppress(GraphcamError):
            found[record["student"]] = Certificate.from_json(kept.find(record["student"]))
    return found

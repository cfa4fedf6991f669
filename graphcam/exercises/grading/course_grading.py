"""What ``graphcam exercise grade`` does: one course, from its folder to its reports."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import GraphcamError, TaskError
from graphcam.exercises.course.course_folder import AnswerKeys, read_secret
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.grading.grade_one import Assignment, grade
from graphcam.exercises.grading.gradebook import check_gradebook, enter_scores
from graphcam.exercises.grading.grading_run import Records, grade_folder
from graphcam.exercises.grading.record_store import Store
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.report_files import write_feedback, write_reports
from graphcam.exercises.running.levels import Level
from graphcam.exercises.running.probe import require
from graphcam.exercises.running.resource_limits import ResourceLimits
from graphcam.files import OutputError
from graphcam.workers import WorkerPool, cluster, processes


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
    _check_places(course)
    folder, kept = AnswerKeys.of(course.folder)
    exercise = _exercise(course, kept)
    require(course.level, (course.folder, course.secret_file, course.out))
    secret = read_secret(course.secret_file)
    kept.check_secret(secret, course.secret_file)
    assignment = Assignment(exercise, secret, course.level, ResourceLimits(seconds=course.seconds))
    if course.gradebook:
        with _installed("--gradebook", "nbgrader", "nbgrader"):
            check_gradebook(course.gradebook)
    store = Store.beside(course.out, assignment)
    with store.held():
        with closing(_worker_pool(course)) as pool:
            records = grade_folder(folder, assignment, pool, store, kept, step)
        answer_keys = _answer_keys(kept, records)
        names = write_reports(course.out, exercise, records, answer_keys)
        if course.feedback is not None:
            write_feedback(course.feedback, exercise, records, answer_keys)
        if course.gradebook:
            enter_scores(course.gradebook, exercise, records)
        store.clear()
    return f"{len(records)} hand-ins, graded at level {course.level}, in {course.out.parent}: {', '.join(names)}"


def _check_places(course: Course) -> None:
    """What must not first come out when all is graded."""
    if not course.folder.is_dir():
        why = "a file" if course.folder.exists() else "not there"
        raise TaskError(str(course.folder), "the folder", why, "one with a folder for every student", "check the name")
    if course.out.is_dir():
        raise OutputError(course.out, "it is a folder", "name a file, grades.csv")
    if course.feedback is not None and course.feedback.exists() and not course.feedback.is_dir():
        raise OutputError(course.feedback, "it is a file", "name a folder for the pages")


def _exercise(course: Course, kept: AnswerKeys) -> Exercise:
    """The exercise that the course is noted to be about, or else the one that is named."""
    noted = kept.exercise()
    if not noted and not course.exercise:
        raise TaskError(str(course.folder), "the exercise", "not noted there", "known", "name it with --exercise")
    exercise = find_exercise(course.exercise or noted, kept.language())
    if noted and exercise.name != Path(noted).stem:
        made_for = f"{Path(noted).stem!r}, which {course.folder} was made for"
        raise TaskError("--exercise", "the exercise", exercise.name, made_for, "leave the option out")
    return exercise


def _worker_pool(course: Course) -> WorkerPool:
    if not course.cluster:
        return processes(course.workers, grade.__module__)
    with _installed("--cluster", "dask's distributed", "cluster"):
        return cluster(course.cluster)


@contextmanager
def _installed(option: str, library: str, extra: str) -> Generator[None]:
    try:
        yield
    except ImportError:
        remedy = f"pip install 'graphcam[{extra}]'"
        raise TaskError(option, library, "not installed", "installed", remedy) from None


def _answer_keys(kept: AnswerKeys, records: Records) -> dict[str, AnswerKey]:
    found: dict[str, AnswerKey] = {}
    for record in records:
        with suppress(GraphcamError):
            found[record["student"]] = AnswerKey.from_json(kept.find(record["student"]))
    return found

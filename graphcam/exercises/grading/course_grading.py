"""A whole course, graded: read, shared out, kept so that an interrupted run resumes, and reported on."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from collections.abc import Callable, Generator, Iterable
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import graphcam
from graphcam.drafting.ink import say
from graphcam.errors import GraphcamError, TaskError, installed
from graphcam.exercises.course.course_folder import AnswerKeys, read_secret
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.grading.grade_one import Assignment, Submission, grade, read_submission, students_in, unmarked
from graphcam.exercises.grading.gradebook import check_gradebook, enter_scores
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.report_files import write_feedback, write_reports
from graphcam.exercises.running.levels import Level, ResourceLimits
from graphcam.exercises.running.probe import require
from graphcam.files import OutputError
from graphcam.workers import BATCH, WorkerPool, results, worker_pool

Records = list[dict[str, Any]]
"""Records as JSON takes them, in the order of the students' names."""
CRASHED = say("the grader broke down over this hand-in; look at it by hand")


@dataclass(frozen=True)
class Store:
    """A folder of finished records, named after what they were graded with: of another assignment they do not count."""

    folder: Path

    @staticmethod
    def beside(out: Path, assignment: Assignment) -> Store:
        """The store of a run that writes to ``out``."""
        # Of the secret only a digest is left, and of that a part.
        secret = hashlib.sha256(b"graphcam store" + assignment.secret).hexdigest()
        said = [graphcam.__version__, repr(assignment.exercise), secret, assignment.level, repr(assignment.limits)]
        return Store(out.parent / f".{out.name}-{hashlib.sha256(repr(said).encode()).hexdigest()[:16]}")

    @contextmanager
    def held(self) -> Generator[None]:
        """Keep other runs out meanwhile: two that write the same records, and clear them, break each other.

        Raises
        ------
        OutputError : another run is at it
        """
        import fcntl

        made = not self.folder.parent.exists()
        self.folder.mkdir(parents=True, exist_ok=True)
        with ExitStack() as stack:
            lock = os.open(self.folder, os.O_RDONLY | os.O_CLOEXEC)
            stack.callback(os.close, lock)
            try:
                # The system gives it free when the run ends, however it ends.
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                out = self.folder.with_name(self.folder.name.rpartition("-")[0][1:])
                raise OutputError(out, "another run is grading into it", "wait until it ends") from None
            # Where nothing was graded, nothing is left.
            stack.callback(_remove_empty, (self.folder, self.folder.parent)[: 1 + made])
            yield

    def find(self, submission: Submission) -> dict[str, Any] | None:
        """The record of just this submission, if a former run got so far."""
        try:
            kept = json.loads(self._path(submission).read_bytes())
        except (OSError, ValueError):
            return None
        return kept["record"] if kept["digest"] == submission.digest else None

    def keep(self, submission: Submission, record: dict[str, Any]) -> None:
        """Write a record; it is there whole or not at all."""
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self._path(submission)
        draft = path.with_name(f"{path.name}.{os.getpid()}.new")
        draft.write_text(json.dumps({"digest": submission.digest, "record": record}), encoding="ascii")
        draft.replace(path)

    def clear(self) -> None:
        """The run is complete."""
        shutil.rmtree(self.folder, ignore_errors=True)

    def _path(self, submission: Submission) -> Path:
        # Of any length, and of letters that every file system has.
        return self.folder / f"{hashlib.sha256(os.fsencode(submission.place)).hexdigest()[:32]}.json"


def _remove_empty(folders: Iterable[Path]) -> None:
    for folder in folders:
        with suppress(OSError):
            folder.rmdir()


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
        with installed("--gradebook", "nbgrader", "nbgrader"):
            check_gradebook(course.gradebook)
    store = Store.beside(course.out, assignment)
    with store.held():
        with closing(worker_pool(course.workers, course.cluster, grade.__module__)) as pool:
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


def _answer_keys(kept: AnswerKeys, records: Records) -> dict[str, AnswerKey]:
    found: dict[str, AnswerKey] = {}
    for record in records:
        with suppress(GraphcamError):
            found[record["student"]] = AnswerKey.from_json(kept.find(record["student"]))
    return found


def grade_folder(
    folder: Path,
    assignment: Assignment,
    pool: WorkerPool,
    store: Store,
    kept: AnswerKeys,
    step: Callable[[int, int], None] = lambda done, total: None,
) -> Records:
    """One record for each student's folder.

    kept : the students' answer keys; who has none yet gets one
    step : hears how many of how many are done

    Raises
    ------
    TaskError : there is no such folder
    """
    students = students_in(folder, kept.student, lambda student: bool(kept.find(student)))
    found: dict[str, dict[str, Any]] = {}

    def unfinished() -> Generator[Submission]:
        """The hand-ins without a record yet; the records that are there are taken."""
        for student, path in students:
            submission = read_submission(student, path, kept.find(student), assignment.exercise.name)
            if (record := store.find(submission)) is not None:
                found[path.name] = record
                step(len(found), len(students))
            else:
                yield submission

    # Code takes so long that it travels alone, else one worker is left with the rest.
    batch = BATCH if assignment.level is Level.L0 else 1
    for submission, graded in results(pool, partial(grade, assignment), unfinished(), batch):
        if graded is not None and graded.answer_key and graded.answer_key != submission.answer_key:
            kept.keep(submission.student, graded.answer_key)
        record = graded.record if graded is not None else unmarked(assignment, submission.student, CRASHED)
        found[submission.place] = record.to_dict()
        store.keep(submission, found[submission.place])
        step(len(found), len(students))
    return [found[path.name] for _, path in students]

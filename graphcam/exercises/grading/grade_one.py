"""One submission: the bytes that lie in its folder, and their grading, which workers do here or on another machine."""

import _thread
import hashlib
import signal
import threading
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from types import FrameType

from graphcam.drafting.ink import Caption, say
from graphcam.exercises.course.submissions import HandIn, answers_folder
from graphcam.exercises.definition.exercise import BAR, Answers, Exercise
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.record import MarkedAnswer, Record
from graphcam.exercises.reading.paper_area import PaperArea
from graphcam.exercises.reading.submission_files import DXF, from_files, read_files
from graphcam.exercises.running.isolation_levels import MEBIBYTE, Level, ResourceLimits

READING_SECONDS = 10.0
"""Seconds of the processor's time in which a submission is read and marked; its code has a time of its own.

Of the processor's, so that a busy machine gives the same marks as an idle one.
"""
CHECK_INTERVAL = 0.1
"""Seconds between two looks at that time, where the system does not watch it."""


@dataclass(frozen=True)
class Submission:
    """What one student handed in, as bytes: it can travel to another machine.

    student : any text
    place : the name of the folder, which two never share
    files : by name, those that can hold answers
    errors : sentences on files that could not be read
    answer_key : the student's answer key as JSON; empty where there is none yet
    """

    student: str
    place: str
    files: dict[str, bytes]
    errors: tuple[Caption, ...]
    answer_key: str = ""

    @property
    def digest(self) -> str:
        """Tells whether it is the same submission as before."""
        digest = hashlib.sha256()
        for error in self.errors:
            digest.update(hashlib.sha256(str(error).encode("utf-8", "surrogatepass")).digest())
        for name, data in sorted(self.files.items()):
            digest.update(name.encode() + hashlib.sha256(data).digest())
        return digest.hexdigest()


def read_submission(student: str, folder: Path, answer_key: str = "", assignment: str = "") -> Submission:
    """The bytes of a student's own folder; see :func:`read_hand_in`."""
    return read_hand_in(HandIn(student, folder.name, folder), answer_key, assignment)


def read_hand_in(hand_in: HandIn, answer_key: str = "", assignment: str = "") -> Submission:
    """The bytes that a student handed in, whatever lies there.

    assignment : name of the folder in the student's that counts if it is there, as nbgrader collects
    """
    files, notes = read_files(answers_folder(hand_in, assignment), hand_in.names)
    said = (*hand_in.notes, *notes)
    return Submission(hand_in.student, hand_in.place, files, said, answer_key)


class LateError(BaseException):
    """Reading or marking took too long; whatever a library catches, this it does not.

    >>> print(LateError(10))
    it took more than 10 s
    """

    def __str__(self) -> str:
        return str(say("it took more than {seconds:g} s", seconds=self.args[0]))


@dataclass(frozen=True)
class Assignment:
    """What all submissions have in common.

    level : at which code is run; at L0 nothing is
    """

    exercise: Exercise
    secret: bytes
    level: Level = Level.L0
    limits: ResourceLimits = field(default_factory=ResourceLimits)

    @property
    def memory(self) -> int | None:
        """MiB that all processes of one hand-in's code may take together; None where no code is run."""
        return None if self.level is Level.L0 else self.limits.memory // MEBIBYTE


@dataclass(frozen=True)
class GradedSubmission:
    """The record of one submission, and the answer key where it had to be made."""

    record: Record
    answer_key: str


def grade(assignment: Assignment, submission: Submission) -> GradedSubmission:
    """The record of one submission; it never raises, since one that none foresaw has its record too."""
    text = ""
    try:
        answer_key, text = _answer_key(assignment, submission)
        with _seconds(READING_SECONDS):
            answers = _answers(assignment, submission, answer_key)
            if BAR.name in answers.values or BAR.name in answers.problems:
                from graphcam.exercises.key.printed_size import on_true_print

                answers = on_true_print(assignment.exercise, answer_key, answers)
            record = mark(assignment.exercise, answer_key, answers, level=assignment.level)
            return GradedSubmission(replace(record, memory=assignment.memory), text)
    except (Exception, LateError) as error:  # noqa: BLE001
        why = say("this submission could not be graded ({error})", error=f"{type(error).__name__}: {error}"[:200])
        return GradedSubmission(unmarked(assignment, submission.student, why), text)


def unmarked(assignment: Assignment, student: str, why: Caption) -> Record:
    """The record of a submission that cannot be marked."""
    exercise, level = assignment.exercise, assignment.level
    answers = tuple(MarkedAnswer(asked.name, "unreadable", 0.0, asked.marks) for asked in exercise.answers)
    said = (exercise.tell(why),)
    of = (student, exercise.name, exercise.version, 0, {}, answers, 0.0, exercise.marks)
    return Record(*of, None, False, said, said, level, memory=assignment.memory)


def _answer_key(assignment: Assignment, submission: Submission) -> tuple[AnswerKey, str]:
    """The student's answer key, and its text if it had to be made.

    What a file says counts only where the secret says the same.
    """
    exercise = assignment.exercise
    if submission.answer_key:
        known = AnswerKey.from_json(submission.answer_key)
        variant = drawn(exercise, submission.student, assignment.secret, known.draw)
        same = (known.exercise, known.version, known.student) == (exercise.name, exercise.version, submission.student)
        if same and dict(known.parameters) == dict(variant.parameters):
            return known, ""
    # Whoever has an answer key needs nothing that draws.
    from graphcam.exercises.key.key_making import issue

    _, made = issue(exercise, submission.student, assignment.secret)
    return made, made.to_json()


def _answers(assignment: Assignment, submission: Submission, answer_key: AnswerKey) -> Answers:
    asked = assignment.exercise.answers
    read = partial(from_files, asked, submission.files, submission.errors)
    if DXF in submission.files:
        read = partial(read, rooms=_paper_areas(assignment.exercise, answer_key))
    if assignment.level is Level.L0:
        return read()
    from graphcam.exercises.running.code_answers import run_notebook

    return read(
        notebook=partial(run_notebook, assignment.level, [one.name for one in (*asked, BAR)], assignment.limits)
    )


def _paper_areas(exercise: Exercise, answer_key: AnswerKey) -> dict[str, PaperArea]:
    """The areas where drawn answers can lie: where the key does, or what a usual mistake makes of it."""
    areas: dict[str, PaperArea] = {}
    for k, asked in enumerate(exercise.answers):
        if asked.kind != "number":
            key = answer_key.keys[asked.name]
            known = [key.expected, *(wrong[k] for wrong in answer_key.hypotheses.values())]
            areas[asked.name] = PaperArea.for_answers(asked.kind, known, key.tolerance)
    return areas


@contextmanager
def _seconds(seconds: float) -> Generator[None]:
    """End what takes longer with a LateError; a thread other than the main one cannot be interrupted."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def late(_: int, __: FrameType | None) -> None:
        """End what runs, as a signal that has come."""
        raise LateError(seconds)

    if not hasattr(signal, "setitimer"):
        with _time_limit_by_thread(seconds, late):
            yield
        return
    former = signal.signal(signal.SIGPROF, late)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, former)


@contextmanager
def _time_limit_by_thread(seconds: float, late: Callable[[int, FrameType | None], None]) -> Generator[None]:
    """A limit of the processor's time where the system has no such clock, as Windows: a thread looks at it."""
    until, over = time.process_time() + seconds, threading.Event()

    def watch() -> None:
        """Wait until the time is used up, or the work is over."""
        while not over.wait(CHECK_INTERVAL):
            if time.process_time() > until:
                _thread.interrupt_main(signal.SIGTERM)
                return

    former = signal.signal(signal.SIGTERM, late)
    watching = threading.Thread(target=watch, daemon=True)
    watching.start()
    try:
        yield
    finally:
        over.set()
        watching.join()
        signal.signal(signal.SIGTERM, former)

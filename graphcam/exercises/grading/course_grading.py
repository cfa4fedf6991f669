"""A whole course, graded: read, shared out, kept so that an interrupted run resumes, and reported on."""

from __future__ import annotations

import glob
import hashlib
import json
import shutil
import zipfile
from collections.abc import Callable, Generator, Iterable, Sequence
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import graphcam
from graphcam.drafting.ink import say
from graphcam.errors import DesignError, MissingFileError, TaskError, installed
from graphcam.exercises.course.answer_search import AnswerSearch
from graphcam.exercises.course.course_folder import AnswerKeys, KeysAsNeeded
from graphcam.exercises.course.photo_reports import await_review, read_off_photographs, with_photo_notes
from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.roster import Student, folder_name
from graphcam.exercises.course.submissions import HandIn, Refused, course_students, hand_ins_in
from graphcam.exercises.course.zipped_submissions import unpacked
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.marks_policy import caps_of
from graphcam.exercises.grading.changed_exercise import check_unchanged
from graphcam.exercises.grading.empty_submissions import (
    not_handed_in,
    to_check,
    unreadable_hand_ins,
    with_absence,
    with_paper,
)
from graphcam.exercises.grading.grade_one import Assignment, Submission, grade, read_hand_in, unmarked
from graphcam.exercises.grading.gradebook import ENTERED_FILE, check_gradebook, enter_scores
from graphcam.exercises.grading.notebook_marks import course_questions, grade_notebooks
from graphcam.exercises.grading.overrides import OVERRIDES_FILE, Override, overridden, read_overrides
from graphcam.exercises.marking.copy_detection import alike_pairs
from graphcam.exercises.marking.record import is_handed_in
from graphcam.exercises.reports.report_files import GroupNotes, write_feedback, write_reports
from graphcam.exercises.reports.shown_names import ShownNames, hidden_names
from graphcam.exercises.running.isolation_levels import Level, ResourceLimits
from graphcam.exercises.running.isolation_probe import LevelError, require
from graphcam.file_locks import locked_folder
from graphcam.files import OutputError, clear_drafts
from graphcam.words import Caption, Words
from graphcam.workers import BATCH_SIZE, WorkerPool, results, worker_pool

Records = list[dict[str, Any]]
"""Records as JSON takes them, in the order of the students' names."""
Finished = dict[str, tuple[str, dict[str, Any]]]
"""The digest of a submission and its record, by the name of its folder."""
CRASHED_REMARK = say("grading this submission failed; mark it by hand")


PAGES_FILE = "pages"
"""The file in a store with the folder for the students' pages."""


@dataclass(frozen=True)
class Store:
    """A folder with the journal of finished records.

    It is named after what they were graded with: of another assignment they do not count.
    """

    folder: Path

    @staticmethod
    def for_run(out: Path, assignment: Assignment) -> Store:
        """The store of a run that writes to ``out``."""
        # Of the secret only a digest is left, and of that a part.
        secret = hashlib.sha256(b"graphcam store" + assignment.secret).hexdigest()
        said = [graphcam.__version__, repr(assignment.exercise), secret, assignment.level, repr(assignment.limits)]
        return Store(out.parent / f".{out.name}-{hashlib.sha256(repr(said).encode()).hexdigest()[:16]}")

    @contextmanager
    def lock(self) -> Generator[None]:
        """Keep other runs out meanwhile: two that write the same records, and clear them, break each other.

        Raises
        ------
        OutputError : another run is at it
        """
        made = not self.folder.parent.exists()
        self.folder.mkdir(parents=True, exist_ok=True)
        with ExitStack() as stack:
            try:
                stack.enter_context(locked_folder(self.folder))
            except BlockingIOError:
                out = self.folder.with_name(self.folder.name.rpartition("-")[0][1:])
                raise OutputError(out, say("another run is grading into it"), say("wait until it ends")) from None
            # Where nothing was graded, nothing is left.
            stack.callback(_remove_empty, (self.folder, self.folder.parent)[: 1 + made])
            yield

    def finished_submissions(self) -> Finished:
        """What a former run got done, by the names of the folders."""
        try:
            lines = self._journal.read_bytes().split(b"\n")
        except OSError:
            return {}
        found: Finished = {}
        for line in lines:
            # A run that was killed may have left a line torn, which is no JSON.
            with suppress(ValueError, TypeError, KeyError):
                kept = json.loads(line)
                found[kept["place"]] = (kept["digest"], kept["record"])
        return found

    def keep(self, submission: Submission, record: dict[str, Any]) -> None:
        """Append a record to the journal, which costs far less than a file each."""
        self.folder.mkdir(parents=True, exist_ok=True)
        kept = {"place": submission.place, "digest": submission.digest, "record": record}
        # Each line begins its own, so that a torn one before it spoils nothing; unbuffered, so that it stays when the
        # run is killed.
        with self._journal.open("ab", buffering=0) as journal:
            journal.write(b"\n" + json.dumps(kept).encode("ascii"))

    def note_pages(self, folder: Path) -> None:
        """Keep in mind where students' pages are about to be written, in case the run is killed meanwhile."""
        (self.folder / PAGES_FILE).write_text(
            str(folder.absolute()), encoding="utf-8", newline="\n", errors="surrogateescape"
        )

    def clear_pages(self, out: Path) -> None:
        """Remove the half-written pages of killed runs that wrote to ``out``, wherever they put their pages."""
        for noted in out.parent.glob(f".{glob.escape(out.name)}-*/{PAGES_FILE}"):
            with suppress(OSError):
                clear_drafts(Path(noted.read_text(encoding="utf-8", errors="surrogateescape")))

    def clear(self) -> None:
        """The run is complete."""
        shutil.rmtree(self.folder, ignore_errors=True)

    @property
    def _journal(self) -> Path:
        return self.folder / "records.jsonl"


def _remove_empty(folders: Iterable[Path]) -> None:
    for folder in folders:
        with suppress(OSError):
            folder.rmdir()


L1_WARNING = say(
    "code there can read and change what you can: the secret, the answers of others, the "
    "grades; choose level L2, or add --i-trust-these-students"
)
"""What level L1 does not hold."""
FORMER_TABLES = ("extensions.csv", "submitted.csv", "regrade-requests.csv")
"""Tables of the teacher that graphcam read once."""
OF_THE_PLATFORM = say("keep deadlines, late penalties, attempts and questions about marks in your learning platform")


@dataclass(frozen=True)
class Course:
    """An order to grade: the options of ``graphcam exercise grade``.

    folder : with a folder for every student, or a zip of them
    secret_file : of the course's secret; None for the one in the teacher's folder
    out : the file for the grades
    exercise : its name; empty where the folder says it
    level, seconds : where and how long the code of notebooks runs
    workers, cluster : processes here, or the address of a dask scheduler
    feedback : folder for the students' pages
    gradebook : database of nbgrader that the scores go into too
    trusted : whether the students are trusted, without which level L1 is refused
    roster : of the students, instead of the one that the course was made for
    overrides : marks given by hand, instead of those in the teacher's folder
    follow_through, near : parts of the exercise's policy that are to be other, as of a MarksPolicy; else None
    cap : texts such as "offset-sign=0.5", added to the policy's own caps
    anonymous : the pages hide who the students are
    show_right : the students' pages show what would have been right
    elsewhere : a deadline, a penalty or a rule for attempts, which the learning platform has; empty

    Raises
    ------
    DesignError : there is one nevertheless
    """

    folder: Path
    secret_file: Path | None
    out: Path
    exercise: str = ""
    level: Level = Level.L0
    seconds: float = 10.0
    workers: int = 1
    cluster: str = ""
    feedback: Path | None = None
    gradebook: str = ""
    trusted: bool = False
    roster: Path | None = None
    overrides: Path | None = None
    follow_through: float | None = None
    near: float | None = None
    cap: Sequence[str] | None = None
    anonymous: bool = False
    show_right: bool = False
    elsewhere: str = ""

    def __post_init__(self) -> None:
        if self.elsewhere:
            raise DesignError("--deadline, --late or --attempts", self.elsewhere, say("left out"), OF_THE_PLATFORM)


def grade_course(course: Course, step: Callable[[int, int], None] = lambda done, total: None) -> list[Caption]:
    """Grade a course and write its reports; what was done, in lines.

    Raises
    ------
    GraphcamError : wrong input, or a level of isolation that there is not here
    """
    _check_places(course)
    if questions := course_questions(course.folder):
        given = {"--feedback": course.feedback, "--gradebook": course.gradebook, "--overrides": course.overrides}
        with unpacked(course.folder) as (handed_in, unsafe):
            return [*grade_notebooks(handed_in, course.out, questions, given), *map(_not_graded, unsafe)]
    folder, kept = AnswerKeys.of(course.folder)
    if not course.folder.is_dir() and not kept.course():
        remedy = say("put it beside the folder 'teacher' of its course, or unpack it")
        raise TaskError(str(course.folder), say("the zip"), say("elsewhere"), say("beside the answer keys"), remedy)
    exercise = _exercise(course, kept)
    if course.level is Level.L1 and not course.trusted:
        raise LevelError(course.level, L1_WARNING)
    require(course.level, (course.folder, kept.secret_file(course.secret_file), course.out))
    secret = kept.secret(course.secret_file)
    assignment = Assignment(exercise, secret, course.level, ResourceLimits(seconds=course.seconds))
    if course.gradebook:
        with installed("--gradebook", "nbgrader", "nbgrader"):
            check_gradebook(course.gradebook)
    with unpacked(folder) as (submissions, unsafe), TemporaryDirectory(prefix="graphcam-") as scratch:
        hand_ins, refused = hand_ins_in(submissions, kept, course.roster)
        check_unchanged(exercise, kept, [one.student for one in hand_ins], secret)
        if read_off_photographs(submissions):
            hand_ins = with_photo_notes(hand_ins, submissions)
        else:
            table = str(exercise.task.get("motion", {}).get("table", ""))
            look = AnswerSearch(
                exercise.name, [asked.name for asked in exercise.answers], Path(scratch), Path(table).name
            )
            hand_ins = [look.located(one) for one in hand_ins]
        awaiting = await_review(hand_ins, submissions)
        return _graded(course, assignment, kept, hand_ins, [*unsafe, *refused], awaiting, step)


def _graded(
    course: Course,
    assignment: Assignment,
    kept: AnswerKeys,
    hand_ins: Sequence[HandIn],
    refused: Sequence[Refused],
    awaiting: Sequence[str],
    step: Callable[[int, int], None],
) -> list[Caption]:
    """Grade what was handed in and write all reports; what was done, in sentences.

    awaiting : students whose photographs nobody has looked at who should
    """
    exercise = assignment.exercise
    # Where nobody said who the students are, they are those who handed in.
    students = course_students(kept, course.roster) or Recognition(Student(one.student) for one in hand_ins)
    by_hand = _by_hand(course, exercise, kept, students, {one.student for one in hand_ins})
    hand_ins = with_paper(hand_ins, by_hand, kept.folder)
    names = _shown_names(course, assignment, hand_ins)
    store = Store.for_run(course.out, assignment)
    with store.lock():
        store.clear_pages(course.out)
        with closing(worker_pool(course.workers, course.cluster, grade.__module__)) as pool:
            records = grade_folder(hand_ins, assignment, pool, store, kept, step)
        # The store stays free of it, so that a line that is taken back leaves the marks that were found.
        records = overridden(exercise, with_absence(exercise, hand_ins, records), by_hand)
        answer_keys = KeysAsNeeded(kept, [record["student"] for record in records])
        silent = unreadable_hand_ins(hand_ins, records)
        refused = [*refused, *(Refused(one.place, one.notes[-1]) for one in silent)]
        called = {student.id: student.name for student in students.ids.values()}
        notes = GroupNotes(refused, course.feedback, names, called, kept.id_heading(course.roster))
        graded = [record for record in records if is_handed_in(record)]
        pairs = alike_pairs(exercise, graded, answer_keys)
        files = write_reports(course.out, exercise, records, answer_keys, notes, pairs)
        if course.feedback is not None:
            store.note_pages(course.feedback)
            folders = {one.student: one.path for one in hand_ins}
            write_feedback(course.feedback, exercise, records, answer_keys, names, folders, right=course.show_right)
        told = [_not_graded(one) for one in refused]
        if course.gradebook:
            told += enter_scores(course.gradebook, exercise, graded, kept.folder / ENTERED_FILE)
        unreadable = {one.student for one in silent}
        told += not_handed_in(called, graded, unreadable)
        told += to_check(records, unreadable, pairs, awaiting, f"{course.out.stem}.html")
        store.clear()
    # Which of the bounds on memory was in force: the kernel's own are seldom given to users.
    level: Words = f"{course.level}"
    if assignment.memory:
        watched = say("{level} (memory watched, {memory} MiB for all processes)")
        level = watched.with_values(level=level, memory=assignment.memory)
    done = say("submissions graded: {count}, at level {level}; in {folder}: {files}")
    done = done.with_values(count=len(graded), level=level, folder=str(course.out.parent), files=", ".join(files))
    return [done, *told]


def _not_graded(refused: Refused) -> Caption:
    return say("not graded: {place}: {why}", place=refused.place, why=refused.why)


def _by_hand(
    course: Course, exercise: Exercise, kept: AnswerKeys, students: Recognition, handed_in: set[str]
) -> list[Override]:
    """The marks that the teacher gives by hand.

    Raises
    ------
    TaskError : their table cannot be used, or there is one that is not read any more
    """
    for path in (kept.folder / name for name in FORMER_TABLES):
        if path.exists():
            remedy = say("{keep}, and delete the file", keep=OF_THE_PLATFORM)
            raise TaskError(str(path), say("the table"), say("given"), say("left out"), remedy)
    path = course.overrides or kept.folder / OVERRIDES_FILE
    return read_overrides(path, exercise, students, handed_in) if course.overrides or path.exists() else []


def _shown_names(course: Course, assignment: Assignment, hand_ins: Sequence[HandIn]) -> ShownNames:
    """The students' names on the pages.

    Raises
    ------
    OutputError : names are to be hidden in a folder that has pages under the ids
    """
    if not course.anonymous:
        return ShownNames()
    students = {one.student for one in hand_ins}
    pages = [course.feedback / f"{folder_name(student)}.html" for student in students if course.feedback]
    if course.feedback and any(page.exists() for page in pages):
        raise OutputError(course.feedback, say("it has pages under the students' ids"), say("name another folder"))
    return ShownNames(hidden_names(assignment.secret, assignment.exercise.name, students))


def _check_places(course: Course) -> None:
    """What must not first come out when all is graded."""
    if not course.folder.is_dir() and not zipfile.is_zipfile(course.folder):
        if not course.folder.exists():
            raise MissingFileError(str(course.folder), kind=say("folder"))
        wanted = say("one with a folder for every student, or a zip file")
        raise TaskError(str(course.folder), say("the folder"), say("a file"), wanted, say("check the name"))
    if course.out.suffix.lower() != ".csv" and not course.out.is_dir():
        raise OutputError(course.out, say("the grades are a CSV file"), say("name a file that ends in .csv"))
    if course.out.is_dir():
        raise OutputError(course.out, say("it is a folder"), say("name a file, grades.csv"))
    if course.feedback is not None and course.feedback.exists() and not course.feedback.is_dir():
        raise OutputError(course.feedback, say("it is a file"), say("name a folder for the pages"))


def _exercise(course: Course, kept: AnswerKeys) -> Exercise:
    """The exercise that the course is noted to be about, or else the one that is named."""
    noted = kept.exercise()
    if not noted and not course.exercise:
        what = say("the exercise")
        raise TaskError(str(course.folder), what, say("not noted there"), say("known"), say("name it with --exercise"))
    exercise = kept.course_exercise(course.exercise)
    if noted and exercise.name != Path(noted).stem:
        made_for = say("{stem!r}, which {folder} was made for", stem=Path(noted).stem, folder=course.folder)
        raise TaskError("--exercise", say("the exercise"), exercise.name, made_for, say("leave the option out"))
    given = {"follow_through": course.follow_through, "near": course.near}
    changed = {name: value for name, value in given.items() if value is not None}
    caps = {**exercise.policy.caps, **caps_of(course.cap or ())}
    return replace(exercise, policy=replace(exercise.policy, caps=caps, **changed))


def grade_folder(
    hand_ins: Sequence[HandIn],
    assignment: Assignment,
    pool: WorkerPool,
    store: Store,
    kept: AnswerKeys,
    step: Callable[[int, int], None] = lambda done, total: None,
) -> Records:
    """One record for each student who handed in.

    kept : the students' answer keys; who has none yet gets one
    step : progress callback (done, total)
    """
    found: dict[str, dict[str, Any]] = {}
    finished = store.finished_submissions()

    def unfinished() -> Generator[Submission]:
        """The hand-ins without a record yet; the records that are there are taken."""
        for one in hand_ins:
            submission = read_hand_in(one, kept.find(one.student), assignment.exercise.name)
            digest, record = finished.pop(one.place, ("", {}))
            if digest == submission.digest and record["student"] == one.student:
                found[one.place] = record
                step(len(found), len(hand_ins))
            else:
                yield submission

    # Code takes so long that it travels alone, else one worker is left with the rest.
    batch = BATCH_SIZE if assignment.level is Level.L0 else 1
    for submission, graded in results(pool, partial(grade, assignment), unfinished(), batch):
        if graded is not None and graded.answer_key:
            kept.keep(submission.student, graded.answer_key)
        record = graded.record if graded is not None else unmarked(assignment, submission.student, CRASHED_REMARK)
        found[submission.place] = record.to_dict()
        store.keep(submission, found[submission.place])
        step(len(found), len(hand_ins))
    return [found[one.place] for one in hand_ins]

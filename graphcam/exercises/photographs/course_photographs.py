"""The photographs of a course: read, judged, written student by student, and listed; an interrupted run goes on."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path

import graphcam
from graphcam.errors import MissingFileError, TaskError, installed
from graphcam.exercises.course.course_folder import (
    COURSE_FILE,
    PRINTED_FOLDER,
    TEACHER_FOLDER,
    AnswerKeys,
    KeysAsNeeded,
)
from graphcam.exercises.course.spreadsheet import table
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.photographs.corrections import (
    NO_CORRECTIONS,
    Corrections,
    keep_corrections,
    kept_corrections,
    read_corrections,
    with_changes,
)
from graphcam.exercises.photographs.counted_answers import SettledStudent, settled_student
from graphcam.exercises.photographs.page_owner import PrintedSheets
from graphcam.exercises.photographs.photograph_store import KeptPhotographs
from graphcam.exercises.photographs.read_photo import FORMAT_VERSION, ReadPhoto
from graphcam.exercises.photographs.reading_limits import MEMORY_GIGABYTES, OPENED_WITHIN
from graphcam.exercises.photographs.review_page import review_page
from graphcam.exercises.photographs.student_files import write_student
from graphcam.files import OutputError, whole_file
from graphcam.words import Caption, say, say_many
from graphcam.workers import processes, results

READINGS_FOLDER = "photos"
"""The folder of what was read: 'exercise grade' takes it as it takes what was handed in."""
TABLE_FILE = "report.csv"
"""The table of the readings, a line for each photograph."""
REPORT_COLUMNS = (
    *("photograph", "student", "page", "status", "marks_found", "marks_printed", "residual_px", "paper"),
    *("answers_read", "least_share_seen", "why", "remedy"),
)
PHOTO_LIBRARIES = ("cv2", "zxingcpp", "pypdfium2", "pillow_heif", "PIL")
"""The libraries that the extra ``photo`` brings, and reading needs."""
Step = Callable[[int, int], None]


@dataclass(frozen=True)
class ReadingOrder:
    """An order to read photographs.

    photographs : files and folders of them; with none the corrections alone are taken in
    course : the folder that 'exercise make' wrote
    secret_file : of the course's secret; None for the one in the teacher's folder
    out : the folder of the readings; None for that in the course
    review : the file for the review page;  corrections : a file that the review page exported
    """

    photographs: Sequence[Path]
    course: Path
    secret_file: Path | None = None
    out: Path | None = None
    review: Path | None = None
    corrections: Path | None = None
    workers: int = 1


@dataclass(frozen=True, eq=False)
class ReadCourse:
    """What came of it.

    folder : of the readings
    photos : all that are known
    students : who have photographs, in the order of the roster
    """

    folder: Path
    photos: Sequence[ReadPhoto]
    students: Sequence[SettledStudent]


def read_course(order: ReadingOrder, step: Step = lambda done, total: None) -> ReadCourse:
    """Read photographs and write what came of them.

    step : progress callback (done, total)

    Raises
    ------
    GraphcamError : wrong input, or the folder cannot be written
    """
    with installed("exercise read", ", ".join(PHOTO_LIBRARIES), "photo"):
        for library in PHOTO_LIBRARIES:
            import_module(library)
    kept = AnswerKeys(order.course / TEACHER_FOLDER)
    exercise, sheets = _course(order, kept)
    out = order.out or order.course / READINGS_FOLDER
    _check_places(order, out)
    corrections = kept_corrections(kept.folder, exercise, sheets.students)
    if order.corrections is not None:
        corrections = with_changes(corrections, read_corrections(order.corrections, exercise, sheets.students))
    readings = KeptPhotographs(out, _basis(exercise, kept))
    with readings.lock():
        refused = _read_photographs(order, exercise, sheets, readings, step)
        photos = [*readings.all_photographs(), *refused]
        answer_keys = KeysAsNeeded(kept, sheets.students)
        students = _settled_students(exercise, photos, answer_keys, corrections)
        # Before anything is written, so that a bar that is measured wrongly changes nothing.
        if order.corrections is not None:
            keep_corrections(kept.folder, exercise, corrections)
        for one in students:
            write_student(out, exercise, one, answer_keys.get(one.student), readings)
        _write_text(out / TABLE_FILE, photo_table(photos, students, exercise))
        if order.review is not None:
            keys = ((one, answer_keys.get(one.student)) for one in students)
            _write_text(order.review, review_page(exercise, keys, readings, photos))
    return ReadCourse(out, photos, students)


def _course(order: ReadingOrder, kept: AnswerKeys) -> tuple[Exercise, PrintedSheets]:
    """What the course is about, and its sheets.

    Raises
    ------
    TaskError : it is no course, its worksheets are not made to be photographed, or the secret is another one's
    """
    noted = kept.course()
    if not noted:
        missing = say("without {teacher}/{course}", teacher=TEACHER_FOLDER, course=COURSE_FILE)
        remedy = say("name the folder that 'exercise make' wrote")
        raise TaskError(str(order.course), say("the course"), missing, say("a folder of a course"), remedy)
    if not (kept.folder / PRINTED_FOLDER).is_dir():
        wanted, remedy = say("made to be photographed"), say("make the course with --paper A3")
        raise TaskError(str(order.course), say("the worksheet"), say("without marks"), wanted, remedy)
    secret = kept.secret(order.secret_file)
    exercise = kept.course_exercise()
    students = [student.id for student in kept.students()]
    return exercise, PrintedSheets(kept.folder, exercise.name, exercise.version, students, secret)


def _check_places(order: ReadingOrder, out: Path) -> None:
    """What must not first come out when all is read."""
    if out.exists() and not out.is_dir():
        raise OutputError(out, say("it is a file"), say("name a folder for the readings"))
    if out.resolve() in ((order.course / TEACHER_FOLDER).resolve(), order.course.resolve()):
        raise OutputError(out, say("it holds the course itself"), say("name a folder of its own"))
    if order.review is not None and order.review.is_dir():
        raise OutputError(order.review, say("it is a folder"), say("name a file, review.html"))
    for path in order.photographs:
        if not path.exists() and not path.is_symlink():
            raise MissingFileError(str(path), say("check the name"), kind=say("photograph"))


def _basis(exercise: Exercise, kept: AnswerKeys) -> str:
    """Tells what photographs are read with: the program, what is asked for, and the course."""
    drawn = [(asked.name, asked.kind, asked.place, asked.mark) for asked in exercise.answers]
    said = repr((FORMAT_VERSION, graphcam.__version__, exercise.name, exercise.version, drawn, kept.course()))
    return hashlib.sha256(said.encode("utf-8", "backslashreplace")).hexdigest()[:16]


def _read_photographs(
    order: ReadingOrder, exercise: Exercise, sheets: PrintedSheets, readings: KeptPhotographs, step: Step
) -> list[ReadPhoto]:
    """Read what is not read yet; what cannot be opened at all is given back."""
    if not order.photographs:
        return []
    from graphcam.exercises.photographs.photo_files import ReadingJob, files_in, halves_in, read_file, read_halves_of

    files = list(files_in(order.photographs))
    job = ReadingJob(exercise, sheets, readings)
    refused: list[ReadPhoto] = []
    with closing(processes(order.workers, read_file.__module__, fresh=True)) as pool:
        # A photograph a time, since each takes seconds; one that kills its worker costs only itself.
        for done, (file, found) in enumerate(results(pool, partial(read_file, job), files, batch=1), 1):
            refused += found if found is not None else [_crashed_photograph(file.name, exercise)]
            step(done, len(files))
        # Of pages on two sheets both must be known first.
        halves = halves_in(readings.all_photographs(), files, readings)
        for both, found in results(pool, partial(read_halves_of, job), halves, batch=1):
            refused += found if found is not None else [_crashed_photograph(both.name, exercise)]
    return sorted(refused, key=lambda photo: photo.name)


def _crashed_photograph(name: str, exercise: Exercise) -> ReadPhoto:
    why = say(
        "reading it failed, or took more than {seconds} s or {gigabytes} GB of memory",
        seconds=round(OPENED_WITHIN),
        gigabytes=MEMORY_GIGABYTES,
    )
    remedy = say("save it as JPEG again, or photograph the sheet again")
    return ReadPhoto(name, "", why=exercise.tell(why), remedy=exercise.tell(remedy))


def _settled_students(
    exercise: Exercise, photos: Iterable[ReadPhoto], answer_keys: KeysAsNeeded, corrections: Corrections
) -> list[SettledStudent]:
    """What counts, of each student who has photographs or corrections."""
    of: dict[str, list[ReadPhoto]] = {student: [] for student in answer_keys.students}
    for photo in photos:
        if photo.student in of:
            of[photo.student].append(photo)
    return [
        settled_student(exercise, student, own, answer_keys.get(student), corrections.get(student, NO_CORRECTIONS))
        for student, own in of.items()
        if own or student in corrections
    ]


def photo_table(photos: Iterable[ReadPhoto], students: Sequence[SettledStudent], exercise: Exercise) -> str:
    """A line for each photograph: whose it is, how well it is seen, what was read, and what to do."""
    by_student = {one.student: one for one in students}
    return table(REPORT_COLUMNS, (_report_line(photo, by_student.get(photo.student), exercise) for photo in photos))


def _report_line(photo: ReadPhoto, student: SettledStudent | None, exercise: Exercise) -> list[object]:
    counts = student is not None and photo is student.pages.get(photo.page)
    shares = [one.share for one in photo.answers.values()]
    answers = [one for one in student.answers if one.page == photo.page] if student is not None and counts else []
    open_ones = [one for one in answers if one.status == "refused"]
    status = "counts" if counts else "half a page" if photo.half else "not needed"
    status = "refused" if photo.why else "to check" if open_ones else status
    why = [photo.why] if photo.why else [f"{one.asked.name}: {exercise.tell(one.why)}" for one in open_ones]
    remedy = [photo.remedy] if photo.why else list(dict.fromkeys(exercise.tell(one.remedy) for one in open_ones))
    return [
        *(photo.name, photo.student, photo.page or None, status, photo.tags, photo.expected),
        *(round(photo.residual, 3), photo.kind, " ".join(one.asked.name for one in answers if one.given is not None)),
        *(round(min(shares), 3) if shares else None, "; ".join(why), "; ".join(remedy)),
    ]


def _write_text(path: Path, text: str) -> None:
    with whole_file(path) as draft:
        draft.write_text(text, encoding="utf-8", newline="\n", errors="backslashreplace")


def summary(read: ReadCourse) -> Iterator[Caption]:
    """What was done, in lines for a terminal."""
    refused = [photo for photo in read.photos if photo.why]
    waiting = [one for one in read.students if one.open]
    unmeasured = [one for one in read.students if one.pages and not one.corrections.bars]
    yield say(
        "{folder}: {photographs} of {students}, {refused} refused; to check: {waiting}",
        folder=str(read.folder),
        photographs=say_many("{count} photograph", "{count} photographs", len(read.photos)),
        students=_students(read.students),
        refused=len(refused),
        waiting=_students(waiting),
    )
    if unmeasured:
        yield say(
            "of {students} no scale bar is typed; a printer may be off by 1 %, and no photograph shows it",
            students=_students(unmeasured),
        )
    for photo in refused:
        yield say("refused: {name}: {why}; {remedy}", name=photo.name, why=photo.why, remedy=photo.remedy)
    for one in waiting:
        names = ", ".join(each.asked.name for each in one.answers if each.status in ("refused", "not seen"))
        yield say("to check: {student}: {names}", student=one.student, names=names)


def _students(listed: Sequence[object]) -> Caption:
    return say_many("{count} student", "{count} students", len(listed))

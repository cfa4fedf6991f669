"""Making an exercise for a course: the students' handouts in one folder, the teacher's in another."""

import csv
import importlib
import math
import re
import tempfile
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import get_args

import numpy as np

from graphcam.errors import TaskError, installed
from graphcam.exercises.course.course_folder import (
    KEYS_FILE,
    PRINTED_FOLDER,
    ROSTER_FILE,
    SECRET_FILE,
    STUDENTS_FOLDER,
    TEACHER_FOLDER,
    AnswerKeys,
    CourseThereError,
    make_secret,
    read_secret,
    write_secret,
)
from graphcam.exercises.course.handouts import Sheets, instructions, key_rows, key_sheet, write_handouts
from graphcam.exercises.course.roster import Student, folder_name, read_roster
from graphcam.exercises.course.spreadsheet import cell
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.course_variants import course_variants
from graphcam.files import OutputError, whole_folder
from graphcam.language import languages
from graphcam.photo.printed_page import Ink
from graphcam.tasks.sheet_tables import check_choice
from graphcam.words import Words, say
from graphcam.workers import executor_of, ordered_results

WIDE_TOLERANCE_SHARE = 0.1
"""A tolerance is wide that exceeds this part of the value."""
NUMBER = r"(\d+(?:[.,]\d+)?)"
SCALE_STATEMENTS = (
    (re.compile(rf"{NUMBER} ?° ?(?:to|per|in|=|/|в) ?{NUMBER}? ?(?:mm|мм)"), 1, 2),
    (re.compile(rf"{NUMBER} ?(?:mm|мм) ?(?:to|=|per|изображает|соответствует|ứng với|表示) ?{NUMBER} ?°"), 2, 1),
)
"""How texts state the scale of the cam angle, and which of the numbers are degrees and millimetres."""


def wide_tolerances(exercise: Exercise, answer_keys: Sequence[AnswerKey]) -> dict[str, float]:
    """The numbers, by name, whose tolerance is wide in half of the variants, and which part of the value it is."""
    found: dict[str, float] = {}
    for asked in exercise.answers:
        keys = [each.keys[asked.name] for each in answer_keys]
        values = [(key.tolerance, abs(key.expected.value)) for key in keys if isinstance(key.expected.value, float)]
        parts = [tolerance / value if value else math.inf for tolerance, value in values]
        if parts and (part := float(np.median(parts))) > WIDE_TOLERANCE_SHARE:
            found[asked.name] = part
    return found


def stated_scales(text: str) -> Iterator[tuple[str, float]]:
    """The scales of the cam angle that a text states, as it says them and in degrees a millimetre.

    >>> list(stated_scales("Lay off the cam angle at 1° to 1 mm; 2 мм изображает 1°."))
    [('1° to 1 mm', 1.0), ('2 мм изображает 1°', 0.5)]
    """
    for pattern, degrees, millimetres in SCALE_STATEMENTS:
        for said in pattern.finditer(text):
            length = float((said[millimetres] or "1").replace(",", "."))
            if length:
                yield said[0], float(said[degrees].replace(",", ".")) / length


def other_scale(variant: Variant) -> tuple[str, float] | None:
    """What the text says of the scale of the cam angle where the sheet has another, and that of the sheet [deg/mm]."""
    drawn = math.degrees(board_chain(variant.task).board.mu_phi.per_mm)
    for said, scale in stated_scales(instructions(variant)):
        if not math.isclose(scale, drawn, rel_tol=1e-6):
            return said, drawn
    return None


UNMARKED_OPTION = "unmarked"
"""What asks for worksheets that are not made to be photographed."""


def usual_paper(name: str) -> str:
    """The paper of a new course's worksheets where nobody chooses: A3, if the exercise is made for it, with marks.

    >>> usual_paper("inversion-arm"), usual_paper("integration")
    ('A3', '')

    Raises
    ------
    GraphcamError : there is no such exercise
    """
    return "A3" if "A3" in find_exercise(name).papers else ""


def make(
    name: str,
    roster: str | Path,
    secret_file: str | Path | None,
    out: str | Path,
    *,
    language: str = "en",
    hand: str = "",
    paper: str = "",
    ink: Ink = "colour",
    workers: int = 1,
    cluster: str = "",
    step: Callable[[int, int], None] = lambda done, total: None,
    tell: Callable[[Words], None] = lambda line: None,
) -> int:
    """Make every student's handouts; how many students there are.

    secret_file : of the course's secret, of which the teacher's folder gets a copy; None for a new one
    language : of all handouts, and noted for the feedback
    hand : of the students, by its name, and noted too; else as the exercise says
    paper : "A1", "A3", "A4" or "A3-tiles", for worksheets that are photographed; else as the task says, without tags
    ink : of what is given on these: "colour", or "grey" for a printer of black alone
    tell : is told what is odd about the course, a line each
    workers, cluster : processes here, or the address of a dask scheduler, whose machines share no files with this one

    Raises
    ------
    GraphcamError : the exercise, the roster or the secret is not there, or the folder cannot be written
    OSError : no scheduler answers at the address
    """
    check_choice("language", language, languages())
    check_choice("print", ink, get_args(Ink))
    # Before the extra: it is of no use for an exercise that is not made for the paper.
    exercise = find_exercise(name, language, hand, paper)
    if paper:
        # At once, and not in a worker.
        with installed("--paper", "segno", "photo"):
            importlib.import_module("graphcam.sheets.qr")
    students = read_roster(roster)
    secret = make_secret() if secret_file is None else _secret_from_file(secret_file)
    out = Path(out)
    for part in (STUDENTS_FOLDER, TEACHER_FOLDER):
        if (out / part).exists():
            raise CourseThereError(out)
    with whole_folder(out, first=TEACHER_FOLDER) as draft, executor_of(workers, cluster) as executor:
        answer_keys: list[AnswerKey] = []
        variants = course_variants(exercise, (student.id for student in students), secret, executor)
        jobs = zip(students, variants, strict=True)
        for text, files in ordered_results(
            executor, partial(papers, marks=Marks(secret, paper, ink) if paper else None), jobs
        ):
            answer_keys.append(AnswerKey.from_json(text))
            for name_in_draft, data in files.items():
                path = draft / name_in_draft
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(data)
            step(len(answer_keys), len(students))
        kept = AnswerKeys(draft / TEACHER_FOLDER)
        said = {"version": exercise.version, "language": language, "hand": hand}
        kept.keep_course(exercise_path(name), secret, **said, **({"paper": paper, "print": ink} if paper else {}))
        # Who hands in is told by it, whatever a learning system calls the folders.
        (draft / TEACHER_FOLDER / ROSTER_FILE).write_bytes(Path(roster).read_bytes())
        _write_keys(draft / TEACHER_FOLDER / KEYS_FILE, exercise, answer_keys)
        # A copy of one that is given as well: grading looks for it here.
        write_secret(draft / TEACHER_FOLDER / SECRET_FILE, secret)
    variants_told = (Variant(exercise, key.student, key.draw, key.parameters) for key in answer_keys[:1])
    for said, scale in filter(None, map(other_scale, variants_told)):
        other = say("the text of the exercise says '{said}', but the sheet is drawn at {scale:g}° to 1 mm")
        tell(other.with_values(said=said, scale=scale))
    for answer, part in wide_tolerances(exercise, answer_keys).items():
        wide = say(
            "the tolerance of {answer} is {part:.0%} of its value; larger diagrams or --hand careful make it smaller"
        )
        tell(wide.with_values(answer=answer, part=part))
    return len(students)


def _secret_from_file(path: str | Path) -> bytes:
    """The secret in a file that is named, which must be there: another course's variants may depend on it."""
    if not Path(path).exists():
        remedy = say("check the name, or leave out --secret-file: a new secret is made then")
        raise TaskError(str(path), say("the course's secret"), say("missing"), say("a file that is there"), remedy)
    return read_secret(path)


@dataclass(frozen=True)
class Marks:
    """What worksheets need that are photographed: the secret by which their codes are signed, the paper and the ink."""

    secret: bytes
    paper: str
    ink: Ink


def papers(job: tuple[Student, tuple[Variant, AnswerKey]], marks: Marks | None = None) -> tuple[str, dict[str, bytes]]:
    """One student's answer key as text, and the bytes of all files about the student by their paths in the course."""
    from graphcam.sheets.matplotlib_renderer import write_pdf

    student, (variant, answer_key) = job
    name, text = folder_name(student.id), answer_key.to_json()
    with _scratch_folder() as place:
        theirs, key_sheets = place / STUDENTS_FOLDER / name, place / TEACHER_FOLDER / "keys"
        for folder in (theirs, key_sheets):
            folder.mkdir(parents=True)
        write_handouts(variant, student, theirs, _marked(variant, student, marks, place) if marks else None)
        write_pdf(key_sheet(variant, student, answer_key), key_sheets / f"{name}.pdf")
        AnswerKeys(place / TEACHER_FOLDER).keep(student.id, text)
        files = sorted(path for path in place.rglob("*") if path.is_file())
        return text, {path.relative_to(place).as_posix(): path.read_bytes() for path in files}


@contextmanager
def _scratch_folder() -> Generator[Path]:
    """A temporary folder; what the system has against it is told with the folder of all such."""
    try:
        with TemporaryDirectory(prefix="graphcam-") as scratch:
            yield Path(scratch)
    except OSError as error:
        place = tempfile.tempdir or "TMPDIR"
        remedy = say("free some space there, or name another temporary folder by the variable TMPDIR")
        raise OutputError(place, error.strerror or str(error), remedy) from error


def _marked(variant: Variant, student: Student, marks: Marks, place: Path) -> Sheets:
    """The worksheet to be photographed; what a reader must know of its pages is kept for the teacher."""
    from graphcam.exercises.course.marked_worksheet import marked_sheets

    sheets, pages = marked_sheets(variant, student, marks.secret, marks.paper, marks.ink)
    folder = place / TEACHER_FOLDER / PRINTED_FOLDER
    folder.mkdir()
    for number, page in enumerate(pages, 1):
        (folder / f"{folder_name(student.id)}-{number}.json").write_text(page.to_json(), encoding="utf-8", newline="\n")
    return sheets


def _write_keys(path: Path, exercise: Exercise, answer_keys: list[AnswerKey]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, quoting=csv.QUOTE_ALL)
        head = ["student", "draw", "answer", "unit", "key", "tolerance", "marks", "tolerance_paper_mm", "bound"]
        table.writerow(head)
        for each in answer_keys:
            for row in key_rows(exercise, each):
                length = each.keys[str(row[0])].tolerance_paper
                paper = f"{length:.3f}" if math.isfinite(length) else ""
                table.writerow([cell(each.student), each.draw, *map(str, row), paper, f"{each.bound:.3f}"])

"""Courses whose worksheets are photographed: made as a teacher makes them, kept in a folder for the next photograph."""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
from nuisances import PRINTERS
from printer import RENDERERS, Print, printed

from graphcam.constructions.views import ANALYSIS, PROFILE
from graphcam.exercises.course.course_folder import PRINTED_FOLDER, STUDENTS_FOLDER, TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.course_making import make
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.photographs.page_owner import PrintedSheets
from graphcam.photo.printed_page import Ink, PrintedPage

SECRET = b"the secret of the photographs"


GIVEN_CAM = "given-cam-positions"
"""The exercise in which the pitch curve is drawn about the outline of a cam, which is printed."""


@dataclass(frozen=True)
class CourseKind:
    """An exercise, on which paper, printed in which ink."""

    exercise: str
    paper: str
    ink: Ink
    students: tuple[str, ...] = ("17", "18", "Anna M", "ü-3")

    @property
    def curve(self) -> bool:
        """Whether a curve is asked, or else plotted points."""
        return self.exercise != "inversion-arm"

    @property
    def view(self) -> str:
        """The view in which is drawn."""
        return ANALYSIS.name if self.exercise == GIVEN_CAM else PROFILE.name

    @property
    def name(self) -> str:
        """For its folder."""
        return f"{self.exercise}-{self.paper}-{self.ink}-{len(self.students)}"


KINDS = (
    CourseKind("inversion-translating", "A3", "colour"),
    CourseKind("inversion-translating", "A3", "grey"),
    CourseKind("inversion-translating", "A4", "colour"),
    CourseKind("inversion-translating", "A4", "grey"),
    CourseKind("inversion-arm", "A3", "colour"),
    CourseKind("inversion-arm", "A4", "grey"),
)
GIVEN_CAM_KINDS = tuple(
    CourseKind(GIVEN_CAM, paper, ink) for paper, ink in (("A3", "colour"), ("A3", "grey"), ("A4", "colour"))
)
"""Of a trial of their own: ``python tests/photos/trial.py --given-cam``."""


@dataclass(frozen=True, eq=False)
class Course:
    """A course that was made."""

    kind: CourseKind
    folder: Path

    @cached_property
    def exercise(self) -> Exercise:
        """The exercise, for its paper."""
        return find_exercise(self.kind.exercise, paper=self.kind.paper)

    @cached_property
    def drawn(self) -> AskedAnswer:
        """The answer that is drawn: the pitch curve, or its plotted points."""
        return next(asked for asked in self.exercise.answers if asked.mark_form)

    @cached_property
    def sheets(self) -> PrintedSheets:
        """What a reader of photographs is told."""
        teacher, exercise = self.folder / TEACHER_FOLDER, self.exercise
        return PrintedSheets(teacher, exercise.name, exercise.version, self.kind.students, SECRET)

    def key(self, student: str) -> AnswerKey:
        """The answer key of a student."""
        return AnswerKey.from_json(AnswerKeys(self.folder / TEACHER_FOLDER).find(student))

    def variant(self, student: str) -> Variant:
        """What a student was given."""
        key = self.key(student)
        return Variant(self.exercise, student, key.draw, key.parameters)

    def page(self, student: str, view: str) -> tuple[int, PrintedPage]:
        """The number, from 1, of the page on which a view is, and what is known of it."""
        found = sorted((self.folder / TEACHER_FOLDER / PRINTED_FOLDER).glob(f"{folder_name(student)}-*.json"))
        for number, path in enumerate(found, 1):
            page = PrintedPage.from_json(path.read_text(encoding="utf-8"))
            if view in page.views:
                return number, page
        raise LookupError(f"no page of {student} has the view {view}")

    def print_of(self, student: str, number: int, scratch: Path) -> tuple[Print, str]:
        """The page as it was printed, by what; always alike for one page."""
        return self.print_of_file(student, number - 1, scratch)

    def print_of_file(self, student: str, number: int, scratch: Path) -> tuple[Print, str]:
        """A page of the file, counted from 0: of a page on two sheets of paper the one or the other."""
        name = f"{self.kind.name} {student} {number}"
        rng = np.random.default_rng(zlib.crc32(name.encode()))
        printer, renderer = PRINTERS[rng.integers(len(PRINTERS))], sorted(RENDERERS)[int(rng.random() < 0.65)]
        pdf = self.folder / STUDENTS_FOLDER / folder_name(student) / "worksheet.pdf"
        return printed(pdf, number, printer, renderer, scratch / "prints"), f"{renderer} {printer.name}"


@cache
def course_of(kind: CourseKind, scratch: Path) -> Course:
    """The course, made if it is not there yet; several may make it at a time."""
    folder = scratch / kind.name
    if not folder.is_dir():
        scratch.mkdir(parents=True, exist_ok=True)
        draft = Path(mkdtemp(dir=scratch))
        (draft / "secret").write_bytes(SECRET)
        (draft / "roster.csv").write_text("id\n" + "\n".join(kind.students) + "\n", encoding="utf-8")
        make(kind.exercise, draft / "roster.csv", draft / "secret", draft / "course", paper=kind.paper, ink=kind.ink)
        try:
            (draft / "course").rename(folder)
        except OSError:
            # Another one was first, and the courses are the same.
            assert folder.is_dir()
    return Course(kind, folder)

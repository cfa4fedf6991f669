"""Whose page of which worksheet a photograph shows: the QR code says so, and nothing else is asked."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import PRINTED_FOLDER
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.course.sheet_code import SheetCode
from graphcam.photo.pictures import PhotographError
from graphcam.photo.printed_page import PrintedPage
from graphcam.words import message, say

CODE_REMEDY = say("include the whole sheet with its QR code, and keep the picture sharp")


@dataclass(frozen=True)
class PrintedSheets:
    """The worksheets that were printed for a course.

    teacher : the teacher's folder of the course
    exercise, version : that the course is about
    students : ids of those in the course
    """

    teacher: Path
    exercise: str
    version: int
    students: Sequence[str]
    secret: bytes

    def page(self, texts: Iterable[str], *, tags: bool) -> tuple[SheetCode, PrintedPage]:
        """The page whose code is among the texts that were read off a photograph.

        tags : whether the photograph shows tags, as a worksheet has them

        Raises
        ------
        PhotographError : there is none, or there are two, or it is not of this course; each has its own reason
        """
        codes: set[SheetCode] = set()
        errors: list[TaskError] = []
        for text in dict.fromkeys(texts):
            try:
                codes.add(SheetCode.from_text(text, self.secret, self.students, self.exercise))
            except TaskError as error:
                errors.append(error)
        if len(codes) > 1:
            raise PhotographError(
                say("it shows {count} sheets", count=len(codes)), say("photograph each sheet by itself")
            )
        if not codes:
            raise _unidentified_error(errors, tags=tags)
        code = codes.pop()
        return code, self._printed(code)

    def _printed(self, code: SheetCode) -> PrintedPage:
        """What must be known of a page to read it."""
        if code.version != self.version:
            raise PhotographError(
                say(
                    "it belongs to version {found} of the exercise, not {wanted}",
                    found=code.version,
                    wanted=self.version,
                ),
                say("read it with the course that it was printed for"),
            )
        path = self.teacher / PRINTED_FOLDER / f"{folder_name(code.student)}-{code.page}.json"
        try:
            page = PrintedPage.from_json(path.read_text(encoding="utf-8"), str(path))
        except OSError:
            page = None
        except TaskError as error:
            raise PhotographError(error.caption, say("make the course again")) from None
        # The parameters of a student change if the course is made anew after others were added before.
        if page is None or page.code != code.text(self.secret):
            raise PhotographError(
                say("it differs from the printed sheets of this course"),
                say("read it with the course that it was printed for"),
            )
        return page


def _unidentified_error(errors: Sequence[TaskError], *, tags: bool) -> PhotographError:
    if errors:
        error = errors[0]
        what, value, expected = error.args[1:4]
        fault = say("{what} is {shown}, but must be {allowed}", what=what, shown=str(value), allowed=expected)
        return PhotographError(message(fault), error.advice)
    if tags:
        return PhotographError(say("the QR code cannot be seen"), CODE_REMEDY)
    return PhotographError(say("it shows no worksheet: neither the QR code nor the marks can be seen"), CODE_REMEDY)

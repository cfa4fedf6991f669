"""What a teacher corrects, types and confirms on the review page: kept apart from what was read, so that it lasts."""

from __future__ import annotations

import json
import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np

from graphcam.errors import TaskError, UnreadableError
from graphcam.exercises.definition.exercise import Exercise, Given
from graphcam.exercises.photographs.read_photo import pairs
from graphcam.exercises.reading.answer_values import Points, number, points
from graphcam.exercises.reading.regular_file import read_regular
from graphcam.files import whole_file
from graphcam.words import Words, bare_caption, say

FORMAT_VERSION = 1
CORRECTIONS_FILE = "photo-corrections.json"
"""The teacher's file of all corrections of the course."""
MAX_FILE_BYTES = 100_000_000
"""Bytes of a file of corrections: a thousand students with a curve each fill a third of it."""
STRETCH_RANGE = (0.97, 1.03)
"""A printer scales by less; a bar that differs more was measured from the wrong end."""
MAX_DISTANCE = 2000.0
"""mm from the view's origin: no paper is larger."""
Verdict = Literal["corrected", "confirmed", "left out"]
EXPORT_REMEDY = say("export the corrections from the review page again")


@dataclass(frozen=True, eq=False)
class Correction:
    """What the teacher says of one answer.

    verdict : it has another value, it is right as it was read, or it does not count
    value : of a corrected one: a number that was typed, or the points of a :class:`ReadAnswer`
    photo : digest of the photograph that the teacher looked at; empty of a number that was typed
    """

    verdict: Verdict
    value: Given | None = None
    photo: str = ""


@dataclass(frozen=True, eq=False)
class StudentCorrections:
    """What the teacher says of one student's sheets.

    answers : by name
    bars : by page, the measured lengths of the scale bars, across and up [mm]; None where one was not measured
    reviewed : whether the teacher is done with this student
    """

    answers: Mapping[str, Correction] = field(default_factory=dict[str, Correction])
    bars: Mapping[int, tuple[float | None, float | None]] = field(
        default_factory=dict[int, tuple[float | None, float | None]]
    )
    reviewed: bool = False


NO_CORRECTIONS = StudentCorrections()
"""The teacher has said nothing yet."""
Corrections = Mapping[str, StudentCorrections]
"""The corrections by the student's id."""


def kept_corrections(teacher: Path, exercise: Exercise, students: Collection[str]) -> Corrections:
    """The corrections that are kept in the teacher's folder; empty where there are none.

    Raises
    ------
    TaskError : they cannot be used any more
    """
    path = teacher / CORRECTIONS_FILE
    return read_corrections(path, exercise, students) if path.exists() else {}


def keep_corrections(teacher: Path, exercise: Exercise, corrections: Corrections) -> None:
    """Keep corrections in the teacher's folder.

    Raises
    ------
    OutputError : they cannot be written
    """
    with whole_file(teacher / CORRECTIONS_FILE) as draft:
        draft.write_text(to_json(exercise, corrections) + "\n", encoding="utf-8", newline="\n")


def to_json(exercise: Exercise, corrections: Corrections) -> str:
    """The corrections as JSON text."""
    students = {student: student_data(one) for student, one in corrections.items()}
    said = {"format": FORMAT_VERSION, "exercise": exercise.name, "students": students}
    return json.dumps(said, allow_nan=False)


def student_data(one: StudentCorrections) -> dict[str, Any]:
    """One student's corrections as JSON takes them."""
    answers = {
        name: {
            "verdict": each.verdict,
            "value": pairs(each.value) if isinstance(each.value, np.ndarray) else each.value,
            "photo": each.photo,
        }
        for name, each in one.answers.items()
    }
    bars = {str(page): list(lengths) for page, lengths in one.bars.items()}
    return {"answers": answers, "bars": bars, "reviewed": one.reviewed}


def read_corrections(path: Path, exercise: Exercise, students: Collection[str]) -> Corrections:
    """The corrections in a file, as the review page exports them.

    students : of the course

    Raises
    ------
    TaskError : the file cannot be read, or says what cannot be; field, value, what is allowed and what to do
    """
    try:
        text = read_regular(path, MAX_FILE_BYTES).decode("utf-8")
        said = json.loads(text)
    except UnreadableError as error:
        what, found = say("the file"), say("not readable ({error})", error=error.why)
        raise TaskError(str(path), what, found, say("a file of corrections"), say("check the name")) from None
    except (ValueError, RecursionError):
        raise TaskError(
            str(path), say("the file"), say("not JSON"), say("a file of corrections"), EXPORT_REMEDY
        ) from None
    reader = _Reader(str(path), exercise)
    table = reader.table(say("the file"), said, {"format", "exercise", "students"})
    reader.choice("format", table["format"], (FORMAT_VERSION,))
    reader.choice("exercise", table["exercise"], (exercise.name,))
    listed = reader.table("students", table["students"])
    for student in listed:
        if student not in students:
            expected = say("ids of this course")
            raise TaskError(str(path), "students", student, expected, say("use the corrections of this course"))
    return {student: reader.student(f"students.{student}", one) for student, one in listed.items()}


@dataclass(frozen=True)
class _Reader:
    """Reads a file of corrections, strictly: whatever is not understood is said, with its place."""

    path: str
    exercise: Exercise

    def value_error(self, where: Words, value: object, allowed: Words) -> TaskError:
        """The error of a value at a place of the file, with what is allowed there."""
        if isinstance(value, str):
            return TaskError(self.path, where, value[:60], allowed, EXPORT_REMEDY)
        shown = f"{value}"[:60] if isinstance(value, int | float | None) else f"a {type(value).__name__}"
        return TaskError(self.path, where, bare_caption(shown), allowed, EXPORT_REMEDY)

    def table(self, where: Words, said: Any, names: set[str] | None = None) -> dict[str, Any]:
        """A table, with exactly these names if they are given."""
        if not isinstance(said, dict):
            raise self.value_error(where, said, say("a table"))
        if names is not None and said.keys() != names:
            limit = say("a table of {names}", names=", ".join(sorted(names)))
            raise self.value_error(where, ", ".join(map(str, said)), limit)
        return said

    def choice(self, where: str, said: Any, allowed: tuple[Any, ...]) -> Any:
        """What is said, if it is one of what is allowed."""
        if not any(type(said) is type(one) and said == one for one in allowed):
            raise self.value_error(where, said, say("one of {names}", names=", ".join(map(str, allowed))))
        return said

    def student(self, where: str, said: Any) -> StudentCorrections:
        """The corrections of a student's answers and bars."""
        table = self.table(where, said, {"answers", "bars", "reviewed"})
        answers = self.table(f"{where}.answers", table["answers"])
        bars = self.table(f"{where}.bars", table["bars"])
        return StudentCorrections(
            {name: self.answer(f"{where}.answers.{name}", name, one) for name, one in answers.items()},
            dict(self.lengths(f"{where}.bars.{page}", page, one) for page, one in bars.items()),
            self.choice(f"{where}.reviewed", table["reviewed"], (True, False)),
        )

    def answer(self, where: str, name: str, said: Any) -> Correction:
        """The correction of an answer, by its name."""
        asked = next((one for one in self.exercise.answers if one.name == name), None)
        if asked is None:
            names = ", ".join(one.name for one in self.exercise.answers)
            raise self.value_error(where, name, say("one of the answers {names}", names=names))
        table = self.table(where, said, {"verdict", "value", "photo"})
        # Nothing but a drawing is read, so nothing else can be right as it was read.
        verdicts = ("corrected", "confirmed", "left out") if asked.mark_form else ("corrected",)
        verdict = self.choice(f"{where}.verdict", table["verdict"], verdicts)
        photo = table["photo"]
        if not isinstance(photo, str) or len(photo) > 200:
            raise self.value_error(f"{where}.photo", photo, say("a digest"))
        if verdict != "corrected":
            self.choice(f"{where}.value", table["value"], (None,))
            return Correction(verdict, None, photo)
        try:
            given: Given = points(name, table["value"]) if asked.mark_form else number(name, table["value"])
        except UnreadableError as error:
            raise self.value_error(f"{where}.value", str(error), say("as the answer is asked")) from None
        if isinstance(given, np.ndarray) and np.abs(given).max() > MAX_DISTANCE:
            found, limit = f"{np.abs(given).max():g} mm away", say("within {farthest:g} mm", farthest=MAX_DISTANCE)
            raise self.value_error(f"{where}.value", found, limit)
        return Correction(verdict, given, photo)

    def lengths(self, where: str, page: str, said: Any) -> tuple[int, tuple[float | None, float | None]]:
        """The number of a page, and the lengths of its bars, across and up [mm]; None where one is not told."""
        if not (page.isascii() and page.isdecimal() and 0 < int(page[:4]) < 1000):
            raise self.value_error(where, page, say("the number of a page"))
        if not isinstance(said, list) or len(said) != 2:
            raise self.value_error(where, said, say("two lengths in mm, across and up"))
        across, up = (self.length(where, one) for one in said)
        return int(page), (across, up)

    def length(self, where: str, said: Any) -> float | None:
        """A length in mm, if it was measured."""
        if said is None:
            return None
        if isinstance(said, bool) or not isinstance(said, int | float) or not 0 < said <= MAX_DISTANCE:
            raise self.value_error(where, said, say("a length in mm, at most {farthest:g}", farthest=MAX_DISTANCE))
        return float(said)


def stretch_of(
    printed: tuple[float, float], measured: tuple[float | None, float | None], where: str
) -> tuple[float, float]:
    """How much longer the paper is than it should be, across and up; 1 where a bar was not measured.

    printed, measured : lengths of the scale bars [mm]

    Raises
    ------
    TaskError : a printer does not scale by so much, so the bar is to be measured again

    >>> stretch_of((250.0, 180.0), (252.5, None), "Anna")
    (1.01, 1.0)
    """
    found: list[float] = []
    for length, said, way in zip(printed, measured, ("across", "up"), strict=True):
        part = said / length if said is not None and length > 0 else 1.0
        if not (math.isfinite(part) and STRETCH_RANGE[0] <= part <= STRETCH_RANGE[1]):
            allowed = say(
                "from {value:.1f} to {value2:.1f} mm", value=STRETCH_RANGE[0] * length, value2=STRETCH_RANGE[1] * length
            )
            what = say("the scale bar {way}", way=way)
            raise TaskError(where, what, say("{length:g} mm", length=said), allowed, say("measure it again"))
        found.append(part)
    return found[0], found[1]


def stretched_points(points: Points, stretch: tuple[float, float]) -> Points:
    """Points on paper that is so much longer across and up.

    >>> stretched_points(np.array([10 + 10j]), (1.01, 0.99)).tolist()
    [(10.1+9.9j)]
    """
    return points.real * stretch[0] + 1j * points.imag * stretch[1]


def with_changes(kept: Corrections, changes: Corrections) -> Corrections:
    """The kept corrections, those of the students in the changes replaced."""
    return {**kept, **changes}

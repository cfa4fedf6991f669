"""The list of students: a CSV file whose ids are data, whatever they say."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import TaskError
from graphcam.exercises.course.folder_names import folder_name


@dataclass(frozen=True)
class Student:
    """One line of the roster; ``name`` is for the title block and may be empty."""

    id: str
    name: str = ""


def read_roster(path: str | Path) -> list[Student]:
    """The students of a CSV file with a header: the column "id" and, if there is one, "name".

    Without these headings every line is a student, the first column the id, the second the name.

    Raises
    ------
    TaskError : the file cannot be read, is empty, names a student twice, or one by what cannot be printed
    """
    try:
        text = Path(path).read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise TaskError(str(path), "the roster", error.strerror or "not readable", "a CSV file") from None
    except UnicodeDecodeError:
        raise TaskError(str(path), "the roster", "not UTF-8", "a CSV file in UTF-8", "save it as UTF-8") from None
    delimiter = ";" if text.partition("\n")[0].count(";") > text.partition("\n")[0].count(",") else ","
    try:
        rows = [row for row in csv.reader(io.StringIO(text, newline=""), delimiter=delimiter) if any(row)]
    except csv.Error as error:
        raise TaskError(str(path), "the roster", str(error), "a CSV file") from None
    students = _students(rows)
    if not students:
        raise TaskError(str(path), "the roster", "empty", "a line a student", "give a column 'id'")
    seen: dict[str, str] = {}
    for student in students:
        if not student.id.strip():
            raise TaskError(
                str(path), "id", student.id, "given", f"fill in the id of {student.name or 'every student'}"
            )
        # Some file systems do not tell capitals from small letters.
        folder = folder_name(student.id).casefold()
        if folder in seen:
            raise TaskError(str(path), "id", student.id, f"another one than {seen[folder]!r}", "name each student once")
        seen[folder] = student.id
        # It stands in the title block.
        if not (said := student.name or student.id).isprintable():
            raise TaskError(str(path), "the name", repr(said), "printable text on one line")
    return students


def _students(rows: list[list[str]]) -> list[Student]:
    heading = [cell.strip().lower() for cell in rows[0]] if rows else []
    if "id" not in heading:
        return [Student(row[0], row[1] if len(row) > 1 else "") for row in rows]
    at, named = heading.index("id"), heading.index("name") if "name" in heading else None
    full = [row for row in rows[1:] if len(row) > at]
    return [Student(row[at], row[named] if named is not None and len(row) > named else "") for row in full]

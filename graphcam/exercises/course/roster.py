"""The students: a CSV file whose ids are data, whatever they say, and their names as folders; none is a path."""

import hashlib
import re
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import TaskError
from graphcam.exercises.course.roster_columns import at, names_alone, roster_columns
from graphcam.exercises.course.spreadsheet import read_table
from graphcam.words import Caption, say

LONGEST = 180
"""Bytes of a folder's name; file systems take 255, and a suffix may follow."""
_UNSAFE = re.compile(r'[\x00-\x1f\x7f-\x9f%/\\<>:"|?*\ud800-\udfff\u200e\u200f\u202a-\u202e\u2066-\u2069]')
_CUT = re.compile(r"%~[0-9a-f]{24}$")
_DEVICES = re.compile(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\..*)?$")


def folder_name(student: str) -> str:
    """A name for the student's folder that is one folder on every system; readable where that is safe.

    Characters that mean something to a file system are written as %XX of their UTF-8 bytes, so :func:`student_of`
    finds the name again; one that is too long is cut and ends with a digest of the whole.

    >>> folder_name("Anna Müller"), folder_name("../etc/passwd"), folder_name("")
    ('Anna Müller', '%2E.%2Fetc%2Fpasswd', '%')
    """
    name = _UNSAFE.sub(_escaped, student)
    # A leading point hides a folder or leaves it, a trailing point or space is lost on some systems.
    name = re.sub(r"^[. ]|[. ]$", _escaped, name)
    if _DEVICES.match(name):
        name = f"%{ord(name[0]):02X}{name[1:]}"
    if len(name.encode()) > LONGEST:
        digest = hashlib.sha256(student.encode("utf-8", "surrogatepass")).hexdigest()[:24]
        return name.encode()[: LONGEST - 30].decode(errors="ignore").rstrip("%. ") + f"%~{digest}"
    return name or "%"


def student_of(folder: str) -> str:
    """The student whose folder this is: of a name by :func:`folder_name` that one's, else the folder's name itself.

    >>> student_of("%2E.%2Fetc%2Fpasswd"), student_of("100%")
    ('../etc/passwd', '100%')
    """
    if folder == "%":
        return ""
    try:
        coded = folder.encode("utf-8", "surrogatepass")
        raw = re.sub(rb"%([0-9A-F]{2})", lambda code: bytes([int(code[1], 16)]), coded)
        student = raw.decode("utf-8", "surrogatepass")
        return student if folder_name(student) == folder else folder
    except UnicodeError:
        return folder


def is_cut(folder: str) -> bool:
    """Whether the folder's name is that of a student whose name was too long for one.

    >>> is_cut(folder_name("n" * 300)), is_cut(folder_name("n"))
    (True, False)
    """
    return _CUT.search(folder) is not None


def _escaped(character: re.Match[str]) -> str:
    return "".join(f"%{byte:02X}" for byte in character[0].encode("utf-8", "surrogatepass"))


@dataclass(frozen=True)
class Student:
    """One line of the roster; ``name`` is for the title block, ``email`` for other systems; both may be empty."""

    id: str
    name: str = ""
    email: str = ""


def read_roster(path: str | Path) -> list[Student]:
    """The students of a CSV file with a header: the column "id" and, if there are such, "name" and "email".

    Other usual headings are known too, see :func:`~graphcam.exercises.course.roster_columns.roster_columns`.  Without
    any, every line is a student, the first column the id, the second the name.

    Raises
    ------
    TaskError : the file cannot be read, is empty, names a student twice, or one by what cannot be printed
    """
    rows = read_table(path, "the roster")
    if rows and names_alone(rows[0][1]) and not roster_columns([row for _, row in rows]).heading:
        found, advice = say("missing"), say("add a column 'id', or one of the addresses, 'email'")
        raise TaskError(str(path), say("the column of ids"), found, say("given"), advice)
    students = _students(rows)
    if not students:
        what = say("the roster")
        raise TaskError(str(path), what, say("empty"), say("one line for each student"), say("give a column 'id'"))
    seen: dict[str, tuple[int, str]] = {}
    for line, student in students:
        if not student.id.strip():
            remedy = say("fill in the id of {value}", value=student.name or "every student")
            raise TaskError(str(path), say("line {line}: id", line=line), student.id, say("given"), remedy)
        # Some file systems do not tell capitals from small letters.
        folder = folder_name(student.id).casefold()
        if folder in seen:
            before, same = seen[folder]
            expected = say("another one than {same!r} in line {before}", same=same, before=before)
            what = say("line {line}: id", line=line)
            raise TaskError(str(path), what, student.id, expected, say("name each student once"))
        seen[folder] = line, student.id
        # It stands in the title block.
        if not (said := student.name or student.id).isprintable():
            raise TaskError(str(path), say("the name"), said, say("printable text on one line"), say("retype it"))
    return [student for _, student in students]


def ids_from(path: str | Path) -> Caption:
    """The column that a roster's ids are taken from, in words.

    Raises
    ------
    TaskError : the file cannot be read
    """
    heading = roster_columns([row for _, row in read_table(path, "the roster")]).heading
    if heading:
        return say("ids from the column '{column}'", column=heading)
    return say("ids from the first column; no line is a heading")


def _students(rows: list[tuple[int, list[str]]]) -> list[tuple[int, Student]]:
    """The students, each with the number of its line."""
    columns = roster_columns([row for _, row in rows])
    listed = [(line, row) for line, row in rows[bool(columns.heading) :] if len(row) > columns.id]
    return [(line, Student(row[columns.id], columns.name(row), at(row, columns.email).strip())) for line, row in listed]

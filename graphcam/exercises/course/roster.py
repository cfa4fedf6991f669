"""The students: a CSV file whose ids are data, whatever they say, and their names as folders; none is a path."""

import hashlib
import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import TaskError
from graphcam.exercises.course.spreadsheet import read_table
from graphcam.words import Caption, say

ID_HEADINGS = (
    *("id", "ID number", "Student ID", "Student number", "Student no", "Student code", "Matriculation number"),
    *("Matrikelnummer", "Matrikelnr", "Matrikel", "Mat-Nr", "Matrikel-Nr.", "ID-Nummer"),
    *("Индивидуальный номер", "Идентификационный номер"),
    "SIS User ID",
    *("Номер зачётной книжки", "Номер зачетной книжки", "Зачётная книжка", "Зачетная книжка", "№ зачётной книжки"),
    *("Студенческий билет", "Номер студенческого билета", "Табельный номер", "学号", "MSSV", "Mã số sinh viên"),
    *("Mã SV", "Mã sinh viên", "Номер", "№"),
)
"""Headings of ids, the surest first: the last may only count the lines."""
MOODLE_ID_HEADING = "ID number"
"""What Moodle calls the ids; the heading in its table of grades where the roster has none."""
EMAIL_HEADINGS = (
    "email",
    "Email address",
    "E-mail-Adresse",
    "Mail",
    "Адрес электронной почты",
    "Электронная почта",
    "Почта",
)
"""Headings of addresses; a roster without ids has them for ids."""
NAME_HEADINGS = (
    *("name", "Full name", "Student name", "Student", "Vor- und Nachname", "ФИО", "Фамилия и имя", "Имя и фамилия"),
    *("姓名", "Họ và tên", "Họ tên"),
)
"""Headings of whole names."""
NAME_PART_HEADINGS = (
    *(("First name", "Last name"), ("First name", "Surname"), ("Given name", "Family name"), ("Vorname", "Nachname")),
    *(("Имя", "Фамилия"), ("姓", "名"), ("Họ", "Tên"), ("Họ đệm", "Tên"), ("Họ và tên đệm", "Tên")),
)
"""Headings of the parts of a name, in the order in which the name is said."""


@dataclass(frozen=True)
class RosterColumns:
    """The columns of a roster, counted from 0.

    id : the column of the ids;  names : those whose cells together are a name;  email : None where there is none
    heading : of the ids' column; empty where the first row is a student
    """

    id: int
    names: tuple[int, ...]
    email: int | None
    heading: str = ""

    def name(self, row: Sequence[str]) -> str:
        """The name in a row; empty where it has none."""
        return " ".join(part for part in (cell_at(row, place) for place in self.names) if part.strip())


def cell_at(row: Sequence[str], place: int | None) -> str:
    """A cell; empty where the row is shorter.

    >>> cell_at(["7", "Anna"], 1), cell_at(["7"], 1), cell_at(["7"], None)
    ('Anna', '', '')
    """
    return row[place] if place is not None and place < len(row) else ""


def roster_columns(rows: Sequence[Sequence[str]]) -> RosterColumns:
    """The columns of a table of students (rows of cells).

    The first row is a heading if it has a usual one for the ids, or an address in its place; or if there are several
    columns and of the first one every row but the first has a digit.

    >>> roster_columns([["First name", "Last name", "ID number"], ["Anna", "Berg", "7"]])
    RosterColumns(id=2, names=(0, 1), email=None, heading='ID number')
    >>> roster_columns([["Kennung", "Name"], ["k7", "Anna"]]).heading
    'Kennung'
    >>> roster_columns([["7", "Anna"], ["8", "Ben"]])
    RosterColumns(id=0, names=(1,), email=None, heading='')
    """
    first, others = (rows[0], rows[1:]) if rows else ([], [])
    places = {_plain(heading): place for place, heading in reversed(list(enumerate(first)))}
    email = next(_known(places, EMAIL_HEADINGS), None)
    known = [*_known(places, ID_HEADINGS), *([] if email is None else [email])]
    # A platform exports the column whether or not anybody has an id.
    ids = [place for place in known if any(cell_at(row, place).strip() for row in others)] or known
    if (
        not ids
        and len(first) > 1
        and others
        and not _digit(first[0])
        and all(_digit(cell_at(row, 0)) for row in others)
    ):
        ids = [0]
    if not ids:
        return RosterColumns(0, (1,), None)
    whole = list(_known(places, NAME_HEADINGS))[:1]
    parts = next((pair for said in NAME_PART_HEADINGS if len(pair := list(_known(places, said))) == 2), [])
    return RosterColumns(ids[0], tuple(whole or parts), email, first[ids[0]].strip())


def names_alone(first: Sequence[str]) -> bool:
    """Whether a row is a heading of names, with none of ids or addresses.

    >>> names_alone(["First name", "Last name"]), names_alone(["7", "Anna"])
    (True, False)
    """
    plain = {_plain(heading) for heading in first}
    return not plain.isdisjoint(
        map(_plain, (*NAME_HEADINGS, *(part for pair in NAME_PART_HEADINGS for part in pair)))
    ) and plain.isdisjoint(map(_plain, (*ID_HEADINGS, *EMAIL_HEADINGS)))


def _known(places: dict[str, int], headings: Iterable[str]) -> Iterator[int]:
    return (places[plain] for plain in map(_plain, headings) if plain in places)


def _digit(text: str) -> bool:
    return any(letter.isdigit() for letter in text)


def _plain(heading: str) -> str:
    """Letters and digits alone, capitals as small ones.

    >>> _plain("E-Mail Address"), _plain("№")
    ('emailaddress', 'no')
    """
    return "".join(letter for letter in unicodedata.normalize("NFKC", heading).casefold() if letter.isalnum())


MAX_FOLDER_BYTES = 180
"""Bytes of a folder's name; file systems take 255, and a suffix may follow."""
_UNSAFE_PATTERN = re.compile(r'[\x00-\x1f\x7f-\x9f%/\\<>:"|?*\ud800-\udfff\u200e\u200f\u202a-\u202e\u2066-\u2069]')
_UNSEEN = "\u00a0\u200b\u200e\u200f\u2060\ufeff"
"""What programs leave at the ends of an id and nobody sees."""
_CUT_PATTERN = re.compile(r"%~[0-9a-f]{24}$")
_DEVICE_PATTERN = re.compile(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\..*)?$")


def folder_name(student: str) -> str:
    """A name for the student's folder that is one folder on every system; readable where that is safe.

    Characters that mean something to a file system are written as %XX of their UTF-8 bytes, so :func:`student_of`
    finds the name again; one that is too long is cut and ends with a digest of the whole.

    >>> folder_name("Anna Müller"), folder_name("../etc/passwd"), folder_name("")
    ('Anna Müller', '%2E.%2Fetc%2Fpasswd', '%')
    """
    name = _UNSAFE_PATTERN.sub(_escaped, student)
    # A leading point hides a folder or leaves it, a trailing point or space is lost on some systems.
    name = re.sub(r"^[. ]|[. ]$", _escaped, name)
    if _DEVICE_PATTERN.match(name):
        name = f"%{ord(name[0]):02X}{name[1:]}"
    if len(name.encode()) > MAX_FOLDER_BYTES:
        digest = hashlib.sha256(student.encode("utf-8", "surrogatepass")).hexdigest()[:24]
        return name.encode()[: MAX_FOLDER_BYTES - 30].decode(errors="ignore").rstrip("%. ") + f"%~{digest}"
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


def is_shortened(folder: str) -> bool:
    """Whether the folder's name is that of a student whose name was too long for one.

    >>> is_shortened(folder_name("n" * 300)), is_shortened(folder_name("n"))
    (True, False)
    """
    return _CUT_PATTERN.search(folder) is not None


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

    Other usual headings are known too, see :func:`~graphcam.exercises.course.roster.roster_columns`.  Without
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


def id_heading(path: str | Path) -> str:
    """The heading of the column that a roster's ids are taken from; empty where no line is a heading.

    Raises
    ------
    TaskError : the file cannot be read
    """
    return roster_columns([row for _, row in read_table(path, "the roster")]).heading


def ids_from(path: str | Path) -> Caption:
    """The column that a roster's ids are taken from, in words.

    Raises
    ------
    TaskError : the file cannot be read
    """
    rows = [row for _, row in read_table(path, "the roster")]
    columns = roster_columns(rows)
    if columns.heading and not columns.names and len(rows[0]) > 1:
        return say("ids from the column '{column}'; no column is headed 'name'", column=columns.heading)
    if columns.heading:
        return say("ids from the column '{column}'", column=columns.heading)
    return say("ids from the first column; no line is a heading")


def _students(rows: list[tuple[int, list[str]]]) -> list[tuple[int, Student]]:
    """The students of the rows, each with the number of its line."""
    columns = roster_columns([row for _, row in rows])
    listed = [(line, row) for line, row in rows[bool(columns.heading) :] if len(row) > columns.id]
    return [
        (
            line,
            Student(row[columns.id].strip(_UNSEEN), _printed(columns.name(row)), cell_at(row, columns.email).strip()),
        )
        for line, row in listed
    ]


def _printed(name: str) -> str:
    """A name as it is printed: one plain space where it has spaces of any kind, and no marks that are not seen.

    >>> _printed("Eva\\u00a0 Müller\\u200e\\n")
    'Eva Müller'
    """
    seen = "".join(letter for letter in name if unicodedata.category(letter) != "Cf")
    return re.sub(r"[^\S\r\n]+", " ", seen).strip()

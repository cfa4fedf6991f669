"""The columns of a roster by their headings, as learning platforms and offices of several countries write them."""

import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

ID = (
    *("id", "ID number", "Student ID", "Student number", "Student no", "Student code", "Matriculation number"),
    *("Matrikelnummer", "Matrikelnr", "Matrikel", "Mat-Nr", "Matrikel-Nr.", "ID-Nummer"),
    "SIS User ID",
    *("Номер зачётной книжки", "Номер зачетной книжки", "Зачётная книжка", "Зачетная книжка", "№ зачётной книжки"),
    *("Студенческий билет", "Номер студенческого билета", "Табельный номер", "学号", "MSSV", "Mã số sinh viên"),
    *("Mã SV", "Mã sinh viên", "Номер", "№"),
)
"""Headings of ids, the surest first: the last may only count the lines."""
EMAIL = ("email", "Email address", "E-mail-Adresse", "Mail", "Адрес электронной почты", "Электронная почта", "Почта")
"""Headings of addresses; a roster without ids has them for ids."""
NAME = (
    *("name", "Full name", "Student name", "Student", "Vor- und Nachname", "ФИО", "Фамилия и имя", "Имя и фамилия"),
    *("姓名", "Họ và tên", "Họ tên"),
)
"""Headings of whole names."""
PARTS = (
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
        return " ".join(part for part in (at(row, place) for place in self.names) if part.strip())


def at(row: Sequence[str], place: int | None) -> str:
    """A cell; empty where the row is shorter.

    >>> at(["7", "Anna"], 1), at(["7"], 1), at(["7"], None)
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
    email = next(_known(places, EMAIL), None)
    known = [*_known(places, ID), *([] if email is None else [email])]
    # A platform exports the column whether or not anybody has an id.
    ids = [place for place in known if any(at(row, place).strip() for row in others)] or known
    if not ids and len(first) > 1 and others and not _digit(first[0]) and all(_digit(at(row, 0)) for row in others):
        ids = [0]
    if not ids:
        return RosterColumns(0, (1,), None)
    whole = list(_known(places, NAME))[:1]
    parts = next((pair for said in PARTS if len(pair := list(_known(places, said))) == 2), [])
    return RosterColumns(ids[0], tuple(whole or parts), email, first[ids[0]].strip())


def names_alone(first: Sequence[str]) -> bool:
    """Whether a row is a heading of names, with none of ids or addresses.

    >>> names_alone(["First name", "Last name"]), names_alone(["7", "Anna"])
    (True, False)
    """
    plain = {_plain(heading) for heading in first}
    return not plain.isdisjoint(map(_plain, (*NAME, *(part for pair in PARTS for part in pair)))) and plain.isdisjoint(
        map(_plain, (*ID, *EMAIL))
    )


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

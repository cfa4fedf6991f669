"""Tables that a teacher keeps about the students of a course: a line each, with a column that says who it is."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import TaskError
from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.spreadsheet import cell, read_table
from graphcam.words import Words, say


@dataclass(frozen=True)
class StudentLine:
    """One line: where it stands, whose it is, and its cells by the heading of their column."""

    path: str
    number: int
    student: str
    cells: Mapping[str, str]

    def __getitem__(self, column: str) -> str:
        """What stands in a column, without spaces around it; empty where the line has no such cell."""
        return self.cells.get(column, "").strip()

    def wrong(self, column: str, expected: Words, remedy: Words) -> TaskError:
        """The error to raise about a cell of this line."""
        what = say("line {number}: {column}", number=self.number, column=column)
        return TaskError(self.path, what, self[column], expected, remedy)


def student_lines(
    path: Path,
    what: Words,
    columns: Sequence[str],
    known: Recognition,
    who: Words = "of the course",
    absent: str = "check the id",
) -> Iterator[StudentLine]:
    """The lines of a CSV file about students, whom it names by id, e-mail address or name.

    what : the table, as a message names it: "the table of extensions"
    columns : headings that must be there, in any order and among others; the first is the student's
    known, who : the students that it may name, and in words which they are
    absent : the remedy where a line names none of them

    Raises
    ------
    TaskError : the file cannot be read, lacks a column, or a line names nobody, or may mean several students
    """
    rows = read_table(path, what)
    head = [name.strip().lower() for name in rows[0][1]] if rows else []
    if not set(columns) <= set(head):
        remedy = say("name the columns in the first line")
        expected = say("with {names}", names=",".join(columns))
        raise TaskError(str(path), say("the first line"), ",".join(head), expected, remedy)
    for number, row in rows[1:]:
        cells = dict(zip(head, row, strict=False))
        said = cells.get(columns[0], "")
        meant = _meant(said, known)
        if len(meant) != 1:
            remedy = say("it may mean {names}; give the id", names=", ".join(meant)) if meant else absent
            expected = say("one student {who} by id, address or name", who=who)
            raise TaskError(
                str(path), say("line {number}: {columns}", number=number, columns=columns[0]), said, expected, remedy
            )
        yield StudentLine(str(path), number, meant[0], cells)


def _meant(said: str, known: Recognition) -> list[str]:
    """The students whom a cell may mean; an id copied from a table of grades may have the guard of its cell."""
    exact = [student for student in known.ids if said in (student, cell(student))]
    return exact or known.meant([said])


def once(lines: Iterable[StudentLine], keys: Sequence[str], remedy: Words) -> Iterator[StudentLine]:
    """The lines, if none of them is about the same student and the same other cells as one before.

    Raises
    ------
    TaskError : one is
    """
    seen: set[tuple[str, ...]] = set()
    for line in lines:
        about = (line.student, *(line[key] for key in keys))
        if about in seen:
            raise line.wrong(keys[-1] if keys else "student", say("another one"), remedy)
        seen.add(about)
        yield line

"""All files of a graded course, written together; the grades are CSV that is safe to open in a spreadsheet."""

import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import quote

from graphcam.exercises.course.photo_reports import photo_pictures
from graphcam.exercises.course.roster import MOODLE_ID_HEADING, folder_name
from graphcam.exercises.course.spreadsheet import table
from graphcam.exercises.course.submissions import Refused
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.copy_detection import AlikePair
from graphcam.exercises.marking.record import is_handed_in
from graphcam.exercises.reports.group_page import group_page, student_rows
from graphcam.exercises.reports.learning_platforms import canvas_grades, moodle_grades
from graphcam.exercises.reports.shown_names import ShownNames
from graphcam.exercises.reports.student_page import student_page
from graphcam.files import whole_folder

LONG_COLUMNS = (
    *("student", "exercise", "answer", "outcome", "marks", "of"),
    *("given", "pencil_units", "worst_station", "off_paper_mm"),
)
BY_HAND_COLUMNS = ("student", "answer", "found", "marks", "comment")


@dataclass(frozen=True)
class GroupNotes:
    """What the reports tell besides the records.

    refused : what is not graded
    pages : the folder of the students' pages, None where none are written
    names : of the students on the pages;  called : the students' own names by id, of all of the course
    id_heading : of the column of the roster that the ids are from
    """

    refused: Sequence[Refused] = ()
    pages: Path | None = None
    names: ShownNames = field(default_factory=ShownNames)
    called: Mapping[str, str] = field(default_factory=dict[str, str])
    id_heading: str = MOODLE_ID_HEADING


def write_reports(
    out: Path,
    exercise: Exercise,
    records: Sequence[dict[str, Any]],
    answer_keys: Mapping[str, AnswerKey],
    notes: GroupNotes,
    pairs: Sequence[AlikePair],
) -> list[str]:
    """The grades, wide into ``out``; beside it long, for grade books, who agrees, the records, the group's report.

    Their names are given back.

    records : also of those who handed in nothing, who have rows without marks and no part in the statistics
    notes : what is not graded has a table of its own where there is any
    pairs : who agrees beyond chance

    Raises
    ------
    OutputError : they cannot be written
    """
    names: list[str] = []
    with whole_folder(out.parent) as draft:
        # One after the other, each gone from memory before the next is made.
        for name, parts in _texts(out, exercise, records, answer_keys, notes, pairs):
            with (draft / name).open("w", encoding="utf-8", newline="") as file:
                file.writelines(parts)
            names.append(name)
    return names


def _texts(
    out: Path,
    exercise: Exercise,
    records: Sequence[dict[str, Any]],
    answer_keys: Mapping[str, AnswerKey],
    notes: GroupNotes,
    pairs: Sequence[AlikePair],
) -> Iterator[tuple[str, Iterable[str]]]:
    """The names of the files, each with its text in parts."""
    graded = [record for record in records if is_handed_in(record)]
    yield out.name, [wide_table(records, notes.called)]
    by_hand = [(record, one) for record in records for one in record.get("overrides", [])]
    # The table of a former run would go on telling what was taken back.
    if by_hand or (out.parent / f"{out.stem}-by-hand.csv").exists():
        rows = ([record["student"], *(one[column] for column in BY_HAND_COLUMNS[1:])] for record, one in by_hand)
        yield f"{out.stem}-by-hand.csv", [table(BY_HAND_COLUMNS, rows)]
    # One row an answer, for statistics.
    yield (
        f"{out.stem}-long.csv",
        [table(LONG_COLUMNS, (_long_row(record, answer) for record in graded for answer in record["answers"]))],
    )
    yield f"{out.stem}-copies.csv", [copies_table(pairs)]
    # For grade books.
    yield f"{out.stem}-moodle.csv", [moodle_grades(exercise, records, notes.id_heading)]
    yield f"{out.stem}-canvas.csv", [canvas_grades(exercise, records)]
    yield f"{out.stem}.json", _json_lines(records)
    not_graded, names = f"{out.stem}-not-graded.csv", notes.names
    shown = names.records(records)
    links = page_links([record["student"] for record in shown], notes.pages, out.parent)
    refused = names.refused(notes.refused, not_graded)
    keys = names.answer_keys(answer_keys)
    # Their own names would tell what is hidden.
    rows = student_rows(shown, {} if names.hidden else notes.called, links, exercise.marks)
    graded = [record for record in shown if is_handed_in(record)]
    yield f"{out.stem}.html", [group_page(exercise, graded, keys, names.pairs(pairs), refused, rows)]
    if names.hidden:
        rows = sorted([name, one] for one, name in names.hidden.items())
        yield f"{out.stem}-ids.csv", [table(("name", "student"), rows)]
    # The table of a former run would go on telling what is mended.
    if notes.refused or (out.parent / not_graded).exists():
        yield not_graded, [table(("folder", "why"), ([one.place, one.why] for one in notes.refused))]


def page_links(students: Sequence[str], pages: Path | None, beside: Path) -> dict[str, str]:
    """Links to the students' pages in a folder, from a page in another one.

    >>> page_links(["a/b"], Path("out/pages"), Path("out"))
    {'a/b': 'pages/a%252Fb.html'}
    >>> page_links(["a"], None, Path("out"))
    {}
    """
    if pages is None:
        return {}
    # Absolute, as the one may have been named from elsewhere.
    way = os.path.relpath(pages.absolute(), beside.absolute())
    return {student: quote(f"{way}/{folder_name(student)}.html".replace(os.sep, "/")) for student in students}


def _json_lines(records: Sequence[dict[str, Any]]) -> Iterator[str]:
    """A list in JSON, a line a record."""
    for k, record in enumerate(records):
        yield (",\n " if k else "[") + json.dumps(record, allow_nan=False)
    yield "]\n" if records else "[]\n"


def write_feedback(
    folder: Path,
    exercise: Exercise,
    records: Sequence[dict[str, Any]],
    answer_keys: Mapping[str, AnswerKey],
    names: ShownNames,
    folders: Mapping[str, Path],
    *,
    right: bool = False,
) -> None:
    """A page for every student, under the student's id or hidden name as a file's name.

    folders : of the hand-ins by student; those that were read off photographs hold pictures
    right : whether the pages show what would have been right

    Raises
    ------
    OutputError : they cannot be written
    """
    with whole_folder(folder) as draft:
        for record in records:
            name, answer_key = names.name_of(record["student"]), answer_keys.get(record["student"])
            place = folders.get(record["student"])
            photographs = photo_pictures(place, right=right) if place is not None else []
            shown = {**record, "student": name}
            text = student_page(exercise, shown, answer_key, right=right, photographs=photographs)
            (draft / f"{folder_name(name)}.html").write_text(text, encoding="utf-8", newline="\n")


def wide_table(records: Sequence[dict[str, Any]], called: Mapping[str, str]) -> str:
    """One row a student: total, marks of every answer, diagnosis, advice, level, remarks, name.

    called : the students' own names by id
    """
    names = list(dict.fromkeys(answer["name"] for record in records for answer in record["answers"]))
    head = ["student", "exercise", "total", "of", *names, "diagnosis", "too_exact", "level", "notes", "name"]
    return table(head, ([*_wide_row(record, names), called.get(record["student"], "")] for record in records))


def copies_table(pairs: Iterable[AlikePair]) -> str:
    """One row a pair whose numbers agree beyond chance: who, in what, and how probable it is in an honest course."""
    head = ["student", "other", "agrees_in", "count", "answers", "probability"]
    rows = (
        [each.student, each.other, each.kind, len(each.answers), " ".join(each.answers), each.probability]
        for each in pairs
    )
    return table(head, rows)


def _wide_row(record: dict[str, Any], names: list[str]) -> list[Any]:
    given = is_handed_in(record)
    marks = {answer["name"]: answer["marks"] for answer in record["answers"] if given}
    diagnosis = record["diagnosis"]
    found = " or ".join([diagnosis["misconception"], *diagnosis["alike"]]) if diagnosis else ""
    about = [record["student"], record["exercise"], record["total"] if given else None, record["of"]]
    return [*about, *map(marks.get, names), found, record["too_exact"], record["level"], "; ".join(record["notes"])]


def _long_row(record: dict[str, Any], answer: dict[str, Any]) -> list[Any]:
    station = None if answer["station"] is None else answer["station"] + 1
    marked = [answer[name] for name in ("name", "outcome", "marks", "of")]
    off = [answer["deviation"], station, answer["off_paper"]]
    # Of points and curves only how many there are.
    given = f"{len(answer['given'])} points" if isinstance(answer["given"], list) else answer["given"]
    return [record["student"], record["exercise"], *marked, given, *off]

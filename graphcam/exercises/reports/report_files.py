"""All files of a graded course, written together; the grades are CSV that is safe to open in a spreadsheet."""

import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from graphcam.exercises.course.hand_ins import Refused
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.course.spreadsheet import table
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.copies import AlikePair, alike_pairs
from graphcam.exercises.reports.group_page import group_page
from graphcam.exercises.reports.learning_platforms import canvas_grades, moodle_grades
from graphcam.exercises.reports.student_page import student_page
from graphcam.files import whole_folder

LONG = (
    *("student", "exercise", "answer", "outcome", "marks", "of"),
    *("given", "pencil_units", "worst_station", "off_paper_mm"),
)
BY_HAND = ("student", "answer", "found", "marks", "comment")


def write_reports(
    out: Path,
    exercise: Exercise,
    records: Sequence[dict[str, Any]],
    answer_keys: Mapping[str, AnswerKey],
    refused: Sequence[Refused] = (),
) -> list[str]:
    """The grades, wide into ``out``; beside it long, for grade books, who agrees, the records, the group's report.

    Their names are given back.

    refused : what is not graded, which has a table of its own where there is any

    Raises
    ------
    OutputError : they cannot be written
    """
    pairs = alike_pairs(exercise, records, answer_keys)
    texts = {
        out.name: wide_table(records),
        **_by_hand(out, records),
        # One row an answer, for statistics.
        f"{out.stem}-long.csv": table(
            LONG, (_long(record, answer) for record in records for answer in record["answers"])
        ),
        f"{out.stem}-copies.csv": copies_table(pairs),
        # For grade books.
        f"{out.stem}-moodle.csv": moodle_grades(exercise, records),
        f"{out.stem}-canvas.csv": canvas_grades(exercise, records),
        # A line a record.
        f"{out.stem}.json": "[" + ",\n ".join(json.dumps(record, allow_nan=False) for record in records) + "]\n",
        f"{out.stem}.html": group_page(exercise, records, answer_keys, pairs, refused),
    }
    not_graded = f"{out.stem}-not-graded.csv"
    # The table of a former run would go on telling what is mended.
    if refused or (out.parent / not_graded).exists():
        texts[not_graded] = table(("folder", "why"), ([one.place, one.why] for one in refused))
    with whole_folder(out.parent) as draft:
        for name, text in texts.items():
            (draft / name).write_text(text, encoding="utf-8", newline="")
    return list(texts)


def write_feedback(
    folder: Path, exercise: Exercise, records: Sequence[dict[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> None:
    """A page for every student, under the student's name as a file's name.

    Raises
    ------
    OutputError : they cannot be written
    """
    with whole_folder(folder) as draft:
        for record in records:
            text = student_page(exercise, record, answer_keys.get(record["student"]))
            (draft / f"{folder_name(record['student'])}.html").write_text(text, encoding="utf-8")


def _by_hand(out: Path, records: Sequence[dict[str, Any]]) -> dict[str, str]:
    """The table of marks given by hand, where there are any, or were when it was written before."""
    name = f"{out.stem}-by-hand.csv"
    rows = [
        [record["student"], *(one[column] for column in BY_HAND[1:])]
        for record in records
        for one in record.get("overrides", [])
    ]
    return {name: table(BY_HAND, rows)} if rows or (out.parent / name).exists() else {}


def wide_table(records: Sequence[dict[str, Any]]) -> str:
    """One row a student: total, marks of every answer, diagnosis, advice, level, remarks."""
    names = list(dict.fromkeys(answer["name"] for record in records for answer in record["answers"]))
    head = ["student", "exercise", "total", "of", *names, "diagnosis", "too_exact", "level", "notes"]
    return table(head, (_wide(record, names) for record in records))


def copies_table(pairs: Iterable[AlikePair]) -> str:
    """One row a pair whose numbers agree beyond chance: who, in what, and how probable it is in an honest course."""
    head = ["student", "other", "agrees_in", "count", "answers", "probability"]
    rows = (
        [each.student, each.other, each.kind, len(each.answers), " ".join(each.answers), each.probability]
        for each in pairs
    )
    return table(head, rows)


def _wide(record: dict[str, Any], names: list[str]) -> list[Any]:
    marks = {answer["name"]: answer["marks"] for answer in record["answers"]}
    diagnosis = record["diagnosis"]
    found = " or ".join([diagnosis["misconception"], *diagnosis["alike"]]) if diagnosis else ""
    about = [record[name] for name in ("student", "exercise", "total", "of")]
    return [*about, *map(marks.get, names), found, record["too_exact"], record["level"], " ".join(record["notes"])]


def _long(record: dict[str, Any], answer: dict[str, Any]) -> list[Any]:
    station = None if answer["station"] is None else answer["station"] + 1
    marked = [answer[name] for name in ("name", "outcome", "marks", "of")]
    off = [answer["deviation"], station, answer["off_paper"]]
    return [record["student"], record["exercise"], *marked, _number(answer["given"]), *off]


def _number(given: Any) -> Any:
    """A number; of points and curves only how many there are."""
    return f"{len(given)} points" if isinstance(given, list) else given

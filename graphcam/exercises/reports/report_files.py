"""All files of a graded course, written together; the grades are CSV that is safe to open in a spreadsheet."""

import csv
import io
import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.course.spreadsheet import cell
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.group_page import group_page
from graphcam.exercises.reports.student_page import student_page
from graphcam.files import whole_folder

LONG = (
    *("student", "exercise", "answer", "outcome", "marks", "of"),
    *("given", "pencil_units", "worst_station", "off_paper_mm"),
)


def write_reports(
    out: Path, exercise: Exercise, records: Sequence[dict[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> list[str]:
    """The grades, wide into ``out`` and long beside it, the records and the report on the group; their names.

    Raises
    ------
    OutputError : they cannot be written
    """
    texts = {
        out.name: wide_table(records),
        # One row an answer, for statistics.
        f"{out.stem}-long.csv": _csv(
            LONG, (_long(record, answer) for record in records for answer in record["answers"])
        ),
        # A line a record.
        f"{out.stem}.json": "[" + ",\n ".join(json.dumps(record, allow_nan=False) for record in records) + "]\n",
        f"{out.stem}.html": group_page(exercise, records, answer_keys),
    }
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


def wide_table(records: Sequence[dict[str, Any]]) -> str:
    """One row a student: total, marks of every answer, diagnosis, advice, level, remarks."""
    names = list(dict.fromkeys(answer["name"] for record in records for answer in record["answers"]))
    head = ["student", "exercise", "total", "of", *names, "diagnosis", "too_exact", "level", "notes"]
    return _csv(head, (_wide(record, names) for record in records))


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


def _csv(head: Sequence[str], rows: Iterable[list[Any]]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n", quoting=csv.QUOTE_ALL)
    writer.writerow([cell(name) for name in head])
    writer.writerows([cell(value) for value in row] for row in rows)
    return text.getvalue()

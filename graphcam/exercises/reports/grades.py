"""Grades as CSV, one row a student or one row an answer, safe to open in a spreadsheet."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from typing import Any

from graphcam.exercises.course.spreadsheet import cell

LONG = (
    *("student", "exercise", "answer", "outcome", "marks", "of"),
    *("given", "pencil_units", "worst_station", "off_paper_mm"),
)


def wide_table(records: Sequence[dict[str, Any]]) -> str:
    """One row a student: total, marks of every answer, diagnosis, advice, level, remarks."""
    names = list(dict.fromkeys(answer["name"] for record in records for answer in record["answers"]))
    head = ["student", "exercise", "total", "of", *names, "diagnosis", "too_exact", "level", "notes"]
    return _csv(head, (_wide(record, names) for record in records))


def long_table(records: Iterable[dict[str, Any]]) -> str:
    """One row an answer, for statistics."""
    return _csv(LONG, (_long(record, answer) for record in records for answer in record["answers"]))


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

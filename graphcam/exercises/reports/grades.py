"""Grades as CSV, one row a student or one row an answer, safe to open in a spreadsheet."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence
from typing import Any

FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠")
"""What makes a spreadsheet calculate a text instead of showing it; the wide forms count as the plain ones do."""
_AFTER_SEPARATOR = re.compile(r"([;\t][\s\"']*)(?=[=+\-@＝＋－＠])")
"""A formula behind what separates the cells where the comma is decimal: there the same file opens with other cells."""
LONG = (
    "student",
    "exercise",
    "answer",
    "outcome",
    "marks",
    "of",
    "given",
    "pencil_units",
    "worst_station",
    "off_paper_mm",
)


def wide_table(records: Sequence[dict[str, Any]]) -> str:
    """One row a student: total, marks of every answer, diagnosis, advice, level, remarks."""
    names = list(dict.fromkeys(answer["name"] for record in records for answer in record["answers"]))
    head = ["student", "exercise", "total", "of", *names, "diagnosis", "too_exact", "level", "notes"]
    return _csv(head, (_wide(record, names) for record in records))


def long_table(records: Iterable[dict[str, Any]]) -> str:
    """One row an answer, for statistics."""
    return _csv(
        LONG,
        (
            [
                record["student"], record["exercise"], answer["name"], answer["outcome"], answer["marks"], answer["of"],
                _number(answer["given"]), answer["deviation"],
                None if answer["station"] is None else answer["station"] + 1, answer["off_paper"],
            ]
            for record in records for answer in record["answers"]
        ),
    )  # fmt: skip


def cell(value: object) -> str:
    """A cell: numbers as they are, text such that no spreadsheet takes it for a formula.

    >>> cell(2.5), cell(-1.0), cell("-1"), cell(" =1+1"), cell(None), cell(True)
    ('2.5', '-1', "'-1", "' =1+1", '', 'yes')
    >>> cell("\\u200b\\xa0=1")[0], cell("\\u202bAnna")[0] == "'"
    ("'", False)
    >>> cell("a;=1+1"), cell("Anna; Ben")
    ("a;'=1+1", 'Anna; Ben')
    """
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int | float):
        return f"{value:.10g}"
    # Surrogates that a folder's name may hold cannot be written.
    text = str(value).encode("utf-8", "backslashreplace").decode()
    text = _AFTER_SEPARATOR.sub(r"\1'", text)
    # What is not seen may stand before it: spaces of all kinds, marks of the direction of writing.
    seen = next((letter for letter in text if letter.isprintable() and not letter.isspace()), "")
    return f"'{text}" if seen in FORMULA or text.startswith(FORMULA) else text


def _wide(record: dict[str, Any], names: list[str]) -> list[Any]:
    marks = {answer["name"]: answer["marks"] for answer in record["answers"]}
    diagnosis = record["diagnosis"]
    found = " or ".join([diagnosis["misconception"], *diagnosis["alike"]]) if diagnosis else ""
    return [record["student"], record["exercise"], record["total"], record["of"], *(marks.get(name) for name in names),
            found, record["too_exact"], record["level"], " ".join(record["notes"])]  # fmt: skip


def _number(given: Any) -> Any:
    """A number; of points and curves only how many there are."""
    return f"{len(given)} points" if isinstance(given, list) else given


def _csv(head: Sequence[str], rows: Iterable[list[Any]]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n", quoting=csv.QUOTE_ALL)
    writer.writerow([cell(name) for name in head])
    writer.writerows([cell(value) for value in row] for row in rows)
    return text.getvalue()

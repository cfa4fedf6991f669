"""Answers in a text table: ``answers.toml`` and ``answers.csv``."""

import csv
import io
import json
import re
from typing import Any

from graphcam.exercises.reading.regular_file import UnreadableError
from graphcam.exercises.reading.toml_statements import toml_statements
from graphcam.exercises.reading.typed import mended
from graphcam.exercises.reading.values import Points, decimal, shown
from graphcam.words import say

MOST_ROWS = 20_000
HEADINGS = (["answer", "value"], ["answer", "x", "y"], ["answer", "value", "y"])
DECIMAL_COMMA = re.compile(r"^([ \t]*[\w-]+[ \t]*=[ \t]*[+-]?\d+),(\d+[ \t]*(?:#.*)?\r?)$", re.ASCII | re.MULTILINE)
"""A number with a comma, as many countries write it: no line of TOML has this form, and one spoils the whole file."""


def toml_values(name: str, data: bytes) -> dict[str, Any]:
    """The values of a TOML file: those of its table ``[answers]``, or all where it has none.

    A number that stands alone in its line may have a decimal comma.  Where a line is bad, its answer alone is lost.

    >>> toml_values("answers.toml", b"[answers]\\nv_max = 12.5\\ntouch = [1, 2]")
    {'v_max': 12.5, 'touch': [1, 2]}
    >>> toml_values("answers.toml", "v_max = 12,5  # мм/рад".encode())
    {'v_max': 12.5}
    """
    text = DECIMAL_COMMA.sub(r"\1.\2", text_of(name, data))
    whole = _of_numbers(text)
    whole = toml_statements(name, text) if whole is None else whole
    answers = whole.get("answers", whole)
    if not isinstance(answers, dict):
        raise UnreadableError(say("{name}: answers must be a table", name=name))
    return answers


def csv_values(name: str, data: bytes) -> dict[str, float | str | Points | UnreadableError]:
    """The values of rows ``name,value`` and ``name,x,y``; rows of one name are the points of a curve.

    Semicolons may separate, as spreadsheets write them where the comma is decimal.  A row that cannot be read spoils
    its own answer only.

    >>> csv_values("answers.csv", b"answer;value\\nv_max;12,5\\ntouch;1;2\\ntouch;3;4")
    {'v_max': 12.5, 'touch': array([1.+2.j, 3.+4.j])}
    """
    text = text_of(name, data)
    first = text.lstrip().split("\n", 1)[0]
    rows: dict[str, list[list[str]]] = {}
    try:
        for count, row in enumerate(csv.reader(io.StringIO(text), delimiter=";" if ";" in first else ",")):
            if count > MOST_ROWS:
                raise UnreadableError(say("{name} has more than {most} rows", name=name, most=MOST_ROWS))
            cells = [cell.strip() for cell in row]
            while cells and not cells[-1]:
                cells.pop()
            if cells and not (count == 0 and [cell.lower() for cell in cells] in HEADINGS):
                rows.setdefault(cells[0], []).append(cells[1:])
    except csv.Error:
        raise UnreadableError(say("{name} is not valid CSV", name=name)) from None
    # A row without a value is an answer that is still open.
    return {answer: _value(answer, listed) for answer, listed in rows.items() if listed != [[]]}


_NUMBERS = re.compile(r"[ \t]*(?:([A-Za-z0-9_-]+)[ \t]*=([-+0-9.eE, \t\[\]]+)|#[^\x00-\x08\x0a-\x1f\x7f]*|)")
"""A line of TOML with a name and what JSON would read as well, numbers in lists or alone; or a comment, or nothing."""


def _of_numbers(text: str) -> dict[str, Any] | None:
    """The values of a TOML file that holds numbers and lists of them, a line each; None of any other.

    Such a line means the same in JSON, which is read in a tenth of the time.

    >>> _of_numbers("a = 1.5\\nb = [[1, 2], [3, 4e0]]  "), _of_numbers("a = 1_000")
    ({'a': 1.5, 'b': [[1, 2], [3, 4.0]]}, None)
    """
    found: dict[str, Any] = {}
    for line in text.replace("\r\n", "\n").split("\n"):
        said = _NUMBERS.fullmatch(line)
        if said is None or said[1] in found:
            return None
        if said[1] is not None:
            try:
                found[said[1]] = json.loads(said[2])
            except (ValueError, RecursionError):
                return None
    return found


def _value(answer: str, rows: list[list[str]]) -> float | str | Points | UnreadableError:
    import numpy as np

    try:
        if all(len(row) == 2 for row in rows):
            return np.array([complex(decimal(answer, x), decimal(answer, y)) for x, y in rows])
        if len(rows) > 1:
            raise UnreadableError(say("{answer} has {count} answers", answer=shown(answer), count=len(rows)))
        if len(rows[0]) != 1:
            raise UnreadableError(say("{answer} must have one value, or x and y", answer=shown(answer)))
        text = rows[0][0]
        # What has a unit is read where it is known which is asked for.
        return text if not text[-1:].isdigit() and mended(f"a = {text}") != f"a = {text}" else decimal(answer, text)
    except UnreadableError as error:
        return error


def text_of(name: str, data: bytes) -> str:
    """UTF-8 text, with or without a byte order mark."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise UnreadableError(say("{name} is not UTF-8 text", name=name)) from None

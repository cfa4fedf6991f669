"""Answers in a text table: ``answers.toml`` and ``answers.csv``."""

import csv
import io
import json
import re
import tomllib
from typing import Any

from graphcam.errors import UnreadableError
from graphcam.exercises.reading.answer_values import Points, decimal, plain_signs, short_text
from graphcam.exercises.reading.typed_answers import QUANTITY_PATTERN, mended
from graphcam.words import say

MOST_PARTS = 16
"""Parts of a dotted key: tomllib takes minutes for thousands."""
QUOTED_PATTERN = re.compile(
    r"""\"{3}(?:\\.|[^\\])*?"{3}|'{3}.*?'{3}|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|#[^\n]*""", re.DOTALL
)
"""A text or a comment in TOML: what stands in it ends no key."""
STATEMENT_PATTERN = re.compile(r"[ \t]*([^=\[\]{}#,\"']*?)[ \t]*=")
"""The beginning of a line that gives something a value, be it written well or not."""
_POWER_OF_TEN_PATTERN = re.compile(r"\d[eE][-+]?\d+\s*$")
"""The end of a number such as 3.7e1, whose letter is no unit."""
HEADER_PATTERN = re.compile(r"[ \t]*\[[ \t]*([A-Za-z_][\w-]*)[ \t]*\][ \t]*(?:#.*)?", re.ASCII)
"""A line that begins a table."""


def toml_statements(name: str, text: str) -> dict[str, Any]:
    """What a TOML file says; where a line is bad, the others count and its own answer is an UnreadableError.

    A number with a unit behind it is a text; see :mod:`graphcam.exercises.reading.typed_answers`.

    Raises
    ------
    UnreadableError : nothing in it can be told apart

    >>> found = toml_statements("answers.toml", "a = 1\\nb = 2 4\\n# by hand\\nc = [1,\\n2]")
    >>> found["a"], found["c"], print(found["b"])
    answers.toml: line 2 is not valid TOML; a line such as v_max = 12.5 is, with a decimal point
    (1, [1, 2], None)
    """
    try:
        return _loaded(name, text)
    # tomllib passes on what int() and datetime say; deep nesting ends in a RecursionError.
    except (ValueError, RecursionError) as error:
        # The library's own words are English, so only the line is taken from them.
        line = re.search(r"at line (\d+)", str(error))
    values, errors, is_mended = _readable_values(name, text)
    if not values or not (errors or is_mended):
        raise _bad_line(name, line[1]) if line else UnreadableError(say("{name} is not valid TOML", name=name))
    answers = values.get("answers", values)
    # In a table of answers only its own lines count, and that a line is bad is told wherever it stands.
    return {**answers, **errors} if isinstance(answers, dict) else {**values, **errors}


def _loaded(name: str, text: str) -> dict[str, Any]:
    if _longest_key(text) > MOST_PARTS:
        raise UnreadableError(say("{name} has a key of more than {most} parts", name=name, most=MOST_PARTS))
    return tomllib.loads(text)


def _bad_line(name: str, line: object) -> UnreadableError:
    return UnreadableError(
        say(
            "{name}: line {line} is not valid TOML; a line such as v_max = 12.5 is, with a decimal point",
            name=name,
            line=line,
        )
    )


def _readable_values(name: str, text: str) -> tuple[dict[str, Any], dict[str, UnreadableError], bool]:
    """The values of the statements that can be read, those of tables in a table; and by name what cannot.

    Last, whether one of them was mended.
    """
    is_mended = False
    values: dict[str, Any] = {}
    errors: dict[str, UnreadableError] = {}
    table, counts = values, dict[tuple[int, str], int]()
    for number, said, lines in _pieces(text):
        if header := HEADER_PATTERN.fullmatch(lines[0]):
            table = values.setdefault(header[1], {})
            if not isinstance(table, dict) or len(lines) > 1:
                table = {}
                errors[lines[0].strip()] = _bad_line(name, number)
            continue
        found, rest = _statement(lines)
        if not found and (plain := mended(lines[0])) != lines[0]:
            is_mended = True
            found, rest = _statement([plain, *lines[1:]])
        for key, value in found.items():
            counts[id(table), key] = count = counts.get((id(table), key), 0) + 1
            table[key] = value
            if count > 1:
                why = say("{answer} has {count} answers", answer=short_text(key), count=count)
                errors[key] = UnreadableError(why)
        if not found:
            errors[said] = _bad_line(name, number)
        elif rest:
            errors[rest] = _bad_line(name, number + 1)
    return values, errors, is_mended


def _pieces(text: str) -> list[tuple[int, str, list[str]]]:
    """The lines from the beginning of a statement to that of the next: number, name, lines."""
    found: list[tuple[int, str, list[str]]] = []
    for number, line in enumerate(text.replace("\r\n", "\n").split("\n"), 1):
        begins = STATEMENT_PATTERN.match(line)
        if begins or HEADER_PATTERN.fullmatch(line):
            found.append((number, begins[1] if begins else "", [line]))
        elif line.strip() and not line.lstrip().startswith("#"):
            if found:
                found[-1][2].append(line)
            else:
                found.append((number, line.strip(), [line]))
    return found


def _statement(lines: list[str]) -> tuple[dict[str, Any], str]:
    """What a statement says, empty where it cannot be read; and the first line that does not belong to it."""
    for count in sorted({1, len(lines)}):
        try:
            found = _loaded("", "\n".join(lines[:count]))
        except (ValueError, RecursionError, UnreadableError):
            continue
        return found, lines[count].strip() if count < len(lines) else ""
    return {}, ""


def _longest_key(text: str) -> int:
    """The greatest number of parts that stand between points, with nothing between them that ends a key."""
    longest = parts = 0
    for piece in QUOTED_PATTERN.sub("q", text).split("."):
        if any(end in piece for end in ",=\n[]{}"):
            parts = 0
        elif piece.strip():
            parts += 1
            longest = max(longest, parts)
    return longest


MAX_ROWS = 20_000
TABLE_HEADINGS = (["answer", "value"], ["answer", "x", "y"], ["answer", "value", "y"])
COMMA_PATTERN = re.compile(r"^([ \t]*[\w-]+[ \t]*=[ \t]*[+-]?\d+),(\d+[ \t]*(?:#.*)?\r?)$", re.ASCII | re.MULTILINE)
"""A number with a comma, as many countries write it: no line of TOML has this form, and one spoils the whole file."""


def toml_values(name: str, data: bytes) -> dict[str, Any]:
    """The values of a TOML file: those of its table ``[answers]``, or all where it has none.

    A number that stands alone in its line may have a decimal comma.  Where a line is bad, its answer alone is lost.

    >>> toml_values("answers.toml", b"[answers]\\nv_max = 12.5\\ntouch = [1, 2]")
    {'v_max': 12.5, 'touch': [1, 2]}
    >>> toml_values("answers.toml", "v_max = 12,5  # мм/рад".encode())
    {'v_max': 12.5}
    """
    text = COMMA_PATTERN.sub(r"\1.\2", text_of(name, data))
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
            if count > MAX_ROWS:
                raise UnreadableError(say("{name} has more than {most} rows", name=name, most=MAX_ROWS))
            cells = [cell.strip() for cell in row]
            while cells and not cells[-1]:
                cells.pop()
            if cells and not (count == 0 and [cell.lower() for cell in cells] in TABLE_HEADINGS):
                rows.setdefault(cells[0], []).append(cells[1:])
    except csv.Error:
        raise UnreadableError(say("{name} is not valid CSV", name=name)) from None
    # A row without a value is an answer that is still open.
    return {answer: _value(answer, listed) for answer, listed in rows.items() if listed != [[]]}


_NUMBERS_PATTERN = re.compile(r"[ \t]*(?:([A-Za-z0-9_-]+)[ \t]*=([-+0-9.eE, \t\[\]]+)|#[^\x00-\x08\x0a-\x1f\x7f]*|)")
"""A line of TOML with a name and what JSON would read as well, numbers in lists or alone; or a comment, or nothing."""


def _of_numbers(text: str) -> dict[str, Any] | None:
    """The values of a TOML file that holds numbers and lists of them, a line each; None of any other.

    Such a line means the same in JSON, which is read in a tenth of the time.

    >>> _of_numbers("a = 1.5\\nb = [[1, 2], [3, 4e0]]  "), _of_numbers("a = 1_000")
    ({'a': 1.5, 'b': [[1, 2], [3, 4.0]]}, None)
    """
    found: dict[str, Any] = {}
    for line in text.replace("\r\n", "\n").split("\n"):
        said = _NUMBERS_PATTERN.fullmatch(line)
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
            raise UnreadableError(say("{answer} has {count} answers", answer=short_text(answer), count=len(rows)))
        if len(rows[0]) != 1:
            raise UnreadableError(say("{answer} must have one value, or x and y", answer=short_text(answer)))
        text = plain_signs(rows[0][0])
        # What has a unit is read where it is known which is asked for.
        has_unit = QUANTITY_PATTERN.fullmatch(text) and not _POWER_OF_TEN_PATTERN.search(text)
        return text if has_unit else decimal(answer, text)
    except UnreadableError as error:
        return error


def text_of(name: str, data: bytes) -> str:
    """UTF-8 text, with or without a byte order mark."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise UnreadableError(say("{name} is not UTF-8 text", name=name)) from None

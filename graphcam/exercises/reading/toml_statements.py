"""The statements of a TOML file that holds more than numbers; of one with a bad line, each by itself."""

import re
import tomllib
from typing import Any

from graphcam.exercises.reading.regular_file import UnreadableError
from graphcam.exercises.reading.typed import mended
from graphcam.exercises.reading.values import shown
from graphcam.words import say

MOST_PARTS = 16
"""Parts of a dotted key: tomllib takes minutes for thousands."""
QUOTED = re.compile(r"""\"{3}(?:\\.|[^\\])*?"{3}|'{3}.*?'{3}|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|#[^\n]*""", re.DOTALL)
"""A text or a comment in TOML: what stands in it ends no key."""
STATEMENT = re.compile(r"[ \t]*([^=\[\]{}#,\"']*?)[ \t]*=")
"""The beginning of a line that gives something a value, be it written well or not."""
HEADER = re.compile(r"[ \t]*\[[ \t]*([A-Za-z_][\w-]*)[ \t]*\][ \t]*(?:#.*)?", re.ASCII)
"""A line that begins a table."""


def toml_statements(name: str, text: str) -> dict[str, Any]:
    """What a TOML file says; where a line is bad, the others count and its own answer is an UnreadableError.

    A number with a unit behind it is a text; see :mod:`graphcam.exercises.reading.typed`.

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
    values, errors, is_mended = _each(name, text)
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


def _each(name: str, text: str) -> tuple[dict[str, Any], dict[str, UnreadableError], bool]:
    """The values of the statements that can be read, those of tables in a table; and by name what cannot.

    Last, whether one of them was mended.
    """
    is_mended = False
    values: dict[str, Any] = {}
    errors: dict[str, UnreadableError] = {}
    table, counts = values, dict[tuple[int, str], int]()
    for number, said, lines in _pieces(text):
        if header := HEADER.fullmatch(lines[0]):
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
                why = say("{answer} has {count} answers", answer=shown(key), count=count)
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
        begins = STATEMENT.match(line)
        if begins or HEADER.fullmatch(line):
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
    for piece in QUOTED.sub("q", text).split("."):
        if any(end in piece for end in ",=\n[]{}"):
            parts = 0
        elif piece.strip():
            parts += 1
            longest = max(longest, parts)
    return longest

"""The lines of a TOML file at which its keys and list entries stand, for messages about them."""

import re
from collections.abc import Iterator

Place = tuple[int | str, ...]
"""A place in a file: keys, and numbers of list entries."""
_TOKEN_PATTERN = re.compile(
    r"\"{3}(?:[^\\]|\\.)*?\"{3}|'{3}.*?'{3}|\"(?:[^\"\\\n]|\\.)*\"|'[^'\n]*'|#[^\n]*|\n|[\[\]{},=]|[^\s\[\]{},=#\"']+",
    re.DOTALL,
)


def lines_of(text: str) -> dict[Place, int]:
    """The line of every key and list entry of a text that is TOML, by its place.

    >>> found = lines_of('rotation = "cw"\\n[motion]\\nphases = [\\n  { kind = "rise" },\\n  { kind = "dwell" },\\n]')
    >>> found[("rotation",)], found[("motion",)], found[("motion", "phases", 1, "kind")]
    (1, 2, 5)
    """
    found: dict[Place, int] = {}
    table: Place = ()
    opened: list[tuple[str, Place, int]] = []
    key: list[str] = []
    value: Place | None = None
    tokens = _tokens(text)
    for token, line in tokens:
        listed = bool(opened) and opened[-1][0] == "["
        if token == "\n":
            if not opened:
                key, value = [], None
        elif token == "[" and not opened and value is None:
            table = _header(tokens, found)
            for k in range(1, len(table) + 1):
                found.setdefault(table[:k], line)
        elif token == "=":
            value = (*(opened[-1][1] if opened else table), *key)
            for k in range(1, len(value) + 1):
                found.setdefault(value[:k], line)
        elif token in ("[", "{"):
            place = (*opened[-1][1], opened[-1][2]) if listed else value or table
            found.setdefault(place, line)
            opened.append((token, place, 0))
            key, value = [], None
        elif token in ("]", "}"):
            if opened:
                opened.pop()
        elif token == ",":
            key, value = [], None
            if listed:
                opened[-1] = (*opened[-1][:2], opened[-1][2] + 1)
        elif listed:
            found.setdefault((*opened[-1][1], opened[-1][2]), line)
        elif value is None:
            key += _names(token)
    return found


def _tokens(text: str) -> Iterator[tuple[str, int]]:
    """The tokens of a text, without comments, each with its line."""
    line, last = 1, 0
    for token in _TOKEN_PATTERN.finditer(text):
        line, last = line + text.count("\n", last, token.start()), token.start()
        if not token[0].startswith("#"):
            yield token[0], line


def _header(tokens: Iterator[tuple[str, int]], found: dict[Place, int]) -> Place:
    """The place of the table whose header goes on with these tokens; one of a list is the next of it."""
    names: list[str] = []
    marks = 1
    for token, _ in tokens:
        if token == "\n":
            break
        if token == "[":
            marks += 1
        elif token != "]":
            names += _names(token)
    place = tuple(names)
    if marks == 1:
        return place
    return (*place, next(k for k in range(len(found) + 1) if (*place, k) not in found))


def _names(token: str) -> list[str]:
    """The keys of a token: one in quotes, or several with points between."""
    return [token[1:-1]] if token[0] in "\"'" else [name for name in token.split(".") if name]

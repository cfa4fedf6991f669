"""Answers as people type them: a unit behind the number, a name in capitals, the # of the form left in."""

import re
from collections.abc import Iterable, Mapping
from typing import Any

from graphcam.drafting.ink import Caption, say
from graphcam.drafting.scale import plain_unit
from graphcam.errors import UnreadableError
from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.exercises.reading.answer_values import DASHES, decimal, plain_signs, short_text

NUMBER = r"[-+]?(?:\d{1,15}|(?=[.,]\d))(?:[.,]\d{0,15})?"
UNIT = r"[^\W\d_][^#=\"'\[\]\\,;]{0,29}|[°(\[][^\s#=\"'\[\]\\,;]{0,19}\]?"
LINE_PATTERN = re.compile(
    rf"([ \t]*[A-Za-z][A-Za-z0-9_-]*[ \t]*=[ \t]*)({NUMBER}(?:[ \t]*(?:{UNIT}))?)[ \t]*[;,]?[ \t]*(?:#.*)?\r?"
)
"""A line that is no TOML and no Python, but says a number to a reader."""
QUANTITY_PATTERN = re.compile(rf"\s*({NUMBER})\s*({UNIT})\s*")
COMMENTED_PATTERN = re.compile(
    rf"[ \t]*#[ \t]*([A-Za-z][A-Za-z0-9_-]*)[ \t]*=[ \t]*({NUMBER}(?:[ \t]*(?:{UNIT}))?)[ \t]*\r?"
)


def mended(line: str) -> str:
    """A line with a unit, or with the minus of print, as one that TOML and Python read: the number as a text.

    >>> mended("s0 = 37,1 mm  # measured"), mended("v = \u221247.6"), mended("end = [\u22121, 2]")
    ('s0 = "37,1 mm"', 'v = "-47.6"', 'end = [-1, 2]')
    """
    before, equals, _ = line.partition("=")
    plain = f"{before}={plain_signs(line[len(before) + 1 :])}" if equals else plain_signs(line)
    said = LINE_PATTERN.fullmatch(plain)
    if said:
        return f'{said[1]}"{said[2].strip()}"'
    return line if '"' in line or "'" in line else line.translate(str.maketrans(DASHES))


def quantity(asked: AskedAnswer, text: str) -> float:
    """A number with or without the unit that is asked for.

    Raises
    ------
    UnreadableError : it is none, or has another unit
    """
    plain = plain_signs(text).strip()
    said = QUANTITY_PATTERN.fullmatch(plain)
    if said is None:
        return decimal(asked.name, plain)
    if plain_unit(said[2]) != plain_unit(asked.unit):
        values = {"answer": asked.name, "given": short_text(said[2]), "unit": asked.unit_caption or "1"}
        raise UnreadableError(say("{answer} has the unit {given}, but is asked in {unit}", **values))
    return decimal(asked.name, said[1])


def by_answer_names(
    asked: Iterable[AskedAnswer], given: Mapping[str, list[Any]]
) -> tuple[dict[str, list[Any]], list[Caption]]:
    """What is given by the names of the answers, where case or an underscore alone is otherwise; and sentences on it.

    A name that may mean two answers, or one that is also given by its own name, stays as it is.
    """
    names = [one.name for one in asked]
    close: dict[str, list[str]] = {}
    for name in [*names, *(name for name in given if name not in names)]:
        close.setdefault(name.replace("_", "").replace("-", "").casefold(), []).append(name)
    meant = {alike[1]: alike[0] for alike in close.values() if len(alike) == 2 and alike[1] not in names}
    meant = {other: name for other, name in meant.items() if name in names and name not in given}
    notes = [
        say("the name {other} is read as {name}", other=short_text(other), name=name) for other, name in meant.items()
    ]
    return {meant.get(name, name): values for name, values in given.items()}, notes


def left_commented(asked: Iterable[AskedAnswer], given: Mapping[str, list[Any]], text: str) -> dict[str, str]:
    """The numbers behind a # that was left in, of answers that are not given otherwise; none that is there twice."""
    found: dict[str, list[str]] = {}
    for line in text.split("\n") if "#" in text else []:
        if said := COMMENTED_PATTERN.fullmatch(line):
            found.setdefault(said[1], []).append(said[2])
    wanted = {one.name for one in asked if one.kind == "number"} - given.keys()
    return {name: values[0] for name, values in found.items() if name in wanted and len(values) == 1}

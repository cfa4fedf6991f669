"""Remedies for faults of a task file: for the terms of other programs and textbooks, and for what is not TOML.

Each remedy is empty where nothing better is known than the commented example.

Of what is not TOML a parser only says where it stopped.  Here the line is looked at again for what people really write:
a typographic minus or quotes, text without quotes, a number with a comma or a unit.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping
from typing import Any

from graphcam.errors import TaskError, nearest_word_remedy, suggestion
from graphcam.given.follower import SENSE_SYNONYMS
from graphcam.given.laws import LAW_SYNONYMS
from graphcam.tasks.task import table_of
from graphcam.tasks.units import UNITS
from graphcam.words import Words, bare_caption, say

OPTIONAL_KEYS = ("offset", "prime_radius", "roller_radius", "distance")
"""Keys that may be left out, because graphcam finds their values."""
BASE_RADIUS_SYNONYMS = ("base_radius", "base_circle_radius", "base_circle")
"""Names of the radius of the base circle, which is that of the working profile."""
SYNONYMS = {**SENSE_SYNONYMS, **LAW_SYNONYMS, "gost": ("ГОСТ",), "iso": ("ИСО",)}
"""Synonyms of the words of a task file."""


def key_remedy(key: str, value: Any, known: Iterable[str], data: Mapping[str, Any]) -> Words:
    """The remedy for a key that its table does not have.

    known : the keys that it has;  data : the whole file

    >>> follower = {"kind": "translating", "roller_radius": 15}
    >>> print(key_remedy("base_radius", 80, ["prime_radius"], {"follower": follower}))
    graphcam takes the prime radius, of the pitch curve: prime_radius = base_radius + roller_radius = 95
    """
    if key in BASE_RADIUS_SYNONYMS and "arcs" not in data:
        return _radius_remedy(key, value, data.get("follower"))
    if key == "closure":
        return say("leave out limits.pressure_angle_return for force closure, give it for form closure")
    return nearest_word_remedy(key, known, SYNONYMS)


def _radius_remedy(key: str, value: Any, follower: Any) -> Words:
    said: Mapping[str, Any] = follower if isinstance(follower, dict) else {}
    roller = said.get("roller_radius", getattr(table_of(said), "roller_radius", None))
    radius = say("graphcam takes the prime radius, of the pitch curve: prime_radius = {key}", key=key)
    if roller == 0:
        return radius
    if not isinstance(value, int | float) or not isinstance(roller, int | float):
        return say("{radius} + roller_radius", radius=radius)
    return say("{radius} + roller_radius = {value:g}", radius=radius, value=value + roller)


def value_remedy(key: str, value: Any, choices: Iterable[str]) -> Words:
    """The remedy for a value of another type than its key's.

    choices : the permitted words

    >>> print(value_remedy("format", "a3", ["A3", "A4"]), value_remedy("offset", "auto", ()), sep="\\n")
    did you mean 'A3'?
    or leave it out to let it be found
    """
    if not isinstance(value, str):
        return ""
    return say("or leave it out to let it be found") if key in OPTIONAL_KEYS else suggestion(value, choices, SYNONYMS)


def missing_remedy(key: str, data: Mapping[str, Any]) -> Words:
    """The remedy for a key of the file that must be there.

    >>> print(missing_remedy("rotation", {"follower": {"kind": "flat-faced"}}))
    write rotation = "cw" or "ccw", as the cam turns in your task
    """
    if key != "rotation":
        return ""
    remedy = say('write rotation = "cw" or "ccw", as the cam turns in your task')
    follower = data.get("follower")
    if not (isinstance(follower, dict) and "kind" in follower and "offset" in table_of(follower).sought):
        return remedy
    # The sign of the offset's term in the pressure angle: tan(alpha) = (v - sigma e)/(s0 + s).
    return say(
        '{remedy}: an offset greater than 0 lowers the pressure angle of the rise with "ccw", one below 0 with "cw"',
        remedy=remedy,
    )


_PLACE_PATTERN = re.compile(r" \(at (?:line (\d+), column \d+|end of document)\)$")
_STRING_OR_COMMENT_PATTERN = re.compile(r"\"(?:[^\"\\]|\\.)*\"|'[^']*'|#.*")
_VALUE_PATTERN = re.compile(r"=\s*([^=,\[\]{}\s](?:[^=,\[\]{}]*[^=,\[\]{}\s])?)")
"""A value: what stands between an equals sign and the next comma or bracket, without spaces around it."""
_DECIMAL_COMMA_PATTERN = re.compile(r"=\s*[-+]?(\d+),(\d+)")
_VALUE_WITH_UNIT_PATTERN = re.compile(r"([-+]?\d[\d_]*(?:\.\d+)?)\s*([^\W\d_]+(?:/[^\W\d_]+)?|°|%)")
_BOOLEAN_SPELLINGS = {"True": "true", "False": "false", "TRUE": "true", "FALSE": "false"}
_QUOTES = "“”„‟«»‹›″‘’‚‛′`´"
_DASHES = "−–—‐‑‒―"
_PLAIN_CHARACTERS = {**dict.fromkeys(_QUOTES, '"'), **dict.fromkeys(_DASHES, "-"), "、": ",", "。": "."}
"""Characters of the keyboard by those of typography; what Unicode normalises is not listed."""
_MAX_SHOWN_LENGTH = 60
"""The maximum number of characters of a line in a message."""


def toml_fault(path: str, text: str, error: Exception, example: Words) -> TaskError:
    """The error for a text that a parser refused.

    path : of the file, for the message
    error : of the parser, which names the line
    example : the remedy where nothing better is known

    >>> import tomllib
    >>> def fault(text: str) -> TaskError:
    ...     try:
    ...         tomllib.loads(text)
    ...     except tomllib.TOMLDecodeError as error:
    ...         return toml_fault("cam.toml", text, error, "see the example")
    >>> print(fault("offset = −10"))
    cam.toml: line 1, column 10: the character is '−' (minus sign), but must be a plain '-'; type it in a text editor
    >>> print(fault("law = cosine"))
    cam.toml: line 1: the text is cosine, but must be in quotes; write "cosine"
    """
    place = _PLACE_PATTERN.search(str(error))
    why = _PLACE_PATTERN.sub("", str(error))
    if place is None or (place[1] is None and not text.strip()):
        return TaskError(path, say("the text"), say("not TOML ({why})", why=why), say("a TOML file"), example)
    lines = text.splitlines() or [""]
    number = min(int(place[1]), len(lines)) if place[1] else len(lines)
    line = lines[number - 1]
    where = say("line {number}", number=number)
    told = _typography(line, where) or _comma(line, where) or _value(line, where)
    if told is not None:
        return TaskError(path, *told)
    shown = line.strip()
    shown = shown if len(shown) <= _MAX_SHOWN_LENGTH else shown[:_MAX_SHOWN_LENGTH] + "..."
    expected = say("TOML ({why})", why=f"{why[:1].lower()}{why[1:]}")
    return TaskError(path, where, shown, expected, example)


LineFault = tuple[Words, Words, Words, Words]
"""The fault of a line: quantity, value, what it must be, and the remedy."""


def _typography(line: str, place: Words) -> LineFault | None:
    """The fault of a typographic character outside of texts and comments."""
    outside = _STRING_OR_COMMENT_PATTERN.sub(lambda found: " " * len(found[0]), line)
    for column, letter in enumerate(outside, 1):
        plain = _plain_character(letter)
        if plain is None:
            continue
        name = unicodedata.name(letter, f"U+{ord(letter):04X}").lower()
        what = say("{place}, column {column}: the character", place=place, column=column)
        if plain.strip():
            found = bare_caption(f"'{letter}' ({name})")
            return what, found, say("a plain {plain!r}", plain=plain), say("type it in a text editor")
        found = say("invisible ({name})", name=name)
        if plain:
            return what, found, say("a plain space"), say("type it anew")
        return what, found, say("left out"), say("delete it")
    return None


def _plain_character(letter: str) -> str | None:
    """The plain character for one of typography; None for a plain one, and for letters."""
    if letter.isascii():
        return None
    if letter in _PLAIN_CHARACTERS:
        return _PLAIN_CHARACTERS[letter]
    if unicodedata.category(letter) in ("Cf", "Cc"):
        return ""
    same = unicodedata.normalize("NFKC", letter)
    if same.isspace() or letter.isspace():
        return " "
    return same if same.isascii() and len(same) == 1 else None


def _comma(line: str, place: Words) -> LineFault | None:
    """The fault of a number with a decimal comma."""
    if comma := _DECIMAL_COMMA_PATTERN.search(line):
        found, remedy = bare_caption(f"{comma[1]},{comma[2]}"), say("write {word}", word=f"{comma[1]}.{comma[2]}")
        return say("{place}: the number", place=place), found, say("written with a decimal point"), remedy
    return None


def _value(line: str, place: Words) -> LineFault | None:
    """The fault of a text without quotes, or of a number with its unit."""
    for found in _VALUE_PATTERN.finditer(_STRING_OR_COMMENT_PATTERN.sub("''", line)):
        word = found[1]
        if word.startswith("''") or _is_value(word):
            continue
        if word in _BOOLEAN_SPELLINGS:
            remedy = say("write {word}", word=_BOOLEAN_SPELLINGS[word])
            return say("{place}: the switch", place=place), bare_caption(word), say("true or false"), remedy
        number = _VALUE_WITH_UNIT_PATTERN.fullmatch(word)
        if number and (number[2] in UNITS or not any(number[2] in units for units in UNITS.values())):
            limit, remedy = say("written without its unit"), say("write {word}", word=number[1])
            return say("{place}: the number", place=place), bare_caption(word), limit, remedy
        if "'" not in word and '"' not in word:
            limit, remedy = say("in quotes"), say('write "{word}"', word=word)
            return say("{place}: the text", place=place), bare_caption(word), limit, remedy
    return None


def _is_value(word: str) -> bool:
    if word in ("true", "false") or re.fullmatch(r"\d{4}-\d\d-\d\d.*|\d\d:\d\d.*", word):
        return True
    try:
        float(word)
    except ValueError:
        return re.fullmatch(r"0[xob][0-9a-fA-F_]+", word) is not None
    return True

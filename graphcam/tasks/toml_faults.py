"""What is wrong with a text that is not TOML, told by its line: what word processors and other habits put in.

A parser only says where it stopped.  Here the line is looked at again for what people really write: a typographic
minus or quotes, text without quotes, a number with a comma or a unit.
"""

from __future__ import annotations

import re
import unicodedata

from graphcam.errors import TaskError
from graphcam.words import Words, bare, say

_PLACE = re.compile(r" \(at (?:line (\d+), column \d+|end of document)\)$")
_STRING_OR_COMMENT = re.compile(r"\"(?:[^\"\\]|\\.)*\"|'[^']*'|#.*")
_VALUE = re.compile(r"=\s*([^=,\[\]{}\s](?:[^=,\[\]{}]*[^=,\[\]{}\s])?)")
"""What stands behind an equals sign up to the next comma or bracket, without spaces around it."""
_COMMA = re.compile(r"=\s*[-+]?(\d+),(\d+)")
_WITH_UNIT = re.compile(r"([-+]?\d[\d_]*(?:\.\d+)?)\s*([^\W\d_]+(?:/[^\W\d_]+)?|°|%)")
_SWITCHES = {"True": "true", "False": "false", "TRUE": "true", "FALSE": "false"}
_QUOTES = "“”„‟«»‹›″‘’‚‛′`´"
_DASHES = "−–—‐‑‒―"
_PLAIN = {**dict.fromkeys(_QUOTES, '"'), **dict.fromkeys(_DASHES, "-"), "、": ",", "。": "."}
"""Characters of typography by those of the keyboard; what Unicode itself holds to be the same is not listed."""
_LONGEST = 60
"""Characters of a line that a message shows."""


def toml_fault(path: str, text: str, error: Exception, example: Words) -> TaskError:
    """What to say of a text that a parser refused.

    path : how the message calls the file
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
    place = _PLACE.search(str(error))
    why = _PLACE.sub("", str(error))
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
    shown = shown if len(shown) <= _LONGEST else shown[:_LONGEST] + "..."
    expected = say("TOML ({why})", why=f"{why[:1].lower()}{why[1:]}")
    return TaskError(path, where, shown, expected, example)


Told = tuple[Words, Words, Words, Words]
"""What in a line, its value, what it must be, and the remedy."""


def _typography(line: str, place: Words) -> Told | None:
    """A character outside of texts and comments that is not the one of the keyboard."""
    outside = _STRING_OR_COMMENT.sub(lambda found: " " * len(found[0]), line)
    for column, letter in enumerate(outside, 1):
        plain = _plain(letter)
        if plain is None:
            continue
        name = unicodedata.name(letter, f"U+{ord(letter):04X}").lower()
        what = say("{place}, column {column}: the character", place=place, column=column)
        if plain.strip():
            found = bare(f"'{letter}' ({name})")
            return what, found, say("a plain {plain!r}", plain=plain), say("type it in a text editor")
        found = say("invisible ({name})", name=name)
        if plain:
            return what, found, say("a plain space"), say("type it anew")
        return what, found, say("left out"), say("delete it")
    return None


def _plain(letter: str) -> str | None:
    """The plain character that is meant by one of typography; None for a plain one, and for letters."""
    if letter.isascii():
        return None
    if letter in _PLAIN:
        return _PLAIN[letter]
    if unicodedata.category(letter) in ("Cf", "Cc"):
        return ""
    same = unicodedata.normalize("NFKC", letter)
    if same.isspace() or letter.isspace():
        return " "
    return same if same.isascii() and len(same) == 1 else None


def _comma(line: str, place: Words) -> Told | None:
    """A number with a decimal comma."""
    if comma := _COMMA.search(line):
        found, remedy = bare(f"{comma[1]},{comma[2]}"), say("write {word}", word=f"{comma[1]}.{comma[2]}")
        return say("{place}: the number", place=place), found, say("written with a decimal point"), remedy
    return None


def _value(line: str, place: Words) -> Told | None:
    """A text without quotes, or a number with its unit."""
    for found in _VALUE.finditer(_STRING_OR_COMMENT.sub("''", line)):
        word = found[1]
        if word.startswith("''") or _is_value(word):
            continue
        if word in _SWITCHES:
            remedy = say("write {word}", word=_SWITCHES[word])
            return say("{place}: the switch", place=place), bare(word), say("true or false"), remedy
        if number := _WITH_UNIT.fullmatch(word):
            limit, remedy = say("written without its unit"), say("write {word}", word=number[1])
            return say("{place}: the number", place=place), bare(word), limit, remedy
        if "'" not in word and '"' not in word:
            limit, remedy = say("in quotes"), say('write "{word}"', word=word)
            return say("{place}: the text", place=place), bare(word), limit, remedy
    return None


def _is_value(word: str) -> bool:
    """Whether a word is a number, a date or a switch as TOML writes them."""
    if word in ("true", "false") or re.fullmatch(r"\d{4}-\d\d-\d\d.*|\d\d:\d\d.*", word):
        return True
    try:
        float(word)
    except ValueError:
        return re.fullmatch(r"0[xob][0-9a-fA-F_]+", word) is not None
    return True

"""Remedies for faults of a task file: for the terms of other programs and textbooks, and for what is not TOML.

Each remedy is empty where nothing better is known than the commented example.

Of what is not TOML a parser only says where it stopped.  Here the line is looked at again for what people really write:
a typographic minus or quotes, text without quotes, a number with a comma or a unit.
"""

import re
import unicodedata
from collections.abc import Iterable, Mapping
from typing import Any

from graphcam.errors import TaskError, nearest_word_remedy, suggestion
from graphcam.tasks.declared_numbers import Ruled, declared
from graphcam.tasks.task import Task, table_of
from graphcam.tasks.units import UNITS
from graphcam.typed_words import names_of, plain
from graphcam.words import Words, bare_caption, say

FOUND_KEYS = {
    path.rpartition(".")[2]
    for path, each in declared(Task).items()
    if each.name and each.is_open and isinstance(each.range, Ruled)
}
"""Keys that may be left out, because graphcam finds their values."""


def key_remedy(key: str, value: Any, known: Iterable[str], data: Mapping[str, Any]) -> Words:
    """The remedy for a key that its table does not have.

    known : the keys that it has;  data : the whole file

    >>> follower = {"kind": "translating", "roller_radius": 15}
    >>> print(key_remedy("base_radius", 80, ["prime_radius"], {"follower": follower}))
    graphcam takes the prime radius, of the pitch curve: prime_radius = base_radius + roller_radius = 95
    """
    if (plain(key) == "baseradius" or "base_radius" in names_of(key, "keys")) and "arcs" not in data:
        return _radius_remedy(key, value, data.get("follower"))
    if key == "closure":
        return say("leave out limits.pressure_angle_return for force closure, give it for form closure")
    return _converted_key(key, value, known) or nearest_word_remedy(key, known)


CONVERTED_KEYS = {"half": 0.5, "double": 2.0, "omega": 1.0}
"""By what a value is multiplied whose key is in such a section of the table of typed words."""


def _converted_key(key: str, value: Any, known: Iterable[str]) -> Words:
    """The remedy for a key that a known one replaces with another value: a radius for a diameter, rpm for rad/s."""
    for section, factor in CONVERTED_KEYS.items():
        for name in names_of(key, section):
            if name not in known:
                continue
            if isinstance(value, bool) or not isinstance(value, int | float):
                return say("did you mean '{close}'?", close=name)
            told = f'"{value:g} rad/s"' if section == "omega" else f"{value * factor:g}"
            return say("write {word}", word=f"{name} = {told}")
    return ""


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
    return say("or leave it out to let it be found") if key in FOUND_KEYS else suggestion(value, choices)


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


def toml_fault(path: str, text: str, error: Exception, example: Words) -> tuple[int, TaskError, str]:
    """The line and the error for a text that a parser refused, and the text with that mended; empty if it is not plain.

    path : of the file, for the message
    error : of the parser, which names the line
    example : the remedy where nothing better is known

    >>> import tomllib
    >>> def fault(text: str) -> TaskError:
    ...     try:
    ...         tomllib.loads(text)
    ...     except tomllib.TOMLDecodeError as error:
    ...         return toml_fault("cam.toml", text, error, "see the example")[1]
    >>> print(fault("offset = −10"))
    cam.toml: line 1, column 10: the character is '−' (minus sign), but must be a plain '-'; type it in a text editor
    >>> print(fault("law = cosine"))
    cam.toml: line 1: the text is cosine, but must be in quotes; write "cosine"
    """
    place = _PLACE_PATTERN.search(str(error))
    why = _PLACE_PATTERN.sub("", str(error))
    if place is None or (place[1] is None and not text.strip()):
        return 1, TaskError(path, say("the text"), say("not TOML ({why})", why=why), say("a TOML file"), example), ""
    lines = text.split("\n")
    if opened := _open_list(lines, int(place[1] or 0)):
        end, what = int(place[1]) - 1, say("line {number}: the list", number=opened)
        told = TaskError(path, what, say("open"), say("closed by ]"), say("write ] behind its end"))
        return opened, told, "\n".join([*lines[:end], "]", *lines[end:]])
    number = min(int(place[1]), len(lines)) if place[1] else len(lines)
    line = lines[number - 1]
    where = say("line {number}", number=number)
    told = next(filter(None, (find(line, where) for find in _LINE_FAULTS)), None)
    if told is not None:
        mended = "\n".join([*lines[: number - 1], told[1], *lines[number:]])
        return number, TaskError(path, *told[0]), mended
    if twice := _TWICE_PATTERN.match(why):
        what = say(
            "{place}: {key}",
            place=where,
            key=line.strip() if line.lstrip().startswith("[") else twice[1] or line.partition("=")[0].strip(),
        )
        return number, TaskError(path, what, say("given twice"), say("given once"), say("delete one of the two")), ""
    if line.lstrip().startswith("{") and lines[number - 2].rstrip().endswith("}"):
        entry, mended = say("line {number}: the entry", number=number - 1), [*lines]
        mended[number - 2] = f"{lines[number - 2].rstrip()},"
        limit, remedy = say("followed by a comma"), say("write a comma behind its }}")
        return number - 1, TaskError(path, entry, bare_caption("{ ... }"), limit, remedy), "\n".join(mended)
    shown = line.strip()
    shown = shown if len(shown) <= _MAX_SHOWN_LENGTH else shown[:_MAX_SHOWN_LENGTH] + "..."
    expected = say("TOML ({why})", why=f"{why[:1].lower()}{why[1:]}")
    return number, TaskError(path, where, shown, expected, example), ""


LineFault = tuple[tuple[Words, Words, Words, Words], str]
"""The fault of a line: quantity, value, what it must be, and the remedy; and the line with that mended."""
_TWICE_PATTERN = re.compile(r"Cannot declare \(.*\) twice|Cannot overwrite a value|Duplicate inline table key '(.+)'")
"""What the parser says of a key or a table that is there already."""


_TABLE_PATTERN = re.compile(r"\s*\[\[?[\w.]+\]\]?\s*")
_COMMENT_PATTERN = re.compile(r"(?:^|\s)(//|--|%)\s*(.*)$")
_KEY_PATTERN = re.compile(r"(?:^|[{,])\s*([^\W\d]\w*)\s*=|^\s*\[\[?\s*([^\W\d]\w*)\s*\]")
"""A key, or the name of a table."""
_PUNCTUATION = (
    (r"(?P<shown>\s*\[\s*[a-z_]+)", say("the table"), say("closed by ]"), say("write ] behind its end"), r"\g<shown>]"),
    (
        *(r"(\s*\w+\s*=\s*)(?P<shown>\"[^\"]*\"|[\w.+-]+)\s*,", say("the value")),
        *(say("without a comma"), say("delete the comma"), r"\1\g<shown>"),
    ),
    (
        *(r"(?P<shown>\s*\{[^{}#]*[^{}#,\s])\s*,?", say("the entry"), say("closed by }}")),
        *(say("write }} behind its end, on the same line"), r"\g<shown> },"),
    ),
)
"""Lines that lack a sign or have one too many: pattern, what it is, what it must be, remedy, and what is meant."""
_OPEN_TEXT_PATTERN = re.compile(r'"([^\s",}]+)(?=\s*[,}]|\s*$)')


def _open_list(lines: list[str], number: int) -> int:
    """The line of the list that is still open where a table begins; 0 if there is none."""
    if not 0 < number <= len(lines) or not _TABLE_PATTERN.fullmatch(lines[number - 1]):
        return 0
    open_lists = list[int]()
    for k, line in enumerate(lines[: number - 1], 1):
        for bracket in re.findall(r"[\[\]]", _STRING_OR_COMMENT_PATTERN.sub("", line)):
            open_lists = [*open_lists, k] if bracket == "[" else open_lists[:-1]
    return open_lists[-1] if open_lists else 0


def _comment(line: str, place: Words) -> LineFault | None:
    """The fault of a comment as other languages write it."""
    found = _COMMENT_PATTERN.search(_STRING_OR_COMMENT_PATTERN.sub(lambda text: "_" * len(text[0]), line))
    if not found:
        return None
    mended = f"{line[: found.start(1)]}# {found[2]}"
    told = say("{place}: the comment", place=place), bare_caption(line[found.start(1) :])
    return (*told, say("begun with #"), say("write {word}", word=f"# {found[2]}")), mended


def _key(line: str, place: Words) -> LineFault | None:
    """The fault of a key in letters that are not Latin."""
    for found in _KEY_PATTERN.finditer(_STRING_OR_COMMENT_PATTERN.sub(lambda text: "_" * len(text[0]), line)):
        key, (start, end) = found[1] or found[2], found.span(found.lastindex or 0)
        if not key.isascii():
            meant = (*names_of(key, "keys"), "")[0]
            told = say("{place}: the key", place=place), bare_caption(key), say("in Latin letters")
            remedy = (
                say("did you mean '{close}'?", close=meant) if meant else say("'graphcam init FILE' names the keys")
            )
            return (*told, remedy), line[:start] + (meant or f'"{key}"') + line[end:]
    return None


def _quotes(line: str, place: Words) -> LineFault | None:
    """The fault of a text that is not closed."""
    closed = _STRING_OR_COMMENT_PATTERN.sub("", line)
    if line.partition("#")[0].count('"') % 2 == 0 or not (found := _OPEN_TEXT_PATTERN.search(line)):
        return None
    if not closed or line.count('"""'):
        return None
    mended = f'{line[: found.end(1)]}"{line[found.end(1) :]}'
    told = say("{place}: the text", place=place), bare_caption(f'"{found[1]}'), say("closed by a quotation mark")
    return (*told, say("write {word}", word=f'"{found[1]}"')), mended


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
            return (what, found, say("a plain {plain!r}", plain=plain), say("type it in a text editor")), _plain(line)
        found = say("invisible ({name})", name=name)
        if plain:
            return (what, found, say("a plain space"), say("type it anew")), _plain(line)
        return (what, found, say("left out"), say("delete it")), _plain(line)
    return None


def _plain(line: str) -> str:
    """A line with the plain characters of the keyboard, texts in quotes and comments as they are."""
    kept_or_letter = rf"({_STRING_OR_COMMENT_PATTERN.pattern})|."

    def plain(found: re.Match[str]) -> str:
        meant = None if found[1] else _plain_character(found[0])
        return found[0] if meant is None else meant

    return re.sub(kept_or_letter, plain, line)


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
        mended = f"{line[: comma.start(1)]}{comma[1]}.{comma[2]}{line[comma.end() :]}"
        return (say("{place}: the number", place=place), found, say("written with a decimal point"), remedy), mended
    return None


_COLON_PATTERN = re.compile(r"^(\s*|.*[{,]\s*)[\"']?(\w+)[\"']?\s*:(?=\s)")


def _colon(line: str, place: Words) -> LineFault | None:
    """The fault of a colon in place of an equals sign, as in YAML, JSON and Python."""
    if colon := _COLON_PATTERN.match(_STRING_OR_COMMENT_PATTERN.sub(lambda text: text[0].replace(":", "_"), line)):
        found, remedy = bare_caption(f"{colon[2]}:"), say("write {word}", word=f"{colon[2]} =")
        mended = f"{colon[1]}{colon[2]} ={line[colon.end() :]}"
        return (say("{place}: the key", place=place), found, say("followed by an equals sign"), remedy), mended
    return None


def _punctuation(line: str, place: Words) -> LineFault | None:
    """The fault of a table's name or an entry of a list that is not closed, or of a comma behind a line."""
    for pattern, what, limit, remedy, mended in _PUNCTUATION:
        if found := re.fullmatch(rf"{pattern}\s*(?:#.*)?", line):
            told = say("{place}: {what}", place=place, what=what), bare_caption(found["shown"].strip())
            return (*told, limit, remedy), found.expand(mended)
    return None


def _value(line: str, place: Words) -> LineFault | None:
    """The fault of a text without quotes, of a number with its unit, or of a semicolon."""
    blank = _STRING_OR_COMMENT_PATTERN.sub(lambda text: "'" + "_" * (len(text[0]) - 2) + "'", line)
    for found in _VALUE_PATTERN.finditer(blank):
        word = line[found.start(1) : found.end(1)]

        def fault(
            what: Words, limit: Words, remedy: Words, written: str, word: str = word, start: int = found.start(1)
        ) -> LineFault:
            """The fault of the word, and the line with what is written in its place."""
            mended = line[:start] + written + line[start + len(word) :]
            return (say("{place}: {what}", place=place, what=what), bare_caption(word), limit, remedy), mended

        bare = word.rstrip(";, ")
        if word.endswith(";") and (_is_value(bare) or bare[:1] in ("'", '"')):
            return fault(say("the value"), say("without a semicolon"), say("delete the semicolon"), bare)
        if word[0] in "'\"" or _is_value(word):
            continue
        if word in _BOOLEAN_SPELLINGS:
            right = _BOOLEAN_SPELLINGS[word]
            return fault(say("the switch"), say("true or false"), say("write {word}", word=right), right)
        number = _VALUE_WITH_UNIT_PATTERN.fullmatch(word)
        if number and (number[2] in UNITS or not any(number[2] in units for units in UNITS.values())):
            written = say("write {word}", word=number[1])
            return fault(say("the number"), say("written without its unit"), written, number[1])
        if worked := _worked_out(word):
            return fault(say("the number"), say("worked out"), say("write {word}", word=worked), worked)
        if "'" not in word and '"' not in word:
            return fault(say("the text"), say("in quotes"), say('write "{word}"', word=word), f'"{word}"')
    return None


_LINE_FAULTS = _typography, _comment, _key, _quotes, _comma, _value, _colon, _punctuation
"""What finds the fault of a line, in this order."""


def _worked_out(word: str) -> str:
    """The value of two numbers with a sign between them; empty of anything else.

    >>> _worked_out("160/2"), _worked_out("25.4 * 2"), _worked_out("a3")
    ('80', '50.8', '')
    """
    found = re.fullmatch(r"(\d+\.?\d*)\s*([-+*/])\s*(\d+\.?\d*)", word)
    if not found or (found[2] == "/" and not float(found[3])):
        return ""
    one, two = float(found[1]), float(found[3])
    return f"{ {'+': one + two, '-': one - two, '*': one * two, '/': one / (two or 1)}[found[2]]:.12g}"


def _is_value(word: str) -> bool:
    if word in ("true", "false") or re.fullmatch(r"\d{4}-\d\d-\d\d.*|\d\d:\d\d.*", word):
        return True
    try:
        float(word)
    except ValueError:
        return re.fullmatch(r"0[xob][0-9a-fA-F_]+", word) is not None
    return True

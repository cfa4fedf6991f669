"""Messages of errors, and lines on what is being done, in another language than the English in which they are made.

Whoever raises an error knows no language: its text is put together there, in English.  A catalog has the texts of
messages as templates (:mod:`graphcam.message_texts` collects them); here a message is recognised by their literal
parts, and what stands in their places is told likewise.  A text that no template fits stays as it is.
"""

from __future__ import annotations

import re
import string
from dataclasses import dataclass
from functools import cache

from graphcam.language import ENGLISH, Language, language
from graphcam.message_texts import CONTEXT, is_text
from graphcam.words import say_in

DEEPEST = 6
"""Messages within messages."""
SUBJECT = "what"
"""The place in :mod:`graphcam.errors` of what is wrong."""
OPEN = {"allowed", "message", "sentence", "remedy", "why", "error", "shown"}
"""The places in which a message with its remedy, or a semicolon of somebody's own, may stand."""
REMEDY = "; "
"""What stands before a remedy."""
OR = say_in("message", "or")
"""What stands between two texts of which one is wanted."""
QUOTED = re.compile("'[^']*'(, '[^']*')*")
"""Words of a file."""
AMOUNT = re.compile(r"([-+.\de]+) (\S.*)")
"""A number and its unit."""
BETWEEN = (REMEDY, ": ")
"""What stands between what is wrong and what to do, and behind the place where it is."""


def told(message: object, spoken: Language) -> str:
    """A message in a language.

    message : an error, or a text that stands in the catalogs as one of a message

    >>> from graphcam.errors import DesignError
    >>> print(told(DesignError("prime radius", -3, "greater than 0 mm"), language("ru")))
    начальный радиус: -3, а должно быть: больше 0 мм
    """
    text = str(message)
    return text if spoken == ENGLISH else _told(text, _texts(spoken.name), DEEPEST)


@dataclass(frozen=True)
class _Template:
    """A template and what a language makes of it.

    parts : its literal parts, between which the places are
    names : of the places in their order
    """

    parts: tuple[str, ...]
    names: tuple[str, ...]
    translation: str

    def fit(self, text: str) -> dict[str, str] | None:
        """What stands in the places of a text; None where it is another one."""
        # Seldom one fits: so first by what is quickly seen.
        if not (text.startswith(self.parts[0]) and text.endswith(self.parts[-1])):
            return None
        if any(part not in text for part in self.parts):
            return None
        found = re.fullmatch("(.+?)".join(map(re.escape, self.parts)), text, re.DOTALL)
        values = dict(zip(self.names, found.groups(), strict=True)) if found else {}
        # A remedy is no part of what stands before it.
        told = [*self.parts, *(value for name, value in values.items() if name in OPEN)]
        return values if values and text.count(REMEDY) == sum(part.count(REMEDY) for part in told) else None


@dataclass(frozen=True)
class _Texts:
    """The texts of messages in a language: those without places, and the templates, those that say most first."""

    plain: dict[str, str]
    templates: list[_Template]

    def know(self, text: str) -> bool:
        """Whether a text is one of them as a whole."""
        return text in self.plain or any(template.fit(text) for template in self.templates)


@cache
def _texts(name: str) -> _Texts:
    plain: dict[str, str] = {}
    templates: list[_Template] = []
    for (context, text), (translation, *_) in language(name).catalog.told.items():
        if context not in (CONTEXT, ""):
            continue
        literals, names = _pieces(text)
        if not names:
            # What a message says in its own context counts before what a caption says; and a caption of one word may be
            # the name of a field as well.
            if context or (text not in plain and " " in text):
                plain[literals[0]] = translation.replace("{{", "{").replace("}}", "}")
            continue
        if is_text(text) and len({*names}) == len(names):
            templates.append(_Template(literals, names, translation))
    return _Texts(plain, sorted(templates, key=lambda one: -sum(map(len, one.parts))))


def _pieces(template: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The literal parts of a template, and the names of the places between them.

    >>> _pieces("add {{ angle = {off} }}, {or_less}")
    (('add { angle = ', ' }, ', ''), ('off', 'or_less'))
    """
    literals, names = [""], list[str]()
    for literal, place, *_ in string.Formatter().parse(template):
        literals[-1] += literal
        if place is not None:
            names.append(place)
            literals.append("")
    return tuple(literals), tuple(names)


def _told(text: str, texts: _Texts, deeper: int) -> str:
    if text in texts.plain:
        return texts.plain[text]
    if not deeper:
        return text
    for template in texts.templates:
        if (values := template.fit(text)) is not None:
            inner = {name: _inner(name, value, texts, deeper - 1) for name, value in values.items()}
            return _filled(template.translation, inner)
    for between in BETWEEN:
        if between in text:
            first, second = _parted(text, between, texts)
            return _told(first, texts, deeper) + between + _told(second, texts, deeper)
    if (amount := AMOUNT.fullmatch(text)) and amount[2] in texts.plain:
        return f"{amount[1]} {texts.plain[amount[2]]}"
    either = text.split(f" {OR} ")
    if either[1:] and all(texts.know(piece) or QUOTED.fullmatch(piece) for piece in either):
        return f" {texts.plain.get(str(OR), OR)} ".join(_told(piece, texts, deeper) for piece in either)
    return text


def _parted(text: str, between: str, texts: _Texts) -> tuple[str, str]:
    """A text parted where most of the two parts are known, of several such places in the first."""
    pieces = text.split(between)
    pairs = [(between.join(pieces[:k]), between.join(pieces[k:])) for k in range(1, len(pieces))]
    return max(pairs, key=lambda pair: sum(map(texts.know, pair))) if pairs[1:] else pairs[0]


def _inner(place: str, text: str, texts: _Texts, deeper: int) -> str:
    """What stands in a place of a message; one word for what is wrong is the name of a field, and stays."""
    path, between, what = text.rpartition(": ")
    if place == SUBJECT and " " not in what:
        return text
    if place == SUBJECT and between and what in texts.plain:
        return _told(path, texts, deeper) + between + texts.plain[what]
    return _told(text, texts, deeper)


def _filled(template: str, values: dict[str, str]) -> str:
    """A template with texts in its places, whatever formats these have."""
    pieces = string.Formatter().parse(template)
    return "".join(literal + (values[place] if place is not None else "") for literal, place, *_ in pieces)

"""What each language lacks of the texts of the code: ``python tests/translations.py`` prints it, text by text.

A text that a catalog lacks is told in English, and no test asks for more than 95 % of what the built-in tasks show.
Before a release ``python tests/translations.py --release`` ends with status 1 as long as the Russian has a gap.
"""

from __future__ import annotations

import re
import string
import sys
import tomllib
from functools import cache
from pathlib import Path

from babel.messages.catalog import Catalog, Message
from babel.messages.extract import extract_from_dir
from babel.messages.pofile import read_po

import graphcam as gc
from graphcam.exercises.definition.exercise_file import find_exercise, library
from graphcam.language import ENGLISH, languages

PACKAGE = Path(gc.__file__).parent
CATALOGS = [name for name in languages() if name != ENGLISH.name]
RELEASED = {"ru"}
"""Which languages are whole in a release."""
MOST_MISSING = 0.05
"""Of the texts that the built-in tasks show, and of those of the library of exercises."""
KEYWORDS = {"say": (1,), "say_in": ((1, "c"), 2), "say_many": (1, 2)}
"""What the functions of graphcam.words take, as ``pybabel extract`` wants to know it."""


def catalog(name: str) -> Catalog:
    """The catalog of a language, as Babel reads it."""
    with (PACKAGE / "data" / "languages" / f"{name}.po").open("rb") as file:
        return read_po(file, locale=name)


@cache
def texts_of_the_code() -> Catalog:
    """Every text that is told in the language of the user, and where it is written."""
    found = Catalog()
    settings = tomllib.loads((PACKAGE.parent / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["babel"]
    methods = [(mapping["pattern"], mapping["method"]) for mapping in settings["mappings"]]
    for file, line, message, _, context in extract_from_dir(PACKAGE, methods, keywords=KEYWORDS, comment_tags=()):
        found.add(message, context=context, locations=[(file, line)])
    return found


def singular(message: str | tuple[str, ...]) -> str:
    """A text, of one that depends on a count the form for one."""
    return message if isinstance(message, str) else message[0]


def has_words(template: str) -> bool:
    """Whether there is something to translate in a text."""
    bare = "".join(literal for literal, *_ in string.Formatter().parse(template))
    return re.search("[A-Za-z]", bare) is not None


@cache
def lacking(name: str) -> list[Message]:
    """The texts of the code that a language tells in English."""
    there = catalog(name)
    needed = (text for text in texts_of_the_code() if text.id and (text.context or has_words(singular(text.id))))
    return [text for text in needed if (old := there.get(text.id, text.context)) is None or not all_told(old)]


def all_told(message: Message) -> bool:
    """Whether a translation has all its forms."""
    return all([message.string] if isinstance(message.string, str) else message.string)


@cache
def words_lacking(name: str) -> frozenset[str]:
    """The English words of the texts that a language tells in English."""
    bare = (literal for text in lacking(name) for literal, *_ in string.Formatter().parse(singular(text.id)))
    return frozenset(word for literal in bare for word in re.findall("[A-Za-z]+", literal))


def texts_of(exercise: str, name: str) -> dict[str, str]:
    """The texts of an exercise of the library in a language, by what they are of; one that is lacking is English."""
    found = find_exercise(exercise, name)
    return {"title": found.title, "text": found.text} | {asked.name: asked.text for asked in found.answers}


def lacking_of_exercises(name: str) -> list[str]:
    """The texts of the library of exercises that a language tells in English."""
    both = ((each, texts_of(each, ENGLISH.name), texts_of(each, name)) for each in library())
    return [f"{each}, {key}" for each, english, told in both for key in told if told[key] == english[key]]


def left_over(name: str) -> list[Message]:
    """The translations of texts that the code has no more."""
    code = texts_of_the_code()
    return [text for text in catalog(name) if text.id and code.get(text.id, text.context) is None]


def main(asked: list[str]) -> int:
    """Print what is lacking and what is left over; the exit status is 1 where a release lacks something."""
    for name in CATALOGS:
        print(f"{name}: {len(lacking(name))} texts lacking, {len(left_over(name))} left over")
        for text in lacking(name):
            places = ", ".join(f"{file}:{line}" for file, line in text.locations)
            context = f" ({text.context})" if text.context else ""
            print(f"  lacking{context}: {singular(text.id)!r}, {places}")
        for text in left_over(name):
            print(f"  left over: {singular(text.id)!r}")
        for text in lacking_of_exercises(name):
            print(f"  lacking in exercises: {text}")
    return int("--release" in asked and any(lacking(name) or lacking_of_exercises(name) for name in RELEASED))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

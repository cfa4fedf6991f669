"""Mistakes by the names that exercises give them, an argument behind a colon: "wrong-law: cosine"."""

from __future__ import annotations

from dataclasses import dataclass, replace

from graphcam.constructions.law_names import LAW_TITLES
from graphcam.drafting.ink import Caption
from graphcam.errors import DesignError, nearest
from graphcam.exercises.definition.mistakes import CATALOGUE, Change


@dataclass(frozen=True)
class Misconception:
    """A mistake by its name in an exercise's file.

    said : to the student, what was probably done and what is right; it holds no number of the key
    change : from the right drawing to the one with the mistake
    """

    name: str
    said: Caption
    change: Change


def misconception(name: str) -> Misconception:
    """The misconception of that name.

    Raises
    ------
    DesignError : there is none, or its argument is missing or superfluous

    >>> misconception("offset-sign").name
    'offset-sign'
    """
    key, _, argument = (part.strip() for part in name.partition(":"))
    if key not in CATALOGUE:
        raise DesignError("misconception", key, "one of the catalogue", nearest(key, CATALOGUE))
    entry = CATALOGUE[key]
    if bool(argument) != bool(entry.takes):
        wanted = f"followed by a colon and {entry.takes}" if entry.takes else "without an argument"
        raise DesignError("misconception", name, wanted)
    said = replace(entry.said, values={"argument": LAW_TITLES.get(argument, argument)})
    return Misconception(name, said, entry.change(argument) if entry.takes else entry.change)

"""Units by the names that they have in readings and files, as a language writes them."""

from __future__ import annotations

from collections.abc import Mapping

from graphcam.words import Caption, say

UNITS: Mapping[str, Caption] = {
    "mm": say("mm"),
    "mm/rad": say("mm/rad"),
    "mm/rad²": say("mm/rad²"),
    "rad": say("rad"),
    "rad/rad": say("rad/rad"),
    "rad/rad²": say("rad/rad²"),
    "deg": say("deg"),
    "mm of paper": say("mm of paper"),
    "m": say("m"),
    "s": say("s"),
    "m/s": say("m/s"),
    "m/s²": say("m/s²"),
    "rad/s": say("rad/s"),
    "rad/s²": say("rad/s²"),
    "N": say("N"),
    "mm/mm": say("mm/mm"),
    "(mm/rad)/mm": say("(mm/rad)/mm"),
    "(mm/rad²)/mm": say("(mm/rad²)/mm"),
}


def unit(name: str) -> Caption:
    """The unit of that name.

    >>> str(unit("mm/rad"))
    'mm/rad'
    """
    return UNITS[name]

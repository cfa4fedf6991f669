"""The catalogue of mistakes: each is the drawing of a student who does everything right but for that one thing.

A mistake is a function from the right drawing to a wrong one, with what is said to who made it.  Most change what was
given to one construction and go on from there; some change how a length was read.
"""

from dataclasses import dataclass, replace

from graphcam.constructions.law_names import LAW_TITLES
from graphcam.drafting.ink import Caption
from graphcam.errors import DesignError, nearest_word_remedy

# Both enter their mistakes as they are imported.
from graphcam.exercises.definition import cam_mistakes as cam_mistakes, diagram_mistakes as diagram_mistakes
from graphcam.exercises.definition.catalogue import CATALOGUE as CATALOGUE, Change
from graphcam.words import say


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
        raise DesignError("misconception", key, say("one of the catalogue"), nearest_word_remedy(key, CATALOGUE))
    entry = CATALOGUE[key]
    if bool(argument) != bool(entry.takes):
        wanted = (
            say("followed by a colon and {takes}", takes=entry.takes) if entry.takes else say("without an argument")
        )
        raise DesignError("misconception", name, wanted)
    said = replace(entry.said, values={"argument": LAW_TITLES.get(argument, argument)})
    return Misconception(name, said, entry.change(argument) if entry.takes else entry.change)

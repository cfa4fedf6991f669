"""The catalogue of mistakes: how one is entered, and how it is found by its name."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Caption

LAW_ARGUMENT = "the name of a law"
DIAGRAM_ARGUMENT = "integration or differentiation"
READING_ARGUMENT = "a construction and its reading, such as integration.v"
"""What mistakes take, as a message says it."""
Change = Callable[[Chain], Chain]
M = TypeVar("M", bound=Callable[..., Any])


@dataclass(frozen=True)
class CatalogueEntry:
    """A mistake of the catalogue.

    said : to the student; ``{argument}`` stands for the argument
    change : the change itself, or of a mistake that takes an argument the function that makes it of that
    takes : what the argument is; empty where there is none
    """

    said: Caption
    change: Callable[..., Any]
    takes: str


CATALOGUE: dict[str, CatalogueEntry] = {}
"""Every misconception that an exercise may name, by that name: the function's, with hyphens."""


def catalogued(said: Caption, takes: str = "") -> Callable[[M], M]:
    """Enter a function into the catalogue."""

    def entered(mistake: M) -> M:
        """Enter the mistake under its own name, with hyphens."""
        CATALOGUE[mistake.__name__.replace("_", "-")] = CatalogueEntry(said, mistake, takes)
        return mistake

    return entered

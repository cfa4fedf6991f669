"""What may be foretold of a construction before it is drawn: where the guess moves, and how it is judged.

Places are those of the construction: complex, in mm of paper, y up.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Construction
from graphcam.drafting.marks import Points
from graphcam.plane_vectors import dot
from graphcam.studio.view_steps import named_steps
from graphcam.words import Caption

PENCIL_LINE = 0.5
"""A guess that lies no farther from the answer is right [mm of paper]: the width of a pencil line."""


@dataclass(frozen=True)
class JudgedGuess:
    """What is said of a guess.

    answer : where the construction comes to lie, as seen from the guess
    paper : from there to the guess [mm of paper]
    machine : of the guess less that of the answer, in ``unit``;  quantity : what is compared so
    said : the difference in a sentence;  why : the reason, in one sentence or two
    beside : where guess and answer lie in other views, by the views' names
    """

    answer: complex
    paper: float
    machine: float
    unit: str
    quantity: Caption
    said: Caption
    why: Caption
    beside: Mapping[str, tuple[complex, complex]] = field(default_factory=dict[str, tuple[complex, complex]])


@dataclass(frozen=True)
class ShownStep:
    """A step by its name, the view that it is drawn in, and its title."""

    view: str
    step: str
    title: Caption


@dataclass(frozen=True, eq=False)
class Prediction:
    """A question that the construction answers.

    question : what is to be foretold
    view : name of the view in which the guess is made;  given : the steps that are drawn there before
    construct : the steps that answer
    way : the line or curve on which the guess moves, as a polyline; where the guess is free two opposite corners
    free : whether it moves anywhere between those
    start : where the guess lies at first;  pole : from where a ray goes to the guess, if one does
    judge : of a place on the way
    """

    question: Caption
    view: str
    given: Sequence[str]
    construct: Sequence[ShownStep]
    way: Points
    start: complex
    judge: Callable[[complex], JudgedGuess]
    free: bool = False
    pole: complex | None = None

    def on_the_way(self, guess: complex) -> complex:
        """The permitted place nearest to a guess.

        >>> never = lambda place: None
        >>> line = Prediction(Caption("?"), "combined", (), (), np.array([0j, 10j]), 0j, never)
        >>> line.on_the_way(3 + 4j), line.on_the_way(1 + 20j)
        (4j, 10j)
        """
        if self.free:
            low, high = self.way
            return complex(np.clip(guess.real, low.real, high.real), np.clip(guess.imag, low.imag, high.imag))
        return nearest_on_polyline(self.way, guess)


def nearest_on_polyline(way: Points, place: complex) -> complex:
    """The place of a polyline (n,) that is nearest to another.

    >>> nearest_on_polyline(np.array([0j, 4 + 0j, 4 + 4j]), 5 + 1j)
    (4+1j)
    """
    along = np.diff(way)
    lengths = np.maximum(np.abs(along) ** 2, np.finfo(float).tiny)
    found = way[:-1] + along * np.clip(dot(along, place - way[:-1]) / lengths, 0.0, 1.0)
    return complex(found[np.argmin(np.abs(found - place))])


def steps_in(chain: Chain, construction: str, view: str) -> list[str]:
    """The names of a construction's steps in a view, in order."""
    return [shown.step for shown in shown_steps(chain, construction, view)]


def shown_steps(chain: Chain, construction: str, *views: str) -> list[ShownStep]:
    """A construction's steps with their views; only those in ``views``, if any are named."""
    drawn = chain[construction]
    steps = zip(step_ids(drawn), drawn.steps(), strict=True)
    return [ShownStep(step.view.name, name, step.title) for name, step in steps if not views or step.view.name in views]


def step_ids(construction: Construction) -> list[str]:
    """The names of a construction's steps, as the views have them."""
    steps = construction.steps()
    return [each.id for each in named_steps(tuple((k, construction.name, step) for k, step in enumerate(steps, 1)))]

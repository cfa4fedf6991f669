"""Whether the answers can tell every catalogued mistake from careful work and from every other mistake."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.chain import Chain
from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.key.expectation import Expected
from graphcam.exercises.key.scatter import Drawn, answers_of, bulges_of, distances, expected, lengths_of

HANDS = 200
"""Careful hands behind the scatter of a mistake's answers."""
APART = 3.5
"""Two mistakes are told apart where some answer differs by so many of both their scatters: one in 2000 is mistaken."""
BEYOND = 3.3
"""A mistake is noticed where some answer lies outside the tolerance by so many of its scatters."""
CAREFUL = "careful"
"""What work without a mistake is called among the mistakes."""


@dataclass(frozen=True, eq=False)
class PerfectHands:
    """What perfect hands draw of one variant, and answer: one without a mistake, and one with each of the exercise's.

    lengths : units of each answer in one mm of paper
    """

    right: Chain
    wrong: dict[str, Chain]
    answers: Drawn
    wrong_answers: dict[str, Drawn]
    lengths: list[float]


def perfect_hands(exercise: Exercise, right: Chain) -> PerfectHands:
    """The right drawing and the wrong ones by perfect hands; what is the same in several of them is drawn once.

    Raises
    ------
    DesignError : the drawing, or one with a mistake, comes to nothing
    """
    answers, lengths = answers_of(exercise, right), lengths_of(exercise, right)
    wrong = {name: misconception(name).change(right) for name in exercise.misconceptions}
    wrong_answers = {name: answers_of(exercise, chain) for name, chain in wrong.items()}
    return PerfectHands(right, wrong, answers, wrong_answers, lengths)


def hypotheses(exercise: Exercise, drawn: PerfectHands) -> dict[str, tuple[Expected, ...]]:
    """What a student with each of the exercise's mistakes answers, and how it scatters.

    Raises
    ------
    DesignError : the drawing with a mistake comes to nothing
    """
    careful = drawn.right.by(exercise.hand.pencil(HANDS))
    found: dict[str, tuple[Expected, ...]] = {}
    for name, answers in drawn.wrong_answers.items():
        off = distances(exercise, answers, answers_of(exercise, misconception(name).change(careful)))
        bent = bulges_of(exercise, drawn.wrong[name])
        found[name] = tuple(expected(exercise, answers, off, drawn.lengths, bent))
    return found


def alike(exercise: Exercise, wrong: Mapping[str, Sequence[Expected]]) -> tuple[tuple[str, str], ...]:
    """The pairs of mistakes that the answers do not tell apart."""
    return tuple((a, b) for a, b in combinations(wrong, 2) if not _told(exercise, wrong[a], wrong[b]))


def permitted(exercise: Exercise, pairs: Iterable[tuple[str, str]]) -> bool:
    """Whether the exercise lets all these pairs be alike."""
    return {frozenset(pair) for pair in pairs} <= {frozenset(pair) for pair in exercise.alike}


def passing(
    exercise: Exercise, keys: list[Expected], wrong: dict[str, tuple[Expected, ...]], bound: float
) -> list[tuple[str, str]]:
    """The mistakes that pass as careful work, or that no answer names, paired with that."""
    return [(name, CAREFUL) for name, values in wrong.items() if not _noticed(exercise, keys, values, bound)]


def _noticed(exercise: Exercise, keys: Sequence[Expected], wrong: Sequence[Expected], bound: float) -> bool:
    # What may be nought by its scatter names no mistake: whoever answers nought need not have made it.
    return any(
        bool(np.any(_gap(asked, key, value) > bound * key.scatter + BEYOND * value.scatter))
        and (asked.kind != "number" or abs(complex(value.value)) > (bound + BEYOND) * float(value.scatter))
        for asked, key, value in zip(exercise.answers, keys, wrong, strict=True)
    )


def _told(exercise: Exercise, a: Sequence[Expected], b: Sequence[Expected]) -> bool:
    return any(
        bool(np.any(_gap(asked, x, y) > APART * (x.scatter + y.scatter)))
        for asked, x, y in zip(exercise.answers, a, b, strict=True)
    )


def _gap(asked: Asked, a: Expected, b: Expected) -> NDArray[np.float64]:
    """How far two expected answers lie apart; of what is drawn the clear distance.

    A curve shows no shift along itself, and points do not show their numbers.
    """
    if asked.kind != "number":
        return a.distances(np.asarray(b.value), asked.kind)
    return np.abs(np.asarray(a.value) - np.asarray(b.value))


def promising(exercise: Exercise, drawn: PerfectHands) -> bool:
    """Whether no mistake answers plainly too near to the key or to one that it must be told from, by rounding alone.

    It takes no careful hands, so it costs little; nothing that could be told apart is turned away.
    """
    rows = {CAREFUL: drawn.answers, **drawn.wrong_answers}
    if not all(np.isfinite(value).all() for row in rows.values() for value in row):
        return False
    values = {
        name: expected(exercise, row, [np.zeros((1, *value.shape)) for value in row], drawn.lengths)
        for name, row in rows.items()
    }
    return permitted(exercise, alike(exercise, values))

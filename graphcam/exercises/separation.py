"""Whether the answers can tell every catalogued mistake from careful work and from every other mistake."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import GraphcamError
from graphcam.exercises.exercise import Asked, Exercise
from graphcam.exercises.expectation import Expected
from graphcam.exercises.misconceptions import misconception
from graphcam.exercises.scatter import answers_of, bulges_of, expected, lengths_of
from graphcam.exercises.variant import Variant

HANDS = 200
"""Careful hands behind the scatter of a mistake's answers."""
APART = 3.5
"""Two mistakes are told apart where some answer differs by so many of both their scatters: one in 2000 is mistaken."""
BEYOND = 3.3
"""A mistake is noticed where some answer lies outside the tolerance by so many of its scatters."""
CAREFUL = "careful"
"""What work without a mistake is called among the mistakes."""


def hypotheses(variant: Variant, lengths: list[float] | None = None) -> dict[str, tuple[Expected, ...]]:
    """What a student with each of the exercise's mistakes answers, and how it scatters.

    Raises
    ------
    DesignError : the drawing with a mistake comes to nothing
    """
    exercise, task = variant.exercise, variant.task
    lengths = lengths or lengths_of(exercise, task)
    found: dict[str, tuple[Expected, ...]] = {}
    for name in exercise.misconceptions:
        change = misconception(name).change
        perfect = answers_of(exercise, task, None, change=change)
        hands = answers_of(exercise, task, HANDS, change=change)
        found[name] = tuple(expected(exercise, perfect, hands, lengths, bulges_of(exercise, task, change)))
    return found


def alike(
    exercise: Exercise, keys: list[Expected], wrong: dict[str, tuple[Expected, ...]], bound: float
) -> list[tuple[str, str]]:
    """The pairs that the answers do not tell apart; a mistake that passes as careful work is paired with that."""
    passing = [(name, CAREFUL) for name, values in wrong.items() if not _noticed(exercise, keys, values, bound)]
    same = [(a, b) for a, b in combinations(wrong, 2) if not _told(exercise, wrong[a], wrong[b])]
    return passing + same


def _noticed(exercise: Exercise, keys: Sequence[Expected], wrong: Sequence[Expected], bound: float) -> bool:
    return any(
        bool(np.any(_gap(asked, key, value) > bound * key.scatter + BEYOND * value.scatter))
        for asked, key, value in zip(exercise.answers, keys, wrong, strict=True)
    )


def _told(exercise: Exercise, a: Sequence[Expected], b: Sequence[Expected]) -> bool:
    return any(
        bool(np.any(_gap(asked, x, y) > APART * (x.scatter + y.scatter)))
        for asked, x, y in zip(exercise.answers, a, b, strict=True)
    )


def _gap(asked: Asked, a: Expected, b: Expected) -> NDArray[np.float64]:
    """How far two expected answers lie apart; of a curve, which shows no shift along itself, the clear distance."""
    if asked.kind == "curve":
        return a.distances(np.asarray(b.value), asked.kind)
    return np.abs(np.asarray(a.value) - np.asarray(b.value))


def promising(variant: Variant) -> bool:
    """Whether no mistake answers plainly too near to the key or to another, by the rounding alone.

    Drawings by a perfect hand, so it costs little; nothing that could be told apart is turned away.
    """
    exercise, task = variant.exercise, variant.task
    try:
        lengths = lengths_of(exercise, task)
        rows = [answers_of(exercise, task, None)]
        rows += [
            answers_of(exercise, task, None, change=misconception(name).change) for name in exercise.misconceptions
        ]
    except GraphcamError:
        return False
    if not all(np.isfinite(value).all() for row in rows for value in row):
        return False
    values = [expected(exercise, row, [value[None] for value in row], lengths) for row in rows]
    return all(_told(exercise, a, b) for a, b in combinations(values, 2))

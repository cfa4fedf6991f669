"""Answers beside the key: which of them can be read, how far off they are, and which are wrong."""

from typing import NamedTuple

import numpy as np

from graphcam.exercises.definition.exercise import Answers, Asked, Exercise, Given
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.expectation import Expected, Off

MOST_POINTS = 20_000
"""No curve by hand has more, and no submission shall keep the marking busy."""
LARGEST = 1e15
"""No reading is larger, and no number up to here makes the arithmetic overflow."""


class ComparedAnswer(NamedTuple):
    """An answer that can be read, beside the key.

    place : among the answers of the exercise
    wrong : whether it lies outside the tolerance
    """

    place: int
    asked: Asked
    given: Given
    key: Expected
    off: Off
    wrong: bool


def compare(exercise: Exercise, answer_key: AnswerKey, answers: Answers) -> list[ComparedAnswer]:
    """The answers that can be read, in the order of the exercise."""
    found: list[ComparedAnswer] = []
    for place, asked in enumerate(exercise.answers):
        if (given := _readable(asked, answers)) is not None:
            key = answer_key.keys[asked.name].expected
            off = key.off(given, asked.kind, answer_key.bound)
            # A NaN is wrong too.
            wrong = not abs(off.deviation) <= answer_key.bound
            found.append(ComparedAnswer(place, asked, given, key, off, wrong))
    return found


def _readable(asked: Asked, answers: Answers) -> Given | None:
    """The answer as a finite number or as points, None where it is neither."""
    given = answers.values.get(asked.name)
    if asked.kind == "number":
        if isinstance(given, bool) or not isinstance(given, int | float):
            return None
        return float(given) if abs(given) <= LARGEST else None
    if not isinstance(given, np.ndarray) or given.ndim != 1 or not 0 < given.size <= MOST_POINTS:
        return None
    # Compared this way round, for a NaN is not less than anything.
    fits = np.issubdtype(given.dtype, np.number) and bool((np.abs(given) <= LARGEST).all())
    return given.astype(np.complex128) if fits else None

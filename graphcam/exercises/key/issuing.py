"""Issuing variants: parameters are drawn until every catalogued mistake can be told."""

from __future__ import annotations

from graphcam.errors import DesignError
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.variant import Variant, drawn
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.keying import draw_key

MOST_DRAWS = 400
"""Draws after which an exercise is held to have no variant that can be diagnosed."""


def issue(exercise: Exercise, student: str, secret: bytes) -> tuple[Variant, AnswerKey]:
    """The student's variant and its answer key: the first draw in which every mistake can be told from every other.

    The same exercise, student and secret give the same variant on every machine.

    Raises
    ------
    DesignError : no draw can be diagnosed
    """
    for draw in range(MOST_DRAWS):
        candidate = drawn(exercise, student, secret, draw)
        answer_key = draw_key(candidate)
        if answer_key:
            return candidate, answer_key
    remedy = (
        "widen the parameters, ask for another reading, leave a misconception out, or choose an ordinate and poles for "
        "which the diagrams fit on the worksheet"
    )
    raise DesignError("exercise", exercise.name, f"diagnosable in {MOST_DRAWS} draws", remedy)

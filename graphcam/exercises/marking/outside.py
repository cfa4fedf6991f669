"""Mistakes that an exercise does not list, made all the same: what is named then is always another mistake."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.errors import GraphcamError
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.mistakes import CATALOGUE, misconception
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.scatter import Drawn, answers_of
from graphcam.given.laws import LAWS


def unlisted(exercise: Exercise, chain: Chain) -> Iterator[Drawn]:
    """The answers of the hands of a drawing with every catalogued mistake that its exercise does not list.

    Another law is taken as often as there are laws; what cannot be drawn here is left out.
    """
    names = [name for name, entry in CATALOGUE.items() if not entry.takes]
    names += [f"wrong-law: {law}" for law in LAWS]
    for name in names:
        if name in exercise.misconceptions:
            continue
        try:
            answers = answers_of(exercise, misconception(name).change(chain))
        except GraphcamError:
            continue
        if all(np.isfinite(values).all() for values in answers):
            yield answers


def without(answer_key: AnswerKey, name: str) -> AnswerKey:
    """The answer key that does not know one mistake."""
    others = {other: each for other, each in answer_key.hypotheses.items() if other != name}
    return replace(answer_key, hypotheses=others)

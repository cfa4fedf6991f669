"""Mistakes that an exercise does not list, made all the same: what is named then is always another mistake."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.errors import GraphcamError
from graphcam.exercises.definition.catalogue import A_LAW, A_READING
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.mistakes import CATALOGUE, misconception
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.scatter import Drawn, answers_of
from graphcam.given.laws import BETWEEN_DWELLS


def unlisted_names(exercise: Exercise) -> list[str]:
    """Every catalogued mistake that the exercise does not list, with every argument that has to do with its answers.

    Another law is taken as often as there are laws between dwells.
    """
    asked = exercise.answers
    diagrams = ["integration"] + ["differentiation"] * any(each.construction == "differentiation" for each in asked)
    lengths = dict.fromkeys(f"{each.construction}.{each.reading}" for each in asked if each.reading)
    names: list[str] = []
    for name, entry in CATALOGUE.items():
        if entry.takes == A_LAW:
            names += [f"{name}: {law}" for law in BETWEEN_DWELLS]
        elif entry.takes == A_READING:
            names += [f"{name}: {length}" for length in lengths]
        else:
            names += [f"{name}: {diagram}" for diagram in diagrams] if entry.takes else [name]
    return [name for name in names if name not in exercise.misconceptions]


def unlisted(exercise: Exercise, chain: Chain) -> Iterator[tuple[str, Drawn]]:
    """The names and the answers of the hands of a drawing with every mistake that its exercise does not list.

    Left out are what cannot be drawn here, and what is stroke by stroke the drawing with a mistake that is listed, such
    as another law where that is the law of the other phase.
    """
    listed = [answers_of(exercise, misconception(name).change(chain)) for name in exercise.misconceptions]
    for name in unlisted_names(exercise):
        try:
            answers = answers_of(exercise, misconception(name).change(chain))
        except GraphcamError:
            continue
        finite = all(np.isfinite(values).all() for values in answers)
        if finite and not any(all(map(np.array_equal, answers, others)) for others in listed):
            yield name, answers


def without(answer_key: AnswerKey, name: str) -> AnswerKey:
    """The answer key that knows neither one mistake nor those that it does not tell from it."""
    unknown = {name, *answer_key.not_told_from(name)}
    others = {other: each for other, each in answer_key.hypotheses.items() if other not in unknown}
    return replace(answer_key, hypotheses=others)

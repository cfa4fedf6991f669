"""Making a certificate: the variant drawn by a perfect hand, by many careful ones, and with every mistake."""

from __future__ import annotations

import numpy as np

from graphcam.exercises.certificate import Certificate, Key
from graphcam.exercises.hypothesis import Hypothesis
from graphcam.exercises.redrawing import dependences
from graphcam.exercises.scatter import answers_of, bulges_of, deviations, expected, lengths_of
from graphcam.exercises.separation import alike, hypotheses
from graphcam.exercises.variant import Variant

HANDS = 2000
"""Careful hands behind the tolerances."""
MARGIN = 0.6
"""The bound is set for this part of the permitted rate of losses: a rate from finitely many hands is uncertain."""
TOO_EXACT = 5e-4
"""A hand-in is remarked on as too exact where so few careful hands are as near to the key."""


def certify(variant: Variant) -> Certificate:
    """The certificate of a variant.

    Raises
    ------
    DesignError : there is no such cam
    """
    exercise, task = variant.exercise, variant.task
    lengths = lengths_of(exercise, task)
    perfect = answers_of(exercise, task, None)
    hands = answers_of(exercise, task, HANDS)
    keys = expected(exercise, perfect, hands, lengths, bulges_of(exercise, task))
    off = deviations(exercise, keys, hands)
    bound = float(np.quantile(off.max(axis=1), 1 - MARGIN * exercise.careful))
    drawn = [float(np.std(samples)) > 0 for samples in hands]
    wrong = hypotheses(variant, lengths)
    near = np.sqrt(np.mean(off[:, drawn] ** 2, axis=1)) if any(drawn) else np.full(HANDS, np.nan)
    return Certificate(
        exercise.name, exercise.version, variant.student, variant.draw, variant.parameters, bound,
        float(np.mean(off.max(axis=1) > bound)),
        {
            asked.name: Key(key, tolerance, tolerance / length, is_drawn)
            for asked, key, length, is_drawn in zip(exercise.answers, keys, lengths, drawn, strict=True)
            for tolerance in [bound * float(np.max(key.scatter))]
        },
        {name: Hypothesis.of(values) for name, values in wrong.items()},
        tuple(alike(exercise, keys, wrong, bound)),
        dependences(exercise, task, keys, bound),
        float(np.quantile(near, TOO_EXACT)) if any(drawn) else 0.0,
    )  # fmt: skip

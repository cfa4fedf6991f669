"""Issued variants that several tests share: making one takes a second."""

from __future__ import annotations

from functools import cache

import numpy as np

from graphcam.exercises.definition.answers import Answers
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.key.answer_key import Certificate
from graphcam.exercises.key.issuing import issue
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.record import Record

SECRET = b"the secret of the tests"


@cache
def issued(name: str, student: str = "Anna") -> tuple[Exercise, Certificate]:
    exercise = find_exercise(name)
    return exercise, issue(exercise, student, SECRET)[1]


def key(certificate: Certificate) -> dict[str, float | np.ndarray]:
    return {name: key.expected.value for name, key in certificate.keys.items()}


def marked(name: str, student: str = "Anna", **changes: object) -> Record:
    """The key handed in, with some answers changed."""
    exercise, certificate = issued(name, student)
    return mark(exercise, certificate, Answers(key(certificate) | changes))


def outcomes(record: Record) -> dict[str, str]:
    return {answer.name: answer.outcome for answer in record.answers}

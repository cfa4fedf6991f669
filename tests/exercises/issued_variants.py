"""Issued variants that several tests share: making one takes a second."""

from __future__ import annotations

from functools import cache

import numpy as np

from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.keying import issue
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.record import Record

SECRET = b"the secret of the tests"


@cache
def issued(name: str, student: str = "Anna") -> tuple[Exercise, AnswerKey]:
    exercise = find_exercise(name)
    return exercise, issue(exercise, student, SECRET)[1]


def key(answer_key: AnswerKey) -> dict[str, float | np.ndarray]:
    return {name: key.expected.value for name, key in answer_key.keys.items()}


def marked(name: str, student: str = "Anna", **changes: object) -> Record:
    """The key handed in, with some answers changed."""
    exercise, answer_key = issued(name, student)
    return mark(exercise, answer_key, Answers(key(answer_key) | changes))


def outcomes(record: Record) -> dict[str, str]:
    return {answer.name: answer.outcome for answer in record.answers}

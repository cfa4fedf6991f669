"""Issued variants that several tests share: making one takes a second."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np

from graphcam.exercises.course.course_folder import STUDENTS_FOLDER, TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.key_making import issue
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


def answer_lines(values: Mapping[str, object]) -> str:
    """An ``answers.toml``."""
    return "".join(f"{name} = {value!r}\n" for name, value in values.items())


def course_of(place: Path, name: str, handed_in: Mapping[str, str | None]) -> Path:
    """A course as 'make' leaves it, with its secret beside it.

    handed_in : by student an ``answers.toml``; None where there is a key alone
    """
    kept = AnswerKeys(place / TEACHER_FOLDER)
    kept.keep_course(exercise_path(name), SECRET, language="en")
    (place / "secret").write_bytes(SECRET)
    for student, text in handed_in.items():
        kept.keep(student, issued(name, student)[1].to_json())
        if text is not None:
            folder = place / STUDENTS_FOLDER / folder_name(student)
            folder.mkdir(parents=True)
            (folder / "answers.toml").write_text(text)
    return place

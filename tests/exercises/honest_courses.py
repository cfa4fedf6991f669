"""Courses of simulated students who all work alone: how often two of them are named as alike nevertheless."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import answers_of
from graphcam.exercises.key.key_making import issue
from graphcam.exercises.key.unlisted_mistakes import unlisted_answers
from graphcam.exercises.marking.copy_detection import alike_pairs
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.simulate import submission

HANDS = 5
"""Students of each kind who draw each variant; a course takes one of them."""
Records = list[dict[str, Any]]


@dataclass(frozen=True, eq=False)
class HonestStudents:
    """Records of students who work alone, to put courses together from.

    careful, catalogued, unlisted : by student, one record a hand: without a mistake, with one that the exercise lists,
        with one that it does not
    """

    exercise: Exercise
    answer_keys: Mapping[str, AnswerKey]
    careful: list[Records]
    catalogued: list[Records]
    unlisted: list[Records]

    def course(self, seed: int) -> Records:
        """A course of all students: a third each careful, with a listed and with an unlisted mistake."""
        chosen = np.random.default_rng(seed)
        kinds = (self.careful, self.catalogued, self.unlisted)
        found: Records = []
        for k in range(len(self.careful)):
            records = kinds[chosen.integers(3)][k] or self.careful[k]
            found.append(records[chosen.integers(len(records))])
        return found

    def alarms(self, courses: int) -> int:
        """The number of courses, of so many, in which any pair is named."""
        return sum(bool(alike_pairs(self.exercise, self.course(k), self.answer_keys)) for k in range(courses))


def honest_students(exercise: Exercise, secret: bytes, students: int) -> HonestStudents:
    """Honest students with a variant each, and their records with every mistake.

    Raises
    ------
    DesignError : there is a student for whom no draw of the parameters can be diagnosed
    """
    found = HonestStudents(exercise, answer_keys := {}, [], [], [])
    for k in range(students):
        student = f"student {k}"
        variant, answer_keys[student] = issue(exercise, student, secret)
        # Never the seed of the hands that the answer key was made from.
        chain = board_chain(variant.task, exercise.hand.pencil(HANDS, 1 + k))
        listed = [answers_of(exercise, misconception(name).change(chain)) for name in exercise.misconceptions]
        kinds = (
            [answers_of(exercise, chain)],
            listed,
            [answers for _, answers in unlisted_answers(exercise, chain, listed)],
        )
        for records, drawings in zip((found.careful, found.catalogued, found.unlisted), kinds, strict=True):
            given = [submission(exercise, drawn, row) for drawn in drawings for row in range(HANDS)]
            records.append([mark(exercise, answer_keys[student], answers).to_dict() for answers in given])
    return found

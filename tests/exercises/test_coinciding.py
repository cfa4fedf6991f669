"""One number for all answers: it never earns more than half of the marks of a variant that is issued."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from issued_variants import SECRET, issued

from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.exercises.definition.exercise_file import find_exercise, library
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.coinciding_answers import MAX_COINCIDENCE_SHARE, by_one_number
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.key.key_making import issue, key_or_reason


def with_numbers(values: dict[float, float], *others: AskedAnswer) -> float:
    """What one number earns of answers with these values, of so many marks each, at a tolerance of 1."""
    numbers = [
        AskedAnswer(f"a{k}", "A length.", "integration", reading="v", unit="mm", marks=marks)
        for k, marks in enumerate(values.values())
    ]
    exercise = replace(find_exercise("inversion-translating"), answers=(*numbers, *others))
    drawn_keys = [Expected(np.zeros(3, dtype=complex), np.ones(3)) for _ in others]
    keys = [*(Expected(value, 0.3) for value in values), *drawn_keys]
    return by_one_number(exercise, keys, [1.0] * len(keys))


@pytest.mark.parametrize(
    ("values", "earned"),
    [
        ({10.0: 1, 20.0: 1, 30.0: 2}, 0.0),
        ({10.0: 1, 11.9: 1, 30.0: 2}, 0.5),
        ({10.0: 1, -11.9: 1, 30.0: 2}, 0.5),
        ({10.0: 1, 12.1: 1, 30.0: 2}, 0.0),
        # Neighbours overlap each, but no number lies near all three.
        ({10.0: 1, 11.5: 1, 13.0: 2}, 0.75),
        ({10.0: 1, 10.9: 1, 11.8: 2}, 1.0),
        # A single answer coincides with nothing, however much it is worth.
        ({10.0: 9, 20.0: 1}, 0.0),
        ({0.5: 1, -0.4: 1}, 1.0),
    ],
)
def test_one_number_earns_what_lies_within_the_tolerance_of_one_place(values: dict[float, float], earned: float):
    assert with_numbers(values) == pytest.approx(earned)


def test_what_is_drawn_counts_among_the_marks_and_is_not_earned_by_a_number():
    curve = AskedAnswer("pitch", "A curve.", "inversion", points="pitch", kind="curve", layer="PITCH", marks=2)
    assert with_numbers({10.0: 1, 10.5: 1}, curve) == pytest.approx(0.5)


@pytest.mark.slow
@pytest.mark.parametrize("name", library())
def test_no_number_earns_more_than_half_of_an_issued_variant(name: str):
    for student in ("Anna", "Boris", "Clara"):
        exercise, answer_key = issued(name, student)
        keys = [answer_key.keys[asked.name] for asked in exercise.answers]
        assert (
            by_one_number(exercise, [key.expected for key in keys], [key.tolerance for key in keys])
            <= MAX_COINCIDENCE_SHARE
        )


@pytest.mark.parametrize(("marks", "is_issued"), [(0.1, True), (5.0, False)])
def test_a_variant_in_which_one_number_earns_most_marks_is_not_issued(marks: float, is_issued: bool):
    exercise = find_exercise("pressure-angle")
    variant, _ = issue(exercise, "Anna", SECRET)
    alpha = next(asked for asked in exercise.answers if asked.name == "alpha_4")
    again = (replace(alpha, name=f"again_{k}", marks=marks) for k in "ab")
    thrice = replace(exercise, answers=(*exercise.answers, *again))
    assert isinstance(key_or_reason(replace(variant, exercise=thrice)), AnswerKey) == is_issued

"""What counts as an answer, and as a right one: every limit is where it is said to be, and belongs to it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from issued_variants import issued, key

from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.marking.diagnosis import compare


def places(name: str, answer: object, exercise: str = "inversion-translating") -> list[int]:
    """The answers that can be read where everything is right but this one."""
    definition, answer_key = issued(exercise)
    answers = Answers(key(answer_key) | {name: answer})
    return [each.place for each in compare(definition, answer_key, answers)]


def test_a_number_is_read_up_to_a_thousand_million_millions():
    every = list(range(len(issued("integration")[0].answers)))
    more = math.nextafter(1e15, math.inf)
    for given, readable in (
        (1e15, True),
        (-1e15, True),
        (more, False),
        (-more, False),
        (10**15, True),
        (10**16, False),
    ):
        assert places("v_2", given, "integration") == (every if readable else every[1:])


@pytest.mark.parametrize(
    ("points", "readable"),
    [
        (np.zeros(1), True),
        (np.zeros(0), False),
        (np.zeros(20_000), True),
        (np.zeros(20_001), False),
        (np.zeros((3, 2)), False),
        (np.array([1, 2]), True),
        (np.array([True, False]), False),
        (np.array([1j, 1e15]), True),
        (np.array([1j, 1.0000001e15]), False),
        (np.array([1j, math.nan]), False),
    ],
)
def test_points_are_read_up_to_twenty_thousand_and_only_if_each_is_a_place(points, readable):
    exercise, answer_key = issued("inversion-translating")
    pitch = [asked.name for asked in exercise.answers].index("pitch")
    assert (pitch in places("pitch", points)) == readable
    given = {each.place: each.given for each in compare(exercise, answer_key, Answers({"pitch": points}))}
    assert not readable or given[pitch].dtype == np.complex128


def test_an_answer_exactly_at_the_tolerance_is_right():
    exercise, answer_key = issued("integration")
    name = exercise.answers[0].name
    # Numbers without rounding: two deviations of a half from ten.
    keys = {name: replace(answer_key.keys[name], expected=Expected(10.0, 0.5))}
    answer_key = replace(answer_key, bound=2.0, keys={**answer_key.keys, **keys})
    for given, wrong in ((9.0, False), (11.0, False), (math.nextafter(11.0, 12.0), True), (8.999, True)):
        (found,) = compare(exercise, answer_key, Answers({name: given}))
        assert (found.place, found.asked, found.given, found.wrong) == (0, exercise.answers[0], given, wrong)
        assert found.off.deviation == (given - 10.0) / 0.5

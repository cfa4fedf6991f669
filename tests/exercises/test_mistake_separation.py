"""Issued is where every mistake can be told: from careful work, from every other, and from an answer of nought."""

from __future__ import annotations

from dataclasses import replace

import pytest

from graphcam.errors import DesignError
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.student_hands import HandTable
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import answers_of
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.key.key_making import issue, key_or_reason
from graphcam.exercises.key.mistake_separation import DETECTION_SCATTERS, passing
from graphcam.exercises.key.refused_draws import RefusedDraw
from graphcam.exercises.marking.simulate import simulate

BOUND = 2.8
"""Within so many of its scatters an answer earns its marks."""


@pytest.mark.parametrize("near", [-1.0, 1.0])
def test_a_mistake_whose_only_wrong_answer_may_be_nought_cannot_be_named(near):
    exercise = find_exercise("least-radius")
    keys = [Expected(50.0, 1.0) for _ in exercise.answers]
    nought = near * (BOUND + DETECTION_SCATTERS)  # scatters of 1
    for value, told in ((0.9 * nought, False), (1.1 * nought, True)):
        wrong = {"mistake": (Expected(value, 1.0), *keys[1:])}
        assert passing(exercise, keys, wrong, BOUND) == ([] if told else [("mistake", "careful")])
    both = {"mistake": (Expected(0.9 * nought, 1.0), Expected(70.0, 1.0), *keys[2:])}
    assert passing(exercise, keys, both, BOUND) == []  # another answer names it


def test_a_mistake_too_near_to_careful_work_passes():
    exercise = find_exercise("least-radius")
    keys = [Expected(50.0, 1.0) for _ in exercise.answers]
    for gap, told in ((0.9 * (BOUND + DETECTION_SCATTERS), False), (1.1 * (BOUND + DETECTION_SCATTERS), True)):
        wrong = {"mistake": (Expected(50.0 + gap, 1.0), *keys[1:])}
        assert passing(exercise, keys, wrong, BOUND) == ([] if told else [("mistake", "careful")])


def test_limits_swapped_in_a_region_that_begins_almost_on_the_line_of_motion_are_not_issued():
    """There the wrong offset is 2.2 mm, with a scatter of 0.7 mm: one hand in five would be told nothing."""
    exercise = replace(find_exercise("least-radius"), hand=HandTable("careful"))
    parameters = {"back": 105, "dwell": 55, "law_down": "cosine", "law_up": "modified-sine", "lift": 45}
    parameters |= {"limit_down": 40, "limit_up": 27, "pole": 40, "rise": 80, "rotation": "cw"}
    variant = Variant(exercise, "a student", 0, parameters)
    drawn = board_chain(variant.task, exercise.hand.pencil(200))
    offset = [asked.name for asked in exercise.answers].index("offset")
    wrong = answers_of(exercise, misconception("limits-swapped").change(drawn))[offset]
    assert abs(wrong.mean()) < (BOUND + DETECTION_SCATTERS) * wrong.std()
    assert isinstance(key_or_reason(variant), RefusedDraw)
    other = replace(variant, parameters=parameters | {"limit_up": 35, "limit_down": 60})
    assert isinstance(key_or_reason(other), AnswerKey)


@pytest.mark.slow
def test_every_mistake_of_the_variant_of_a_student_is_named():
    found = simulate(find_exercise("least-radius"), b"the secret of the tests", 3, 60)
    assert found.right_diagnoses >= 0.99


def test_a_mistake_that_no_answer_shows_is_named_after_a_few_draws():
    """Nothing on paper changes by a scale in degrees: no parameter helps."""
    whole = find_exercise("integration")
    answers = tuple(replace(asked, of="paper", unit="mm") for asked in whole.answers if asked.reading == "s")[:1]
    exercise = replace(whole, answers=answers, misconceptions=("degree-for-radian: integration",), alike=())
    said = r"in 40 of them 'degree-for-radian: integration' cannot be told from right work; ask for "
    with pytest.raises(DesignError, match=said + r'integration.v \(of = "scale"\)'):
        issue(exercise, "Anna", b"secret")

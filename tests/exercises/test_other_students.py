"""Right work of other students than those who set the tolerances loses a point in at most 2 %."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from issued_variants import issued
from other_students import OtherStudents, answers_of_others
from over_all import fast_first

from graphcam.drafting.acts import Kind
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import BAR
from graphcam.exercises.definition.exercise_file import library
from graphcam.exercises.definition.student_hands import HandTable
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.printed_size import on_true_print
from graphcam.exercises.marking.marking import mark

HANDS = 400
PRINTED_SMALL = 0.1
"""The part of the students whose printer makes 99 % of everything."""


def losing(name: str, student: str, printed: float = 1.0, *, told: bool = False) -> dict[str, float]:
    """The part of them that loses each answer, and any under the name "".

    told : whether they tell how long the rule on their sheet is
    """
    exercise, answer_key = issued(name, student)
    right = board_chain(Variant(exercise, student, answer_key.draw, answer_key.parameters).task)
    given = answers_of_others(exercise, right, OtherStudents(samples=HANDS, seed=5), printed)
    if told:
        given = [replace(each, values={**each.values, BAR.name: 100 * printed}) for each in given]
        given = [on_true_print(exercise, answer_key, each) for each in given]
    records = [mark(exercise, answer_key, each) for each in given]
    found = {"": float(np.mean([record.total < record.of for record in records]))}
    for k, asked in enumerate(exercise.answers):
        if lost := float(np.mean([record.answers[k].marks < asked.marks for record in records])):
            found[asked.name] = lost
    return found


@pytest.mark.parametrize("name", fast_first(library(), 2))
def test_their_right_work_loses_a_point_in_at_most_two_percent(name: str):
    rates = [losing(name, "Anna")[""], losing(name, "Anna", 0.99)[""]]
    assert (1 - PRINTED_SMALL) * rates[0] + PRINTED_SMALL * rates[1] <= 0.02


@pytest.mark.slow
@pytest.mark.parametrize("name", library())
def test_on_a_print_at_98_percent_they_lose_no_more_where_its_length_is_told(name: str):
    assert losing(name, "Anna", 0.98, told=True)[""] <= 0.02


@pytest.mark.slow
@pytest.mark.parametrize(("name", "lost"), [("integration", 0.5), ("least-radius", 0.05)])
def test_where_it_is_not_told_they_lose_more(name: str, lost: float):
    assert losing(name, "Anna", 0.98)[""] > lost


def test_it_can_fail_and_a_print_at_98_percent_is_more_than_a_tolerance_allows():
    exercise, answer_key = issued("pressure-angle")
    right = board_chain(Variant(exercise, "Anna", answer_key.draw, answer_key.parameters).task)
    given = answers_of_others(exercise, right, OtherStudents(samples=HANDS, seed=5))
    strict = replace(answer_key, bound=answer_key.bound / 2)
    assert np.mean([mark(exercise, strict, each).total < exercise.marks for each in given]) > 0.05
    assert losing("pressure-angle", "Boris", 0.98)[""] > 0.2


def test_they_err_otherwise_than_those_who_set_the_tolerances():
    """Their errors have a side and no tails, where normal errors have none and many."""
    hands = OtherStudents(samples=HANDS, seed=5)
    off = hands.slips(Kind.PROTRACTOR, "turn", hands.stream("test"), (HANDS, HANDS))
    sides = np.abs(off.mean(axis=1))
    assert np.degrees(sides).max() > 0.25
    assert np.degrees(np.abs(off - off.mean(axis=1, keepdims=True))).max() < 0.8
    usual = HandTable().pencil(HANDS, 5)
    normal = usual.slips(Kind.PROTRACTOR, "turn", usual.stream("test"), (HANDS, HANDS))
    assert np.degrees(np.abs(normal)).max() > 1.5

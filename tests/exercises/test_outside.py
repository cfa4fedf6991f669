"""Mistakes that an exercise does not list: they are drawn, they are none of its own, and none is looked for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from issued_variants import issued

from graphcam.constructions.chain import Chain
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.mistakes import CATALOGUE, misconception
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import Drawn, answers_of
from graphcam.exercises.key.unlisted_mistakes import unlisted_answers, unlisted_names
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.simulate import key_without, simulate, submission

HANDS = 12


def drawings(name: str) -> tuple[Exercise, AnswerKey, dict[str, Drawn]]:
    """What hands with every mistake that is not listed draw of an issued variant."""
    exercise, answer_key = issued(name)
    task = Variant(exercise, answer_key.student, answer_key.draw, answer_key.parameters).task
    return exercise, answer_key, unlisted(exercise, board_chain(task, exercise.hand.pencil(HANDS, 5)))


def unlisted(exercise: Exercise, chain: Chain) -> dict[str, Drawn]:
    """What hands with every mistake that is not listed answer."""
    listed = [answers_of(exercise, misconception(each).change(chain)) for each in exercise.misconceptions]
    return dict(unlisted_answers(exercise, chain, listed))


def apart(exercise: Exercise, answer_key: AnswerKey, answers: Drawn) -> float:
    """How many scatters the farthest answer of a hand lies from the key; the median of all hands."""
    off = []
    for row in range(HANDS):
        given = submission(exercise, answers, row).values
        keys = [(answer_key.keys[asked.name].expected, asked) for asked in exercise.answers]
        off.append(max(abs(key.deviation(given[asked.name], asked.kind)) for key, asked in keys))
    return float(np.median(off))


@pytest.mark.parametrize("name", ["least-radius", "curvature-and-roller"])
def test_what_is_drawn_with_a_mistake_that_shows_is_wrong_and_no_listed_mistake(name):
    exercise, answer_key, drawn = drawings(name)
    assert not set(drawn) & set(exercise.misconceptions)
    chain = board_chain(
        Variant(exercise, answer_key.student, answer_key.draw, answer_key.parameters).task,
        exercise.hand.pencil(HANDS, 5),
    )
    listed = [answers_of(exercise, misconception(each).change(chain)) for each in exercise.misconceptions]
    for each, answers in drawn.items():
        assert not any(all(map(np.array_equal, answers, others)) for others in listed), each
    off = {each: apart(exercise, answer_key, answers) for each, answers in drawn.items()}
    # Some do not show in the answers asked, such as a circle of the inversion where none is drawn.
    assert sum(each > 10 for each in off.values()) >= 4
    assert off["prime-diameter" if name == "curvature-and-roller" else "wrong-law: triangular"] > 10


def test_another_law_that_is_the_law_of_a_listed_mistake_is_that_mistake():
    exercise, answer_key = issued("acceleration-and-scales")
    laws = {"law_up": "cosine", "law_down": "cycloidal"}
    task = Variant(exercise, "Anna", 0, {**answer_key.parameters, **laws}).task
    chain = board_chain(task, exercise.hand.pencil(HANDS, 5))
    listing = replace(exercise, misconceptions=("wrong-law: cosine",))
    # Both phases by the law of the rise, and by that of the return.
    assert "wrong-law: cosine" not in unlisted(listing, chain)
    assert "wrong-law: cycloidal" in unlisted(listing, chain)
    same = replace(exercise, misconceptions=("laws-swapped",))
    by_one_law = board_chain(
        Variant(exercise, "Anna", 0, {**answer_key.parameters, "law_up": "cosine", "law_down": "cosine"}).task,
        exercise.hand.pencil(HANDS, 5),
    )
    # Laws that are the same are exchanged without anything changing, as by the law that both have.
    assert "wrong-law: cosine" not in unlisted(same, by_one_law)


def test_arguments_are_those_that_have_to_do_with_the_answers():
    names = unlisted_names(find_exercise("differentiation"))
    assert {"pole-forgotten: integration", "scale-forgotten: differentiation.rise", "wrong-law: cosine"} <= set(names)
    assert "scale-forgotten: differentiation.v" not in names  # it is listed
    without_it = unlisted_names(find_exercise("least-radius"))
    assert not any(each.endswith(": differentiation") for each in without_it)
    # Every mistake of the catalogue is there, with an argument where one is taken, or is listed with all of them.
    for exercise in map(find_exercise, ("differentiation", "least-radius", "whole-cam")):
        every = {*unlisted_names(exercise), *exercise.misconceptions}
        assert {each.partition(":")[0] for each in every} == set(CATALOGUE)
        for each in every:
            assert misconception(each).name == each


@pytest.mark.parametrize("name", ["pressure-angle", "curvature-and-roller"])
def test_what_is_left_out_of_the_key_is_never_named(name):
    exercise, answer_key = issued(name)
    for each, values in answer_key.hypotheses.items():
        key = key_without(answer_key, each)
        unknown = {each} | answer_key.inseparable_from(each)
        assert set(key.hypotheses) == set(answer_key.hypotheses) - unknown
        given = {asked.name: value.value for asked, value in zip(exercise.answers, values, strict=True)}
        diagnosis = mark(exercise, key, Answers(given)).diagnosis
        named = {diagnosis.misconception, *diagnosis.alike} if diagnosis else set()
        assert not named & unknown
        # The whole key names it, so that it is the leaving out that tells.
        full = mark(exercise, answer_key, Answers(given)).diagnosis
        assert full is not None
        assert each in {full.misconception, *full.alike}


@pytest.mark.slow
def test_mistakes_that_an_exercise_does_not_know_are_seldom_given_a_name():
    for name in ("pressure-angle", "least-radius-offset"):
        found = simulate(find_exercise(name), b"the secret of the tests", 3, 10)
        assert found.outside.hands > 100
        assert found.left_out.hands == 30 * len(found.rows)
        assert found.outside_named <= 0.1
        assert found.right_diagnoses >= 0.99

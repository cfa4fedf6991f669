"""As exact as a program: said of a program's readings and CAD's, of hardly any hand's, and to the teacher alone."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, strategies as st
from issued_variants import SECRET, issued, marked

from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.definition.student_hands import HandTable
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.exports import gradescope
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import answers_of
from graphcam.exercises.marking.exactness import REMARK_RATE, chance, probability_of_at_least
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.reports.group_page import group_page
from graphcam.exercises.reports.student_page import student_page

NAMES = ("acceleration-and-scales", "differentiation", "least-radius-offset", "inversion-arm", "pressure-angle")
CAD = HandTable(line=1e-5, dividers=1e-5, division=1e-5, protractor_deg=1e-5, stretch=0.0)
"""What a program's own rounding leaves of a drawing."""


def submissions(name: str, hand: HandTable, count: int) -> list[dict[str, float | np.ndarray]]:
    """The numbers that so many hands read, and the points they drew."""
    exercise, answer_key = issued(name)
    task = drawn(exercise, "Anna", SECRET, answer_key.draw).task
    given = answers_of(exercise, board_chain(task, hand.pencil(count, seed=7)))
    columns = list(zip(exercise.answers, given, strict=True))
    return [{asked.name: float(v[k]) if asked.kind == "number" else v[k] for asked, v in columns} for k in range(count)]


def program(name: str) -> dict[str, float]:
    """The numbers of a program, rounded as asked."""
    exercise, answer_key = issued(name)
    numbers = [asked for asked in exercise.answers if asked.kind == "number"]
    return {one.name: round(float(answer_key.keys[one.name].expected.value), one.decimals) for one in numbers}


@given(st.lists(st.floats(0, 1), max_size=6), st.integers(0, 7))
def test_the_probability_of_so_many_is_that_of_all_ways_to_have_them(chances, count):
    ways = product((False, True), repeat=len(chances))
    likely = [
        math.prod(p if happens else 1 - p for p, happens in zip(chances, way, strict=True))
        for way in ways
        if sum(way) >= count
    ]
    assert probability_of_at_least(chances, count) == pytest.approx(sum(likely), abs=1e-12)


@pytest.mark.parametrize(("value", "pencil"), [(20.0, 0.3), (20.04, 0.08), (-3.33, 0.1)])
def test_the_chance_is_how_often_a_rounding_hand_reads_just_that(value, pencil):
    asked = replace(issued("pressure-angle")[0].answers[0], decimals=1)
    read = np.round(np.random.default_rng(1).normal(value, pencil, 200_000), 1)
    often = np.mean(np.abs(read - round(value, 1)) < 1e-9)
    # With its rounding the hand scatters so much; where it rounds away most of its errors that is an estimate.
    assert chance(asked, value, math.hypot(pencil, 0.1 / math.sqrt(12))) == pytest.approx(often, abs=0.005)


@pytest.mark.slow
def test_careful_hands_are_remarked_on_more_seldom_than_is_said():
    hands = 2000
    found = [
        mark(*issued(name), Answers(values)).too_exact
        for name in NAMES
        for values in submissions(name, issued(name)[0].hand, hands)
    ]
    assert sum(found) <= REMARK_RATE * len(found)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_readings_of_a_program_are_remarked_on(name):
    assert marked(name, **program(name)).too_exact


@pytest.mark.parametrize("name", NAMES)
def test_so_is_what_is_read_off_a_cad_drawing_by_the_same_construction(name):
    (values,) = submissions(name, CAD, 1)
    record = mark(*issued(name), Answers(values))
    assert record.too_exact
    assert record.total == record.of


def test_where_the_construction_differs_a_cad_drawing_does_not_agree_and_one_reading_is_not_enough():
    exercise, answer_key = issued("pressure-angle")
    (values,) = submissions("pressure-angle", CAD, 1)
    # Another construction, of the same right to be called one: each reading half a tolerance beside this one's.
    others = {n: float(values[n]) + 0.5 * answer_key.keys[n].tolerance for n in [a.name for a in exercise.answers][1:]}
    record = mark(exercise, answer_key, Answers(values | others))
    assert record.total == record.of
    assert not record.too_exact


def test_points_that_are_exact_beside_readings_by_hand_are_no_remark():
    exercise, answer_key = issued("inversion-arm")
    (values,) = submissions("inversion-arm", exercise.hand, 1)
    points = {a.name: answer_key.keys[a.name].expected.value for a in exercise.answers if a.kind != "number"}
    assert points
    assert not mark(exercise, answer_key, Answers(values | points)).too_exact


def test_a_number_that_every_hand_agrees_on_tells_nothing():
    exercise, answer_key = issued("pressure-angle")
    calculated = {name: replace(each, drawn=False) for name, each in answer_key.keys.items()}
    assert not mark(exercise, replace(answer_key, keys=calculated), Answers(program("pressure-angle"))).too_exact
    rounded = tuple(replace(asked, decimals=-3) for asked in exercise.answers)
    assert not mark(replace(exercise, answers=rounded), answer_key, Answers(program("pressure-angle"))).too_exact


def test_the_teacher_reads_the_remark_with_its_rate_and_the_student_nothing_of_it():
    exercise, answer_key = issued("pressure-angle")
    record = marked("pressure-angle", **program("pressure-angle")).to_dict()
    unremarked = record | {"too_exact": False}
    shown = [group_page(exercise, [one], {"Anna": answer_key}) for one in (record, unremarked)]
    rate = f"Fewer than {100 * REMARK_RATE:g} % of careful drawings are flagged."
    remark = f"Anna: the readings are as exact as those of a program: drawn in CAD or computed? {rate}"
    assert [remark in page for page in shown] == [True, False]
    assert student_page(exercise, record, answer_key) == student_page(exercise, unremarked, answer_key)
    assert gradescope.results(exercise, record) == gradescope.results(exercise, unremarked)
    assert not any("exact" in said for said in (*record["feedback"], *record["notes"]))


def test_an_answer_key_with_the_limit_of_former_versions_is_read():
    _, answer_key = issued("pressure-angle")
    former = json.loads(answer_key.to_json()) | {"too_exact": 0.25}
    assert AnswerKey.from_json(json.dumps(former)).to_json() == answer_key.to_json()

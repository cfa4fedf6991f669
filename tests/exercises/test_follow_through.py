"""Follow-through: one slip costs its own step, within the tolerance that a hand has there, and nothing else is free."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
import pytest
from issued_variants import issued, outcomes

from graphcam.exercises.definition.drawn_answers import board_chain, drawn_answer, is_length, with_own_answers
from graphcam.exercises.definition.exercise import Answers, AskedAnswer, Exercise
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey, Hypothesis, Key
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.key.follow_through import Dependence
from graphcam.exercises.marking.marking import mark

FIRST = AskedAnswer("first", "A length.", "integration", reading="v", unit="mm", marks=1.0)
SECOND = AskedAnswer("second", "A length that follows.", "integration", reading="s", unit="mm", marks=2.0)
THIRD = AskedAnswer("third", "Another one.", "integration", reading="s", unit="mm", marks=4.0)


@dataclass
class Rule:
    """How an answer follows from earlier ones."""

    rule: Callable[[Mapping[str, float]], float]
    together: str = "product"
    scatter: float = math.inf

    def expected(self, key: float, own: Mapping[str, float]) -> float:
        return self.rule(own)

    moved = Dependence.moved


def twice(own: Mapping[str, float]) -> float:
    return 2 * own["first"]


def three(
    second: float = 20.0,
    rule: Rule | None = None,
    *,
    unit: str = "mm",
    scatter: float = 0.5,
    **mistakes: list[float],
) -> tuple[Exercise, AnswerKey]:
    """Three answers: 10, and the second and third that follow from it; twice the scatter is right."""
    exercise, answer_key = issued("integration")
    keys = {
        asked.name: Key(Expected(value, scatter), 2 * scatter, 2 * scatter, drawn=True)
        for asked, value in zip((FIRST, SECOND, THIRD), (10.0, second, 40.0), strict=True)
    }
    hypotheses = {name: Hypothesis.of(Expected(each, scatter) for each in values) for name, values in mistakes.items()}
    dependences = {"second": rule or Rule(twice), "third": Rule(lambda own: 2 * own["second"] * own["first"] / 10)}
    return replace(exercise, answers=(FIRST, replace(SECOND, unit=unit), THIRD)), replace(
        answer_key, bound=2.0, keys=keys, hypotheses=hypotheses, dependences=dependences
    )


def outcome(answers: Mapping[str, object], of: tuple[Exercise, AnswerKey], name: str = "second") -> str:
    return outcomes(mark(*of, Answers(answers)))[name]


@pytest.mark.parametrize(
    ("first", "within"),
    [
        # From twice the length follows twice the tolerance, from half the length still a whole one.
        (20.0, 2.0),
        (5.0, 1.0),
        (12.0, 1.2),
    ],
)
def test_the_tolerance_grows_with_the_lengths_and_does_not_shrink_with_them(first, within):
    for side in (-1, 1):
        for share, expected in ((1.0, "follow-through"), (1.001, "wrong")):
            answers = {"first": first, "second": 2 * first + side * share * within}
            assert outcome(answers, three()) == expected


def test_the_tolerance_of_a_short_key_grows_only_from_eight_tolerances_on():
    for share, expected in ((1.0, "follow-through"), (1.001, "wrong")):
        assert outcome({"first": 30.0, "second": 60.0 + 7.5 * share}, three(2.0)) == expected
        assert outcome({"first": 30.0, "second": 60.0 - 7.5 * share}, three(-2.0)) == expected
        # Eight tolerances of a half are four.
        assert outcome({"first": 32.0, "second": 64.0 + 8.0 * share}, three(2.0, scatter=0.25)) == expected


@pytest.mark.parametrize("changed", [{"rule": Rule(twice, "sum")}, {"unit": "deg"}, {"unit": "deg/mm"}])
def test_the_tolerance_of_sums_and_of_angles_does_not_grow(changed):
    of = three(**changed)
    assert outcome({"first": 20.0, "second": 41.0}, of) == "follow-through"
    assert outcome({"first": 20.0, "second": 41.001}, of) == "wrong"


def test_nought_does_not_follow_but_where_the_key_is_nought():
    small = Rule(lambda own: 0.5)
    assert outcome({"first": 20.0, "second": 1.0}, three(rule=small)) == "wrong"
    assert outcome({"first": 20.0, "second": -1.0}, three(rule=Rule(lambda own: -0.5))) == "wrong"
    assert outcome({"first": 20.0, "second": 1.001}, three(rule=small)) == "follow-through"
    assert outcome({"first": 20.0, "second": 1.0}, three(-1.0, small)) == "follow-through"
    assert outcome({"first": 20.0, "second": 1.0}, three(-1.001, small)) == "wrong"


def test_nothing_follows_from_what_cannot_be_drawn():
    assert outcome({"first": 20.0, "second": 40.0}, three(rule=Rule(lambda own: math.nan))) == "wrong"


def test_the_first_wrong_answer_follows_from_nothing():
    # It agrees with an earlier one that is right, but less exactly so.
    answers = {"first": 10.9, "second": 21.8, "third": 43.6}
    assert outcomes(mark(*three(), Answers(answers))) == {
        "first": "right",
        "second": "wrong",
        "third": "follow-through",
    }


def test_what_follows_is_judged_by_the_earlier_answers_as_they_were_given():
    heard: list[dict[str, float]] = []
    rule = Rule(lambda own: heard.append(dict(own)) or 40.0)
    mark(*three(rule=rule), Answers({"first": 20.0, "second": 40.0, "third": 80.0}))
    assert heard == [{"first": 20.0}]


def test_a_slip_earns_all_marks_but_its_own():
    record = mark(*three(), Answers({"first": 20.0, "second": 40.0, "third": 80.0}))
    assert [each.marks for each in record.answers] == [0.0, 2.0, 4.0]
    assert [each.of for each in record.answers] == [1.0, 2.0, 4.0]
    assert (record.total, record.of) == (6.0, 7.0)


def test_a_mistake_costs_where_it_shows_first_and_nothing_after():
    of = three(rule=Rule(lambda own: 0.0), **{"base-circle": [10.0, 35.0, 70.0]})
    answers = {"first": 10.0, "second": 35.0, "third": 71.0}
    assert outcomes(mark(*of, Answers(answers))) == {"first": "right", "second": "wrong", "third": "follow-through"}
    # What the mistake does not bring is a slip of its own.
    assert outcome(answers | {"third": 72.0}, of, "third") == "wrong"


def test_an_answer_that_stands_there_and_cannot_be_read_is_not_a_missing_one():
    given = {"second": "20", "third": np.zeros(2)}
    record = mark(*three(), Answers(given, {"first": "Two numbers."}))
    assert set(outcomes(record).values()) == {"unreadable"}
    assert set(outcomes(mark(*three(), Answers({}))).values()) == {"missing"}
    assert (record.total, [each.given for each in record.answers]) == (0.0, [None] * 3)


def test_what_hands_share_with_their_own_earlier_answers_is_no_tolerance_of_what_follows():
    exact = three(rule=Rule(twice, scatter=0.1))
    for share, expected in ((1.0, "follow-through"), (1.001, "wrong")):
        assert outcome({"first": 20.0, "second": 40.0 + 0.4 * share}, exact) == expected
    # What is known of a hand's error is never less strict than the key.
    assert outcome({"first": 20.0, "second": 42.001}, three(rule=Rule(twice, scatter=5.0))) == "wrong"


@pytest.mark.parametrize(
    ("name", "slip", "factor", "most"),
    [
        ("least-radius-offset", "mu_s", 1.5, 0.03),
        ("least-radius-offset", "v_4", 1.5, 0.03),
        ("integration", "mu_v", 1.5, 0.05),
        ("pressure-angle", "mu_s", 1.5, 0.05),
        ("pressure-angle", "v_4", 1.5, 0.05),
        ("curvature-and-roller", "rho", 2.0, 0.05),
    ],
)
def test_hands_that_go_on_from_one_slip_lose_nothing_else(name: str, slip: str, factor: float, most: float):
    """Of hands that draw all right but take so many times as much once, and everything after from that."""
    exercise, answer_key = issued(name)
    chain = board_chain(Variant(exercise, "Anna", 0, answer_key.parameters).task, exercise.hand.pencil(200, 77))
    columns: dict[str, np.ndarray] = {}
    for asked in exercise.answers:
        value = drawn_answer(chain, asked) * (chain.pencil.stretch_factors if is_length(chain, asked) else 1.0)
        columns[asked.name] = np.round(value * (factor if asked.name == slip else 1.0), asked.decimals)
        if asked.name == slip:
            chain = with_own_answers(chain, asked, columns[slip])
    rows = [dict(zip(columns, map(float, row), strict=True)) for row in zip(*columns.values(), strict=True)]
    found = [outcomes(mark(exercise, answer_key, Answers(row))) for row in rows]
    losing = [any(said == "wrong" for other, said in each.items() if other != slip) for each in found]
    assert all(each[slip] == "wrong" for each in found)
    assert np.mean(losing) <= most


def test_the_roller_of_another_variant_does_not_follow_from_its_radius_of_curvature():
    """Each has a rule of its own: who copies both numbers is paid for neither."""
    exercise, own = issued("curvature-and-roller")
    rho, factor = 1.6 * own.keys["rho"].expected.value, own.parameters["factor"]
    assert isinstance(factor, float)
    for other in set(exercise.parameters["factor"].values) - {factor}:
        copied = Answers({"rho": rho, "roller": float(other) * rho})
        assert outcomes(mark(exercise, own, copied))["roller"] != "follow-through"
    assert outcomes(mark(exercise, own, Answers({"rho": rho, "roller": factor * rho})))["roller"] == "follow-through"

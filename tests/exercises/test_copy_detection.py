"""Who handed in another's variant, and whose wrong numbers are the same: named where chance does not explain it."""

from __future__ import annotations

import csv
import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from statistics import NormalDist

import numpy as np
import pytest
from honest_courses import HonestStudents, honest_students
from issued_variants import SECRET
from over_all import over_all, over_seeds

from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.marking.copy_detection import (
    FALSE_ALARM_RATE,
    AlikePair,
    CourseNumbers,
    alike_pairs,
    chance,
    of_another_variant,
    same_wrong_numbers,
)
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.reports.report_files import GroupNotes, copies_table, write_reports

NAME, STUDENTS = "acceleration-and-scales", 12


@cache
def honest() -> HonestStudents:
    return honest_students(find_exercise(NAME), SECRET, STUDENTS)


def handed_in(course: HonestStudents, k: int, values: dict[str, float]) -> dict:
    return mark(course.exercise, course.answer_keys[f"student {k}"], Answers(values)).to_dict()


def numbers_of(record: dict) -> dict[str, float]:
    return {answer["name"]: answer["given"] for answer in record["answers"]}


def of_keys(given: np.ndarray, keys: np.ndarray, mistaken: np.ndarray | None = None, scatter: float = 0.3):
    """A course (students, answers) of which all off the key is wrong."""
    students, answers = keys.shape
    mistaken = np.empty((students, 0, answers)) if mistaken is None else mistaken
    wrong = np.abs(given - keys) > 3 * scatter
    expected = np.concatenate([keys[:, None], mistaken], axis=1)
    widths = (np.full(expected.shape, scatter), np.full(answers, True))
    return CourseNumbers(given, wrong, np.full(students, 3.0), expected, *widths)


def keys_of(students: int, answers: int = 6) -> np.ndarray:
    return np.random.default_rng(students).uniform(20, 80, (students, answers))


def by_hand(keys: np.ndarray, seed: int = 1) -> np.ndarray:
    return np.round(keys + 0.3 * np.random.default_rng(seed).standard_normal(keys.shape), 1)


@pytest.mark.slow
def test_who_handed_in_anothers_variant_is_named_with_its_owner():
    course = honest()
    records = [each[0] for each in course.careful]
    assert alike_pairs(course.exercise, records, course.answer_keys) == []
    records[3] = handed_in(course, 3, numbers_of(course.careful[2][1]))
    found = alike_pairs(course.exercise, records, course.answer_keys)
    assert [(pair.student, pair.other, pair.kind) for pair in found] == [("student 3", "student 2", "variant")]
    assert 0 < found[0].probability <= FALSE_ALARM_RATE
    wrong = {answer["name"] for answer in records[3]["answers"] if answer["outcome"] == "wrong"}
    assert len(found[0].answers) >= 2
    assert set(found[0].answers) <= wrong


@pytest.mark.slow
def test_the_pair_stands_in_the_table_beside_the_grades_and_on_the_group_page(tmp_path: Path):
    course = honest()
    records = [each[0] for each in course.careful]

    def written(name: str) -> list[str]:
        pairs = alike_pairs(course.exercise, records, course.answer_keys)
        return write_reports(tmp_path / name, course.exercise, records, course.answer_keys, GroupNotes(), pairs)

    names = written("honest.csv")
    assert "honest-copies.csv" in names
    assert (tmp_path / "honest-copies.csv").read_text().count("\n") == 1
    records[3] = handed_in(course, 3, numbers_of(course.careful[2][1]))
    written("copied.csv")
    rows = list(csv.DictReader((tmp_path / "copied-copies.csv").read_text().splitlines()))
    assert [(row["student"], row["other"], row["agrees_in"]) for row in rows] == [("student 3", "student 2", "variant")]
    pages = [(tmp_path / name).read_text() for name in ("honest.html", "copied.html")]
    assert ["fit the other" in page for page in pages] == [False, True]


@pytest.mark.slow
def test_wrong_numbers_taken_over_are_named_once():
    course = honest()
    records = [each[0] for each in course.careful]
    wrong = numbers_of(records[7])
    invented = {name: round(value * 1.37 + 0.0113, 4) for name, value in wrong.items()}
    records[3], records[7] = (handed_in(course, k, invented) for k in (3, 7))
    found = alike_pairs(course.exercise, records, course.answer_keys)
    assert [(pair.student, pair.other, pair.kind) for pair in found] == [("student 3", "student 7", "wrong numbers")]


@pytest.mark.slow
def test_nobody_is_compared_with_who_has_no_key_and_one_alone_with_nobody():
    course = honest()
    record = course.careful[0][0]
    assert alike_pairs(course.exercise, [record], course.answer_keys) == []
    assert alike_pairs(course.exercise, [record, record | {"student": "stranger"}], course.answer_keys) == []
    assert alike_pairs(course.exercise, [], {}) == []


def test_the_same_key_is_no_copy():
    """Two students of one variant who draw carefully, or make one mistake, agree and are not named."""
    keys = keys_of(10)
    keys[1] = keys[0]
    assert of_another_variant(of_keys(by_hand(keys), keys)) == []
    mistaken = keys[:, None] * 0.5
    given = by_hand(keys)
    given[0] = given[1] = np.round(mistaken[0, 0], 1)
    assert same_wrong_numbers(of_keys(given, keys, mistaken)) == []
    # Without the mistake in the catalogue the same digits would be told, so the test can fail.
    assert [(i, j) for i, j, *_ in same_wrong_numbers(of_keys(given + 0.03, keys))] == [(0, 1)]


def test_the_tenth_mistake_counts_as_the_first_does():
    keys = keys_of(10)
    mistaken = keys[:, None] * np.linspace(0.4, 0.6, 10)[None, :, None]
    given = by_hand(keys)
    given[0] = given[1] = np.round(mistaken[0, 9] + 0.03, 2)
    mistaken[1] = mistaken[0]
    assert same_wrong_numbers(of_keys(given, keys, mistaken)) == []
    assert [(i, j) for i, j, *_ in same_wrong_numbers(of_keys(given, keys, mistaken[:, :9]))] == [(0, 1)]


def plain_ratio(numbers: CourseNumbers, i: int, j: int) -> float:
    """How much likelier the numbers of student i are by the key of j than by the own, a number after the other."""
    density, ratio = NormalDist(0, 1).pdf, 1.0
    for a, given in enumerate(numbers.given[i]):
        values, scatter = numbers.expected[:, 0, a], numbers.scatter[:, 0, a]
        by_keys = [density((given - value) / s) / s for value, s in zip(values, scatter, strict=True)]
        by_course = NormalDist(values.mean(), values.std()).pdf(given)
        anywhere = (float(np.mean(by_keys)) + by_course) / 2
        ratio *= max(by_keys[j], anywhere) / max(by_keys[i], anywhere)
    return ratio


def test_who_is_found_far_off_in_the_course_is_as_probable_as_the_formula_says():
    students = 150
    keys = keys_of(students)
    given = by_hand(keys)
    given[3], given[140] = by_hand(keys, 2)[149], by_hand(keys, 3)[5]
    numbers = of_keys(given, keys)
    found = of_another_variant(numbers)
    assert [(i, j) for i, j, *_ in found] == [(3, 149), (140, 5)]
    # Ten for answers that go together; two have wrong numbers.
    for i, j, probability, _ in found:
        assert probability == pytest.approx(10 * 2 * (students - 1) / plain_ratio(numbers, i, j))
    given[3], given[140] = keys[3] * 1.3713, keys[3] * 1.3713
    assert [(i, j) for i, j, *_ in same_wrong_numbers(of_keys(given, keys))] == [(3, 140)]


def test_a_mistake_of_ones_own_that_meets_anothers_key_is_no_copy():
    keys = keys_of(10)
    mistaken = keys[:, None] * 0.5
    mistaken[0, 0] = keys[5]
    given = by_hand(keys)
    given[0] = by_hand(keys, 2)[5]
    assert of_another_variant(of_keys(given, keys, mistaken)) == []
    assert [(i, j) for i, j, *_ in of_another_variant(of_keys(given, keys))] == [(0, 5)]


def test_round_numbers_and_those_that_many_say_prove_little():
    keys = keys_of(40)
    given = by_hand(keys)
    given[:2] = [10.0, 20.0, 30.0, 40.0, 50.0, 60.0]
    assert same_wrong_numbers(of_keys(given, keys)) == []
    given[:2] = [91.37, 92.41, 93.59, 94.13, 95.77, 96.29]
    assert [(i, j) for i, j, *_ in same_wrong_numbers(of_keys(given, keys))] == [(0, 1)]
    given[:20] = given[0]
    assert same_wrong_numbers(of_keys(given, keys)) == []


def test_two_hands_read_the_same_tenth_as_often_as_is_said():
    keys, draw = np.full((2, 1), 50.0), np.random.default_rng(5).standard_normal((2, 200_000))
    a, b = np.round(57.3 + 0.5 * draw, 1)
    numbers = of_keys(np.array([[57.3], [57.3]]), keys, scatter=0.5)
    assert np.mean(a == b) == pytest.approx(float(chance(numbers, 0, np.array([1]))[0, 0]), rel=0.05)


def test_the_more_pairs_the_more_it_takes():
    few, many = keys_of(5), keys_of(300)
    many[:5] = few
    probability = []
    for keys in (few, many):
        given = by_hand(keys) + np.where(np.arange(len(keys)) > 4, 200, 0)[:, None]
        given[:2] = [91.37, 92.41, 93.59, 94.13, 95.77, 96.29]
        probability += [p for i, j, p, _ in same_wrong_numbers(of_keys(given, keys)) if (i, j) == (0, 1)]
    # Of five 2 are wrong, one pair; of three hundred 297.
    assert probability[1] / probability[0] == pytest.approx(297 * 296 / 2)


def test_a_copy_takes_over_half_of_the_wrong_numbers():
    keys = keys_of(5)
    given = by_hand(keys)
    given[0] = [91.37, 92.41, 93.59, 94.13, 95.77, 96.29]
    given[1] = [91.37, 92.41, 93.59, 94.13, 95.77, 17.31]
    numbers = of_keys(given, keys)
    *same, other = chance(numbers, 0, np.array([1]))[0].tolist()
    [(i, j, probability, agreeing)] = same_wrong_numbers(numbers)
    assert (i, j, agreeing.tolist()) == (0, 1, [True] * 5 + [False])
    assert probability == pytest.approx(math.prod(same) / 0.5**5 * (1 - other) / 0.5)


def test_left_out_and_absurd_numbers_name_nobody():
    keys = keys_of(20)
    given = by_hand(keys)
    given[0], given[1], given[2], given[3] = np.nan, 1e15, -1e15, 0.0
    numbers = of_keys(given, keys)
    assert of_another_variant(numbers) == []
    assert same_wrong_numbers(numbers) == []
    assert same_wrong_numbers(replace(numbers, wrong=np.full(keys.shape, False))) == []


def test_the_table_of_pairs_is_safe_and_whole():
    pairs = [AlikePair("=1+1", "b", "variant", ("v", "s"), 2e-5)]
    rows = list(csv.DictReader(copies_table(pairs).splitlines()))
    assert rows == [
        {
            "student": "'=1+1",
            "other": "b",
            "agrees_in": "variant",
            "count": "2",
            "answers": "v s",
            "probability": "2e-05",
        }
    ]


@pytest.mark.slow
@over_all("name", [NAME, "whole-cam"])
@over_seeds(1)
def test_honest_courses_name_nobody(name: str, seed: int):
    """Of 200 courses at most two, as the page says: 1 %."""
    assert honest_students(find_exercise(name), SECRET + bytes([seed % 256]), STUDENTS).alarms(200) <= 2

"""Difficulty, discrimination and reliability of a group's marks, beside what the theory of tests says of them."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest

from graphcam.exercises.reports.item_statistics import cronbach_alpha, item_statistics, variant_groups


def record(marks, of, student="s", given=None, **parameters):
    given = given or [1.0] * len(marks)
    rows = zip(marks, of, given, strict=True)
    answers = [{"name": f"a{k}", "marks": m, "of": o, "given": g} for k, (m, o, g) in enumerate(rows)]
    return {
        "student": student, "answers": answers, "total": sum(marks), "of": sum(of), "parameters": parameters,
    }  # fmt: skip


@pytest.mark.parametrize("items", [2, 4, 6])
def test_alpha_is_the_mean_of_all_split_half_coefficients(items):
    """Cronbach 1951: of all ways to halve a test, the mean of 4 cov(a, b) / var(a + b)."""
    marks = np.random.default_rng(items).normal(size=(40, items)) + np.random.default_rng(9).normal(size=(40, 1))
    halves = []
    for chosen in combinations(range(items), items // 2):
        a = marks[:, list(chosen)].sum(axis=1)
        b = marks.sum(axis=1) - a
        halves.append(4 * np.cov(a, b, bias=True)[0, 1] / np.var(a + b))
    assert cronbach_alpha(marks) == pytest.approx(np.mean(halves), rel=1e-12)


def test_alpha_of_right_or_wrong_is_that_of_kuder_and_richardson():
    """Formula 20 of 1937, k / (k - 1) * (1 - sum p q / variance)."""
    marks = (np.random.default_rng(3).random((50, 7)) < np.linspace(0.2, 0.9, 7)).astype(float)
    p = marks.mean(axis=0)
    kr20 = 7 / 6 * (1 - (p * (1 - p)).sum() / np.var(marks.sum(axis=1)))
    assert cronbach_alpha(marks) == pytest.approx(kr20, rel=1e-12)


def test_alpha_of_too_little_is_not_told():
    assert math.isnan(cronbach_alpha(np.ones((5, 3))))
    assert math.isnan(cronbach_alpha(np.arange(5.0)[:, None]))
    assert math.isnan(cronbach_alpha(np.empty((0, 3))))


def test_every_answer_is_told_with_its_own_marks_and_those_of_the_others():
    rows = [[2, 1, 0], [2, 0, 1], [0, 0, 2], [2, 1, 0]]
    found = item_statistics([record(row, [2, 1, 2], given=[1.0, None, 1.0]) for row in rows])
    marks = np.array(rows, dtype=float)
    assert [each.difficulty for each in found] == [0.75, 0.5, 0.375]
    assert [each.answered for each in found] == [4, 0, 4]
    for k, each in enumerate(found):
        rest = np.delete(marks, k, axis=1)
        assert each.discrimination == pytest.approx(np.corrcoef(marks[:, k], rest.sum(axis=1))[0, 1])
        assert each.alpha_without == pytest.approx(cronbach_alpha(rest), nan_ok=True)


def test_an_answer_that_all_gave_right_tells_nobody_apart():
    found = item_statistics([record([1, m], [1, 1]) for m in (0, 1, 1)])
    assert math.isnan(found[0].discrimination)
    assert item_statistics([]) == []


def test_students_are_grouped_by_the_parameters_of_their_variants():
    made = [(20, "cosine", 0), (30, "cosine", 1), (40, "cycloidal", 2), (50, "cycloidal", 4)]
    records = [record([m], [4], lift=lift, law=law, turns=1) for lift, law, m in made]
    found = variant_groups(records, str)
    told = [(each.parameter, each.values, each.students, each.earned) for each in found]
    assert told == [
        ("lift", "20 … 30", 2, 0.125), ("lift", "40 … 50", 2, 0.75),
        ("law", "cosine", 2, 0.125), ("law", "cycloidal", 2, 0.75),
    ]  # fmt: skip
    assert variant_groups([], str) == []

"""The variants of a course are told apart: nobody earns much with a neighbour's answers."""

from __future__ import annotations

from dataclasses import replace

import pytest
from issued_variants import SECRET, issued

from graphcam.exercises.definition.exercise import Parameter
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.key.key_making import issue
from graphcam.exercises.marking import course_variants as module
from graphcam.exercises.marking.course_variants import course_variants, right_answers, too_near
from graphcam.exercises.marking.marking import mark

NAMES = [f"student {k}" for k in range(10)]


@pytest.mark.slow
def test_nobody_earns_more_than_half_with_the_answers_of_one_before():
    exercise = find_exercise("integration")
    course = [answer_key for _, answer_key in course_variants(exercise, NAMES, SECRET)]
    for k, own in enumerate(course):
        for other in course[:k]:
            for to, copied in ((own, other), (other, own)):
                record = mark(exercise, to, right_answers(copied))
                assert record.total <= record.of / 2


def test_two_that_are_too_near_are_not_issued_one_after_the_other(monkeypatch):
    """Were it not held against those before, the second student would get what the first one got."""
    exercise, secret = find_exercise("integration"), SECRET
    alone = [issue(exercise, name, secret) for name in NAMES[:2]]
    monkeypatch.setattr(module, "too_near", lambda _, one, other: one is alone[1][1] or other is alone[1][1])
    monkeypatch.setattr(module, "issue", lambda _, student, secret: alone[NAMES.index(student)])
    course = list(course_variants(exercise, NAMES[:2], secret))
    assert course[0] == alone[0]
    assert course[1][0].draw > alone[1][0].draw


def test_the_right_answers_are_too_near_to_their_own_key_and_not_to_another():
    exercise, own = issued("integration")
    other = next(iter(course_variants(exercise, ["somebody"], SECRET)))[1]
    assert too_near(exercise, own, own)
    assert not too_near(exercise, own, other)


@pytest.mark.slow
def test_who_is_added_at_the_end_changes_nobodys_variant():
    exercise = find_exercise("acceleration-and-scales")
    few, more = (list(course_variants(exercise, NAMES[:count], SECRET)) for count in (3, 5))
    assert [variant.parameters for variant, _ in few] == [variant.parameters for variant, _ in more[:3]]


@pytest.mark.slow
def test_an_exercise_with_too_few_variants_for_a_course_is_issued_all_the_same(monkeypatch):
    """One parameter with two values: the third student has a variant that somebody has."""
    monkeypatch.setattr(module, "MAX_REDRAWS", 2)
    whole = find_exercise("acceleration-and-scales")
    given = dict(issue(whole, "Anna", SECRET)[0].parameters)
    fixed = {name: Parameter(choices=(value,)) for name, value in given.items()}
    lift = float(given["lift"])
    exercise = replace(whole, parameters=fixed | {"lift": Parameter(choices=(lift, lift + 5))})
    course = list(course_variants(exercise, NAMES[:3], SECRET))
    assert [key.student for _, key in course] == NAMES[:3]
    assert {variant.parameters["lift"] for variant, _ in course} <= {lift, lift + 5}

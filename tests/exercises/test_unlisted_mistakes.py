"""Mistakes that an exercise does not list keep no marks in full, and radii are not those of the text."""

from __future__ import annotations

from dataclasses import replace

import pytest
from issued_variants import SECRET, issued

from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.marks_policy import MarksPolicy
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.key_making import key_or_reason
from graphcam.exercises.key.mistake_separation import perfect_hands
from graphcam.exercises.key.refused_draws import Refusals, RefusedDraw
from graphcam.exercises.key.unlisted_mistakes import UnlistedOutcomes, unlisted_outcomes


def outcomes_of(name: str, bound: float | None = None) -> UnlistedOutcomes:
    """What becomes of the mistakes not listed in the variant that Anna gets."""
    exercise, answer_key = issued(name)
    drawn = perfect_hands(exercise, board_chain(Variant(exercise, "Anna", 0, answer_key.parameters).task))
    keys = [answer_key.keys[asked.name].expected for asked in exercise.answers]
    return unlisted_outcomes(exercise, drawn, keys, bound or answer_key.bound)


@pytest.mark.parametrize("name", ["pressure-angle", "inversion-translating", "differentiation"])
def test_an_issued_variant_lets_no_mistake_keep_all_marks(name):
    found = outcomes_of(name)
    assert len(found.shown) >= 8
    assert not found.too_many
    assert set(found.kept) <= set(found.shown)
    # With tolerances that let everything pass it is counted.
    wide = outcomes_of(name, bound=1e6)
    assert wide.kept == wide.shown == found.shown
    assert wide.too_many


def test_an_exercise_whose_answers_no_law_changes_enough_is_refused_with_mistake_and_reading():
    whole = find_exercise("inversion-translating")
    # One place on the pitch curve, late in the rise: by any law it lies about there.
    asked = tuple(replace(each, station="10") for each in whole.answers if each.name in ("radius_8", "angle_8"))
    exercise = replace(whole, answers=asked, misconceptions=(), alike=(), policy=MarksPolicy())
    _, answer_key = issued("inversion-translating")
    refused = key_or_reason(Variant(exercise, "Anna", 0, answer_key.parameters))
    assert isinstance(refused, RefusedDraw)
    assert {reason.kind for reason in refused.reasons} == {"unlisted"}
    assert refused.always == refused.reasons
    refusals = Refusals(exercise)
    refusals.add(refused)
    told = str(refusals.error())
    assert "is not among the misconceptions, keeps all marks; ask for" in told
    assert SECRET.decode() not in told

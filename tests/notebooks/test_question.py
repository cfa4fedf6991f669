"""The verdicts on a reader's number: hints, never the number."""

from __future__ import annotations

import re

import numpy as np
import pytest
from russian import english_words

import graphcam as gc
from graphcam.drafting.ink import reading
from graphcam.language import language
from graphcam.notebooks.question import Question

RADIUS = Question(43.28, 0.6, "mm", "step 5", {"the pole distance is forgotten": 1731.2})


@pytest.mark.parametrize(
    ("answer", "status", "hint"),
    [
        (None, "open", "Your turn"),
        (43.28, "right", "Right"),
        (43.87, "right", "Right"),
        (44.5, "nearly", "not exact enough"),
        (-43.3, "wrong", "the sign is not"),
        (86.5, "wrong", "twice the value"),
        (21.6, "wrong", "half the value"),
        (43.28 * 57.2958, "wrong", "degrees and radians"),
        (43.28 / 57.2958, "wrong", "radians and degrees"),
        (1731.0, "wrong", "the pole distance is forgotten"),
        (60.0, "wrong", "too large"),
        (30.0, "wrong", "too small"),
        (float("nan"), "wrong", "a finite number"),
    ],
)
def test_a_mistake_gets_its_hint_and_not_the_number(answer, status, hint):
    verdict = RADIUS.check(answer)
    assert (verdict.status, hint in verdict.text) == (status, True)
    assert "43" not in verdict.text
    assert re.search(r"step 5|Your turn|Right|finite", verdict.text)


@pytest.mark.parametrize(
    "factor", [None, 1.0, 1.02, 1.2, 0.8, -1.0, 2.0, 0.5, 57.2958, 1 / 57.2958, float("inf"), "paper"]
)
def test_a_russian_question_answers_in_russian(factor):
    quantity = gc.solve(gc.builtin_task()).comparison.quantities["minimum_prime_radius"]
    question = Question.about(quantity, language("ru").text)
    on_paper = quantity.drawn / quantity.per_mm
    answer = on_paper if factor == "paper" else None if factor is None else factor * quantity.drawn
    said = question.check(answer).text
    assert english_words(said, ("None",)) == set()
    assert re.search("[а-я]{3}", said)


@pytest.mark.parametrize("answer", ["43.28", "43,28", " 43,3 ", "43,28 mm", "+43.28", "4.328e1", np.float64(43.28), 43])
def test_a_text_with_a_number_is_as_good_as_the_number(answer):
    assert RADIUS.check(answer).status == "right"


@pytest.mark.parametrize("answer", ["", "  "])
def test_an_empty_text_is_no_answer_yet(answer):
    assert RADIUS.check(answer) == RADIUS.check(None)


@pytest.mark.parametrize("answer", ["43,28,1", "1,043.28", "forty-three", "43 cm", "43..28", [43.28], "−"])
def test_what_is_no_number_is_told_with_how_to_write_one(answer):
    verdict = RADIUS.check(answer)
    assert verdict.status == "wrong"
    assert f'"{answer}" is not a number; write it like 12.3, in mm.' in verdict.text


def test_a_minus_as_it_is_printed_is_one():
    assert "the sign is not" in RADIUS.check("−43,3").text


@pytest.mark.parametrize("end", ["", ".", "?", "!"])
@pytest.mark.parametrize("answer", [44.5, 60.0, 1731.0, "x"])
def test_a_hint_ends_with_one_stop(end, answer):
    question = Question(43.28, 0.6, "mm", f"step 5{end}", {f"the pole distance is forgotten{end}": 1731.2})
    text = question.check(answer).text
    assert re.search(r"[^.?!][.?!]$", text)
    assert not re.search(r"[.?!][.?!]", text.replace("12.3", ""))


def test_the_questions_of_the_course_end_with_one_stop():
    """Whatever place a notebook names: several of them are questions themselves."""
    assert Question(1.0, 0.1, "mm", "point 3: where does s start?").check(5).text.endswith("where does s start?")


def test_a_reading_gives_scale_unit_and_tolerance():
    question = Question.of(reading(np.array([10.0, 72.0]), 0.6, "mm"), "step 7", at=1)
    assert question.check(43.2 + 0.59).status == "right"
    assert question.check(43.2 + 0.61).status != "right"
    assert "multiply it by the scale" in question.check(72.0).text

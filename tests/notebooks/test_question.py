"""The verdicts on a reader's number: hints, never the number."""

from __future__ import annotations

import re

import numpy as np
import pytest
from over_all import over_all
from russian import english_words

import graphcam as gc
from graphcam.drafting.acts import Kind
from graphcam.drafting.ink import reading
from graphcam.language import language
from graphcam.notebooks import ArrayQuestion, Question, changed, kept_questions
from graphcam.notebooks.question import kept_text

RADIUS = Question(43.28, 0.6, "mm", "step 5", {"the pole distance is forgotten": 1731.2})


@pytest.mark.parametrize(
    ("answer", "status", "hint"),
    [
        (None, "open", "Your turn"),
        (43.28, "right", "Right"),
        (43.87, "right", "Right"),
        (44.3, "nearly", "not exact enough"),
        (-43.3, "wrong", "the sign is not"),
        (86.5, "wrong", "twice the value"),
        (21.6, "wrong", "half the value"),
        (43.28 * 57.2958, "wrong", "degrees and radians"),
        (43.28 / 57.2958, "wrong", "radians and degrees"),
        (1731.0, "wrong", "the pole distance is forgotten"),
        (4.328, "wrong", "a power of ten"),
        (4328, "wrong", "a power of ten"),
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


PLACES = ArrayQuestion(
    np.array([0, 3 + 4j, -2.5]), 1e-3, "the formula", {"that is the mirror image": [0, 3 - 4j, -2.5]}
)


@pytest.mark.parametrize(
    ("answer", "status", "hint"),
    [
        (None, "open", "Your turn"),
        ([0, 3 + 4j, -2.5], "right", "Right"),
        (np.array([0, 3 + 4.0005j, -2.5]), "right", "Right"),
        ((0, 3 - 4j, -2.5), "wrong", "the mirror image"),
        ([0, 3 + 4j, -2.6], "wrong", "value 3 of 3 is the first"),
        ([0, 3 + 4j, float("nan")], "wrong", "value 3 of 3 is the first"),
        ([0, 3 + 4j], "wrong", "the shape (2,), and should have (3,)"),
        (5.0, "wrong", "the shape ()"),
        ([[0, 3 + 4j, -2.5]], "wrong", "the shape (1, 3)"),
        ("by_pole", "wrong", "no array of numbers"),
        ([1, [2, 3]], "wrong", "no array of numbers"),
        (lambda: 0, "wrong", "no array of numbers"),
        (..., "wrong", "no array of numbers"),
    ],
)
def test_lines_of_code_are_judged_by_what_they_give(answer, status, hint):
    (kept,) = kept_questions(kept_text([PLACES]))
    for question in (PLACES, kept):
        verdict = question.check(answer)
        assert (verdict.status, hint in verdict.text) == (status, True)
        assert "2.5" not in verdict.text


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


@pytest.mark.parametrize(
    "answer",
    [
        "43.28",
        "43,28",
        " 43,3 ",
        "43,28 mm",
        "+43.28",
        "4.328e1",
        np.float64(43.28),
        np.int64(43),
        "43.28mm",
        "4.33 cm",
        "4,33cm",
        "0.0433 m",
        "43,3 мм",
        "43.3 mm of paper",
    ],
)
def test_a_text_with_a_number_is_as_good_as_the_number(answer):
    assert RADIUS.check(answer).status == "right"


@pytest.mark.parametrize("answer", ["", "  "])
def test_an_empty_text_is_no_answer_yet(answer):
    assert RADIUS.check(answer) == RADIUS.check(None)


@pytest.mark.parametrize("answer", ["43,28,1", "1,043.28", "forty-three", "43 kg", "43..28", True, [43.28], "−"])
def test_what_is_no_number_is_told_with_how_to_write_one(answer):
    verdict = RADIUS.check(answer)
    assert verdict.status == "wrong"
    assert f'"{answer}" is not a number; write it like 12.3, in mm.' in verdict.text


def test_a_minus_as_it_is_printed_is_one():
    assert "the sign is not" in RADIUS.check("−43,3").text


@pytest.mark.parametrize("end", ["", ".", "?", "!"])
@pytest.mark.parametrize("answer", [44.3, 60.0, 1731.0, "x"])
def test_a_hint_ends_with_one_stop(end, answer):
    question = Question(43.28, 0.6, "mm", f"step 5{end}", {f"the pole distance is forgotten{end}": 1731.2})
    text = question.check(answer).text
    assert re.search(r"[^.?!][.?!]$", text)
    assert not re.search(r"[.?!][.?!]", text.replace("12.3", ""))


def test_the_questions_of_the_course_end_with_one_stop():
    """Whatever place a notebook names: several of them are questions themselves."""
    assert Question(1.0, 0.1, "mm", "point 3: where does s start?").check(5).text.endswith("where does s start?")


@pytest.mark.parametrize("answer", [20.1, "20.1°", "20,1 °", "20.1 deg", "20.1 degrees", "0.351 rad", "20,1 град"])
def test_an_angle_is_read_in_the_units_of_angles(answer):
    assert Question(20.14, 0.1, "degrees", "step 1").check(answer).status == "right"


def test_what_is_calculated_or_counted_is_not_told_of_lines():
    computed, counted = (
        Question(9.0, 0.2, "N", "step 1", found_by="calculation"),
        Question(12, 0.5, "parts", "step 1", found_by="counting"),
    )
    assert [computed.check(x).text for x in (9.1, 9.3)] == [
        "Right.", "Nearly: the method is right, but a figure is not exact enough. Repeat step 1.",
    ]  # fmt: skip
    assert [counted.check(x).text for x in (12, 13)] == ["Right.", "Not yet: that is too large. Look again at step 1."]


def test_the_nearest_mistake_gets_its_hint():
    question = Question(1.351, 0.05, "mm", "step 1", {"nothing is left": 0.0, "the lift is forgotten": 0.045})
    assert [question.check(x).text[9:24] for x in (0.0, 0.02, 0.03, 0.045)] == [
        "nothing is left", "nothing is left", "the lift is for", "the lift is for",
    ]  # fmt: skip


def test_a_mistake_that_would_be_called_right_is_refused():
    with pytest.raises(
        gc.DesignError, match=r"mistake s is forgotten is 19\.54, but must be further from 20\.14 than 0\.7"
    ):
        Question(20.14, 0.7, "degrees", "step 1", {"s is forgotten": 19.54})


def read_by(deviation, bias=0.0):
    def draw(pencil):
        off = pencil.deviation(Kind.ERECT, "across") and deviation * np.linspace(-1, 1, pencil.samples or 1) + bias
        return reading(pencil.sheets(72.0) + off, 0.6, "mm")

    return draw


def test_right_is_what_careful_hands_read_however_they_are_biased():
    question = Question.by(read_by(4.0, bias=-3.0), "step 7", {"that is twenty": 20.0, "hands may read it": 41.0})
    low, high = 0.6 * (72 - 3 - 4), 0.6 * (72 - 3 + 4)
    assert [question.check(x).status for x in (low + 0.1, 43.2, high - 0.1)] == ["right"] * 3
    assert [question.check(x).status for x in (low - 0.3, high + 0.3)] == ["nearly"] * 2
    assert [*question.mistakes.values()] == [72.0, 20.0]


def test_half_a_division_of_the_rule_is_granted_about_the_drawn_and_the_exact_value():
    question = Question.by(read_by(0.0), "step 7", exact=44.0)
    assert [question.check(x).status for x in (42.91, 43.2, 44.0, 44.29)] == ["right"] * 4
    assert [question.check(x).status for x in (42.89, 44.31)] == ["nearly"] * 2


SMOOTH = changed(
    gc.builtin_task(),
    {"motion.phases": tuple(
        changed(phase, {"law": "cycloidal"}) if phase.kind != "dwell" else phase
        for phase in gc.builtin_task().motion.phases
    )},
)  # fmt: skip
TASKS = {
    **{name: gc.builtin_task(name) for name in ("coursework", "arm", "flat", "swinging-face", "measured")},
    "arcs": gc.builtin_arcs_task(),
    "smooth": SMOOTH,
    "small": changed(SMOOTH, {"drawing.format": "A3", "drawing.ordinate": 25.0, "drawing.poles": (20.0, 20.0)}),
    "few parts": changed(SMOOTH, {"drawing.divisions": 6}),
    "anticlockwise": changed(SMOOTH, {"rotation": "ccw", "follower.offset": 10.0}),
    "offset left open": changed(SMOOTH, {"follower.offset": None, "limits.pressure_angle_return": 50.0}),
}


@over_all("name", TASKS)
def test_honest_drawings_are_right_and_mistakes_get_their_hints(name):
    """Of 400 drawings by a pencil of 0.2 mm, 95 % are; the hands that draw here are not those of the tolerance."""
    ideal, hands = gc.solve(TASKS[name]), gc.solve(TASKS[name], gc.Pencil.of(0.2, samples=400, seed=5))
    asked = [quantity for quantity in ideal.comparison.quantities.values() if np.isfinite(quantity.drawn)]
    assert len(asked) > 3
    for quantity in asked:
        question = Question.about(quantity)
        _, (construction, reading_, place), factor = quantity.draw_by_hands.args
        drawn = factor * np.ravel(hands.drawn[construction].readings[reading_].at(place).value)
        right = [question.check(float(x)).status == "right" for x in drawn[np.isfinite(drawn)]]
        assert np.mean(right) >= 0.95, quantity.name
        assert question.check(quantity.drawn).status == "right"
        if np.isfinite(quantity.exact):
            assert question.check(quantity.exact).status == "right"
        for hint, wrong in question.mistakes.items():
            verdict = question.check(wrong)
            assert (verdict.status, hint in verdict.text) == ("wrong", True)

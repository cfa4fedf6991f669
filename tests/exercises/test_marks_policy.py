"""The lecturer's policy: a cap holds, what follows is paid in part, what is near is paid the more the nearer it is."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from issued_variants import SECRET, answer_lines, course_of, issued, key, outcomes
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.errors import DesignError, TaskError
from graphcam.exercises.definition.exercise import Answers, AskedAnswer
from graphcam.exercises.definition.exercise_file import exercise_path, load_exercise
from graphcam.exercises.definition.marks_policy import MarksPolicy
from graphcam.exercises.grading.course_grading import Store
from graphcam.exercises.grading.grade_one import Assignment
from graphcam.exercises.marking.marking import JudgedAnswer, earned, mark
from graphcam.exercises.marking.record import Record
from graphcam.exercises.reports.group_page import group_page

NAME = "inversion-translating"
PARTS = st.floats(0, 1)


def with_offset_sign(policy: MarksPolicy, **changes: object) -> Record:
    """All that a student draws who lays the offset off on the wrong side."""
    exercise, answer_key = issued(NAME)
    pairs = zip(exercise.answers, answer_key.hypotheses["offset-sign"], strict=True)
    given = {asked.name: expected.value for asked, expected in pairs} | changes
    return mark(replace(exercise, policy=policy), answer_key, Answers(given))


def test_a_cap_bounds_the_total_and_scales_every_answer():
    free = with_offset_sign(MarksPolicy())
    capped = with_offset_sign(MarksPolicy(caps={"offset-sign": 0.5}))
    assert free.total > 0.8 * free.of
    assert 0.5 * free.of - 0.01 * len(free.answers) <= capped.total <= 0.5 * free.of
    assert capped.total == sum(answer.marks for answer in capped.answers)
    for a, b in zip(free.answers, capped.answers, strict=True):
        assert b.marks == pytest.approx(a.marks * 0.5 * free.of / free.total, abs=0.01)
        assert a.outcome == b.outcome
    assert capped.without_caps == free.total
    assert capped.feedback[-2:] == (
        "With this mistake a submission earns at most 7 of 14 marks.",
        "To keep within that, the marks of all answers, also of right ones, are reduced in the same proportion.",
    )
    assert not any("at most" in said or "reduced" in said for said in free.feedback)


def test_a_cap_on_another_mistake_takes_nothing():
    assert with_offset_sign(MarksPolicy(caps={"base-circle": 0.0})).total == with_offset_sign(MarksPolicy()).total


def test_what_follows_is_paid_in_part():
    free, half, none = (with_offset_sign(MarksPolicy(follow_through=part)) for part in (1.0, 0.5, 0.0))
    followed = [answer.of for answer in free.answers if answer.outcome == "follow-through"]
    assert followed
    assert free.total - half.total == pytest.approx(0.5 * sum(followed))
    assert free.total - none.total == pytest.approx(sum(followed))
    assert {each.without_follow_through for each in (free, half, none)} == {none.total}
    name = next(answer.name for answer in half.answers if answer.outcome == "follow-through")
    assert any(said.startswith(f"{name}: it follows correctly") and " of " in said for said in half.feedback)


@pytest.mark.parametrize(("tolerances", "marks"), [(0.99, 2.0), (1.5, 1.0), (1.9, 0.2), (2.0, 0.0), (-1.5, 1.0)])
def test_what_is_near_is_paid_the_more_the_nearer_it_is(tolerances, marks):
    exercise, answer_key = issued(NAME)
    # Nothing follows from anything, and no mistake is looked for: the answer stands alone.
    alone = replace(answer_key, dependences={}, hypotheses={})
    value, tolerance = key(answer_key)["radius_8"], answer_key.keys["radius_8"].tolerance
    given = key(answer_key) | {"radius_8": value + (tolerances + 1e-9) * tolerance}
    record = mark(replace(exercise, policy=MarksPolicy(near=2.0)), alone, Answers(given))
    answer = next(one for one in record.answers if one.name == "radius_8")
    assert answer.marks == pytest.approx(marks, abs=0.1 + 1e-9)
    assert outcomes(record)["radius_8"] == ("right" if marks == 2 else "partial" if marks else "wrong")
    assert any(said.startswith("radius_8: your answer is slightly farther off") for said in record.feedback) == (
        0 < marks < 2
    )


def test_a_scribble_through_all_stations_is_not_near():
    exercise, answer_key = issued(NAME)
    pitch = np.asarray(key(answer_key)["pitch"])
    scribble = np.stack([pitch, 1.2 * pitch], axis=1).ravel()
    record = mark(replace(exercise, policy=MarksPolicy(near=3.0)), answer_key, Answers({"pitch": scribble}))
    assert outcomes(record)["pitch"] == "wrong"


@st.composite
def judged_answers(draw: st.DrawFn) -> list[JudgedAnswer]:
    found: list[JudgedAnswer] = []
    for k in range(draw(st.integers(1, 5))):
        asked = AskedAnswer(
            f"a{k}", "A length.", "integration", reading="v", marks=draw(st.sampled_from([0.5, 1.0, 2.0]))
        )
        outcome = draw(st.sampled_from(["right", "follow-through", "wrong", "missing"]))
        off = {"right": st.floats(0, 1), "missing": st.just(float("inf"))}.get(outcome, st.floats(1.001, 8))
        found.append(JudgedAnswer(asked, outcome, draw(off), draw(st.sampled_from([0.0, 0.7]))))
    return found


@given(judged_answers(), PARTS, PARTS)
def test_less_for_what_follows_and_caps_never_pay_more(judged, follow_through, cap):
    plain = earned(MarksPolicy(), judged, ["offset-sign"])
    policy = MarksPolicy(follow_through=follow_through, caps={"offset-sign": cap})
    strict = earned(policy, judged, ["offset-sign"])
    assert all(less <= more for less, more in zip(strict, plain, strict=True))
    whole = sum(each.asked.marks for each in judged)
    assert sum(strict) <= cap * whole + 1e-9
    assert earned(policy, judged, ["offset-sign", "base-circle"]) == earned(replace(policy, caps={}), judged, [])


@given(st.floats(1, 10), st.floats(0, 12), st.floats(0, 12), st.sampled_from([0.5, 1.0, 4.0]))
def test_the_farther_off_the_less_is_earned_and_never_all_beyond_the_tolerance(near, one, other, marks):
    asked = AskedAnswer("a", "A length.", "integration", reading="v", marks=marks)

    def pay(tolerances: float) -> float:
        outcome = "right" if tolerances <= 1 else "wrong"
        return earned(MarksPolicy(near=near), [JudgedAnswer(asked, outcome, tolerances)], [])[0]

    nearer, farther = sorted((one, other))
    assert 0 <= pay(farther) <= pay(nearer) <= marks
    assert pay(farther) < marks or farther <= 1
    assert pay(farther) == 0 or farther < max(near, 1 + 1e-12)


@settings(max_examples=30, deadline=None)
@given(st.lists(st.floats(-6, 6), min_size=6, max_size=6), PARTS, st.floats(1, 4), PARTS)
def test_every_record_adds_up_and_is_paid_no_more_than_without_caps(off, follow_through, near, cap):
    exercise, answer_key = issued("integration")
    numbers = zip(exercise.answers, off, strict=False)
    given = {
        asked.name: key(answer_key)[asked.name] + k * answer_key.keys[asked.name].tolerance for asked, k in numbers
    }
    caps = dict.fromkeys(exercise.misconceptions, cap)
    policy = MarksPolicy(follow_through, near, caps)
    record = mark(replace(exercise, policy=policy), answer_key, Answers(given))
    assert record.total == sum(answer.marks for answer in record.answers) <= record.without_caps + 1e-9
    assert record.without_follow_through <= record.total + 0.01 * len(off) or follow_through == 0
    assert all(0 <= answer.marks <= answer.of for answer in record.answers)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("follow_through = 1.5", "marks.follow_through is 1.5, but must be a part from 0 to 1"),
        ("near = 0.5", "marks.near is 0.5, but must be a number of tolerances, at least 1"),
        ("caps = { end-ordinate = 2 }", "marks.caps.end-ordinate is 2, but must be a part from 0 to 1"),
        ("caps = { end-ordinat = 0.5 }", "did you mean 'end-ordinate'?"),
        ("caps = { base-circle = 0.5 }", "one of the misconceptions of this exercise; known are"),
        ("folow_through = 1", "did you mean 'follow_through'?"),
        ("near = true", "marks.near is true"),
    ],
)
def test_a_wrong_policy_gets_one_message(tmp_path: Path, table: str, message: str):
    path = tmp_path / "mine.toml"
    text = exercise_path("integration").read_text(encoding="utf-8")
    path.write_text(text.replace("[sheet]", f"[marks]\n{table}\n\n[sheet]"), encoding="utf-8")
    with pytest.raises(TaskError) as caught:
        load_exercise(path)
    assert message in str(caught.value)


def test_an_exercise_file_says_its_policy(tmp_path: Path):
    path = tmp_path / "mine.toml"
    text = exercise_path("integration").read_text(encoding="utf-8")
    table = "[marks]\nfollow_through = 0.5\nnear = 2.0\ncaps = { end-ordinate = 0.6 }\n\n[sheet]"
    path.write_text(text.replace("[sheet]", table), encoding="utf-8")
    assert load_exercise(path).policy == MarksPolicy(0.5, 2.0, {"end-ordinate": 0.6})


def test_the_group_page_shows_what_another_policy_would_have_given():
    record = with_offset_sign(MarksPolicy(caps={"offset-sign": 0.5})).to_dict()
    html = group_page(issued(NAME)[0], [record], {})
    for said, name in (("This policy", "total"), ("Without caps on mistakes", "without_caps")):
        assert f'{said}</td><td class="number">{record[name]:.2f}' in html
    assert record["without_caps"] > record["total"]


def test_the_group_page_shows_no_policy_that_pays_everyone_the_same():
    exercise, answer_key = issued(NAME)
    right = mark(exercise, answer_key, Answers(key(answer_key))).to_dict()
    assert "This policy" not in group_page(exercise, [right], {})
    # A cap on another mistake changes nothing; without follow-through this hand-in earns less.
    follows = with_offset_sign(MarksPolicy(caps={"base-circle": 0.5})).to_dict()
    html = group_page(exercise, [right, follows], {})
    assert f'This policy</td><td class="number">{(right["total"] + follows["total"]) / 2:.2f}' in html
    assert "Without follow-through" in html
    assert "Without caps on mistakes" not in html


def test_a_wrong_side_of_the_offset_earns_at_most_six_of_ten_marks():
    exercise, _ = issued(NAME)
    record = with_offset_sign(exercise.policy)
    assert record.total <= 0.6 * record.of + 1e-9 < record.without_caps


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """One student, with the wrong side of the offset."""
    exercise, answer_key = issued("pressure-angle")
    wrong = zip(exercise.answers, answer_key.hypotheses["offset-sign"], strict=True)
    return course_of(
        tmp_path, "pressure-angle", {"Anna": answer_lines({asked.name: each.value for asked, each in wrong})}
    )


def test_the_command_line_changes_the_policy_of_a_course(course: Path):
    order = ["exercise", "grade", str(course), "--secret-file", str(course / "secret"), "--workers", "1", "--out"]
    totals: list[float] = []
    uncapped = ["--cap", "offset-sign=1"]
    for k, options in enumerate(
        (uncapped, ["--follow-through", "0", *uncapped], ["--near", "2", "--cap", "offset-sign=0.1"])
    ):
        out = course / f"{k}.csv"
        done = CliRunner().invoke(app, [*order, str(out), *options])
        assert done.exit_code == 0, done.output
        totals.append(json.loads(out.with_suffix(".json").read_text())[0]["total"])
    assert totals[0] > totals[1]
    assert totals[2] <= 0.1 * issued("pressure-angle")[0].marks
    for wrong in ("offset-sgn=0.1", "offset-sign", "offset-sign=2"):
        done = CliRunner().invoke(app, [*order, str(course / "wrong.csv"), "--cap", wrong])
        assert done.exit_code == 2
        assert not (course / "wrong.csv").exists()


def test_records_of_another_policy_do_not_count_when_a_run_goes_on(tmp_path: Path):
    exercise, _ = issued(NAME)
    policies = [
        MarksPolicy(),
        MarksPolicy(near=2.0),
        MarksPolicy(follow_through=0.5),
        MarksPolicy(caps={"polar-angle": 0}),
    ]
    stores = [
        Store.for_run(tmp_path / "g.csv", Assignment(replace(exercise, policy=each), SECRET)) for each in policies
    ]
    assert len({store.folder for store in stores}) == len(policies)


def test_a_policy_that_cannot_be_is_refused():
    with pytest.raises(DesignError, match="misconceptions of this exercise"):
        replace(issued(NAME)[0], policy=MarksPolicy(caps={"rule-greater": 0.5}))

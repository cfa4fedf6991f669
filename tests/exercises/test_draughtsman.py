"""Every entry of the catalogue of mistakes, drawn a second time by a draughtsman who shares nothing with graphcam."""

from __future__ import annotations

import math
from functools import cache

import pytest
from draughtsman import Asked, GivenCam, Givens, answer
from issued_variants import issued

from graphcam.errors import GraphcamError
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Answers, AskedAnswer, Exercise
from graphcam.exercises.definition.exercise_file import library
from graphcam.exercises.definition.mistakes import CATALOGUE, misconception
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import answers_of
from graphcam.exercises.key.unlisted_mistakes import unlisted_names
from graphcam.exercises.marking.marking import mark

pytestmark = pytest.mark.slow

STUDENTS = ("Anna", "Boris")


def givens(exercise: Exercise, answer_key: AnswerKey) -> Givens | GivenCam:
    """The task as the student reads it, out of its parameters."""
    said = answer_key.parameters
    drawing = exercise.task["drawing"]

    def value(of: object) -> float:
        return float(said[of.strip("{}")]) if isinstance(of, str) else float(of)  # type: ignore[arg-type]

    def number(name: str, otherwise: float = 0.0) -> float:
        return float(said.get(name, otherwise))

    sense = -1 if said.get("rotation") == "cw" else 1
    # Of a cam whose motion is not differentiated no poles are told, and no scale where nothing is asked on paper.
    first, second = drawing.get("poles", (40, 40))
    poles = value(first), value(second)
    if "base" in said:
        offset, (shown, real) = number("offset"), map(float, str(said.get("scale", "1:1")).split(":"))
        sizes = number("base"), number("lift"), math.radians(number("ascent")), number("roller"), offset
        return GivenCam(*sizes, sense, real / shown, poles, held_at=offset, numbered=sense)
    up, down = math.radians(number("limit_up")), math.radians(number("limit_down"))
    return Givens(
        lift=math.radians(number("lift")) if "arm" in said else number("lift"),
        laws=(str(said["law_up"]), str(said["law_down"])),
        angles=(math.radians(number("rise")), math.radians(number("back"))),
        dwell=math.radians(number("dwell")),
        divisions=drawing["divisions"],
        ordinate=value(drawing["ordinate"]),
        poles=poles,
        sense=sense,
        offset=number("offset"),
        prime=number("r0", 60.0),
        roller=number("roller", 10.0),
        limits=(up, down),
        rule=number("factor"),
        arm=number("arm"),
        distance=number("distance"),
    )


def asked_of(one: AskedAnswer) -> Asked:
    return Asked(one.construction, one.reading or one.points, one.station, one.of, one.unit, one.component or "")


@cache
def by_hand(name: str, student: str, mistake: str) -> dict[str, float]:
    """What the draughtsman answers, as asked rounded."""
    exercise, answer_key = issued(name, student)
    given = givens(exercise, answer_key)
    numbers = [one for one in exercise.answers if one.kind == "number"]
    return {one.name: round(answer(given, asked_of(one), mistake), one.decimals) for one in numbers}


@pytest.mark.parametrize("student", STUDENTS)
@pytest.mark.parametrize("name", library())
def test_right_work_of_the_draughtsman_earns_all_marks_of_its_numbers(name: str, student: str):
    exercise, answer_key = issued(name, student)
    record = mark(exercise, answer_key, Answers(by_hand(name, student, "")))
    assert {one.name for one in record.answers if one.outcome == "right"} == set(by_hand(name, student, ""))
    # And two of its own draws are not each other's: it can fail.
    other = mark(exercise, answer_key, Answers(by_hand(name, STUDENTS[student == STUDENTS[0]], "")))
    assert other.total < record.total


@pytest.mark.parametrize("student", STUDENTS)
@pytest.mark.parametrize("name", library())
def test_every_mistake_of_an_exercise_that_the_draughtsman_makes_is_named(name: str, student: str):
    exercise, answer_key = issued(name, student)
    for mistake in exercise.misconceptions:
        given = by_hand(name, student, mistake)
        if mistake == "scale-forgotten: differentiation.v":
            # There the scale itself counts as forgotten too; the value alone is a slip of one answer.
            given = by_hand(name, student, "") | {each: given[each] for each in ("mu_v", "v_3", "mu_a")}
        record = mark(exercise, answer_key, Answers(given))
        assert record.diagnosis is not None, mistake
        assert mistake in (record.diagnosis.misconception, *record.diagnosis.alike), (mistake, record.diagnosis)
        assert record.total < record.of


UNDRAWN_LAWS = ("trapezoidal", "modified-trapezoidal")
"""Laws that the draughtsman does not know."""
AGREEMENT = 0.05
"""Its curves are not faired through stations: in few parts that alone makes up to so much of a value."""


def apart(name: str, mistake: str) -> dict[str, float]:
    """How many tolerances the draughtsman's numbers lie from graphcam's drawing with a mistake, where more than one."""
    exercise, answer_key = issued(name)
    right = board_chain(Variant(exercise, "Anna", answer_key.draw, answer_key.parameters).task)
    found: dict[str, float] = {}
    for asked, drawn in zip(exercise.answers, answers_of(exercise, misconception(mistake).change(right)), strict=True):
        if asked.kind != "number":
            continue
        key = answer_key.keys[asked.name]
        grown = key.tolerance * max(1.0, abs(float(drawn) / float(key.expected.value)))
        off = abs(by_hand(name, "Anna", mistake)[asked.name] - float(drawn)) / max(grown, AGREEMENT * abs(float(drawn)))
        if off > 1:
            found[asked.name] = off
    return found


@pytest.mark.parametrize("name", library())
def test_every_entry_of_the_catalogue_that_can_be_drawn_is_drawn_alike(name: str):
    exercise, _ = issued(name)
    for mistake in (*exercise.misconceptions, *unlisted_names(exercise)):
        if mistake.startswith("scale-forgotten") or mistake.endswith(UNDRAWN_LAWS):
            continue
        try:
            found = apart(name, mistake)
        except (GraphcamError, ValueError):
            continue  # what cannot be drawn here, as an arm about an offset circle
        if mistake.startswith(("ordinates-", "offset-circle")):
            # The draughtsman looks for the sharpest place on the law's own curve, all along it.
            found = {each: off for each, off in found.items() if each not in ("rho", "roller")}
        assert not found, mistake


def test_drawings_of_different_mistakes_lie_apart():
    """Were each compared with another one, it would be told."""
    exercise, answer_key = issued("inversion-translating")
    given = givens(exercise, answer_key)
    asked = {one.name: asked_of(one) for one in exercise.answers if one.kind == "number"}
    right, turned = answer(given, asked["y_8"]), answer(given, asked["y_8"], "rotation-sense")
    assert abs(right - turned) > 3 * answer_key.keys["y_8"].tolerance


def test_the_draughtsman_knows_every_mistake_of_the_catalogue_but_one_of_a_rule_that_no_exercise_gives():
    names = {each.partition(":")[0] for name in library() for each in (*issued(name)[0].misconceptions,)}
    names |= {each.partition(":")[0] for name in library() for each in unlisted_names(issued(name)[0])}
    assert names == set(CATALOGUE)

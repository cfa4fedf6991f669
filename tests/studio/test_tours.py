"""The tours: their views, steps and paths, goals that can be reached and are not at first, answers by solving."""

from __future__ import annotations

import json
import operator
import re
from pathlib import Path

import numpy as np
import pytest
from tour_facts import facts, right_choice, trend

import graphcam as gc
from graphcam.errors import DesignError
from graphcam.language import languages
from graphcam.studio.guesses import step_ids
from graphcam.studio.task_paths import changed_task, value_at
from graphcam.studio.tours import OPERATORS, card_task, extract, goal_of, places_of, texts_of, tours, tours_answer
from graphcam.tasks.task_file import task_of
from graphcam.words import Caption

CARDS = [(tour["task"], card) for tour in tours() for card in tour["cards"]]
NAMES = [f"{tour['id']}-{k}" for tour in tours() for k, _ in enumerate(tour["cards"], 1)]
COMPARED = {"<=": operator.le, ">=": operator.ge, "==": operator.eq, ">": operator.gt, "<": operator.lt}
BEYOND = {">=": 0.0, "<=": 0.0, "==": 0.0, ">": 1.0, "<": -1.0}


def is_reached(goal, task, phi=0.0) -> bool:
    """Whether a size of the task, or the cam angle, has reached a goal; what is open has not."""
    size = phi if goal["path"] == "phi" else value_at(task, goal["path"])
    return size is not None and COMPARED[goal["operator"]](size, goal["value"])


def done(task: dict, goal) -> dict:
    """The task as it is when the goal is reached; the last dwell takes what a phase gains."""
    path, value = goal["path"], goal["value"] + BEYOND[goal["operator"]]
    changes = {path: value}
    if path.startswith("motion.phases[") and path.endswith(".angle"):
        last = len(task["motion"]["phases"]) - 1
        sum_of_others = sum(phase["angle"] for phase in task["motion"]["phases"][:last])
        changes[f"motion.phases[{last}].angle"] = 360 - sum_of_others - value + task["motion"]["phases"][0]["angle"]
    return changed_task(task, changes)


def test_there_are_four_tours_and_more_of_four_to_seven_cards():
    assert len(tours()) >= 4
    assert all(4 <= len(tour["cards"]) <= 7 for tour in tours())
    assert len({tour["id"] for tour in tours()}) == len(tours())


@pytest.mark.parametrize(("built_in", "card"), CARDS, ids=NAMES)
def test_what_a_card_shows_is_drawn(built_in, card):
    solution = gc.solve(task_of("card", card_task(built_in, card)))
    construction = solution.drawn[card["step"].partition("/")[0]]
    views = dict(zip(step_ids(construction), (step.view.name for step in construction.steps()), strict=True))
    assert views[card["step"]] == card["view"]


@pytest.mark.parametrize(("built_in", "card"), CARDS, ids=NAMES)
def test_a_card_is_answered_by_choosing_or_by_doing(built_in, card):
    assert "choices" in card or "goal" in card
    if "choices" in card:
        assert 0 <= card["answer"] < len(card["choices"]) == len(set(card["choices"]))


@pytest.mark.parametrize("card", [card for _, card in CARDS if "choices" in card])
def test_every_wrong_choice_has_a_reason_of_its_own_and_the_right_one_has_none(card):
    reasons = card["wrong"]
    assert len(reasons) == len(card["choices"])
    assert [k for k, reason in enumerate(reasons) if reason is None] == [card["answer"]]
    said = [*filter(None, reasons), card["why"]]
    assert len(set(said)) == len(said)
    assert all(len(reason) > 40 and reason.endswith(".") for reason in filter(None, reasons))


def sign_of_offset(text: str) -> int:
    """The sign before e in the formula of the pressure angle that a text tells."""
    found = re.search(r"tan α = \(v ([+−]) e\)/\(s₀ \+ s\)", text)
    assert found, text
    return {"+": 1, "−": -1}[found[1]]


@pytest.mark.parametrize("rotation", ["cw", "ccw", "of the card"])
def test_the_formula_of_the_pressure_angle_is_that_of_the_task_that_is_shown(rotation):
    told = tours_answer({"language": "en"})["tours"][0]["cards"][0]
    task, why = told["task"], told["why"]
    if rotation != "of the card":
        task = changed_task(task, {"rotation": rotation})
        why = str(Caption(tours()[0]["cards"][0]["why"], places_of(task)))
    cam = gc.solve(task_of("card", task)).cam
    e = task["follower"]["offset"]
    s0 = np.sqrt(cam.prime_radius**2 - e**2)
    found = cam.at(np.radians([10.0, 39.0, 70.0, 100.0, 140.0, 170.0, 250.0]))
    s, v = found.values[:2]
    assert e != 0
    assert np.tan(found.pressure_angle) == pytest.approx((v + sign_of_offset(why) * e) / (s0 + s), rel=1e-9)
    assert f"turns {'clockwise' if task['rotation'] == 'cw' else 'anticlockwise'}:" in why


@pytest.mark.parametrize(("built_in", "card"), [c for c in CARDS if "instead of" in c[1]["ask"]])
def test_what_a_card_asks_to_change_is_the_size_of_its_task(built_in, card):
    found = re.search(r"(\d+)(?:°| mm).* instead of (\d+)(?:°| mm)", card["ask"])
    goal = goal_of(card["goal"])
    assert found
    assert (float(found[1]), float(found[2])) == (goal["value"], value_at(card_task(built_in, card), goal["path"]))


@pytest.mark.parametrize(("built_in", "card"), [c for c in CARDS if "goal" in c[1]])
def test_a_goal_is_not_reached_at_the_start_and_can_be_reached(built_in, card):
    goal, task = goal_of(card["goal"]), card_task(built_in, card)
    assert not is_reached(goal, task, card.get("phi", 0.0))
    if goal["path"] == "phi":
        assert 0 <= goal["value"] < 360
        return
    reached = done(task, goal)
    assert is_reached(goal, reached)
    gc.solve(task_of("card", reached))


@pytest.mark.parametrize(("built_in", "card"), [c for c in CARDS if "rests" in c[1] and "choices" in c[1]])
def test_the_answer_of_a_card_is_right(built_in, card):
    assert right_choice(card_task(built_in, card), card) == card["answer"]


@pytest.mark.parametrize(("built_in", "card"), [c for c in CARDS if "rests" in c[1] and "choices" not in c[1]])
def test_what_is_to_be_done_without_a_question_changes_what_the_card_rests_on(built_in, card):
    assert trend(card_task(built_in, card), card["rests"]) != 0


def test_the_check_of_answers_can_fail():
    card = next(card for _, card in CARDS if card["goal" if "goal" in card else "ask"] == "follower.offset >= 0")
    wrong = {**card, "rests": {"quantity": "minimum_prime_radius", "with": {"follower.offset": -12.0}}}
    assert right_choice(card_task("coursework", card), wrong) != card["answer"]


def test_an_undercut_that_a_card_speaks_of_is_there_and_its_remedy_helps():
    spoiled, saved = (
        card
        for _, card in CARDS
        if card.get("rests", {}).get("quantity") == "undercuts" and "follower.roller_radius" in card.get("changes", {})
    )
    task = card_task("coursework", spoiled)
    assert facts(task)["undercuts"] == 0 < facts(done(task, goal_of(spoiled["goal"])))["undercuts"]
    task = card_task("coursework", saved)
    assert facts(task)["undercuts"] > 0 == facts(done(task, goal_of(saved["goal"])))["undercuts"]


def test_the_scales_follow_from_one_another_as_the_cards_say():
    task = gc.builtin_task().to_dict()
    found, (first, second) = facts(task), task["drawing"]["poles"]
    mu_phi = gc.solve(gc.builtin_task()).chain.board.mu_phi.per_mm
    assert found["mu_v"] == pytest.approx(first * found["mu_a"] * mu_phi)
    assert found["mu_s"] == pytest.approx(second * found["mu_v"] * mu_phi)


def test_the_page_gets_every_text_and_no_rest():
    told = tours_answer({"language": "en"})["tours"]
    assert [tour["title"] for tour in told] == [tour["title"] for tour in tours()]
    assert not any("rests" in card for tour in told for card in tour["cards"])
    json.dumps(told, allow_nan=False)


@pytest.mark.parametrize("name", languages())
def test_every_place_of_a_text_is_filled_in_every_language(name):
    told = list(texts_of(tours_answer({"language": name})["tours"]))
    assert len(told) == len(list(texts_of(tours())))
    assert not [text for text in told if "{" in text]


def test_every_text_is_found_by_the_tools_of_gettext():
    path = Path(gc.__file__).parent / "data" / "studio" / "tours.json"
    with path.open("rb") as file:
        found = {text for _, _, text, _ in extract(file, (), (), {})}
    assert found == set(texts_of(json.loads(path.read_text(encoding="utf-8"))))


@pytest.mark.parametrize("text", ["phi", "phi >= x", "phi >= 1; 2", "a..b > 1", "open('x') > 1", "", "phi => 3"])
def test_a_goal_that_is_none_is_refused(text):
    with pytest.raises(DesignError, match=r"goal|path"):
        goal_of(text)


def test_every_goal_has_one_of_the_operators_of_the_page():
    assert set(OPERATORS) == set(BEYOND) == set(COMPARED)
    assert goal_of(" phi>=-4.5 ") == {"path": "phi", "operator": ">=", "value": -4.5}

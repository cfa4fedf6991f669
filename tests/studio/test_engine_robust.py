"""Whatever is asked, an answer comes: a picture, or an error with a field and a message, in strict JSON."""

import json
import os

import pytest
from random_requests import random_request
from studio_tasks import plain_task

from graphcam.studio.engine import answer
from graphcam.studio.task_paths import changed_task

MANY = int(os.environ.get("GRAPHCAM_RANDOM_REQUESTS", "200"))
"""So many are asked by the slow test; ten thousand take a quarter of an hour of the processor."""


def check(seed):
    request = random_request(seed)
    found = answer(request)
    json.dumps(found, allow_nan=False)
    assert found["seq"] in (seed, None, request["seq"])
    if not found["ok"]:
        assert isinstance(found["error"]["field"], str)
        assert found["error"]["message"]
    return found["ok"]


def test_a_view_larger_than_any_sheet_is_an_error_at_once():
    """Hatching alone would have a line for every three millimetres of it."""
    request = {"task": plain_task("coursework"), "views": [{"name": "combined", "px_per_mm": 4}]}
    request["task"]["cam"] = {"prime_radius": 1e9}
    error = answer(request)["error"]
    assert "at most 2000 mm wide and high" in error["message"]
    # The page puts the two together.
    assert error["remedy"] not in error["message"]
    found = answer({**request, "views": [{"name": "profile", "px_per_mm": 4}]})
    assert found["ok"]
    # It is not offered either.
    assert {"combined", "profile"} - {view["name"] for view in found["names"]} == {"combined"}


def test_an_angle_that_is_too_small_to_be_seen_is_drawn_once_round():
    """The tails of its arc went round it millions of times, and took all memory."""
    task = changed_task(plain_task("coursework"), {"follower": {"kind": "oscillating", "arm": 1e9, "lift": "arc"}})
    request = {"task": changed_task(task, {"cam": {}, "limits": {"rest": False}}), "views": []}
    names = [view["name"] for view in answer(request)["names"]]
    found = answer({**request, "views": [{"name": "plan", "px_per_mm": 1.0}]})
    assert "plan" in names
    assert len(json.dumps(found["views"])) < 1e5


def test_random_requests_are_answered():
    assert 0.1 * 40 < sum(check(seed) for seed in range(40)) < 0.95 * 40


@pytest.mark.slow
def test_hundreds_of_random_requests_are_answered():
    assert 0.2 * MANY < sum(check(seed) for seed in range(1000, 1000 + MANY)) < 0.95 * MANY


@pytest.mark.parametrize("ask", ["task_file", "open", "sweep", "nothing", 3, [], {}])
def test_other_questions_are_answered_too(ask):
    for seed in range(4):
        found = answer({**random_request(seed), "ask": ask, "text": str(random_request(seed)["task"])})
        json.dumps(found, allow_nan=False)
        assert found["ok"] or found["error"]["message"]


def test_an_arm_whose_arcs_miss_each_other_is_told_beside_its_prime_radius():
    """Beside a flat triangle no cam centre is found on the paper: an error, not a failure of the program."""
    arm = {"follower.arm": 12.5, "follower.distance": 150.0, "follower.roller_radius": 0.0}
    small = {"motion.phases[0].lift": 5, "motion.phases[2].lift": 5, "limits.pressure_angle_rise": 80}
    for radius, drawn in ((137.55, False), (139.0, True)):
        task = changed_task(plain_task("arm"), {**arm, **small, "cam.prime_radius": radius})
        told = answer({"task": task, "views": []})
        assert told["ok"] is answer({"task": task, "views": [], "told": True})["ok"] is drawn
        assert drawn or told["error"]["field"] == "cam.prime_radius"


@pytest.mark.parametrize("radius", [60.0, 2000.0, 1e9])
@pytest.mark.parametrize("name", ["coursework", "flat", "measured"])
def test_every_view_that_is_offered_can_be_drawn(name, radius):
    """A cam centre that is too far away for the diagram of the region, whose ordinate the task gives."""
    task = changed_task(plain_task(name), {"cam.prime_radius": radius, "drawing.ordinate": 50.0})
    names = [each["name"] for each in answer({"task": task})["names"]]
    refused = [each for each in names if not answer({"task": task, "views": [{"name": each}]})["ok"]]
    assert refused == []
    assert radius == 2000 or ("combined" in names) == (radius == 60)

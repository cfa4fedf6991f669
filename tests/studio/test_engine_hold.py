"""While the hand is down the picture stays: frame, scales, labels; and only what is shown is drawn."""

import itertools
import math

import pytest
from asking import ask, moved, view_names
from over_all import fast_first, over_all
from studio_tasks import plain_task

from graphcam.sheets.labels import MAX_HOP
from graphcam.studio.engine import answer

STEP = {"offset": 0.25, "prime radius": 0.25, "phase border": 0.5, "lift": 0.1}
"""How far a hand moves between two pictures [mm or degrees]."""
DRAGS = [("coursework", "offset"), ("coursework", "phase border"), ("arm", "prime radius"), ("flat", "lift")]
DRAGS += [("measured", "prime radius")]
"""Each follower, and each size that can be moved."""


def dragged(name, what, view, count=3):
    """The answers of a drag, the first at rest."""
    found = [ask(moved(name, what, 0.0), view)]
    for k in range(1, count + 1):
        found.append(ask(moved(name, what, k * STEP[what]), view, hold=found[-1]["hold"]))
    return found


@pytest.mark.slow
@over_all(("name", "what"), DRAGS)
def test_frame_and_labels_stay_while_a_size_is_moved(name, what):
    for view in view_names(name):
        answers = dragged(name, what, view)
        assert len({tuple(each["views"][0]["frame"]) for each in answers}) == 1
        places = [each["hold"]["views"][view]["labels"] for each in answers]
        for before, after in itertools.pairwise(places):
            assert before.keys() == after.keys()
            for label, (x, y, _) in before.items():
                assert math.dist((x, y), after[label][:2]) <= MAX_HOP + 0.01, (view, label)


@pytest.mark.slow
@over_all(("name", "what"), DRAGS)
def test_scales_stay_while_a_size_is_moved_and_without_hold_they_go(name, what):
    far = 25 * STEP[what]
    first = ask(moved(name, what, 0.0), "profile")
    held = ask(moved(name, what, far), told=True, hold=first["hold"])
    assert held["hold"]["scales"] == first["hold"]["scales"]
    titles = {each["name"]: each["title"] for each in first["names"]}
    # Asked for with all that is told, every construction is drawn, so that all titles say what was drawn.
    for view in titles:
        drawn = ask(moved(name, what, far), view, told=True, hold=first["hold"])["views"][0]
        assert drawn["title"] == titles[view]


def test_with_a_fixed_ordinate_the_scales_would_go():
    """What the held ordinate is good for: at 60 degrees for 80 the acceleration is drawn at nearly twice the scale."""
    wide, narrow = (ask(moved("coursework", "phase border", way))["scales"]["a"]["per_mm"] for way in (0.0, -20.0))
    assert narrow / wide == pytest.approx((80 / 60) ** 2, rel=1e-9)


def test_an_ordinate_that_is_moved_itself_is_not_held():
    task, hold = plain_task("coursework"), ask(plain_task("coursework"), "acceleration")["hold"]
    task["drawing"]["ordinate"] = 60.0
    free, held = (ask(task, "acceleration", told=True, hold=each)["views"][0] for each in (None, hold))
    assert held["title"] == free["title"]


def test_the_profile_scale_is_held_beyond_the_radius_at_which_it_would_change():
    small, large = (moved("coursework", "prime radius", way) for way in (0.0, 16.0))
    hold = ask(small, "profile")["hold"]
    assert "1:1" in ask(large, "profile")["views"][0]["title"]
    assert "2:1" in ask(large, "profile", hold=hold)["views"][0]["title"]


def test_a_label_that_would_hop_is_left_out_and_a_new_one_waits():
    at_rest = ask(plain_task("coursework"), "profile")
    hold, labels = at_rest["hold"], at_rest["hold"]["views"]["profile"]["labels"]
    label, (x, y, angle) = next(iter(labels.items()))
    hold["views"]["profile"]["labels"] = {**labels, label: [x + 300.0, y, angle]}
    gone = next(each for each in labels if each.endswith("|7|1"))
    del hold["views"]["profile"]["labels"][gone]
    count = sum(step["svg"].count("<text") for step in at_rest["views"][0]["steps"].values())
    held = ask(plain_task("coursework"), "profile", hold=hold)
    assert sum(step["svg"].count("<text") for step in held["views"][0]["steps"].values()) == count - 2
    assert gone not in held["hold"]["views"]["profile"]["labels"]


@pytest.mark.parametrize("name", fast_first(["coursework", "arcs", "arm", "flat", "measured"], 2))
def test_only_the_constructions_of_the_view_are_drawn_and_nothing_comes_out_otherwise(name):
    """A held view of an unchanged task has the lines of the free one."""
    for view in view_names(name):
        free = ask(plain_task(name), view)
        held = ask(plain_task(name), view, hold=free["hold"])
        steps = [{key: step["hash"] for key, step in each["views"][0]["steps"].items()} for each in (free, held)]
        assert list(steps[0]) == list(steps[1])
        same = [key for key in steps[0] if steps[0][key] == steps[1][key]]
        assert len(same) >= len(steps[0]) / 2, view


def test_steps_that_the_page_has_come_back_as_their_hash():
    task = plain_task("coursework")
    first = ask(task, "combined")["views"][0]["steps"]
    have = {key: step["hash"] for key, step in first.items()}
    same = answer({"task": task, "views": [{"name": "combined", "px_per_mm": 1.9, "have": have}]})["views"][0]
    assert not any("svg" in step for step in same["steps"].values())
    moved_on = moved("coursework", "offset", 1.0)
    new = answer({"task": moved_on, "views": [{"name": "combined", "px_per_mm": 1.9, "have": have}]})["views"][0]
    assert 0 < sum("svg" in step for step in new["steps"].values()) < len(have) + 1


@pytest.mark.parametrize(
    "hold", [{}, {"scales": 3}, {"scales": {"profile": "x"}, "diagrams": None, "views": {}, "names": []}, {"a": [1]}]
)
def test_a_hold_that_no_answer_left_is_an_error(hold):
    found = answer({"task": plain_task("coursework"), "views": [], "hold": hold})
    assert found["ok"] or found["error"]["field"] == "hold"

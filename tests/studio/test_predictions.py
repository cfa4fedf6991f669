"""What is foretold, against the construction and the exact cam; guesses, reasons, and tasks by a seed."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import graphcam as gc
from graphcam.studio.engine import answer
from graphcam.studio.guesses import nearest_on_polyline, step_ids
from graphcam.studio.predictions import SEEDED_TASKS, seeded_task
from graphcam.tasks.task_file import task_of

KINDS = {
    "coursework": ["centre", "angle", "steepest", "sharpest"],
    "arm": ["centre", "steepest", "sharpest"],
    "flat": ["centre", "sharpest"],
    "measured": ["centre", "angle", "steepest", "sharpest"],
}
ASKED = [(name, kind) for name in ("coursework", "arm", "flat") for kind in KINDS[name]]


def ask(name: str, kind: str | None = None, **more) -> dict:
    task = gc.builtin_task(name).to_dict()
    found = answer({"ask": "predict", "task": task, **({"kind": kind} if kind else {}), **more})
    assert found["ok"], found
    json.dumps(found, allow_nan=False)
    return found


def solved(name: str):
    return gc.solve(gc.builtin_task(name))


@pytest.mark.parametrize("name", ["coursework", "arm", "flat"])
def test_each_follower_has_the_questions_that_apply(name):
    assert [each["kind"] for each in ask(name)["kinds"]] == KINDS[name]


@pytest.mark.parametrize(("name", "kind"), ASKED)
def test_what_is_given_does_not_hold_what_is_asked(name, kind):
    asked, drawn = ask(name, kind), solved(name).drawn
    views = {
        step_id: step.view.name
        for construction in drawn.values()
        for step_id, step in zip(step_ids(construction), construction.steps(), strict=True)
    }
    assert asked["given"]
    assert {views[step] for step in asked["given"]} == {asked["view"]}
    assert all(views[each["step"]] == each["view"] for each in asked["construct"])
    assert not {each["step"] for each in asked["construct"]} & set(asked["given"])
    assert "judged" not in asked


@pytest.mark.parametrize(("name", "kind"), ASKED)
def test_the_answer_itself_is_a_right_guess(name, kind):
    asked = ask(name, kind)
    first = ask(name, kind, guess=asked["start"])["judged"]
    assert first["paper"] > 5
    place = first["at"][asked["view"]]["answer"]
    again = ask(name, kind, guess=place)["judged"]
    assert again["paper"] < 0.05
    assert again["said"] != first["said"]


def test_the_centre_lies_where_the_least_radius_is_drawn():
    judged = ask("coursework", "centre", guess=[0, 100])["judged"]
    x, y = judged["at"]["combined"]["answer"]
    centre = complex(solved("coursework").drawn["minimum_radius"].first("centre"))
    assert complex(x, -y) == pytest.approx(centre, abs=1e-3)
    # The guess is taken to the line of the offset first.
    assert judged["at"]["combined"]["guess"] == pytest.approx([x, 100.0])


@pytest.mark.parametrize(
    ("name", "far", "near"), [("coursework", [16.7, 120], [16.7, 40]), ("flat", [0, 120], [0, 30])]
)
def test_the_difference_has_the_sign_of_the_radius(name, far, near):
    drawn = solved(name).drawn["minimum_radius"]
    least, mu = float(drawn.value("prime_radius")), drawn.readings["prime_radius"].per_mm
    for guess, sign in ((far, 1), (near, -1)):
        judged = ask(name, "centre", guess=guess)["judged"]
        assert np.sign(judged["machine"]) == sign
        radius = math.hypot(*judged["at"]["combined"]["guess"]) * mu
        assert judged["machine"] == pytest.approx(radius - least, abs=1e-3)


def test_the_reason_names_the_pressure_angle_of_that_centre():
    judged = ask("coursework", "centre", guess=[16.667, 40])["judged"]
    radius = math.hypot(16.667, 40) * 0.6
    task = gc.builtin_task().to_dict()
    task["cam"]["prime_radius"], task["follower"]["roller_radius"] = radius, 5.0
    there = math.degrees(gc.solve(task_of("there", task)).cam.extremes().pressure_angle_rise[0])
    assert f"{there:.1f}°" in judged["why"]
    assert "more than the 30.0°" in judged["why"]


def test_from_below_all_limits_are_kept_but_the_cam_is_too_large():
    assert "all limits are satisfied" in ask("coursework", "centre", guess=[16.667, 110])["judged"]["why"]


@pytest.mark.parametrize(
    ("rho", "said"), [(-3.0, "inside out"), (4.0, "8 mm is the permitted minimum"), (20.0, "enough")]
)
def test_under_a_flat_face_the_reason_is_the_radius_of_curvature(rho, said):
    region = solved("flat").drawn["minimum_radius"]
    need, mu = float(region.value("need")), region.readings["need"].per_mm
    why = ask("flat", "centre", guess=[0, (need + rho) / mu])["judged"]["why"]
    assert said in why
    assert f"{rho:.1f} mm".replace("-", "−") in why


def test_the_ray_leans_by_the_greatest_angle_that_is_measured():
    upright = ask("coursework", "angle")["start"]
    judged, drawn = ask("coursework", "angle", guess=upright)["judged"], solved("coursework").drawn
    pole = np.array([16.667, -complex(drawn["pressure_angle"].first("centre")).imag])
    x, y = np.array(judged["at"]["combined"]["answer"]) - pole
    greatest = math.degrees(float(drawn["pressure_angle"].first("alpha").max()))
    assert math.degrees(math.atan2(x, -y)) == pytest.approx(greatest, abs=1e-2)
    assert judged["machine"] == pytest.approx(-greatest, abs=1e-2)


@pytest.mark.parametrize("name", ["coursework", "arm"])
def test_the_steepest_place_is_that_of_the_exact_cam(name):
    asked = ask(name, "steepest")
    judged = ask(name, "steepest", guess=asked["start"])["judged"]
    _, phi = solved(name).cam.extremes().pressure_angle_rise
    x, _ = judged["at"]["velocity"]["answer"]
    assert x == pytest.approx(math.degrees(phi), abs=1.5)
    assert judged["at"]["angle"]["answer"] == [x, 0.0]


@pytest.mark.parametrize("name", ["coursework", "arm", "flat"])
def test_no_place_of_the_curve_is_sharper_than_the_sharpest(name):
    solution = solved(name)
    judged = ask(name, "sharpest", guess=ask(name, "sharpest")["start"])["judged"]
    x, y = judged["at"]["profile"]["answer"]
    phi = np.linspace(0, 2 * math.pi, 7201)
    curve = solution.cam.pitch_curve(phi) / solution.drawn["inversion"].readings["radius"].per_mm
    curvature = solution.cam.pitch_curvature(phi)
    here = np.argmin(np.hypot(curve[:, 0] - x, curve[:, 1] + y))
    # A jump of the acceleration has the sharper side on either hand.
    assert max(curvature[here - 20 : here + 21]) == pytest.approx(curvature.max(), rel=0.02)


@given(
    st.floats(-300, 300), st.floats(-300, 300), st.lists(st.complex_numbers(max_magnitude=200), min_size=2, max_size=8)
)
def test_the_foot_of_a_guess_is_nearer_than_every_corner(x, y, way):
    foot = nearest_on_polyline(np.array(way), complex(x, y))
    assert abs(foot - complex(x, y)) <= min(abs(corner - complex(x, y)) for corner in way) + 1e-6


@settings(max_examples=12, deadline=None)
@given(st.sampled_from(sorted(SEEDED_TASKS)), st.integers(0, 10**9))
def test_every_seed_gives_a_task_that_can_be_foretold(follower, seed):
    task = gc.builtin_task(SEEDED_TASKS[follower][0]).to_dict()
    found = answer({"ask": "predict", "task": task, "seed": seed})
    assert found["ok"], found
    assert found["task"] == seeded_task(follower, seed)
    assert found["task"]["follower"]["kind"] == follower
    judged = answer({"ask": "predict", "task": found["task"], "guess": found["start"]})["judged"]
    place = judged["at"][found["view"]]["answer"]
    assert answer({"ask": "predict", "task": found["task"], "guess": place})["judged"]["paper"] < 0.05


def test_seeds_give_tasks_that_differ():
    tasks = [json.dumps(seeded_task("translating", seed)) for seed in range(50)]
    assert len(set(tasks)) == 50


def test_a_measured_motion_and_an_open_offset_can_be_foretold():
    task = gc.builtin_task().to_dict()
    del task["follower"]["offset"]
    found = answer({"ask": "predict", "task": task, "guess": [30.0, 60.0]})
    assert found["ok"]
    assert found["free"]
    assert found["judged"]["at"]["combined"]["guess"] == [30.0, 60.0]


@pytest.mark.parametrize(
    ("more", "field"),
    [
        ({"kind": "colour"}, "kind"),
        ({"guess": [1]}, "guess"),
        ({"guess": [1, None]}, "guess"),
        ({"guess": [1, "a"]}, "guess"),
        ({"seed": -1}, "seed"),
        ({"task": gc.builtin_arcs_task().to_dict()}, "task"),
    ],
)
def test_a_senseless_request_is_refused_by_field(more, field):
    found = answer({"ask": "predict", "task": gc.builtin_task().to_dict(), **more})
    assert not found["ok"]
    assert found["error"]["field"] == field


def test_it_speaks_russian_where_it_is_translated():
    found = answer({"ask": "predict", "task": gc.builtin_task().to_dict(), "language": "ru", "guess": [16.7, 100]})
    assert found["judged"]["paper_said"].partition(" ")[0].count(",") == 1

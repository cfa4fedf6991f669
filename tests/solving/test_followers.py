"""Arms and flat faces through the main job: the task files that come with graphcam, solved and told as plain data."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from functools import cache
from importlib.resources import files

import numpy as np
import pytest

import graphcam as gc
from graphcam.comparison.quantities import COMMON_QUANTITIES
from graphcam.report.sheet_data import data
from graphcam.tasks.task import CamTable, LimitsTable, OscillatingTable

TASKS = ("arm", "flat", "swinging-face")
KINDS = {"arm": "oscillating", "flat": "flat-faced", "swinging-face": "oscillating-flat"}
KEYS = {"graphcam", "task", "cam", "scales", "quantities", "stations", "files"}
each_task = pytest.mark.parametrize("name", TASKS)


def task_of(name: str) -> gc.Task:
    return gc.load_task(str(files("graphcam") / "data" / "tasks" / f"{name}.toml"))


@cache
def solution_of(name: str) -> gc.Solution:
    return gc.solve(task_of(name))


@cache
def told(name: str) -> dict:
    return solution_of(name).to_dict()


@each_task
def test_the_solution_is_strict_json_with_all_its_keys(name):
    text = json.dumps(told(name), allow_nan=False)
    again = json.loads(text)
    assert set(again) >= KEYS
    assert set(again["quantities"]) >= set(COMMON_QUANTITIES)
    assert again["task"]["follower"]["kind"] == KINDS[name]
    for quantity in again["quantities"].values():
        assert set(quantity) == {"drawn", "exact", "unit", "error", "error_paper", "tolerance_paper"}
    for station in again["stations"]:
        assert set(station) == {
            *("phi_deg", "phase", "s", "v", "a", "pressure_angle_deg", "transmission_angle_deg", "pitch")
        }


@each_task
def test_the_same_task_is_solved_to_the_same_digits(name):
    assert gc.solve(task_of(name)).to_dict() == told(name)


def test_sizes_are_told_by_the_names_that_the_follower_has():
    sizes = {"prime_radius": 61.0, "arm": 125.0, "distance": 150.0, "roller_radius": 15.0, "rotation": "ccw"}
    assert told("arm")["cam"] == sizes
    flat = told("flat")["cam"]
    assert flat["prime_radius"] == math.ceil(gc.minimum_radius(
        solution_of("flat").cam.motion, gc.FlatFaced(), curvature=8.0).prime_radius)  # fmt: skip
    assert "distance" not in flat
    face = told("swinging-face")["cam"]
    assert {key: face[key] for key in ("distance", "face_offset", "rotation")} == {
        "distance": 120.0, "face_offset": 10.0, "rotation": "ccw"
    }  # fmt: skip
    assert {key for key, value in flat.items() if value is not None} >= {"prime_radius", "rotation"}


def test_an_arm_is_told_in_degrees_and_its_velocities_per_radian():
    scales, stations = told("arm")["scales"], told("arm")["stations"]
    assert [scales[key]["unit"] for key in ("phi", "s", "v", "a")] == ["deg", "deg", "rad/rad", "rad/rad²"]
    solution = solution_of("arm")
    assert scales["s"]["per_mm"] == pytest.approx(
        math.degrees(float(solution.drawn["integration"].readings["s"].scale)), rel=1e-14
    )
    top = max(stations, key=lambda station: station["s"]["exact"])
    assert top["s"]["exact"] == pytest.approx(15.0, rel=1e-12)
    assert top["s"]["drawn"] == pytest.approx(15.0, rel=1e-12)
    assert top["phi_deg"] == pytest.approx(75)
    fastest = max(station["v"]["exact"] for station in stations)
    assert fastest == pytest.approx(2 * 15 / 75, rel=1e-12)  # v_max = 2 h/F
    assert told("arm")["quantities"]["max_v"]["exact"] == pytest.approx(0.4, rel=1e-12)


def test_the_published_angle_of_the_arm_stands_in_the_solution():
    """The case arm: 31.00 degrees for cam and arm turning in opposite senses, -34.82 in the same."""
    rise = told("arm")["quantities"]["max_pressure_angle_rise_deg"]
    assert rise["exact"] == pytest.approx(31.00, abs=0.005)
    assert rise["drawn"] == pytest.approx(31.00, abs=0.005)
    same = gc.solve(replace(task_of("arm"), rotation="cw")).to_dict()["quantities"]["max_pressure_angle_rise_deg"]
    assert [same["exact"], same["drawn"]] == pytest.approx([-34.82] * 2, abs=0.005)


def test_values_that_a_follower_does_not_have_are_null():
    arm, flat = told("arm")["quantities"], told("flat")["quantities"]
    for quantity in (arm["minimum_offset"], *(flat[key] for key in NOT_OF_A_FLAT_FACE)):
        assert [quantity[key] for key in ("drawn", "exact", "error", "error_paper", "tolerance_paper")] == [None] * 5
    assert "minimum_distance" in arm
    assert "minimum_distance" not in flat
    assert "face_left" not in arm
    for station in told("flat")["stations"]:
        assert station["pressure_angle_deg"] == {"drawn": None, "exact": None}


NOT_OF_A_FLAT_FACE = (
    "minimum_offset", "max_pressure_angle_rise_deg", "max_pressure_angle_return_deg", "roller_radius",
)  # fmt: skip


def test_the_computed_case_of_the_flat_face_stands_in_the_solution():
    """The case flat: cusp radius 11.753 mm, half-width 26.857 mm; the task permits 8 mm at the sharpest place."""
    quantities = told("flat")["quantities"]
    assert quantities["minimum_prime_radius"]["exact"] == pytest.approx(19.752953153077656, rel=1e-14)
    for side in ("face_left", "face_right"):
        assert quantities[side]["exact"] == pytest.approx(26.857396646757338, rel=1e-14)
        assert abs(quantities[side]["error"]) < 16.3 / 12**2
    sharpest = told("flat")["cam"]["prime_radius"] - 11.752953153077656
    assert quantities["min_pitch_curvature_radius"]["exact"] == pytest.approx(sharpest, rel=1e-13)


@each_task
def test_every_value_lies_within_its_tolerance(name):
    for key, quantity in told(name)["quantities"].items():
        if quantity["error_paper"] is not None:
            assert abs(quantity["error_paper"]) <= quantity["tolerance_paper"], key


def test_a_given_arm_is_compared_though_no_radius_keeps_its_limits():
    """At 120 mm no radius keeps 20 degrees; the given cam is solved, its least radius null on both sides."""
    task = replace(
        task_of("arm"), rotation="cw", follower=OscillatingTable(100.0, 120.0, 10.0), cam=CamTable(45.0),
        limits=LimitsTable(20.0, 20.0),
    )  # fmt: skip
    quantities = gc.solve(task).to_dict()["quantities"]
    for key in ("minimum_prime_radius", "minimum_distance"):
        assert [quantities[key][side] for side in ("drawn", "exact")] == [None, None]
    assert quantities["max_pressure_angle_rise_deg"]["exact"] is not None
    json.dumps(quantities, allow_nan=False)


@each_task
def test_a_trembling_hand_draws_them_too_and_adopts_the_same_sizes(name):
    solution = gc.solve(task_of(name), gc.Pencil(line=0.2, dividers=0.2, protractor=0.005, samples=20, seed=3))
    assert solution.to_dict()["cam"] == told(name)["cam"]
    scatter = solution.drawn["inversion"].readings["x"].value.std(axis=0)
    assert np.all(scatter[1:-1] > 0)


def test_the_data_of_an_arm_tell_its_length():
    arm = solution_of("arm")
    assert ("arm", f"{arm.task.follower.arm:g} mm", "given") in [tuple(map(str, row)) for row in data(arm).rows]


@each_task
def test_a_limit_that_the_task_leaves_out_is_not_said_to_be_given(name):
    solution = solution_of(name)
    task = replace(solution.task, limits=LimitsTable(min_curvature_radius=solution.task.limits.min_curvature_radius))
    rows = {str(row[0]): str(row[2]) for row in data(gc.solve(task)).rows}
    assert {by for quantity, by in rows.items() if quantity.startswith("permitted")} == {"limit"}

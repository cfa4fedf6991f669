"""``solution.json``: its keys, units and values."""

from __future__ import annotations

import json
from dataclasses import replace
from math import atan, degrees, radians, sqrt

import numpy as np
import pytest

import graphcam
from graphcam.solving.solve import solve
from graphcam.tasks.task import CamTable, LimitsTable, Task, TranslatingTable
from graphcam.tasks.task_file import builtin_task

TOP = {"graphcam", "task", "cam", "phases", "scales", "quantities", "stations", "low_dwells", "warnings", "files"}
QUANTITIES = {
    "max_v": "mm/rad", "max_a": "mm/rad²", "minimum_prime_radius": "mm", "minimum_offset": "mm",
    "max_pressure_angle_rise_deg": "deg", "max_pressure_angle_return_deg": "deg", "min_pitch_curvature_radius": "mm",
    "roller_radius": "mm",
}  # fmt: skip
FILES = {
    "pdf", "svg", "png", "dxf", "csv", "md", "note", "note_html", "player", "profile_dxf", "profile_csv", "profile_xyz",
    "profile_step", "profile_gcode",
}  # fmt: skip


@pytest.fixture(scope="module")
def builtin():
    return solve(builtin_task())


@pytest.fixture(scope="module")
def document(builtin):
    """What the built-in task's file says, in strict JSON and back."""
    return json.loads(json.dumps(builtin.to_dict(), allow_nan=False))


def sizes(task: Task) -> tuple[float, float, float]:
    cam = solve(task).to_dict()["cam"]
    return cam["prime_radius"], cam["offset"], cam["roller_radius"]


def test_keys(document):
    assert document.keys() == TOP
    assert document["graphcam"] == graphcam.__version__
    assert document["task"] == builtin_task().to_dict()
    assert document["cam"].keys() == {"prime_radius", "offset", "roller_radius", "rotation"}
    ends = [(phase["begins_deg"], phase["ends_deg"]) for phase in document["phases"]]
    assert np.allclose(ends, [(0, 80), (80, 125), (125, 185), (185, 360)])
    assert document["scales"].keys() == {"phi", "s", "v", "a", "t", "v_at_speed", "a_at_speed"}
    assert {name: q["unit"] for name, q in document["quantities"].items()} == QUANTITIES
    for quantity in document["quantities"].values():
        assert quantity.keys() == {"drawn", "exact", "unit", "error", "error_paper", "tolerance_paper"}
    for station in document["stations"]:
        both = {"s", "v", "a", "pressure_angle_deg", "transmission_angle_deg", "pitch"}
        assert station.keys() == {"phi_deg", "phase", *both}
        for name in both:
            assert station[name].keys() == {"drawn", "exact"}
    assert document["files"].keys() == FILES


def test_the_transmission_angle_is_what_the_pressure_angle_leaves_of_a_right_one(document):
    for station in document["stations"]:
        for side in ("drawn", "exact"):
            alpha, gamma = (station[f"{name}_angle_deg"][side] for name in ("pressure", "transmission"))
            assert gamma == pytest.approx(90 - abs(alpha), abs=1e-12)


def test_the_scales_over_time_are_those_of_the_speed(document):
    """At 120 rpm omega is 4 pi; metres and seconds."""
    scales, omega = document["scales"], radians(720)
    assert scales["t"] == {"per_mm": pytest.approx(radians(1) / omega), "unit": "s"}
    assert scales["v_at_speed"] == {"per_mm": pytest.approx(scales["v"]["per_mm"] * omega / 1000), "unit": "m/s"}
    assert scales["a_at_speed"] == {"per_mm": pytest.approx(scales["a"]["per_mm"] * omega**2 / 1000), "unit": "m/s²"}


def test_the_jerk_is_told_where_it_is_drawn():
    task = builtin_task()
    document = solve(replace(task, drawing=replace(task.drawing, jerk=True))).to_dict()
    json.dumps(document, allow_nan=False)
    assert document["scales"]["j"]["unit"] == document["jerk"]["unit"] == "mm/rad³"
    assert document["quantities"]["max_j"]["exact"] == 0  # of constant accelerations
    assert [jump["phi_deg"] for jump in document["jerk"]["infinite"]] == pytest.approx([0, 40, 80, 125, 155, 185])
    assert len(document["jerk"]["parts"]) == 24


def test_the_arcs_of_the_lower_dwells_are_told(document):
    assert document["low_dwells"] == [
        {"phase": 3, "angle_deg": {"drawn": pytest.approx(175), "exact": pytest.approx(175)}}
    ]


def test_scales_follow_through_the_poles(document):
    """1 degree a millimetre on A1; mu_v = mu_s/(mu_phi H2), mu_a = mu_v/(mu_phi H1) with poles of 40 mm."""
    scales = document["scales"]
    assert scales["phi"] == {"per_mm": pytest.approx(1.0), "unit": "deg"}
    assert [scales[name]["unit"] for name in "sva"] == ["mm", "mm/rad", "mm/rad²"]
    step = radians(1) * 40
    assert scales["v"]["per_mm"] == pytest.approx(scales["s"]["per_mm"] / step)
    assert scales["a"]["per_mm"] == pytest.approx(scales["v"]["per_mm"] / step)


def test_errors_are_drawn_less_exact_and_on_paper(document):
    for q in document["quantities"].values():
        assert q["error"] == pytest.approx(q["drawn"] - q["exact"], abs=1e-12)
    angle = document["quantities"]["max_pressure_angle_rise_deg"]
    assert angle["error_paper"] == pytest.approx(angle["error"])  # at 1 degree a millimetre
    rho = document["quantities"]["min_pitch_curvature_radius"]
    assert rho["error_paper"] == pytest.approx(2 * rho["error"])  # the profile is drawn at 2:1


def test_stations_are_the_ends_of_twelve_parts_of_each_moving_phase(document):
    stations = document["stations"]
    assert [s["phase"] for s in stations] == [0] * 13 + [2] * 13
    expected = np.concatenate([np.linspace(0, 80, 13), np.linspace(125, 185, 13)])
    assert [s["phi_deg"] for s in stations] == pytest.approx(expected)


def test_a_phase_ends_with_its_own_acceleration(document):
    """Constant acceleration jumps at both ends of the rise and in its middle; a dwell has none."""
    rise = 4 * 30 / radians(80) ** 2
    a = [s["a"] for s in document["stations"][:13]]
    for side in ("drawn", "exact"):
        assert [x[side] for x in a] == pytest.approx([rise] * 6 + [-rise] * 7)


def test_pressure_angles_at_stations_are_signed_degrees(document):
    at_rest = -degrees(atan(10 / sqrt(44**2 - 10**2)))
    for k in (0, 25):
        angle = document["stations"][k]["pressure_angle_deg"]
        assert [angle["drawn"], angle["exact"]] == pytest.approx([at_rest, at_rest])


def test_the_first_pitch_point_is_the_trace_point_at_the_start(document):
    pitch = document["stations"][0]["pitch"]
    for side in ("drawn", "exact"):
        assert pitch[side] == pytest.approx([-10, sqrt(44**2 - 10**2)])


def test_the_adopted_cam(document):
    """r0 43.28 rounded up, the offset as given, and of 0.4 r0 = 17.6 the whole millimetres."""
    assert document["cam"] == {"prime_radius": 44.0, "offset": -10.0, "roller_radius": 17.0, "rotation": "cw"}


def test_what_is_given_is_not_decided():
    task = replace(builtin_task(), cam=CamTable(61.5), follower=TranslatingTable(offset=-7.25, roller_radius=0.0))
    assert sizes(task) == (61.5, -7.25, 0.0)


def test_an_open_offset_is_adopted_as_a_round_number():
    """The nearest place of the region: s0 and e from the two lines of rise and rest, e = s0 tan(30)."""
    task = replace(builtin_task(), follower=TranslatingTable())
    solution = solve(task)
    offset = solution.to_dict()["quantities"]["minimum_offset"]
    assert offset["exact"] < 0  # the favourable side of a clockwise cam
    assert solution.to_dict()["cam"]["offset"] == round(offset["drawn"])


def test_the_prime_radius_is_read_again_at_the_adopted_offset():
    solution = solve(replace(builtin_task(), follower=TranslatingTable()))
    cam = solution.cam
    at_adopted = graphcam.minimum_radius(cam.motion, graphcam.Translating(), "cw", offset=cam.follower.offset)
    assert cam.prime_radius == np.ceil(at_adopted.prime_radius)


def test_another_rounding_is_kept_to():
    task = builtin_task()
    prime_radius, _, roller = sizes(replace(task, drawing=replace(task.drawing, rounding=2.5)))
    assert (prime_radius, roller) == (45.0, 17.5)


def test_what_cannot_be_read_is_null():
    """With half a degree permitted the rise's tangent crosses the line of the offset at half a degree."""
    task = replace(builtin_task(), cam=CamTable(60.0), limits=LimitsTable(pressure_angle_rise=0.5))
    document = solve(task).to_dict()
    json.dumps(document, allow_nan=False)
    least = document["quantities"]["minimum_prime_radius"]
    assert [least[key] for key in ("drawn", "error", "error_paper", "tolerance_paper")] == [None] * 4
    assert least["exact"] > 1000


def test_files_are_not_named_before_they_are_written(builtin):
    assert builtin.to_dict()["files"] == dict.fromkeys(FILES)

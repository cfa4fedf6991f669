"""A task with a spring: what is solved, what the sheet shows, and which faults of the table are refused."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import graphcam as gc
from graphcam.constructions.pressure_angle import shown_station
from graphcam.report.documents import sheet_of
from graphcam.sheets.model import Stroke, Text
from graphcam.tasks.task_file import builtin_text

VOLODER = """
rotation = "cw"
speed_rpm = 550
[motion]
phases = [
  { kind = "rise", angle = 45, lift = 30, law = "cosine" }, { kind = "dwell", angle = 45 },
  { kind = "return", angle = 45, lift = 30, law = "cosine" }, { kind = "dwell", angle = 225 },
]
[follower]
kind = "translating"
offset = 0
[spring]
mass = 0.2
stiffness = 3
"""


def solved(path: Path, text: str) -> gc.Solution:
    file = path / "cam.toml"
    file.write_text(text, encoding="utf-8")
    return gc.solve(gc.load_task(file))


def test_an_open_preload_is_the_least_one_of_the_publication(tmp_path):
    found = solved(tmp_path, VOLODER).to_dict()["spring"]
    assert found["least_preload"]["value"] == pytest.approx(69.2296176709083, rel=1e-13)
    assert found["least_preload"]["phi_deg"] == pytest.approx(45)
    assert found["preload"]["value"] == found["least_preload"]["value"]
    assert found["contact_lost_deg"] == []
    assert abs(found["least_contact_force"]["value"]) <= 1e-12
    assert found["least_contact_force"]["side"] == "left"


def test_a_preload_that_is_too_small_loses_contact_and_the_sheet_says_where(tmp_path):
    solution = solved(tmp_path, VOLODER + "preload = 60\n")
    lost = solution.to_dict()["spring"]["contact_lost_deg"]
    assert [round(phi, 2) for phi in lost[0]] == [39.2, 45.0]
    texts = [
        e.text for page in sheet_of(solution).pages for g in page.groups for e in g.entities if isinstance(e, Text)
    ]
    assert any("lost, " in text for text in texts)
    assert any("Contact force" in text for text in texts)


def test_the_sheet_shows_the_contact_function_and_the_force_plan(tmp_path):
    """The curve is as wide as the view says, and the force plan is drawn at the velocity plan's station."""
    solution = solved(tmp_path, VOLODER)
    groups = {g.name: g for page in sheet_of(solution).pages for g in page.groups}
    (contact,) = (g for name, g in groups.items() if " contact " in name)
    widths = [e.points.real.max() - e.points.real.min() for e in contact.entities if isinstance(e, Stroke)]
    assert max(widths) == pytest.approx(120, abs=1e-6)
    assert sum(" force_plan " in name for name in groups) == 4
    plan = solution.spring.force_plan
    k = plan.givens.station
    stations = solution.chain.board.stations
    exact = gc.CamForces(solution.cam, solution.spring.load).at(stations.phase[k], stations.u[k])
    assert float(plan.readings["normal"].value) == pytest.approx(float(exact.normal), rel=0.01)


JUMP = """
rotation = "ccw"
speed_rpm = 300
[motion]
phases = [
  { kind = "rise", angle = 40, lift = 12, law = "rectangular", ratio = 2.5 },
  { kind = "dwell", angle = 20 },
  { kind = "return", angle = 120, lift = 12, law = "cycloidal" }, { kind = "dwell", angle = 180 },
]
[follower]
kind = "translating"
[spring]
mass = 0.4
stiffness = 2
"""


def test_the_force_plan_is_drawn_where_the_least_preload_leaves_a_load(tmp_path):
    """Here the greatest pressure angle and the lost load are at one place, the jump of the acceleration."""
    solution = solved(tmp_path, JUMP)
    spring, stations = solution.spring, solution.chain.board.stations
    forces = gc.CamForces(solution.cam, spring.load)
    shown = shown_station(solution.chain.pressure_angle)
    assert spring.least.phi == pytest.approx(math.radians(40 / 3.5))
    assert math.radians(40) * stations.u[shown] == pytest.approx(spring.least.phi)
    k = spring.force_plan.givens.station
    normal = float(spring.force_plan.readings["normal"].value)
    assert normal == pytest.approx(float(forces.at(stations.phase[k], stations.u[k]).normal), rel=0.02)
    assert normal > 0.2 * spring.greatest_normal.value


def test_a_flat_faced_follower_has_a_spring_but_no_plan_of_forces(tmp_path):
    flat = builtin_text("flat")
    speed = "" if "speed_rpm" in flat else "speed_rpm = 100\n"
    solution = solved(tmp_path, speed + flat + "\n[spring]\nmass = 0.3\nstiffness = 2\n")
    assert solution.spring.force_plan is None
    assert solution.to_dict()["spring"]["greatest_normal_force"]["value"] > 0


def test_without_a_spring_nothing_is_said_of_one():
    solution = gc.solve(gc.builtin_task())
    assert solution.spring is None
    assert "spring" not in solution.to_dict()


@pytest.mark.parametrize(
    ("text", "field", "words"),
    [
        (VOLODER.replace("speed_rpm = 550\n", ""), "speed_rpm", "missing given spring"),
        (VOLODER.replace("mass = 0.2", "mass = 0"), "spring.mass", "0 greater than 0 kg"),
        (VOLODER.replace("mass = 0.2", 'mass = "0.2"'), "spring.mass", "'0.2' a number"),
        (VOLODER.replace("mass = 0.2\n", ""), "spring.mass", "missing"),
        (VOLODER.replace("stiffness = 3", "stifness = 3"), "spring.stifness", "unknown did you mean 'stiffness'"),
        (VOLODER + "preload = -1\n", "spring.preload", "-1 0 N or more"),
        (VOLODER.replace("[spring]\nmass = 0.2\nstiffness = 3\n", "spring = 3"), "follower.spring", "unknown"),
        (
            VOLODER.replace('"translating"\noffset = 0', '"oscillating"\narm = 80\ndistance = 100'),
            "spring", "a table left out for an arm",
        ),
    ],
)  # fmt: skip
def test_faults_of_the_spring_are_named(tmp_path, text, field, words):
    file = tmp_path / "cam.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(gc.TaskError) as caught:
        gc.load_task(file)
    message = str(caught.value)
    assert f": {field} is " in message
    assert all(word in message for word in words.split())


def test_a_preload_that_is_not_needed_is_a_plain_zero(tmp_path):
    """The speed is so low that the spring's travel alone keeps contact."""
    solution = solved(tmp_path, VOLODER.replace("speed_rpm = 550", "speed_rpm = 10"))
    found = solution.to_dict()["spring"]
    assert repr(found["least_preload"]["value"]) == repr(found["preload"]["value"]) == "0.0"
    rows = {str(name): str(value) for name, value, _ in solution.spring.table().rows}
    assert rows["least preload"] == rows["preload F₀"] == "0 N"

"""A task with a spring: what is solved, what the sheet shows, and which faults of the table are refused."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import graphcam as gc
from graphcam.constructions.pressure_angle import shown_station
from graphcam.drafting.marks import Dots, Line, Role
from graphcam.mechanism.turn_extremes import TurnCurve, ValueAt
from graphcam.report.documents import sheet_of
from graphcam.sheets.model import Stroke, Text
from graphcam.solving.turn_diagrams import TurnDiagram, diagram_step
from graphcam.tasks.task_file import builtin_text
from graphcam.words import Caption

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

ARM = """
rotation = "ccw"
speed_rpm = 900
[motion]
phases = [
  { kind = "rise", angle = 75, lift = 15, law = "3-4-5" }, { kind = "dwell", angle = 60 },
  { kind = "return", angle = 90, lift = 15, law = "cycloidal" }, { kind = "dwell", angle = 135 },
]
[follower]
kind = "oscillating"
arm = 125
distance = 150
roller_radius = 12
[cam]
prime_radius = 61
[spring]
inertia = 1500
stiffness = 4000
"""
TABLE = "load = [[0, 20], [50, 20], [130, 60], [140, 25], [360, 20]]\n"


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


LOST = "Contact is lost from 39.2° to 45.0° and from 90.0° to 95.8°: a preload of 69.23 N keeps it, 60 N are given."


def test_lost_contact_is_warned_of_with_the_preload_that_keeps_it(tmp_path):
    """On the sheet and in the solution; with that preload nothing is left to warn of."""
    solution = solved(tmp_path, VOLODER + "preload = 60\n")
    assert LOST in solution.warnings
    texts = [
        e.text for page in sheet_of(solution).pages for g in page.groups for e in g.entities if isinstance(e, Text)
    ]
    assert LOST in " ".join(texts)
    for kept in ("", "preload = 69.23\n"):
        assert not [each for each in solved(tmp_path, VOLODER + kept).warnings if "Contact" in each]


def test_lost_contact_is_warned_of_for_an_arm_and_under_a_flat_face(tmp_path):
    """The preload that is told is the least of four digits: of one unit less in the last digit contact is lost."""
    torsion, at_point = (
        ARM + "preload = 100\n",
        ARM.replace("4000", "4") + "preload = 1\nat = {arm = 60, anchor = [120, -60]}\n",
    )
    face = VOLODER.replace('kind = "translating"\noffset = 0', 'kind = "flat-faced"') + "preload = 60\n"
    for text, unit in ((torsion, "N·mm"), (at_point, "N"), (face, "N")):
        (said,) = (each for each in solved(tmp_path, text).warnings if each.startswith("Contact is lost from "))
        needed = float(re.search(rf"a preload of ([\d.]+) {unit} keeps it", said)[1])
        enough = re.sub(r"preload = \d+", f"preload = {needed:.12g}", text)
        assert not [each for each in solved(tmp_path, enough).warnings if "Contact" in each]
        less = re.sub(r"preload = \d+", f"preload = {needed * (1 - 1.1e-3):.12g}", text)
        assert [each for each in solved(tmp_path, less).warnings if "Contact" in each]


@pytest.mark.parametrize("language", ["ru", "vi", "zh"])
def test_lost_contact_is_warned_of_in_every_language(tmp_path, language):
    drawing = f'[drawing]\nlanguage = "{language}"\n'
    (said,) = (s for s in solved(tmp_path, VOLODER + "preload = 60\n" + drawing).warnings if re.search(r"69[.,]23", s))
    assert not re.search("[a-z]{4}", said)


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
    assert normal > 0.2 * spring.max_normal.value


def test_a_flat_faced_follower_has_a_spring_but_no_plan_of_forces(tmp_path):
    """Its contact force is the load itself: there is no pressure angle, and no diagram of the transmission."""
    flat = builtin_text("flat")
    speed = "" if "speed_rpm" in flat else "speed_rpm = 100\n"
    solution = solved(tmp_path, speed + flat + "\n[spring]\nmass = 0.3\nstiffness = 2\nfriction = 0.1\n")
    assert solution.spring.force_plan is None
    found = solution.to_dict()["spring"]
    assert found["greatest_normal_force"]["value"] > 0
    assert found["least_transmission"]["value"] == 1
    assert [diagram.name for diagram in solution.spring.drawn["turn_forces"].givens.diagrams] == [
        "normal_force",
        "torque",
    ]


@pytest.mark.parametrize(
    "text",
    [
        VOLODER + TABLE + "friction = 0.1\nacceleration = 30\n",
        ARM + TABLE + "friction = 0.1\nacceleration = -30\n",
        ARM.replace("stiffness = 4000", "stiffness = 6\nat = { arm = 70, anchor = [130, -40] }") + "load = 15\n",
    ],
    ids=["slides", "torsion", "at a point"],
)
def test_what_presses_is_what_the_task_says(tmp_path, text):
    """The plain data, the diagrams and the extremes are those of CamForces under the load of the task."""
    solution = solved(tmp_path, text)
    spring, said = solution.spring, solution.task.spring
    found = solution.to_dict()["spring"]
    load = replace(said(solution.task.speed_rpm), preload=found["preload"]["value"])
    forces = gc.CamForces(solution.cam, load, friction=said.friction)
    assert load.acceleration == said.acceleration
    assert found["least_preload"]["value"] == pytest.approx(gc.spring_preload(solution.cam, load).preload)
    assert abs(found["least_normal_force"]["value"]) <= 1e-9 * found["greatest_normal_force"]["value"]
    assert found["greatest_normal_force"]["value"] == pytest.approx(forces.max_normal().value, rel=1e-13)
    assert found["torque"]["mean"]["value"] == pytest.approx(gc.mean_torque(forces), rel=1e-9, abs=1e-9)
    assert found["torque"]["greatest"]["value"] == pytest.approx(forces.max_torque().value, rel=1e-13)
    margin = gc.jamming_margin(solution.cam, said.friction)
    assert found["least_transmission"]["value"] == pytest.approx(margin.value, rel=1e-13)
    columns = found["over_turn"]
    phi = np.radians(columns["phi_deg"])
    assert np.all(np.diff(phi) >= -1e-12)
    assert len(set(map(len, columns.values()))) == 1
    assert np.hypot(columns["along"], columns["side"]) == pytest.approx(np.abs(columns["normal_force"]), abs=1e-9)
    assert max(columns["torque"]) == pytest.approx(found["torque"]["greatest"]["value"], rel=0.02)
    (normal,) = (each for each in spring.drawn["turn_forces"].givens.diagrams if each.name == "normal_force")
    assert normal.curve.values.max() == pytest.approx(forces.max_normal().value, rel=1e-3)
    assert {step.view.name for step in spring.drawn["turn_forces"].steps()} == {
        "transmission",
        "normal_force",
        "torque",
    }


def test_the_diagrams_show_curve_extreme_limit_and_what_is_wrong():
    """Lengths on paper times the scale are the values; a curve with a gap is drawn in two parts."""
    motion = gc.builtin_task().motion()
    phi = np.linspace(0, math.tau, 721)
    values = 40 * np.sin(phi)
    values[100:110] = np.nan
    diagram = TurnDiagram(
        "stress", Caption("Stress"), Caption("Stress, {mu:g} MPa/mm"), Caption("p, MPa"), "MPa", motion,
        TurnCurve(phi, values), Caption("At {mu:g} MPa/mm."), marked=((ValueAt(40.0, math.pi / 2, "right"), "40 MPa"),),
        limit=(60.0, "60 MPa permitted"), wrong=((6.0, 6.6),),
    )  # fmt: skip
    step = diagram_step(diagram)
    assert diagram.mu.per_mm == 2.0  # 60 MPa in 50 mm at most, at a round scale
    assert str(step.view.title) == "Stress, 2 MPa/mm"
    assert str(step.caption) == "At 2 MPa/mm."
    curve = [mark for mark in step.own_marks if isinstance(mark, Line) and mark.role is Role.RESULT]
    assert len(curve) == 2
    points = np.concatenate([line.points for line in curve])
    assert points.real / 120 * math.tau == pytest.approx(phi[np.isfinite(values)])
    assert 2 * points.imag == pytest.approx(values[np.isfinite(values)])
    (dot,) = (mark for mark in step.own_marks if isinstance(mark, Dots))
    assert dot.points[0] == pytest.approx(30 + 20j)
    level, *wrong = (mark.points for mark in step.own_marks if isinstance(mark, Line) and mark.role is Role.LIMIT)
    assert level.imag == pytest.approx([30, 30])
    ends = [tuple(part.real / 120 * math.tau) for part in wrong]
    assert ends == [pytest.approx((6.0, math.tau)), pytest.approx((0.0, 6.6 - math.tau))]


def test_friction_that_jams_is_refused_with_the_place(tmp_path):
    """A steep rise on a small cam: the message names the friction that would do, and where it does not."""
    text = VOLODER.replace("[spring]", "[cam]\nprime_radius = 30\n[spring]\nfriction = 0.8") + "preload = 80\n"
    with pytest.raises(
        gc.DesignError, match=r"friction is 0\.8, but must be less than the [\d.]+ .* cam angle of"
    ) as caught:
        solved(tmp_path, text)
    permitted = float(caught.value.limit.split()[3])
    assert solved(tmp_path, text.replace("0.8", f"{permitted - 1e-3:g}")).to_dict()["spring"]["friction"] < permitted


def test_a_spring_over_the_pivot_is_refused(tmp_path):
    text = ARM.replace("stiffness = 4000", "stiffness = 6\nat = { arm = 70, anchor = [200, -25] }")
    with pytest.raises(gc.DesignError, match=r"at\.anchor is \(200, -25\).* passes over the pivot"):
        solved(tmp_path, text)


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
            "spring.mass", "0.2 left out for an arm spring.inertia",
        ),
        (VOLODER.replace("mass = 0.2", "inertia = 20"), "spring.inertia", "20 left out translating spring.mass"),
        (VOLODER.replace("mass = 0.2", "mass = -0.2"), "spring.mass", "-0.2 greater than 0 kg"),
        (VOLODER.replace("stiffness = 3", "stiffness = 0"), "spring.stiffness", "0 greater than 0 N/mm"),
        (VOLODER + "accelaration = 3\n", "spring.accelaration", "unknown did you mean 'acceleration'"),
        (VOLODER + "friction = -0.1\n", "spring.friction", "-0.1 from 0 to 2"),
        (VOLODER + "friction = 30\n", "spring.friction", "30 from 0 to 2 coefficient"),
        (VOLODER + "load = 1e12\n", "spring.load", "N in magnitude"),
        (VOLODER + "load = [[0, 5], [270, 5]]\n", "spring.load", "0 to 270 degrees covers the turn 360"),
        (VOLODER + "load = [[0, 5], [90, 7], [80, 5], [360, 5]]\n", "spring.load", "80 degrees after 90 grow"),
        (VOLODER + "load = [[0, 5], [360, 9]]\n", "spring.load", "5 N 9 N the same at both"),
        (VOLODER + "load = [[0, 5, 7], [360, 9]]\n", "spring.load[0]", "a list of 2"),
        (VOLODER + "load = 'heavy'\n", "spring.load", "a number a list"),
        (VOLODER + "at = { arm = 3, anchor = [1, 2] }\n", "spring.at", "unknown key"),
        (ARM.replace("inertia = 1500", "inertia = -1"), "spring.inertia", "-1 greater than 0 kg mm^2"),
        (ARM.replace("inertia = 1500\n", ""), "spring.inertia", "missing kg mm^2"),
        (ARM + "at = { arm = 0, anchor = [1, 2] }\n", "spring.at.arm", "0 pivot"),
        (ARM + "at = { arm = 5, anchor = [1, 1e12] }\n", "spring.at.anchor[1]", "mm in magnitude"),
        (ARM + "at = { arm = 5, anchor = [1] }\n", "spring.at.anchor[1]", "missing"),
        (ARM + "at = { arms = 5, anchor = [1, 2] }\n", "spring.at.arms", "unknown did you mean 'arm'"),
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
    assert rows["minimum preload"] == rows["preload F₀"] == "0 N"

"""A task with materials: the stress that is told and drawn, and which faults of the table are refused."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from russian import english_words

import graphcam as gc
from graphcam.report.documents import note_of, sheet_of
from graphcam.sheets.model import Stroke, Text
from graphcam.tasks.material_table import MaterialTable
from graphcam.tasks.sheet_tables import plain_data
from graphcam.tasks.task_file import builtin_text, task_from

TRANSLATING = """
rotation = "ccw"
speed_rpm = 300
[motion]
phases = [
  { kind = "rise", angle = 60, lift = 12, law = "cycloidal" }, { kind = "dwell", angle = 60 },
  { kind = "return", angle = 60, lift = 12, law = "cycloidal" }, { kind = "dwell", angle = 180 },
]
[follower]
kind = "translating"
offset = 20
roller_radius = 15
[cam]
prime_radius = 95
[spring]
mass = 0.5
stiffness = 10
preload = 6000
"""
MATERIAL = "[material]\nwidth = 15\n"


def loaded(path: Path, text: str) -> gc.Task:
    file = path / "cam.toml"
    file.write_text(text, encoding="utf-8")
    return gc.load_task(file)


def solved(path: Path, text: str) -> gc.Solution:
    return gc.solve(loaded(path, text))


def texts_of(solution: gc.Solution) -> list[str]:
    pages = sheet_of(solution).pages
    return [e.text for page in pages for group in page.groups for e in group.entities if isinstance(e, Text)]


def test_the_greatest_stress_is_that_of_the_exact_cam(tmp_path):
    solution = solved(tmp_path, TRANSLATING + MATERIAL + "permitted_stress = 1000\n")
    found = solution.to_dict()["contact_stress"]
    load = gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=10, preload=6000)
    stress = gc.ContactStress(gc.CamForces(solution.cam, load), gc.RollerContact(15))
    exact, at = stress.max_pressure(), found["greatest"]
    assert at["value"] == exact.value
    assert math.radians(at["phi_deg"]) == pytest.approx(exact.phi)
    radius, force = at["profile_radius"]["value"], at["normal_force"]["value"]
    one = gc.hertz_line_contact(force, 15, radius, 15)
    assert (one.peak_pressure, one.half_width) == pytest.approx((at["value"], at["half_width"]["value"]), rel=1e-12)
    assert found["permitted"] == {"value": 1000.0, "unit": "MPa", "kept": False}
    # On the least width that is told the permitted stress is reached, and not exceeded.
    wide = replace(solution.task, material=MaterialTable(found["least_width"]["value"], permitted_stress=1000.0))
    assert gc.solve(wide).stress.max_pressure.value == pytest.approx(1000.0, rel=1e-12)
    json.dumps(found, allow_nan=False)


def test_a_stress_that_is_exceeded_is_warned_of(tmp_path):
    (warning,) = solved(tmp_path, TRANSLATING + MATERIAL + "permitted_stress = 1000\n").warnings
    assert warning.startswith("The contact stress reaches 1149 MPa at 138.001°; 1000 MPa are permitted.")
    assert "Widen the contact to 19.80 mm" in warning
    assert solved(tmp_path, TRANSLATING + MATERIAL + "permitted_stress = 1200\n").warnings == []
    assert solved(tmp_path, TRANSLATING + MATERIAL).to_dict()["contact_stress"]["permitted"] is None


@pytest.mark.parametrize(
    ("permitted", "marked", "words"),
    [(1000, True, "Only 1000 MPa are permitted. A contact 19.80 mm wide satisfies this."),
     (1200, False, "1200 MPa are permitted: a contact 13.75 mm wide would be enough."),
     (None, False, "there pitting begins.")],
)  # fmt: skip
def test_the_diagram_and_the_note_say_what_is_permitted(tmp_path, permitted, marked, words):
    limit = "" if permitted is None else f"permitted_stress = {permitted}\n"
    solution = solved(tmp_path, TRANSLATING + MATERIAL + limit)
    (step,) = solution.stress.drawn["contact_stress"].steps()
    assert ("the curve lies above it, the axis is marked" in str(step.caption)) == marked
    note = note_of(solution)
    assert words in note
    assert "= 1148.8\\ \\text{MPa}" in note
    assert "The pressure has its maximum at 138.0°, where $N = 6410.2$ N." in note
    told = texts_of(solution)
    assert "1149 MPa" in told
    assert (f"{permitted} MPa" in told) == (permitted is not None)


def test_the_curve_on_the_sheet_is_the_stress_over_the_turn(tmp_path):
    """Read off the sheet, heights times the scale of the title are the stresses."""
    solution = solved(tmp_path, TRANSLATING + MATERIAL)
    (view,) = [g for page in sheet_of(solution).pages for g in page.groups if " contact_stress " in g.name]
    curve = max((e for e in view.entities if isinstance(e, Stroke)), key=lambda stroke: stroke.points.size)
    (title,) = [text for text in texts_of(solution) if re.fullmatch(r"μ\S* = \d+ MPa/mm", text)]
    x, y = curve.points.real, curve.points.imag
    stress, phi = solution.stress.stress, np.linspace(0.05, 6.2, 40)
    base = y[0] - float(stress.at(0, 0.0).peak_pressure) / float(title.split()[2])
    heights = np.interp(phi, (x - x[0]) / 120 * 2 * math.pi, y - base) * float(title.split()[2])
    values = solution.cam.motion(phi)
    normal = stress.forces.load.force(values) / np.cos(solution.cam.pressure_angle(phi))
    radii = 1 / solution.cam.pitch_curvature(phi) - 15
    each = [gc.hertz_line_contact(float(n), 15, float(r), 15).peak_pressure for n, r in zip(normal, radii, strict=True)]
    assert heights == pytest.approx(each, rel=2e-3)


def test_a_knife_edge_has_no_finite_stress_and_the_note_says_so(tmp_path):
    text = TRANSLATING.replace("roller_radius = 15", "roller_radius = 0") + MATERIAL
    solution = solved(tmp_path, text + "permitted_stress = 1000\n")
    found = solution.to_dict()["contact_stress"]
    assert (found["greatest"], found["without"], found["permitted"]["kept"]) == (None, "knife edge", False)
    assert "by Hertz the pressure is infinite under any force" in note_of(solution)
    (warning,) = [each for each in solution.warnings if "contact stress" in each]
    assert "a knife edge has no width of contact" in warning
    assert solution.stress.drawn == {}
    assert any("the stress is infinite" in text for text in [" ".join(texts_of(solution))])


def test_an_undercut_profile_ends_in_an_edge(tmp_path):
    text = TRANSLATING.replace("offset = 20\nroller_radius = 15", "offset = 5\nroller_radius = 20")
    text = text.replace("lift = 12", "lift = 30").replace("prime_radius = 95", "prime_radius = 30")
    solution = solved(tmp_path, text + MATERIAL)
    assert solution.to_dict()["contact_stress"]["without"] == "undercut"
    assert "The profile is undercut and ends in an edge" in note_of(solution)


def test_a_cam_that_nothing_presses_on_is_not_stressed(tmp_path):
    """A load that pulls everywhere is no load on the contact."""
    solution = solved(tmp_path, TRANSLATING + MATERIAL + "permitted_stress = 500\n")
    design = solution.stress
    slack = replace(design, forces=gc.CamForces(solution.cam, gc.SpringLoad(0, 0, 0, preload=-5)))
    assert (slack.without, slack.max_pressure, slack.permitted) == ("no force", None, None)
    assert list(slack.cautions) == []


def test_a_concave_place_is_told_as_such(tmp_path):
    """Under a force that is great only where the profile is hollow the radius is negative, and beyond the roller's."""
    text = TRANSLATING.replace("lift = 12", "lift = 60")
    solution = solved(tmp_path, text.replace("offset = 20", "offset = 0") + MATERIAL)
    stress = solution.stress
    hollow = stress.stress.at(0, np.linspace(0, 1, 101))
    k = int(np.argmin(hollow.profile_radius * (hollow.profile_radius < 0)))
    assert hollow.profile_radius[k] < -15
    # A heavy mass is braked at the top and driven at the foot of the rise: there the profile is hollow.
    heavy = replace(solution.task, spring=replace(solution.task.spring, mass=400.0, preload=None))
    at = gc.solve(heavy).to_dict()["contact_stress"]["greatest"]
    assert (at["profile_radius"]["shape"], at["profile_radius"]["value"] < -15) == ("concave", True)
    assert "There the profile is concave with a radius of" in note_of(gc.solve(heavy))


def test_a_flat_face_touches_in_the_profiles_own_radius(tmp_path):
    flat = builtin_text("flat")
    speed = "" if "speed_rpm" in flat else "speed_rpm = 100\n"
    solution = solved(tmp_path, speed + flat + "\n[spring]\nmass = 0.3\nstiffness = 2\npreload = 200\n" + MATERIAL)
    at = solution.to_dict()["contact_stress"]["greatest"]
    s, _, a, _ = solution.cam.motion(math.radians(at["phi_deg"]), at["side"])
    assert at["profile_radius"]["value"] == pytest.approx(solution.cam.prime_radius + float(s + a), rel=1e-9)
    face = gc.hertz_line_contact(at["normal_force"]["value"], 15, at["profile_radius"]["value"], math.inf)
    assert at["value"] == pytest.approx(face.peak_pressure, rel=1e-12)
    assert r"R = \varrho" in note_of(solution)


def test_other_materials_and_their_order(tmp_path):
    """A softer follower flattens more; which body is the softer one does not matter."""
    soft = "young_{0} = 110000\npoisson_{0} = 0.34\n"
    one, other = (solved(tmp_path, TRANSLATING + MATERIAL + soft.format(body)) for body in ("cam", "follower"))
    steel = solved(tmp_path, TRANSLATING + MATERIAL).stress.max_pressure.value
    assert one.stress.max_pressure.value == pytest.approx(other.stress.max_pressure.value, rel=1e-14)
    assert one.stress.max_pressure.value < steel
    modulus = gc.RollerContact(15, young_cam=110000, poisson_cam=0.34).modulus
    assert one.stress.max_pressure.value == pytest.approx(steel * math.sqrt(modulus / gc.RollerContact(15).modulus))


def test_without_materials_nothing_is_said_of_stress(tmp_path):
    solution = solved(tmp_path, TRANSLATING)
    assert solution.stress is None
    assert "contact_stress" not in solution.to_dict()
    assert "Contact stress" not in note_of(solution)


def test_in_russian_no_english_word_is_left(tmp_path):
    task = loaded(tmp_path, TRANSLATING + MATERIAL + "permitted_stress = 1000\n")
    named = replace(task, title=replace(task.title, name="Кулачок"), drawing=replace(task.drawing, language="ru"))
    solution = gc.solve(named)
    note = re.sub(r"^\*\*\d+\.\d+\. ", "", note_of(solution), flags=re.MULTILINE)
    for text in (note, *solution.warnings, *texts_of(solution)):
        assert english_words(text, ("cos", "sin")) == set()
        assert re.findall(r"\d\.\d", text) == []


def test_the_table_is_written_as_it_was_read(tmp_path):
    task = loaded(tmp_path, TRANSLATING + MATERIAL + "permitted_stress = 1000\n")
    assert task_from(task.to_dict()) == task
    assert plain_data(task.material)["young_follower"] == 206000.0


@pytest.mark.parametrize(
    ("text", "field", "words"),
    [
        (TRANSLATING.partition("[spring]")[0] + MATERIAL, "spring", "missing given material force"),
        (TRANSLATING + "[material]\nyoung_cam = 1\n", "material.width", "missing given"),
        (TRANSLATING + "[material]\nwidth = 0\n", "material.width", "0 greater than 0 mm"),
        (TRANSLATING + "[material]\nwidth = -3\n", "material.width", "-3 greater than 0 mm"),
        (TRANSLATING + '[material]\nwidth = "15"\n', "material.width", "'15' a number"),
        (TRANSLATING + MATERIAL + "young_cam = 206000\nyoung_follower = -1\n", "material.young_follower", "-1 MPa"),
        (TRANSLATING + MATERIAL + "young_cam = 206\n", "material.young_cam", "if it is in GPa, write 206000"),
        (TRANSLATING + MATERIAL + "young_cam = 206e9\n", "material.young_cam", "1000 to 10000000 MPa unit digits"),
        (TRANSLATING + MATERIAL + "poisson_cam = 0.6\n", "material.poisson_cam", "0.6 from 0 to 0.5"),
        (TRANSLATING + MATERIAL + "poisson_follower = -0.1\n", "material.poisson_follower", "-0.1 from 0 to 0.5"),
        (TRANSLATING + MATERIAL + "permitted_stress = 0\n", "material.permitted_stress", "0 greater than 0 MPa"),
        (TRANSLATING + MATERIAL + "young = 206000\n", "material.young", "unknown known are young_cam"),
        (
            TRANSLATING + MATERIAL + "permited_stress = 9\n",
            "material.permited_stress",
            "did you mean 'permitted_stress'",
        ),
    ],
)
def test_faults_of_the_table_are_named(tmp_path, text, field, words):
    with pytest.raises(gc.TaskError) as caught:
        loaded(tmp_path, text)
    message = str(caught.value)
    assert f": {field} is " in message
    assert all(word in message for word in words.split()), message


ARM = """
rotation = "ccw"
speed_rpm = 200
[motion]
phases = [
  { kind = "rise", angle = 100, lift = 15, law = "cycloidal" }, { kind = "dwell", angle = 60 },
  { kind = "return", angle = 100, lift = 15, law = "cycloidal" }, { kind = "dwell", angle = 100 },
]
[follower]
kind = "oscillating"
arm = 120
distance = 130
roller_radius = 14
[cam]
prime_radius = 60
[spring]
inertia = 3000
stiffness = 90000
preload = 150000
friction = 0.05
"""


def test_an_arm_presses_with_its_torque_over_its_lever(tmp_path):
    """The moment of N and of its friction about the pivot is that of spring and inertia; N is found from it anew."""
    solution = solved(tmp_path, ARM + MATERIAL + "permitted_stress = 500\n")
    at = solution.to_dict()["contact_stress"]["greatest"]
    cam, phi = solution.cam, math.radians(at["phi_deg"])
    s, _, a, _ = cam.motion(phi, at["side"])
    omega = 200 * 2 * math.pi / 60
    torque = 3000 * 1e-3 * float(a) * omega**2 + 150000 + 90000 * float(s)
    # Seen in the frame: where the arm's end is, where it touches, and the normal there.
    values = cam.motion(phi, at["side"])
    pivot, end, normal = 130 + 0j, complex(cam.kinematics.point(values)), complex(cam.kinematics.normal(values))
    touch = end - 14 * normal
    moment = lambda place, force: ((place - pivot).conjugate() * force).imag  # noqa: E731
    along = 1j * touch / abs(touch)  # the cam turns anticlockwise
    tangent = 1j * normal * np.sign((along.conjugate() * 1j * normal).real)
    lever = abs(moment(touch, normal + 0.05 * tangent))
    assert at["normal_force"]["value"] == pytest.approx(torque / lever, rel=1e-9)
    one = gc.hertz_line_contact(at["normal_force"]["value"], 15, at["profile_radius"]["value"], 14)
    assert at["value"] == pytest.approx(one.peak_pressure, rel=1e-12)
    assert "Contact stress" in note_of(solution)


@pytest.mark.parametrize("permitted", [1035, 1100, 1140])
def test_where_the_stress_is_exceeded_the_axis_is_marked(tmp_path, permitted):
    solution = solved(tmp_path, TRANSLATING + MATERIAL + f"permitted_stress = {permitted}\n")
    (diagram,) = solution.stress.drawn["contact_stress"].givens.diagrams
    stress = lambda phi: float(np.interp(phi, diagram.curve.phi, diagram.curve.values))  # noqa: E731
    assert diagram.wrong
    for start, end in diagram.wrong:
        for phi in (start, end):
            assert phi in (0, 2 * math.pi) or stress(phi) == pytest.approx(permitted, rel=1e-9)
        assert stress((start + end) / 2) > permitted
    marked = sum(end - start for start, end in diagram.wrong)
    phi = np.linspace(0, 2 * math.pi, 20001)
    above = np.interp(phi, diagram.curve.phi, diagram.curve.values) > permitted
    assert marked == pytest.approx(above.mean() * 2 * math.pi, abs=1e-3)


@pytest.mark.parametrize(("permitted", "drawn"), [(3000, True), (4000, False)])
def test_a_permitted_stress_far_above_the_curve_is_told_and_not_drawn(tmp_path, permitted, drawn):
    """Else the curve would have no height on the paper."""
    solution = solved(tmp_path, TRANSLATING + MATERIAL + f"permitted_stress = {permitted}\n")
    (diagram,) = solution.stress.drawn["contact_stress"].givens.diagrams
    assert (diagram.limit is not None) == drawn
    (step,) = solution.stress.drawn["contact_stress"].steps()
    assert (f"The permitted stress of {permitted} MPa lies beyond the diagram." in str(step.caption)) != drawn

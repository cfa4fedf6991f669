"""What the note calculates of an arm and of a flat face: its formulas hold for the numbers that are put into them."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from graphcam.drafting.pencil import Pencil
from graphcam.report.note import note
from graphcam.solving.solve import solve
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.task import CamTable, FlatFacedTable, LimitsTable, OscillatingFlatTable, OscillatingTable
from graphcam.tasks.task_file import builtin_task

ARM, FLAT, ON_PIVOT = (builtin_task(name) for name in ("arm", "flat", "swinging-face"))
SWINGING = MotionTable(
    (RiseTable(120, 22, "cycloidal"), DwellTable(40), ReturnTable(100, 22, "3-4-5"), DwellTable(100))
)
FREE = replace(
    ARM, motion=SWINGING, cam=CamTable(), follower=OscillatingTable(arm=95, roller_radius=9), limits=LimitsTable(45, 70)
)
TASKS = {
    "built-in arm": (ARM, None),
    "clockwise": (replace(FREE, rotation="cw"), None),
    "anticlockwise": (replace(FREE, rotation="ccw"), None),
    "not limited at rest": (replace(FREE, limits=LimitsTable(45, 70, rest=False)), None),
    "an arm by hand": (FREE, Pencil(line=0.2, dividers=0.2)),
    "built-in face": (FLAT, None),
    "a face, clockwise": (replace(FLAT, rotation="cw" if FLAT.rotation == "ccw" else "ccw"), None),
    "a face by hand": (FLAT, Pencil(line=0.2, dividers=0.2)),
    "built-in face on a pivot": (ON_PIVOT, None),
    "a face on a pivot, clockwise": (replace(ON_PIVOT, rotation="cw", follower=OscillatingFlatTable(150, -8)), None),
    "a face on a pivot by hand": (ON_PIVOT, Pencil(line=0.2, dividers=0.2)),
}
CHAPTERS = (
    "Minimum prime radius",
    "Pressure angle",
    "Pitch curve by inversion",
    "Profile by inversion",
    "Minimum radius of curvature",
)


@pytest.fixture(scope="module")
def notes():
    return {name: note(solve(*task)) for name, task in TASKS.items()}


def chapter(text: str, title: str) -> str:
    """What the note says under a title; empty where there is no such chapter."""
    found = re.search(rf"^## \d+\. {title}\n(.*?)(?=^## )", text, re.MULTILINE | re.DOTALL)
    return found[1] if found else ""


def value(tex: str) -> float | None:
    """What a formula in TeX comes to; None where it holds a letter."""
    tex = re.sub(r"\\text\{[^}]*\}|\\,|\\ |\\left|\\right|\.$|,$", "", tex.strip()).strip(" .,")
    tex = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"((\1)/(\2))", tex)
    tex = re.sub(r"(\\sqrt)\{(.*)\}$", r"\1(\2)", tex)
    tex = re.sub(r"\\(cos|sin) ?([\d.]+)\^\\circ", r"\\\1(\2^\\circ)", tex)
    tex = re.sub(r"\\arccos(.*)\^?$", r"\\acos(\1)", tex)
    tex = tex.replace(r"\cdot", "*").replace(r"^\circ", "*DEGREE").replace("^2", "**2")
    tex = re.sub(r"(?<=[\d)]) ?(?=\(|\\)", "*", tex).replace("\\", "")
    if re.search(r"[A-Za-z_[\]{}]", re.sub(r"\b(sqrt|cos|sin|acos|DEGREE)\b", "", tex)) or not re.search(r"\d", tex):
        return None
    known = {name: getattr(math, name) for name in ("sqrt", "cos", "sin", "acos")}
    return eval(tex, {"__builtins__": {}, "DEGREE": math.pi / 180} | known)


def test_a_formula_in_tex_is_evaluated():
    assert value(r"\frac{125\,(1 + 0.4) - 150\cos(20^\circ + 10^\circ)}{150\,\sin 30^\circ}") == pytest.approx(
        0.60128, abs=1e-5
    )
    assert value(r"\sqrt{3^2 + 4^2 - 2 \cdot 3 \cdot 4\cos 90^\circ}") == pytest.approx(5)
    assert value(r"8 + 11.135\ \text{mm}.") == pytest.approx(19.135)
    assert value(r"r_0 + 2") is None


def chains(text: str) -> list[list[float]]:
    """Of every formula with numbers put in what its sides come to."""
    formulas = re.findall(r"(?<!\\)\$\$?([^$]+)\$\$?", text)
    parts = [part for each in formulas for part in each.split(r"\qquad")]
    sides = [[value(side) for side in re.split(r"=", part)] for part in parts]
    return [known for each in sides if len(known := [side for side in each if side is not None]) > 1]


@pytest.mark.parametrize("name", TASKS)
def test_every_formula_holds_for_the_numbers_put_into_it(notes, name):
    found = [chain for title in CHAPTERS for chain in chains(chapter(notes[name], title))]
    assert len(found) >= (3 if "face" in name else 5)
    for chain in found:
        assert chain[1:] == pytest.approx(chain[:-1], abs=0.006, rel=2e-4)


@pytest.mark.parametrize("name", [name for name in TASKS if "face" not in name])
def test_the_tangent_gives_the_angle(notes, name):
    text = "".join(chapter(notes[name], title) for title in CHAPTERS)
    found = re.findall(r"= (-?[\d.]+), \\qquad \\alpha\S* = (-?[\d.]+)\^\\circ", text)
    assert len(found) >= 2
    for tangent, angle in found:
        assert math.degrees(math.atan(float(tangent))) == pytest.approx(float(angle), abs=0.009)


@pytest.mark.parametrize("name", ["built-in arm", "clockwise", "anticlockwise"])
def test_what_is_calculated_is_what_was_drawn(notes, name):
    text = chapter(notes[name], "Pressure angle")
    calculated = re.search(r"\\alpha = (-?[\d.]+)\^\\circ\.\$\$", text)[1]
    drawn = re.search(r"the pressure angle at station \S+ is ([−\d.]+)°", text)[1].replace("−", "-")
    assert float(drawn) == pytest.approx(float(calculated), abs=0.011)
    start = float(re.search(r"\\arccos.* = ([\d.]+)\^\\circ\.\$\$", text)[1])
    assert float(re.search(r"B₀CA with the protractor: ψ₀ = ([\d.]+)°", text)[1]) == pytest.approx(start, abs=0.006)
    found = re.search(r"A₀B₀ = .*? so r₀ = ([\d.]+) mm", notes[name])[1]
    radius = re.search(r"\\cos [\d.]+\^\\circ\} = ([\d.]+)\\ \\text\{mm\}", notes[name])[1]
    assert float(radius) == pytest.approx(float(found), abs=0.006)


def test_the_conditions_of_an_arm_hold_at_the_cam_centre_and_one_binds(notes):
    condition = r"\\alpha_\S+ = (-?[\d.]+)\^\\circ \\([gl])e (-?\d+)\^\\circ"
    found = re.findall(condition, chapter(notes["built-in arm"], "Minimum prime radius"))
    assert [found[-1], [(side, limit) for _, side, limit in found]] == [
        ("-45.00", "g", "-45"),
        [("l", "45"), ("g", "-45")],
    ]
    for name in ("clockwise", "anticlockwise"):
        found = re.findall(condition, chapter(notes[name], "Minimum prime radius"))
        assert len(found) == 4
        for angle, side, limit in found:
            sign = 1 if side == "l" else -1
            assert sign * float(angle) <= sign * float(limit) + 0.005


def test_a_cam_centre_that_is_not_there_is_warned_of():
    hopeless = replace(ARM, limits=LimitsTable(2, 2))
    assert "At this centre distance no cam centre satisfies all the limits." in note(solve(hopeless))


def test_the_width_of_a_face_is_that_of_both_extremes_of_the_velocity(notes):
    widths = r"b_l = (.*?), \\qquad b_r = (.*?), .*?b = ([\d.]+) \+ ([\d.]+) = ([\d.]+)\\ "
    for name, sides in (
        ("built-in face", (r"-\min\frac{ds}{d\varphi}", r"\max\frac{ds}{d\varphi}")),
        ("a face, clockwise", (r"\max\frac{ds}{d\varphi}", r"-\min\frac{ds}{d\varphi}")),
    ):
        left_of, right_of, left, right, width = re.search(widths, notes[name], re.DOTALL).groups()
        assert (left_of, right_of) == sides
        assert float(width) == pytest.approx(float(left) + float(right), abs=0.011)


def test_no_prime_radius_is_too_small_where_the_sum_is_never_negative():
    gentle = MotionTable((RiseTable(175, 2, "cycloidal"), ReturnTable(185, 2, "cycloidal")))
    text = note(solve(replace(FLAT, motion=gentle, follower=FlatFacedTable(), cam=CamTable(30.0))))
    assert "At least 8 mm is required: the condition is satisfied." in text


def test_too_small_a_face_cam_is_told_to_break_the_condition():
    text = note(solve(replace(FLAT, cam=CamTable(17.0))))
    assert "**At least 8 mm is required: the condition is not satisfied.**" in chapter(
        text, "Minimum radius of curvature"
    )


def test_under_a_flat_face_there_is_one_curve_and_no_pressure_angle(notes):
    body = notes["built-in face"]
    stations = chapter(body, "Values at the stations")
    assert "pressure angle" not in stations
    assert re.search(r"^\| station +\| +φ \| +s drawn .* a exact \|$", stations, re.MULTILINE)
    assert re.search(r"^\| station +\| +φ \| +R profile \| +θ profile \|$", body, re.MULTILINE)


def test_an_arms_angles_are_told_in_degrees(notes):
    text = notes["built-in arm"]
    assert "In degrees the scale is 0.26667°/mm." in text
    assert "in degrees the lift is 15°." in text
    assert re.search(r"^\| 12 +\| +75\.00 \| +15\.000 \| 15\.0000 \|", text, re.MULTILINE)


@pytest.mark.parametrize("step", [5, 10])
def test_the_profile_is_told_at_round_angles_where_the_task_asks_for_it(step):
    solution = solve(replace(FLAT, part=PartTable(table_step=step)))
    text = note(solution)
    assert f"The exact working profile every {step}° of the polar angle" in text
    told = [(float(a), float(r)) for a, r in re.findall(r"^\| (\d+)° +\| +([\d.]+) \|$", text, re.MULTILINE)]
    assert [angle for angle, _ in told] == list(range(0, 360, step))
    points = solution.cam.profile(np.linspace(0, math.tau, 20001)) @ [1, 1j]
    turned = np.unwrap(np.angle(points / points[0])) * (1 if solution.cam.sigma < 0 else -1)
    radii = np.interp(np.radians([angle for angle, _ in told]), turned, np.abs(points))
    assert [radius for _, radius in told] == pytest.approx(radii.tolist(), abs=0.002)


def test_without_a_part_there_is_no_such_table(notes):
    assert "The exact working profile every" not in notes["built-in face"]

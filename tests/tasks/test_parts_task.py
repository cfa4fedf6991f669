"""Tasks whose motion is given by conditions: read, drawn, written and read again; every fault of a part."""

from __future__ import annotations

import math

import numpy as np
import pytest

import graphcam as gc
from graphcam.report.output_folder import write
from graphcam.tasks.task_file import builtin_text, load_task, task_from
from graphcam.tasks.task_writer import task_files

WHOLE = builtin_text("coursework")
MOTION = WHOLE[WHOLE.index("[motion]") : WHOLE.index("[follower]")]
START = "{ angle = 0, s = 0, v = 0, a = 0 }"
TOP = "{ angle = 120, s = 30, v = 0, a = 0 }"
RISE = f'{{ kind = "polynomial", points = [{START}, {{ angle = 60, s = 15, v = 22, a = 0 }}, {TOP}] }}'
BACK = (
    '{ kind = "spline", degree = 5, points = [{ angle = 160, s = 30, v = 0, a = 0 }, { angle = 200, s = 22 }, '
    "{ angle = 240, s = 8 }, { angle = 280, s = 0, v = 0, a = 0 }] }"
)
PARTS = f"[motion]\nparts = [\n  {RISE},\n  {BACK},\n]\n\n"


def task_in(folder, text: str):
    path = folder / "cam.toml"
    path.write_text(text, encoding="utf-8")
    return load_task(path)


def with_parts(*changes: tuple[str, str]) -> str:
    parts = PARTS
    for old, new in changes:
        assert old in parts
        parts = parts.replace(old, new, 1)
    return WHOLE.replace(MOTION, parts)


@pytest.mark.slow
def test_a_motion_by_conditions_is_drawn_and_written_as_any_other(tmp_path):
    task = task_in(tmp_path, with_parts())
    motion = task.motion()
    assert isinstance(motion, gc.BoundaryMotion)
    assert [phase.kind for phase in motion.phases] == ["rise", "dwell", "return", "dwell"]
    np.testing.assert_allclose(motion(np.radians([60, 200, 240]))[0], [15, 22, 8], rtol=1e-14)
    assert float(motion(math.radians(60))[1]) == pytest.approx(22, rel=1e-14)
    solution = gc.solve(task)
    for quantity in solution.to_dict()["quantities"].values():
        assert abs(quantity["error_paper"]) <= quantity["tolerance_paper"] + 1e-9
    assert "polynomial of 3 points, spline of 4 points" in repr(task)
    write(solution, tmp_path / "out")
    assert (tmp_path / "out" / "sheet.pdf").stat().st_size > 5000
    said = (tmp_path / "out" / "note.md").read_text(encoding="utf-8")
    rows = [line.split("|")[1:-1] for line in said.splitlines() if "°" in line and line.startswith("| ")]
    asked = [[cell.strip() for cell in row] for row in rows if len(row) == 5]
    assert asked[1] == ["", "60°", "15", "22", "0"]
    assert [row[0] for row in asked if row[0]] == ["polynomial, degree 8", "spline, degree 5"]


def test_it_is_read_again_from_what_was_written(tmp_path):
    task = task_in(tmp_path, with_parts((BACK, BACK.replace("degree = 5", "degree = 4, knots = [190, 215, 250]"))))
    assert task.motion.parts[1].knots == (190, 215, 250)
    assert task_in(tmp_path, task_files(task)["task.toml"]) == task
    assert task_from(task.to_dict()) == task


def test_an_arm_s_conditions_are_angles(tmp_path):
    follower = '[follower]\nkind = "oscillating"\narm = 100\ndistance = 120\n'
    text = with_parts().replace(WHOLE[WHOLE.index("[follower]") : WHOLE.index("[limits]")], follower + "\n")
    text = text.replace("pressure_angle_rise = 30", "pressure_angle_rise = 45")
    s, v, *_ = task_in(tmp_path, text).motion()(math.radians(60))
    assert (float(s), float(v)) == pytest.approx((math.radians(15), math.radians(22)), rel=1e-14)


@pytest.mark.parametrize("follower", ["translating", "flat-faced"])
@pytest.mark.parametrize("quantity", ["max_v", "max_a"])
def test_what_is_drawn_of_it_is_of_second_order(tmp_path, follower, quantity):
    errors = []
    for n in (12, 24, 48, 96):
        text = with_parts().replace("[drawing]", f"[drawing]\ndivisions = {n}").replace("divisions = 12", "", 1)
        if follower == "flat-faced":
            text = text.replace(
                WHOLE[WHOLE.index("[follower]") : WHOLE.index("[drawing]")], '[follower]\nkind = "flat-faced"\n\n'
            )
        q = gc.solve(task_in(tmp_path, text)).comparison.quantities[quantity]
        errors.append(abs(float(q.error)))
    order = -np.polyfit(np.log([12, 24, 48, 96]), np.log(errors), 1)[0]
    assert order == pytest.approx(2.0, abs=0.2)


# --- constant velocity -----------------------------------------------------------------------------------------------


def constant(**changes: str) -> str:
    keys = {"kind": '"rise"', "angle": "80", "lift": "30", "law": '"constant-velocity"', "blends": "[0.2, 0.3]"}
    old = '{ kind = "rise", angle = 80, lift = 30, law = "rectangular" }'
    said = ", ".join(f"{key} = {value}" for key, value in (keys | changes).items() if value)
    return WHOLE.replace(old, "{ " + said + " }")


def test_constant_velocity_with_blends_in_a_file(tmp_path):
    task = task_in(tmp_path, constant())
    law = task.motion().phases[0].normalised
    assert law == gc.constant_velocity_law(0.2, 0.3)
    assert law.peak_velocity == pytest.approx(2 / 1.5)
    assert task_in(tmp_path, task_files(task)["task.toml"]) == task
    assert task_in(tmp_path, constant(blends="")).motion().phases[0].normalised == gc.constant_velocity_law()


# --- faults ----------------------------------------------------------------------------------------------------------

FAULTS = {
    "a kind that is none": (('"polynomial"', '"cubic"'), "parts[0].kind", "'cubic' polynomial, spline"),
    "no kind": (('kind = "spline", ', ""), "parts[1].kind", "missing polynomial, spline"),
    "no points": (("points", "punkte"), "parts[0].punkte", "unknown points"),
    "a part that is a number": ((RISE, "5"), "parts[0]", "5 table"),
    "a point without an angle": (("angle = 60, ", ""), "parts[0].points[1].angle", "missing"),
    "an unknown key": (("angle = 60, s", "angle = 60, z"), "parts[0].points[1].z", "unknown"),
    "a degree of a half": (("degree = 5", "degree = 5.5"), "parts[1].degree", "5.5 whole number"),
    "text for a number": (("s = 15", 's = "15"'), "parts[0].points[1].s", "'15' number quotes"),
    "an angle below zero": (("angle = 60", "angle = -60"), "parts[0].points[1].angle", "-60 from 0 to 720"),
    "a slip of digits": (("s = 15", "s = 1e12"), "parts[0].points[1].s", "unit digits"),
    "no condition": (("angle = 60, s = 15, v = 22, a = 0", "angle = 60"), "parts[0].points[1].s", "missing"),
    "out of order": (("angle = 60", "angle = 130"), "parts[0].points[2].angle", "120 degrees sort"),
    "knots for a polynomial": (
        ('"polynomial", ', '"polynomial", knots = [20], '), "parts[0].knots", "left out it is for spline",
    ),
    "knots that are too many": (
        ("degree = 5", "degree = 5, knots = [200, 220, 230]"), "parts[1].knots", "2, one for each",
    ),
    "a knot below zero": (("degree = 5", "degree = 5, knots = [-1, 2]"), "parts[1].knots[0]", "-1 from 0 to 720"),
    "a degree that does not fit": (('"polynomial", ', '"polynomial", degree = 3, '), "parts[0].degree", "3 8 many"),
    "a part that swings": (("s = 15, v = 22", "s = 15, v = 2000"), "parts[0].points[0] (s behind it)", "swings"),
    "a joint": (("angle = 160, s = 30", "angle = 160, s = 29"), "parts[1] (s before it)", "30 29 equal"),
    "a turn that does not close": (("angle = 280, s = 0", "angle = 280, s = 1"), "parts (s at their end)", "1 0"),
    "more than a turn": (("angle = 280", "angle = 380"), "parts (turn)", "380 360 degrees"),
    "no parts": ((f"\n  {RISE},\n  {BACK},\n", ""), "parts", "empty one part or more"),
    "phases beside parts": (("parts =", "phases = []\nparts ="), "parts", "left out phases one of the two"),
    "a tolerance": (("parts =", "tolerance = 1\nparts ="), "tolerance", "1 left out parts exactly"),
}  # fmt: skip


def check(folder, text: str, field: str, words: str) -> None:
    with pytest.raises(gc.TaskError) as caught:
        task_in(folder, text)
    message = str(caught.value)
    assert caught.value.field == field, message
    assert all(word in message for word in words.split()), message


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_of_a_part_is_told_with_its_place(tmp_path, name):
    change, field, words = FAULTS[name]
    check(tmp_path, with_parts(change), f"motion.{field}", words)


@pytest.mark.parametrize(
    ("changes", "field", "words"),
    [
        ({"law": '"cosine"'}, "motion.phases[0].blends", "left out cosine constant-velocity"),
        ({"law": '"constant-velosity"'}, "motion.phases[0].blends", "left out constant-velosity"),
        ({"law": '"constant-velosity"', "blends": ""}, "motion.phases[0].law", "did you mean 'constant-velocity'"),
        ({"blends": "[0.6, 0.4]"}, "motion.phases[0].blends", "less than 1 together"),
        ({"blends": "[-0.1, 0.4]"}, "motion.phases[0].blends[0]", "-0.1 from 0"),
        ({"blends": "[0.2]"}, "motion.phases[0].blends[1]", "missing"),
        ({"ratio": "2"}, "motion.phases[0].ratio", "2 constant-velocity rectangular"),
    ],
)
def test_a_fault_of_blends_is_told(tmp_path, changes, field, words):
    check(tmp_path, constant(**changes), field, words)

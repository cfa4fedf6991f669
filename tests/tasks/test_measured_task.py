"""Tasks whose motion is a table in a CSV file: the whole way to the files, and every fault of a table."""

from __future__ import annotations

import copy
import json
import math
import pickle
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from over_all import over_all
from typer.testing import CliRunner

import graphcam
from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS
from graphcam.errors import DesignError, TaskError
from graphcam.given.measured import IntegratedMotion, MeasuredMotion
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.given.table_file import CurveTable, read_table
from graphcam.tasks.motion_tables import MotionTable
from graphcam.tasks.task_file import builtin_task, builtin_text, load_task
from graphcam.tasks.task_writer import task_files

TASK = builtin_text("measured")
DEGREES = np.arange(360)
EXACT = Motion([
    Rise(30, math.radians(100)), Dwell(math.radians(40)), Return(30, math.radians(90)), Dwell(math.radians(130))
])  # fmt: skip


def csv(header: str = "phi_deg,s_mm", rows=None) -> str:
    rows = zip(DEGREES, EXACT(np.radians(DEGREES))[0], strict=True) if rows is None else rows
    return header + "\n" + "".join(f"{phi:g},{value:.3f}\n" for phi, value in rows)


WHOLE = csv()


def place(folder: Path, text: str | bytes | None = WHOLE, task: str = TASK) -> Path:
    """A task file and, beside it, its table."""
    path = folder / "cam.toml"
    path.write_text(task, encoding="utf-8")
    if text is not None:
        (folder / "measured.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


# --- what a table gives ----------------------------------------------------------------------------------------------


def test_the_built_in_table_is_the_law_it_was_taken_from():
    motion = builtin_task("measured").motion()
    assert isinstance(motion, MeasuredMotion)
    phi = np.linspace(0, FULL_TURN, 5001)
    assert np.max(np.abs(motion(phi)[0] - EXACT(phi)[0])) <= motion.tolerance == 0.01
    assert [round(math.degrees(phase.angle), 9) for phase in motion.phases] == [100, 40, 90, 130]


def test_the_table_is_sought_beside_the_task_wherever_one_stands(tmp_path, monkeypatch):
    (tmp_path / "tasks").mkdir()
    path = place(tmp_path / "tasks")
    monkeypatch.chdir(tmp_path)
    tasks = load_task(path), load_task("tasks/cam.toml")
    assert tasks[0] == tasks[1] == builtin_task("measured")


@pytest.mark.slow
def test_solving_gives_the_full_set_of_files(tmp_path):
    result = CliRunner().invoke(app, ["solve", str(place(tmp_path)), "--out", str(tmp_path / "out")])
    assert result.exit_code == 0
    document = json.loads((tmp_path / "out" / "solution.json").read_text(encoding="utf-8"))
    assert document["task"]["motion"] == {"table": "measured.csv", "tolerance": 0.01}
    for name in ("pdf", "svg", "png", "dxf", "csv", "md", "note"):
        assert (tmp_path / "out" / document["files"][name]).stat().st_size > 500
    for quantity in document["quantities"].values():
        assert abs(quantity["error_paper"]) <= quantity["tolerance_paper"] + 1e-9
    exact = graphcam.minimum_radius(EXACT, graphcam.Translating(), offset=10.0).prime_radius
    assert document["quantities"]["minimum_prime_radius"]["exact"] == pytest.approx(exact, abs=0.05)


def test_the_table_belongs_to_the_task(tmp_path):
    """Once read, the file is not asked for again: a task can be changed, copied and sent elsewhere."""
    path = place(tmp_path)
    task = load_task(path)
    assert isinstance(task, graphcam.Task)
    (tmp_path / "measured.csv").unlink()
    for other in (copy.deepcopy(task), pickle.loads(pickle.dumps(task)), replace(task, rotation="cw")):
        assert other.motion().lift == task.motion().lift


def test_accelerations_are_read_as_such(tmp_path):
    values = EXACT(np.radians(DEGREES))[2]
    task = load_task(
        place(tmp_path, csv("phi_deg,a", zip(DEGREES, values, strict=True)), TASK.replace("0.01 ", "0.1 "))
    )
    motion = task.motion()
    assert isinstance(motion, IntegratedMotion)
    assert motion.lift == pytest.approx(30, abs=0.1)


def test_an_arm_s_table_is_in_degrees(tmp_path):
    text = csv("phi_deg,s_deg")
    arm = TASK.replace('kind = "translating"\noffset = 10', 'kind = "oscillating"\narm = 125')
    motion = load_task(place(tmp_path, text, arm)).motion()
    assert math.degrees(motion.lift) == pytest.approx(30, abs=0.01)
    assert math.degrees(motion.tolerance) == pytest.approx(0.01)


def test_an_arm_s_table_may_be_of_its_arc_in_mm(tmp_path):
    arm = TASK.replace('kind = "translating"\noffset = 10', 'kind = "oscillating"\narm = 125\nlift = "arc"')
    motion = load_task(place(tmp_path, task=arm)).motion()
    assert 125 * motion.lift == pytest.approx(30, abs=0.01)


HALF = Motion([Rise(10, math.radians(70)), Return(10, math.radians(70)), Dwell(math.radians(220))])


@over_all(
    ("header", "per_degree", "per_mm", "fields"),
    [
        ("phi_deg,s_mm", 1, 1, "symmetric = true"),
        ("phi_deg,s_in", 2, 1 / 25.4, "symmetric = true\nper_cam_degree = 2"),
        ("phi_rad,s_thou", math.radians(1), 1000 / 25.4, "symmetric = true"),
        ("Crank deg,Lift [mil]", 2, 1000 / 25.4, "symmetric = true\nper_cam_degree = 2"),
        ("phi_rad,s_mm", math.radians(2), 1, "symmetric = true\nper_cam_degree = 2.0"),
    ],
)
def test_half_a_cam_is_mirrored_in_any_unit(header, per_degree, per_mm, fields, tmp_path):
    """A rise over 70 degrees, typed up to the nose: the rest of the turn is a dwell."""
    degrees = np.arange(0, 71.0)
    rows = zip((degrees * per_degree).tolist(), (HALF(np.radians(degrees))[0] * per_mm).tolist(), strict=True)
    text = header + "\n" + "".join(f"{phi!r},{value:.6f}\n" for phi, value in rows)
    path = place(tmp_path, text, TASK.replace("tolerance", f"{fields}\ntolerance"))
    task = load_task(path)
    motion = task.motion()
    phi = np.linspace(0, FULL_TURN, 2001)
    assert np.max(np.abs(motion(phi - motion.zero)[0] - HALF(phi)[0])) <= 0.01
    assert [phase.kind for phase in motion.phases if phase.angle > 0.01] == ["rise", "return", "dwell"]
    # Written and read again it is the same: the table stays half of the cam.
    for name, content in task_files(task).items():
        (tmp_path / name).write_text(content, encoding="utf-8")
    again = load_task(tmp_path / "task.toml")
    assert again == task
    assert np.max(np.abs(again.motion()(phi)[0] - motion(phi)[0])) == 0


def test_crank_degrees_are_two_of_the_cam(tmp_path):
    rows = zip(2 * DEGREES, EXACT(np.radians(DEGREES))[0], strict=True)
    task = load_task(place(tmp_path, csv(rows=rows), TASK.replace("tolerance", "per_cam_degree = 2\ntolerance")))
    assert np.max(np.abs(task.motion()(np.radians(DEGREES))[0] - EXACT(np.radians(DEGREES))[0])) <= 0.01


@over_all(
    ("fields", "said"),
    [
        ("symmetric = true", "half of the cam is 359 degrees, but must be at most 180 degrees"),
        ("per_cam_degree = 2", "line 361: turn that the rows cover is 179.5 degrees"),
        ("per_cam_degree = 0", "motion.per_cam_degree is 0, but must be a finite number greater than 0"),
        ("per_cam_degree = true", "motion.per_cam_degree is true"),
        ("symmetric = 1", "motion.symmetric is 1"),
    ],
)
def test_a_part_of_a_turn_that_cannot_be_is_refused(fields, said, tmp_path):
    with pytest.raises(TaskError) as caught:
        load_task(place(tmp_path, task=TASK.replace("tolerance", f"{fields}\ntolerance")))
    assert said in str(caught.value)


def test_phases_are_not_mirrored():
    for fields in ({"symmetric": True}, {"per_cam_degree": 2.0}):
        with pytest.raises(DesignError, match="left out where there is no table"):
            MotionTable(graphcam.builtin_task("coursework").motion.phases, **fields)


def test_a_table_may_carry_a_byte_order_mark_blanks_and_windows_line_ends(tmp_path):
    text = WHOLE.replace("\n", "\r\n").replace(",", " , ")
    place(tmp_path, b"\xef\xbb\xbf" + text.encode() + b"\r\n")
    assert read_table(tmp_path / "measured.csv", "x").rows[2] == (2.0, 0.002)


@pytest.mark.parametrize(
    "spoken",
    [
        WHOLE.replace(",", ";").replace(".", ","),
        WHOLE.replace(",", ";"),
        WHOLE.replace(",", "\t").replace(".", ","),
        '"' + WHOLE.replace(",", '";"').replace(".", ",").replace("\n", '"\n"').removesuffix('"'),
    ],
    ids=["semicolons and decimal commas", "semicolons and decimal points", "tabs", "quotes around every cell"],
)
def test_a_table_is_read_as_spreadsheets_of_other_countries_write_it(spoken, tmp_path):
    place(tmp_path, WHOLE)
    plain = read_table(tmp_path / "measured.csv", "x")
    assert read_table(place(tmp_path, spoken).with_name("measured.csv"), "x") == plain
    assert plain.rows[2] == (2.0, 0.002)


def test_a_table_that_is_missing_is_named_beside_its_task(tmp_path, monkeypatch):
    place(tmp_path, None, TASK.replace("measured.csv", "motion.csv"))
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, ["solve", "cam.toml"])
    assert (result.exit_code, result.stdout) == (INPUT_ERROR_STATUS, "")
    assert result.stderr == "graphcam: there is no file motion.csv beside cam.toml; check motion.table\n"
    assert [entry.name for entry in tmp_path.iterdir()] == ["cam.toml"]


# --- what cannot be --------------------------------------------------------------------------------------------------


def line(number: int, text: str) -> str:
    """The table with another line."""
    lines = WHOLE.splitlines()
    lines[number - 1] = text
    return "\n".join(lines)


# The table's text; where the error is, and the words of its message.
FAULTS = {
    "empty": ("", "line 1", "'' 'phi_deg,s_mm' 'phi_deg,a'"),
    "no header": (WHOLE.split("\n", 1)[1], "line 1", "'0,0.000' phi_deg,s_mm"),
    "another header": (csv("angle,lift"), "line 1", "'angle,lift' phi_deg,s_mm"),
    "three columns": (csv("phi_deg,s_mm,v"), "line 1", "phi_deg,s_mm"),
    "a third number": (line(7, "5,0.037,1"), "line 7", "'5,0.037,1' two finite numbers"),
    "one number": (line(7, "5"), "line 7", "'5' point semicolons"),
    "a word": (line(9, "7,seven"), "line 9", "'7,seven' two finite numbers"),
    "a decimal comma": (line(9, "7,0,1"), "line 9", "decimals point"),
    "nan": (line(12, "10,nan"), "line 12", "'10,nan' finite"),
    "infinite": (line(12, "10,-inf"), "line 12", "'10,-inf' finite"),
    "an empty line": (line(20, ""), "line 20", "'' two finite numbers"),
    "too few": ("\n".join(WHOLE.splitlines()[:8]), "line 8: number of rows", "7 8 to 10000"),
    "only a header": ("phi_deg,s_mm\n", "line 2: number of rows", "0 8"),
    "not growing": (line(31, "27,7"), "line 31: cam angle", "27 degrees 28 degrees sort"),
    "repeated": (line(31, "28,7"), "line 31: cam angle", "28 degrees once"),
    "half a turn": ("\n".join(WHOLE.splitlines()[:182]), "line 182: turn that the rows cover", "180 degrees 360"),
    "angles in radians": (
        "phi_deg,s_mm\n" + "".join(f"{math.radians(phi):.6f},0\n" for phi in DEGREES),
        "line 361: turn that the rows cover", "6.26 2 pi in degrees, not in radians",
    ),
    "more than a turn": (WHOLE + "360.5,0\n", "line 362: turn that the rows cover", "360.5 degrees"),
    "not closed": (WHOLE + "360,0.5\n", "line 362: last row", "0.5 0 as in the first"),
    "not UTF-8": (WHOLE.encode() + b"\xff\xfe", "line 362", "UTF-8"),
    "a picture": (b"\x89PNG\r\n\x1a\n\x00\x00", "the table", "picture CSV"),
}  # fmt: skip


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_of_a_table_gets_one_message_and_leaves_nothing(fault, tmp_path):
    text, where, words = FAULTS[fault]
    path = place(tmp_path, text)
    before = sorted(entry.name for entry in tmp_path.iterdir())
    result = CliRunner().invoke(app, ["solve", str(path), "--out", str(tmp_path / "out")])
    assert result.exit_code == INPUT_ERROR_STATUS
    assert result.stdout == ""
    message = result.stderr.removesuffix("\n")
    assert "\n" not in message
    assert message.startswith(f"graphcam: {tmp_path / 'measured.csv'}: {where} is ")
    assert [word for word in words.split() if word not in message] == []
    assert message.count(", but must be ") == 1
    assert "; " in message.split(", but must be ")[1]
    assert sorted(entry.name for entry in tmp_path.iterdir()) == before


MOTION = TASK[TASK.index("[motion]") : TASK.index("[follower]")]
# What the task's [motion] says instead; the field and the words of the message.
MISFITS = {
    "a table that is a number": ("table = 3", "motion.table", "3 text quotes"),
    "a table that is a list": ("table = [[0, 0]]", "motion.table", "list text"),
    "a table and phases": (
        'table = "measured.csv"\nphases = [{ kind = "dwell", angle = 360 }]', "motion.table", "left out one two"
    ),
    "a tolerance of zero": ('table = "measured.csv"\ntolerance = 0', "motion.tolerance", "0 greater"),
    "a tolerance in quotes": ('table = "measured.csv"\ntolerance = "1"', "motion.tolerance", "'1' number"),
    "a tolerance that is no number": ('table = "measured.csv"\ntolerance = nan', "motion.tolerance", "nan finite"),
    "a tolerance beyond the lift": ('table = "measured.csv"\ntolerance = 20', "motion.table (lift)", "30 40 smaller"),
    "a tolerance below what a spline can": (
        'table = "measured.csv"\ntolerance = 1e-6', "motion.tolerance", "1e-06 spline greater"
    ),
    "a tolerance of phases": (
        'phases = [{ kind = "dwell", angle = 360 }]\ntolerance = 1', "motion.tolerance", "left out table"
    ),
    "a mistyped tolerance": ('table = "measured.csv"\ntolernce = 1', "motion.tolernce", "did you mean 'tolerance'"),
}  # fmt: skip


@pytest.mark.parametrize("fault", MISFITS)
def test_a_motion_that_does_not_fit_its_table_is_named(fault, tmp_path):
    said, field, words = MISFITS[fault]
    path = place(tmp_path, task=TASK.replace(MOTION, f"[motion]\n{said}\n\n"))
    with pytest.raises(TaskError) as caught:
        load_task(path)
    assert (caught.value.path, caught.value.field) == (str(path), field)
    assert [word for word in words.split() if word not in str(caught.value)] == []


ARM = TASK.replace('kind = "translating"\noffset = 10', 'kind = "oscillating"\narm = 125')


@pytest.mark.parametrize(
    ("header", "task", "words"),
    [("phi_deg,s_deg", TASK, "s_deg, but must be s_mm"), ("phi_deg,s_mm", ARM, "s_mm, but must be s_deg")],
)
def test_a_column_in_the_other_follower_s_unit_is_refused(header, task, words, tmp_path):
    with pytest.raises(TaskError) as caught:
        load_task(place(tmp_path, csv(header), task))
    assert f"motion.table (column) is {words} for this follower" in str(caught.value)


def test_a_table_in_python():
    rows = tuple(zip(DEGREES.tolist(), EXACT(np.radians(DEGREES))[0].tolist(), strict=True))
    table = CurveTable("rows", "s_mm", rows)
    assert MotionTable(table=table)().lift == pytest.approx(30, abs=0.01)
    with pytest.raises(DesignError, match="phases is missing"):
        MotionTable()

"""Task files with a table [arcs]: read, refused with a reason, solved, written."""

from __future__ import annotations

import json
import math
import re
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from over_all import fast_first
from three_arcs import CASE, EXAMPLE
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS
from graphcam.errors import DesignError, TaskError
from graphcam.report.arcs_report import arcs_note
from graphcam.report.output_folder import write
from graphcam.tasks.arcs_task import ArcsTable, ArcsTask, RollerTable
from graphcam.tasks.task_file import builtin_arcs_task, builtin_text, load_task

WHOLE = builtin_text("arcs")
ROUNDING_PAPER = 1e-9
"""mm, of a hand without error where the construction has no error of method"""
STATION = {"phi_deg", "phase", "s", "v", "a", "pressure_angle_deg", "pitch"}
ALWAYS = {"max_v", "max_a", "minimum_prime_radius", "minimum_offset", "max_pressure_angle_rise_deg",
          "max_pressure_angle_return_deg", "min_pitch_curvature_radius", "roller_radius"}  # fmt: skip


@pytest.fixture(scope="module")
def solution():
    return gc.solve(builtin_arcs_task())


@pytest.fixture(scope="module")
def document(solution):
    return json.loads(json.dumps(solution.to_dict(), allow_nan=False))


def file_of(text: str, tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text(text, encoding="utf-8")
    return path


# --- reading ---------------------------------------------------------------------------------------------------------


def test_the_built_in_task_is_the_published_example():
    task = builtin_arcs_task()
    for name in ("A", "D", "G", "C1", "C2"):
        assert list(getattr(task.arcs, name)) == CASE[name]
    assert task.arcs.rho1 == CASE["rho1"]
    assert task.arcs.dwell == CASE["phases"][1]


def test_a_task_mirrors_its_file(tmp_path):
    task = load_task(file_of(WHOLE, tmp_path))
    assert task == builtin_arcs_task()
    file, back = tomllib.loads(WHOLE), task.to_dict()
    for table in ("arcs", "follower"):
        assert back[table] == file[table]
    assert back["drawing"] == {"language": "en"} | file["drawing"]


def test_centres_may_be_left_out(tmp_path):
    text = "\n".join(line for line in WHOLE.splitlines() if not line.startswith(("C1", "C2")))
    task = load_task(file_of(text, tmp_path))
    assert task.arcs().design_case == 4
    assert "C1" not in task.to_dict()["arcs"]


FAULTS = {
    "a mistyped key": (("rho1", "roh1"), "arcs.roh1", "unknown did you mean 'rho1'"),
    "a table of another kind": (("[follower]", "[motion]"), "motion", "unknown arcs"),
    "a key of another kind": (("divisions = 4", "ordinate = 4"), "drawing.ordinate", "unknown"),
    "no D": (("D = [51.68, 18.81]", ""), "arcs.D", "missing graphcam init"),
    "a point of one number": (("[22.24, 37.84]", "[22.24]"), "arcs.G[1]", "missing"),
    "a point of three": (("[22.24, 37.84]", "[22.24, 37.84, 0]"), "arcs.G", "list 2"),
    "a point that is a number": (("[22.24, 37.84]", "22.24"), "arcs.G", "22.24 list"),
    "a point of texts": (("[22.24, 37.84]", '["x", 37.84]'), "arcs.G[0]", "'x' number quotes"),
    "a point at infinity": (("[22.24, 37.84]", "[inf, 37.84]"), "arcs.G[0]", "finite"),
    "a point in the centre": (("[51.68, 18.81]", "[0, 0]"), "arcs.D", "away from the cam centre"),
    "no radius": (("rho1 = 17", "rho1 = 0"), "arcs.rho1", "0 more than 0 mm"),
    "a radius beyond the centre": (
        ("rho1 = 17 ", "rho1 = 60 "), "arcs.rho1", "60 less than smaller radius",
    ),
    "neither A nor C2": (("A = [0, 40]", ""), "arcs.C2", "left out give C2 or A"),
    "a dwell of a turn": (("dwell = 40", "dwell = 360"), "arcs.dwell", "360 less than"),
    "a negative roller": (("roller_radius = 10", "roller_radius = -1"), "follower.roller_radius", "-1 0 mm or more"),
    "another follower": (('"translating"', '"oscillating"'), "follower.kind", "'oscillating' 'translating'"),
    "too few parts": (("divisions = 4", "divisions = 1"), "drawing.divisions", "1 from 2"),
    "an unknown format": (('"A1"', '"A5"'), "drawing.format", "'A5' 'A1'"),
    "a speed of zero": (("[title]", "speed_rpm = 0\n[title]"), "speed_rpm", "0 greater than 0 rpm"),
    "arcs that are a number": ((WHOLE, "arcs = 3\n"), "arcs", "3 table"),
}  # fmt: skip
ALSO_LEFT_OUT = {"neither A nor C2": ("C2",), "a radius beyond the centre": ("C1",)}
"""Centres without which there is a fault at all."""


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_named_with_its_remedy(fault, tmp_path):
    (before, after), field, words = FAULTS[fault]
    assert before in WHOLE
    lines = WHOLE.replace(before, after).splitlines()
    text = "\n".join(line for line in lines if not line.startswith(ALSO_LEFT_OUT.get(fault, ("-",))))
    path = file_of(text, tmp_path)
    with pytest.raises(TaskError) as caught:
        load_task(path)
    message = str(caught.value)
    assert re.match(rf"{re.escape(str(path))}: (line \d+: )?{re.escape(field)} is ", message), message
    assert [word for word in words.split() if word not in message] == [], message
    result = CliRunner().invoke(app, ["solve", str(path), "--out", str(tmp_path / "out")])
    assert result.exit_code == INPUT_ERROR_STATUS
    assert result.stderr == f"graphcam: {message}\n"
    assert [entry.name for entry in tmp_path.iterdir()] == ["cam.toml"]


REFUSED = {
    "hollow": ({"G": (22.24, 30), "A": None}, "not sound", "hollow"),
    "A off its arc": ({"A": (0, 42)}, "A is", "make A and C2 agree"),
    "a dwell too long": ({"dwell": 300}, "rise, dwell and return", "shorten the dwell"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_cam_that_cannot_be_built_is_refused_with_the_reason(name, tmp_path):
    change, quantity, words = REFUSED[name]
    task = ArcsTask(ArcsTable(**(EXAMPLE | {"dwell": 40} | change)))
    with pytest.raises(DesignError) as caught:
        gc.solve(task)
    assert quantity in str(caught.value)
    assert words in str(caught.value)


# --- solving ---------------------------------------------------------------------------------------------------------


def test_the_document_has_the_shape_of_every_solution(document):
    assert document.keys() == {"graphcam", "task", "cam", "scales", "quantities", "stations", "warnings", "files"}
    assert document["task"] == builtin_arcs_task().to_dict()
    assert {"prime_radius", "offset", "roller_radius", "rotation"} <= document["cam"].keys()
    assert document["scales"].keys() == {"phi", "s", "v", "a"}
    assert document["quantities"].keys() >= ALWAYS
    for quantity in document["quantities"].values():
        assert quantity.keys() == {"drawn", "exact", "unit", "error", "error_paper", "tolerance_paper"}
    for station in document["stations"]:
        assert station.keys() == STATION
    assert document["cam"]["rotation"] == "ccw"


def test_both_roots_are_told_with_their_reasons(document):
    sound, other = document["cam"]["roots"]
    assert sound["C3"] == pytest.approx(CASE["computed_C3"], abs=1e-12)
    assert sound["F"] == pytest.approx(CASE["computed_F"], abs=1e-12)
    assert other["C3"] == pytest.approx(CASE["computed_unsound_C3"], abs=1e-12)
    assert (sound["sound"], other["sound"]) == (True, False)
    assert "C₁, F, C₃ instead of F, C₁, C₃" in other["why"]


def test_a_hand_without_error_draws_every_quantity_to_rounding(solution):
    """All but the greatest pressure angle, which lies inside an arc and is read off a faired curve."""
    for name, quantity in solution.comparison.quantities.items():
        if name in ("minimum_prime_radius", "minimum_offset"):
            assert math.isnan(quantity.drawn)
            assert math.isnan(quantity.exact)
            continue
        assert abs(quantity.error_paper) <= quantity.tolerance_paper, name
        if "pressure_angle" not in name:
            assert abs(quantity.error_paper) < ROUNDING_PAPER, name


def test_a_centre_whose_lines_cross_too_flatly_is_told(solution):
    far = replace(solution.task, arcs=replace(solution.task.arcs, A=(-3.0, 36.0), C2=None))
    found = gc.solve(far)
    # The second arc is almost straight.
    assert found.cam.rho2 == pytest.approx(1220.2, abs=0.1)
    assert math.isnan(found.comparison.quantities["rho2"].drawn)
    (said,) = found.warnings
    assert "C₂ cannot be drawn: the lines to it cross at less than 1°, 1220 mm away" in said
    assert solution.warnings == []


def test_stations_are_drawn_as_they_are_exactly(document):
    assert [station["phase"] for station in document["stations"]] == [0] * 5 + [1] * 5 + [2] * 5
    for station in document["stations"]:
        for name in ("s", "v", "a", "pressure_angle_deg"):
            assert station[name]["drawn"] == pytest.approx(station[name]["exact"], abs=1e-10)
        assert station["pitch"]["drawn"] == pytest.approx(station["pitch"]["exact"], abs=1e-10)
    # Where the arcs meet in G, there are two accelerations and one of all else.
    before, after = document["stations"][4:6]
    assert before["v"]["exact"] == pytest.approx(after["v"]["exact"], rel=1e-12)
    assert before["a"]["exact"] > after["a"]["exact"] + 10


def test_a_trembling_hand_stays_within_its_bounds():
    pencil = gc.Pencil(line=0.1, dividers=0.1, protractor=0.002, seed=4)
    quantities = gc.solve(builtin_arcs_task(), pencil).comparison.quantities.values()
    off = [q.name for q in quantities if abs(q.error_paper) > q.tolerance_paper]
    assert off == []
    assert max(abs(q.error_paper) for q in quantities if math.isfinite(q.error_paper)) > 0.02


def test_the_scales_are_those_of_the_diagrams(solution, document):
    board = solution.chain.board
    plotted, rolled = solution.drawn["arc_diagrams"], solution.drawn["arc_roller"]
    for name in ("s", "v", "a"):
        assert np.allclose(plotted.first(name).imag * document["scales"][name]["per_mm"], rolled.value(name), atol=1e-9)
    assert np.allclose(plotted.first("s").real * document["scales"]["phi"]["per_mm"], np.degrees(rolled.first("phi")))
    assert board.mu_l.per_mm == 0.5


def test_a_speed_adds_velocity_and_acceleration_at_it():
    task = replace(builtin_arcs_task(), speed_rpm=300.0)
    note = arcs_note(gc.solve(task))
    motion = gc.solve(task).motion
    omega = 300 * math.tau / 60
    assert f"{motion.max_velocity()[0] * omega / 1000:.4g} m/s" in note
    assert f"{motion.max_acceleration()[0] * omega**2 / 1000:.4g} m/s²" in note


# --- writing ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("paper", fast_first(["A3", "A1", "A4"]))
def test_sheet_tables_and_note_are_written(paper, tmp_path):
    task = builtin_arcs_task()
    solution = gc.solve(replace(task, drawing=replace(task.drawing, format=paper)))
    files = write(solution, tmp_path)
    assert all((tmp_path / name).is_file() for name in files.values() if name)
    assert {kind for kind, name in files.items() if name} >= {"pdf", "svg", "png", "dxf", "csv", "md", "note"}
    written = json.loads((tmp_path / "solution.json").read_text(encoding="utf-8"))
    assert written["files"] == files
    text = "".join(path.read_text(encoding="utf-8") for path in tmp_path.glob("sheet*.svg"))
    text = re.sub(r"<[^>]+>", "", text)  # an index is an element of its own
    for word in ("Three arcs", "The roller on the arcs", "Velocity v", "Displacement s", "C3′", "drawn and exact"):
        assert word in text


def test_the_note_tells_case_construction_roots_impact_and_comparison(solution):
    note = arcs_note(solution)
    for part in (
        "design case 1", "Where the bisector meets the line G C₂ is C₃ = (12.003, −14.394) mm",
        "the profile would turn back in a cusp at F", "the impact is soft", "| 57.95°", "Every drawn value lies within",
    ):  # fmt: skip
        assert part in note, part
    open_ = ArcsTask(ArcsTable(D=EXAMPLE["D"], G=EXAMPLE["G"], rho1=17, A=(0, 40)), RollerTable())
    said = arcs_note(gc.solve(open_))
    assert "design case 4" in said
    assert "Bisect AG: compass" in said
    assert "The knife edge moves along the arcs" in said


def test_the_command_line_solves_it(tmp_path):
    path = file_of(WHOLE, tmp_path)
    result = CliRunner().invoke(app, ["solve", str(path), "--json", "--divisions", "6", "--pencil", "0.1"])
    assert result.exit_code == 0
    document = json.loads(result.stdout)
    assert len(document["stations"]) == 3 * 7
    assert document["quantities"]["F_x"]["drawn"] != pytest.approx(document["quantities"]["F_x"]["exact"], abs=1e-3)

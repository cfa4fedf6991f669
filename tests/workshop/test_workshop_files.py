"""What the workshop gets of a solution: which files, when, and what the task's table says of them."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import ezdxf
import numpy as np
import pytest
from over_all import fast_first
from test_gcode import contour, xy
from test_spline import greatest_distance
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.errors import DesignError
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.task import CamTable

CUTTING = ["profile_step", "profile_gcode"]
TASKS = ("coursework", "arm", "flat", "measured", "arcs")


def solved(part: PartTable | None = None):
    return gc.solve(replace(gc.builtin_task(), part=part))


@pytest.mark.parametrize("name", fast_first(TASKS, 2))
def test_every_cam_has_a_solid_and_a_program_whose_bytes_repeat(name, tmp_path):
    task = gc.load_task(f"graphcam/data/tasks/{name}.toml")
    for folder in ("a", "b"):
        written = gc.solve(task).write(tmp_path / folder, CUTTING)
        assert {name for name in written.values() if name} == {"profile.step", "profile.ngc"}
    for file in ("profile.step", "profile.ngc"):
        assert (tmp_path / "a" / file).read_bytes() == (tmp_path / "b" / file).read_bytes()
        assert b"\r" not in (tmp_path / "a" / file).read_bytes()


@pytest.mark.slow
def test_they_come_with_the_working_drawing_and_not_by_themselves(tmp_path):
    solution = solved()
    plain = solution.write(tmp_path / "plain", ["csv"])
    assert plain["profile_step"] is plain["profile_gcode"] is None
    runner = CliRunner()
    for option, there in (([], False), (["--working-drawing"], True)):
        place = tmp_path / f"out{len(option)}"
        assert runner.invoke(app, ["solve", "--out", str(place), *option]).exit_code == 0
        files = json.loads((place / "solution.json").read_text(encoding="utf-8"))["files"]
        for kind in CUTTING:
            assert (files[kind] is not None) == there
            assert not there or (place / files[kind]).is_file()


def test_the_part_says_cutter_feed_and_tolerance(tmp_path):
    solution = solved(PartTable(cutter_radius=6.0, feed=80.0, profile_tolerance=0.02))
    solution.write(tmp_path, CUTTING)
    text = (tmp_path / "profile.ngc").read_text()
    assert "(WAY OF THE CENTRE OF A CUTTER OF RADIUS 6 MM)" in text
    assert "(TOLERANCE 0.002 MM, " in text
    assert " F80\n" in text
    phi = np.linspace(0, 2 * np.pi, 100_000, endpoint=False)
    pitch, profile = solution.cam.pitch_curve(phi), solution.cam.profile(phi)
    centres = profile + 6.0 * (pitch - profile) / solution.cam.roller_radius
    assert greatest_distance(xy(contour(text)), centres) <= 0.002


@pytest.mark.parametrize(("degree", "count"), [(2, 60), (3, 30), (4, 50), (5, 64)])
def test_the_part_asks_for_a_spline_and_hears_its_error(degree, count, tmp_path):
    solution = solved(PartTable(spline_degree=degree, spline_control_points=count))
    solution.write(tmp_path, ["profile_dxf", "profile_step"])
    told = json.loads((tmp_path / "solution.json").read_text(encoding="utf-8"))["profile_spline"]
    assert told["degree"] == degree
    assert told["control_points"] == count
    document = ezdxf.readfile(tmp_path / "profile.dxf")
    (spline,) = document.modelspace()
    assert spline.dxf.degree == degree
    assert len(spline.control_points) == count
    # As ezdxf evaluates it, against the exact profile.
    tool = spline.construction_tool()
    read = np.array([tuple(p)[:2] for p in tool.points(np.linspace(0, tool.max_t, 4000))])
    assert greatest_distance(read, solution.cam.trimmed_profile(100_000)) <= 1.05 * told["deviation"]
    (said,) = (value for name, value in document.header.custom_vars if "exact profile" in name)
    assert float(said) == pytest.approx(told["deviation"], rel=0.05)
    (in_step,) = re.findall(r"exact profile (\S+) mm", (tmp_path / "profile.step").read_text())
    assert in_step == said


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ({"spline_control_points": 5}, r"part.spline_control_points is 5, but must be \d+ to 2000 for this profile"),
        ({"cutter_radius": 60.0}, r"part.cutter_radius is 60.0, but must be less than 47.97 mm, the minimum radius"),
        ({"bore": 64.0}, r"part.bore is 64 mm.*small enough to leave a wall"),
    ],
)
def test_what_cannot_be_made_is_refused_and_nothing_is_written(said, message, tmp_path):
    with pytest.raises(DesignError, match=message):
        solved(PartTable(**said)).write(tmp_path / "out", ["profile_dxf", *CUTTING])
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("said", [{"feed": 0.0}, {"feed": -3.0}, {"spline_degree": 6}, {"spline_degree": 1}])
def test_a_part_has_a_feed_and_a_degree_that_can_be(said):
    with pytest.raises(DesignError, match=next(iter(said))):
        PartTable(**said)


def test_of_an_undercut_cam_what_can_be_cut_is_written(tmp_path):
    """Both files have its corner, which the program passes with the cutter on an arc about it."""
    task = gc.builtin_task()
    sharp = replace(task, cam=CamTable(44.0), follower=replace(task.follower, roller_radius=30.0))
    solution = gc.solve(replace(sharp, part=PartTable(bore=6.0, cutter_radius=4.0)))
    corners = [complex(*lost.crossing[2:]) for lost in solution.cam.undercuts()]
    assert corners
    solution.write(tmp_path, CUTTING)
    text = (tmp_path / "profile.ngc").read_text()
    way = contour(text)
    for corner in corners:
        assert np.sum(np.abs(np.abs(way - corner) - 4.0) <= 0.005) > 100
        x, y = (f"{value:.9f}"[:12] for value in (corner.real, corner.imag))
        assert re.search(
            rf"CARTESIAN_POINT\('',\({re.escape(x[:9])}\d*,{re.escape(y[:9])}", (tmp_path / "profile.step").read_text()
        )

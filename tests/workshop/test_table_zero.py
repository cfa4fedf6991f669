"""Cam angle 0 is that of the table, wherever the motion's phases begin: two cams of one shaft keep their timing."""

from __future__ import annotations

import csv
import json
import math
import tempfile
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from numpy.testing import assert_allclose
from over_all import over_all
from scipy.spatial import cKDTree

import graphcam as gc
from graphcam.given.laws import Floats
from graphcam.report.mechanism_view import cam_scene
from graphcam.workshop.part_outline import of_cam
from graphcam.workshop.polar_table import PolarCurve

R0 = 40.0
ROWS = np.radians(np.arange(0.0, 360.0, 2.0))


def displacement(phi: Floats, turned: float) -> Floats:
    """A motion without dwells whose turning points lie anywhere, never less than 0."""
    at = phi - turned
    return 13 - 11 * np.cos(at) + 2 * np.sin(2 * at)


def cam(turned: float, rotation: str = "ccw") -> gc.Cam:
    motion = gc.measured_motion(ROWS, displacement(ROWS, turned), 0.001)
    return gc.Cam(motion, gc.Translating(offset=0, roller_radius=0), R0, rotation=rotation)


def on_cam(phi: Floats, turned: float, rotation: str) -> np.ndarray:
    """Where a knife edge over the centre stands on the cam at cam angles of the table, x + i y."""
    s = displacement(phi, turned)
    s = s - displacement(np.linspace(0, math.tau, 100_001), turned).min()
    return (R0 + s) * np.exp(1j * (math.pi / 2 - {"ccw": 1, "cw": -1}[rotation] * phi))


def distances(points: np.ndarray, curve: np.ndarray) -> np.ndarray:
    """From points to the nearest ones of a dense curve."""
    return cKDTree(np.stack([curve.real, curve.imag], axis=-1)).query(np.stack([points.real, points.imag], axis=-1))[0]


@over_all(("turned", "rotation"), [(1.7, "cw"), (3.9, "ccw")])
def test_files_stand_as_the_table_says(turned, rotation):
    made = cam(turned, rotation)
    assert made.motion.zero != 0
    with tempfile.TemporaryDirectory() as folder:
        files = gc.write_profile(made, folder, ("csv", "xyz", "step", "gcode"), bore=12)
        rows = np.array([list(map(float, row)) for row in list(csv.reader(files["csv"].read_text().splitlines()))[1:]])
        xyz = np.loadtxt(files["xyz"])
        program = files["gcode"].read_text()
    assert_allclose(rows[:, 1] + 1j * rows[:, 2], on_cam(np.radians(rows[:, 0]), turned, rotation), atol=0.01)
    assert_allclose(xyz[:-1, :2], rows[:, 1:3], atol=1e-8)
    dense = on_cam(np.linspace(0, math.tau, 20_000), turned, rotation)
    moves = [line for line in program.splitlines() if line.startswith(("G2 ", "G3 "))]
    ends = np.array([complex(*(float(word[1:]) for word in line.split()[1:3])) for line in moves])
    assert len(ends) > 10
    # All but leads lie on the profile.
    away = distances(ends, dense)
    assert np.median(away) < 0.02
    outline = of_cam(made)
    # The zero mark and the keyway stand where the follower meets the cam at the table's angle 0.
    assert outline.zero == pytest.approx(math.pi / 2, abs=1e-9)
    theta = np.linspace(0.1, 6.1, 50)
    assert_allclose(PolarCurve(outline).radius(theta), np.abs(on_cam(theta, turned, rotation)), atol=0.01)


@over_all("turned", [0.4, 2.0, 4.1])
def test_the_spline_is_turned_with_the_rest(turned):
    made = cam(turned)
    with tempfile.TemporaryDirectory() as folder:
        files = gc.write_profile(made, folder, "dxf")
        (spline,) = ezdxf.readfile(files["dxf"]).modelspace().query("SPLINE")
        points = np.array([complex(p[0], p[1]) for p in spline.construction_tool().approximate(2000)])
    dense = on_cam(np.linspace(0, math.tau, 20_000), turned, "ccw")
    assert distances(points, dense).max() < 0.02
    assert_allclose(np.abs(points).max(), np.abs(dense).max(), atol=0.01)


def test_a_solution_tells_where_its_phases_begin_and_the_player_turns_from_the_table_s_zero(tmp_path: Path):
    """The pair of one shaft: the same motion, 60 degrees later on the second cam."""
    tops, sheets = [], []
    for name, turned in (("x", 0.4), ("y", 0.4 + math.radians(60))):
        rows = zip(np.degrees(ROWS).tolist(), displacement(ROWS, turned).tolist(), strict=True)
        text = "phi_deg,s_mm\n" + "".join(f"{phi:g},{s:.4f}\n" for phi, s in rows)
        (tmp_path / f"{name}.csv").write_text(text, encoding="utf-8")
        (tmp_path / f"{name}.toml").write_text(
            f'rotation = "ccw"\n[motion]\ntable = "{name}.csv"\n[follower]\nkind = "translating"\noffset = 0\n'
            f"roller_radius = 4\n[cam]\nprime_radius = {R0}\n",
            encoding="utf-8",
        )
        solution = gc.solve(gc.load_task(tmp_path / f"{name}.toml"))
        plain = json.loads(json.dumps(solution.to_dict()))
        rise = next(one for one in plain["phases"] if one["kind"] == "rise")
        dense = np.linspace(0, math.tau, 36_001)
        lowest = math.degrees(dense[np.argmin(displacement(dense, turned))])
        assert rise["begins_deg"] % 360 == pytest.approx(lowest, abs=0.1)
        tops.append(rise["ends_deg"] % 360)
        scene = cam_scene(solution)
        assert scene.s[0] == pytest.approx(
            displacement(np.zeros(1), turned)[0] - displacement(dense, turned).min(), abs=0.01
        )
        assert (scene.phases[0].start, scene.phases[-1].end) == (0.0, math.tau)
        assert all(a.end == b.start for a, b in zip(scene.phases, scene.phases[1:], strict=False))
        radii, angles = np.abs(scene.profile), np.degrees(np.angle(scene.profile))
        sheets.append(angles[radii.argmax()])
    assert (tops[1] - tops[0]) % 360 == pytest.approx(60, abs=0.1)
    assert (sheets[0] - sheets[1]) % 360 == pytest.approx(60, abs=1)

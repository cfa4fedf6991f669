"""The files of a bare cam are those of a solved task with the same cam; own laws and measured motions have them too."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import numpy as np
import pytest

import graphcam as gc
from graphcam.tasks.part_table import PartTable

ALL = ["csv", "dxf", "xyz", "step", "gcode"]
PART = {"bore": 16.0, "width": 12.0, "cutter_radius": 6.0}


def test_files_are_those_of_the_task(tmp_path):
    task = gc.builtin_task()
    task = replace(task, part=PartTable(**PART), drawing=replace(task.drawing, frame="iso"))
    solution = gc.solve(task)
    names = solution.write(tmp_path / "task", files=[f"profile_{kind}" for kind in ALL])
    name = task.title.name
    paths = gc.write_profile(solution.cam, tmp_path / "cam", ALL, name=name, **PART)
    assert list(paths) == ALL
    for kind, path in paths.items():
        assert path.read_bytes() == (tmp_path / "task" / names[f"profile_{kind}"]).read_bytes(), kind


def test_only_what_is_asked_for_is_written_and_other_files_stay(tmp_path):
    (tmp_path / "mine.txt").write_text("mine", encoding="utf-8")
    gc.write_profile(gc.solve(gc.builtin_task()).cam, tmp_path, "xyz")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine.txt", "profile.xyz"]


def test_own_laws_and_measured_motions_are_written(tmp_path):
    own = gc.Law("own", lambda u: (u**2 * (3 - 2 * u), 6 * u * (1 - u), 6 - 12 * u, -12 + 0 * u))
    motion = gc.Motion([gc.Rise(10, radians(180), own), gc.Return(10, radians(180), own)])
    phi = np.radians(np.arange(0, 360, 2.0))
    measured = gc.measured_motion(phi, motion(phi)[0], tolerance=0.01)
    for k, each in enumerate((motion, measured)):
        cam = gc.Cam(each, gc.Translating(roller_radius=8), 40)
        path = gc.write_profile(cam, tmp_path / str(k), "csv")["csv"]
        table = np.genfromtxt(path, delimiter=",", names=True)
        written = np.stack([table["x"], table["y"]], axis=1)
        assert np.allclose(written, cam.profile(np.radians(table["phi_deg"])), rtol=0, atol=1e-8)


@pytest.mark.parametrize(
    ("kinds", "part", "said"),
    [
        ("stp", {}, "kinds is 'stp', but must be of csv, dxf, xyz, step, gcode; did you mean 'step'"),
        ("step", {"bor": 20}, "part is bor = 20, but must be what a table .part. has; did you mean 'bore'"),
        ("step", {"bore": 200.0}, "bore"),
        ("gcode", {"cutter_radius": -1.0}, "cutter_radius"),
    ],
)
def test_what_cannot_be_written_is_refused_and_leaves_nothing(tmp_path, kinds, part, said):
    with pytest.raises(gc.DesignError, match=said):
        gc.write_profile(gc.solve(gc.builtin_task()).cam, tmp_path / "out", kinds, **part)
    assert not (tmp_path / "out").exists()

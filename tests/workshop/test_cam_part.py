"""What follows from the cam where the task's table ``[part]`` is silent, and what cannot be made."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import graphcam as gc
from graphcam.errors import DesignError, TaskError
from graphcam.given.limits_and_fits import standard_diameters
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.task_file import builtin_text
from graphcam.tasks.task_writer import task_files
from graphcam.workshop.cam_part import MIN_WALL, cam_part
from graphcam.workshop.part_contents import PartContents


@pytest.mark.parametrize("least_radius", [8.0, 17.0, 27.0, 46.0, 200.0, 1e5])
def test_the_bore_is_the_largest_standard_one_that_leaves_enough_wall(least_radius: float) -> None:
    part = cam_part(PartTable(), "iso", least_radius)
    assert part.bore in standard_diameters()
    wall = least_radius - part.keyway_top
    assert wall >= 0.3 * part.bore
    if part.bore < 500:
        larger = min(d for d in standard_diameters() if d > part.bore)
        other = cam_part(PartTable(bore=larger), "iso", 2 * least_radius)
        assert least_radius - other.keyway_top < 0.3 * larger


@pytest.mark.parametrize(("frame", "standard"), [("iso", "DIN 6885-1"), ("gost", "GOST 23360-78")])
def test_the_frame_chooses_the_standards(frame: str, standard: str) -> None:
    assert str(cam_part(PartTable(), frame, 27).key_standard) == standard
    assert str(cam_part(PartTable(keyway="din6885"), frame, 27).key_standard) == "DIN 6885-1"
    assert cam_part(PartTable(keyway="none"), frame, 27).keyway is None


WRONG = {
    "bore = 50": "part.bore is 50 mm with its keyway 3.8 mm deep, but must be small enough to leave a wall of 0.15 "
    "of the bore inside the minimum radius of the profile of 27 mm",
    "keyway = 'din6885'\nbore = 5": "part.keyway is 'din6885', but must be none for a bore of 5 mm",
    "hub_diameter = 60\nhub_length = 40": "part.hub_diameter is 60.0, but must be less than twice the minimum radius",
    "bore = 20\nhub_diameter = 24\nhub_length = 40": "inside the hub's radius of 12 mm; take a smaller bore",
    "bore = 20\nhub_diameter = 40\nhub_length = 10": "part.hub_length is 10.0, but must be greater than the cam's",
    "cutter_radius = 80": "part.cutter_radius is 80.0, but must be less than 47.97 mm",
    "profile_tolerance = 1e-6": "part.profile_tolerance is 1e-06, but must be large enough",
}


@pytest.mark.parametrize("said", WRONG)
def test_a_part_that_cannot_be_is_one_message(tmp_path: Path, said: str) -> None:
    (tmp_path / "cam.toml").write_text(
        f"{builtin_text('coursework')}\n[cam]\nprime_radius = 44\n\n[part]\n{said}\n", encoding="utf-8"
    )
    task = gc.load_task(tmp_path / "cam.toml")
    with pytest.raises(DesignError) as caught:
        PartContents(gc.solve(task)).check()
    assert WRONG[said] in str(caught.value)
    assert "\n" not in str(caught.value)


WRONG_IN_FILE = {
    "bore = 0": "part.bore is 0",
    "width = -1": "part.width is -1",
    "bore = 20\nhub_diameter = 20\nhub_length = 30": "part.hub_diameter is 20, but must be greater than the bore",
    "width = 20\nhub_diameter = 40\nhub_length = 20": "part.hub_length is 20, but must be greater than the width",
    "hub_length = 20": "part.hub_diameter is missing",
    "table_step = 3": "part.table_step is 3, but must be 1, 2, 5 or 10",
    "keyway = 'iso'": "part.keyway is 'iso', but must be 'din6885', 'gost23360' or 'none'",
    "bore_tolerance = 'K7'": "part.bore_tolerance is 'K7'",
    "roughness = 0": "part.roughness is 0",
    "density = 7.85": "part.density is 7.85, but must be from 10 to 30000 kg/m^3",
    "material = 7": "part.material is 7, but must be text in quotes",
    "diameter = 20": "part.diameter is an unknown key",
}


@pytest.mark.parametrize("name", ["coursework", "arcs"])
@pytest.mark.parametrize("said", WRONG_IN_FILE)
def test_a_wrong_value_in_the_file_is_named(tmp_path: Path, name: str, said: str) -> None:
    (tmp_path / "cam.toml").write_text(f"{builtin_text(name)}\n[part]\n{said}\n", encoding="utf-8")
    with pytest.raises(TaskError) as caught:
        gc.load_task(tmp_path / "cam.toml")
    assert WRONG_IN_FILE[said] in str(caught.value)


def test_a_task_with_a_part_is_written_and_read_again(tmp_path: Path) -> None:
    task = replace(gc.builtin_task(), part=PartTable(bore=20, hub_diameter=40, hub_length=30, table_step=2))
    for name, text in task_files(task).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert gc.load_task(tmp_path / "task.toml") == task


def test_mass_by_a_sum_over_a_fine_grid() -> None:
    """Cells of the plane that lie in the profile and not in bore or keyway, times the thickness there."""
    table = PartTable(bore=20, width=12, hub_diameter=40, hub_length=25, density=2700)
    solution = gc.solve(replace(gc.builtin_task(), part=table))
    contents = PartContents(solution)
    outline, part = contents.outline, contents.part
    step = 0.05
    axis = np.arange(-60, 60, step) + step / 2
    z = axis + 1j * axis[:, None]
    angles, radii = np.angle(outline.points), np.abs(outline.points)
    order = np.argsort(angles)
    inside = np.abs(z) <= np.interp(np.angle(z), angles[order], radii[order], period=2 * math.pi)
    assert part.keyway
    hole = (np.abs(z) <= 10) | ((np.abs(z.real) <= part.keyway.width / 2) & (z.imag >= 0) & (z.imag <= part.keyway_top))
    thickness = 12 * inside + 13 * (np.abs(z) <= 20)
    mass = np.sum(np.where(hole, 0, thickness)) * step**2 * 2700e-9
    assert part.mass(outline.area) == pytest.approx(mass, rel=2e-4)


def test_the_least_wall_is_just_allowed() -> None:
    part = cam_part(PartTable(bore=20), "iso", 27)
    least = part.keyway_top + MIN_WALL * 20
    assert cam_part(PartTable(bore=20), "iso", least).bore == 20
    with pytest.raises(DesignError, match="bore is"):
        cam_part(PartTable(bore=20), "iso", least - 0.001)


@pytest.mark.parametrize("bore", [2.0, 7.0, 20.0, 40.0])
@pytest.mark.parametrize("width", [0.1, 1.5, 3.0, 20.0])
def test_both_chamfers_leave_most_of_the_bore(bore: float, width: float) -> None:
    part = cam_part(PartTable(bore=bore, width=width, keyway="none"), "iso", 60)
    assert 0 < part.chamfer <= 0.2 * width
    assert part.chamfer <= {2.0: 0.1, 7.0: 0.5, 20.0: 1.0, 40.0: 1.6}[bore]

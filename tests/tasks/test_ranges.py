"""Whatever number a file gives, the outcome is a cam or one message: nothing else is raised, nothing half-written."""

from __future__ import annotations

import math
import re
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from over_all import over_all, over_seeds
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.errors import GraphcamError
from graphcam.sweeps.design_space import load_space
from graphcam.tasks.task_file import builtin_text

HUGE = "9" * 400
FOUL = [f"{sign}{size}" for size in ("1e-300", "1e-30", "1e-9", "1e9", "1e30", "1e300", HUGE) for sign in ("", "-")]
FOUL += ["nan", "inf", "-inf"]
EDGES = ["1e-3", "1e8", "-1e8", "1", "-1", "0"]
"""On the edge of what is sensible, or of no size at all."""
NUMBER = re.compile(r"(?<![\w.\"-])-?\d+(\.\d+)?(?![\w\"])")
WITH_MORE = {
    "coursework": "\n[spring]\nmass = 0.5\nstiffness = 3.0\npreload = 50.0\n[cam]\nprime_radius = 50\n"
    "[material]\nwidth = 15\npermitted_stress = 900\n",
    **dict.fromkeys(("arm", "flat", "measured", "arcs"), ""),
}
SPACES = {
    "translating": "lift = 20\n|prime_radius = { start = 40, stop = 80, count = 3 }\noffset = 5\nroller_radius = 4\n",
    "oscillating": "lift = 20\n|prime_radius = [50, 60]\narm = 120\ndistance = 130\nroller_radius = 5\n",
    "flat-faced": "lift = 20\n|prime_radius = 50\n",
}


def without_comments(name: str) -> str:
    return re.sub("#.*", "", builtin_text(name)) + WITH_MORE[name]


def changed(text: str, values: list[str]) -> list[str]:
    """The text with each of its numbers replaced in turn; both lifts too, for a single one does not close."""
    spots = [match.span() for match in NUMBER.finditer(text)]
    one = [text[:a] + value + text[b:] for a, b in spots for value in values]
    return one + [re.sub(r"lift = \d+", f"lift = {value}", text) for value in values]


def beside(folder: Path) -> Path:
    """A file in the folder, next to the table of the measured task."""
    table = Path(gc.__file__).parent / "data" / "tasks" / "measured.csv"
    (folder / "measured.csv").write_bytes(table.read_bytes())
    return folder / "cam.toml"


def loaded(path: Path, text: str) -> gc.Task | gc.ArcsTask | None:
    path.write_text(text, encoding="utf-8")
    try:
        return gc.load_task(path)
    except GraphcamError:
        return None


@pytest.mark.parametrize("name", ["coursework", "arcs"])
def test_no_number_in_a_task_file_raises_anything_but_a_message(name, tmp_path):
    path = beside(tmp_path)
    for text in changed(without_comments(name), FOUL):
        loaded(path, text)


PART = 12
"""One file in so many is tried with one seed."""


@pytest.mark.slow
@over_seeds(1)
@over_all("name", list(WITH_MORE))
def test_what_is_accepted_of_foul_numbers_is_solved_or_refused_in_one_message(name, seed):
    with TemporaryDirectory() as folder:
        path = beside(Path(folder))
        texts = changed(without_comments(name), FOUL + EDGES if name != "measured" else FOUL)
        for text in texts[seed % PART :: PART]:
            if (task := loaded(path, text)) is None:
                continue
            with suppress(GraphcamError):
                solution = gc.solve(task)
                solution.to_dict()
                files = ["csv", "note", "profile_dxf", "profile_step", "profile_gcode"]
                solution.write(Path(folder) / "out", files=files, working_drawing=True)


@pytest.mark.parametrize("follower", list(SPACES))
def test_no_number_in_a_space_file_raises_anything_but_a_message(follower, tmp_path):
    path = tmp_path / "space.toml"
    motion, cam = SPACES[follower].split("|")
    whole = f'follower = "{follower}"\n[motion]\n{motion}rise_angle = 80\nreturn_angle = [90, 100]\n[cam]\n{cam}'
    for text in changed(whole, FOUL + EDGES):
        path.write_text(text, encoding="utf-8")
        try:
            space = load_space(path)
        except GraphcamError:
            continue
        space.results((0, len(space)))


@pytest.mark.parametrize(
    ("number", "changes", "field", "allowed"),
    [
        ("lift = 30", "lift = 1e30", "lift of phase 1 is 1e+30", "from 1e-09 to 1000000000 mm (degrees for an arm)"),
        ("speed_rpm = 120", "speed_rpm = 1e300", "speed_rpm is 1e+300", "from 0.001 to 1000000 rpm"),
        ("offset = -10", "offset = -1e12", "follower.offset is -1000000000000.0", "at most 1000000000 mm in magnitude"),
        ("mass = 0.5", "mass = 1e30", "spring.mass is 1e+30", "from 1e-06 to 1000000 kg"),
    ],
)
def test_a_size_beyond_reason_ends_in_one_message_and_writes_nothing(number, changes, field, allowed, tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text(without_comments("coursework").replace(number, changes, 1), encoding="utf-8")
    result = CliRunner().invoke(app, ["solve", str(path), "--out", str(tmp_path / "out")])
    assert result.exit_code == 2
    lines = result.stderr.strip().splitlines()
    assert len(lines) == 1
    assert f"{field}, but must be {allowed}; check its unit and its digits" in lines[0]
    assert [item.name for item in tmp_path.iterdir()] == ["cam.toml"]


def test_a_lift_that_vanishes_beside_the_cam_is_not_drawn(tmp_path):
    text = without_comments("coursework").replace("lift = 30", "lift = 0.01")
    path = tmp_path / "cam.toml"
    path.write_text(text, encoding="utf-8")
    result = CliRunner().invoke(app, ["solve", str(path), "--out", str(tmp_path / "out")])
    assert result.exit_code == 2
    assert "prime radius is 50 mm, but must be at most 1000 times the lift of 0.01 mm" in result.stderr
    assert [item.name for item in tmp_path.iterdir()] == ["cam.toml"]


def test_the_profile_of_a_huge_cam_asks_for_a_deviation_that_can_be_told_from_rounding():
    motion = gc.Motion([gc.Rise(1e30, 2.0), gc.Return(1e30, 2.0), gc.Dwell(math.tau - 4)])
    with pytest.raises(gc.DesignError, match=r"deviation is 0\.0005, but must be .* mm or more"):
        gc.profile_spline(gc.Cam(motion, gc.Translating(), 1e30))


def test_a_profile_that_would_take_more_knots_than_the_memory_holds_is_refused():
    motion = gc.Motion(
        [gc.Rise(1e9, 1.4, "rectangular"), gc.Return(1e9, 1.05, "rectangular"), gc.Dwell(math.tau - 2.45)]
    )
    with pytest.raises(gc.DesignError, match=r"deviation is 0\.0005 mm, but must be larger for this profile"):
        gc.profile_spline(gc.Cam(motion, gc.Translating(offset=-10, roller_radius=17), 50), trimmed=True)

"""``graphcam sweep``: space files, and the files of results."""

from __future__ import annotations

import csv
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS
from graphcam.errors import TaskError
from graphcam.given.follower import Limits
from graphcam.sweeps.dataset import sweep_to_file
from graphcam.sweeps.design_space import load_space

SPACE = """
rotation = ["ccw", "cw"]
[motion]
lift = 30
rise_angle = { start = 60, stop = 120, count = 4 }
return_angle = 90
rise_law = ["cycloidal", "rectangular"]
[cam]
prime_radius = [10, 50]
offset = 12
"""


@pytest.fixture
def space(tmp_path):
    path = tmp_path / "space.toml"
    path.write_text(SPACE)
    return path


def run(*arguments: object):
    return CliRunner().invoke(app, ["sweep", *map(str, arguments)])


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_the_rows_are_those_of_a_sweep(space, tmp_path):
    result = run(space, "--out", tmp_path / "out.csv")
    assert result.exit_code == 0
    assert "32 designs" in result.stdout
    rows = rows_of(tmp_path / "out.csv")
    for row in rows:
        designs = gc.Designs(
            lift=30, rise_angle=math.radians(float(row["rise_angle_deg"])), return_angle=math.radians(90),
            prime_radius=float(row["prime_radius"]), offset=12, rise_law=row["rise_law"], rotation=row["rotation"],
        )  # fmt: skip
        found = gc.sweep(designs, limits=Limits(math.radians(30)))
        angle = row["max_pressure_angle_rise_deg"]
        if row["prime_radius"] == "10.0":
            assert (angle, row["feasible"]) == ("", "false")
        else:
            assert float(angle) == pytest.approx(math.degrees(found["max_pressure_angle_rise"][0]), rel=1e-15)
            assert float(row["min_pitch_curvature_radius"]) == found["min_pitch_curvature_radius"][0]
            assert row["feasible"] == str(bool(found["feasible"][0])).lower()
    assert len({tuple(row.values())[:4] for row in rows}) == 32
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out-front.csv", "out.csv", "space.toml"]


@pytest.mark.slow
def test_parquet_and_csv_hold_the_same(space, tmp_path):
    from pyarrow import parquet

    for name in ("out.csv", "out.parquet"):
        assert run(space, "--out", tmp_path / name).exit_code == 0
    table = parquet.read_table(tmp_path / "out.parquet").to_pydict()
    for name, column in table.items():
        written = [row[name] for row in rows_of(tmp_path / "out.csv")]
        assert written == ["" if x is None else str(x).lower() if isinstance(x, bool) else str(x) for x in column]
    assert None in table["max_pressure_angle_rise_deg"]


@pytest.mark.slow
def test_workers_change_nothing(space, tmp_path):
    assert run(space, "--out", tmp_path / "one.csv").exit_code == 0
    assert run(space, "--out", tmp_path / "two.csv", "--workers", 2).exit_code == 0
    assert (tmp_path / "one.csv").read_bytes() == (tmp_path / "two.csv").read_bytes()


def test_blocks_join_without_a_seam(space, tmp_path, monkeypatch):
    whole, parts, done = tmp_path / "whole.csv", tmp_path / "parts.csv", []
    sweep_to_file(load_space(space), whole)
    monkeypatch.setattr("graphcam.sweeps.dataset.CHUNKS_PER_JOB", 1)
    monkeypatch.setattr("graphcam.sweeps.dataset.CHUNK_OF_DESIGNS", 5)
    sweep_to_file(load_space(space), parts, progress=done.append)
    assert whole.read_bytes() == parts.read_bytes()
    assert done == [5, 10, 15, 20, 25, 30, 32]


def test_a_failure_leaves_what_was_there(space, tmp_path):
    out = tmp_path / "out.csv"
    out.write_text("before")

    def stop(_: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep_to_file(load_space(space), out, progress=stop)
    assert out.read_text() == "before"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.csv", "space.toml"]


def test_without_pyarrow_the_message_names_the_remedy(space, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    result = run(space, "--out", tmp_path / "out.parquet")
    assert result.exit_code == INPUT_ERROR_STATUS
    assert 'pip install ".[parquet]"' in result.stderr
    assert "Traceback" not in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["space.toml"]


def test_another_ending_is_refused(space, tmp_path):
    result = run(space, "--out", tmp_path / "out.xlsx")
    assert result.exit_code == INPUT_ERROR_STATUS
    assert ".csv nor .parquet" in result.stderr


def test_an_arm_has_its_lift_in_degrees_and_its_own_limit(tmp_path):
    path = tmp_path / "arms.toml"
    path.write_text(
        'follower = "oscillating"\n[motion]\nlift = [20, 25]\nrise_angle = 90\nreturn_angle = 80\n'
        "[cam]\nprime_radius = [40, 60]\narm = 100\ndistance = 120\nroller_radius = 10\n"
    )
    assert run(path, "--out", tmp_path / "out.csv").exit_code == 0
    rows = rows_of(tmp_path / "out.csv")
    assert [(row["lift_deg"], row["prime_radius"]) for row in rows] == [
        ("20.0", "40.0"), ("20.0", "60.0"), ("25.0", "40.0"), ("25.0", "60.0"),
    ]  # fmt: skip
    angles = [float(row["max_pressure_angle_rise_deg"]) for row in rows]
    assert [row["feasible"] for row in rows] == [str(angle <= 45).lower() for angle in angles]
    phases = [gc.Rise(math.radians(25), math.pi / 2), gc.Return(math.radians(25), math.radians(80))]
    motion = gc.Motion([*phases, gc.Dwell(math.radians(190))])
    cam = gc.Cam(motion, gc.Oscillating(100, 120, 10), 40)
    assert angles[2] == pytest.approx(math.degrees(cam.extremes().pressure_angle_rise[0]), rel=1e-13)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("rise_angle", "rise_angel", "motion.rise_angel is an unknown key.*did you mean 'rise_angle'"),
        ("count", "cuont", "motion.rise_angle.cuont.*did you mean 'count'"),
        ("count = 4", "count = 0", "motion.rise_angle.count is 0"),
        ("count = 4", "count = 4.5", "motion.rise_angle.count is 4.5"),
        (", count = 4", "", "motion.rise_angle.count is missing"),
        ('"rectangular"', '"rectangle"', "motion.rise_law.*did you mean 'rectangular'"),
        ("[10, 50]", "[]", "cam.prime_radius is an empty list"),
        ("[10, 50]", '"50"', "cam.prime_radius is '50', but must be a number"),
        ("[10, 50]", "true", "cam.prime_radius is true"),
        ('["ccw", "cw"]', '"up"', "rotation is 'up'"),
        ("prime_radius = [10, 50]", "", "cam.prime_radius is missing.*space.toml"),
        ("offset = 12", "offset = 12\n[limits]\npressure_angle_rise = 95", "pressure_angle_rise is 95"),
        ("rotation", 'quantities = ["max_w"]\nrotation', "quantities.*known are"),
        ("rotation", 'follower = "flat"\nrotation', "follower is 'flat'"),
        ("offset = 12", "arm = 12", "arm.*left out for a translating follower"),
        ("rotation", 'follower = "oscillating"\nrotation', "offset.*left out for an oscillating follower"),
    ],
)
def test_a_wrong_file_is_told_in_its_own_words(space, old, new, message):
    space.write_text(SPACE.replace(old, new, 1))
    with pytest.raises(TaskError, match=message):
        load_space(space)


def test_a_missing_file_is_one_message(tmp_path):
    result = run(tmp_path / "none.toml", "--out", tmp_path / "out.csv")
    assert result.exit_code == INPUT_ERROR_STATUS
    assert len(result.stderr.splitlines()) == 1


def test_a_range_has_both_its_ends(space):
    angles = load_space(space).axes["rise_angle"]
    np.testing.assert_allclose(angles, [60, 80, 100, 120], rtol=0, atol=1e-12)

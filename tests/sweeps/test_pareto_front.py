"""The front of size and pressure angle: of a sweep as a whole, whatever the blocks, and as the command tells it."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.plots.front_figure import front_figure
from graphcam.sweeps.design_space import Space, load_space
from graphcam.sweeps.pareto_front import ANGLE, FEASIBLE, SIZE_COLUMN, front_among, joined_front, pareto_front

SPACE = """
[motion]
lift = 30
rise_angle = [80, 100, 120]
return_angle = 90
rise_law = ["cycloidal", "3-4-5"]
[cam]
prime_radius = { start = 20, stop = 60, count = 9 }
offset = [0, 8]
roller_radius = 6
"""
PAIRS = st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), max_size=12)


@pytest.fixture
def space(tmp_path: Path) -> Path:
    path = tmp_path / "space.toml"
    path.write_text(SPACE, encoding="utf-8")
    return path


def run(*arguments: object):
    return CliRunner().invoke(app, ["sweep", *map(str, arguments)])


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@given(PAIRS)
def test_what_is_on_the_front_is_beaten_by_none_and_what_is_not_is(pairs: list[tuple[int, int]]):
    """By the definition, of every pair."""
    found = pareto_front([a for a, _ in pairs], [b for _, b in pairs]).tolist()
    front = [pairs[k] for k in found]
    assert len(set(front)) == len(front)

    def beats(one: tuple[int, int], other: tuple[int, int]) -> bool:
        return one != other and one[0] <= other[0] and one[1] <= other[1]

    assert set(front) == {pair for pair in pairs if not any(beats(other, pair) for other in pairs)}
    assert front == sorted(front)


def columns(pairs: list[tuple[int, int]]) -> dict[str, Any]:
    sizes, angles = np.array(pairs, dtype=float).reshape(-1, 2).T
    # A third column, so that equal designs can be told apart.
    return {SIZE_COLUMN: sizes, "offset": np.arange(sizes.size) % 3.0, ANGLE: -angles}


@given(PAIRS, PAIRS)
def test_the_front_of_two_blocks_is_that_of_all_designs_in_either_order(
    first: list[tuple[int, int]], second: list[tuple[int, int]]
):
    blocks = [columns(first), columns(second)]
    whole = front_among({name: np.concatenate([block[name] for block in blocks]) for name in blocks[0]})
    for order in (blocks, blocks[::-1]):
        joined = joined_front([*map(front_among, order)])
        assert {name: column.tolist() for name, column in joined.items()} == {
            name: column.tolist() for name, column in whole.items()
        }


def test_the_command_ends_with_the_best_of_its_rows(space: Path, tmp_path: Path):
    """The table beside the results is recomputed here from the rows themselves."""
    result = run(space, "--out", tmp_path / "out.csv")
    assert result.exit_code == 0, result.output
    rows = rows_of(tmp_path / "out.csv")
    kept = [row for row in rows if row[FEASIBLE] == "true"]
    assert f"{len(rows)} designs, {len(kept)} keep the limits" in result.stdout
    measures = [(float(row[SIZE_COLUMN]), abs(float(row[ANGLE]))) for row in kept]
    best = [
        k for k, (r, a) in enumerate(measures) if not any(s <= r and b <= a and (s, b) != (r, a) for s, b in measures)
    ]
    front = rows_of(tmp_path / "out-front.csv")
    assert len(front) > 3
    assert {(float(row[SIZE_COLUMN]), abs(float(row[ANGLE]))) for row in front} == {measures[k] for k in best}
    assert all({name: row[name] for name in front[0]} in [{n: r[n] for n in front[0]} for r in kept] for row in front)
    smallest = re.search(r"^the smallest: prime_radius (\S+), .*pressure_angle (\S+)$", result.stdout, re.MULTILINE)
    assert smallest
    assert float(smallest[1]) == min(measures)[0]
    assert abs(float(smallest[2])) == pytest.approx(min(measures)[1], rel=1e-4)
    table = [line.split() for line in result.stdout.splitlines() if re.match(r" +\d+ ", line)]
    assert [float(row[0]) for row in table] == [float(row[SIZE_COLUMN]) for row in front]
    figure = (tmp_path / "out-front.svg").read_text(encoding="utf-8")
    assert "maximum pressure angle on the rise" in figure


@pytest.mark.slow
def test_a_folder_tells_the_same_front_also_after_an_interruption(
    space: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    run(space, "--out", tmp_path / "out.csv")
    monkeypatch.setattr("graphcam.sweeps.dataset.MAX_PART_DESIGNS", 11)
    monkeypatch.setattr("graphcam.sweeps.dataset.BLOCK_DESIGNS", 11)
    folder = tmp_path / "results"
    told = run(space, "--out", folder).stdout
    front = (folder / "_front.csv").read_bytes()
    assert front == (tmp_path / "out-front.csv").read_bytes()
    (folder / "part-00003.parquet").unlink()
    assert run(space, "--out", folder).stdout.split("\n\n")[1:] == told.split("\n\n")[1:]
    assert (folder / "_front.csv").read_bytes() == front
    # A folder that an earlier version began has no front: nothing wrong is told.
    manifest = json.loads((folder / "_manifest.json").read_text(encoding="utf-8"))
    del manifest["front"]
    (folder / "_manifest.json").write_text(json.dumps(manifest), encoding="utf-8")
    again = run(space, "--out", folder)
    assert again.exit_code == 0
    assert "the smallest" not in again.stdout


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ('quantities = ["max_v"]\n' + SPACE, 'put "feasible" among the quantities'),
        (SPACE + "[limits]\npressure_angle_rise = 1\n", "0 keep the limits\nnone keeps the limits: try larger"),
        (SPACE.replace("{ start = 20, stop = 60, count = 9 }", "60"), "the smallest: prime_radius 60, rise_angle 120"),
        ('quantities = ["feasible"]\n' + SPACE, "the smallest: prime_radius "),
    ],
)
def test_without_a_front_the_rest_is_told(space: Path, tmp_path: Path, changed: str, said: str):
    space.write_text(changed, encoding="utf-8")
    result = run(space, "--out", tmp_path / "out.csv")
    assert result.exit_code == 0, result.output
    assert said in result.stdout
    assert "No design is both" not in result.stdout
    assert not (tmp_path / "out-front.svg").exists()


def test_the_figure_shades_what_no_design_reaches(space: Path):
    loaded: Space = load_space(space)
    rows = loaded.results((0, len(loaded)))
    front = front_among({name: column[rows[FEASIBLE]] for name, column in rows.items() if name != FEASIBLE})
    axes = front_figure(front, 30.0).axes[0]
    (shaded,) = (patch.get_paths()[0] for patch in axes.collections)
    for size, angle in zip(rows[SIZE_COLUMN][rows[FEASIBLE]], np.abs(rows[ANGLE][rows[FEASIBLE]]), strict=True):
        assert not shaded.contains_point((size + 1e-6, angle + 1e-6))
    assert shaded.contains_point((front[SIZE_COLUMN][2] - 1e-3, abs(front[ANGLE][1]) - 1e-3))

"""Designs of every combination of sizes in Python, and the table of what is found of them."""

from __future__ import annotations

import numpy as np
import pytest

import graphcam as gc
from graphcam.sweeps.design_space import load_space


def test_a_grid_is_every_combination_as_in_a_file(tmp_path):
    path = tmp_path / "space.toml"
    path.write_text(
        '[motion]\nlift = 30\nrise_angle = [90, 120]\nreturn_angle = 90\nrise_law = ["3-4-5", "cycloidal"]\n'
        "[cam]\noffset = 10\nprime_radius = { start = 50, stop = 60, count = 3 }\n"
    )
    space = load_space(path)
    designs = gc.grid(
        lift=30,
        rise_angle=np.radians([90, 120]),
        return_angle=np.radians(90),
        rise_law=["3-4-5", "cycloidal"],
        offset=10,
        prime_radius={"start": 50, "stop": 60, "count": 3},
    )
    assert len(designs) == len(space) == 12
    filed, found = gc.sweep(space.designs(0, 12)), gc.sweep(designs)
    rows = {tuple(row) for row in found.array.tolist()}
    assert rows == {tuple(row) for row in gc.sweep(space.designs(0, 12)).array.tolist()}
    assert set(filed) == set(found)
    assert found.array.dtype.names == (*designs.varied, *found)


def test_a_sweep_is_a_frame():
    pytest.importorskip("pandas")
    found = gc.sweep(gc.grid(lift=30, rise_angle=2.0, return_angle=1.5, prime_radius=[40, 60]), "max_v")
    assert found.frame().to_records(index=False).tolist() == found.array.tolist()


@pytest.mark.parametrize(
    ("sizes", "message"),
    [
        ({"prime_radius": []}, "prime_radius is an empty list"),
        ({"lift": "30"}, "lift is no number, but must be a number, a list of numbers, or a range"),
        ({"lift": [30, None]}, "lift is no number"),
        ({"lift": [[30]]}, "lift is no number"),
        ({"prime_radius": {"start": 40, "stop": 60}}, "prime_radius.count is missing"),
        ({"prime_radius": {"start": 40, "stop": 60, "step": 5}}, "prime_radius.step is an unknown key.*count = 5"),
        ({"rise_law": ["cicloidal", "3-4-5"]}, "rise_law is 'cicloidal'.*did you mean 'cycloidal'"),
        ({"prime_radius": np.arange(1, 4000), "offset": np.arange(4000)}, "number of designs is 15996000"),
    ],
)
def test_a_grid_that_is_none_is_refused(sizes, message):
    given = {"lift": 30, "rise_angle": 2.0, "return_angle": 1.5, "prime_radius": 50} | sizes
    with pytest.raises(gc.DesignError, match=message):
        gc.grid(**given)

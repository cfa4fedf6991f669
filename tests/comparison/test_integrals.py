"""Running sums against exact ones."""

from __future__ import annotations

import math

import numpy as np
import pytest

from graphcam.comparison.integrals import BLOCK_SIZE, accurate_cumsum

EPS = 2.0**-52


@pytest.mark.parametrize("n", [1, 5, BLOCK_SIZE - 1, BLOCK_SIZE, BLOCK_SIZE + 1, 1_000_000])
def test_every_running_sum_to_what_a_block_leaves_and_the_last_to_four_eps(n):
    values = np.random.default_rng(n).random(n)
    sums, total = accurate_cumsum(values), math.fsum(values)
    assert abs(sums[-1] - total) <= 4 * EPS * total
    for k in np.random.default_rng(2).integers(n, size=20):
        assert sums[k] == pytest.approx(math.fsum(values[: k + 1]), rel=BLOCK_SIZE * EPS)


def test_ten_million_stations():
    """Plain running sums miss by 1e-10."""
    values = np.full(10_000_000, 0.1)
    exact = math.fsum(values)
    assert abs(accurate_cumsum(values)[-1] / exact - 1) <= 4 * EPS
    assert abs(np.cumsum(values)[-1] / exact - 1) > 1e-10


def test_nothing_and_signs():
    assert accurate_cumsum([]).shape == (0,)
    swing = np.cos(np.linspace(0, 40 * math.pi, 400_001)[:-1])
    assert abs(accurate_cumsum(swing)[-1] - math.fsum(swing)) <= 4 * EPS * np.abs(swing).sum()

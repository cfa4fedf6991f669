"""The complete cubic spline: what defines it, and another program's."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.interpolate import BSpline, CubicSpline, make_interp_spline

from graphcam.mechanism.complete_spline import closed_spline_through, spline_through


def curve(count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Uneven parameters, and points anywhere."""
    random = np.random.default_rng(seed)
    at = np.cumsum(random.uniform(0.05, 3.0, count))
    return at, random.normal(size=count) + 1j * random.normal(size=count)


@pytest.mark.parametrize("count", [2, 3, 5, 40, 500])
def test_the_knots_and_control_points_are_those_that_scipy_finds(count):
    at, points = curve(count, seed=count)
    found = spline_through(at, points, 1 + 2j, -1j)
    other = make_interp_spline(at, points, 3, bc_type=([(1, 1 + 2j)], [(1, -1j)]))
    assert found.knots.tolist() == other.t.tolist()
    assert_allclose(found.control, other.c, atol=5e-14)


@pytest.mark.parametrize("count", [3, 4, 40])
def test_a_closed_one_is_the_periodic_spline(count):
    at, points = curve(count, seed=count)
    points[-1] = points[0]
    found = closed_spline_through(at, points)
    assert_allclose(found.slopes, CubicSpline(at, points, bc_type="periodic")(at, 1), atol=5e-14)


def test_its_points_are_those_of_its_b_spline():
    at, points = curve(30, seed=1)
    found = spline_through(at, points, 0j, 1 + 0j)
    distances = np.diff(at)[:, None] * np.linspace(0, 1, 7)
    assert_allclose(
        found.beyond(distances), BSpline(found.knots, found.control, 3)(at[:-1, None] + distances), atol=1e-13
    )
    assert_allclose(found.beyond(distances)[:, -1], points[1:], atol=1e-14)


def test_a_cubic_is_its_own_spline():
    at = np.array([-2.0, -0.5, 0.1, 3.0, 3.2])
    cubic, slope = np.polynomial.Polynomial([1j, 2, -1, 0.5]), np.polynomial.Polynomial([2, -2, 1.5])
    found = spline_through(at, cubic(at).astype(complex), complex(slope(at[0])), complex(slope(at[-1])))
    assert_allclose(found.slopes, slope(at), atol=1e-13)

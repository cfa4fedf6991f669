"""B-splines and their least squares: what defines them, and another program's."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
from over_all import over_all
from scipy.interpolate import BSpline, make_lsq_spline

from graphcam.mechanism.profile_spline import Conditions, at_ends, basis, fitted_control_points, solve_banded

DEGREES = (1, 2, 3, 4, 5)


def clamped(degree: int, seed: int) -> np.ndarray:
    """Uneven knots, one of them double."""
    inner = 0.7 * np.arange(1, 10) + np.random.default_rng(seed).uniform(-0.25, 0.25, 9)
    ends = [0.0] * (degree + 1), [7.0] * (degree + 1)
    return np.sort(np.concatenate([*ends, inner, inner[4:5] if degree > 1 else []]))


@over_all("degree", DEGREES)
def test_the_b_splines_are_those_of_scipy(degree):
    knots, at = clamped(degree, degree), np.linspace(0, 7, 200)
    splines = basis(knots, degree, at)
    full = np.zeros((at.size, splines.size))
    np.put_along_axis(full, splines.numbers, splines.values, axis=1)
    assert_allclose(full, BSpline.design_matrix(at, knots, degree).toarray(), atol=1e-14)
    assert_allclose(splines.values.sum(axis=1), 1, atol=1e-14)  # a partition of unity
    products = full.T @ full
    for k in range(degree + 1):
        assert_allclose(splines.products[: splines.size - k, k], np.diagonal(products, k), atol=1e-12)


@over_all(("degree", "derivative"), [(p, k) for p in DEGREES for k in range(3) if k < p])
def test_the_derivatives_at_the_ends_are_those_of_scipy(degree, derivative):
    knots = clamped(degree, 10 + degree)
    control = np.random.default_rng(degree).normal(size=knots.size - degree - 1)
    first, last = at_ends(knots, degree, derivative)
    spline = BSpline(knots, control, degree)
    assert_allclose([first @ control, last @ control], spline(np.array([0.0, 7.0]), nu=derivative), rtol=1e-9)


@over_all("degree", DEGREES)
def test_without_need_of_its_conditions_the_fit_is_that_of_scipy(degree):
    """Of conditions that the free fit fulfils anyway."""
    knots, at = clamped(degree, 20 + degree), np.linspace(0, 7, 300)
    points = np.exp(1j * at) + 0.1 * np.sin(5 * at)
    free = make_lsq_spline(at, points, knots, degree)
    rows = np.stack(at_ends(knots, degree, 1))
    found = fitted_control_points(basis(knots, degree, at), points, Conditions(rows, rows @ free.c))
    assert_allclose(found, free.c, atol=1e-11)


@over_all("degree", DEGREES)
def test_conditions_hold_exactly_and_the_rest_is_as_near_as_can_be(degree):
    """The error is orthogonal to every change of the control points that keeps the conditions."""
    knots, at = clamped(degree, 30 + degree), np.linspace(0, 7, 300)
    points = np.exp(1j * at) + 0.1 * np.sin(5 * at)
    splines = basis(knots, degree, at)
    rows = np.stack([row for derivative in (0, 1) for row in at_ends(knots, degree, derivative)])
    values = np.array([1 + 1j, 2 - 1j, 0.5j, -3.0])
    control = fitted_control_points(splines, points, Conditions(rows, values))
    assert_allclose(rows @ control, values, atol=1e-11)
    kept = np.linalg.svd(rows)[2][len(rows) :]  # the null space
    off = points - splines.at(control)
    shares = splines.shares(off.real) + 1j * splines.shares(off.imag)
    assert_allclose(kept @ shares, 0, atol=1e-11)


@over_all("degree", DEGREES)
def test_a_spline_is_its_own_fit(degree):
    knots, at = clamped(degree, 40 + degree), np.linspace(0, 7, 300)
    random = np.random.default_rng(degree)
    control = random.normal(size=(knots.size - degree - 1, 2)) @ [1, 1j]
    points = BSpline(knots, control, degree)(at)
    rows = np.stack(at_ends(knots, degree, 0))
    assert_allclose(
        fitted_control_points(basis(knots, degree, at), points, Conditions(rows, rows @ control)), control, atol=1e-10
    )


@over_all("degree", DEGREES)
def test_a_banded_system_is_solved_as_a_full_one(degree):
    knots = clamped(degree, 50 + degree)
    bands = basis(knots, degree, np.linspace(0, 7, 300)).products
    m = len(bands)
    full = sum(np.diag(bands[: m - k, k], k) + (np.diag(bands[: m - k, k], -k) if k else 0) for k in range(degree + 1))
    right = np.random.default_rng(degree).normal(size=(m, 3))
    assert_allclose(solve_banded(bands, right), np.linalg.solve(full, right), rtol=1e-8)

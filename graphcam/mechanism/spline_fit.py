"""Curves fitted by B-splines of any degree: least squares, with what must hold at the ends held exactly.

A spline through given points misses a curve between them and always to the same side; that of the least squares of the
error swings about the curve, so that with the same knots it stays about twice as near.  What has to hold exactly (ends,
tangents, a smooth seam) comes in by Lagrange's multipliers.

Written for itself because ``scipy.interpolate`` takes longer to load than a task takes to be solved.  Source: C. de
Boor, *A Practical Guide to Splines* (rev. ed., 2001), chapters X and XIV.
"""

from dataclasses import dataclass

import numpy as np

from graphcam.given.b_splines import basis_functions
from graphcam.given.laws import Floats
from graphcam.mechanism.envelope import Indices
from graphcam.mechanism.kinematics import Complexes

SOLUTION_COUNT = 2
"""The first one, and one of what rounding left of it, which normal equations magnify."""


@dataclass(frozen=True, eq=False)
class Conditions:
    """What control points must fulfil exactly: ``rows`` (k, m) @ control = ``values`` (k,)."""

    rows: Floats
    values: Complexes


@dataclass(frozen=True, eq=False)
class Basis:
    """The B-splines of degree p at places: numbers and values of those that are not zero there, both (n, p + 1).

    size : m, how many control points there are
    """

    numbers: Indices
    values: Floats
    size: int

    def at(self, control: Complexes) -> Complexes:
        """(n,) the points of the spline with these control points."""
        return np.sum(self.values * control[self.numbers], axis=1)

    def shares(self, of: Floats) -> Floats:
        """(m,) numbers (n,) at the places, summed for each control point as far as it is there."""
        return _sums_by_number(self.numbers, self.values * of[:, None], self.size)

    @property
    def products(self) -> Floats:
        """(m, p + 1) of each B-spline with itself and with the p next ones, summed over the places; others are zero."""
        width = self.numbers.shape[1]
        first, second = np.triu_indices(width)
        places = self.numbers[:, first] * width + second - first
        products = self.values[:, first] * self.values[:, second]
        return _sums_by_number(places, products, self.size * width).reshape(self.size, width)


def basis(knots: Floats, degree: int, at: Floats) -> Basis:
    """The B-splines over these knots at parameters (n,).

    >>> splines = basis(np.array([0.0, 0, 0, 1, 2, 2, 2]), 2, np.array([0.5, 2.0]))
    >>> splines.numbers.tolist(), splines.values.tolist()
    ([[0, 1, 2], [1, 2, 3]], [[0.25, 0.625, 0.125], [0.0, 0.0, 1.0]])
    """
    return Basis(*basis_functions(knots, degree, at), knots.size - degree - 1)


def at_ends(knots: Floats, degree: int, derivative: int) -> tuple[Floats, Floats]:
    """(m,) what each control point gives to a derivative at the start and at the end of a clamped spline.

    >>> [row.tolist() for row in at_ends(np.array([0.0, 0, 0, 2, 2, 2]), 2, 1)]
    [[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0]]
    """
    first, last = np.zeros((2, knots.size - degree - 1))
    first[: derivative + 1] = _at_start(knots, degree, derivative)
    last[-derivative - 1 :] = (-1) ** derivative * _at_start(-knots[::-1], degree, derivative)[::-1]
    return first, last


def _at_start(knots: Floats, degree: int, derivative: int) -> Floats:
    """What the first control points give, by the derivatives' own control points."""
    rows = np.eye(derivative + 1)
    for k in range(derivative):
        widths = knots[degree + 1 : degree + 1 + derivative - k] - knots[k + 1 : derivative + 1]
        rows = (degree - k) * np.diff(rows, axis=0) / widths[:, None]
    return rows[0]


def fitted_control_points(splines: Basis, points: Complexes, conditions: Conditions) -> Complexes:
    """(m,) the control points of the spline nearest to points (n,), in the sense of least squares.

    >>> knots, at = np.array([0.0, 0, 0, 0, 1, 2, 2, 2, 2]), np.linspace(0, 2, 20)
    >>> ends = Conditions(np.stack(at_ends(knots, 3, 0)), np.array([0j, 2 + 2j]))
    >>> fitted_control_points(basis(knots, 3, at), (1 + 1j) * at, ends).imag.round(6)[1:].tolist()
    [0.333333, 1.0, 1.666667, 2.0]
    """
    # Rows of derivatives are as large as their parts are short.
    size = np.abs(conditions.rows).max(axis=1)
    rows, wanted, products = conditions.rows / size[:, None], conditions.values / size, splines.products
    control = np.zeros(splines.size, dtype=complex)
    for _ in range(SOLUTION_COUNT):
        off, left = points - splines.at(control), wanted - rows @ control
        free = np.stack([splines.shares(off.real), splines.shares(off.imag)], axis=1)
        solved = solve_banded(products, np.hstack([free, rows.T]))
        free, of_rows = solved[:, :2], solved[:, 2:]
        missing = np.stack([left.real, left.imag], axis=1) - rows @ free
        found = free + of_rows @ np.linalg.solve(rows @ of_rows, missing)
        control += found[:, 0] + 1j * found[:, 1]
    return control


def solve_banded(bands: Floats, right: Floats) -> Floats:
    """(m, n) the solution of a positive definite symmetric system for columns (m, n), by elimination in order.

    bands : (m, p + 1) of each row what stands on the diagonal and in the p places to the right of it

    >>> solve_banded(np.array([[2.0, 1.0], [2.0, 0.0]]), np.array([[4.0], [5.0]])).tolist()
    [[1.0], [2.0]]
    """
    upper, right = bands.copy(), right.copy()
    m, width = upper.shape
    for i in range(m):
        for k in range(1, min(width, m - i)):
            factor = upper[i, k] / upper[i, 0]
            upper[i + k, : width - k] -= factor * upper[i, k:]
            right[i + k] -= factor * right[i]
    for i in reversed(range(m)):
        reach = min(width, m - i)
        right[i] = (right[i] - upper[i, 1:reach] @ right[i + 1 : i + reach]) / upper[i, 0]
    return right


def _sums_by_number(numbers: Indices, values: Floats, size: int) -> Floats:
    return np.bincount(numbers.ravel(), values.ravel(), size).astype(np.float64)

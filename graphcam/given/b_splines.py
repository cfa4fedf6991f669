"""B-splines of one variable and polynomials piece by piece, as far as measured motions need them.

Written for itself because they must run where there is NumPy alone.  Source: C. de Boor, *A Practical Guide to Splines*
(rev. ed., 2001), chapters X and XIV.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, partial
from math import perm

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from graphcam.given.piecewise import Floats
from graphcam.given.reproducible_sums import ordered_sum
from graphcam.given.root_finding import roots


def basis_functions(knots: Floats, degree: int, at: Floats) -> tuple[NDArray[np.intp], Floats]:
    """The numbers and the values, both (n, p + 1), of the B-splines of degree p that are not zero at places (n,).

    By the recursion of Cox and de Boor.  Beyond the first and the last interval these go on.

    >>> numbers, values = basis_functions(np.arange(6.0), 2, np.array([2.5]))
    >>> numbers.tolist(), values.tolist()
    ([[0, 1, 2]], [[0.125, 0.75, 0.125]])
    """
    part = np.clip(np.searchsorted(knots, at, side="right") - 1, degree, knots.size - degree - 2)
    values = np.ones((at.size, 1))
    for k in range(1, degree + 1):
        # Each B-spline of degree k - 1 is shared between two of degree k.
        number = part[:, None] + np.arange(1 - k, 1)
        share = (at[:, None] - knots[number]) / (knots[number + k] - knots[number])
        raised = np.zeros((at.size, k + 1))
        raised[:, :-1] += (1 - share) * values
        raised[:, 1:] += share * values
        values = raised
    return part[:, None] + np.arange(-degree, 1), values


@dataclass(frozen=True, eq=False)
class KnottedSpline:
    """A spline by its knots (m + p + 1,), its coefficients (m,) and its degree p.

    >>> line = KnottedSpline(np.arange(5.0), np.array([0.0, 2.0, 4.0]), 1)
    >>> float(line(1.5)), line([1.5, 2.5], nu=1).tolist()
    (1.0, [2.0, 2.0])
    """

    knots: Floats
    coefficients: Floats
    degree: int

    def __call__(self, at: ArrayLike, nu: int = 0) -> Floats:
        """The values, or those of a derivative, at places of any shape."""
        if nu:
            return self.derivative(at, nu - 1)
        places = np.asarray(at, dtype=np.float64)
        numbers, values = basis_functions(self.knots, self.degree, places.ravel())
        return ordered_sum(values * self.coefficients[numbers]).reshape(places.shape)

    @cached_property
    def derivative(self) -> KnottedSpline:
        """The spline of the first derivative; where knots coincide it has a coefficient that no interval sees."""
        p, knots = self.degree, self.knots
        widths = knots[p + 1 : -1] - knots[1 : -p - 1]
        rises = p * np.diff(self.coefficients)
        return KnottedSpline(knots[1:-1], np.divide(rises, widths, out=np.zeros_like(rises), where=widths > 0), p - 1)


@dataclass(frozen=True, eq=False)
class PiecewisePolynomial:
    """Polynomials about the left ends of their intervals; the first and the last go on beyond.

    coefficients : (d + 1, n), the lowest first;  ends : (n + 1,) of the intervals

    >>> square = PiecewisePolynomial(np.array([[0.0], [0.0], [1.0]]), np.array([0.0, 1.0]))
    >>> square([0.5, 2.0]).tolist(), square([0.5], nu=1).tolist()
    ([0.25, 4.0], [1.0])
    """

    coefficients: Floats
    ends: Floats

    def __call__(self, at: ArrayLike, nu: int = 0) -> Floats:
        """The values, or those of a derivative, at places of any shape."""
        places = np.asarray(at, dtype=np.float64)
        piece = np.clip(np.searchsorted(self.ends, places, side="right") - 1, 0, self.ends.size - 2)
        return self._derivative_in_intervals(places - self.ends[piece], nu, self.coefficients[:, piece])

    def greatest(self, nu: int) -> float:
        """The greatest magnitude of a derivative in the intervals.

        >>> cubic = PiecewisePolynomial(np.array([[0.0], [3.0], [0.0], [-4.0]]), np.array([0.0, 0.75]))
        >>> round(cubic.greatest(0), 12)
        1.0
        """
        widths = np.diff(self.ends)
        cuts = np.stack([np.zeros_like(widths), widths])
        # Between neighbouring places where a derivative vanishes the one before it vanishes once at most.
        for order in range(self.coefficients.shape[0] - 2, nu, -1):
            derivative = partial(self._derivative_in_intervals, nu=order, coefficients=self.coefficients[:, None])
            cuts = np.concatenate([cuts[:1], roots(derivative, cuts[:-1], cuts[1:]), cuts[-1:]])
        return float(np.abs(self._derivative_in_intervals(cuts, nu, self.coefficients[:, None])).max())

    def _derivative_in_intervals(self, x: Floats, nu: int, coefficients: Floats) -> Floats:
        """A derivative at distances from the left ends of intervals, whose coefficients stand beside them."""
        found = np.zeros(x.shape)
        for power in range(self.coefficients.shape[0] - 1, nu - 1, -1):
            found = found * x + perm(power, nu) * coefficients[power]
        return found


def solve_banded(band: Floats, right: Floats) -> Floats:
    """(n,) the solution of a symmetric positive definite system whose lower diagonals are given, (w + 1, n).

    By L D L^T, a column at a time, with no other operations than those of single numbers, so that the digits are the
    same everywhere (:mod:`graphcam.given.reproducible_sums`).  Behind its end a diagonal is filled up with zeros.

    >>> solve_banded(np.array([[2.0, 2.0, 2.0], [1.0, 1.0, 0.0]]), np.array([3.0, 4.0, 3.0])).round(12).tolist()
    [1.0, 1.0, 1.0]
    """
    wide, n = band.shape[0] - 1, band.shape[1]
    # Zeros behind the last column and before the first are unknowns that meet no other.
    columns, y = np.zeros((n + wide, wide + 1)), np.zeros(n + wide)
    columns[:n], y[:n] = band.T, right
    column = np.zeros(2 * wide + 1)
    products = sliding_window_view(column, wide + 1)[1:]
    for k in range(n):
        column[: wide + 1] = columns[k]
        shares = columns[k, 1:]
        shares /= columns[k, 0]
        after = slice(k + 1, k + 1 + wide)
        columns[after] -= shares[:, None] * products
        y[after] -= shares * y[k]
    back, distance = np.arange(n)[:, None], np.arange(wide, 0, -1)
    rows = np.where(back >= distance, columns[back - distance, distance], 0.0)
    z = np.concatenate([np.zeros(wide), y[:n] / columns[:n, 0]])
    for k in range(n - 1, -1, -1):
        z[k : k + wide] -= rows[k] * z[k + wide]
    return z[wide:]

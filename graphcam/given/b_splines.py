"""B-splines of one variable, as far as measured motions need them.

Written for itself because they must run where there is NumPy alone.  Source: C. de Boor, *A Practical Guide to Splines*
(rev. ed., 2001), chapters X and XIV.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from graphcam.given.piecewise import Floats


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

"""Many linear forms of unknowns that lie around a circle, each of a few neighbours; their squares make a band."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphcam.given.fixed_order import summed
from graphcam.given.laws import Floats


def around(number: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """Unknowns that are numbered around a circle, counted from both ends by turns, so that neighbours are near.

    >>> around(np.arange(6), 6).tolist()
    [0, 2, 4, 5, 3, 1]
    """
    return np.minimum(2 * number, 2 * (count - 1 - number) + 1)


@dataclass(frozen=True, eq=False)
class Forms:
    """Linear forms of unknowns.

    unknowns : (m, w) which ones each form takes;  factors : (m, w) how many times

    >>> differences = Forms(np.array([[0, 1], [1, 2]]), np.array([[-1.0, 1.0], [-1.0, 1.0]]))
    >>> differences(np.array([1.0, 4.0, 9.0])).tolist()
    [3.0, 5.0]
    >>> differences.squared(np.array([1.0, 10.0]), 3, 2).tolist()
    [[1.0, 11.0, 10.0], [-1.0, -10.0, 0.0]]
    """

    unknowns: NDArray[np.intp]
    factors: Floats

    def __call__(self, z: Floats) -> Floats:
        """(m,) their values."""
        return summed(self.factors * z[self.unknowns])

    def transposed(self, values: Floats, size: int) -> Floats:
        """(size,) the sum of values times forms."""
        return _summed(self.unknowns, self.factors * values[:, None], size)

    def squared(self, weights: Floats, size: int, bands: int) -> Floats:
        """(bands, size) the lower diagonals of the sum of weight times form times its transpose."""
        apart, first, products = self._products
        return _summed(apart * size + first, products * weights[:, None], bands * size).reshape(bands, size)

    @property
    def bands(self) -> int:
        """How many diagonals the squares have."""
        return int(self._products[0].max()) + 1

    @cached_property
    def _products(self) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
        """For every two unknowns of a form: how far apart they are, the first, and the product of their factors."""
        left, right = np.triu_indices(self.unknowns.shape[1])
        a, b = self.unknowns[:, left], self.unknowns[:, right]
        # Two factors of one unknown meet twice on the diagonal.
        times = np.where((left != right) & (a == b), 2.0, 1.0)
        return np.abs(a - b), np.minimum(a, b), times * self.factors[:, left] * self.factors[:, right]


def _summed(places: NDArray[np.intp], values: Floats, size: int) -> Floats:
    """(size,) the sums of the values that go to the same place."""
    sums: Floats = np.zeros(size)
    np.add.at(sums, places.ravel(), values.ravel())
    return sums

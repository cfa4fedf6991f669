"""Sums and powers whose digits do not depend on the machine.

IEEE 754 prescribes every digit of +, -, *, / and the square root, so what is made of them in one order is the same
everywhere.  A library of linear algebra adds in the order that is quick on its machine, and powers are approximations
that every library of mathematics makes in its own way.  The fit of a measured motion, which makes 1e-8 of a difference
in the last digit, uses neither.
"""

import numpy as np

from graphcam.given.piecewise import Floats


def ordered_sum(values: Floats) -> Floats:
    """The sums over the last axis, (..., n), one value added after the other; n is 1 or more.

    >>> ordered_sum(np.array([[1e16, 1.0, 1.0], [1.0, 1.0, 1e16]])).tolist()
    [1e+16, 1.0000000000000002e+16]
    """
    # np.sum adds in an order that depends on how the values lie in memory.
    return np.cumsum(values, axis=-1)[..., -1]


def column_sums(values: Floats) -> Floats:
    """The sums over the rows of a table, (n, m), each of its columns as :func:`ordered_sum` adds it.

    >>> column_sums(np.array([[1e16, 1.0], [1.0, 1.0], [1.0, 1e16]])).tolist()
    [1e+16, 1.0000000000000002e+16]
    """
    # Row after row, many columns at a time, is several times as fast; np.sum adds a single column in another order.
    return np.add.reduce(values, axis=0) if values.shape[1] > 1 else ordered_sum(values.T)


def powers(x: Floats | float, highest: int) -> Floats:
    """1, x, x^2, ... to the highest power, (highest + 1, ...), each the one before times x.

    >>> powers(3.0, 4).tolist()
    [1.0, 3.0, 9.0, 27.0, 81.0]
    """
    times = np.stack([np.ones_like(x, dtype=np.float64), *[np.asarray(x, dtype=np.float64)] * highest])
    return np.cumprod(times, axis=0)

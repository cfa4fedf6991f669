"""Where on a page things would rather stand: what it costs to put their lower left corner at x, y (in cells)."""

from __future__ import annotations

from graphcam.sheets.packing import Grid, Preference


def least(across: float, up: float) -> Preference:
    """Where a weighted sum of x and y is least.

    >>> import numpy as np
    >>> least(10, -1)(np.array([2.0]), np.array([5.0])).tolist()
    [15.0]
    """

    def cost(x: Grid, y: Grid) -> Grid:
        return across * x + up * y

    return cost


top_left, top_right = least(10, -1), least(-1, -10)
"""At the left, then high; high, then at the right."""
bottom_left, bottom_right = least(1, 10), least(-3, 1)
"""Low, then at the left; at the right, then low."""
high = least(1, -10)
"""High, then at the left."""


def left(x: Grid, y: Grid) -> Grid:
    """At the left, at middle height."""
    return 10 * x + abs(y - y.mean())


def top(x: Grid, y: Grid) -> Grid:
    """High, in the middle of the width."""
    return abs(x - x.mean()) - 10 * y


def middle(x: Grid, y: Grid) -> Grid:
    """In the middle of the free room."""
    return (x - x.mean()) ** 2 + (y - y.mean()) ** 2

"""Finding room on a page for things that may not overlap."""

import math
from collections.abc import Callable, Iterable, Sequence
from copy import copy
from typing import Self

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.sheets.box import Box

Grid = NDArray[np.float64]
Preference = Callable[[Grid, Grid], Grid]
"""Cost of putting the lower left corner of the whole at x, y, in cells; the least is taken."""
MESH = 2.0
"""Of the grid on which room is sought, mm."""
EDGE = 1e-6
"""A box that ends on a line of the grid does not touch the cells beyond it."""


class Room:
    """The free room inside a box, on a grid of 2 mm.

    >>> room = Room(Box(0, 0, 100, 50))
    >>> room.take(Box(0, 0, 60, 50))
    >>> room.find([Box(0, 0, 30, 20)], lambda x, y: x + y)
    (60+0j)
    >>> room.find([Box(0, 0, 50, 20)], lambda x, y: x + y) is None
    True
    """

    def __init__(self, inside: Box, taken: Iterable[Box] = ()) -> None:
        self.corner = inside.corner
        self.full = np.zeros((math.floor(inside.height / MESH), math.floor(inside.width / MESH)), dtype=bool)
        for box in taken:
            self.take(box)

    def copy(self) -> Self:
        """The same room, to be taken in another way."""
        other = copy(self)
        other.full = self.full.copy()
        return other

    def _cells(self, box: Box) -> tuple[int, int, int, int]:
        """The cells that a box touches: left, bottom, and the first ones beyond it."""
        box = box.moved(-self.corner)
        left, bottom = math.floor(box.left / MESH + EDGE), math.floor(box.bottom / MESH + EDGE)
        return left, bottom, math.ceil(box.right / MESH - EDGE), math.ceil(box.top / MESH - EDGE)

    def take(self, box: Box) -> None:
        """Occupy a box."""
        left, bottom, right, top = (max(0, cell) for cell in self._cells(box))
        self.full[bottom:top, left:right] = True

    def take_points(self, points: Points, margin: float) -> None:
        """Occupy the cells of points, and all cells in the squares that reach ``margin`` mm beyond them."""
        cells = np.floor((points - self.corner).view(np.float64).reshape(-1, 2) / MESH).astype(int)
        rows, columns = self.full.shape
        inside = np.all((cells >= 0) & (cells < (columns, rows)), axis=1)
        taken = np.zeros_like(self.full)
        taken[cells[inside, 1], cells[inside, 0]] = True
        for _ in range(math.ceil(margin / MESH)):
            taken[1:] |= taken[:-1].copy()
            taken[:-1] |= taken[1:].copy()
            taken[:, 1:] |= taken[:, :-1].copy()
            taken[:, :-1] |= taken[:, 1:].copy()
        self.full |= taken

    def find(self, boxes: Sequence[Box], preference: Preference) -> complex | None:
        """By how much to move the boxes, as one rigid body, so that all lie in free room; None if there is no room."""
        # How many cells are full to the left of and below each grid point: four of these tell if a box is free.
        sums = np.pad(self.full.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32), ((1, 0), (1, 0)))
        cells = np.array([self._cells(box) for box in boxes])
        least, most = cells[:, :2].min(axis=0), cells[:, 2:].max(axis=0)
        # Moves, in cells, that keep everything inside.
        columns, rows = sums.shape[1] - (most - least)[0], sums.shape[0] - (most - least)[1]
        if columns <= 0 or rows <= 0:
            return None
        free = np.ones((rows, columns), dtype=bool)
        for left, bottom, right, top in (cells - np.tile(least, 2)).tolist():
            below, above = sums[bottom : bottom + rows], sums[top : top + rows]
            # The cells between the two rows and left of each column: as many at the left as at the right, if free.
            between = above - below
            free &= between[:, right : right + columns] == between[:, left : left + columns]
        if not free.any():
            return None
        y, x = (cell.astype(np.float64) for cell in np.nonzero(free))
        best = int(np.argmin(preference(x, y)))
        return MESH * complex(x[best] - least[0], y[best] - least[1])


def least(across: float, up: float) -> Preference:
    """Where a weighted sum of x and y is least.

    >>> import numpy as np
    >>> least(10, -1)(np.array([2.0]), np.array([5.0])).tolist()
    [15.0]
    """
    return lambda x, y: across * x + up * y


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

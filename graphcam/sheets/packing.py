"""A packer of boxes that may not overlap on a page."""

import math
from collections.abc import Callable, Iterable, Sequence
from copy import copy
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.sheets.model import Box

Grid = NDArray[np.float64]
Preference = Callable[[Grid, Grid], Grid]
"""The cost of the whole with its lower left corner at x, y (in cells); the place with the least cost is taken."""
MESH = 2.0
"""The mesh of the grid on which room is sought [mm]."""
BATCH_PAIRS = 20_000
"""The number of pairs of a place and a box that are checked together."""
EDGE_TOLERANCE = 1e-6
"""The part of a cell by which a box may pass a line of the grid without touching the cells beyond it."""


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
        rows, columns = self.full.shape
        self._sums, self._summed = np.zeros((rows + 1, columns + 1), dtype=np.int32), 0
        for box in taken:
            self.take(box)

    def copy(self, by: complex = 0j) -> Self:
        """A copy of the room, moved ``by`` x + iy, that can be filled differently."""
        other = copy(self)
        other.full, other.corner = self.full.copy(), self.corner + by
        return other

    def _cells(self, box: Box) -> tuple[int, int, int, int]:
        """The cells that a box touches: left, bottom, and the first ones beyond it."""
        box = box.moved(-self.corner)
        left, bottom = math.floor(box.left / MESH + EDGE_TOLERANCE), math.floor(box.bottom / MESH + EDGE_TOLERANCE)
        return left, bottom, math.ceil(box.right / MESH - EDGE_TOLERANCE), math.ceil(box.top / MESH - EDGE_TOLERANCE)

    def take(self, box: Box) -> None:
        """Occupy a box."""
        left, bottom, right, top = (max(0, cell) for cell in self._cells(box))
        part = self.full[bottom:top, left:right]
        if not part.all():
            part[:] = True
            self._summed = min(self._summed, bottom)

    def take_points(self, points: Points, margin: float) -> None:
        """Occupy the cells of points, and all cells in squares that reach ``margin`` mm beyond them."""
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
        self._summed = 0

    @property
    def _counts(self) -> NDArray[np.int32]:
        """Counts of full cells to the left of and below each point of the grid: four of these tell if a box is free.

        They are counted when they are asked for, and again above the lowest row in which something has been taken.
        """
        rows = self._summed
        if rows < len(self.full):
            above = np.cumsum(self.full[rows:], axis=1, dtype=np.int32)
            above[0] += self._sums[rows, 1:]
            # Copies of the room share the former ones.
            self._sums = self._sums.copy()
            np.cumsum(above, axis=0, out=self._sums[rows + 1 :, 1:])
            self._summed = len(self.full)
        return self._sums

    def find(self, boxes: Sequence[Box], preference: Preference) -> complex | None:
        """The move x + iy of the boxes, as one rigid body, into free room; None if there is no room."""
        found = self.moves(boxes)
        return None if found is None else found.best(preference)

    def moves(self, boxes: Sequence[Box]) -> "FreeMoves | None":
        """All moves of the boxes, as one rigid body, into free room; None if there is no room."""
        cells = np.array([self._cells(box) for box in boxes])
        least, most = cells[:, :2].min(axis=0), cells[:, 2:].max(axis=0)
        # Moves, in cells, that keep everything inside.
        columns, rows = (self.full.shape[::-1] - (most - least) + 1).tolist()
        if columns <= 0 or rows <= 0:
            return None
        places = self._free_points(cells - np.tile(least, 2), rows, columns)
        if not places.size:
            return None
        wide = self.full.shape[1] + 1
        y = places // wide
        x = (places - y * wide).astype(np.float64)
        return FreeMoves(x, y.astype(np.float64), complex(*least))

    def _free_points(self, cells: NDArray[np.int_], rows: int, columns: int) -> NDArray[np.intp]:
        """The points of the grid, numbered row after row, to which boxes of cells can be moved; all in order."""
        sums, wide = self._counts, self.full.shape[1] + 1
        # The largest box first: it leaves the fewest places to look at for the others.
        sizes = (cells[:, 2:] - cells[:, :2]).prod(axis=1)
        cells = cells[np.argsort(-sizes, kind="stable")]
        left, bottom, right, top = cells[0].tolist()
        # The cells between two rows and left of each column: as many at the left as at the right, if a box is free.
        between = sums[top : top + rows] - sums[bottom : bottom + rows]
        free = between[:, right : right + columns] == between[:, left : left + columns]
        places = np.flatnonzero(free)
        # Of the grid, whose rows are longer than those of the places.
        places += places // columns * (wide - columns)
        counts, done = sums.reshape(-1), 1
        while done < len(cells) and places.size:
            lefts, bottoms, rights, tops = cells[done : done + max(1, BATCH_PAIRS // places.size), :, None].swapaxes(
                0, 1
            )
            below, above = bottoms * wide + places, tops * wide + places
            inside = counts.take(above + rights) - counts.take(above + lefts)
            free = inside == counts.take(below + rights) - counts.take(below + lefts)
            places, done = places[free.all(axis=0)], done + len(lefts)
        return places


@dataclass(frozen=True, eq=False)
class FreeMoves:
    """Where the lower left corner of boxes may lie (k,), in cells, and where it lies."""

    x: Grid
    y: Grid
    corner: complex

    def best(self, preference: Preference) -> complex:
        """The preferred move x + iy [mm]."""
        k = int(np.argmin(preference(self.x, self.y)))
        return MESH * (complex(self.x[k], self.y[k]) - self.corner)


def least_weighted(across: float, up: float) -> Preference:
    """The preference for the place where a weighted sum of x and y is minimal.

    >>> import numpy as np
    >>> least_weighted(10, -1)(np.array([2.0]), np.array([5.0])).tolist()
    [15.0]
    """
    return lambda x, y: across * x + up * y


prefer_top_left, prefer_top_right = least_weighted(10, -1), least_weighted(-1, -10)
"""Preferences for a place at the left, then high; and high, then at the right."""
prefer_bottom_left, prefer_bottom_right = least_weighted(1, 10), least_weighted(-3, 1)
"""Preferences for a low place, then at the left; and at the right, then low."""
prefer_high = least_weighted(1, -10)
"""The preference for a high place, then at the left."""


def at_left(x: Grid, y: Grid) -> Grid:
    """The preference for a place at the left, at middle height."""
    return 10 * x + abs(y - y.mean())


def prefer_top(x: Grid, y: Grid) -> Grid:
    """The preference for a high place in the middle of the width."""
    return abs(x - x.mean()) - 10 * y


def middle(x: Grid, y: Grid) -> Grid:
    """The preference for a place in the middle of the free room."""
    return (x - x.mean()) ** 2 + (y - y.mean()) ** 2

"""The cams worth a look among many: the front of size and pressure angle.

A cam is on the front if no other that keeps the limits is both smaller and of a smaller pressure angle (V. Pareto).
The front of designs that come block by block is that of all of them together: what one block beats can be forgotten.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.sweeps.design_space import Space
from graphcam.sweeps.sweep import Columns

SIZE_COLUMN, ANGLE, FEASIBLE = "prime_radius", "max_pressure_angle_rise_deg", "feasible"
"""The columns that make the front; where the angle was not asked for, the smallest cam alone is on it."""


@dataclass(frozen=True, eq=False)
class FoundBest:
    """What a sweep found besides its rows.

    feasible : designs within the limits;  front : by column, from the smallest design to that of the least pressure
        angle.  Both are None where the quantity ``feasible`` was not asked for
    """

    designs: int
    feasible: int | None = None
    front: Columns | None = None

    def with_block(self, space: Space, columns: Columns) -> FoundBest:
        """The best designs with some more of a space, by the columns of their results."""
        designs = self.designs + next(iter(columns.values())).size
        if FEASIBLE not in columns:
            return FoundBest(designs)
        front = front_of(space, columns)
        feasible = (self.feasible or 0) + int(np.count_nonzero(columns[FEASIBLE]))
        return FoundBest(designs, feasible, front if self.front is None else joined_front([self.front, front]))


def pareto_front(first: ArrayLike, second: ArrayLike) -> NDArray[np.intp]:
    """The numbers of the designs that no other beats in both measures, both the smaller the better; by the first.

    first, second : (n,).  A design that equals another one in both is there once, the earlier; NaN is never there

    >>> pareto_front([1, 2, 2, 3, 4], [9, 5, 4, 4, 3]).tolist()
    [0, 2, 4]
    """
    a, b = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    order = np.lexsort((b, a))
    order = order[~(np.isnan(a) | np.isnan(b))[order]]
    least_before = np.concatenate(([np.inf], np.minimum.accumulate(b[order])[:-1]))[: order.size]
    return order[b[order] < least_before]


def front_of(space: Space, columns: Columns) -> Columns:
    """The front of some designs of a space, by the columns of their results, and their size if that does not vary."""
    n = next(iter(columns.values())).size
    columns = {SIZE_COLUMN: np.full(n, space.axes[SIZE_COLUMN][0]), **columns}
    return front_among({name: column[columns[FEASIBLE]] for name, column in columns.items() if name != FEASIBLE})


def front_among(columns: Columns) -> Columns:
    """The front of designs within the limits.

    Of designs that are equal in both measures the first in the order of all other columns is taken, so that it does not
    matter in which order the designs came.
    """
    order = np.lexsort(tuple(reversed(columns.values())))
    size = columns[SIZE_COLUMN][order]
    angle = np.abs(columns[ANGLE][order]) if ANGLE in columns else np.zeros(size.size)
    best = order[pareto_front(size, angle)]
    return {name: column[best] for name, column in columns.items()}


def joined_front(fronts: Sequence[Mapping[str, Any]]) -> Columns:
    """The front of several together.

    >>> parts = [{"prime_radius": [40.0, 50.0]}, {"prime_radius": [30.0]}]
    >>> joined_front(parts)["prime_radius"].tolist()
    [30.0]
    """
    # A front of no design, as it is read from a file, does not know the kind of its values.
    parts = [part for part in fronts if len(part[SIZE_COLUMN])] or fronts
    return front_among({name: np.concatenate([np.asarray(part[name]) for part in parts]) for name in parts[0]})


def front_csv(front: Columns) -> str:
    """The front as a table of CSV."""
    text = StringIO(newline="")
    table = csv.writer(text)
    table.writerow(front)
    table.writerows(zip(*(column.tolist() for column in front.values()), strict=True))
    return text.getvalue()

"""Where a motion rests or turns among a few rows of a table, sought by least squares.

A law of motion leaves its level L as a power of the way: s = L + c z^p (1 + b z), with z the cam angle since it left,
and p = 2 where the acceleration jumps, 3 where the jerk does, 4 where both are continuous.  Before and after a stop L
is the same; all else, and the places where the motion arrives and leaves, is sought by linear least squares for every p
on places that are refined.  It rests if two places explain the rows better than one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphcam.given.laws import Floats
from graphcam.given.reproducible_sums import column_sums, ordered_sum

MAX_STOP_ROWS, MIN_WAY_ROWS = 512, 32
"""Of more rows about a stop the means of neighbours are looked at, which tell as much where so many lie on its way."""
END_POWERS, POWER_PENALTIES = np.array([2, 3, 4]), np.array([1.4, 0.0, 3.6])
"""The powers in which a law may leave its rest, and -2 log of their shares (3, 6, 1 of ten laws) over the largest."""
TRIED_PLACES, SEARCH_ROUNDS = 13, 7
"""Places tried at a time, and rounds in which they close in on the best one and its neighbours."""
MIN_EVIDENCE = 16.0
"""A rest takes at least so much from the sum of squares [variances of the noise] that a turning leaves, ..."""
FLAT_PENALTIES, LONG_REST_SHARE = np.array([0.0, 8.0, 14.0]), 0.2
"""... to which a flat turning adds this by its powers, beside a rest over such a part of the rows or more."""
ROW_SNAP = 4.0
"""A rest ends at a row if that adds no more than this to the sum of squares [variances of the noise]."""
MAX_TABLE = 2**16
"""Rows times places of which fewer are looked at at once, so that they are near at hand in the machine's memory."""
NEGLIGIBLE_ANGLE, SINGULAR_DETERMINANT = 1e-9, 1e-12
"""A way [rad] of less is none; a determinant of less than this beside its terms says that rows are missing."""


@dataclass(frozen=True)
class StopInterval:
    """A stop: from where to where a motion rests, or where it turns (then start = end).

    start, end : cam angles [rad]
    powers : p before and after
    misfit : the mean square of what is left [variances of the noise]
    """

    start: float
    end: float
    powers: tuple[int, int]
    misfit: float


@dataclass(frozen=True)
class StopRows:
    """The rows about a place at which a motion may stop, 0.

    x, y : (n,) cam angles [rad] that grow, and displacements
    directions : of the displacement away from the stop, before and after
    reach : how far before and after 0 it may arrive and leave [rad]
    noise : standard deviation of the displacements
    """

    x: Floats
    y: Floats
    directions: tuple[int, int]
    reach: tuple[float, float]
    noise: float

    @property
    def joined(self) -> int:
        """How many neighbours one mean is made of: 1 where there are few rows, or few on the way."""
        before, after = self.reach
        way = int(min(np.count_nonzero(self.x < -before), np.count_nonzero(self.x > after)))
        return max(1, min(-(-self.x.size // MAX_STOP_ROWS), way // MIN_WAY_ROWS))

    @property
    def means(self) -> StopRows:
        """The means of neighbours; rows that are over at the end are left out.

        >>> StopRows(np.arange(-512.0, 513), np.ones(1025), (1, 1), (400.0, 400.0), 0.3).means.x[:3].tolist()
        [-511.0, -508.0, -505.0]
        """
        count = self.joined
        if count == 1:
            return self
        whole = self.x.size // count * count
        x, y = (ordered_sum(each[:whole].reshape(-1, count)) / count for each in (self.x, self.y))
        return replace(self, x=x, y=y, noise=self.noise / math.sqrt(count))

    def leaving(self, side: int, places: Floats, since: Floats, powers: Floats) -> _Squares:
        """The least squares of rows from ``since`` on, for a motion that leaves at the places; backwards before 0."""
        x, y = (self.x, self.y) if side else (-self.x[::-1], self.y[::-1])
        on_way = np.searchsorted(x, places.min(), side="right")
        if places.size * (x.size - on_way) > MAX_TABLE:
            order = np.argsort(places)
            parts = (self.leaving(side, places[k], since[k], powers[k]) for k in np.array_split(order, 2))
            return _Squares(*np.concatenate([*parts], axis=1)[:, np.argsort(order)])
        way = np.maximum(x[-1] - places, NEGLIGIBLE_ANGLE)
        # Rows before all places add nothing but to the sums of 1, y and y^2, which begin at few rows.
        begins, begin = np.unique(np.searchsorted(x, since), return_inverse=True)
        levels = np.stack([np.ones(x.size), y, y * y])
        ones = np.stack([ordered_sum(levels[:, k:]) for k in begins.tolist()], axis=1)[:, begin]
        z = np.maximum(x[on_way:, None] - places, 0.0) / way
        square = z * z
        first = square * np.choose(powers - END_POWERS[0], [1.0, z, square])
        return _least_squares(ones, first, first * z, y[on_way:, None], self.directions[side], powers)


class _Squares(NamedTuple):
    """The least sums of squares as functions of the level L: least + weight (L - level)^2."""

    least: Floats
    weight: Floats
    level: Floats

    def at(self, level: float) -> Floats:
        """The sums of squares if the rest lies at a level."""
        return self.least + self.weight * (level - self.level) ** 2


def find_stop(rows: StopRows, shortest: float) -> StopInterval:
    """The stop among some rows; a rest that is shorter than ``shortest`` [rad] is a turning.

    >>> x = np.radians(np.arange(-20.0, 21.0))
    >>> y = np.maximum(np.abs(x) - np.radians(7), 0) ** 3
    >>> stop = find_stop(StopRows(x, y, (1, 1), (0.2, 0.2), 1e-6), 0.02)
    >>> np.degrees([stop.start, stop.end]).round(3).tolist(), stop.powers
    ([-7.0, 7.0], (3, 3))
    """
    table, rows = rows, rows.means
    variance = rows.noise**2
    freedom = variance * max(rows.x.size - 7, 1)
    turnings, places, powers = _best_turnings(rows)
    resting, (before, after), left_by, level = _best_dwell(rows)
    long = before + after >= LONG_REST_SHARE * (rows.x[-1] - rows.x[0])
    prices = ordered_sum(FLAT_PENALTIES[powers - END_POWERS[0]]) if long else 0.0
    best = int(np.argmin(turnings + prices * variance))
    if not resting + MIN_EVIDENCE * variance < (turnings + prices * variance)[best] or before + after < shortest:
        turning = float(turnings[best])
        place = float(places[best]) if np.isfinite(turning) else 0.0
        return StopInterval(place, place, (int(powers[best, 0]), int(powers[best, 1])), turning / freedom)
    if table is not rows:
        ends = enumerate(zip((before, after), left_by, strict=True))
        before, after = (_at_row(table, side, end, power, level)[1] for side, (end, power) in ends)
    return StopInterval(-before, after, left_by, resting / freedom)


def _best_turnings(rows: StopRows) -> tuple[Floats, Floats, NDArray[np.intp]]:
    """The least sums of squares (n,) of a motion that turns at one place, the places, and all powers (n, 2)."""
    before, after = (powers.ravel() for powers in np.meshgrid(END_POWERS, END_POWERS))
    low, high = np.full(before.size, -rows.reach[0]), np.full(before.size, rows.reach[1])
    squares = centre = low
    for _ in range(SEARCH_ROUNDS):
        places = np.linspace(low, high, TRIED_PLACES)
        flat = places.ravel()
        come = rows.leaving(0, -flat, -flat, np.tile(before, TRIED_PLACES))
        leave = rows.leaving(1, flat, flat, np.tile(after, TRIED_PLACES))
        together = come.least + leave.least
        together += come.weight * leave.weight / (come.weight + leave.weight) * (come.level - leave.level) ** 2
        best = together.reshape(places.shape).argmin(axis=0)
        squares = together.reshape(places.shape).min(axis=0)
        low, centre, high = _closer(places, best)
    return squares, centre, np.stack([before, after], axis=1)


def _best_dwell(rows: StopRows) -> tuple[float, list[float], tuple[int, int], float]:
    """The least sum of squares of a motion that rests at 0, how long before and after, its powers, and its level."""
    level = float(rows.y[np.argmin(np.abs(rows.x))])
    low: list[Floats] = [np.zeros(END_POWERS.size)] * 2
    high: list[Floats] = [np.full(END_POWERS.size, far) for far in rows.reach]
    found: list[tuple[float, float, float, int]] = []
    for _ in range(SEARCH_ROUNDS):
        found = []
        for side in (0, 1):
            places = np.linspace(low[side], high[side], TRIED_PLACES)
            flat = places.ravel()
            squares = rows.leaving(side, flat, np.zeros(flat.size), np.tile(END_POWERS, TRIED_PLACES))
            at_level = squares.at(level).reshape(places.shape) + (POWER_PENALTIES * rows.noise**2)
            best = at_level.argmin(axis=0)
            low[side], centre, high[side] = _closer(places, best)
            k = int(np.argmin(at_level.min(axis=0)))
            pick = best[k] * END_POWERS.size + k
            found.append(
                (float(squares.weight[pick]), float(squares.level[pick]), float(centre[k]), int(END_POWERS[k]))
            )
        weights, levels, _, _ = zip(*found, strict=True)
        level = float(np.average(levels, weights=weights))
    ends = [_at_row(rows, side, end, power, level) for side, (_, _, end, power) in enumerate(found)]
    return sum(cost for cost, _ in ends), [end for _, end in ends], (found[0][3], found[1][3]), level


def _closer(places: Floats, best: NDArray[np.intp]) -> tuple[Floats, Floats, Floats]:
    """The best of the places in every column, and its neighbours on both sides."""
    column = np.arange(places.shape[1])
    low, high = np.maximum(best - 1, 0), np.minimum(best + 1, TRIED_PLACES - 1)
    return places[low, column], places[best, column], places[high, column]


def _at_row(rows: StopRows, side: int, end: float, power: int, level: float) -> tuple[float, float]:
    """The sum of squares, and an end of a rest: at a row if it may be, because most phases end where a table has one.

    level : of the rest
    """
    x = np.abs(rows.x[rows.x * (side - 0.5) > 0])
    # As near as the means of rows may have moved it.
    count = 2 * rows.joined - 1
    places = np.append(end, x[np.argsort(np.abs(x - end), kind="stable")[:count]])
    squares = rows.leaving(side, places, np.zeros(places.size), np.full(places.size, power)).at(level)
    k = 1 + int(np.argmin(squares[1:]))
    k *= int(squares[k] <= squares[0] + ROW_SNAP * rows.noise**2)
    return float(squares[k]), float(places[k])


def _least_squares(ones: Floats, first: Floats, second: Floats, y: Floats, direction: int, powers: Floats) -> _Squares:
    """The sums of squares for the columns 1, z^p, z^(p + 1); infinite where these would lead the other way.

    ones : (3, m) the sums of 1, y and y^2
    first, second, y : (n, m), (n, m) and (n, 1), without rows that are zero in all columns
    """
    n, y_n, y_y = ones
    p, q, y_p, y_q = (column_sums(column) for column in (first, second, first * y, second * y))
    a, b, c = (column_sums(column) for column in (first * first, first * second, second * second))
    determinant = a * c - b * b
    sound = determinant > SINGULAR_DETERMINANT * a * c
    determinant = np.where(sound, determinant, 1.0)
    # What z^p and z^(p + 1) explain of the level's column, and of the rows.
    level_p, level_q = (c * p - b * q) / determinant, (a * q - b * p) / determinant
    rows_p, rows_q = (c * y_p - b * y_q) / determinant, (a * y_q - b * y_p) / determinant
    weight = n - (level_p * p + level_q * q)
    sound &= weight > NEGLIGIBLE_ANGLE
    weight = np.where(sound, weight, 1.0)
    level = (y_n - (level_p * y_p + level_q * y_q)) / weight
    times_p, times_q = direction * (rows_p - level_p * level), direction * (rows_q - level_q * level)
    sound &= (times_p > 0) & (powers * times_p + (powers + 1) * times_q > 0)
    least = y_y - (rows_p * y_p + rows_q * y_q) - weight * level**2
    return _Squares(np.where(sound, np.maximum(least, 0.0), np.inf), weight, level)

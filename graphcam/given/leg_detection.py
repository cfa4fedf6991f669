"""What a table of displacements does over the turn: where it rests, where it turns, and the legs between.

A rise or return of less than the tolerance hides is no leg.  What keeps to a level as far as the noise can tell is
looked at once, as a whole; so no leg begins between two rests that noise cannot tell apart.

Where a motion rests or turns among a few rows of a table, sought by least squares.

A law of motion leaves its level L as a power of the way: s = L + c z^p (1 + b z), with z the cam angle since it left,
and p = 2 where the acceleration jumps, 3 where the jerk does, 4 where both are continuous.  Before and after a stop L
is the same; all else, and the places where the motion arrives and leaves, is sought by linear least squares for every p
on places that are refined.  It rests if two places explain the rows better than one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.reproducible_sums import column_sums, ordered_sum
from graphcam.words import say

# --- where a motion rests or turns -----------------------------------------------------------------------------------

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


# --- the legs between ------------------------------------------------------------------------------------------------

MIN_LEG_LIFT = 2.0
"""A rise or return of less than this many tolerances is not told from noise."""
MAX_TURNINGS = 24
"""What turns more often is noise."""
MAX_LEVEL_DEVIATION = 6.0
"""The rows of a rest are off their level by less than this [sd of the noise]."""
STOP_DEVIATION, STOP_LEG_SHARE = 100.0, 0.15
"""A stop is judged by rows that are off its level by no more than this [sd of the noise] and part of the leg, ..."""
MIN_STOP_ROWS = 5
"""The minimum number of rows on either side by which a stop is judged."""
SLOW_FACTOR = 2.0
"""A motion on its way may rest where it is so many times slower than on average."""


@dataclass(frozen=True)
class Leg:
    """A stretch over which the displacement rises (+1) or falls (-1), and whether there is a rest before and after.

    start, end : cam angles [rad]; the next leg starts where this one ends, or at the end of the rest between
    """

    start: float
    end: float
    direction: int
    from_rest: bool
    to_rest: bool

    @property
    def a_turn_later(self) -> Leg:
        """The leg in the next revolution."""
        return replace(self, start=self.start + FULL_TURN, end=self.end + FULL_TURN)


@dataclass(frozen=True)
class _LevelRows:
    """Rows first .. last that keep to a level, where the motion may rest or turn."""

    first: int
    last: int
    level: float

    def shifted(self, rows: int) -> _LevelRows:
        return replace(self, first=self.first + rows, last=self.last + rows)


def find_legs(phi: Floats, s: Floats, tolerance: float, noise: float) -> tuple[list[Leg], float]:
    """The legs of a table over one turn, in order, and how many times more than the noise their stops are off at most.

    phi, s : (n,) cam angles [rad] that grow over less than a turn, and the displacements there
    noise : the standard deviation of the displacements

    Raises
    ------
    DesignError : the displacement moves by no more than the tolerance hides, turns too often, or turns between two
        levels that noise does not tell apart

    >>> phi = np.radians(np.arange(0, 360, 10))
    >>> legs, _ = find_legs(phi, 10 - 10 * np.cos(phi), tolerance=0.01, noise=0.001)
    >>> [(round(leg.end - leg.start, 3), leg.direction, leg.to_rest) for leg in legs]
    [(3.142, 1, False), (3.142, -1, False)]
    """
    if not np.ptp(s) > MIN_LEG_LIFT * tolerance:
        limit = say(
            "more than {value:g}, {depth:g} times the tolerance", value=MIN_LEG_LIFT * tolerance, depth=MIN_LEG_LIFT
        )
        remedy = say("give the table of a motion, or a smaller tolerance")
        raise DesignError(say("the table's lift"), say("{ptp:.4g}", ptp=np.ptp(s)), limit, remedy)
    turnings = _turnings(s, MIN_LEG_LIFT * tolerance)
    # Three turns of rows, so that nothing begins or ends within the middle one.
    around, rows = np.concatenate([phi - FULL_TURN, phi, phi + FULL_TURN]), np.tile(s, 3)
    flats = [_level_rows(rows, k + s.size, noise) for k in turnings]
    apart = all(a.last < b.first for a, b in pairwise([*flats, flats[0].shifted(s.size)]))
    if not apart or len(turnings) > MAX_TURNINGS:
        limit = say("greater than the noise that turns the table {turnings} times", turnings=len(turnings))
        raise DesignError("tolerance", tolerance, limit)
    flats = _with_intermediate_dwells(around, rows, flats, noise, MIN_LEG_LIFT * tolerance)
    gap = FULL_TURN / s.size
    stops = _stops(around, rows, flats, noise, gap)
    ends = [(flat.level, *_to_the_turn(*_ends(stop, gap), gap)) for flat, stop in stops]
    first = ends[0]
    legs = [
        Leg(end, start, 1 if above > below else -1, end > begin, finish > start)
        for (below, begin, end), (above, start, finish) in pairwise(
            [*ends, (first[0], first[1] + FULL_TURN, first[2] + FULL_TURN)]
        )
    ]
    return legs, float(np.sqrt(max(stop.misfit for _, stop in stops)))


def _stops(
    around: Floats, rows: Floats, flats: list[_LevelRows], noise: float, gap: float
) -> list[tuple[_LevelRows, StopInterval]]:
    """The flats at which the motion turns or rests, each with its stop.

    On a leg's way a stop without a rest is none.  Slow rows beside a rest may look like one, and leave few rows by
    which the rest is judged: without them it is judged once more.
    """
    n = rows.size // 3
    judged: dict[tuple[_LevelRows, _LevelRows, _LevelRows], tuple[StopInterval, bool]] = {}
    while True:
        neighbours = [*zip([flats[-1].shifted(-n), *flats], flats, [*flats[1:], flats[0].shifted(n)], strict=False)]
        judged |= {near: _stop(around, rows, near, noise, gap) for near in neighbours if near not in judged}
        found = ((near[1], *judged[near]) for near in neighbours)
        stops = [(flat, stop) for flat, stop, turns in found if turns or stop.end > stop.start]
        if len(stops) == len(flats):
            return stops
        flats = [flat for flat, _ in stops]


def _turnings(s: Floats, depth: float) -> list[int]:
    """The rows of extremes, between which the displacement swings by more than ``depth``, from the lowest one on."""
    lowest = int(np.argmin(s))
    values = np.roll(s, -lowest).tolist()
    found, best, direction = [0], 0, 1
    for k, value in enumerate([*values[1:], values[0]], 1):
        gain = direction * (value - values[best])
        if gain > 0 and k < s.size:
            best = k
        elif gain < -depth:
            found.append(best)
            best, direction = k % s.size, -direction
    return [lowest + k for k in found]


def _level_rows(rows: Floats, k: int, noise: float) -> _LevelRows:
    """The rows about an extreme that keep to its level as far as noise can tell."""
    first, last = _run(rows, k, float(rows[k]), 2 * MAX_LEVEL_DEVIATION * noise)
    quarter, middle = (last - first) // 4, (first + last) // 2
    level = float(np.median(rows[first + quarter : last + 1 - quarter]))
    if abs(rows[middle] - level) > MAX_LEVEL_DEVIATION * noise:
        return _LevelRows(k, k, float(rows[k]))
    return _LevelRows(*_run(rows, middle, level, MAX_LEVEL_DEVIATION * noise), level)


def _run(rows: Floats, k: int, level: float, off: float) -> tuple[int, int]:
    """The first and the last row about k that are off the level by no more than ``off``."""
    outside = np.abs(rows - level) > off
    before, after = np.flatnonzero(outside[:k]), np.flatnonzero(outside[k + 1 :])
    return int(before[-1]) + 1 if before.size else 0, k + int(after[0]) if after.size else rows.size - 1


def _with_intermediate_dwells(
    around: Floats, rows: Floats, flats: list[_LevelRows], noise: float, depth: float
) -> list[_LevelRows]:
    """The extremes' flats, and between them those that a rise or a return may have on its way."""
    n = rows.size // 3
    found: list[_LevelRows] = []
    for a, b in pairwise([*flats, flats[0].shifted(n)]):
        found.append(a)
        between = slice(a.last + 1, b.first)
        direction = 1.0 if b.level > a.level else -1.0
        slow = _slow_rows(around[between], direction * rows[between], noise, depth)
        found += [replace(flat, level=direction * flat.level).shifted(between.start) for flat in slow]
    return found


def _slow_rows(x: Floats, y: Floats, noise: float, depth: float) -> list[_LevelRows]:
    """Where rising rows are slow for long, more than ``depth`` above the first and below the last; in order."""
    found: list[_LevelRows] = []
    # With much noise the last of the rows between may be no higher than the first.
    if y.size < 2 * MIN_STOP_ROWS or y[-1] <= y[0]:
        return found
    spread = 2 * MAX_LEVEL_DEVIATION * noise
    usual = spread * (x[-1] - x[0]) / (y[-1] - y[0])
    # From each row on, as far as the rows have not risen by more than what noise may; an outlier lies below them all.
    ends = np.maximum(np.searchsorted(np.maximum.accumulate(y), y + spread, side="right") - 1, np.arange(y.size))
    length = x[ends] - x
    while length.max() > SLOW_FACTOR * usual:
        first = int(np.argmax(length))
        last = int(ends[first])
        level = float(np.median(y[first : last + 1]))
        if last - first >= MIN_STOP_ROWS and level - y[0] > depth and y[-1] - level > depth:
            inside = first + np.flatnonzero(np.abs(y[first : last + 1] - level) <= MAX_LEVEL_DEVIATION * noise)
            if inside.size:  # of rows in two groups the median lies between, where no row is
                found.append(_LevelRows(int(inside[0]), int(inside[-1]), level))
        length[(ends >= first) & (np.arange(y.size) <= last)] = 0.0
    return sorted(found, key=lambda flat: flat.first)


def _stop(
    around: Floats, rows: Floats, near: tuple[_LevelRows, _LevelRows, _LevelRows], noise: float, gap: float
) -> tuple[StopInterval, bool]:
    """The stop at a flat between two others, and whether the motion turns there."""
    before, here, after = near
    lifts = before.level - here.level, after.level - here.level
    first = _edge(
        rows, here.first, before.last, here.level, min(STOP_DEVIATION * noise, STOP_LEG_SHARE * abs(lifts[0]))
    )
    last = _edge(rows, here.last, after.first, here.level, min(STOP_DEVIATION * noise, STOP_LEG_SHARE * abs(lifts[1])))
    centre = float(around[here.first] + around[here.last]) / 2
    reach = centre - float(around[here.first - 1]), float(around[here.last + 1]) - centre
    directions = 1 if lifts[0] > 0 else -1, 1 if lifts[1] > 0 else -1
    x, y = around[first : last + 1] - centre, rows[first : last + 1] - here.level
    stop = find_stop(StopRows(x, y, directions, reach, noise), gap)
    moved = replace(stop, start=centre + stop.start, end=centre + stop.end)
    return moved, directions[0] == directions[1]


def _edge(rows: Floats, edge: int, limit: int, level: float, off: float) -> int:
    """The first row after (or before) the edge of a flat that is off its level by more, not beyond the next flat."""
    step = 1 if limit > edge else -1
    outside = np.abs(rows[edge + step : limit : step] - level) > off
    way = 1 + (int(np.argmax(outside)) if outside.any() else outside.size)
    return edge + step * min(max(way, MIN_STOP_ROWS), abs(limit - edge))


def _ends(stop: StopInterval, gap: float) -> tuple[float, float]:
    """The ends of a stop; a rest half a gap sooner where the acceleration jumps, which the spline rounds."""
    if stop.end == stop.start:
        return stop.start, stop.end
    sooner, later = (gap / 2 if power == 2 else 0.0 for power in stop.powers)
    if stop.end - stop.start - sooner - later < gap:
        return stop.start, stop.end
    return stop.start + sooner, stop.end - later


def _to_the_turn(start: float, end: float, gap: float) -> tuple[float, float]:
    """A rest without the part beyond the begin of a turn, if that is shorter than a gap: it would be a phase by itself.

    So the leg beside it begins sooner, or ends later, where the spline may keep to the level all the same.
    """
    turn = FULL_TURN * np.ceil(start / FULL_TURN)
    if not start < turn < end:
        return start, end
    if end - turn < gap:
        end = turn
    return (turn if turn - start < gap and turn < end else start), end

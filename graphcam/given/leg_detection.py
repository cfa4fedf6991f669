"""What a table of displacements does over the turn: where it rests, where it turns, and the legs between.

A rise or return of less than the tolerance hides is no leg.  What keeps to a level as far as the noise can tell is
looked at once, as a whole; so no leg begins between two rests that noise cannot tell apart.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.stop_detection import StopInterval, StopRows, find_stop
from graphcam.words import say

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

"""What a table of displacements does over the turn: where it rests, where it turns, and the legs between.

A rest is a run of rows that keep to one level for longer than a turning point would; a rise or return of less than the
tolerance hides is no leg.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN

LEVEL = 0.7
"""The rows of a rest differ by at most this fraction of the tolerance."""
DEPTH = 2.0
"""A rise or return of less than this many tolerances is not told from noise."""
LONGER_THAN_TURNING = 1.5
"""A rest is at least so many times longer than an eccentric, which turns slowest, keeps to a level so."""
OUTSIDE = 1.5
"""An end row of a rest belongs to it if it is off by no more than so many times what the rows in its middle are."""


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
        """The same leg in the next revolution."""
        return replace(self, start=self.start + FULL_TURN, end=self.end + FULL_TURN)


@dataclass(frozen=True)
class _Stop:
    """A row, or the rows of a rest: cam angles [rad] and displacement."""

    start: float
    end: float
    level: float

    @property
    def rest(self) -> bool:
        return self.end > self.start

    @property
    def a_turn_later(self) -> _Stop:
        return replace(self, start=self.start + FULL_TURN, end=self.end + FULL_TURN)


def find_legs(phi: Floats, s: Floats, tolerance: float) -> list[Leg]:
    """The legs of a table over one turn, in order.

    phi, s : (n,) cam angles [rad] that grow over less than a turn, and the displacements there

    Raises
    ------
    DesignError : the displacement moves by no more than the tolerance hides

    >>> phi = np.radians(np.arange(0, 360, 10))
    >>> legs = find_legs(phi, 10 - 10 * np.cos(phi), tolerance=0.01)
    >>> [(round(leg.end - leg.start, 3), leg.direction, leg.to_rest) for leg in legs]
    [(3.142, 1, False), (3.142, -1, False)]
    """
    lift = float(np.ptp(s))
    if not lift > DEPTH * tolerance:
        limit = f"more than {DEPTH * tolerance:g}, {DEPTH:g} times the tolerance"
        remedy = "give the table of a motion, or a smaller tolerance"
        raise DesignError("the table's lift", f"{lift:.4g}", limit, remedy)
    # Begun where it moves fastest, the table has no rest across its ends.
    steepness = np.abs(np.roll(s, -1) - s) / ((np.roll(phi, -1) - phi) % FULL_TURN)
    first = (int(np.argmax(steepness)) + 1) % s.size
    phi, s = np.concatenate([phi[first:], phi[:first] + FULL_TURN]), np.roll(s, -first)
    stops = _stops(phi, s, tolerance, lift)
    lowest = min(range(len(stops)), key=lambda k: stops[k].level)
    around = [*stops[lowest:], *(stop.a_turn_later for stop in stops[: lowest + 1])]
    turnings = _turnings(around, DEPTH * tolerance)
    # The places where a leg ends are the turnings and, within a rise or a return, the rests.
    ends = [k for k, stop in enumerate(around) if stop.rest or k in turnings]
    places = [around[k] if around[k].rest else _turning_point(around, k) for k in ends]
    places[-1] = places[0].a_turn_later
    directions = np.sign(np.diff([around[k].level for k in ends]))
    return [
        Leg(a.end, b.start, int(direction), a.rest, b.rest)
        for (a, b), direction in zip(pairwise(places), directions, strict=True)
    ]


def _stops(phi: Floats, s: Floats, tolerance: float, lift: float) -> list[_Stop]:
    """The rows in order, those of a rest as one."""
    # An eccentric's s = lift/2 (1 - cos phi) is lift phi^2/4 near its turning point.
    shortest = LONGER_THAN_TURNING * 4 * math.sqrt(LEVEL * tolerance / lift)
    stops: list[_Stop] = []
    row = 0
    while row < s.size:
        # The run of rows from here on whose displacements differ by no more than those of a rest.
        spread = np.maximum.accumulate(s[row:]) - np.minimum.accumulate(s[row:])
        last = row + int(np.searchsorted(spread, LEVEL * tolerance, side="right")) - 1
        first, last, level = _trimmed(s, row, last)
        if last - first < 2 or phi[last] - phi[first] < shortest:
            first, last, level = row, row, float(s[row])
        stops += [_Stop(float(phi[k]), float(phi[k]), float(s[k])) for k in range(row, first)]
        start = -_left(-phi[: last + 1][::-1], s[: last + 1][::-1], last - first, level, tolerance)
        stops.append(_Stop(start, _left(phi[first:], s[first:], last - first, level, tolerance), level))
        row = last + 1
    return _merged(stops, tolerance)


def _trimmed(s: Floats, first: int, last: int) -> tuple[int, int, float]:
    """A run without the rows at its ends where the motion has begun, and its level."""
    quarter = (last - first) // 4
    middle = s[first + quarter : last + 1 - quarter]
    level = float(np.median(middle))
    off = OUTSIDE * float(np.max(np.abs(middle - level)))
    inside = np.flatnonzero(np.abs(s[first : last + 1] - level) <= off)
    return first + int(inside[0]), first + int(inside[-1]), level


def _left(phi: Floats, s: Floats, last: int, level: float, tolerance: float) -> float:
    """The cam angle where a rest, from the first of the rows to the ``last`` at most, is left.

    What leaves it as x^3 is off by eight times as much at twice the distance.  What leaves it as x^2 does so a little
    later than told, which does no harm: the spline stays level where it may move.
    """
    off = np.abs(s - level)
    near, far = (int(np.argmax(off > limit)) for limit in (tolerance, 8 * tolerance))
    if last == 0 or not 0 < near <= far:
        return float(phi[last])
    crossings = [
        np.interp(limit, off[k - 1 : k + 1], phi[k - 1 : k + 1])
        for k, limit in ((near, tolerance), (far, 8 * tolerance))
    ]
    # At a row, because phases mostly begin where a table has one.
    row = int(np.argmin(np.abs(phi - (2 * crossings[0] - crossings[1]))))
    return float(phi[min(max(row, last // 2 + 1), last)])


def _merged(stops: list[_Stop], tolerance: float) -> list[_Stop]:
    """The stops, with rests that noise has parted joined again."""
    joined: list[_Stop] = []
    for stop in stops:
        latest = next((k for k in reversed(range(len(joined))) if joined[k].rest), None) if stop.rest else None
        if latest is not None and all(abs(other.level - stop.level) <= tolerance for other in joined[latest:]):
            joined[latest:] = [_Stop(joined[latest].start, stop.end, joined[latest].level)]
        else:
            joined.append(stop)
    return joined


def _turnings(stops: list[_Stop], depth: float) -> set[int]:
    """Which stops are lowest or highest between swings of more than ``depth``; the first and last are lowest."""
    found = {0, len(stops) - 1}
    direction, best = 1, 0
    for k, stop in enumerate(stops):
        gain = direction * (stop.level - stops[best].level)
        # Among levels that noise may have parted a rest is the turning.
        if gain > (depth if stops[best].rest else 0.0) or (stop.rest and not stops[best].rest and gain > -depth):
            best = k
        elif gain < -depth:
            found.add(best)
            direction, best = -direction, k
    return found


def _turning_point(stops: list[_Stop], k: int) -> _Stop:
    """The top of the parabola through a turning row and its neighbours, kept between these."""
    row = stops[k]
    # The first and the last stop are the same one, a turn apart.
    before = stops[k - 1] if k else _Stop(stops[-2].start - FULL_TURN, stops[-2].end - FULL_TURN, stops[-2].level)
    after = stops[k + 1] if k + 1 < len(stops) else stops[1].a_turn_later
    left, right = before.end - row.start, after.start - row.start
    slope_left, slope_right = (before.level - row.level) / left, (after.level - row.level) / right
    bend = (slope_right - slope_left) / (right - left)
    top = -(slope_left - bend * left) / (2 * bend) if bend else 0.0
    top = row.start + min(max(float(top), left / 2), right / 2)
    return _Stop(top, top, row.level)

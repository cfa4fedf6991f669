"""What a table of displacements does over the turn: where it rests, where it turns, and the legs between."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.rests import find_stop

DEPTH = 2.0
"""A rise or return of less than this many tolerances is not told from noise."""
SPREAD = 10.0
"""The rows of a rest differ by less than this [sd of the noise], and ..."""
OFF = 6.0
"""... are off their level by less than this."""
SEEN, PART = 100.0, 0.15
"""A stop is judged by rows that are off its level by no more than this [sd of the noise], and this part of the leg."""
FEWEST = 5
"""Rows on either side of a stop, that it is judged by."""
SLOW = 3.0
"""On its way a motion may rest where it is so many times slower than on average."""


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
class _Flat:
    """Rows first .. last that keep to a level, where the motion may rest or turn."""

    first: int
    last: int
    level: float


def find_legs(phi: Floats, s: Floats, tolerance: float, noise: float) -> tuple[list[Leg], float]:
    lift = float(np.ptp(s))
    if not lift > DEPTH * tolerance:
        limit = f"more than {DEPTH * tolerance:g}, {DEPTH:g} times the tolerance"
        remedy = "give the table of a motion, or a smaller tolerance"
        raise DesignError("the table's lift", f"{lift:.4g}", limit, remedy)
    n = s.size
    # Three turns of rows, so that nothing begins or ends within the middle one.
    around, rows = np.concatenate([phi - FULL_TURN, phi, phi + FULL_TURN]), np.tile(s, 3)
    turnings = [k + n for k in _turnings(s, DEPTH * tolerance)]
    flats = [_flat(rows, k, noise) for k in turnings]
    flats = _with_rests_between(around, rows, flats, n, noise, DEPTH * tolerance)
    gap = FULL_TURN / n
    stops = []
    worst = 0.0
    m = len(flats)
    for k, here in enumerate(flats):
        before, after = flats[k - 1], flats[(k + 1) % m]
        lo = before.last - (n if k == 0 else 0)
        hi = after.first + (n if k == m - 1 else 0)
        lifts = before.level - here.level, after.level - here.level
        first, last = _window(rows, here, (lo, hi), lifts, noise)
        centre = (around[here.first] + around[here.last]) / 2
        x, y = around[first : last + 1] - centre, rows[first : last + 1] - here.level
        directions = tuple(int(np.sign(l)) for l in lifts)
        reach = centre - around[here.first - 1], around[here.last + 1] - centre
        stop = find_stop(x, y, directions, reach, noise, gap)
        worst = max(worst, stop.misfit)
        turns = directions[0] == directions[1]
        if turns or stop.end > stop.start:
            wide = [gap / 2 * (p == 2) * (stop.end > stop.start) for p in stop.powers]
            stops.append((centre + stop.start + wide[0], centre + stop.end - wide[1], here.level, stop))
    legs = []
    for k, (a, b) in enumerate(zip(stops, [*stops[1:], stops[0]], strict=True)):
        later = FULL_TURN if k == len(stops) - 1 else 0.0
        legs.append(Leg(a[1], b[0] + later, int(np.sign(b[2] - a[2])), a[1] > a[0], b[1] > b[0]))
    return legs, worst


def _turnings(s: Floats, depth: float) -> list[int]:
    """The rows of extremes between which the displacement swings by more than depth, in order, from the lowest on."""
    lowest = int(np.argmin(s))
    values = np.roll(s, -lowest).tolist()
    found, best, direction = [0], 0, 1
    for k, value in enumerate([*values, values[0]]):
        if direction * (value - values[best % len(values)]) > 0:
            best = k
        elif direction * (values[best % len(values)] - value) > depth:
            found.append(best)
            best, direction = k, -direction
    return [lowest + k for k in dict.fromkeys(found) if k < len(values)]


def _flat(rows: Floats, k: int, noise: float) -> _Flat:
    """The rows about an extreme that keep to its level as far as noise can tell."""
    first, last = _run(rows, k, rows[k], 2 * OFF * noise)
    quarter = (last - first) // 4
    level = float(np.median(rows[first + quarter : last + 1 - quarter]))
    middle = (first + last) // 2
    if abs(rows[middle] - level) > OFF * noise:
        return _Flat(k, k, float(rows[k]))
    first, last = _run(rows, middle, level, OFF * noise)
    return _Flat(first, last, level)


def _run(rows: Floats, k: int, level: float, off: float) -> tuple[int, int]:
    outside = np.abs(rows - level) > off
    after, before = outside[k:], outside[k::-1]
    return k - (int(np.argmax(before)) - 1), k + int(np.argmax(after)) - 1


def _with_rests_between(around, rows, flats, n, noise, depth):
    found = list(flats)
    m = len(flats)
    for k, a in enumerate(flats):
        b = flats[(k + 1) % m]
        later = n if k == m - 1 else 0
        first, last, top = a.last + 1, b.first + later - 1, b.level
        if last - first < 2 * FEWEST:
            continue
        direction = np.sign(top - a.level)
        here = direction * rows[first : last + 1]
        x = around[first : last + 1]
        slope = (here[-1] - here[0]) / (x[-1] - x[0])
        # From each row on, how long the rows stay within what noise spreads.
        ahead = np.maximum.accumulate(here)
        ends = np.searchsorted(ahead, here + SPREAD * noise, side="right") - 1
        length = x[ends] - x
        usual = SPREAD * noise / slope
        while True:
            i = int(np.argmax(length))
            j = int(ends[i])
            if j - i < FEWEST or length[i] < SLOW * usual or length[i] <= 0:
                break
            level = float(np.median(here[i : j + 1]))
            if level - here[0] > depth and here[-1] - level > depth:
                inner = np.flatnonzero(np.abs(here[i : j + 1] - level) <= OFF * noise)
                found.append(_Flat(first + i + int(inner[0]), first + i + int(inner[-1]), direction * level))
            near = (np.arange(here.size) <= j) & (ends >= i)
            length[near] = 0.0
    found = [f if f.first < 2 * n else _Flat(f.first - n, f.last - n, f.level) for f in found]
    return sorted(found, key=lambda f: f.first)


def _window(rows, here, limits, lifts, noise):
    ends = []
    for k, (lift, limit) in enumerate(zip(lifts, limits, strict=True)):
        edge = (here.first, here.last)[k]
        step = (-1, 1)[k]
        off = min(SEEN * noise, PART * abs(lift))
        j = edge + step
        while j != limit and abs(rows[j] - here.level) <= off:
            j += step
        far = edge + step * FEWEST
        j = min(j, far) if k == 0 else max(j, far)
        j = max(j, limit) if k == 0 else min(j, limit)
        ends.append(j)
    return ends

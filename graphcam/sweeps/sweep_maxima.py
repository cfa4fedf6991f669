"""The greatest value of a quantity over the rises, or the returns, of many cams, which follow one law each.

A table of the law serves all of them.  A return is a rise seen backwards: with w the distance from the low end, as a
fraction of the phase, both have s = h f(w), of a return with f of the law reversed, and its odd derivatives change
their sign.

First the quantity is looked at in fixed places; then every place that is higher than its neighbours, and could belong
to the greatest value, is refined by secants on the quantity's slope, within the bracket of its neighbours, halved
where a secant leaves it.  Every operation is done to each cam by itself: what the others are, and how many there are,
changes no bit.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import count, pairwise
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from graphcam.given.laws import Floats
from graphcam.given.motion_law import Law
from graphcam.mechanism.kinematics import Kinematics, Values

PHASE_PLACES = 16
"""Places on a whole phase between which a quantity is taken to have one extreme at most."""
MIN_PIECE_PLACES = 4
"""Places on a smooth piece of it, however short."""
END_RATIO = 1 / 256
"""The ratio at which the places follow nearer the phase's ends, for small prime radii move the extremes there."""
MIN_END_DISTANCE = 1e-12
"""The minimum distance of a place from the phase's ends."""
BLOCK_PLACES = 16_384
"""Places that are looked at together: their arrays stay in the cache, and bound the memory."""
CONVERGED_STEP = 1e-8
"""A step of so small a part of the bracket changes the greatest value by no more than its rounding."""
FREE_STEPS = 6
"""The number of steps after which every other one halves the bracket."""
Numbers = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class LawTable:
    """A law at fixed places; where its acceleration or jerk jumps there are two places, one for either side.

    w : (m,) fractions of the phase;  values : (4, m) f, f', f'', f'''
    first, last : (m,) the first and last place on the same smooth piece
    """

    w: Floats
    values: Floats
    first: NDArray[np.intp]
    last: NDArray[np.intp]

    @cached_property
    def seams(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The first place of each smooth piece, and the last one."""
        return np.unique(self.first), np.unique(self.last)

    @cached_property
    def inner(self) -> NDArray[np.intp]:
        """(m,) the nearest place that has a neighbour on either side."""
        return np.clip(np.arange(self.w.size), self.first + 1, self.last - 1)


@lru_cache(maxsize=64)
def law_table(law: Law) -> LawTable:
    """The table of a law.

    >>> import graphcam as gc
    >>> table = law_table(gc.law("rectangular"))
    >>> first, last = table.seams
    >>> table.w[first].tolist(), table.w[last].tolist(), table.values[2, first].tolist()
    ([0.0, 0.5], [0.5, 1.0], [4.0, -4.0])
    """
    pieces = [_places(*ends) for ends in pairwise((0.0, *law.breaks, 1.0))]
    values = np.hstack([np.array(law(w)) for w in pieces])
    ends = np.cumsum([len(w) for w in pieces])
    starts = np.concatenate([[0], ends[:-1]])
    values[:, ends - 1] = np.array(law(np.array([w[-1] for w in pieces]), side="left"))
    sizes = np.diff(ends, prepend=0)
    return LawTable(np.concatenate(pieces), values, np.repeat(starts, sizes), np.repeat(ends - 1, sizes))


def _places(begin: float, end: float) -> Floats:
    n = max(MIN_PIECE_PLACES, round(PHASE_PLACES * (end - begin)))
    share = np.sin(np.linspace(0, np.pi / 2, n + 2)[1:-1]) ** 2
    near = share[0] * END_RATIO ** np.arange(1, np.log(MIN_END_DISTANCE / share[0]) / np.log(END_RATIO))[::-1]
    share = np.concatenate([near if begin == 0 else [], share, 1 - near[::-1] if end == 1 else []])
    return np.concatenate([[begin], begin + (end - begin) * share, [end]])


@dataclass(frozen=True, eq=False)
class Legs:
    """Rises (direction +1) or returns (-1) by one law.

    lift : (n,) mm;  angle : (n,) rad
    """

    law: Law
    direction: int
    lift: Floats
    angle: Floats

    def part(self, which: NDArray[np.intp] | slice) -> Legs:
        """The legs of some of the cams."""
        return Legs(self.law, self.direction, self.lift[which], self.angle[which])

    def at(self, w: Floats) -> Values:
        """(s, v, a, j), one place w for each cam."""
        return self.values(self.law(w))

    def values(self, f: Floats | Sequence[Floats]) -> Values:
        """(s, v, a, j) from f, f', f'', f''', (4, n), or (4, m, 1) for m places on every cam.

        Without f''', whose cost counts where the places are many, j is NaN.
        """
        rate = self.direction / self.angle
        first = self.lift * rate
        second = first * rate
        j = second * rate * f[3] if len(f) > 3 else np.asarray(np.nan)
        return self.lift * f[0], first * f[1], second * f[2], j


@dataclass(frozen=True, eq=False)
class SoughtQuantity(ABC):
    """A quantity of many cams whose greatest value is sought, or with ``signed`` the one of greatest magnitude."""

    kin: Kinematics
    signed: ClassVar[bool] = False
    """Whether a negative value counts as much as a positive one."""

    def part(self, which: Numbers | slice) -> Self:
        """The quantity of some of the cams."""
        return type(self)(self.kin.part(which))

    @abstractmethod
    def reading(self, values: Values) -> Floats:
        """The quantity, from (s, v, a, j)."""

    @abstractmethod
    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """The quantity, and what has the sign of its derivative by phi."""


@dataclass(frozen=True, eq=False)
class _Summits:
    """Places higher than their neighbours: cam, place of the table, and a guess where between these the summit is."""

    cam: Numbers
    place: Numbers
    guess: Floats


def leg_maxima(sought: SoughtQuantity, legs: Legs) -> Floats:
    """(n,) the greatest reading over each cam's rise or return; NaN for what is no cam."""
    table, n = law_table(legs.law), legs.lift.size
    step = max(1, BLOCK_PLACES // table.w.size)
    out = np.full(n, np.nan)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        found = [_peaks(sought, legs, table, slice(k, min(k + step, n))) for k in range(0, n, step)]
        summits = _summits(table, *(np.concatenate(parts, axis=-1) for parts in zip(*found, strict=True)))
        readings = _refined(sought.part(summits.cam), legs.part(summits.cam), table, summits)
        heights, top = _heights(sought, readings), np.full(n, -np.inf)
        np.maximum.at(top, summits.cam, heights)
        highest = np.flatnonzero(heights == top[summits.cam])[::-1]  # of equal ones the first is written last
        out[summits.cam[highest]] = readings[highest]
    return out


def _heights(sought: SoughtQuantity, readings: Floats) -> Floats:
    return np.abs(readings) if sought.signed else readings


def _peaks(sought: SoughtQuantity, legs: Legs, table: LawTable, here: slice) -> tuple[Numbers, Numbers, Floats]:
    """The places of the table that are higher than their neighbours: cams, places, and heights.

    heights : (5, p) of the place itself, of it and its neighbours (at an end of a piece the three nearest it), and of
        the cam's highest place
    """
    values = legs.part(here).values(table.values[:3, :, None])
    height = _heights(sought, sought.part(here).reading(values))
    first, last = table.seams
    rising = np.ones((height.shape[0] + 1, height.shape[1]), dtype=bool)
    np.greater(height[1:], height[:-1], out=rising[1:-1])
    rising[-1] = False
    peak = rising[:-1] & ~rising[1:]
    # Between pieces there are no neighbours.
    peak[first], peak[last] = ~rising[first + 1], rising[last]
    place, cam = np.divmod(np.flatnonzero(peak), height.shape[1])
    middle = table.inner[place]
    top = height.max(axis=0)
    heights = [height[place, cam], height[middle - 1, cam], height[middle, cam], height[middle + 1, cam], top[cam]]
    return cam + here.start, place, np.array(heights)


def _summits(table: LawTable, cam: Numbers, place: Numbers, heights: Floats) -> _Summits:
    """The peaks that may belong to the greatest value."""
    own, left, centre, right, top = heights
    # A summit stands out from the places about it by no more than these differ.
    spread = np.maximum(np.maximum(left, centre), right) - np.minimum(np.minimum(left, centre), right)
    may = own + spread >= top
    w, place = table.w, place[may]
    middle = table.inner[place]
    # The parabola through three neighbours has its vertex there.
    before, after = w[middle] - w[middle - 1], w[middle + 1] - w[middle]
    fall, rise = (left[may] - centre[may]) / before, (right[may] - centre[may]) / after
    return _Summits(cam[may], place, w[middle] + (rise * before - fall * after) / (2 * -(rise + fall)))


def _refined(sought: SoughtQuantity, legs: Legs, table: LawTable, summits: _Summits) -> Floats:
    """The reading at each summit."""
    place = summits.place
    values = legs.values(table.values[:, place])
    best, slope = _reading_and_slope(sought, legs, values)
    w, low, high = table.w[place], table.w[place - 1], table.w[np.minimum(place + 1, table.w.size - 1)]
    low, high = np.where(place == table.first[place], w, low), np.where(place == table.last[place], w, high)
    close = CONVERGED_STEP * (high - low)
    low, high = np.where(slope > 0, w, low), np.where(slope > 0, high, w)
    state = np.array([_place_or_middle(summits.guess, low, high, close), low, high, w, slope, close])
    active = np.arange(place.size)
    for step in count():
        w, low, high, before, slope_before, close = state
        (going,) = np.nonzero((high - low > close) & (np.abs(w - before) > close) & (slope_before != 0))
        if not going.size:
            break
        active, (w, low, high, before, slope_before, close) = active[going], state.take(going, axis=1)
        some, part = sought.part(active), legs.part(active)
        values = part.at(w)
        reading, slope = _reading_and_slope(some, part, values)
        higher = _heights(sought, reading) > _heights(sought, best[active])
        best[active] = np.where(higher, reading, best[active])
        low, high = np.where(slope > 0, w, low), np.where(slope > 0, high, w)
        secant = w - slope * (w - before) / (slope - slope_before)
        halved = step > FREE_STEPS and step % 2
        state = np.array([_place_or_middle(np.nan if halved else secant, low, high, close), low, high, w, slope, close])
    return best


def _reading_and_slope(sought: SoughtQuantity, legs: Legs, values: Values) -> tuple[Floats, Floats]:
    """The reading, and what is positive where its height grows with w."""
    reading, slope = sought.with_slope(values)
    slope = legs.direction * slope
    return reading, slope * np.sign(reading) if sought.signed else slope


def _place_or_middle(w: Floats | float, low: Floats, high: Floats, close: Floats) -> Floats:
    """The place if it lies between the two, else the one halfway.

    At an end it is drawn off a little: what is found there closes the bracket.
    """
    near = close / 2
    return np.where((w >= low) & (w <= high), np.clip(w, low + near, high - near), (low + high) / 2)

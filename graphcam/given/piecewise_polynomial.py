"""Functions that are polynomials piece by piece, with their derivatives, integral and turnings.

Motions by conditions, measured and sampled ones and laws that are polynomials are made of them.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, MutableSequence, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from graphcam.given.b_splines import basis_functions
from graphcam.given.extreme_search import Indices, SmoothPieces
from graphcam.given.piecewise import Floats, Side
from graphcam.given.reproducible_sums import ordered_sum, powers

ORDER_COUNT = 4
"""s, v, a, j."""
MIN_SEARCHED_CELLS = 128
"""The number of cells from which a search is quicker than a comparison with every start."""
FEW_VALUES = 128
"""The average number of values a cell below which they are gathered; more are sliced."""
SAME_PLACE = 1e-9
"""Places nearer to one another than this are the same."""
SAME_LEVEL = 1e-15
"""What rises or falls by less than this part of the greatest value is at rest."""
NEWTON_STEPS = 2


def taylor_shift(coefficients: MutableSequence[Any] | Floats, by: Any) -> None:
    """Make of the coefficients of a polynomial about 0, the lowest first, those about ``by``; of numbers or of rows.

    >>> square = [0, 0, 1]
    >>> taylor_shift(square, 3)
    >>> square
    [9, 6, 1]
    """
    for first in range(len(coefficients) - 1):
        for k in range(len(coefficients) - 2, first - 1, -1):
            coefficients[k] += by * coefficients[k + 1]


@dataclass(frozen=True, eq=False)
class PiecewisePolynomial:
    """A function and its first three derivatives, by a series in each of its cells; those at the ends go on beyond.

    ends : (n + 1,) where cells begin, and where the last one ends
    anchors, coefficients : (n,) and (m, n) of the series in powers of t - anchor, the lowest first
    breaks : inner places where a derivative may jump; at the other ends of cells none does

    >>> square = PiecewisePolynomial.of([0.0, 0.0, 1.0], 0.0, 1.0)
    >>> [row.tolist() for row in square(np.array([0.5, 1.0]))]
    [[0.25, 1.0], [1.0, 2.0], [2.0, 2.0], [0.0, 0.0]]
    """

    ends: Floats
    anchors: Floats
    coefficients: Floats
    breaks: Floats

    @classmethod
    def of(cls, coefficients: Sequence[float], start: float, end: float) -> PiecewisePolynomial:
        """One polynomial of t - start."""
        return cls(
            np.array([start, end]), np.array([start]), np.array([coefficients], dtype=np.float64).T, np.array([])
        )

    @classmethod
    def of_spline(cls, knots: Floats, coefficients: Floats, degree: int) -> PiecewisePolynomial:
        """A spline by its knots (m + degree + 1,) and its coefficients (m,).

        >>> line = PiecewisePolynomial.of_spline(np.arange(5.0), np.array([0.0, 2.0, 4.0]), 1)
        >>> line(1.5)[0].item(), line([1.5, 2.5])[1].tolist()
        (1.0, [2.0, 2.0])
        """
        ends = np.unique(knots[degree : knots.size - degree])
        middles, rows = (ends[:-1] + ends[1:]) / 2, list[Floats]()  # derivatives may jump at knots
        for order in range(degree + 1):
            p = degree - order
            numbers, values = basis_functions(knots, p, middles)
            rows.append(ordered_sum(values * coefficients[numbers]) / math.factorial(order))
            if p:
                widths, rises = knots[p + 1 : -1] - knots[1 : -p - 1], p * np.diff(coefficients)
                # Where knots coincide there is a coefficient that no interval sees.
                coefficients = np.divide(rises, widths, out=np.zeros_like(rises), where=widths > 0)
                knots = knots[1:-1]
        return cls(ends, middles, np.array(rows), ends[1:-1])

    @classmethod
    def joined(cls, parts: Sequence[PiecewisePolynomial]) -> PiecewisePolynomial:
        """Parts one behind the other; the end of each is the beginning of the next."""
        most = max(len(part.coefficients) for part in parts)
        padded = [np.pad(part.coefficients, ((0, most - len(part.coefficients)), (0, 0))) for part in parts]
        return cls(
            np.concatenate([*(part.ends[:-1] for part in parts), parts[-1].ends[-1:]]),
            np.concatenate([part.anchors for part in parts]),
            np.concatenate(padded, axis=1),
            np.concatenate([parts[0].breaks, *(part for each in parts[1:] for part in (each.ends[:1], each.breaks))]),
        )

    # --- values ---------------------------------------------------------------------------------------------------

    def __call__(self, t: ArrayLike, side: Side = "right") -> Floats:
        """(4, ...) the function and its derivatives at t of any shape; where cells meet, those of the named side."""
        if isinstance(t, float):
            return np.array(self._at_number(t, side))
        t = np.asarray(t, dtype=np.float64)
        out = np.empty((ORDER_COUNT, t.size))
        self.fill(t.ravel(), side, out)
        return out.reshape(ORDER_COUNT, *t.shape)

    def fill(self, t: Floats, side: Side, out: Floats) -> None:
        """Write the values at t, (n,), into ``out``, (4, n); NaN stays NaN.

        At a place where cells meet the value of the named side is written.
        """
        if t.size == 1:
            out[:, 0] = self._at_number(float(t[0]), side)
            return
        if t.size >= FEW_VALUES * self.anchors.size:
            if np.all(t[1:] >= t[:-1]):
                self._slice(t, side, out)
                return
            if np.all(t[1:] <= t[:-1]):
                forwards = np.empty(out.shape)
                self._slice(t[::-1].copy(), side, forwards)
                out[:] = forwards[:, ::-1]
                return
        self._gather(self._numbers(t, side), t, out)

    @cached_property
    def _series(self) -> list[tuple[float, list[float]]]:
        """The anchor and the coefficients of every cell, the highest first, without those that are zero."""
        columns = self.coefficients[::-1].T.tolist()
        leading = np.argmax(self.coefficients[::-1] != 0, axis=0).tolist()
        return [(anchor, c[first:]) for anchor, c, first in zip(self.anchors.tolist(), columns, leading, strict=True)]

    def _at_number(self, t: float, side: Side) -> tuple[float, float, float, float]:
        """The values at one place, much faster than from an array of one."""
        find = bisect_right if side == "right" else bisect_left
        anchor, series = self._series[find(self._inner_ends, t)]
        x, (s, v, a, j) = t - anchor, [0.0] * ORDER_COUNT
        for coefficient in series:
            j = j * x + a
            a = a * x + v
            v = v * x + s
            s = s * x + coefficient
        return s, v, 2 * a, 6 * j

    @cached_property
    def _inner_ends(self) -> list[float]:
        return self.ends[1:-1].tolist()

    def _numbers(self, t: Floats, side: Side) -> Indices:
        """The cells that t lie in; where cells are few and t many it is quicker to compare than to search."""
        starts = self.ends[1:-1]
        if starts.size >= MIN_SEARCHED_CELLS or t.size < MIN_SEARCHED_CELLS * starts.size:
            return starts.searchsorted(t, side=side)
        number, compare = np.zeros(t.shape, dtype=np.uint8), np.greater_equal if side == "right" else np.greater
        for start in starts.tolist():
            number += compare(t, start).view(np.uint8)
        return number.astype(np.intp)

    def _slice(self, t: Floats, side: Side, out: Floats) -> None:
        """Write the values at t, which lie in the order of the cells."""
        cuts = np.searchsorted(t, self.ends[1:-1], side="left" if side == "right" else "right").tolist()
        for (anchor, series), (first, last) in zip(self._series, pairwise([0, *cuts, t.size]), strict=True):
            if first < last:
                _evaluate(t[first:last] - anchor, series, out[:, first:last])

    def _gather(self, number: Indices, t: Floats, out: Floats) -> None:
        """Write the values at t in the cells of those numbers."""
        x = t - self.anchors.take(number, mode="clip")
        _evaluate(x, (row.take(number, mode="clip") for row in self.coefficients[::-1]), out)
        if np.isnan(np.min(t, initial=0.0)):
            out[:, np.isnan(t)] = np.nan  # even where a constant took its place

    # --- others made of it -------------------------------------------------------------------------------------------

    def integral(self, level: float = 0.0) -> PiecewisePolynomial:
        """The integral from the first cell's beginning on, there ``level``.

        >>> line = PiecewisePolynomial.of([0.0, 2.0], 0.0, 1.0)
        >>> line.integral(5.0)([0.0, 1.0])[0].tolist()
        [5.0, 6.0]
        """
        c = np.vstack(
            [np.zeros(self.anchors.size), self.coefficients / np.arange(1, len(self.coefficients) + 1)[:, None]]
        )
        low, high = (ordered_sum((c * powers(x - self.anchors, len(c) - 1)).T) for x in (self.ends[:-1], self.ends[1:]))
        c[0] = level + np.append(0.0, np.cumsum(high - low)[:-1]) - low
        return replace(self, coefficients=c)

    def between(self, low: float, high: float) -> PiecewisePolynomial:
        """The cells, or their parts, from one place to another."""
        low, high = (self._snapped(place) for place in (low, high))
        kept = (self.ends[1:] > low) & (self.ends[:-1] < high)
        ends = np.concatenate([[low], self.ends[:-1][kept][1:], [high]])
        inner = (self.breaks > low) & (self.breaks < high)
        return PiecewisePolynomial(ends, self.anchors[kept], self.coefficients[:, kept], self.breaks[inner])

    def _snapped(self, place: float) -> float:
        """An end of a cell, if the place is the same."""
        end = float(self.ends[np.argmin(np.abs(self.ends - place))])
        return end if abs(end - place) <= SAME_PLACE else place

    def seen(self, origin: float, length: float = 1.0, base: float = 0.0, height: float = 1.0) -> PiecewisePolynomial:
        """(f - base)/height as a function of (t - origin)/length; a negative length looks back.

        >>> square = PiecewisePolynomial.of([0.0, 0.0, 1.0], 0.0, 1.0)
        >>> square.seen(2.0, -2.0, 4.0, -4.0)([0.5, 1.0])[0].tolist()
        [0.75, 1.0]
        """
        way = slice(None, None, -1 if length < 0 else 1)
        c = self.coefficients * (powers(length, len(self.coefficients) - 1) / height)[:, None]
        c[0] = (self.coefficients[0] - base) / height
        places = [((x - origin) / length)[way] for x in (self.ends, self.anchors, self.breaks)]
        return PiecewisePolynomial(places[0], places[1], c[:, way], places[2])

    def at_rest(self, place: float, zeros: int = 2) -> PiecewisePolynomial:
        """The same by series about a place of rest or of turning, whose terms from v on are 0 before number ``zeros``.

        A series about another place leaves nothing of the digits of the little that it moves beside this one.
        """
        found, place = self, self._snapped(place)
        for way in (-1, 1):
            cell = int(found.ends.searchsorted(place, "left" if way < 0 else "right")) - 1
            if not 0 <= cell < found.anchors.size or found.anchors[cell] == place:
                continue
            low, high = found.ends[cell : cell + 2].tolist()
            anchor = float(found.anchors[cell])
            # No further than the terms of the series reached: there they hardly cancel.
            reach = max(high - anchor, anchor - low)
            near = [max(low, place - reach), place] if way < 0 else [place, min(high, place + reach)]
            c = found.coefficients[:, cell : cell + 1].copy()
            taylor_shift(c, place - anchor)
            c[1:zeros] = 0.0
            about = PiecewisePolynomial(np.array(near), np.array([place]), c, self.breaks[:0])
            first, last = found.ends[[0, -1]].tolist()
            parts = found.between(first, near[0]), about, found.between(near[1], last)
            found = PiecewisePolynomial.joined([part for part in parts if part.anchors.size])
        return replace(found, breaks=self.breaks)

    def with_breaks(self, places: Floats) -> PiecewisePolynomial:
        """The same with the ends of cells that are the same as these places moved to them, and breaks there."""
        ends = self.ends.copy()
        ends[np.abs(ends - places[:, None]).argmin(axis=1)] = places
        others = np.abs(self.breaks[:, None] - places).min(axis=1, initial=np.inf) > SAME_PLACE
        return replace(self, ends=ends, breaks=np.sort(np.append(places, self.breaks[others])))

    # --- where it turns ----------------------------------------------------------------------------------------------

    def runs(self) -> list[tuple[float, int]]:
        """Where the function begins to rise (+1), to rest (0) and to fall (-1).

        >>> PiecewisePolynomial.of([0.0, 3.0, 0.0, -4.0], -1.0, 0.0).seen(-1.0).runs()
        [(0.0, 1), (0.5, -1)]
        """
        places = self._stationary_places()
        apart = np.abs(places[:, None] - self.ends).min(axis=1) > SAME_PLACE
        cuts = np.sort(np.append(self.ends, places[apart]))
        signs = np.sign(self((cuts[:-1] + cuts[1:]) / 2)[1]).astype(int).tolist()
        found = _merged(list(zip(cuts.tolist(), signs, strict=False)))
        starts = np.array([start for start, _ in found])
        levels, ends = self(starts)[0], np.append(starts[1:], self.ends[-1])
        moved = np.abs(self(ends, "left")[0] - levels)
        still = np.array([not sign for _, sign in found])
        # What moves by less than rounding, or for less than a place is told from another one, is rounding.
        kept = (ends - starts > SAME_PLACE) & (still | (moved > SAME_LEVEL * np.abs(levels).max()))
        return _merged([run for run, keep in zip(found, kept.tolist(), strict=True) if keep])

    def turnings(self) -> list[float]:
        """Where it turns; if it rests there, the end of the rest."""
        moving = [(start, sign) for start, sign in self.runs() if sign]
        return [start for (_, before), (start, sign) in pairwise(moving) if sign != before]

    def _stationary_places(self) -> Floats:
        """Where the first derivative vanishes within cells, but for their anchors."""
        m = len(self.coefficients)
        slopes = self.coefficients[1:] * np.arange(1.0, m)[:, None]
        moving = np.flatnonzero(slopes.any(axis=0))
        if not moving.size:
            return np.array([])
        # Without the powers that vanish at the anchor, where nothing tells rounding from a root.
        first = np.argmax(slopes != 0, axis=0)
        rows = np.arange(m - 1)[:, None] + first
        slopes = np.where(rows < m - 1, np.take_along_axis(slopes, np.minimum(rows, m - 2), 0), 0.0)
        reach = np.maximum(self.ends[1:] - self.anchors, self.anchors - self.ends[:-1])
        slopes = slopes / np.abs(slopes * powers(reach, m - 2)).sum(axis=0).clip(np.finfo(float).tiny)

        def slope(piece: Indices, x: Floats) -> Floats:
            cell = moving[piece]
            y, value = x - self.anchors[cell], 0.0
            for row in slopes[::-1]:
                value = value * y + row[cell]
            return np.asarray(value)

        cell, x = SmoothPieces(self.ends[:-1][moving], self.ends[1:][moving]).zeros(slope)
        for _ in range(NEWTON_STEPS):
            v, a = self(x)[1:3]
            step = np.divide(v, a, out=np.zeros_like(v), where=a != 0)
            x = np.clip(x - step, self.ends[moving[cell]], self.ends[moving[cell] + 1])
        return x


def _merged(runs: Sequence[tuple[float, int]]) -> list[tuple[float, int]]:
    """The runs without those that only go on."""
    return [run for before, run in zip([None, *(sign for _, sign in runs)], runs, strict=False) if before != run[1]]


def _evaluate(x: Floats, coefficients: Iterable[float | Floats], out: Floats) -> None:
    """Write a polynomial and its derivatives at x, (n,), into ``out``, (4, n).

    coefficients : the highest first

    By Horner's scheme, each row one of the row before.
    """
    made = 0
    for coefficient in coefficients:
        if made:
            if made < ORDER_COUNT:
                out[made] = out[made - 1]
            for order in range(min(made, ORDER_COUNT) - 1, 0, -1):
                out[order] *= x
                out[order] += out[order - 1]
            out[0] *= x
            out[0] += coefficient
        else:
            out[0] = coefficient
        made += 1
    out[made:] = 0.0
    out[2] *= 2
    out[3] *= 6

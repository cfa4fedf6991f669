"""Where smooth quantities are stationary, or vanish, on many pieces at once, such that none is missed between samples.

On every piece a quantity is interpolated at Chebyshev's places.  Where its coefficients have not decayed to nothing the
piece is divided, and so on: what oscillates between the places of one look, or bends sharply near an end, is followed
with as many parts as it needs.  Of the interpolant all roots are isolated: a polynomial sum c_k T_k has none on [-1, 1]
if |c_0| exceeds the sum of the other |c_k|, and one at most if |c_1| exceeds that of the k^2 |c_k| behind it, which
bound its slope; what is neither is halved.

Source: L. N. Trefethen, *Approximation Theory and Approximation Practice* (2013), chapters 3, 4, 8 and 18.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from graphcam.given.piecewise import Floats

Indices = NDArray[np.intp]
Quantity = Callable[[Indices, Floats], Floats]
"""Values at places, of the pieces with these numbers: (n, 1) numbers and (n, m) places, or (n,) of both."""
Height = Callable[[Floats], Floats]

DEGREE = 16
PARTS = 4
"""What is not resolved is divided into so many parts."""
RESOLVED = 1e-12
"""The last coefficients of a resolved quantity, as a part of its greatest value."""
NOISE = 1e-8
"""What is left of this part, and is not lessened by a division, is rounding: no division would."""
LESSENED, PLAIN_TAIL = 0.5, 4.0
"""A division lessens what is no rounding to less than this part of it; rounding is off at the ends by no more than so
many times the last coefficients."""
FLAT = 2e-14
"""A quantity that differs by no more than this part of its greatest value over a cell is told by its middle."""
NEARLY_STATIONARY = 1e-8
"""An end of a cell counts as stationary if the slope there is this part of the greatest value over half the cell."""
NARROWEST = 2.0**-40
"""A part of a piece that is not divided further."""
MAX_CELLS = 30_000
TAIL = 3
"""The number of coefficients that tell whether a quantity is resolved."""
MAX_HALVINGS, NEWTON_STEPS = 40, 6
SEAM = 1e-6
"""Roots so little outside of a cell, as a part of its half width, are its own: some at a seam would be nobody's."""
LINEAR = 4.0
"""A slope so many times as great as all that it can change by: there Newton's steps cannot miss the root."""

_NUMBERS = np.arange(DEGREE + 1)
_INNER = np.cos(np.pi * (_NUMBERS + 0.5) / (DEGREE + 1))
NODES = np.array([*_INNER, 1 - 1e-12, -1 + 1e-12])
"""Chebyshev's places, and the ends, where what is narrow beside one shows that the quantity is not resolved."""
_TO_COEFFICIENTS = 2 / (DEGREE + 1) * chebyshev.chebvander(_INNER, DEGREE)
_TO_COEFFICIENTS[:, 0] /= 2
_AT_ENDS = chebyshev.chebvander(NODES[-2:], DEGREE).T
_DERIVATIVE = np.pad(chebyshev.chebder(np.eye(DEGREE + 1)).T, ((0, 0), (0, 1)))
_HALVES = [chebyshev.chebvander((_INNER + side) / 2, DEGREE).T @ _TO_COEFFICIENTS for side in (-1, 1)]
_SIGNS = (-1.0) ** _NUMBERS


class _Cells(NamedTuple):
    """Parts of pieces: (n,) number of the piece, and where each begins and ends."""

    piece: Indices
    low: Floats
    high: Floats

    def selected(self, chosen: NDArray[np.bool_] | Indices) -> _Cells:
        return _Cells(self.piece[chosen], self.low[chosen], self.high[chosen])

    def divided(self) -> _Cells:
        ends = self.low[:, None] + (self.high - self.low)[:, None] * (np.arange(PARTS + 1) / PARTS)
        ends[:, -1] = self.high
        return _Cells(np.repeat(self.piece, PARTS), ends[:, :-1].ravel(), ends[:, 1:].ravel())

    def at(self, t: Floats) -> Floats:
        """The places at t in [-1, 1] of the cells."""
        within = np.nextafter(self.high, self.low)  # what begins at the end may be another formula
        return np.clip((self.low + self.high) / 2 + (self.high - self.low) / 2 * t, self.low, within)


@dataclass(frozen=True, eq=False)
class SmoothPieces:
    """Pieces on each of which quantities are smooth.

    low, high : (p,) where each begins and ends
    """

    low: Floats
    high: Floats

    @cached_property
    def nodes(self) -> Floats:
        """(p, k) the places on whole pieces at which a quantity is asked for first."""
        return _Cells(np.arange(self.low.size), self.low[:, None], self.high[:, None]).at(NODES)

    def stationary(
        self, quantity: Quantity, group: Indices | None = None, top: Floats | None = None, height: Height = np.positive
    ) -> tuple[Indices, Floats]:
        """Pieces and places, inside, where a quantity is stationary, in no order; some that are not may be among them.

        group : (p,) numbers from 0: pieces of which the quantity has its own size; by default all are one group
        top : for each group a height that is reached elsewhere: only places that may be higher are sought
        height : ``np.abs`` if a negative value counts as much as a positive one

        >>> pieces = SmoothPieces(np.array([0.0]), np.array([3.0]))
        >>> waves = pieces.stationary(lambda _, x: np.sin(40 * np.pi * x))[1]
        >>> np.unique(waves.round(9)).size, bool(np.abs(np.cos(40 * np.pi * waves)).max() < 1e-9)
        (120, True)
        """
        group = np.zeros(self.low.size, dtype=np.intp) if group is None else group
        reached = None if top is None else top.copy()
        cells, coefficients, scale, ragged = self._resolved(quantity, group, reached, height)
        spread = np.abs(coefficients[:, 1:]).sum(axis=1)
        flat = spread <= FLAT * scale
        may = np.ones(flat.shape, dtype=bool)
        if reached is not None:
            may = _may_reach(height(coefficients[:, 0]) + spread, reached[group[cells.piece]])
        flat, sloped = may & flat, may & ~flat
        slopes, curved = coefficients[sloped] @ _DERIVATIVE, cells.selected(sloped)
        which, t = _roots(slopes)
        found = [(curved.piece[which], curved.selected(which).at(t))]
        even = cells.selected(flat)
        found.append((even.piece, even.at(np.zeros(1))))
        # Where a slope is small all about the seam of two cells, a root there may fall to neither.
        just = NEARLY_STATIONARY * scale[sloped]
        for place, end in ((curved.low, slopes @ _SIGNS), (curved.high, slopes.sum(axis=1))):
            near = np.abs(end) <= just
            found.append((curved.piece[near], place[near]))
        found += [(ragged.piece, ragged.low), (ragged.piece, ragged.high)]
        piece, x = (np.concatenate(parts) for parts in zip(*found, strict=True))
        return piece, x

    def zeros(self, quantity: Quantity) -> tuple[Indices, Floats]:
        """Pieces and places, inside, where a quantity vanishes.

        >>> pieces = SmoothPieces(np.array([0.0, 2.0]), np.array([2.0, 4.0]))
        >>> piece, x = pieces.zeros(lambda piece, x: np.cos(x))
        >>> piece.tolist(), x.round(9).tolist()
        ([0], [1.570796327])
        """
        cells, coefficients, _, ragged = self._resolved(quantity, np.zeros(self.low.size, dtype=np.intp))
        which, t = _roots(coefficients)
        piece, x = cells.piece[which], cells.selected(which).at(t)
        return np.concatenate([piece, ragged.piece]), np.concatenate([x, ragged.low])

    def _resolved(
        self, quantity: Quantity, groups: Indices, top: Floats | None = None, height: Height = np.positive
    ) -> tuple[_Cells, Floats, Floats, _Cells]:
        """Cells with (n, k) coefficients of the quantity on them, its scale there, and cells in which it is not smooth.

        top : raised to the greatest height that is met; what stays below is left out
        """
        cells, nodes = _Cells(np.arange(self.low.size), self.low, self.high), self.nodes
        scales, left_before = np.zeros(groups.max() + 1), np.full(self.low.size, np.inf)
        narrowest = NARROWEST * (self.high - self.low)
        found: list[tuple[_Cells, Floats]] = []
        ragged: list[_Cells] = []
        while True:
            group, values = groups[cells.piece], quantity(cells.piece[:, None], nodes)
            size = np.abs(values)
            if not np.isfinite(size.sum()):
                values = np.where(np.isfinite(values), values, np.nan)
                size = np.abs(values)
            magnitude = np.fmax.reduce(size, axis=1)
            np.fmax.at(scales, group, magnitude)
            coefficients = values[:, :-2] @ _TO_COEFFICIENTS
            terms = np.abs(coefficients)
            off = np.abs(coefficients @ _AT_ENDS - values[:, -2:]).max(axis=1) / DEGREE
            tail, scale = terms[:, -TAIL:].max(axis=1), scales[group]
            left = np.maximum(tail, off)
            rounding = (left <= NOISE * scale) & (left >= LESSENED * left_before) & (off <= PLAIN_TAIL * tail)
            done = (left <= RESOLVED * scale) | rounding
            going = ~(done | np.isnan(magnitude))
            if top is not None:
                np.fmax.at(top, group, np.fmax.reduce(height(values), axis=1))
                going &= _may_reach(height(coefficients[:, 0]) + 2 * terms[:, 1:].sum(axis=1), top[group])
            found.append((cells.selected(done), coefficients[done]))
            cells, left_before = cells.selected(going), left[going]
            narrow = (cells.high - cells.low <= narrowest[cells.piece]) | (cells.piece.size > MAX_CELLS)
            ragged.append(cells.selected(narrow))
            if narrow.all():
                break
            cells, left_before = cells.selected(~narrow).divided(), np.repeat(left_before[~narrow], PARTS)
            nodes = _Cells(cells.piece, cells.low[:, None], cells.high[:, None]).at(NODES)
        parts, coefficients = zip(*found, strict=True)
        smooth = _joined(parts)
        return smooth, np.concatenate(coefficients), scales[groups[smooth.piece]], _joined(ragged)


def _joined(parts: tuple[_Cells, ...] | list[_Cells]) -> _Cells:
    return _Cells(*(np.concatenate(part) for part in zip(*parts, strict=True)))


def _may_reach(height: Floats, top: Floats) -> NDArray[np.bool_]:
    return ~(height < top - FLAT * np.abs(top))


def _roots(coefficients: Floats) -> tuple[Indices, Floats]:
    """Which polynomials vanish in [-1, 1], and where: one entry for each root."""
    which, middle, half = np.arange(len(coefficients)), np.zeros(len(coefficients)), 1.0
    found: list[tuple[Indices, Floats]] = []
    for _ in range(MAX_HALVINGS):
        terms = np.abs(coefficients[:, 1:])
        may = np.abs(coefficients[:, 0]) <= (1 + SEAM) * terms.sum(axis=1)
        which, middle, coefficients, terms = which[may], middle[may], coefficients[may], terms[may]
        single = terms[:, 0] > LINEAR * (terms[:, 1:] @ _NUMBERS[2:] ** 2)
        t = _single_root(coefficients[single])
        inside = np.abs(t) <= 1 + SEAM
        found.append((which[single][inside], middle[single][inside] + half * t[inside]))
        which, middle, coefficients = which[~single], middle[~single], coefficients[~single]
        if not which.size:
            break
        half /= 2
        which, middle = np.tile(which, 2), np.concatenate([middle - half, middle + half])
        coefficients = np.concatenate([coefficients @ part for part in _HALVES])
    found.append((which, middle))
    numbers, places = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return numbers, places


def _single_root(coefficients: Floats) -> Floats:
    """The one root of each polynomial whose first term outweighs the others; beyond 1 if it has none in [-1, 1]."""
    slopes = coefficients @ _DERIVATIVE[:, :-1]
    t = -coefficients[:, 0] / coefficients[:, 1]
    for _ in range(NEWTON_STEPS if t.size else 0):
        t = np.clip(t, -1, 1)
        terms = np.cos(np.arccos(t)[:, None] * _NUMBERS)
        t = t - (coefficients * terms).sum(axis=1) / (slopes * terms[:, :-1]).sum(axis=1)
    return t

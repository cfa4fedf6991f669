"""Polynomials piece by piece as the machine computes them: to the last digits, whatever their degree, and quickly.

Every exact piece is cut into cells until in each the terms of the series about its middle hardly cancel; where the
motion rests at an end of a piece, the series begins there, so that the little that it has left keeps its digits.  Every
coefficient is rounded once.  A cell keeps the terms that count.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.given.exact_polynomials import Exact, ExactPiece, derivative
from graphcam.given.piecewise import Floats, Side

ORDER_COUNT = 4
"""s, v, a, j."""
MAX_CANCELLATION = 2.0
"""The terms of a series come to so many times the greatest value at most."""
NEGLIGIBLE_TERMS = 2.0**-56
"""Terms that all together are smaller, as a fraction of the greatest value, are left out."""
REST_MOVEMENT = 2.0**-55
"""A piece rests that moves by less than this part of the greatest displacement over its width, at its end's speed."""
LEADING_TERM = 1e-12
"""The first term of a series that is no smaller than this part of all terms leads where the motion leaves its rest."""
MAX_HALVINGS = 20
"""How often a piece is halved at most: a cell of a millionth is as good as it gets."""
PIECE_SAMPLES = 33
"""Places of a piece among which the greatest values are looked for."""
MIN_SEARCHED_CELLS = 128
"""The number of cells from which a search is quicker than a comparison with every start."""
FEW_VALUES = 128
"""The average number of values a cell below which they are gathered; more are sliced."""


@dataclass(frozen=True)
class Cell:
    """A series about ``anchor`` in powers of (t - anchor)/scale, from ``start`` on.

    start, anchor : as the machine has them;  scale : a power of two
    coefficients : the lowest first
    """

    start: float
    anchor: float
    scale: float
    coefficients: tuple[float, ...]


def cells(pieces: Sequence[ExactPiece], start: Fraction = Fraction(0), ahead: bool = True) -> list[list[Cell]]:
    """The cells of each piece, as functions of t = place - start; looking back, of t = start - place.

    Looking back the value is what s has more than here, so that a law's missing lift is positive: -s.

    >>> square = ExactPiece(Fraction(0), Fraction(1), (Fraction(0), Fraction(0), Fraction(1)))
    >>> [(cell.start, cell.anchor, cell.scale, cell.coefficients) for cell in cells([square])[0]]
    [(0.0, 0.0, 2.0, (0.0, 0.0, 4.0))]
    """
    greatest = _max_magnitudes(pieces)
    return [_Cutter(piece, greatest, start, 1 if ahead else -1).cells() for piece in pieces]


def _max_magnitudes(pieces: Sequence[ExactPiece]) -> list[float]:
    """The greatest magnitude of s and its derivatives over all pieces."""
    y = np.linspace(0, 1, PIECE_SAMPLES)
    found = [0.0] * ORDER_COUNT
    for piece in pieces:
        width = float(piece.width)
        for order in range(ORDER_COUNT):
            values = np.polynomial.polynomial.polyval(y, np.array([float(c) for c in derivative(piece.p, order)]))
            found[order] = max(found[order], float(np.abs(values).max()) / width**order)
    return found


@dataclass(frozen=True)
class _Cutter:
    """The state of one piece while it is cut."""

    piece: ExactPiece
    greatest: list[float]
    origin: Fraction
    way: int

    def cells(self) -> list[Cell]:
        """The parts of the piece, seen from the origin."""
        low, high = sorted((self._from_origin(self.piece.start), self._from_origin(self.piece.end)))
        return self._cells(low, high, 0)

    def _from_origin(self, place: Fraction) -> Fraction:
        return self.way * (place - self.origin)

    @cached_property
    def _rest_places(self) -> list[Fraction]:
        """Ends of the piece at which the velocity is zero."""
        piece, still = self.piece, Fraction(REST_MOVEMENT * self.greatest[0])
        ends = (piece.start, piece.end) if len(piece.p) > 1 else ()
        return [self._from_origin(end) for end in ends if abs(piece.at(end, 1) * piece.width) <= still]

    def _cells(self, low: Fraction, high: Fraction, depth: int) -> list[Cell]:
        rests = [end for end in (low, high) if end in self._rest_places]
        anchor = float(rests[0] if rests else (low + high) / 2)
        reach = max(abs(low - Fraction(anchor)), abs(high - Fraction(anchor)))
        # At a rest the series begins there, though the machine's place is another one by a rounding.
        about = rests[0] if rests else Fraction(anchor)
        scale = 2.0 ** math.frexp(float(reach))[1]
        p = self.piece.coefficients_about(self.origin + self.way * about, self.way * Fraction(scale))
        p = tuple(self.way * c for c in p)
        if rests:  # a place of rest that is no rational number was rounded
            level = p[0] if abs(p[0]) > Fraction(REST_MOVEMENT * self.greatest[0]) else Fraction(0)
            p = level, Fraction(0), *p[2:]
        part = float(reach) / scale
        needed = [self._needed_terms(p, order, scale, part, bool(rests)) for order in range(ORDER_COUNT)]
        if depth < MAX_HALVINGS and not (len(rests) < 2 and all(fits for _, fits in needed)):
            middle = (low + high) / 2
            return self._cells(low, middle, depth + 1) + self._cells(middle, high, depth + 1)
        terms = max(count for count, _ in needed)
        return [Cell(float(low), anchor, scale, tuple(float(c) for c in p[:terms]))]

    def _needed_terms(self, p: Exact, order: int, scale: float, part: float, rests: bool) -> tuple[int, bool]:
        """How many terms a derivative asks for, and whether they do not cancel within ``part`` of the scale."""
        row = np.array([float(c / Fraction(scale) ** order) for c in derivative(p, order)])
        terms = np.abs(row) * part ** np.arange(row.size)
        varying = np.flatnonzero((terms[1:] if order == 0 else terms) > LEADING_TERM * terms.sum())
        size, fits = self.greatest[order], terms.sum() <= MAX_CANCELLATION * self.greatest[order]
        if rests and order < 2 and varying.size:
            # The first power that varies leads near the rest; the others come to no more.
            lead = int(varying[0]) + (order == 0)
            size = min(size, float(terms[lead]))
            fits = fits and terms[lead + 1 :].sum() <= terms[lead]
        tail = np.append(np.cumsum(terms[::-1])[::-1], 0.0)
        count = int(np.argmax(tail <= NEGLIGIBLE_TERMS * size))
        return (count + order if count else 1), bool(fits)


@dataclass(frozen=True, eq=False)
class LocalPolynomials:
    """A function and its first three derivatives, by a series in each of its cells; those at the ends go on beyond.

    >>> square = ExactPiece(Fraction(0), Fraction(1), (Fraction(0), Fraction(0), Fraction(1)))
    >>> [row.tolist() for row in LocalPolynomials(cells([square])[0])(np.array([0.5, 1.0]))]
    [[0.25, 1.0], [1.0, 2.0], [2.0, 2.0], [0.0, 0.0]]
    """

    cells: Sequence[Cell]

    def __call__(self, t: Floats) -> list[Floats]:
        """The function and its derivatives at t of any shape; where cells meet, those of the one behind."""
        t = np.asarray(t, dtype=np.float64)
        out = np.empty((ORDER_COUNT, t.size))
        self.fill(t.ravel(), "right", out)
        return list(out.reshape(ORDER_COUNT, *t.shape))

    def fill(self, t: Floats, side: Side, out: Floats) -> None:
        """Write the values at t, (n,), into ``out``, (4, n); NaN stays NaN.

        At a place where cells meet the value of the named side is written.
        """
        if t.size >= FEW_VALUES * len(self.cells) and np.all(t[1:] >= t[:-1]):
            self._slice(np.searchsorted(t, self._starts, side="left" if side == "right" else "right"), t, out)
        else:
            self._gather(self._numbers(t, side), t, out)

    @cached_property
    def _starts(self) -> Floats:
        """(p - 1,) where all cells but the first begin."""
        return np.array([cell.start for cell in self.cells[1:]])

    @cached_property
    def _tables(self) -> tuple[Floats, Floats, Floats]:
        """(p,) anchors, (4, p) factors of the derivatives, and (terms, p) coefficients."""
        table = np.zeros((max(len(cell.coefficients) for cell in self.cells), len(self.cells)))
        for column, cell in enumerate(self.cells):
            table[: len(cell.coefficients), column] = cell.coefficients
        anchors, factors = zip(*((cell.anchor, _factors(cell.scale)) for cell in self.cells), strict=True)
        return np.array(anchors), np.transpose(factors).copy(), table

    def _numbers(self, t: Floats, side: Side) -> NDArray[np.intp]:
        """The cells that t lie in; where cells are few and t many it is quicker to compare than to search."""
        starts = self._starts
        if starts.size >= MIN_SEARCHED_CELLS or t.size < MIN_SEARCHED_CELLS * starts.size:
            return starts.searchsorted(t, side=side)
        number, compare = np.zeros(t.shape, dtype=np.uint8), np.greater_equal if side == "right" else np.greater
        for start in starts.tolist():
            number += compare(t, start).view(np.uint8)
        return number.astype(np.intp)

    def _slice(self, cuts: NDArray[np.intp], t: Floats, out: Floats) -> None:
        """Write the values at t, which lie in the order of the cells."""
        for cell, (first, last) in zip(self.cells, pairwise([0, *cuts.tolist(), t.size]), strict=True):
            if first < last:
                x = t[first:last] - cell.anchor
                x *= 1 / cell.scale
                _evaluate(x, cell.coefficients[::-1], out[:, first:last])
                for row, factor in zip(out[1:, first:last], _factors(cell.scale)[1:], strict=True):
                    row *= factor

    def _gather(self, number: NDArray[np.intp], t: Floats, out: Floats) -> None:
        """Write the values at t in the cells of those numbers."""
        anchors, factors, table = self._tables
        x = t - anchors.take(number, mode="clip")
        x *= factors[1].take(number, mode="clip")
        _evaluate(x, (row.take(number, mode="clip") for row in table[::-1]), out)
        for row, factor in zip(out[1:], factors[1:], strict=True):
            row *= factor.take(number, mode="clip")
        if np.isnan(np.min(t, initial=0.0)):
            out[:, np.isnan(t)] = np.nan  # even where a constant took its place


def _factors(scale: float) -> tuple[float, float, float, float]:
    """The factors from a series in (t - anchor)/scale to the derivatives by t."""
    return 1.0, 1 / scale, 2 / scale**2, 6 / scale**3


def _evaluate(x: Floats, coefficients: Iterable[float | Floats], out: Floats) -> None:
    """Write the Taylor coefficients of a polynomial about x, (n,), to the third, into ``out``, (4, n).

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

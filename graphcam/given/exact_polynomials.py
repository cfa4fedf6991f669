"""Polynomials with rational coefficients, alone or as pieces of a motion: no result hangs on rounding.

A polynomial is the tuple of its coefficients, the lowest first.  Conditions of motion with degrees up to 31 lose all
digits in floating point long before the motion itself is unsound; with fractions what is left of a doubtful result is
the doubt in the conditions.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

Exact = tuple[Fraction, ...]
PI = Fraction("3.14159265358979323846264338327950288419716939937510582097494")
"""The number pi to 60 digits."""
MAX_DENOMINATOR = 10**6
"""A number that is the nearest one of the machine to a fraction with no greater a denominator stands for it."""
COEFFICIENT_BITS = 400
"""The binary digits that the largest of the coefficients that were solved for keeps."""
HALVING_COUNT = 90
"""How often an interval is halved about a place where a polynomial changes its sign."""


def shortest(number: float) -> Fraction:
    """The fraction that a number stands for: 1/10 for 0.1, else what the machine has.

    >>> shortest(0.1), shortest(0.5 + 2.0**-52).denominator == 2**52
    (Fraction(1, 10), True)
    """
    exact = Fraction(number)
    short = exact.limit_denominator(MAX_DENOMINATOR)
    return short if float(short) == number else exact


def derivative(p: Exact, times: int = 1) -> Exact:
    """The derivative of that order.

    >>> [int(c) for c in derivative((Fraction(1), Fraction(2), Fraction(3)))]
    [2, 6]
    """
    return tuple(math.perm(k, times) * p[k] for k in range(times, len(p))) or (Fraction(0),)


def value_at(p: Exact, at: Fraction) -> Fraction:
    """The value of the polynomial at a place.

    >>> value_at((Fraction(1), Fraction(2)), Fraction(1, 2))
    Fraction(2, 1)
    """
    found = Fraction(0)
    for coefficient in reversed(p):
        found = found * at + coefficient
    return found


def shifted(p: Exact, at: Fraction, scale: Fraction) -> Exact:
    """The polynomial of y whose value is p(at + scale y).

    >>> shifted((Fraction(0), Fraction(0), Fraction(1)), Fraction(1), Fraction(2))
    (Fraction(1, 1), Fraction(4, 1), Fraction(4, 1))
    """
    found = list(p)
    if at:
        for first in range(len(found) - 1):
            for k in range(len(found) - 2, first - 1, -1):
                found[k] += at * found[k + 1]
    power = Fraction(1)
    for k in range(len(found)):
        found[k] *= power
        power *= scale
    return tuple(found)


def rounded_terms(p: Sequence[Fraction]) -> Exact:
    """The coefficients to :data:`COEFFICIENT_BITS` binary digits of the largest, so that further work is quick.

    >>> rounded_terms([Fraction(1, 4), Fraction(3) / 2**500]) == (Fraction(1, 4), 0)
    True
    """
    largest = max(map(abs, p))
    places = COEFFICIENT_BITS + largest.denominator.bit_length() - largest.numerator.bit_length()
    unit = Fraction(2) ** places
    return tuple(round(coefficient * unit) / unit for coefficient in p)


def sampled_values(p: Exact) -> list[Fraction]:
    """The values at more equidistant places from 0 to 1 than the degree says: all the same only if p is constant.

    >>> sampled_values((Fraction(1), Fraction(-2)))
    [Fraction(1, 1), Fraction(0, 1), Fraction(-1, 1)]
    """
    return [value_at(p, Fraction(k, len(p))) for k in range(len(p) + 1)]


def solve_exactly(rows: Sequence[Sequence[Fraction]], right: Sequence[Fraction]) -> list[Fraction] | None:
    """The solution of as many equations as unknowns; None where they leave one open, or contradict each other.

    >>> one, two = Fraction(1), Fraction(2)
    >>> solve_exactly([[one, two], [one, one]], [two, one])
    [Fraction(0, 1), Fraction(1, 1)]
    >>> solve_exactly([[one, two], [two, two * two]], [two, one]) is None
    True
    """
    table = [[*row, last] for row, last in zip(rows, right, strict=True)]
    n = len(table)
    for k in range(n):
        pivots = [row for row in range(k, n) if table[row][k]]
        if not pivots:
            return None
        # The number of fewest digits: what is divided by it grows least.
        best = min(pivots, key=lambda row: table[row][k].denominator * abs(table[row][k].numerator))
        table[k], table[best] = table[best], table[k]
        filled = [column for column in range(k, n + 1) if table[k][column]]
        for row in range(k + 1, n):
            if table[row][k]:
                share = table[row][k] / table[k][k]
                for column in filled:
                    table[row][column] -= share * table[k][column]
    found = [Fraction(0)] * n
    for k in range(n - 1, -1, -1):
        known = sum((table[k][m] * found[m] for m in range(k + 1, n) if table[k][m]), Fraction(0))
        found[k] = (table[k][n] - known) / table[k][k]
    return found


def sign_changes(p: Exact) -> tuple[int, list[Fraction]]:
    """The sign of p just behind 0, 0 for a polynomial that is zero, and the places in (0, 1) where it changes.

    By the rule of Descartes for Bernstein's coefficients: they change their signs as often as the polynomial, or by an
    even number more, so intervals are halved until they change once or never.  A place is known to 2^-90.

    >>> sign_changes((Fraction(-1), Fraction(4)))
    (-1, [Fraction(1, 4)])
    >>> sign_changes((Fraction(1), Fraction(-4), Fraction(4)))  # it touches zero in the middle
    (1, [])
    """
    n = len(p) - 1
    shared = math.lcm(*(c.denominator for c in p))
    whole = [int(c * shared) for c in p]
    factor = math.lcm(*(math.comb(n, k) for k in range(n + 1)))
    coefficients = [
        sum(math.comb(i, k) * (factor // math.comb(n, k)) * whole[k] for k in range(i + 1)) for i in range(n + 1)
    ]
    if not any(coefficients):
        return 0, []
    return _sign(coefficients), _changes(coefficients, Fraction(0), 0)


def _changes(coefficients: list[int], start: Fraction, depth: int) -> list[Fraction]:
    """The places in the interval of width 2^-depth from ``start`` on."""
    many = _variations(coefficients)
    if not many:
        return []
    width = Fraction(1, 1 << depth)
    if depth >= HALVING_COUNT:
        return [start + width / 2] * (many % 2)
    left, right = _halves(coefficients)
    middle = start + width / 2
    found = _changes(left, start, depth + 1)
    if not left[-1] and _sign(left[::-1]) != _sign(right):
        found.append(middle)
    return found + _changes(right, middle, depth + 1)


def _halves(coefficients: list[int]) -> tuple[list[int], list[int]]:
    """Bernstein's coefficients of both halves of an interval, times 2^n: de Casteljau's algorithm."""
    n = len(coefficients) - 1
    left, right, row = [0] * (n + 1), [0] * (n + 1), coefficients
    for k in range(n + 1):
        left[k], right[n - k] = row[0] << (n - k), row[-1] << (n - k)
        row = [a + b for a, b in pairwise(row)]
    return left, right


def _sign(coefficients: list[int]) -> int:
    """The sign just behind the start."""
    first = next(c for c in coefficients if c)
    return 1 if first > 0 else -1


def _variations(coefficients: list[int]) -> int:
    signs = [c > 0 for c in coefficients if c]
    return sum(a != b for a, b in pairwise(signs))


@dataclass(frozen=True)
class ExactPiece:
    """One polynomial of a motion: s at start + width y for y in [0, 1], in rational numbers.

    start, width : cam angle [rad], of a law fractions of the phase
    """

    start: Fraction
    width: Fraction
    p: Exact

    @property
    def end(self) -> Fraction:
        """Where the piece ends."""
        return self.start + self.width

    def at(self, place: Fraction, order: int = 0) -> Fraction:
        """A derivative by the angle."""
        return value_at(derivative(self.p, order) if order else self.p, (place - self.start) / self.width) / (
            self.width**order
        )

    def coefficients_about(self, place: Fraction, scale: Fraction) -> Exact:
        """The coefficients in y of s at place + scale y; a negative scale looks back."""
        return shifted(self.p, (place - self.start) / self.width, scale / self.width)


def pieces_between(pieces: Sequence[ExactPiece], start: Fraction, end: Fraction) -> list[ExactPiece]:
    """The pieces, or the parts of them, from one place to another.

    >>> line = ExactPiece(Fraction(0), Fraction(1), (Fraction(0), Fraction(1)))
    >>> [(str(piece.start), str(piece.end)) for piece in pieces_between([line], Fraction(1, 4), Fraction(1, 2))]
    [('1/4', '1/2')]
    """
    found: list[ExactPiece] = []
    for piece in pieces:
        low, high = max(piece.start, start), min(piece.end, end)
        if (low, high) == (piece.start, piece.end):
            found.append(piece)
        elif low < high:
            found.append(ExactPiece(low, high - low, rounded_terms(piece.coefficients_about(low, high - low))))
    return found


def turning_places(pieces: Sequence[ExactPiece]) -> list[tuple[Fraction, ExactPiece]]:
    """Where the velocity changes its sign, with the piece that the place lies in, or ends."""
    found: list[tuple[Fraction, ExactPiece]] = []
    before = 0
    for piece in pieces:
        sign, places = sign_changes(derivative(piece.p))
        if before * sign < 0:
            found.append((piece.start, piece))
        found += [(piece.start + piece.width * y, piece) for y in places]
        if sign:
            before = sign * (-1) ** len(places)
    return found

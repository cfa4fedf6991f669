"""Conditions of motion solved with some 360 digits, and what is found as series that the machine computes well.

Degrees up to 31 lose all digits in floating point long before the motion itself is unsound; with so many what is left
of a doubtful result is the doubt in the conditions.  Every polynomial that is found is cut into cells until in each
the terms of the series about its middle hardly cancel; where the motion rests, the series begins there, so that the
little that it has left keeps its digits.  Every coefficient is rounded once.  A cell keeps the terms that count.

A polynomial is the list of its coefficients, the lowest first.  Source: C. de Boor, *A Practical Guide to Splines*
(rev. ed., 2001), chapters IX, X and XIII.
"""

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from operator import mul

import numpy as np

from graphcam.given.piecewise import Floats
from graphcam.given.piecewise_polynomial import ORDER_COUNT, PiecewisePolynomial, taylor_shift

Exact = Sequence[Fraction]
Condition = tuple[Fraction, int, Fraction]
"""A place in [0, 1], the order of a derivative, and its value there."""
Span = tuple[Fraction, Fraction, Exact]
"""From where to where a polynomial of y from 0 to 1 reaches, and its coefficients."""
PI = Fraction("3.14159265358979323846264338327950288419716939937510582097494")
"""The number pi to 60 digits."""
MAX_DENOMINATOR = 10**6
"""A number that is the nearest one of the machine to a fraction with no greater a denominator stands for it."""
WORKING_BITS = 1200
"""The binary digits after the point with which conditions are solved: so many that hundreds of them may cancel."""
ONE = 1 << WORKING_BITS
"""The number 1 in units of 2^-WORKING_BITS."""
COEFFICIENT_BITS = 400
"""The binary digits that the largest of the coefficients that were solved for keeps."""
MAX_CANCELLATION = 2.0
"""The terms of a series come to so many times the greatest value at most."""
NEGLIGIBLE_TERMS = 2.0**-56
"""Terms that all together are smaller, as a fraction of the greatest value, are left out."""
REST_MOVEMENT = 2.0**-55
"""A polynomial rests that moves by less than this part of its greatest value over its width, at its end's speed."""
LEADING_TERM = 1e-12
"""The first term of a series that is no smaller than this part of all terms leads where the motion leaves its rest."""
MAX_HALVINGS = 20
"""How often a polynomial is halved at most: a cell of a millionth is as good as it gets."""
SAMPLES = np.linspace(0, 1, 33)
"""Places among which the greatest values are looked for."""
HUGE = Fraction(10) ** 300
"""Greater coefficients, of a part that nobody sees, are cut to this."""


def shortest(number: float) -> Fraction:
    """The fraction that a number stands for: 1/10 for 0.1, else what the machine has.

    >>> shortest(0.1), shortest(0.5 + 2.0**-52).denominator == 2**52
    (Fraction(1, 10), True)
    """
    exact = Fraction(number)
    short = exact.limit_denominator(MAX_DENOMINATOR)
    return short if float(short) == number else exact


def value_at(p: Sequence[Fraction], at: Fraction, order: int = 0) -> Fraction:
    """A derivative of the polynomial at a place.

    >>> value_at((Fraction(1), Fraction(2)), Fraction(1, 2)), value_at((Fraction(1), Fraction(2)), Fraction(1, 2), 1)
    (Fraction(2, 1), Fraction(2, 1))
    """
    found = Fraction(0)
    for k in range(len(p) - 1, order - 1, -1):
        found = found * at + math.perm(k, order) * p[k]
    return found


def solve_conditions(degree: int, inner: Sequence[Fraction], conditions: Sequence[Condition]) -> list[Span] | None:
    """The spline on [0, 1] with the inner knots that meets as many conditions as it has coefficients; else None.

    >>> zero, one = Fraction(0), Fraction(1)
    >>> [(_, _, p)] = solve_conditions(3, [], [(zero, 0, zero), (zero, 1, zero), (one, 0, one), (one, 1, zero)])
    >>> [int(c) for c in p]
    [0, 0, 3, -2]
    """
    places, right = [(place, order) for place, order, _ in conditions], [value for _, _, value in conditions]
    if not inner:
        # Powers are the quickest of all polynomials here, and in rational numbers as sound as any.
        found = solve_exactly([_powers(degree, *place) for place in places], right)
        return [(Fraction(0), Fraction(1), _rounded(found))] if found else None
    knots = [*[0] * (degree + 1), *map(_units, inner), *[ONE] * (degree + 1)]
    ends = [Fraction(0)] * (degree + 1) + [*inner] + [Fraction(1)] * (degree + 1)
    spans = [(k, low, high) for k, (low, high) in enumerate(pairwise(ends)) if high > low]
    rows: list[list[int]] = []
    for place, order in places:
        k = next(k for k, _, high in spans if place <= high)
        rows.append([0] * len(places))
        rows[-1][k - degree : k + 1] = _b_splines(knots, degree, k, _units(place), order)
    found = _solve_units(rows, [_units(value) for value in right])
    if found is None:
        return None
    solved: list[Span] = []
    for k, low, high in spans:
        taylor = [
            Fraction(
                sum(map(mul, found[k - degree : k + 1], _b_splines(knots, degree, k, knots[k], order))),
                math.factorial(order) << 2 * WORKING_BITS,
            )
            for order in range(degree + 1)
        ]
        solved.append((low, high, _rounded([c * (high - low) ** order for order, c in enumerate(taylor)])))
    return solved


def _powers(degree: int, at: Fraction, order: int) -> list[Fraction]:
    """A derivative at a place of 1, y, y^2, ..."""
    return [math.perm(k, order) * at ** max(k - order, 0) for k in range(degree + 1)]


def _b_splines(knots: Sequence[int], degree: int, k: int, at: int, order: int) -> list[int]:
    """A derivative at a place of the B-splines that are not zero between knots k and k + 1, all in units."""
    values = [ONE if order <= degree else 0]
    for p in range(1, degree + 1):
        raised = [0] * (p + 1)
        for m, value in enumerate(values):
            # B-spline number k - p + 1 + m of the degree before is shared between this number and the one before it.
            first, last = knots[k - p + 1 + m], knots[k + 1 + m]
            up, down = (at - first, last - at) if p <= degree - order else (p * ONE, -p * ONE)
            raised[m + 1] += value * up // (last - first)
            raised[m] += value * down // (last - first)
        values = raised
    return values


def _rounded(p: Sequence[Fraction]) -> Exact:
    """The coefficients to :data:`COEFFICIENT_BITS` binary digits of the largest, so that further work is quick."""
    largest = max(map(abs, p))
    unit = Fraction(2) ** (COEFFICIENT_BITS + largest.denominator.bit_length() - largest.numerator.bit_length())
    return [round(coefficient * unit) / unit for coefficient in p]


def solve_exactly(rows: Sequence[Sequence[Fraction]], right: Sequence[Fraction]) -> Exact | None:
    """The solution of as many equations as unknowns; None where they leave one open, or contradict each other.

    >>> one, two = Fraction(1), Fraction(2)
    >>> solve_exactly([[one, two], [one, one]], [two, one])
    [Fraction(0, 1), Fraction(1, 1)]
    >>> solve_exactly([[one, two], [two, two * two]], [two, one]) is None
    True
    """
    found = _solve_units([[*map(_units, row)] for row in rows], [*map(_units, right)])
    return None if found is None else [Fraction(x, ONE) for x in found]


def _units(x: Fraction) -> int:
    return (x.numerator << WORKING_BITS) // x.denominator


def _solve_units(rows: Sequence[Sequence[int]], right: Sequence[int]) -> list[int] | None:
    """The same in whole numbers of units, which do not grow from one elimination to the next as fractions would."""
    largest = [max(map(abs, row)) for row in rows]
    if not all(largest):
        return None
    # Beside a greatest coefficient of 1 what is no more than rounding is told from what counts.
    table = [[x * ONE // most for x in (*row, last)] for row, last, most in zip(rows, right, largest, strict=True)]
    n = len(table)
    for k in range(n):
        best = max(range(k, n), key=lambda row: abs(table[row][k]))
        table[k], table[best] = table[best], table[k]
        pivot = table[k][k]
        if abs(pivot) >> WORKING_BITS // 2 == 0:
            return None
        filled = [column for column in range(k + 1, n + 1) if table[k][column]]
        for row in range(k + 1, n):
            if table[row][k]:
                share = table[row][k] * ONE // pivot
                for column in filled:
                    table[row][column] -= share * table[k][column] >> WORKING_BITS
    found = [0] * n
    for k in range(n - 1, -1, -1):
        known = sum(map(mul, table[k][k + 1 : n], found[k + 1 :]))
        found[k] = (table[k][n] * ONE - known) // table[k][k]
    return found


# --- as series ------------------------------------------------------------------------------------------------------


def as_series(
    spans: Sequence[Span], start: Fraction = Fraction(0), width: Fraction = Fraction(1), rests: Sequence[Fraction] = ()
) -> PiecewisePolynomial:
    """The polynomials over [0, 1] as series over the width from ``start`` on.

    rests : inner places, from 0 to 1, at which the motion may rest

    >>> zero, one = Fraction(0), Fraction(1)
    >>> square = as_series([(zero, one, [zero, zero, one])], zero, Fraction(2))
    >>> square.anchors.tolist(), square.coefficients.tolist()
    ([0.0], [[0.0], [0.0], [0.25]])
    """
    greatest = _max_magnitudes(spans, width)
    cells: list[tuple[float, float, list[float]]] = []
    for low, high, p in spans:
        cuts = [low, *(place for place in rests if low < place < high), high]
        cells += _cells(p, start + low * width, (high - low) * width, [start + cut * width for cut in cuts], greatest)
    starts, anchors, rows = zip(*cells, strict=True)
    table = np.zeros((max(map(len, rows)), len(rows)))
    for column, row in enumerate(rows):
        table[: len(row), column] = row
    breaks = [float(start + low * width) for low, _, _ in spans[1:]]
    return PiecewisePolynomial(np.array([*starts, float(start + width)]), np.array(anchors), table, np.array(breaks))


def _max_magnitudes(spans: Sequence[Span], width: Fraction) -> list[float]:
    """The greatest magnitude of s and its derivatives."""
    found = [0.0] * ORDER_COUNT
    for low, high, p in spans:
        c = np.array([float(x) for x in p])
        for order in range(ORDER_COUNT):
            values = np.polynomial.polynomial.polyval(SAMPLES, np.polynomial.polynomial.polyder(c, order))
            found[order] = max(found[order], float(np.abs(values).max()) / float((high - low) * width) ** order)
    return found


def _cells(
    p: Exact, start: Fraction, width: Fraction, cuts: Sequence[Fraction], greatest: Sequence[float]
) -> list[tuple[float, float, list[float]]]:
    """Of each cell of a polynomial of (x - start)/width where it starts, its anchor, and the coefficients about it.

    cuts : places in order, from the first to the last of which the cells reach
    """
    still = Fraction(REST_MOVEMENT * greatest[0])
    rests = [x for x in cuts if len(p) > 1 and abs(value_at(p, (x - start) / width, 1)) <= still]
    waiting, found = list(pairwise(cuts))[::-1], list[tuple[float, float, list[float]]]()
    while waiting:
        low, high = waiting.pop()
        ends = [x for x in (low, high) if x in rests]
        anchor = float(ends[0] if ends else (low + high) / 2)
        # At a rest the series begins there, though the machine's place is another one by a rounding.
        about = ends[0] if ends else Fraction(anchor)
        terms = list(p)
        taylor_shift(terms, (about - start) / width)
        if ends:  # a place of rest that is no rational number was rounded
            terms[:2] = terms[0] if abs(terms[0]) > still else Fraction(0), Fraction(0)
        c = np.array([float(min(max(x / width**k, -HUGE), HUGE)) for k, x in enumerate(terms)])
        count, fits = _needed_terms(c, float(max(high - about, about - low)), greatest, bool(ends))
        if (len(ends) < 2 and fits) or (high - low) * 2**MAX_HALVINGS <= width:
            found.append((float(low), anchor, c[:count].tolist()))
        else:
            middle = (low + high) / 2
            waiting += [(middle, high), (low, middle)]
    return found


def _needed_terms(c: Floats, reach: float, greatest: Sequence[float], rests: bool) -> tuple[int, bool]:
    """How many terms are asked for within reach of the anchor, and whether none of the derivatives' cancel there."""
    needed, fit = 1, True
    for order, size in enumerate(greatest):
        row = np.polynomial.polynomial.polyder(c, order)
        terms = np.abs(row) * reach ** np.arange(row.size)
        fit &= bool(terms.sum() <= MAX_CANCELLATION * size)
        varying = np.flatnonzero((terms[1:] if order == 0 else terms) > LEADING_TERM * terms.sum())
        if rests and order < 2 and varying.size:
            # The first power that varies leads near the rest; the others come to no more.
            lead = int(varying[0]) + (order == 0)
            size = min(size, float(terms[lead]))
            fit &= bool(terms[lead + 1 :].sum() <= terms[lead])
        tail = np.append(np.cumsum(terms[::-1])[::-1], 0.0)
        count = int(np.argmax(tail <= NEGLIGIBLE_TERMS * size))
        needed = max(needed, count + order if count else 1)
    return needed, fit

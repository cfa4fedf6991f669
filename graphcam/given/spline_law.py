"""The law of a phase whose displacement is a spline: its pieces between the knots, seen from the nearer end."""

from __future__ import annotations

import math
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.polynomial import Polynomial

from graphcam.given.laws import Floats, Formula, Half, Law
from graphcam.given.monotone_spline import DEGREE, Fit

MEASURED = "measured"
"""The name of such a law."""
AT_REST, TURNING = 4, 2
"""So many of the first Taylor coefficients are zero: s is smooth to the third derivative at a rest, else v is zero."""
SAME_KNOT = 1e-9
"""Knots nearer to one another than this fraction of the phase are one."""


def spline_law(fit: Fit, start: float, end: float, contact: tuple[int, int]) -> tuple[float, Law]:
    """The signed lift and the normalised law of the spline between two cam angles [rad] where its velocity is zero.

    contact : :data:`AT_REST` or :data:`TURNING`, at the start and at the end

    The pieces of the first half are series about their starts, those of the second about their ends, so that a small
    lift and a small missing lift keep their digits.
    """
    angle = end - start
    slack = SAME_KNOT * angle
    inner = fit.knots[(fit.knots > start + slack) & (fit.knots < end - slack)]
    u = np.concatenate([[0.0], (inner - start) / angle, [1.0]])
    level, top = (float(s) for s in fit.spline([start, end]))
    lift = top - level
    first: list[Polynomial] = []
    second: list[Polynomial] = []
    for a, b in pairwise(u):
        # Derivatives may jump at knots, so they are taken in the middle.
        middle = (a + b) / 2
        at = start + angle * middle
        series = (
            np.array([float(fit.spline(at, nu=k)) * angle**k / math.factorial(k) for k in range(DEGREE + 1)]) / lift
        )
        first.append(Polynomial(series)(Polynomial([a - middle, 1.0])) - level / lift)
        second.append(top / lift - Polynomial(series)(Polynomial([b - middle, -1.0])))
    first[0].coef[: contact[0]] = 0.0
    second[-1].coef[: contact[1]] = 0.0
    half = int(np.argmin(np.abs(u[1:-1] - 0.5))) + 1
    halves = _half(first[:half], u[: half + 1]), _half(second[half:][::-1], 1.0 - u[half:][::-1])
    peaks = (max(map(_greatest, (f.deriv(k) for f in first), np.diff(u))) for k in (1, 2))
    return lift, Law(MEASURED, 1.0, float(u[half]), halves, *peaks)


def _half(pieces: list[Polynomial], edges: Floats) -> Half:
    functions: list[Formula] = [
        partial(_polynomial, start=float(x), coefficients=tuple(piece.coef.tolist()))
        for piece, x in zip(pieces, edges, strict=False)
    ]
    return Half(tuple(functions), tuple(edges[1:-1].tolist()))


def _polynomial(x: Floats, *, start: float, coefficients: tuple[float, ...]):
    """A polynomial of x - start, and its first three derivatives."""
    f = Polynomial(coefficients)
    t = x - start
    return f(t), f.deriv(1)(t), f.deriv(2)(t), f.deriv(3)(t)


def _greatest(polynomial: Polynomial, length: float) -> float:
    """The greatest |value| between 0 and ``length``."""
    turning = polynomial.deriv().roots()
    turning = turning[np.isreal(turning)].real
    inside = turning[(turning > 0) & (turning < length)]
    return float(np.max(np.abs(polynomial(np.concatenate([inside, [0.0, length]])))))

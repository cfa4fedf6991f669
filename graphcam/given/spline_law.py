"""Laws whose lift is a spline: their pieces between the knots, seen from the nearer end."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError
from graphcam.given.b_splines import PiecewisePolynomial
from graphcam.given.monotone_spline import DEGREE, Fit
from graphcam.given.motion_law import Law
from graphcam.given.piecewise import Floats
from graphcam.given.reproducible_sums import powers
from graphcam.words import say

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

MEASURED_LAW = "measured"
"""The name of the law of a measured motion."""
REST_ZEROS, TURNING_ZEROS = 4, 2
"""How many of the first Taylor coefficients are zero: s is smooth to the third derivative at a rest, else v is zero."""
MIN_SAMPLES = 3
"""Samples of a law."""
SAME_KNOT = 1e-9
"""Knots nearer to one another than this fraction of the phase are one."""


def spline_law(fit: Fit, start: float, end: float, contact: tuple[int, int]) -> tuple[float, Law]:
    """The signed lift and the normalised law of the spline between two cam angles [rad] where its velocity is zero.

    contact : :data:`REST_ZEROS` or :data:`TURNING_ZEROS`, at the start and at the end

    The pieces of the first half are series about their starts, those of the second about their ends, so that a small
    lift and a small missing lift keep their digits.
    """
    angle = end - start
    slack = SAME_KNOT * angle
    inner = fit.knots[(fit.knots > start + slack) & (fit.knots < end - slack)]
    u = np.concatenate([[0.0], (inner - start) / angle, [1.0]])
    level, top = (float(s) for s in fit.spline([start, end]))
    lift = top - level
    # Derivatives may jump at knots, so they are taken in the middle.
    half_width, middle = np.diff(u) / 2, start + angle * (u[:-1] + u[1:]) / 2
    derivatives = fit.spline(middle), *(fit.velocity(middle, nu=n) for n in range(DEGREE))
    units = powers(angle, DEGREE) / np.cumprod([1, *range(1, DEGREE + 1)]) / lift
    taylor = np.array(derivatives) * units[:, None]
    ahead, back = (
        _shifted_taylor(taylor, -half_width),
        -_shifted_taylor(taylor, half_width) * (-1.0) ** np.arange(DEGREE + 1)[:, None],
    )
    ahead[0] -= level / lift
    back[0] += top / lift
    ahead[: contact[0], 0] = back[: contact[1], -1] = 0.0
    first, second = PiecewisePolynomial(ahead, u), PiecewisePolynomial(back[:, ::-1], (1.0 - u)[::-1])
    half = int(np.argmin(np.abs(u[1:-1] - 0.5))) + 1
    # One formula for all pieces of a half, so that many places in it are computed together.
    formulas = [partial(_spline, spline=first)] * half + [partial(_spline, spline=second)] * (u.size - 1 - half)
    edges, middle_edge = u[1:-1].tolist(), float(u[half])
    peaks = first.greatest(1), first.greatest(2)
    return lift, Law(MEASURED_LAW, formulas, edges, middle=middle_edge, peaks=peaks, trusted=True)


def _shifted_taylor(taylor: Floats, shift: Floats) -> Floats:
    """(6, p) the Taylor coefficients about places that are off by ``shift``."""
    orders, shifts = range(DEGREE + 1), powers(shift, DEGREE)
    return np.array([sum(math.comb(m, n) * taylor[m] * shifts[m - n] for m in orders[n:]) for n in orders])


def sampled_law(name: str, u: ArrayLike, f: ArrayLike, accelerations: tuple[float, float] = (0.0, 0.0)) -> Law:
    """The law through samples, smooth to the fourth derivative: a quintic spline from rest to rest.

    Parameters
    ----------
    name : what it is called on the sheet
    u : (n,) growing from 0 to 1;  f : (n,) the lift there, growing from 0 to 1
    accelerations : f'' at the start and at the end, 0 for a law without impact

    Raises
    ------
    DesignError : the samples are fewer than three, not numbers, or not in order; or the spline through them is no law

    >>> import graphcam as gc
    >>> u = np.linspace(0, 1, 21)
    >>> law = gc.sampled_law("half a turn", u, (1 - np.cos(np.pi * u)) / 2, accelerations=(np.pi**2 / 2, -np.pi**2 / 2))
    >>> round(law.peak_velocity, 6)
    1.570796
    """
    from scipy.interpolate import make_interp_spline

    u, f = np.asarray(u, dtype=np.float64), np.asarray(f, dtype=np.float64)
    if u.ndim != 1 or u.shape != f.shape or u.size < MIN_SAMPLES:
        shapes = say("{shape} and {shape2}", shape=u.shape, shape2=f.shape)
        limit = say("one f for every u, {least} or more", least=MIN_SAMPLES)
        raise DesignError(say("shapes of the samples of the law '{name}'", name=name), shapes, limit)
    for symbol, values in (("u", u), ("f", f)):
        least, most = np.diff(values).min(), np.abs(values[[0, -1]] - [0.0, 1.0]).max()
        if not (least >= 0 and most <= SAME_KNOT) or (symbol == "u" and least <= SAME_KNOT):
            found = say("{values} numbers from {values2:g} to {values3:g}, the smallest step {least:g}")
            found = found.with_values(values=len(values), values2=values[0], values3=values[-1], least=least)
            remedy = say("divide by the last one; where the lift falls, begin another phase")
            quantity = say("samples {symbol} of the law '{name}'", symbol=symbol, name=name)
            raise DesignError(quantity, found, say("growing from 0 to 1"), remedy)
    ends = tuple([(1, 0.0), (2, acceleration)] for acceleration in accelerations)
    spline = make_interp_spline(u, f, k=DEGREE, bc_type=ends)
    # These coefficients are the ends' f, f' and f''; without their rounding what is small near an end keeps its digits.
    at_start, at_end = (2 if acceleration else 3 for acceleration in accelerations)
    spline.c[:at_start], spline.c[-at_end:] = 0.0, 1.0
    knots = np.unique(spline.t)
    return Law(name, [partial(_spline, spline=spline)] * (knots.size - 1), knots[1:-1].tolist())


def _spline(u: Floats, *, spline: BSpline | PiecewisePolynomial):
    """A spline and its first three derivatives."""
    return [spline(u, nu=order) for order in range(4)]

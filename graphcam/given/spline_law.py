"""Laws whose lift is a spline: their pieces between the knots, seen from the nearer end."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError
from graphcam.given.monotone_spline import DEGREE
from graphcam.given.motion_law import Law
from graphcam.given.piecewise_polynomial import PiecewisePolynomial
from graphcam.given.polynomial_law import leg_law
from graphcam.words import say

MEASURED_LAW = "measured"
"""The name of the law of a measured motion."""
MIN_SAMPLES = 3
"""Samples of a law."""
SAME_KNOT = 1e-9
"""Knots nearer to one another than this fraction of the phase are one."""


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
    leg = (
        PiecewisePolynomial.of_spline(spline.t, spline.c, DEGREE)
        .at_rest(float(u[0]), at_start)
        .at_rest(float(u[-1]), at_end)
    )
    return leg_law(name, leg, trusted=False)[1]

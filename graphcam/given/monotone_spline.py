"""A periodic quintic spline through the rows of a table: it rests where they rest, and rises or falls in between.

The knots are single, and double at the ends of rests, so s is smooth to the fourth derivative, and to the third where
a rest begins or ends.  A spline changes its sign no more often than its coefficients do (C. de Boor, *A Practical Guide
to Splines*, 1978, chapter XI), so coefficients of the velocity that are of one sign on every leg, and zero over the
rests, give a displacement without ripples: no leg turns on its way.  Under that condition the displacements come as
near to the rows as least squares can bring them (monotone regression splines, J. O. Ramsay 1988).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.legs import Leg
from graphcam.given.motion import FULL_TURN

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

DEGREE = 5
FEWEST, MOST, GROWTH = 6, 100, 1.3
"""A leg is first divided into so many intervals; where it misses the tolerance their number grows by this factor."""
PARTS_OF_ROWS = 1.0
"""A leg has at most so many intervals for each of its rows: more would follow the noise of every row."""
MOST_LEGS = 24
"""What rises and falls more often is noise."""
CLOSING = 1e4
"""Weight of the closure in the least squares, before it is made exact."""
LESS_NOISE = "give a greater tolerance, or a table with less noise"
STIFFNESS = 1e-6
"""Weight of the spline's stiffness, which settles what the rows leave open."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A periodic spline s(phi), and its knots [rad], over three turns of which the first leg begins the middle one."""

    spline: BSpline
    knots: Floats


def fit(phi: Floats, s: Floats, legs: list[Leg], tolerance: float) -> Fit:
    """The spline with the fewest knots that keeps every row to the tolerance.

    phi, s : (n,) cam angles [rad] within the turn that begins with the first leg, in order, and displacements
    legs : from :func:`~graphcam.given.legs.find_legs`

    Raises
    ------
    DesignError : there are too many legs, or no spline keeps to the tolerance that does not follow every row
    """
    if len(legs) > MOST_LEGS:
        limit = f"greater than the noise that turns the table {len(legs)} times"
        raise DesignError("tolerance", tolerance, limit, LESS_NOISE)
    rows = [np.flatnonzero((phi >= leg.start) & (phi <= leg.end)) for leg in legs]
    most = [min(math.floor(PARTS_OF_ROWS * here.size), MOST) for here in rows]
    parts = [FEWEST] * len(legs)
    while True:
        knots = np.concatenate([_divided(leg, n) for leg, n in zip(legs, parts, strict=True)])
        fitted = _least_squares(phi, s, legs, knots)
        off = np.abs(fitted.spline(phi) - s)
        if off.max() <= tolerance:
            return fitted
        coarse = [k for k, here in enumerate(rows) if here.size and off[here].max() > tolerance]
        # A rest that is off its level is drawn there by the legs beside it.
        finer = [k for k in coarse or range(len(legs)) if parts[k] < most[k]]
        if not finer:
            limit = f"more than {off.max():.3g}, what the best spline leaves at a row"
            raise DesignError("tolerance", tolerance, limit, LESS_NOISE)
        for k in finer:
            parts[k] = min(math.ceil(parts[k] * GROWTH), most[k])


def _divided(leg: Leg, parts: int) -> Floats:
    """The knots of a leg, but for the last if the next leg begins there; towards a rest closer, there double."""
    x = np.linspace(0, 1, parts + 1)
    if leg.from_rest and leg.to_rest:
        x = np.sin(np.pi / 2 * x) ** 2
    elif leg.from_rest:
        x = 1 - np.cos(np.pi / 2 * x)
    elif leg.to_rest:
        x = np.sin(np.pi / 2 * x)
    # With single knots s would leave its rest as x^5; laws leave it as x^2, x^3 or x^4.
    times = np.ones(parts + 1, dtype=np.intp)
    times[0], times[-1] = 1 + leg.from_rest, 2 * leg.to_rest
    return np.repeat(leg.start + (leg.end - leg.start) * x, times)


def _least_squares(phi: Floats, s: Floats, legs: list[Leg], knots: Floats) -> Fit:
    from scipy.interpolate import BSpline
    from scipy.optimize import lsq_linear

    n = knots.size
    # Three turns of knots, so that every spline over the middle one is whole.
    turns = np.concatenate([knots - FULL_TURN, knots, knots + FULL_TURN])
    t = turns[n - DEGREE : 2 * n + DEGREE + 1]
    velocity = np.arange(n + DEGREE - 1) - (DEGREE - 1)  # which of the n velocities each coefficient is, a turn apart
    lower, upper = _signs(np.append(knots, knots + FULL_TURN), legs)
    # The coefficients of s are sums of those of v: c_j = c_(j-1) + d_j (t_(j+5) - t_j)/5.
    steps = (t[DEGREE + 1 : -1] - t[1 : -DEGREE - 1]) / DEGREE
    sums = np.zeros((n + DEGREE, n + 1))
    sums[:, 0] = 1.0
    for j, (step, v) in enumerate(zip(steps, velocity % n, strict=True)):
        sums[j + 1 :, 1 + v] += step
    rise = sums[n, 1:] - sums[0, 1:]
    basis = BSpline.design_matrix(phi, t, DEGREE).toarray() @ sums
    free = np.flatnonzero(upper > lower)
    columns = np.append(0, 1 + free)
    lift = float(np.ptp(s))
    stiff = STIFFNESS * np.diff(np.eye(n), n=2, axis=0)[:, free]
    closing, stiffness = CLOSING * np.append(0.0, rise[free]), np.hstack([np.zeros((stiff.shape[0], 1)), stiff])
    equations = np.vstack([basis[:, columns], closing, stiffness])
    target = np.concatenate([s, np.zeros(1 + stiff.shape[0])])
    bounds = np.append(-np.inf, lower[free]), np.append(np.inf, upper[free])
    solution = lsq_linear(equations, target / lift, bounds, method="bvls").x * lift
    d = np.zeros(n)
    d[free] = solution[1:]
    # The closure to the last digit: the falls are brought to the height of the rises.
    d[d < 0] *= (rise @ np.maximum(d, 0)) / (rise @ np.maximum(-d, 0))
    c = sums @ np.append(solution[0], d)
    around = (np.arange(3 * n - DEGREE - 1) - (n - DEGREE)) % n
    return Fit(BSpline(turns, c[around], DEGREE), np.unique(turns))


def _signs(turns: Floats, legs: list[Leg]) -> tuple[Floats, Floats]:
    """Bounds of the velocities' coefficients: zero over rests, of one sign on a leg, one of any sign at a turning."""
    n = turns.size // 2  # the knots of this turn and of the next are given
    reach = np.lib.stride_tricks.sliding_window_view(turns, DEGREE + 1)[:n]
    middle = reach[:, 1:-1].mean(axis=1)  # where the coefficient is about the velocity (T. N. E. Greville)
    around = [*legs, *(leg.a_turn_later for leg in legs)]
    ends = np.array([leg.end for leg in around])
    on = np.minimum(np.searchsorted(ends, middle), 2 * len(legs) - 1)
    direction = np.array([leg.direction for leg in around])[on]
    lower, upper = np.where(direction > 0, 0.0, -np.inf), np.where(direction > 0, np.inf, 0.0)
    for a, b in pairwise(around):
        if a.to_rest:
            over = (reach[:, 0] < b.start) & (reach[:, -1] > a.end)
            lower[over] = upper[over] = 0.0
        elif a.direction != b.direction:
            away = np.abs((middle - a.end + math.pi) % FULL_TURN - math.pi)
            lower[np.argmin(away)], upper[np.argmin(away)] = -np.inf, np.inf
    return lower, upper

"""The circle through three points of a curve, as an approximation of its circle of curvature."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from graphcam.given.laws import Floats


def circumradius(before: ArrayLike, middle: ArrayLike, after: ArrayLike) -> Floats:
    """Radius of the circle through three points, signed: positive where the way through them turns left.

    R = |a| |b| |b - a|/(2 b x a), with a and b from the middle point to the others; infinite on a line, NaN where
    points coincide.  The unit is that of the points.

    before, middle, after : (..., 2) points

    Against a curve of curvature kappa, at chords of h it errs by kappa'' h^2/12 if they are equally long, and by
    (b - a) kappa'/3 if their lengths a and b differ; rounding leaves 4 eps |p|/(kappa h^2) of the radius.

    The orientation of three floats is exact, however close they are to a line.

    >>> import graphcam as gc
    >>> gc.circumradius([4, 0], [0, 0], [0, 3]).item()
    -2.5
    >>> bool(gc.circumradius([0.5, 0.5 + 2**-53], [12, 12], [24, 24]) > 0)
    True
    """
    points = np.broadcast_arrays(*(np.asarray(point, dtype=np.float64) for point in (before, middle, after)))
    first, centre, last = (np.asarray(point) for point in points)
    # From the middle point, because differences of near points are exact, and products of their coordinates are not.
    a, b = first - centre, last - centre
    size = np.zeros(a.shape[:-1], dtype=np.intc)
    longer = np.maximum(np.abs(a), np.abs(b))
    longest = np.maximum(longer[..., 0], longer[..., 1])  # faster than over so short an axis
    if np.any((longest < MIN_LENGTH) | (longest > 1 / MIN_LENGTH)):
        # A power of two is taken out, so that no product overflows or vanishes.
        size = np.frexp(longest)[1]
        a, b = np.ldexp(a, -size[..., None]), np.ldexp(b, -size[..., None])
    chords = np.hypot(a[..., 0], a[..., 1]) * np.hypot(b[..., 0], b[..., 1])
    across = np.hypot(b[..., 0] - a[..., 0], b[..., 1] - a[..., 1])
    p, q = b[..., 0] * a[..., 1], b[..., 1] * a[..., 0]
    turn = np.asarray(p - q)
    for k in np.argwhere(np.abs(turn) < CANCELLATION_SHARE * (np.abs(p) + np.abs(q))):
        at = tuple(k)
        # b x a of the points as they are, in units of 2^size, rounded once.
        (ax, ay), (mx, my), (bx, by) = ([Fraction(float(x)) for x in part[at]] for part in (first, centre, last))
        turn[at] = float(((bx - mx) * (ay - my) - (by - my) * (ax - mx)) / Fraction(2) ** (2 * int(size[at])))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.ldexp(chords * across / (2 * turn), size)


MIN_LENGTH = 1e-70
"""Products of four such lengths are still told from zero."""
CANCELLATION_SHARE = 1e-9
"""A difference of two products that is a smaller part of them has lost so many digits that it is taken exactly."""

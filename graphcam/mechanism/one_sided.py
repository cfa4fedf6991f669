"""The greatest value of a quantity that jumps: a supremum, which is a limit from one side of a jump or the other."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from graphcam.given.laws import Floats, Side
from graphcam.given.motion import Motion
from graphcam.mechanism.kinematics import Values
from graphcam.mechanism.stationary import Places, smooth_pieces, stationary_places

ROUNDING = 32 * np.finfo(np.float64).eps
"""Values that differ by less than this part of their terms are the same value."""


class ValueAt(NamedTuple):
    """A value at a cam angle [rad]; at a jump it is the limit from the named side."""

    value: float
    phi: float
    side: Side


def greatest(
    motion: Motion, slope: Callable[[Values], Floats], quantity: Callable[[Places], Floats], size: float = 0.0
) -> ValueAt:
    """The supremum of a quantity over the turn, to full precision; of equal ones the first.

    slope : the quantity's derivative by phi, or anything of its sign, as a function of (s, v, a, j)
    size : of the terms that the quantity is a sum of, if they are larger than itself; NaN values are left out

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi, "rectangular"), gc.Return(30, pi, "rectangular")])
    >>> value, phi, side = greatest(motion, lambda values: values[3], lambda places: places.values[2])
    >>> round(value, 3), phi, side  # the acceleration just after the start, and on to the middle
    (12.159, 0.0, 'right')
    """
    places = stationary_places(motion, slope)
    values, pieces = quantity(places), len(smooth_pieces(motion)[0])
    top = np.nanmax(values)
    best = np.flatnonzero(values >= top - ROUNDING * max(size, abs(top)))
    k = best[np.argmin(places.phi[best])]
    # The beginnings of the pieces come first, then their ends.
    return ValueAt(float(values[k]), float(places.phi[k]), "left" if pieces <= k < 2 * pieces else "right")

"""Roots of many functions at once, each kept between two places at which its function has opposite signs.

Source: T. R. Chandrupatla, *A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear function
without using derivatives*, Advances in Engineering Software 28 (1997), 145-149.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from graphcam.given.laws import Floats

# Not scipy.optimize.elementwise.find_root, which is the same method: measured from 1 to 10,000 roots at once, what
# stands here takes a half to a thirtieth of its time, and needs no scipy.

BRACKET_ROUNDING = 4 * np.finfo(np.float64).eps
"""A root is known when its bracket is no wider than this part of it."""


def roots(function: Callable[[Floats], Floats], low: ArrayLike, high: ArrayLike) -> Floats:
    """The places between low and high at which the functions vanish, each to the rounding of its own place.

    A dozen steps find them, and two or three times as many where a function is flat.

    Parameters
    ----------
    function : values at places, both shaped like low and high; the k-th value depends on the k-th place alone
    low, high : (n,), or numbers for one function; where the signs at both are the same, that of the smaller value is
        returned

    >>> roots(lambda x: x**2 - [2, 9], [0, 0], [4, 4]).round(12).tolist()
    [1.414213562373, 3.0]
    """
    last, other = np.asarray(high, dtype=np.float64), np.asarray(low, dtype=np.float64)
    at_last, at_other = function(last), function(other)
    share, found = np.full(last.shape, 0.5), np.where(np.abs(at_last) < np.abs(at_other), last, other)
    going = np.sign(at_last) * np.sign(at_other) <= 0
    with np.errstate(all="ignore"):
        while True:
            nearer = np.abs(at_last) < np.abs(at_other)
            found = np.where(going, np.where(nearer, last, other), found)
            width, close = np.abs(other - last), BRACKET_ROUNDING * np.abs(found) + np.finfo(np.float64).tiny
            going &= (width > close) & (np.where(nearer, at_last, at_other) != 0)
            if not going.any():
                return found
            # Not nearer to either end than what counts as the same place.
            share = np.clip(share, close / width / 2, 1 - close / width / 2)
            place = last + share * (other - last)
            value = function(np.where(going, place, found))
            same = np.sign(value) == np.sign(at_last)
            third, at_third = np.where(same, last, other), np.where(same, at_last, at_other)
            other, at_other = np.where(same, other, last), np.where(same, at_other, at_last)
            last, at_last = place, value
            share = _share(last, other, third, at_last, at_other, at_third)


def _share(a: Floats, b: Floats, c: Floats, fa: Floats, fb: Floats, fc: Floats) -> Floats:
    """Where from a to b the inverse parabola through three places vanishes; halfway if it does not go straight."""
    x, f = (a - b) / (c - b), (fa - fb) / (fc - fb)
    straight = (f * f < x) & ((1 - f) * (1 - f) < 1 - x)
    inverse = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    return np.where(straight, inverse, 0.5)

"""Where the trace point of a follower stands that rests on a given cam: on its guide, or on the circle about its pivot.

The trace point is the centre of a roller, or the knife edge; its distance from the cam centre tells where it stands,
and where it stands how far the follower has moved.
"""

import math
from collections.abc import Callable
from functools import singledispatch
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.follower import Follower, Oscillating, Translating
from graphcam.given.laws import Floats
from graphcam.words import say

Complexes = NDArray[np.complex128]


class Trace(NamedTuple):
    """The way of a follower's trace point.

    prime_radius : its distance from the cam centre [mm] where the follower has not moved
    lowest : the height, or angle, from which s is counted [mm or rad]
    position : from distances from the cam centre [mm] to places, complex [mm]
    moved : from places to displacements s [mm or rad]
    arm : mm of way for one unit of s
    """

    prime_radius: float
    lowest: float
    position: Callable[[float | Floats], Complexes]
    moved: Callable[[Complexes], Floats]
    arm: float = 1.0

    def at(self, s: float) -> float:
        """The distance from the cam centre [mm] after a displacement, by bisection: both grow together."""
        low, high = self.prime_radius / 2, 2 * self.prime_radius
        while (middle := (low + high) / 2) not in (low, high):
            low, high = (middle, high) if self.moved(self.position(middle)) < s else (low, middle)
        return high


@singledispatch
def trace(follower: Follower, base_radius: float) -> Trace:
    """The way of a follower's trace point, for a cam of a base radius [mm].

    Raises
    ------
    DesignError : the follower has no trace point, or cannot rest on such a cam

    >>> from graphcam.given.follower import Translating
    >>> way = trace(Translating(offset=12, roller_radius=8), 29)
    >>> round(way.lowest, 4), complex(way.position(37.0)).real
    (35.0, 12.0)
    """
    raise unfit_follower()


def unfit_follower() -> DesignError:
    """The error for a follower of which it is not known what a given cam does to it."""
    limit, remedy = say("a stem, an arm, or a flat face on a stem"), say("take another follower")
    return DesignError("follower", say("a face that swings"), limit, remedy)


@trace.register
def _(follower: Translating, base_radius: float) -> Trace:
    r0, e = base_radius + follower.roller_radius, follower.offset
    if not abs(e) < r0:
        limit = say("less than the prime radius of {radius:g} mm in magnitude", radius=r0)
        raise DesignError("offset", e, limit, say("take a smaller offset"))
    lowest = math.sqrt((r0 - e) * (r0 + e))

    def position(radius: float | Floats) -> Complexes:
        return np.asarray(e + 1j * np.sqrt(np.maximum(np.square(radius) - e * e, 0.0)), dtype=np.complex128)

    def moved(place: Complexes) -> Floats:
        return place.imag - lowest

    return Trace(r0, lowest, position, moved)


@trace.register
def _(follower: Oscillating, base_radius: float) -> Trace:
    r0, c, arm = base_radius + follower.roller_radius, follower.distance, follower.arm
    if c is None:
        remedy = say("the given cam stands at some distance")
        raise DesignError(say("centre distance"), say("missing"), say("given"), remedy)
    if not abs(c - arm) < r0 < c + arm:
        limit = say("between {least:g} and {most:g} mm, so that the arm reaches", least=abs(c - arm), most=c + arm)
        found, remedy = say("{radius:.6g}", radius=base_radius), say("change the arm or its distance")
        raise DesignError("base_radius", found, limit, remedy)

    def position(radius: float | Floats) -> Complexes:
        cosine = (c * c + arm * arm - np.square(radius)) / (2 * c * arm)
        return np.asarray(c - arm * np.exp(-1j * np.arccos(np.clip(cosine, -1.0, 1.0))), dtype=np.complex128)

    lowest = float(-np.angle((c - position(r0)) / arm))

    def moved(place: Complexes) -> Floats:
        return -np.angle((c - place) / arm) - lowest

    return Trace(r0, lowest, position, moved, arm)

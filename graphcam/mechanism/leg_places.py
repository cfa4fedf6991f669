"""The rises and the returns of a motion, each seen from its lower end, and places on them."""

from bisect import bisect_right
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from graphcam.given.laws import Floats
from graphcam.given.motion import Dwell, Motion
from graphcam.given.motion_law import Law

PHASE_PLACES = 96
"""Places on a whole phase, denser at the ends of its smooth pieces ..."""
MIN_PIECE_PLACES = 16
"""The minimum number of places on a piece, however short."""
END_PLACES = np.logspace(-12, -4, 25)
"""Places nearer the phase's ends, where a steep limit moves the extremes to."""


class OneLeg(NamedTuple):
    """A rise, or a return as if time ran backwards: s = low + lift f(w), |v| = lift/angle f'(w).

    law : as seen from the lower end;  angle : rad;  low : s of the lower end
    """

    law: Law
    lift: float
    angle: float
    low: float


class LegPlaces(NamedTuple):
    """The rises or the returns of a motion, with their places in one row.

    first : where each leg's places begin, and the count of all;  w : fractions of the leg, from its lower end
    s, v : s and |v|
    """

    legs: tuple[OneLeg, ...]
    first: tuple[int, ...]
    w: Floats
    s: Floats
    v: Floats

    def leg_of(self, k: int) -> OneLeg:
        """The leg that the k-th place belongs to."""
        return self.legs[bisect_right(self.first, k) - 1]


@lru_cache(maxsize=64)
def legs(motion: Motion, direction: int) -> tuple[OneLeg, ...]:
    """The rises (direction +1) or the returns (-1) of a motion.  They are kept, for it is sized again and again.

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, 1.0, "cosine"), gc.Return(30, 2 * pi - 1.0, "2-3")])
    >>> [(leg.law.name, leg.lift, leg.low) for leg in legs(motion, -1)]
    [('2-3', 30, 0.0)]
    """
    found: list[OneLeg] = []
    for k, phase in enumerate(motion.phases):
        if phase.direction == direction and not isinstance(phase, Dwell):
            law, low = (phase.normalised, k) if direction > 0 else (phase.normalised.reversed, k + 1)
            found.append(OneLeg(law, phase.lift, phase.angle, motion.levels.item(low)))
    return tuple(found)


@lru_cache(maxsize=64)
def sampled_legs(motion: Motion, direction: int) -> LegPlaces:
    """The rises or the returns of a motion, each with places on it.

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, 1.0, "cosine"), gc.Return(30, 2 * pi - 1.0, "2-3")])
    >>> sampled_legs(motion, +1).s[[0, -1]].tolist()
    [0.0, 30.0]
    """
    found = legs(motion, direction)
    places = [_places(leg.law) for leg in found]
    first = np.cumsum([0, *(part.shape[1] for part in places)]).tolist()
    s = [leg.low + leg.lift * f for leg, (_, f, _) in zip(found, places, strict=True)]
    v = [leg.lift / leg.angle * f1 for leg, (_, _, f1) in zip(found, places, strict=True)]
    w = [w for w, _, _ in places]
    return LegPlaces(found, tuple(first), *map(np.concatenate, (w, s, v)))


@lru_cache(maxsize=64)
def _places(law: Law) -> Floats:
    """(3, n) places w, and f and f' there."""
    pieces = pairwise((0.0, *law.breaks, 1.0))
    inside = [
        begin
        + (end - begin)
        * np.sin(np.linspace(0, np.pi / 2, max(MIN_PIECE_PLACES, round(PHASE_PLACES * (end - begin))))) ** 2
        for begin, end in pieces
    ]
    w = np.unique(np.concatenate([END_PLACES, *inside, 1 - END_PLACES]))
    return np.array([w, *law(w, derivatives=1)])

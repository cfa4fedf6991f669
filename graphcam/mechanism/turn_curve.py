"""A quantity as a curve over the turn: dense points in order, at a jump one on either side."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.mechanism.stationary import Places, places_in, smooth_pieces


@dataclass(frozen=True, eq=False)
class TurnCurve:
    """Dense points of a curve over the turn, (n,), in order, at a jump one on either side.

    phi : rad;  values : of the quantity, NaN where it has none
    """

    phi: Floats
    values: Floats


def over_turn(
    motion: Motion, quantity: Callable[[Places], Floats], knots: Sequence[float] = (), parts: int = 60
) -> TurnCurve:
    """A quantity over the turn, with ``parts`` points on every smooth piece and both its ends.

    quantity : at places that belong to phases, shaped like them
    knots : cam angles [rad] at which its slope jumps inside a phase

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi, "rectangular"), gc.Return(30, pi, "rectangular")])
    >>> curve = over_turn(motion, lambda places: places.values[2], parts=1)
    >>> curve.values.round(2).tolist()  # the acceleration, on both sides of its jumps
    [12.16, 12.16, -12.16, -12.16, -12.16, -12.16, 12.16, 12.16]
    """
    phase, u0, u1 = smooth_pieces(motion, knots)
    share = np.linspace(0, 1, parts + 1)
    inside = places_in(motion, phase[:, None], u0[:, None] * (1 - share) + u1[:, None] * share)
    values = np.array(quantity(inside))
    values[:, -1] = quantity(places_in(motion, phase, u1, "left"))
    return TurnCurve(inside.phi.ravel(), values.ravel())

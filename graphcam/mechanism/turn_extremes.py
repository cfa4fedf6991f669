"""The extremes of a motion and of any quantity of it, one that jumps included, and its curve over the turn.

An extreme lies at an end of a smooth piece, or where the quantity is stationary inside it, which
:mod:`graphcam.given.extreme_search` finds.  Source of v_max = C_v h/F and a_max = C_a h/F^2: R. L. Norton, *Cam Design
and Manufacturing Handbook* (2009), chapter 3.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.given.extreme_search import SmoothPieces
from graphcam.given.laws import Floats, Side
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Phase, wrap
from graphcam.mechanism.kinematics import Values


@dataclass(frozen=True, eq=False)
class Places:
    """Places of a motion that belong to phases.

    phase, u, phi : (n,) index of the phase, fraction of it, cam angle [rad];  values : (s, v, a, j), each (n,)
    """

    phase: NDArray[np.intp]
    u: Floats
    phi: Floats
    values: Values

    def selected(self, chosen: NDArray[np.bool_]) -> Places:
        """The places that a mask chooses."""
        s, v, a, j = (value[chosen] for value in self.values)
        return Places(self.phase[chosen], self.u[chosen], self.phi[chosen], (s, v, a, j))


PlaceQuantity = Callable[[Places], Floats]
"""A quantity at places, shaped like them."""


def stationary_places(motion: Motion, quantity: PlaceQuantity, knots: Sequence[float] = ()) -> Places:
    """Both ends of every smooth piece, with the values from inside, and where inside a quantity is stationary.

    knots : cam angles [rad] at which the quantity may bend inside a smooth piece of the motion

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi, "cosine"), gc.Return(30, pi, "cosine")])
    >>> places = stationary_places(motion, lambda places: places.values[1])  # where v is greatest
    >>> np.unique(places.u.round(9)).tolist()
    [0.0, 0.5, 1.0]
    """
    smooth = _smooth(motion, tuple(knots))
    piece, u = smooth.moving.stationary(smooth.on_pieces(quantity), smooth.phase)
    inside = smooth.phase[piece]
    return at_places(motion, *smooth.ends, (inside, u, motion.at(inside, u)))


def zero_angles(motion: Motion, quantity: PlaceQuantity, knots: Sequence[float] = ()) -> Floats:
    """The cam angles [rad] at which a quantity vanishes inside a smooth piece."""
    smooth = _smooth(motion, tuple(knots))
    piece, u = smooth.moving.zeros(smooth.on_pieces(quantity))
    return motion.angle_at(smooth.phase[piece], u)


def highest_places(motion: Motion, quantity: Callable[[Values], Floats], *, signed: bool = False) -> Places:
    """Both ends of every smooth piece, and where inside a quantity is highest on the rises, and on the returns.

    Places that are as high, or nearly so, are among them; others may be.

    quantity : of (s, v, a, j);  signed : whether a negative value counts as much as a positive one

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi, "cosine"), gc.Return(30, pi, "cosine")])
    >>> np.unique(highest_places(motion, lambda values: values[1], signed=True).u.round(9)).tolist()
    [0.0, 0.5, 1.0]
    """
    return _highest_places(motion, lambda places: quantity(places.values), (), motion.directions, signed)


def _highest_places(
    motion: Motion, quantity: PlaceQuantity, knots: Sequence[float], groups: Floats, signed: bool = False
) -> Places:
    """The ends of the pieces, and where each group of phases, 0 to 2 or -1, may be highest."""
    height = np.abs if signed else np.positive
    smooth, group = _smooth(motion, tuple(knots)), groups.astype(np.intp) % 3
    top = np.full(3, -np.inf)
    for phase, u, values in smooth.ends:
        at_ends = quantity(Places(phase, u, motion.angle_at(phase, u), values))
        np.fmax.at(top, group[phase], height(at_ends))
    piece, u = smooth.moving.stationary(smooth.on_pieces(quantity), group[smooth.phase], top, height)
    inside = smooth.phase[piece]
    return at_places(motion, *smooth.ends, (inside, u, motion.at(inside, u)))


def places_in(motion: Motion, phase: ArrayLike, u: ArrayLike, side: Side = "right") -> Places:
    """Places at fractions u of phases, shaped like both together."""
    index, fraction = np.broadcast_arrays(np.asarray(phase, dtype=np.intp), np.asarray(u, dtype=np.float64))
    return Places(index, fraction, motion.angle_at(index, fraction), motion.at(index, fraction, side))


def places_at(motion: Motion, phi: ArrayLike, side: Side = "right") -> Places:
    """Places at cam angles [rad], any real numbers, shaped like them; an end of a phase belongs to that on its side.

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi), gc.Return(30, pi)])
    >>> [places_at(motion, [0.0, pi / 2, pi], side).phase.tolist() for side in ("left", "right")]
    [[1, 0, 0], [0, 0, 1]]
    """
    turned = wrap(phi)
    if side == "left":
        turned = np.where(turned == 0, FULL_TURN, turned)
    phase = motion.starts[1:].searchsorted(turned, side=side)
    u = (turned - motion.starts[phase]) / motion.angles[phase]
    return Places(phase, u, np.asarray(phi, dtype=np.float64), motion(phi, side))


def places_from(motion: Motion, where: ArrayLike, u: ArrayLike | None, side: Side) -> Places:
    """Places as they are told in one of two ways: at cam angles where ``u`` is None, or at fractions of phases."""
    return places_at(motion, where, side) if u is None else places_in(motion, where, u, side)


def at_places(motion: Motion, *parts: tuple[NDArray[np.intp], Floats, Values]) -> Places:
    """Several runs of places as one, each with its phases, fractions and values."""
    phases, fractions, values = zip(*parts, strict=True)
    s, v, a, j = (np.concatenate(part) for part in zip(*values, strict=True))
    phase, u = np.concatenate(phases), np.concatenate(fractions)
    return Places(phase, u, motion.angle_at(phase, u), (s, v, a, j))


def smooth_pieces(motion: Motion, knots: Sequence[float] = ()) -> tuple[NDArray[np.intp], Floats, Floats]:
    """Where a motion is smooth: (p,) phase, and the fractions of it where the piece begins and ends.

    knots : cam angles [rad] at which pieces end besides
    """
    return _smooth_pieces(motion, tuple(knots))


@lru_cache(maxsize=64)
def _smooth_pieces(motion: Motion, knots: tuple[float, ...]) -> tuple[NDArray[np.intp], Floats, Floats]:
    pieces = [
        (k, u0, u1)
        for k, phase in enumerate(motion.phases)
        for u0, u1 in pairwise((0.0, *_inside(motion, k, phase, knots), 1.0))
    ]
    phase, u0, u1 = zip(*pieces, strict=True)
    return np.array(phase), np.array(u0), np.array(u1)


class _Smooth(NamedTuple):
    """The smooth pieces of a motion.

    ends : their beginnings and their ends, with the values from inside
    phase, moving : of rises and returns alone: in a dwell nothing changes
    first : the places of these that every search begins with
    """

    motion: Motion
    ends: tuple[tuple[NDArray[np.intp], Floats, Values], ...]
    phase: NDArray[np.intp]
    moving: SmoothPieces
    first: Places

    def on_pieces(self, quantity: PlaceQuantity) -> Callable[[NDArray[np.intp], Floats], Floats]:
        """A quantity at fractions u of phases, by the numbers of the pieces."""

        def at(piece: NDArray[np.intp], u: Floats) -> Floats:
            here = u is self.moving.nodes
            return quantity(self.first if here else places_in(self.motion, self.phase[piece], u))

        return at


@lru_cache(maxsize=64)
def _smooth(motion: Motion, knots: tuple[float, ...]) -> _Smooth:
    phase, u0, u1 = smooth_pieces(motion, knots)
    ends = (phase, u0, motion.at(phase, u0, "right")), (phase, u1, motion.at(phase, u1, "left"))
    moving = motion.directions[phase] != 0
    pieces = SmoothPieces(u0[moving], u1[moving])
    return _Smooth(motion, ends, phase[moving], pieces, places_in(motion, phase[moving, None], pieces.nodes))


def _inside(motion: Motion, k: int, phase: Phase, knots: Sequence[float]) -> list[float]:
    """The fractions of a phase at which one piece of it meets the next."""
    breaks = [] if isinstance(phase, Dwell) else list(phase.normalised.breaks)
    shares = ((phi - float(motion.starts[k])) / phase.angle for phi in knots)
    return sorted(
        {
            *breaks,
            *(
                u
                for u in shares
                if KNOT_DISTANCE < u < 1 - KNOT_DISTANCE and all(abs(u - b) > KNOT_DISTANCE for b in breaks)
            ),
        }
    )


KNOT_DISTANCE = 1e-9
"""Knots that lie nearer to a break than this part of a phase are one with it."""
SAME_ANGLE = 1e-9
"""Places that are nearer to one another than this angle [rad], and as high, are one."""
VALUE_ROUNDING = 32 * np.finfo(np.float64).eps
"""Values that differ by less than this part of their terms are the same value."""


class Extreme(NamedTuple):
    """A value, and the cam angle [rad] of its place."""

    value: float
    phi: float


class Interval(NamedTuple):
    """An interval of the cam angle [rad]; an end beyond 2 pi lies in the next turn."""

    start: float
    end: float


class ValueAt(NamedTuple):
    """A value at a cam angle [rad]; at a jump it is the limit from the named side."""

    value: float
    phi: float
    side: Side


def turn_maximum(motion: Motion, quantity: PlaceQuantity, knots: Sequence[float] = ()) -> ValueAt:
    """The supremum of a quantity over the turn, to full precision; of equal ones the first.

    quantity : at places; NaN values are left out
    knots : cam angles [rad] at which it may bend inside a smooth piece

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi, "rectangular"), gc.Return(30, pi, "rectangular")])
    >>> value, phi, side = turn_maximum(motion, lambda places: places.values[2])
    >>> round(value, 3), phi, side  # the acceleration just after the start, and on to the middle
    (12.159, 0.0, 'right')
    """
    return first_highest(
        motion, _highest_places(motion, quantity, knots, np.zeros(len(motion.phases))), quantity, knots
    )


def first_highest(
    motion: Motion, places: Places, quantity: PlaceQuantity, knots: Sequence[float] = (), size: float = 0.0
) -> ValueAt:
    """The highest of a quantity's stationary places over the turn, as :func:`stationary_places` gives them.

    size : of the terms that the quantity is a sum of, if they are larger than itself; NaN values are left out
    """
    values, pieces = quantity(places), len(smooth_pieces(motion, knots)[0])
    k = first_index(values, places.phi, size)
    # The beginnings of the pieces come first, then their ends.
    return ValueAt(float(values[k]), float(places.phi[k]), "left" if pieces <= k < 2 * pieces else "right")


def first_index(values: Floats, phi: Floats, size: float = 0.0) -> int:
    """Which of the greatest values comes first in the turn; of those at one place the first in the array.

    size : of the terms that the values are sums of, if they are larger than these; NaN values are left out
    """
    top = np.nanmax(values)
    (best,) = np.nonzero(values >= top - VALUE_ROUNDING * max(size, abs(top)))
    return int(best[np.argmax(phi[best] <= phi[best].min() + SAME_ANGLE)])


def velocity_range(motion: Motion) -> tuple[float, float]:
    """The least v, on a return, and the greatest, on a rise [mm/rad].

    >>> from math import pi
    >>> import graphcam as gc
    >>> velocity_range(gc.Motion([gc.Rise(30, 2.5, "cycloidal"), gc.Dwell(2 * pi - 4.5), gc.Return(30, 2.0, "2-3")]))
    (-22.5, 24.0)
    """
    moving = [p for p in motion.phases if not isinstance(p, Dwell)]
    peaks = [p.direction * p.normalised.peak_velocity * p.lift / p.angle for p in moving]
    return min(peaks), max(peaks)


def max_velocity(motion: Motion) -> float:
    """The greatest |v| over the turn [mm/rad].

    >>> from math import pi
    >>> import graphcam as gc
    >>> max_velocity(gc.Motion([gc.Rise(30, 2.0, "cycloidal"), gc.Return(30, 2 * pi - 2, "cycloidal")]))
    30.0
    """
    return max(p.normalised.peak_velocity * p.lift / p.angle for p in motion.phases if not isinstance(p, Dwell))


def max_acceleration(motion: Motion) -> float:
    """The greatest |a| over the turn [mm/rad^2], of the two sides at a jump.

    >>> from math import pi
    >>> import graphcam as gc
    >>> max_acceleration(gc.Motion([gc.Rise(30, 2.0, "rectangular"), gc.Return(30, 2 * pi - 2, "rectangular")]))
    30.0
    """
    return max(p.peak_acceleration for p in motion.phases if not isinstance(p, Dwell))


def max_jerk(motion: Motion) -> float:
    """The greatest finite |j| over the turn [mm/rad^3]: where the acceleration jumps, the jerk is infinite.

    >>> from math import pi
    >>> import graphcam as gc
    >>> round(max_jerk(gc.Motion([gc.Rise(30, 2.0, "3-4-5"), gc.Return(30, 2 * pi - 2, "3-4-5")])), 9)
    225.0
    """
    return max(p.normalised.peak_jerk * p.lift / p.angle**3 for p in motion.phases if not isinstance(p, Dwell))


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

"""The extremes of a motion and of any quantity of it, one that jumps included, and its curve over the turn.

An extreme lies at an end of a smooth piece, or where the slope vanishes.  Source of v_max = C_v h/F and a_max =
C_a h/F^2: R. L. Norton, *Cam Design and Manufacturing Handbook* (2009), chapter 3.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.given.laws import Floats, Side
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Phase, wrap
from graphcam.given.root_finding import roots
from graphcam.mechanism.kinematics import Values

_END_FRACTIONS = np.logspace(-12, -4, 25)
# Fractions of a piece: dense at its ends, where a small prime radius or a steep limit moves the extremes to.
PIECE_FRACTIONS = np.concatenate(
    [_END_FRACTIONS, np.sin(np.linspace(0, np.pi / 2, 97)[1:-1]) ** 2, 1 - _END_FRACTIONS[::-1]]
)
"""Fractions of a smooth piece between which a quantity is taken to have one extreme at most."""


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


def stationary_places(motion: Motion, slope: Callable[[Values], Floats]) -> Places:
    """Both ends of every smooth piece, with the values from inside, and the inner roots of the slope.

    slope : the derivative of the quantity by phi, or anything of its sign, as a function of (s, v, a, j)

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi, "cosine"), gc.Return(30, pi, "cosine")])
    >>> stationary_places(motion, slope=lambda values: values[2]).u.round(12).tolist()  # where v is greatest
    [0.0, 0.0, 1.0, 1.0, 0.5, 0.5]
    """
    return places_of(motion, lambda places: slope(places.values))


def places_of(motion: Motion, slope: Callable[[Places], Floats], knots: Sequence[float] = ()) -> Places:
    """The extreme places of a quantity that depends on the cam angle besides, or on the sense of the motion.

    slope : of places;  knots : cam angles [rad] at which the slope may jump inside a smooth piece
    """
    phase, u0, u1 = smooth_pieces(motion, knots)
    phase_r, u_r = _roots(motion, slope, phase, u0, u1)
    begin, end, inner = motion.at(phase, u0, "right"), motion.at(phase, u1, "left"), motion.at(phase_r, u_r)
    return at_places(motion, (phase, u0, begin), (phase, u1, end), (phase_r, u_r, inner))


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
    pieces = [
        (k, u0, u1)
        for k, phase in enumerate(motion.phases)
        for u0, u1 in pairwise((0.0, *_inside(motion, k, phase, knots), 1.0))
    ]
    phase, u0, u1 = zip(*pieces, strict=True)
    return np.array(phase), np.array(u0), np.array(u1)


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


def _roots(
    motion: Motion, slope: Callable[[Places], Floats], phase: NDArray[np.intp], u0: Floats, u1: Floats
) -> tuple[NDArray[np.intp], Floats]:
    moving = motion.directions[phase] != 0  # in a dwell nothing changes
    phase, u0, u1 = phase[moving], u0[moving], u1[moving]
    u = u0[:, None] + (u1 - u0)[:, None] * PIECE_FRACTIONS
    sign = np.sign(slope(places_in(motion, phase[:, None], u)))
    on_root = np.nonzero(sign == 0)
    piece, left = np.nonzero(sign[:, :-1] * sign[:, 1:] < 0)
    inside = phase[piece]
    bracketed = roots(lambda u: slope(places_in(motion, inside, u)), u[piece, left], u[piece, left + 1])
    return np.concatenate([inside, phase[on_root[0]]]), np.concatenate([bracketed, u[on_root]])


KNOT_DISTANCE = 1e-9
"""Knots that lie nearer to a break than this part of a phase are one with it."""
VALUE_ROUNDING = 32 * np.finfo(np.float64).eps
"""Values that differ by less than this part of their terms are the same value."""


class ValueAt(NamedTuple):
    """A value at a cam angle [rad]; at a jump it is the limit from the named side."""

    value: float
    phi: float
    side: Side


def turn_maximum(
    motion: Motion, slope: Callable[[Values], Floats], quantity: Callable[[Places], Floats], size: float = 0.0
) -> ValueAt:
    """The supremum of a quantity over the turn, to full precision; of equal ones the first.

    slope : the quantity's derivative by phi, or anything of its sign, as a function of (s, v, a, j)
    size : of the terms that the quantity is a sum of, if they are larger than itself; NaN values are left out

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi, "rectangular"), gc.Return(30, pi, "rectangular")])
    >>> value, phi, side = turn_maximum(motion, lambda values: values[3], lambda places: places.values[2])
    >>> round(value, 3), phi, side  # the acceleration just after the start, and on to the middle
    (12.159, 0.0, 'right')
    """
    return places_maximum(motion, lambda places: slope(places.values), quantity, size)


def places_maximum(
    motion: Motion,
    slope: Callable[[Places], Floats],
    quantity: Callable[[Places], Floats],
    size: float = 0.0,
    knots: Sequence[float] = (),
) -> ValueAt:
    """The supremum of a quantity whose slope depends on the cam angle besides, or on the sense of the motion.

    slope : of places;  knots : cam angles [rad] at which it may jump inside a smooth piece
    """
    places = places_of(motion, slope, knots)
    values, pieces = quantity(places), len(smooth_pieces(motion, knots)[0])
    top = np.nanmax(values)
    best = np.flatnonzero(values >= top - VALUE_ROUNDING * max(size, abs(top)))
    k = best[np.argmin(places.phi[best])]
    # The beginnings of the pieces come first, then their ends.
    return ValueAt(float(values[k]), float(places.phi[k]), "left" if pieces <= k < 2 * pieces else "right")


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
    return max(p.normalised.peak_acceleration * p.lift / p.angle**2 for p in motion.phases if not isinstance(p, Dwell))


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

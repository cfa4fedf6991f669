"""A whole turn of motion by conditions: parts one behind the other, and dwells in the gaps between them.

The motion is cut where it turns, so that it becomes one of rises, dwells and returns as any other, whose laws are the
pieces of its polynomials.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.boundary_joints import FULL_TURN, SAME_VALUE, joined_turn
from graphcam.given.boundary_parts import Part, SplinePart
from graphcam.given.exact_polynomials import ExactPiece, derivative, pieces_between, sign_changes
from graphcam.given.local_polynomials import LocalPolynomials, cells
from graphcam.given.measured import from_zero
from graphcam.given.motion import Dwell, Motion, Phase, Return, Rise
from graphcam.given.piecewise import Floats, Side
from graphcam.given.polynomial_law import leg_law
from graphcam.words import say

ZERO_DISPLACEMENT = Fraction(1, 1 << 60)
"""A lowest displacement nearer to 0 than this part of the lift is 0, and was rounded."""


@dataclass(frozen=True, eq=False, repr=False)
class BoundaryMotion(Motion):
    """A motion whose parts satisfy conditions; made by :func:`boundary_motion`.

    Attributes
    ----------
    parts : the polynomials and splines, as they were given
    zero : the cam angle [rad] of the parts where this motion's begins: 0, unless the follower moves there
    lowest : the displacement of the parts [mm] at which this motion's is 0
    """

    parts: tuple[Part, ...]
    zero: float
    lowest: float
    joints: Floats
    """(n,) cam angles at which phases begin and polynomials join"""
    _series: LocalPolynomials

    def _told_exactly(self, starts: Floats) -> Floats:
        # The joints are known from the given angles; sums of the phases' angles are off by their rounding.
        return self.joints[np.abs(self.joints - starts[:, None]).argmin(axis=1)]

    def _summary(self) -> str:
        degrees = ", ".join(f"{part.name} of degree {part.highest_power}" for part in self.parts)
        return f"{super()._summary()}, by conditions: {degrees}"

    @property
    def breaks(self) -> Floats:
        """The cam angles where a derivative may jump: where phases begin and where polynomials join."""
        return self.joints

    def _fill(self, turned: Floats, side: Side, out: Floats) -> None:
        # From the given angles themselves: as a fraction of its phase the place within a tiny part keeps few digits.
        self._series.fill(turned, side, out)


def boundary_motion(parts: Sequence[Part]) -> BoundaryMotion:
    """The motion over one turn whose parts satisfy conditions; in the gaps between them the follower dwells.

    Parameters
    ----------
    parts : :class:`PolynomialPart` and :class:`SplinePart` in the order of their angles, from 0 to 2 pi [rad].  Where
        two join, s and v are the same; the acceleration may jump, which is a soft impact

    Raises
    ------
    DesignError : the parts are out of order, do not join, or do not close the turn

    >>> import graphcam as gc
    >>> from math import pi
    >>> low, top = gc.MotionPoint(0, s=0, v=0, a=0), gc.MotionPoint(pi / 2, s=30)
    >>> motion = gc.boundary_motion([gc.PolynomialPart([low, top, gc.MotionPoint(pi, s=0, v=0, a=0)])])
    >>> [phase.kind for phase in motion.phases], round(float(motion(pi / 2)[0]), 12)
    (['rise', 'return', 'dwell'], 30.0)
    """
    given = tuple(parts)
    pieces = joined_turn(given)
    legs = _legs(pieces)
    if len(legs) < 2:
        value = say("at rest at {p:g} over the whole turn", p=float(pieces[0].p[0]))
        raise DesignError("motion", value, say("one with a rise and a return"), say("give different s"))
    # Twice round, so that a leg over the end of the turn is found whole.
    round_ = [*pieces, *(replace(piece, start=piece.start + FULL_TURN) for piece in pieces)]
    phases: list[tuple[float, Phase]] = []
    levels: list[Fraction] = []
    for start, end, sign in legs:
        leg = pieces_between(round_, start, end)
        levels.append(leg[0].at(start))
        phases.append((float(start % FULL_TURN), _phase(given, leg, sign)))
    ordered, zero_ = from_zero(phases)
    zero = _exactly(zero_, [start for start, _, _ in legs]) if abs(zero_) > SAME_VALUE else Fraction(0)
    lowest = min(levels)
    if abs(lowest) <= ZERO_DISPLACEMENT * (max(levels) - lowest):
        lowest = Fraction(0)
    turn = pieces_between(_moved_by_turn(round_, zero), zero, zero + FULL_TURN)
    lowered = [replace(piece, p=(piece.p[0] - lowest, *piece.p[1:])) for piece in turn]
    series = LocalPolynomials([cell for cut in cells(lowered, zero) for cell in cut])
    joints = _apart(
        [float((start - zero) % FULL_TURN) for start, _, _ in legs] + [float(piece.start - zero) for piece in turn]
    )
    return BoundaryMotion(ordered, given, float(zero), float(lowest), joints, series)


def _exactly(zero: float, starts: Sequence[Fraction]) -> Fraction:
    """The one of the places, a turn before or behind if need be, that was rounded to ``zero``."""
    return min(
        (start % FULL_TURN - turns * FULL_TURN for start in starts for turns in (0, 1)),
        key=lambda at: abs(at - Fraction(zero)),
    )


def _apart(places: Sequence[float]) -> Floats:
    """The places from 0 to less than a turn in order; of those that are the same, the first that is given."""
    kept = [0.0, float(FULL_TURN)]
    for place in places:
        if min(abs(place - other) for other in kept) > SAME_VALUE:
            kept.append(place)
    return np.array(sorted(kept)[:-1])


def _legs(pieces: Sequence[ExactPiece]) -> list[tuple[Fraction, Fraction, int]]:
    """Where over one turn the motion rises (+1), rests (0) or falls (-1); the last leg may end behind the turn."""
    found: list[tuple[Fraction, int]] = []
    for piece in pieces:
        sign, places = sign_changes(derivative(piece.p))
        for k, place in enumerate([Fraction(0), *places]):
            now = sign * (-1) ** k
            if not found or found[-1][1] != now:
                found.append((piece.start + piece.width * place, now))
    ends = [*found[1:], (found[0][0] + FULL_TURN, 0)]
    # What moves for less than a place is told from another one is rounding.
    long = [(start, sign) for (start, sign), (end, _) in zip(found, ends, strict=True) if end - start > SAME_VALUE]
    merged = [leg for before, leg in zip([(0, None), *long], long, strict=False) if before[1] != leg[1]]
    if len(merged) > 1 and merged[0][1] == merged[-1][1]:
        del merged[0]
    ends = [*merged[1:], (merged[0][0] + FULL_TURN, 0)]
    return [(start, end, sign) for (start, sign), (end, _) in zip(merged, ends, strict=True)]


def _phase(parts: Sequence[Part], leg: Sequence[ExactPiece], sign: int) -> Phase:
    start, end = leg[0].start, leg[-1].end
    if not sign:
        return Dwell(float(end - start))
    splined = any(
        (part.start < end and part.end > start) or part.start + FULL_TURN < end
        for part in parts
        if isinstance(part, SplinePart)
    )
    lift, law = leg_law("spline" if splined else "polynomial", leg)
    return (Rise if sign > 0 else Return)(abs(float(lift)), float(end - start), law)


def _moved_by_turn(pieces: Sequence[ExactPiece], zero: Fraction) -> list[ExactPiece]:
    """The pieces, moved by a turn if the place lies before them."""
    back = FULL_TURN if zero < pieces[0].start else Fraction(0)
    return [replace(piece, start=piece.start - back) for piece in pieces]

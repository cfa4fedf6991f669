"""A whole turn of motion by conditions: parts one behind the other, and dwells in the gaps between them.

The motion is cut where it turns, so that it becomes one of rises, dwells and returns as any other, whose laws are the
pieces of its polynomials.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphcam.errors import DesignError, check_kind
from graphcam.given.boundary_parts import (
    SAME_VALUE,
    Part,
    PolynomialPart,
    SplinePart,
    dwell_after,
    greatest_lift,
    joined_parts,
    quoted_angle,
)
from graphcam.given.measured import from_zero
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Phase, Return, Rise
from graphcam.given.piecewise import Floats, Side
from graphcam.given.piecewise_polynomial import SAME_LEVEL, SAME_PLACE, PiecewisePolynomial
from graphcam.given.polynomial_law import leg_law
from graphcam.words import say


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
    _series: PiecewisePolynomial

    @property
    def origin(self) -> float:
        """The cam angle [rad] of the parts at which the first phase begins."""
        return self.zero

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "_series", self._series.with_breaks(self.starts))

    def _summary(self) -> str:
        degrees = ", ".join(f"{part.name} of degree {part.highest_power}" for part in self.parts)
        return f"{super()._summary()}, by conditions: {degrees}"

    @property
    def breaks(self) -> Floats:
        """The cam angles where a derivative may jump: where phases begin and where polynomials join."""
        return self._series.breaks

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
    for place, part in enumerate(given):
        check_kind(f"parts[{place}]", part, (PolynomialPart, SplinePart))
    turn = _joined_turn(given)
    runs = turn.runs()
    if len(runs) > 1 and runs[0][1] == runs[-1][1]:
        del runs[0]
    if len(runs) < 2:
        value = say("at rest at {p:g} over the whole turn", p=float(turn.coefficients[0, 0]))
        raise DesignError("motion", value, say("one with a rise and a return"), say("give different s"))
    starts = [start for start, _ in runs]
    ends = [*starts[1:], starts[0] + FULL_TURN]
    for place in (starts[0], *ends):
        turn = turn.at_rest(place)
    # Twice round, so that a leg over the end of the turn is found whole.
    round_ = PiecewisePolynomial.joined([turn, turn.seen(-FULL_TURN)])
    phases = [
        (start % FULL_TURN, _phase(given, round_.between(start, end), sign))
        for (start, sign), end in zip(runs, ends, strict=True)
    ]
    ordered, zero = from_zero(phases)
    if abs(zero) <= SAME_PLACE:
        zero = 0.0
    levels = turn(starts)[0]
    lowest = float(levels.min())
    if abs(lowest) <= SAME_LEVEL * np.ptp(levels):
        lowest = 0.0
    turns = math.floor((zero - turn.ends[0]) / FULL_TURN + SAME_PLACE)
    series = round_.seen(-turns * FULL_TURN).between(zero, zero + FULL_TURN).seen(zero, base=lowest)
    return BoundaryMotion(ordered, given, zero, lowest, series)


def _joined_turn(parts: Sequence[Part]) -> PiecewisePolynomial:
    """The motion of one turn from the first part's beginning on, the gaps filled with rest."""
    if not parts:
        found = say("empty")
        raise DesignError("parts", found, say("one part or more"), say("give what leads the follower up and back"))
    turn = joined_parts(parts)
    begun = float(parts[0].start)
    if not 0 <= begun < FULL_TURN:
        limit = say("from 0 to less than 360 degrees")
        raise DesignError("parts[0].points[0].angle", quoted_angle(begun), limit, say("count the cam angle from 0"))
    _check_closed(parts)
    if float(parts[-1].end) < begun + FULL_TURN - SAME_PLACE:
        turn = PiecewisePolynomial.joined([turn, dwell_after(parts[-1], begun + FULL_TURN)])
    return turn


def _check_closed(parts: Sequence[Part]) -> None:
    first, last, size = parts[0], parts[-1], greatest_lift(parts)
    turn = float(last.end - first.start)
    if turn > FULL_TURN + SAME_PLACE:
        remedy = say("one turn of the cam is 360 degrees: shorten a part")
        limit = say("360 degrees or less from first to last")
        raise DesignError(say("parts (turn)"), quoted_angle(turn), limit, remedy)
    s, v = zip(last.at_ends[1], first.at_ends[0], strict=True)
    if abs(s[1] - s[0]) > SAME_VALUE * size:
        limit = say("{s:.10g}, as the first part begins", s=s[1])
        remedy = say("lead the follower back to where it was a turn before")
        raise DesignError(say("parts (s at their end)"), say("{s:.10g}", s=s[0]), limit, remedy)
    gap = turn < FULL_TURN - SAME_PLACE
    off = max(map(abs, v)) if gap else abs(v[1] - v[0])
    if off > SAME_VALUE * (size + abs(v[0])):
        found = say("{v:.10g}, and {v2:.10g} where they begin", v=v[0], v2=v[1])
        limit = say("0 at both: the follower dwells between them") if gap else say("the same at both")
        raise DesignError(say("parts (v at their end)"), found, limit, say("give v at the first and at the last point"))


def _phase(parts: Sequence[Part], leg: PiecewisePolynomial, sign: int) -> Phase:
    start, end = leg.ends[[0, -1]].tolist()
    if not sign:
        return Dwell(end - start)
    splined = any(
        (part.start < end and part.end > start) or part.start + FULL_TURN < end
        for part in parts
        if isinstance(part, SplinePart)
    )
    lift, law = leg_law("spline" if splined else "polynomial", leg)
    return (Rise if sign > 0 else Return)(abs(lift), end - start, law)

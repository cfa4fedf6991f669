"""Laws of polynomials piece by piece: of a leg of a motion by conditions, of conditions alone, of constant velocity."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np

from graphcam.errors import DesignError, check_kind, check_number
from graphcam.given.boundary_parts import MotionPoint, Part, PolynomialPart, SplinePart, joined_parts
from graphcam.given.motion_law import JUMP_BLEND, Law
from graphcam.given.piecewise_polynomial import PiecewisePolynomial
from graphcam.words import say

CONSTANT_VELOCITY = "constant-velocity"
"""The name of the law of constant velocity with blends."""
USUAL_BLENDS = 0.25, 0.25
"""The parts of a phase that they take where none are given."""
MIDDLE_RANGE = 0.25, 0.75
"""An edge between these is where the law is seen from the other end; else a seam is laid at the middle."""
JUMP = 1e-9
"""A derivative jumps by more than this part of its greatest value."""
MAX_BLEND_ORDER = 3
"""Blends are smooth to this derivative at most: the jerk is continuous."""
MIN_STEADY_SHARE = 1e-6
"""The constant velocity lasts at least this part of the phase."""
MAX_BLOW = 0.001
"""A blend over less than this part of the phase is a blow, whose acceleration is too short and too high to be drawn."""


def leg_law(
    name: str,
    leg: PiecewisePolynomial,
    *,
    trusted: bool = True,
    blows: tuple[float, float] = (0.0, 0.0),
    peaks: tuple[float, float] | None = None,
) -> tuple[float, Law]:
    """The signed lift of what leads from rest to rest, and its normalised law, with its peaks where they are known.

    Those of the first half are series in u, those of the second in 1 - u, so that little lift keeps its digits.
    """
    start, end = leg.ends[[0, -1]].tolist()
    angle = end - start
    low, high = leg([start, end])[0].tolist()
    lift = high - low
    places = leg.breaks
    nearest = places[np.abs(places - (start + end) / 2).argsort()[:1]]
    seamed = not any(MIDDLE_RANGE[0] <= u <= MIDDLE_RANGE[1] for u in (nearest - start) / angle)
    middle = (start + end) / 2 if seamed else float(nearest[0])
    if seamed:
        places = np.sort(np.append(places, middle))
    # Between places where no value jumps the pieces share a formula, so that they are computed together.
    before, after = leg(places, "left"), leg(places)
    size = np.abs([before, after]).max(axis=(0, 2), keepdims=True)[0]
    jumps = (np.abs(after - before) > JUMP * size).any(axis=0) | (places == middle)
    cuts = [start, *places[jumps].tolist(), end]
    shared = [
        leg.between(*cut).seen(start, angle, low, lift)
        if cut[1] <= middle
        else leg.between(*cut).seen(end, -angle, high, -lift)
        for cut in pairwise(cuts)
    ]
    formulas = [shared[k] for k in np.cumsum([0, *jumps]).tolist()]
    edges, middle_edge = ((places - start) / angle).tolist(), (middle - start) / angle
    seams = (middle_edge,) if seamed else ()
    law = Law(name, formulas, edges, middle=middle_edge, peaks=peaks, trusted=trusted, seams=seams, blows=blows)
    return lift, law


def boundary_law(parts: Sequence[Part] | Sequence[MotionPoint], name: str = "by conditions") -> Law:
    """The normalised law of conditions: a rise, or a return, from rest to rest, over any angle and by any lift.

    Parameters
    ----------
    parts : :class:`PolynomialPart` and :class:`SplinePart` one behind the other; or points, of one polynomial
    name : what the law is called on the sheet

    Raises
    ------
    DesignError : the parts do not join, or they make no law: it does not lead from rest to rest, or turns on its way

    >>> import graphcam as gc
    >>> start, end = gc.MotionPoint(0, s=0, v=0, a=0, j=0), gc.MotionPoint(1, s=1, v=0, a=0, j=0)
    >>> round(gc.boundary_law([start, end], "4-5-6-7").peak_velocity, 12)
    2.1875
    """
    given = tuple(parts)
    for k, part in enumerate(given):
        remedy = say("the points come first, the name behind them")
        check_kind(f"parts[{k}]", part, (MotionPoint, PolynomialPart, SplinePart), remedy=remedy)
    points = [part for part in given if isinstance(part, MotionPoint)]
    if points:
        if len(points) < len(given):
            found = say("points and parts")
            raise DesignError("parts", found, say("points of one polynomial, or parts"), say("give one of the two"))
        given = (PolynomialPart(points),)
    made = tuple(part for part in given if not isinstance(part, MotionPoint))
    if not made:
        raise DesignError("parts", say("empty"), say("one part or more"))
    leg = joined_parts(made)
    if made[0].at_ends[0][0] == made[-1].at_ends[1][0]:
        limit = say("that of a rise or a return")
        remedy = say("what comes back to where it was is a motion: gc.boundary_motion")
        raise DesignError(say("lift of the law '{name}'", name=name), 0, limit, remedy)
    return leg_law(name, leg, trusted=False)[1]


MAX_BLEND = float(np.nextafter(1, 0))
"""The largest part of a phase that a blend may take: it leaves something."""


@lru_cache(maxsize=64)  # so that phases of the same law share their formulas and are computed together
def constant_velocity_law(start: float = USUAL_BLENDS[0], end: float = USUAL_BLENDS[1], smooth: int = 2) -> Law:
    """The law of constant velocity between two blends, which lead from rest to it and back to rest.

    The velocity of a blend is the polynomial of lowest degree with ``smooth - 1`` derivatives that are zero at both of
    its ends: a line with 1, 3 x^2 - 2 x^3 with 2, 10 x^3 - 15 x^4 + 6 x^5 with 3.  Its mean is half the constant
    velocity V, so V = 2/(2 - start - end).  Sources: H. A. Rothbart, *Cams* (1956), chapter 2; R. L. Norton, *Cam
    Design and Manufacturing Handbook* (2009), section 4.6.

    Parameters
    ----------
    start, end : fractions of the phase that the first and the last blend take, together less than 1; of 0 the velocity
        jumps, which is the uniform velocity of the textbooks
    smooth : the order of the highest continuous derivative of the lift: 1 velocity, 2 acceleration, 3 jerk

    Raises
    ------
    DesignError : a blend is negative, they leave nothing between them, or there are no such blends

    >>> import graphcam as gc
    >>> gc.constant_velocity_law(0.25, 0.25).at(0.5)
    [0.5, 1.3333333333333333, 0.0, 0.0]
    """
    for place, part in enumerate((start, end)):
        remedy = say("give the fraction of the phase that the blend takes")
        check_number(
            f"blends[{place}]", part, say("from 0 to less than 1"), remedy, least=0, most=float(np.nextafter(1, 0))
        )
    if not 1 - (start + end) >= MIN_STEADY_SHARE:
        remedy = say("shorten them: the constant velocity takes what they leave")
        found = say("{start:g} and {end:g}", start=start, end=end)
        raise DesignError("blends", found, say("less than 1 together"), remedy)
    if smooth not in range(1, MAX_BLEND_ORDER + 1):
        limit = say("1 (velocity), 2 (acceleration) or {smoothest} (jerk continuous)", smoothest=MAX_BLEND_ORDER)
        raise DesignError("smooth", smooth, limit)
    start, end = max(start, JUMP_BLEND), max(end, JUMP_BLEND)
    v = 2 / (2 - start - end)
    velocity = (0, 1), (0, 0, 3, -2), (0, 0, 0, 10, -15, 6)
    # The lift of a blend over its length: the integral of its velocity, 1/2 at the end.
    blend = PiecewisePolynomial.of(velocity[smooth - 1], 0.0, 1.0).integral()
    up = blend.seen(0.0, 1 / start, 0.0, 1 / (v * start))
    line = PiecewisePolynomial.of([v * start / 2, v], start, 1 - end)
    back = blend.seen(1 / end, -1 / end, 1 / (v * end), -1 / (v * end))
    blows = (start if start < MAX_BLOW else 0.0, end if end < MAX_BLOW else 0.0)
    # Every blend is steepest in its middle; of a series there the digits that cancel would add to the velocity.
    peaks = v, v * (1.0, 1.5, 1.875)[smooth - 1] / min(start, end)
    return leg_law(CONSTANT_VELOCITY, PiecewisePolynomial.joined([up, line, back]), blows=blows, peaks=peaks)[1]

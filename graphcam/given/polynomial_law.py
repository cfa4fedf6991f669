"""Laws of exact polynomials: of a leg of a motion by conditions, of conditions alone, of constant velocity."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

from graphcam.errors import DesignError, check_kind
from graphcam.given.boundary_joints import check_joint, greatest_lift
from graphcam.given.boundary_parts import MotionPoint, Part, PolynomialPart, SplinePart
from graphcam.given.exact_polynomials import ExactPiece, pieces_between, rounded_terms, shortest
from graphcam.given.local_polynomials import LocalPolynomials, cells
from graphcam.given.motion_law import Law
from graphcam.words import say

CONSTANT_VELOCITY = "constant-velocity"
"""The name of the law of constant velocity with blends."""
HALF = Fraction(1, 2)
MIDDLE_RANGE = Fraction(1, 4), Fraction(3, 4)
"""An edge between these is where the law is seen from the other end; else a seam is laid at the middle."""
MIN_PIECE_SHARE = Fraction(1, 10**9)
"""A piece shorter than this part of a leg is rounding."""
MAX_BLEND_ORDER = 3
"""Blends are smooth to this derivative at most: the jerk is continuous."""
MIN_BLEND_SHARE = 1e-6
"""A blend shorter than this part of the phase is a blow."""


def leg_law(name: str, pieces: Sequence[ExactPiece], *, trusted: bool = True) -> tuple[Fraction, Law]:
    """The signed lift of pieces that lead from rest to rest, and their normalised law.

    Those of the first half are series in u, those of the second in 1 - u, so that little lift keeps its digits.
    """
    pieces = _without_slivers(pieces)
    start, angle = pieces[0].start, pieces[-1].end - pieces[0].start
    low, high = pieces[0].at(start), pieces[-1].at(start + angle)
    lift = high - low
    unit = [_scaled_piece(piece, start, angle, low, lift) for piece in pieces]
    inner = [piece.start for piece in unit[1:]]
    middle = min(inner, key=lambda u: abs(u - HALF), default=Fraction(0))
    seams: tuple[float, ...] = ()
    if not MIDDLE_RANGE[0] <= middle <= MIDDLE_RANGE[1]:
        middle, seams = HALF, (0.5,)
        unit = pieces_between(unit, Fraction(0), HALF) + pieces_between(unit, HALF, Fraction(1))
    first = [piece for piece in unit if piece.end <= middle]
    # Seen from the end: what is missing of 1.
    second = [ExactPiece(each.start, each.width, (each.p[0] - 1, *each.p[1:])) for each in unit if each.end > middle]
    one = Fraction(1)
    formulas = [LocalPolynomials(each) for each in cells(first)]
    formulas += [LocalPolynomials(each) for each in cells(second, one, ahead=False)]
    edges = [float(piece.start) for piece in unit[1:]]
    law = Law(name, formulas, edges, middle=float(middle), trusted=trusted, seams=seams)
    return lift, law


def _without_slivers(pieces: Sequence[ExactPiece]) -> list[ExactPiece]:
    """The pieces, those stretched over which a turning beside a joint leaves a sliver."""
    start, end = pieces[0].start, pieces[-1].end
    kept = [piece for piece in pieces if piece.width > MIN_PIECE_SHARE * (end - start)]
    cuts = [start, *(piece.start for piece in kept[1:]), end]
    return [
        piece
        if (low, high) == (piece.start, piece.end)
        else ExactPiece(low, high - low, rounded_terms(piece.coefficients_about(low, high - low)))
        for piece, (low, high) in zip(kept, pairwise(cuts), strict=True)
    ]


def _scaled_piece(piece: ExactPiece, start: Fraction, angle: Fraction, low: Fraction, lift: Fraction) -> ExactPiece:
    p = ((piece.p[0] - low) / lift, *(c / lift for c in piece.p[1:]))
    return ExactPiece((piece.start - start) / angle, piece.width / angle, rounded_terms(p))


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
    pieces = [piece for part in made for piece in part.pieces]
    for k, part in enumerate(made[1:], 1):
        check_joint(made[k - 1], part, k, greatest_lift(made))
    if pieces[0].at(pieces[0].start) == pieces[-1].at(pieces[-1].end):
        limit = say("that of a rise or a return")
        remedy = say("what comes back to where it was is a motion: gc.boundary_motion")
        raise DesignError(say("lift of the law '{name}'", name=name), 0, limit, remedy)
    return leg_law(name, pieces, trusted=False)[1]


@lru_cache(maxsize=64)  # so that phases of the same law share their formulas and are computed together
def constant_velocity_law(start: float = 0.25, end: float = 0.25, smooth: int = 2) -> Law:
    """The law of constant velocity between two blends, which lead from rest to it and back to rest.

    The velocity of a blend is the polynomial of lowest degree with ``smooth - 1`` derivatives that are zero at both of
    its ends: a line with 1, 3 x^2 - 2 x^3 with 2, 10 x^3 - 15 x^4 + 6 x^5 with 3.  Its mean is half the constant
    velocity V, so V = 2/(2 - start - end).  Sources: H. A. Rothbart, *Cams* (1956), chapter 2; R. L. Norton, *Cam
    Design and Manufacturing Handbook* (2009), section 4.6.

    Parameters
    ----------
    start, end : fractions of the phase that the first and the last blend take, together less than 1
    smooth : the order of the highest continuous derivative of the lift: 1 velocity, 2 acceleration, 3 jerk

    Raises
    ------
    DesignError : a blend is too short, they leave nothing between them, or there are no such blends

    >>> import graphcam as gc
    >>> gc.constant_velocity_law(0.25, 0.25).at(0.5)
    [0.5, 1.3333333333333333, 0.0, 0.0]
    """
    for place, part in enumerate((start, end)):
        if not MIN_BLEND_SHARE <= part < 1:
            remedy = say("give the fraction of the phase that the blend takes")
            raise DesignError(
                f"blends[{place}]", part, say("from {least:g} to less than 1", least=MIN_BLEND_SHARE), remedy
            )
    first, last = shortest(float(start)), shortest(float(end))
    if not 1 - first - last >= Fraction(MIN_BLEND_SHARE):
        remedy = say("shorten them: the constant velocity takes what they leave")
        found = say("{start:g} and {end:g}", start=start, end=end)
        raise DesignError("blends", found, say("less than 1 together"), remedy)
    if smooth not in range(1, MAX_BLEND_ORDER + 1):
        limit = say("1 (velocity), 2 (acceleration) or {smoothest} (jerk continuous)", smoothest=MAX_BLEND_ORDER)
        raise DesignError("smooth", smooth, limit)
    v = 2 / (2 - first - last)
    # Of the lift of a blend, over its length: the integral of its velocity, 1/2 at the end.
    velocity = {1: (0, 1), 2: (0, 0, 3, -2), 3: (0, 0, 0, 10, -15, 6)}[smooth]
    blend = (Fraction(0), *(Fraction(c, k) for k, c in enumerate(velocity, 1)))
    up = tuple(c * v * first for c in blend)
    back = ExactPiece(Fraction(0), Fraction(1), tuple(-c * v * last for c in blend)).coefficients_about(
        Fraction(1), Fraction(-1)
    )
    pieces = [
        ExactPiece(Fraction(0), first, up),
        ExactPiece(first, 1 - first - last, (v * first / 2, v * (1 - first - last))),
        ExactPiece(1 - last, last, (1 + back[0], *back[1:])),
    ]
    return leg_law(CONSTANT_VELOCITY, pieces)[1]

"""Parts of a motion one behind the other: whether they join, and the turn that they make with dwells between them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from graphcam.errors import DesignError
from graphcam.given.boundary_parts import Part, quoted_angle
from graphcam.given.exact_polynomials import PI, ExactPiece, sampled_values
from graphcam.words import say

FULL_TURN = 2 * PI
SAME_VALUE = Fraction(1, 10**9)
"""Cam angles nearer to one another [rad], displacements and velocities (beside the greatest) are the same."""


def check_joint(before: Part, after: Part, number: int, size: Fraction) -> None:
    """Check that a part begins where, and as fast as, the one before ends; with a gap between, the motion rests there.

    number : of the part that begins;  size : the greatest lift, and what a velocity is compared with per radian

    Raises
    ------
    DesignError : it does not
    """
    end, start = before.pieces[-1], after.pieces[0]
    where = quoted_angle(float(start.start))
    if start.start < end.end - SAME_VALUE:
        limit = say("{told} or more, where the part before ends", told=quoted_angle(float(end.end)))
        raise DesignError(f"parts[{number}].points[0].angle", where, limit, say("give the parts in order"))
    s, v = ((end.at(end.end, order), start.at(start.start, order)) for order in (0, 1))
    if start.start > end.end + SAME_VALUE:
        _check_gap(number, f"from {quoted_angle(float(end.end))} to {where}", s, v, size)
        return
    if abs(s[1] - s[0]) > SAME_VALUE * size:
        limit = say("{s:.10g}, as the part before ends", s=float(s[0]))
        quantity = say("parts[{number}] (s where it begins)", number=number)
        raise DesignError(quantity, say("{s:.10g}", s=float(s[1])), limit, say("give one s at {where}", where=where))
    if abs(v[1] - v[0]) > SAME_VALUE * (size + abs(v[0])):
        limit = say("{v:.10g}, as the part before ends", v=float(v[0]))
        remedy = say("give v, the same in both, at {where}", where=where)
        quantity = say("parts[{number}] (v where it begins)", number=number)
        raise DesignError(quantity, say("{v:.10g}", v=float(v[1])), limit, remedy)


def _check_gap(
    number: int, where: str, s: tuple[Fraction, Fraction], v: tuple[Fraction, Fraction], size: Fraction
) -> None:
    if abs(s[1] - s[0]) > SAME_VALUE * size:
        found = say("{s:.10g} and {s2:.10g}", s=float(s[0]), s2=float(s[1]))
        limit = say("equal: the follower dwells {where}", where=where)
        quantity = say("parts[{number}] (s before it)", number=number)
        raise DesignError(quantity, found, limit, say("give a part that leads from one to the other"))
    if max(map(abs, v)) > SAME_VALUE * size:
        found = say("{v:.10g} and {v2:.10g}", v=float(v[0]), v2=float(v[1]))
        limit = say("0: the follower dwells {where}", where=where)
        quantity = say("parts[{number}] (v before it)", number=number)
        raise DesignError(quantity, found, limit, say("give v = 0 there, or a part that fills the gap"))


def greatest_lift(parts: Sequence[Part]) -> Fraction:
    """The difference of the displacements at some places of every piece; 0 only if no piece moves."""
    values = [s for part in parts for piece in part.pieces for s in sampled_values(piece.p)]
    return max(values) - min(values)


def joined_turn(parts: Sequence[Part]) -> list[ExactPiece]:
    """The pieces of one turn from the first part's beginning on, the gaps filled with rest.

    Raises
    ------
    DesignError : the parts do not join, or do not close the turn
    """
    if not parts:
        found = say("empty")
        raise DesignError("parts", found, say("one part or more"), say("give what leads the follower up and back"))
    size = greatest_lift(parts)
    for k, (before, after) in enumerate(pairwise(parts), 1):
        check_joint(before, after, k, size)
    begun, ended = parts[0].start, parts[-1].end
    if not 0 <= begun < FULL_TURN:
        limit = say("from 0 to less than 360 degrees")
        raise DesignError(
            "parts[0].points[0].angle", quoted_angle(float(begun)), limit, say("count the cam angle from 0")
        )
    _check_closed(parts, size)
    pieces: list[ExactPiece] = []
    for part in parts:
        if pieces and part.start > pieces[-1].end + SAME_VALUE:
            pieces.append(_dwell_piece(pieces[-1], part.start))
        pieces += part.pieces
    if ended < begun + FULL_TURN - SAME_VALUE:
        pieces.append(_dwell_piece(pieces[-1], begun + FULL_TURN))
    return pieces


def _dwell_piece(before: ExactPiece, end: Fraction) -> ExactPiece:
    return ExactPiece(before.end, end - before.end, (before.at(before.end),))


def _check_closed(parts: Sequence[Part], size: Fraction) -> None:
    first, last = parts[0].pieces[0], parts[-1].pieces[-1]
    turn = last.end - first.start
    if turn > FULL_TURN + SAME_VALUE:
        remedy = say("one turn of the cam is 360 degrees: shorten a part")
        raise DesignError(
            say("parts (turn)"), quoted_angle(float(turn)), say("360 degrees or less from first to last"), remedy
        )
    s, v = ((last.at(last.end, order), first.at(first.start, order)) for order in (0, 1))
    if abs(s[1] - s[0]) > SAME_VALUE * size:
        limit = say("{s:.10g}, as the first part begins", s=float(s[1]))
        remedy = say("lead the follower back to where it was a turn before")
        raise DesignError(say("parts (s at their end)"), say("{s:.10g}", s=float(s[0])), limit, remedy)
    gap = turn < FULL_TURN - SAME_VALUE
    off = max(map(abs, v)) if gap else abs(v[1] - v[0])
    if off > SAME_VALUE * (size + abs(v[0])):
        found = say("{v:.10g}, and {v2:.10g} where they begin", v=float(v[0]), v2=float(v[1]))
        limit = say("0 at both: the follower dwells between them") if gap else say("the same at both")
        raise DesignError(say("parts (v at their end)"), found, limit, say("give v at the first and at the last point"))

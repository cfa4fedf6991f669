"""Parts of a motion one behind the other: whether they join, and what they make with dwells between them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.boundary_parts import Part, quoted_angle
from graphcam.given.piecewise_polynomial import SAME_PLACE, PiecewisePolynomial
from graphcam.words import say

SAME_VALUE = 1e-9
"""Displacements and velocities nearer to one another, beside the greatest, are the same."""


def joined_parts(parts: Sequence[Part]) -> PiecewisePolynomial:
    """The motion of parts, the gaps between them filled with rest.

    Raises
    ------
    DesignError : a part does not begin where, and as fast as, the one before ends; or the motion does not rest in a gap
    """
    size = greatest_lift(parts)
    found = [parts[0].polynomials]
    for number, (before, after) in enumerate(pairwise(parts), 1):
        _check_joint(before, after, number, size)
        if after.start - before.end > SAME_PLACE:
            found.append(dwell_after(before, float(after.start)))
        found.append(after.polynomials)
    return PiecewisePolynomial.joined(found)


def dwell_after(before: Part, end: float) -> PiecewisePolynomial:
    """The rest from the end of a part on."""
    return PiecewisePolynomial.of([before.at_ends[1][0]], float(before.end), end)


def greatest_lift(parts: Sequence[Part]) -> float:
    """The difference of the displacements at some places of every part; 0 only if none moves."""
    values = np.concatenate(
        [
            part.polynomials(np.linspace(float(part.start), float(part.end), 2 * part.highest_power + 3))[0]
            for part in parts
        ]
    )
    return float(np.ptp(values))


def _check_joint(before: Part, after: Part, number: int, size: float) -> None:
    """Check that a part begins where, and as fast as, the one before ends; with a gap between, the motion rests there.

    number : of the part that begins;  size : the greatest lift, and what a velocity is compared with per radian
    """
    start, end = float(after.start), float(before.end)
    where = quoted_angle(start)
    if start < end - SAME_PLACE:
        limit = say("{told} or more, where the part before ends", told=quoted_angle(end))
        raise DesignError(f"parts[{number}].points[0].angle", where, limit, say("give the parts in order"))
    s, v = zip(before.at_ends[1], after.at_ends[0], strict=True)
    if start > end + SAME_PLACE:
        _check_gap(number, f"from {quoted_angle(end)} to {where}", s, v, size)
        return
    if abs(s[1] - s[0]) > SAME_VALUE * size:
        limit = say("{s:.10g}, as the part before ends", s=s[0])
        quantity = say("parts[{number}] (s where it begins)", number=number)
        raise DesignError(quantity, say("{s:.10g}", s=s[1]), limit, say("give one s at {where}", where=where))
    if abs(v[1] - v[0]) > SAME_VALUE * (size + abs(v[0])):
        limit = say("{v:.10g}, as the part before ends", v=v[0])
        remedy = say("give v, the same in both, at {where}", where=where)
        quantity = say("parts[{number}] (v where it begins)", number=number)
        raise DesignError(quantity, say("{v:.10g}", v=v[1]), limit, remedy)


def _check_gap(number: int, where: str, s: tuple[float, ...], v: tuple[float, ...], size: float) -> None:
    if abs(s[1] - s[0]) > SAME_VALUE * size:
        found = say("{s:.10g} and {s2:.10g}", s=s[0], s2=s[1])
        limit = say("equal: the follower dwells {where}", where=where)
        quantity = say("parts[{number}] (s before it)", number=number)
        raise DesignError(quantity, found, limit, say("give a part that leads from one to the other"))
    if max(map(abs, v)) > SAME_VALUE * size:
        found = say("{v:.10g} and {v2:.10g}", v=v[0], v2=v[1])
        limit = say("0: the follower dwells {where}", where=where)
        quantity = say("parts[{number}] (v before it)", number=number)
        raise DesignError(quantity, found, limit, say("give v = 0 there, or a part that fills the gap"))

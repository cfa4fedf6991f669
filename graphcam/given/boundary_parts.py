"""Parts of a motion by conditions: polynomials and splines through points with given s, v, a, j.

What is asked for at the points is as many linear equations for the coefficients, solved in rational numbers.  Sources:
R. L. Norton, *Cam Design and Manufacturing Handbook* (2009), chapters 4 and 5; C. de Boor, *A Practical Guide to
Splines* (rev. ed., 2001), chapters IX and XIII.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import ClassVar

import numpy as np

from graphcam.errors import DesignError, check_number
from graphcam.given.exact_conditions import PI, Condition, Span, as_series, shortest, solve_conditions, value_at
from graphcam.given.piecewise_polynomial import SAME_PLACE, PiecewisePolynomial
from graphcam.words import Caption, say

MAX_DEGREE = 31
"""The maximum degree of a polynomial."""
SPLINE_DEGREES = 2, 9
"""Degrees of a spline: from 2 on its velocity is continuous; of a high degree it swings as a polynomial does."""
MAX_POINTS = 100
"""The maximum number of points of a part."""
LAST_DIGITS_EFFECT = 1e-9
"""How far the last digits of the given numbers may change a part, as a part of its maximum displacement."""
MAX_TURNINGS = 2
"""How often a part may turn between neighbouring points."""
MAX_OVERSHOOT = 0.5
"""How far a part may pass two neighbouring points, as a part of the span of the given displacements."""


DERIVATIVE_NAMES = "s", "v", "a", "j"


@dataclass(frozen=True)
class MotionPoint:
    """Conditions on a motion at one cam angle; values that are omitted are free there.

    Parameters
    ----------
    angle : the cam angle [rad], of a law the fraction of the phase; within rounding of a round number of degrees it is
        that number
    s, v, a, j : displacement [mm; of an arm rad] and its derivatives by the angle in radians

    Raises
    ------
    DesignError : a number is not finite, or nothing is asked

    >>> import graphcam as gc
    >>> gc.MotionPoint(0.5, s=10, v=0).given
    {0: 10, 1: 0}
    """

    angle: float
    s: float | None = None
    v: float | None = None
    a: float | None = None
    j: float | None = None

    def __post_init__(self) -> None:
        for name in ("angle", *DERIVATIVE_NAMES):
            number = getattr(self, name)
            if number is not None:
                check_number(name, number, say("a finite number"))
        if not self.given:
            remedy = say("give s, v, a or j there, or leave the point out")
            found = say("missing at {told}", told=quoted_angle(self.angle))
            raise DesignError("s", found, say("given with v, a or j, or one of these"), remedy)

    @property
    def place(self) -> Fraction:
        """The cam angle [rad], exact where it is a round one in radians or in degrees."""
        return exact_angle(self.angle)

    @property
    def given(self) -> dict[int, float]:
        """What is asked, by the order of the derivative."""
        values = (getattr(self, name) for name in DERIVATIVE_NAMES)
        return {order: number for order, number in enumerate(values) if number is not None}


def exact_angle(angle: float) -> Fraction:
    """A cam angle [rad]: exact where it is round in radians, or within rounding of what is round in degrees.

    >>> exact_angle(0.25), exact_angle(math.pi / 2) == PI / 2
    (Fraction(1, 4), True)
    """
    plain = shortest(angle)
    if plain != Fraction(angle) or plain.denominator <= 1024:
        return plain
    degrees = shortest(round(math.degrees(angle), 12))
    if abs(math.radians(float(degrees)) - angle) <= math.ulp(angle):
        return degrees * PI / 180
    return plain


def quoted_angle(angle: float) -> Caption:
    """A cam angle in the words of a message.

    >>> print(quoted_angle(math.pi))
    180 degrees
    """
    return say("{degrees:.10g} degrees", degrees=math.degrees(angle))


class _Part:
    """What polynomials and splines have in common."""

    points: Sequence[MotionPoint]

    def _check_points(self) -> None:
        points = tuple(self.points)
        object.__setattr__(self, "points", points)
        if not 2 <= len(points) <= MAX_POINTS:
            limit = say("2 to {most} points", most=MAX_POINTS)
            raise DesignError("points", len(points), limit, say("a part leads from one to another"))
        for k, (before, after) in enumerate(pairwise(points), 1):
            if not after.place > before.place:
                limit = say("greater than {told}, the angle of the point before", told=quoted_angle(before.angle))
                remedy = say("sort the points by the angle, and give each one once")
                raise DesignError(f"points[{k}].angle", quoted_angle(after.angle), limit, remedy)

    @cached_property
    def start(self) -> Fraction:
        return self.points[0].place

    @cached_property
    def end(self) -> Fraction:
        return self.points[-1].place

    @property
    def highest_power(self) -> int:
        return max(len(p) for _, _, p in self.solution) - 1

    @property
    def _count(self) -> int:
        return sum(len(point.given) for point in self.points)

    @property
    def _conditions(self) -> list[Condition]:
        """What is given, over the part from 0 to 1."""
        width = self.end - self.start
        return [
            ((point.place - self.start) / width, order, shortest(number) * width**order)
            for point in self.points
            for order, number in point.given.items()
        ]

    @cached_property
    def solution(self) -> list[Span]:
        """The polynomials that meet the conditions, over the part from 0 to 1."""
        return self._solved(self._conditions)

    def _solved(self, conditions: Sequence[Condition]) -> list[Span]:
        found = solve_conditions(self._order, self._inner_knots([place for place, _, _ in conditions]), conditions)
        if found is None:
            raise self._open()
        return found

    @property
    def _order(self) -> int:
        raise NotImplementedError

    def _inner_knots(self, places: Sequence[Fraction]) -> list[Fraction]:
        raise NotImplementedError

    @cached_property
    def polynomials(self) -> PiecewisePolynomial:
        """The part as a function of the cam angle."""
        width = self.end - self.start
        rests = [(point.place - self.start) / width for point in self.points if point.v == 0]
        return as_series(self.solution, self.start, width, rests)

    @cached_property
    def at_ends(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """s and v at the start and at the end."""

        def s_and_v(span: Span, y: int) -> tuple[float, float]:
            low, high, p = span
            width = (high - low) * (self.end - self.start)
            return float(value_at(p, Fraction(y))), float(value_at(p, Fraction(y), 1) / width)

        return s_and_v(self.solution[0], 0), s_and_v(self.solution[-1], 1)

    def _open(self) -> DesignError:
        if all(point.s is None for point in self.points):
            found = say("without any s")
            return DesignError("points", found, say("points of which one gives s"), say("say how high the motion is"))
        limit = say("conditions that determine the part: some of these leave it open or contradict each other")
        remedy = say("give s where only v, a or j is given")
        found = say("{count} conditions that depend on each other", count=self._count)
        return DesignError("points", found, limit, remedy)

    def _check_last_digits(self) -> None:
        """Refuse what the last digits of the given numbers decide."""
        nudged = self._solved([_nudged(k, *condition) for k, condition in enumerate(self._conditions)])
        both = np.array(
            [
                [[float(value_at(p, Fraction(k, len(p)))) for k in range(len(p) + 1)] for p in (here, there)]
                for (_, _, here), (_, _, there) in zip(self.solution, nudged, strict=True)
            ]
        )
        off = np.abs(both[:, 1] - both[:, 0]).max()
        if off > LAST_DIGITS_EFFECT * np.abs(both[:, 0]).max():
            found = say("decided by the last digits of the numbers: s changes by {off:.3g} with them", off=off)
            remedy = say("move the points apart, or give fewer conditions")
            limit = say("conditions that keep s to {last_digits:g} of its maximum", last_digits=LAST_DIGITS_EFFECT)
            raise DesignError("points", found, limit, remedy)

    def _check_swings(self) -> None:
        turns = self.polynomials.turnings()
        given = [point.s for point in self.points if point.s is not None]
        span, beside = max(given) - min(given) if given else 0.0, SAME_PLACE * float(self.end - self.start)
        for k, (before, after) in enumerate(pairwise(self.points)):
            # At a point with v = 0 the sign may change beside it, by rounding.
            between = [x for x in turns if float(before.place) + beside < x < float(after.place) - beside]
            where = say("between {told} and {told2}", told=quoted_angle(before.angle), told2=quoted_angle(after.angle))
            remedy = say("give a point there or fewer conditions, take a spline, or part the motion")
            if len(between) > MAX_TURNINGS:
                value_ = say("{between} {where}", between=len(between), where=where)
                quantity = say("points[{k}] (turns behind it)", k=k)
                raise DesignError(quantity, value_, say("at most {most}; the part swings", most=MAX_TURNINGS), remedy)
            if before.s is None or after.s is None or not span:
                continue
            least, most = min(before.s, after.s) - MAX_OVERSHOOT * span, max(before.s, after.s) + MAX_OVERSHOOT * span
            for s in self.polynomials(between)[0].tolist():
                if not least <= s <= most:
                    limit = say("from {least:.6g} to {most:.6g}; the part swings", least=least, most=most)
                    quantity = say("points[{k}] (s behind it)", k=k)
                    raise DesignError(quantity, say("{s:.6g} {where}", s=s, where=where), limit, remedy)


@dataclass(frozen=True)
class PolynomialPart(_Part):
    """A part of a motion: the polynomial that meets all conditions of its points.

    Parameters
    ----------
    points : two or more in the order of their angles; the part leads from the first to the last
    degree : one less than the number of conditions; None takes this degree, a given number is checked

    Raises
    ------
    DesignError : the points are out of order, the conditions too many, too few, or they determine no polynomial; it
        swings, or the last digits of the numbers decide it

    >>> import graphcam as gc
    >>> rise = gc.PolynomialPart([gc.MotionPoint(0, s=0, v=0, a=0), gc.MotionPoint(1, s=1, v=0, a=0)])
    >>> [int(c) for c in rise.solution[0][2]]
    [0, 0, 0, 10, -15, 6]
    """

    points: Sequence[MotionPoint]
    degree: int | None = None
    name: ClassVar[str] = "polynomial"

    def __post_init__(self) -> None:
        self._check_points()
        degree = self._count - 1
        if degree > MAX_DEGREE:
            limit = say("at most {value}, for a degree of {most}", value=MAX_DEGREE + 1, most=MAX_DEGREE)
            found = say("{value} conditions", value=degree + 1)
            raise DesignError("points", found, limit, say("give fewer, or take a spline"))
        if self.degree is not None and self.degree != degree:
            limit = say("{degree}, one less than the {value} conditions", degree=degree, value=degree + 1)
            remedy = say("they are too many: leave the degree out, or change them")
            if self.degree > degree:
                remedy = say("they are too few: leave the degree out, or change them")
            raise DesignError("degree", self.degree, limit, remedy)
        self._check_last_digits()
        self._check_swings()

    @property
    def _order(self) -> int:
        return self._count - 1

    def _inner_knots(self, places: Sequence[Fraction]) -> list[Fraction]:
        return []


@dataclass(frozen=True)
class SplinePart(_Part):
    """A part of a motion: the B-spline of a degree that meets all conditions of its points.

    With n conditions a spline of degree p has n - p - 1 inner knots.  By default each is the mean of p neighbouring
    places of conditions, so that every B-spline has its own; moving them shifts the peaks of the acceleration.

    Parameters
    ----------
    points : two or more in the order of their angles; the part leads from the first to the last
    degree : 2 to 9; all derivatives below it are continuous at the knots, where the pieces join
    knots : the angles [rad] of the inner knots; if None, they are chosen

    Raises
    ------
    DesignError : as for a polynomial; or there are too few or too many knots, or some B-spline is left without a point

    >>> import graphcam as gc
    >>> points = [gc.MotionPoint(0, s=0, v=0, a=0), gc.MotionPoint(0.5, s=0.4), gc.MotionPoint(1, s=1, v=0, a=0)]
    >>> len(gc.SplinePart(points, degree=4).solution)
    3
    """

    points: Sequence[MotionPoint]
    degree: int = 5
    knots: Sequence[float] | None = None
    name: ClassVar[str] = "spline"

    def __post_init__(self) -> None:
        self._check_points()
        least, most = SPLINE_DEGREES
        if not least <= self.degree <= most:
            limit = say("from {least} to {most}", least=least, most=most)
            raise DesignError("degree", self.degree, limit, say("take 5 for a jerk without jumps"))
        inner = self._count - self.degree - 1
        if inner < 0:
            limit = say("{value} or more for a degree of {degree}", value=self.degree + 1, degree=self.degree)
            remedy = say("give more points or conditions, or a lower degree")
            raise DesignError("points", say("{count} conditions", count=self._count), limit, remedy)
        if self.knots is not None:
            self._check_knots(tuple(self.knots), inner)
        self._check_last_digits()
        self._check_swings()

    def _check_knots(self, knots: tuple[float, ...], inner: int) -> None:
        object.__setattr__(self, "knots", knots)
        if len(knots) != inner:
            limit = say(
                "{inner}, one for each of {count} conditions but the degree and one", inner=inner, count=self._count
            )
            raise DesignError("knots", len(knots), limit, say("leave them out to have them chosen"))
        ends = self.points[0].angle, *knots, self.points[-1].angle
        for k, (before, after) in enumerate(pairwise(ends)):
            if not after > before:
                limit = say("greater than {told}, the one before, and inside the part", told=quoted_angle(before))
                raise DesignError(
                    f"knots[{min(k, inner - 1)}]", quoted_angle(after), limit, say("sort them by the angle")
                )

    @property
    def _order(self) -> int:
        return self.degree

    def _inner_knots(self, places: Sequence[Fraction]) -> list[Fraction]:
        if self.knots is None:
            p = self.degree
            return [sum(places[k + 1 : k + p + 1], Fraction(0)) / p for k in range(len(places) - p - 1)]
        width = self.end - self.start
        return [(exact_angle(knot) - self.start) / width for knot in self.knots]


Part = PolynomialPart | SplinePart


def _nudged(k: int, place: Fraction, order: int, right: Fraction) -> Condition:
    """A condition with other last digits."""
    off = Fraction(1 if k % 2 else -1, 1 << 52)
    moved_place = place if place in (0, 1) else place * (1 + off)
    return moved_place, order, right * (1 - off)


# --- parts one behind the other --------------------------------------------------------------------------------------

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

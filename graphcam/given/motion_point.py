"""Conditions of a motion at one cam angle."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from graphcam.errors import DesignError, check_number
from graphcam.given.exact_polynomials import PI, shortest
from graphcam.words import Caption, say

ORDERS = "s", "v", "a", "j"


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
        for name in ("angle", *ORDERS):
            number = getattr(self, name)
            if number is not None:
                check_number(name, number, say("a finite number"))
        if not self.given:
            remedy = say("give s, v, a or j there, or leave the point out")
            found = say("missing at {told}", told=told(self.angle))
            raise DesignError("s", found, say("given with v, a or j, or one of these"), remedy)

    @property
    def place(self) -> Fraction:
        """The cam angle [rad], exact where it is a round one in radians or in degrees."""
        return exact_angle(self.angle)

    @property
    def given(self) -> dict[int, float]:
        """What is asked, by the order of the derivative."""
        values = (getattr(self, name) for name in ORDERS)
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


def told(angle: float) -> Caption:
    """A cam angle in the words of a message.

    >>> print(told(math.pi))
    180 degrees
    """
    return say("{degrees:.10g} degrees", degrees=math.degrees(angle))

"""The data of a cam whose flank is three circular arcs, in cam coordinates: the cam centre is the origin.

An arc about C2 leads from A on the base circle to G, an arc about C3 from there to F, and an arc about C1 from F to D
on the outer circle.  C2 lies on the line OA and C1 on the line OD, so both touch the dwells' circles there.

Source: C. Lanni, M. Ceccarelli, G. Figliolini, "An analytical design for three circular-arc cams", *Mechanism and
Machine Theory* 37 (2002).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from graphcam.errors import DesignError, check_number
from graphcam.given.laws import Floats
from graphcam.words import say

Point = Sequence[float] | Floats
"""x and y [mm]; an array of two numbers will do."""


@dataclass(frozen=True)
class ThreeArcs:
    """What is given of a cam of three circular arcs, points as (x, y) in mm.

    D : where the rise ends, on the outer circle
    G : where the second arc ends and the third begins
    rho1 : radius of the first arc [mm]
    A : where the rise begins, on the base circle; needed where C2 is left out
    C1 : centre of the first arc; left out, it lies on the line OD, rho1 from D
    C2 : centre of the second arc; left out, it lies on the line OA, as far from A as from G

    Raises
    ------
    DesignError : a number is not finite, rho1 is not positive, a point lies in the cam centre, both A and C2 are left
        out, or rho1 reaches from D to the cam centre while C1 is left out

    >>> ThreeArcs(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, A=(0, 40)).design_case
    4
    """

    D: Point
    G: Point
    rho1: float
    A: Point | None = None
    C1: Point | None = None
    C2: Point | None = None

    def __post_init__(self) -> None:
        for name in ("D", "G", "A", "C1", "C2"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, _point(name, getattr(self, name)))
        check_number("rho1", self.rho1, say("a finite radius of more than 0 mm"), above=0)
        if self.C2 is None and self.A is None:
            found = say("left out")
            raise DesignError("C2", found, say("given, or A in its place"), say("give C2, or A to have it found"))
        if self.C2 == self.G:
            raise DesignError("C2", self.C2, say("away from G"), say("the second arc needs a radius"))
        if self.C1 is None and self.rho1 >= math.hypot(*self.D):
            limit = say("less than the {hypot:g} mm from the cam centre to D", hypot=math.hypot(*self.D))
            raise DesignError("rho1", self.rho1, limit, say("take a smaller radius, or give C1"))

    @property
    def design_case(self) -> int:
        """The design case: 1 with both centres, 2 without C2, 3 without C1, 4 without either."""
        return 1 + (self.C2 is None) + 2 * (self.C1 is None)


def _point(name: str, value: Point) -> tuple[float, float]:
    try:
        x, y = (float(coordinate) for coordinate in value)
    except (TypeError, ValueError):
        raise DesignError(name, say("{value!r}", value=value), say("two numbers, x and y in mm")) from None
    if not (math.isfinite(x) and math.isfinite(y)):
        raise DesignError(name, (x, y), say("two finite numbers, x and y in mm"))
    if x == y == 0 and name != "C2":
        raise DesignError(name, (x, y), say("away from the cam centre"))
    return x, y

"""The list ``parts`` of ``[motion]``: polynomials and splines through points, angles in degrees."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, Literal

from graphcam.errors import DesignError
from graphcam.given.boundary_parts import PolynomialPart, SplinePart
from graphcam.given.motion_point import ORDERS, MotionPoint
from graphcam.given.ranges import bounded
from graphcam.tasks.dataclass_reader import ByKind
from graphcam.words import say

TWO_TURNS = 720.0
"""A part may lead over the end of the turn."""


def _check_angle(angle: float, name: str = "angle") -> None:
    if not 0 <= angle <= TWO_TURNS:
        limit = say("from 0 to {two_turns:g} degrees", two_turns=TWO_TURNS)
        raise DesignError(name, angle, limit, say("count the cam angle from 0"))


@dataclass(frozen=True)
class PointTable:
    """What is asked at a cam angle [degrees]; what is left out is free.

    s : mm (degrees for an arm);  v, a, j : its derivatives by the cam angle in radians
    """

    angle: float
    s: float | None = None
    v: float | None = None
    a: float | None = None
    j: float | None = None

    def __post_init__(self) -> None:
        _check_angle(self.angle)
        for name in ORDERS:
            bounded(name, getattr(self, name), "mm/rad^2")
        self()

    def __call__(self, unit: float = 1.0) -> MotionPoint:
        """The point in radians, its values times ``unit`` (radians per degree for an arm, else 1)."""
        values = {name: None if (x := getattr(self, name)) is None else x * unit for name in ORDERS}
        return MotionPoint(math.radians(self.angle), **values)


@dataclass(frozen=True)
class PolynomialTable:
    """The polynomial through points, of the degree that all their conditions ask for."""

    points: tuple[PointTable, ...]
    degree: int | None = None
    kind: Literal["polynomial"] = "polynomial"

    def __post_init__(self) -> None:
        self()

    def __call__(self, unit: float = 1.0) -> PolynomialPart:
        """The part in radians, its values times ``unit``."""
        return _polynomial(self, unit)


@dataclass(frozen=True)
class SplineTable:
    """The B-spline of a degree through points; its inner knots [degrees] are chosen where they are left out."""

    points: tuple[PointTable, ...]
    degree: int = 5
    knots: tuple[float, ...] | None = None
    kind: Literal["spline"] = "spline"

    def __post_init__(self) -> None:
        for k, knot in enumerate(self.knots or ()):
            _check_angle(knot, f"knots[{k}]")
        self()

    def __call__(self, unit: float = 1.0) -> SplinePart:
        """The part in radians, its values times ``unit``."""
        return _spline(self, unit)


PartOfMotion = Annotated[PolynomialTable | SplineTable, ByKind()]


# Kept, because a task asks for its motion in several places, and to solve for a part takes its time.


@lru_cache(maxsize=64)
def _polynomial(table: PolynomialTable, unit: float) -> PolynomialPart:
    return PolynomialPart([point(unit) for point in table.points], table.degree)


@lru_cache(maxsize=64)
def _spline(table: SplineTable, unit: float) -> SplinePart:
    knots = None if table.knots is None else tuple(map(math.radians, table.knots))
    return SplinePart([point(unit) for point in table.points], table.degree, knots)

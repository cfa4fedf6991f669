"""The region for the cam centre, cut out by lines, and its point nearest to the start of the lift."""

import math
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, get_args

Line = Literal["rise", "return", "rest"]
LINE_NAMES: tuple[Line, ...] = get_args(Line)


class HalfPlane(NamedTuple):
    """The points R with normal . R >= height; the reach of the arm, which no limit sets, has no name.

    touch : where on the motion the line touches, if it goes along with a place of it
    """

    name: Line | None
    normal: complex
    height: float
    touch: Any = None

    def excess(self, point: complex) -> float:
        """How far the point lies outside [mm]."""
        return self.height - (self.normal.conjugate() * point).real


NearestPoint = tuple[complex, tuple[HalfPlane, ...]]
"""A point, and the lines that hold it off."""


def nearest_point(lines: Sequence[HalfPlane]) -> NearestPoint:
    """The point nearest to the start of the lift that keeps the lines, and the one or two that hold it off.

    One line after another is taken in.  The point stays if it keeps the next one too, else it moves onto that one.

    Source: R. Seidel, *Small-dimensional linear programming and convex hulls made easy*, Discrete & Computational
    Geometry 6 (1991), 423-434.

    >>> point, kept = nearest_point([HalfPlane("rise", 1j, 3.0), HalfPlane("return", 1 + 0j, 4.0)])
    >>> abs(point), [line.name for line in kept]
    (5.0, ['return', 'rise'])
    """
    point, kept = 0j, ()
    for k, line in enumerate(lines):
        _, normal, height, _ = line
        if normal.real * point.real + normal.imag * point.imag < height:
            point, kept = _nearest_on_line(line, lines[:k])
    return point, kept


def _nearest_on_line(line: HalfPlane, others: Sequence[HalfPlane]) -> NearestPoint:
    """The nearest point that keeps the others on one of the lines, whose points are (height + i t) normal."""
    _, normal, height, _ = line
    along, at, low, high = normal.conjugate(), None, -math.inf, math.inf
    for other in others:
        between = along * other.normal  # cosine and sine of the angle between the normals
        if not between.imag:
            continue
        t = (other.height - height * between.real) / between.imag
        if between.imag > 0 and t > low:
            low, at = t, other if t > 0 else at
        elif between.imag < 0 and t < high:
            high, at = t, other if t < 0 else at
    if at is None:
        return height * normal, (line,)
    return 1j * (at.height * normal - height * at.normal) / (along * at.normal).imag, (line, at)

"""The region for the cam centre, cut out by lines, and its point nearest to the start of the lift."""

from collections.abc import Sequence
from itertools import combinations
from typing import Literal, NamedTuple

Line = Literal["rise", "return", "rest"]


class HalfPlane(NamedTuple):
    """The points R with normal . R >= height; the reach of the arm, which no limit sets, has no name."""

    name: Line | None
    normal: complex
    height: float

    def excess(self, point: complex) -> float:
        """How far the point lies outside [mm]."""
        return self.height - (self.normal.conjugate() * point).real


Kept = tuple[complex, tuple[HalfPlane, ...]]
"""A point, and the lines that hold it off."""


def nearest(lines: Sequence[HalfPlane]) -> Kept:
    """The point nearest to the start of the lift that keeps the lines, and the one or two that hold it off."""
    if len(lines) < 3:
        return _nearest_of_two(lines[0], lines[-1])
    # Two half-planes at most fix the nearest point of a plane region (Helly).
    return max([_nearest_of_two(a, b) for a, b in combinations(lines, 2)], key=lambda kept: abs(kept[0]))


def _nearest_of_two(a: HalfPlane, b: HalfPlane) -> Kept:
    between = a.normal.conjugate() * b.normal  # cosine and sine of the angle between the normals
    for line, other in ((a, b), (b, a)):
        distance = line.height if line.height > 0 else 0.0
        if line is other or other.height <= distance * between.real:
            return distance * line.normal, (line,)
    return 1j * (b.height * a.normal - a.height * b.normal) / between.imag, (a, b)

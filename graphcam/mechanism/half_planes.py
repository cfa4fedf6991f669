"""The region for the cam centre, cut out by lines, and its point nearest to the start of the lift."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Literal, NamedTuple, get_args

Line = Literal["rise", "return", "rest"]
NAMES: tuple[Line, ...] = get_args(Line)


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
    # Two half-planes at most fix the nearest point of a plane region (Helly), and the other lines can only push it
    # farther out: so it is the farthest of the points that are nearest for two lines alone.
    if len(lines) < 3:
        return _nearest_of_two(lines[0], lines[-1])
    return max((_nearest_of_two(a, b) for a, b in combinations(lines, 2)), key=lambda found: abs(found[0]))


def _nearest_of_two(a: HalfPlane, b: HalfPlane) -> Kept:
    for line, other in ((a, b), (b, a)):
        foot = max(line.height, 0.0) * line.normal
        if line is other or other.excess(foot) <= 0:
            return foot, (line,)
    return 1j * (b.height * a.normal - a.height * b.normal) / (a.normal.conjugate() * b.normal).imag, (a, b)


def names_of(lines: Sequence[HalfPlane]) -> tuple[Line, ...]:
    """The names of lines, each once."""
    found = {line.name for line in lines}
    return tuple(name for name in NAMES if name in found)

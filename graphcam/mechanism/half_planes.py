"""The region for the cam centre, cut out by lines, and its point nearest to the start of the lift."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import Literal, get_args

Line = Literal["rise", "return", "rest"]


@dataclass(frozen=True)
class HalfPlane:
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
    # Two half-planes at most fix the nearest point of a plane region (Helly).
    return max((_nearest_of_two(a, b) for a, b in combinations_with_replacement(lines, 2)), key=lambda p: abs(p[0]))


def _nearest_of_two(a: HalfPlane, b: HalfPlane) -> Kept:
    for line, other in ((a, b), (b, a)):
        foot = max(line.height, 0.0) * line.normal
        if line is other or other.excess(foot) <= 0:
            return foot, (line,)
    return 1j * (b.height * a.normal - a.height * b.normal) / (a.normal.conjugate() * b.normal).imag, (a, b)


def names_of(lines: Sequence[HalfPlane]) -> tuple[Line, ...]:
    """The names of lines, each once."""
    return tuple(name for name in get_args(Line) if any(line.name == name for line in lines))

"""Upright rectangles of the paper."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Box:
    """An upright rectangle, mm.

    >>> Box(0, 0, 30, 20).grown(1).width
    32
    """

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """From left to right, mm."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """From bottom to top, mm."""
        return self.top - self.bottom

    @property
    def area(self) -> float:
        """mm²"""
        return self.width * self.height

    @property
    def corner(self) -> complex:
        """The lower left corner."""
        return complex(self.left, self.bottom)

    @property
    def corners(self) -> tuple[complex, complex, complex, complex]:
        """The four corners, counter-clockwise from the lower left one."""
        right, top = self.right, self.top
        return self.corner, complex(right, self.bottom), complex(right, top), complex(self.left, top)

    def moved(self, by: complex) -> Box:
        """The box moved ``by`` x + iy."""
        return Box(self.left + by.real, self.bottom + by.imag, self.right + by.real, self.top + by.imag)

    def grown(self, by: float) -> Box:
        """The box with ``by`` more on every side (less, if negative)."""
        return Box(self.left - by, self.bottom - by, self.right + by, self.top + by)

    def meets(self, other: Box) -> bool:
        """Whether the two have more than an edge in common.

        >>> Box(0, 0, 2, 2).meets(Box(1, 1, 3, 3)), Box(0, 0, 2, 2).meets(Box(2, 0, 3, 2))
        (True, False)
        """
        across = self.left < other.right and other.left < self.right
        return across and self.bottom < other.top and other.bottom < self.top

    def common(self, other: Box) -> float:
        """The area that two boxes share, mm².

        >>> Box(0, 0, 2, 2).common(Box(1, 1, 3, 3)), Box(0, 0, 2, 2).common(Box(2, 0, 3, 2))
        (1, 0)
        """
        across = min(self.right, other.right) - max(self.left, other.left)
        up = min(self.top, other.top) - max(self.bottom, other.bottom)
        return max(0, across) * max(0, up)

    def holds(self, other: Box) -> bool:
        """Whether the other lies inside, edges included."""
        across = self.left <= other.left and other.right <= self.right
        return across and self.bottom <= other.bottom and other.top <= self.top


def around_all(boxes: Iterable[Box]) -> Box:
    """The smallest box that holds all of at least one box.

    >>> around_all([Box(0, 0, 1, 1), Box(5, -2, 6, 0)])
    Box(left=0, bottom=-2, right=6, top=1)
    """
    lefts, bottoms, rights, tops = zip(*((box.left, box.bottom, box.right, box.top) for box in boxes), strict=True)
    return Box(min(lefts), min(bottoms), max(rights), max(tops))

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
    def corner(self) -> complex:
        """The lower left corner."""
        return complex(self.left, self.bottom)

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
        return (self.left < other.right and other.left < self.right
                and self.bottom < other.top and other.bottom < self.top)  # fmt: skip

    def holds(self, other: Box) -> bool:
        """Whether the other lies inside, edges included."""
        return (self.left <= other.left and other.right <= self.right
                and self.bottom <= other.bottom and other.top <= self.top)  # fmt: skip


def around_all(boxes: Iterable[Box]) -> Box:
    """The smallest box that holds all of at least one box.

    >>> around_all([Box(0, 0, 1, 1), Box(5, -2, 6, 0)])
    Box(left=0, bottom=-2, right=6, top=1)
    """
    boxes = list(boxes)
    return Box(min(b.left for b in boxes), min(b.bottom for b in boxes),
               max(b.right for b in boxes), max(b.top for b in boxes))  # fmt: skip

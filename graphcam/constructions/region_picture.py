"""How far the region of the cam centre is drawn: its own lines bound it, and the picture's edges cut it off."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.region import ON_THE_LINE, Boundary, permitted_part
from graphcam.drafting.euclid import UP
from graphcam.drafting.marks import Points
from graphcam.plane import dot

MARGIN = 14.0
"""So far beyond the places that it shows the picture ends [mm]."""
SHORTEST = 60.0
"""A line that bounds the region elsewhere is drawn at least so far down, for its angle to be seen [mm]."""


@dataclass(frozen=True)
class RegionPicture:
    """The part of the paper in which the lines that bound the region are drawn [mm]."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def corners(self) -> list[complex]:
        """Anticlockwise from the lower left one."""
        low, high = self.bottom * UP, self.top * UP
        return [self.left + low, self.right + low, self.right + high, self.left + high]

    def permitted(self, lines: Sequence[Boundary]) -> Points:
        """The corners of what every boundary permits of it.

        >>> picture = RegionPicture(-9.0, 9.0, -4.0, 0.0)
        >>> below = Boundary("below", np.asarray(-1j), np.asarray(-1j))
        >>> picture.permitted([below]).tolist()
        [(-9-4j), (9-4j), (9-1j), (-9-1j)]
        """
        return permitted_part(lines, self.corners)

    def end(self, line: Boundary, others: Sequence[Boundary]) -> complex:
        """Where a boundary is drawn to, down from its touch: the picture's edge, if it bounds the region there.

        Else it ends a little below where it crosses the last of the other boundaries.

        >>> flat, steep = (Boundary("", np.asarray(0j), np.exp(turn)) for turn in (-1.4j, -0.4j))
        >>> picture = RegionPicture(-9.0, 9.0, -400.0, 0.0)
        >>> leaves, ends = picture.end(flat, []), picture.end(flat, [steep])
        >>> round(leaves.real), round(abs(ends))
        (-9, 9)
        """
        touch, along = complex(line.touch), complex(line.along)
        sideways = (self.right if along.real > 0 else self.left) - touch.real
        leaves = (self.bottom - touch.imag) / along.imag
        if abs(along.real) * leaves > abs(sideways):
            leaves = sideways / along.real
        edge = touch + leaves * along
        if all(other.clearance(np.asarray(edge)) > -ON_THE_LINE for other in others):
            return edge
        with np.errstate(divide="ignore", invalid="ignore"):
            crossed = [
                float(other.clearance(np.asarray(touch)) / -dot(other.inward, np.asarray(along))) for other in others
            ]
        last = max((way for way in crossed if 0 < way < leaves), default=0.0)
        return touch + min(leaves, max(last + MARGIN, SHORTEST)) * along


def picture_of(places: Iterable[complex], lines: Sequence[Boundary] = ()) -> RegionPicture:
    """A picture that shows places not above the start of the lift, and the lines that bound their region.

    Lines that lean at up to 45 degrees end on its lower edge: only what is flatter is cut off at the sides.

    >>> line = Boundary("rise", np.asarray(5j), np.exp(-0.25j * np.pi))
    >>> picture_of([0j, -20j, 3 - 6j], [line])
    RegionPicture(left=-53.0, right=56.0, bottom=-34.0, top=0.0)
    """
    shown: Points = np.array(
        [*(place for place in places if np.isfinite(place)), *(complex(each.touch) for each in lines)]
    )
    bottom = float(shown.imag.min()) - MARGIN
    aside = MARGIN + max(0.0, *shown.imag.tolist()) - bottom
    return RegionPicture(float(shown.real.min()) - aside, float(shown.real.max()) + aside, bottom, 0.0)

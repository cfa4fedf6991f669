"""Where the cam centre may lie: lines that bound a region, and the places of the region that textbooks take.

Every place is found with ruler and compass on lines of the paper; all of it works on arrays, one region a sample.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.curve import at_greatest
from graphcam.drafting.euclid import NOWHERE, UP, crossing, foot, meet
from graphcam.drafting.ink import say
from graphcam.drafting.marks import Points
from graphcam.drafting.meaning import Compared, Converges, ReadingMeaning
from graphcam.given.laws import Floats
from graphcam.plane import dot

ON_THE_LINE = 1e-9
"""A point of the paper this near to a boundary [mm] lies on it: rounding of the arithmetic."""


LEAST_RADIUS = ReadingMeaning(
    say("prime radius r₀"),
    "r₀",
    "mm",
    (Compared("minimum_prime_radius", say("least radius r₀")),),
    Converges("least prime radius", "minimum_prime_radius"),
)
"""The least prime radius, however it is found."""


@dataclass(frozen=True, eq=False)
class Boundary:
    """A line that bounds the region: places on the side ``inward`` of the line through ``touch`` are permitted.

    name : of what is limited; touch, inward : a point of the line and the direction across it, (...) one a sample
    """

    name: str
    touch: Points
    inward: Points

    @property
    def along(self) -> Points:
        """The direction of the line, downwards on the paper."""
        along = self.inward * UP
        return np.where(along.imag < 0, along, -along)

    def clearance(self, place: Points) -> Floats:
        """How far inside the boundary a place lies [mm of paper]."""
        return dot(self.inward, place - self.touch)

    @property
    def first(self) -> Boundary:
        """The line of the first sample, or the only one."""
        return Boundary(self.name, np.ravel(self.touch)[0], np.ravel(self.inward)[0])


def nearest(lines: Sequence[Boundary], start: Points) -> Points:
    """The permitted place nearest to ``start``: a foot of a perpendicular or a corner of the region; NaN if none is.

    >>> at = np.asarray
    >>> lines = [Boundary("left", at(0j), at(1 + 0j)), Boundary("below", at(-3j), at(-1j))]
    >>> complex(nearest(lines, at(-1 + 0j)))
    -3j
    """
    feet = [foot(start, line.touch, line.along) for line in lines]
    corners = [meet(a.touch, a.along, b.touch, b.along) for a, b in combinations(lines, 2)]
    places = np.stack(np.broadcast_arrays(*feet, *corners), axis=-1)
    permitted = np.all([line.clearance(places.T).T >= -ON_THE_LINE for line in lines], axis=0)
    nearness = np.where(permitted, -np.abs(places - np.asarray(start)[..., None]), -np.inf)
    return np.where(np.isfinite(nearness.max(axis=-1)), at_greatest(places, nearness), NOWHERE)


def nearest_of_many(touches: Points, inwards: Points, start: Points) -> tuple[Points, NDArray[np.intp]]:
    """The permitted place nearest to ``start`` among many lines, and which of them bind.

    touches, inwards : (..., k) lines as in :class:`Boundary`; start : (...)
    returns : places (...), NaN where none is permitted, and (..., 2) indices of the lines that meet there; where a
        single line binds, it is named twice

    The line that cuts off most is added to the one or two on which the place lies, until no line cuts it off: every
    addition takes the place farther from the start, so none comes back.

    >>> place, lines = nearest_of_many(np.array([0j, -3j, -1j]), np.array([1 + 0j, -1j, -1j]), np.asarray(-1 + 0j))
    >>> complex(place), sorted(lines.tolist())
    (-3j, [0, 1])
    """
    place = np.array(np.broadcast_to(start, touches.shape[:-1]))
    lines = np.zeros((*place.shape, 2), dtype=np.intp)
    for added in range(touches.shape[-1]):
        clearance = dot(inwards, place[..., None] - touches)
        deepest = np.argmin(clearance, axis=-1)[..., None]
        cut_off = clearance.min(axis=-1) < -ON_THE_LINE
        if not cut_off.any():
            break
        three = np.concatenate([deepest, lines if added else np.repeat(deepest, 2, axis=-1)], axis=-1)
        touch, inward = (np.take_along_axis(given, three, -1) for given in (touches, inwards))
        found, pair = _nearest_of_three(touch, inward, start)
        place = np.where(cut_off, found, place)
        lines = np.where(cut_off[..., None], np.take_along_axis(three, pair, -1), lines)
    return place, lines


_PAIRS = np.array([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)])


def _nearest_of_three(touches: Points, inwards: Points, start: Points) -> tuple[Points, NDArray[np.intp]]:
    """The nearest place that three lines permit, and the pair of them that makes it, (..., 2)."""
    lines = [(touches[..., k], inwards[..., k] * UP) for k in range(3)]
    feet = [foot(start, *line) for line in lines]
    # Neighbouring lines of a family cross at less than a degree; what they bound is their envelope, not the crossing.
    corners = [crossing(*lines[a], *lines[b]) for a, b in _PAIRS[3:]]
    places = np.stack([*feet, *corners], axis=-1)
    clearance = dot(inwards[..., None, :], places[..., None] - touches[..., None, :])
    permitted = np.all(clearance >= -ON_THE_LINE, axis=-1)
    best = np.argmin(np.where(permitted, np.abs(places - start[..., None]), np.inf), axis=-1)
    place = np.take_along_axis(places, best[..., None], -1)[..., 0]
    return np.where(permitted.any(axis=-1), place, NOWHERE), _PAIRS[best]


def lowest_on(lines: Sequence[Boundary], x: Floats | float) -> Points:
    """The highest place on the vertical at x that every boundary permits: the lowest of its meetings with the lines.

    >>> at = np.asarray
    >>> lines = [Boundary("sloping", at(-3j), at(1 - 1j)), Boundary("level", at(-4j), at(-1j))]
    >>> complex(lowest_on(lines, 2.0)), complex(lowest_on(lines, -2.0))
    ((2-4j), (-2-5j))
    """
    vertical = np.asarray(x + 0j)
    meetings = [meet(vertical, np.asarray(UP), line.touch, line.along) for line in lines]
    heights = np.stack([*(place.imag for place in meetings), np.zeros_like(meetings[0].imag)])
    return vertical + UP * heights.min(axis=0)


def binding(lines: Sequence[Boundary], centre: complex) -> list[Boundary]:
    """The boundaries, of one sample, on which the cam centre lies."""
    return [line for line in lines if abs(line.clearance(np.asarray(centre))) <= 1e3 * ON_THE_LINE]


def permitted_part(lines: Sequence[Boundary], corners: Sequence[complex]) -> Points:
    """The part of a convex polygon that every boundary permits: cut by one after another."""
    polygon = list(corners)
    for line in lines:
        polygon = _cut(polygon, line)
    return np.array(polygon)


def _cut(polygon: list[complex], line: Boundary) -> list[complex]:
    kept: list[complex] = []
    for start, end in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        inside, outside = (float(line.clearance(np.asarray(place))) for place in (start, end))
        if inside >= 0:
            kept.append(start)
        if inside * outside < 0:
            kept.append(start + (end - start) * inside / (inside - outside))
    return kept

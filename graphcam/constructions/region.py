"""Where the cam centre may lie: lines that bound a region, places that textbooks take, how far it is drawn.

Every place is found with ruler and compass on lines of the paper; all of it works on arrays, one region a sample.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import station_names
from graphcam.constructions.integration import Integrated
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import NOWHERE, UP, crossing, foot
from graphcam.drafting.hand import Hand
from graphcam.drafting.ink import say
from graphcam.drafting.marks import Points
from graphcam.drafting.meaning import ComparedReading, ReadingConvergence, ReadingMeaning
from graphcam.drafting.scale import NEGLIGIBLE_SIZE
from graphcam.given.laws import Floats
from graphcam.plane_vectors import dot

ON_THE_LINE = 1e-9
"""A point of the paper this near to a boundary [mm] lies on it: rounding of the arithmetic."""


LEAST_RADIUS = ReadingMeaning(
    say("prime radius r₀"),
    "r₀",
    "mm",
    (ComparedReading("minimum_prime_radius", say("minimum radius r₀")),),
    ReadingConvergence("minimum prime radius", "minimum_prime_radius"),
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


def boundary(line: Drawn) -> Boundary:
    """The boundary that a drawn line makes, by its name: places to the right of its direction are permitted."""
    return Boundary(line.act.name, line.points, -UP * line.directions)


def nearest_permitted(hand: Hand, name: str, lines: Sequence[Drawn], start: Drawn) -> Drawn:
    """The permitted place nearest to ``start``: a foot of a perpendicular or a corner of the region; NaN if none is.

    >>> import graphcam as gc
    >>> from graphcam.drafting.meaning import Meaning
    >>> hand = Hand(gc.Pencil(), Meaning("region", say("Region"), say("Two lines bound it.")))
    >>> lines = [hand.given("left", 0j, UP), hand.given("below", -3j, 1)]
    >>> nearest_permitted(hand, "centre", lines, hand.given("start", -1)).place
    -3j
    """
    places = [hand.cross(f"foot on {line.act.name}", line, hand.perpendicular("across", line, start)) for line in lines]
    places += [hand.cross(f"{a.act.name} and {b.act.name}", a, b) for a, b in combinations(lines, 2)]
    at = np.stack([place.points for place in places], axis=-1)
    permitted = np.all([boundary(line).clearance(at.T).T >= -ON_THE_LINE for line in lines], axis=0)
    best = np.argmin(np.where(permitted, np.abs(at - start.points[..., None]), np.inf), axis=-1)
    which = np.where(permitted.any(axis=-1), best, len(places))[..., None]
    return hand.take(name, *places, hand.given("nowhere", NOWHERE), which=which)[0]


def highest_on(hand: Hand, name: str, lines: Sequence[Drawn], upright: Drawn, level: Drawn) -> Drawn:
    """The highest permitted place of an upright, below a level: the lowest of its meetings with the lines.

    >>> import graphcam as gc
    >>> from graphcam.drafting.meaning import Meaning
    >>> hand = Hand(gc.Pencil(), Meaning("region", say("Region"), say("Two lines bound it.")))
    >>> lines = [hand.given("sloping", -3j, 1 + 1j), hand.given("level", -4j, 1)]
    >>> upright, zero = hand.given("upright", 2, UP), hand.given("zero", along=1)
    >>> highest_on(hand, "centre", lines, upright, zero).place
    (2-4j)
    """
    met = [hand.cross(f"{name} on {line.act.name}", upright, line) for line in (*lines, level)]
    lowest = np.argmin(np.stack([place.points.imag for place in met], axis=-1), axis=-1)
    return hand.take(name, *met, which=lowest[..., None])[0]


def nearest_for_many(touches: Points, inwards: Points, start: Points) -> tuple[Points, NDArray[np.intp]]:
    """The permitted place nearest to ``start`` among many lines, and which of them bind.

    touches, inwards : (..., k) lines as in :class:`Boundary`; start : (...)
    returns : places (...), NaN where none is permitted, and (..., 2) indices of the lines that meet there; where a
        single line binds, it is named twice

    The line that cuts off most is added to the one or two on which the place lies, until no line cuts it off: every
    addition takes the place farther from the start, so none comes back.

    >>> place, lines = nearest_for_many(np.array([0j, -3j, -1j]), np.array([1 + 0j, -1j, -1j]), np.asarray(-1 + 0j))
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
        found, pair = _nearest_for_three_lines(touch, inward, start)
        place = np.where(cut_off, found, place)
        lines = np.where(cut_off[..., None], np.take_along_axis(three, pair, -1), lines)
    return place, lines


_VERTEX_PAIRS = np.array([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)])


def _nearest_for_three_lines(touches: Points, inwards: Points, start: Points) -> tuple[Points, NDArray[np.intp]]:
    """The nearest place that three lines permit, and the pair of them that makes it, (..., 2)."""
    lines = [(touches[..., k], inwards[..., k] * UP) for k in range(3)]
    feet = [foot(start, *line) for line in lines]
    # Neighbouring lines of a family cross at less than a degree; what they bound is their envelope, not the crossing.
    corners = [crossing(*lines[a], *lines[b]) for a, b in _VERTEX_PAIRS[3:]]
    places = np.stack([*feet, *corners], axis=-1)
    clearance = dot(inwards[..., None, :], places[..., None] - touches[..., None, :])
    permitted = np.all(clearance >= -ON_THE_LINE, axis=-1)
    best = np.argmin(np.where(permitted, np.abs(places - start[..., None]), np.inf), axis=-1)
    place = np.take_along_axis(places, best[..., None], -1)[..., 0]
    return np.where(permitted.any(axis=-1), place, NOWHERE), _VERTEX_PAIRS[best]


def binding_boundaries(lines: Sequence[Boundary], centre: complex) -> list[Boundary]:
    """The boundaries, of one sample, on which the cam centre lies."""
    return [line for line in lines if abs(line.clearance(np.asarray(centre))) <= 1e3 * ON_THE_LINE]


def permitted_part(lines: Sequence[Boundary], corners: Sequence[complex]) -> Points:
    """The part of a convex polygon that every boundary permits: cut by one after another."""
    polygon = list(corners)
    for line in lines:
        polygon = _cut_polygon(polygon, line)
    return np.array(polygon)


def _cut_polygon(polygon: list[complex], line: Boundary) -> list[complex]:
    kept: list[complex] = []
    for start, end in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        inside, outside = (float(line.clearance(np.asarray(place))) for place in (start, end))
        if inside >= 0:
            kept.append(start)
        if inside * outside < 0:
            kept.append(start + (end - start) * inside / (inside - outside))
    return kept


PICTURE_MARGIN = 14.0
"""So far beyond the places that it shows the picture ends [mm]."""
MIN_LINE_LENGTH = 60.0
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
        """The corners [mm], anticlockwise from the lower left one."""
        low, high = self.bottom * UP, self.top * UP
        return [self.left + low, self.right + low, self.right + high, self.left + high]

    def permitted(self, lines: Sequence[Boundary]) -> Points:
        """The corners of the part of the picture that every boundary permits.

        >>> picture = RegionPicture(-9.0, 9.0, -4.0, 0.0)
        >>> below = Boundary("below", np.asarray(-1j), np.asarray(-1j))
        >>> picture.permitted([below]).tolist()
        [(-9-4j), (9-4j), (9-1j), (-9-1j)]
        """
        return permitted_part(lines, self.corners)

    def end(self, line: Boundary, others: Sequence[Boundary]) -> complex:
        """The end of a boundary below its touch: on the picture's edge, if it bounds the region there.

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
        return touch + min(leaves, max(last + PICTURE_MARGIN, MIN_LINE_LENGTH)) * along


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
    bottom = float(shown.imag.min()) - PICTURE_MARGIN
    aside = PICTURE_MARGIN + max(0.0, *shown.imag.tolist()) - bottom
    return RegionPicture(float(shown.real.min()) - aside, float(shown.real.max()) + aside, bottom, 0.0)


STATION_NEARNESS = 0.05
"""A line that touches this near to a station, in parts of the way to the next one, touches at it."""


def touched_stations(integrated: Integrated, plotted: Points, place: complex, direction: int) -> list[str]:
    """The name of the station at which a curve is touched, or the names of those on both sides.

    plotted : (n,) the curve's points at the stations;  direction : 1 for the curve of the rises, -1 of the returns

    >>> import graphcam as gc
    >>> integrated = gc.solve(gc.builtin_task()).drawn["integration"]
    >>> curve = np.arange(integrated.first("s").size) + 0j
    >>> touched_stations(integrated, curve, 4.02 + 0j, 1), touched_stations(integrated, curve, 4.3 + 0j, 1)
    (['4'], ['4', '5'])
    """
    motion, stations = integrated.givens.motion, integrated.givens.stations
    names, moving = station_names(stations), np.array([phase.direction for phase in motion.phases])
    left = stations.left[moving[stations.phase[stations.left]] == direction]
    ways = plotted[left + 1] - plotted[left]
    # A part that has no length, where the follower stays, is touched nowhere.
    along = np.clip(dot(ways, place - plotted[left]) / np.maximum(np.abs(ways) ** 2, NEGLIGIBLE_SIZE), 0.0, 1.0)
    part = int(np.argmin(np.abs(plotted[left] + along * ways - place)))
    first, share = int(left[part]), float(along[part])
    if min(share, 1 - share) < STATION_NEARNESS:
        return [names[first + (share > 0.5)]]
    return [names[first], names[first + 1]]

"""What an answer is expected to be, how far a careful hand scatters about it, and how far a given one is off.

Two drawn curves are apart each way: from the stations of the one to the line of the other, and from that line back.

A curve that is expected is known at its stations, and between two of them by its *bulge*, as DXF has it: the height of
the arc over half the chord, positive where it lies to the right of the way (an arc turning counter-clockwise).  With as
many bulges as stations the last is that of the part back to the first; with none all parts are straight.

Between two neighbouring points a line may run anywhere between chord and arc: a table of points is joined by chords,
and a CAD program draws a smooth curve.  The points stand so close, on the arcs of dwells too, that this is little.
"""

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.exercises.definition.exercise import Given, Kind

Floats = NDArray[np.float64]
SAMPLING_STEP = 5.0
"""A drawn line is looked at in all its vertices, and on straight stretches in places at most this far apart [mm]."""
MAX_PLACES = 2000
"""Places between the vertices: a line longer than any curve is looked at in longer steps."""
STRAIGHT_BULGE = 1e-6
"""A part of less bulge is as good as straight, and still has a radius."""
LENGTH_ROUNDING = 1e-9
"""A part of a length above what rounding makes of it."""
MIN_PART_LENGTH = 1e-9
"""A part of less length is as good as a point, and still has a direction [mm of paper]."""
Scatter = float | Floats


def distance_to_curve(points: Points, curve: Points) -> NDArray[np.float64]:
    """Distances (..., m) of points (m,) to the nearest place of the lines through the vertices ``curve`` (..., n).

    >>> distance_to_curve(np.array([1 + 1j, 5 + 0j]), np.array([0j, 2 + 0j])).tolist()
    [1.0, 3.0]
    """
    if curve.shape[-1] < 2:
        return np.abs(points - curve) if curve.size else np.full(points.shape, np.inf)
    start, way = curve[..., None, :-1], (curve[..., 1:] - curve[..., :-1])[..., None, :]
    to = points[:, None] - start
    length = np.abs(way) ** 2
    # A part of no length has its start alone.
    along = (to * way.conj()).real / np.where(length > 0, length, 1.0)
    return np.abs(to - np.minimum(np.maximum(along, 0.0), 1.0) * way).min(axis=-1)


def distance_from_drawn(drawn: Points, stations: Points, bulge: Floats) -> tuple[Floats, NDArray[np.intp]]:
    """How far places (k,) all along the line ``drawn`` (n,) lie from a curve, and the part of it that is nearest.

    >>> square = np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j])
    >>> circle = np.full(4, np.tan(np.pi / 8))
    >>> drawn = np.array([2.0, 1.2, 1.0]) * np.sqrt(2)
    >>> distance_from_drawn(drawn, square, circle)[0].round(3).tolist()
    [1.414, 0.283, 0.0]
    """
    bulge = bulge if bulge.size else np.zeros(max(stations.size - 1, 1))
    starts, ends = stations[: bulge.size], np.append(stations, stations[0])[1 : bulge.size + 1]
    half, middle = (ends - starts) / 2, (starts + ends) / 2
    half[np.abs(half) < MIN_PART_LENGTH] = MIN_PART_LENGTH
    size, height = np.abs(half), np.maximum(np.abs(bulge), STRAIGHT_BULGE)
    at = places(drawn)
    # A part holds the middle of its chord, and a circle about that holds the part: few can be the nearest.
    far = np.abs(at[:, None] - middle)
    reach = size * np.maximum(height, 1.0) * (1 + LENGTH_ROUNDING)
    place, part = np.nonzero(far - reach <= far.min(axis=1)[:, None])
    # Every part in a frame of its own: its chord from -1 to 1, its arc on the upper side.
    own = at[place] * (1 / half)[part] - (middle / half)[part]
    up = own.imag * np.where(bulge < 0, 1.0, -1.0)[part]
    distance = np.full(far.shape, np.inf)
    distance[place, part] = _from_segment(own.real, up, height[part]) * size[part]
    nearest = distance.argmin(axis=1)
    return distance[np.arange(nearest.size), nearest], nearest


def places(line: Points) -> Points:
    """Places (k,) on the line through the vertices (n,): the vertices, then some at equal distances.

    >>> places(np.array([0j, 7 + 0j])).tolist()
    [0j, (7+0j), (2.5+0j)]
    """
    length = np.append(0.0, np.cumsum(np.abs(line[1:] - line[:-1])))
    step = max(SAMPLING_STEP, float(length[-1]) / MAX_PLACES)
    between = np.arange(step / 2, length[-1], step)
    return np.concatenate([line, np.interp(between, length, line)])


def _from_segment(along: Floats, up: Floats, height: Floats) -> Floats:
    """Distances of points from what lies between the chord from -1 to 1 and an arc of some height over it."""
    radius = (1 + height * height) / (2 * height)
    above = up - (height - radius)  # the circle's centre
    reach = np.sqrt(along * along + above * above)
    outside = reach - radius
    beside = np.maximum(np.abs(along), 1.0) - 1.0
    to_chord = np.where((outside < 0) & (up >= 0), 0.0, np.sqrt(beside * beside + up * up))
    # The nearest place on the circle belongs to the arc where it lies above the chord.
    on_arc = (outside >= 0) & (radius * above >= (radius - height) * reach)
    return np.where(on_arc, outside, to_chord)


class AnswerDeviation(NamedTuple):
    """How far an answer is off.

    deviation : in standard deviations of a careful hand ("pencil units"); signed for a number
    station : of points and curves, the place of the largest deviation, counted from 0
    paper : of points and curves, that deviation in mm of paper
    """

    deviation: float
    station: int | None = None
    paper: float | None = None


@dataclass(frozen=True, eq=False)
class Expected:
    """The value that a perfect hand reads, and the standard deviation of careful ones.

    value : a number, or complex points (m,) [mm of paper]; scatter : a number, or one a point (m,) [mm of paper]
    bulge : of a curve, how far it bends between its points: see above
    """

    value: Given
    scatter: Scatter
    bulge: Floats = field(default_factory=lambda: np.empty(0))

    def deviation(self, given: Given, kind: Kind, far: float = math.inf) -> float:
        """How far an answer is off, in pencil units; what is farther off than ``far`` need not be told exactly.

        >>> Expected(10.0, 0.5).deviation(11.0, "number")
        2.0
        """
        return self.deviation_of(given, kind, far).deviation

    def deviation_of(self, given: Given, kind: Kind, far: float = math.inf) -> AnswerDeviation:
        """How far an answer is off, and where most; what is farther off than ``far`` need not be told exactly.

        Of points, in whatever order, the worst counts.  Of a curve it is the worst distance of an expected point to
        the curve, or of a place on the curve to what is expected, whichever is larger: else a scribble that passes
        through everything would be as good as the curve.  Where the number of points differs it is infinite, and
        nowhere.
        """
        if not isinstance(given, np.ndarray):
            off = math.inf if isinstance(self.value, np.ndarray) else (given - self.value) / float(self.scatter)
            return AnswerDeviation(off)
        distances = self.distances(given, kind)
        relative = distances / self.scatter
        # Where one is infinite or a NaN, that is the place.
        worst = int(relative.argmax())
        deviation = float(relative[worst])
        if not math.isfinite(deviation):
            return AnswerDeviation(math.inf)
        found = AnswerDeviation(deviation, worst, float(distances[worst]))
        if kind != "curve" or found.deviation > far:
            return found
        distances, part = distance_from_drawn(given, np.asarray(self.value), self.bulge)
        scatter = np.asarray(self.scatter)
        relative = distances / np.maximum(scatter[part], scatter[(part + 1) % scatter.size])
        worst = int(relative.argmax())
        return max(found, AnswerDeviation(float(relative[worst]), int(part[worst]), float(distances[worst])))

    def share(self, given: Points, bound: float, least: float) -> float:
        """The part of a curve that is drawn within a bound [pencil units], or that of the drawing which is the curve.

        The smaller of the two counts: neither a piece of the curve nor a scribble all over it is the curve.

        least : a smaller share is told as 0

        >>> Expected(np.array([0j, 10 + 0j, 20 + 0j]), np.ones(3)).share(np.array([0j, 10 + 0j]), 1.0, least=0.5)
        0.5
        """
        value, scatter = np.asarray(self.value), np.asarray(self.scatter)
        near = distance_to_curve(value, given) <= bound * scatter
        length = np.abs(np.append(value, value[0])[1:] - value)[: max(self.bulge.size, value.size - 1)]
        drawn = (near & np.append(near, near[0])[1:])[: length.size]
        covered = float(length[drawn].sum() / length.sum()) if length.any() else 0.0
        at = places(given)[given.size :]
        # What covers too little need not be looked at all along.
        if not at.size or covered < least:
            return 0.0
        distances, part = distance_from_drawn(at, value, self.bulge)
        on = distances <= bound * np.maximum(scatter[part], scatter[(part + 1) % scatter.size])
        share = min(covered, float(on.mean()))
        return share if share >= least else 0.0

    def distances(self, given: Points, kind: Kind) -> Floats:
        """How far the points or the curve given lie from every expected point (m,) [mm of paper]."""
        value = np.atleast_1d(np.asarray(self.value, dtype=np.complex128))
        if kind == "curve":
            return distance_to_curve(value, np.asarray(given, dtype=np.complex128))
        if given.shape != value.shape:
            return np.full(value.shape, np.inf)
        return np.abs(paired(given, value) - value)


def stored(expected: Expected) -> list[Any]:
    """The expectation for JSON: value and scatter, and of points the bulge; a point is a pair."""
    if not isinstance(expected.value, np.ndarray):
        return [expected.value, float(expected.scatter)]
    points = [[z.real, z.imag] for z in expected.value.tolist()]
    return [points, np.asarray(expected.scatter).tolist(), expected.bulge.tolist()]


def from_stored(said: list[Any]) -> Expected:
    """The expected answer in the form that :func:`stored` wrote.

    >>> stored(from_stored([[[0.0, 1.0]], [0.5], []]))
    [[[0.0, 1.0]], [0.5], []]
    """
    if len(said) == 2:
        return Expected(float(said[0]), float(said[1]))
    value, scatter, bulge = (np.array(each, dtype=np.float64) for each in said)
    return Expected(value.reshape(-1, 2).view(np.complex128)[:, 0], scatter, bulge)


def paired(given: Points, wanted: Points) -> Points:
    """Points (n,) in the order of the wanted ones, paired so that they lie as near as they can together.

    A drawing does not say which point is which, and a CAD program may save them in another order.  The distances
    themselves are summed, not their squares, so that one point in a wrong place is left as that one.

    >>> paired(np.array([5 + 1j, 0.2 + 0j]), np.array([0j, 5 + 0j]))
    array([0.2+0.j, 5. +1.j])
    """
    from scipy.optimize import linear_sum_assignment

    _, order = linear_sum_assignment(np.abs(wanted[:, None] - given))
    return given[order]

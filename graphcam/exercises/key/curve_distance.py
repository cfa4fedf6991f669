"""Distances between two drawn curves, each way: from its stations to the other's line, and from the line back.

A curve that is expected is known at its stations, and between two of them by its *bulge*, as DXF has it: the height of
the arc over half the chord, positive where it lies to the right of the way (an arc turning counter-clockwise).  With as
many bulges as stations the last is that of the part back to the first; with none all parts are straight.

A line that runs anywhere between chord and arc is taken for right: a table of points is joined by chords, and a CAD
program draws a smooth curve.
"""

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points

Floats = NDArray[np.float64]

STEP = 5.0
"""A drawn line is looked at in all its vertices, and on straight stretches in places at most this far apart [mm]."""
MOST_PLACES = 2000
"""Places between the vertices: a line longer than any curve is looked at in longer steps."""
STRAIGHT = 1e-6
"""A part of less bulge is as good as straight, and still has a radius."""
ROUNDING = 1e-9
"""More than rounding makes of a length, of itself."""
POINT = 1e-9
"""A part of less length is as good as a point, and still has a direction [mm of paper]."""


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
    half[np.abs(half) < POINT] = POINT
    size, height = np.abs(half), np.maximum(np.abs(bulge), STRAIGHT)
    at = places(drawn)
    # A part holds the middle of its chord, and a circle about that holds the part: few can be the nearest.
    far = np.abs(at[:, None] - middle)
    reach = size * np.maximum(height, 1.0) * (1 + ROUNDING)
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
    step = max(STEP, float(length[-1]) / MOST_PLACES)
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

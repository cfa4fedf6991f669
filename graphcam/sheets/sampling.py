"""Entities as dense points and as straight pieces, for placing labels and checking them."""

import cmath
import math
from collections.abc import Iterable
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.sheets.model import ArcEntity, Box, Circles, Curve, Entity, Polygons, Stroke, Strokes, Text
from graphcam.sheets.text_measures import extent, start_of

Floats = NDArray[np.float64]
FLATNESS = 0.02
"""The maximum distance of a curve from the chords that replace it [mm]."""
DIRECTION_COUNT = 72
"""The number of directions of outermost points: of a circle they miss 0.1 % of its radius."""


def pieces(entity: Entity) -> tuple[Points, Points]:
    """Starts and ends (n,) of straight pieces that follow the entity, or the box of a text."""
    match entity:
        case Strokes():
            return entity.starts, entity.ends
        case Stroke(points=points, closed=closed):
            return (points, np.roll(points, -1)) if closed else (points[:-1], points[1:])
        case Curve(points=points):
            return points, np.roll(points, -1)
        case Circles(centres=centres, radius=radius):
            ring = _bow(radius, 0.0, 2 * math.pi)
            return (centres[:, None] + ring[:-1]).ravel(), (centres[:, None] + ring[1:]).ravel()
        case ArcEntity(centre=centre, radius=radius, start=start, end=end):
            bow = centre + _bow(radius, start, end)
            return bow[:-1], bow[1:]
        case Polygons(corners=filled):
            return filled.ravel(), np.roll(filled, -1, axis=1).ravel()
        case Text():
            box = corners(entity)
            return box, np.roll(box, -1)


def linework(entities: Iterable[Entity]) -> tuple[Points, Points]:
    """Starts and ends (n,) of the straight pieces of all entities together.

    >>> side = Strokes(np.array([0j]), np.array([4 + 0j]), "curve")
    >>> starts, ends = linework([side, side])
    >>> (ends - starts).tolist()
    [(4+0j), (4+0j)]
    """
    nothing: Points = np.empty(0, dtype=np.complex128)
    starts, ends = zip((nothing, nothing), *map(pieces, entities), strict=True)
    return np.concatenate(starts), np.concatenate(ends)


def outermost(points: Points) -> Points:
    """Corners of the convex hull, counter-clockwise: the points farthest out in each of ``DIRECTION_COUNT`` directions.

    >>> outermost(np.array([0j, 2, 1 + 0.5j, 2 + 1j, 1j])).tolist()
    [(2+1j), 1j, 0j, (2+0j)]
    """
    angles = 2 * np.pi * (np.arange(DIRECTION_COUNT) + 0.5) / DIRECTION_COUNT
    # One direction after the other: a product of matrices would wake threads, which take longer than the work.
    x, y, ways = points.real.copy(), points.imag.copy(), zip(np.cos(angles), np.sin(angles), strict=True)
    farthest = np.array([np.argmax(across * x + up * y) for across, up in ways])
    return points[farthest[np.diff(farthest, prepend=-1) != 0]]


# Most circles are the dots of plotted points, all of one radius.
@lru_cache(maxsize=256)
def _bow(radius: float, start: float, end: float) -> Points:
    chord = 2 * math.acos(max(0.0, 1 - FLATNESS / radius)) if radius > FLATNESS else math.pi / 2
    return (radius + 0j) * np.exp(1j * np.linspace(start, end, max(2, math.ceil((end - start) / chord) + 1)))


def sampled(starts: Points, ends: Points, spacing: float) -> Points:
    """Dense points (m,) on straight pieces, at most ``spacing`` apart, both ends included.

    >>> sampled(np.array([0j]), np.array([1 + 0j]), 0.5).tolist()
    [0j, (0.5+0j), (1+0j)]
    """
    starts, ends = np.ravel(starts), np.ravel(ends)
    known = np.isfinite(starts) & np.isfinite(ends)
    starts, ends = starts[known], ends[known]
    parts = np.maximum(1, np.ceil(np.abs(ends - starts) / spacing)).astype(int)
    of = np.repeat(np.arange(len(parts)), parts + 1)
    first = np.cumsum(parts + 1) - (parts + 1)
    share = (np.arange(len(of)) - first[of]) / parts[of]
    return starts[of] + (ends - starts)[of] * share


def corners(text: Text) -> Points:
    """The four corners of a text's box, counter-clockwise from the lower left one."""
    wide, below, above = extent(text.text, text.height)
    left = start_of(text)
    box = np.array([left - 1j * below, left + wide - 1j * below, left + wide + 1j * above, left + 1j * above])
    return text.at + box * cmath.rect(1.0, text.angle)


def spans_in_box(starts: Points, ends: Points, box: Points, margin: float) -> tuple[Floats, Floats]:
    """Parts (n,) of lines, from 0 at the start to 1 at the end, within a text's box (4 corners) and a margin.

    A line has no part in it where the first number is not less than the second.

    >>> low, high = spans_in_box(np.array([0j]), np.array([10 + 0j]), np.array([4 - 1j, 6 - 1j, 6 + 1j, 4 + 1j]), 0.0)
    >>> low.tolist(), high.tolist()
    ([0.4], [0.6])
    """
    # Turned so that the box lies level, a line is clipped to two slabs.
    turn = cmath.exp(-1j * cmath.phase(complex(box[1] - box[0])))
    a, b, box = starts * turn, ends * turn, box * turn
    low, high = np.zeros(len(a)), np.ones(len(a))
    for start, end, corner in ((a.real, b.real, box.real), (a.imag, b.imag, box.imag)):
        # A line along the slab is all in it or all out: with the least of steps its ends lie far beyond 0 and 1.
        step = np.where(end == start, np.finfo(float).tiny, end - start)
        with np.errstate(over="ignore"):
            enter, leave = (corner.min() - margin - start) / step, (corner.max() + margin - start) / step
        low, high = np.maximum(low, np.minimum(enter, leave)), np.minimum(high, np.maximum(enter, leave))
    return low, high


def box_of(entities: Iterable[Entity]) -> Box | None:
    """The box around entities; None if none is visible."""
    return box_of_lines(*linework(entities))


def box_of_lines(starts: Points, ends: Points) -> Box | None:
    """The box around straight pieces; None if there are none."""
    points = np.concatenate([starts, ends])
    points = points[np.isfinite(points)]
    return box_around(points) if len(points) else None


def box_around(points: Points) -> Box:
    """The box around at least one point."""
    return Box(points.real.min().item(), points.imag.min().item(), points.real.max().item(), points.imag.max().item())

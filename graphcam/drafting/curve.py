"""Plotted points and the curve that a hand fairs through them: a parabola through three neighbouring points."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.polynomial.polynomial import polyder, polyval
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.plane_vectors import cross, dot

PLACE_DECIMALS = 6
"""Places that differ by less [decimals of mm] are one."""
BLENDING = np.array([[0.0, 1.0, 0.0, 0.0], [-0.5, 0.0, 0.5, 0.0], [1.0, -2.5, 2.0, -0.5], [-0.5, 1.5, -1.5, 0.5]])
"""The parabolas through the first and the last three of four points, blended between the middle ones: what each point
gives to the powers 0 to 3 of the fraction of that part."""
MAX_SECANTS, SAME_SHARE = 50, 2.0**-50
"""So many secants at most are drawn to find where a line meets a part, until two meet it at the same share of it."""

Distances = NDArray[np.floating[Any]]
Reach = Callable[[Points], tuple[Distances, Distances]]
"""Of places how far each lies beside a line or a circle, with a sign, and how far out on it, NaN where it ends."""


def farthest_on_pieces(points: Points, pieces: Sequence[slice], direction: Points | complex) -> Points:
    """The point of a faired curve that lies farthest in a direction: there the tangent is perpendicular to it.

    points : (..., n) plotted points, in order, of several smooth pieces, each faired for itself
    direction : one for all, or (...) one for each
    returns : (...) on the parabola through the three points about the farthest one, or that point itself where the
    parabola has no top between them, so that nothing is read beyond a corner or an end

    >>> x = np.array([-1.0, 0.5, 2.0])
    >>> complex(farthest_on_pieces(x + 1j * (3 - x**2), [slice(0, 3)], 1j))
    3j

    >>> x = np.arange(5.0)
    >>> corner = x + 1j * np.minimum(x, 4 - x)
    >>> complex(farthest_on_pieces(corner, [slice(0, 3), slice(2, 5)], 1j))
    (2+2j)
    >>> complex(farthest_on_pieces(x + 1j * np.minimum(x, 1), [slice(0, 5)], 1j))
    (2+1j)
    """
    direction = np.asarray(direction / np.abs(direction))[..., None]
    points = np.broadcast_to(points, np.broadcast_shapes(points.shape, direction.shape))
    first, last = _ends(pieces, points.shape[-1])
    best = _highest(dot(direction, points), first, last)
    plotted = np.take_along_axis(points, best, -1)
    # The three points about it; of a piece of fewer the first ones, which count for nothing.
    middle = np.clip(best, first + 1, np.maximum(last - 1, first + 1))
    a, b, c = (np.take_along_axis(points, np.minimum(middle + k, points.shape[-1] - 1), -1) for k in (-1, 0, 1))
    slope, bend = (c - a) / 2, a - 2 * b + c  # the parabola b + slope t + bend t^2/2, at t = -1, 0, 1 on the points
    with np.errstate(divide="ignore", invalid="ignore"):
        top = -dot(direction, slope) / dot(direction, bend)
        between = (dot(direction, bend) < 0) & (np.abs(top) <= 1) & (last - first > 1)
    top = np.where(between, top, 0.0)
    tops = np.where(between, b + top * (slope + top * bend / 2), plotted)
    # Of pieces that reach equally far it is the first, not the one that rounding favours.
    farthest = np.argmax(np.round(dot(direction, tops), PLACE_DECIMALS), axis=-1)[..., None]
    return np.take_along_axis(tops, farthest, -1)[..., 0]


def _ends(pieces: Sequence[slice], count: int) -> NDArray[np.intp]:
    """The first and the last place of each of k pieces of ``count`` points, (2, k)."""
    ends = np.array([piece.indices(count)[:2] for piece in pieces], dtype=np.intp)
    return (ends - (0, 1)).T


def _highest(heights: NDArray[np.float64], first: NDArray[np.intp], last: NDArray[np.intp]) -> NDArray[np.intp]:
    """(..., k) the place of the greatest of heights (..., n) in each of k runs, from the first place to the last.

    Of several that are equal it is the middle one, so that a level stretch is touched within, and not where rounding or
    a corner has it.  All runs are gone through in one pass; they may share places.
    """
    counts = last - first + 1
    begins = np.cumsum(counts) - counts
    places = np.arange(counts.sum()) + np.repeat(first - begins, counts)
    in_order = np.where(np.isnan(heights), -np.inf, heights)[..., places]
    greatest = np.repeat(np.maximum.reduceat(in_order, begins, axis=-1), counts, axis=-1)
    highest = in_order >= greatest - 10.0**-PLACE_DECIMALS
    passed = np.cumsum(highest, axis=-1)
    among = np.add.reduceat(highest, begins, axis=-1, dtype=np.intp)
    middle = passed[..., begins] - highest[..., begins] + (among + 1) // 2
    found = highest & (passed == np.repeat(middle, counts, axis=-1))
    return np.minimum.reduceat(np.where(found, places, heights.shape[-1]), begins, axis=-1)


def faired_pieces(points: Points, pieces: Sequence[slice], between: int = 8) -> Points:
    """The smooth lines through the plotted points of several pieces, one after another, as :func:`faired_line`.

    Pieces of as many points are faired together.

    >>> x = np.arange(6.0)
    >>> faired_pieces(x + 1j * abs(x - 3), [slice(0, 4), slice(3, 6)], between=1).real.tolist()
    [0.0, 1.0, 2.0, 3.0, 3.0, 4.0, 5.0]
    """
    first, last = _ends(pieces, points.shape[-1])
    lines: list[Points] = [points] * first.size
    for parts in np.unique(last - first):
        alike = np.flatnonzero(last - first == parts)
        together = faired_line(points[..., first[alike, None] + np.arange(parts + 1)], between)
        for k, number in enumerate(alike):
            lines[number] = together[..., k, :]
    return np.concatenate(lines, axis=-1)


def faired_line(points: Points, between: int = 8) -> Points:
    """A smooth line through plotted points (..., n), with ``between`` short chords a part.

    Between two points the parabolas through them and either neighbour are blended into one another (A. W. Overhauser
    1968), so the line bends as the readings do.

    >>> x = np.arange(4.0)
    >>> line = faired_line(x + 1j * x**2, between=2)
    >>> complex(line[3])
    (1.5+2.25j)
    """
    if points.shape[-1] < 3:
        return points
    # One product of real matrices: x and y of four points by their shares in the places.
    powers = np.vander(np.arange(between) / between, 4, increasing=True)
    shares = np.kron((powers @ BLENDING).T, np.eye(2))
    blended = (_neighbours(points).view(np.float64) @ shares).view(np.complex128)
    line: list[Points] = [blended.reshape(*points.shape[:-1], -1), points[..., -1:]]
    return np.concatenate(line, axis=-1)


def _neighbours(points: Points) -> Points:
    """The four points (..., n - 1, 4) about every part between plotted points (..., n): its ends, and one beyond each.

    Beyond either end of the curve it lies on the parabola through the last three.
    """
    before = 3 * points[..., :1] - 3 * points[..., 1:2] + points[..., 2:3]
    after = 3 * points[..., -1:] - 3 * points[..., -2:-1] + points[..., -3:-2]
    p = np.concatenate([before, points, after], axis=-1)
    return np.stack([p[..., :-3], p[..., 1:-2], p[..., 2:-1], p[..., 3:]], axis=-1)


def along_rays(start: Points, way: Points) -> Reach:
    """How places lie beside rays (..., k) of unit directions, and how far along them."""

    def reach(places: Points) -> tuple[Distances, Distances]:
        """Distances beside the rays, and along them; NaN behind their starts."""
        from_start = places - start[..., None]
        along = dot(way[..., None], from_start)
        return cross(way[..., None], from_start), np.where(along >= 0, along, np.nan)

    return reach


def on_circles(centre: Points, radius: Distances) -> Reach:
    """How places lie beside circles (..., k), and how far from the origin, left of the way from it to the centres."""

    def reach(places: Points) -> tuple[Distances, Distances]:
        """How far places lie outside the circles, and from the origin where they are left of the way to the centres."""
        left = cross(centre[..., None], places) > 0
        return np.abs(places - centre[..., None]) - radius[..., None], np.where(left, np.abs(places), np.nan)

    return reach


def meeting(points: Points, pieces: Sequence[slice], reach: Reach) -> tuple[Points, Points]:
    """Where each of k lines or circles meets a faired curve farthest out, and how the curve runs there.

    points : (..., m) plotted;  reach : of places (..., k, n), or (..., 1, n)

    Returns
    -------
    places and directions (..., k); NaN where none is met

    >>> x = np.arange(-3.0, 4.0)
    >>> upright = along_rays(np.array([0.5 - 9j]), np.array([1j]))
    >>> place, way = meeting(x + 1j * (4 - x**2), [slice(0, 7)], upright)
    >>> complex(np.round(place, 9).item()), complex(np.round(way, 9).item())
    ((0.5+3.75j), (1-1j))
    """
    parts = np.concatenate([_neighbours(points[..., piece]) for piece in pieces], axis=-2)[..., None, :, :]
    (before, near), (after, far) = reach(parts[..., 1]), reach(parts[..., 2])
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.where(before == after, 0.0, before / (before - after))
        out = np.where(before * after <= 0, near + share * (far - near), np.nan)
    best = np.argmax(np.where(np.isnan(out), -np.inf, out), axis=-1)[..., None]
    met = np.isfinite(np.take_along_axis(out, best, -1)[..., 0])
    four = np.take_along_axis(np.broadcast_to(parts, (*out.shape, 4)), best[..., None], -2)
    cubic = np.moveaxis(four @ BLENDING.T, -1, 0)
    begin, end = np.take_along_axis(before, best, -1), np.take_along_axis(after, best, -1)
    share = _first_zero(lambda t: reach(polyval(t, cubic, tensor=False))[0], begin, end)
    places = polyval(share, cubic, tensor=False)[..., 0]
    ways = polyval(share, polyder(cubic), tensor=False)[..., 0]
    return np.where(met, places, np.nan), np.where(met, ways, np.nan)


def _first_zero(height: Callable[[Distances], Distances], begin: Distances, end: Distances) -> Distances:
    """Where heights change their sign between 0 and 1, by secants of which neither end stays (M. Dowell, P. Jarratt
    1971); ``begin`` and ``end`` are the heights there."""
    low, high = np.zeros(begin.shape), np.ones(begin.shape)
    bottom, top, before = begin, end, np.zeros(begin.shape)
    share, goes_on = low, begin * end <= 0
    for _ in range(MAX_SECANTS):
        with np.errstate(invalid="ignore", divide="ignore"):
            t = np.where(top == bottom, low, high - top * (high - low) / (top - bottom))
        # Where it comes to rest it stays, whatever lines are looked at with it.
        share, goes_on = np.where(goes_on, t, share), goes_on & (np.abs(t - share) > SAME_SHARE)
        if not goes_on.any():
            break
        there = height(share)
        side = np.where(there * top > 0, 1, -1)
        low, high = np.where(side < 0, t, low), np.where(side > 0, t, high)
        # An end that stays twice counts half.
        halved = np.where(side == before, 0.5, 1.0)
        bottom, top = np.where(side < 0, there, halved * bottom), np.where(side > 0, there, halved * top)
        before = side
    return share

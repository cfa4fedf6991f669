"""The arcs and straight parts of a closed outline whose points all lie on a few of them, as CAD programs draw cams.

A spline through such points rounds off where the curvature jumps, and the acceleration with it.  Circles are laid
through the points as far as they go.  Two parts follow one another without a corner if the line of their centres is
their common normal n, (r1 - r2) n = C2 - C1; centres and radii are corrected by the least that makes it so.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.given.cam_by_radii import OutlineArc
from graphcam.given.laws import Floats

Complexes = NDArray[np.complex128]
ON_CIRCLE = 2e-5
"""Points lie on a circle that they miss by no more [mm], as those that a program lays on an arc."""
MAX_PARTS, MIN_POINTS = 16, 6
"""The maximum number of parts, and the minimum mean number of points of each: fewer lie on any circles by chance."""
CORNER = 1e-3
"""A normal of two parts has the length 1 within so much, or they make a corner."""
STRAIGHT = 1e-9
"""Points bend so little from a straight line, as a part of their distance."""
CENTRAL = 1e-4
"""A centre as near to the cam centre [mm] is there."""
CORRECTIONS, STEP = 5, 1e-6
"""So often the parts are made to touch; each time what is left is squared.  Steps of sizes, for slopes [mm or rad]."""


@dataclass(frozen=True, eq=False)
class ArcLoop:
    """A given cam of arcs and straight parts, as it lies at the cam angle 0; made by :func:`arc_loop`.

    parts : clockwise, the order in which a cam that turns counter-clockwise meets them
    base_radius : distance of the nearest place from the cam centre [mm]
    """

    parts: tuple[OutlineArc, ...]
    base_radius: float

    def arcs(self, sigma: int = 1) -> Sequence[OutlineArc]:
        """Its parts, or those of its mirror image, clockwise too, from behind the lowest dwell if there is one."""
        parts = list(self.parts) if sigma > 0 else _mirrored(self.parts)
        dwells = [k for k, part in enumerate(parts) if math.isfinite(part.radius) and not part.centre]
        first = min(dwells, key=lambda k: parts[k].radius, default=-1) + 1
        return [*parts[first:], *parts[:first]]


def _mirrored(parts: Sequence[OutlineArc]) -> list[OutlineArc]:
    """The parts of the mirror image in the x axis: each begins where it ended."""
    return [
        OutlineArc(a.centre.conjugate(), a.radius, a.normal.conjugate(), b.point.conjugate(), b.outward.conjugate())
        for a, b in reversed([*pairwise([*parts, parts[0]])])
    ]


def arc_loop(points: Complexes) -> ArcLoop | None:
    """The loop of arcs and straight parts on which the points (n,) of a closed outline lie; None where there is none.

    points : counter-clockwise round the cam centre [mm], the first not repeated

    >>> turned = np.exp(1j * np.linspace(0, 2 * math.pi, 400, endpoint=False))
    >>> loop = arc_loop(3 + 4j + 30 * turned)
    >>> round(loop.base_radius, 9), [(round(part.radius, 9), complex(np.round(part.centre, 9))) for part in loop.parts]
    (25.0, [(30.0, (3+4j))])
    >>> arc_loop(30 * turned + 3 * turned**3) is None
    True
    """
    clockwise = points[::-1]
    if (ends := _breaks(clockwise)) is None:
        return None
    runs = [np.take(clockwise, np.arange(a, b + 1), mode="wrap") for a, b in pairwise(ends)]
    parts = _touching([_part(run) for run in runs])
    if parts is None or (len(parts) == 1 and not parts[0].centre):
        return None
    begun = [abs(part.point - run[0]) - 2 * np.abs(np.diff(run)).max() for part, run in zip(parts, runs, strict=True)]
    if len(parts) > 1 and max(begun) > CORNER:
        return None
    # The nearest place is one of these; that of the points tells which.
    near = [abs(abs(part.radius) - abs(part.centre)) for part in parts if math.isfinite(part.radius)]
    near += [abs((part.point * part.normal.conjugate()).real) for part in parts if part.normal]
    near += [abs(part.point) for part in parts]
    lowest = float(np.abs(points).min())
    return ArcLoop(tuple(parts), min(near, key=lambda radius: abs(radius - lowest)))


# --- runs of points on one circle ------------------------------------------------------------------------------------


def _breaks(points: Complexes) -> list[int] | None:
    """The numbers of the points at which the circle or the line changes, the first again at the end."""
    around, count = np.concatenate([points, points, points[:1]]), points.size
    if _on_one(around[: count + 1]):
        return [0, count]
    # From somewhere within a part to its end, and from there once around.
    start = _run_end(around, 0, count)
    found = [start]
    while found[-1] < start + count:
        found.append(_run_end(around, found[-1], start + count))
        if len(found) > MAX_PARTS + 1:
            return None
    return found if MIN_POINTS * len(found) <= count else None


def _run_end(points: Complexes, start: int, most: int) -> int:
    """The last point, at most this one, up to which those from a start lie on one circle or line."""
    low, high = start + 1, start + 3
    while high < most and _on_one(points[start : high + 1]):
        low, high = high, start + 2 * (high - start)
    high = min(high, most) + 1
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if _on_one(points[start : middle + 1]) else (low, middle)
    return low


def _on_one(points: Complexes) -> bool:
    """Whether points lie on the circle, or the line, through three of them; three alone on a line."""
    first, second, third = points[0], points[points.size // 3], points[2 * points.size // 3]
    a, b = second - first, third - first
    bend = 2 * (a.conjugate() * b).imag
    if abs(bend) <= STRAIGHT * abs(a) * abs(b):
        way = points[-1] - first
        return bool(np.abs(((points - first) * np.conj(way)).imag).max() <= ON_CIRCLE * abs(way))
    centre = first + 1j * (a * abs(b) ** 2 - b * abs(a) ** 2) / bend
    return points.size > 3 and bool(np.abs(np.abs(points - centre) - abs(first - centre)).max() <= ON_CIRCLE)


# --- circles and lines that touch ------------------------------------------------------------------------------------


def _part(run: Complexes) -> Floats:
    """What a run of points lies on: angle of the normal and distance of a line (2,), or radius and centre of a circle.

    The radius is negative of a hollow; a circle about the cam centre has nothing else (1,).
    """
    chord, middle = run[-1] - run[0], run.mean()
    normal = 1j * chord / abs(chord) if chord else 0j
    if chord and np.abs(((run - run[0]) * np.conj(normal)).real).max() <= ON_CIRCLE:
        return np.array([np.angle(normal), (middle * np.conj(normal)).real])
    inner = run[1:-1] - middle if run.size > MIN_POINTS else run - middle
    across = np.stack([2 * inner.real, 2 * inner.imag, np.ones(inner.size)], axis=-1)
    x, y, rest = np.linalg.lstsq(across, np.abs(inner) ** 2, rcond=None)[0]
    centre, radius = complex(x, y) + middle, math.sqrt(rest + x * x + y * y)
    if abs(centre) < CENTRAL:
        return np.array([radius])
    bends = (np.conj(np.diff(run)[:-1]) * np.diff(run)[1:]).imag.sum()
    return np.array([radius if bends < 0 else -radius, centre.real, centre.imag])


def _circle(size: Floats) -> tuple[complex, float]:
    """Centre and radius of a circle."""
    return (complex(*size[1:]) if size[1:].size else 0j), float(size[0])


def _touching(sizes: list[Floats]) -> list[OutlineArc] | None:
    """The parts, with their sizes corrected so that each touches the next; None if they make a corner."""
    if len(sizes) == 1:
        centre, radius = _circle(sizes[0])
        return [OutlineArc(centre, radius, 0j, centre + radius, 1 + 0j)]
    ends, values = np.cumsum([size.size for size in sizes])[:-1], np.concatenate(sizes)

    def pairs(values: Floats) -> list[tuple[Floats, Floats]]:
        """Every part and the one before it."""
        parts = np.split(values, ends)
        return [(parts[k - 1], part) for k, part in enumerate(parts)]

    def gaps(values: Floats) -> Floats:
        """How far every part misses the one before it [mm]."""
        return np.array([_gap(*pair) for pair in pairs(values)])

    if any(one.size == other.size == 2 for one, other in pairs(values)):
        return None
    for _ in range(CORRECTIONS):
        gap = gaps(values)
        slopes = np.array([(gaps(values + STEP * row) - gap) / STEP for row in np.eye(values.size)]).T
        values = values - np.linalg.lstsq(slopes, gap, rcond=None)[0]
    found = list[OutlineArc]()
    for one, other in pairs(values):
        normal = _normal(one, other)
        if not abs(abs(normal) - 1) <= CORNER:
            return None
        normal /= abs(normal)
        centre, radius = _circle(other if other.size != 2 else one)
        point = centre + radius * normal
        straight = other.size == 2
        found.append(OutlineArc(*((0j, math.inf, normal) if straight else (centre, radius, 0j)), point, normal))
    return found


def _gap(one: Floats, other: Floats) -> float:
    for line, circle in ((one, other), (other, one)):
        if line.size == 2:
            centre, radius = _circle(circle)
            return (centre * np.exp(-1j * line[0])).real + radius - line[1]
    (c1, r1), (c2, r2) = _circle(one), _circle(other)
    return abs(c2 - c1) - abs(r1 - r2)


def _normal(one: Floats, other: Floats) -> complex:
    """The common normal of two parts, outwards; of circles that do not touch it has another length than 1."""
    for line in (one, other):
        if line.size == 2:
            return complex(np.exp(1j * line[0]))
    (c1, r1), (c2, r2) = _circle(one), _circle(other)
    return (c2 - c1) / (r1 - r2) if r1 != r2 else 0j

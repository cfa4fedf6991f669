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
CORRECTIONS = 5
"""So often the parts are made to touch; each time what is left is squared."""


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
    """What a run of points lies on: centre and signed radius (3,), or normal and distance of a line (2,), outwards."""
    chord = run[-1] - run[0]
    normal = 1j * chord / abs(chord) if chord else 0j
    middle = run.mean()
    if chord and np.abs(((run - run[0]) * np.conj(normal)).real).max() <= ON_CIRCLE:
        return np.array([np.angle(normal), (middle * np.conj(normal)).real])
    inner = run[1:-1] - middle if run.size > MIN_POINTS else run - middle
    across = np.stack([2 * inner.real, 2 * inner.imag, np.ones(inner.size)], axis=-1)
    x, y, rest = np.linalg.lstsq(across, np.abs(inner) ** 2, rcond=None)[0]
    bends = (np.conj(np.diff(run)[:-1]) * np.diff(run)[1:]).imag.sum()
    centre = complex(x, y) + middle
    radius = math.sqrt(rest + x * x + y * y)
    if abs(centre) < CENTRAL:
        return np.array([0.0, 0.0, radius])
    return np.array([centre.real, centre.imag, radius if bends < 0 else -radius])


def _touching(sizes: list[Floats]) -> list[OutlineArc] | None:
    """The parts, with their sizes corrected so that each touches the next; None if they make a corner."""
    if len(sizes) == 1:
        x, y, radius = sizes[0].tolist()
        return [OutlineArc(complex(x, y), radius, 0j, complex(x + radius, y), 1 + 0j)]
    pairs = [(k - 1, k) for k in range(len(sizes))]
    if any(sizes[i].size == sizes[k].size == 2 for i, k in pairs):
        return None
    places = np.cumsum([0, *(size.size for size in sizes)])
    values = np.concatenate(sizes)
    # What stands about the cam centre stays there.
    loose = np.flatnonzero(np.concatenate([[each.size < 3 or bool(each[:2].any())] * each.size for each in sizes]))
    loose = np.union1d(loose, [places[k] + 2 for k, each in enumerate(sizes) if each.size == 3])

    def split(values: Floats) -> list[Floats]:
        return np.split(values, places[1:-1])

    def gaps(values: Floats) -> Floats:
        """How far every part misses the next [mm]."""
        parts = split(values)
        return np.array([_gap(parts[i], parts[k]) for i, k in pairs])

    for _ in range(CORRECTIONS):
        gap = gaps(values)
        slopes = np.array([(gaps(values + STEP * row) - gap) / STEP for row in np.eye(values.size)[loose]]).T
        values[loose] -= np.linalg.lstsq(slopes, gap, rcond=None)[0]
    parts, found = split(values), list[OutlineArc]()
    for i, k in pairs:
        normal, point = _joint(parts[i], parts[k])
        if abs(abs(normal) - 1) > CORNER:
            return None
        if parts[k].size == 2:
            found.append(OutlineArc(0j, math.inf, normal, point, normal))
        else:
            found.append(OutlineArc(complex(*parts[k][:2]), float(parts[k][2]), 0j, point, normal / abs(normal)))
    return found


STEP = 1e-6
"""Of sizes, for slopes [mm or rad]."""


def _gap(one: Floats, other: Floats) -> float:
    if one.size == other.size == 3:
        return math.hypot(*(other[:2] - one[:2])) - abs(one[2] - other[2])
    line, circle = (one, other) if one.size == 2 else (other, one)
    return circle[0] * math.cos(line[0]) + circle[1] * math.sin(line[0]) + circle[2] - line[1]


def _joint(one: Floats, other: Floats) -> tuple[complex, complex]:
    """The common normal, outwards, and the place where two parts touch."""
    if one.size == other.size == 3:
        normal = complex(*(other[:2] - one[:2])) / (one[2] - other[2])
    else:
        angle = (one if one.size == 2 else other)[0]
        normal = complex(math.cos(angle), math.sin(angle))
    circle = one if one.size == 3 else other
    return normal, complex(*circle[:2]) + circle[2] * normal / abs(normal)

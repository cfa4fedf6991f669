"""How a hand draws lines: it wobbles, it draws a curve in several goes, it rubs out, hatches and scribbles."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from bent_paper import Floats, Points
from pencil import Rng, Stroke
from scipy.ndimage import gaussian_filter1d

STEP = 0.25
"""Between the points of a line, mm."""
WOBBLE = 12.0
"""Over so many mm a hand strays to one side, and then to the other."""


def even(line: Points, *, closed: bool = False, step: float = STEP) -> Points:
    """The line (n,) with points at equal distances; a closed one ends one step before it begins."""
    line = np.append(line, line[0]) if closed else np.asarray(line)
    way = np.append(0.0, np.cumsum(np.abs(np.diff(line))))
    count = max(2, round(way[-1] / step))
    at = np.arange(count) * way[-1] / count if closed else np.linspace(0, way[-1], count + 1)
    return np.interp(at, way, line)


def normals(line: Points, *, closed: bool) -> Points:
    """To the right of the way (n,), unit."""
    along = np.roll(line, -1) - np.roll(line, 1) if closed else np.gradient(line)
    return -1j * along / np.maximum(np.abs(along), 1e-12)


def wobble(count: int, deviation: float, rng: Rng, *, closed: bool, over: float = WOBBLE) -> Floats:
    """How far to one side each of so many points strays, with just this standard deviation [mm]."""
    if count < 4 or not deviation:
        return np.zeros(count)
    # Smoothed so, places that far apart have a third in common.
    strays = gaussian_filter1d(rng.standard_normal(count), over / 2 / STEP, mode="wrap" if closed else "reflect")
    return np.asarray(strays * deviation / max(float(np.sqrt(np.mean(strays**2))), 1e-12))


def by_hand(line: Points, deviation: float, rng: Rng, *, closed: bool) -> Points:
    """The line (n,) as a hand draws it, with points at equal distances."""
    points = even(line, closed=closed)
    return points + normals(points, closed=closed) * wobble(points.size, deviation, rng, closed=closed)


def goes(line: Points, rng: Rng, *, closed: bool, apart: float = 0.08) -> list[Points]:
    """The line in several goes of a French curve: each begins a little before the last one ends, and beside it."""
    count = int(rng.integers(3, 8))
    cuts = np.sort(rng.choice(np.arange(1, 20), count - 1, replace=False)) * line.size // 20
    if closed:
        line = np.roll(line, -int(rng.integers(line.size)))
        cuts = np.concatenate([[0], cuts, [line.size]])
    else:
        cuts = np.concatenate([[0], cuts, [line.size - 1]])
    found: list[Points] = []
    for start, end in pairwise(cuts):
        longer = rng.integers(2, 12, 2)
        places = np.arange(start - longer[0], end + longer[1])
        places = places % line.size if closed else places[(places >= 0) & (places < line.size)]
        piece = line[places]
        if piece.size >= 2:
            aside = normals(piece, closed=False) * rng.normal(0, apart)
            found.append(piece + aside)
    return found


def straight(start: complex, end: complex, rng: Rng, *, over: float = 1.0, deviation: float = 0.05) -> Stroke:
    """Along a ruler, a little beyond both ends."""
    way = (end - start) / abs(end - start)
    line = even(np.array([start - way * rng.uniform(0, over), end + way * rng.uniform(0, over)]), step=1.0)
    slow = wobble(line.size, deviation, rng, closed=False, over=30.0 * STEP)
    return Stroke.of(line + 1j * way * slow, rng)


def cross(place: complex, rng: Rng, size: float = 1.5) -> list[Stroke]:
    """Two short strokes through a point, each off by a little."""
    turn = np.exp(1j * np.radians(rng.uniform(-10, 10) + 45 * (rng.random() < 0.3)))
    found: list[Stroke] = []
    for way in (turn, 1j * turn):
        ends = place + way * np.array([-1, 1]) * size * rng.uniform(0.8, 1.15, 2) + 1j * way * rng.normal(0, 0.03)
        found.append(Stroke.of(np.linspace(ends[0], ends[1], 8), rng, taper=0.5))
    return found


def dot(place: complex, rng: Rng) -> list[Stroke]:
    """A dot made by turning the pencil."""
    turns = np.linspace(0, 6 * np.pi, 40)
    spiral = np.linspace(0.02, rng.uniform(0.2, 0.32), 40) * np.exp(1j * turns)
    return [Stroke.of(place + spiral, rng, taper=0.0)]


def ring(place: complex, rng: Rng) -> list[Stroke]:
    """A small circle about a point, as of a stencil."""
    turns = np.linspace(0, 2 * np.pi + 0.2, 50)
    return [Stroke.of(place + rng.uniform(0.65, 0.85) * np.exp(1j * turns), rng, taper=0.0)]


def hatching(outline: Points, angle: float, apart: float, rng: Rng) -> list[Stroke]:
    """Parallel strokes within an outline (n,), not quite parallel."""
    way = np.exp(1j * angle)
    own = outline * np.conj(way)
    found: list[Stroke] = []
    for height in np.arange(own.imag.min() + apart, own.imag.max(), apart):
        level = height + rng.normal(0, 0.12 * apart)
        after = np.roll(own, -1)
        cuts = (own.imag - level) * (after.imag - level) < 0
        part = (level - own.imag[cuts]) / (after.imag[cuts] - own.imag[cuts])
        ends = np.sort(own.real[cuts] + part * (after.real[cuts] - own.real[cuts]))
        for left, right in zip(ends[::2], ends[1::2], strict=False):
            tilt = rng.normal(0, 0.01) * (right - left)
            line = np.array([left + 1j * level, right + 1j * (level + tilt)]) * way
            found.append(straight(line[0], line[1], rng, deviation=0.1))
    return found


def scribble(middle: complex, reach: float, rng: Rng, length: int = 900) -> Stroke:
    """A line that goes to and fro about a place."""
    steps = gaussian_filter1d(rng.standard_normal(length) + 1j * rng.standard_normal(length), 12)
    line = np.cumsum(steps)
    line -= line.mean()
    return Stroke.of(middle + even(line / np.abs(line).max() * reach), rng)

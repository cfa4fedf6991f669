"""Whether a motion rests where it slows down, and from where to where: decided by least squares.

Near a rest, or near a place where the motion turns, a law of motion leaves its level as a power of the way:
s = L + c z^p (1 + b z) with z the cam angle since it left and p = 2 (the acceleration jumps), 3 (the jerk does) or 4.
All of L, c, b, p and the place where it leaves are sought on both sides at once, by linear least squares for every p
on places that are refined.  The motion rests if two places, one on either side, explain the rows better than one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphcam.given.laws import Floats

POWERS = np.array([2, 3, 4])
PLACES, ROUNDS, NARROWER = 13, 6, 4.0
"""Places tried at a time, how often they are tried, and by how much their range shrinks every time."""
EVIDENCE = 16.0
"""A rest takes so much from the sum of squares [variances of the noise] beside a turning, or it is none."""
TINY = 1e-9
"""Less way than this [rad] is none."""
SNAP = 4.0
"""A rest ends at a row if that costs the sum of squares no more than this [variances of the noise]."""


@dataclass(frozen=True)
class Stop:
    """Where a motion rests, or turns (then start = end).

    start, end : cam angles [rad]
    powers : with which power of the way the motion comes and leaves
    misfit : the mean square of what is left, in variances of the noise
    """

    start: float
    end: float
    powers: tuple[int, int]
    misfit: float


class _Squares(NamedTuple):
    """The least sum of squares of a stretch as a function of the level: least + weight (L - level)^2."""

    least: Floats
    weight: Floats
    level: Floats


def find_stop(
    x: Floats, y: Floats, directions: tuple[int, int], reach: tuple[float, float], noise: float, gap: float
) -> Stop:
    """The stop in a stretch of rows about x = 0.

    x, y : (n,) cam angles [rad] that grow, and displacements
    directions : of the displacement away from the stop, before and after
    reach : how far before and after 0 the motion may have left at most
    gap : between rows
    """
    variance = noise**2
    rows = max(x.size - 7, 1)
    turn, place, powers = _turning(x, y, directions, reach)
    rest, before, after, left_by = _rest(x, y, directions, reach, variance)
    if not rest + EVIDENCE * variance < turn or before + after < gap:
        return Stop(place, place, powers, turn / variance / rows)
    return Stop(-before, after, left_by, rest / variance / rows)


def _leaving(x: Floats, y: Floats, direction: int, left: Floats, since: Floats, power: Floats) -> _Squares:
    """Of the rows from ``since`` on, for a motion that leaves at ``left`` with ``power``, (m,) each."""
    z = np.maximum(x - left[:, None], 0.0) / np.maximum(x[-1] - left, TINY)[:, None]
    rows = (x >= since[:, None]).astype(np.float64)
    first = rows * z ** power[:, None]
    second = first * z
    columns = np.stack([rows, first, second], axis=1)
    gram = columns @ columns.transpose(0, 2, 1)
    moments = columns @ y
    total = rows @ (y * y)
    (a, b), (_, c) = gram[:, 1:, 1:].transpose(1, 2, 0)
    determinant = a * c - b * b
    sound = determinant > 1e-12 * a * c
    inverse = np.array([[c, -b], [-b, a]]) / np.where(sound, determinant, 1.0)
    by_level = np.einsum("ijm,mj->im", inverse, gram[:, 0, 1:])
    by_rows = np.einsum("ijm,mj->im", inverse, moments[:, 1:])
    weight = gram[:, 0, 0] - np.einsum("im,mi->m", by_level, gram[:, 0, 1:])
    sound &= weight > 1e-9
    weight = np.where(sound, weight, 1.0)
    level = (moments[:, 0] - np.einsum("im,mi->m", by_level, moments[:, 1:])) / weight
    c0, c1 = direction * (by_rows - by_level * level)
    sound &= (c0 > 0) & (power * c0 + (power + 1) * c1 > 0)
    least = total - np.einsum("im,mi->m", by_rows, moments[:, 1:]) - weight * level**2
    return _Squares(np.where(sound, np.maximum(least, 0.0), np.inf), weight, level)


def _together(a: _Squares, b: _Squares) -> Floats:
    """The least sum of squares of two stretches at one level."""
    return a.least + b.least + a.weight * b.weight / (a.weight + b.weight) * (a.level - b.level) ** 2


def _turning(x: Floats, y: Floats, directions: tuple[int, int], reach: tuple[float, float]):
    """The least sum of squares of a motion that turns at one place, the place, and its powers."""
    before, after = (p.ravel() for p in np.meshgrid(POWERS, POWERS, indexing="ij"))
    low, high = np.full(before.size, -reach[0]), np.full(before.size, reach[1])
    every = np.arange(before.size)
    for _ in range(ROUNDS):
        places = np.linspace(low, high, PLACES)
        flat = places.ravel()
        come = _leaving(-x[::-1], y[::-1], directions[0], -flat, -flat, np.tile(before, PLACES))
        leave = _leaving(x, y, directions[1], flat, flat, np.tile(after, PLACES))
        squares = _together(come, leave).reshape(places.shape)
        best = squares.argmin(axis=0)
        half = (high - low) / NARROWER / 2
        centre = places[best, every]
        low, high = np.maximum(centre - half, -reach[0]), np.minimum(centre + half, reach[1])
    least = squares[best, every]
    k = int(np.argmin(least))
    return float(least[k]), float(centre[k]), (int(before[k]), int(after[k]))


def _rest(x: Floats, y: Floats, directions: tuple[int, int], reach: tuple[float, float], variance: float):
    """The least sum of squares of a motion that rests about 0, how far before and after, and its powers."""
    sides = (-x[::-1], y[::-1], directions[0]), (x, y, directions[1])
    every = np.arange(POWERS.size)
    low = [np.zeros(POWERS.size), np.zeros(POWERS.size)]
    high = [np.full(POWERS.size, far) for far in reach]
    level = float(np.median(y[np.abs(x) <= min(reach) / 2])) if np.any(np.abs(x) <= min(reach) / 2) else float(y[np.argmin(np.abs(x))])
    for _ in range(ROUNDS):
        found, chosen = [], []
        for k, (along, values, direction) in enumerate(sides):
            places = np.linspace(low[k], high[k], PLACES)
            squares = _leaving(along, values, direction, places.ravel(), np.zeros(places.size), np.tile(POWERS, PLACES))
            at_level = (squares.least + squares.weight * (level - squares.level) ** 2).reshape(places.shape)
            best = at_level.argmin(axis=0)
            half = (high[k] - low[k]) / NARROWER / 2
            centre = places[best, every]
            low[k], high[k] = np.maximum(centre - half, 0.0), np.minimum(centre + half, reach[k])
            power = int(np.argmin(at_level[best, every]))
            pick = best[power] * POWERS.size + power
            found.append(_Squares(*(part[pick] for part in squares)))
            chosen.append((float(centre[power]), int(POWERS[power])))
        if not all(np.isfinite(one.least) for one in found):
            return np.inf, 0.0, 0.0, (2, 2)
        a, b = found
        level = float((a.weight * a.level + b.weight * b.level) / (a.weight + b.weight))
    (before, coming), (after, leaving) = _snapped(sides, chosen, level, variance)
    return float(_together(*found)), before, after, (coming, leaving)


def _snapped(sides, chosen, level, variance):
    """The ends of a rest, at the nearest row where the rows allow it, because phases mostly begin where a table has one."""
    ends = []
    for (along, values, direction), (end, power) in zip(sides, chosen, strict=True):
        row = float(along[np.argmin(np.abs(along - end))])
        places = np.array([end, max(row, 0.0)])
        squares = _leaving(along, values, direction, places, np.zeros(2), np.full(2, power))
        cost = np.diff(squares.least + squares.weight * (level - squares.level) ** 2)[0]
        ends.append((row if cost <= SNAP * variance and row > 0 else end, power))
    return ends

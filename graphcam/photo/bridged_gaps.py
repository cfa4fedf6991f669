"""Short gaps of a curve, bridged by the run of what is seen before and behind them; no other knowledge goes in."""

import numpy as np
from numpy.typing import NDArray

from graphcam.photo.flag_runs import Flags, runs
from graphcam.photo.printed import Points

LONGEST_GAP = 9.0
"""The maximum gap of a curve [mm]: less than the distance of two stations, so that it cannot turn unseen."""
NEIGHBOURS = 5
"""Stations on either side whose run is prolonged, about 5 mm: less is the hand's tremor."""
NOWHERE = complex(np.nan, np.nan)


def bridged(points: Points, seen: Flags, lengths: NDArray[np.float64], wraps: bool) -> Points:
    """The points (n,) where they are seen, between them over gaps up to ``LONGEST_GAP``, and NaN elsewhere.

    A gap at an end of an open curve has one neighbour only, and stays.

    >>> line = np.arange(12) + 0j
    >>> seen = (line != 5) & (line != 11)
    >>> bridged(line + 9j * ~seen, seen, np.ones(12), wraps=False)[[5, 11]]
    array([ 5. +0.j, nan+nanj])
    """
    whole = np.where(seen, points, NOWHERE)
    if not seen.any():
        return whole
    count = points.size
    for gap in runs(~seen, wraps):
        before, behind = int(gap[0]) - 1, int(gap[-1]) + 1
        if lengths[gap].sum() > LONGEST_GAP or (not wraps and (before < 0 or behind >= count)):
            continue
        start, from_start = _run(whole, before, -1, wraps)
        end, to_end = _run(whole, behind % count, 1, wraps)
        at = np.arange(1, gap.size + 1) / (gap.size + 1)
        whole[gap] = _hermite(at, start, from_start * (gap.size + 1), end, to_end * (gap.size + 1))
    return whole


def _run(points: Points, last: int, away: int, wraps: bool) -> tuple[complex, complex]:
    """The point at the edge of a gap and the step from station to station there, by the stations away from it."""
    stations = last + away * np.arange(NEIGHBOURS)
    if not wraps:
        stations = stations[(stations >= 0) & (stations < points.size)]
    near = points[stations % points.size]
    unbroken = int(np.argmin(np.append(np.isfinite(near), False)))
    if unbroken < 2:
        return complex(near[0]), 0j
    at = away * np.arange(unbroken)
    # A parabola, as the run of a curve changes its direction within 5 mm.
    step, edge = np.polyfit(at, near[:unbroken], 2 if unbroken > 3 else 1)[-2:]
    return complex(edge), complex(step)


def _hermite(at: NDArray[np.float64], start: complex, ahead: complex, end: complex, arriving: complex) -> Points:
    """The cubic from start to end with these derivatives, at parameters (n,) from 0 to 1."""
    rest = 1 - at
    return rest**2 * ((1 + 2 * at) * start + at * ahead) + at**2 * ((1 + 2 * rest) * end - rest * arriving)

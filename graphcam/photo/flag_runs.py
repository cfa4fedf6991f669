"""Runs of like stations of a curve, and short gaps in it, bridged by the run of the curve on both sides."""

import numpy as np
from numpy.typing import NDArray

from graphcam.photo.printed_page import Points

Flags = NDArray[np.bool_]


def flag_runs(flags: Flags, wraps: bool) -> list[NDArray[np.int64]]:
    """The station numbers of each run of true flags (n,), in order; of a closed curve also across its end.

    >>> [run.tolist() for run in flag_runs(np.array([1, 1, 0, 1, 0, 1], bool), wraps=True)]
    [[3], [5, 0, 1]]
    >>> [run.tolist() for run in flag_runs(np.array([1, 1, 0, 1, 0, 1], bool), wraps=False)]
    [[0, 1], [3], [5]]
    """
    if flags.all():
        return [np.arange(flags.size)]
    first = int(np.argmin(flags)) if wraps else 0
    turned = np.concatenate([[False], np.roll(flags, -first), [False]])
    starts, ends = np.flatnonzero(~turned[:-1] & turned[1:]), np.flatnonzero(turned[:-1] & ~turned[1:])
    return [(np.arange(start, end) + first) % flags.size for start, end in zip(starts, ends, strict=True)]


def long_runs(flags: Flags, lengths: NDArray[np.float64], least: float, wraps: bool) -> Flags:
    """The flags (n,) without runs that are shorter than the least length; ``lengths`` (n,) are those of the stations.

    >>> long_runs(np.array([1, 1, 0, 1, 0, 1], bool), np.ones(6), 2.0, wraps=False).tolist()
    [True, True, False, False, False, False]
    """
    kept = np.zeros(flags.shape, np.bool_)
    for run in flag_runs(flags, wraps):
        kept[run] = lengths[run].sum() >= least
    return kept


def longest_run(flags: Flags, lengths: NDArray[np.float64], wraps: bool) -> float:
    """The length of the longest run of true flags (n,), in the unit of the stations' ``lengths`` (n,).

    >>> longest_run(np.array([1, 1, 0, 1], bool), np.ones(4), wraps=True)
    3.0
    """
    return max((float(lengths[run].sum()) for run in flag_runs(flags, wraps)), default=0.0)


MAX_GAP = 9.0
"""The maximum gap of a curve [mm]: less than the distance of two stations, so that it cannot turn unseen."""
NEIGHBOUR_COUNT = 5
"""The number of stations on either side that give the run, about 5 mm: fewer would follow the hand's tremor."""
NOWHERE = complex(np.nan, np.nan)


def bridged(points: Points, seen: Flags, lengths: NDArray[np.float64], wraps: bool) -> Points:
    """The points (n,) where they are seen, between them over gaps up to ``MAX_GAP``, and NaN elsewhere.

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
    for gap in flag_runs(~seen, wraps):
        before, behind = int(gap[0]) - 1, int(gap[-1]) + 1
        if lengths[gap].sum() > MAX_GAP or (not wraps and (before < 0 or behind >= count)):
            continue
        start, from_start = _run(whole, before, -1, wraps)
        end, to_end = _run(whole, behind % count, 1, wraps)
        at = np.arange(1, gap.size + 1) / (gap.size + 1)
        whole[gap] = _hermite(at, start, from_start * (gap.size + 1), end, to_end * (gap.size + 1))
    return whole


def _run(points: Points, last: int, away: int, wraps: bool) -> tuple[complex, complex]:
    """The point at the edge of a gap, and the step per station there."""
    stations = last + away * np.arange(NEIGHBOUR_COUNT)
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

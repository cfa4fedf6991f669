"""Runs of stations of a curve that are alike."""

import numpy as np
from numpy.typing import NDArray

Flags = NDArray[np.bool_]


def runs(flags: Flags, wraps: bool) -> list[NDArray[np.int64]]:
    """The numbers of the stations of each run of true flags (n,), in order; of a closed curve also over its end.

    >>> [run.tolist() for run in runs(np.array([1, 1, 0, 1, 0, 1], bool), wraps=True)]
    [[3], [5, 0, 1]]
    >>> [run.tolist() for run in runs(np.array([1, 1, 0, 1, 0, 1], bool), wraps=False)]
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
    for run in runs(flags, wraps):
        kept[run] = lengths[run].sum() >= least
    return kept


def longest_run(flags: Flags, lengths: NDArray[np.float64], wraps: bool) -> float:
    """The length of the longest run of true flags (n,).

    >>> longest_run(np.array([1, 1, 0, 1], bool), np.ones(4), wraps=True)
    3.0
    """
    return max((float(lengths[run].sum()) for run in runs(flags, wraps)), default=0.0)

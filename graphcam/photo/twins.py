"""Two lines beside each other, nearer than a second curve is looked for: two crests in the profile across a curve."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from graphcam.photo.flag_runs import Flags, long_runs
from graphcam.photo.pencil_ink import Ink
from graphcam.photo.tracks import SHORTEST_RUN, Track

REACH = 2.2
"""Half the profile [mm] in which a second crest is looked for."""
STEP = 0.1
"""The step along the profile [mm]."""
CENTRAL = 0.7
"""The curve's own crest lies so near to its path [mm]."""
NEAREST = 0.55
"""Two crests are at least so far apart [mm]; nearer ones a photograph shows as one."""
SECOND = 0.45
"""Share of the first crest's height that a second one has: what an eraser leaves has less."""
VALLEY = 0.8
"""Share of the second crest's height below which the profile falls between the two."""
ALONG = 1.5
"""Deviation over which profiles are smoothed along the curve [stations], against crosses and digits."""


def twin_share(track: Track, seen: Flags, ink: Ink, wraps: bool) -> float:
    """Share of the seen length along which there are two crests, over at least ``SHORTEST_RUN`` at once."""
    offsets = np.arange(-REACH, REACH + STEP / 2, STEP)
    profiles = ink.at(track.path[:, None] + track.normal[:, None] * offsets)
    profiles = gaussian_filter1d(profiles, ALONG, axis=0, mode="wrap" if wraps else "nearest")
    double = long_runs(seen & _two_crests(profiles, offsets), track.lengths, SHORTEST_RUN, wraps)
    return float(track.lengths[double].sum() / max(float(track.lengths[seen].sum()), 1e-6))


def _two_crests(profiles: NDArray[Any], offsets: NDArray[np.float64]) -> Flags:
    """Whether profiles (n, m) have a second crest."""
    station = np.arange(profiles.shape[0])
    central = np.flatnonzero(np.abs(offsets) < CENTRAL)
    crest = central[profiles[:, central].argmax(1)]
    height = profiles[station, crest]
    found = np.zeros(station.size, np.bool_)
    for k in range(1, offsets.size - 1):
        second = profiles[:, k]
        is_crest = (second >= profiles[:, k - 1]) & (second >= profiles[:, k + 1])
        apart = np.abs(offsets[k] - offsets[crest]) > NEAREST
        high = is_crest & apart & (second > SECOND * height)
        for row in np.flatnonzero(high):
            low, top = sorted((k, int(crest[row])))
            found[row] |= profiles[row, low:top].min() < VALLEY * second[row]
    return found

"""The track of a line through a grid: at which stations it is seen, and its exact place there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from graphcam.photo.curve_grid import BestWay, CurveGrid, Evidence, hidden_places
from graphcam.photo.flag_runs import Flags, flag_runs, long_runs
from graphcam.photo.pencil_ink import Ink
from graphcam.photo.printed_page import Points
from graphcam.photo.raster import ALONG_DEVIATION, Raster

MIN_SIGNAL_TO_NOISE = 6.0
"""The minimum strength of a line, in standard deviations of noise."""
STRENGTH_SHARE = 0.35
"""The minimum strength of a line, as a share of its strong places: what an eraser leaves is fainter."""
STRENGTH_PERCENTILE = 80
"""The percentile of a line's answers that is the strength of its strong places."""
MIN_RESIDUE_FACTOR = 2.0
"""The minimum strength of a line beside print, as a multiple of what is left of the print."""
MIN_DENSITY = 0.02
"""The density of the faintest line."""
MIN_COHERENCE = 0.6
"""The minimum answer in the line's own direction, as a share of the best in any near by: a crossing or digit has less.
"""
COHERENCE_OFFSETS = np.array([-0.4, -0.2, 0.0, 0.2, 0.4])
"""Offsets to both sides at which the best direction is looked for [mm]."""
MIN_RUN_LENGTH = 5.0
"""The minimum length over which a line is seen at once [mm]; shorter runs come from crossings."""
MIN_GAP = 2.0
"""The minimum length of a gap [mm]; a shorter one is the crossing of a ray."""
STEP_SMOOTHING = 1.5
"""The deviation of the smoothing of the grid's steps [stations]."""
PROFILE_HALF_WIDTH = 0.8
"""Half the width of the profile by which a line is placed [mm]."""
BARE_PAPER_DISTANCE = 1.4
"""The distance from the crest of a stroke at which the paper is bare on both sides [mm]."""
MAX_PAPER_DENSITY_SHARE = 0.3
"""The maximum density of the paper beside a stroke as a share of its own; in a finger or a table's edge it is half."""
PROFILE_FOOT_SHARE = 0.3
"""The share of a profile's height that is its foot, and has no weight for its place."""
PLACE_SMOOTHING = 1.0
"""The deviation of the smoothing of places [stations], about 1 mm: between rough paper and tremor."""


@dataclass(frozen=True, eq=False)
class Track:
    """A way through a grid with what is seen on it, by stations (n,).

    path : places on the page, exact to the grid's step
    normal : unit normals, to the side of the greater states
    answers : how much more ink lies on it than beside it;  strong : that of its strong places
    best : how much more ink lies on a line in any direction near by;  coherence : share of it that lies on one near by
        in the way's own direction
    hidden : by black print, or outside the room;  beside : light print
    lengths : of the path, mm
    """

    states: NDArray[np.int64]
    path: Points
    normal: Points
    answers: NDArray[np.float32]
    strong: float
    best: NDArray[np.float32]
    coherence: NDArray[np.float32]
    hidden: Flags
    beside: Flags
    lengths: NDArray[np.float64]


def track_of(way: BestWay, grid: CurveGrid, evidence: Evidence, ink: Ink) -> Track:
    """The track along a way through a grid."""
    station = np.arange(way.states.size)
    states = grid.places.shape[1]
    around = np.round(COHERENCE_OFFSETS / grid.spacing[way.states][:, None]).astype(np.int64)
    nearby = np.clip(way.states[:, None] + around, 0, states - 1)
    answers = evidence.answers[station, way.states, way.slopes + grid.steepest]
    best = evidence.best[station[:, None], nearby].max(1)
    # Where any place on a dark stroke is reward enough the way runs beside its crest: that is no matter of direction.
    own = evidence.answers[station[:, None], nearby, way.slopes[:, None] + grid.steepest].max(1)
    black = hidden_places(ink.black, grid)
    hidden = black[station[:, None], nearby].any(1) | ~grid.inside[station, way.states]
    smooth = gaussian_filter1d(way.states.astype(float), STEP_SMOOTHING, mode="wrap" if grid.wraps else "nearest")
    path = grid.between(smooth)
    ahead = steps(path, grid.wraps)
    normal = 1j * ahead / np.maximum(np.abs(ahead), 1e-9)
    # Round an origin counter-clockwise that points inwards.
    normal *= np.where((normal * np.conj(grid.across[:, 0])).real < 0, -1, 1)
    open_answers = answers[~hidden]
    return Track(
        states=way.states,
        path=path,
        normal=normal,
        answers=answers,
        strong=float(np.percentile(open_answers, STRENGTH_PERCENTILE)) if open_answers.size else 0.0,
        best=best,
        coherence=own / np.maximum(best, 1e-6),
        hidden=hidden,
        beside=ink.beside_print(path),
        lengths=np.abs(ahead),
    )


def steps(path: Points, wraps: bool) -> Points:
    """The vectors (n,) from the middle before each station to the middle behind it.

    >>> steps(np.array([0j, 1, 3]), wraps=False).tolist()
    [(1+0j), (1.5+0j), (2+0j)]
    """
    return (np.roll(path, -1) - np.roll(path, 1)) / 2 if wraps else np.gradient(path)


def seen_stations(track: Track, evidence: Evidence, ink: Ink, wraps: bool) -> Flags:
    """Flags (n,) of the stations at which a line is seen; at the others it may be hidden."""
    least = max(MIN_SIGNAL_TO_NOISE * evidence.noise, STRENGTH_SHARE * track.strong, MIN_DENSITY)
    beside_print = max(least, MIN_RESIDUE_FACTOR * ink.residue)
    enough = track.answers > np.where(track.beside, beside_print, least)
    coherent = track.coherence > MIN_COHERENCE
    # Where a ray crosses nothing is seen, but the line runs on.
    crossed = ~coherent & ~long_runs(~coherent, track.lengths, MIN_GAP, wraps)
    running = enough & (coherent | crossed) & ~track.hidden
    seen = long_runs(running, track.lengths, MIN_RUN_LENGTH, wraps) & coherent
    return _without_ends(seen, track.lengths, wraps)


def _without_ends(seen: Flags, lengths: NDArray[np.float64], wraps: bool) -> Flags:
    """Flags (n,) without those beside a true gap, where a filter still answers to the stroke that has ended."""
    kept = seen.copy()
    for gap in flag_runs(~seen, wraps):
        if lengths[gap].sum() > MIN_GAP:
            more = int(np.ceil(ALONG_DEVIATION / max(float(lengths[gap].mean()), 1e-6)))
            around = np.concatenate([gap[0] - 1 - np.arange(more), gap[-1] + 1 + np.arange(more)])
            kept[around % seen.size if wraps else np.clip(around, 0, seen.size - 1)] = False
    return kept


def line_places(track: Track, sharp: Raster, wraps: bool) -> Points:
    """The places (n,) of the line: the middle of its profile, as sharp as the photograph is."""
    offsets = np.arange(-PROFILE_HALF_WIDTH, PROFILE_HALF_WIDTH + 0.025, 0.05)
    profile = sharp.at(track.path[:, None] + track.normal[:, None] * offsets)
    profile = gaussian_filter1d(profile, PLACE_SMOOTHING, axis=0, mode="wrap" if wraps else "nearest")
    weights = above_foot(profile, offsets)
    return track.path + track.normal * (weights @ offsets) / np.maximum(weights.sum(1), 1e-9)


def is_stroke(track: Track, pencil: Raster) -> Flags:
    """Flags (n,) of stations with lighter paper on both sides, as beside no edge of a finger or of a table."""
    offsets = np.arange(-PROFILE_HALF_WIDTH, PROFILE_HALF_WIDTH + 0.05, 0.1)
    profile = pencil.at(track.path[:, None] + track.normal[:, None] * offsets)
    crest = track.path + track.normal * offsets[profile.argmax(1)]
    sides = np.stack([pencil.at(crest + side * BARE_PAPER_DISTANCE * track.normal) for side in (-1, 1)])
    return sides.max(0) < MAX_PAPER_DENSITY_SHARE * profile.max(1)


def above_foot(profile: NDArray[Any], offsets: NDArray[np.float64]) -> NDArray[np.float64]:
    """Weights (n, m) of profiles (n, m): what rises above the paper at both ends, and above the foot."""
    ends = np.abs(offsets) > np.abs(offsets).max() - 0.25
    risen = profile - np.median(profile[:, ends], axis=1, keepdims=True)
    return np.asarray(np.maximum(risen - PROFILE_FOOT_SHARE * risen.max(1, keepdims=True), 0), float)

"""A curve drawn in a view, read without knowledge of its course; what is not seen of it stays missing.

Of a closed curve r(theta) about the view's origin is read, else y(x) over its axis; both are the best way through a
grid of places, looked for by lines in the pencil, then looked at station by station.

How often the limits of a refusal decide wrongly is measured by the trial of simulated photographs
(tests/photos/trial.py).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, maximum_filter1d

from graphcam.photo.curve_grid import (
    OUTSIDE_REWARD,
    BestWay,
    CurveGrid,
    Evidence,
    best_way,
    evidence_of,
    grid_of,
    hidden_places,
)
from graphcam.photo.flag_runs import MAX_GAP, Flags, bridged, flag_runs, long_runs, longest_run
from graphcam.photo.line_tracks import (
    MIN_GAP,
    MIN_RUN_LENGTH,
    STRENGTH_PERCENTILE,
    Track,
    is_stroke,
    line_places,
    seen_stations,
    track_of,
)
from graphcam.photo.pencil_ink import Ink
from graphcam.photo.printed_page import Points, PrintedView
from graphcam.words import Words, say

FULL_REWARD = 12.0
"""The contrast for full reward, in standard deviations of noise."""
INITIAL_FULL_DENSITY = 0.05
"""The density for full reward while the strength of the curve is not known yet."""
FULL_STRENGTH_SHARE = 0.7
"""The share of the curve's strong places for full reward, so that a dark stroke does not outweigh a whole curve."""
RIVAL_FULL_REWARD, RIVAL_STRENGTH_SHARE = 8.0, 0.35
"""The full reward and the share of strong places for a second curve, which may be fainter."""
RIVAL_DISTANCE = 1.2
"""The minimum distance of a second curve from the first [mm]; nearer ones are found by their crests."""
SAME_STRENGTH_SHARE, SAME_STRENGTH_LENGTH, SAME_STRENGTH_PRESENCE = 0.6, 10.0, 0.7
"""The share of the curve's strength, the length [mm], and the share of it on which a second line is seen, for doubt
which of both is the curve."""
MEETING_DISTANCE = 3.0
"""The distance [mm] within which a second line meets the curve before and behind; lines of a hatching do not."""
MAX_DARKNESS_RATIO = 1.8
"""The maximum darkness of a long piece or another line, as a multiple of a curve's strong places: a hand presses
evenly, and what is so much lighter an eraser has left."""
STEEPEST_COSINE = 0.2
"""The cosine of the steepest slope for which the distance across is computed."""
MIN_RIVAL_STRENGTH = 0.45
"""The minimum strength of a second curve that was meant, as a share of the curve's strong places,"""
MIN_CREST_SHARE = 0.6
"""and as a share of the darkest line near by."""


MIN_SEEN_SHARE = 0.90
"""The minimum share of its length on which a curve is seen: a half has far less, a faint but whole one more."""
MIN_COHERENCE = 0.80
"""The minimum coherence of a curve (see :class:`Measures`): through a scribble the way jumps."""
MAX_RIVAL_SHARE = 0.25
"""The maximum share of its length over which a second curve is seen; rays and digits make less."""
MAX_BEND = 3.5
"""The maximum mean change of direction from station to station [degrees]; through a scribble the way turns more."""
MAX_TWIN_SHARE = 0.06
"""The maximum share of its length along which a second crest runs beside the first."""
MAX_DARKER_SHARE = 0.10
"""The maximum share of its length along which a line far darker than the curve runs, on it or elsewhere."""
MAX_HIDDEN_SHARE = 0.10
"""The maximum share of its length under black print, where nothing is seen."""
EMPTY_SHARE = 0.25
"""The share of its length below which nothing is taken for a curve."""


PROFILE_HALF_WIDTH = 2.2
"""Half the width of the profile in which a second crest is looked for [mm]."""
PROFILE_STEP = 0.1
"""The step along such a profile [mm]."""
OWN_CREST_DISTANCE = 0.7
"""The maximum distance of the curve's own crest from its path [mm]."""
MIN_CREST_DISTANCE = 0.55
"""The minimum distance of two crests [mm]; a photograph shows nearer ones as one."""
MIN_SECOND_CREST = 0.45
"""The minimum height of a second crest, as a share of the first: what an eraser leaves has less."""
MAX_VALLEY = 0.8
"""The maximum height of the profile between two crests, as a share of the second."""
PROFILE_SMOOTHING = 1.5
"""The deviation of the smoothing of profiles along the curve [stations], against crosses and digits."""


def twin_share(track: Track, seen: Flags, ink: Ink, wraps: bool) -> float:
    """The share of the seen length along which there are two crests, over at least ``MIN_RUN_LENGTH`` at once."""
    offsets = np.arange(-PROFILE_HALF_WIDTH, PROFILE_HALF_WIDTH + PROFILE_STEP / 2, PROFILE_STEP)
    profiles = ink.at(track.path[:, None] + track.normal[:, None] * offsets)
    profiles = gaussian_filter1d(profiles, PROFILE_SMOOTHING, axis=0, mode="wrap" if wraps else "nearest")
    double = long_runs(seen & _two_crests(profiles, offsets), track.lengths, MIN_RUN_LENGTH, wraps)
    return float(track.lengths[double].sum() / max(float(track.lengths[seen].sum()), 1e-6))


def _two_crests(profiles: NDArray[Any], offsets: NDArray[np.float64]) -> Flags:
    """Flags (n,) of profiles (n, m) with a second crest."""
    station = np.arange(profiles.shape[0])
    central = np.flatnonzero(np.abs(offsets) < OWN_CREST_DISTANCE)
    crest = central[profiles[:, central].argmax(1)]
    height = profiles[station, crest]
    found = np.zeros(station.size, np.bool_)
    for k in range(1, offsets.size - 1):
        second = profiles[:, k]
        is_crest = (second >= profiles[:, k - 1]) & (second >= profiles[:, k + 1])
        apart = np.abs(offsets[k] - offsets[crest]) > MIN_CREST_DISTANCE
        high = is_crest & apart & (second > MIN_SECOND_CREST * height)
        for row in np.flatnonzero(high):
            low, top = sorted((k, int(crest[row])))
            found[row] |= profiles[row, low:top].min() < MAX_VALLEY * second[row]
    return found


@dataclass(frozen=True)
class Measures:
    """Measures of how well a curve is seen.

    share : share of its length that is seen
    gap : the longest piece that is not seen, mm
    coherence : median share of the best direction's answer that its own direction has
    rival : share of its length over which a second curve is seen elsewhere
    bend : mean change of its direction from station to station, degrees
    twin : share of its length along which a second line runs within 2 mm
    hidden : share of its length under black print
    contrast : density of its strong places relative to their surroundings
    length : mm
    darker : share of its length along which a far darker line runs, on it or elsewhere
    """

    share: float
    gap: float
    coherence: float
    rival: float
    bend: float
    twin: float
    hidden: float
    contrast: float
    length: float
    darker: float


def refusal_of(measures: Measures) -> tuple[Words, Words] | None:
    """The reason why a curve cannot be used, and the remedy; None for a usable curve.

    >>> from dataclasses import replace
    >>> good = Measures(.98, 3, .95, .05, 1.5, 0, 0, .3, 300, 0)
    >>> refusal_of(good) is None
    True
    >>> str(refusal_of(replace(good, share=.6, gap=40))[0])
    '60 % of the curve can be seen, and 90 % are needed'
    """
    again = say("draw it as one clear line, or enter it in the review page")
    share = say(
        "{share:.0f} % of the curve can be seen, and {least:.0f} % are needed",
        share=100 * measures.share,
        least=100 * MIN_SEEN_SHARE,
    )
    over = say("draw over the faint parts, also along printed lines, and take the photograph again in even light")
    cases = [
        (measures.rival > MAX_RIVAL_SHARE, _rival_refusal(measures), say("erase the one that is not meant")),
        (
            measures.darker > MAX_DARKER_SHARE,
            _darker_refusal(measures),
            say("draw over the whole curve, or erase what is not meant"),
        ),
        (
            measures.share < EMPTY_SHARE,
            say("no curve can be seen"),
            say("check that this is the right page and in focus"),
        ),
        (measures.twin > MAX_TWIN_SHARE, _twin_refusal(measures), say("erase the one that is not meant")),
        (
            measures.coherence < MIN_COHERENCE or measures.bend > MAX_BEND,
            say("the lines do not form one curve"),
            again,
        ),
        (measures.hidden > MAX_HIDDEN_SHARE, _hidden_refusal(measures), say("enter it in the review page")),
        (measures.share < MIN_SEEN_SHARE, share, over),
        (measures.gap > MAX_GAP, _gap_refusal(measures), over),
    ]
    return next(((why, remedy) for applies, why, remedy in cases if applies), None)


def _rival_refusal(measures: Measures) -> Words:
    return say("a second curve is drawn along {share:.0f} % of the first", share=100 * measures.rival)


def _twin_refusal(measures: Measures) -> Words:
    return say("two lines run side by side along {share:.0f} % of the curve", share=100 * measures.twin)


def _darker_refusal(measures: Measures) -> Words:
    return say("a line far darker than the curve is drawn along {share:.0f} % of it", share=100 * measures.darker)


def _hidden_refusal(measures: Measures) -> Words:
    return say("{share:.0f} % of the curve lies under black print", share=100 * measures.hidden)


def _gap_refusal(measures: Measures) -> Words:
    return say("a piece of {gap:.0f} mm of the curve cannot be seen", gap=measures.gap)


@dataclass(frozen=True, eq=False)
class CurveReading:
    """A curve that was read.

    points : (n,) mm of paper from the view's origin, in order, closed ones counter-clockwise; in gaps up to
        ``MAX_GAP`` by the run of what is seen before and behind, NaN in others
    seen : (n,) whether the line is seen there
    measures : how well it is seen
    """

    points: Points
    seen: Flags
    measures: Measures

    def refusal(self) -> tuple[Words, Words] | None:
        """The reason why the curve cannot be used, and the remedy; None for a usable curve."""
        return refusal_of(self.measures)


def read_curve(ink: Ink, view: PrintedView) -> CurveReading:
    """The curve that is drawn in a view."""
    grid = grid_of(view)
    evidence = evidence_of(ink, grid)
    black = hidden_places(ink.black, grid)
    way, track, darker = _best_curve(grid, evidence, black, ink)
    clear = seen_stations(track, evidence, ink, grid.wraps)
    rival = _rival(track, grid, evidence, black, ink)
    seen = clear & ~_by_another_way(track, rival, grid)
    twin = twin_share(track, clear, ink, grid.wraps)
    measures = _measures(way, track, seen, grid, rival.share, twin, darker)
    points = line_places(track, ink.sharp, grid.wraps) - view.origin
    return CurveReading(bridged(points, seen, track.lengths, grid.wraps), seen, measures)


@dataclass(frozen=True, eq=False)
class RivalLine:
    """A second curve, at least ``RIVAL_DISTANCE`` from the first, and the stations (n,) at which it is seen."""

    track: Track
    seen: Flags

    @property
    def share(self) -> float:
        """The share of its length on which the line is seen."""
        return float(self.track.lengths[self.seen].sum() / self.track.lengths.sum())


def _best_curve(grid: CurveGrid, evidence: Evidence, black: Flags, ink: Ink) -> tuple[BestWay, Track, float]:
    """The curve as way and track, and the share of its length along which a far darker line runs."""
    full = max(FULL_REWARD * evidence.noise, INITIAL_FULL_DENSITY)
    strong = track_of(best_way(_rewards(evidence, black, full), grid.wraps), grid, evidence, ink).strong
    way, track = _at_strength(strong, grid, evidence, black, ink)
    darker, strength = _darker(track, grid, evidence, black, ink)
    if darker > MAX_DARKER_SHARE:
        # What an eraser left of a whole curve outweighs a part of a dark one, until it is known how dark that is.
        way, track = _at_strength(strength, grid, evidence, black, ink)
        darker, _ = _darker(track, grid, evidence, black, ink)
    return way, track, darker


def _at_strength(strong: float, grid: CurveGrid, evidence: Evidence, black: Flags, ink: Ink) -> tuple[BestWay, Track]:
    """The curve, as way and track, if ``strong`` is the density of its strong places."""
    way = best_way(
        _rewards(evidence, black, max(FULL_REWARD * evidence.noise, FULL_STRENGTH_SHARE * strong)), grid.wraps
    )
    return way, track_of(way, grid, evidence, ink)


def _darker(track: Track, grid: CurveGrid, evidence: Evidence, black: Flags, ink: Ink) -> tuple[float, float]:
    """The share of the length along which the darkest line is darker by ``MAX_DARKNESS_RATIO``, and its density."""
    full = max(FULL_REWARD * evidence.noise, 2 * MAX_DARKNESS_RATIO * track.strong)
    line = track_of(best_way(_rewards(evidence, black, full), grid.wraps), grid, evidence, ink)
    # Of a line so dark its flanks are reward enough, so the way need not run on its crest.
    dark = (line.best > MAX_DARKNESS_RATIO * track.strong) & ~line.hidden
    other = long_runs(~(dark & is_stroke(line, ink.pencil)), line.lengths, MIN_GAP, grid.wraps)
    # Where a ray crosses it is no stroke, but runs on.
    dark = long_runs(dark & ~other, line.lengths, SAME_STRENGTH_LENGTH, grid.wraps)
    strength = float(np.percentile(line.best[dark], STRENGTH_PERCENTILE)) if dark.any() else 0.0
    return float(line.lengths[dark].sum() / line.lengths.sum()), strength


def _rewards(evidence: Evidence, black: Flags, full: float) -> NDArray[np.float32]:
    rewards = np.clip(evidence.answers, OUTSIDE_REWARD, full)
    rewards /= np.float32(full)
    rewards[black] = 0
    return rewards


def _measures(
    way: BestWay, track: Track, seen: Flags, grid: CurveGrid, rival: float, twin: float, darker: float
) -> Measures:
    there = ~track.hidden
    length = float(track.lengths[there].sum())
    # Against the circle or the axis.
    direction = np.arctan(way.slopes * grid.spacing[way.states] / np.abs(grid.along[0, way.states]))
    turns = np.abs(np.diff(direction, append=direction[:1] if grid.wraps else direction[-1:]))
    return Measures(
        share=float(track.lengths[seen].sum()) / max(length, 1e-6),
        gap=longest_run(~seen, np.where(there, track.lengths, 0.0), grid.wraps),
        coherence=float(np.median(track.coherence[there])) if there.any() else 0.0,
        rival=rival,
        bend=float(np.degrees(turns.mean())),
        twin=twin,
        hidden=float(track.lengths[track.hidden].sum() / track.lengths.sum()),
        contrast=track.strong,
        length=float(track.lengths.sum()),
        darker=darker,
    )


def _rival(track: Track, grid: CurveGrid, evidence: Evidence, black: Flags, ink: Ink) -> RivalLine:
    full = max(RIVAL_FULL_REWARD * evidence.noise, RIVAL_STRENGTH_SHARE * track.strong)
    rewards = _rewards(evidence, black, full)
    room = _room_of(track, grid)
    rewards[np.abs(grid.offsets - grid.offsets[track.states][:, None]) < room[:, None]] = OUTSIDE_REWARD
    second = track_of(best_way(rewards, grid.wraps), grid, evidence, ink)
    apart = np.abs(grid.offsets[second.states] - grid.offsets[track.states]) > room
    # At the edge of a finger no way runs on a crest.
    dark = second.answers > np.maximum(MIN_RIVAL_STRENGTH * track.strong, MIN_CREST_SHARE * second.best)
    return RivalLine(second, seen_stations(second, evidence, ink, grid.wraps) & apart & dark)


def _by_another_way(track: Track, rival: RivalLine, grid: CurveGrid) -> Flags:
    """Flags (n,) where a second line leaves the curve and comes back: either may be meant, as about a stain."""
    second = rival.track
    dark = rival.seen & (second.answers > SAME_STRENGTH_SHARE * track.answers)
    another = np.zeros(dark.shape, np.bool_)
    for run in flag_runs(np.abs(second.path - track.path) > MEETING_DISTANCE, grid.wraps):
        length = float(second.lengths[run].sum())
        another[run] = (
            length > SAME_STRENGTH_LENGTH
            and float(second.lengths[run][dark[run]].sum()) > SAME_STRENGTH_PRESENCE * length
        )
    return another


def _room_of(track: Track, grid: CurveGrid) -> NDArray[np.float64]:
    """Distances (n,) across the grid within which the curve keeps others away; they are greater where it is steep."""
    upright = np.abs((track.normal * np.conj(grid.across[:, 0])).real)
    own = RIVAL_DISTANCE / np.maximum(upright, STEEPEST_COSINE)
    return maximum_filter1d(own, 3, mode="wrap" if grid.wraps else "nearest")

"""What the chords of a double integration come to, calculated before anything is drawn: are the divisions fine enough?

An ordinate at the middle of a part stands for the whole part, so an acceleration that lasts less than a part is missed,
or counted whole.  The chords of a hand without error are calculated here as they are drawn: each phase's base line is
turned to end at rest, what is left at the end of the turn is taken up by the returns, and the top is read as the lift.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.curve import farthest_on_pieces
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion, MovingPhase
from graphcam.given.motion_law import Law
from graphcam.given.stations import MAX_FINER_PARTS, Stations, cuts_at_corners

MAX_S_SHARE = 0.02
"""How far s may be off, as a part of the lift, before a phase is divided into more parts."""
MAX_V_SHARE = 0.05
"""How far v and its maximum may be off, as a part of the phase's maximum, before it is divided into more parts."""
ENOUGH_OWN_SHARE = 0.4
"""A phase that is divided into more parts is divided until its own chords are off by this part of what is permitted."""
HALVED_SHARE = 0.2
"""Parts are halved whose chords are off by more than this part of the one that is off the most."""
MIN_OWN_SHARE = 0.5
"""A phase whose own chords are off by less than this part of what is permitted does not spoil the others."""


@dataclass(frozen=True, eq=False)
class ChordReadings:
    """How far the chords are off in each moving phase (p,), of a hand without error.

    phase : index of the phase
    s : as a part of the lift;  v : as a part of the phase's maximum
    own : the greater of the two in units of what is permitted, were the phase alone and the scale of its a known
    """

    phase: NDArray[np.intp]
    s: Floats
    v: Floats
    own: Floats

    @property
    def too_coarse(self) -> list[int]:
        """The phases in which s or v is off by more than is permitted."""
        return self.phase[(self.s > MAX_S_SHARE) | (self.v > MAX_V_SHARE)].tolist()


def chord_readings(motion: Motion, stations: Stations) -> ChordReadings:
    """How far s and v, read from the chords at the stations, and the maximum of v are off.

    >>> import graphcam as gc
    >>> from graphcam.given.stations import divide
    >>> rise = gc.Rise(30, 2.0, gc.constant_velocity_law(0.02, 0.02))
    >>> motion = gc.Motion([rise, gc.Return(30, 2 * np.pi - 2.0, "cosine")])
    >>> chord_readings(motion, divide(motion, 12)).too_coarse
    [0, 1]
    >>> finer = finer_parts(motion, 12, lambda finer: divide(motion, 12, finer=finer))
    >>> chord_readings(motion, divide(motion, 12, finer=finer)).too_coarse
    []
    """
    phase, left, u = stations.phase, stations.left, stations.u
    angle = motion.angles[phase]
    widths = np.diff(u)[left] * angle[left]
    exact_s, exact_v = motion.at(phase, u)[:2]
    # In a blow v is laid off.
    middles = motion.at(phase[left], (u[left] + u[left + 1]) / 2)[2]
    steps = np.where(stations.blows, exact_v[left + 1] - exact_v[left], widths * middles)
    v, s, permitted = np.zeros_like(u), np.zeros_like(u), np.ones((2, len(stations.phases)))
    own = np.ones(len(stations.phases))
    index = phase[stations.last]
    for k, (span, parts) in enumerate(zip(stations.phases, stations.parts, strict=True)):
        chords = np.append(0.0, np.cumsum(steps[parts]))
        v[span] = chords - u[span] * chords[-1]
        s[span] = np.append(0.0, np.cumsum(widths[parts] * (v[span][:-1] + v[span][1:]) / 2))
        moving = motion.phases[int(index[k])]
        assert isinstance(moving, MovingPhase)
        permitted[:, k] = MAX_S_SHARE, MAX_V_SHARE * moving.normalised.peak_velocity / moving.angle
        permitted[:, k] *= moving.lift
        off = np.abs(s[span] - (exact_s[span] - exact_s[span.start])).max(), np.abs(v[span] - exact_v[span]).max()
        own[k] = np.max(off / permitted[:, k])
    ends = s[stations.last]
    turned = np.where(motion.directions[index] < 0, motion.angles[index], 0.0)
    turned *= ends.sum() / turned.sum()
    starts = np.cumsum(ends - turned) - (ends - turned)
    s += (starts - min(starts.min(), 0.0))[stations.moving] - turned[stations.moving] * u
    top = s[stations.last[np.argmax(motion.levels[index + 1])]]
    if not top > 0:  # nothing rises on the paper, so there is no scale
        far = np.full_like(own, np.inf)
        return ChordReadings(index, far, far, own)
    s, v = s * (motion.lift / top), v * (motion.lift / top)
    s_off, v_off = np.empty_like(own), np.empty_like(own)
    for k, span in enumerate(stations.phases):
        s_off[k] = np.abs(s[span] - exact_s[span]).max() / motion.lift
        peak = permitted[1, k] / MAX_V_SHARE
        pieces = [piece for piece in stations.pieces if span.start <= piece.start < span.stop - 1]
        read = farthest_on_pieces(u + 1j * v, pieces, 1j * motion.directions[index[k]]).imag
        v_off[k] = max(np.abs(v[span] - exact_v[span]).max(), abs(abs(read) - peak)) / peak
    return ChordReadings(index, s_off, v_off, own)


def finer_parts(
    motion: Motion, divisions: int, divided: Callable[[Mapping[int, Sequence[float]]], Stations]
) -> dict[int, Sequence[float]]:
    """The cuts of the phases whose acceleration is too short for equal parts.

    They are cut at the corners of their acceleration, and the parts in which a chord is off the most are halved, until
    v and s are read well within what is permitted, or there are too many parts.

    divided : the stations with such phases
    """
    finer: dict[int, Sequence[float]] = {}
    readings = chord_readings(motion, divided(finer))
    while candidates := _divisible(readings, finer):
        for k in candidates:
            phase = motion.phases[k]
            assert isinstance(phase, MovingPhase)
            law = phase.normalised
            cuts = _halved(law, np.asarray(finer[k])) if k in finer else cuts_at_corners(law, divisions)
            if k in finer and cuts.size == len(finer[k]):
                continue
            finer = {**finer, k: cuts.tolist()}
            readings = chord_readings(motion, divided(finer))
            break
        else:
            break
    return finer


def _halved(law: Law, cuts: Floats) -> Floats:
    """The cuts with those parts halved whose chords are off the most; the same where there would be too many."""
    (f, f1), widths, middles = law(cuts, 1), np.diff(cuts), (cuts[:-1] + cuts[1:]) / 2
    off_v = np.abs(widths * law(middles)[2] - np.diff(f1)) / (MAX_V_SHARE * law.peak_velocity)
    off_s = np.abs(widths * (f1[:-1] + f1[1:]) / 2 - np.diff(f)) / MAX_S_SHARE
    off = np.where((middles > law.steady[0]) & (middles < law.steady[1]), np.maximum(off_v, off_s), 0.0)
    worst = np.argsort(-off, kind="stable")[: MAX_FINER_PARTS - widths.size]
    return np.sort([*cuts, *middles[worst[off[worst] > HALVED_SHARE * off.max()]]])


def _divisible(readings: ChordReadings, finer: Mapping[int, Sequence[float]]) -> list[int]:
    """The moving phases that are to be divided, those whose chords are off the most first."""
    coarse, found = readings.too_coarse, list[int]()
    for at in np.argsort(-readings.own, kind="stable").tolist():
        k, own = int(readings.phase[at]), readings.own[at]
        if (k in coarse or own > ENOUGH_OWN_SHARE) if k in finer else (coarse and own > MIN_OWN_SHARE):
            found.append(k)
    return found

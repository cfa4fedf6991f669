"""What the eye sees of a plotted curve before three points are taken: where it is bent most, and where it has a corner.

A moving phase is looked through along the drawn curve; in a rest the pitch curve is an arc about the cam centre.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.profile_view import Inverted
from graphcam.drafting.euclid import UP, centre_of_circle, crossing, perpendicular_bisector
from graphcam.drafting.marks import Points
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.motion import Dwell, Motion, MovingPhase
from graphcam.given.stations import Stations
from graphcam.plane_vectors import cross, dot

Triples = NDArray[np.intp]
"""(..., k, 3) which three points each: of those of the drawn curve, then of the rests, then one that is nowhere."""
CURVE_PLACES = 8
"""The drawn curve is looked through at so many places a part."""
SHORTEST_STEP = 7
"""So many of these places lie at least between the three points.

Over a whole part chords flatten a bend that lets up on both sides; the parabolas that the curve is faired by bend a
little more between the points, and over seven eighths of a part the two make up for one another.
"""
PHASE_SHARE = 0.24
"""The three points are so large a part of their phase apart, where the line is 1 mm off; else by its fourth root.

The best chord is 2.33 (sigma/kappa'')^(1/4).  In the usual laws the acceleration goes through one wave in a phase, and
the curvature with it: kappa'' is about kappa times the square of 2 pi over the length of the phase.
"""


def share_of_phase(line: float) -> float:
    """The part of a phase by which the three points are apart, drawn with a line that is so far off [mm]."""
    return PHASE_SHARE * line**0.25


@dataclass(frozen=True)
class Stretch:
    """A smooth stretch of the drawn curve, continued beyond the ends of its phase by its image.

    There the follower is at rest and the curve runs square to the ray from the cam centre: its image in the ray goes on
    without a bend, so that three points lie on both sides of an end, and none of them across a jump of the
    acceleration.

    stations, parts : its own stations, and the parts of its phase;  before, after : whether it is continued
    """

    stations: slice
    parts: int
    before: bool
    after: bool

    @property
    def images(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The stations whose images lie before it and after it, in order."""
        own = np.arange(self.stations.start, self.stations.stop)
        return own[:0:-1] if self.before else own[:0], own[-2::-1] if self.after else own[:0]

    @property
    def own(self) -> slice:
        """Its own places among all on it, its images included."""
        start, parts = self.images[0].size, self.stations.stop - self.stations.start - 1
        return slice(CURVE_PLACES * start, CURVE_PLACES * (start + parts) + 1)

    @property
    def count(self) -> int:
        """How many places lie on it, its images included."""
        points = self.stations.stop - self.stations.start + sum(image.size for image in self.images)
        return CURVE_PLACES * (points - 1) + 1


def stretches_of(inverted: Inverted) -> list[Stretch]:
    """The smooth stretches of the drawn curve with three stations or more, in order."""
    integrated = inverted.givens.integrated.givens
    motion, stations = integrated.motion, integrated.stations
    speed = np.abs(motion.at(stations.phase, stations.u)[1])
    found: list[Stretch] = []
    for span in stations.phases:
        at_rest = speed[[span.start, span.stop - 1]] <= NO_ACCELERATION * speed[span].max()
        for piece in stations.pieces:
            if span.start <= piece.start < piece.stop <= span.stop and piece.stop - piece.start > 2:
                before, after = piece.start == span.start and at_rest[0], piece.stop == span.stop and at_rest[1]
                found.append(Stretch(piece, span.stop - span.start - 1, bool(before), bool(after)))
    return found


def steps_along(inverted: Inverted, stretches: Sequence[Stretch], points: Points, share: float) -> Triples:
    """The numbers of every place of the drawn curve and of two so large a part of the phase apart, (..., k, 3).

    Where the bisectors cross at less than a degree they are twice as far apart, or four times, and so on.

    points : (..., m) of the drawn curve
    """
    rows, first = [np.empty((3, 0), dtype=np.intp)], 0
    for stretch in stretches:
        own, last = stretch.own, stretch.count - 1
        apart = min(max(SHORTEST_STEP, round(CURVE_PLACES * stretch.parts * share)), last // 2)
        middle = np.arange(max(own.start, apart), min(own.stop, last + 1 - apart))
        rows.append(np.stack([first + middle, np.full_like(middle, apart), np.minimum(middle, last - middle)]))
        first += stretch.count
    middle, apart, room = np.concatenate(rows, axis=-1)
    step = np.array(np.broadcast_to(apart, (*points.shape[:-1], apart.size)))
    sides = np.array([-1, 0, 1])
    # At first the places of all hands have the same numbers; afterwards only those are looked at that were too near.
    unreadable = np.isnan(centres_of(inverted, points[..., middle[:, None] + apart[:, None] * sides]))
    wider = np.nonzero(unreadable & (2 * step <= room))
    while wider[-1].size:
        step[wider] *= 2
        *hands, of = (axis[:, None] for axis in wider)
        triples = points[(*hands, middle[of] + step[wider][:, None] * sides)]
        still = np.isnan(centres_of(inverted, triples)) & (2 * step[wider] <= room[wider[-1]])
        wider = tuple(axis[still] for axis in wider)
    return middle[:, None] + step[..., None] * sides


INSTANT_ANGLE = math.radians(5)
"""Three points of the arc of an instant's rest are taken so far apart."""
NO_ACCELERATION = 1e-9
"""Part of the greatest acceleration that is none."""


def dwell_arcs(motion: Motion, stations: Stations) -> list[tuple[int, Floats]]:
    """The station before every dwell, and the angles [rad] of three places of its arc from there.

    Where two moving phases meet and the acceleration of either vanishes, it rests for an instant.
    """
    before = stations.phase[stations.last]
    # What follows a moving phase is a dwell or the next moving phase; the last is followed by the first.
    following = (before + 1) % len(motion.phases)
    vanishes = _vanishes(motion, before, 1.0) | _vanishes(motion, following, 0.0)
    found: list[tuple[int, Floats]] = []
    for last, k, instant in zip(stations.last.tolist(), following, vanishes, strict=True):
        phase = motion.phases[k]
        if isinstance(phase, Dwell):
            found.append((last, phase.angle * np.array([0.0, 0.5, 1.0])))
        elif instant:
            found.append((last, INSTANT_ANGLE * np.array([-1.0, 0.0, 1.0])))
    return found


def _vanishes(motion: Motion, phases: NDArray[np.intp], u: float) -> NDArray[np.bool_]:
    """Whether the acceleration of phases is zero at the end u; true for a dwell."""
    ends = [motion.phases[k] for k in phases]
    # In a blow there is no rest.
    greatest = [
        (-1.0 if p.normalised.blows[int(u)] else p.peak_acceleration) if isinstance(p, MovingPhase) else 0.0
        for p in ends
    ]
    return np.abs(motion.at(phases, u)[2]) <= NO_ACCELERATION * np.array(greatest)


def points_at(points: Points, at: Triples) -> Points:
    """The three points each of a choice, (..., k, 3), of points (..., m)."""
    return np.take_along_axis(points[..., None, :], at, -1)


def centres_of(inverted: Inverted, triples: Points) -> Points:
    """The centres of the circles through three points (..., 3); NaN where the bisectors cross at less than a degree.

    In a drawing that is divided again to see what finer parts would change, every crossing counts.
    """
    a, b, c = np.moveaxis(triples, -1, 0)
    if inverted.givens.integrated.givens.stations.refine > 1:
        return crossing(*perpendicular_bisector(a, b), *perpendicular_bisector(b, c))
    return centre_of_circle(a, b, c)


def sharpest_of(inverted: Inverted, points: Points, triples: Triples) -> tuple[NDArray[np.intp], Floats]:
    """The triple (..., 3) of points (..., m) with the smallest convex radius, and that radius on paper.

    The radius is infinite where no bend is convex, NaN where none can be read.
    """
    none = np.full_like(triples, points.shape[-1] - 1, shape=(*triples.shape[:-2], 1, 3))
    triples = np.concatenate([triples, none], axis=-2)
    shown = points_at(points, triples)
    a, b, c = np.moveaxis(shown, -1, 0)
    centres = centres_of(inverted, shown)
    # Numbered against the rotation, a convex curve turns the other way than the cam.
    convex = sense(inverted.givens.rotation) * cross(b - a, c - b) < 0
    radii = np.where(np.isnan(centres), np.nan, np.where(convex, np.abs(centres - b), np.inf))
    best = np.argmin(np.where(np.isnan(radii), np.inf, radii), axis=-1)[..., None]
    return np.take_along_axis(triples, best[..., None], -2)[..., 0, :], np.fmin.reduce(radii, axis=-1)


CORNER_ANGLE = math.radians(45)
"""A curve that turns by so much more than the follower does between a rest and the next point has a corner there."""


def turns_a_corner(inverted: Inverted) -> NDArray[np.bool_]:
    """Whether the pitch curve turns inwards by more than can be read between the end of a phase and the next point.

    It does where the velocity falls at once.  Where the follower rests the curve runs square to the ray from the cam
    centre.
    """
    stations, pitch = inverted.givens.integrated.givens.stations, inverted.points["pitch"]
    ends = np.array([[span.start, span.stop - 1] for span in stations.phases]).ravel()
    onwards = np.tile([1, -1], len(stations.phases))
    end, following = pitch[..., ends], pitch[..., ends + onwards]
    chord, along = following - end, -sense(inverted.givens.rotation) * onwards * UP * end
    # The chord of an arc about the cam centre leaves it by half of what the cam has turned.
    by_turning = np.abs(np.angle(following * end.conj())) / 2
    falls = bool(inverted.givens.integrated.givens.motion.corners)
    return falls | np.any(
        (dot(chord, end) < 0) & (np.abs(np.angle(chord * along.conj())) > by_turning + CORNER_ANGLE), axis=-1
    )

"""What the eye sees of a plotted curve before three points are taken: where it is bent most, and where it has a corner.

A moving phase is looked through from station to station; in a rest the pitch curve is an arc about the cam centre.
"""

import math

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
"""(..., k, 3) which three points each: of those of the pitch curve, then of the rests, then one that is nowhere."""


def neighbours(inverted: Inverted) -> Triples:
    """The numbers of every station and its neighbours (..., k, 3), never across a jump of the acceleration.

    Where the bisectors cross at less than a degree the second neighbours are taken in place of the first, or the
    fourth, and so on: with very many parts the chords between neighbours hardly bend.
    """
    stations, pitch = inverted.givens.integrated.givens.stations, inverted.points["pitch"]
    middle = np.concatenate([np.arange(piece.start + 1, piece.stop - 1) for piece in stations.pieces])
    within = [np.arange(1, piece.stop - piece.start - 1) for piece in stations.pieces]
    reach = np.concatenate([np.minimum(inside, inside[::-1]) for inside in within])
    step = np.ones((*pitch.shape[:-1], middle.size), dtype=np.intp)
    while True:
        at = np.stack([middle - step, middle + 0 * step, middle + step], axis=-1)
        wider = np.isnan(centres_of(inverted, points_at(pitch, at))) & (2 * step <= reach)
        if not wider.any():
            return at
        step = np.where(wider, 2 * step, step)


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

"""The mean driving torque over the turn: the work of a turn over 2 pi.

Without friction a load that is the same at the end of a turn as at its beginning, and depends on the place alone, does
no work over the turn, and the mean torque is zero; so is that of the inertia at a constant speed.  What remains is what
friction takes, and a load that differs on the way up and on the way down.
"""

from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.stationary import Places, places_in, places_of, smooth_pieces

NODES = 24
"""The number of Gauss nodes on a part of a smooth piece."""
PARTS = 4
"""A smooth piece is divided into so many equal parts, and where a bearing of the guide changes its side."""


def mean_torque(forces: CamForces) -> float:
    """The mean of the torque on the cam over a turn [N mm].

    Raises
    ------
    DesignError : the follower jams, at the cam or in its guide

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> cam = gc.Cam(motion, gc.Translating(offset=10, roller_radius=12), prime_radius=50)
    >>> load = gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=100)
    >>> abs(gc.mean_torque(gc.CamForces(cam, load))) < 1e-9
    True
    >>> round(gc.mean_torque(gc.CamForces(cam, load, friction=0.1)), 3)
    938.227
    """
    forces.check()
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    phase, low, high = _parts(forces)
    half = (high - low) / 2
    places = places_in(forces.cam.motion, phase[:, None], (low + half)[:, None] + half[:, None] * nodes)
    width = half * forces.cam.motion.angles[phase]
    return float(np.sum(width * (forces.torque(places) @ weights))) / FULL_TURN


def _parts(forces: CamForces) -> tuple[NDArray[np.intp], Floats, Floats]:
    """The parts of the turn in which the torque is smooth: phase, and the fractions where a part begins and ends."""
    motion, knots = forces.cam.motion, forces.pressing.knots
    phase, u0, u1 = smooth_pieces(motion, knots)
    cuts: list[tuple[int, float]] = []
    for which in (0, 1) if forces.guide.friction else ():
        found = places_of(motion, partial(_bearing, forces, which), knots)
        inner = slice(2 * phase.size, None)
        cuts += zip(found.phase[inner].tolist(), found.u[inner].tolist(), strict=True)
    rows: list[tuple[int, float, float]] = []
    for k, start, end in zip(phase.tolist(), u0.tolist(), u1.tolist(), strict=True):
        ends = {*np.linspace(start, end, PARTS + 1).tolist(), *(u for i, u in cuts if i == k and start < u < end)}
        rows += [(k, a, b) for a, b in pairwise(sorted(ends))]
    of, low, high = zip(*rows, strict=True)
    return np.array(of), np.array(low), np.array(high)


def _bearing(forces: CamForces, which: int, places: Places) -> Floats:
    """The force of one bearing over the normal force: where it changes its sign, the friction has a corner."""
    return forces.bearings(places.values)[0][which]

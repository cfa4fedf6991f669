"""How the curve that a hand fairs through plotted points bends between them."""

from __future__ import annotations

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.drafting.curve import faired
from graphcam.drafting.marks import Points
from graphcam.exercises.definition.drawn_answers import ask
from graphcam.exercises.definition.exercise import Asked
from graphcam.exercises.key.expectation import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.stations import Stations


def bulges(chain: Chain, asked: Asked) -> Floats:
    """The bulges of a curve, as many as it has points where it is closed, else one fewer, else none: all straight.

    chain : drawn by a hand without samples

    Inside a moving phase the curve is faired through the points; in a dwell a profile is an arc about the cam centre,
    and a diagram a straight line.
    """
    points, stations = ask(chain, asked), chain.board.stations
    if points.size != stations.u.size:
        return np.empty(0)
    found = np.zeros(points.size)
    for piece in stations.pieces:
        plotted = points[piece]
        # Of two points alone the second comes back, which lies on the chord as well.
        middle = faired(plotted, between=2)[1::2]
        found[piece.start : piece.stop - 1] = _bulge(plotted[:-1], middle, plotted[1:])
    if asked.construction not in PROFILES:
        return found[:-1]
    found[stations.last] = np.tan(_dwells(points, stations) / 4)
    return found


PROFILES = ("inversion", "working_profile")
"""Constructions about the cam centre, whose curves are closed."""


def _bulge(start: Points, middle: Points, end: Points) -> Floats:
    half = (end - start) / 2
    bent: Points = np.divide(middle - start - half, half, out=np.zeros_like(half), where=half != 0)
    return np.asarray(-bent.imag, dtype=np.float64)


def _dwells(points: Points, stations: Stations) -> Floats:
    """The angles at the cam centre after every moving phase, counter-clockwise [rad]."""
    inside = np.delete(np.angle(points[1:] / points[:-1]), stations.last[:-1])
    after = (stations.phi[(stations.last + 1) % points.size] - stations.phi[stations.last]) % FULL_TURN
    return np.copysign(after, inside.sum())

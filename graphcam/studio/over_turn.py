"""Values that the drawing has at its stations, interpolated at any cam angle between."""

import math

import numpy as np
from numpy.typing import ArrayLike

from graphcam.given.motion import FULL_TURN
from graphcam.given.stations import Stations


def over_stations(
    stations: Stations, phi: float, values: ArrayLike, before: ArrayLike | None = None, *, rests: bool = False
) -> complex:
    """A value or a place at a cam angle [rad], straight between those at the stations.

    values : (m,);  before : where they jump, those on the left;  rests : whether it is zero in dwells; else it stays
        what it was at the station before

    >>> import graphcam as gc
    >>> from graphcam.given.stations import divide
    >>> halves = divide(gc.Motion([gc.Rise(30, 2.0), gc.Dwell(1.0), gc.Return(30, FULL_TURN - 3.0)]), 2)
    >>> over_stations(halves, 0.5, [0, 10, 30, 30, 20, 0]).real, over_stations(halves, 2.5, [0, 10, 30, 30, 20, 0]).real
    (5.0, 30.0)
    """
    after, turn = np.asarray(values), phi % FULL_TURN
    ends = after if before is None else np.asarray(before)
    first, last = stations.phi[stations.left], stations.phi[stations.left + 1]
    within = np.flatnonzero((first <= turn) & (turn <= last))
    if within.size:
        k = int(within[0])
        share, left = (turn - first[k]) / (last[k] - first[k]), int(stations.left[k])
        return complex((1 - share) * after[left] + share * ends[left + 1])
    if rests:
        return 0j
    earlier = np.flatnonzero(stations.phi <= turn)
    return complex(after[earlier[-1] if earlier.size else -1])


def nearest_station(places: ArrayLike, to: complex) -> int:
    """The number of the place nearest to another one.

    >>> nearest_station([0j, 3j, 5j], 1 + 4.5j)
    2
    """
    return int(np.nanargmin(np.abs(np.asarray(places) - to)))


def in_degrees(phi: float) -> float:
    """A cam angle of the exact side as the page has it.

    >>> in_degrees(math.pi / 3)
    60.0
    """
    return round(math.degrees(phi), 6)

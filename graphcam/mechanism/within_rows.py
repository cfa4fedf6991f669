"""What the rows of a measured motion tell for certain, whatever motion within their tolerance is the true one.

A jump of the acceleration between rows is not seen, and a smooth motion swings beside it; so an undercut or a loss of
contact in the smoothed motion need not be one of the motion that was measured.  Mean accelerations are told: twice the
divided difference of three rows is the mean of s'' over their interval, weighted by a hat whose top is over the middle
row.  Rows at distances p and q that are off by the tolerance t at most change it by 4 t/(p q) at most.
"""

import math

import numpy as np

from graphcam.given.laws import Floats
from graphcam.given.measured import MeasuredMotion
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.mechanism.turn_extremes import PlaceQuantity, Places, places_from

WIDEST_WINDOW = math.pi / 2
"""The rows of a mean acceleration are no farther apart than this [rad]."""


def rows_tell(motion: Motion, quantity: PlaceQuantity) -> bool:
    """Whether a quantity is negative somewhere for every motion within the tolerance of the rows; True without rows.

    quantity : of places, linear in the acceleration or taken to be; displacement and velocity are those that were
        smoothed

    >>> import graphcam as gc
    >>> phi = np.radians(np.arange(0.0, 360.0, 2.0))
    >>> motion = gc.measured_motion(phi, 10 - 10 * np.cos(phi), tolerance=0.01)
    >>> [rows_tell(motion, lambda places: limit + places.values[2]) for limit in (5.0, 9.5, 9.999)]
    [True, True, False]
    """
    if not isinstance(motion, MeasuredMotion):
        return True
    places = places_from(motion, (motion.phi - motion.zero) % FULL_TURN, None, "right")
    now, slope = quantity(places), quantity(_accelerated(places, 1.0)) - quantity(places)
    with np.errstate(divide="ignore", invalid="ignore"):
        critical, sign = places.values[2] - now / slope, np.sign(slope)
    n, reach = motion.phi.size, 1
    while reach == 1 or 2 * reach * FULL_TURN / n <= WIDEST_WINDOW:
        mean, off = _mean_accelerations(motion, reach)
        hat = np.sum([(reach - abs(k)) * np.roll(critical, k) for k in range(1 - reach, reach)], axis=0)
        if np.any(sign * mean + off < sign * hat / reach**2):
            return True
        reach = max(reach + 1, reach * 3 // 2)
    return False


def _accelerated(places: Places, by: float) -> Places:
    s, v, a, j = places.values
    return Places(places.phase, places.u, places.phi, (s, v, a + by, j))


def _mean_accelerations(motion: MeasuredMotion, reach: int) -> tuple[Floats, Floats]:
    """(n,) about every row the mean acceleration between the rows so many before and behind, and what it may be off."""
    before, behind = ((motion.phi - np.roll(motion.phi, k)) for k in (reach, -reach))
    p, q = before % FULL_TURN, -behind % FULL_TURN
    s = motion.measured
    slopes = (s - np.roll(s, reach)) / p, (np.roll(s, -reach) - s) / q
    return 2 * (slopes[1] - slopes[0]) / (p + q), 4 * motion.tolerance / (p * q)

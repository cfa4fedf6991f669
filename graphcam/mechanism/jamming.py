"""Friction between cam and follower: what it leaves of the normal force, and where the follower jams.

The cam slides past the follower in its own sense and drags it along the profile with mu N.  Of a unit of the normal
force cos alpha - mu sin alpha acts along the motion then; of an arm of the length l with a roller of the radius r, in
lengths of the arm, cos alpha - sigma mu (sin alpha - r/l), for its friction acts at the roller's rim.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from graphcam.errors import check_number
from graphcam.given.laws import Floats
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.kinematics import Kinematics, Values, pair_cross
from graphcam.mechanism.turn_extremes import Places, ValueAt, turn_maximum
from graphcam.words import say


def transmission(cam: Cam, values: Values, friction: float = 0.0) -> tuple[Floats, Floats]:
    """What a unit of normal force moves along the motion, cos alpha - mu sin alpha, and its derivative by phi.

    values : (s, v, a, j)
    returns : of an arm divided by its length, cos alpha - sigma mu (sin alpha - r/l)
    """
    return transmitted(cam.kinematics, values, friction, cam.roller_radius)


def transmitted(kin: Kinematics, values: Values, friction: float, roller: Any) -> tuple[Floats, Floats]:
    """The transmission of one cam or of many, as in :func:`transmission`, with the radii of their rollers [mm]."""
    cosine, sine, turning = contact_angle(kin, values)
    lean = kin.leaning * friction
    return cosine - lean * (sine - kin.rim(roller)), -(sine + lean * cosine) * turning


def lever_about_cam(kin: Kinematics, values: Values, friction: float, roller: Any) -> tuple[Floats, Floats]:
    """The torque on the cam over the normal force [mm], of one cam or of many, and its slope: by virtual power."""
    _, v, a, _ = values
    moved, moved_slope = transmitted(kin, values, friction, roller)
    sliding, sliding_slope = kin.sliding(values, roller)
    reach, reach_slope = kin.reach(values)
    slope = reach * (a * moved + v * moved_slope) + reach_slope * v * moved
    return reach * v * moved + friction * sliding, slope + friction * sliding_slope


def jamming_margin(cam: Cam, friction: float) -> ValueAt:
    """The minimum transmission coefficient over the turn, cos alpha - mu sin alpha, and where it is; at 0 the cam jams.

    friction : mu between cam and follower

    Raises
    ------
    DesignError : the friction is negative or not finite

    >>> from math import degrees, radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(60)), gc.Dwell(radians(120)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> margin = gc.jamming_margin(gc.Cam(motion, gc.Translating(), prime_radius=30), friction=0.1)
    >>> round(margin.value, 4), round(degrees(margin.phi), 2)
    (0.5443, 25.19)
    """
    check_friction(friction)

    def margin(places: Places) -> Floats:
        """The margin's negative: the minimum coefficient is the maximum of these."""
        return -transmission(cam, places.values, friction)[0]

    worst = turn_maximum(cam.motion, margin)
    return worst._replace(value=-worst.value)


def check_friction(friction: float) -> None:
    """Check that a number can be a coefficient of friction.

    Raises
    ------
    DesignError : it is negative or not finite
    """
    check_number("friction", friction, say("a finite number of 0 or more"), least=0)


def contact_angle(kin: Kinematics, values: Values) -> tuple[Floats, Floats, Floats]:
    """cos and sin of the pressure angle, and its slope by phi, from (s, v, a, j)."""
    q, q1 = kin.pressure(values)
    size = np.sqrt(np.add(q[0] * q[0], q[1] * q[1]))
    return q[0] / size, q[1] / size, pair_cross(q, q1) / size**2


def most_friction(cam: Cam) -> float:
    """The friction at the cam at which the minimum transmission coefficient is zero; infinite or negative for none.

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(60)), gc.Dwell(radians(120)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> cam = gc.Cam(motion, gc.Translating(), prime_radius=30)
    >>> abs(gc.jamming_margin(cam, most_friction(cam)).value) < 1e-12
    True
    """

    def over(places: Places) -> Floats:
        """The friction over the force that moves, for mu = 1."""
        plain, rubbing = (transmission(cam, places.values, mu)[0] for mu in (0.0, 1.0))
        return (plain - rubbing) / plain

    greatest = turn_maximum(cam.motion, over).value
    return math.inf if greatest == 0 else 1 / greatest

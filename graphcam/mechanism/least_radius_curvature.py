"""The minimum prime radius whose working profile, too, is nowhere sharper than permitted, under a roller or knife edge.

The working profile is the pitch curve less the roller, so its convex radius of curvature is rho - r; hollows of a sound
cam only widen.  From the radius that the pressure angles need, the prime radius grows, at the same offset or centre
distance, until rho of the sharpest place is the roller radius and the permitted one together.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from graphcam.errors import DesignError, check_number
from graphcam.given.follower import Follower, Limits, no_prime_radius
from graphcam.given.motion import Motion
from graphcam.given.root_finding import roots
from graphcam.mechanism.followers import kinematics
from graphcam.mechanism.kinematics import Kinematics
from graphcam.mechanism.least_radius_arm import ArmMinimumRadius
from graphcam.mechanism.least_radius_translating import MinimumRadius
from graphcam.mechanism.turn_extremes import highest_places
from graphcam.words import say

GROWTH = 1.05
"""The factor between prime radii that are tried, until the profile is nowhere too sharp."""
MAX_GROWTH = 1e6
"""So many times the sizes of the follower a prime radius is tried."""
ANGLE_ROUNDING = 1e-9
"""Of the tangent of a permitted angle: what the angle may pass it by for the arithmetic."""


def sharp_enough(
    motion: Motion,
    follower: Follower,
    sigma: int,
    limits: Limits,
    least: MinimumRadius | ArmMinimumRadius,
    curvature: float,
) -> MinimumRadius | ArmMinimumRadius:
    """The minimum prime radius at which the working profile, too, is nowhere sharper than permitted.

    follower : with its place, which stays;  least : what its pressure angles need;  curvature : permitted radius [mm]

    Raises
    ------
    DesignError : the permitted radius is no length of 0 mm or more, or at this centre distance no prime radius has it

    >>> import graphcam as gc
    >>> rise, back = gc.Rise(16, math.pi / 3, "cycloidal"), gc.Return(16, math.pi / 3, "rectangular")
    >>> motion = gc.Motion([gc.Dwell(math.pi / 3), rise, gc.Dwell(math.pi), back])
    >>> follower, limits = gc.Translating(offset=5, roller_radius=12), Limits(math.radians(45), math.radians(70))
    >>> steep = gc.minimum_radius(motion, follower, "ccw", limits.rise, limits.return_, offset=5)
    >>> least = sharp_enough(motion, follower, +1, limits, steep, 4.0)
    >>> round(steep.prime_radius, 4), round(least.prime_radius, 4), least.active
    (19.0661, 32.0781, ('curvature',))
    """
    check_number(say("minimum radius of curvature"), curvature, say("a finite length of 0 mm or more"), least=0)
    needed = float(getattr(follower, "roller_radius", 0.0)) + curvature
    if not needed:  # a knife edge, and the pitch curve may come to a point
        return least

    def excess(radius: float) -> float:
        """How far the greatest curvature exceeds the permitted one, as a part of it."""
        kin = kinematics(follower, radius, sigma, motion.lift)
        places = highest_places(motion, kin.sharpness)
        return needed * float(np.max(kin.sharpness(places.values))) - 1

    try:
        radius = _first_without(excess, least.prime_radius * (1 + 1e-12), MAX_GROWTH * (needed + least.prime_radius))
        if radius is None:
            return least
        kept = _kept(motion, kinematics(follower, radius, sigma, motion.lift), limits)
    except DesignError:  # the arm no longer reaches
        kept, radius = False, math.inf
    if kept:
        return replace(least, prime_radius=radius, active=("curvature",))
    raise no_prime_radius(say("minimum radius of curvature"), curvature, say("take a smaller roller"))


def _first_without(excess: Callable[[float], float], radius: float, most: float) -> float | None:
    """The first prime radius [mm] from one on without an excess; None where that one has none."""
    if excess(radius) <= 0:
        return None
    while radius < most:
        smaller, radius = radius, GROWTH * radius
        if excess(radius) <= 0:
            return float(roots(lambda at: np.asarray(excess(float(at))), smaller, radius))
    return math.inf


def _kept(motion: Motion, kin: Kinematics, limits: Limits) -> bool:
    """Whether the pressure angles keep their limits; without rest only where the velocity drives them."""
    places = highest_places(motion, kin.steepness, signed=True)
    steep, directions = kin.leaning * kin.steepness(places.values), motion.directions[places.phase]
    for direction, limit in ((+1, limits.rise), (-1, limits.return_)):
        if limit is not None:
            driven = direction * steep[directions == direction]
            worst = np.max(np.abs(driven) if limits.rest else driven)
            if worst > math.tan(limit) * (1 + ANGLE_ROUNDING):
                return False
    return True

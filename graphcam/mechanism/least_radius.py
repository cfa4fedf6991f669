"""The minimum prime radius that keeps the pressure angle, and the profile's curvature, within their limits.

Each follower's stands in a file of its own: :mod:`~graphcam.mechanism.least_radius_translating`,
:mod:`~graphcam.mechanism.least_radius_arm`, :mod:`~graphcam.mechanism.flat_faced` and
:mod:`~graphcam.mechanism.oscillating_flat`; what a roller adds in :mod:`~graphcam.mechanism.least_radius_curvature`.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import overload

from graphcam.errors import DesignError, check_kind
from graphcam.given.follower import (
    FOLLOWER_CLASSES,
    FlatFaced,
    Follower,
    Limits,
    Oscillating,
    OscillatingFlat,
    Rotation,
    Translating,
    sense,
)
from graphcam.given.motion import Motion
from graphcam.mechanism.flat_faced import FlatMinimumRadius
from graphcam.mechanism.followers import EXACT_FUNCTIONS, LeastRadius
from graphcam.mechanism.least_radius_arm import ArmMinimumRadius
from graphcam.mechanism.least_radius_curvature import sharp_enough
from graphcam.mechanism.least_radius_translating import MinimumRadius
from graphcam.words import say

PLACE_TITLES = {"offset": say("offset"), "distance": say("centre distance")}


@overload
def minimum_radius(
    motion: Motion,
    follower: Translating,
    rotation: Rotation = "ccw",
    rise: float | None = None,
    return_: float | None = None,
    offset: float | None = None,
    rest: bool = True,
    curvature: float | None = None,
) -> MinimumRadius: ...
@overload
def minimum_radius(
    motion: Motion,
    follower: Oscillating,
    rotation: Rotation = "ccw",
    rise: float | None = None,
    return_: float | None = None,
    offset: float | None = None,
    rest: bool = True,
    curvature: float | None = None,
) -> ArmMinimumRadius: ...
@overload
def minimum_radius(
    motion: Motion,
    follower: FlatFaced | OscillatingFlat,
    rotation: Rotation = "ccw",
    rise: float | None = None,
    return_: float | None = None,
    offset: float | None = None,
    rest: bool = True,
    curvature: float | None = None,
) -> FlatMinimumRadius: ...
def minimum_radius(
    motion: Motion,
    follower: Follower,
    rotation: Rotation = "ccw",
    rise: float | None = None,
    return_: float | None = None,
    offset: float | None = None,
    rest: bool = True,
    curvature: float | None = None,
) -> LeastRadius:
    """The minimum prime radius for permitted pressure angles, for a permitted curvature of the profile, or for both.

    Parameters
    ----------
    motion, follower, rotation : as for a :class:`~graphcam.mechanism.cam.Cam`; a translating follower's own offset is
        not used, an arm's distance is kept if it is given
    rise, return_ : permitted |alpha| [rad] on rises and on returns; rise = None is the usual limit, 30 degrees for a
        translating follower and 45 for an arm, as in a sweep and a task file; return_ = None is force closure, no limit
        there.  :func:`graphcam.size_cam` takes 25 degrees if nothing is said, the limit of the problem it comes from
    offset : e [mm] of a translating follower if it is given; None leaves it free
    rest : whether the angle in the lower dwell, for an arm in both, must also satisfy the limits of the phases that
        end there, so that |alpha| satisfies them all the way
    curvature : the minimum permitted radius of curvature [mm] of the profile.  Under a flat face None is 0, where the
        profile has a cusp, which a cam can only approach; under a roller or a knife edge, with the follower's own
        ``roller_radius``, None is no limit, and a limit needs the offset or the centre distance

    Without the rest condition a given offset larger than M needs no height at all; the radius returned is then the
    offset itself, which a cam can only approach, and no line binds.  The same holds for an arm that only has to reach:
    r0 = |c - l|.  The minimum radius under a flat face is never negative; it is 0 where any prime radius will do.

    Raises
    ------
    DesignError : a limit is not between 0 and 90 degrees or an arm cannot satisfy it (its lift is too large for any
        radius, or for the given distance), a length is not finite, an offset is given for a follower that has none, or
        a curvature where the place is to be found

    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, math.pi / 2, "cosine"), gc.Return(30, math.pi / 2, "cosine"),
    ...     gc.Dwell(math.pi)])
    >>> least = gc.minimum_radius(motion, gc.Translating())
    >>> round(least.prime_radius, 4), round(least.offset, 4), least.active
    (22.5647, 11.2824, ('rise', 'rest'))
    >>> round(gc.minimum_radius(motion, gc.FlatFaced(), curvature=8.0).prime_radius, 9)
    38.0
    """
    check_kind("motion", motion, Motion)
    check_kind("follower", follower, FOLLOWER_CLASSES)
    sigma, exact = sense(rotation), EXACT_FUNCTIONS[type(follower)]
    if offset is not None and exact.condition != "offset":
        raise DesignError("offset", offset, say("left out"), say("only a translating follower has an offset"))
    limits = Limits(math.radians(follower.usual_limit_deg) if rise is None else rise, return_, rest)
    condition = curvature if exact.condition == "curvature" else offset
    least = exact.least_radius(motion, follower, sigma, limits, *([] if condition is None else [condition]))
    if curvature is None or isinstance(least, FlatMinimumRadius):
        return least
    place = {"offset": offset, "distance": getattr(follower, "distance", None)}[least.place_name]
    if place is None:
        remedy = say("give the {place} too", place=PLACE_TITLES[least.place_name])
        raise DesignError("curvature", curvature, say("left out where the place is to be found"), remedy)
    placed = replace(follower, **{least.place_name: place})
    return sharp_enough(motion, placed, sigma, limits, least, curvature)

"""The minimum prime radius that keeps the pressure angle, or of a flat-faced follower the curvature, within its limits.

Each follower's stands in a file of its own: :mod:`~graphcam.mechanism.least_radius_translating`,
:mod:`~graphcam.mechanism.least_radius_arm`, :mod:`~graphcam.mechanism.flat_faced` and
:mod:`~graphcam.mechanism.oscillating_flat`.
"""

import math
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
from graphcam.mechanism.least_radius_translating import MinimumRadius
from graphcam.words import say


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
    """The minimum prime radius for permitted pressure angles, or, under a flat face, for a permitted curvature.

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
    curvature : the minimum permitted radius of curvature [mm] of the profile under a flat face; None is 0, where the
        profile has a cusp, which a cam can only approach

    Without the rest condition a given offset larger than M needs no height at all; the radius returned is then the
    offset itself, which a cam can only approach, and no line binds.  The same holds for an arm that only has to reach:
    r0 = |c - l|.  The minimum radius under a flat face is never negative; it is 0 where any prime radius will do.

    Raises
    ------
    DesignError : a limit is not between 0 and 90 degrees or an arm cannot satisfy it (its lift is too large for any
        radius, or for the given distance), a length is not finite, or an offset or a curvature is given for a follower
        that has none

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
    if curvature is not None and exact.condition != "curvature":
        limit = say("left out")
        raise DesignError("curvature", curvature, limit, say("only a flat face limits the radius by the curvature"))
    if offset is not None and exact.condition != "offset":
        raise DesignError("offset", offset, say("left out"), say("only a translating follower has an offset"))
    limits = Limits(math.radians(follower.usual_limit_deg) if rise is None else rise, return_, rest)
    condition = offset if curvature is None else curvature
    if condition is None:
        return exact.least_radius(motion, follower, sigma, limits)
    return exact.least_radius(motion, follower, sigma, limits, condition)

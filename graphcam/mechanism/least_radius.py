"""The minimum prime radius that keeps the pressure angle, and the profile's curvature, within their limits.

Each follower's stands in a file of its own: :mod:`~graphcam.mechanism.least_radius_lines`,
:mod:`~graphcam.mechanism.flat_faced` and :mod:`~graphcam.mechanism.oscillating_flat`.

Under a roller the working profile is the pitch curve less the roller, so its convex radius of curvature is rho - r;
hollows of a sound cam only widen.  From the radius that the pressure angles need, the prime radius grows, at the same
offset or centre distance, until rho of the sharpest place is the roller radius and the permitted one together.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, Concatenate, ParamSpec, Protocol, cast, overload

import numpy as np

from graphcam.errors import DesignError, check_kind, check_number
from graphcam.given.follower import (
    FOLLOWER_CLASSES,
    FlatFaced,
    Follower,
    Limits,
    Oscillating,
    OscillatingFlat,
    Rotation,
    Translating,
    no_prime_radius,
    sense,
)
from graphcam.given.motion import Motion
from graphcam.given.root_finding import roots
from graphcam.mechanism.flat_faced import FlatMinimumRadius
from graphcam.mechanism.followers import EXACT_FUNCTIONS, LeastRadius, kinematics
from graphcam.mechanism.kinematics import Kinematics
from graphcam.mechanism.least_radius_lines import ArmMinimumRadius, MinimumRadius
from graphcam.mechanism.turn_extremes import highest_places
from graphcam.words import say

GROWTH = 1.05
"""The factor between prime radii that are tried, until the profile is nowhere too sharp."""
MAX_GROWTH = 1e6
"""So many times the sizes of the follower a prime radius is tried."""
ANGLE_ROUNDING = 1e-9
"""Of the tangent of a permitted angle: what the angle may pass it by for the arithmetic."""


def _sharp_enough(
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
    >>> least = _sharp_enough(motion, follower, +1, limits, steep, 4.0)
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


PLACE_TITLES = {"offset": say("offset"), "distance": say("centre distance")}


_Given = ParamSpec("_Given")


class _ByFollower(Protocol[_Given]):
    """A function of a motion and a follower, which decides in what its least radius is told."""

    @overload
    def __call__(
        self, motion: Motion, follower: Translating, *given: _Given.args, **named: _Given.kwargs
    ) -> MinimumRadius: ...
    @overload
    def __call__(
        self, motion: Motion, follower: Oscillating, *given: _Given.args, **named: _Given.kwargs
    ) -> ArmMinimumRadius: ...
    @overload
    def __call__(
        self, motion: Motion, follower: FlatFaced | OscillatingFlat, *given: _Given.args, **named: _Given.kwargs
    ) -> FlatMinimumRadius: ...


def _by_follower(function: Callable[Concatenate[Motion, Any, _Given], LeastRadius]) -> _ByFollower[_Given]:
    return cast(_ByFollower[_Given], function)


@_by_follower
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
    return _sharp_enough(motion, placed, sigma, limits, least, curvature)

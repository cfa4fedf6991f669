"""How pressure angle, radius of curvature, minimum radius and motion change with the sizes of a cam: exact derivatives.

Two questions differ.  In *design* a size is chosen otherwise, and the cam is computed anew for the same motion: then
pressure angle and curvature change.  In *making* the cam is what it is, and the mechanism around it is off: then the
motion changes.  The derivatives are those of the implicit formulas, not differences.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError
from graphcam.given.follower import Follower, Rotation, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.followers import kinematics
from graphcam.mechanism.kinematics import Kinematics, Values
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.mechanism.made_cam import lifts_by_error
from graphcam.mechanism.turn_extremes import highest_places
from graphcam.showing import parts_text
from graphcam.words import say

BINDING_ANGLE = 1e-7
"""How far a pressure angle may be off its limit [rad] where the minimum radius is said to be held by it."""


@dataclass(frozen=True, eq=False)
class Sensitivities:
    """The derivatives of a cam's quantities by its sizes, per mm; by the lift per mm, or of an arm per rad.

    Every method takes cam angles phi [rad] and gives arrays shaped like them by the names of the sizes.  A change of
    the lift stretches the whole motion.

    >>> import graphcam as gc
    >>> from math import degrees, pi
    >>> motion = gc.Motion([gc.Rise(10, pi), gc.Return(10, pi)])
    >>> found = gc.sensitivities(gc.Cam(motion, gc.Translating(roller_radius=8), prime_radius=30))
    >>> {name: round(degrees(by), 3) for name, by in found.pressure_angle(pi / 2).items()}
    {'prime_radius': -0.271, 'offset': -1.591, 'lift': 0.814}
    """

    cam: Cam
    __repr__ = parts_text

    def pressure_angle(self, phi: ArrayLike) -> dict[str, Floats]:
        """The derivatives of alpha by the sizes of the design [rad/mm]."""
        return self._by_lift(self.cam.kinematics.angle_by_sizes(self.cam.motion(phi)))

    def curvature_radius(self, phi: ArrayLike) -> dict[str, Floats]:
        """Derivatives of the working profile's signed radius of curvature rho - r by the design's sizes [mm/mm].

        inf or NaN at an inflection of the pitch curve.
        """
        kin = self.cam.kinematics
        with np.errstate(divide="ignore", invalid="ignore"):
            found = self._by_lift(kin.radius_by_sizes(self.cam.motion(phi)))
        return found | {"roller_radius": -np.ones(np.shape(phi))} if kin.takes_roller else found

    def motion(self, phi: ArrayLike) -> dict[str, Floats]:
        """Derivatives of (s, v, a), (3, ...), by what is too large as it is made [mm; rad of an arm, per mm].

        "profile" is the profile that lies too far out along its normal, everywhere; a wave of it is in
        :func:`~graphcam.motion_bands`.  Where the acceleration jumps, those of v and a are of the right side.
        """
        lifted = lifts_by_error(self.cam.kinematics, self.cam.motion(phi))
        return {name: np.array([by.value, by.slope, by.bend]) for name, by in lifted.items()}

    def _by_lift(self, found: dict[str, Floats]) -> dict[str, Floats]:
        return found | {"lift": found["lift"] / self.cam.motion.lift}


def sensitivities(cam: Cam) -> Sensitivities:
    """The changes of pressure angle, curvature and motion of a cam with its sizes.

    On a flank with the pressure angle alpha an error of the profile displaces the follower by 1/cos(alpha) times its
    size, one of the offset by tan(alpha) times its size.

    Source: R. L. Norton, *Cam Design and Manufacturing Handbook* (2009), chapters 7 and 13, for the quantities; the
    derivatives are those of the conventions of :mod:`graphcam`.

    >>> import graphcam as gc
    >>> cam = gc.solve(gc.builtin_task()).cam
    >>> {name: by[0].round(4).tolist() for name, by in gc.sensitivities(cam).motion([0.0, 0.7]).items()}
    {'profile': [1.0269, 1.1497], 'roller_radius': [1.0269, 1.1497], 'offset': [0.2334, -0.5672]}
    """
    return Sensitivities(cam)


# --- the least radius ------------------------------------------------------------------------------------------------


class _HoldingPlace(NamedTuple):
    """A place of the motion at which sense * alpha has reached the limit of that name."""

    limit: str
    sense: float
    values: Values


def radius_sensitivity(
    motion: Motion,
    follower: Follower,
    rotation: Rotation = "ccw",
    rise: float | None = None,
    return_: float | None = None,
    offset: float | None = None,
    rest: bool = True,
    curvature: float | None = None,
) -> dict[str, float]:
    """The derivatives of the minimum prime radius by the sizes that determine it, per mm or, by an angle, per rad.

    At the minimum radius one or two places of the motion have just the permitted pressure angle: sigma_i alpha_i = A_i.
    Along the motion alpha is largest there, so these places stand still to the first order (the theorem of the
    envelope); and so does an offset or a distance that is free, where one limit alone holds the radius.  What remains
    is linear in the changes of r0, of a free offset or distance x, and of a size p:

        sigma_i (d alpha_i/d r0 dr0 + d alpha_i/dx dx + d alpha_i/dp dp) = dA_i

    The arguments are those of :func:`graphcam.minimum_radius`.  The derivatives are called "rise" and "return" by the
    permitted angles, "offset" or "distance" where it is given, "arm", "lift", and under a flat face "curvature" and the
    sizes of the face.  There the sharpest place takes the place of the steepest.

    Raises
    ------
    DesignError : as for :func:`graphcam.minimum_radius`, or no limit holds the radius

    >>> import graphcam as gc
    >>> from math import pi
    >>> motion = gc.Motion([gc.Rise(30, pi / 2, "cosine"), gc.Return(30, pi / 2, "cosine"), gc.Dwell(pi)])
    >>> {name: round(by, 4) for name, by in gc.radius_sensitivity(motion, gc.Translating()).items()}
    {'lift': 0.7522, 'rise': -53.5363}
    """
    limits = {"rise": math.radians(follower.usual_limit_deg) if rise is None else rise, "return": return_}
    least = minimum_radius(motion, follower, rotation, rise, return_, offset, rest, curvature)
    if not least.active:
        remedy = say("without one the radius is where the follower only just reaches the cam")
        shown = say("{length:g} mm", length=least.prime_radius)
        raise DesignError(say("minimum prime radius"), shown, say("held by a limit"), remedy)
    if least.place_name is None:
        slopes = _sharpest_radius_by_sizes(
            motion, kinematics(follower, least.prime_radius, sense(rotation), motion.lift)
        )
        by_radius = slopes.pop("prime_radius")
        found = {name: -by / by_radius for name, by in slopes.items()} | {"curvature": 1 / by_radius}
        return found | {"lift": found["lift"] / motion.lift}
    fixed = {"offset": offset, "distance": getattr(follower, "distance", None)}[least.place_name] is not None
    free = ["prime_radius"] if fixed else ["prime_radius", least.place_name]
    sized = replace(follower, roller_radius=0.0, **{least.place_name: least.place})
    kin = kinematics(sized, least.prime_radius, sense(rotation), motion.lift)
    held = list(_holding_places(motion, kin, least.active, limits))[: len(free)]
    slopes = [kin.angle_by_sizes(place.values) for place in held]
    # Of a single place alpha does not change with what is free beside r0: it is the least radius of all.
    matrix = [[place.sense * by[name] for name in free[: len(held)]] for place, by in zip(held, slopes, strict=True)]
    given = [name for name in slopes[0] if name not in free]
    right = {name: [-place.sense * by[name] for place, by in zip(held, slopes, strict=True)] for name in given}
    right |= {name: [float(place.limit == name) for place in held] for name, limit in limits.items() if limit}
    found = {name: float(np.linalg.solve(np.array(matrix), np.array(column))[0]) for name, column in right.items()}
    return found | {"lift": found["lift"] / motion.lift}


def _sharpest_radius_by_sizes(motion: Motion, kin: Kinematics) -> dict[str, float]:
    """The derivatives of the minimum radius of curvature: its place stands still to the first order."""
    values = highest_places(motion, kin.sharpness).values
    k = int(np.argmax(kin.sharpness(values)))
    return {name: float(by[k]) for name, by in kin.radius_by_sizes(values).items()}


def _holding_places(
    motion: Motion, kin: Kinematics, active: Sequence[str], limits: Mapping[str, float | None]
) -> Iterator[_HoldingPlace]:
    for name, direction in (("rise", 1.0), ("return", -1.0)):
        if name in active:
            towards = direction * kin.leaning
            yield _HoldingPlace(name, towards, _steepest(motion, kin, direction, towards))
    if "rest" in active:
        for s, towards, (name, limit) in product((0.0, motion.lift), (-1.0, 1.0), limits.items()):
            values = np.array(s), np.zeros(()), np.zeros(()), np.zeros(())
            alpha = math.atan(kin.steepness(values))
            if limit and abs(towards * alpha - limit) < BINDING_ANGLE:
                yield _HoldingPlace(name, towards, values)


def _steepest(motion: Motion, kin: Kinematics, direction: float, towards: float) -> Values:
    """(s, v, a, j) where towards * alpha is largest on all rises, or on all returns."""

    def steepness(values: Values) -> Floats:
        return towards * kin.steepness(values)

    places = highest_places(motion, steepness)
    values = places.selected(motion.directions[places.phase] == direction).values
    k = np.argmax(steepness(values))
    s, v, a, j = (value[k] for value in values)
    return s, v, a, j

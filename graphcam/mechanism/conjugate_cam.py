"""The second cam of a conjugate pair: on the same shaft, for a second roller on the same follower, which holds it back.

The second roller is fixed to the follower, so its centre q follows from s alone: with its derivatives by s its velocity
is q' = q_s v, and q'' = q_s a + q_ss v^2.  Seen from the cam its path is p = q exp(-i sigma phi), with

    p' = (q' - i sigma q) exp(-i sigma phi),    p'' = (q'' - 2 i sigma q' - q) exp(-i sigma phi)

and the profile lies inside of it by the second roller's radius, as that of the first cam does.

Source: H. A. Rothbart, *Cam Design Handbook* (2004), chapter 2, on positive drive by conjugate cams.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError, check_kind, check_number
from graphcam.former_names import renamed
from graphcam.given.laws import Floats, Side
from graphcam.given.motion import Motion, wrap
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.envelope import Envelope, outer_wall
from graphcam.mechanism.kinematics import Complexes, Kinematics, RollerKinematics, Values
from graphcam.mechanism.turn_extremes import Places, ValueAt, turn_maximum
from graphcam.plane_vectors import cross, dot
from graphcam.words import say


@dataclass(frozen=True, eq=False)
class _SecondPath:
    """The path of the second roller's centre, which lies in ``at`` when the follower is lowest; see the module."""

    kinematics: Kinematics
    at: complex
    takes_roller: ClassVar[bool] = True

    @property
    def sigma(self) -> Any:
        return self.kinematics.sigma

    @property
    def prime_radius(self) -> float:
        return abs(self.at)

    def bent(self, values: Values) -> tuple[Complexes, Complexes, Complexes]:
        """The centre in the frame, and the first two derivatives of its path as the cam sees it."""
        s, v, a, _ = values
        centre, by_s, bent_by_s = self.kinematics.carried(self.at, s)
        turning, moved = 1j * self.sigma, by_s * v
        return centre, moved - turning * centre, by_s * a + bent_by_s * v * v - 2 * turning * moved - centre

    def point(self, values: Values) -> Complexes:
        return self.bent(values)[0]

    def normal(self, values: Values) -> Complexes:
        along = self.bent(values)[1]
        return 1j * self.sigma * along / np.abs(along)

    def speed(self, values: Values, inset: float) -> Floats:
        return np.abs(self.bent(values)[1]) * (1 - inset * self.curvature(values))

    def curvature(self, values: Values) -> Floats:
        _, along, bent = self.bent(values)
        return -self.sigma * cross(along, bent) / np.abs(along) ** 3

    def sharpness(self, values: Values) -> Floats:
        return self.curvature(values)

    def convex_radius(self, values: Values) -> Floats:
        return RollerKinematics.radius_of(self.curvature(values))


@renamed(least_radius="min_convex_radius")
@dataclass(frozen=True)
class ConjugateCam:
    """The second cam of a conjugate pair, whose roller holds the follower on the first.

    cam : the first cam, of a follower with a roller
    at : (x, y) of the second roller's centre with the follower in its lowest position [mm]; the origin is the cam
        centre, a stem moves along y, an arm's pivot is (distance, 0)
    roller_radius : of the second roller [mm]

    Raises
    ------
    DesignError : the follower has no roller, a size is not finite, the second roller does not hold the follower back
        over the whole turn, or is too large for the path of its centre

    A stem with both rollers 100 mm apart, on either side of the cam centre; the lobes are alike, so the breadth is
    equal and both cams are one:

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(20, pi), gc.Return(20, pi)])
    >>> cam = gc.Cam(motion, gc.Translating(roller_radius=10), prime_radius=40)
    >>> second = gc.ConjugateCam(cam, at=(0, -60), roller_radius=10)
    >>> second.pitch_curve(0).round(6).tolist(), (second.profile([0, pi]).round(6) + 0.0).tolist()
    ([0.0, -60.0], [[0.0, -50.0], [0.0, 30.0]])
    >>> float(abs(cam.profile(pi / 3) - second.profile(pi / 3 + pi)).max()) < 1e-12
    True
    """

    cam: Cam
    at: tuple[float, float]
    roller_radius: float

    def __post_init__(self) -> None:
        check_kind("cam", self.cam, Cam)
        if not self.cam.kinematics.takes_roller:
            raise DesignError("follower", self.cam.follower.kind, say("one with a roller"))
        for coordinate in self.at:
            check_number("at", coordinate, say("two finite coordinates in mm"))
        check_number("roller_radius", self.roller_radius, say("a finite length of 0 mm or more"), least=0)
        freed = turn_maximum(self.motion, self._pushed)
        if freed.value >= 0:
            place = say("({x:g}, {y:g})", x=self.at[0], y=self.at[1])
            limit = say("where the second cam pushes the follower back to the first, at {phi:.4g} degrees too")
            remedy = say("place it on the other side of the cam centre, farther away")
            raise DesignError("at", place, limit.with_values(phi=math.degrees(freed.phi)), remedy)
        least = self.min_convex_radius
        if self.roller_radius >= least.value:
            limit = say("less than {radius:.4g} mm, the radius of curvature of its centre's path at {phi:.4g} degrees")
            limit = limit.with_values(radius=least.value, phi=math.degrees(least.phi))
            raise DesignError("roller_radius", self.roller_radius, limit, say("take a smaller roller"))

    def pitch_curve(self, phi: ArrayLike, side: Side = "right") -> Floats:
        """(..., 2) the path of the second roller's centre on the cam [mm], at cam angles phi [rad]."""
        phi = wrap(np.asarray(phi, dtype=np.float64))
        return self._on_cam(self._path.point(self.motion(phi, side)), phi)

    def profile(self, phi: ArrayLike, side: Side = "right") -> Floats:
        """(..., 2) the second cam's working profile [mm], in the coordinates of the first cam."""
        phi = wrap(np.asarray(phi, dtype=np.float64))
        values = self.motion(phi, side)
        return self._on_cam(self._path.point(values) - self.roller_radius * self._path.normal(values), phi)

    @property
    def motion(self) -> Motion:
        """The motion of the follower, which both cams give it."""
        return self.cam.motion

    @property
    def sigma(self) -> int:
        """The sense in which both cams turn."""
        return self.cam.sigma

    @property
    def prime_radius(self) -> float:
        """The distance of the second roller's centre from the cam centre with the follower in its lowest position."""
        return self._path.prime_radius

    @property
    def table_turn(self) -> complex:
        """As of the first cam."""
        return self.cam.table_turn

    @cached_property
    def envelope(self) -> Envelope:
        """The profile as a curve."""
        return Envelope(self.motion, self._path, self.roller_radius)

    @cached_property
    def outer_wall(self) -> Envelope:
        """The outer wall of a groove for the second roller."""
        return outer_wall(self.motion, self._path, self.roller_radius)

    @cached_property
    def min_convex_radius(self) -> ValueAt:
        """The minimum convex radius of curvature of the path of the second roller's centre [mm], and its place."""
        sharpest = turn_maximum(self.motion, lambda places: self._path.curvature(places.values))
        return sharpest._replace(value=1 / sharpest.value if sharpest.value > 0 else math.inf)

    @cached_property
    def _path(self) -> _SecondPath:
        return _SecondPath(self.cam.kinematics, complex(*self.at))

    def _pushed(self, places: Places) -> Floats:
        """How the second cam pushes the follower, by a unit of force: below 0 towards the first cam."""
        _, by_s, _ = self.cam.kinematics.carried(complex(*self.at), places.values[0])
        return dot(by_s, self._path.normal(places.values)) / np.abs(by_s)

    def _on_cam(self, points: Complexes, phi: Floats) -> Floats:
        turned = points * np.exp(-1j * self.cam.sigma * phi)
        return np.stack([turned.real, turned.imag], axis=-1)

"""What a cam needs to know of its follower: each kind of follower has one file that says it.

The trace point z(phi) of the frame, a complex number, is seen from the turning cam as p = z exp(-i sigma phi), with

    p' = q1 exp(-i sigma phi),   q1 = z' - i sigma z

for every follower with a roller or a knife edge.  The curve runs against the cam's sense, so the outer normal is
i sigma q1/|q1|.  The vector q whose argument is the pressure angle is q1, turned, and in its parts the curvature,
positive where the cam is convex, is (|q|^2 + g q.imag - h q.real)/|q|^3, with g and h of each follower's own.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import check_kind
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.spring_load import ArmLoad, FollowerLoad, SpringLoad
from graphcam.words import say

Complexes = NDArray[np.complexfloating[Any, Any]]
Pair = tuple[Floats | float, Floats | float]
"""The x and y of plane vectors; real, because numpy takes its time with complex arrays."""
Values = tuple[Floats, Floats, Floats, Floats]
"""(s, v, a, j)"""
INERTIA_REMEDY, MASS_REMEDY = say("give its inertia about the pivot"), say("an ArmLoad turns an arm")


@dataclass(frozen=True, eq=False)
class Appearance:
    """A follower as a picture of the mechanism shows it.

    kind : a stem with a roller or a knife edge, an arm, a flat face, a flat face that swings
    trace : (n,) the trace point, or the middle of the face, or where it touches;  motion : (n,) unit directions of its
        motion on the rise
    pivot : of the arm, or of the face;  face : how far the face reaches to the left (negative) and to the right, or
        where it begins and ends from the foot of its pivot [mm]
    """

    kind: Literal["stem", "arm", "face", "blade"]
    trace: Complexes
    motion: Complexes
    pivot: complex = 0j
    face: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Contour:
    """A curve on the turned cam, with which the follower is in contact, at places of it; points are of the frame.

    point : mm;  normal : of length 1, away from the cam;  curvature : 1/mm, positive where convex
    speed : how far the curve runs on, along -i sigma times the normal, with the parameter;  turning : of the normal
    """

    point: Complexes
    normal: Complexes
    curvature: Floats
    speed: Floats
    turning: Floats


@dataclass(frozen=True, eq=False)
class Kinematics(ABC):
    """One kind of follower on one cam; points and vectors of the frame are complex numbers, x + i y.

    Everything follows from (s, v, a, j), whatever the angle or the phase they came from.  Sizes may also be arrays, of
    many cams at once: what does not fit gives NaN.

    sigma : the sense in which the cam turns;  prime_radius : r0 [mm]
    """

    sigma: Any
    prime_radius: Any
    takes_roller: ClassVar[bool] = True
    """Whether a roller touches the cam, or a knife edge in its place: then a smaller roller mends an undercut."""
    has_pressure_angle: ClassVar[bool] = True
    """Whether the contact pushes the follower aside at all."""
    swings: ClassVar[bool] = False
    """Whether the follower swings about a pivot: then s is an angle, and a load along the motion a torque."""
    max_speed_with_cam: ClassVar[float] = math.inf
    """What |v| [rad/rad] must stay below where the follower turns in the sense of the cam."""

    @classmethod
    @abstractmethod
    def of(cls, sizes: Any, prime_radius: Any, sigma: Any, lift: Any) -> Self:
        """The kinematics of a follower, or of many with arrays for its sizes."""

    @abstractmethod
    def check(self) -> None:
        """Check that such a cam, a single one, can exist.

        Raises
        ------
        DesignError : the follower does not fit the prime radius or the lift
        """

    def face_ends(self, motion: Motion) -> Mapping[str, float]:
        """How far the contact wanders on a flat face [mm], by the names of its ends; none without a face."""
        return {}

    def check_motion(self, motion: Motion) -> None:  # noqa: B027 - most followers can do any
        """Check that the follower can do a motion, beyond its lift.

        Raises
        ------
        DesignError : it cannot
        """

    def part(self, which: NDArray[Any] | slice) -> Self:
        """The kinematics of some of the cams, with what is known of them already."""
        some = copy(self)
        for name, values in vars(self).items():
            object.__setattr__(some, name, values[which])
        return some

    @abstractmethod
    def path(self, values: Values) -> tuple[Pair, Pair, Floats]:
        """The point [mm] whose path on the cam is the pitch curve, the unit normal away from the cam, the curvature."""

    @abstractmethod
    def pressure(self, values: Values) -> tuple[Pair, Pair]:
        """A vector q whose argument is the pressure angle, and q'."""

    def seen(self, values: Values) -> Pair:
        """q of :meth:`pressure` alone."""
        return self.pressure(values)[0]

    def steepness(self, values: Values) -> Floats:
        """The tangent of the pressure angle."""
        (along, across), _ = self.pressure(values)
        return np.divide(across, along)

    def steepest(self, lift: Any, speed: Any) -> Any:
        """What |tan(alpha)| does not exceed over a motion with that lift and that greatest |v|; 0 of a face."""
        return 0.0 * lift

    def pressed_by(self, load: Any) -> FollowerLoad:
        """A load on the follower beside this cam, or beside each of many.

        Raises
        ------
        DesignError : it is a load on another kind of follower, or does not fit
        """
        if self.swings:
            check_kind("load", load, ArmLoad, say("an ArmLoad, for the follower swings"), INERTIA_REMEDY)
        else:
            check_kind("load", load, SpringLoad, say("a SpringLoad, for the follower slides"), MASS_REMEDY)
        return load

    def reach(self, values: Values) -> tuple[Any, Any]:
        """How far the point of contact, or the trace point, moves with s [mm per mm; of an arm per rad]; its slope."""
        return 1.0, 0.0

    def rim(self, roller: Any) -> Any:
        """How far beside the trace point the friction on a roller [mm] turns the follower, in parts of the reach."""
        return 0.0

    @abstractmethod
    def lift_per_error(self, values: Values) -> dict[str, Any]:
        """How far the follower is lifted [mm or rad] per mm by which something is too large as it is made.

        By "profile", along its normal; by the roller's radius, and by the sizes of the mechanism, which the cam does
        not follow: it is cut for the nominal ones.  Displacements of the trace point along the normal of the pitch
        curve decide: the cam pushes the follower by d/cos(alpha) where the curve lies d too far out.
        """

    @abstractmethod
    def gap(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any]:
        """What vanishes where the follower meets a contour of the turned cam, and its derivative along the contour.

        sizes : by how much each is too large [mm]
        """

    @abstractmethod
    def motion_on_contour(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any, Any]:
        """(s, v, a) of a follower that meets a contour of the turned cam: from place, normal and curvature there."""

    @abstractmethod
    def angle_by_sizes(self, values: Values) -> dict[str, Floats]:
        """The derivatives of the pressure angle by the sizes of the design [rad/mm] and by the lift [rad].

        The cam is designed anew for every size, and gives the same motion; the lift stretches it all, so that by it
        they are those of d/dk where s, v and a are k times as large.
        """

    @abstractmethod
    def radius_by_sizes(self, values: Values) -> dict[str, Floats]:
        """Derivatives of the pitch curve's signed radius of curvature by the sizes; inf or NaN where it is flat."""

    @property
    def leaning(self) -> Any:
        """The sign of sin(alpha) where the cam, that slides past the follower, holds it back by friction: +1 or -1."""
        return 1.0

    @abstractmethod
    def sliding(self, values: Values, roller: float) -> tuple[Floats, Floats]:
        """The velocity of the cam past a follower whose roller does not turn [mm/rad], and its derivative by phi."""

    def tipping(self, values: Values, friction: float, roller: float) -> Floats:
        """The moment of a unit normal force with its friction about trace point or middle of the face [mm].

        Positive as that of the friction on a roller.
        """
        return np.zeros_like(values[0]) + friction * roller

    @abstractmethod
    def speed(self, values: Values, inset: float) -> Floats:
        """How far the curve parallel to the pitch curve, ``inset`` mm inside of it, runs on [mm/rad].

        Negative where it runs backwards.  Forwards is against the cam's sense, along -i sigma times the normal.
        """

    @abstractmethod
    def curvature(self, values: Values) -> Floats:
        """Curvature kappa of the pitch curve [1/mm], positive where the cam is convex."""

    @abstractmethod
    def sharpness_and_slope(self, values: Values) -> tuple[Floats, Floats]:
        """The sharpness, and what has the sign of its derivative; both cost little more than one."""

    @abstractmethod
    def sharpness(self, values: Values) -> Floats:
        """What is greatest where the radius of curvature is least that a design keeps from becoming too small."""

    @staticmethod
    @abstractmethod
    def radius_of(sharpness: Floats) -> Floats:
        """The roller radius [mm] as far as it matters: inf where it does not, NaN for NaN."""

    @abstractmethod
    def relative_radius(self, values: Values, roller: Any) -> Floats:
        """R of Hertz's contact with the profile [mm]; not positive where the profile is undercut.

        1/R is the sum of both curvatures.  roller : its radius [mm]
        """

    def convex_radius(self, values: Values) -> Floats:
        """The radius of curvature [mm] that a design keeps from becoming too small; inf where it does not matter."""
        return self.radius_of(self.sharpness(values))

    def point(self, values: Values) -> Complexes:
        """The point [mm] whose path on the cam is the pitch curve."""
        (x, y), _, _ = self.path(values)
        return x + 1j * np.asarray(y)

    def normal(self, values: Values) -> Complexes:
        """The unit normal of the pitch curve there, away from the cam."""
        _, (x, y), _ = self.path(values)
        return x + 1j * np.asarray(y)

    def carried(self, place: complex, s: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """A point of the follower, and its first two derivatives by s [mm; of an arm mm/rad and mm/rad^2].

        place : of the point in the lowest position, x + i y [mm];  by default it slides upwards
        """
        return place + 1j * s, np.full(np.shape(s), 1j), np.zeros(np.shape(s), np.complex128)

    def appearance(self, motion: Motion, values: Values) -> Appearance:
        """What is to be shown of the follower over places of a motion; by default a stem that slides upwards."""
        return Appearance("stem", self.point(values), np.full(np.shape(values[0]), 1j))


@dataclass(frozen=True, eq=False)
class RollerKinematics(Kinematics):
    """A follower with a roller or a knife edge: what follows from its trace point."""

    @abstractmethod
    def trace(self, values: Values) -> tuple[Pair, Pair]:
        """The trace point z [mm] and z' by phi, from (s, v, a, j)."""

    def path(self, values: Values) -> tuple[Pair, Pair, Floats]:
        """The trace point [mm], the unit normal of the pitch curve away from the cam, and its curvature [1/mm]."""
        z, (x, y) = self.trace(values)
        x, y = x + self.sigma * z[1], y - self.sigma * z[0]
        factor = self.sigma / np.sqrt(x * x + y * y)
        return z, (-y * factor, x * factor), self.curvature(values)

    def point(self, values: Values) -> Complexes:
        """The trace point [mm]."""
        x, y = self.trace(values)[0]
        return x + 1j * np.asarray(y)

    @abstractmethod
    def seen_by_sizes(self, values: Values) -> dict[str, tuple[Pair, Pair]]:
        """The derivatives of q, and of g and h, by the sizes and by the lift as for :meth:`angle_by_sizes`."""

    def angle_by_sizes(self, values: Values) -> dict[str, Floats]:
        """alpha = arg q turns by the part of dq across q."""
        along, across = q = self.seen(values)
        squared = np.add(along * along, across * across)
        return {name: pair_cross(q, by) / squared for name, (by, _) in self.seen_by_sizes(values).items()}

    def radius_by_sizes(self, values: Values) -> dict[str, Floats]:
        """The derivatives of rho = |q|^3/(|q|^2 + g q.imag - h q.real) by the sizes."""
        (along, across), ((g, h), _) = self.seen(values), self.bend(values)
        squared, bent = self._bent(values)
        radius = squared * np.sqrt(squared) / bent
        found: dict[str, Floats] = {}
        for name, ((by_along, by_across), (by_g, by_h)) in self.seen_by_sizes(values).items():
            longer = along * by_along + across * by_across
            more = 2 * longer + (by_g * across + g * by_across) - (by_h * along + h * by_along)
            found[name] = radius * (3 * longer / squared - more / bent)
        return found

    def outwards(self, values: Values) -> tuple[Any, Any]:
        """The secant 1/cos(alpha) and the tangent of the pressure angle."""
        steep = self.steepness(values)
        return np.sqrt(1 + steep * steep), steep

    def sliding(self, values: Values, roller: float) -> tuple[Floats, Floats]:
        """|q| - r: the cam slides past the trace point with |q|, and past the contact with less by the roller."""
        (along, across), (along1, across1) = self.pressure(values)
        speed = np.sqrt(along * along + across * across)
        return speed - roller, (along * along1 + across * across1) / speed

    def speed(self, values: Values, inset: float) -> Floats:
        """|p'| (1 - inset kappa) [mm/rad]."""
        squared, bent = self._bent(values)
        return np.sqrt(squared) - inset * bent / squared

    @abstractmethod
    def seen(self, values: Values) -> Pair:
        """q of :meth:`pressure`; it is as long as q1."""

    def steepness(self, values: Values) -> Floats:
        """The tangent of the pressure angle."""
        along, across = self.seen(values)
        return np.divide(across, along)

    @abstractmethod
    def bend(self, values: Values) -> tuple[Pair, Pair]:
        """The two factors g, h of kappa = (|q|^2 + g q.imag - h q.real)/|q|^3, and their derivatives g', h'."""

    def curvature(self, values: Values) -> Floats:
        """Curvature kappa of the pitch curve [1/mm], positive where the cam is convex."""
        squared, bent = self._bent(values)
        return bent / (squared * np.sqrt(squared))

    def _bent(self, values: Values) -> tuple[Floats, Floats]:
        """|q|^2, and kappa |q|^3."""
        (along, across), ((g, h), _) = self.seen(values), self.bend(values)
        squared = np.add(along * along, across * across)
        return squared, np.add(squared, g * across - h * along)

    def sharpness_and_slope(self, values: Values) -> tuple[Floats, Floats]:
        """kappa [1/mm], and what has the sign of kappa'."""
        (along, across), (along1, across1) = self.pressure(values)
        (g, h), (g1, h1) = self.bend(values)
        squared, half = along * along + across * across, along * along1 + across * across1
        bent = squared + (g * across - h * along)
        bent1 = 2 * half + (g1 * across - h1 * along) + (g * across1 - h * along1)
        return bent / (squared * np.sqrt(squared)), np.subtract(bent1 * squared, 3 * bent * half)

    def sharpness(self, values: Values) -> Floats:
        """The measure of sharpness: the curvature kappa [1/mm]."""
        return self.curvature(values)

    def relative_radius(self, values: Values, roller: Any) -> Floats:
        """r (1 - kappa r), whether the profile, of the radius 1/kappa - r, is convex, flat or concave."""
        return roller * (1 - self.curvature(values) * roller)

    @staticmethod
    def radius_of(sharpness: Floats) -> Floats:
        """1/kappa [mm] where the pitch curve is convex, else inf: a roller fits into any hollow of a sound cam."""
        return np.divide(1.0, sharpness, out=np.full_like(sharpness, np.inf), where=~(sharpness <= 0))


def pair_cross(a: Pair, b: Pair) -> Floats:
    """The vector product of vectors in two parts, x and y."""
    return np.subtract(a[0] * b[1], a[1] * b[0])

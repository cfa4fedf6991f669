"""The oscillating follower: the trace point swings about a pivot at (c, 0) on an arm of the length l.

Sources: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapter 4; for the angle of a triangle W. Kahan,
*Miscalculating Area and Angles of a Needle-like Triangle* (2014).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError
from graphcam.given.follower import Oscillating, swing_remedy
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.piecewise import sine_cosine
from graphcam.given.spring_load import FollowerLoad, PlacedArmLoad
from graphcam.mechanism.kinematics import Appearance, Complexes, Contour, Pair, RollerKinematics, Values
from graphcam.words import say


@dataclass(frozen=True, eq=False)
class OscillatingKinematics(RollerKinematics):
    """z = c - l exp(-i psi), with psi = psi0 + s the angle between the arm and the line of centres.

    arm, distance : l and c [mm];  swing : the greatest s [rad]
    """

    arm: Any
    distance: Any
    swing: Any
    swings = True

    @classmethod
    def of(cls, sizes: Oscillating, prime_radius: Any, sigma: Any, lift: Any) -> Self:
        """The kinematics of an arm at its centre distance; the lift is an angle."""
        if sizes.distance is None:
            remedy = say("take the one that minimum_radius(...) finds")
            raise DesignError(say("centre distance"), say("left open"), say("given for a cam"), remedy)
        made = cls(sigma, prime_radius, sizes.arm, sizes.distance, lift)
        _ = made.psi0  # so that its parts know it
        return made

    def check(self) -> None:
        """Check that arm, distance and prime radius close a triangle, and the arm stays above the line of centres."""
        arm, distance, r0 = self.arm, self.distance, self.prime_radius
        nearest, farthest = abs(distance - arm), distance + arm
        if not nearest < r0 < farthest:
            limit = say(
                "between {nearest:g} and {farthest:g} mm, where the arm of {arm:g} mm meets it from a centre "
                "distance of {distance:g} mm"
            )
            limit = limit.with_values(nearest=nearest, farthest=farthest, arm=arm, distance=distance)
            quantity = say("prime radius")
            raise DesignError(quantity, r0, limit, say("change the prime radius, the arm or the centre distance"))
        if math.isnan(self.psi0):
            left = math.degrees(math.pi - angle_between(distance, arm, r0))
            limit = say("less than the {left:g} degrees from the lower dwell to the stretched arm", left=left)
            remedy = say("make the lift or the prime radius smaller, or the centre distance or the arm longer")
            lift = say("{degrees:g} degrees", degrees=math.degrees(self.swing))
            raise DesignError("lift", lift, limit, swing_remedy(self.swing, remedy))

    @cached_property
    def psi0(self) -> Any:
        """The angle between the arm and the line of centres at the low rest [rad].

        >>> arm = OscillatingKinematics(+1, prime_radius=61, arm=125, distance=150, swing=0.2)
        >>> round(math.degrees(arm.psi0), 2)
        23.45
        """
        angle = angle_between(self.distance, self.arm, self.prime_radius)
        fits = (np.abs(self.distance - self.arm) < self.prime_radius) & (angle + self.swing < np.pi)
        return np.where(fits, angle, np.nan)[()]

    def carried(self, place: complex, s: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """A point of the arm, which turns about the pivot, and its first two derivatives by s [mm/rad, mm/rad^2]."""
        lever = (place - self.distance) * np.exp(-1j * s)
        return self.distance + lever, -1j * lever, -lever

    def trace(self, values: Values) -> tuple[Pair, Pair]:
        """The trace point z [mm] and z' by phi, from (s, v, a, j)."""
        s, v, _, _ = values
        sine, cosine = sine_cosine((self.psi0 + s) / 2)
        # By the half angle, because c and l cos(psi) may be nearly equal.
        x, y = (self.distance - self.arm) + 2 * self.arm * sine * sine, 2 * self.arm * sine * cosine
        return (x, y), (v * y, self.arm * v * (cosine - sine) * (cosine + sine))

    def pressure(self, values: Values) -> tuple[Pair, Pair]:
        """q = c sin(psi) + i (l (1 + sigma v) - c cos(psi)), whose argument is the pressure angle, and q'.

        It is the pitch curve's outer normal -i sigma exp(i sigma phi) p' seen along the trace point's motion
        i exp(-i psi), drawn from the end of the segment l v, which is laid off along the arm, to the cam centre.
        """
        _, v, a, _ = values
        along, across = self.seen(values)
        forth = self.arm - across + self.sigma * self.arm * v  # c cos(psi)
        return (along, across), (v * forth, v * along + self.sigma * self.arm * a)

    def seen(self, values: Values) -> Pair:
        """q of :meth:`pressure`: c sin(psi), and l (1 + sigma v) - c cos(psi)."""
        s, v, _, _ = values
        tangent = np.tan((self.psi0 + s) / 2)
        along = 2 * self.distance * tangent / (1 + tangent * tangent)
        # By the half angle, because l and c cos(psi) may be nearly equal.
        return along, (self.arm - self.distance) + self.sigma * self.arm * v + along * tangent

    def steepest(self, lift: Any, speed: Any) -> Any:
        """The bounds of numerator and denominator: cos(psi) falls and sin(psi) has its minimum at an end."""
        ends = self.psi0, self.psi0 + lift
        along = self.distance * np.minimum(*map(np.sin, ends))
        across = np.maximum(*(np.abs(self.arm - self.distance * np.cos(psi)) for psi in ends))
        return (across + self.arm * speed) / along

    def bend(self, values: Values) -> tuple[Pair, Pair]:
        """g = l v (sigma + v) and h = l a of kappa, and g', h'."""
        _, v, a, j = values
        return (self.arm * v * (self.sigma + v), self.arm * a), (self.arm * a * (self.sigma + 2 * v), self.arm * j)

    def pressed_by(self, load: Any) -> FollowerLoad:
        """A torque about the pivot."""
        super().pressed_by(load)
        placed = PlacedArmLoad(load, self.arm, self.distance, self.psi0)
        if np.ndim(self.psi0) == 0:
            placed.check(self.swing)
        return placed

    def reach(self, values: Values) -> tuple[Any, Any]:
        """l: s is an angle."""
        return self.arm, 0.0

    def rim(self, roller: Any) -> Any:
        """r/l: the friction acts at the rim of the roller."""
        return roller / self.arm

    @property
    def leaning(self) -> Any:
        """sigma: alpha is measured in one sense about the arm, whichever way the cam turns."""
        return self.sigma

    def lift_per_error(self, values: Values) -> dict[str, Any]:
        """1/(l cos(alpha)) by profile and roller; by c and l what moves the trace point along the normal.

        The normal has the angle alpha to the motion i exp(-i psi), so that c moves it by sin(psi - alpha) and l by
        sin(alpha) along it.
        """
        (outwards, steep), (along, across) = self.outwards(values), self.seen(values)
        sine, cosine = along / self.distance, (self.arm * (1 + self.sigma * values[1]) - across) / self.distance
        lift, level = outwards / self.arm, (steep * cosine - sine) / self.arm
        return {"profile": lift, "roller_radius": lift, "distance": level, "arm": -steep / self.arm}

    def gap(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any]:
        """How far beyond the arm's reach."""
        arm, distance = self._made_sizes(sizes)
        out = contour.point - distance
        along = -1j * self.sigma * contour.speed * contour.normal
        return np.abs(out) - arm, (along * out.conj()).real / np.abs(out)

    def motion_on_contour(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any, Any]:
        """psi from the place, tan(alpha) from the normal seen along i exp(-i psi), v from it, a from the curvature."""
        arm, distance = self._made_sizes(sizes)
        inwards = (distance - contour.point) / arm  # exp(-i psi)
        seen = contour.normal * (1j * inwards).conj()
        along, forth = -distance * inwards.imag, distance * inwards.real
        across = along * seen.imag / seen.real
        v = self.sigma * ((across + forth) / arm - 1)
        squared = along * along + across * across
        bent = contour.curvature * squared * np.sqrt(squared)
        a = (squared + arm * v * (self.sigma + v) * across - bent) / (arm * along)
        return -np.angle(inwards) - self.psi0, v, a

    def _made_sizes(self, sizes: Mapping[str, Any]) -> tuple[Any, Any]:
        """l and c as they are made [mm]."""
        return self.arm + sizes.get("arm", 0.0), self.distance + sizes.get("distance", 0.0)

    def seen_by_sizes(self, values: Values) -> dict[str, tuple[Pair, Pair]]:
        """The derivatives of q = c sin(psi) + i (l (1 + sigma v) - c cos(psi)); g = l v (sigma + v), h = l a.

        cos(psi0) = (c^2 + l^2 - r0^2)/(2 c l) gives psi0 by r0, c and l: r0, l cos(psi0) - c and c cos(psi0) - l, each
        over c l sin(psi0).
        """
        s, v, a, _ = values
        along, across = self.seen(values)
        forth, ahead = self.arm * (1 + self.sigma * v) - across, 1 + self.sigma * v
        low_sine, low_cosine = np.sin(self.psi0), np.cos(self.psi0)
        doubled = self.distance * self.arm * low_sine
        by_r0 = self.prime_radius / doubled
        by_c = (self.arm * low_cosine - self.distance) / doubled
        by_l = (self.distance * low_cosine - self.arm) / doubled
        g, h = v * (self.sigma + v), a
        return {
            "prime_radius": ((forth * by_r0, along * by_r0), (0.0, 0.0)),
            "distance": ((along / self.distance + forth * by_c, along * by_c - forth / self.distance), (0.0, 0.0)),
            "arm": ((forth * by_l, ahead + along * by_l), (g, h)),
            "lift": (
                (forth * s, self.sigma * self.arm * v + along * s),
                (self.arm * v * (self.sigma + 2 * v), self.arm * a),
            ),
        }

    def sliding(self, values: Values, roller: float) -> tuple[Floats, Floats]:
        """|q| - r (1 + sigma v): the roller turns with the arm."""
        speed, slope = super().sliding(values, roller)
        return speed - self.sigma * roller * values[1], slope - self.sigma * roller * values[2]

    def appearance(self, motion: Motion, values: Values) -> Appearance:
        """An arm; from the left it swings clockwise on the rise."""
        trace, pivot = self.point(values), complex(self.distance)
        return Appearance("arm", trace, -1j * (trace - pivot) / self.arm, pivot)


def angle_between(one: ArrayLike, two: ArrayLike, opposite: ArrayLike) -> Floats:
    """The angles [rad] between two sides of triangles, from the three sides; NaN where they do not close.

    >>> np.degrees(angle_between(3, 4, [5, 8])).tolist()
    [90.0, nan]
    """
    # Kahan's half-angle form: the law of cosines loses the digits of small angles.
    a: Floats = np.maximum(one, two)
    b: Floats = np.minimum(one, two)
    c: Floats = np.asarray(opposite, dtype=np.float64)
    rest = np.where(b >= c, c - (a - b), b - (a - c))
    with np.errstate(invalid="ignore"):
        above, below = np.sqrt(((a - b) + c) * rest), np.sqrt((a + (b + c)) * ((a - c) + b))
    return 2 * np.arctan2(above, below)

"""The translating follower: the trace point slides along the line x = e.

Source: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapter 4.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.follower import Translating
from graphcam.mechanism.kinematics import Contour, Pair, RollerKinematics, Values
from graphcam.words import say


@dataclass(frozen=True, eq=False)
class TranslatingKinematics(RollerKinematics):
    """z = e + i (s0 + s), with s0 = sqrt((r0 - e)(r0 + e)); offset : e [mm]."""

    offset: Any

    @classmethod
    def of(cls, sizes: Translating, prime_radius: Any, sigma: Any, lift: Any) -> Self:
        """The kinematics with the follower's offset."""
        return cls(sigma, prime_radius, sizes.offset)

    def check(self) -> None:
        """That the follower's line crosses the prime circle."""
        if not abs(self.offset) < self.prime_radius:
            limit = say(
                "smaller than the prime radius of {prime_radius} mm in magnitude", prime_radius=self.prime_radius
            )
            remedy = say("bring the follower nearer to the cam centre or enlarge the prime radius")
            raise DesignError("offset", self.offset, limit, remedy)

    @cached_property
    def s0(self) -> Any:
        """Height of the trace point over the cam centre at the low rest [mm]."""
        # Factored, because r0^2 - e^2 loses its digits where the offset is nearly the prime radius.
        with np.errstate(invalid="ignore"):
            return np.sqrt((self.prime_radius - self.offset) * (self.prime_radius + self.offset))

    def trace(self, values: Values) -> tuple[Pair, Pair]:
        """The trace point z [mm] and z' by phi, from (s, v, a, j)."""
        s, v, _, _ = values
        return (self.offset, self.s0 + s), (0.0, v)

    def pressure(self, values: Values) -> tuple[Pair, Pair]:
        """q = s0 + s + i (v - sigma e), whose argument is the pressure angle, and q'.

        tan(alpha) = (v - sigma e)/(s0 + s): the contact normal passes through the centre of relative rotation, which
        lies on the horizontal through the cam centre at the distance v.
        """
        _, v, a, _ = values
        return self.seen(values), (v, a)

    def seen(self, values: Values) -> Pair:
        """q of :meth:`pressure`: from the centre of relative rotation to the trace point, turned."""
        s, v, _, _ = values
        return self.s0 + s, v - self.sigma * self.offset

    def steepest(self, lift: Any, speed: Any) -> Any:
        """The bound (|v| + |e|)/s0 of the pressure angle's tangent."""
        return (speed + np.abs(self.offset)) / self.s0

    def bend(self, values: Values) -> tuple[Pair, Pair]:
        """g = v and h = a of kappa, and g', h'."""
        _, v, a, j = values
        return (v, a), (a, j)

    def lift_per_error(self, values: Values) -> dict[str, Any]:
        """1/cos(alpha) by profile and roller, sigma tan(alpha) by the offset: the trace point slides along the cam."""
        outwards, steep = self.outwards(values)
        return {"profile": outwards, "roller_radius": outwards, "offset": self.sigma * steep}

    def gap(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any]:
        """How far to the right of the follower's line."""
        along = -1j * self.sigma * contour.speed * contour.normal
        return contour.point.real - (self.offset + sizes.get("offset", 0.0)), along.real

    def motion_on_contour(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any, Any]:
        """tan(alpha) from the normal (-sigma sin(alpha), cos(alpha)), v from it, a from the curvature."""
        place, height = self.sigma * (self.offset + sizes.get("offset", 0.0)), contour.point.imag
        across = -self.sigma * height * contour.normal.real / contour.normal.imag
        v, squared = place + across, height * height + across * across
        bent = contour.curvature * squared * np.sqrt(squared)
        return height - self.s0, v, (squared + v * across - bent) / height

    def seen_by_sizes(self, values: Values) -> dict[str, tuple[Pair, Pair]]:
        """The derivatives of q = s0 + s + i (v - sigma e) by the sizes, s0^2 = r0^2 - e^2, with g = v and h = a."""
        s, v, a, _ = values
        straight: Pair = 0.0, 0.0
        by_r0: Pair = self.prime_radius / self.s0, 0.0
        by_e: Pair = -self.offset / self.s0, -self.sigma
        return {"prime_radius": (by_r0, straight), "offset": (by_e, straight), "lift": ((s, v), (v, a))}

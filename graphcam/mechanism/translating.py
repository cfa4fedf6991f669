"""The translating follower: the trace point slides along the line x = e.

Source: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapter 4.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.follower import Translating
from graphcam.mechanism.kinematics import Pair, RollerKinematics, Values


@dataclass(frozen=True, eq=False)
class TranslatingKinematics(RollerKinematics):
    """z = e + i (s0 + s), with s0 = sqrt((r0 - e)(r0 + e)); offset : e [mm]."""

    offset: Any

    @classmethod
    def of(cls, sizes: Translating, prime_radius: Any, sigma: Any, lift: Any) -> Self:
        """With the follower's offset."""
        return cls(sigma, prime_radius, sizes.offset)

    def check(self) -> None:
        """That the follower's line crosses the prime circle."""
        if not abs(self.offset) < self.prime_radius:
            limit = f"smaller than the prime radius of {self.prime_radius} mm in magnitude"
            remedy = "bring the follower nearer to the cam centre or enlarge the prime radius"
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
        """(|v| + |e|)/s0."""
        return (speed + np.abs(self.offset)) / self.s0

    def bend(self, values: Values) -> tuple[Pair, Pair]:
        """g = v and h = a of kappa, and g', h'."""
        _, v, a, j = values
        return (v, a), (a, j)

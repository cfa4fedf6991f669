"""The translating follower: the trace point slides along the line x = e.

Source: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapter 4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.follower import Translating
from graphcam.mechanism.kinematics import Pair, RollerKinematics, Values


@dataclass(frozen=True)
class TranslatingKinematics(RollerKinematics):
    """z = e + i (s0 + s), with s0 = sqrt((r0 - e)(r0 + e)).

    sigma : the sense in which the cam turns;  offset, prime_radius : e and r0 [mm]

    Raises
    ------
    DesignError : the follower's line passes the cam at the prime radius or farther out
    """

    offset: float
    prime_radius: float
    has_forces = True

    def __post_init__(self) -> None:
        if not abs(self.offset) < self.prime_radius:
            limit = f"smaller than the prime radius of {self.prime_radius} mm in magnitude"
            remedy = "bring the follower nearer to the cam centre or enlarge the prime radius"
            raise DesignError("offset", self.offset, limit, remedy)

    @classmethod
    def of(cls, follower: Translating, prime_radius: Any, sigma: Any, lift: Any) -> Self:
        """With the follower's offset."""
        return cls(sigma, follower.offset, prime_radius)

    @property
    def s0(self) -> float:
        """Height of the trace point over the cam centre at the low rest [mm]."""
        # Factored, because r0^2 - e^2 loses its digits where the offset is nearly the prime radius.
        return math.sqrt((self.prime_radius - self.offset) * (self.prime_radius + self.offset))

    def trace(self, values: Values) -> tuple[Pair, Pair, Pair, Pair]:
        """The trace point z [mm] and z', z'', z''' by phi, from (s, v, a, j)."""
        s, v, a, j = values
        return (self.offset, self.s0 + s), (0.0, v), (0.0, a), (0.0, j)

    def pressure(self, values: Values) -> tuple[Pair, Pair]:
        """q = s0 + s + i (v - sigma e), whose argument is the pressure angle, and q'.

        tan(alpha) = (v - sigma e)/(s0 + s): the contact normal passes through the centre of relative rotation, which
        lies on the horizontal through the cam centre at the distance v.
        """
        s, v, a, _ = values
        return (self.s0 + s, v - self.sigma * self.offset), (v, a)


@dataclass(frozen=True, eq=False)
class ManyTranslating(TranslatingKinematics):
    """Translating followers on many cams at once: offset, prime radius and sense are numbers or arrays.

    An offset that does not fit its prime radius gives NaN.
    """

    sigma: Any
    offset: Any
    prime_radius: Any

    def __post_init__(self) -> None:
        """No error: within arrays a miss is NaN."""

    @cached_property
    def s0(self) -> Any:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Heights of the trace points over the cam centre at the low rest [mm]."""
        with np.errstate(invalid="ignore"):
            return np.sqrt((self.prime_radius - self.offset) * (self.prime_radius + self.offset))

    def part(self, which: NDArray[Any] | slice) -> ManyTranslating:
        """The same of some of the cams."""
        return ManyTranslating(self.sigma[which], self.offset[which], self.prime_radius[which])

"""The quantities of many cams of which the greatest value is sought: what the followers' formulas say of arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from graphcam.given.laws import Floats
from graphcam.mechanism.kinematics import Kinematics, Values, pair_cross
from graphcam.sweeps.greatest import Numbers


@dataclass(frozen=True, eq=False)
class _OfManyCams:
    kin: Kinematics

    def part(self, which: Numbers | slice) -> Self:
        """The same of some of the cams."""
        return type(self)(self.kin.part(which))


class Steepness(_OfManyCams):
    """tan(alpha), which grows with the pressure angle."""

    signed: ClassVar[bool] = True

    def reading(self, values: Values) -> Floats:
        """tan(alpha)."""
        (along, across), _ = self.kin.pressure(values)
        return np.asarray(across / along)

    def slope(self, values: Values) -> Floats:
        """Of the sign of alpha'."""
        return pair_cross(*self.kin.pressure(values))


class Sharpness(_OfManyCams):
    """What is greatest where the radius of curvature is least: the curvature of the pitch curve, or -rho."""

    signed: ClassVar[bool] = False

    def reading(self, values: Values) -> Floats:
        """kappa [1/mm], or -rho [mm] of a flat face's cam."""
        return self.kin.sharpness(values)

    def slope(self, values: Values) -> Floats:
        """Of the sign of kappa'."""
        return self.kin.curvature_slope(values)

    def radius(self, sharpest: Floats) -> Floats:
        """The least convex radius [mm], inf where nothing is convex; under a flat face the least rho."""
        return self.kin.radius_of(sharpest)

"""The quantities of many cams of which the greatest value is sought: what the followers' formulas say of arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from graphcam.given.laws import Floats
from graphcam.mechanism.flat_faced import FlatFacedKinematics
from graphcam.mechanism.kinematics import Values, pair_cross
from graphcam.mechanism.oscillating import ManyOscillating
from graphcam.mechanism.translating import ManyTranslating
from graphcam.sweeps.greatest import Numbers

Many = ManyTranslating | ManyOscillating


@dataclass(frozen=True, eq=False)
class Steepness:
    """tan(alpha), which grows with the pressure angle."""

    kin: Many
    signed: ClassVar[bool] = True

    def part(self, which: Numbers | slice) -> Steepness:
        """The same of some of the cams."""
        return Steepness(self.kin.part(which))

    def reading(self, values: Values) -> Floats:
        """tan(alpha)."""
        (along, across), _ = self.kin.pressure(values)
        return np.asarray(across / along)

    def slope(self, values: Values) -> Floats:
        """Of the sign of alpha'."""
        return pair_cross(*self.kin.pressure(values))


@dataclass(frozen=True, eq=False)
class Sharpness:
    """The curvature of the pitch curve."""

    kin: Many
    signed: ClassVar[bool] = False

    def part(self, which: Numbers | slice) -> Sharpness:
        """The same of some of the cams."""
        return Sharpness(self.kin.part(which))

    def reading(self, values: Values) -> Floats:
        """kappa [1/mm]."""
        return self.kin.curvature(values)

    def slope(self, values: Values) -> Floats:
        """Of the sign of kappa'."""
        return self.kin.curvature_slope(values)

    def radius(self, sharpest: Floats) -> Floats:
        """The least convex radius [mm], inf where nothing is convex."""
        with np.errstate(divide="ignore"):
            return np.where(sharpest <= 0, np.inf, 1 / sharpest)


@dataclass(frozen=True, eq=False)
class FlatSharpness:
    """-rho of a flat face's cam."""

    kin: FlatFacedKinematics
    signed: ClassVar[bool] = False

    def part(self, which: Numbers | slice) -> FlatSharpness:
        """The same of some of the cams."""
        return FlatSharpness(FlatFacedKinematics(self.kin.sigma, np.asarray(self.kin.prime_radius)[which]))

    def reading(self, values: Values) -> Floats:
        """-rho [mm]."""
        return -self.kin.convex_radius(values)

    def slope(self, values: Values) -> Floats:
        """-rho'."""
        return self.kin.curvature_slope(values)

    def radius(self, sharpest: Floats) -> Floats:
        """The least rho [mm]."""
        return -sharpest

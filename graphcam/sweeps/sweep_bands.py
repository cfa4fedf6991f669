"""How far the displacement of many cams may be off as they are made, all to the same tolerances."""

from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.making_errors import MakingErrors, deviations_within
from graphcam.mechanism.kinematics import Kinematics, Values
from graphcam.mechanism.motion_bands import check_sizes, position_band, position_band_slope
from graphcam.sweeps.greatest import Numbers, Sought
from graphcam.words import say

BANDS = ("position_band",)


@dataclass(frozen=True)
class SweptErrors:
    """The tolerances to which all cams of a sweep are made, and the part of all mechanisms that a band holds.

    Raises
    ------
    DesignError : the part is not between 0 and 1
    """

    errors: MakingErrors
    coverage: float

    def __post_init__(self) -> None:
        _ = self.within

    @property
    def within(self) -> float:
        """How many standard deviations a band holds on either side."""
        return deviations_within(self.coverage)

    def check(self, kin: Kinematics, roller: Any) -> None:
        """Check that the followers have the sizes with a tolerance."""
        check_sizes(kin, self.errors)
        if self.errors.roller_diameter and not np.all(np.asarray(roller) > 0):
            limit = say("left out where a follower has a knife edge")
            remedy = say("or give every follower a roller_radius")
            raise DesignError("roller_diameter", self.errors.roller_diameter, limit, remedy)


@dataclass(frozen=True, eq=False)
class SoughtBand(Sought):
    """The half-width of the band of s [mm; rad of an arm], to the first order."""

    swept: SweptErrors

    def part(self, which: Numbers | slice) -> Self:
        """The band of some of the cams."""
        return type(self)(self.kin.part(which), self.swept)

    def reading(self, values: Values) -> Floats:
        """The half-width."""
        return position_band(self.kin, self.swept.errors, self.swept.within, values)

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """The half-width, and what has the sign of its derivative."""
        slope = position_band_slope(self.kin, self.swept.errors, self.swept.within, values)
        return self.reading(values), slope

"""The guide of a translating follower: two bearings above the roller, and their friction."""

import math
from dataclasses import dataclass

from graphcam.errors import DesignError


@dataclass(frozen=True)
class Guide:
    """Two bearings in which the stem of a translating follower slides.

    friction : mu, the coefficient of friction between stem and bearing
    overhang : b, from the roller's centre up to the nearer bearing with the follower at its lowest place [mm]
    length : l, from the nearer bearing to the farther one [mm]

    Raises
    ------
    DesignError : a value is negative or not finite, or the bearings are not apart

    >>> import graphcam as gc
    >>> gc.Guide(friction=0.1, overhang=40, length=80)
    Guide(friction=0.1, overhang=40, length=80)
    """

    friction: float
    overhang: float
    length: float

    def __post_init__(self) -> None:
        for quantity, unit in (("friction", ""), ("overhang", " mm")):
            value = getattr(self, quantity)
            if not (math.isfinite(value) and value >= 0):
                raise DesignError(quantity, value, f"a finite number of 0{unit} or more")
        if not (math.isfinite(self.length) and self.length > 0):
            raise DesignError("length", self.length, "a finite number greater than 0 mm")

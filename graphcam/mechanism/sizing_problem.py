"""What a cam may be, and what it must keep: the ranges of its sizes, its limits and its load."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Literal

from graphcam.errors import DesignError
from graphcam.given.follower import Rotation, Translating, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.spring_load import SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.contact import Contact
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.hertz import ContactStress
from graphcam.mechanism.sizing_limits import Bearing, Sizes, SizingLimits, TurnPlaces, margins
from graphcam.words import say

Range = tuple[float, float]
Measure = Literal["prime radius", "base radius"]
"""The size of a cam: the least radius of its pitch curve, or of its profile, which is less by the roller."""
BINDS = 1e-6
"""A limit binds, and a size stands at the end of its range, if they are this part of it apart."""


@dataclass(frozen=True)
class SizingProblem:
    """The ranges [mm] of a cam's sizes, its limits and its load; see :func:`~graphcam.size_cam`.

    radius : of what ``measure`` names
    """

    motion: Motion
    load: SpringLoad
    limits: SizingLimits
    radius: Range
    offset: Range
    roller_radius: Range
    face_width: Range
    rotation: Rotation
    measure: Measure = "prime radius"

    def __post_init__(self) -> None:
        sense(self.rotation)
        for name, (low, high) in self.ranges.items():
            positive = name == "offset" or low > 0
            if not (math.isfinite(low) and math.isfinite(high) and low <= high and positive):
                found = say("{low:g} to {high:g} mm", low=low, high=high)
                limit = say("from a size to one that is not smaller")
                raise DesignError(say("range of the {name}", name=name), found, limit)
        least = self.radius[0] + self._between(self.roller_radius[0])
        roller = 0.0 if self.measure == "base radius" else self.roller_radius[1]
        for quantity, most in (("offset", max(map(abs, self.offset))), (say("roller radius"), roller)):
            if not most < least:
                limit = say("less than the minimum prime radius of {least:g} mm", least=least)
                found, remedy = say("up to {most:g} mm", most=most), say("no such cam could be made")
                raise DesignError(say("range of the {quantity}", quantity=quantity), found, limit, remedy)

    @property
    def ranges(self) -> dict[str, Range]:
        """The ranges by the names of the sizes, in the order of the search."""
        widths = self.roller_radius, self.face_width
        return {
            self.measure: self.radius,
            "offset": self.offset,
            **dict(zip(("roller radius", "face width"), widths, strict=True)),
        }

    def check_contact(self) -> None:
        """Check that the load keeps the follower on its cam.

        Raises
        ------
        DesignError : it does not
        """
        least = Contact(self.motion, self.load).least_force()
        if least.value < -BINDS * abs(self.load.preload):
            limit = say("0 N or more, so that the follower stays on its cam")
            remedy = say("preload the spring: spring_preload(...) tells the minimum")
            raise DesignError(say("minimum contact force"), say("{value:.4g} N", value=least.value), limit, remedy)

    def sizes(self, radius: Any, offset: Any, roller: Any, width: Any) -> Sizes:
        """The sizes with a radius [mm] of what is measured."""
        return Sizes(radius + self._between(roller), offset, roller, width)

    def values(self, sizes: Sizes) -> tuple[float, float, float, float]:
        """The sizes in the order of the ranges."""
        return sizes.radius - self._between(sizes.roller), sizes.offset, sizes.roller, sizes.width

    def _between(self, roller: Any) -> Any:
        """The prime radius less what is measured [mm]."""
        return roller if self.measure == "base radius" else 0.0

    def stress(self, sizes: Sizes) -> ContactStress:
        """The contact stress of the exact cam."""
        cam = Cam(self.motion, Translating(sizes.offset, sizes.roller), sizes.radius, self.rotation)
        forces = CamForces(cam, self.load, friction=self.limits.friction)
        return ContactStress(forces, replace(self.limits.contact, width=sizes.width))

    def margins(self, places: TurnPlaces, sizes: Sizes) -> dict[str, Floats]:
        """What is left of every limit at places."""
        return margins(self.limits, places, sizes, sense(self.rotation))

    def needed_width(self, places: TurnPlaces, sizes: Sizes) -> Floats:
        """The face width [mm] that bears the load at places; infinite where none does."""
        return Bearing.of(self.limits, places, sizes, sense(self.rotation)).width

    def exact_margins(self, sizes: Sizes) -> dict[str, float]:
        """What is left of every limit, from the exact extremes."""
        left = self.margins(TurnPlaces.worst(self.stress(sizes)), sizes)
        return {name: float(margin.min()) for name, margin in left.items()}

    def exact_width(self, sizes: Sizes) -> float:
        """The least face width [mm] of the exact cam, its greatest stress being the permitted one then."""
        return float(self.needed_width(TurnPlaces.worst(self.stress(sizes)), sizes).max())

    def keeps(self, sizes: Sizes, slack: float = BINDS) -> bool:
        """Whether the exact cam keeps all limits, but for a part of them."""
        return min(self.exact_margins(sizes).values()) >= -slack

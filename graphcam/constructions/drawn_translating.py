"""The translating follower on the drawing board: knife edge or roller, central or offset."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.board import DrawnFollower
from graphcam.constructions.force_plan import force_plan
from graphcam.constructions.guided_stem import guided_stem
from graphcam.constructions.inversion import inversion
from graphcam.constructions.minimum_radius import least_radius
from graphcam.constructions.pressure_angle import pressure_angle
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import showing
from graphcam.drafting.ink import Construction
from graphcam.drafting.marks import Mark, Role
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import Rotation, Translating
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits
from graphcam.given.spring_load import SpringLoad

STEM, GUIDE = 30.0, 9.0
"""In the scheme: length of the stem, and height of its guide above the roller [mm]."""


@dataclass(frozen=True)
class DrawnTranslating(DrawnFollower):
    """A translating follower; ``place`` is its offset [mm, machine sign], None where it is to be found."""

    place: float | None

    @property
    def conditions(self) -> dict[str, float | None]:
        """The exact least radius is asked for at the offset, if it is given."""
        return {"offset": self.place}

    def least_radius(
        self, integrated: Construction, rotation: Rotation, limits: Limits, place: float | None, pencil: Pencil
    ) -> Construction:
        """From the combined diagram."""
        return least_radius(integrated, rotation, limits, place, pencil)

    def pressure_angle(
        self, integrated: Construction, rotation: Rotation, prime_radius: float, place: float, pencil: Pencil
    ) -> Construction:
        """From the velocity plan."""
        return pressure_angle(integrated, rotation, prime_radius, place, pencil)

    def inversion(
        self, integrated: Construction, rotation: Rotation, r0: float, place: float, mu_l: Scale, pencil: Pencil
    ) -> Construction:
        """On tangents of the offset circle."""
        return inversion(integrated, rotation, r0, place, mu_l, pencil)

    def force_plan(self, drawn: Mapping[str, Construction], load: SpringLoad, pencil: Pencil) -> Construction:
        """At the station of the velocity plan."""
        return force_plan(drawn["pressure_angle"], load, pencil)

    def places(self, region: Construction, prime_radius: float) -> Floats:
        """All offsets at which the line of motion cuts the prime circle: a larger radius keeps the limits at each."""
        return np.array([[-prime_radius, prime_radius]])

    def must_exceed(self, place: float) -> float:
        """The follower's line must cross the prime circle."""
        return abs(place)

    def reach(self, prime_radius: float, place: float, lift: float, roller_radius: float) -> float:
        """The pitch curve's greatest radius, and a roller on it."""
        return prime_radius + lift + roller_radius

    def built(self, place: float | None, roller_radius: float) -> Translating:
        """The follower with these sizes; an open offset is 0 in it."""
        return Translating(place or 0.0, roller_radius)

    def scheme(self, inverted: Construction, roller_radius: float, scale: Scale) -> tuple[Mark, ...]:
        """Roller, stem and guide."""
        integrated, hand = inverted.givens.integrated, showing(inverted)
        # The sketch shows the cam as it was adopted, so its follower stands at the given offset.
        foot = hand.lay_off("foot", hand.given("A"), RIGHT, inverted.givens.offset / scale.per_mm)
        prime = hand.circle("prime circle", hand.given("A"), inverted.givens.prime_radius / scale.per_mm)
        start = hand.cross("start of the lift", hand.erect("line of motion", foot), prime)
        b = hand.lay_off("B", start, UP, integrated.givens.motion.levels[0] / scale.per_mm)
        tail = hand.lay_off("tail", hand.lay_off("beside the stem", b, RIGHT, 4.0), UP, STEM + 1)
        return (
            hand.circle("roller", b, roller_radius / scale.per_mm).drawn_circle(Role.CURVE),
            *guided_stem(hand, b, STEM, GUIDE),
            b.dots(),
            hand.lay_off("head", tail, UP, 8.0).arrow(tail, Role.CURVE),
        )

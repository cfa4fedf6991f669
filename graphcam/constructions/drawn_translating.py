"""The translating follower on the drawing board: knife edge or roller, central or offset."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.curvature import curvature
from graphcam.constructions.inversion import inversion
from graphcam.constructions.minimum_radius import least_radius
from graphcam.constructions.pressure_angle import pressure_angle
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Construction
from graphcam.drafting.marks import Arrow, Circle, Dots, Label, Line, Mark, Role, Segments
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import Rotation, Translating, sense
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits

STEM, GUIDE, WALL = 30.0, 9.0, 2.2
"""In the scheme: length of the stem, height of its guide above the roller, and half the guide's width [mm]."""


@dataclass(frozen=True)
class DrawnTranslating:
    """A translating follower; ``place`` is its offset [mm, machine sign], None where it is to be found."""

    place: float | None
    place_name = "offset"
    unit = "mm"
    divides_at_corners = False
    constructions = (
        "acceleration", "integration", "minimum_radius", "pressure_angle", "angle_diagram", "inversion", "curvature",
        "roller", "working_profile", "scheme",
    )  # fmt: skip

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
        self,
        integrated: Construction,
        rotation: Rotation,
        prime_radius: float,
        place: float,
        mu_l: Scale,
        pencil: Pencil,
    ) -> Construction:
        """On tangents of the offset circle."""
        return inversion(integrated, rotation, prime_radius, place, mu_l, pencil)

    def curvature(self, drawn: Mapping[str, Construction], pencil: Pencil) -> Construction:
        """By three points."""
        return curvature(drawn["inversion"], pencil)

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
        integrated, mu_l = inverted.givens["integrated"], inverted.givens["mu_l"]
        stations, motion = integrated.givens["stations"], integrated.givens["motion"]
        # Turned back by the station's cam angle, the foot of the first station lies level with the cam centre.
        back = np.exp(1j * sense(inverted.givens["rotation"]) * stations.phi[0])
        foot = complex(inverted.first("feet")[0] * back) * mu_l.per_mm / scale.per_mm
        radius, start = inverted.givens["prime_radius"] / scale.per_mm, motion.levels[0] / scale.per_mm
        b = foot.real + UP * (np.sqrt(radius**2 - foot.real**2) + start)
        ends = b + np.array([GUIDE, GUIDE + 8.0]) * UP
        ticks = np.linspace(0, 8.0, 5)[:-1]
        walls = (-WALL, WALL)
        return (
            Circle(b, roller_radius / scale.per_mm, Role.CURVE),
            Line(np.array([b, b + STEM * UP]), Role.CURVE),
            Line(np.array([complex(b.real, -6.0), b + (STEM + 5) * UP]), Role.AXIS),
            *(Line(ends + wall, Role.CURVE) for wall in walls),
            *(Segments(ends[0] + w + ticks * UP, ends[0] + w * 1.9 + (ticks + 1.6) * UP, Role.HATCH) for w in walls),
            Label(b, "B", towards=1 + 1j),
            Dots(np.array([b])),
            Arrow(b + (STEM + 1) * UP + 4, b + (STEM + 9) * UP + 4, Role.CURVE),
        )

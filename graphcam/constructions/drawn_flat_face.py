"""The flat-faced follower on the drawing board."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.flat_inversion import flat_inversion
from graphcam.constructions.flat_minimum_radius import flat_curvature, flat_least_radius
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Construction
from graphcam.drafting.marks import Label, Line, Mark, Role, Segments
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import FlatFaced, Rotation
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits

STEM, GUIDE, WALL = 34.0, 12.0, 2.2
"""In the scheme: length of the stem, height of its guide above the face, and half the guide's width [mm]."""


@dataclass(frozen=True)
class DrawnFlatFaced:
    """A face perpendicular to its motion; ``least_curvature`` is the least permitted radius of the profile [mm]."""

    least_curvature: float
    place: float | None = 0.0
    place_name = "offset"
    unit = "mm"
    divides_at_corners = True
    constructions = (
        "acceleration", "integration", "minimum_radius", "inversion", "curvature", "working_profile", "scheme",
    )  # fmt: skip

    @property
    def conditions(self) -> dict[str, float | None]:
        """What the exact least radius is asked for."""
        return {"curvature": self.least_curvature}

    def least_radius(
        self, integrated: Construction, rotation: Rotation, limits: Limits, place: float | None, pencil: Pencil
    ) -> Construction:
        """From the displacement over the acceleration; a pressure angle there is none."""
        return flat_least_radius(integrated, self.least_curvature, pencil)

    def pressure_angle(
        self, integrated: Construction, rotation: Rotation, prime_radius: float, place: float, pencil: Pencil
    ) -> Construction:
        """Never drawn: the normal of the face is the direction of its motion."""
        raise NotImplementedError

    def inversion(
        self,
        integrated: Construction,
        rotation: Rotation,
        prime_radius: float,
        place: float,
        mu_l: Scale,
        pencil: Pencil,
    ) -> Construction:
        """As the envelope of perpendiculars."""
        return flat_inversion(integrated, rotation, prime_radius, mu_l, pencil)

    def curvature(self, drawn: Mapping[str, Construction], pencil: Pencil) -> Construction:
        """From the displacement over the acceleration."""
        return flat_curvature(drawn["minimum_radius"], drawn["inversion"].givens["prime_radius"], pencil)

    def places(self, region: Construction, prime_radius: float) -> Floats:
        """The face is symmetrical about its stem."""
        return np.zeros((1, 2))

    def must_exceed(self, place: float) -> float:
        """Any prime radius closes the mechanism."""
        return 0.0

    def reach(self, prime_radius: float, place: float, lift: float, roller_radius: float) -> float:
        """The profile reaches a little beyond the highest position of the face, where it is touched aside."""
        return 1.2 * (prime_radius + lift)

    def built(self, place: float | None, roller_radius: float) -> FlatFaced:
        """The follower, which has no sizes."""
        return FlatFaced()

    def scheme(self, inverted: Construction, roller_radius: float, scale: Scale) -> tuple[Mark, ...]:
        """Face, stem and guide."""
        motion = inverted.givens["integrated"].givens["motion"]
        width = max(float(inverted.value("face_left")), float(inverted.value("face_right"))) / scale.per_mm + 2
        b = (inverted.givens["prime_radius"] + motion.levels[0]) / scale.per_mm * UP
        ends = b + np.array([GUIDE, GUIDE + 8.0]) * UP
        ticks = np.linspace(0, 8.0, 5)[:-1]
        walls = (-WALL, WALL)
        return (
            Line(np.array([b - width, b + width]), Role.CURVE),
            Line(np.array([b, b + STEM * UP]), Role.CURVE),
            Line(np.array([-6.0 * UP, b + (STEM + 5) * UP]), Role.AXIS),
            *(Line(ends + wall, Role.CURVE) for wall in walls),
            *(Segments(ends[0] + w + ticks * UP, ends[0] + w * 1.9 + (ticks + 1.6) * UP, Role.HATCH) for w in walls),
            Label(b, "B", towards=1 + 1j),
        )

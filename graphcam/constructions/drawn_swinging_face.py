"""The oscillating flat-faced follower on the drawing board."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from graphcam.constructions.axes import sense_caption
from graphcam.constructions.board import TURN_SAMPLES, DrawnFollower, FollowerSize
from graphcam.constructions.curvature import curvature
from graphcam.constructions.kinematic_sketch import (
    BASE_RADIUS,
    bearing,
    link,
    plain_cam,
    size,
)
from graphcam.constructions.swinging_face_inversion import swinging_face_inversion
from graphcam.constructions.swinging_face_radius import swinging_face_least_radius
from graphcam.drafting.euclid import unit
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.drafting.marks import Arc, Label, Line, Mark, Points, Role
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import Limits, OscillatingFlat, Rotation, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Motion

SKETCH_PIVOT, SKETCH_OFFSET, SKETCH_FACE, SKETCH_SWING = 44 + 0j, 4.0, 58.0, 0.16
"""The sizes of the kinematic diagram: the pivot, an offset, how far the face reaches [mm], and its swing [rad]."""


@dataclass(frozen=True)
class DrawnOscillatingFlat(DrawnFollower):
    """A face [mm] on a pivot; ``place`` is its distance from the cam centre.

    face_offset : of the face from the line through the pivot, towards the cam centre [mm]
    least_curvature : the least permitted radius of the profile [mm];  mu_l : scale of the positions [mm/mm]
    """

    place: float | None
    face_offset: float
    least_curvature: float
    mu_l: Scale
    place_name = "distance"
    place_title = say("distance")
    unit = OscillatingFlat.lift_unit
    divides_at_corners = True
    constructions = (
        *("scheme", "acceleration", "integration", "minimum_radius"),
        *("inversion", "curvature", "working_profile"),
    )

    @property
    def distance(self) -> float:
        """The centre distance [mm], which is always given."""
        assert self.place is not None
        return self.place

    @property
    def conditions(self) -> dict[str, float | None]:
        """The condition of the exact minimum radius: the permitted radius of curvature."""
        return {"curvature": self.least_curvature}

    def sizes(self, place: float | None, roller_radius: float | None) -> list[FollowerSize]:
        """The centre distance and the offset of the face; there is no roller."""
        distance, roller = super().sizes(place, None)
        return [distance, FollowerSize("face_offset", say("face offset"), self.face_offset), roller]

    def with_positions_at(self, scale: float) -> Self:
        """The follower with the positions of its face at that scale [mm/mm]."""
        return replace(self, mu_l=Scale(scale, "mm"))

    def least_radius(
        self, integrated: Construction, rotation: Rotation, limits: Limits, place: float | None, pencil: Pencil
    ) -> Construction:
        """The minimum prime radius, from the limit lines of the cam centre."""
        given = self.least_curvature, self.distance, self.face_offset
        return swinging_face_least_radius(integrated, rotation, *given, self.mu_l, pencil)

    def inversion(
        self, integrated: Construction, rotation: Rotation, r0: float, place: float, mu_l: Scale, pencil: Pencil
    ) -> Construction:
        """The profile, as the envelope of the face's positions."""
        return swinging_face_inversion(integrated, rotation, r0, place, self.face_offset, mu_l, pencil)

    def curvature(self, drawn: Mapping[str, Construction], pencil: Pencil) -> Construction:
        """The minimum radius of curvature of the profile, by three points."""
        return curvature(drawn["inversion"], pencil, profile=True)

    def places(self, region: Construction, prime_radius: float) -> Floats:
        """The one distance that is given."""
        return np.full((1, 2), self.distance)

    def must_exceed(self, place: float) -> float:
        """The bound [mm] above which the line through the pivot passes the cam centre on the right side."""
        return max(-self.face_offset, 0.0)

    def reach(
        self, prime_radius: float, place: float, motion: Motion, roller_radius: float, rotation: Rotation
    ) -> float:
        """The radius [mm] of the pivot circle, or the farthest contact where the face is longer."""
        s, v, _, _ = motion(np.linspace(0.0, FULL_TURN, TURN_SAMPLES))
        angle, turned = np.arcsin((prime_radius + self.face_offset) / place) + s, sense(rotation) * v
        # The contact is the foot on the face of the pole, which lies on the line of centres.
        along = turned / (1 + turned) * np.cos(angle)
        return max(place, float(np.hypot(place * np.sin(angle) - self.face_offset, place * along).max()))

    def built(self, place: float | None, roller_radius: float) -> OscillatingFlat:
        """The oscillating flat face with these sizes."""
        return OscillatingFlat(self.distance if place is None else place, self.face_offset)

    def scheme(self, rotation: Rotation, roller_radius: float | None) -> tuple[Mark, ...]:
        """The kinematic diagram: cam, face, pivot, and the offset of the face."""
        pivot, f = SKETCH_PIVOT, SKETCH_OFFSET * np.sign(self.face_offset)
        angle = np.arcsin((BASE_RADIUS + f) / pivot.real)
        along, normal = -np.exp(-1j * angle), 1j * np.exp(-1j * angle)
        foot = pivot - f * normal
        face: Points = foot + along * np.array([0.0, SKETCH_FACE])
        touch = complex(BASE_RADIUS * normal)
        swing = np.angle(along) - np.array([1.5, 0.5]) * SKETCH_SWING
        arm = [] if not f else [Line(np.array([pivot, foot]), Role.CURVE)]
        offset = [Label((pivot + foot) / 2, size("f", self.face_offset), complex(unit(-along)))] if f else []
        return (
            *plain_cam(touch, sense(rotation)),
            *bearing(pivot, "C"),
            *link("2", complex(face[1]), complex(normal)),
            *(*arm, Line(face, Role.CURVE), Label(touch, "B", complex(normal)), *offset),
            Line(np.array([0j, pivot]), Role.AXIS),
            Arc(pivot, SKETCH_FACE, float(swing[0]), float(swing[1]), Role.CURVE, arrow="start"),
            Label(0.7 * pivot, size("c", self.place), -1j),
        )

    def assignment(self, roller: bool) -> Caption:
        """The sentence that asks for a cam for an oscillating flat face."""
        return say("A disk cam is to move an oscillating flat-faced follower by the following motion.")

    def described(self, rotation: Rotation, roller_radius: float | None) -> list[Caption]:
        """Sentences on the face, its pivot and its offset."""
        cam = say("The cam turns {rotation} about A and swings a flat face about the pivot C; it touches the cam in B.")
        offset = say("The face lies f = {offset:g} mm from the line through C, {side}.").with_values(
            offset=abs(self.face_offset),
            side=say("on the side of A") if self.face_offset > 0 else say("on the side away from A"),
        )
        return [
            cam.with_values(rotation=sense_caption(rotation)),
            say("The pivot is c = {place:g} mm from A.", place=self.distance),
            *([offset] if self.face_offset else []),
        ]

    def limited(self, limits: Limits) -> Caption:
        """A sentence on the permitted radius of curvature, which limits this cam."""
        least = self.least_curvature
        return say("The profile is to have a radius of curvature of at least {least:g} mm.", least=least)

"""The flat-faced follower on the drawing board."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.axes import sense_caption
from graphcam.constructions.board import TURN_SAMPLES, DrawnFollower, FollowerSize, Values
from graphcam.constructions.cam_analysis import AnalysisGivens
from graphcam.constructions.face_analysis import face_analysis
from graphcam.constructions.flat_inversion import flat_inversion
from graphcam.constructions.flat_minimum_radius import flat_curvature, flat_least_radius
from graphcam.constructions.kinematic_sketch import BASE_RADIUS, guided_stem, plain_cam
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.drafting.marks import Label, Line, Mark, Role
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import FlatFaced, Limits, Rotation, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Motion

STEM_LENGTH, GUIDE_HEIGHT, FACE_HALF_LENGTH = 34.0, 12.0, 17.0
"""The sizes of the kinematic diagram: stem, height of its guide above the face, and half the face [mm]."""
FLAT_FACE_CAPTION = say(
    "The cam turns {rotation} about A and moves a flat-faced follower; its line of motion meets the face in B."
)


@dataclass(frozen=True)
class DrawnFlatFaced(DrawnFollower):
    """A face perpendicular to its motion; ``least_curvature`` is the least permitted radius of the profile [mm]."""

    least_curvature: float
    place: float | None = 0.0
    divides_at_corners = True
    constructions = (
        *("scheme", "acceleration", "integration", "minimum_radius"),
        *("inversion", "curvature", "working_profile"),
    )

    @property
    def conditions(self) -> dict[str, float | None]:
        """The condition of the exact minimum radius: the permitted radius of curvature."""
        return {"curvature": self.least_curvature}

    def sizes(self, place: float | None, roller_radius: float | None) -> list[FollowerSize]:
        """The sizes of all followers, of which none applies."""
        return super().sizes(None, None)

    def least_radius(
        self, integrated: Construction, rotation: Rotation, limits: Limits, place: float | None, pencil: Pencil
    ) -> Construction:
        """The minimum prime radius, from the displacement over the acceleration."""
        return flat_least_radius(integrated, self.least_curvature, pencil)

    def inversion(
        self, integrated: Construction, rotation: Rotation, r0: float, place: float, mu_l: Scale, pencil: Pencil
    ) -> Construction:
        """The profile, as the envelope of the face's positions."""
        return flat_inversion(integrated, rotation, r0, mu_l, pencil)

    def analysis(self, givens: AnalysisGivens, pencil: Pencil) -> Construction:
        """The displacements by the face, brought to the outline square to every ray."""
        return face_analysis(givens, pencil)

    def curvature(self, drawn: Mapping[str, Construction], pencil: Pencil) -> Construction:
        """The minimum radius of curvature, from the displacement over the acceleration."""
        return flat_curvature(drawn["minimum_radius"], drawn["inversion"].givens.prime_radius, pencil)

    def places(self, region: Construction, prime_radius: float) -> Floats:
        """The one place 0, as the face is symmetrical about its stem."""
        return np.zeros((1, 2))

    def must_exceed(self, place: float) -> float:
        """The bound 0: any prime radius closes the mechanism."""
        return 0.0

    def reach(
        self, prime_radius: float, place: float, motion: Motion, roller_radius: float, rotation: Rotation
    ) -> float:
        """The reach [mm], a little beyond the highest position of the face or the farthest contact point."""
        s, v, _, _ = motion(np.linspace(0.0, FULL_TURN, TURN_SAMPLES))
        return max(1.2 * (prime_radius + motion.lift), float(np.hypot(prime_radius + s, v).max()))

    def extent(self, values: Values, limits: Limits, rotation: Rotation, prime_radius: float | None) -> complex:
        """The width + i height of the displacement over the acceleration, with the prime radius below it."""
        s, _, a = values
        radius = max(self.least_curvature + max(-float((s + a).min()), 0.0), prime_radius or 0.0)
        return complex(float(np.ptp(a)), float(s.max()) + radius)

    def built(self, place: float | None, roller_radius: float) -> FlatFaced:
        """The flat-faced follower, which has no sizes."""
        return FlatFaced()

    def scheme(self, rotation: Rotation, roller_radius: float | None) -> tuple[Mark, ...]:
        """The kinematic diagram: cam, face, stem and guide."""
        b = BASE_RADIUS * UP
        face = Line(b + np.array([-FACE_HALF_LENGTH, FACE_HALF_LENGTH]), Role.CURVE)
        return *plain_cam(b, sense(rotation)), face, Label(b, "B"), *guided_stem(b, STEM_LENGTH, GUIDE_HEIGHT)

    def assignment(self, roller: bool) -> Caption:
        """The sentence that asks for a cam for a flat face."""
        return say("A disk cam is to move a flat-faced follower by the following motion.")

    def described(self, rotation: Rotation, roller_radius: float | None) -> list[Caption]:
        """A sentence on the face."""
        return [FLAT_FACE_CAPTION.with_values(rotation=sense_caption(rotation))]

    def limited(self, limits: Limits) -> Caption:
        """A sentence on the permitted radius of curvature, for under a face there is no pressure angle."""
        least = self.least_curvature
        return say("The profile is to have a radius of curvature of at least {least:g} mm.", least=least)

"""The oscillating follower on the drawing board: an arm with a knife edge or a roller."""

import cmath
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from graphcam.constructions.arm_analysis import arm_analysis
from graphcam.constructions.arm_force_plan import arm_force_plan
from graphcam.constructions.arm_inversion import arm_inversion
from graphcam.constructions.arm_limit_lines import ARM_OVERHANG_FACTOR
from graphcam.constructions.arm_minimum_radius import arm_least_radius, permitted_distances
from graphcam.constructions.arm_positions import cam_centre
from graphcam.constructions.arm_pressure_angle import arm_pressure_angle
from graphcam.constructions.axes import sense_caption
from graphcam.constructions.board import DrawnFollower, FollowerLoads, FollowerSize, Values, roller_sentences
from graphcam.constructions.cam_analysis import AnalysisGivens
from graphcam.constructions.kinematic_sketch import bearing, edge, link, low_point, plain_cam, size
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.drafting.marks import Arc, Label, Line, Mark, Points, Role
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import Limits, Oscillating, Rotation, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.spring_load import ArmLoad

MAX_ARM_ON_PAPER = 130.0
"""The arm positions are usually drawn at the largest standard scale at which the arm is not longer [mm]."""
START_OVERHANG = 0.3
"""So much is drawn beyond B₀ where the arm is not produced, in lengths of the arm."""
SKETCH_PIVOT, SKETCH_ARM_OFFSET, SKETCH_SWING = 42 + 0j, 2.0, 0.2
"""The sizes of the kinematic diagram: the pivot, B beside A [mm], and how far the arm is seen to swing [rad]."""
ROLLER_CAPTION = say(
    "The cam turns {rotation} about A and swings an arm about the pivot C; the roller on it turns about B."
)
KNIFE_EDGE_CAPTION = say(
    "The cam turns {rotation} about A and swings an arm about the pivot C; the knife edge on it is B."
)


@dataclass(frozen=True)
class DrawnOscillating(DrawnFollower):
    """An arm [mm]; ``place`` is its pivot's distance from the cam centre [mm], None where it is to be found.

    mu_l : scale of the arm positions [mm/mm]
    """

    arm: float
    place: float | None
    mu_l: Scale
    place_name = "distance"
    place_title = say("distance")
    unit = Oscillating.lift_unit

    def sizes(self, place: float | None, roller_radius: float | None) -> list[FollowerSize]:
        """The arm's length, and the sizes of all followers."""
        return [FollowerSize("arm", say("arm"), self.arm), *super().sizes(place, roller_radius)]

    def with_positions_at(self, scale: float) -> Self:
        """The follower with the arm positions at that scale [mm/mm]."""
        return replace(self, mu_l=Scale(scale, "mm"))

    def least_radius(
        self, integrated: Construction, rotation: Rotation, limits: Limits, place: float | None, pencil: Pencil
    ) -> Construction:
        """The minimum prime radius and the distance of the pivot, from the arm positions."""
        return arm_least_radius(integrated, rotation, limits, self.arm, place, self.mu_l, pencil)

    def pressure_angle(
        self, integrated: Construction, rotation: Rotation, prime_radius: float, place: float, pencil: Pencil
    ) -> Construction:
        """The pressure angles, from the velocity plan and along the arm."""
        return arm_pressure_angle(integrated, rotation, prime_radius, self.arm, place, self.mu_l, pencil)

    def inversion(
        self, integrated: Construction, rotation: Rotation, r0: float, place: float, mu_l: Scale, pencil: Pencil
    ) -> Construction:
        """The pitch curve, from the pivots on their circle."""
        return arm_inversion(integrated, rotation, r0, self.arm, place, mu_l, pencil)

    def analysis(self, givens: AnalysisGivens, pencil: Pencil) -> Construction:
        """The angles of the arm, by its arcs about the inverted pivots."""
        return arm_analysis(givens, self.arm, pencil)

    def force_plan(
        self, drawn: Mapping[str, Construction], load: FollowerLoads, pencil: Pencil, friction: float = 0.0
    ) -> Construction | None:
        """The force plan without friction; None with it, as it acts at the rim of a roller beside the pin."""
        assert isinstance(load, ArmLoad)
        return None if friction else arm_force_plan(drawn["pressure_angle"], load, pencil)

    def places(self, region: Construction, prime_radius: float) -> Floats:
        """The pivot distances (k, 2) [mm] at which no line of the region cuts the cam centre off."""
        return permitted_distances(region, prime_radius)

    def must_exceed(self, place: float) -> float:
        """The bound [mm] above which the arm reaches the prime circle from its pivot."""
        return abs(place - self.arm)

    def reach(
        self, prime_radius: float, place: float, motion: Motion, roller_radius: float, rotation: Rotation
    ) -> float:
        """The radius [mm] of the pivot circle, or of the pitch curve with a roller on it where that is larger."""
        return max(place, prime_radius + self.arm * motion.lift + roller_radius)

    def built(self, place: float | None, roller_radius: float) -> Oscillating:
        """The oscillating follower with these sizes."""
        return Oscillating(self.arm, place, roller_radius)

    def scheme(self, rotation: Rotation, roller_radius: float | None) -> tuple[Mark, ...]:
        """The kinematic diagram: cam, roller, arm and pivot."""
        b = low_point(SKETCH_ARM_OFFSET, roller_radius)
        arm = b - SKETCH_PIVOT
        swing = cmath.phase(arm) - np.array([1.5 * SKETCH_SWING, 0.5 * SKETCH_SWING])
        return (
            *plain_cam(b, sense(rotation)),
            *edge(b, roller_radius, 1j - 1),
            *bearing(SKETCH_PIVOT, "C"),
            Line(np.array([b, SKETCH_PIVOT]), Role.CURVE),
            *link("2", (b + 3 * SKETCH_PIVOT) / 4, 1j * -arm),
            Line(np.array([0j, SKETCH_PIVOT]), Role.AXIS),
            Arc(SKETCH_PIVOT, abs(arm), swing[0], swing[1], Role.CURVE, arrow="start"),
            Label((b + SKETCH_PIVOT) / 2, size("l", self.arm), 1j * -arm),
            Label(0.7 * SKETCH_PIVOT, size("c", self.place), -1j),
        )

    def assignment(self, roller: bool) -> Caption:
        """The sentence that asks for a cam for an arm."""
        if roller:
            return say("A disk cam is to move an oscillating follower with a roller by the following motion.")
        return say("A disk cam is to move an oscillating follower with a knife edge by the following motion.")

    def described(self, rotation: Rotation, roller_radius: float | None) -> list[Caption]:
        """Sentences on the arm, the pivot and the roller."""
        return [
            (KNIFE_EDGE_CAPTION if roller_radius == 0 else ROLLER_CAPTION).with_values(
                rotation=sense_caption(rotation)
            ),
            say("The arm is l = {arm:g} mm long.", arm=self.arm),
            *([] if self.place is None else [say("The pivot is c = {place:g} mm from A.", place=self.place)]),
            *roller_sentences(roller_radius),
        ]


def positions_extent(
    arm: float, values: Values, rotation: Rotation, limits: Limits, centres: Iterable[tuple[float, float]]
) -> complex:
    """The approximate width + i height [mm] of the positions of an arm [mm].

    values : over the turn;  centres : prime radii and distances of the cam centres that are found in them [mm]
    """
    s, v, _ = values
    tips = -arm * (1 + sense(rotation) * v) * np.exp(-1j * s)
    # The arm produced lies beyond B₀, the region below the ends.
    beyond = -arm * (1 + (START_OVERHANG if limits.rest else ARM_OVERHANG_FACTOR))
    found = [cam_centre(arm, distance, radius, flat=True) for radius, distance in centres]
    # The lines of the limits go through the highest cam centre on as far down as the lowest, the adopted one, may lie.
    low = min((centre.imag for centre in found), default=0.0)
    slopes = sense(rotation) * math.tan(limits.rise), -sense(rotation) * math.tan(limits.return_ or 0.0)
    ends = [centre + (centre.imag - low) * (slope - 1j) for centre in found for slope in slopes]
    places: Points = np.array([0j, *tips.tolist(), beyond, *found, *ends])
    return complex(float(np.ptp(places.real)), float(np.ptp(places.imag)))

"""The oscillating follower on the drawing board: an arm with a knife edge or a roller."""

from dataclasses import dataclass

import numpy as np

from graphcam.constructions.arm_inversion import arm_inversion
from graphcam.constructions.arm_minimum_radius import arm_least_radius, permitted_distances
from graphcam.constructions.arm_pressure_angle import arm_pressure_angle
from graphcam.constructions.board import DrawnFollower, FollowerSize
from graphcam.drafting.hand import between, showing
from graphcam.drafting.ink import Construction, say
from graphcam.drafting.marks import Mark, Role
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, standard_scale
from graphcam.given.follower import Oscillating, Rotation, sense
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits

ARM_ON_PAPER = 130.0
"""The arm positions are usually drawn at the largest standard scale at which the arm is not longer [mm]."""


@dataclass(frozen=True)
class DrawnOscillating(DrawnFollower):
    """An arm [mm]; ``place`` is its pivot's distance from the cam centre [mm], None where it is to be found.

    on_paper : the arm positions are drawn at the largest standard scale at which the arm is not longer [mm of paper]
    """

    arm: float
    place: float | None
    on_paper: float = ARM_ON_PAPER
    place_name = "distance"
    place_title = say("distance")
    unit = Oscillating.lift_unit

    def sizes(self, place: float | None, roller_radius: float | None) -> list[FollowerSize]:
        """The arm's own length, and those of all followers."""
        return [FollowerSize("arm", say("arm"), self.arm), *super().sizes(place, roller_radius)]

    def least_radius(
        self, integrated: Construction, rotation: Rotation, limits: Limits, place: float | None, pencil: Pencil
    ) -> Construction:
        """From the arm positions."""
        return arm_least_radius(integrated, rotation, limits, self.arm, place, self._mu_l, pencil)

    def pressure_angle(
        self, integrated: Construction, rotation: Rotation, prime_radius: float, place: float, pencil: Pencil
    ) -> Construction:
        """From the velocity plan, along the arm."""
        return arm_pressure_angle(integrated, rotation, prime_radius, self.arm, place, self._mu_l, pencil)

    @property
    def _mu_l(self) -> Scale:
        """The scale of the arm positions."""
        return standard_scale(self.arm, self.on_paper)

    def inversion(
        self, integrated: Construction, rotation: Rotation, r0: float, place: float, mu_l: Scale, pencil: Pencil
    ) -> Construction:
        """About the pivots on their circle."""
        return arm_inversion(integrated, rotation, r0, self.arm, place, mu_l, pencil)

    def places(self, region: Construction, prime_radius: float) -> Floats:
        """The distances at which no line of the region cuts the cam centre off."""
        return permitted_distances(region, prime_radius)

    def must_exceed(self, place: float) -> float:
        """The arm must reach the prime circle from its pivot."""
        return abs(place - self.arm)

    def reach(self, prime_radius: float, place: float, lift: float, roller_radius: float) -> float:
        """The pivot circle, or the pitch curve with a roller on it where that is larger."""
        return max(place, prime_radius + self.arm * lift + roller_radius)

    def built(self, place: float | None, roller_radius: float) -> Oscillating:
        """The follower with these sizes."""
        return Oscillating(self.arm, place, roller_radius)

    def scheme(self, inverted: Construction, roller_radius: float, scale: Scale) -> tuple[Mark, ...]:
        """Roller, arm and pivot."""
        stations, motion = inverted.givens.integrated.givens.stations, inverted.givens.integrated.givens.motion
        hand, centre = showing(inverted), inverted.acts["cam centre"].first
        # Turned back by the station's cam angle, the first pivot lies on the line of centres.
        back = np.exp(1j * sense(inverted.givens.rotation) * stations.phi[0]) * inverted.givens.mu_l.per_mm
        first = (inverted.acts[name].first[0] for name in ("pivots", "starts"))
        pivot, start = (hand.enlarged("C", place, centre, back / scale.per_mm) for place in first)
        arm = hand.protractor("arm", pivot, hand.join("arm at rest", pivot, start), -motion.levels[0])
        b = hand.lay_off("B", pivot, arm, between(pivot, start))
        support = pivot.place + np.array([-0.8 - 0.9j, -3 - 5j, 3 - 5j, 0.8 - 0.9j])
        ground = hand.given("ground", pivot.place + np.arange(-3, 3.1, 1.5) - 5j, -1.2 - 1.5j)
        return (
            hand.circle("roller", b, roller_radius / scale.per_mm).drawn_circle(Role.CURVE),
            hand.join("arm", b, pivot).way(Role.CURVE),
            pivot.line_from(centre, Role.AXIS),
            hand.circle("hinge", pivot, 1.2).drawn_circle(Role.CURVE),
            hand.given("support", support).line(Role.CURVE),
            ground.ways(Role.HATCH),
            b.dots(),
            b.label("B"),
            pivot.label("C"),
        )

"""The translating follower on the drawing board: knife edge or roller, central or offset."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.axes import sense_caption
from graphcam.constructions.board import DrawnFollower, FollowerLoads, Values, roller_sentences
from graphcam.constructions.cam_analysis import AnalysisGivens
from graphcam.constructions.force_plan import force_plan
from graphcam.constructions.friction_plan import friction_plan
from graphcam.constructions.inversion import inversion
from graphcam.constructions.kinematic_sketch import sketched_stem
from graphcam.constructions.minimum_radius import least_radius
from graphcam.constructions.pressure_angle import pressure_angle
from graphcam.constructions.stem_analysis import stem_analysis
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.drafting.marks import Mark
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import Limits, Rotation, Translating, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.spring_load import SpringLoad

ROLLER_CAPTION = say("The cam turns {rotation} about A and moves a translating follower; its roller turns about B.")
KNIFE_EDGE_CAPTION = say("The cam turns {rotation} about A and moves a translating follower; its knife edge is B.")
CENTRAL_REMARK = say("The line of motion passes through A.")
LEFT_REMARK = say("The line of motion passes A on the left, at the offset e = {offset:g} mm.")
RIGHT_REMARK = say("The line of motion passes A on the right, at the offset e = {offset:g} mm.")


@dataclass(frozen=True)
class DrawnTranslating(DrawnFollower):
    """A translating follower; ``place`` is its offset [mm, machine sign], None where it is to be found."""

    place: float | None
    has_own_region = True

    @property
    def conditions(self) -> dict[str, float | None]:
        """The condition of the exact minimum radius: the offset, if it is given."""
        return {"offset": self.place}

    def least_radius(
        self, integrated: Construction, rotation: Rotation, limits: Limits, place: float | None, pencil: Pencil
    ) -> Construction:
        """The minimum prime radius and the offset, from the combined diagram."""
        return least_radius(integrated, rotation, limits, place, pencil)

    def pressure_angle(
        self, integrated: Construction, rotation: Rotation, prime_radius: float, place: float, pencil: Pencil
    ) -> Construction:
        """The pressure angles, from the velocity plan."""
        return pressure_angle(integrated, rotation, prime_radius, place, pencil)

    def inversion(
        self, integrated: Construction, rotation: Rotation, r0: float, place: float, mu_l: Scale, pencil: Pencil
    ) -> Construction:
        """The pitch curve, from tangents of the offset circle."""
        return inversion(integrated, rotation, r0, place, mu_l, pencil)

    def analysis(self, givens: AnalysisGivens, pencil: Pencil) -> Construction:
        """The displacements from the prime circle to the pitch curve, along the inverted lines of the stem."""
        return stem_analysis(givens, pencil)

    def force_plan(
        self, drawn: Mapping[str, Construction], load: FollowerLoads, pencil: Pencil, friction: float = 0.0
    ) -> Construction:
        """The force plan, with friction at the cam if there is any."""
        assert isinstance(load, SpringLoad)
        measured = drawn["pressure_angle"]
        return friction_plan(measured, load, pencil, friction) if friction else force_plan(measured, load, pencil)

    def places(self, region: Construction, prime_radius: float) -> Floats:
        """The offsets [mm] at which the line of motion cuts the prime circle; the limits are satisfied at each."""
        return np.array([[-prime_radius, prime_radius]])

    def must_exceed(self, place: float) -> float:
        """The bound [mm] above which the line of motion cuts the prime circle."""
        return abs(place)

    def reach(
        self, prime_radius: float, place: float, motion: Motion, roller_radius: float, rotation: Rotation
    ) -> float:
        """The maximum radius of the pitch curve and the radius of a roller on it [mm]."""
        return prime_radius + motion.lift + roller_radius

    def extent(self, values: Values, limits: Limits, rotation: Rotation, prime_radius: float | None) -> complex:
        """The width + i height of the combined diagram, with the lines of the region down to the lowest place."""
        s, v, _ = values
        rise, offset = math.tan(limits.rise), sense(rotation) * (self.place or 0.0)
        # Where the lines meet zero lift, from the line of motion to the side of the rise's velocities.
        lines = [(float((v - s * rise).max()), -rise)]
        if limits.return_ is not None:
            back = math.tan(limits.return_)
            lines.append((-float((-v - s * back).max()), back))
        # The cam centre, the central place, that at the offset, and the apex: the lines are drawn down to the lowest.
        down = [prime_radius or 0.0, *((place - at) / slope for at, slope in lines for place in (0.0, offset))]
        if len(lines) == 2:
            (at, slope), (other, steep) = lines
            down.append((at - other) / (steep - slope))
        if limits.rest:
            rests = [rise]
            if limits.return_ is not None and limits.return_ < limits.rise:
                rests.append(-math.tan(limits.return_))
            lines += [(0.0, slope) for slope in rests]
            down += [offset / slope for slope in rests]
        beside = [offset, *v.tolist(), *(at + slope * max(down) for at, slope in lines)]
        return complex(max(beside) - min(beside), float(s.max()) + max(down))

    def built(self, place: float | None, roller_radius: float) -> Translating:
        """The translating follower with these sizes; an open offset is 0 in it."""
        return Translating(place or 0.0, roller_radius)

    def scheme(self, rotation: Rotation, roller_radius: float | None) -> tuple[Mark, ...]:
        """The kinematic diagram: cam, roller, stem and guide."""
        # An offset that is to be found is drawn on the favourable side.
        side = sense(rotation) if self.place is None else float(np.sign(self.place))
        return sketched_stem("A", side, sense(rotation), roller_radius, self.place)

    def assignment(self, roller: bool) -> Caption:
        """The sentence that asks for a cam for a stem."""
        if roller:
            return say("A disk cam is to move a translating follower with a roller by the following motion.")
        return say("A disk cam is to move a translating follower with a knife edge by the following motion.")

    def described(self, rotation: Rotation, roller_radius: float | None) -> list[Caption]:
        """Sentences on the line of motion and the roller."""
        moved = (KNIFE_EDGE_CAPTION if roller_radius == 0 else ROLLER_CAPTION).with_values(
            rotation=sense_caption(rotation)
        )
        if self.place is None:
            return [moved, *roller_sentences(roller_radius)]
        line = (CENTRAL_REMARK if self.place == 0 else LEFT_REMARK if self.place < 0 else RIGHT_REMARK).with_values(
            offset=self.place
        )
        return [moved, line, *roller_sentences(roller_radius)]

"""What lies on the drawing board before the first line: the task, and what differs between followers."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

from graphcam.constructions.axes import degrees
from graphcam.constructions.cam_analysis import AnalysisGivens
from graphcam.constructions.curvature import curvature
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.drafting.marks import Mark
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Paper, Scale
from graphcam.given.follower import Follower, Limits, Rotation
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.roller_rule import Candidate
from graphcam.given.spring_load import ArmLoad, SpringLoad
from graphcam.given.stations import Stations, divide

FollowerLoads = SpringLoad | ArmLoad
"""A load of a follower that slides, or of one that swings."""
Values = tuple[Floats, Floats, Floats]
"""s, v and a at places of the turn."""


@dataclass(frozen=True)
class FollowerSize:
    """A size of a follower: its key in files, its title, and its value [mm], None where it does not apply."""

    name: str
    title: Caption
    value: float | None


TURN_SAMPLES = 361
"""Samples of a turn, to see how far aside a profile is touched."""


class DrawnFollower(ABC):
    """A follower on the drawing board: what differs from a stem with a roller is stated by a subclass."""

    place: float | None
    """Where it stands beside the cam [mm]: its offset or centre distance; None where it is to be found."""
    place_name = "offset"
    """What the place is called, and the reading of the least radius that proposes it."""
    place_title: Caption = say("offset")
    unit = "mm"
    """The unit of the lift: "mm", or "rad" for an arm."""
    has_own_region = False
    """Whether the combined diagram of the minimum radius may have a scale of its own."""
    divides_at_corners = False
    """Whether a corner of the acceleration must fall on a division, for the extremes may lie in it."""
    constructions: tuple[str, ...] = (
        *("scheme", "acceleration", "integration", "minimum_radius", "pressure_angle", "angle_diagram"),
        *("inversion", "curvature", "roller", "working_profile"),
    )
    """The names of what is drawn for it, in order."""

    @property
    def conditions(self) -> dict[str, float | None]:
        """The conditions of the exact minimum radius besides the pressure angles, by the names of its arguments."""
        return {}

    def sizes(self, place: float | None, roller_radius: float | None) -> list[FollowerSize]:
        """The follower's sizes, in order, with these for what may be left open."""
        rollers = FollowerSize("roller_radius", say("roller radius"), roller_radius)
        return [FollowerSize(self.place_name, self.place_title, place), rollers]

    @abstractmethod
    def least_radius(
        self, integrated: Construction, rotation: Rotation, limits: Limits, place: float | None, pencil: Pencil
    ) -> Construction:
        """The least prime radius; readings ``prime_radius`` and the place by its name [mm]."""

    def pressure_angle(
        self, integrated: Construction, rotation: Rotation, prime_radius: float, place: float, pencil: Pencil
    ) -> Construction:
        """The pressure angles at the stations; reading ``alpha`` [rad]."""
        raise NotImplementedError

    @abstractmethod
    def inversion(
        self, integrated: Construction, rotation: Rotation, r0: float, place: float, mu_l: Scale, pencil: Pencil
    ) -> Construction:
        """The pitch curve; readings ``x``, ``y``, ``radius`` [mm].

        Points, and acts of these names: ``starts`` on the prime circle, ``pitch``, and directions of the ``motion``.
        """

    def analysis(self, givens: AnalysisGivens, pencil: Pencil) -> Construction:
        """What a given cam does: reading ``s``, the displacement at equal parts of the turn."""
        raise NotImplementedError

    def curvature(self, drawn: Mapping[str, Construction], pencil: Pencil) -> Construction:
        """The least radius of curvature, from what is drawn; readings ``rho`` and ``rho_candidates`` [mm]."""
        return curvature(drawn["inversion"], pencil)

    def force_plan(
        self, drawn: Mapping[str, Construction], load: FollowerLoads, pencil: Pencil, friction: float = 0.0
    ) -> Construction | None:
        """The force plan under a load, with friction at the cam; None where the follower has none."""
        return None

    @abstractmethod
    def places(self, region: Construction, prime_radius: float) -> Floats:
        """The stretches (k, 2) of places [mm] that go with a prime radius [mm] on the region of the least radius."""

    @abstractmethod
    def must_exceed(self, place: float) -> float:
        """The bound [mm] above which the prime radius must lie for the mechanism to close at all."""

    @abstractmethod
    def reach(
        self, prime_radius: float, place: float, motion: Motion, roller_radius: float, rotation: Rotation
    ) -> float:
        """How far the drawing of the profile reaches from the cam centre [mm]."""

    def extent(self, values: Values, limits: Limits, rotation: Rotation, prime_radius: float | None) -> complex:
        """How wide + i high the combined diagram is that shares the scale of s, in units of the lift; 0 for none.

        values : over the turn;  prime_radius : mm, None where it is to be found
        """
        return 0j

    def with_positions_at(self, scale: float) -> Self:
        """The follower with its positions drawn at a scale [mm/mm], where they have one of their own."""
        return self

    @abstractmethod
    def built(self, place: float | None, roller_radius: float) -> Follower:
        """The follower with these sizes."""

    @abstractmethod
    def scheme(self, rotation: Rotation, roller_radius: float | None) -> tuple[Mark, ...]:
        """The kinematic diagram: the follower low on a plain cam, with the sizes that the task gives."""

    @abstractmethod
    def assignment(self, roller: bool) -> Caption:
        """The sentence that asks for a cam for this follower, with a roller or without one."""

    @abstractmethod
    def described(self, rotation: Rotation, roller_radius: float | None) -> list[Caption]:
        """Sentences on what the cam moves, and on the sizes that the task gives."""

    def limited(self, limits: Limits) -> Caption:
        """A sentence on what the design must keep to."""
        if limits.return_ is None:
            return FORCE_CLOSED.with_values(rise=degrees(limits.rise))
        return FORM_CLOSED.with_values(rise=degrees(limits.rise), back=degrees(limits.return_))


FORCE_CLOSED = say(
    "The pressure angle is to be at most {rise} on a rise; on a return a spring drives the follower (force closure), "
    "and the angle is not limited."
)
FORM_CLOSED = say("The pressure angle is to be at most {rise} on a rise and {back} on a return.")


def roller_sentences(roller_radius: float | None) -> list[Caption]:
    """A sentence on the radius of a roller [mm], where the task gives it; else none."""
    return [say("The roller radius is r = {radius:g} mm.", radius=roller_radius)] if roller_radius else []


@dataclass(frozen=True, eq=False)
class Board:
    """What lies on the board of a cam: the task, and the draughtsman's choices.

    prime_radius, roller_radius : mm, or None where the task leaves them to be found
    ordinate, poles : mm of paper; mu_phi : rad/mm, of the cam angle
    mu_alpha : rad/mm, of the pressure angle; None where it is that of the cam angle
    min_profile_radius : permitted radius of curvature of the profile under a roller or knife edge [mm]; None for none
    shaft_radius : that a bore takes with its keyway and a wall, inside the profile [mm]; 0 where the task gives none
    rounding : adopted sizes are multiples of it [mm]; None for the largest power of ten below r0/10, at most 1 mm
    paper : what the profile, or another view of its own, finds on the sheet
    omega : of the cam [rad/s], where the task gives a speed
    station : whose velocity plan is asked for, None for the one that shows most
    refine : divides every part again, to see what finer parts would change
    jerk_pole : of the diagram of the jerk [mm of paper], None where none is asked for
    finer : the cuts of phases by their index that need more parts than ``divisions``, as :func:`divide` takes them
    """

    motion: Motion
    follower: DrawnFollower
    rotation: Rotation
    limits: Limits
    prime_radius: float | None
    roller_radius: float | None
    roller_rule: tuple[Candidate, ...]
    divisions: int
    ordinate: float
    poles: tuple[float, float]
    mu_phi: Scale
    rounding: float | None
    paper: Paper
    omega: float | None = None
    refine: int = 1
    station: int | None = None
    jerk_pole: float | None = None
    min_profile_radius: float | None = None
    shaft_radius: float = 0.0
    finer: Mapping[int, Sequence[float]] = field(default_factory=dict[int, Sequence[float]])
    mu_alpha: Scale | None = None

    @property
    def needed_profile_radius(self) -> float | None:
        """The radius of curvature of the profile [mm] that an open prime radius has to leave; None for any.

        As permitted, else none: a roller that the task gives must find a prime radius on which it does not undercut.
        """
        if self.min_profile_radius is None and self.prime_radius is None and self.roller_radius:
            return 0.0
        return self.min_profile_radius

    @cached_property
    def stations(self) -> Stations:
        """The ends of the parts into which the phases are divided."""
        return self.divided(self.divisions, self.finer)

    def divided(self, divisions: int, finer: Mapping[int, Sequence[float]]) -> Stations:
        """The stations with another number of divisions."""
        # No chord of the acceleration may run across a corner, where the jerk jumps.
        at_corners = self.follower.divides_at_corners or self.jerk_pole is not None
        return divide(self.motion, divisions, self.refine, at_corners=at_corners, finer=finer)

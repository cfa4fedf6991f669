"""What lies on the drawing board before the first line: the task, and what differs between followers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

from graphcam.drafting.ink import Construction
from graphcam.drafting.marks import Mark
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import Follower, Rotation
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits
from graphcam.given.motion import Motion
from graphcam.given.roller_rule import Candidate
from graphcam.given.stations import Stations, divide


class DrawnFollower(Protocol):
    """A follower on the drawing board: the constructions that are its own.

    ``place`` is where it stands beside the cam [mm]: a translating follower's offset, an arm's centre distance.
    """

    @property
    def place_name(self) -> str:
        """What the place is called, and the reading of the least radius that proposes it."""
        ...

    @property
    def place(self) -> float | None:
        """The given place [mm], or None where the task leaves it to be found."""
        ...

    @property
    def unit(self) -> str:
        """Of the lift: "mm", or "rad" for an arm."""
        ...

    @property
    def divides_at_corners(self) -> bool:
        """Whether a corner of the acceleration must fall on a division, for the extremes may lie in it."""
        ...

    @property
    def conditions(self) -> dict[str, float | None]:
        """What the exact least radius is asked for besides the pressure angles, by the names of its arguments."""
        ...

    @property
    def constructions(self) -> tuple[str, ...]:
        """The names of what is drawn for it, in order."""
        ...

    def least_radius(
        self, integrated: Construction, rotation: Rotation, limits: Limits, place: float | None, pencil: Pencil
    ) -> Construction:
        """The least prime radius; readings ``prime_radius`` and the place by its name [mm]."""
        ...

    def pressure_angle(
        self, integrated: Construction, rotation: Rotation, prime_radius: float, place: float, pencil: Pencil
    ) -> Construction:
        """The pressure angles at the stations; reading ``alpha`` [rad]."""
        ...

    def inversion(
        self,
        integrated: Construction,
        rotation: Rotation,
        prime_radius: float,
        place: float,
        mu_l: Scale,
        pencil: Pencil,
    ) -> Construction:
        """The pitch curve; readings ``x``, ``y``, ``radius`` [mm]; points ``pitch`` and ``motion``, its directions."""
        ...

    def curvature(self, drawn: Mapping[str, Construction], pencil: Pencil) -> Construction:
        """The least radius of curvature, from what is drawn; readings ``rho`` and ``rho_candidates`` [mm]."""
        ...

    def places(self, region: Construction, prime_radius: float) -> Floats:
        """The stretches (k, 2) of places [mm] that go with a prime radius [mm] on the region of the least radius."""
        ...

    def must_exceed(self, place: float) -> float:
        """What the prime radius must be greater than for the mechanism to close at all [mm]."""
        ...

    def reach(self, prime_radius: float, place: float, lift: float, roller_radius: float) -> float:
        """How far the drawing of the profile reaches from the cam centre [mm]."""
        ...

    def built(self, place: float | None, roller_radius: float) -> Follower:
        """The follower with these sizes."""
        ...

    def scheme(self, inverted: Construction, roller_radius: float, scale: Scale) -> tuple[Mark, ...]:
        """The follower in the scheme of the mechanism, at the start of the turn."""
        ...


@dataclass(frozen=True, eq=False)
class Board:
    """The task, and the draughtsman's choices.

    prime_radius, roller_radius : mm, or None where the task leaves them to be found
    ordinate, poles : mm of paper; mu_phi : rad/mm, for the pressure angle's axis too
    rounding : adopted sizes are multiples of it [mm]; None for the largest power of ten below r0/10, at most 1 mm
    profile_room : width and height of paper that the profile may take [mm]
    refine : divides every part again, to see what finer parts would change
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
    profile_room: tuple[float, float]
    refine: int = 1

    @cached_property
    def stations(self) -> Stations:
        """The phases, divided."""
        return divide(self.motion, self.divisions, self.refine, at_corners=self.follower.divides_at_corners)

"""The table ``[spring]`` of a task file: spring, mass and loads of a sliding follower, and of an arm."""

import math
from dataclasses import dataclass
from typing import Annotated

from graphcam.errors import DesignError
from graphcam.given.spring_load import ArmLoad, ArmSpring, Load, LoadCurve, SpringLoad
from graphcam.tasks.declared_numbers import About, Fixed, Ruled
from graphcam.tasks.number_limits import NotNegative, Positive, Within, check_limits
from graphcam.tasks.units import (
    Angle,
    AngularAcceleration,
    ArmDamping,
    ArmPreload,
    ArmStiffness,
    Damping,
    Force,
    Inertia,
    Length,
    Mass,
    Preload,
    Stiffness,
    check_turning,
)
from graphcam.words import say

LoadTable = Force | tuple[tuple[Angle, Force], ...]
"""A load in N, or rows of a cam angle in degrees and a load in N, from 0 to 360 degrees."""


def load_of(said: LoadTable) -> Load:
    """The load that a file says.

    Raises
    ------
    DesignError : the rows do not cover the turn, are out of order or do not close

    >>> load_of(25.0), float(load_of(((0, 10), (180, 20), (360, 10)))(math.pi / 2))
    (25.0, 15.0)
    """
    if not isinstance(said, tuple):
        return said
    return LoadCurve([math.radians(angle) for angle, _ in said], [force for _, force in said])


MAX_FRICTION = 2.0
"""The maximum coefficient of friction; a greater one is a typing error."""
Friction = Annotated[
    float,
    Within(
        0.0,
        MAX_FRICTION,
        say("from 0 to {most:g}", most=MAX_FRICTION),
        say("it is the coefficient mu between cam and follower"),
    ),
]


@dataclass(frozen=True)
class SpringTable:
    """``[spring]``: what presses a translating or flat-faced follower on its cam; it needs ``speed_rpm``.

    mass : kg, of the follower and all that moves with it
    stiffness : N/mm
    preload : N, in the lowest position; left out: the minimum that keeps contact; if that is 0, nothing presses in the
        lower dwell: choose more
    acceleration : rad/s^2, of the cam, at the speed
    friction : coefficient mu between cam and follower
    load : N, what else presses the follower on; or a table over the turn: [[0, 20], [90, 60], [360, 20]]
    damping : N s/m, against the motion
    """

    mass: Annotated[Mass, say("Moving mass"), About(1.0)]
    stiffness: Annotated[Stiffness, say("Stiffness c"), About(3.0)]
    preload: Annotated[Preload | None, say("Preload F₀"), About(100.0, from_zero=True)] = None
    acceleration: Annotated[AngularAcceleration, say("Angular acceleration ε"), Fixed(-500.0, 500.0, 5.0)] = 0.0
    friction: Annotated[Friction, say("Friction at the cam f₁"), Fixed(0.0, 0.5, 0.01)] = 0.0
    load: Annotated[LoadTable, say("Load P"), About(100.0, from_zero=True)] = 0.0
    damping: Annotated[Damping, say("Damping d"), About(100.0, from_zero=True)] = 0.0
    swings = False

    def __post_init__(self) -> None:
        check_limits(self)
        load_of(self.load)

    def __call__(self, speed_rpm: float) -> SpringLoad:
        """The load at a speed [rpm]; an open preload is 0 in it.  Friction belongs to the contact, not to the load."""
        load, preload = load_of(self.load), self.preload or 0.0
        return SpringLoad(
            *(self.mass, speed_rpm, self.stiffness, preload, self.acceleration), load=load, damping=self.damping
        )


@dataclass(frozen=True)
class ArmSpringPlace:
    """``[spring] at``: where a spring acts on an arm.

    arm : mm from the pivot, on the line to the arm's end
    anchor : mm, (x, y) of the spring's other end in the frame, whose origin is the cam centre
    """

    arm: Annotated[Length, say("Spring from the pivot"), Ruled()]
    anchor: tuple[
        Annotated[Length, say("Anchor of the spring, x"), Ruled()],
        Annotated[Length, say("Anchor of the spring, y"), Ruled()],
    ]

    def __post_init__(self) -> None:
        if self.arm == 0:
            limit = say("a length other than 0 mm")
            raise DesignError("arm", self.arm, limit, say("at the pivot a spring turns nothing"))
        check_limits(self)

    def __call__(self) -> ArmSpring:
        """The spring in the terms of the exact side."""
        return ArmSpring(self.arm, self.anchor)


@dataclass(frozen=True)
class ArmSpringTable:
    """``[spring]``: what presses an arm on its cam; it needs ``speed_rpm``.

    inertia : kg mm^2, of the arm and all that swings with it, about the pivot
    stiffness : N mm/rad, of a torsion spring about the pivot; N/mm, of a spring at a point
    preload : N mm in the lowest position, N of a spring at a point; left out: the minimum that keeps contact
    acceleration : rad/s^2, of the cam, at the speed
    friction : coefficient mu between cam and follower
    load : N, what else presses on the arm's end along its path; or a table over the turn
    at : where a spring acts: mm from the pivot, and to what point of the frame; left out: a torsion spring about the
        pivot
    damping : N mm s/rad, about the pivot against the motion
    """

    inertia: Annotated[Inertia, say("Moment of inertia J"), About(900.0)]
    stiffness: Annotated[ArmStiffness, say("Stiffness c"), About(3.0)]
    preload: Annotated[ArmPreload | None, say("Preload F₀"), About(100.0, from_zero=True)] = None
    acceleration: Annotated[AngularAcceleration, say("Angular acceleration ε"), Fixed(-500.0, 500.0, 5.0)] = 0.0
    friction: Annotated[Friction, say("Friction at the cam f₁"), Fixed(0.0, 0.5, 0.01)] = 0.0
    load: Annotated[LoadTable, say("Load P"), About(100.0, from_zero=True)] = 0.0
    at: ArmSpringPlace | None = None
    damping: Annotated[ArmDamping, say("Damping d"), About(100.0, from_zero=True)] = 0.0
    swings = True

    def __post_init__(self) -> None:
        check_limits(self)
        check_turning(self, turning=self.at is None)
        Positive("N mm/rad" if self.at is None else "N/mm").check("stiffness", self.stiffness)
        if self.preload is not None:
            NotNegative("N mm" if self.at is None else "N").check("preload", self.preload)
        load_of(self.load)

    def __call__(self, speed_rpm: float) -> ArmLoad:
        """The load at a speed [rpm]; an open preload is 0 in it.  Friction belongs to the contact, not to the load."""
        load, preload, at = load_of(self.load), self.preload or 0.0, self.at and self.at()
        return ArmLoad(
            *(self.inertia, speed_rpm, self.stiffness, preload, self.acceleration, load, at), damping=self.damping
        )

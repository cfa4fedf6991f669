"""The followers of a disk cam, the sense and speed of its turn, permitted angles.  Conventions: see :mod:`graphcam`."""

from __future__ import annotations

import math
from dataclasses import dataclass
from numbers import Real
from typing import Literal, get_args

from graphcam.errors import DesignError, check_kind, check_number, suggestion
from graphcam.given.plausible_ranges import check_positive
from graphcam.words import Words, say

Rotation = Literal["ccw", "cw"]
MM_PER_M = 1000.0


def omega_of(speed_rpm: float) -> float:
    """The angular velocity [rad/s] at a speed [rpm].

    >>> round(omega_of(300), 3)
    31.416
    """
    return speed_rpm * math.tau / 60


def sense(rotation: str) -> int:
    """sigma: +1 for a cam that turns counter-clockwise, -1 for clockwise.

    >>> sense("ccw"), sense("cw")
    (1, -1)
    """
    try:
        return {"ccw": 1, "cw": -1}[rotation]
    except (KeyError, TypeError):
        remedy = suggestion(f"{rotation}", get_args(Rotation))
        raise DesignError("rotation", rotation, say("'ccw' or 'cw'"), remedy) from None


def _check_length(quantity: str, value: float, *, zero: bool) -> None:
    if zero:
        check_number(quantity, value, say("a finite length of 0 mm or more"), least=0)
    else:
        check_number(quantity, value, say("a finite length of more than 0 mm"), above=0)


@dataclass(frozen=True)
class Translating:
    """A follower that slides along the line x = offset, with a roller or (roller_radius = 0) a knife edge.

    offset, roller_radius : mm; offset > 0 to the right of the cam centre

    >>> import graphcam as gc
    >>> gc.Translating(offset=10, roller_radius=12)
    Translating(offset=10, roller_radius=12)
    """

    offset: float = 0.0
    roller_radius: float = 0.0
    kind = "translating"
    lift_unit = "mm"
    usual_limit_deg = 30.0
    """The permitted pressure angle on the rise where none is given."""

    def __post_init__(self) -> None:
        check_number("offset", self.offset, say("a finite length in mm"))
        _check_length("roller radius", self.roller_radius, zero=True)


@dataclass(frozen=True)
class Oscillating:
    """A follower that swings about a pivot at (distance, 0) on an arm, with a roller or a knife edge.

    arm, roller_radius : mm
    distance : centre distance [mm]; if None, it is found with the minimum radius; a cam needs it

    The lift of its motion is an angle in radians.

    >>> import graphcam as gc
    >>> swing, turn = math.radians(15), math.radians(90)
    >>> motion = gc.Motion([gc.Rise(swing, turn), gc.Dwell(turn), gc.Return(swing, turn), gc.Dwell(turn)])
    >>> cam = gc.Cam(motion, gc.Oscillating(arm=120, distance=130, roller_radius=12), prime_radius=50)
    >>> cam.motion.lift == swing
    True
    """

    arm: float
    distance: float | None = None
    roller_radius: float = 0.0
    kind = "oscillating"
    lift_unit = "rad"
    usual_limit_deg = 45.0

    def __post_init__(self) -> None:
        _check_length("arm", self.arm, zero=False)
        if self.distance is not None:
            _check_length("centre distance", self.distance, zero=False)
        _check_length("roller radius", self.roller_radius, zero=True)


@dataclass(frozen=True)
class FlatFaced:
    """A follower with a flat face perpendicular to its motion.

    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(10, math.pi), gc.Return(10, math.pi)])
    >>> gc.Cam(motion, gc.FlatFaced(), prime_radius=40).pressure_angle(1.0).item()
    0.0
    """

    kind = "flat-faced"
    lift_unit = "mm"
    usual_limit_deg = 30.0  # any limit is kept: the pressure angle is 0
    roller_radius = 0.0


@dataclass(frozen=True)
class OscillatingFlat:
    """A follower with a flat face that swings about a pivot at (distance, 0).

    distance : centre distance c [mm]
    face_offset : f [mm], how far the face lies beside the line through the pivot, towards the cam centre if positive

    The lift of its motion is an angle in radians.  In the lower dwell the face touches the base circle:
    c sin(psi0) = r0 + f, with psi0 the angle between the face and the line of centres.

    >>> import graphcam as gc
    >>> swing, turn = math.radians(15), math.radians(90)
    >>> motion = gc.Motion([gc.Rise(swing, turn), gc.Dwell(turn), gc.Return(swing, turn), gc.Dwell(turn)])
    >>> cam = gc.Cam(motion, gc.OscillatingFlat(distance=100, face_offset=10), prime_radius=40)
    >>> round(math.degrees(cam.kinematics.psi0), 9)
    30.0
    """

    distance: float
    face_offset: float = 0.0
    kind = "oscillating-flat"
    lift_unit = "rad"
    usual_limit_deg = 45.0
    roller_radius = 0.0

    def __post_init__(self) -> None:
        _check_length("centre distance", self.distance, zero=False)
        check_number("face offset", self.face_offset, say("a finite length in mm"))


def swing_remedy(lift: float, otherwise: Words) -> Words:
    """What to do about the lift of an arm [rad] that is too large: beyond a turn it was meant in another unit.

    >>> print(swing_remedy(15, "swing the arm less"))
    in Python an arm's lift is an angle in radians: math.radians(15)
    """
    if lift > 2 * math.pi:
        return say("in Python an arm's lift is an angle in radians: math.radians({lift:g})", lift=lift)
    return otherwise


Follower = Translating | Oscillating | FlatFaced | OscillatingFlat
FOLLOWER_CLASSES = Translating, Oscillating, FlatFaced, OscillatingFlat
Kind = Literal["translating", "oscillating", "flat-faced", "oscillating-flat"]
"""What a file calls the kind of a follower."""
FOLLOWERS_BY_KIND: dict[str, type[Follower]] = {follower.kind: follower for follower in FOLLOWER_CLASSES}
"""The followers by their kind."""


QUARTER_TURN = math.pi / 2
LIMIT_NAMES = {
    "rise": say("permitted pressure angle on the rise"),
    "return": say("permitted pressure angle on the return"),
}
"""What an error calls a limit, by its name."""
AN_ANGLE, ITS_REMEDY = say("an angle in rad"), say("30 degrees are math.radians(30)")
CURVATURE_NAME = say("minimum radius of curvature")


@dataclass(frozen=True)
class Limits:
    """Permitted pressure angles [rad], as magnitudes, and curvature.

    rise : on every rise
    return_ : on every return; None for force closure, where a spring drives the return
    rest : whether the angle in the lower dwell must keep the limits of the phases beside it too
    curvature : the minimum radius of curvature [mm] of the convex parts of the profile, for :func:`graphcam.sweep`;
        None is no limit

    Raises
    ------
    DesignError : an angle is not between 0 and 90 degrees, or the radius of curvature not greater than 0

    >>> import graphcam as gc
    >>> gc.Limits(rise=math.radians(30), return_=math.radians(45)).rest
    True
    >>> gc.Limits(rise=30)
    Traceback (most recent call last):
    graphcam.errors.DesignError: permitted pressure angle on the rise is 1718.87 degrees, but must be between 0 and ...
    """

    rise: float = math.radians(Translating.usual_limit_deg)
    return_: float | None = None
    rest: bool = True
    curvature: float | None = None

    def __post_init__(self) -> None:
        back = self.return_
        check_positive(CURVATURE_NAME, self.curvature, "mm")
        for name, angle in (("rise", self.rise), ("return", 0.0 if back is None else back)):
            check_kind(LIMIT_NAMES[name], angle, Real, AN_ANGLE, ITS_REMEDY)
        if not (0 < self.rise < QUARTER_TURN and (back is None or 0 < back < QUARTER_TURN)):
            name, value = ("return", back) if 0 < self.rise < QUARTER_TURN else ("rise", self.rise)
            given, limit = math.degrees(value or 0.0), say("between 0 and 90 degrees, both excluded")
            remedy = say("30 degrees is usual for a translating follower")
            if given > 360:
                remedy = say("write math.radians({value:g}) if it is in degrees", value=value)
            raise DesignError(LIMIT_NAMES[name], say("{given:g} degrees", given=given), limit, remedy)

    def slip(self) -> tuple[str, float] | None:
        """The name and the degrees of a limit so small that radians were given for degrees; None if there is none.

        >>> Limits(rise=math.radians(0.52)).slip()
        ('rise', 0.52)
        >>> Limits(rise=0.52).slip()
        """
        for name, value in (("rise", self.rise), ("return", self.return_)):
            if value is not None and (given := math.degrees(value)) <= QUARTER_TURN:
                return name, round(given, 12)
        return None


def no_prime_radius(quantity: Words, value: object, smaller: Words) -> DesignError:
    """The error of a size that goes with no prime radius within the permitted pressure angles.

    smaller : the remedy of taking a smaller one
    """
    limit = say("so small that some prime radius goes with it within the permitted pressure angles")
    remedy = say("{smaller}, lengthen the centre distance, or permit larger pressure angles")
    return DesignError(quantity, value, limit, remedy.with_values(smaller=smaller))

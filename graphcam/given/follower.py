"""The followers of a disk cam and the sense in which the cam turns.  Conventions: see :mod:`graphcam`."""

import math
from dataclasses import dataclass
from typing import Literal

from graphcam.errors import DesignError, meant

Rotation = Literal["ccw", "cw"]
SENSES = {
    "ccw": (
        *("counter-clockwise", "anticlockwise", "anti-clockwise"),
        *("против часовой стрелки", "逆时针", "ngược chiều kim đồng hồ"),
    ),
    "cw": ("clockwise", "по часовой стрелке", "顺时针", "thuận chiều kim đồng hồ"),
}
"""What else the senses are called; a message names the one that is meant."""


def sense(rotation: str) -> int:
    """sigma: +1 for a cam that turns counter-clockwise, -1 for clockwise.

    >>> sense("ccw"), sense("cw")
    (1, -1)
    """
    try:
        return {"ccw": 1, "cw": -1}[rotation]
    except (KeyError, TypeError):
        raise DesignError("rotation", rotation, "'ccw' or 'cw'", meant(f"{rotation}", SENSES, SENSES)) from None


def _check_length(quantity: str, value: float, *, zero: bool) -> None:
    if not math.isfinite(value) or value < 0 or (value == 0 and not zero):
        raise DesignError(quantity, value, "a finite length of " + ("0 mm or more" if zero else "more than 0 mm"))


@dataclass(frozen=True)
class Translating:
    """A follower that slides along the line x = offset, with a roller or (roller_radius = 0) a knife edge.

    offset, roller_radius : mm; offset > 0 to the right of the cam centre
    """

    offset: float = 0.0
    roller_radius: float = 0.0
    kind = "translating"
    lift_unit = "mm"
    usual_limit_deg = 30.0
    """The permitted pressure angle on the rise where none is given."""

    def __post_init__(self) -> None:
        if not math.isfinite(self.offset):
            raise DesignError("offset", self.offset, "a finite length in mm")
        _check_length("roller radius", self.roller_radius, zero=True)


@dataclass(frozen=True)
class Oscillating:
    """A follower that swings about a pivot at (distance, 0) on an arm, with a roller or a knife edge.

    arm, roller_radius : mm
    distance : centre distance [mm]; if None, it is found with the minimum radius; a cam needs it
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
    """A follower with a flat face perpendicular to its motion."""

    kind = "flat-faced"
    lift_unit = "mm"
    usual_limit_deg = 30.0  # any limit is kept: the pressure angle is 0
    roller_radius = 0.0


Follower = Translating | Oscillating | FlatFaced
FOLLOWERS: dict[str, type[Follower]] = {follower.kind: follower for follower in (Translating, Oscillating, FlatFaced)}
"""The followers by their kind."""

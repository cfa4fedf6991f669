"""What a cam's size must keep, as margins at places of the turn: 0 at the limit, negative beyond it.

Every margin is a smooth function of prime radius, offset, roller radius and face width at a fixed place, and a part of
its limit: of the tangent of the pressure angle, of the roller's share of the radius of curvature, of the force that
the permitted stress allows, pi w r (1 - kappa r) p^2/E'.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError, Unquoted
from graphcam.given.follower_load import FollowerLoad
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.roller_contact import RollerContact
from graphcam.mechanism.hertz import ContactStress
from graphcam.mechanism.kinematics import Values
from graphcam.mechanism.stationary import Places, places_of, smooth_pieces, stationary_places
from graphcam.mechanism.translating import TranslatingKinematics

LIMITS = ("pressure angle on the rise", "pressure angle on the return", "curvature", "stress")
SPREAD = 24
"""Places on every smooth piece with which the search begins."""


@dataclass(frozen=True)
class SizingLimits:
    """Permitted stress [MPa] and pressure angles [rad], None for force closure; the roller's share of the curvature."""

    stress: float
    rise: float
    return_: float | None
    roller_share: float
    contact: RollerContact

    def __post_init__(self) -> None:
        if not (math.isfinite(self.stress) and self.stress > 0):
            raise DesignError("permitted stress", self.stress, "a finite number greater than 0 MPa")
        for name, angle in (("rise", self.rise), ("return", self.return_)):
            if angle is not None and not 0 < angle < math.pi / 2:
                quantity, limit = f"permitted pressure angle on the {name}", "between 0 and 90 degrees, both excluded"
                raise DesignError(quantity, Unquoted(f"{math.degrees(angle):g} degrees"), limit)
        if not 0 < self.roller_share <= 1:
            quantity = "roller's share of the radius of curvature"
            raise DesignError(quantity, self.roller_share, "greater than 0, at most 1")


@dataclass(frozen=True)
class Sizes:
    """Prime radius, offset, roller radius and face width [mm], numbers or arrays with a last axis of length 1."""

    radius: Any
    offset: Any
    roller: Any
    width: Any


@dataclass(frozen=True, eq=False)
class TurnPlaces:
    """Places of the turn: direction of the motion, (s, v, a, j), load along the motion [N]; each (n,)."""

    direction: Floats
    values: Values
    load: Floats

    @classmethod
    def of(cls, motion: Motion, load: FollowerLoad, places: Places) -> TurnPlaces:
        """The same places with their loads."""
        direction = motion.directions[places.phase]
        return cls(direction, places.values, load.force(places.values, direction, places.phi))

    @classmethod
    def spread(cls, motion: Motion, load: FollowerLoad, finer: int = 1) -> TurnPlaces:
        """Places all over the turn, ``finer`` times as many as usual, both ends of every piece among them."""
        phase, u0, u1 = smooth_pieces(motion)
        share = (1 - np.cos(np.linspace(0, np.pi, finer * SPREAD))) / 2
        u = u0[:, None] + (u1 - u0)[:, None] * share
        inside, last = motion.at(phase[:, None], u), motion.at(phase, u1, "left")
        for value, end in zip(inside, last, strict=True):
            value[:, -1] = end
        s, v, a, j = (value.ravel() for value in inside)
        every = np.repeat(phase, share.size)
        places = Places(every, u.ravel(), motion.angle_at(every, u.ravel()), (s, v, a, j))
        # A dwell is one place.
        return cls.of(motion, load, places.where((motion.directions[every] != 0) | (u.ravel() == 0)))

    @classmethod
    def worst(cls, stress: ContactStress) -> TurnPlaces:
        """Where pressure angle, curvature and stress of one cam can have their exact extremes."""
        cam, load = stress.forces.cam, stress.forces.pressing
        kin, motion = cam.kinematics, cam.motion
        steep, sharp = (stationary_places(motion, slope) for slope in (kin.pressure_slope, kin.curvature_slope))
        first, *others = (
            cls.of(motion, load, places) for places in (steep, sharp, places_of(motion, stress.slope, load.knots))
        )
        for other in others:
            first = first.joined(other)
        return first

    def joined(self, other: TurnPlaces) -> TurnPlaces:
        """These places and others."""
        s, v, a, j = (np.concatenate(pair) for pair in zip(self.values, other.values, strict=True))
        direction = np.concatenate([self.direction, other.direction])
        return TurnPlaces(direction, (s, v, a, j), np.concatenate([self.load, other.load]))

    def where(self, chosen: NDArray[np.bool_]) -> TurnPlaces:
        """Some of the places."""
        s, v, a, j = (value[chosen] for value in self.values)
        return TurnPlaces(self.direction[chosen], (s, v, a, j), self.load[chosen])


def margins(limits: SizingLimits, places: TurnPlaces, sizes: Sizes, sigma: int) -> dict[str, Floats]:
    """What is left of every limit at the places, as a part of it; inf where a pressure angle is not limited.

    returns : by the names of :data:`LIMITS`, each (..., n)
    """
    kin = TranslatingKinematics(sigma, sizes.radius, sizes.offset)
    (along, across), _ = kin.pressure(places.values)
    kappa, steepness = kin.curvature(places.values), np.abs(across) / along

    def angle(permitted: float | None, direction: int) -> Floats:
        """What is left (..., n) of a permitted pressure angle [rad] where the motion has that direction."""
        if permitted is None:
            return np.full_like(steepness, np.inf)
        return np.where(places.direction == direction, 1 - steepness / math.tan(permitted), np.inf)

    share = kappa * sizes.roller
    bearable = math.pi * sizes.width * limits.stress**2 / limits.contact.modulus * sizes.roller * (1 - share)
    normal = places.load * np.sqrt(1 + steepness**2)
    left = (
        angle(limits.rise, 1),
        angle(limits.return_, -1),
        1 - share / limits.roller_share,
        (bearable - normal) / places.load.max(),
    )
    return dict(zip(LIMITS, left, strict=True))

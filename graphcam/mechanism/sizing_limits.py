"""What a cam may be, and what it must keep, as margins at places of the turn: 0 at the limit, negative beyond.

Every margin is a smooth function of prime radius, offset, roller radius and face width at a fixed place, and a part of
its limit: of the tangent of the pressure angle, of the roller's share of the radius of curvature and of the prime
radius, of the force that the permitted stress allows, pi w r (1 - kappa r) p^2/E'.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError, check_number
from graphcam.given.follower import LIMIT_NAMES, Rotation, Translating, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.roller_contact import RollerContact
from graphcam.given.roller_rule import Candidate
from graphcam.given.spring_load import FollowerLoad, SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.contact import Contact
from graphcam.mechanism.forces import CamForces, check_friction
from graphcam.mechanism.hertz import ContactStress
from graphcam.mechanism.kinematics import Values
from graphcam.mechanism.translating import TranslatingKinematics
from graphcam.mechanism.turn_extremes import Places, smooth_pieces, stationary_places
from graphcam.words import say

RISE_LIMIT, RETURN_LIMIT, CURVATURE_LIMIT, SHARE_LIMIT, STRESS_LIMIT = LIMITS = (
    "pressure angle on the rise",
    "pressure angle on the return",
    "curvature",
    "roller's share of the prime radius",
    "stress",
)
PIECE_PLACES = 24
"""Places on every smooth piece with which the search begins ..."""
TOTAL_PLACES, MIN_PIECE_PLACES = 300, 3
"""Places in all where there are many pieces, and the minimum on each; the search adds what it needs."""
POSSIBLE_SHARE = 0.999
"""Rollers and offsets of a search are at most this part of the prime radius, which they must not reach."""
NO_UNDERCUT_RULE = Candidate("rho", "rho")
"""What every cam must keep: the roller is no larger than the radius of curvature."""


@dataclass(frozen=True)
class SizingLimits:
    """Permitted stress [MPa] and pressure angles [rad], None for force closure; what a roller may be, and friction.

    rule : the terms of a roller rule, all of which the roller keeps;  friction : mu, between cam and follower
    """

    stress: float
    rise: float
    return_: float | None
    rule: tuple[Candidate, ...]
    contact: RollerContact
    friction: float = 0.0

    def __post_init__(self) -> None:
        check_number(say("permitted stress"), self.stress, say("a finite number greater than 0 MPa"), above=0)
        for name, angle in (("rise", self.rise), ("return", self.return_)):
            if angle is not None and not 0 < angle < math.pi / 2:
                quantity, limit = LIMIT_NAMES[name], say("between 0 and 90 degrees, both excluded")
                raise DesignError(quantity, say("{degrees:g} degrees", degrees=math.degrees(angle)), limit)
        check_friction(self.friction)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the limits that there are."""
        without = {RETURN_LIMIT: self.return_ is None, SHARE_LIMIT: all(term.of == "rho" for term in self.rule)}
        return tuple(name for name in LIMITS if not without.get(name))

    def largest_roller(self, rho: float, prime_radius: float) -> float:
        """The largest roller [mm] that the rule permits with a least convex radius of curvature and a prime radius."""
        return min(term(rho, prime_radius) for term in (*self.rule, NO_UNDERCUT_RULE))


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
        """Places of the turn with their loads."""
        direction = motion.directions[places.phase]
        return cls(direction, places.values, load.force(places.values, direction, places.phi))

    @classmethod
    def spread(cls, motion: Motion, load: FollowerLoad, finer: int = 1) -> TurnPlaces:
        """Places all over the turn, ``finer`` times as many as usual, both ends of every piece among them."""
        phase, u0, u1 = smooth_pieces(motion)
        count = finer * max(MIN_PIECE_PLACES, min(PIECE_PLACES, TOTAL_PLACES // phase.size))
        share = (1 - np.cos(np.linspace(0, np.pi, count))) / 2
        u = u0[:, None] + (u1 - u0)[:, None] * share
        inside, last = motion.at(phase[:, None], u), motion.at(phase, u1, "left")
        for value, end in zip(inside, last, strict=True):
            value[:, -1] = end
        s, v, a, j = (value.ravel() for value in inside)
        every = np.repeat(phase, share.size)
        places = Places(every, u.ravel(), motion.angle_at(every, u.ravel()), (s, v, a, j))
        # A dwell is one place.
        return cls.of(motion, load, places.selected((motion.directions[every] != 0) | (u.ravel() == 0)))

    @classmethod
    def at_extremes(cls, stress: ContactStress) -> TurnPlaces:
        """The places where pressure angle, curvature and stress of one cam can have their exact extremes."""
        cam, load = stress.forces.cam, stress.forces.pressing
        kin, motion = cam.kinematics, cam.motion
        steep = stationary_places(motion, lambda places: kin.steepness(places.values))
        sharp = stationary_places(motion, lambda places: kin.curvature(places.values))
        stressed = stationary_places(motion, stress.squared_pressure, load.knots)
        first, *others = (cls.of(motion, load, places) for places in (steep, sharp, stressed))
        for other in others:
            first = first.joined(other)
        return first

    def joined(self, other: TurnPlaces) -> TurnPlaces:
        """The places together with others."""
        s, v, a, j = (np.concatenate(pair) for pair in zip(self.values, other.values, strict=True))
        direction = np.concatenate([self.direction, other.direction])
        return TurnPlaces(direction, (s, v, a, j), np.concatenate([self.load, other.load]))

    def selected(self, chosen: NDArray[np.bool_]) -> TurnPlaces:
        """The places that a mask chooses."""
        s, v, a, j = (value[chosen] for value in self.values)
        return TurnPlaces(self.direction[chosen], (s, v, a, j), self.load[chosen])


@dataclass(frozen=True, eq=False)
class Bearing:
    """Cams of some sizes at places of the turn; every array (..., n).

    steepness : |tan alpha|;  kappa : of the pitch curve [1/mm]
    pressed : the force that a permitted stress must bear [N]: that along the motion over cos alpha
    borne : what it bears of it, a millimetre of face [N/mm]; negative where the follower jams or undercuts
    """

    steepness: Floats
    kappa: Floats
    pressed: Floats
    borne: Floats

    @classmethod
    def of(cls, limits: SizingLimits, places: TurnPlaces, sizes: Sizes, sigma: int) -> Bearing:
        """The normal force is Q/(cos alpha - mu sin alpha): both sides of Hertz's formula times 1 - mu tan alpha."""
        kin = TranslatingKinematics(sigma, sizes.radius, sizes.offset)
        (along, across), _ = kin.pressure(places.values)
        kappa, slope = kin.curvature(places.values), across / along
        flatness = sizes.roller * (1 - kappa * sizes.roller)
        moved = 1 - kin.leaning * limits.friction * slope
        borne = math.pi * limits.stress**2 / limits.contact.modulus * flatness * moved
        # Two negatives would make a strong contact of an undercut one that jams.
        borne = np.where((flatness > 0) | (moved > 0), borne, -np.abs(borne))
        return cls(np.abs(slope), kappa, places.load * np.sqrt(1 + slope**2), borne)

    @property
    def width(self) -> Floats:
        """The width of the face [mm] at which the stress is the permitted one; infinite where no width bears it."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.borne > 0, np.maximum(self.pressed, 0) / self.borne, np.inf)


def margins(limits: SizingLimits, places: TurnPlaces, sizes: Sizes, sigma: int) -> dict[str, Floats]:
    """What is left of every limit at the places, as a part of it; inf where a pressure angle is not limited.

    returns : by the names of :data:`LIMITS`, each (..., n)
    """
    possible = (np.abs(sizes.offset) < sizes.radius) & (np.asarray(sizes.roller) < sizes.radius)
    if not np.all(possible):
        whole = replace(
            sizes, offset=np.where(possible, sizes.offset, 0.0), roller=np.where(possible, sizes.roller, 0.0)
        )
        left = margins(limits, places, whole, sigma)
        return {name: np.where(possible, margin, -1.0) for name, margin in left.items()}
    at = Bearing.of(limits, places, sizes, sigma)

    def angle(permitted: float | None, direction: int) -> Floats:
        """The margin (..., n) of a permitted pressure angle [rad] where the motion has that direction."""
        if permitted is None:
            return np.full_like(at.steepness, np.inf)
        return np.where(places.direction == direction, 1 - at.steepness / math.tan(permitted), np.inf)

    def roller(term: Candidate) -> Floats:
        """The margin (..., n) of one term of the rule."""
        if term.of == "rho":
            return 1 - (sizes.roller + term.margin) * at.kappa / term.factor
        return 1 - sizes.roller / (term.factor * sizes.radius) + np.zeros_like(at.kappa)

    def rule(of: str) -> Floats:
        """The smallest margin (..., n) of all terms of a kind."""
        terms = [term for term in (*limits.rule, NO_UNDERCUT_RULE) if term.of == of]
        return np.minimum.reduce([roller(term) for term in terms]) if terms else np.full_like(at.kappa, np.inf)

    return {
        RISE_LIMIT: angle(limits.rise, 1),
        RETURN_LIMIT: angle(limits.return_, -1),
        CURVATURE_LIMIT: rule("rho"),
        SHARE_LIMIT: rule("r0"),
        STRESS_LIMIT: (sizes.width * at.borne - at.pressed) / places.load.max(),
    }


Range = tuple[float, float]
Measure = Literal["prime radius", "base radius"]
"""The size of a cam: the least radius of its pitch curve, or of its profile, which is less by the roller."""
BINDING_SHARE = 1e-6
"""A limit binds, and a size stands at the end of its range, if they are this part of it apart."""


@dataclass(frozen=True)
class SizingProblem:
    """The ranges [mm] of a cam's sizes, its limits and its load; see :func:`~graphcam.size_cam`.

    radius : of what ``measure`` names
    """

    motion: Motion
    load: SpringLoad
    limits: SizingLimits
    radius: Range
    offset: Range
    roller_radius: Range
    width: Range
    rotation: Rotation
    measure: Measure = "prime radius"

    def __post_init__(self) -> None:
        sense(self.rotation)
        for name, (low, high) in self.ranges.items():
            positive = name == "offset" or low > 0
            if not (math.isfinite(low) and math.isfinite(high) and low <= high and positive):
                found = say("{low:g} to {high:g} mm", low=low, high=high)
                limit = say("from a size to one that is not smaller")
                raise DesignError(say("range of the {name}", name=name), found, limit)
        most = self.radius[1] + self._offset_radius(self.roller_radius[1])
        roller = 0.0 if self.measure == "base radius" else self.roller_radius[0]
        for quantity, least in (("offset", self._least_offset), (say("roller radius"), roller)):
            if not least < POSSIBLE_SHARE * most:
                limit = say("less than the maximum prime radius of {most:g} mm", most=most)
                found, remedy = say("from {least:g} mm on", least=least), say("no such cam could be made")
                raise DesignError(say("range of the {quantity}", quantity=quantity), found, limit, remedy)

    @property
    def _least_offset(self) -> float:
        """The least magnitude of an offset in its range [mm]."""
        low, high = self.offset
        return max(low, -high, 0.0)

    @property
    def radius_ends(self) -> Range:
        """The range of the radius [mm], from the least on with which some offset and some roller make a cam."""
        low, high = self.radius
        roller = self.roller_radius[0] / POSSIBLE_SHARE if self.measure == "prime radius" else 0.0
        offset = self._least_offset / POSSIBLE_SHARE - self._offset_radius(self.roller_radius[1])
        return min(max(low, roller, offset), high), high

    def at_shares(self, radius: Any, offset: Any, roller: Any, width: Any) -> Sizes:
        """The sizes at shares 0 to 1 of their ranges, as far as these make a cam; the width in mm."""
        low, high = self.radius_ends
        measured = low + radius * (high - low)
        low, high = self._roller_ends(measured)
        drawn = low + roller * (high - low)
        low, high = self._offset_ends(measured + self._offset_radius(drawn))
        return self.sizes(measured, low + offset * (high - low), drawn, width)

    def shares(self, sizes: Sizes) -> tuple[float, float, float]:
        """At which shares of the ranges sizes lie; 0 in a range that holds nothing else."""
        measured, offset, roller, _ = self.values(sizes)
        ends = self.radius_ends, self._offset_ends(sizes.radius), self._roller_ends(measured)
        found = [
            min(max((value - low) / (high - low), 0.0), 1.0) if high > low else 0.0
            for value, (low, high) in zip((measured, offset, roller), ends, strict=True)
        ]
        return found[0], found[1], found[2]

    def _roller_ends(self, measured: Any) -> tuple[Any, Any]:
        """The range of the roller [mm]: it is smaller than the prime radius."""
        low, high = self.roller_radius
        return (low, high) if self.measure == "base radius" else (low, np.minimum(high, POSSIBLE_SHARE * measured))

    def _offset_ends(self, prime_radius: Any) -> tuple[Any, Any]:
        """The range of the offset [mm]: it is smaller than the prime radius."""
        low, high = self.offset
        return np.maximum(low, -POSSIBLE_SHARE * prime_radius), np.minimum(high, POSSIBLE_SHARE * prime_radius)

    @property
    def ranges(self) -> dict[str, Range]:
        """The ranges by the names of the sizes, in the order of the search."""
        widths = self.roller_radius, self.width
        return {
            self.measure: self.radius,
            "offset": self.offset,
            **dict(zip(("roller radius", "face width"), widths, strict=True)),
        }

    def check_contact(self) -> None:
        """Check that the load keeps the follower on its cam.

        Raises
        ------
        DesignError : it does not
        """
        least = Contact(self.motion, self.load).min_force()
        if least.value < -BINDING_SHARE * abs(self.load.preload):
            limit = say("0 N or more, so that the follower stays on its cam")
            remedy = say("preload the spring: spring_preload(...) tells the minimum")
            raise DesignError(say("minimum contact force"), say("{value:.4g} N", value=least.value), limit, remedy)

    def sizes(self, radius: Any, offset: Any, roller: Any, width: Any) -> Sizes:
        """The sizes with a radius [mm] of what is measured."""
        return Sizes(radius + self._offset_radius(roller), offset, roller, width)

    def values(self, sizes: Sizes) -> tuple[float, float, float, float]:
        """The sizes in the order of the ranges."""
        return sizes.radius - self._offset_radius(sizes.roller), sizes.offset, sizes.roller, sizes.width

    def _offset_radius(self, roller: Any) -> Any:
        """The prime radius less what is measured [mm]."""
        return roller if self.measure == "base radius" else 0.0

    def stress(self, sizes: Sizes) -> ContactStress:
        """The contact stress of the exact cam."""
        cam = Cam(self.motion, Translating(sizes.offset, sizes.roller), sizes.radius, self.rotation)
        forces = CamForces(cam, self.load, friction=self.limits.friction)
        return ContactStress(forces, replace(self.limits.contact, width=sizes.width))

    def margins(self, places: TurnPlaces, sizes: Sizes) -> dict[str, Floats]:
        """What is left of every limit at places."""
        return margins(self.limits, places, sizes, sense(self.rotation))

    def needed_width(self, places: TurnPlaces, sizes: Sizes) -> Floats:
        """The face width [mm] that bears the load at places; infinite where none does."""
        return Bearing.of(self.limits, places, sizes, sense(self.rotation)).width

    def exact_margins(self, sizes: Sizes) -> dict[str, float]:
        """What is left of every limit, from the exact extremes."""
        left = self.margins(TurnPlaces.at_extremes(self.stress(sizes)), sizes)
        return {name: float(margin.min()) for name, margin in left.items()}

    def exact_width(self, sizes: Sizes) -> float:
        """The least face width [mm] of the exact cam, its greatest stress being the permitted one then."""
        return float(self.needed_width(TurnPlaces.at_extremes(self.stress(sizes)), sizes).max())

    def keeps(self, sizes: Sizes, slack: float = BINDING_SHARE) -> bool:
        """Whether the exact cam keeps all limits, but for a part of them."""
        return min(self.exact_margins(sizes).values()) >= -slack

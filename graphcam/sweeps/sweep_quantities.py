"""What a sweep can ask of its cams; every quantity is computed once at most, and only if it is asked for."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any, Literal, Self, get_args

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.follower import FOLLOWERS_BY_KIND, Limits
from graphcam.given.laws import Floats, LawName, law, law_of_return
from graphcam.given.making_errors import MakingErrors, deviations_within
from graphcam.given.motion_law import Law
from graphcam.given.spring_load import PlacedArmLoad
from graphcam.mechanism.followers import EXACT_FUNCTIONS
from graphcam.mechanism.kinematics import Kinematics, Values, pair_cross
from graphcam.mechanism.motion_bands import check_sizes, position_band, position_band_slope
from graphcam.sweeps.designs import OWN_SIZE_NAMES, Designs
from graphcam.sweeps.sweep_forces import SOUGHT_FORCES, Rubbing, SoughtForce, SweptLoad
from graphcam.sweeps.sweep_maxima import Legs, Numbers, SoughtQuantity, leg_maxima
from graphcam.words import say

Quantity = Literal[
    "max_pressure_angle_rise", "max_pressure_angle_return", "min_pitch_curvature_radius", "max_v", "max_a", "feasible"
]
QuantityOfErrors = Literal["position_band"]
QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)

JAMMING_QUANTITIES = "max_normal_force", "min_normal_force", "max_torque"
"""What does not exist where the follower jams."""


BAND_QUANTITIES: tuple[QuantityOfErrors, ...] = get_args(QuantityOfErrors)


@dataclass(frozen=True)
class SweptErrors:
    """The tolerances to which all cams of a sweep are made, and the part of all mechanisms that a band holds.

    Raises
    ------
    DesignError : the part is not between 0 and 1
    """

    errors: MakingErrors
    coverage: float

    def __post_init__(self) -> None:
        _ = self.band_half_width

    @property
    def band_half_width(self) -> float:
        """How many standard deviations a band holds on either side."""
        return deviations_within(self.coverage)

    def check(self, kin: Kinematics, roller: Any) -> None:
        """Check that the followers have the sizes with a tolerance."""
        check_sizes(kin, self.errors)
        if self.errors.roller_diameter and not np.all(np.asarray(roller) > 0):
            limit = say("left out where a follower has a knife edge")
            remedy = say("or give every follower a roller_radius")
            raise DesignError("roller_diameter", self.errors.roller_diameter, limit, remedy)


@dataclass(frozen=True, eq=False)
class SoughtBand(SoughtQuantity):
    """The half-width of the band of s [mm; rad of an arm], to the first order."""

    swept: SweptErrors

    def part(self, which: Numbers | slice) -> Self:
        """The band of some of the cams."""
        return type(self)(self.kin.part(which), self.swept)

    def reading(self, values: Values) -> Floats:
        """The half-width of the band."""
        return position_band(self.kin, self.swept.errors, self.swept.band_half_width, values)

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """The half-width, and what has the sign of its derivative."""
        slope = position_band_slope(self.kin, self.swept.errors, self.swept.band_half_width, values)
        return self.reading(values), slope


class Steepness(SoughtQuantity):
    """tan(alpha), which grows with the pressure angle."""

    signed = True

    def reading(self, values: Values) -> Floats:
        """The tangent of the pressure angle."""
        return self.kin.steepness(values)

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """tan(alpha), and what has the sign of alpha'."""
        q, q1 = self.kin.pressure(values)
        return np.divide(q[1], q[0]), pair_cross(q, q1)


class Sharpness(SoughtQuantity):
    """What is greatest where the radius of curvature is least: the curvature of the pitch curve, or -rho."""

    def reading(self, values: Values) -> Floats:
        """kappa [1/mm], or -rho [mm] of a flat face's cam."""
        return self.kin.sharpness(values)

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """The curvature, and what has the sign of kappa'."""
        return self.kin.sharpness_and_slope(values)


@dataclass(frozen=True, eq=False)
class Chunk:
    """Some designs and their quantities by the names of :data:`QUANTITIES`; each is (n,), NaN where there is no cam."""

    designs: Designs
    limits: Limits
    swept: SweptLoad | None = None
    made: SweptErrors | None = None

    @cached_property
    def position_band(self) -> Floats:
        """The greatest half-width of the band of s [mm; of an arm rad] as the cams are made."""
        assert self.made is not None
        sought = SoughtBand(self.all_kinematics, self.made)
        found = np.maximum(self._over_legs(sought, self._rises), self._over_legs(sought, self._returns))
        for level, angle in self._dwells:
            still = np.zeros_like(level)
            found = np.maximum(found, np.where(angle > 0, sought.reading((level, still, still, still)), -np.inf))
        return found

    def under_load(self, name: str) -> Floats:
        """A quantity of the forces, by its name among :data:`FORCES`; NaN where the follower jams somewhere."""
        assert self.swept is not None
        kind, sign = SOUGHT_FORCES[name]
        found = self._greatest_force(kind)
        if name in JAMMING_QUANTITIES:
            found = np.where(self._moves, found, np.nan)
        return sign * found

    def _greatest_force(self, kind: type[SoughtForce]) -> Floats:
        assert self.swept is not None
        found = np.full(len(self.designs), -np.inf)
        for legs in (self._rises, self._returns):
            sought = kind(self.all_kinematics, self.swept, self.designs.column("roller_radius"), legs[1])
            found = np.maximum(found, self._over_legs(sought, legs))
        for level, angle in self._dwells:
            found = np.maximum(found, np.where(angle > 0, sought.at_rest(level), -np.inf))
        placed = self.swept.load_for(self.all_kinematics)
        if isinstance(placed, PlacedArmLoad):
            found = np.where(placed.presses(self._lift), found, np.nan)
        return found

    @cached_property
    def _moves(self) -> NDArray[np.bool_]:
        """Flags of the cams whose follower jams nowhere."""
        assert self.swept is not None
        friction, kin, roller = self.swept.friction, self.all_kinematics, self.designs.column("roller_radius")
        steep = kin.steepest(self._lift, self.max_v)
        moves = friction * (steep + kin.rim(roller) * np.sqrt(1 + steep * steep)) < 1
        # What this does not prove is sought: few of the cams that one would build.
        (doubtful,) = np.nonzero(~moves & ~np.isnan(steep))
        if friction and doubtful.size:
            some = Chunk(self.designs.part(doubtful), self.limits, self.swept)
            moves[doubtful] = friction * some._greatest_force(Rubbing) < 1
        return moves

    @property
    def _dwells(self) -> tuple[tuple[Floats, Floats], ...]:
        return (self._lift, self.designs.column("dwell_angle")), (0 * self._lift, self.designs.low_dwell)

    @cached_property
    def max_pressure_angle_rise(self) -> Floats:
        """The pressure angle of greatest magnitude on the rise [rad], signed."""
        return self._pressure_angle(self._rises)

    @cached_property
    def max_pressure_angle_return(self) -> Floats:
        """The pressure angle of greatest magnitude on the return [rad], signed."""
        return self._pressure_angle(self._returns)

    @cached_property
    def min_pitch_curvature_radius(self) -> Floats:
        """The least radius of curvature of the convex parts of the pitch curve [mm]; signed under a flat face."""
        sharpest = self._over_legs(self._sharpness, self._rises)
        sharpest = np.maximum(sharpest, self._over_legs(self._sharpness, self._returns))
        for level, angle in self._dwells:
            still = np.zeros_like(level)
            resting = np.where(angle > 0, self._sharpness.reading((level, still, still, still)), -np.inf)
            sharpest = np.maximum(sharpest, resting)
        return self.all_kinematics.radius_of(sharpest)

    @cached_property
    def max_v(self) -> Floats:
        """The greatest |v| [mm/rad], of an arm [rad/rad]: C_v h/F."""
        return self._peak(lambda law: law.peak_velocity, 1)

    @cached_property
    def max_a(self) -> Floats:
        """The greatest |a|, of both sides of a jump [mm/rad^2], of an arm [rad/rad^2]: C_a h/F^2."""
        return self._peak(lambda law: law.peak_acceleration, 2)

    @cached_property
    def feasible(self) -> NDArray[np.bool_]:
        """Whether there is such a cam, its pressure angles are permitted and its profile is not undercut."""
        limits, roller = self.limits, self.designs.column("roller_radius")
        sound = (roller >= 0) & (roller < self._prime_radius) & (roller < self.min_pitch_curvature_radius)
        if limits.curvature is not None:
            sound &= self.min_pitch_curvature_radius - roller >= limits.curvature
        sound &= np.abs(self.max_pressure_angle_rise) <= limits.rise
        return sound if limits.return_ is None else sound & (np.abs(self.max_pressure_angle_return) <= limits.return_)

    @cached_property
    def _lift(self) -> Floats:
        return np.where(self.designs.possible, self.designs.column("lift"), np.nan)

    @cached_property
    def _prime_radius(self) -> Floats:
        r0 = self.designs.column("prime_radius")
        return np.where((np.abs(self.designs.column("offset")) < r0) & (r0 < np.inf), r0, np.nan)

    @cached_property
    def _sharpness(self) -> Sharpness:
        return Sharpness(self.all_kinematics)

    @cached_property
    def all_kinematics(self) -> Kinematics:
        """The kinematics of all of them."""
        designs, kind = self.designs, EXACT_FUNCTIONS[FOLLOWERS_BY_KIND[self.designs.follower]].kinematics
        lift = np.where(self._speed_with_cam < kind.max_speed_with_cam, self._lift, np.nan)
        sizes = SimpleNamespace(**{name: designs.column(name) for name in OWN_SIZE_NAMES[designs.follower]})
        return kind.of(sizes, self._prime_radius, designs.sigma, lift)

    @property
    def _speed_with_cam(self) -> Floats:
        """The greatest |v| of the motion in the sense of the cam: on its return, or clockwise on its rise."""
        rise, back = self._peaks(lambda law: law.peak_velocity, 1)
        return np.where(self.designs.sigma > 0, back, rise)

    @property
    def _rises(self) -> tuple[str, int, Floats]:
        return "rise_law", +1, self.designs.column("rise_angle")

    @property
    def _returns(self) -> tuple[str, int, Floats]:
        return "return_law", -1, self.designs.column("return_angle")

    def _pressure_angle(self, legs: tuple[str, int, Floats]) -> Floats:
        if not self.all_kinematics.has_pressure_angle:
            return 0 * self._lift * self._prime_radius  # the face is perpendicular to the motion
        return np.arctan(self._over_legs(Steepness(self.all_kinematics), legs))

    def _over_legs(self, sought: SoughtQuantity, legs: tuple[str, int, Floats]) -> Floats:
        key, direction, angle = legs
        out = np.full(len(self.designs), np.nan)
        for each, which in self._laws[key]:
            out[which] = leg_maxima(sought.part(which), Legs(each, direction, self._lift[which], angle[which]))
        return out

    @cached_property
    def _laws(self) -> dict[str, list[tuple[Law, Numbers | slice]]]:
        """The laws of rises and returns that occur, as seen from the low end, and whose they are."""
        up, down = (np.asarray(laws) for laws in (self.designs.rise_law, self.designs.return_law))
        rises, returns = _by_law(up, law), _by_law(down, law_of_return)
        return {"rise_law": rises, "return_law": [(each.reversed, which) for each, which in returns]}

    def _peak(self, coefficient: Callable[[Law], float], power: int) -> Floats:
        return self._peaks(coefficient, power).max(axis=0)

    def _peaks(self, coefficient: Callable[[Law], float], power: int) -> Floats:
        """(2, n) the greatest magnitudes of a derivative on the rises, and on the returns."""
        peaks = np.empty((2, len(self.designs)))
        for row, (key, _, angle) in zip(peaks, (self._rises, self._returns), strict=True):
            for each, which in self._laws[key]:
                row[which] = coefficient(each) * self._lift[which] / angle[which] ** power
        return peaks


def _by_law(laws: NDArray[Any], named: Callable[[LawName | Law], Law]) -> list[tuple[Law, Numbers | slice]]:
    """The laws, and which of the designs follow each."""
    if laws.ndim == 0:
        return [(named(laws.item()), slice(None))]
    return [(named(each), np.flatnonzero(laws == each)) for each in dict.fromkeys(laws.tolist())]

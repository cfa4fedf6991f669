"""The forces of many cams under one load: greatest and least normal force, torque, least preload, jamming."""

from dataclasses import dataclass, replace
from typing import Any, Literal, Self, get_args

import numpy as np

from graphcam.errors import DesignError, check_kind
from graphcam.given.laws import Floats
from graphcam.given.spring_load import ArmLoad, FollowerLoad, LoadCurve, SpringLoad
from graphcam.mechanism.forces import check_friction, lever_about_cam, transmitted
from graphcam.mechanism.kinematics import Kinematics, Values, pair_cross
from graphcam.sweeps.sweep_maxima import Numbers, SoughtQuantity
from graphcam.words import say


@dataclass(frozen=True)
class SweptLoad:
    """What presses the followers of all cams of a sweep, and the friction between cam and follower.

    Raises
    ------
    DesignError : the load depends on the cam angle, does not fit the follower, or the friction is negative
    """

    load: SpringLoad | ArmLoad
    friction: float = 0.0

    def __post_init__(self) -> None:
        check_friction(self.friction)
        check_kind("load", self.load, (SpringLoad, ArmLoad))
        if isinstance(self.load.load, LoadCurve):
            found = say("a table over the turn")
            raise DesignError("load", found, say("a number in a sweep"), say("the cams have other phases"))

    def load_for(self, kin: Kinematics) -> FollowerLoad:
        """The load beside each of many cams."""
        return kin.pressed_by(self.load)


@dataclass(frozen=True, eq=False)
class SoughtForce(SoughtQuantity):
    """A quantity of the forces, of many cams with rollers [mm], on rises (direction 1) or returns (-1)."""

    swept: SweptLoad
    roller: Any
    direction: int

    def part(self, which: Numbers | slice) -> Self:
        """The force of some of the cams."""
        return replace(self, kin=self.kin.part(which), roller=self.roller[which])

    def at_rest(self, level: Floats) -> Floats:
        """The quantity in a dwell at a displacement, (n,), without the friction in the guide."""
        still = np.zeros_like(level)
        return replace(self, direction=0).reading((level, still, still, still))

    def _load(self, values: Values) -> tuple[Floats, Floats]:
        load = self.swept.load_for(self.kin)
        return load.force(values, self.direction), load.slope(values)

    def _moving_force(self, values: Values) -> tuple[Floats, Floats]:
        """What a unit of normal force moves, and its slope; NaN where the follower jams."""
        moved, slope = transmitted(self.kin, values, self.swept.friction, self.roller)
        reach, reach_slope = self.kin.reach(values)
        return reach * np.where(moved > 0, moved, np.nan), reach * slope + reach_slope * moved

    def _part(self, values: Values) -> tuple[Floats, Floats]:
        """What a unit of normal force moves, times |q| over the reach, and |q|: one root for each place."""
        along, across = self.kin.seen(values)
        lean = self.kin.leaning * self.swept.friction
        size = np.sqrt(along * along + across * across)
        return np.subtract(along, lean * (across - self.kin.rim(self.roller) * size)), size

    def _normal(self, values: Values) -> Floats:
        """The normal force [N], without its slope; NaN where the follower jams."""
        moved, size = self._part(values)
        force = self.swept.load_for(self.kin).force(values, self.direction) / self.kin.reach(values)[0]
        return force * size / np.where(moved > 0, moved, np.nan)


class GreatestNormal(SoughtForce):
    """The normal force [N]."""

    def reading(self, values: Values) -> Floats:
        """The normal force N [N]."""
        return self._normal(values)

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """N = Q/D, and what has the sign of N'."""
        (q, q_slope), (d, d_slope) = self._load(values), self._moving_force(values)
        return q / d, q_slope * d - q * d_slope


class LeastNormal(GreatestNormal):
    """The negative normal force [N], which is greatest where the force is least."""

    def reading(self, values: Values) -> Floats:
        """The negative normal force -N [N]."""
        return -self._normal(values)

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """-N, and what has the sign of its slope."""
        value, slope = super().with_slope(values)
        return -value, -slope


class GreatestTorque(SoughtForce):
    """The torque that drives the cam [N mm]."""

    def reading(self, values: Values) -> Floats:
        """M = Q v + mu N w, with w the speed of sliding."""
        passed = self.swept.load_for(self.kin).force(values, self.direction) * values[1]
        if not self.swept.friction:
            return passed
        return passed + self.swept.friction * self._normal(values) * self.kin.sliding(values, self.roller)[0]

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """M, and its slope."""
        (q, q_slope), (d, d_slope) = self._load(values), self._moving_force(values)
        lever, lever_slope = lever_about_cam(self.kin, values, self.swept.friction, self.roller)
        normal = q / d
        return normal * lever, (q_slope - normal * d_slope) / d * lever + normal * lever_slope


class NeededPreload(SoughtForce):
    """The preload that is needed at a place [N, or N mm of a torsion spring]."""

    def reading(self, values: Values) -> Floats:
        """F0 less the load over its lever."""
        load = self.swept.load_for(self.kin)
        return load.preload - load.force(values, self.direction) / load.leverage(values)[0]

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """The needed preload, and what has the sign of its slope."""
        (q, q_slope), (w, w_slope) = self._load(values), self.swept.load_for(self.kin).leverage(values)
        return self.swept.load.preload - q / w, q * w_slope - q_slope * w


class Jamming(SoughtForce):
    """The negative transmission coefficient, which is greatest where it is least."""

    def reading(self, values: Values) -> Floats:
        """mu sin(alpha) - cos(alpha)."""
        moved, size = self._part(values)
        return -moved / size

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """The reading, and what has the sign of its slope, (sin(alpha) + mu cos(alpha)) alpha'."""
        q, q1 = self.kin.pressure(values)
        return self.reading(values), (q[1] + self.kin.leaning * self.swept.friction * q[0]) * pair_cross(q, q1)


class Rubbing(SoughtForce):
    """tan(alpha), of an arm (sin(alpha) - r/l)/cos(alpha) with the sign of the friction: the follower jams at 1/mu."""

    def reading(self, values: Values) -> Floats:
        """The friction over the force that moves, for mu = 1."""
        along, across = self.kin.seen(values)
        rim = self.kin.rim(self.roller) * np.sqrt(along * along + across * across)
        return self.kin.leaning * (across - rim) / along

    def with_slope(self, values: Values) -> tuple[Floats, Floats]:
        """The reading, and what has the sign of its slope, alpha' (1 - r/l sin(alpha))."""
        q, q1 = self.kin.pressure(values)
        left = np.sqrt(q[0] * q[0] + q[1] * q[1]) - self.kin.rim(self.roller) * q[1]
        return self.reading(values), self.kin.leaning * pair_cross(q, q1) * left


QuantityUnderLoad = Literal["max_normal_force", "min_normal_force", "max_torque", "least_preload", "jamming_margin"]
SOUGHT_FORCES: dict[str, tuple[type[SoughtForce], int]] = {
    "max_normal_force": (GreatestNormal, 1),
    "min_normal_force": (LeastNormal, -1),
    "max_torque": (GreatestTorque, 1),
    "least_preload": (NeededPreload, 1),
    "jamming_margin": (Jamming, -1),
}
"""What is sought for each of :data:`FORCE_QUANTITIES`, and the sign with which its greatest value is the quantity."""
FORCE_QUANTITIES: tuple[QuantityUnderLoad, ...] = get_args(QuantityUnderLoad)
"""What a sweep can find under a load."""

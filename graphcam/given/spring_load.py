"""What presses a follower on its cam: its inertia, a spring, a load, friction in the guide of one that slides.

Source: I. Voloder, M. Cohodar, S. Karic, *Annals of DAAAM* (2007): contact is kept while m (a omega^2 + v eps) + F0 +
c s is not negative.

Along the motion means in the direction in which the coordinate s shrinks: of a follower that slides a force in N, of an
arm, whose s is an angle, a torque about its pivot in N mm.

What presses an arm turns it about its pivot, towards the cam, with the torque

    M = J (a omega^2 + v eps) + M_spring + d v omega + l P

of the inertia J about the pivot, of damping, and of a load P at the arm's end, along its path.  A torsion spring has
M_spring = F0 + c s, with F0 in N mm and c in N mm/rad.  A spring between a point of the arm and an anchor in the frame
has the length L(s); with x = L - L(0), or L(0) - L of one that is pressed together as the arm rises, its force is F0 +
c x, and by virtual work M_spring = (F0 + c x) dx/ds.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, Protocol

import numpy as np

from graphcam.errors import DesignError, check_kind, check_number
from graphcam.given.follower import MM_PER_M, omega_of
from graphcam.given.laws import Floats
from graphcam.given.motion import CLOSURE_TOLERANCE, FULL_TURN, wrap
from graphcam.given.plausible_ranges import NUMBER_TYPES, bounded
from graphcam.words import Words, say

# --- a load over the turn --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class LoadCurve:
    """A load that depends on the cam angle; between two rows it is linear.

    phi : (n,) cam angles [rad], each greater than the one before, from 0 to a full turn
    force : (n,) the load there [N], positive where it presses the follower on the cam; the last as the first

    Raises
    ------
    DesignError : of the quantity ``load``: the rows do not cover the turn, are out of order, or do not close

    >>> import graphcam as gc
    >>> from math import radians
    >>> press = gc.LoadCurve(np.radians([0, 90, 100, 360]), [20, 20, 120, 20])
    >>> press(np.radians([45, 95, 360])).round(9).tolist()
    [20.0, 70.0, 20.0]
    """

    phi: Sequence[float]
    force: Sequence[float]

    def __post_init__(self) -> None:
        phi, force = (tuple(np.asarray(each, dtype=np.float64).ravel().tolist()) for each in (self.phi, self.force))
        object.__setattr__(self, "phi", phi)
        object.__setattr__(self, "force", force)
        if len(phi) != len(force) or not all(map(math.isfinite, (*phi, *force))):
            found = say("a table of {phi} angles and {force} loads", phi=len(phi), force=len(force))
            raise DesignError("load", found, say("rows of finite numbers"))
        if len(phi) < 2 or abs(phi[0]) > CLOSURE_TOLERANCE or abs(phi[-1] - FULL_TURN) > CLOSURE_TOLERANCE:
            covered = say("without a row")
            if phi:
                covered = say("from {degrees} to {degrees2}", degrees=_degrees(phi[0]), degrees2=_degrees(phi[-1]))
            remedy = say("begin the table with a row at 0 degrees and end it with one at 360")
            found = say("a table {covered}", covered=covered)
            raise DesignError("load", found, say("a table that covers the turn, from 0 to 360 degrees"), remedy)
        for before, after in pairwise(phi):
            if not before < after:
                found = say(
                    "a table with {degrees} after {degrees2}", degrees=_degrees(after), degrees2=_degrees(before)
                )
                remedy = say("a jump is a steep line between two rows that lie close together")
                raise DesignError("load", found, say("a table whose angles grow from row to row"), remedy)
        if not math.isclose(force[0], force[-1], rel_tol=CLOSURE_TOLERANCE, abs_tol=CLOSURE_TOLERANCE):
            found = say("{force:g} N at 0 degrees and {force2:g} N at 360", force=force[0], force2=force[-1])
            remedy = say("a turn ends as the next begins")
            raise DesignError("load", found, say("the same at both"), remedy)

    def __call__(self, phi: Floats | float) -> Floats:
        """The load [N] at cam angles [rad], any real numbers; NaN for NaN."""
        return np.interp(wrap(phi), self.phi, self.force)


Load = float | LoadCurve
"""A load along the motion: the same over the turn [N], or one that depends on the cam angle."""


def load_at(load: Load, phi: Floats | float) -> Floats | float:
    """A load [N] at cam angles [rad]."""
    return load(phi) if isinstance(load, LoadCurve) else load


def knots_of(load: Load) -> tuple[float, ...]:
    """The cam angles [rad] at which the load's slope may jump."""
    return tuple(load.phi) if isinstance(load, LoadCurve) else ()


def check_load(load: Load) -> None:
    """Check that a load of one number is finite.

    Raises
    ------
    DesignError : it is not
    """
    if not isinstance(load, LoadCurve):
        check_number("load", load, say("a finite number of N, or a table over the turn"))


def largest(load: Load) -> float:
    """The maximum magnitude of a load [N].

    >>> largest(-3.0)
    3.0
    """
    return max(map(abs, load.force)) if isinstance(load, LoadCurve) else abs(load)


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.6g} degrees"


# --- springs and loads -----------------------------------------------------------------------------------------------

Values = tuple[Floats, Floats, Floats, Floats]
"""(s, v, a, j)"""


class FollowerLoad(Protocol):
    """A load on a follower, as it stands beside its cam."""

    @property
    def preload(self) -> float:
        """The preload of the spring at the lowest place."""
        ...

    @property
    def knots(self) -> tuple[float, ...]:
        """The cam angles [rad] inside a phase at which the force's slope may jump."""
        ...

    def force(self, values: Values, direction: Floats | float = 0.0, phi: Floats | float = ...) -> Floats:
        """The force along the motion [N; of an arm N mm] that the cam must bear, from (s, v, a, j).

        direction : +1 on a rise, -1 on a return, 0 in a dwell;  phi : cam angles [rad], for a load that depends on them
        returns : negative where the cam would have to pull
        """
        ...

    def slope(self, values: Values) -> Floats:
        """The derivative of the load by phi inside a phase, under a load that is the same over the turn."""
        ...

    def size(self, values: Values) -> Floats:
        """The sum of the magnitudes of its terms: what its rounding is a part of."""
        ...

    def leverage(self, values: Values) -> tuple[Floats, Floats]:
        """How much the force grows with the spring's preload, and the derivative of that by phi."""
        ...


@dataclass(frozen=True)
class SpringLoad:
    """The load along the motion of a follower that slides: F = m (a omega^2 + v eps) + F0 + c s + d v omega + P, in N.

    mass : of the follower and all that moves with it [kg]
    speed_rpm : of the cam at the instant [rpm];  acceleration : eps of the cam at the instant [rad/s^2], 0 at a
        constant speed
    stiffness : c of the spring [N/mm];  preload : F0 in the lowest position [N], with a constant load of the follower
    friction : in the guide [N], whatever the side force: it acts against the motion, so it loads the cam on a rise and
        is relieved of it on a return
    load : P, a further force on the follower [N], positive towards the cam: a number, or a
        :class:`~graphcam.LoadCurve` over the turn
    damping : d, the force against the motion over its speed [N s/m]

    Raises
    ------
    DesignError : a value is negative where it cannot be, or not finite

    >>> import numpy as np
    >>> import graphcam as gc
    >>> load = gc.SpringLoad(mass=0.2, speed_rpm=550, stiffness=3, preload=80)
    >>> rest = np.zeros(1)
    >>> load.force((rest, rest, rest, rest)).tolist()
    [80.0]
    """

    mass: float
    speed_rpm: float
    stiffness: float
    preload: float = 0.0
    acceleration: float = 0.0
    friction: float = 0.0
    load: Load = 0.0
    damping: float = 0.0

    def __post_init__(self) -> None:
        units = {"mass": "kg", "speed_rpm": "rpm", "stiffness": "N/mm", "friction": "N", "damping": say("N s/m")}
        _check_numbers(self, units, "N")

    @property
    def omega(self) -> float:
        """Speed of the cam [rad/s]."""
        return omega_of(self.speed_rpm)

    @property
    def knots(self) -> tuple[float, ...]:
        """The cam angles [rad] at which the load's slope may jump inside a phase."""
        return knots_of(self.load)

    def force(self, values: Values, direction: Floats | float = 0.0, phi: Floats | float = math.nan) -> Floats:
        """The force [N] that the cam must bear along the motion, from (s, v, a, j).

        direction : +1 on a rise, -1 on a return, 0 in a dwell, where the friction may act either way
        phi : cam angles [rad], for a load that depends on them
        returns : negative where the cam would have to pull
        """
        s, v, a, _ = values
        moving = (self.mass * (a * self.omega**2 + v * self.acceleration) + self.damping * v * self.omega) / MM_PER_M
        return moving + self.preload + self.stiffness * s + self.friction * direction + load_at(self.load, phi)

    def slope(self, values: Values) -> Floats:
        """dF/dphi [N/rad] inside a phase, from (s, v, a, j), under a load that is the same over the turn."""
        _, v, a, j = values
        moving = (self.mass * (j * self.omega**2 + a * self.acceleration) + self.damping * a * self.omega) / MM_PER_M
        return moving + self.stiffness * v

    def size(self, values: Values) -> Floats:
        """The sum of the magnitudes of the force's terms [N], to which its rounding is relative."""
        s, v, a, _ = values
        inertia = self.mass * (abs(a) * self.omega**2 + abs(v * self.acceleration))
        moving = (inertia + self.damping * abs(v) * self.omega) / MM_PER_M
        return moving + abs(self.preload) + self.stiffness * s + self.friction + largest(self.load)

    def leverage(self, values: Values) -> tuple[Floats, Floats]:
        """1 and 0: the spring acts along the motion."""
        return np.ones_like(values[0]), np.zeros_like(values[0])


@dataclass(frozen=True)
class Guide:
    """Two bearings in which the stem of a translating follower slides.

    friction : mu, the coefficient of friction between stem and bearing
    overhang : b, from the roller's centre up to the nearer bearing with the follower in its lowest position [mm]
    length : l, from the nearer bearing to the farther one [mm]

    Raises
    ------
    DesignError : a value is negative or not finite, or the bearings are not apart

    >>> import graphcam as gc
    >>> gc.Guide(friction=0.1, overhang=40, length=80)
    Guide(friction=0.1, overhang=40, length=80)
    """

    friction: float
    overhang: float
    length: float

    def __post_init__(self) -> None:
        for quantity, unit in (("friction", ""), ("overhang", say(" mm"))):
            limit = say("a finite number of 0{unit} or more", unit=unit)
            check_number(quantity, getattr(self, quantity), limit, least=0)
        check_number("length", self.length, say("a finite number greater than 0 mm"), above=0)


DEAD_POINT_ANGLE = 1e-9
"""A spring that is so near to its dead point [rad] turns nothing."""


@dataclass(frozen=True)
class ArmSpring:
    """Where a spring acts on an arm: between a point of the arm and an anchor in the frame.

    arm : distance of the point from the pivot, on the line to the arm's end [mm]; negative on the far side of the pivot
    anchor : (x, y) of the other end in the frame [mm]; the cam centre is (0, 0), the pivot (distance, 0)

    Raises
    ------
    DesignError : a size is not finite, or the spring acts on the pivot

    >>> import graphcam as gc
    >>> gc.ArmSpring(arm=60, anchor=(90, -40))
    ArmSpring(arm=60, anchor=(90, -40))
    """

    arm: float
    anchor: tuple[float, float]

    def __post_init__(self) -> None:
        if not (math.isfinite(self.arm) and self.arm != 0):
            limit = say("a finite length in mm, other than 0")
            raise DesignError("at.arm", self.arm, limit, say("at the pivot it turns nothing"))
        if len(self.anchor) != 2 or not all(map(math.isfinite, self.anchor)):
            raise DesignError("at.anchor", self.anchor, say("two finite coordinates in mm"))


@dataclass(frozen=True)
class ArmLoad:
    """The load on an oscillating follower, as a torque about its pivot.

    inertia : J of the arm and all that swings with it, about the pivot [kg mm^2]
    speed_rpm : of the cam at the instant [rpm];  acceleration : eps of the cam at the instant [rad/s^2]
    stiffness : c, of a torsion spring [N mm/rad], of a spring at a point [N/mm]
    preload : F0 in the lowest position, of a torsion spring [N mm], of a spring at a point [N]
    load : P, the force on the arm's end along its path [N], positive towards the cam: a number, or a
        :class:`~graphcam.LoadCurve` over the turn
    at : where a spring at a point acts; None for a torsion spring about the pivot
    damping : d, the torque about the pivot against the motion over its angular speed [N mm s/rad]

    Raises
    ------
    DesignError : a value is negative where it cannot be, or not finite

    >>> import graphcam as gc
    >>> gc.ArmLoad(inertia=900, speed_rpm=300, stiffness=4000, preload=500).at is None
    True
    """

    inertia: float
    speed_rpm: float
    stiffness: float
    preload: float = 0.0
    acceleration: float = 0.0
    load: Load = 0.0
    at: ArmSpring | None = None
    damping: float = 0.0

    def __post_init__(self) -> None:
        per = "N mm/rad" if self.at is None else "N/mm"
        units = {"inertia": say("kg mm^2"), "speed_rpm": "rpm", "stiffness": per, "damping": say("N mm s/rad")}
        _check_numbers(self, units, self.preload_unit)

    @property
    def preload_unit(self) -> str:
        """What the preload is measured in."""
        return "N mm" if self.at is None else "N"

    @property
    def omega(self) -> float:
        """Speed of the cam [rad/s]."""
        return omega_of(self.speed_rpm)


@dataclass(frozen=True, eq=False)
class PlacedArmLoad:
    """A load on an arm beside its cam: a torque about the pivot [N mm], positive towards the cam.

    arm, distance : l and c [mm];  psi0 : angle between arm and line of centres at the lower dwell [rad]; each may
        be an array, of many arms at once
    """

    given: ArmLoad
    arm: Any
    distance: Any
    psi0: Any

    @property
    def preload(self) -> float:
        """The preload of the spring in the lowest position [N mm, or N of a spring at a point]."""
        return self.given.preload

    @property
    def knots(self) -> tuple[float, ...]:
        """The cam angles [rad] at which the load's slope may jump inside a phase."""
        return knots_of(self.given.load)

    def force(self, values: Values, direction: Floats | float = 0.0, phi: Floats | float = math.nan) -> Floats:
        """The torque [N mm] that the cam must bear, from (s, v, a, j); the pivot is without friction."""
        _, v, a, _ = values
        given, (x, x1, _) = self.given, self._spring(values)
        moving = given.inertia / MM_PER_M * (a * given.omega**2 + v * given.acceleration)
        moving = moving + given.damping * v * given.omega
        return moving + (given.preload + given.stiffness * x) * x1 + self.arm * load_at(given.load, phi)

    def slope(self, values: Values) -> Floats:
        """The derivative by phi inside a phase [N mm/rad], under a load that is the same over the turn."""
        _, v, a, j = values
        given, (x, x1, x2) = self.given, self._spring(values)
        inertia = given.inertia / MM_PER_M * (j * given.omega**2 + a * given.acceleration)
        spring = given.stiffness * x1 * x1 + (given.preload + given.stiffness * x) * x2
        return inertia + given.damping * a * given.omega + spring * v

    def size(self, values: Values) -> Floats:
        """The sum of the magnitudes of the torque's terms [N mm]."""
        _, v, a, _ = values
        given, (x, x1, _) = self.given, self._spring(values)
        moving = given.inertia / MM_PER_M * (abs(a) * given.omega**2 + abs(v * given.acceleration))
        moving = moving + given.damping * abs(v) * given.omega
        return moving + (abs(given.preload) + given.stiffness * abs(x)) * abs(x1) + self.arm * largest(given.load)

    def leverage(self, values: Values) -> tuple[Floats, Floats]:
        """dx/ds, the lever of a spring at a point [mm], 1 of a torsion spring; and its derivative by phi."""
        _, x1, x2 = self._spring(values)
        return x1, x2 * values[1]

    def spring_force(self, values: Values) -> Floats:
        """F0 + c x of the spring [N], or [N mm] of a torsion spring."""
        return self.given.preload + self.given.stiffness * self._spring(values)[0]

    def check(self, swing: float) -> None:
        """Check that a spring at a point presses the arm on the cam over the whole swing [rad]."""
        if self.given.at is None or self.presses(swing):
            return
        if self._anchor == 0:
            remedy = say("anchor the spring beside the pivot")
            found = say("at the pivot")
            raise DesignError("at.anchor", found, say("elsewhere, for there the spring turns nothing"), remedy)
        limit = say("beside the line on which the spring passes over the pivot, after {degrees:.4g} degrees")
        limit = limit.with_values(degrees=math.degrees(self._left))
        remedy = say("move the anchor round the pivot, or the spring's point to the other side of it")
        anchor = say("({anchor:g}, {anchor2:g})", anchor=self.given.at.anchor[0], anchor2=self.given.at.anchor[1])
        raise DesignError("at.anchor", anchor, limit, remedy)

    def presses(self, swing: Any) -> Any:
        """Whether the spring turns the arm towards the cam over the whole swing [rad]."""
        return self.given.at is None or (np.abs(self._anchor) > 0) & (self._left > swing + DEAD_POINT_ANGLE)

    @property
    def _left(self) -> Any:
        """How far the arm swings until the spring's point, the pivot and the anchor lie on one line [rad]."""
        turned = np.mod(np.angle(self._anchor) + self.psi0, math.pi)
        return np.where(turned < DEAD_POINT_ANGLE, 0.0, math.pi - turned)[()]

    @cached_property
    def _anchor(self) -> Any:
        """The anchor seen from the pivot, turned so that the spring's point lies at psi0 = 0 on the positive axis."""
        at = self.given.at
        assert at is not None
        return -(complex(*at.anchor) - self.distance)

    def _spring(self, values: Values) -> tuple[Floats, Floats, Floats]:
        """x, dx/ds and d2x/ds2 of the spring."""
        s, at = values[0], self.given.at
        if at is None:
            return s, np.ones_like(s), np.zeros_like(s)
        # From the pivot the point is -b exp(-i psi): with the anchor at -r exp(i beta) the angle between is psi + beta.
        b, r = at.arm, np.abs(self._anchor)
        start = self.psi0 + np.angle(self._anchor)
        angle, low = start + s, np.sqrt(b * b + r * r - 2 * b * r * np.cos(start))
        length = np.sqrt(b * b + r * r - 2 * b * r * np.cos(angle))
        first = b * r * np.sin(angle) / length
        second = (b * r * np.cos(angle) - first * first) / length
        way = np.copysign(1.0, b * np.sin(start))
        # The difference of lengths by that of their squares: it keeps its digits near the lowest place.
        stretch = 4 * b * r * np.sin(s / 2) * np.sin((start + angle) / 2) / (length + low)
        return way * stretch, way * first, way * second


def _check_numbers(load: SpringLoad | ArmLoad, units: Mapping[str, Words], preload_unit: str) -> None:
    """That the numbers of a load are finite; ``units`` are those of the numbers that are 0 or more."""
    for quantity, unit in units.items():
        limit = say("a finite number of 0 {unit} or more", unit=unit)
        check_number(quantity, getattr(load, quantity), limit, least=0)
    bounded("speed_rpm", load.speed_rpm, "rpm")
    for quantity, unit in (("preload", preload_unit), ("acceleration", "rad/s^2")):
        value = getattr(load, quantity)
        if isinstance(value, tuple):  # all that is said of the preload, in place of the number alone
            limit = say("a number of {unit}", unit=unit)
            check_kind(quantity, value, NUMBER_TYPES, limit, say("write spring_preload(...).preload"))
        check_number(quantity, value, say("a finite number of {unit}", unit=unit))
    check_load(load.load)

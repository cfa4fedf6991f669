"""Whether a spring keeps a follower on its cam: the contact function xi(phi), its extremes, and where it is negative.

xi = m (a omega^2 + v eps) + F0 + c s + P is the force along the motion with which the cam bears the follower; where it
would be negative the cam would have to pull, and the follower leaves it.

Source: I. Voloder, M. Cohodar, S. Karic, *Annals of DAAAM* (2007).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError, check_kind
from graphcam.former_names import renamed
from graphcam.given.impact import check_finite_acceleration
from graphcam.given.laws import Floats, Side
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.given.plausible_ranges import NUMBER_TYPES
from graphcam.given.root_finding import roots
from graphcam.given.spring_load import ArmLoad, FollowerLoad, SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.turn_extremes import (
    VALUE_ROUNDING,
    Interval,
    Places,
    ValueAt,
    first_highest,
    over_turn,
    places_in,
    smooth_pieces,
    stationary_places,
)
from graphcam.showing import parts_text
from graphcam.words import say


class SpringPreload(NamedTuple):
    """The minimum preload [N] that keeps contact, and the cam angle [rad] where it is needed.

    It is the supremum of -(m (a omega^2 + v eps) + c s) over the turn.  If it is negative, contact is kept even by a
    spring without preload.
    """

    preload: float
    phi: float


@dataclass(frozen=True, eq=False)
class ContactCurve:
    """The contact function over the turn: dense points (n,) in order, at a jump one on either side.

    phi : rad;  force : xi [N]
    """

    phi: Floats
    force: Floats


@overload
def spring_preload(motion: Cam, mass: SpringLoad | ArmLoad, /) -> SpringPreload: ...
@overload
def spring_preload(
    motion: Motion, mass: float, speed_rpm: float, stiffness: float, acceleration: float = 0.0
) -> SpringPreload: ...
def spring_preload(
    motion: Motion | Cam,
    mass: float | SpringLoad | ArmLoad,
    speed_rpm: float = 0.0,
    stiffness: float = 0.0,
    acceleration: float = 0.0,
) -> SpringPreload:
    """The minimum preload that keeps a follower on its cam over the whole turn: sup -(m a omega^2 + ...).

    ``spring_preload(cam, load)``: of any cam under a load, whose own preload does not count.  Friction at the cam does
    not change it, as long as the follower does not jam.
    ``spring_preload(motion, mass, speed_rpm, stiffness)``: of a translating follower.

    mass : kg;  speed_rpm : of the cam [rpm];  stiffness : of the spring [N/mm]
    acceleration : of the cam [rad/s^2], 0 at a constant speed
    returns : preload [N; N mm of a torsion spring about an arm's pivot], negative if none is needed, and the cam angle
        [rad]; it may be needed on one side of a jump only (:meth:`Contact.min_force` names the side), and of equal
        places the first is named

    Raises
    ------
    DesignError : the load does not fit the follower

    >>> from math import degrees, radians
    >>> import graphcam as gc
    >>> angle = radians(45)
    >>> motion = gc.Motion([gc.Rise(30, angle, "cosine"), gc.Dwell(angle), gc.Return(30, angle, "cosine"),
    ...     gc.Dwell(5 * angle)])
    >>> preload, phi = gc.spring_preload(motion, mass=0.2, speed_rpm=550, stiffness=3)
    >>> round(preload, 4), degrees(phi)
    (69.2296, 45.0)
    >>> swing = radians(15)
    >>> motion = gc.Motion([gc.Rise(swing, radians(75)), gc.Dwell(radians(60)), gc.Return(swing, radians(75)),
    ...     gc.Dwell(radians(150))])
    >>> cam = gc.Cam(motion, gc.Oscillating(arm=120, distance=130), prime_radius=50)
    >>> spring = gc.ArmSpring(arm=60, anchor=(90, -40))
    >>> preload, phi = gc.spring_preload(cam, gc.ArmLoad(3000, 550, stiffness=3, at=spring))
    >>> round(preload, 3), round(degrees(phi), 2)
    (165.395, 59.04)
    """
    if isinstance(motion, Cam):
        check_kind("load", mass, (SpringLoad, ArmLoad), remedy=say("write spring_preload(cam, load)"))
        return _least_preload(motion.motion, motion.kinematics.pressed_by(cast(SpringLoad | ArmLoad, mass)))
    check_kind("motion", motion, (Motion, Cam))
    check_kind("mass", mass, NUMBER_TYPES, say("a number of kg"), say("under a load write spring_preload(cam, load)"))
    return _least_preload(motion, SpringLoad(cast(float, mass), speed_rpm, stiffness, acceleration=acceleration))


def _least_preload(motion: Motion, load: FollowerLoad) -> SpringPreload:
    """sup -(Q - w F0)/w, with w the force per preload."""
    check_finite_acceleration(motion)

    def needed(places: Places) -> Floats:
        weight, _ = load.leverage(places.values)
        return load.preload - load.force(places.values, motion.directions[places.phase], places.phi) / weight

    places = stationary_places(motion, needed, load.knots)
    size = float((load.size(places.values) / load.leverage(places.values)[0]).max())
    found = first_highest(motion, places, needed, load.knots, size)
    return SpringPreload(found.value, found.phi)


@renamed(least_force="min_force", greatest_force="max_force")
@dataclass(frozen=True)
class Contact:
    """A follower that a load presses on its cam; of an arm the load beside it, and torques [N mm] in place of forces.

    >>> from math import degrees, radians
    >>> import graphcam as gc
    >>> angle = radians(45)
    >>> motion = gc.Motion([gc.Rise(30, angle, "cosine"), gc.Dwell(angle), gc.Return(30, angle, "cosine"),
    ...     gc.Dwell(5 * angle)])
    >>> contact = gc.Contact(motion, gc.SpringLoad(mass=0.2, speed_rpm=550, stiffness=3, preload=60))
    >>> [round(x, 4) for x in contact.min_force()[:2]], contact.min_force().side
    ([-9.2296, 0.7854], 'left')
    >>> [[round(degrees(phi), 2) for phi in interval] for interval in contact.lost()]
    [[39.2, 45.0], [90.0, 95.8]]
    """

    motion: Motion
    load: FollowerLoad
    __repr__ = parts_text

    def __post_init__(self) -> None:
        check_kind("motion", self.motion, Motion, remedy=say("of a cam take cam.motion"))
        check_finite_acceleration(self.motion)
        if isinstance(self.load, ArmLoad):
            remedy = say("take CamForces(cam, load).pressing")
            raise DesignError("load", say("an ArmLoad"), say("that load in its place beside the cam"), remedy)

    def min_force(self) -> ValueAt:
        """The minimum xi over the turn [N], both sides of every jump included; of equal ones the first."""
        value, phi, side = self._extreme(-1)
        return ValueAt(-value, phi, side)

    def max_force(self) -> ValueAt:
        """The maximum xi over the turn [N], both sides of every jump included; of equal ones the first."""
        return self._extreme(+1)

    def lost(self) -> list[Interval]:
        """The intervals of phi [rad] in which the cam would have to pull, in order.

        An end beyond 2 pi lies in the next turn.  In these intervals the cam's motion cannot be followed; a follower
        that has left the cam comes back to it later than the interval ends.
        """
        found: list[Interval] = []
        for start, end in self._negative_stretches().tolist():
            if not start < end:
                continue
            if found and start - found[-1][1] <= VALUE_ROUNDING * FULL_TURN:
                found[-1] = Interval(found[-1].start, end)
            else:
                found.append(Interval(start, end))
        whole_turns = len(found) > 1 and found[0][0] == 0 and FULL_TURN - found[-1][1] <= VALUE_ROUNDING * FULL_TURN
        if whole_turns:
            (_, first_end), (last_start, _) = found.pop(0), found.pop()
            found.append(Interval(last_start, first_end + FULL_TURN))
        return found

    def curve(self, parts: int = 60) -> ContactCurve:
        """xi over the turn [N], with ``parts`` points on every smooth piece and both its ends."""
        curve = over_turn(self.motion, self.force, self.load.knots, parts)
        return ContactCurve(curve.phi, curve.values)

    def force(self, places: Places) -> Floats:
        """xi at places that belong to phases [N]."""
        return self.load.force(places.values, self.motion.directions[places.phase], places.phi)

    def _force(self, phase: ArrayLike, u: ArrayLike, side: Side = "right") -> Floats:
        return self.force(places_in(self.motion, phase, u, side))

    @cached_property
    def _places(self) -> Places:
        return stationary_places(self.motion, self.force, self.load.knots)

    def _extreme(self, sign: int) -> ValueAt:
        places = self._places
        size = float(self.load.size(places.values).max())
        return first_highest(self.motion, places, lambda places: sign * self.force(places), self.load.knots, size)

    def _stretches(self) -> tuple[NDArray[np.intp], Floats, Floats]:
        """Phase, u and u (n,) of the ends of stretches in which xi is monotonous, in order."""
        phase, u0, u1 = smooth_pieces(self.motion, self.load.knots)
        ends = np.concatenate([u0, u1, self._places.u[2 * phase.size :]])
        phases = np.concatenate([phase, phase, self._places.phase[2 * phase.size :]])
        order = np.lexsort((ends, phases))
        phases, ends = phases[order], ends[order]
        here = np.flatnonzero((phases[1:] == phases[:-1]) & (ends[1:] > ends[:-1]))
        return phases[here], ends[here], ends[here + 1]

    def _negative_stretches(self) -> Floats:
        """The intervals (n, 2) of cam angles [rad] in which xi is negative, each within one stretch."""
        phase, low, high = self._stretches()
        # From inside: beyond the end of the stretch the force may have jumped.
        first, last = self._force(phase, low), self._force(phase, high, "left")
        size = np.maximum(*(self.load.size(self.motion.at(phase, u)) for u in (low, high)))
        negative = np.minimum(first, last) < -VALUE_ROUNDING * size
        phase, low, high, first, last = (each[negative] for each in (phase, low, high, first, last))

        def xi(u: Floats) -> Floats:
            """The forces at parts u of the phases, from 0 to 1."""
            return np.where(u == high, last, self._force(phase, u))

        crossing = first * last < 0
        root = roots(xi, low, high)
        start, end = np.where(crossing & (last < 0), root, low), np.where(crossing & (last > 0), root, high)
        return np.stack([self.motion.angle_at(phase, start), self.motion.angle_at(phase, end)], axis=1)

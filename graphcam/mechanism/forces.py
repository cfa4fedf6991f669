"""The forces between a cam and its follower: at the contact, in the guide, and the torque on the cam.

The cam pushes along the contact normal, at the pressure angle alpha to the motion, with N, and as it slides past the
follower it drags it along the profile with mu N: always in the cam's sense, for an edge or a face that slides, and for
a roller with as much as its bearing holds it back at the rim.  Along the motion of a follower that slides

    m (a omega^2 + v eps) + d v omega = N (cos alpha - mu sin alpha) - (F0 + c s) - P

and of an arm about its pivot, with its length l, the roller radius r and the cam's sense sigma,

    J (a omega^2 + v eps) + d v omega = N (l cos alpha - sigma mu (l sin alpha - r)) - (F0 + c s) - l P

because the friction acts at the rim, r nearer to the cam than the roller's centre.  Contact is kept where N > 0.  What
a unit of N moves, cos alpha - mu sin alpha, is the transmission coefficient: where it is zero or less the follower
jams.

Two bearings guide a stem; the nearer one lies b above the roller's centre, the farther one l above the nearer.  The
stem is thin, the roller light.  Equilibrium across the motion, of moments about the roller's centre, and along the
motion under the load Q, with x = sin alpha + mu cos alpha and the moment N m of the contact about the centre, m = mu r:

    N1 - N2 = N x                                  N1 b + N m = N2 (b + l)
    N1 = N (x (l + b) + m)/l                       N2 = N (x b + m)/l
    N (cos alpha - mu sin alpha) = Q +- mu_g (|N1| + |N2|)      + on a rise, - on a return: against the motion

so with h = mu_g (|N1| + |N2|)/N the normal force is N = Q/(cos alpha - mu sin alpha -+ h).  On a rise it grows without
bound as the denominator vanishes: the follower jams in its guide.  Without friction at the cam that is
where tan alpha = l/(mu_g (l + 2 b)).  Of a flat face, whose contact wanders sigma v from the axis, m = -v.

The torque on the cam is found by virtual power: the follower's motion, and the friction times the speed of sliding.

Sources: I. Voloder, M. Cohodar, S. Karic, *Annals of DAAAM* (2007) for the load; H. A. Rothbart, *Cam Design Handbook*
(2004), chapter 6, for the guide, tan alpha_max = B/(mu (2 A + B)) for the overhang A and the length B of the bearing.

Without friction a load that is the same at the end of a turn as at its beginning, and depends on the place alone, does
no work over the turn, and the mean torque is zero; so is that of the inertia at a constant speed.  What remains is what
friction and damping d take, and a load that differs on the way up and on the way down.

Friction between cam and follower: what it leaves of the normal force, and where the follower jams.

The cam slides past the follower in its own sense and drags it along the profile with mu N.  Of a unit of the normal
force cos alpha - mu sin alpha acts along the motion then; of an arm of the length l with a roller of the radius r, in
lengths of the arm, cos alpha - sigma mu (sin alpha - r/l), for its friction acts at the roller's rim.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError, check_kind, check_number
from graphcam.former_names import renamed
from graphcam.given.impact import check_finite_acceleration
from graphcam.given.laws import Floats, Side
from graphcam.given.motion import FULL_TURN
from graphcam.given.spring_load import ArmLoad, FollowerLoad, Guide, SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.kinematics import Kinematics, Values, pair_cross
from graphcam.mechanism.turn_extremes import (
    Places,
    ValueAt,
    places_from,
    places_in,
    smooth_pieces,
    turn_maximum,
    zero_angles,
)
from graphcam.showing import Plottable, parts_text
from graphcam.words import say

# --- friction between cam and follower -------------------------------------------------------------------------------


def transmission(cam: Cam, values: Values, friction: float = 0.0) -> tuple[Floats, Floats]:
    """What a unit of normal force moves along the motion, cos alpha - mu sin alpha, and its derivative by phi.

    values : (s, v, a, j)
    returns : of an arm divided by its length, cos alpha - sigma mu (sin alpha - r/l)
    """
    return transmitted(cam.kinematics, values, friction, cam.roller_radius)


def transmitted(kin: Kinematics, values: Values, friction: float, roller: Any) -> tuple[Floats, Floats]:
    """The transmission of one cam or of many, as in :func:`transmission`, with the radii of their rollers [mm]."""
    cosine, sine, turning = contact_angle(kin, values)
    lean = kin.leaning * friction
    return cosine - lean * (sine - kin.rim(roller)), -(sine + lean * cosine) * turning


def lever_about_cam(kin: Kinematics, values: Values, friction: float, roller: Any) -> tuple[Floats, Floats]:
    """The torque on the cam over the normal force [mm], of one cam or of many, and its slope: by virtual power."""
    _, v, a, _ = values
    moved, moved_slope = transmitted(kin, values, friction, roller)
    sliding, sliding_slope = kin.sliding(values, roller)
    reach, reach_slope = kin.reach(values)
    slope = reach * (a * moved + v * moved_slope) + reach_slope * v * moved
    return reach * v * moved + friction * sliding, slope + friction * sliding_slope


def jamming_margin(cam: Cam, friction: float) -> ValueAt:
    """The minimum transmission coefficient over the turn, cos alpha - mu sin alpha, and where it is; at 0 the cam jams.

    friction : mu between cam and follower

    Raises
    ------
    DesignError : the friction is negative or not finite

    >>> from math import degrees, radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(60)), gc.Dwell(radians(120)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> margin = gc.jamming_margin(gc.Cam(motion, gc.Translating(), prime_radius=30), friction=0.1)
    >>> round(margin.value, 4), round(degrees(margin.phi), 2)
    (0.5443, 25.19)
    """
    check_friction(friction)

    def margin(places: Places) -> Floats:
        """The margin's negative: the minimum coefficient is the maximum of these."""
        return -transmission(cam, places.values, friction)[0]

    worst = turn_maximum(cam.motion, margin)
    return worst._replace(value=-worst.value)


def check_friction(friction: float) -> None:
    """Check that a number can be a coefficient of friction.

    Raises
    ------
    DesignError : it is negative or not finite
    """
    check_number("friction", friction, say("a finite number of 0 or more"), least=0)


def contact_angle(kin: Kinematics, values: Values) -> tuple[Floats, Floats, Floats]:
    """cos and sin of the pressure angle, and its slope by phi, from (s, v, a, j)."""
    q, q1 = kin.pressure(values)
    size = np.sqrt(np.add(q[0] * q[0], q[1] * q[1]))
    return q[0] / size, q[1] / size, pair_cross(q, q1) / size**2


def most_friction(cam: Cam) -> float:
    """The friction at the cam at which the minimum transmission coefficient is zero; infinite or negative for none.

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(60)), gc.Dwell(radians(120)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> cam = gc.Cam(motion, gc.Translating(), prime_radius=30)
    >>> abs(gc.jamming_margin(cam, most_friction(cam)).value) < 1e-12
    True
    """

    def over(places: Places) -> Floats:
        """The friction over the force that moves, for mu = 1."""
        plain, rubbing = (transmission(cam, places.values, mu)[0] for mu in (0.0, 1.0))
        return (plain - rubbing) / plain

    greatest = turn_maximum(cam.motion, over).value
    return math.inf if greatest == 0 else 1 / greatest


# --- the forces ------------------------------------------------------------------------------------------------------

NO_GUIDE = Guide(friction=0.0, overhang=0.0, length=1.0)
"""A guide without friction."""


def grip(guide: Guide, s: Floats | float = 0.0) -> Floats:
    """g = mu (1 + 2 b/l), the friction in the guide over the side force, with the follower s mm up: b = overhang - s.

    >>> import graphcam as gc
    >>> float(grip(gc.Guide(friction=0.1, overhang=40, length=80)))
    0.2
    """
    return np.asarray(guide.friction * (1 + 2 * (guide.overhang - s) / guide.length))


def jamming_angle(guide: Guide, s: Floats | float = 0.0) -> Floats:
    """The pressure angle [rad] at which the guide jams on a rise: tan alpha = l/(mu (2 b + l)); pi/2 without friction.

    >>> import graphcam as gc
    >>> round(math.degrees(jamming_angle(gc.Guide(friction=0.1, overhang=40, length=80))), 4)
    78.6901
    """
    return np.arctan2(1.0, grip(guide, s))


@dataclass(frozen=True, eq=False)
class Forces:
    """The forces at places of a cam; every array is shaped like the places.  Negative: the cam would have to pull.

    phi : rad;  load : Q, along the motion [N], of an arm about its pivot [N mm]
    normal : N, along the contact normal [N]; NaN where the follower jams
    along, side : N cos(alpha), along the motion, and N sin(alpha), across it [N]
    contact_friction : mu N, along the profile [N]
    near, far : N1 and N2 of the bearings, in the sense that they balance a positive side force [N]; NaN of an arm
    friction : of both bearings together [N];  torque : on the cam [N mm], positive where it must be driven
    efficiency : part of the work that passes the guide; NaN where nothing moves, and of an arm
    transmission : cos(alpha) - mu sin(alpha), what a unit of the normal force moves
    """

    phi: Floats
    load: Floats
    normal: Floats
    along: Floats
    side: Floats
    near: Floats
    far: Floats
    friction: Floats
    torque: Floats
    efficiency: Floats
    transmission: Floats
    contact_friction: Floats


@renamed(
    greatest_normal="max_normal",
    least_normal="min_normal",
    greatest_torque="max_torque",
    least_torque="min_torque",
    least_efficiency="min_efficiency",
)
@dataclass(frozen=True)
class CamForces(Plottable):
    """The forces between a cam and its follower under a load, with friction between them, and of a stem in a guide.

    Cam angles are in radians; for degrees write ``forces.at(gc.cam_angle(60))``.

    load : a :class:`~graphcam.SpringLoad`, or of an arm an :class:`~graphcam.ArmLoad`
    guide : of a follower that slides;  friction : mu, between cam and follower

    Raises
    ------
    DesignError : the load does not fit the follower, the friction is negative, an arm has a guide, or the follower
        rises beyond the nearer bearing

    >>> from math import degrees, radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> cam = gc.Cam(motion, gc.Translating(offset=10, roller_radius=12), prime_radius=50)
    >>> forces = gc.CamForces(cam, gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=100))
    >>> at = forces.at(phase=0, u=0.5)
    >>> float(at.load.round(3)), float(at.normal.round(3)), float(at.side.round(3))
    (160.0, 165.459, 42.15)
    >>> forces.at(gc.cam_angle(60)).normal.round(3).item()  # at 60 degrees
    165.459
    >>> most = forces.max_normal()
    >>> round(most.value, 3), round(degrees(most.phi), 3)
    (221.756, 120.0)
    """

    _drawn_in = "force_curves.plot"

    cam: Cam
    load: SpringLoad | ArmLoad
    guide: Guide = field(default=NO_GUIDE)
    friction: float = 0.0

    def __repr__(self) -> str:
        """The parts, and whether the follower keeps to the cam.

        >>> import graphcam as gc
        >>> print(gc.CamForces(gc.solve(gc.builtin_task()).cam, gc.SpringLoad(0.5, 600, 2, preload=5)))
        CamForces
        ...
          minimum normal force: ... N at ... degrees: contact is lost there; gc.spring_preload(cam, load) keeps it
        """
        try:
            least = self.min_normal()
        except DesignError as error:
            return f"{parts_text(self)}\n  {error}"
        said = (
            f"{parts_text(self)}\n  minimum normal force: {least.value:.4g} N at {math.degrees(least.phi):.4g} degrees"
        )
        lost = ": contact is lost there; gc.spring_preload(cam, load) keeps it"
        return said + (lost if least.value < 0 else "")

    def __post_init__(self) -> None:
        check_kind("cam", self.cam, Cam)
        check_finite_acceleration(self.cam.motion)
        check_kind("guide", self.guide, Guide, remedy=say("friction between cam and follower is friction=..."))
        check_friction(self.friction)
        _ = self.pressing  # says at once what does not fit
        if not self.guide.friction:
            return
        if self.cam.kinematics.swings:
            remedy = say("an arm turns in a bearing: leave the guide out")
            raise DesignError("follower", self.cam.follower.kind, say("one that slides in a guide"), remedy)
        overhang, lift = self.guide.overhang, self.cam.motion.lift
        if overhang < lift:
            remedy = say("place the nearer bearing higher: the roller's centre rises towards it")
            raise DesignError("overhang", overhang, say("the lift of {lift:g} mm or more", lift=lift), remedy)

    @cached_property
    def pressing(self) -> FollowerLoad:
        """The load as it stands beside this cam."""
        return self.cam.kinematics.pressed_by(self.load)

    @overload
    def at(self, phi: ArrayLike, /, *, side: Side = "right") -> Forces: ...
    @overload
    def at(self, phase: ArrayLike, u: ArrayLike, side: Side = "right") -> Forces: ...
    def at(self, phase: ArrayLike, u: ArrayLike | None = None, side: Side = "right") -> Forces:
        """The forces at cam angles phi [rad], or at fractions of phases, whose ends are seen from inside then.

        ``at(phi)``: any real numbers; at a break the value of the named side.
        ``at(phase, u)``: the index of the phase, one or as many as there are fractions u.

        The fields of what it returns, each an array of that shape: phi [rad]; load, along the motion [N; of an arm
        N mm]; normal, along, side, contact_friction [N]; near, far and friction, of the bearings of a guide [N];
        torque, on the cam [N mm]; efficiency, of the guide; transmission.
        """
        return self.of(places_from(self.cam.motion, phase, u, side))

    def of(self, places: Places) -> Forces:
        """The forces at places that belong to phases."""
        values, direction = places.values, self.cam.motion.directions[places.phase]
        cosine, sine, _ = contact_angle(self.cam.kinematics, values)
        normal, slip, (near, far) = self.normal(places), self._slip(places), self.bearings(values)
        with np.errstate(invalid="ignore"):
            works = np.where(direction > 0, np.maximum(1 - slip, 0.0), 1 / (1 + slip))
        stem = np.nan if self.cam.kinematics.swings else 1.0
        return Forces(
            phi=places.phi,
            load=self.pressing.force(values, direction, places.phi),
            normal=normal,
            along=normal * cosine,
            side=normal * sine,
            near=stem * normal * near,
            far=stem * normal * far,
            friction=np.abs(normal) * self._guide_friction(values),
            torque=normal * self._turning(values),
            efficiency=np.where(direction == 0, np.nan, stem * works),
            transmission=transmission(self.cam, values, self.friction)[0],
            contact_friction=self.friction * normal,
        )

    def max_normal(self) -> ValueAt:
        """The maximum normal force over the turn [N], both sides of every jump included.

        Raises
        ------
        DesignError : the follower jams, at the cam or in its guide
        """
        return self._extreme(self.normal)

    def min_normal(self) -> ValueAt:
        """The minimum normal force over the turn [N]; contact is lost where it is negative.

        Raises
        ------
        DesignError : the follower jams, at the cam or in its guide
        """
        return self._extreme(self.normal, -1)

    def max_torque(self) -> ValueAt:
        """The maximum torque that must drive the cam [N mm].

        Raises
        ------
        DesignError : the follower jams, at the cam or in its guide

        >>> from math import degrees, radians
        >>> import graphcam as gc
        >>> swing = radians(15)
        >>> motion = gc.Motion([gc.Rise(swing, radians(120)), gc.Dwell(radians(60)), gc.Return(swing, radians(120)),
        ...     gc.Dwell(radians(60))])
        >>> cam = gc.Cam(motion, gc.Oscillating(arm=120, distance=130, roller_radius=12), prime_radius=50)
        >>> forces = gc.CamForces(cam, gc.ArmLoad(2000, 300, 5000, preload=6000), friction=0.1)
        >>> torque = forces.max_torque()
        >>> round(torque.value, 1), round(degrees(torque.phi), 2)
        (1953.2, 60.48)
        """
        return self._extreme(self.torque)

    def min_torque(self) -> ValueAt:
        """The minimum torque on the cam [N mm], negative where the follower drives it.

        Raises
        ------
        DesignError : the follower jams, at the cam or in its guide
        """
        return self._extreme(self.torque, -1)

    def min_efficiency(self) -> ValueAt:
        """The minimum efficiency of the guide over the rises; at 0 or below it jams."""
        worst = turn_maximum(self.cam.motion, self._slip_on_rises, self.corners)
        return worst._replace(value=1 - worst.value)

    # --- for other quantities of the contact -------------------------------------------------------------------------

    def normal(self, places: Places) -> Floats:
        """N at places that belong to phases [N]; NaN where the follower jams."""
        direction, values = self.cam.motion.directions[places.phase], places.values
        left = self._moving_force(values, direction)
        return self.pressing.force(values, direction, places.phi) / np.where(left > 0, left, np.nan)

    def torque(self, places: Places) -> Floats:
        """The torque on the cam at places that belong to phases [N mm]; NaN where the follower jams."""
        return self.normal(places) * self._turning(places.values)

    def check(self) -> None:
        """Check that the follower moves: that it jams nowhere.

        Raises
        ------
        DesignError : it jams, at the cam or in its guide
        """
        _ = self._sound

    @cached_property
    def _sound(self) -> bool:
        """True: what jams raises an error."""
        if self.friction and (margin := jamming_margin(self.cam, self.friction)).value <= 0:
            allowed = say("less than the {most_friction:.4g} at which the follower jams, {where}")
            allowed = allowed.with_values(most_friction=most_friction(self.cam), where=self._place_text(margin))
            remedy = say("lubricate, let a roller turn, or enlarge the prime radius")
            raise DesignError("friction", self.friction, allowed, remedy)
        if self.guide.friction:
            self._check_guide()
        return True

    def _extreme(self, quantity: Callable[[Places], Floats], sign: int = 1) -> ValueAt:
        """The maximum value, or with -1 the minimum, of a quantity that grows without bound where the follower jams."""
        self.check()
        knots = (*self.pressing.knots, *self.corners)
        found = turn_maximum(self.cam.motion, lambda places: sign * quantity(places), knots)
        return found._replace(value=sign * found.value)

    def _moving_force(self, values: Values, direction: Floats) -> Floats:
        """What a unit of normal force moves along the motion, less what the guide holds of it; of an arm [mm]."""
        moved = transmission(self.cam, values, self.friction)[0]
        return self.cam.kinematics.reach(values)[0] * moved - direction * self._guide_friction(values)

    def _guide_friction(self, values: Values) -> Floats:
        """h, the friction in the guide over the normal force."""
        if not self.guide.friction:
            return np.zeros_like(values[0])
        near, far = self.bearings(values)
        return self.guide.friction * (np.abs(near) + np.abs(far))

    def bearings(self, values: Values) -> tuple[Floats, Floats]:
        """N1 and N2 of the bearings over the normal force."""
        cosine, sine, _ = contact_angle(self.cam.kinematics, values)
        moment = self.cam.kinematics.tipping(values, self.friction, self.cam.roller_radius)
        x, length = sine + self.friction * cosine, self.guide.length
        far = x * ((self.guide.overhang - values[0]) / length) + moment / length
        return x + far, far

    @cached_property
    def corners(self) -> tuple[float, ...]:
        """The cam angles [rad] at which a bearing of the guide changes its side, so that the friction has a corner."""
        if not self.guide.friction:
            return ()
        motion, knots = self.cam.motion, self.pressing.knots
        found = [zero_angles(motion, partial(_bearing, self, which), knots) for which in (0, 1)]
        return tuple(np.concatenate(found).tolist())

    def _turning(self, values: Values) -> Floats:
        return lever_about_cam(self.cam.kinematics, values, self.friction, self.cam.roller_radius)[0]

    def _slip(self, places: Places) -> Floats:
        return self._guide_friction(places.values) / transmission(self.cam, places.values, self.friction)[0]

    def _slip_on_rises(self, places: Places) -> Floats:
        return np.where(self.cam.motion.directions[places.phase] > 0, self._slip(places), np.nan)

    def _place_text(self, found: ValueAt) -> str:
        alpha = math.degrees(self.cam.pressure_angle(found.phi))
        return f"at a cam angle of {math.degrees(found.phi):.4g} degrees, where the pressure angle is {alpha:.4g}"

    def _check_guide(self) -> None:
        worst = self.min_efficiency()
        if worst.value > 0:
            return
        if self.friction:
            allowed = say(
                "so small that the follower does not jam in its guide, {where}", where=self._place_text(worst)
            )
            raise DesignError("friction", self.friction, allowed, say("lubricate guide and cam, or lengthen the guide"))
        alpha, limit = (self.cam.pressure_angle(worst.phi), jamming_angle(self.guide, self.cam.motion(worst.phi)[0]))
        found = say("{degrees:.4g} degrees at a cam angle of {degrees2:.4g}")
        found = found.with_values(degrees=math.degrees(alpha), degrees2=math.degrees(worst.phi))
        allowed = say("less than the {degrees:.4g} degrees at which the guide jams", degrees=math.degrees(limit))
        remedy = say("enlarge the prime radius, lengthen the guide or bring it nearer to the cam")
        raise DesignError(say("pressure angle"), found, allowed, remedy)


GAUSS_NODE_COUNT = 24
"""The number of Gauss nodes on a part of a smooth piece."""
PIECE_PARTS = 4
"""A smooth piece, in which no bearing of the guide changes its side, is divided into so many equal parts."""


def mean_torque(forces: CamForces) -> float:
    """The mean of the torque on the cam over a turn [N mm].

    Raises
    ------
    DesignError : the follower jams, at the cam or in its guide

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> cam = gc.Cam(motion, gc.Translating(offset=10, roller_radius=12), prime_radius=50)
    >>> load = gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=100)
    >>> abs(gc.mean_torque(gc.CamForces(cam, load))) < 1e-9
    True
    >>> round(gc.mean_torque(gc.CamForces(cam, load, friction=0.1)), 3)
    938.227
    """
    check_kind("forces", forces, CamForces)
    forces.check()
    nodes, weights = np.polynomial.legendre.leggauss(GAUSS_NODE_COUNT)
    phase, low, high = _parts(forces)
    half = (high - low) / 2
    places = places_in(forces.cam.motion, phase[:, None], (low + half)[:, None] + half[:, None] * nodes)
    width = half * forces.cam.motion.angles[phase]
    return float(np.sum(width * (forces.torque(places) @ weights))) / FULL_TURN


def _parts(forces: CamForces) -> tuple[NDArray[np.intp], Floats, Floats]:
    """The parts of the turn in which the torque is smooth: phase, and the fractions where a part begins and ends."""
    phase, u0, u1 = smooth_pieces(forces.cam.motion, (*forces.pressing.knots, *forces.corners))
    ends = np.linspace(u0, u1, PIECE_PARTS + 1)
    return np.tile(phase, PIECE_PARTS), ends[:-1].ravel(), ends[1:].ravel()


def _bearing(forces: CamForces, which: int, places: Places) -> Floats:
    """The force of one bearing over the normal force: where it changes its sign, the friction has a corner."""
    return forces.bearings(places.values)[which]

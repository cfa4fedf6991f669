"""The forces on a translating follower: at the contact, in the guide, and the torque on the cam.

The roller turns freely, so the cam pushes along the contact normal, at the pressure angle alpha to the motion, with F.
Two bearings guide the stem; the nearer one lies b above the roller's centre, the farther one l above the nearer.
The stem is thin, the roller light.  Equilibrium across the motion, of moments about the roller's centre, and along the
motion under the load Q:

    N1 - N2 = F sin alpha                          N1 b = N2 (b + l)
    N1 = F sin alpha (l + b)/l                     N2 = F sin alpha b/l
    F cos alpha = Q +- mu (|N1| + |N2|)            + on a rise, - on a return: friction acts against the motion

so with g = mu (1 + 2 b/l) the normal force is F = Q/(cos alpha -+ g |sin alpha|).  On a rise it grows without bound as
tan alpha approaches 1/g: the follower jams.  Of the work on a rise the part 1 - g |tan alpha| lifts the load.

Sources: H. A. Rothbart, *Cam Design Handbook* (2004), chapter 6, tan alpha_max = B/(mu (2 A + B)) for the overhang A
and the length B of the bearing.  The cam's torque is F cos alpha ds/dphi, by virtual work.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError
from graphcam.given.laws import Floats, Side
from graphcam.given.spring_load import Guide, SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.kinematics import Values, pair_cross
from graphcam.mechanism.stationary import Places, ValueAt, greatest
from graphcam.showing import by_parts

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

    phi : rad;  load : Q, along the motion [N]
    normal : F, along the contact normal [N]; NaN where the guide jams
    along, side : F cos(alpha), which drives the follower, and F sin(alpha), which presses it against the guide [N]
    near, far : N1 and N2 of the bearings, in the sense that they balance a positive side force [N]
    friction : of both bearings together [N]
    torque : on the cam [N mm], positive where it must be driven
    efficiency : part of the work that passes the guide; NaN where nothing moves
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


@dataclass(frozen=True)
class CamForces:
    """The forces between a cam and a translating follower under a load, in a guide.

    Raises
    ------
    DesignError : the follower is not a translating one, or it rises beyond the nearer bearing

    >>> from math import degrees, radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> cam = gc.Cam(motion, gc.Translating(offset=10, roller_radius=12), prime_radius=50)
    >>> forces = gc.CamForces(cam, gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=100))
    >>> at = forces.at(phase=0, u=0.5)
    >>> float(at.load.round(3)), float(at.normal.round(3)), float(at.side.round(3))
    (160.0, 165.459, 42.15)
    >>> most = forces.greatest_normal()
    >>> round(most.value, 3), round(degrees(most.phi), 3)
    (221.756, 120.0)
    """

    cam: Cam
    load: SpringLoad
    guide: Guide = field(default=NO_GUIDE)
    __repr__ = by_parts

    def __post_init__(self) -> None:
        if not self.cam.kinematics.has_forces:
            raise DesignError("follower", self.cam.follower.kind, "'translating'", "forces are worked out for it alone")
        overhang, lift = self.guide.overhang, self.cam.motion.lift
        if self.guide.friction and overhang < lift:
            remedy = "place the nearer bearing higher: the roller's centre rises towards it"
            raise DesignError("overhang", overhang, f"the lift of {lift:g} mm or more", remedy)

    def at(self, phase: ArrayLike, u: ArrayLike, side: Side = "right") -> Forces:
        """The forces at the fraction u of a phase, so that an end of a phase is seen from inside.

        phase : index of the phase, one or as many as there are u
        """
        motion = self.cam.motion
        values, direction = motion.at(phase, u, side), self.cam.motion.directions[np.asarray(phase, dtype=np.intp)]
        s, v, _, _ = values
        cosine, sine, _ = self._angle(values)
        load = self.load.force(values, direction)
        normal = self._normal(values, direction)
        across, leverage = normal * sine, (self.guide.overhang - s) / self.guide.length
        slip = grip(self.guide, s) * np.abs(sine) / cosine
        with np.errstate(invalid="ignore"):
            works = np.where(direction > 0, np.maximum(1 - slip, 0.0), 1 / (1 + slip))
        along, friction = normal * cosine, grip(self.guide, s) * np.abs(across)
        bearings, efficiency = (across * (1 + leverage), across * leverage), np.where(direction == 0, np.nan, works)
        phi = motion.angle_at(phase, u)
        return Forces(phi, load, normal, along, across, *bearings, friction, along * v, efficiency)

    def greatest_normal(self) -> ValueAt:
        """The greatest normal force over the turn [N], both sides of every jump included.

        Raises
        ------
        DesignError : the guide jams on a rise
        """
        self._check_jamming()
        return greatest(self.cam.motion, self.normal_slope, self.normal)

    def least_efficiency(self) -> ValueAt:
        """The least efficiency of the guide over the rises; at 0 or below it jams."""
        worst = greatest(self.cam.motion, self._slip_slope, self._slip_on_rises)
        return ValueAt(1 - worst.value, worst.phi, worst.side)

    # --- for other quantities of the contact -------------------------------------------------------------------------

    def normal(self, places: Places) -> Floats:
        """F at places that belong to phases [N]."""
        return self._normal(places.values, self.cam.motion.directions[places.phase])

    def normal_inside(self, values: Values) -> Floats:
        """F [N] inside a phase, where v has the sense of the motion, from (s, v, a, j)."""
        return self._normal(values, np.sign(values[1]))

    def normal_slope(self, values: Values) -> Floats:
        """dF/dphi [N/rad] inside a phase, from (s, v, a, j)."""
        # F = Q/D
        direction = np.sign(values[1])
        cosine, sine, turning = self._angle(values)
        share, share_slope = self._share(values, direction)
        q, q_slope = self.load.force(values, direction), self.load.slope(values)
        d = cosine - share * np.abs(sine)
        d_slope = -(sine + share * np.sign(sine) * cosine) * turning - share_slope * np.abs(sine)
        with np.errstate(divide="ignore", invalid="ignore"):
            return (q_slope * d - q * d_slope) / d**2

    def _normal(self, values: Values, direction: Floats) -> Floats:
        cosine, sine, _ = self._angle(values)
        share, _ = self._share(values, direction)
        d = cosine - share * np.abs(sine)
        return self.load.force(values, direction) / np.where(d > 0, d, np.nan)

    def _share(self, values: Values, direction: Floats) -> tuple[Floats, Floats]:
        """g with the sense of the motion, and its slope."""
        slope = -2 * self.guide.friction / self.guide.length * values[1]
        return direction * grip(self.guide, values[0]), direction * slope

    def _slip_on_rises(self, places: Places) -> Floats:
        cosine, sine, _ = self._angle(places.values)
        slip = grip(self.guide, places.values[0]) * np.abs(sine) / cosine
        return np.where(self.cam.motion.directions[places.phase] > 0, slip, np.nan)

    def _slip_slope(self, values: Values) -> Floats:
        """Of the sign of (g |tan alpha|)'."""
        cosine, sine, turning = self._angle(values)
        share, share_slope = self._share(values, np.ones_like(values[0]))
        return share_slope * np.abs(sine) * cosine + share * np.sign(sine) * turning

    def _check_jamming(self) -> None:
        efficiency, phi, _ = self.least_efficiency()
        if efficiency <= 0:
            alpha, limit = self.cam.pressure_angle(phi), jamming_angle(self.guide, self.cam.motion(phi)[0])
            allowed = f"less than the {math.degrees(limit):.4g} degrees at which the guide jams"
            remedy = "enlarge the prime radius, lengthen the guide or bring it nearer to the cam"
            raise DesignError("pressure angle", f"{math.degrees(alpha):.4g} degrees", allowed, remedy)

    def _angle(self, values: Values) -> tuple[Floats, Floats, Floats]:
        """cos and sin of the pressure angle, and its slope by phi."""
        q, q1 = self.cam.kinematics.pressure(values)
        size = np.hypot(*q)
        return q[0] / size, q[1] / size, pair_cross(q, q1) / size**2

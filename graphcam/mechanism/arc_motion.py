"""What a roller does on a cam of circular arcs: lift, velocity, acceleration and their jumps, from the arcs themselves.

A roller of radius R rolls its centre on the arcs moved outwards by R.  Each such arc passes through a point Q with the
inner unit normal n and the curvature kappa, so its points X = r u(phi) satisfy kappa |X - Q|^2/2 = (X - Q).n, or with
c = n + kappa Q (kappa times the centre)

    kappa r^2/2 + B r + E = 0,    B = -u.c,    E = kappa |Q|^2/2 + Q.n,

which holds for the flattest arc as well.  With u'' = -u, differentiated by phi:

    r' = -B' r/S,    r'' = (B r - (S' + B') r')/S,    r''' = (3 B r' + B' r - 3 S' r'')/S,

where S = kappa r + B = sqrt(1 - B'^2) is the cosine of the pressure angle.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError, check_number
from graphcam.given.extreme_search import SmoothPieces
from graphcam.given.impact import JUMP_ROUNDING, Jump
from graphcam.given.laws import Floats, Side
from graphcam.given.motion import CLOSURE_TOLERANCE, FULL_TURN, MotionValues, PhaseSpan, wrap
from graphcam.given.three_arcs import Point, ThreeArcs
from graphcam.mechanism.kinematics import Complexes, Values
from graphcam.mechanism.turn_extremes import Extreme
from graphcam.showing import Plottable, value_text
from graphcam.words import Caption, bare_caption, say

FIT_TOLERANCE = 1e-3
"""How far given points may miss the arcs, as a part of their distance from the cam centre: printed data are rounded."""
ARC_NAMES = ("AG", "GF", "FD")
"""The arcs of the flank, in the order in which the rise meets them."""


@dataclass(frozen=True, eq=False)
class ArcFlank:
    """One root of a three-arc cam; points are (2,) arrays in cam coordinates [mm].

    Attributes
    ----------
    given : the data it was found from
    A, D : where the first and the last arc touch the circles about the cam centre, found from their centres
    F, G : where the arcs touch each other
    C1, C2, C3 : centres of the arcs from F to D, from A to G and from G to F; C3 is NaN where the flank is straight
    rho1, rho2, rho3 : radii [mm]; rho3 is inf where the flank is straight
    hollow : whether the arc from G to F bends away from the cam
    sound : whether the profile can be built: F, C1, C3 and G, C3, C2 lie in these orders on their lines
    reason : why it is sound or not, in whole sentences
    """

    given: ThreeArcs
    A: Floats
    D: Floats
    F: Floats
    G: Floats
    C1: Floats
    C2: Floats
    C3: Floats
    rho1: float
    rho2: float
    rho3: float
    hollow: bool
    sound: bool
    reason: Caption

    @property
    def why(self) -> str:
        """The reason in English."""
        return str(self.reason)

    @property
    def straight(self) -> bool:
        """Whether the flank from G to F is a straight line."""
        return math.isinf(self.rho3)

    def outward_normals(self) -> Complexes:
        """Unit normals away from the cam in A, G, F and D."""
        a, g, f, d, c1, c2 = (complex(*getattr(self, name)) for name in ("A", "G", "F", "D", "C1", "C2"))
        return np.array([a / abs(a), (g - c2) / self.rho2, (f - c1) / self.rho1, d / abs(d)])

    def check(self) -> None:
        """Check that it is sound, and that A and D lie where their arcs touch the circles about the cam centre.

        Raises
        ------
        DesignError : it is not, or they do not
        """
        if not self.sound:
            raise DesignError("root", say("not sound"), say("one that can be built"), self.why)
        if not np.dot(self.A, self.A - self.C2) > 0:
            limit = say("so that the second arc goes around the cam centre")
            raise DesignError("C2", _point_text(self.C2), limit, say("move C2"))
        for name, arc, centre in (("A", "second", "C2"), ("D", "first", "C1")):
            found, given = getattr(self, name), getattr(self.given, name)
            if not np.all(np.isfinite(found)):
                limit = say("on the line from the cam centre to {name}", name=name)
                raise DesignError(centre, _point_text((0, 0)), limit, say("move {centre}", centre=centre))
            if given is not None and not math.dist(found, given) <= FIT_TOLERANCE * math.hypot(*given):
                where = say(
                    "{shown}, where the {arc} arc touches a circle about the cam centre",
                    shown=_point_text(found),
                    arc=arc,
                )
                remedy = say("make {name} and {centre} agree, or leave {centre} out", name=name, centre=centre)
                raise DesignError(name, _point_text(given), where, remedy)

    def turning(self) -> int:
        """sigma: +1 where the normal turns clockwise from A to D, -1 where it turns the other way.

        Raises
        ------
        DesignError : it does not turn the same way along every arc
        """
        outward = self.outward_normals()
        turning = np.angle(outward[1:] * np.conj(outward[:-1]))
        sigma = -1 if turning.sum() > 0 else 1
        for name, angle in zip(ARC_NAMES, -sigma * turning, strict=True):
            if not angle > 0:
                limit = say("greater than 0, in the sense from A to D")
                found = say("{degrees:.4g} degrees", degrees=math.degrees(angle))
                raise DesignError(say("angle of the arc {name}", name=name), found, limit, say("move G or C1"))
        return sigma


def _point_text(point: Point) -> Caption:
    x, y = point
    return bare_caption(f"({x + 0.0:.6g}, {y + 0.0:.6g})")  # with no sign at 0


@dataclass(frozen=True, eq=False)
class Arcs:
    """Arcs that the trace point follows, in the terms of the equation above: kappa [1/mm], c and E [mm], each (k,)."""

    curvature: Floats
    centre: Complexes
    power: Floats


@dataclass(frozen=True, eq=False, repr=False)
class ArcMotion(Plottable):
    """The motion s(phi) of a central translating follower; call it with cam angles [rad] for (s, v, a, j).

    The rise runs over the arcs AG, GF and FD, the return over their mirror image; between them the outer circle holds
    the follower for the angle ``dwell``, and for the rest of the turn the base circle.  phi = 0 where the rise begins.

    Parameters
    ----------
    cam : a sound root of :func:`~graphcam.mechanism.three_arc_cam.three_arc_cam`
    roller_radius : mm, 0 for a knife edge
    dwell : rad

    Raises
    ------
    DesignError : the root is not sound, the given A or D misses its arc, the arcs do not follow one another around the
        cam, the phases take more than a turn, or the pressure angle reaches 90 degrees

    >>> import graphcam as gc
    >>> motion = gc.ArcMotion(gc.three_arc_cam(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, A=(0, 40))[0], 10.0, 0.5)
    >>> s, v, a, j = motion(motion.breaks[1], side="left")
    >>> round(float(s), 4), round(float(v), 4), round(float(a), 4)
    (3.4297, 15.1134, 36.4642)
    >>> [round(jump.size, 3) for jump in motion.jumps[:4]]
    [30.092, -25.181, -96.294, 91.469]
    """

    _drawn_in = "motion_curves.plot"

    cam: ArcFlank
    roller_radius: float = 0.0
    dwell: float = 0.0
    sigma: int = field(init=False, repr=False)
    """+1 for a cam that turns counter-clockwise on the rise from A to D, -1 for clockwise"""
    arcs: Arcs = field(init=False, repr=False)
    """the rise's three arcs, the outer circle and the base circle"""
    edges: Floats = field(init=False, repr=False)
    """(8,) cam angles [rad] where the arcs begin: of the rise, the outer circle, the return, the base circle"""

    def __post_init__(self) -> None:
        for quantity, value in ((say("roller radius"), self.roller_radius), ("dwell", self.dwell)):
            check_number(quantity, value, say("a finite number of 0 or more"), least=0)
        self.cam.check()
        outward = self.cam.outward_normals()
        object.__setattr__(self, "sigma", self.cam.turning())
        points: Complexes = np.array([complex(*getattr(self.cam, name)) for name in "AGFD"])
        trace = points + self.roller_radius * outward
        r0, r1 = (abs(complex(points[k])) + self.roller_radius for k in (0, 3))
        object.__setattr__(self, "arcs", self._followed(trace, -outward, r0, r1))
        # The follower is never pushed across its guide: on an arc it is not, if at neither end of it.
        for name, n, z in zip("AGFD", outward.tolist(), trace.tolist(), strict=True):
            if not (n * z.conjugate()).real > 0:
                at = say("90 degrees or more at {name}", name=name)
                raise DesignError(say("pressure angle"), at, say("less than 90 degrees"), say("move G or C1"))
        object.__setattr__(self, "edges", self._edges(self.sigma * np.angle(trace[0] * np.conj(trace))))

    def _followed(self, trace: Complexes, inward: Complexes, r0: float, r1: float) -> Arcs:
        """The arcs through the trace points at A, G, F and D with these inner normals, and both circles."""
        kappa = 1 / (np.array([self.cam.rho2, self.cam.rho3, self.cam.rho1]) + self.roller_radius)
        # The first arc is known best where it leaves the base circle, the last where it reaches the outer one.
        known, inward = trace[[0, 1, 3]], inward[[0, 1, 3]]
        power = kappa * np.abs(known) ** 2 / 2 + (known * np.conj(inward)).real
        return Arcs(
            np.array([*kappa, 1 / r1, 1 / r0]),
            np.array([*(inward + kappa * known), 0, 0]),
            np.array([*power, -r1 / 2, -r0 / 2]),
        )

    def _edges(self, turned: Floats) -> Floats:
        """The cam angles where the arcs begin, from those of A, G, F and D on the rise."""
        rise, angles = float(turned[3]), np.degrees(turned[1:]).round(4).tolist()
        if not 0 < turned[1] < turned[2] < rise:
            found = say("{angles} degrees at G, F and D", angles=angles)
            raise DesignError("rise", found, say("growing angles"), say("move G or C1"))
        moving = 2 * rise + self.dwell
        if moving > FULL_TURN + CLOSURE_TOLERANCE:
            found = say("{degrees:.6g} degrees", degrees=math.degrees(moving))
            raise DesignError(say("rise, dwell and return"), found, say("at most a turn"), say("shorten the dwell"))
        return np.concatenate([turned, moving - turned[::-1]])

    @property
    def breaks(self) -> Floats:
        """The cam angles [rad] where one arc takes over from another, 0 among them."""
        return np.unique(self.edges[self.edges < FULL_TURN - CLOSURE_TOLERANCE])

    @property
    def timing(self) -> list[PhaseSpan]:
        """The kind of every phase, and the cam angles [rad] from which and to which it lasts."""
        ends = [0.0, *self.edges[[3, 4, 7]].tolist(), FULL_TURN]
        phases = zip(("rise", "dwell", "return", "dwell"), ends[:-1], ends[1:], strict=True)
        return [PhaseSpan(kind, start, end) for kind, start, end in phases if end - start > CLOSURE_TOLERANCE]

    def __repr__(self) -> str:
        phases = (f"{kind} {math.degrees(end - start):.6g}°" for kind, start, end in self.timing)
        sizes = f"prime radius {self.prime_radius:.6g} mm, roller radius {self.roller_radius:.6g} mm"
        last = "motion(phi) gives s, v, a and j at phi in rad; .jumps, .pitch_curve(phi); .plot() draws them"
        return value_text(f"ArcMotion with a lift of {self.lift:.6g} mm", (", ".join(phases), sizes), last)

    @property
    def rise(self) -> float:
        """The angle of the rise, and of the return [rad]."""
        return float(self.edges[3])

    @property
    def prime_radius(self) -> float:
        """The minimum distance of the trace point from the cam centre [mm]."""
        return float(1 / self.arcs.curvature[4])

    @property
    def lift(self) -> float:
        """The whole lift [mm]."""
        return float(1 / self.arcs.curvature[3]) - self.prime_radius

    def __call__(self, phi: ArrayLike, side: Side = "right") -> MotionValues:
        """(s, v, a, j) at cam angles phi [rad], any real numbers, each shaped like phi; NaN stays NaN.

        Where one arc takes over from another, the value of the named side.
        """
        arc, psi, direction = self._place(phi, side)
        r, r1, r2, r3 = self._radius(arc, psi)
        return MotionValues(r - self.prime_radius, direction * r1, r2, direction * r3)

    def at(self, arc: NDArray[np.intp], u: Floats) -> tuple[Floats, Values]:
        """The cam angle [rad] and (s, v, a, j) at the fraction u of an arc of the rise, both its ends seen from inside.

        arc : 0 for AG, 1 for GF, 2 for FD, as many as there are u
        """
        psi = self.edges[arc] + (self.edges[arc + 1] - self.edges[arc]) * u
        r, v, a, j = self._radius(arc, psi)
        return psi, (r - self.prime_radius, v, a, j)

    def pressure_angle(self, phi: ArrayLike) -> Floats:
        """alpha [rad] between the contact normal and the follower's motion: tan(alpha) = v/(r0 + s)."""
        s, v, _, _ = self(phi)
        return np.arctan2(v, self.prime_radius + s)

    def pitch_curve(self, phi: ArrayLike) -> Floats:
        """(..., 2) the trace point's path on the cam [mm]."""
        s, *_ = self(phi)
        z = self._start * np.exp(-1j * self.sigma * wrap(phi)) * (self.prime_radius + s)
        return np.stack([z.real, z.imag], axis=-1)

    def pitch_curvature(self, phi: ArrayLike, side: Side = "right") -> Floats:
        """Curvature kappa of the trace point's path on the cam [1/mm]: of each arc one."""
        return self.arcs.curvature[self._place(phi, side)[0]]

    @property
    def jumps(self) -> list[Jump]:
        """The soft impacts: where the acceleration jumps [mm/rad^2]; the velocity never does: the arcs are tangent."""
        phi = self.breaks
        before, after = self(phi, "left")[2], self(phi, "right")[2]
        jumped = np.abs(after - before) > JUMP_ROUNDING * np.abs(before).max()
        columns = (column[jumped].tolist() for column in (phi, before, after))
        return [Jump(*row) for row in zip(*columns, strict=True)]

    def max_velocity(self) -> Extreme:
        """The maximum |v| [mm/rad] of the turn and where on the rise [rad]."""
        return self._greatest(lambda r: r[1])

    def max_acceleration(self) -> Extreme:
        """The maximum |a| [mm/rad^2] of the turn, of both sides at a jump, and where on the rise [rad]."""
        return self._greatest(lambda r: r[2])

    def max_pressure_angle(self) -> Extreme:
        """The maximum pressure angle [rad] and where on the rise [rad]; on the return it is the same, negative."""
        return self._greatest(lambda r: np.arctan2(r[1], r[0]))

    # --- how it is found ---------------------------------------------------------------------------------------------

    @property
    def _start(self) -> complex:
        a = complex(*self.cam.A)
        return a / abs(a)

    def _place(self, phi: ArrayLike, side: Side) -> tuple[NDArray[np.intp], Floats, Floats]:
        """The arc of each cam angle, the angle at which the rise is on the same place of it, and the way it runs."""
        if side not in ("right", "left"):
            raise DesignError("side", side, say("'right' or 'left'"))
        flat = wrap(phi)
        if side == "left":
            flat = np.where(flat == 0, FULL_TURN, flat)
        piece = np.searchsorted(self.edges, flat, side=side) - 1
        back = piece >= 4
        arc = np.array([0, 1, 2, 3, 2, 1, 0, 4])[piece]
        psi = np.where(back, self.edges[-1] - flat, flat)
        return arc, psi, np.where(back, -1.0, 1.0)

    def _radius(self, arc: NDArray[np.intp], psi: Floats) -> Values:
        """r, r', r'', r''' of the trace point on an arc, at the angle psi from the start of the rise."""
        kappa, e = self.arcs.curvature[arc], self.arcs.power[arc]
        seen = self.arcs.centre[arc] * np.conj(self._start * np.exp(-1j * self.sigma * psi))
        b, b1 = -seen.real, self.sigma * seen.imag
        s = np.sqrt((1 - b1) * (1 + b1))
        # Of the two forms of the root the one without a difference of what is almost equal.
        far = b > 0
        r = np.where(far, -2 * e / np.where(far, b + s, 1.0), (s - b) / kappa)
        r1 = -b1 * r / s
        s1 = kappa * r1 + b1
        r2 = (b * r - (s1 + b1) * r1) / s
        return r, r1, r2, (3 * b * r1 + b1 * r - 3 * s1 * r2) / s

    def _greatest(self, value: Callable[[Values], Floats]) -> Extreme:
        """The value of maximum magnitude on the rise: at an end of an arc, or where it is stationary."""
        arc, start, end = np.arange(3), self.edges[:3], self.edges[1:4]
        on, inner = SmoothPieces(start, end).stationary(lambda arc, psi: value(self._radius(arc, psi)))
        arcs, psi = np.concatenate([arc, arc, on]), np.concatenate([start, end, inner])
        values = value(self._radius(arcs, psi))
        k = int(np.argmax(np.abs(values)))
        return Extreme(float(abs(values[k])), float(psi[k]))

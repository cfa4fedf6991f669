"""The least prime radius of an oscillating follower: the region for the cam centre, cut out by lines.

The arm is drawn in its positions about the pivot, the low one along the real axis, and along each the segment l v from
the trace point, outwards on a rise if cam and arm turn in opposite senses (sigma = +1), else inwards.  The cam centre
sees that arm at the pressure angle alpha, tan(alpha) = (l (1 + sigma v) - c cos(psi))/(c sin(psi)), so through each end
of l v go two lines at the limit A to the arm's normal, alpha <= A and alpha >= -A.  With R the vector from the start of
the lift to the cam centre (r0 = |R|, c = |l + R|, psi0 = arg(l + R)) and tau = +1 or -1 for the two, they are

    n . R >= h,   n = tau exp(i (tau A - s)),   h = tau l (sigma v cos A - 2 sin(s/2) sin(tau A - s/2)).

On a rise the velocity drives the angle towards the line tau = sigma, on a return towards tau = -sigma.  The other one
can only bind at rest: it gives way with |v|, and for v = 0 it leaves psi an arc, so that the lowest and the highest
lift decide.

Source: the shaded region of the textbooks on the theory of machines, written as inequalities.
"""

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import get_args

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.follower import Oscillating
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits
from graphcam.given.motion import Motion
from graphcam.mechanism.half_planes import HalfPlane, Kept, Line, nearest
from graphcam.mechanism.kinematics import Complexes, Values
from graphcam.mechanism.stationary import SAMPLES, smooth_pieces
from graphcam.plane import cross, dot

ROUNDING = 1e-15
"""How far a point may lie beyond a line and count as on it, relative to the arm and the distance from its start."""
KEPT = 1e-12
"""How far the least point may lie beyond a line, relative to the same, if the limits can be kept at all."""
SAME_PLACE = 1e-9
"""Fraction of a phase; at a greatest value a step this small no longer changes the value in double precision."""


@dataclass(frozen=True)
class ArmMinimumRadius:
    """The least permitted prime radius and the centre distance that goes with it [mm]; ``active`` names what binds."""

    prime_radius: float
    distance: float
    active: tuple[Line, ...]

    @property
    def place(self) -> float:
        """The distance: where the follower stands beside the cam [mm]."""
        return self.distance


def arm_minimum_radius(motion: Motion, follower: Oscillating, sigma: int, limits: Limits) -> ArmMinimumRadius:
    """The least prime radius for permitted pressure angles, with the follower's distance if it is given.

    With ``limits.rest`` |alpha| keeps the limit on every rise and, if there is one, on every return.  Without, a rise
    must only keep the side to which the velocity drives the angle, and so must a return; the arm must still reach,
    0 <= psi0 and psi0 + lift <= pi, and where that binds, a cam can only approach the radius.

    Raises
    ------
    DesignError : the lift is too large for the limits, or they cannot be kept at the given distance

    >>> from math import pi, radians
    >>> import graphcam as gc
    >>> swing = radians(20)
    >>> motion = gc.Motion([gc.Rise(swing, 2.0), gc.Return(swing, 2.0, "cosine"), gc.Dwell(2 * pi - 4)])
    >>> least = arm_minimum_radius(motion, gc.Oscillating(arm=80), +1, Limits(rise=radians(45)))
    >>> round(least.prime_radius, 4), round(least.distance, 4), least.active
    (11.2226, 88.2929, ('rise', 'rest'))
    """
    _check_lift(motion, limits)
    region = _Region(motion, follower.arm, sigma, limits)
    if follower.distance is None:
        point, lines = _exchange(region, 0j, nearest)
        distance = abs(follower.arm + point)
    else:
        distance = follower.distance
        arc = _Arc(follower.arm, distance)
        point, lines = _exchange(region, arc.point(0.0), arc.first)
        if region.worst(point, refined=True)[0] > KEPT * (follower.arm + abs(point)):
            free = arm_minimum_radius(motion, replace(follower, distance=None), sigma, limits)
            limit = "one at which the pressure angle can keep its limits over the whole swing"
            remedy = f"leave it open: the least prime radius has a centre distance of {free.distance:.6g} mm"
            raise DesignError("centre distance", distance, limit, remedy)
    active = tuple(name for name in get_args(Line) if any(line.name == name for line in lines))
    return ArmMinimumRadius(abs(point), distance, active)


def _check_lift(motion: Motion, limits: Limits) -> None:
    """Far from the arm the pressure angle is psi - 90 degrees: it must keep the limits on both sides."""
    back = math.pi / 2 if limits.return_ is None else limits.return_
    room = 2 * min(limits.rise, back) if limits.rest else limits.rise + back
    if motion.lift >= room:
        lift, limit = (f"{math.degrees(angle):g} degrees" for angle in (motion.lift, room))
        remedy = "permit larger pressure angles or swing the arm less"
        raise DesignError("lift", lift, f"less than {limit} for these limits", remedy)


# --- the lines -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Lines:
    """Lines through ends of l v at limits to the arm's normals: arrays, or one value for all, that go with the places.

    tau : +1 or -1, the side of the limit;  limit : the angle [rad];  sigma, arm : the cam's sense and l [mm]
    """

    tau: Floats
    limit: Floats
    sigma: int
    arm: float

    def normals(self, values: Values) -> Complexes:
        angle = self.tau * self.limit - values[0]
        return self.tau * (np.cos(angle) + 1j * np.sin(angle))

    def heights(self, values: Values) -> Floats:
        s, v, _, _ = values
        turned = 2 * np.sin(s / 2) * np.sin(self.tau * self.limit - s / 2)
        return self.tau * self.arm * (self.sigma * v * np.cos(self.limit) - turned)

    def excess(self, values: Values, point: complex) -> Floats:
        """How far the point lies outside of each line [mm]."""
        return self.heights(values) - dot(self.normals(values), np.asarray(point))

    def slopes(self, values: Values, point: complex) -> tuple[Floats, Floats]:
        """The first and the second derivative of the excess by phi."""
        s, v, a, j = values
        n, p = self.normals(values), np.asarray(point)
        force, angle = self.sigma * np.cos(self.limit), s - self.tau * self.limit
        arm = self.tau * self.arm
        first = arm * (force * a + v * np.sin(angle)) + v * cross(n, p)
        second = arm * (force * j + a * np.sin(angle) + v * v * np.cos(angle)) + a * cross(n, p) + v * v * dot(n, p)
        return first, second

    def half_planes(self, names: Sequence[Line], values: Values) -> list[HalfPlane]:
        """The lines of some places one by one."""
        parts = zip(names, self.normals(values), self.heights(values), strict=True)
        return [HalfPlane(name, complex(normal), float(height)) for name, normal, height in parts]


class _Region:
    """All lines of a motion: those on the driven sides at every place, those at rest or the reach of the arm."""

    def __init__(self, motion: Motion, arm: float, sigma: int, limits: Limits) -> None:
        self.motion, self.arm, self.sigma = motion, arm, sigma
        # Of every smooth piece of a limited phase: phase, direction, limit, and samples (pieces, n) of u and values.
        limit_of = {+1: limits.rise, 0: None, -1: limits.return_}
        phase, start, end = smooth_pieces(motion)
        limited = np.array([limit_of[motion.phases[k].direction] is not None for k in phase])
        self.phase, start, end = phase[limited], start[limited], end[limited]
        self.direction = np.array([motion.phases[k].direction for k in self.phase])
        self.limit = np.where(self.direction > 0, limits.rise, limits.return_ or 0.0)
        self.u = start[:, None] + (end - start)[:, None] * np.concatenate([[0.0], SAMPLES, [1.0]])
        self.values = motion.at(self.phase[:, None], self.u)
        self.fixed = self._at_rest(limits) if limits.rest else self._reach()

    def _at_rest(self, limits: Limits) -> list[HalfPlane]:
        """On the sides that are not driven, in the lowest and the highest position."""
        s, rest = np.array([0.0, self.motion.lift]), np.zeros(2)
        sides = [(-self.sigma, limits.rise), (self.sigma, limits.return_)]
        lines = [_Lines(np.full(2, tau), np.full(2, limit), self.sigma, self.arm) for tau, limit in sides if limit]
        return [half for some in lines for half in some.half_planes(("rest", "rest"), (s, rest, rest, rest))]

    def _reach(self) -> list[HalfPlane]:
        """The arm stays above the line of centres in its lowest and its highest position."""
        return [HalfPlane(None, 1j * cmath.exp(-1j * s), -self.arm * math.sin(s)) for s in (0.0, self.motion.lift)]

    def _driven(self, piece: NDArray[np.intp]) -> _Lines:
        return _Lines(self.sigma * self.direction[piece], self.limit[piece], self.sigma, self.arm)

    def worst(self, point: complex, *, refined: bool) -> tuple[float, HalfPlane]:
        """The line that the point lies farthest beyond, and by how much [mm]; of the samples, or of all places."""
        excess = self._driven(np.arange(self.phase.size)[:, None]).excess(self.values, point)
        piece, k = (np.array([index]) for index in np.unravel_index(np.argmax(excess), excess.shape))
        s, v, a, j = (value[piece, k] for value in self.values)
        places = [(piece, (s, v, a, j))]
        if refined:
            places.append(self._peaks(excess, point))
        lines = list(self.fixed)
        for pieces, values in places:
            names: list[Line] = ["rise" if direction > 0 else "return" for direction in self.direction[pieces]]
            lines += self._driven(pieces).half_planes(names, values)
        return max(((line.excess(point), line) for line in lines), key=lambda found: found[0])

    def _peaks(self, excess: Floats, point: complex) -> tuple[NDArray[np.intp], Values]:
        """The places where the excess may be worst inside the pieces, by Newton's method kept between samples."""
        before, here, after = excess[:, :-2], excess[:, 1:-1], excess[:, 2:]
        # A peak rises above its sample by an eighth of the second difference, if its neighbours are as far.
        may_be_worst = 3 * here - before - after >= max(0.0, excess.max())
        piece, k = np.nonzero((here > before) & (here >= after) & may_be_worst)
        phase, low, high = self.phase[piece], self.u[piece, k], self.u[piece, k + 2]
        angle = np.array([self.motion.phases[k].angle for k in phase])
        lines, u = self._driven(piece), self.u[piece, k + 1]
        while True:
            values = self.motion.at(phase, u)
            first, second = lines.slopes(values, point)
            low, high = np.where(first > 0, u, low), np.where(first > 0, high, u)
            newton = u - np.divide(first, second * angle, out=np.full_like(u, np.inf), where=second < 0)
            step = np.where((newton >= low) & (newton <= high), newton, (low + high) / 2) - u
            if np.abs(step).max(initial=0.0) <= SAME_PLACE:
                return piece, values
            u = u + step


# --- the least point -------------------------------------------------------------------------------------------------


def _exchange(region: _Region, point: complex, meet: Callable[[Sequence[HalfPlane]], Kept]) -> Kept:
    """The least point that keeps all lines: meet the lines that bind and the worst one, until none is worse.

    A place where the excess is greatest enters with the square of its error, so the exchange converges like Newton's
    method.
    """
    kept: tuple[HalfPlane, ...] = ()
    refined = True  # at first, because the one line that may bind alone must be the right one
    while True:
        beyond, line = region.worst(point, refined=refined)
        if beyond > ROUNDING * (region.arm + abs(point)):
            next_point, next_kept = meet((*kept, line))
            if abs(next_point) > abs(point):  # it grows until nothing but rounding is left
                point, kept, refined = next_point, next_kept, False
                continue
        if refined:
            return point, kept
        refined = True  # the samples keep, but what is between them?


@dataclass(frozen=True)
class _Arc:
    """The cam centres at a given distance from the pivot."""

    arm: float
    distance: float

    def point(self, psi0: float) -> complex:
        """R at that angle."""
        return (self.distance - self.arm) + 2j * self.distance * math.sin(psi0 / 2) * cmath.exp(0.5j * psi0)

    def first(self, lines: Sequence[HalfPlane]) -> Kept:
        """The point of the arc where psi0, as it grows, comes to keep the last line; R = 0 if the arc nowhere does."""
        line = lines[-1]
        cosine = (line.height + self.arm * line.normal.real) / self.distance
        if cosine > 1:
            return 0j, ()
        return self.point(cmath.phase(line.normal) - math.acos(cosine)), (line,)

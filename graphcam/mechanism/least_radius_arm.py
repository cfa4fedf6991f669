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
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, get_args

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.follower import Oscillating
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits
from graphcam.given.motion import Motion
from graphcam.mechanism.half_planes import HalfPlane, Kept, Line, nearest
from graphcam.mechanism.legs import Leg, Legs, sampled_legs

ROUNDING = 1e-15
"""How far a point may lie beyond a line and count as on it, relative to the arm and the distance from its start."""
KEPT = 1e-12
"""How far the least point may lie beyond a line, relative to the same, if the limits can be kept at all."""
SQUARED = 1e-5
"""A step of so small a part of the place leaves an error of its square, which changes a greatest value by no bit."""
PATIENCE = 12
"""Steps after which the search begins anew."""
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
    region, arm = _region(motion, follower.arm, sigma, limits), follower.arm
    if follower.distance is None:
        point, lines, _ = _least(region, 0j, lambda lines: nearest((*lines, *region.fixed)))
        distance = abs(arm + point)
    else:
        distance = follower.distance
        arc = _Arc(arm, distance)
        point, lines, beyond = _least(region, arc.point(0.0), arc.first)
        if beyond > KEPT * (arm + abs(point)):
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


class _Touch(NamedTuple):
    """Where a line touches: a side, a place w of a leg, the ends of its smooth piece, and three derivatives of f there."""

    side: "_Side"
    leg: Leg
    w: float
    low: float
    high: float
    derivatives: list[float]


class _Side(NamedTuple):
    """The lines on the side to which the velocity drives the angle, of all rises or of all returns.

    tau : +1 or -1, the side of the limit [rad];  legs : with their places;  outer : l cos(A) (|v| + tau) at each
    """

    name: Line
    tau: int
    limit: float
    arm: float
    legs: Legs
    outer: Floats

    def excess(self, point: complex) -> Floats:
        """How far the point lies beyond the line of each place [mm]: l cos(A) (|v| + tau) - tau c cos(psi - tau A)."""
        from_pivot = self.arm + point
        beyond = self.legs.s + (cmath.phase(from_pivot) - self.tau * self.limit)
        np.cos(beyond, beyond)
        beyond *= -self.tau * abs(from_pivot)
        beyond += self.outer
        return beyond

    def number(self, k: int, point: complex) -> HalfPlane:
        """The line of the k-th place; at a break it belongs to the piece into which the excess grows."""
        legs = self.legs
        leg, w = legs.legs[bisect_right(legs.first, k) - 1], legs.w.item(k)
        ends = (0.0, *leg.law.breaks, 1.0)
        piece = min(bisect_right(ends, w), len(ends) - 1)
        line = self.line(leg, w, ends[piece - 1], ends[piece])
        if w == ends[piece - 1] and piece > 1 and _slopes(line, point)[0] <= 0:
            return self.line(leg, w, ends[piece - 2], w)
        return line

    def line(self, leg: Leg, w: float, low: float, high: float) -> HalfPlane:
        """The line of a place of a smooth piece between two others."""
        f, f1, f2, f3 = leg.law.at(w, "left" if w == high else "right")
        s, turned = leg.low + leg.lift * f, self.tau * self.limit
        direct, half = turned - s, s / 2
        lowered = 2 * self.tau * math.sin(half) * math.sin(turned - half)
        height = self.arm * (math.cos(self.limit) * leg.rate * f1 - lowered)
        normal = complex(self.tau * math.cos(direct), self.tau * math.sin(direct))
        return HalfPlane(self.name, normal, height, _Touch(self, leg, w, low, high, [f1, f2, f3]))


def _slopes(line: HalfPlane, point: complex) -> tuple[float, float]:
    """The first and the second derivative of the excess by w."""
    side, (_, lift, rate, _), _, _, _, (f1, f2, f3) = line.touch
    seen = line.normal.conjugate() * (side.arm + point)
    pushed = side.arm * math.cos(side.limit) * rate
    return pushed * f2 + lift * f1 * seen.imag, pushed * f3 + lift * (f2 * seen.imag + lift * f1 * f1 * seen.real)


def _higher(line: HalfPlane, point: complex, low: float, high: float) -> float:
    """By Newton's method the place between two others where the excess is greatest, from that of the line."""
    first, second = _slopes(line, point)
    w = line.touch.w
    if not first:
        return w
    if second < 0:
        return min(max(w - first / second, low), high)
    return (w + (high if first > 0 else low)) / 2


class _Region(NamedTuple):
    """All lines of a motion: those on the driven sides, and those at rest or the reach of the arm."""

    arm: float
    sides: list[_Side]
    fixed: list[HalfPlane]


def _region(motion: Motion, arm: float, sigma: int, limits: Limits) -> _Region:
    sides: list[_Side] = []
    fixed: list[HalfPlane] = []
    for name, direction, limit in (("rise", +1, limits.rise), ("return", -1, limits.return_)):
        if limit is not None:
            tau, legs, steep = sigma * direction, sampled_legs(motion, direction), arm * math.cos(limit)
            sides.append(_Side(name, tau, limit, arm, legs, steep * legs.v + tau * steep))
            if limits.rest:
                fixed += [_rest_line(-tau, limit, s, arm) for s in (0.0, motion.lift)]
    if not limits.rest:  # the arm stays above the line of centres in its lowest and its highest position
        fixed = [HalfPlane(None, 1j * cmath.exp(-1j * s), -arm * math.sin(s)) for s in (0.0, motion.lift)]
    return _Region(arm, sides, fixed)


def _rest_line(tau: int, limit: float, s: float, arm: float) -> HalfPlane:
    """The limit on the side that is not driven, in a position of rest."""
    lowered = 2 * tau * math.sin(s / 2) * math.sin(tau * limit - s / 2)
    return HalfPlane("rest", cmath.rect(tau, tau * limit - s), -arm * lowered)


# --- the least point -------------------------------------------------------------------------------------------------

Meet = Callable[[Sequence[HalfPlane]], Kept]


def _least(region: _Region, point: complex, meet: Meet) -> tuple[complex, tuple[HalfPlane, ...], float]:
    """The least point that keeps all lines, those that hold it off, and how far it still lies beyond one [mm].

    The lines that bind and the worst one meet, and touch anew where they meet, until no other is worse.
    """
    kept: tuple[HalfPlane, ...] = ()
    while True:
        worst = _worst(region, point, kept)
        if worst is None:
            return point, kept, 0.0
        beyond, line = worst
        next_point, next_kept = _touching(meet, *meet((*kept, line)))
        if abs(next_point) <= abs(point):  # it grows until nothing but rounding is left
            return point, kept, beyond
        point, kept = next_point, next_kept


def _touching(meet: Meet, point: complex, kept: tuple[HalfPlane, ...]) -> Kept:
    """The same lines where they touch best, and where they meet then.

    A place where the excess is greatest enters with the square of its error, so this converges like Newton's method;
    wherever it stops, no permitted point is nearer.
    """
    for _ in range(PATIENCE if kept else 0):
        moved, far = [], 0.0
        for line in kept:
            if line.touch:
                side, leg, w, low, high, _ = line.touch
                place = _higher(line, point, low, high)
                far = max(far, abs(place - w) - SQUARED * place)
                line = side.line(leg, place, low, high)
            moved.append(line)
        point, kept = meet(moved)
        if far <= 0:
            break
    return point, kept


def _worst(region: _Region, point: complex, kept: Sequence[HalfPlane]) -> tuple[float, HalfPlane] | None:
    """A line that the point lies beyond, and by how far [mm]; None if it keeps all but what rounding leaves."""
    rounding, found = ROUNDING * (region.arm + abs(point)), list(region.fixed)
    excesses = [side.excess(point) for side in region.sides]
    for side, excess in zip(region.sides, excesses, strict=True):
        k = int(excess.argmax())
        if excess[k] > rounding:
            found.append(side.number(k, point))
    if (worst := _farthest(found, point))[0] > rounding:
        return worst
    peaks = [
        _refined(side.number(k, point), point, side.legs.w.item(k - 1), side.legs.w.item(k + 1))
        for side, excess in zip(region.sides, excesses, strict=True)
        for k in _peaks(side, excess, kept)
    ]
    return worst if peaks and (worst := _farthest(peaks, point))[0] > rounding else None


def _farthest(lines: Sequence[HalfPlane], point: complex) -> tuple[float, HalfPlane]:
    return max([(line.excess(point), line) for line in lines], key=lambda found: found[0])


def _peaks(side: _Side, excess: Floats, kept: Sequence[HalfPlane]) -> list[int]:
    """The numbers of places beside which the excess may exceed 0, but for those where a line touches already."""
    rising = excess[1:] > excess[:-1]
    found: list[int] = []
    for k in ((rising[:-1] > rising[1:]).nonzero()[0] + 1).tolist():
        before, here, after = excess[k - 1 : k + 2].tolist()
        # A peak rises above its sample by an eighth of the second difference, if its neighbours are as far.
        if 3 * here - before - after >= 0:
            leg, w = side.legs.legs[bisect_right(side.legs.first, k) - 1], side.legs.w
            touched = [line.touch for line in kept if line.touch and line.touch.side is side]
            if not any(touch.leg is leg and w[k - 1] <= touch.w <= w[k + 1] for touch in touched):
                found.append(k)
    return found


def _refined(line: HalfPlane, point: complex, low: float, high: float) -> HalfPlane:
    """The line between two places that the point lies farthest beyond."""
    side, leg, _, begin, end, _ = line.touch
    low, high = max(low, begin), min(high, end)
    while True:
        w = line.touch.w
        slope = _slopes(line, point)[0]
        low, high = (w, high) if slope > 0 else (low, w)
        place = _higher(line, point, low, high)
        if abs(place - w) <= SAME_PLACE:
            return line
        line = side.line(leg, place, begin, end)


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

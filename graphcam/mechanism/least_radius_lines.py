"""The minimum prime radius of a follower with a roller: the region for the cam centre, cut out by lines.

Source: the shaded region of the textbooks on the theory of machines, written as inequalities.

A translating follower: with e' = sigma e the pressure angle is permitted on the rises and on the returns, their ends
included, where

    s0 tan A  + e' >= M,    M  = max over the rises of (v - s tan A)
    s0 tan A  - e' >= 0
    s0 tan A' - e' >= M',   M' = max over the returns of (|v| - s tan A')
    s0 tan A' + e' >= 0

so the cam centre lies in a region bounded by lines, and r0 is its distance from the start of the lift.  The second and
the fourth, of |alpha| in the lower dwell, say that the angle keeps its limit on the side to which no velocity drives
it: there |v| and s only help, so the end of the phase decides.

An arm is drawn in its positions about the pivot, the low one along the real axis, and along each the segment l v from
the trace point, outwards on a rise if cam and arm turn in opposite senses (sigma = +1), else inwards.  The cam centre
sees that arm at the pressure angle alpha, tan(alpha) = (l (1 + sigma v) - c cos(psi))/(c sin(psi)), so through each end
of l v go two lines at the limit A to the arm's normal, alpha <= A and alpha >= -A.  With R the vector from the start of
the lift to the cam centre (r0 = |R|, c = |l + R|, psi0 = arg(l + R)) and tau = +1 or -1 for the two, they are

    n . R >= h,   n = tau exp(i (tau A - s)),   h = tau l (sigma v cos A - 2 sin(s/2) sin(tau A - s/2)).

On a rise the velocity drives the angle towards the line tau = sigma, on a return towards tau = -sigma.  The other one
can only bind at rest: it gives way with |v|, and for v = 0 it leaves psi an arc, so that the lowest and the highest
lift decide.

With P = l + R, the vector from the pivot to the cam centre, |P| = c, the point R lies beyond the line of a place by

    E = l cos(A) (|v| + tau) - tau c cos(psi - tau A),   E' = l cos(A) |v|' + s' (conj(n) P).imag

where w is the fraction of a leg from its lower end, and a dash is the derivative by it.
"""

from __future__ import annotations

import cmath
import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import Any, Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError, check_number
from graphcam.given.extreme_search import SmoothPieces
from graphcam.given.follower import Limits, Oscillating, Translating, swing_remedy
from graphcam.given.laws import Floats
from graphcam.given.motion import Dwell, Motion
from graphcam.given.motion_law import Law
from graphcam.words import say, sequence

# --- lines that bound the region -------------------------------------------------------------------------------------

Line = Literal["rise", "return", "rest"]
LINE_NAMES: tuple[Line, ...] = get_args(Line)


class HalfPlane(NamedTuple):
    """The points R with normal . R >= height; the reach of the arm, which no limit sets, has no name.

    touch : where on the motion the line touches, if it goes along with a place of it
    """

    name: Line | None
    normal: complex
    height: float
    touch: Any = None

    def excess(self, point: complex) -> float:
        """How far the point lies outside [mm]."""
        return self.height - (self.normal.conjugate() * point).real


NearestPoint = tuple[complex, tuple[HalfPlane, ...]]
"""A point, and the lines that hold it off."""


def nearest_point(lines: Sequence[HalfPlane]) -> NearestPoint:
    """The point nearest to the start of the lift that keeps the lines, and the one or two that hold it off.

    One line after another is taken in.  The point stays if it keeps the next one too, else it moves onto that one.

    Source: R. Seidel, *Small-dimensional linear programming and convex hulls made easy*, Discrete & Computational
    Geometry 6 (1991), 423-434.

    >>> point, kept = nearest_point([HalfPlane("rise", 1j, 3.0), HalfPlane("return", 1 + 0j, 4.0)])
    >>> abs(point), [line.name for line in kept]
    (5.0, ['return', 'rise'])
    """
    point, kept = 0j, ()
    for k, line in enumerate(lines):
        _, normal, height, _ = line
        if normal.real * point.real + normal.imag * point.imag < height:
            point, kept = _nearest_on_line(line, lines[:k])
    return point, kept


def _nearest_on_line(line: HalfPlane, others: Sequence[HalfPlane]) -> NearestPoint:
    """The nearest point that keeps the others on one of the lines, whose points are (height + i t) normal."""
    _, normal, height, _ = line
    along, at, low, high = normal.conjugate(), None, -math.inf, math.inf
    for other in others:
        between = along * other.normal  # cosine and sine of the angle between the normals
        if not between.imag:
            continue
        t = (other.height - height * between.real) / between.imag
        if between.imag > 0 and t > low:
            low, at = t, other if t > 0 else at
        elif between.imag < 0 and t < high:
            high, at = t, other if t < 0 else at
    if at is None:
        return height * normal, (line,)
    return 1j * (at.height * normal - height * at.normal) / (along * at.normal).imag, (line, at)


# --- places on the legs ----------------------------------------------------------------------------------------------

PHASE_PLACES = 96
"""Places on a whole phase, denser at the ends of its smooth pieces ..."""
MIN_PIECE_PLACES = 16
"""The minimum number of places on a piece, however short."""
END_PLACES = np.logspace(-12, -4, 25)
"""Places nearer the phase's ends, where a steep limit moves the extremes to."""


class OneLeg(NamedTuple):
    """A rise, or a return as if time ran backwards: s = low + lift f(w), |v| = lift/angle f'(w).

    law : as seen from the lower end;  angle : rad;  low : s of the lower end
    """

    law: Law
    lift: float
    angle: float
    low: float


class LegPlaces(NamedTuple):
    """The rises or the returns of a motion, with their places in one row.

    first : where each leg's places begin, and the count of all;  w : fractions of the leg, from its lower end
    s, v : s and |v|
    """

    legs: tuple[OneLeg, ...]
    first: tuple[int, ...]
    w: Floats
    s: Floats
    v: Floats

    def leg_of(self, k: int) -> OneLeg:
        """The leg that the k-th place belongs to."""
        return self.legs[bisect_right(self.first, k) - 1]


@lru_cache(maxsize=64)
def legs(motion: Motion, direction: int) -> tuple[OneLeg, ...]:
    """The rises (direction +1) or the returns (-1) of a motion.  They are kept, for it is sized again and again.

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, 1.0, "cosine"), gc.Return(30, 2 * pi - 1.0, "2-3")])
    >>> [(leg.law.name, leg.lift, leg.low) for leg in legs(motion, -1)]
    [('2-3', 30, 0.0)]
    """
    found: list[OneLeg] = []
    for k, phase in enumerate(motion.phases):
        if phase.direction == direction and not isinstance(phase, Dwell):
            law, low = (phase.normalised, k) if direction > 0 else (phase.normalised.reversed, k + 1)
            found.append(OneLeg(law, phase.lift, phase.angle, motion.levels.item(low)))
    return tuple(found)


@lru_cache(maxsize=64)
def sampled_legs(motion: Motion, direction: int) -> LegPlaces:
    """The rises or the returns of a motion, each with places on it.

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, 1.0, "cosine"), gc.Return(30, 2 * pi - 1.0, "2-3")])
    >>> sampled_legs(motion, +1).s[[0, -1]].tolist()
    [0.0, 30.0]
    """
    found = legs(motion, direction)
    places = [_places(leg.law) for leg in found]
    first = np.cumsum([0, *(part.shape[1] for part in places)]).tolist()
    s = [leg.low + leg.lift * f for leg, (_, f, _) in zip(found, places, strict=True)]
    v = [leg.lift / leg.angle * f1 for leg, (_, _, f1) in zip(found, places, strict=True)]
    w = [w for w, _, _ in places]
    return LegPlaces(found, tuple(first), *map(np.concatenate, (w, s, v)))


@lru_cache(maxsize=64)
def _places(law: Law) -> Floats:
    """(3, n) places w, and f and f' there."""
    pieces = pairwise((0.0, *law.breaks, 1.0))
    inside = [
        begin
        + (end - begin)
        * np.sin(np.linspace(0, np.pi / 2, max(MIN_PIECE_PLACES, round(PHASE_PLACES * (end - begin))))) ** 2
        for begin, end in pieces
    ]
    w = np.unique(np.concatenate([END_PLACES, *inside, 1 - END_PLACES]))
    return np.array([w, *law(w, derivatives=1)])


# --- a translating follower ------------------------------------------------------------------------------------------

GROWING_PLACES = 0.3 * 4.0 ** np.arange(60)
"""Places, over a small one, between which a law grows by no more than some powers of four."""


@dataclass(frozen=True)
class MinimumRadius:
    """The minimum permitted prime radius and its offset [mm]; ``active`` names the active lines, or the curvature."""

    prime_radius: float
    offset: float
    active: tuple[Line | Literal["curvature"], ...]
    place_name = "offset"

    @property
    def place(self) -> float:
        """The offset: where the follower stands beside the cam [mm]."""
        return self.offset


def translating_minimum_radius(
    motion: Motion, follower: Translating, sigma: int, limits: Limits, offset: float | None = None
) -> MinimumRadius:
    """The minimum prime radius for permitted pressure angles, at an offset [mm] if it is given; not the follower's own.

    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, math.pi / 2, "cosine"), gc.Return(30, math.pi / 2, "cosine"),
    ...     gc.Dwell(math.pi)])
    >>> least = translating_minimum_radius(motion, gc.Translating(), +1, Limits())
    >>> round(least.prime_radius, 4), round(least.offset, 4), least.active
    (22.5647, 11.2824, ('rise', 'rest'))
    """
    lines = _boundaries(motion, limits)
    if offset is None:
        centre, kept = nearest_point(lines)
        return MinimumRadius(abs(centre), sigma * centre.real, _names(kept))
    check_number("offset", offset, say("a finite length in mm"), say("leave it out to let it be found"))
    across = sigma * offset
    needed = [(line.height - line.normal.real * across) / line.normal.imag for line in lines]
    s0 = max(0.0, *needed)
    kept = [line for line, least in zip(lines, needed, strict=True) if least == s0 > 0]
    return MinimumRadius(math.hypot(offset, s0), offset, _names(kept))


def _boundaries(motion: Motion, limits: Limits) -> list[HalfPlane]:
    """The lines that bound the region of e' + i s0, each on the side to which the velocity drives the angle first."""
    driven: list[HalfPlane] = []
    resting: list[HalfPlane] = []
    limited: tuple[tuple[Line, int, float | None], ...] = ("rise", +1, limits.rise), ("return", -1, limits.return_)
    for name, direction, limit in limited:
        if limit is not None:
            across, up = math.cos(limit), math.sin(limit)
            height = across * _steepest_line(motion, direction, math.tan(limit))
            driven.append(HalfPlane(name, complex(direction * across, up), height))
            resting.append(HalfPlane("rest", complex(-direction * across, up), 0.0))
    return [*driven, *resting] if limits.rest else driven


def _names(lines: Sequence[HalfPlane]) -> tuple[Line, ...]:
    found = {line.name for line in lines}
    return tuple(name for name in LINE_NAMES if name in found)


def _steepest_line(motion: Motion, direction: int, slope: float) -> float:
    """M or M': the maximum |v| - s * slope over all rises or all returns [mm/rad]."""
    heights: list[float] = []
    for law, lift, angle, low in legs(motion, direction):
        heights.append(lift / angle * steepest_tangent(law, 1 / (slope * angle))[1] - slope * low)
    return max(heights)


def steepest_tangent(law: Law, k: float) -> tuple[float, float]:
    """The u at which f' - f/k is largest, k = cot(A)/F, and that value.

    There the tangent at the angle A touches the s - v diagram, and it meets the axis of v at that height.

    >>> import graphcam as gc
    >>> u, height = steepest_tangent(gc.law("cosine"), 1.5)
    >>> round(u, 12), round(height, 12)
    (0.433439924624, 1.272441311934)
    """
    if closed_form := law.tangents[0]:
        return closed_form(k)

    def height(_: NDArray[np.intp], u: Floats) -> Floats:
        """k f' - f, a pure number."""
        f, f1 = law(u, derivatives=1)
        return k * f1 - f

    # Of a law that begins as u^n the place is (n - 1) k for small k, and the height as small as k^n.
    growing = k * GROWING_PLACES
    edges = np.unique([0.0, *law.breaks, *growing[growing < 1], 1.0])
    _, inside = SmoothPieces(edges[:-1], edges[1:]).stationary(height, np.arange(edges.size - 1))
    places = np.concatenate([edges, inside])
    f, f1 = law(places, derivatives=1)
    heights = f1 - f / k
    best = np.argmax(heights)
    return float(places[best]), float(heights[best])


# --- an arm ----------------------------------------------------------------------------------------------------------

LINE_ROUNDING = 1e-15
"""How far a point may lie beyond a line and count as on it, relative to the arm and the distance from its start."""
KEPT_TOLERANCE = 1e-12
"""How far the minimum point may lie beyond a line, relative to the same, if the limits can be kept at all."""
SQUARED_ERROR_STEP = 1e-6
"""A step of so small a part of the place leaves an error of its square, which changes a maximum value by no bit."""
MAX_STEPS = 12
"""Steps after which the search begins anew."""
SAME_PLACE = 1e-9
"""Fraction of a phase; at a greatest value a step this small no longer changes the value in double precision."""


class Side(NamedTuple):
    """The lines of all rises or of all returns.

    tau : +1 or -1, the side of the limit [rad];  force : l cos(A) [mm]
    """

    name: Line
    tau: int
    limit: float
    arm: float
    force: float
    legs: LegPlaces

    def excess(self, point: complex) -> Floats:
        """How far the point lies beyond the line of each place, over l cos(A), less tau."""
        from_pivot = self.arm + point
        beyond = self.legs.s + (cmath.phase(from_pivot) - self.tau * self.limit)
        np.cos(beyond, beyond)
        beyond *= -self.tau * abs(from_pivot) / self.force
        beyond += self.legs.v
        return beyond

    def peaks(self, excess: Floats, kept: Sequence[HalfPlane]) -> list[int]:
        """The numbers of places beside which the excess may exceed 0, but for those where a line touches already."""
        rising = excess[1:] > excess[:-1]
        found: list[int] = []
        for k in (rising[:-1] > rising[1:]).nonzero()[0].tolist():
            before, here, after = excess[k : k + 3].tolist()
            # A peak rises above its sample by an eighth of the second difference, if its neighbours are as far.
            if 3 * here - before - after + self.tau >= 0 and not [
                line for line in kept if self._touches_beside(line, k + 1)
            ]:
                found.append(k + 1)
        return found

    def _touches_beside(self, line: HalfPlane, k: int) -> bool:
        if line.touch is None or line.touch.side is not self or not line.touch.low < line.touch.w < line.touch.high:
            return False  # at the end of its piece a line may touch, and the excess grow on in the next one
        w = self.legs.w
        return line.touch.leg is self.legs.leg_of(k) and w.item(k - 1) <= line.touch.w <= w.item(k + 1)

    def number(self, k: int, point: complex) -> HalfPlane:
        """The line of the k-th place; at a break it belongs to the piece into which the excess grows."""
        leg, w = self.legs.leg_of(k), self.legs.w.item(k)
        ends = (0.0, *leg.law.breaks, 1.0)
        piece = bisect_right(ends, w, hi=len(ends) - 1)
        line = self.line(leg, w, ends[piece - 1], ends[piece])
        if 0 < w == ends[piece - 1] and slopes(line, point)[0] <= 0:
            return self.line(leg, w, ends[piece - 2], w)
        return line

    def line(self, leg: OneLeg, w: float, low: float, high: float) -> HalfPlane:
        """The line of a place of a smooth piece between two others."""
        f, f1, f2, f3 = leg.law.at(w, "left" if w == high else "right")
        half, turned = (leg.low + leg.lift * f) / 2, self.tau * self.limit
        lowered = 2 * self.arm * math.sin(half) * math.sin(turned - half)
        height = self.force * leg.lift / leg.angle * f1 - self.tau * lowered
        return HalfPlane(
            self.name, cmath.rect(self.tau, turned - 2 * half), height, Touch(self, leg, w, low, high, f1, f2, f3)
        )

    def greatest(self, k: int, point: complex) -> HalfPlane:
        """The line, of those beside the k-th place, that the point lies farthest beyond."""
        line = self.number(k, point)
        low, high = max(line.touch.low, self.legs.w.item(k - 1)), min(line.touch.high, self.legs.w.item(k + 1))
        while True:
            leg, w = line.touch.leg, line.touch.w
            low, high = (w, high) if slopes(line, point)[0] > 0 else (low, w)
            place = higher(line, point, low, high)
            if abs(place - w) <= SAME_PLACE:
                return line
            line = self.line(leg, place, line.touch.low, line.touch.high)


class Touch(NamedTuple):
    """A place at which a line touches: side, place w of a leg, ends of its smooth piece, and f', f'', f''' there."""

    side: Side
    leg: OneLeg
    w: float
    low: float
    high: float
    f1: float
    f2: float
    f3: float


def slopes(line: HalfPlane, point: complex) -> tuple[float, float]:
    """The first and the second derivative of the excess by w."""
    side, leg, _, _, _, f1, f2, f3 = line.touch
    seen, along, pushed = line.normal.conjugate() * (side.arm + point), leg.lift * f1, side.force * leg.lift / leg.angle
    return pushed * f2 + along * seen.imag, pushed * f3 + leg.lift * f2 * seen.imag + along * along * seen.real


def higher(line: HalfPlane, point: complex, low: float, high: float) -> float:
    """The place between two others to which Newton's method goes for the greatest excess."""
    first, second = slopes(line, point)
    w = line.touch.w
    if not first:
        return w
    if second < 0:
        step = w - first / second
        return min(max(step, low), high)
    return (w + (high if first > 0 else low)) / 2


@dataclass(frozen=True)
class ArmMinimumRadius:
    """The minimum permitted prime radius and its centre distance [mm]; ``active`` names the active limits."""

    prime_radius: float
    distance: float
    active: tuple[Line | Literal["curvature"], ...]
    place_name = "distance"

    @property
    def place(self) -> float:
        """The distance: where the follower stands beside the cam [mm]."""
        return self.distance


def arm_minimum_radius(motion: Motion, follower: Oscillating, sigma: int, limits: Limits) -> ArmMinimumRadius:
    """The minimum prime radius for permitted pressure angles, with the follower's distance if it is given.

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
    if (found := _least(motion, follower, sigma, limits)) is not None:
        return found
    free = arm_minimum_radius(motion, replace(follower, distance=None), sigma, limits)
    limit = say("one at which the pressure angle can keep its limits over the whole swing")
    remedy = say("leave it open: the minimum prime radius has a centre distance of {distance:.6g} mm")
    remedy = remedy.with_values(distance=free.distance)
    if (other := _least(motion, follower, -sigma, limits)) is not None:
        turned = say("or turn the cam the other way, with a minimum prime radius of {radius:.5g} mm")
        remedy = sequence([remedy, turned.with_values(radius=other.prime_radius)])
    raise DesignError(say("centre distance"), say("{length:g} mm", length=follower.distance), limit, remedy)


def _least(motion: Motion, follower: Oscillating, sigma: int, limits: Limits) -> ArmMinimumRadius | None:
    """The minimum, or None where the limits are exceeded at the given distance whatever the prime radius."""
    region, arm, distance = _region(motion, follower.arm, sigma, limits), follower.arm, follower.distance
    if distance is None:
        point, lines, _ = _nearest_permitted(region, 0j, nearest_point)
        distance = abs(arm + point)
    else:
        arc = _Arc(arm, distance)
        point, lines, beyond = _nearest_permitted(region, arc.point(0.0), arc.first)
        if beyond > KEPT_TOLERANCE * (arm + abs(point)):
            return None
    return ArmMinimumRadius(abs(point), distance, _names(lines))


def _check_lift(motion: Motion, limits: Limits) -> None:
    """Far from the arm the pressure angle is psi - 90 degrees: it must keep the limits on both sides."""
    back = math.pi / 2 if limits.return_ is None else limits.return_
    room = 2 * min(limits.rise, back) if limits.rest else limits.rise + back
    if motion.lift >= room:
        lift, limit = (say("{angle:g} degrees", angle=math.degrees(angle)) for angle in (motion.lift, room))
        remedy = say("permit larger pressure angles or swing the arm less")
        remedy = swing_remedy(motion.lift, remedy)
        raise DesignError("lift", lift, say("less than {limit} for these limits", limit=limit), remedy)


class _Region(NamedTuple):
    """All lines of a motion: those on the driven sides, and those at rest or the reach of the arm."""

    arm: float
    sides: list[Side]
    fixed: list[HalfPlane]

    def exceeded_lines(self, point: complex, kept: Sequence[HalfPlane]) -> list[HalfPlane]:
        """The worst line of each side that the point lies beyond by more than rounding; the farthest last."""
        rounding, lines = LINE_ROUNDING * (self.arm + abs(point)), self.fixed
        excesses = [(side, side.excess(point)) for side in self.sides]
        for side, excess in excesses:
            k = int(excess.argmax())
            if (excess.item(k) + side.tau) * side.force > rounding:
                lines = [*lines, side.number(k, point)]
        if found := _lines_exceeded(lines, point, rounding):
            return found
        return _lines_exceeded(
            [side.greatest(k, point) for side, x in excesses for k in side.peaks(x, kept)], point, rounding
        )


def _lines_exceeded(lines: Sequence[HalfPlane], point: complex, rounding: float) -> list[HalfPlane]:
    found = [line for line in lines if line.excess(point) > rounding]
    return sorted(found, key=lambda line: line.excess(point)) if len(found) > 1 else found


def _region(motion: Motion, arm: float, sigma: int, limits: Limits) -> _Region:
    sides: list[Side] = []
    fixed: list[HalfPlane] = []
    limited: tuple[tuple[Line, int, float | None], ...] = ("rise", +1, limits.rise), ("return", -1, limits.return_)
    for name, direction, limit in limited:
        if limit is not None:
            tau, legs = sigma * direction, sampled_legs(motion, direction)
            sides.append(Side(name, tau, limit, arm, arm * math.cos(limit), legs))
            if limits.rest:
                fixed += [_rest_line(-tau * limit, -tau, s, arm) for s in (0.0, motion.lift)]
    if not limits.rest:  # the arm stays above the line of centres in its lowest and its highest position
        fixed = [HalfPlane(None, 1j * cmath.exp(-1j * s), -arm * math.sin(s)) for s in (0.0, motion.lift)]
    return _Region(arm, sides, fixed)


def _rest_line(turned: float, tau: int, s: float, arm: float) -> HalfPlane:
    """The limit on the side that is not driven, in a position of rest."""
    height = -2 * tau * arm * math.sin(s / 2) * math.sin(turned - s / 2)
    return HalfPlane("rest", cmath.rect(tau, turned - s), height)


def _nearest_permitted(
    region: _Region, point: complex, meet: Callable[[Sequence[HalfPlane]], NearestPoint]
) -> tuple[complex, tuple[HalfPlane, ...], float]:
    """The minimum point that keeps all lines, those that hold it off, and how far it still lies beyond one [mm].

    The lines that bind and the worst one meet, and touch anew where they meet, until no other is worse.  A place where
    the excess is largest enters with the square of its error, so this converges like Newton's method; wherever it
    stops, no permitted point is nearer.
    """
    kept: tuple[HalfPlane, ...] = ()
    while True:
        beyond = region.exceeded_lines(point, kept)
        if not beyond:
            return point, kept, 0.0
        next_point, next_kept = meet((*region.fixed, *kept, *beyond))
        for _ in range(MAX_STEPS):
            moved, step = _touching(next_kept, next_point)
            if step > SAME_PLACE:
                next_point, next_kept = meet(moved)
            if step <= SQUARED_ERROR_STEP:
                break
        if abs(next_point) <= abs(point):  # it grows until nothing but rounding is left
            return point, kept, beyond[-1].excess(point)
        point, kept = next_point, next_kept


def _touching(lines: Sequence[HalfPlane], point: complex) -> tuple[list[HalfPlane], float]:
    """The lines moved to where they touch nearer to the point, and the longest step there, as a part of its place."""
    moved: list[HalfPlane] = []
    longest = 0.0
    for line in lines:
        if line.touch:
            side, leg, w, low, high, *_ = line.touch
            place = higher(line, point, low, high)
            step = abs(place - w) / (max(place, w) or 1.0)
            longest = max(longest, step)
            if step > SAME_PLACE:
                line = side.line(leg, place, low, high)
        moved.append(line)
    return moved, longest


@dataclass(frozen=True)
class _Arc:
    """The cam centres at a given distance from the pivot."""

    arm: float
    distance: float

    def point(self, psi0: float) -> complex:
        return (self.distance - self.arm) + 2j * self.distance * math.sin(psi0 / 2) * cmath.exp(0.5j * psi0)

    def first(self, lines: Sequence[HalfPlane]) -> NearestPoint:
        """The point of the arc where psi0, as it grows, comes to keep the last line; R = 0 if the arc nowhere does."""
        if not lines:
            return 0j, ()
        line = lines[-1]
        cosine = (line.height + self.arm * line.normal.real) / self.distance
        if cosine > 1:
            return 0j, ()
        return self.point(cmath.phase(line.normal) - math.acos(cosine)), (line,)

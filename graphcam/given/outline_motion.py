"""What a cam of arcs does to a follower: s, v, a and j in closed form on every arc, and the motion over the turn.

The trace point (the centre of a roller, or the knife edge) keeps the distance R, that of the arc and the roller
together, from the centre C of the arc, which turns with the cam: C = C0 exp(i sigma phi).  So a translating follower at
the offset e stands at

    y = Im C + sqrt(R^2 - (e - Re C)^2),

and an arm of the length l about a pivot at c at the angle psi, where w = c - C and

    Re(w exp(i psi)) = (|w|^2 + l^2 - R^2)/(2 l).

On a straight part with the outward normal n, at the distance p from the cam centre, e Re n + y Im n = p; and for an arm
w = l n and the right side c Re n - p.  Under a flat face y = Im C + R; one that swings at the offset f about a pivot at
c, where w = -i (c - C), has the right side R + f.  Each is differentiated three times.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import singledispatch
from itertools import groupby, pairwise
from typing import Any, NamedTuple, overload

import numpy as np

from graphcam.errors import DesignError, check_kind
from graphcam.given.arc_loop import ArcLoop
from graphcam.given.cam_by_radii import ArcOutline, OutlineArc
from graphcam.given.extreme_search import SmoothPieces
from graphcam.given.follower import FlatFaced, Follower, Oscillating, OscillatingFlat, Rotation, Translating, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Phase, Return, Rise, wrap
from graphcam.given.motion_law import Law
from graphcam.given.point_outline import (
    Complexes,
    PointOutline,
    Trace,
    TracedMotion,
    check_pivot,
    swinging_face_angle,
    trace,
    traced_motion,
)
from graphcam.words import say

Values = tuple[Floats, Floats, Floats, Floats]
"""s, v, a and j."""
OUTLINE_LAW = "given cam"
"""The name of the law of what a given cam does."""
CHECKED_PLACES = 65
"""Places of an arc at which the pressure angle is looked at."""
MOST_STEEP = 1e3
"""So many prime radii per radian no follower moves that is not about to jam."""
JOINED = 1e-6
"""By so much of its maximum the displacement, or the velocity, may seem to jump where one part follows another."""
SAME_PLACE = 1e-9
"""Cam angles [rad] nearer to one another are the same: a turning that is found twice, or where a part begins."""
STILL = 1e-12
"""An arc whose centre is nearer to the cam centre than this part of the prime radius is about the cam centre."""


@dataclass(frozen=True, eq=False, repr=False)
class OutlineMotion(Motion):
    """The motion that a given cam gives a follower; made by :func:`outline_motion`.

    Attributes
    ----------
    outline : the cam
    prime_radius : of the pitch curve [mm], the base radius and the roller together
    follower, rotation : what it moves, and the sense in which it turns
    arcs : the parts of the pitch curve, of a flat face those of the cam, where they lie at phi = 0
    zero : the cam angle [rad] of the cam as it is given at which the first phase begins
    """

    outline: ArcOutline | ArcLoop
    prime_radius: float
    follower: Follower
    rotation: Rotation
    arcs: Sequence[OutlineArc]
    zero: float = 0.0

    @property
    def origin(self) -> float:
        """The cam angle [rad] of the cam as it is given at which the first phase begins."""
        return self.zero

    def __reduce__(self) -> tuple[Any, ...]:
        """What another process needs: the laws of the phases are formulas, which are made again."""
        return outline_motion, (self.outline, self.follower, self.rotation)

    def _summary(self) -> str:
        return f"{super()._summary()}, by a given cam"


@overload
def outline_motion(outline: ArcOutline | ArcLoop, follower: Follower, rotation: Rotation = "ccw") -> OutlineMotion: ...
@overload
def outline_motion(
    outline: PointOutline, follower: Follower, rotation: Rotation = "ccw", tolerance: float | None = None
) -> TracedMotion: ...
def outline_motion(
    outline: ArcOutline | ArcLoop | PointOutline,
    follower: Follower,
    rotation: Rotation = "ccw",
    tolerance: float | None = None,
) -> OutlineMotion | TracedMotion:
    """What a given cam does to a follower: one of base circle, flank and nose, or one through points.

    The first turns so that its flank OA comes first, and its motion is exact, arc by arc.  The second lies at the cam
    angle 0 as its points are given; its motion is that of :func:`measured_motion` through 720 rows.

    follower : a :class:`~graphcam.Translating`, an :class:`~graphcam.Oscillating` with its distance, a
        :class:`~graphcam.FlatFaced`, or an :class:`~graphcam.OscillatingFlat`
    tolerance : of a cam through points, how far the trace point may be from a row [mm]; None is 0.01

    Raises
    ------
    DesignError : the follower does not reach the cam all around: its pressure angle comes to 90 degrees, its roller is
        larger than a hollow, or a flat face would meet a straight or hollow flank

    >>> import graphcam as gc
    >>> cam = gc.cam_by_radii(base_radius=28, flank_radius="straight", lift=15, ascent=math.radians(70))
    >>> motion = outline_motion(cam, gc.Translating(roller_radius=16))
    >>> [round(math.degrees(phase.angle), 4) for phase in motion.phases]
    [70.0, 70.0, 220.0]
    >>> s, v, a, j = motion([0.0, math.radians(70)])
    >>> (a * (600 * math.pi / 30) ** 2 / 1000).round(2).tolist()
    [173.71, -146.67]
    """
    check_kind("outline", outline, (ArcOutline, ArcLoop, PointOutline))
    if isinstance(outline, PointOutline):
        return traced_motion(outline, follower, rotation, tolerance)
    if tolerance is not None:
        raise DesignError("tolerance", tolerance, say("left out for a cam of arcs"), say("its motion is exact"))
    track = _track(follower, outline, sense(rotation))
    edges = _edges(track)
    _check_contact(track, edges)
    legs = _legs(track, _split(track, edges))
    turn = cmath.exp(1j * track.sigma * legs[0][0].start)
    arcs = [
        OutlineArc(turn * arc.centre, arc.radius, turn * arc.normal, turn * arc.point, turn * arc.outward)
        for arc in track.arcs
    ]
    zero = 0.0
    if isinstance(outline, ArcLoop):
        zero = float(wrap(track.sigma * cmath.phase(track.turned) + legs[0][0].start))
    phases = [_phase(track, leg) for leg in legs]
    return OutlineMotion(phases, outline, track.prime_radius, follower, rotation, arcs, zero)


class _Track(NamedTuple):
    """The arcs for the trace point, and how it stands on one.

    arcs : with radii and points of the trace point, turned to where they lie at phi = 0
    turned : by what the outline is turned to lie there
    position : where the trace point is at a distance from the cam centre; of a flat face the direction of its normal,
        where it touches a part whose tangent is so far from the cam centre
    stand : (arc, phi) to s and its derivatives
    by_normal : whether a part begins where its normal, and not its first point, lies as ``position`` tells
    """

    arcs: Sequence[OutlineArc]
    turned: complex
    sigma: int
    prime_radius: float
    position: Callable[[float], Complexes | complex]
    stand: Callable[[OutlineArc, Floats], Values]
    by_normal: bool = False


@singledispatch
def _track(follower: Follower, outline: ArcOutline | ArcLoop, sigma: int) -> _Track:
    """How a follower stands on the arcs: the one place that asks which it is."""
    raise TypeError(type(follower))


@_track.register
def _(follower: Translating, outline: ArcOutline | ArcLoop, sigma: int) -> _Track:
    way = trace(follower, outline.base_radius)

    def stand(arc: OutlineArc, phi: Floats) -> Values:
        return _on_guide(arc, phi, sigma, follower.offset, way.lowest)

    return _by_trace(way, follower.roller_radius, outline, sigma, stand)


@_track.register
def _(follower: Oscillating, outline: ArcOutline | ArcLoop, sigma: int) -> _Track:
    way, distance = trace(follower, outline.base_radius), follower.distance or math.nan

    def stand(arc: OutlineArc, phi: Floats) -> Values:
        return _on_arm(arc, phi, sigma, distance, follower.arm, way.lowest)

    return _by_trace(way, follower.roller_radius, outline, sigma, stand)


def _by_trace(
    way: Trace, roller: float, outline: ArcOutline | ArcLoop, sigma: int, stand: Callable[[OutlineArc, Floats], Values]
) -> _Track:
    first = outline.arcs(sigma)[0]
    trace_point = _seen(first.point + roller * first.outward, sigma)
    turned = complex(way.position(abs(trace_point))) / trace_point
    arcs = _for_roller(outline, roller, turned, sigma)
    return _Track(arcs, turned, sigma, way.prime_radius, way.position, stand)


@_track.register
def _(follower: FlatFaced, outline: ArcOutline | ArcLoop, sigma: int) -> _Track:
    base = outline.base_radius

    def stand(arc: OutlineArc, phi: Floats) -> Values:
        y, y1, y2, y3 = (turned.imag for turned in _turning(arc.centre, phi, sigma))
        return y + (arc.radius - base), y1, y2, y3

    def upwards(_: float) -> complex:
        return 1j

    return _by_face(outline, sigma, upwards, stand)


@_track.register
def _(follower: OscillatingFlat, outline: ArcOutline | ArcLoop, sigma: int) -> _Track:
    c, f = follower.distance, follower.face_offset
    lowest = float(swinging_face_angle(follower, outline.base_radius))

    def stand(arc: OutlineArc, phi: Floats) -> Values:
        z, z1, z2, z3 = _turning(arc.centre, phi, sigma)
        w = [-1j * (c - z), 1j * z1, 1j * z2, 1j * z3]
        check_pivot(c, beyond=bool(np.all(abs(arc.radius + f) < np.abs(w[0]))))
        return _turned_until(w, [arc.radius + f, 0.0, 0.0, 0.0], -1.0, lowest)

    def normal(support: float) -> complex:
        return complex(1j * np.exp(-1j * swinging_face_angle(follower, support)))

    return _by_face(outline, sigma, normal, stand)


def _by_face(
    outline: ArcOutline | ArcLoop,
    sigma: int,
    normal: Callable[[float], complex],
    stand: Callable[[OutlineArc, Floats], Values],
) -> _Track:
    sharpest = min(outline.arcs(sigma), key=lambda arc: 1 / arc.radius)
    if not 0 < sharpest.radius < math.inf:
        limit, remedy = say("rounded outwards under a flat face"), say("take a roller, or a flank of a large radius")
        found = say("straight") if sharpest.radius > 0 else say("hollow")
        raise DesignError("outline" if isinstance(outline, ArcLoop) else "flank_radius", found, limit, remedy)
    first = outline.arcs(sigma)[0]
    turned = normal(_support(first)) / _seen(first.outward, sigma)
    arcs = _for_roller(outline, 0.0, turned, sigma)
    return _Track(arcs, turned, sigma, outline.base_radius, normal, stand, by_normal=True)


def _support(arc: OutlineArc) -> float:
    """How far the tangent at the beginning of a part is from the cam centre [mm]."""
    return (arc.point * arc.outward.conjugate()).real


def _for_roller(outline: ArcOutline | ArcLoop, roller: float, turned: complex, sigma: int) -> list[OutlineArc]:
    """The arcs for the trace point of a roller, where they lie at phi = 0."""
    hollow = max((arc.radius for arc in outline.arcs(sigma) if arc.radius < 0), default=-math.inf)
    if not roller < -hollow:
        limit = say("less than {most:g} mm, the radius of the hollow flank", most=-hollow)
        raise DesignError(say("roller radius"), roller, limit, say("take a smaller roller or a flatter flank"))
    return [_placed(arc, turned, sigma, roller) for arc in outline.arcs(sigma)]


def _seen(z: complex, sigma: int) -> complex:
    return z if sigma > 0 else z.conjugate()


def _placed(arc: OutlineArc, turned: complex, sigma: int, roller: float) -> OutlineArc:
    """The arc for the trace point of a roller, seen at phi = 0; of a cam that turns clockwise its mirror image."""

    def seen(z: complex) -> complex:
        return turned * _seen(z, sigma)

    point, outward = seen(arc.point + roller * arc.outward), seen(arc.outward)
    return OutlineArc(seen(arc.centre), arc.radius + roller, seen(arc.normal), point, outward)


# --- a follower on an arc --------------------------------------------------------------------------------------------


def _turning(z: complex, phi: Floats, sigma: int) -> list[Complexes]:
    """A point that turns with the cam, and its first three derivatives by phi."""
    turned = z * np.exp(1j * sigma * phi)
    return [turned, 1j * sigma * turned, -turned, -1j * sigma * turned]


def _on_guide(arc: OutlineArc, phi: Floats, sigma: int, e: float, lowest: float) -> Values:
    if math.isinf(arc.radius):
        n, n1, n2, n3 = _turning(arc.normal, phi, sigma)
        p = _support(arc)
        y = (p - e * n.real) / n.imag
        y1 = (-e * n1.real - y * n1.imag) / n.imag
        y2 = (-e * n2.real - 2 * y1 * n1.imag - y * n2.imag) / n.imag
        y3 = (-e * n3.real - 3 * (y2 * n1.imag + y1 * n2.imag) - y * n3.imag) / n.imag
        return y - lowest, y1, y2, y3
    c, c1, c2, c3 = _turning(arc.centre, phi, sigma)
    x, x1, x2, x3 = e - c.real, -c1.real, -c2.real, -c3.real
    q = np.sign(arc.radius) * np.sqrt(arc.radius * arc.radius - x * x)
    q1 = -x * x1 / q
    q2 = -(x1 * x1 + x * x2 + q1 * q1) / q
    q3 = -(3 * x1 * x2 + x * x3 + 3 * q1 * q2) / q
    return c.imag + q - lowest, c1.imag + q1, c2.imag + q2, c3.imag + q3


def _on_arm(arc: OutlineArc, phi: Floats, sigma: int, distance: float, arm: float, start: float) -> Values:
    if math.isinf(arc.radius):
        w = [arm * n for n in _turning(arc.normal, phi, sigma)]
        right = [distance / arm * z.real for z in w]
        right[0] = right[0] - _support(arc)
    else:
        c, c1, c2, c3 = _turning(arc.centre, phi, sigma)
        w = [distance - c, -c1, -c2, -c3]
        # |w|^2 = distance^2 + |C|^2 - 2 distance Re C
        square = distance * distance + abs(arc.centre) ** 2 + arm * arm - arc.radius * arc.radius
        right = [-distance * z.real / arm for z in (c, c1, c2, c3)]
        right[0] = right[0] + square / (2 * arm)
    return _turned_until(w, right, float(np.sign(arc.radius)), start)


def _turned_until(way: Sequence[Complexes], right: Sequence[Any], side: float, start: float) -> Values:
    """The angle psi beyond its start, and its derivatives by phi, for which Re(w exp(i psi)) is the right side.

    way, right : w and the right side, each with its first three derivatives;  side : 1 or -1, of two such angles
    """
    w, w1, w2, w3 = way
    psi = np.angle(np.exp(1j * (side * np.arccos(right[0] / np.abs(w)) - np.angle(w))))
    turn = np.exp(1j * psi)
    lever = (w * turn).imag
    psi1 = ((w1 * turn).real - right[1]) / lever
    psi2 = (((w2 + 2j * psi1 * w1 - psi1**2 * w) * turn).real - right[2]) / lever
    third = w3 + 3j * (psi2 * w1 + psi1 * w2) - 3 * psi1 * (psi2 * w + psi1 * w1) - 1j * psi1**3 * w
    psi3 = ((third * turn).real - right[3]) / lever
    return psi - start, psi1, psi2, psi3


# --- the motion over the turn ----------------------------------------------------------------------------------------


def _edges(track: _Track) -> list[float]:
    """The cam angles [rad] at which the parts begin, and the end of the turn."""
    found: list[float] = []
    for arc in track.arcs:
        seen, far = (arc.outward, _support(arc)) if track.by_normal else (arc.point, abs(arc.point))
        place = complex(track.position(far))
        found.append(float(wrap(track.sigma * cmath.phase(place / seen))))
    found[0] = 0.0
    if not all(a < b for a, b in pairwise([*found, FULL_TURN])):
        degrees = ", ".join(f"{math.degrees(angle):.4g}" for angle in found)
        limit = say("growing, so that the follower touches one part after the other")
        quantity = say("cam angles of the parts")
        raise DesignError(quantity, say("{degrees} degrees", degrees=degrees), limit, say("take a smaller roller"))
    return [*found, FULL_TURN]


class _OneWay(NamedTuple):
    """A part of the turn on one arc, over which the follower moves one way."""

    arc: OutlineArc
    start: float
    end: float
    direction: int


def _split(track: _Track, edges: Sequence[float]) -> list[_OneWay]:
    """The turn, divided where another part begins and where the follower turns."""
    found: list[_OneWay] = []
    for arc, (start, end) in zip(track.arcs, pairwise(edges), strict=True):
        if abs(arc.centre) <= STILL * track.prime_radius and math.isfinite(arc.radius):
            found.append(_OneWay(arc, start, end, 0))
            continue
        pieces = SmoothPieces(np.array([start]), np.array([end]))
        _, turning = pieces.zeros(lambda _, phi, arc=arc: track.stand(arc, phi)[1])
        ends = [start, *(phi for phi in sorted(turning.tolist()) if phi < end - SAME_PLACE), end]
        for low, high in ((low, high) for low, high in pairwise(ends) if high - low > SAME_PLACE):
            velocity = float(track.stand(arc, np.array((low + high) / 2))[1])
            found.append(_OneWay(arc, low, high, 1 if velocity > 0 else -1))
    return found


def _check_contact(track: _Track, edges: Sequence[float]) -> None:
    """Check that the follower stays on the cam: on every part it stands somewhere, and nowhere jumps to the next."""
    with np.errstate(invalid="ignore", divide="ignore"):
        on = [
            np.array(track.stand(arc, np.linspace(start, end, CHECKED_PLACES)))[:2]
            for arc, (start, end) in zip(track.arcs, pairwise(edges), strict=True)
        ]
    largest = max(float(np.abs(values).max()) for values in on)
    jumps = [np.abs(before[:, -1] - after[:, 0]).max() for before, after in zip(on, [*on[1:], on[0]], strict=True)]
    if not (largest < MOST_STEEP * track.prime_radius and max(jumps) < JOINED * largest):
        limit = say("less than 90 degrees")
        remedy = say("enlarge the base radius, lift less, or take a larger ascent")
        raise DesignError(say("pressure angle"), say("90 degrees or more"), limit, remedy)


def _legs(track: _Track, stretches: list[_OneWay]) -> list[list[_OneWay]]:
    """The phases: what moves one way, from where the follower begins to rise."""
    if stretches[0].direction < 0 or len(track.arcs) == 1:  # it turns inside a part: begin where it is lowest
        lowest = next(k for k, each in enumerate(stretches) if each.direction > 0 and stretches[k - 1].direction < 0)
        stretches = [*stretches[lowest:], *stretches[:lowest]]
    grouped = [list(group) for _, group in groupby(stretches, key=lambda each: each.direction)]
    if len(grouped) > 1 and grouped[0][0].direction == grouped[-1][0].direction:
        grouped[0] = [*grouped.pop(), *grouped[0]]
    return grouped


def _phase(track: _Track, leg: list[_OneWay]) -> Phase:
    angle = math.fsum(each.end - each.start for each in leg)
    direction = leg[0].direction
    if not direction:
        return Dwell(angle)
    first, last = leg[0], leg[-1]
    low = float(track.stand(first.arc, np.array(first.start))[0])
    high = float(track.stand(last.arc, np.array(last.end))[0])
    lift, begins = abs(high - low), np.cumsum([0.0, *(each.end - each.start for each in leg)])
    # Counted from the beginning of the leg, which may run through the end of the turn.
    formulas = [
        _formula(track, each, begin, angle, low, direction * lift)
        for each, begin in zip(leg, begins.tolist(), strict=False)
    ]
    law = Law(OUTLINE_LAW, formulas, tuple((begins[1:-1] / angle).tolist()), trusted=True)
    return (Rise if direction > 0 else Return)(lift, angle, law)


def _formula(
    track: _Track, stretch: _OneWay, begin: float, angle: float, low: float, change: float
) -> Callable[[Floats], Values]:
    """f and its derivatives by the fraction u of the phase, on one stretch of it."""

    def formula(u: Floats) -> Values:
        s, v, a, j = track.stand(stretch.arc, stretch.start + (np.asarray(u) * angle - begin))
        return (s - low) / change, v * (angle / change), a * (angle**2 / change), j * (angle**3 / change)

    return formula

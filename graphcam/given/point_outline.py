"""Cams given by points of their outline, measured or drawn, and what they do to a follower.

The outline is the periodic cubic spline through the points over the length of their chords.  On its normal at every
place lies the trace point of the follower that touches it there, at the radius of the roller; its distance from the cam
centre tells where the follower stands, and the angle between that place and the trace point on the cam by how much the
cam has turned.  A flat face stands as far from the cam centre as the tangent.  Where places compete, round a hollow
that is sharper than the roller, the farthest outward holds the follower up.

At 720 cam angles these displacements make the rows of a measured motion, which tells rests and turnings, and smooths
what the tolerance permits: so the velocity is good, and the acceleration as good as that of a measured table.

Where the trace point of a follower stands that rests on a given cam: on its guide, or on the circle about its pivot.

The trace point is the centre of a roller, or the knife edge; its distance from the cam centre tells where it stands,
and where it stands how far the follower has moved.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, singledispatch
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError, check_number
from graphcam.given.b_splines import solve_banded
from graphcam.given.follower import FlatFaced, Follower, Oscillating, OscillatingFlat, Rotation, Translating, sense
from graphcam.given.laws import Floats
from graphcam.given.measured import DEFAULT_TOLERANCE, MeasuredMotion, RowError, measured_motion
from graphcam.given.motion import FULL_TURN
from graphcam.words import Words, say

# --- a follower that rests on a given cam ----------------------------------------------------------------------------

Complexes = NDArray[np.complex128]


class Trace(NamedTuple):
    """The way of a follower's trace point.

    prime_radius : its distance from the cam centre [mm] where the follower has not moved
    lowest : the height, or angle, from which s is counted [mm or rad]
    position : from distances from the cam centre [mm] to places, complex [mm]
    moved : from places to displacements s [mm or rad]
    arm : mm of way for one unit of s
    """

    prime_radius: float
    lowest: float
    position: Callable[[float | Floats], Complexes]
    moved: Callable[[Complexes], Floats]
    arm: float = 1.0

    def at(self, s: float) -> float:
        """The distance from the cam centre [mm] after a displacement, by bisection: both grow together."""
        low, high = self.prime_radius / 2, 2 * self.prime_radius
        while (middle := (low + high) / 2) not in (low, high):
            low, high = (middle, high) if self.moved(self.position(middle)) < s else (low, middle)
        return high


@singledispatch
def trace(follower: Follower, base_radius: float) -> Trace:
    """The way of a follower's trace point, for a cam of a base radius [mm].

    Raises
    ------
    DesignError : the follower has no trace point, or cannot rest on such a cam

    >>> from graphcam.given.follower import Translating
    >>> way = trace(Translating(offset=12, roller_radius=8), 29)
    >>> round(way.lowest, 4), complex(way.position(37.0)).real
    (35.0, 12.0)
    """
    raise TypeError(type(follower))


def check_pivot(distance: float, *, beyond: bool) -> None:
    """Check that the pivot of a face that swings lies beyond the reach of the cam."""
    if not beyond:
        limit = say("greater than the cam's outer radius and the face offset together")
        raise DesignError(say("centre distance"), distance, limit, say("move the pivot away"))


def swinging_face_angle(follower: OscillatingFlat, support: float | Floats) -> Floats:
    """The angle psi [rad] between the line of centres and a face that is so far from the cam centre [mm].

    Raises
    ------
    DesignError : the pivot is within reach of the cam

    >>> round(math.degrees(swinging_face_angle(OscillatingFlat(distance=100, face_offset=10), 40.0)), 6)
    30.0
    """
    together, c = np.asarray(support) + follower.face_offset, follower.distance
    check_pivot(c, beyond=bool(np.all(np.abs(together) < c)))
    return np.asarray(np.arcsin(together / c))


@trace.register
def _(follower: Translating, base_radius: float) -> Trace:
    r0, e = base_radius + follower.roller_radius, follower.offset
    if not abs(e) < r0:
        limit = say("less than the prime radius of {radius:g} mm in magnitude", radius=r0)
        raise DesignError("offset", e, limit, say("take a smaller offset"))
    lowest = math.sqrt((r0 - e) * (r0 + e))

    def position(radius: float | Floats) -> Complexes:
        return np.asarray(e + 1j * np.sqrt(np.maximum(np.square(radius) - e * e, 0.0)), dtype=np.complex128)

    def moved(place: Complexes) -> Floats:
        return place.imag - lowest

    return Trace(r0, lowest, position, moved)


@trace.register
def _(follower: Oscillating, base_radius: float) -> Trace:
    r0, c, arm = base_radius + follower.roller_radius, follower.distance, follower.arm
    if c is None:
        remedy = say("the given cam stands at some distance")
        raise DesignError(say("centre distance"), say("missing"), say("given"), remedy)
    if not abs(c - arm) < r0 < c + arm:
        limit = say("between {least:g} and {most:g} mm, so that the arm reaches", least=abs(c - arm), most=c + arm)
        found, remedy = say("{radius:.6g}", radius=base_radius), say("change the arm or its distance")
        raise DesignError("base_radius", found, limit, remedy)

    def position(radius: float | Floats) -> Complexes:
        cosine = (c * c + arm * arm - np.square(radius)) / (2 * c * arm)
        return np.asarray(c - arm * np.exp(-1j * np.arccos(np.clip(cosine, -1.0, 1.0))), dtype=np.complex128)

    lowest = float(-np.angle((c - position(r0)) / arm))

    def moved(place: Complexes) -> Floats:
        return -np.angle((c - place) / arm) - lowest

    return Trace(r0, lowest, position, moved, arm)


# --- cams by points --------------------------------------------------------------------------------------------------

MIN_POINTS, MAX_POINTS = 12, 100_000
MAX_GAP_RATIO = 3.0
"""The outline is closed if its last gap is at most so many times the widest of the others."""
PERIODS = 24
"""The spline through this many more points at either end is the periodic one: what is beyond fades by 0.27 a point."""
ROW_COUNT = 720
"""Cam angles at which the follower's place is found."""
MIN_SAMPLES = 8 * ROW_COUNT
"""Places of the outline, at least, between which those that the follower touches are found."""
SECANT_STEPS = 4
"""Steps from a place between two samples to the one that the follower touches."""
MIN_LOST_SHARE = 1e-4
"""A part of the lift, by which the straight line between two rows may pass beside the displacement."""
MAX_RADIUS = 1e5
"""Of a point [mm]."""


@dataclass(frozen=True, eq=False, repr=False)
class PointOutline:
    """A closed outline through points, made by :func:`cam_through_points`; counter-clockwise round the cam centre.

    points : (n,) complex [mm], the first one not repeated
    """

    points: Complexes

    def __repr__(self) -> str:
        return f"PointOutline of {self.points.size} points, radii {self.base_radius:.6g} to {self.outer_radius:.6g} mm"

    @property
    def base_radius(self) -> float:
        """The radius of the point that is nearest to the cam centre [mm]."""
        return float(np.abs(self.points).min())

    @property
    def outer_radius(self) -> float:
        """The radius of the farthest point [mm]."""
        return float(np.abs(self.points).max())

    @cached_property
    def _chords(self) -> Floats:
        return np.abs(np.diff(np.append(self.points, self.points[0])))

    @cached_property
    def _bends(self) -> Complexes:
        """(n,) the second derivatives of the spline at the points, by the length of chord."""
        count = self.points.size
        at = np.arange(-PERIODS, count + PERIODS + 1) % count
        h, points = self._chords[at[:-1]], self.points[at]
        slopes = np.diff(points) / h
        band = np.array([2 * (h[:-1] + h[1:]), np.append(h[1:-1], 0.0)])
        right = 6 * np.diff(slopes)
        return (solve_banded(band, right.real) + 1j * solve_banded(band, right.imag))[PERIODS - 1 :][:count]

    def __call__(self, place: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """Points and derivatives by the length of chord, at places such as 3.25, a quarter from point 3 to point 4."""
        number = np.floor(place).astype(int)
        u = place - number
        k, following = number % self.points.size, (number + 1) % self.points.size
        h, p, q, m, n = self._chords[k], self.points[k], self.points[following], self._bends[k], self._bends[following]
        w = 1 - u
        point = w * p + u * q + h**2 / 6 * ((w**3 - w) * m + (u**3 - u) * n)
        slope = (q - p) / h + h / 6 * ((1 - 3 * w**2) * m + (3 * u**2 - 1) * n)
        return point, slope, w * m + u * n

    def outward(self, place: Floats) -> Complexes:
        """The unit normals away from the cam."""
        _, slope, _ = self(place)
        return -1j * slope / np.abs(slope)

    def hollow_radius(self, place: Floats) -> float:
        """The minimum radius of curvature [mm] at hollow places among these; inf if there are none."""
        _, slope, bend = self(place)
        curvature = (np.conj(slope) * bend).imag / np.abs(slope) ** 3
        sharpest = float(curvature.min())
        return -1 / sharpest if sharpest < 0 else math.inf


def cam_through_points(points: ArrayLike) -> PointOutline:
    """The cam through points of its outline, as it lies at the cam angle 0, in order round the cam centre at 0.

    points : (n,) complex or (n, 2) x, y [mm]; the last may repeat the first

    Raises
    ------
    DesignError : too few or too many, not numbers, not in order round the cam centre, or the outline is open

    >>> import graphcam as gc
    >>> angle = np.radians(np.arange(0, 360, 2))
    >>> disc = cam_through_points(5j + 30 * np.exp(1j * angle))
    >>> disc
    PointOutline of 180 points, radii 25 to 35 mm
    >>> round(gc.outline_motion(disc, gc.Translating(roller_radius=10)).lift, 4)
    10.0
    """
    try:
        given = np.asarray(points)
        z = given.astype(np.complex128) if given.ndim == 1 else given.astype(np.float64) @ np.array([1, 1j])
    except (TypeError, ValueError, OverflowError):
        limit = say("(n,) complex or (n, 2) x, y in mm")
        raise DesignError("points", say("not of numbers"), limit, say("give a list of points")) from None
    return PointOutline(_checked(np.asarray(z, dtype=np.complex128)))


def _checked(z: Complexes) -> Complexes:
    """The points counter-clockwise, the first not repeated."""
    if z.ndim != 1 or not MIN_POINTS <= z.size <= MAX_POINTS:
        limit = say("from {least} to {most}", least=MIN_POINTS, most=MAX_POINTS)
        raise RowError(max(z.size - 1, 0), say("number of points"), z.size, limit, say("give more, or fewer"))
    for k in np.flatnonzero(~(np.abs(z) <= MAX_RADIUS))[:1].tolist():
        found, limit = say("{x:g}, {y:g}", x=z[k].real, y=z[k].imag), say("within {most:g} mm", most=MAX_RADIUS)
        raise RowError(k, say("point"), found, limit, say("give lengths in mm from the cam centre"))
    widest = float(np.abs(np.diff(z)).max())
    if abs(z[-1] - z[0]) <= FULL_TURN * 1e-9 * widest:
        z = z[:-1]
    steps = np.angle(np.roll(z, -1) / np.where(z == 0, 1, z))
    turn, last = float(steps.sum()), float(abs(z[-1] - z[0]))
    if abs(turn) < FULL_TURN / 2:
        limit, remedy = say("round the cam centre at (0, 0)"), say("count the coordinates from the cam's axis")
        raise DesignError(say("outline"), say("beside the cam centre"), limit, remedy)
    for k in np.flatnonzero(steps * turn <= 0)[:1].tolist():
        row = (k + 1) % z.size
        found, remedy = say("{x:g}, {y:g}", x=z[row].real, y=z[row].imag), say("sort the points, or thin them")
        limit = say("one after the other round the cam centre, so that a ray meets the outline once")
        raise RowError(row, say("point"), found, limit, remedy)
    if last > MAX_GAP_RATIO * widest:
        limit = say("at most {most:.4g} mm, as between the others", most=MAX_GAP_RATIO * widest)
        gap = say("gap between the last point and the first")
        raise RowError(z.size - 1, gap, say("{gap:.4g} mm", gap=last), limit, say("close the outline"))
    return z if turn > 0 else z[::-1]


# --- what it does to a follower --------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class TracedMotion(MeasuredMotion):
    """The motion that a cam through points gives a follower; made by :func:`~graphcam.outline_motion`.

    Attributes
    ----------
    outline : the cam
    prime_radius : of the pitch curve, or of a flat face the base radius [mm]
    follower, rotation : what it moves, and the sense in which it turns
    """

    outline: PointOutline
    prime_radius: float
    follower: Follower
    rotation: Rotation

    def _summary(self) -> str:
        return f"{super()._summary()}, by a given cam"

    def touched(self, phi: Floats) -> Floats:
        """The places of the outline that the follower touches at cam angles [rad] of this motion, growing."""
        sigma = sense(self.rotation)
        place = _between_points(self.outline, sigma)
        angles = np.unwrap(_laying(self.follower, self.outline, sigma).touching(place).phi - self.zero)
        angles = np.maximum.accumulate(angles)
        first = angles[0]
        turns = np.floor((phi - first) / FULL_TURN)
        along = np.interp(phi - FULL_TURN * turns, angles, place)
        return along - sigma * self.outline.points.size * turns


class Touching(NamedTuple):
    """Where a follower stands that touches the outline: the cam angles [rad] and the displacements."""

    phi: Floats
    s: Floats


class Laying(NamedTuple):
    """How a follower is laid against an outline.

    touching : where it stands if it touches the outline at places
    radius_at : the prime radius [mm], if s is counted from a level
    arm : mm of way for one unit of s
    gaps : how far it stays at least from places [mm], while it touches others
    too_hollow : the error for places that it cannot reach
    """

    touching: Callable[[Floats], Touching]
    radius_at: Callable[[float], float]
    arm: float
    gaps: Callable[[Floats, Floats], Floats]
    too_hollow: Callable[[Floats], DesignError]


def traced_motion(
    outline: PointOutline, follower: Follower, rotation: Rotation, tolerance: float | None = None
) -> TracedMotion:
    """What a cam through points does to a follower; see :func:`~graphcam.outline_motion`."""
    tolerance, sigma = DEFAULT_TOLERANCE if tolerance is None else tolerance, sense(rotation)
    check_number("tolerance", tolerance, say("a finite number greater than 0"), above=0)
    laying = _laying(follower, outline, sigma)
    unit = tolerance / laying.arm
    rows, held, covered = _rows(outline, laying.touching, sigma, unit)
    missed = covered[laying.gaps(covered, held) > tolerance]
    if missed.size:
        raise laying.too_hollow(missed)
    s = rows.s - rows.s.min()
    if not float(np.ptp(s)) > 2 * unit:
        found, limit = say("round about the cam centre"), say("moving the follower by more than twice the tolerance")
        raise DesignError(say("outline"), found, limit, say("check that the coordinates are in mm"))
    motion = measured_motion(rows.phi, s, unit)
    radius = laying.radius_at(float(rows.s[0] - motion.measured[0]))
    table = motion.phases, motion.zero, rows.phi, motion.measured, unit
    return TracedMotion(*table, outline, radius, follower, rotation)


@singledispatch
def _laying(follower: Follower, outline: PointOutline, sigma: int) -> Laying:
    way = trace(follower, outline.base_radius)
    roller = way.prime_radius - outline.base_radius

    def touching(place: Floats) -> Touching:
        centre = outline(place)[0] + roller * outline.outward(place)
        there = way.position(np.abs(centre))
        return Touching(sigma * np.angle(there / centre), way.moved(there))

    def gaps(places: Floats, held: Floats) -> Floats:
        centres = outline(held)[0] + roller * outline.outward(held)
        return np.abs(outline(places)[0][:, None] - centres).min(axis=-1) - roller

    def too_hollow(places: Floats) -> DesignError:
        most, angle = outline.hollow_radius(places), _at(outline, places)
        limit = say("at most {most:.4g} mm, the radius of the hollow at {angle}", most=most, angle=angle)
        found = say("{radius:.6g}", radius=roller)
        remedy = say("take a smaller roller, or where measured points scatter a larger tolerance")
        return DesignError(say("roller radius"), found, limit, remedy)

    return Laying(touching, way.at, way.arm, gaps, too_hollow)


@_laying.register
def _(follower: FlatFaced, outline: PointOutline, sigma: int) -> Laying:
    def touching(place: Floats) -> Touching:
        normal = outline.outward(place)
        return Touching(sigma * np.angle(1j / normal), (outline(place)[0] * np.conj(normal)).real)

    def radius_at(level: float) -> float:
        return level

    return _laid_face(outline, touching, radius_at, 1.0)


@_laying.register
def _(follower: OscillatingFlat, outline: PointOutline, sigma: int) -> Laying:
    def touching(place: Floats) -> Touching:
        normal = outline.outward(place)
        psi = swinging_face_angle(follower, (outline(place)[0] * np.conj(normal)).real)
        return Touching(sigma * np.angle(1j * np.exp(-1j * psi) / normal), psi)

    def radius_at(level: float) -> float:
        return follower.distance * math.sin(level) - follower.face_offset

    return _laid_face(outline, touching, radius_at, follower.distance)


def _laid_face(
    outline: PointOutline, touching: Callable[[Floats], Touching], radius_at: Callable[[float], float], arm: float
) -> Laying:
    """How a flat face is laid against an outline that must be rounded outwards everywhere."""

    def gaps(places: Floats, held: Floats) -> Floats:
        faces = np.conj(outline.outward(held))
        heights = (outline(held)[0] * faces).real
        return (heights - (outline(places)[0][:, None] * faces).real).min(axis=-1)

    def too_hollow(places: Floats) -> DesignError:
        limit, remedy = say("rounded outwards under a flat face"), say("take a roller")
        return DesignError(say("outline"), say("hollow at {angle}", angle=_at(outline, places)), limit, remedy)

    return Laying(touching, radius_at, arm, gaps, too_hollow)


def _at(outline: PointOutline, places: Floats) -> Words:
    middle = np.angle(outline(places)[0][places.size // 2])
    return say("{degrees:.4g}° on the cam", degrees=math.degrees(middle) % 360)


def _between_points(outline: PointOutline, sigma: int) -> Floats:
    """Places all over the outline, in the order in which they come under the follower."""
    between = math.ceil(MIN_SAMPLES / outline.points.size)
    return np.arange(outline.points.size * between + 1)[::-sigma] / between


def _rows(
    outline: PointOutline, touching: Callable[[Floats], Touching], sigma: int, tolerance: float
) -> tuple[Touching, Floats, Floats]:
    """The rows of the motion over the turn, the places that hold the follower there, and those passed under another.

    touching : where the follower would stand if it touched the outline at places
    """
    place = _between_points(outline, sigma)
    there = touching(place)
    phi, s = np.unwrap(there.phi), there.s
    step = FULL_TURN / ROW_COUNT
    # Every row between two samples, whichever of them comes first; of those at one cam angle the highest counts.
    low, high = (
        np.ceil(ends / step).astype(int) for ends in (np.minimum(phi[:-1], phi[1:]), np.maximum(phi[:-1], phi[1:]))
    )
    count = high - low
    k = np.repeat(np.arange(count.size), count)
    row = np.arange(k.size) - np.repeat(np.cumsum(count) - count, count) + low[k]
    share = (row * step - phi[k]) / (phi[k + 1] - phi[k])
    height, row = s[k] + share * (s[k + 1] - s[k]), row % ROW_COUNT
    highest = np.full(ROW_COUNT, -np.inf)
    np.maximum.at(highest, row, height)
    held = np.zeros(ROW_COUNT, dtype=int)
    at_top = height == highest[row]
    held[row[at_top]] = np.flatnonzero(at_top)
    k, share, angles = k[held], share[held], step * np.arange(ROW_COUNT)
    start, length = place[k], place[k + 1] - place[k]
    for _ in range(SECANT_STEPS):
        off = np.angle(np.exp(1j * (touching(start + share * length).phi - angles)))
        share = np.clip(share - off / (phi[k + 1] - phi[k]), 0.0, 1.0)
    places = start + share * length
    rows = Touching(angles, touching(places).s)
    if np.all(phi[1:] > phi[:-1]):
        return rows, places, np.empty(0)
    lost = np.interp(phi, angles, rows.s, period=FULL_TURN) - s
    return rows, places, place[lost > max(tolerance, MIN_LOST_SHARE * float(np.ptp(s)))]

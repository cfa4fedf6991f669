"""The least prime radius that keeps the pressure angle, or of a flat-faced follower the curvature, within its limits.

For a translating follower, with e' = sigma e, the pressure angle is permitted on the rises, on the returns and at the
low rest where

    s0 tan A  + e' >= M,    M  = max over the rises of (v - s tan A)
    s0 tan A' - e' >= M',   M' = max over the returns of (|v| - s tan A')
    s0 tan A  - e' >= 0

so the cam centre lies in a region bounded by up to three lines, and r0 is its distance from the start of the lift.
The region of an arm stands in :mod:`~graphcam.mechanism.least_radius_arm`; the profile under a flat face has the radius
of curvature r0 + s + a.

Source: the shaded region of the textbooks on the theory of machines, written as inequalities.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations
from typing import Literal, NamedTuple, overload

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.follower import FlatFaced, Follower, Oscillating, Rotation, Translating, sense
from graphcam.given.laws import Floats, Law
from graphcam.given.limits import Limits, usual_limit
from graphcam.given.motion import Dwell, Motion
from graphcam.given.spline_law import MEASURED
from graphcam.mechanism.least_radius_arm import ArmMinimumRadius, Line, arm_minimum_radius
from graphcam.mechanism.roots import roots
from graphcam.mechanism.stationary import SAMPLES, stationary_places


@dataclass(frozen=True)
class MinimumRadius:
    """The least permitted prime radius and the offset that goes with it [mm]; ``active`` names the lines that bind."""

    prime_radius: float
    offset: float
    active: tuple[Line, ...]

    @property
    def place(self) -> float:
        """The offset: where the follower stands beside the cam [mm]."""
        return self.offset


class _HalfPlane(NamedTuple):
    """The points (e', s0) with s0 * slope + side * e' >= height; side is +1 or -1."""

    name: Line
    slope: float
    side: int
    height: float

    def lowest(self, x: float) -> float:
        """The least permitted s0 at e' = x."""
        return (self.height - self.side * x) / self.slope

    def foot(self) -> tuple[float, float]:
        """The foot of the perpendicular from the start of the lift."""
        # Angles in place of 1 + slope^2, which overflows near 90 degrees sooner than the foot does.
        norm = math.hypot(1.0, self.slope)
        return self.side * self.height / norm / norm, self.height / norm * (self.slope / norm)


@dataclass(frozen=True)
class FlatMinimumRadius:
    """The least prime radius [mm] under a flat face; ``active`` is ("curvature",), or () where any radius will do."""

    prime_radius: float
    active: tuple[Literal["curvature"], ...]

    @property
    def place(self) -> float:
        """0: a flat face may stand anywhere across its motion."""
        return 0.0


LeastRadius = MinimumRadius | ArmMinimumRadius | FlatMinimumRadius


@overload
def minimum_radius(
    motion: Motion, follower: Translating, rotation: Rotation = "ccw", rise: float | None = None,
    return_: float | None = None, offset: float | None = None, rest: bool = True, curvature: float | None = None,
) -> MinimumRadius: ...  # fmt: skip
@overload
def minimum_radius(
    motion: Motion, follower: Oscillating, rotation: Rotation = "ccw", rise: float | None = None,
    return_: float | None = None, offset: float | None = None, rest: bool = True, curvature: float | None = None,
) -> ArmMinimumRadius: ...  # fmt: skip
@overload
def minimum_radius(
    motion: Motion, follower: FlatFaced, rotation: Rotation = "ccw", rise: float | None = None,
    return_: float | None = None, offset: float | None = None, rest: bool = True, curvature: float | None = None,
) -> FlatMinimumRadius: ...  # fmt: skip
def minimum_radius(
    motion: Motion,
    follower: Follower,
    rotation: Rotation = "ccw",
    rise: float | None = None,
    return_: float | None = None,
    offset: float | None = None,
    rest: bool = True,
    curvature: float | None = None,
) -> LeastRadius:
    """The least prime radius for permitted pressure angles, or, under a flat face, for a permitted curvature.

    Parameters
    ----------
    motion, follower, rotation : as for a :class:`~graphcam.mechanism.cam.Cam`; a translating follower's own offset is
        not used, an arm's distance is kept if it is given
    rise, return_ : permitted |alpha| [rad] on rises and on returns; rise = None is the usual limit, 30 degrees for a
        translating follower and 45 for an arm, return_ = None is force closure, no limit there
    offset : e [mm] of a translating follower if it is given; None leaves it free
    rest : whether the angle at the low rest must keep the rise's limit too; for an arm, whether the angle at both rests
        must keep the limits of the phases that end there, so that |alpha| keeps them all the way
    curvature : the least permitted radius of curvature [mm] of the profile under a flat face; None is 0, where the
        profile has a cusp, which a cam can only approach

    Without the rest condition a given offset larger than M needs no height at all; the radius returned is then the
    offset itself, which a cam can only approach, and no line binds.  So it is with an arm that only has to reach:
    r0 = |c - l|.  The least radius under a flat face is never negative; it is 0 where any prime radius will do.

    Raises
    ------
    DesignError : a limit is not between 0 and 90 degrees or cannot be kept by an arm (its lift is too large for any
        radius, or for the given distance), a length is not finite, or an offset or a curvature is given for a follower
        that has none

    >>> from graphcam.given.motion import Return, Rise
    >>> motion = Motion([Rise(30, math.pi / 2, "cosine"), Return(30, math.pi / 2, "cosine"), Dwell(math.pi)])
    >>> least = minimum_radius(motion, Translating())
    >>> round(least.prime_radius, 4), round(least.offset, 4), least.active
    (22.5647, 11.2824, ('rise', 'rest'))
    >>> round(minimum_radius(motion, FlatFaced(), curvature=8.0).prime_radius, 9)
    38.0
    """
    sigma = sense(rotation)
    if curvature is not None and not isinstance(follower, FlatFaced):
        raise DesignError("curvature", curvature, "left out", "only a flat face limits the radius by the curvature")
    if offset is not None and not isinstance(follower, Translating):
        raise DesignError("offset", offset, "left out", "only a translating follower has an offset")
    if isinstance(follower, FlatFaced):
        return _flat(motion, curvature or 0.0)
    limits = Limits(usual_limit(follower.kind) if rise is None else rise, return_, rest)
    if isinstance(follower, Oscillating):
        return arm_minimum_radius(motion, follower, sigma, limits)
    return _translating(motion, sigma, limits, offset)


def _flat(motion: Motion, curvature: float) -> FlatMinimumRadius:
    if not (math.isfinite(curvature) and curvature >= 0):
        raise DesignError("least radius of curvature", curvature, "a finite length of 0 mm or more")
    s, _, a, _ = stationary_places(motion, slope=lambda values: values[1] + values[3]).values
    radius = curvature - float(np.min(s + a))
    return FlatMinimumRadius(radius, ("curvature",)) if radius > 0 else FlatMinimumRadius(0.0, ())


def _translating(motion: Motion, sigma: int, limits: Limits, offset: float | None) -> MinimumRadius:
    lines = _region(motion, limits)
    if offset is None:
        x, y, active = _nearest(lines)
        return MinimumRadius(math.hypot(x, y), sigma * x, active)
    if not math.isfinite(offset):
        raise DesignError("offset", offset, "a finite length in mm", "leave it out to let it be found")
    heights = [line.lowest(sigma * offset) for line in lines]
    s0 = max(0.0, *heights)
    binding: list[Line] = [line.name for line, height in zip(lines, heights, strict=True) if height == s0 > 0]
    return MinimumRadius(math.hypot(offset, s0), offset, tuple(binding))


def _region(motion: Motion, limits: Limits) -> list[_HalfPlane]:
    slope = math.tan(limits.rise)
    lines = [_HalfPlane("rise", slope, +1, _steepest_line(motion, +1, slope))]
    if limits.return_ is not None:
        slope_return = math.tan(limits.return_)
        lines.append(_HalfPlane("return", slope_return, -1, _steepest_line(motion, -1, slope_return)))
    if limits.rest:
        lines.append(_HalfPlane("rest", slope, -1, 0.0))
    return lines


def _nearest(lines: list[_HalfPlane]) -> tuple[float, float, tuple[Line, ...]]:
    """The region's point nearest to the origin, and the lines that hold it off."""
    # Two half-planes at most fix the nearest point of a plane region (Helly), and the other lines can only push it
    # farther out: so it is the farthest of the points that are nearest for two lines alone.
    if len(lines) < 3:
        return _nearest_of_two(lines[0], lines[-1])
    points = [_nearest_of_two(a, b) for a, b in combinations(lines, 2)]
    return max(points, key=lambda point: math.hypot(point[0], point[1]))


def _nearest_of_two(a: _HalfPlane, b: _HalfPlane) -> tuple[float, float, tuple[Line, ...]]:
    for line, other in ((a, b), (b, a)):
        x, y = line.foot()
        if line is other or y >= other.lowest(x):
            return x, y, (line.name,)
    # The two lines meet from both sides; were both on one side, a foot would have done.
    rising, falling = (a, b) if a.side > 0 else (b, a)
    y = (rising.height + falling.height) / (rising.slope + falling.slope)
    x = (rising.height * falling.slope - falling.height * rising.slope) / (rising.slope + falling.slope)
    return x, y, (a.name, b.name)


# --- the tangent to the s - v diagram --------------------------------------------------------------------------------


def _steepest_line(motion: Motion, direction: int, slope: float) -> float:
    """M or M': the greatest |v| - s * slope over all rises (+1) or all returns (-1) [mm/rad]."""
    heights: list[float] = []
    for k, phase in enumerate(motion.phases):
        if isinstance(phase, Dwell) or phase.direction != direction:
            continue
        # A return is seen from its lower end, as if time ran backwards: |v| and s are then those of a rise.
        law = phase.normalised if direction > 0 else phase.normalised.reversed
        height = phase.lift / phase.angle * steepest_line(law, 1 / (slope * phase.angle))
        base = motion.levels[k] if direction > 0 else motion.levels[k + 1]
        heights.append(height - slope * float(base))
    return max(heights)


def steepest_line(law: Law, k: float) -> float:
    """The greatest f' - f/k, k = cot(A)/F: the height at which the tangent at the angle A meets the axis of v.

    With q = pi k it is pi/2 q/(1 + sqrt(1 + q^2)) for the cosine, and with q = 2 pi k 2 - 2 atan(q)/q for the cycloid.
    For a polynomial f' and f/k have u^n/(1 - u) in common at the tangent point, n k (1 - 2u) = u (1 - u); what is left
    is a polynomial without the cancellation of the two.

    >>> from graphcam.given.laws import law
    >>> round(steepest_line(law("cosine"), 1.5), 12)
    1.272441311934
    """
    if law.name == "cosine":
        q = math.pi * k
        return math.pi / 2 * q / (1 + math.hypot(1, q))
    q = 2 * math.pi * k
    if law.name == "cycloidal":
        return 2 * _less_atan(q) / q
    u = tangent_point(law, k)
    if law.name == "rectangular":
        return 2 * (1 + law.ratio) * u * (1 - u / k / 2)
    if law.name in _POLYNOMIALS:
        n, coefficients = _POLYNOMIALS[law.name]
        rest = 0.0
        for coefficient in reversed(coefficients):
            rest = coefficient + u * rest
        return u**n / (1 - u) * rest
    f, f1 = law(u, derivatives=1)
    return float(f1 - f / k)


def _less_atan(q: float) -> float:
    """q - atan(q) for q > 0, to its own last digits."""
    if q > 2:
        return q - math.atan(q)
    if q > 0.3:
        # atan(q) = 2 atan(t) with q = 2t/(1 - t^2), and both terms are positive.
        t = q / (1 + math.hypot(1, q))
        return 2 * (t**3 / ((1 - t) * (1 + t)) + _less_atan(t))
    series = 0.0
    for n in range(33, 1, -2):
        series = 1 / n - q * q * series
    return q**3 * series


def tangent_point(law: Law, k: float) -> float:
    """The u at which f' - f/k is greatest, k = cot(A)/F: where the tangent at the angle A touches the s - v diagram.

    It is the root of k f'' = f' in the first half of the law, and f'/f'' grows there from 0 without bound.  A measured
    law may accelerate several times: then it is one of several roots.

    >>> from graphcam.given.laws import law
    >>> tangent_point(law("2-3"), 1.5)
    0.4188611699158103
    """
    if law.name in _POLYNOMIALS:  # n k (1 - 2u) = u (1 - u)
        q = 2 * _POLYNOMIALS[law.name][0] * k
        return q / (1 + q + math.hypot(1, q))
    if law.name in ("cosine", "cycloidal"):
        return math.atan(math.pi * k if law.name == "cosine" else 2 * math.pi * k) / math.pi
    if law.name == "rectangular":
        return min(k, law.middle)

    def slope(u: Floats) -> Floats:
        _, f1, f2 = law(u, derivatives=2)
        return k * f2 - f1

    if law.name != MEASURED:
        # Up to its first break the acceleration does not fall, so f' <= u f'', and half of k or of the break is below.
        return float(roots(slope, min(k, law.breaks[0]) / 2, law.middle))
    edges = np.array([0.0, *law.edges, 1.0])
    u = (edges[:-1, None] + np.diff(edges)[:, None] * SAMPLES).ravel()
    sign = np.sign(slope(u))
    top = np.flatnonzero((sign[:-1] > 0) & (sign[1:] <= 0))
    places = roots(slope, u[top], u[top + 1])
    f, f1 = law(places, derivatives=1)
    return float(places[np.argmax(f1 - f / k)])


_POLYNOMIALS = {"2-3": (1, (3, -4, 2)), "3-4-5": (2, (10, -20, 18, -6)), "4-5-6-7": (3, (35, -98, 126, -80, 20))}
"""The laws with f' proportional to (u (1 - u))^n, their n, and (f' - f/k)(1 - u)/u^n at the tangent point."""

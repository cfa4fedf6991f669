"""The least prime radius of a translating follower: the region for the cam centre, cut out by lines.

With e' = sigma e the pressure angle is permitted on the rises, on the returns and at the low rest where

    s0 tan A  + e' >= M,    M  = max over the rises of (v - s tan A)
    s0 tan A' - e' >= M',   M' = max over the returns of (|v| - s tan A')
    s0 tan A  - e' >= 0

so the cam centre lies in a region bounded by up to three lines, and r0 is its distance from the start of the lift.

Source: the shaded region of the textbooks on the theory of machines, written as inequalities.
"""

import cmath
import math
from dataclasses import dataclass

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.follower import Translating
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits
from graphcam.given.motion import Motion, Return, Rise
from graphcam.given.motion_law import Law
from graphcam.mechanism.half_planes import HalfPlane, Line, nearest
from graphcam.mechanism.roots import roots
from graphcam.mechanism.stationary import SAMPLES


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


def translating_minimum_radius(
    motion: Motion, follower: Translating, sigma: int, limits: Limits, offset: float | None = None
) -> MinimumRadius:
    """The least prime radius for permitted pressure angles, at an offset [mm] if it is given; not the follower's own.

    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, math.pi / 2, "cosine"), gc.Return(30, math.pi / 2, "cosine"),
    ...     gc.Dwell(math.pi)])
    >>> least = translating_minimum_radius(motion, gc.Translating(), +1, Limits())
    >>> round(least.prime_radius, 4), round(least.offset, 4), least.active
    (22.5647, 11.2824, ('rise', 'rest'))
    """
    lines = _region(motion, limits)
    if offset is None:
        point, binding = nearest(lines)
        return MinimumRadius(abs(point), sigma * point.real, tuple([line.name for line in binding if line.name]))
    if not math.isfinite(offset):
        raise DesignError("offset", offset, "a finite length in mm", "leave it out to let it be found")
    place = sigma * offset
    heights = [(height - normal.real * place) / normal.imag for _, normal, height, _ in lines]
    s0 = max(0.0, *heights)
    lowest = zip(heights, lines, strict=True)
    active: list[Line] = [line.name for height, line in lowest if height == s0 > 0 and line.name]
    return MinimumRadius(math.hypot(offset, s0), offset, tuple(active))


def _region(motion: Motion, limits: Limits) -> list[HalfPlane]:
    """The lines for the point e' + i s0, each multiplied by the cosine of its angle."""
    normal = cmath.rect(1.0, limits.rise)
    lines = [HalfPlane("rise", normal, normal.real * _steepest_line(motion, Rise, math.tan(limits.rise)))]
    if limits.return_ is not None:
        back = cmath.rect(1.0, limits.return_)
        height = back.real * _steepest_line(motion, Return, math.tan(limits.return_))
        lines.append(HalfPlane("return", -back.conjugate(), height))
    if limits.rest:
        lines.append(HalfPlane("rest", -normal.conjugate(), 0.0))
    return lines


# --- the tangent to the s - v diagram --------------------------------------------------------------------------------


def _steepest_line(motion: Motion, kind: type[Rise | Return], slope: float) -> float:
    """M or M': the greatest |v| - s * slope over all rises or all returns [mm/rad]."""
    heights: list[float] = []
    for k, phase in enumerate(motion.phases):
        if isinstance(phase, kind):
            # A return is seen from its lower end, as if time ran backwards: |v| and s are then those of a rise.
            law, low = (phase.normalised, k) if kind is Rise else (phase.normalised.reversed, k + 1)
            _, height = steepest_tangent(law, 1 / (slope * phase.angle))
            heights.append(phase.lift / phase.angle * height - slope * float(motion.levels[low]))
    return max(heights)


def steepest_tangent(law: Law, k: float) -> tuple[float, float]:
    """The u at which f' - f/k is greatest, k = cot(A)/F, and that value.

    There the tangent at the angle A touches the s - v diagram, and it meets the axis of v at that height.

    >>> import graphcam as gc
    >>> u, height = steepest_tangent(gc.law("cosine"), 1.5)
    >>> round(u, 12), round(height, 12)
    (0.433439924624, 1.272441311934)
    """
    if closed_form := law.tangents[0]:
        return closed_form(k)

    def slope(u: Floats) -> Floats:
        _, f1, f2 = law(u, derivatives=2)
        return k * f2 - f1

    edges = np.array([0.0, *law.edges, 1.0])
    u = (edges[:-1, None] + np.diff(edges)[:, None] * SAMPLES).ravel()
    # Of a law that begins as u^n the place is (n - 1) k for small k, which may lie before every sample.
    u = np.append(min(k, u[0]) / 2, u)
    sign = np.sign(slope(u))
    top = np.flatnonzero((sign[:-1] > 0) & (sign[1:] <= 0))
    places = roots(slope, u[top], u[top + 1])
    f, f1 = law(places, derivatives=1)
    heights = f1 - f / k
    best = np.argmax(heights)
    return float(places[best]), float(heights[best])

"""The least prime radius of a translating follower: the region for the cam centre, cut out by lines.

With e' = sigma e the pressure angle is permitted on the rises, on the returns and at the low rest where

    s0 tan A  + e' >= M,    M  = max over the rises of (v - s tan A)
    s0 tan A' - e' >= M',   M' = max over the returns of (|v| - s tan A')
    s0 tan A  - e' >= 0

so the cam centre lies in a region bounded by up to three lines, and r0 is its distance from the start of the lift.

Source: the shaded region of the textbooks on the theory of machines, written as inequalities.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.follower import Translating
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits
from graphcam.given.motion import Dwell, Motion
from graphcam.given.motion_law import Law
from graphcam.mechanism.half_planes import HalfPlane, Line, names_of, nearest
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
        return MinimumRadius(abs(point), sigma * point.real, names_of(binding))
    if not math.isfinite(offset):
        raise DesignError("offset", offset, "a finite length in mm", "leave it out to let it be found")
    heights = [(line.height - line.normal.real * sigma * offset) / line.normal.imag for line in lines]
    s0 = max(0.0, *heights)
    binding = [line for line, height in zip(lines, heights, strict=True) if height == s0 > 0]
    return MinimumRadius(math.hypot(offset, s0), offset, names_of(binding))


def _region(motion: Motion, limits: Limits) -> list[HalfPlane]:
    """The lines for the point e' + i s0, each multiplied by the cosine of its angle."""
    lines = [_line("rise", +1, limits.rise, _steepest_line(motion, +1, math.tan(limits.rise)))]
    if limits.return_ is not None:
        lines.append(_line("return", -1, limits.return_, _steepest_line(motion, -1, math.tan(limits.return_))))
    return [*lines, _line("rest", -1, limits.rise, 0.0)] if limits.rest else lines


def _line(name: Line, side: int, angle: float, height: float) -> HalfPlane:
    cosine = math.cos(angle)
    return HalfPlane(name, complex(side * cosine, math.sin(angle)), height * cosine)


# --- the tangent to the s - v diagram --------------------------------------------------------------------------------


def _steepest_line(motion: Motion, direction: int, slope: float) -> float:
    """M or M': the greatest |v| - s * slope over all rises (+1) or all returns (-1) [mm/rad]."""
    heights: list[float] = []
    for k, phase in enumerate(motion.phases):
        if isinstance(phase, Dwell) or phase.direction != direction:
            continue
        # A return is seen from its lower end, as if time ran backwards: |v| and s are then those of a rise.
        law = phase.normalised if direction > 0 else phase.normalised.reversed
        height = phase.lift / phase.angle * steepest_tangent(law, 1 / (slope * phase.angle))[1]
        base = motion.levels[k] if direction > 0 else motion.levels[k + 1]
        heights.append(height - slope * float(base))
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

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
from graphcam.given.laws import Floats, Law
from graphcam.given.limits import Limits
from graphcam.given.motion import Dwell, Motion
from graphcam.given.spline_law import MEASURED
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

    >>> from graphcam.given.motion import Return, Rise
    >>> motion = Motion([Rise(30, math.pi / 2, "cosine"), Return(30, math.pi / 2, "cosine"), Dwell(math.pi)])
    >>> least = translating_minimum_radius(motion, Translating(), +1, Limits())
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

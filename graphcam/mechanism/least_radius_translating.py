"""The minimum prime radius of a translating follower: the region for the cam centre, cut out by lines.

With e' = sigma e the pressure angle is permitted on the rises and on the returns, their ends included, where

    s0 tan A  + e' >= M,    M  = max over the rises of (v - s tan A)
    s0 tan A  - e' >= 0
    s0 tan A' - e' >= M',   M' = max over the returns of (|v| - s tan A')
    s0 tan A' + e' >= 0

so the cam centre lies in a region bounded by lines, and r0 is its distance from the start of the lift.  The second and
the fourth, of |alpha| in the lower dwell, say that the angle keeps its limit on the side to which no velocity drives
it: there |v| and s only help, so the end of the phase decides.

Source: the shaded region of the textbooks on the theory of machines, written as inequalities.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import check_number
from graphcam.given.extreme_search import SmoothPieces
from graphcam.given.follower import Limits, Translating
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.motion_law import Law
from graphcam.mechanism.half_planes import LINE_NAMES, HalfPlane, Line, nearest_point
from graphcam.mechanism.leg_places import legs
from graphcam.words import say

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
    lines = _region(motion, limits)
    if offset is None:
        centre, kept = nearest_point(lines)
        return MinimumRadius(abs(centre), sigma * centre.real, _names(kept))
    check_number("offset", offset, say("a finite length in mm"), say("leave it out to let it be found"))
    across = sigma * offset
    needed = [(line.height - line.normal.real * across) / line.normal.imag for line in lines]
    s0 = max(0.0, *needed)
    kept = [line for line, least in zip(lines, needed, strict=True) if least == s0 > 0]
    return MinimumRadius(math.hypot(offset, s0), offset, _names(kept))


def _region(motion: Motion, limits: Limits) -> list[HalfPlane]:
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


# --- the tangent to the s - v diagram --------------------------------------------------------------------------------


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

"""The minimum prime radius of a translating follower: the region for the cam centre, cut out by lines.

With e' = sigma e the pressure angle is permitted on the rises, on the returns and at the lower dwell where

    s0 tan A  + e' >= M,    M  = max over the rises of (v - s tan A)
    s0 tan A' - e' >= M',   M' = max over the returns of (|v| - s tan A')
    s0 tan A  - e' >= 0

so the cam centre lies in a region bounded by up to three lines, and r0 is its distance from the start of the lift.

Source: the shaded region of the textbooks on the theory of machines, written as inequalities.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import check_number
from graphcam.given.extreme_search import SmoothPieces
from graphcam.given.follower import Limits, Translating
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.motion_law import Law
from graphcam.mechanism.half_planes import Line
from graphcam.mechanism.leg_places import legs
from graphcam.words import say

GROWING_PLACES = 0.3 * 4.0 ** np.arange(60)
"""Places, over a small one, between which a law grows by no more than some powers of four."""


@dataclass(frozen=True)
class MinimumRadius:
    """The minimum permitted prime radius and its offset [mm]; ``active`` names the active lines."""

    prime_radius: float
    offset: float
    active: tuple[Line, ...]
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
    slope = math.tan(limits.rise)
    height = _steepest_line(motion, +1, slope)
    lines: list[_Bound] = []
    if limits.return_ is not None:
        back = math.tan(limits.return_)
        lines.append(("return", back, _steepest_line(motion, -1, back)))
    if limits.rest:
        lines.append(("rest", slope, 0.0))
    if offset is None:
        across, s0, active = _nearest_permitted(slope, height, lines)
        return MinimumRadius(math.hypot(across, s0), sigma * across, active)
    check_number("offset", offset, say("a finite length in mm"), say("leave it out to let it be found"))
    place = sigma * offset
    heights: dict[Line, float] = {"rise": (height - place) / slope}
    heights |= {name: (height + place) / slope for name, slope, height in lines}
    s0 = max(0.0, *heights.values())
    needing: list[Line] = [name for name, needed in heights.items() if needed == s0 > 0]
    return MinimumRadius(math.hypot(offset, s0), offset, tuple(needing))


_Bound = tuple[Line, float, float]
"""Name, slope and height of the line of the returns, or of the rest: s0 slope - e' >= height."""


def _nearest_permitted(slope: float, height: float, lines: list[_Bound]) -> tuple[float, float, tuple[Line, ...]]:
    """The point (e', s0) nearest to the start of the lift, with s0 slope + e' >= height and the other lines kept."""
    for name, other, its_height in lines:
        # Where the perpendicular meets the line of the returns the rises may be kept too.
        foot = its_height / (1 + other * other)
        if foot * (slope * other - 1) >= height:
            return -foot, foot * other, (name,)
    # Else the point lies on the rises' line: at the foot, or farther up, as far as the others need.
    across = height / (1 + slope * slope)
    s0 = across * slope
    active: tuple[Line, ...] = ("rise",)
    for name, other, its_height in lines:
        crossing = (height + its_height) / (slope + other)
        if crossing > s0:
            across, s0 = (height * other - its_height * slope) / (slope + other), crossing
            active = "rise", name
    return across, s0, active


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

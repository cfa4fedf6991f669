"""The region of cams that keep all limits, over the plane of the radius and another size."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphcam.given.laws import Floats
from graphcam.mechanism.sizing_limits import TurnPlaces
from graphcam.mechanism.sizing_problem import SizingProblem

HALVINGS = 20
"""The borders are found by halving the range of the radius so often."""
ROLLERS = 25
"""Rollers that are tried on every cam."""
FINER = 3
"""How many times as many places as in the search the region begins with."""
ALL = "all limits"
Across = Literal["offset", "roller radius", "face width"]
"""The size over which a region is drawn."""


@dataclass(frozen=True, eq=False)
class FeasibleRegion:
    """The least radius over another size, with the best roller and the widest face where these are not that size.

    It is for a drawing: limits are looked at at places of the turn, and rollers are tried, which leaves about 0.01 mm.

    across : the other size;  values : of it (n,) [mm]
    by_limit : (n,) mm by the names of the limits, each for itself; NaN where no radius of the range keeps it
    least : (n,) mm, where all limits are kept together
    """

    across: Across
    values: Floats
    by_limit: dict[str, Floats]
    least: Floats


def across_of(problem: SizingProblem) -> Across:
    """The first size that has a range; the offset where all others are given."""
    ranges = problem.offset, problem.roller_radius, problem.face_width
    names: tuple[Across, Across, Across] = ("offset", "roller radius", "face width")
    for name, (low, high) in zip(names, ranges, strict=True):
        if low < high:
            return name
    return "offset"


def feasible_region(problem: SizingProblem, parts: int = 60) -> FeasibleRegion:
    """The borders of the region at ``parts + 1`` values of the size of :func:`across_of`.

    A larger radius is taken to be better for every limit, as it is wherever the load does not depend on it.
    """
    places, across = TurnPlaces.spread(problem.motion, problem.load, FINER), across_of(problem)
    values = np.linspace(*problem.ranges[across], parts + 1)
    tried = values[:, None, None]
    low, high = problem.roller_radius
    rollers = np.linspace(low, high, ROLLERS if low < high else 1)[:, None]
    offset = tried if across == "offset" else problem.offset[0]
    roller = tried if across == "roller radius" else rollers
    width = tried if across == "face width" else problem.face_width[1]

    def left(radius: Floats) -> dict[str, Floats]:
        """Of every limit with the best roller, and of all together."""
        sizes = problem.sizes(radius[:, None, None], offset, roller, width)
        worst = {name: margin.min(axis=-1) for name, margin in problem.margins(places, sizes).items()}
        together = np.minimum.reduce(np.broadcast_arrays(*worst.values()))
        return {name: margin.max(axis=-1) for name, margin in (*worst.items(), (ALL, together))}

    borders = {name: _border(problem, left, name, parts + 1) for name in problem.limits.kept}
    return FeasibleRegion(across, values, borders, _border(problem, left, ALL, parts + 1))


def _border(problem: SizingProblem, left: Callable[[Floats], dict[str, Floats]], name: str, count: int) -> Floats:
    """The least radius of the range that keeps a limit, by halving; NaN where none does."""
    low, high = (np.full(count, end, dtype=np.float64) for end in problem.radius)
    none, kept_at_once = left(high)[name] < 0, left(low)[name] >= 0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        kept = left(middle)[name] >= 0
        low, high = np.where(kept, low, middle), np.where(kept, middle, high)
    return np.where(none, np.nan, np.where(kept_at_once, problem.radius[0], high))

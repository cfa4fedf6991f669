"""The region of cams that keep all limits, over the plane of offset and prime radius."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from graphcam.given.laws import Floats
from graphcam.mechanism.sizing import SizingProblem
from graphcam.mechanism.sizing_limits import LIMITS, Sizes, TurnPlaces

HALVINGS = 30
"""The borders are found by halving the range of the prime radius so often."""
ROLLERS = 25
"""Rollers that are tried on every cam."""
FINER = 4
"""So many times as many places as the search begins with."""
ALL = "all limits"


@dataclass(frozen=True, eq=False)
class FeasibleRegion:
    """The least prime radius at every offset, with the widest face and the best roller.

    It is for a drawing: limits are looked at at places of the turn, and rollers are tried, which leaves about 0.01 mm.

    offset : (n,) mm
    by_limit : (n,) mm by the names of the limits, each for itself; NaN where no prime radius of the range keeps it
    least : (n,) mm, where all limits are kept together
    """

    offset: Floats
    by_limit: dict[str, Floats]
    least: Floats


def feasible_region(problem: SizingProblem, parts: int = 60) -> FeasibleRegion:
    """The borders of the region at ``parts + 1`` offsets of the range.

    A larger prime radius is taken to be better for every limit, as it is wherever the load does not depend on it.
    """
    places = TurnPlaces.spread(problem.motion, problem.load, FINER)
    offset = np.linspace(*problem.offset, parts + 1)
    rollers = np.linspace(*problem.roller_radius, ROLLERS)

    def left(radius: Floats) -> dict[str, Floats]:
        """Of every limit with the best roller, and of all together."""
        sizes = Sizes(radius[:, None, None], offset[:, None, None], rollers[:, None], problem.face_width[1])
        worst = {name: margin.min(axis=-1) for name, margin in problem.margins(places, sizes).items()}
        together = np.minimum.reduce(np.broadcast_arrays(*worst.values()))
        return {name: margin.max(axis=-1) for name, margin in (*worst.items(), (ALL, together))}

    limited = [name for name in LIMITS if problem.limits.return_ is not None or "return" not in name]
    borders = {name: _border(problem, left, name, parts + 1) for name in limited}
    return FeasibleRegion(offset, borders, _border(problem, left, ALL, parts + 1))


def _border(problem: SizingProblem, left: Callable[[Floats], dict[str, Floats]], name: str, count: int) -> Floats:
    """The least prime radius of the range that keeps a limit, by halving; NaN where none does."""
    low, high = (np.full(count, end, dtype=np.float64) for end in problem.prime_radius)
    none, kept_at_once = left(high)[name] < 0, left(low)[name] >= 0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        kept = left(middle)[name] >= 0
        low, high = np.where(kept, low, middle), np.where(kept, middle, high)
    return np.where(none, np.nan, np.where(kept_at_once, problem.prime_radius[0], high))

"""The search for the best sizes in their ranges under limits that hold over the whole turn.

A limit is a constraint at every place of the turn.  Constraints at some places are solved by sequential quadratic
programming (scipy); then the exact extremes of that cam say where a limit is exceeded, and these places are added,
until none is (exchange, as in semi-infinite programming: R. Hettich, K. O. Kortanek, *SIAM Review* 35 (1993)).
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace
from typing import Literal

import numpy as np

from graphcam.given.laws import Floats
from graphcam.mechanism.sizing_limits import LIMITS, Sizes, SizingProblem, TurnPlaces

Goal = Literal["radius", "width", "room"]
"""What is sought: the least radius with the widest face, the least face width that bears the load, which has the least
stress, or the most that is left of all limits, to see how near a cam comes to them."""
MAX_EXCHANGES = 30
"""Exchanges at most; a few are enough."""
EXCHANGE_SLACK = 1e-10
"""A limit is kept if it is exceeded by less than this part of it while places are exchanged."""
WIDTH_SLACK = 1e-9
"""The part of a limit by which a search for the width stays within it, so that rounding does not cost radius."""
SAME_SIZE = 1e-13
"""Sizes that differ by less than this part are the same."""
MAX_LAST_MOVE = 1e-5
"""The last move of the prime radius is smaller than this part of it."""
MIN_WIDTH_SHARE = 1e-9
"""Narrower than this part of the widest face none is sought."""
START_COUNT = 3
"""The number of the best cams of a coarse grid from which the search starts."""
GRID_SHAPE = 13, 9, 7
"""Cams of the coarse grid, by radius, offset and roller radius."""


class WatchedPlaces:
    """The places of the turn at which limits are constraints; every search adds those that it has found to matter."""

    def __init__(self, problem: SizingProblem) -> None:
        self.places = TurnPlaces.spread(problem.motion, problem.load)


def best_sizes(
    problem: SizingProblem, goal: Goal, watched: WatchedPlaces | None = None, first: Sizes | None = None
) -> Sizes | None:
    """The best cam in the ranges that keeps all limits; None where no cam was found that does.

    watched : by searches for the same motion and load before;  first : a cam from which the search starts too
    """
    watched = watched or WatchedPlaces(problem)
    low, high = problem.radius
    # A radius that is given is not sought: what keeps the limits best is as good as any.
    sought: Goal = "room" if goal == "radius" and low == high else goal
    starts = [first, *_starts(problem, goal)[:1]] if first else _starts(problem, goal)
    found = [exchange(problem, sought, start, watched) for start in starts]
    kept = [sizes for sizes in found if problem.keeps(_with_widest_face(problem, sizes))]
    if not kept and sought != "room":
        near = exchange(problem, sought, nearest_sizes(problem), watched)
        kept = [near] if problem.keeps(_with_widest_face(problem, near)) else []
    if not kept:
        return None
    if goal == "width":
        return min(kept, key=problem.exact_width)
    return polished(problem, min(kept, key=lambda sizes: sizes.radius))


def nearest_sizes(problem: SizingProblem, names: Collection[str] = LIMITS) -> Sizes:
    """The cam of the ranges, with the widest face, that has most left of the limits of these names, or exceeds them
    least."""
    watched = WatchedPlaces(problem)
    found = [exchange(problem, "room", start, watched, names) for start in _starts(problem, "room", names)]
    return max(found, key=lambda sizes: _least_margin(problem, sizes, names))


def exchange(
    problem: SizingProblem, goal: Goal, start: Sizes, watched: WatchedPlaces, names: Collection[str] = LIMITS
) -> Sizes:
    """Solve with constraints at places, and add those where the exact extremes exceed a limit, until none does."""
    sizes = start
    for _ in range(MAX_EXCHANGES):
        before = sizes
        sizes, room = _solve(problem, goal, watched.places, sizes, names)
        worst = TurnPlaces.at_extremes(problem.stress(sizes))
        left = problem.margins(worst, sizes)
        chosen = np.any([left[name] < room - EXCHANGE_SLACK for name in names], axis=0)
        # Where the radius leaves no room at all, a search for the width comes to rest a little beyond a limit.
        steps = (abs(x - y) for x, y in zip(problem.values(before), problem.values(sizes), strict=True))
        if not chosen.any() or all(step <= SAME_SIZE * before.radius for step in steps):
            break
        watched.places = watched.places.joined(worst.selected(chosen))
    return sizes


def polished(problem: SizingProblem, sizes: Sizes) -> Sizes:
    """The prime radius moved a little to where the exact extremes just keep all limits."""
    from scipy.optimize import brentq

    def left(radius: float) -> float:
        """What is left of the limit that is kept most narrowly, as a part of it, with a prime radius [mm]."""
        return min(problem.exact_margins(replace(sizes, radius=radius)).values())

    low, high = sizes.radius * (1 - MAX_LAST_MOVE), sizes.radius * (1 + MAX_LAST_MOVE)
    _, *others = problem.values(sizes)
    low = max(low, float(problem.sizes(problem.radius_ends[0], others[0], others[1], others[2]).radius))
    if left(low) >= 0:
        return replace(sizes, radius=low)
    if left(high) < 0:
        return sizes
    radius = float(brentq(left, low, high, xtol=1e-13 * high, rtol=1e-15))  # pyright: ignore[reportArgumentType]
    while left(radius) < 0:  # on the permitted side of the root
        radius = math.nextafter(radius, math.inf)
    return replace(sizes, radius=radius)


def _with_widest_face(problem: SizingProblem, sizes: Sizes) -> Sizes:
    return replace(sizes, width=problem.width[1])


def _least_margin(problem: SizingProblem, sizes: Sizes, names: Collection[str]) -> float:
    left = problem.exact_margins(sizes)
    return min(left[name] for name in names)


def _starts(problem: SizingProblem, goal: Goal, names: Collection[str] = LIMITS) -> list[Sizes]:
    """The best cams of a coarse grid that keep the limits, or those that exceed them least."""
    ranges = problem.radius_ends, problem.offset, problem.roller_radius
    axes = [np.linspace(0, 1, n if high > low else 1) for (low, high), n in zip(ranges, GRID_SHAPE, strict=True)]
    shares = [axis.reshape(-1, 1) for axis in np.meshgrid(*axes, indexing="ij")]
    places, widest = TurnPlaces.spread(problem.motion, problem.load), problem.width[1]
    grid = problem.at_shares(shares[0], shares[1], shares[2], widest)
    left = problem.margins(places, grid)
    worst = np.min([left[name].min(axis=-1) for name in names], axis=0)
    radius, offset, roller = (np.ravel(size) for size in np.broadcast_arrays(grid.radius, grid.offset, grid.roller))
    wanted = {"radius": shares[0].ravel(), "width": problem.needed_width(places, grid).max(axis=-1), "room": -worst}[
        goal
    ]
    order = np.lexsort((-worst, np.where(worst >= 0, wanted, np.inf)))
    return [Sizes(float(radius[k]), float(offset[k]), float(roller[k]), widest) for k in order[:START_COUNT]]


def _solve(
    problem: SizingProblem, goal: Goal, places: TurnPlaces, start: Sizes, names: Collection[str]
) -> tuple[Sizes, float]:
    """Sequential quadratic programming with constraints at the places alone: the sizes, and the room that is left."""
    from scipy.optimize import minimize

    widest = problem.width[1]
    least = MIN_WIDTH_SHARE * widest if goal == "width" else widest
    ranges = problem.radius_ends, problem.offset, problem.roller_radius, (least, widest)
    free = np.array([high > low for low, high in ranges])
    count, room = int(np.count_nonzero(free)), goal == "room"

    def sizes(t: Floats) -> Sizes:
        shares = np.zeros(free.size)
        shares[free] = t[:count]
        radius, offset, roller, width = shares.tolist()
        found = problem.at_shares(radius, offset, roller, least + width * (widest - least))
        return Sizes(float(found.radius), float(found.offset), float(found.roller), found.width)

    def left(t: Floats) -> Floats:
        """What is left of every limit at every place, as a part of it, beyond the room that is sought."""
        found = problem.margins(places, sizes(t))
        of_all = np.concatenate([margin[np.isfinite(margin)] for name in names for margin in [found[name]]])
        return of_all - (t[count] if room else WIDTH_SLACK if goal == "width" else 0.0)

    width = (start.width - least) / (widest - least) if free[3] else 0.0
    parts = np.array([*problem.shares(start), min(max(width, 0.0), 1.0)])[free]
    if not room:
        k = int(np.count_nonzero(free[: 0 if goal == "radius" else 3]))
        begin, bounds, slope = parts, [(0.0, 1.0)] * count, np.eye(count)[k]
    else:
        begin = np.append(parts, float(left(np.append(parts, 0.0)).min()))
        bounds, slope = [(0.0, 1.0)] * count + [(None, None)], -np.eye(count + 1)[count]

    def sought(t: Floats) -> float:
        return float(slope @ t)

    def sought_slope(_: Floats) -> Floats:
        return slope

    kept, options = {"type": "ineq", "fun": left}, {"ftol": 1e-14, "maxiter": 200}
    result = minimize(sought, begin, jac=sought_slope, bounds=bounds, constraints=kept, method="SLSQP", options=options)
    t = np.clip(result.x, 0, 1) if not room else np.append(np.clip(result.x[:-1], 0, 1), result.x[-1])
    return sizes(t), float(t[count]) if room else 0.0

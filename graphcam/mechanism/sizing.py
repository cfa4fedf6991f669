"""The smallest cam within given ranges, or that of the minimum stress, the front between both, and their region.

The unknowns are the cam's radius, offset and roller radius.  Limits are the pressure angles, the roller's rule and the
contact stress.  Hertz's stress falls as 1/sqrt(width), so the minimum stress with the widest face and the minimum width
for a permitted stress are found by the same search, and one front of radius and stress is that of radius and width too.
Last, the radius is moved to where the exact extremes just keep all limits, so that nothing rests on samples.

Source of the problem: Tran Minh Quang, Nguyen Quang Hung (2015).

The search for the best sizes in their ranges under limits that hold over the whole turn.

A limit is a constraint at every place of the turn.  Constraints at some places are solved by sequential quadratic
programming (scipy); then the exact extremes of that cam say where a limit is exceeded, and these places are added,
until none is (exchange, as in semi-infinite programming: R. Hettich, K. O. Kortanek, *SIAM Review* 35 (1993)).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass, field, replace
from typing import Literal, NoReturn, cast

import numpy as np

from graphcam.errors import DesignError, check_kind
from graphcam.former_names import renamed
from graphcam.given.follower import Rotation, Translating
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.plausible_ranges import NUMBER_TYPES
from graphcam.given.roller_contact import RollerContact
from graphcam.given.roller_rule import DEFAULT_RULE, roller_rule as terms_of
from graphcam.given.spring_load import SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.sizing_limits import (
    BINDING_SHARE,
    CURVATURE_LIMIT,
    LIMITS,
    NO_UNDERCUT_RULE,
    RETURN_LIMIT,
    RISE_LIMIT,
    SHARE_LIMIT,
    STRESS_LIMIT,
    Measure,
    Range,
    Sizes,
    SizingLimits,
    SizingProblem,
    TurnPlaces,
)
from graphcam.showing import value_text
from graphcam.words import Caption, Words, and_chain, or_list, say

# --- the search ------------------------------------------------------------------------------------------------------

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


# --- the smallest cam ------------------------------------------------------------------------------------------------

Objective = Literal["size", "stress"]
OBJECTIVES: tuple[Objective, ...] = ("size", "stress")
"""The minimum radius, and at it the narrowest face; or the minimum stress, with the widest face."""
DOMINATED_SHARE = 1e-6
"""A cam of the front whose stress is less by no more than this part is no gain."""


SAME_EXCESS = 1e-3
"""Limits that the nearest cam exceeds by parts that differ by less stand in each other's way."""
CONFLICT_REASON = say("no cam in the ranges keeps them all")


def refuse(problem: SizingProblem) -> NoReturn:
    """Say which limit no cam of the ranges keeps, or which of them not together, and where they come nearest.

    Raises
    ------
    DesignError : always
    """
    near = nearest_sizes(problem)
    left = problem.exact_margins(near)
    worst = min(left.values())
    together = [
        name for name in problem.limits.names if left[name] <= worst + SAME_EXCESS and left[name] < -BINDING_SHARE
    ]
    for name in together:
        alone = nearest_sizes(problem, [name])
        if problem.exact_margins(alone)[name] < -BINDING_SHARE:
            raise _error(problem, alone, [name], say("no cam in the ranges keeps it, even without the other limits"))
    raise _error(
        problem, near, together, say("no cam in the ranges keeps both") if len(together) == 2 else CONFLICT_REASON
    )


def _error(problem: SizingProblem, near: Sizes, names: list[str], why: Words) -> DesignError:
    said = [_limit_values(problem, near, name) for name in names]
    found, limit = map(and_chain, zip(*said, strict=True))
    sizes = zip(problem.ranges, problem.values(near), strict=True)
    at = ", ".join(f"{name} {value:.6g}" for name, value in sizes)
    remedy = say("{why}: the nearest has {at} mm; widen the ranges or permit more", why=why, at=at)
    return DesignError(and_chain(names), found, limit, remedy)


def _limit_values(problem: SizingProblem, near: Sizes, name: str) -> tuple[Caption, Caption]:
    """The cam's value of a limit, and the permitted one, as captions."""
    limits = problem.limits
    if name in (RISE_LIMIT, RETURN_LIMIT):
        permitted = limits.rise if name == RISE_LIMIT else limits.return_ or math.inf
        steepness = math.tan(permitted) * (1 - problem.exact_margins(near)[name])
        return say("{degrees:.4g} degrees", degrees=math.degrees(math.atan(steepness))), say(
            "at most {degrees:.4g} degrees", degrees=math.degrees(permitted)
        )
    if name in (CURVATURE_LIMIT, SHARE_LIMIT):
        rho = problem.stress(near).forces.cam.extremes().min_convex_radius[0]
        kind = "rho" if name == CURVATURE_LIMIT else "r0"
        terms = [term for term in (*limits.rule, NO_UNDERCUT_RULE) if term.of == kind]
        most = min(terms, key=lambda term: term(rho, near.radius))
        least = say("{radius:.4g} mm of prime radius", radius=near.radius)
        if name == CURVATURE_LIMIT:
            least = say("{rho:.4g} mm of curvature", rho=rho)
        return say("a roller of {roller:.4g} mm on {least}", roller=near.roller, least=least), say(
            "a roller of at most {text}", text=most.text
        )
    assert name == STRESS_LIMIT
    stress = limits.stress * math.sqrt(problem.exact_width(near) / near.width)
    return say("{stress:.5g} MPa", stress=stress), say("at most {stress:.5g} MPa", stress=limits.stress)


@renamed(face_width="width", least_width="min_width")
@dataclass(frozen=True, repr=False)
class SizedCam:
    """The best cam of a sizing problem, with its widths, its extremes and the limits that bind.

    cam : with its prime radius and roller;  offset : of its follower [mm]
    width : of its face [mm];  min_width : the minimum that the stress permits, whatever its range [mm]
    max_pressure_angle : on the rises and, if it is limited, on the returns, in magnitude [rad]
    min_convex_radius : of the pitch curve [mm];  stress : maximum peak pressure with this face width [MPa]
    binding : what keeps the radius, or with the objective "stress" the stress, from being smaller: ends of ranges, and
        limits that a wider face would not relax
    active : limits that are just satisfied with this face width, and ends of ranges
    problem : the sizing problem
    """

    cam: Cam
    offset: float
    width: float
    min_width: float
    max_pressure_angle: float
    min_convex_radius: float
    stress: float
    binding: tuple[str, ...]
    active: tuple[str, ...]
    problem: SizingProblem = field(repr=False)

    def __repr__(self) -> str:
        sizes = self.sizes
        widths = f"roller radius {sizes.roller:.6g} mm, face width {self.width:.6g} mm"
        angle, stress = math.degrees(self.max_pressure_angle), f"contact stress up to {self.stress:.4g} MPa"
        said = [
            f"prime radius {sizes.radius:.6g} mm, offset {self.offset:.6g} mm, {widths}",
            f"pressure angle up to {angle:.4g}°, radius of curvature from {self.min_convex_radius:.4g} mm, {stress}",
            f"bound by: {', '.join(self.binding) or 'nothing'}",
        ]
        last = ".cam, .radius, .stress, .min_width, .binding, .active"
        return value_text("SizedCam", said, last)

    @property
    def radius(self) -> float:
        """The prime or the base radius [mm], whichever was given a range."""
        return self.problem.values(self.sizes)[0]

    @property
    def sizes(self) -> Sizes:
        """The sizes of the cam [mm]."""
        return Sizes(self.cam.prime_radius, self.offset, self.cam.roller_radius, self.width)


@renamed(face_width="width")
def size_cam(
    motion: Motion,
    load: SpringLoad,
    *,
    prime_radius: Range | float | None = None,
    base_radius: Range | float | None = None,
    offset: Range | float,
    roller_radius: Range | float,
    width: Range | float,
    permitted_stress: float,
    objective: Objective = "size",
    rise: float | None = None,
    return_: float | None = None,
    roller_rule: str = DEFAULT_RULE,
    rotation: Rotation = "ccw",
    contact: RollerContact | None = None,
    friction: float = 0.0,
) -> SizedCam:
    """The best cam for a translating roller follower: the smallest, or that of the minimum stress.

    load : that presses the follower on the cam over the whole turn; SpringLoad(0, 0, 0, preload=F) is a constant force
    prime_radius, base_radius, offset, roller_radius, width : ranges [mm], machine sign; one number fixes a size.
        Of the first two one is given, and made as small as possible; the base radius is the minimum one of the profile,
        less than the prime radius by the roller
    permitted_stress : peak pressure of the line contact [MPa]
    objective : "size", the minimum radius and then the narrowest face, or "stress", with the widest face
    rise, return_ : permitted pressure angles, as magnitudes [rad], at rest too; rise = None is 30 degrees, as of
        :func:`graphcam.minimum_radius`, return_ = None is force closure
    roller_rule : the largest roller that is permitted, by the minimum convex radius of curvature or the prime radius.
        The publication from which the problem comes has 25 degrees and "0.8 rho"
    contact : moduli and Poisson's ratios of cam and roller; its width does not matter.  None is steel on steel
    friction : mu, between cam and follower

    Raises
    ------
    DesignError : the load does not keep contact, a range is empty, or no cam in the ranges satisfies the limits; the
        message then says which of them, and how close the nearest cam comes

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(12, radians(60)), gc.Dwell(radians(60)), gc.Return(12, radians(60)),
    ...     gc.Dwell(radians(180))])
    >>> sized_cam = gc.size_cam(motion, gc.SpringLoad(0, 0, 0, preload=6000), prime_radius=(60, 120), offset=0,
    ...                  roller_radius=(10, 15), width=(10, 20), permitted_stress=1500)
    >>> sized_cam.cam.prime_radius, round(sized_cam.cam.roller_radius, 6), round(sized_cam.width, 3)
    (60.0, 15.0, 10.694)
    >>> sized_cam
    SizedCam
      prime radius 60 mm, offset 0 mm, roller radius 15 mm, face width 10.6935 mm
      pressure angle up to 18.09°, radius of curvature from 38.01 mm, contact stress up to 1500 MPa
      bound by: minimum prime radius, maximum roller radius
    .cam, .radius, .stress, .min_width, .binding, .active
    >>> sized_cam.binding
    ('minimum prime radius', 'maximum roller radius')
    """
    if (prime_radius is None) == (base_radius is None):
        found = say("neither given") if prime_radius is None else say("both given")
        raise DesignError(say("prime_radius and base_radius"), found, say("one of them, as a range in mm"))
    measure: Measure = "base radius" if prime_radius is None else "prime radius"
    usual = math.radians(Translating.usual_limit_deg)
    limits = SizingLimits(
        permitted_stress,
        usual if rise is None else rise,
        return_,
        terms_of(roller_rule),
        contact or RollerContact(1.0),
        friction,
    )
    check_kind("motion", motion, Motion)
    check_kind("load", load, SpringLoad)
    radius = base_radius if prime_radius is None else prime_radius
    assert radius is not None
    problem = SizingProblem(
        motion,
        load,
        limits,
        _range(measure, radius),
        _range("offset", offset),
        _range("roller radius", roller_radius),
        _range("face width", width),
        rotation,
        measure,
    )
    return best_cam(problem, objective)


def _range(name: str, size: Range | float) -> Range:
    """A range as it is given; of a number the one that holds nothing else."""
    if isinstance(size, tuple | list | np.ndarray) and len(size) == 2:
        return float(size[0]), float(size[1])
    check_kind(
        say("range of the {name}", name=name), size, NUMBER_TYPES, say("two lengths in mm, or one that is fixed")
    )
    return float(cast(float, size)), float(cast(float, size))


def best_cam(problem: SizingProblem, objective: Objective) -> SizedCam:
    """The best cam of a problem, as :func:`size_cam` says."""
    if objective not in OBJECTIVES:
        raise DesignError("objective", objective, or_list([repr(each) for each in OBJECTIVES]))
    problem.check_contact()
    found = best_sizes(problem, "radius" if objective == "size" else "width")
    if found is None:
        refuse(problem)
    if objective == "stress":
        return sized_cam(problem, replace(found, width=problem.width[1]))
    sizes = _narrowest(problem, found)
    low, high = problem.width
    return sized_cam(problem, replace(sizes, width=min(max(problem.exact_width(sizes), low), high)))


def pareto_front(problem: SizingProblem, count: int = 11) -> list[SizedCam]:
    """Cams with the widest face none of which is both smaller and under less stress than another, the smallest first.

    Between the smallest cam and that of the minimum stress the radius is limited step by step, and the minimum stress
    is found each time (epsilon constraint: Y. Y. Haimes, L. S. Lasdon, D. A. Wismer, 1971).

    count : of the radii; fewer cams where a larger radius is no gain

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(12, radians(40)), gc.Dwell(radians(60)), gc.Return(12, radians(40)),
    ...     gc.Dwell(radians(220))])
    >>> sized_cam = gc.size_cam(motion, gc.SpringLoad(0, 0, 0, preload=6000), prime_radius=(30, 90), offset=(-20, 20),
    ...                  roller_radius=(8, 15), width=(10, 30), permitted_stress=1500)
    >>> for cam in pareto_front(sized_cam.problem, 3):
    ...     print(round(cam.radius, 2), round(cam.stress))
    39.71 1500
    64.86 1037
    90.0 865
    """
    widest = problem.width[1]
    smallest = replace(best_cam(problem, "size").sizes, width=widest)
    calmest = best_cam(problem, "stress")
    front, low, watched = [sized_cam(problem, smallest)], problem.radius[0], WatchedPlaces(problem)
    for radius in np.linspace(front[0].radius, calmest.radius, count)[1:-1].tolist():
        within = replace(problem, radius=(low, radius))
        found = best_sizes(within, "width", watched, front[-1].sizes)
        # The last cam of the front keeps these limits too.
        front.append(sized_cam(problem, replace(found or front[-1].sizes, width=widest)))
    return _undominated([*front, calmest])


def _undominated(cams: list[SizedCam]) -> list[SizedCam]:
    """The cams that gain stress for their radius."""
    kept: list[SizedCam] = []
    for cam in sorted(cams, key=lambda cam: (cam.radius, cam.stress)):
        if not kept or cam.stress < kept[-1].stress * (1 - DOMINATED_SHARE):
            kept.append(cam)
    return kept


def _narrowest(problem: SizingProblem, smallest: Sizes) -> Sizes:
    """The minimum face width at a radius, by the choice of offset and roller."""
    radius = problem.values(smallest)[0]
    widest = problem.width[1]
    fixed = exchange(replace(problem, radius=(radius, radius)), "width", smallest, WatchedPlaces(problem))
    candidates = [smallest]
    if problem.keeps(found := replace(fixed, width=widest)):
        candidates.append(polished(problem, found))
    # What the second search gains in width must not cost radius.
    permitted = [sizes for sizes in candidates if problem.values(sizes)[0] <= radius * (1 + BINDING_SHARE)]
    return min(permitted, key=problem.exact_width)


def sized_cam(problem: SizingProblem, sizes: Sizes) -> SizedCam:
    """A cam of these sizes with its exact extremes and what binds."""
    stress = problem.stress(sizes)
    extremes = stress.forces.cam.extremes()
    ends: list[str] = []
    for (name, (low, high)), value in zip(problem.ranges.items(), problem.values(sizes), strict=True):
        near = BINDING_SHARE * (high - low)
        if low < high and value <= low + near:
            ends.append(f"minimum {name}")
        if low < high and value >= high - near:
            ends.append(f"maximum {name}")
    angles = [extremes.pressure_angle_rise[0]]
    if problem.limits.return_ is not None:
        angles.append(extremes.pressure_angle_return[0])
    exact = max(map(abs, angles)), extremes.min_convex_radius[0], stress.max_pressure().value
    width, widest = problem.exact_width(sizes), replace(sizes, width=problem.width[1])
    binding, active = ((*_no_room(problem, each), *ends) for each in (widest, sizes))
    return SizedCam(stress.forces.cam, sizes.offset, sizes.width, width, *exact, binding, active, problem)


def _no_room(problem: SizingProblem, sizes: Sizes) -> list[str]:
    """The limits of which a cam leaves nothing."""
    return [name for name, margin in problem.exact_margins(sizes).items() if margin <= BINDING_SHARE]


BORDER_HALVINGS = 20
"""The borders are found by halving the range of the radius so often."""
ROLLER_COUNT = 25
"""Rollers that are tried on every cam."""
PLACE_FACTOR = 3
"""How many times as many places as in the search the region begins with."""
ALL_LIMITS = "all limits"
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


def across_size(problem: SizingProblem) -> Across:
    """The first size that has a range; the offset where all others are given."""
    ranges = problem.offset, problem.roller_radius, problem.width
    names: tuple[Across, Across, Across] = ("offset", "roller radius", "face width")
    for name, (low, high) in zip(names, ranges, strict=True):
        if low < high:
            return name
    return "offset"


def feasible_region(problem: SizingProblem, parts: int = 60) -> FeasibleRegion:
    """The borders of the region at ``parts + 1`` values of the size of :func:`across_size`.

    A larger radius is taken to be better for every limit, as it is wherever the load does not depend on it.
    """
    places, across = TurnPlaces.spread(problem.motion, problem.load, PLACE_FACTOR), across_size(problem)
    values = np.linspace(*problem.ranges[across], parts + 1)
    tried = values[:, None, None]
    low, high = problem.roller_radius
    rollers = np.linspace(low, high, ROLLER_COUNT if low < high else 1)[:, None]
    offset = tried if across == "offset" else problem.offset[0]
    roller = tried if across == "roller radius" else rollers
    width = tried if across == "face width" else problem.width[1]

    def left(radius: Floats) -> dict[str, Floats]:
        """The margin of every limit with the best roller, and of all together."""
        sizes = problem.sizes(radius[:, None, None], offset, roller, width)
        worst = {name: margin.min(axis=-1) for name, margin in problem.margins(places, sizes).items()}
        together = np.minimum.reduce(np.broadcast_arrays(*worst.values()))
        return {name: margin.max(axis=-1) for name, margin in (*worst.items(), (ALL_LIMITS, together))}

    borders = {name: _border(problem, left, name, parts + 1) for name in problem.limits.names}
    return FeasibleRegion(across, values, borders, _border(problem, left, ALL_LIMITS, parts + 1))


def _border(problem: SizingProblem, left: Callable[[Floats], dict[str, Floats]], name: str, count: int) -> Floats:
    """The least radius of the range that keeps a limit, by halving; NaN where none does."""
    low, high = (np.full(count, end, dtype=np.float64) for end in problem.radius)
    none, kept_at_once = left(high)[name] < 0, left(low)[name] >= 0
    for _ in range(BORDER_HALVINGS):
        middle = (low + high) / 2
        kept = left(middle)[name] >= 0
        low, high = np.where(kept, low, middle), np.where(kept, middle, high)
    return np.where(none, np.nan, np.where(kept_at_once, problem.radius[0], high))

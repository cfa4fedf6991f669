"""The smallest cam within given ranges that keeps pressure angle, curvature and contact stress permitted.

The unknowns are prime radius, offset and roller radius, with the widest face that is permitted; the prime radius is
made as small as possible, and at that prime radius the face as narrow as possible.  A limit holds over the whole turn,
so it is a constraint at every place of it.  Constraints at some places are solved by sequential quadratic programming
(scipy); then the exact extremes of that cam say where a limit is exceeded, and these places are added, until none is
(exchange, as in semi-infinite programming: R. Hettich, K. O. Kortanek, *SIAM Review* 35 (1993)).  Last, the prime
radius is moved to where the exact extremes just keep all limits, so that nothing rests on samples.

Source of the problem: Tran Minh Quang, Nguyen Quang Hung (2015).
"""

import math
from dataclasses import astuple, dataclass, field, replace
from typing import NoReturn

import numpy as np

from graphcam.errors import DesignError, Unquoted
from graphcam.given.follower import Rotation, Translating, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.roller_contact import RollerContact
from graphcam.given.spring_load import SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.contact import Contact
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.hertz import ContactStress
from graphcam.mechanism.sizing_limits import Sizes, SizingLimits, TurnPlaces, margins

Range = tuple[float, float]
ROUNDS = 30
"""Exchanges at most; a few are enough."""
KEPT = 1e-10
"""A limit is kept if it is exceeded by less than this part of it while places are exchanged."""
BINDS = 1e-6
"""A limit binds, and a size stands at the end of its range, if they are this part of it apart."""
ROOM = 1e-9
"""By this part of a limit the second search stays within it, so that rounding does not cost prime radius."""
SAME = 1e-13
"""Sizes that differ by less than this part are the same."""
POLISH = 1e-5
"""The last move of the prime radius is smaller than this part of it."""
NAMES = ("prime radius", "offset", "roller radius", "face width")
STARTS = 3
"""From the best so many cams of a coarse grid the search starts."""


@dataclass(frozen=True)
class SizingProblem:
    """What a cam may be, and what it must keep; see :func:`size_cam`."""

    motion: Motion
    load: SpringLoad
    limits: SizingLimits
    prime_radius: Range
    offset: Range
    roller_radius: Range
    face_width: Range
    rotation: Rotation

    def __post_init__(self) -> None:
        sense(self.rotation)
        for name in ("prime_radius", "offset", "roller_radius", "face_width"):
            low, high = getattr(self, name)
            positive = name == "offset" or low > 0
            if not (math.isfinite(low) and math.isfinite(high) and low <= high and positive):
                quantity = f"range of the {name.replace('_', ' ')}"
                raise DesignError(
                    quantity, Unquoted(f"{low:g} to {high:g} mm"), "from a size to one that is not smaller"
                )
        for quantity, most in (("offset", max(map(abs, self.offset))), ("roller radius", self.roller_radius[1])):
            if not most < self.prime_radius[0]:
                limit = f"less than the least prime radius of {self.prime_radius[0]:g} mm"
                raise DesignError(
                    f"range of the {quantity}", Unquoted(f"up to {most:g} mm"), limit, "no such cam could be made"
                )
        least = Contact(self.motion, self.load).least_force()
        if least.value < -BINDS * abs(self.load.preload):
            limit = "0 N or more, so that the follower stays on its cam"
            remedy = "preload the spring: spring_preload(...) tells the least"
            raise DesignError("minimum contact force", Unquoted(f"{least.value:.4g} N"), limit, remedy)

    @property
    def bounds(self) -> list[Range]:
        """The ranges of prime radius, offset and roller radius."""
        return [self.prime_radius, self.offset, self.roller_radius]

    def stress(self, sizes: Sizes) -> ContactStress:
        """The contact stress of the exact cam."""
        cam = Cam(self.motion, Translating(sizes.offset, sizes.roller), sizes.radius, self.rotation)
        return ContactStress(CamForces(cam, self.load), replace(self.limits.contact, width=sizes.width))

    def margins(self, places: TurnPlaces, sizes: Sizes) -> dict[str, Floats]:
        """What is left of every limit at places."""
        return margins(self.limits, places, sizes, sense(self.rotation))

    def exact_margins(self, sizes: Sizes) -> dict[str, float]:
        """What is left of every limit, from the exact extremes."""
        left = self.margins(TurnPlaces.worst(self.stress(sizes)), sizes)
        return {name: float(margin.min()) for name, margin in left.items()}


@dataclass(frozen=True)
class SizedCam:
    """The smallest cam.

    cam : with its prime radius and roller;  offset : of its follower [mm]
    face_width : the least that the stress permits, in its range [mm]
    max_pressure_angle : on the rises and, if it is limited, on the returns, in magnitude [rad]
    min_convex_radius : of the pitch curve [mm];  stress : greatest peak pressure with this face width [MPa]
    binding : what keeps the prime radius from being smaller, limits and ends of ranges
    problem : what was asked
    """

    cam: Cam
    offset: float
    face_width: float
    max_pressure_angle: float
    min_convex_radius: float
    stress: float
    binding: tuple[str, ...]
    problem: SizingProblem = field(repr=False)


def size_cam(
    motion: Motion,
    load: SpringLoad,
    *,
    prime_radius: Range,
    offset: Range,
    roller_radius: Range,
    face_width: Range,
    permitted_stress: float,
    rise: float = math.radians(25),
    return_: float | None = None,
    roller_share: float = 0.8,
    rotation: Rotation = "ccw",
    contact: RollerContact | None = None,
) -> SizedCam:
    """The smallest cam for a translating roller follower: the least prime radius, and then the narrowest face.

    load : that presses the follower on the cam over the whole turn; SpringLoad(0, 0, 0, preload=F) is a constant force
    prime_radius, offset, roller_radius, face_width : ranges [mm], machine sign; two equal ends fix a size
    permitted_stress : peak pressure of the line contact [MPa]
    rise, return_ : permitted pressure angles, as magnitudes [rad], at rest too; None is force closure
    roller_share : the roller may take this share of the least convex radius of curvature
    contact : moduli and Poisson's ratios of cam and roller; its width does not matter.  None is steel on steel

    Raises
    ------
    DesignError : the load does not keep contact, a range is none, or no cam in the ranges keeps the limits; then the
        limit that is exceeded most is named

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(12, radians(60)), gc.Dwell(radians(60)), gc.Return(12, radians(60)),
    ...     gc.Dwell(radians(180))])
    >>> sized = gc.size_cam(motion, gc.SpringLoad(0, 0, 0, preload=6000), prime_radius=(60, 120), offset=(0, 0),
    ...                  roller_radius=(10, 15), face_width=(10, 20), permitted_stress=1500)
    >>> sized.cam.prime_radius, round(sized.cam.roller_radius, 6), round(sized.face_width, 3)
    (60.0, 15.0, 10.694)
    >>> sized.binding
    ('least prime radius', 'greatest roller radius')
    """
    limits = SizingLimits(permitted_stress, rise, return_, roller_share, contact or RollerContact(1.0))
    problem = SizingProblem(motion, load, limits, prime_radius, offset, roller_radius, face_width, rotation)
    smallest = _smallest(problem)
    narrow = _narrowest(problem, smallest)
    return _report(problem, narrow)


# --- the search ------------------------------------------------------------------------------------------------------


def _smallest(problem: SizingProblem) -> Sizes:
    """The least prime radius, with the widest face."""
    places = TurnPlaces.spread(problem.motion, problem.load)
    found = [_exchange(problem, places, start, None) for start in _starts(problem, places)]
    kept = [sizes for sizes in found if min(problem.exact_margins(sizes).values()) >= -BINDS]
    if not kept:
        _refuse(problem, max(found, key=lambda sizes: min(problem.exact_margins(sizes).values())))
    return _polished(problem, min(kept, key=lambda sizes: sizes.radius))


def _narrowest(problem: SizingProblem, smallest: Sizes) -> Sizes:
    """The least face width at that prime radius, by the choice of offset and roller."""
    places = TurnPlaces.spread(problem.motion, problem.load)
    found = _exchange(problem, places, smallest, smallest.radius)
    candidates = [smallest]
    if min(problem.exact_margins(replace(found, width=smallest.width)).values()) >= -BINDS:
        candidates.append(_polished(problem, replace(found, width=smallest.width)))
    widths = [problem.stress(sizes).least_width(problem.limits.stress) for sizes in candidates]
    # What the second search gains in width must not cost prime radius.
    permitted = [sizes.radius <= smallest.radius * (1 + BINDS) for sizes in candidates]
    _, best = min((width, k) for k, width in enumerate(widths) if permitted[k])
    low, high = problem.face_width
    return replace(candidates[best], width=min(max(widths[best], low), high))


def _report(problem: SizingProblem, sizes: Sizes) -> SizedCam:
    """The cam, and what binds: limits with the widest face, and ends of ranges."""
    stress = problem.stress(sizes)
    extremes = stress.forces.cam.extremes()
    left = problem.exact_margins(replace(sizes, width=problem.face_width[1]))
    binding = [name for name, margin in left.items() if margin <= BINDS]
    found, ranges = (sizes.radius, sizes.offset, sizes.roller, sizes.width), (*problem.bounds, problem.face_width)
    for name, value, (low, high) in zip(NAMES, found, ranges, strict=True):
        near = BINDS * (high - low)
        if low < high and value <= low + near:
            binding.append(f"least {name}")
        if low < high and value >= high - near:
            binding.append(f"greatest {name}")
    angles = [extremes.pressure_angle_rise[0]]
    if problem.limits.return_ is not None:
        angles.append(extremes.pressure_angle_return[0])
    exact = max(map(abs, angles)), extremes.min_convex_radius[0], stress.greatest().value
    return SizedCam(stress.forces.cam, sizes.offset, sizes.width, *exact, tuple(binding), problem)


def _refuse(problem: SizingProblem, nearest: Sizes) -> NoReturn:
    """No cam in the ranges keeps the limits: say which is exceeded most by the cam that comes nearest."""
    left = problem.exact_margins(nearest)
    worst = min(left, key=lambda name: left[name])
    has = f"r0 = {nearest.radius:.4g}, e = {nearest.offset:.4g}, roller {nearest.roller:.4g}"
    remedy = f"widen the ranges or permit more; it has {has} and face width {nearest.width:.4g} mm"
    found = f"not found (the nearest one exceeds the limit of the {worst})"
    raise DesignError("smallest cam", Unquoted(found), "within the given ranges", remedy)


def _starts(problem: SizingProblem, places: TurnPlaces) -> list[Sizes]:
    """The smallest cams of a coarse grid that keep the limits, or those that exceed them least."""
    axes = [np.linspace(low, high, n) for (low, high), n in zip(problem.bounds, (13, 9, 7), strict=True)]
    r0, e, roller = (axis.ravel() for axis in np.meshgrid(*axes, indexing="ij"))
    grid = Sizes(r0[:, None], e[:, None], roller[:, None], problem.face_width[1])
    left = problem.margins(places, grid)
    worst = np.min([margin.min(axis=-1) for margin in left.values()], axis=0)
    order = np.lexsort((-worst, np.where(worst >= 0, r0, np.inf)))
    return [Sizes(r0[k], e[k], roller[k], problem.face_width[1]) for k in order[:STARTS]]


def _exchange(problem: SizingProblem, places: TurnPlaces, start: Sizes, radius: float | None) -> Sizes:
    """Solve with constraints at places, and add those where the exact extremes exceed a limit, until none does.

    radius : None to make it as small as possible; else it is kept and the face is made as narrow as possible
    """
    sizes = start
    for _ in range(ROUNDS):
        before, sizes = sizes, _solve(problem, places, sizes, radius)
        worst = TurnPlaces.worst(problem.stress(sizes))
        exceeded = [margin < -KEPT for margin in problem.margins(worst, sizes).values()]
        chosen = np.any(exceeded, axis=0)
        # Where the least prime radius leaves no room at all, the second search comes to rest a little beyond a limit.
        steps = (abs(x - y) for x, y in zip(astuple(before), astuple(sizes), strict=True))
        if not chosen.any() or all(step <= SAME * before.radius for step in steps):
            break
        places = places.joined(worst.where(chosen))
    return sizes


def _solve(problem: SizingProblem, places: TurnPlaces, start: Sizes, radius: float | None) -> Sizes:
    """Sequential quadratic programming with constraints at the places alone."""
    from scipy.optimize import minimize

    widest = problem.face_width[1]
    fixed = (widest, widest) if radius is None else (0.0, widest)
    ranges = [problem.prime_radius if radius is None else (radius, radius), *problem.bounds[1:], fixed]
    low, high = np.array(ranges, dtype=np.float64).T
    free = high > low
    target = 0 if radius is None else 3
    if not free[target]:
        return start
    spare = 0.0 if radius is None else ROOM

    def sizes(t: Floats) -> Sizes:
        """The sizes with the free ones at parts t (n,) of their ranges."""
        x = low.copy()
        x[free] += t * (high - low)[free]
        return Sizes(*map(float, x))

    def left(t: Floats) -> Floats:
        """What is left of every limit at every place, as a part of it; negative where it is not kept."""
        found = problem.margins(places, sizes(t)).values()
        return np.concatenate([margin[np.isfinite(margin)] for margin in found]) - spare

    begin = np.array([start.radius, start.offset, start.roller, start.width])
    t0 = np.clip((begin - low)[free] / (high - low)[free], 0, 1)
    k = int(np.count_nonzero(free[:target]))

    def size(t: Floats) -> float:
        """What is to be least: the prime radius, or where that is given the face width, as a part of its range."""
        return float(t[k])

    bounds, kept, options = [(0, 1)] * t0.size, {"type": "ineq", "fun": left}, {"ftol": 1e-14, "maxiter": 200}
    result = minimize(size, t0, bounds=bounds, constraints=kept, method="SLSQP", options=options)
    return sizes(np.clip(result.x, 0, 1))


def _polished(problem: SizingProblem, sizes: Sizes) -> Sizes:
    """The prime radius moved a little to where the exact extremes just keep all limits."""
    from scipy.optimize import brentq

    def left(radius: float) -> float:
        """What is left of the limit that is kept most narrowly, as a part of it, with a prime radius [mm]."""
        return min(problem.exact_margins(replace(sizes, radius=radius)).values())

    low, high = sizes.radius * (1 - POLISH), sizes.radius * (1 + POLISH)
    low = max(low, float(problem.prime_radius[0]))
    if left(low) >= 0:
        return replace(sizes, radius=low)
    if left(high) < 0:
        return sizes
    radius = float(brentq(left, low, high, xtol=1e-13 * high, rtol=1e-15))  # pyright: ignore[reportArgumentType]
    while left(radius) < 0:  # on the permitted side of the root
        radius = math.nextafter(radius, math.inf)
    return replace(sizes, radius=radius)

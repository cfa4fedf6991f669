"""Handles of an oscillating follower: cam centre and arm in its positions, pivot and arm on the profile."""

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.arm_positions import cam_centre
from graphcam.constructions.views import PROFILE, REGION
from graphcam.drafting.euclid import circle_crossing
from graphcam.drafting.marks import Points
from graphcam.plane_vectors import dot
from graphcam.solving.solution import Solution
from graphcam.studio.handle import (
    MAGNET_REACH,
    Changes,
    Handle,
    HandleAxis,
    HandleState,
    point_on_curve,
    size_handle,
    snapped,
)
from graphcam.studio.handles_profile import scale_of
from graphcam.studio.size_ranges import (
    SizeRange,
    lift_of,
    multiple_above,
    ranges,
    round_up,
    sizes_of,
    step_for,
    third_side,
)
from graphcam.words import say

ARM, DISTANCE, RADIUS = say("Arm length l"), say("Centre distance c"), say("Prime radius r₀")
EDGE_TOLERANCE = 1e-6
"""What lies so little outside of the region [mm of paper] is on its edge."""


@dataclass(frozen=True, eq=False)
class ArmRegionPlaces:
    """The places where the hand may put the cam centre of an arm, and which sizes it has there.

    touches, inwards : the lines that bound the region, (k,) each [mm of paper]
    arm : mm;  mu : mm of the machine to a millimetre of paper;  step : to which sizes are snapped
    roller : the given roller radius, which the prime radius must exceed [mm]
    """

    touches: Points
    inwards: Points
    arm: float
    mu: float
    step: float
    roller: float

    def inside(self, distance: float, radius: float) -> bool:
        """Whether all limits are kept there."""
        centre = cam_centre(self.arm, distance, radius, flat=True) / self.mu
        return bool((dot(self.inwards, centre - self.touches) >= -EDGE_TOLERANCE).all())

    def radii(self, distance: float) -> SizeRange:
        """The prime radii that close a triangle."""
        sides = third_side(self.arm, distance, self.step)
        return sides._replace(least=max(sides.least, multiple_above(self.roller, self.step)))

    def distances(self) -> SizeRange:
        """The centre distances that leave some prime radius."""
        return SizeRange(5 * self.step, round_up(2.5 * self.arm), self.step)

    def sizes(self, to: complex, *, fine: bool) -> tuple[float, float]:
        """The centre distance and the prime radius of a cam centre that is put to a place [mm of paper]."""
        # The cam centre lies below the line of the arm at rest.
        below = complex(to.real, min(to.imag, -EDGE_TOLERANCE))
        distance = self.distances().nearest_step(abs(below) * self.mu, fine=fine)
        wanted, room = abs(below * self.mu + self.arm), self.radii(distance)
        edge = None if fine else self._edge(distance, wanted, room)
        return distance, room.nearest_step(wanted, fine=fine) if edge is None else edge

    def _edge(self, distance: float, wanted: float, room: SizeRange) -> float | None:
        """The prime radius nearest to a wanted one at which the arc about the pivot enters the region, if near."""
        step = self.step / 5
        count = math.ceil(MAGNET_REACH * self.mu / step)
        tried = [round(step * (round(wanted / step) + k), 9) for k in range(-count, count + 1)]
        tried = [radius for radius in tried if room.least <= radius <= room.most]
        inside = [self.inside(distance, radius) for radius in tried]
        # Where one is inside and its neighbour is not, the one inside.
        edges = [tried[k + (not inside[k])] for k in range(len(tried) - 1) if inside[k] != inside[k + 1]]
        return min(edges, key=lambda radius: abs(radius - wanted), default=None)


def places_of(solution: Solution) -> ArmRegionPlaces:
    """What the region of a solution lets the hand do."""
    region = solution.chain["minimum_radius"]
    names = [name.removeprefix("touch of ") for name in region.points if name.startswith("touch of ")]
    touches, inwards = (
        np.concatenate([np.ravel(region.first(f"{what} of {name}")) for name in names]) for what in ("touch", "inward")
    )
    follower, step = sizes_of(solution.task), step_for(lift_of(solution))
    mu = region.readings["prime_radius"].per_mm
    return ArmRegionPlaces(touches, inwards, follower["arm"], mu, step, follower["roller_radius"] or 0.0)


def of_region(solution: Solution, state: HandleState) -> Iterator[Handle]:
    """Cam centre, end of the arm at rest, and a point of the curve of the tips."""
    yield from _cam_centre(solution)
    yield from _arm_at_rest(solution)
    yield point_on_curve(REGION.name, "tips", solution, state)


def _cam_centre(solution: Solution) -> Iterator[Handle]:
    """The handle that sets centre distance and prime radius in one."""
    free, chain = places_of(solution), solution.chain

    def drag(to: complex, fine: bool) -> Changes:
        distance, radius = free.sizes(to, fine=fine)
        return {"follower.distance": distance, "cam.prime_radius": radius}

    distances = third_side(free.arm, chain.prime_radius, free.step)
    axes = (
        HandleAxis("follower.distance", DISTANCE, "mm", chain.place, distances, "x", {"sign": -1}),
        HandleAxis("cam.prime_radius", RADIUS, "mm", chain.prime_radius, free.radii(chain.place), "y", {"sign": -1}),
    )
    at = complex(np.ravel(chain["pressure_angle"].first("centre"))[0])
    outside = not free.inside(chain.place, chain.prime_radius)
    yield Handle(REGION.name, "A", say("Cam centre A"), at, "xy", axes, drag, limit=outside)


def _arm_at_rest(solution: Solution) -> Iterator[Handle]:
    """The end of the arm at rest, which is as far from the pivot as the arm is long."""
    arm, mu = sizes_of(solution.task)["arm"], solution.chain["pressure_angle"].givens.mu_l.per_mm
    extra = {"sign": -1, "first": _fixed_sizes(solution)}
    axis = HandleAxis("follower.arm", ARM, "mm", arm, arms(solution), "x", extra)
    yield size_handle(REGION.name, "B0", ARM, complex(-arm / mu), complex(-1 / mu), axis)


def arms(solution: Solution) -> SizeRange:
    """The lengths of the arm at which the mechanism closes; any where both other sizes are found for it."""
    if _all_open(solution):
        return ranges(solution)["follower.arm"]
    return third_side(solution.chain.place, solution.chain.prime_radius, step_for(lift_of(solution)))


def _all_open(solution: Solution) -> bool:
    """Whether prime radius and centre distance are both left open."""
    return solution.task.prime_radius is None and sizes_of(solution.task)["distance"] is None


def _fixed_sizes(solution: Solution) -> Changes:
    """What must stay as it is while the arm's length changes, unless all is found for it."""
    if _all_open(solution):
        return {}
    return {"follower.distance": solution.chain.place, "cam.prime_radius": solution.chain.prime_radius}


def of_profile(solution: Solution) -> Iterator[Handle]:
    """Pivot and end of the arm at the start of the turn."""
    yield from _pivot(solution)
    yield from _end_of_arm(solution)


def _pivot(solution: Solution) -> Iterator[Handle]:
    chain, mu, arm = solution.chain, scale_of(solution), sizes_of(solution.task)["arm"]
    room = third_side(arm, chain.prime_radius, step_for(lift_of(solution)))
    extra = {"first": {"cam.prime_radius": chain.prime_radius}}
    axis = HandleAxis("follower.distance", DISTANCE, "mm", chain.place, room, "x", extra)
    yield size_handle(PROFILE.name, "c", say("Pivot C"), complex(chain.place / mu), complex(1 / mu), axis)


def _end_of_arm(solution: Solution) -> Iterator[Handle]:
    """The handle on the prime circle: a longer arm reaches farther round it."""
    chain, mu, arm = solution.chain, scale_of(solution), sizes_of(solution.task)["arm"]
    radius, distance = chain.prime_radius, chain.place
    room = third_side(distance, radius, step_for(lift_of(solution)))

    def drag(to: complex, fine: bool) -> Changes:
        """The arm that ends on the prime circle in the direction of the hand."""
        turn = cmath.phase(complex(to.real, max(to.imag, 0.0)))
        length = abs(cmath.rect(radius, turn) - distance)
        return {
            "follower.arm": snapped(length, room, fine=fine),
            "follower.distance": distance,
            "cam.prime_radius": radius,
        }

    at = complex(circle_crossing(np.asarray(0j), radius, np.asarray(distance + 0j), arm, flat=True)) / mu
    axis = HandleAxis("follower.arm", ARM, "mm", arm, room, "x", {"sign": -1})
    yield Handle(PROFILE.name, "l", ARM, at, "along", (axis,), drag, along=1j * at / abs(at))

"""Handles of the combined diagram: the cam centre in the region, the tangents, and a point of the curve."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.axes import pieces_of
from graphcam.constructions.minimum_radius import shown_boundaries
from graphcam.constructions.region import Boundary
from graphcam.constructions.views import COMBINED
from graphcam.drafting.curve import farthest_on_pieces
from graphcam.drafting.euclid import UP
from graphcam.drafting.marks import Points
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.solving.solution import Solution
from graphcam.studio.handle import (
    MAGNET_REACH,
    Changes,
    Handle,
    HandleAxis,
    HandleState,
    in_degrees,
    nearest_station,
    over_stations,
    phi_axis,
    size_handle,
)
from graphcam.studio.size_ranges import SizeRange, lift_of, multiple_above, ranges, round_up, step_for
from graphcam.tasks.task import ANGLE_RANGE
from graphcam.words import say

EDGE_TOLERANCE = 1e-6
"""What lies so little outside of the region [mm of paper] is on its edge."""
CENTRE_NAME = say("Cam centre A")


@dataclass(frozen=True, eq=False)
class CentreOfRegion:
    """The places where the hand may put the cam centre of a translating follower, and which sizes it has there.

    lines : that bound the region;  mu : mm of the machine to a millimetre of paper
    step : to which sizes are snapped;  most : the greatest prime radius;  aside : the greatest offset
    roller : the given roller radius, which the prime radius must exceed
    places : of the region that textbooks take [mm of paper]
    """

    lines: tuple[Boundary, ...]
    mu: float
    step: float
    most: float
    aside: float
    roller: float
    places: tuple[complex, ...]

    def edge(self, offset: float) -> float:
        """The least prime radius at an offset, as the edge of the region has it there; both in mm."""
        x, lowest = -offset / self.mu, 0.0
        for line in self.lines:
            touch, inward = complex(line.touch), complex(line.inward)
            if inward.imag:
                lowest = min(lowest, touch.imag - (x - touch.real) * inward.real / inward.imag)
        return self.mu * abs(complex(x, lowest))

    def inside(self, offset: float, radius: float) -> bool:
        """Whether all limits are kept there."""
        return radius >= self.edge(offset) - EDGE_TOLERANCE * self.mu

    def sizes(self, to: complex, *, fine: bool) -> tuple[float, float]:
        """The offset and the prime radius of a cam centre that is put to a place [mm of paper]."""
        aside = SizeRange(-self.aside, self.aside, self.step)
        place = None if fine else next((each for each in self.places if abs(each - to) <= MAGNET_REACH), None)
        if place is not None and abs(place.real) * self.mu <= self.aside:
            offset = aside._replace(step=self.step / 5).nearest_step(-place.real * self.mu)
            return offset, self._radius(offset, self.edge(offset), rounded_up=True, fine=True)
        offset = aside.nearest_step(-to.real * self.mu, fine=fine)
        radius = self.mu * abs(complex(offset / self.mu, min(to.imag, 0.0)))
        edge = self.edge(offset)
        if not fine and abs(radius - edge) <= MAGNET_REACH * self.mu:
            return offset, self._radius(offset, edge, rounded_up=True, fine=True)
        return offset, self._radius(offset, radius, fine=fine)

    def _radius(self, offset: float, wanted: float, *, fine: bool, rounded_up: bool = False) -> float:
        """A prime radius on a step, larger than the offset and the roller."""
        step = self.step / 5 if fine else self.step
        steps = math.ceil(wanted / step - 1e-9) if rounded_up else round(wanted / step)
        return round(min(max(steps * step, multiple_above(max(abs(offset), self.roller), step)), self.most), 9)


def centre_of_region(solution: Solution) -> CentreOfRegion:
    """What the region of a solution lets the hand do."""
    region, sizes = solution.chain["minimum_radius"], ranges(solution)
    follower, step = solution.task.follower, step_for(lift_of(solution))
    most, radius, offset = sizes["cam.prime_radius"].most, solution.chain.prime_radius, solution.chain.place
    aside = min(max(round_up(lift_of(solution)), abs(offset)), max(most, radius) - step)
    named = (region.acts.get(name) for name in ("nearest", "foot on rise", "central"))
    places = (complex(np.ravel(each.first.shown)[0]) for each in named if each is not None)
    return CentreOfRegion(
        lines=tuple(shown_boundaries(region)),
        mu=region.readings["prime_radius"].per_mm,
        step=step,
        most=max(most, radius),
        aside=aside,
        roller=follower.roller_radius or 0.0,
        places=tuple(place for place in places if np.isfinite(place)),
    )


def cam_centre(solution: Solution) -> Iterator[Handle]:
    """The cam centre of a translating follower: its offset and its prime radius in one."""
    free, chain = centre_of_region(solution), solution.chain
    offset, radius = chain.place, chain.prime_radius

    def drag(to: complex, fine: bool) -> Changes:
        e, r0 = free.sizes(to, fine=fine)
        return {"follower.offset": e, "cam.prime_radius": r0}

    aside = SizeRange(-free.aside, free.aside, free.step)
    radii = SizeRange(multiple_above(max(abs(offset), free.roller), free.step), free.most, free.step)
    axes = (
        HandleAxis("follower.offset", say("Offset e"), "mm", offset, aside, "x", {"sign": -1}),
        HandleAxis("cam.prime_radius", say("Prime radius r₀"), "mm", radius, radii, "y", {"sign": -1}),
    )
    at = complex(chain["pressure_angle"].first("centre"))
    outside = not free.inside(offset, radius)
    yield Handle(COMBINED.name, "A", CENTRE_NAME, at, "xy", axes, drag, limit=outside)


# --- the tangents ----------------------------------------------------------------------------------------------------


def tangents(solution: Solution) -> Iterator[Handle]:
    """The tangents at the permitted angles, each taken as far below zero lift as the curve is high."""
    limits, ends = solution.task.limits, solution.chain["pressure_angle"].first("ends")
    level = -float(ends.imag.max())
    for name, title, permitted in (
        ("rise", say("Tangent of the rise"), limits.pressure_angle_rise),
        ("return", say("Tangent of the return"), limits.pressure_angle_return),
    ):
        if permitted is None:
            continue
        path = f"limits.pressure_angle_{name}"

        def drag(to: complex, fine: bool, name: str = name, path: str = path) -> Changes:
            """The angle at which the tangent comes nearest to the hand."""
            angles = np.arange(ANGLE_RANGE.least, ANGLE_RANGE.most + 0.1, 0.2 if fine else 1.0).round(6)
            met = tangents_meet(solution, name, np.radians(angles), level)
            return {path: float(angles[np.argmin(np.abs(met - to.real))])}

        at = float(tangents_meet(solution, name, np.radians([permitted]), level)[0])
        axis = HandleAxis(path, title, "°", permitted, SizeRange(*ANGLE_RANGE), "x", {"sign": _side(solution, name)})
        yield Handle(COMBINED.name, f"tangent {name}", title, complex(at, level), "x", (axis,), drag)


def _side(solution: Solution, name: str) -> int:
    """The side to which a tangent leans going down: 1 to the right."""
    return sense(solution.task.rotation) * (1 if name == "rise" else -1)


def tangents_meet(solution: Solution, name: str, angles: Floats, level: float) -> Floats:
    """Where tangents at permitted angles [rad] to the curve of rise or return meet a level; (k,) in mm."""
    motion, stations = solution.cam.motion, solution.chain.board.stations
    side, pieces = _side(solution, name), pieces_of(motion, stations, 1 if name == "rise" else -1)
    ends = np.asarray(solution.chain["pressure_angle"].first("ends"))
    along: Points = -side * UP * np.exp(1j * side * angles)
    touch = farthest_on_pieces(np.broadcast_to(ends, (angles.size, ends.size)), pieces, along * -UP)
    return touch.real + (level - touch.imag) * along.real / along.imag


# --- a flat face -----------------------------------------------------------------------------------------------------


def flat_centre(solution: Solution) -> Iterator[Handle]:
    """The cam centre under a flat face: the prime radius below the axis of a."""
    region, chain, sizes = solution.chain["minimum_radius"], solution.chain, ranges(solution)["cam.prime_radius"]
    mu = region.readings["prime_radius"].per_mm
    least = float(region.value("prime_radius"))
    found = math.ceil(5 * least / sizes.step - 1e-9) * sizes.step / 5
    axis = HandleAxis("cam.prime_radius", say("Prime radius r₀"), "mm", chain.prime_radius, sizes, "y", {"sign": -1})
    at, outside = -UP * chain.prime_radius / mu, chain.prime_radius < least - EDGE_TOLERANCE * mu
    yield size_handle(COMBINED.name, "A", CENTRE_NAME, at, -UP / mu, axis, magnets=[round(found, 9)], limit=outside)


def flat_point(solution: Solution, state: HandleState) -> Iterator[Handle]:
    """The point of the curve of s over a at the cam angle."""
    integrated, stations = solution.chain["integration"], solution.chain.board.stations
    times = integrated.readings["a"].per_mm / integrated.readings["s"].per_mm
    after, before = (integrated.first("s") * UP + times * integrated.first(name) for name in ("a", "a_before"))

    def drag(to: complex, fine: bool) -> Changes:
        count = stations.phi.size
        return {"phi": in_degrees(stations.phi[nearest_station([*after, *before], to) % count])}

    place = over_stations(stations, math.radians(state.phi), after, before)
    resting = over_stations(stations, math.radians(state.phi), integrated.first("a"), rests=True) == 0
    at = complex(0.0, place.imag) if resting else place
    yield Handle(COMBINED.name, "D", say("Point of the curve"), at, "xy", (phi_axis(state.phi),), drag)

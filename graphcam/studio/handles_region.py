"""Handles of the region and of what is drawn in it: cam centre, arm, tangents, a point of the curve, velocity plan."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np

from graphcam.constructions import arm_pressure_angle, pressure_angle
from graphcam.constructions.axes import pieces_of
from graphcam.constructions.minimum_radius import shown_boundaries
from graphcam.constructions.pressure_angle import moving_up, shown_station
from graphcam.constructions.views import COMBINED, PLAN, REGION
from graphcam.drafting.curve import farthest_on_pieces
from graphcam.drafting.euclid import UP, circle_crossing
from graphcam.drafting.marks import Points
from graphcam.given.follower import sense
from graphcam.plane_vectors import dot
from graphcam.solving.solution import Solution
from graphcam.studio.handle import (
    MAGNET_REACH,
    Handle,
    HandleAxis,
    axis_of,
    mark_handle,
    over_stations,
    radius_handle,
    station_handle,
    turn_handle,
)
from graphcam.studio.size_ranges import (
    SizeRange,
    has_angles,
    lift_of,
    multiple_above,
    ranges,
    round_up,
    sizes_of,
    step_for,
    third_side,
)
from graphcam.tasks.task import ANGLE_RANGE
from graphcam.words import say

EDGE_TOLERANCE = 1e-6
"""What lies so little outside of the region [mm of paper] is on its edge."""
CENTRE_NAME = say("Cam centre A")


def centre_handle(
    solution: Solution,
    view: str,
    mark: Callable[[float, Any], Any],
    lines: Iterable[tuple[Any, Any]],
    first: HandleAxis,
    firsts: SizeRange,
    radii: Callable[[float], SizeRange],
    places: Sequence[complex] = (),
) -> Handle:
    """The cam centre: the follower's place and the prime radius in one.

    mark : the cam centre for both sizes [mm of paper], also of an array of radii
    lines : that bound the region: where they touch the curve, and inwards [mm of paper]
    first, firsts : the axis of the place, and its range for the hand;  radii : that of the prime radius at a place
    places : that draw the cam centre
    """
    chain, mu = solution.chain, solution.chain["minimum_radius"].readings["prime_radius"].per_mm
    touches, inwards = (np.concatenate([np.ravel(each) for each in of]) for of in zip(*lines, strict=True))

    def inside(place: float, radius: Any) -> Any:
        """Whether all limits are kept there."""
        centre = np.asarray(mark(place, radius))[..., None]
        return (dot(inwards, centre - touches) >= -EDGE_TOLERANCE).all(axis=-1)

    def rooms(known: Sequence[float], wanted: float) -> tuple[SizeRange, Sequence[float]]:
        """The range of the place; if that is known that of the radius, and those near a wanted one just inside."""
        if not known:
            return firsts, ()
        room = radii(known[0])
        step = room.step / 5
        count = math.ceil(MAGNET_REACH * mu / step) + 1
        tried = (step * (round(wanted / step) + np.arange(-count, count + 1))).round(9)
        tried = tried[(room.least <= tried) & (tried <= room.most)]
        kept = inside(known[0], tried)
        # Where one is inside and its neighbour is not, the one inside.
        return room, [float(tried[k + (not kept[k])]) for k in np.flatnonzero(kept[1:] != kept[:-1])]

    axes = [first, axis_of(solution, "cam.prime_radius", "y", radii(chain.place), sign=-1)]
    outside = not inside(chain.place, chain.prime_radius)
    return mark_handle(view, "A", CENTRE_NAME, mark, axes, rooms=rooms, places=places, limit=outside)


def of_combined(solution: Solution, phi: float) -> Iterator[Handle]:
    """Handles of a stem with an offset, or of a flat face; an arm has another drawing."""
    if "offset" in sizes_of(solution.task):
        yield cam_centre(solution)
        yield from tangents(solution)
        yield point_on_curve(COMBINED.name, "ends", solution, phi)
    elif not has_angles(solution.task):
        yield flat_centre(solution)
        yield flat_point(solution, phi)


def cam_centre(solution: Solution) -> Handle:
    """The cam centre of a translating follower, on the line of its offset."""
    region, chain, lift = solution.chain["minimum_radius"], solution.chain, lift_of(solution)
    mu, step = region.readings["prime_radius"].per_mm, step_for(lift)
    most, roller = ranges(solution)["cam.prime_radius"].most, solution.task.follower.roller_radius or 0.0
    widest = min(max(round_up(lift), abs(chain.place)), most - step)

    def mark(e: float, r0: Any) -> Any:
        """The centre below the zero of s."""
        return (-e - 1j * np.sqrt(np.maximum(np.square(r0) - e**2, 0.0))) / mu

    def radii(e: float) -> SizeRange:
        """The prime radii larger than offset and roller."""
        return SizeRange(multiple_above(max(abs(e), roller), step / 5), most, step)

    named = (region.acts.get(name) for name in ("nearest", "foot on rise", "central"))
    places = [complex(np.ravel(each.first.shown)[0]) for each in named if each is not None]
    places = [place for place in places if np.isfinite(place) and abs(place.real) * mu <= widest]
    lines = [(line.touch, line.inward) for line in shown_boundaries(region)]
    aside = SizeRange(-widest, widest, step)
    axis = axis_of(solution, "follower.offset", "x", aside, sign=-1)
    return centre_handle(solution, COMBINED.name, mark, lines, axis, aside, radii, places)


def point_on_curve(view: str, places: str, solution: Solution, phi: float) -> Handle:
    """The handle of the cam angle on the curve of a view.

    places : the name of the ends at the stations, in the construction of the pressure angle
    """
    stations, ends = solution.chain.board.stations, solution.chain["pressure_angle"].first(places)
    at = over_stations(stations, math.radians(phi), ends)
    return turn_handle(view, "D", say("Point D of the curve"), at, phi, ends, stations.phi)


# --- an arm ----------------------------------------------------------------------------------------------------------


def of_positions(solution: Solution, phi: float) -> Iterator[Handle]:
    """Cam centre, end of the arm at rest, and a point of the curve of the tips."""
    if "arm" in sizes_of(solution.task):
        yield arm_centre(solution)
        yield arm_at_rest(solution)
        yield point_on_curve(REGION.name, "tips", solution, phi)


def arm_centre(solution: Solution) -> Handle:
    """The cam centre about the pivot of an arm, at the centre distance."""
    region, follower = solution.chain["minimum_radius"], sizes_of(solution.task)
    arm, step, mu = follower["arm"], step_for(lift_of(solution)), region.readings["prime_radius"].per_mm
    pivot, end = np.asarray(0j), np.asarray(-arm + 0j)

    def radii(distance: float) -> SizeRange:
        """The prime radii that close a triangle, larger than the roller."""
        sides = third_side(arm, distance, step)
        return sides._replace(least=max(sides.least, multiple_above(follower["roller_radius"] or 0.0, step)))

    def mark(c: float, r0: Any) -> Any:
        """The centre below the line of the arm at rest, whose pivot is the origin."""
        return circle_crossing(pivot, c, end, r0, flat=True) / mu

    names = [name.removeprefix("touch of ") for name in region.points if name.startswith("touch of ")]
    lines = [(region.first(f"touch of {name}"), region.first(f"inward of {name}")) for name in names]
    axis = axis_of(solution, "follower.distance", "x", third_side(arm, solution.chain.prime_radius, step), sign=-1)
    firsts = SizeRange(5 * step, round_up(2.5 * arm), step)
    return centre_handle(solution, REGION.name, mark, lines, axis, firsts, radii)


def arm_at_rest(solution: Solution) -> Handle:
    """The end of the arm at rest, which is as far from the pivot as the arm is long."""
    chain, mu = solution.chain, solution.chain["pressure_angle"].givens.mu_l.per_mm
    # What must stay as it is while the arm's length changes, unless all is found for it.
    kept, room = {"follower.distance": chain.place, "cam.prime_radius": chain.prime_radius}, None
    if solution.task.prime_radius is None and sizes_of(solution.task)["distance"] is None:
        kept = {}
    else:
        room = third_side(chain.place, chain.prime_radius, step_for(lift_of(solution)))
    axis = axis_of(solution, "follower.arm", "x", room, sign=-1, first=kept)
    return mark_handle(REGION.name, "B0", axis.name, lambda arm: complex(-arm / mu), [axis])


# --- the tangents ----------------------------------------------------------------------------------------------------


def tangents(solution: Solution) -> Iterator[Handle]:
    """The tangents at the permitted angles, each taken as far below zero lift as the curve is high."""
    limits, ends = solution.task.limits, solution.chain["pressure_angle"].first("ends")
    level = -float(ends.imag.max())
    for name, title, permitted in (
        ("rise", say("Tangent of the rise"), limits.pressure_angle_rise),
        ("return", say("Tangent of the return"), limits.pressure_angle_return),
    ):
        if permitted is not None:
            sign, path = _side(solution, name), f"limits.pressure_angle_{name}"
            axis = axis_of(solution, path, "x", SizeRange(*ANGLE_RANGE), sign=sign)
            mark = partial(tangent_at, solution, name, level)
            yield mark_handle(COMBINED.name, f"tangent {name}", title, mark, [axis])


def _side(solution: Solution, name: str) -> int:
    """The side to which a tangent leans going down: 1 to the right."""
    return sense(solution.task.rotation) * (1 if name == "rise" else -1)


def tangent_at(solution: Solution, name: str, level: float, angle: float) -> complex:
    """Where the tangent at a permitted angle [degrees] to the curve of rise or return meets a level [mm of paper]."""
    motion, stations = solution.cam.motion, solution.chain.board.stations
    side, pieces = _side(solution, name), pieces_of(motion, stations, 1 if name == "rise" else -1)
    ends = np.asarray(solution.chain["pressure_angle"].first("ends"))
    along: Points = np.array([-side * UP * np.exp(1j * side * math.radians(angle))])
    touch: Points = farthest_on_pieces(ends[None], pieces, along * -UP)
    return complex((touch.real + (level - touch.imag) * along.real / along.imag)[0], level)


# --- a flat face -----------------------------------------------------------------------------------------------------


def flat_centre(solution: Solution) -> Handle:
    """The cam centre under a flat face: the prime radius below the axis of a."""
    region = solution.chain["minimum_radius"]
    mu, least = region.readings["prime_radius"].per_mm, float(region.value("prime_radius"))
    return radius_handle(solution, COMBINED.name, "A", CENTRE_NAME, mu, least)


def flat_point(solution: Solution, phi: float) -> Handle:
    """The point of the curve of s over a at the cam angle."""
    integrated, stations = solution.chain["integration"], solution.chain.board.stations
    times = integrated.readings["a"].per_mm / integrated.readings["s"].per_mm
    after, before = (integrated.first("s") * UP + times * integrated.first(name) for name in ("a", "a_before"))
    at = over_stations(stations, math.radians(phi), after, before)
    if over_stations(stations, math.radians(phi), integrated.first("a"), rests=True) == 0:
        at = complex(0.0, at.imag)
    angles, ends = [*stations.phi, *stations.phi], [*after, *before]
    return turn_handle(COMBINED.name, "D", say("Point of the curve"), at, phi, ends, angles)


# --- the velocity plan ------------------------------------------------------------------------------------------------


def station(solution: Solution, phi: float) -> Iterator[Handle]:
    """The end D of the mechanism's triangle, which goes to that of the nearest station with a plan."""
    measured = solution.chain["pressure_angle"]
    shown, possible = shown_station(measured), np.flatnonzero(moving_up(measured))
    places, name = _ends(solution, shown), say("Station of the velocity plan")
    room = SizeRange(float(possible[0]), float(possible[-1]), 1.0)
    axis = HandleAxis("station", name, "", shown, room, "x", {"fine": 1.0, "coarse": 1.0})
    yield station_handle(PLAN.name, "station", name, places[shown].item(), axis, places[possible], possible.tolist())


def _ends(solution: Solution, shown: int) -> Points:
    """The ends D of all stations about the cam centre, at the scale of the plan that is shown [mm of paper]."""
    measured = solution.chain["pressure_angle"]
    if "arm" not in sizes_of(solution.task):
        mu, centre = measured.readings["s0"].per_mm, complex(np.ravel(measured.first("centre"))[0])
        ends = (np.asarray(measured.first("ends")) - centre) * mu
        return ends / pressure_angle.plan_scale(measured, shown, complex(ends[shown])).per_mm
    integrated, givens = measured.givens.integrated, measured.givens
    s, v = (np.asarray(integrated.value(name)) for name in "sv")
    arms = -givens.arm * np.exp(-1j * (float(measured.first("psi0")) + s))
    ends = givens.distance + arms * (1 + sense(givens.rotation) * v)
    return ends / arm_pressure_angle.plan_scale(measured, shown).per_mm

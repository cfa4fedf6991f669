"""Handles of the cam profile: prime circle, offset circle, the rim of the roller, the pitch point."""

import cmath
import math
from collections.abc import Iterator

import numpy as np

from graphcam.constructions.adoption import BLUNT_FACTOR
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import UP
from graphcam.given.follower import sense
from graphcam.solving.solution import Solution
from graphcam.studio.handle import (
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
from graphcam.studio.size_ranges import SizeRange, lift_of, multiple_below, ranges, sizes_of, step_for, third_side
from graphcam.words import say

PRIME_CIRCLE_NAME, OFFSET_CIRCLE_NAME = say("Prime circle"), say("Offset circle")
RIM_NAME, PITCH_POINT_NAME = say("Rim of the roller"), say("Point of the pitch curve")


def scale_of(solution: Solution) -> float:
    """The scale of the profile: mm that go to a millimetre of paper."""
    return solution.chain["inversion"].readings["x"].per_mm


def prime_circle(solution: Solution) -> Iterator[Handle]:
    """The lowest point of the prime circle."""
    mu, radius, room = scale_of(solution), solution.chain.prime_radius, radii(solution)
    adopted = solution.chain.adopted_if_any()
    least = math.nan if adopted is None else adopted.least
    fine = room.step / 5
    found = [] if math.isnan(least) else [round(math.ceil(least / fine - 1e-9) * fine, 9)]

    extra = {"sign": -1, "first": kept_place(solution)}
    axis = HandleAxis("cam.prime_radius", say("Prime radius r₀"), "mm", radius, room, "y", extra)
    at, too_small = -UP * radius / mu, radius < least - fine / 10
    yield size_handle(PROFILE.name, "r0", PRIME_CIRCLE_NAME, at, -UP / mu, axis, magnets=found, limit=too_small)


def radii(solution: Solution) -> SizeRange:
    """The prime radii at which the mechanism closes with the present place of the follower."""
    room, follower = ranges(solution)["cam.prime_radius"], sizes_of(solution.task)
    if "arm" not in follower:
        return room
    closing = third_side(follower["arm"], solution.chain.place, room.step)
    return closing._replace(least=max(closing.least, room.least))


def kept_place(solution: Solution) -> Changes:
    """An arm's centre distance, where it is open: it must go with the radius."""
    open_ = sizes_of(solution.task).get("distance", 0.0) is None
    return {"follower.distance": solution.chain.place} if open_ else {}


def offset_circle(solution: Solution) -> Iterator[Handle]:
    """The handle where the follower's line touches the offset circle at the start of the turn."""
    mu, offset, room = scale_of(solution), solution.chain.place, ranges(solution)["follower.offset"]
    axis = HandleAxis("follower.offset", say("Offset e"), "mm", offset, room, "x")
    yield size_handle(PROFILE.name, "e", OFFSET_CIRCLE_NAME, complex(offset / mu), complex(1 / mu), axis)


def pitch_at(solution: Solution, phi: float) -> complex:
    """The point of the pitch curve at a cam angle [rad]; of a flat face where it is touched."""
    sigma, stations = sense(solution.task.rotation), solution.chain.board.stations
    pitch = np.asarray(solution.chain["inversion"].first("pitch"))
    # In the frame the trace point hardly moves, so it can be sought straight between the stations there.
    in_frame = pitch * np.exp(1j * sigma * stations.phi)
    return over_stations(stations, phi, in_frame) * cmath.exp(-1j * sigma * phi)


def roller_rim(solution: Solution, state: HandleState) -> Iterator[Handle]:
    """The outermost point of the roller where it stands at the cam angle."""
    mu, radius, step = scale_of(solution), solution.chain.roller_radius, step_for(lift_of(solution))
    room = ranges(solution)["follower.roller_radius"]
    centre = pitch_at(solution, math.radians(state.phi))
    out = centre / abs(centre)
    rho = float(solution.chain["curvature"].value("rho"))
    if solution.task.prime_radius is None and math.isfinite(rho):  # a larger roller would find a larger prime radius
        room = room._replace(most=max(room.least, min(room.most, multiple_below(rho / BLUNT_FACTOR, step))))
    sharpest = [round(math.floor(5 * rho / step) * step / 5, 9)] if math.isfinite(rho) else []
    axis = HandleAxis("follower.roller_radius", say("Roller radius r"), "mm", radius, room, "y")
    at, undercut = centre + out * radius / mu, radius >= rho
    yield size_handle(PROFILE.name, "r", RIM_NAME, at, out / mu, axis, magnets=sharpest, limit=undercut)


def pitch_point(solution: Solution, state: HandleState) -> Iterator[Handle]:
    """The point of the pitch curve at the cam angle."""
    stations = solution.chain.board.stations
    pitch = solution.chain["inversion"].first("pitch")

    def drag(to: complex, fine: bool) -> Changes:
        return {"phi": in_degrees(stations.phi[nearest_station(pitch, to)])}

    at = pitch_at(solution, math.radians(state.phi))
    yield Handle(PROFILE.name, "phi", PITCH_POINT_NAME, at, "xy", (phi_axis(state.phi),), drag)

"""Handles of the cam profile: prime circle, offset circle, pivot and arm, the rim of the roller, the pitch point."""

import cmath
import math
from collections.abc import Iterator

import numpy as np

from graphcam.constructions.adoption import BLUNT_FACTOR
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import UP, circle_crossing
from graphcam.given.follower import sense
from graphcam.solving.solution import Solution
from graphcam.studio.handle import (
    Changes,
    Handle,
    HandleState,
    angle_at,
    angle_handle,
    axis_of,
    mark_handle,
    over_stations,
)
from graphcam.studio.size_ranges import SizeRange, lift_of, multiple_below, ranges, sizes_of, step_for, third_side
from graphcam.words import say


def of_profile(solution: Solution, state: HandleState) -> Iterator[Handle]:
    """The handles of a follower's profile: those of the sizes that it has."""
    sizes = sizes_of(solution.task)
    yield prime_circle(solution)
    if "offset" in sizes:
        # Where the follower's line touches the offset circle at the start of the turn.
        mu, axis = scale_of(solution), axis_of(solution, "follower.offset", "x")
        yield mark_handle(PROFILE.name, "e", say("Offset circle"), lambda e: complex(e / mu), [axis])
    if "arm" in sizes:
        yield from pivot_and_arm(solution)
    if "roller_radius" in sizes:
        yield roller_rim(solution, state)
    phi, pitch = solution.chain.board.stations.phi, solution.chain["inversion"].first("pitch")
    at, name = pitch_at(solution, math.radians(state.phi)), say("Point of the pitch curve")
    yield angle_handle(PROFILE.name, "phi", name, at, state, angle_at(phi, pitch))


def scale_of(solution: Solution) -> float:
    """The scale of the profile: mm that go to a millimetre of paper."""
    return solution.chain["inversion"].readings["x"].per_mm


def prime_circle(solution: Solution) -> Handle:
    """The lowest point of the prime circle."""
    mu, room, adopted = scale_of(solution), radii(solution), solution.chain.adopted_if_any()
    least = math.nan if adopted is None else adopted.least
    fine = room.step / 5
    found = [] if math.isnan(least) else [round(math.ceil(least / fine - 1e-9) * fine, 9)]
    axis = axis_of(solution, "cam.prime_radius", "y", room, sign=-1, first=kept_place(solution))
    too_small, name = axis.value < least - fine / 10, say("Prime circle")
    return mark_handle(PROFILE.name, "r0", name, lambda r0: -UP * r0 / mu, [axis], magnets=found, limit=too_small)


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


def pivot_and_arm(solution: Solution) -> Iterator[Handle]:
    """Pivot and end of the arm at the start of the turn: a longer arm reaches farther round the prime circle."""
    chain, mu, arm = solution.chain, scale_of(solution), sizes_of(solution.task)["arm"]
    radius, distance, step = chain.prime_radius, chain.place, step_for(lift_of(solution))
    kept = {"cam.prime_radius": radius}
    axis = axis_of(solution, "follower.distance", "x", third_side(arm, radius, step), first=kept)
    yield mark_handle(PROFILE.name, "c", say("Pivot C"), lambda c: complex(c / mu), [axis])
    kept = {"follower.distance": distance, "cam.prime_radius": radius}
    axis = axis_of(solution, "follower.arm", "x", third_side(distance, radius, step), sign=-1, first=kept)
    centre, pivot = np.asarray(0j), np.asarray(distance + 0j)
    yield mark_handle(
        PROFILE.name, "l", axis.name, lambda arm: circle_crossing(centre, radius, pivot, arm, flat=True) / mu, [axis]
    )


def pitch_at(solution: Solution, phi: float) -> complex:
    """The point of the pitch curve at a cam angle [rad]; of a flat face where it is touched."""
    sigma, stations = sense(solution.task.rotation), solution.chain.board.stations
    pitch = np.asarray(solution.chain["inversion"].first("pitch"))
    # In the frame the trace point hardly moves, so it can be sought straight between the stations there.
    in_frame = pitch * np.exp(1j * sigma * stations.phi)
    return over_stations(stations, phi, in_frame) * cmath.exp(-1j * sigma * phi)


def roller_rim(solution: Solution, state: HandleState) -> Handle:
    """The outermost point of the roller where it stands at the cam angle."""
    mu, radius, step = scale_of(solution), solution.chain.roller_radius, step_for(lift_of(solution))
    room = ranges(solution)["follower.roller_radius"]
    centre = pitch_at(solution, math.radians(state.phi))
    out = centre / abs(centre)
    rho = float(solution.chain["curvature"].value("rho"))
    if solution.task.prime_radius is None and math.isfinite(rho):  # a larger roller would find a larger prime radius
        room = room._replace(most=max(room.least, min(room.most, multiple_below(rho / BLUNT_FACTOR, step))))
    sharpest = [round(math.floor(5 * rho / step) * step / 5, 9)] if math.isfinite(rho) else []
    axis, name = axis_of(solution, "follower.roller_radius", "y", room), say("Rim of the roller")
    undercut = radius >= rho
    return mark_handle(
        PROFILE.name, "r", name, lambda r: centre + out * r / mu, [axis], magnets=sharpest, limit=undercut
    )

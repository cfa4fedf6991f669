"""Handles of the cam itself: prime circle, offset circle, pivot, arm and roller; of three arcs their points."""

import cmath
import math
from collections.abc import Iterator

import numpy as np

from graphcam.constructions.adoption import BLUNT_FACTOR
from graphcam.constructions.arc_outline import ARCS
from graphcam.constructions.arc_profile import ROLLER
from graphcam.constructions.views import ACCELERATION, ANGLE, DISPLACEMENT, PROFILE, VELOCITY
from graphcam.drafting.euclid import circle_crossing
from graphcam.given.follower import sense
from graphcam.solving.arcs_solution import ArcsSolution
from graphcam.solving.solution import Solution
from graphcam.studio.form_fields import POINT_NAMES, coordinate_name, must_agree
from graphcam.studio.handle import Handle, HandleAxis, axis_of, mark_handle, over_stations, radius_handle, turn_handle
from graphcam.studio.handles_diagrams import cursor
from graphcam.studio.size_ranges import (
    ARC_POINTS,
    lift_of,
    multiple_below,
    point_reach,
    ranges,
    sizes_of,
    step_for,
    third_side,
)
from graphcam.words import say


def of_profile(solution: Solution, phi: float) -> Iterator[Handle]:
    """The handles of a follower's profile: those of the sizes that it has."""
    sizes, mu = sizes_of(solution.task), solution.chain["inversion"].readings["x"].per_mm
    yield prime_circle(solution, mu)
    if "offset" in sizes:
        # Where the follower's line touches the offset circle at the start of the turn.
        axis = axis_of(solution, "follower.offset", "x")
        yield mark_handle(PROFILE.name, "e", say("Offset circle"), lambda e: complex(e / mu), [axis])
    if "arm" in sizes:
        yield from pivot_and_arm(solution, mu)
    at = pitch_at(solution, math.radians(phi))
    if "roller_radius" in sizes:
        yield roller_rim(solution, mu, at)
    angles, pitch = solution.chain.board.stations.phi, solution.chain["inversion"].first("pitch")
    yield turn_handle(PROFILE.name, "phi", say("Point of the pitch curve"), at, phi, pitch, angles)


def prime_circle(solution: Solution, mu: float) -> Handle:
    """The lowest point of the prime circle, at radii with which the mechanism closes where the follower stands."""
    chain, sizes, room = solution.chain, sizes_of(solution.task), ranges(solution)["cam.prime_radius"]
    adopted = chain.adopted_if_any()
    if "arm" in sizes:
        closing = third_side(sizes["arm"], chain.place, room.step)
        room = closing._replace(least=max(closing.least, room.least))
    # An arm's centre distance that is open must go with the radius.
    kept = {"follower.distance": chain.place} if sizes.get("distance", 0.0) is None else {}
    least = math.nan if adopted is None else adopted.least
    return radius_handle(solution, PROFILE.name, "r0", say("Prime circle"), mu, least, room, first=kept)


def pivot_and_arm(solution: Solution, mu: float) -> Iterator[Handle]:
    """Pivot and end of the arm at the start of the turn: a longer arm reaches farther round the prime circle."""
    chain, arm = solution.chain, sizes_of(solution.task)["arm"]
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


def roller_rim(solution: Solution, mu: float, centre: complex) -> Handle:
    """The outermost point of the roller where it stands."""
    room, step = ranges(solution)["follower.roller_radius"], step_for(lift_of(solution))
    out = centre / abs(centre)
    rho = float(solution.chain["curvature"].value("rho"))
    if solution.task.prime_radius is None and math.isfinite(rho):  # a larger roller would find a larger prime radius
        room = room._replace(most=max(room.least, min(room.most, multiple_below(rho / BLUNT_FACTOR, step))))
    sharpest = [round(math.floor(5 * rho / step) * step / 5, 9)] if math.isfinite(rho) else []
    axis, name = axis_of(solution, "follower.roller_radius", "y", room), say("Rim of the roller")
    undercut = solution.chain.roller_radius >= rho
    return mark_handle(
        PROFILE.name, "r", name, lambda r: centre + out * r / mu, [axis], magnets=sharpest, limit=undercut
    )


# --- a cam of three arcs ----------------------------------------------------------------------------------------------


def of_arcs(solution: ArcsSolution, view: str, phi: float) -> Iterator[Handle]:
    """The handles of a view of a cam of three arcs."""
    if view in (ACCELERATION.name, VELOCITY.name, DISPLACEMENT.name, ANGLE.name):
        yield from cursor(solution, view, phi)
    elif view == ARCS.name:
        yield from points(solution)
        yield first_arc(solution)
    elif view == ROLLER.name:
        yield from roller(solution, phi)


def points(solution: ArcsSolution) -> Iterator[Handle]:
    """The points, given or found; what must agree with one that is moved is left open with it."""
    mu, room, drawn = solution.chain.board.mu_l.per_mm, point_reach(solution), solution.chain["three_arcs"]
    for name in ARC_POINTS:
        given, place = getattr(solution.task.arcs, name), complex(np.ravel(drawn.first(name))[0]) * mu
        x, y = given or (round(place.real, 6), round(place.imag, 6))
        freed = dict.fromkeys(must_agree(solution.task.arcs, name))
        first = {"first": freed if given is not None else {**freed, f"arcs.{name}": [x, y]}}
        axes = [
            HandleAxis(f"arcs.{name}[{k}]", coordinate_name(name, k), "mm", each, room, "xy"[k], first)
            for k, each in enumerate((x, y))
        ]
        yield mark_handle(ARCS.name, name, POINT_NAMES[name], lambda x, y: (x + 1j * y) / mu, axes)


def first_arc(solution: ArcsSolution) -> Handle:
    """The centre of the first arc: on the line to D, as far from there as its radius."""
    mu, given = solution.chain.board.mu_l.per_mm, solution.task.arcs
    end = complex(*given.D)
    freed = dict.fromkeys(must_agree(given, "rho1"))
    axis = axis_of(solution, "arcs.rho1", "x", sign=-1, first=freed)
    return mark_handle(ARCS.name, "C1", POINT_NAMES["C1"], lambda rho: (end - rho * end / abs(end)) / mu, [axis])


def roller(solution: ArcsSolution, phi: float) -> Iterator[Handle]:
    """The roller on the arcs: where it stands, and its rim where the rise begins, on the base circle."""
    rolled, mu = solution.chain["arc_roller"], solution.chain.board.mu_l.per_mm
    places, angles = np.asarray(rolled.first("B")), np.asarray(rolled.value("phi"))
    at = complex(np.interp(math.radians(phi), angles, places))
    yield turn_handle(ROLLER.name, "phi", say("Position of the roller"), at, phi, places, angles)
    axis = axis_of(solution, "follower.roller_radius", "x")
    out = complex(places[0]) / abs(places[0])
    # It lies a diameter outside of the base circle.
    base = complex(places[0]) - out * axis.value / mu
    yield mark_handle(ROLLER.name, "r", say("Rim of the roller"), lambda r: base + 2 * out * r / mu, [axis])

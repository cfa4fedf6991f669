"""Handles of a cam of three arcs: its points, its first arc, the roller, the cam angle."""

import math
from collections.abc import Iterator

import numpy as np

from graphcam.constructions.arc_outline import ARCS
from graphcam.constructions.arc_profile import ROLLER
from graphcam.constructions.views import ACCELERATION, ANGLE, DISPLACEMENT, VELOCITY
from graphcam.solving.arcs_solution import ArcsSolution
from graphcam.studio.form_fields import POINT_NAMES, must_agree
from graphcam.studio.handle import (
    Changes,
    Handle,
    HandleAxis,
    HandleState,
    in_degrees,
    nearest_station,
    phi_axis,
    size_handle,
    snapped,
)
from graphcam.studio.handles_diagrams import cursor
from graphcam.studio.size_ranges import ARC_POINTS, point_reach, ranges
from graphcam.words import say

RHO_NAME = say("Radius of the first arc ρ₁")


def of_view(solution: ArcsSolution, view: str, state: HandleState) -> Iterator[Handle]:
    """The handles of one of its views."""
    if view in (ACCELERATION.name, VELOCITY.name, DISPLACEMENT.name, ANGLE.name):
        yield from cursor(solution, view, state)
    elif view == ARCS.name:
        yield from points(solution)
        yield from first_arc(solution)
    elif view == ROLLER.name:
        yield from roller(solution, state)


def points(solution: ArcsSolution) -> Iterator[Handle]:
    """The points, given or found; what must agree with one that is moved is left open with it."""
    mu, room, drawn = solution.chain.board.mu_l.per_mm, point_reach(solution), solution.chain["three_arcs"]
    for name in ARC_POINTS:
        given, place = getattr(solution.task.arcs, name), complex(np.ravel(drawn.first(name))[0])
        at = place if given is None else complex(*given) / mu
        across, up = (f"arcs.{name}[{k}]" for k in (0, 1))
        freed = dict.fromkeys(must_agree(solution.task.arcs, name))

        def drag(to: complex, fine: bool, name: str = name, freed: Changes = freed) -> Changes:
            return {f"arcs.{name}": [snapped(x * mu, room, fine=fine) for x in (to.real, to.imag)], **freed}

        value = round(at.real * mu, 6), round(at.imag * mu, 6)
        first = {"first": freed if given is not None else {**freed, f"arcs.{name}": list(value)}}
        title = POINT_NAMES[name]
        axes = tuple(
            HandleAxis(path, say("{point}, {axis}", point=title, axis=screen), "mm", x, room, screen, first)
            for path, screen, x in zip((across, up), "xy", value, strict=True)
        )
        yield Handle(ARCS.name, name, title, at, "xy", axes, drag)


def first_arc(solution: ArcsSolution) -> Iterator[Handle]:
    """The centre of the first arc: on the line to D, as far from there as its radius."""
    mu, room, given = solution.chain.board.mu_l.per_mm, ranges(solution)["arcs.rho1"], solution.task.arcs
    end = complex(*given.D) / mu
    towards = -end / abs(end)
    freed = dict.fromkeys(must_agree(given, "rho1"))
    axis = HandleAxis("arcs.rho1", RHO_NAME, "mm", given.rho1, room, "x", {"first": freed, "sign": -1})
    at = end + towards * given.rho1 / mu
    yield size_handle(ARCS.name, "C1", POINT_NAMES["C1"], at, towards / mu, axis)


def roller(solution: ArcsSolution, state: HandleState) -> Iterator[Handle]:
    """The roller on the arcs: where it stands, and its rim where the rise begins, on the base circle."""
    rolled, mu = solution.chain["arc_roller"], solution.chain.board.mu_l.per_mm
    places, phi = np.asarray(rolled.first("B")), np.asarray(rolled.value("phi"))
    radius, room = solution.task.follower.roller_radius, ranges(solution)["follower.roller_radius"]
    start = complex(places[0])
    out = start / abs(start)

    def drag(to: complex, fine: bool) -> Changes:
        return {"phi": in_degrees(phi[nearest_station(places, to)])}

    at = complex(np.interp(math.radians(state.phi), phi, places))
    yield Handle(ROLLER.name, "phi", say("Position of the roller"), at, "xy", (phi_axis(state.phi),), drag)
    axis = HandleAxis("follower.roller_radius", say("Roller radius r"), "mm", radius, room, "x")
    # It lies a diameter outside of the base circle.
    rim = start + out * radius / mu
    yield size_handle(ROLLER.name, "r", say("Rim of the roller"), rim, 2 * out / mu, axis)

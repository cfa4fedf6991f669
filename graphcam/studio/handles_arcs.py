"""Handles of a cam of three arcs: its points, its first arc, the roller, the cam angle."""

import math
from collections.abc import Iterator

import numpy as np

from graphcam.constructions.arc_outline import ARCS
from graphcam.constructions.arc_profile import ROLLER
from graphcam.constructions.views import ACCELERATION, ANGLE, DISPLACEMENT, VELOCITY
from graphcam.solving.arcs_solution import ArcsSolution
from graphcam.studio.form_fields import POINT_NAMES, must_agree
from graphcam.studio.handle import Handle, HandleAxis, HandleState, angle_at, angle_handle, axis_of, mark_handle
from graphcam.studio.handles_diagrams import cursor
from graphcam.studio.size_ranges import ARC_POINTS, point_reach
from graphcam.words import say


def of_view(solution: ArcsSolution, view: str, state: HandleState) -> Iterator[Handle]:
    """The handles of one of its views."""
    if view in (ACCELERATION.name, VELOCITY.name, DISPLACEMENT.name, ANGLE.name):
        yield from cursor(solution, view, state)
    elif view == ARCS.name:
        yield from points(solution)
        yield first_arc(solution)
    elif view == ROLLER.name:
        yield from roller(solution, state)


def points(solution: ArcsSolution) -> Iterator[Handle]:
    """The points, given or found; what must agree with one that is moved is left open with it."""
    mu, room, drawn = solution.chain.board.mu_l.per_mm, point_reach(solution), solution.chain["three_arcs"]
    for name in ARC_POINTS:
        given, place = getattr(solution.task.arcs, name), complex(np.ravel(drawn.first(name))[0]) * mu
        x, y = given or (round(place.real, 6), round(place.imag, 6))
        freed = dict.fromkeys(must_agree(solution.task.arcs, name))
        first = {"first": freed if given is not None else {**freed, f"arcs.{name}": [x, y]}}
        title = POINT_NAMES[name]
        axes = [
            HandleAxis(
                f"arcs.{name}[{k}]", say("{point}, {axis}", point=title, axis="xy"[k]), "mm", each, room, "xy"[k], first
            )
            for k, each in enumerate((x, y))
        ]
        yield mark_handle(ARCS.name, name, title, lambda x, y: (x + 1j * y) / mu, axes)


def first_arc(solution: ArcsSolution) -> Handle:
    """The centre of the first arc: on the line to D, as far from there as its radius."""
    mu, given = solution.chain.board.mu_l.per_mm, solution.task.arcs
    end = complex(*given.D)
    freed = dict.fromkeys(must_agree(given, "rho1"))
    axis = axis_of(solution, "arcs.rho1", "x", sign=-1, first=freed)
    return mark_handle(ARCS.name, "C1", POINT_NAMES["C1"], lambda rho: (end - rho * end / abs(end)) / mu, [axis])


def roller(solution: ArcsSolution, state: HandleState) -> Iterator[Handle]:
    """The roller on the arcs: where it stands, and its rim where the rise begins, on the base circle."""
    rolled, mu = solution.chain["arc_roller"], solution.chain.board.mu_l.per_mm
    places, phi = np.asarray(rolled.first("B")), np.asarray(rolled.value("phi"))
    at = complex(np.interp(math.radians(state.phi), phi, places))
    yield angle_handle(ROLLER.name, "phi", say("Position of the roller"), at, state, angle_at(phi, places))
    axis = axis_of(solution, "follower.roller_radius", "x")
    out = complex(places[0]) / abs(places[0])
    # It lies a diameter outside of the base circle.
    base = complex(places[0]) - out * axis.value / mu
    yield mark_handle(ROLLER.name, "r", say("Rim of the roller"), lambda r: base + 2 * out * r / mu, [axis])

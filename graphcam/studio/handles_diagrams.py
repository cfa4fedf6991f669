"""Handles of the diagrams over the cam angle: borders of phases, ordinate, poles, permitted angles, cam angle."""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from graphcam.constructions.axes import phase_ends, phase_title
from graphcam.constructions.views import ACCELERATION, ANGLE, DISPLACEMENT, VELOCITY
from graphcam.drafting.euclid import UP
from graphcam.solving.arcs_solution import ArcsSolution
from graphcam.solving.solution import Solution
from graphcam.studio.handle import (
    Changes,
    Handle,
    HandleAxis,
    HandleState,
    over_stations,
    phi_axis,
    size_handle,
    snapped,
)
from graphcam.studio.size_ranges import MIN_PHASE_ANGLE, SizeRange, lift_size, ranges
from graphcam.words import Caption, say

MAGNET_STEP = 5.0
"""Round phase angles [degrees] draw a border ..."""
MAGNET_REACH = 1.0
"""The distance [degrees] within which a magnet draws a border."""
READING_NAMES = {ACCELERATION.name: "a", VELOCITY.name: "v", DISPLACEMENT.name: "s"}
"""The readings over the cam angle by the names of their views."""


def borders(solution: Solution, view: str) -> Iterator[Handle]:
    """Handles where one phase ends and the next begins: what one gains the other loses."""
    phases = solution.task.motion.phases
    if phases is None:
        return
    ends = phase_ends(solution.cam.motion, solution.chain.board.mu_phi).tolist()
    degrees = math.degrees(solution.chain.board.mu_phi.per_mm)
    for k, (first, second) in enumerate(pairwise(phases)):
        paths = tuple(f"motion.phases[{n}].angle" for n in (k, k + 1))
        total, start = first.angle + second.angle, ends[k] * degrees

        def drag(to: complex, fine: bool, start: float = start, total: float = total, paths: tuple[str, ...] = paths):
            angle = border_angle(to.real * degrees, start, total, fine=fine)
            return {paths[0]: angle, paths[1]: round(total - angle, 9)}

        room = SizeRange(MIN_PHASE_ANGLE, total - MIN_PHASE_ANGLE, 1.0)
        title = say("Angle of the {phase}", phase=phase_title(solution.cam.motion, k))
        axis = HandleAxis(paths[0], title, "°", first.angle, room, "x", {"sum": {"path": paths[1], "total": total}})
        name = say("End of the {phase}", phase=phase_title(solution.cam.motion, k))
        yield Handle(view, f"border {k + 1}", name, complex(ends[k + 1]), "x", (axis,), drag)


def border_angle(phi: float, start: float, total: float, *, fine: bool = False) -> float:
    """The angle of a phase [degrees] that ends where the hand is: whole degrees, and rather a multiple of five.

    phi : where the hand is;  start : where the phase begins;  total : its angle and that of the next one together

    >>> border_angle(84.3, 0.0, 125.0), border_angle(82.7, 0.0, 125.0), border_angle(300.0, 0.0, 125.0)
    (85.0, 83.0, 124.0)
    """
    room = SizeRange(MIN_PHASE_ANGLE, total - MIN_PHASE_ANGLE, 1.0)
    magnet = MAGNET_STEP * round((phi - start) / MAGNET_STEP)
    return snapped(phi - start, room, fine=fine, magnets=[magnet], reach=MAGNET_REACH)


def ordinate(solution: Solution) -> Iterator[Handle]:
    """The greatest ordinate of the first rise, which makes the scale of the acceleration."""
    chain, span = solution.chain, solution.chain.spans[_first_rise(solution)]
    heights = np.abs(chain["acceleration"].first("stations")[span])
    at = float(chain["acceleration"].first("axis")[span][int(np.argmax(heights))].real)
    room, height = ranges(solution)["drawing.ordinate"], chain.board.ordinate
    axis = HandleAxis("drawing.ordinate", say("Maximum ordinate of the first rise"), "mm", height, room, "y")
    yield size_handle(ACCELERATION.name, "ordinate", axis.name, complex(at, height), UP, axis)


def lift(solution: Solution) -> Iterator[Handle]:
    """The height of the first rise, at its end; the other lifts go with it."""
    if (size := lift_size(solution.task)) is None:
        return
    drawn, k = solution.chain["integration"], solution.chain.spans[_first_rise(solution)].stop - 1
    at = complex(float(solution.chain["acceleration"].first("axis")[k].real), float(drawn.first("s")[k]))
    start = drawn.first("s")[solution.chain.spans[_first_rise(solution)].start]
    unit = "°" if solution.task.follower.column == "s_deg" else "mm"
    axis = HandleAxis(size.path, say("Lift h"), unit, size.value, size.range, "y", {"with": size.shares})
    yield size_handle(DISPLACEMENT.name, "lift", axis.name, at, UP * (at.imag - start) / size.value, axis)


def _first_rise(solution: Solution) -> int:
    """The number of the first rise among the moving phases."""
    moving = [phase.direction for phase in solution.cam.motion.phases if phase.direction]
    return moving.index(1)


def pole(solution: Solution, view: str) -> Iterator[Handle]:
    """The pole of the integration that starts in a view."""
    k = (ACCELERATION.name, VELOCITY.name).index(view)
    poles, given = solution.chain.board.poles, solution.task.drawing.poles
    path, room = f"drawing.poles[{k}]", ranges(solution)[f"drawing.poles[{k}]"]
    first = {} if given is not None else {"drawing.poles": list(poles)}
    name = say("Pole distance H₁") if k == 0 else say("Pole distance H₂")
    axis = HandleAxis(path, name, "mm", poles[k], room, "x", {"sign": -1, "first": first})
    yield size_handle(view, f"P{k + 1}", name, complex(-poles[k]), -1 + 0j, axis)


def limits(solution: Solution) -> Iterator[Handle]:
    """The permitted pressure angles, where the rise and the return begin."""
    task, chain = solution.task.limits, solution.chain
    mu, readings = math.degrees(chain.board.mu_phi.per_mm), chain["angle_diagram"].readings
    per_mm = math.degrees(readings["max_rise"].per_mm)
    motion = solution.cam.motion
    for way, name, given, side in (
        ("rise", say("Permitted pressure angle, rise"), task.pressure_angle_rise, 1),
        ("return", say("Permitted pressure angle, return"), task.pressure_angle_return, -1),
    ):
        if given is None:
            continue
        path = f"limits.pressure_angle_{way}"
        k = [phase.kind for phase in motion.phases].index(way)
        at = complex(math.degrees(motion.starts[k]) / mu, side * given / per_mm)
        reached = abs(math.degrees(float(chain["angle_diagram"].value(f"max_{way}"))))
        axis = HandleAxis(path, name, "°", given, ranges(solution)[path], "y", {"sign": side})
        is_over = reached > given + 0.005
        yield size_handle(ANGLE.name, f"limit {way}", name, at, side * UP / per_mm, axis, limit=is_over)


CURSOR_NAME: Caption = say("Cam angle φ")


def cursor(solution: Solution | ArcsSolution, view: str, state: HandleState) -> Iterator[Handle]:
    """The cam angle, on the curve."""
    degrees = math.degrees(solution.chain.board.mu_phi.per_mm)
    height = curve_height(solution, view, math.radians(state.phi))

    def drag(to: complex, fine: bool) -> Changes:
        return {"phi": snapped(to.real * degrees, phi_axis(0.0).range, fine=fine)}

    yield Handle(view, "phi", CURSOR_NAME, complex(state.phi / degrees, height), "x", (phi_axis(state.phi),), drag)


def curve_height(solution: Solution | ArcsSolution, view: str, phi: float) -> float:
    """The height [mm of paper] of a curve over the axis at a cam angle [rad], from its stations."""
    if isinstance(solution, ArcsSolution):
        drawn = solution.chain["arc_diagrams"].first(READING_NAMES.get(view, "alpha"))
        # Only the rise is drawn.
        return float(np.interp(phi / solution.chain.board.mu_phi.per_mm, drawn.real, drawn.imag))
    stations = solution.chain.board.stations
    if view == ANGLE.name:
        return over_stations(stations, phi, solution.chain["angle_diagram"].first("curve")).imag
    integrated = solution.chain["integration"]
    name = READING_NAMES[view]
    before = integrated.first("a_before") if name == "a" else None
    return over_stations(stations, phi, integrated.first(name), before, rests=name != "s").real

"""Handles of the diagrams over the cam angle: borders of phases, ordinate, poles, points of the motion, cam angle."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from pathlib import PurePath

import numpy as np

from graphcam.constructions.axes import phase_ends, phase_title
from graphcam.constructions.views import ACCELERATION, ANGLE, DISPLACEMENT, VELOCITY
from graphcam.drafting.euclid import UP
from graphcam.solving.arcs_solution import ArcsSolution
from graphcam.solving.solution import Solution
from graphcam.studio.form_fields import lift_unit
from graphcam.studio.handle import Handle, HandleAxis, axis_of, mark_handle, over_stations, phi_axis
from graphcam.studio.size_ranges import MIN_PHASE_ANGLE, SizeRange, lift_size, round_up, step_for
from graphcam.words import say

MAGNET_STEP = 5.0
"""Round phase angles [degrees] draw a border ..."""
MAGNET_REACH = 1.0
"""The distance [degrees] within which a magnet draws a border."""
READING_NAMES = {ACCELERATION.name: "a", VELOCITY.name: "v", DISPLACEMENT.name: "s"}
"""The readings over the cam angle by the names of their views."""
ROWS_BETWEEN = 12
"""The rows of a table between two that can be dragged, as a part of all of them."""
EDITED = "-edited"
"""The file of an edited table is called so."""


def of_diagram(solution: Solution, view: str, phi: float) -> Iterator[Handle]:
    """The handles of acceleration, velocity or displacement."""
    yield from borders(solution, view)
    if view == DISPLACEMENT.name:
        yield from lift(solution)
        yield from conditions(solution)
        yield from rows(solution)
    else:
        yield from poles_and_ordinate(solution, view)
    yield from cursor(solution, view, phi)


def of_angles(solution: Solution, phi: float) -> Iterator[Handle]:
    """The handles of the diagram of the pressure angle."""
    yield from limits(solution)
    yield from cursor(solution, ANGLE.name, phi)


def _degrees(solution: Solution | ArcsSolution) -> float:
    """The degrees of the cam to a millimetre of paper."""
    return math.degrees(solution.chain.board.mu_phi.per_mm)


def borders(solution: Solution, view: str) -> Iterator[Handle]:
    """Handles where one phase ends and the next begins: what one gains the other loses.

    A border goes in whole degrees, and is drawn to where its phase has a multiple of five.
    """
    ends = phase_ends(solution.cam.motion, solution.chain.board.mu_phi).tolist()
    degrees = _degrees(solution)
    for k, (first, second) in enumerate(pairwise(solution.task.motion.phases or ())):
        path, other = (f"motion.phases[{n}].angle" for n in (k, k + 1))
        total, title = first.angle + second.angle, phase_title(solution.cam.motion, k)
        room, name = SizeRange(MIN_PHASE_ANGLE, total - MIN_PHASE_ANGLE, 1.0), say("Angle of the {phase}", phase=title)
        axis = HandleAxis(path, name, "°", first.angle, room, "x", {"sum": {"path": other, "total": total}})
        yield mark_handle(
            view,
            f"border {k + 1}",
            say("End of the {phase}", phase=title),
            lambda angle, start=ends[k]: complex(start + angle / degrees),
            [axis],
            magnets=np.arange(MAGNET_STEP, total, MAGNET_STEP).tolist(),
            reach=MAGNET_REACH / degrees,
        )


def lift(solution: Solution) -> Iterator[Handle]:
    """The height of the first rise, at its end; the other lifts go with it."""
    if (size := lift_size(solution.task)) is None:
        return
    span, s = solution.chain.spans[_first_rise(solution)], solution.chain["integration"].first("s")
    x, start = float(solution.chain["acceleration"].first("axis")[span.stop - 1].real), float(s[span.start])
    per_size = (float(s[span.stop - 1]) - start) / size.value
    unit = lift_unit(solution.task.follower.column)
    axis = HandleAxis(size.path, say("Lift h"), unit, size.value, size.range, "y", {"with": size.shares})
    yield mark_handle(DISPLACEMENT.name, "lift", axis.name, lambda h: x + UP * (start + h * per_size), [axis])


def _first_rise(solution: Solution) -> int:
    """The number of the first rise among the moving phases."""
    moving = [phase.direction for phase in solution.cam.motion.phases if phase.direction]
    return moving.index(1)


def poles_and_ordinate(solution: Solution, view: str) -> Iterator[Handle]:
    """The pole of the integration that starts in a view, and the greatest ordinate, which makes the scale of a."""
    chain, drawn = solution.chain, solution.chain["acceleration"]
    if view == ACCELERATION.name:
        span = chain.spans[_first_rise(solution)]
        k = int(np.argmax(np.abs(drawn.first("stations")[span])))
        x, axis = float(drawn.first("axis")[span][k].real), axis_of(solution, "drawing.ordinate", "y")
        yield mark_handle(view, "ordinate", axis.name, lambda height: x + UP * height, [axis])
    k = (ACCELERATION.name, VELOCITY.name).index(view)
    first = {} if solution.task.drawing.poles is not None else {"drawing.poles": list(chain.board.poles)}
    axis = axis_of(solution, f"drawing.poles[{k}]", "x", sign=-1, first=first)
    yield mark_handle(view, f"P{k + 1}", axis.name, lambda pole: complex(-pole), [axis])


def limits(solution: Solution) -> Iterator[Handle]:
    """The permitted pressure angles, where the rise and the return begin."""
    angles, motion = solution.chain["angle_diagram"], solution.cam.motion
    per_mm = math.degrees(angles.readings["max_rise"].per_mm)
    for way, side in (("rise", 1), ("return", -1)):
        path = f"limits.pressure_angle_{way}"
        if getattr(solution.task.limits, path.partition(".")[2]) is None:
            continue
        axis = axis_of(solution, path, "y", sign=side)
        x = math.degrees(motion.starts[[phase.kind for phase in motion.phases].index(way)]) / _degrees(solution)
        is_over = abs(math.degrees(float(angles.value(f"max_{way}")))) > axis.value + 0.005
        start, up = complex(x), side * UP / per_mm
        yield mark_handle(
            ANGLE.name,
            f"limit {way}",
            axis.name,
            lambda angle, start=start, up=up: start + up * angle,
            [axis],
            limit=is_over,
        )


def cursor(solution: Solution | ArcsSolution, view: str, phi: float) -> Iterator[Handle]:
    """The cam angle, on the curve."""
    degrees, height = _degrees(solution), curve_height(solution, view, math.radians(phi))
    axis = phi_axis(phi)
    yield mark_handle(view, "phi", axis.name, lambda angle: complex(angle / degrees, height), [axis])


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


# --- points through which a motion goes ------------------------------------------------------------------------------


def _places(solution: Solution, lifts: Sequence[float]) -> Callable[[float, float], complex]:
    """Where a cam angle [degrees] and a displacement are in the diagram, whose axis is at the least one."""
    degrees, axis = _degrees(solution), min(lifts)
    scale = solution.chain["integration"].readings["s"].per_mm / solution.task.motion.lift_unit
    return lambda angle, lift: complex(angle / degrees, (lift - axis) / scale)


def _lifts(values: Sequence[float]) -> SizeRange:
    step = step_for(max(values) - min(values) or 1.0)
    return SizeRange(min(0.0, *values), round_up(1.6 * max(*map(abs, values), step)), step)


def conditions(solution: Solution) -> Iterator[Handle]:
    """The points of a motion by conditions with a displacement: of those within a part the cam angle is moved too.

    Where a part begins at the height at which the one before it has ended, both go together.
    """
    parts = solution.task.motion.parts or ()
    unit = lift_unit(solution.task.follower.column)
    given = [point.s for part in parts for point in part.points if point.s is not None]
    if not given:
        return
    place, lifts = _places(solution, given), _lifts(given)
    for k, part in enumerate(parts):
        after = (k + 1) % len(parts)
        for j, point in enumerate(part.points):
            # The height from which the follower sets out is that of all others.
            if not point.s:
                continue
            path, axes, extra = f"motion.parts[{k}].points[{j}]", list[HandleAxis](), {}
            if 0 < j < len(part.points) - 1:
                room = SizeRange(part.points[j - 1].angle + 1.0, part.points[j + 1].angle - 1.0, 1.0)
                axes.append(HandleAxis(f"{path}.angle", say("Cam angle φ"), "°", point.angle, room, "x"))
            elif j and parts[after].points[0].s == point.s:
                extra = {"with": {f"motion.parts[{after}].points[0].s": 1.0}}
            elif not j:
                continue
            rising = HandleAxis(f"{path}.s", say("Displacement s"), unit, point.s, lifts, "y", extra)
            mark = place if axes else partial(place, point.angle)
            name = say("Point of the motion at {angle:g}°", angle=point.angle)
            yield mark_handle(DISPLACEMENT.name, f"point {k}.{j}", name, mark, [*axes, rising])


def rows(solution: Solution) -> Iterator[Handle]:
    """Some rows of a measured displacement: those beside a dragged one follow it, less and less.

    The table is called edited from then on.
    """
    table = solution.task.motion.table
    if table is None or table.column not in ("s_mm", "s_deg") or solution.task.motion.symmetric:
        return
    given, apart = table.rows, max(1, len(table.rows) // ROWS_BETWEEN)
    reach = 3 * apart // 2
    heights, file = [s for _, s in given], PurePath(table.file)
    place, lifts = _places(solution, heights), _lifts(heights)
    edited = table.file if file.stem.endswith(EDITED) else f"{file.stem}{EDITED}{file.suffix}"
    cam_degree = 1.0 / (solution.task.motion.per_cam_degree or 1.0)
    for k in range(apart, len(given) - apart, apart):
        beside = range(max(k - reach, 0), min(k + reach + 1, len(given)))
        # What rests is left as it is.
        if len({given[j][1] for j in beside}) == 1:
            continue
        angle, start = given[k]
        # A wave is added whose ends are level and without acceleration.
        shares = {j: round(((1.0 + math.cos(math.pi * (j - k) / reach)) / 2.0) ** 2, 3) for j in beside if j != k}
        extra = {
            "first": {"motion.table.file": edited},
            "with": {f"motion.table.rows[{j}][1]": share for j, share in shares.items()},
            "beyond": {f"motion.table.rows[{j}][1]": round(given[j][1] - start * shares[j], 4) for j in shares},
        }
        axis = HandleAxis(
            f"motion.table.rows[{k}][1]", say("Displacement s"), lift_unit(table.column), start, lifts, "y", extra
        )
        name, mark = say("Row of the table at {angle:g}°", angle=angle), partial(place, angle * cam_degree)
        yield mark_handle(DISPLACEMENT.name, f"point {k}", name, mark, [axis])

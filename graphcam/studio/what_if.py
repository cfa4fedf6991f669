"""What if one size were another: the curves of a sweep of designs, from the exact side alone."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from graphcam.constructions.axes import phase_title
from graphcam.drafting.units import UNITS
from graphcam.errors import DesignError, GraphcamError
from graphcam.given.measured import MeasuredMotion
from graphcam.language import language
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solution import Solution
from graphcam.studio.exact_design import CURVES, Design, exact_design
from graphcam.studio.form_fields import DRAWING, NUMBERS, POINTS, must_agree
from graphcam.studio.held_board import solved
from graphcam.studio.request import number, some, task_data, task_in, whole
from graphcam.studio.size_ranges import LEAST_ANGLE, SizeRange, has_angles, ranges, round_up, step_for
from graphcam.studio.task_paths import changed, value_at
from graphcam.words import Caption, Tell, say

DESIGNS, MOST_DESIGNS = 200, 400
MOST_MEASURED = 60
"""The maximum number of designs of a measured motion, whose extremes take ten times as long."""
UNMOVED = "motion.tolerance", "speed_rpm", *(path for path in NUMBERS if path.startswith(("spring.", "material.")))
"""Sizes that change none of the curves, or too slowly."""
LARGEST = 1e6
TIMES = 2.5
"""How many times shorter and longer a phase is looked at: of much less angle every cam is huge."""
NEARBY = 0.15
"""A point of the arcs is moved by so much of the outer circle's radius: few places make a sound cam."""


def sweep_answer(data: Mapping[str, Any]) -> dict[str, Any]:
    """The answer to "sweep": quantities of as many designs as are asked for, over one size.

    data : ``task``, ``path``, ``from`` and ``to`` (left out, the range of the size), ``count``, ``quantities``

    Raises
    ------
    GraphcamError : the task has no solution, or no such size

    >>> import graphcam as gc
    >>> task = gc.builtin_task().to_dict()
    >>> found = sweep_answer({"task": task, "path": "follower.offset", "from": -10.0, "to": 0.0, "count": 3})
    >>> found["at"], [round(r0, 2) for r0 in found["curves"][0]["values"]]
    ([-10.0, -5.0, 0.0], [43.28, 51.01, 59.43])
    """
    task, spoken = task_data(data), language(some(data, "language", str, "en"))
    solution = solved(task, spoken.name)
    sizes = swept_sizes(solution)
    path = some(data, "path", str, next(iter(sizes)))
    if path not in sizes:
        raise DesignError("path", path, say("a size of the task that can be swept"))
    at = _places(data, sizes[path][1], solution)
    designs = [_design(changed(task, with_size(solution, path, value))) for value in at]
    wanted = some(data, "quantities", list, list(CURVES))
    return {
        "path": path,
        "now": _now(solution, path),
        "at": at,
        "curves": _curves(designs, wanted, spoken.text),
        "limits": _limits(solution),
        "sizes": [
            {"path": each, "name": spoken.text(name), "unit": unit, **room.plain()}
            for each, (name, room, unit) in sizes.items()
        ],
    }


def _places(data: Mapping[str, Any], room: SizeRange, solution: AnySolution) -> list[float]:
    """The values of the size."""
    first = number(data, "from", room.least, -LARGEST, LARGEST)
    last = number(data, "to", room.most, -LARGEST, LARGEST)
    count = whole(data, "count", DESIGNS, 2, MOST_DESIGNS) or DESIGNS
    if isinstance(solution, Solution) and isinstance(solution.cam.motion, MeasuredMotion):
        count = min(count, MOST_MEASURED)
    return [round(value, 9) for value in np.linspace(first, last, count).tolist()]


def swept_sizes(solution: AnySolution) -> dict[str, tuple[Caption, SizeRange, str]]:
    """The sizes that can be swept, by their paths: name, range and unit."""
    found = ranges(solution)
    sizes = {
        path: (name, found[path], unit)
        for path, (group, name, unit) in NUMBERS.items()
        if path in found and path not in UNMOVED and group is not DRAWING
    }
    return sizes | (_of_points(solution) if isinstance(solution, ArcsSolution) else _of_phases(solution))


def _of_points(solution: ArcsSolution) -> dict[str, tuple[Caption, SizeRange, str]]:
    """The coordinates of the points that are given; C1 goes with the radius of its arc."""
    arcs, found = solution.task.arcs, ranges(solution)
    nearby = NEARBY * math.hypot(*arcs.D)
    sizes: dict[str, tuple[Caption, SizeRange, str]] = {}
    for name, title in POINTS.items():
        given = None if name == "C1" else getattr(arcs, name)
        for k, (axis, value) in enumerate(zip("xy", given or (), strict=bool(given))):
            path = f"arcs.{name}[{k}]"
            room = found[path]._replace(least=round(value - nearby, 1), most=round(value + nearby, 1))
            sizes[path] = say("{point}, {axis}", point=title, axis=axis), room, "mm"
    return sizes


def _of_phases(solution: Solution) -> dict[str, tuple[Caption, SizeRange, str]]:
    """The angles of the phases, each at the cost of the next one, and the lift of all together."""
    phases, motion = solution.task.motion.phases, solution.cam.motion
    if phases is None:
        return {}
    sizes: dict[str, tuple[Caption, SizeRange, str]] = {}
    for k, phase in enumerate(phases):
        room = phase.angle + phases[(k + 1) % len(phases)].angle - LEAST_ANGLE
        name = say("Angle of the {phase}", phase=phase_title(motion, k))
        least, most = max(LEAST_ANGLE, phase.angle / TIMES), min(room, phase.angle * TIMES)
        sizes[f"motion.phases[{k}].angle"] = name, SizeRange(round(least), round(most), 1.0), "°"
    k, lift = next((k, phase.lift) for k, phase in enumerate(phases) if phase.kind == "rise")
    step = step_for(lift)
    unit = "mm" if solution.task.motion.lift_unit == 1.0 else "°"
    return sizes | {f"motion.phases[{k}].lift": (say("Lift"), SizeRange(step, round_up(1.6 * lift), step), unit)}


def with_size(solution: AnySolution, path: str, value: float) -> dict[str, Any]:
    """The changes that give a task another value of one size, and what has to go with it.

    >>> import graphcam as gc
    >>> with_size(gc.solve(gc.builtin_task()), "motion.phases[0].angle", 90.0)
    {'motion.phases[0].angle': 90.0, 'motion.phases[1].angle': 35.0}
    """
    if isinstance(solution, ArcsSolution):
        name = path.removeprefix("arcs.").split("[")[0]
        freed = dict.fromkeys(must_agree(solution.task.arcs, name)) if path.startswith("arcs.") else {}
        return {path: value, **freed}
    phases = solution.task.motion.phases or ()
    if path.endswith("].angle"):
        k = int(path.split("[")[1].split("]")[0])
        other = (k + 1) % len(phases)
        total = phases[k].angle + phases[other].angle
        return {path: value, f"motion.phases[{other}].angle": round(total - value, 9)}
    if path.endswith("].lift"):
        now = value_at(solution.task.to_dict(), path)
        moving = ((k, phase.lift) for k, phase in enumerate(phases) if phase.kind != "dwell")
        return {f"motion.phases[{k}].lift": lift * value / now for k, lift in moving}
    return {path: value}


def _design(task: dict[str, Any]) -> Design:
    """The quantities of a design; none of what cannot be."""
    try:
        return exact_design(task_in(task))
    except GraphcamError:
        return {}


def _curves(designs: Sequence[Design], wanted: Sequence[Any], tell: Tell) -> list[dict[str, Any]]:
    """The quantities that some design has."""
    return [
        {
            "id": name,
            "title": tell(title),
            "unit": tell(UNITS.get(unit, unit)),
            "values": [None if (x := each.get(name)) is None else round(x, 6) for each in designs],
        }
        for name, (title, unit) in CURVES.items()
        if name in wanted and any(each.get(name) is not None for each in designs)
    ]


def _now(solution: AnySolution, path: str) -> float | None:
    """The present value of the size, found where the task leaves it open."""
    given = value_at(solution.task.to_dict(), path)
    if given is not None or isinstance(solution, ArcsSolution):
        return given
    chain = solution.chain
    found = {"prime_radius": chain.prime_radius, "roller_radius": chain.roller_radius}
    return found.get(path.split(".")[1], chain.place if path.startswith("follower.") else None)


def _limits(solution: AnySolution) -> dict[str, float | None]:
    """What the curves must keep to, by their names."""
    if isinstance(solution, ArcsSolution):
        return {}
    limits = solution.task.limits
    if not has_angles(solution.task):
        return {"curvature_radius": limits.min_curvature_radius or 0.0}
    permitted = solution.task.limits()
    back = permitted.return_
    return {
        "pressure_angle_rise": math.degrees(permitted.rise),
        "pressure_angle_return": None if back is None else math.degrees(back),
    }

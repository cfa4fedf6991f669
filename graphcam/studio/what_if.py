"""What if one size were another: the curves of a sweep of designs, from the exact side alone."""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field, replace
from typing import Annotated, Any

import numpy as np

from graphcam.constructions.axes import phase_title
from graphcam.drafting.scale import UNITS
from graphcam.errors import DesignError, GraphcamError
from graphcam.given.measured import MeasuredMotion
from graphcam.language import language
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.mechanism.three_arc_cam import three_arc_cam
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.shown_solution import plain_number
from graphcam.solving.solution import Solution
from graphcam.studio.form_fields import Field
from graphcam.studio.handle import changes_with
from graphcam.studio.held_solutions import held_solution
from graphcam.studio.size_ranges import MIN_PHASE_ANGLE, SizeRange, has_angles, sizes_of
from graphcam.studio.sizes_form import form_of
from graphcam.studio.task_paths import changed_task
from graphcam.studio.views_request import TaskRequest, read_request, task_in
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.number_limits import Within
from graphcam.tasks.task import Task
from graphcam.words import Caption, Tell, say

DEFAULT_DESIGNS, MAX_DESIGNS = 200, 400
MAX_MEASURED_DESIGNS = 60
"""The maximum number of designs of a measured motion, whose extremes take ten times as long."""
UNSWEPT_PATHS = "motion.tolerance", "speed_rpm", "spring.", "material.", "drawing.", "pencil"
"""How the paths of sizes begin that change none of the curves, or too slowly."""
MAX_SIZE = 1e6
PHASE_FACTOR = 2.5
"""How many times shorter and longer a phase is looked at: of much less angle every cam is huge."""


CURVE_TITLES: dict[str, tuple[Caption, str]] = {
    "least_prime_radius": (say("minimum prime radius"), "mm"),
    "prime_radius": (say("prime radius"), "mm"),
    "pressure_angle_rise": (say("maximum pressure angle, rise"), "°"),
    "pressure_angle_return": (say("maximum pressure angle, return"), "°"),
    "curvature_radius": (say("minimum radius of curvature ρ"), "mm"),
    "roller_radius": (say("roller radius"), "mm"),
    "max_v": (say("maximum velocity"), "mm/rad"),
}
"""What is told of a design, by name: title and unit."""
Design = dict[str, float | None]


def exact_design(task: Task | ArcsTask) -> Design:
    """The quantities of a design by the names of :data:`CURVE_TITLES`; None for what it does not have.

    What the task leaves open is what the exact side finds, not rounded as a drawing adopts it.

    Raises
    ------
    DesignError : there is no such cam

    >>> import graphcam as gc
    >>> found = exact_design(gc.builtin_task())
    >>> round(found["least_prime_radius"], 3), found["prime_radius"] == found["least_prime_radius"]
    (43.28, True)
    """
    found = _of_arcs(task) if isinstance(task, ArcsTask) else _of_motion(task)
    return {name: None if value is None else plain_number(value) for name, value in found.items()}


def _of_motion(task: Task) -> dict[str, float | None]:
    """The design of a cam whose follower moves by laws, or as it was measured."""
    sizes, (least, place) = sizes_of(task), _exact_least_radius(task)
    r0 = least if task.prime_radius is None else task.prime_radius
    found_place = {name: place for name in ("offset", "distance") if name in sizes and sizes[name] is None}
    # The pitch curve does not depend on the roller, which the rule takes from it.
    knife_edge = {"roller_radius": 0.0} if "roller_radius" in sizes else {}
    cam = Cam(task.motion(), replace(task.follower(), **found_place, **knife_edge), r0, task.rotation)
    extremes = cam.extremes()
    rho = extremes.min_convex_radius[0]
    found: dict[str, float | None] = {"least_prime_radius": least, "prime_radius": r0, "curvature_radius": rho}
    if not has_angles(task):
        return found
    rise, back = (math.degrees(abs(each)) for each, _ in (extremes.pressure_angle_rise, extremes.pressure_angle_return))
    by_rule = min(term(rho=rho, r0=r0) for term in task.roller_terms)
    roller = by_rule if sizes["roller_radius"] is None else sizes["roller_radius"]
    return found | {"pressure_angle_rise": rise, "pressure_angle_return": back, "roller_radius": roller}


def _exact_least_radius(task: Task) -> tuple[float, float]:
    """The least prime radius and the place that goes with it [mm]; NaN where a given place keeps the limits nowhere."""
    sizes, sharpest, asked = sizes_of(task), task.limits.min_curvature_radius, asdict(task.limits())
    if not has_angles(task):
        asked["curvature"] = sharpest or 0.0
    elif "offset" in sizes:
        asked["offset"] = sizes["offset"]
    try:
        least = minimum_radius(task.motion(), task.follower(), task.rotation, **asked)
        if least.place_name and sharpest is not None:
            placed = replace(task.follower(), **{least.place_name: least.place})
            asked |= {"curvature": sharpest} | ({"offset": least.place} if "offset" in asked else {})
            least = minimum_radius(task.motion(), placed, task.rotation, **asked)
    except DesignError:
        if task.prime_radius is None:
            raise
        return math.nan, math.nan
    return least.prime_radius, least.place


def _of_arcs(task: ArcsTask) -> dict[str, float | None]:
    """The design of a cam of arcs; on the return the pressure angle is the same, negative."""
    arcs = task.arcs()
    cam, _ = three_arc_cam(arcs.D, arcs.G, arcs.rho1, arcs.A, arcs.C1, arcs.C2)
    motion = cam.motion(task.follower.roller_radius, math.radians(task.arcs.dwell))
    radii = (rho + motion.roller_radius for rho in (cam.rho1, cam.rho2, cam.rho3))
    return {
        "prime_radius": motion.prime_radius,
        "pressure_angle_rise": math.degrees(motion.max_pressure_angle()[0]),
        "curvature_radius": min(motion.prime_radius, *radii),
        "roller_radius": motion.roller_radius,
        "max_v": motion.max_velocity()[0],
    }


@dataclass(frozen=True, eq=False, kw_only=True)
class SweepRequest(TaskRequest):
    """How many designs of a task are asked for, over the size at a path, and what of them.

    path : left out, the first size;  first, last : left out, the ends of its range
    """

    path: str | None = None
    first: Annotated[float, Within(-MAX_SIZE, MAX_SIZE)] | None = field(default=None, metadata={"alias": "from"})
    last: Annotated[float, Within(-MAX_SIZE, MAX_SIZE)] | None = field(default=None, metadata={"alias": "to"})
    count: Annotated[int, Within(2, MAX_DESIGNS)] = DEFAULT_DESIGNS
    quantities: tuple[Any, ...] = tuple(CURVE_TITLES)


def sweep_answer(data: Mapping[str, Any]) -> dict[str, Any]:
    """The answer to "sweep": quantities of as many designs as are asked for, over one size.

    data : see :class:`SweepRequest`

    Raises
    ------
    GraphcamError : the task has no solution, or no such size

    >>> import graphcam as gc
    >>> task = gc.builtin_task().to_dict()
    >>> found = sweep_answer({"task": task, "path": "follower.offset", "from": -10.0, "to": 0.0, "count": 3})
    >>> found["at"], [round(r0, 2) for r0 in found["curves"][0]["values"]]
    ([-10.0, -5.0, 0.0], [43.28, 51.01, 59.43])
    """
    asked = read_request(SweepRequest, data)
    task, tell, solution = asked.task, language(asked.language).text, held_solution(asked.task, asked.language)
    sizes = {field["path"]: field for field in swept_fields(solution, tell)}
    path = next(iter(sizes)) if asked.path is None else asked.path
    if path not in sizes:
        raise DesignError("path", path, say("a size of the task that can be swept"))
    at = _places(asked, sizes[path], solution)
    designs: list[Design] = []
    for value in at:
        designs.append({})
        # Where there is no cam nothing is told.
        with suppress(GraphcamError):
            designs[-1] = exact_design(task_in(changed_task(task, changes_with(sizes[path], path, value))))
    return {
        "path": path,
        "now": sizes[path]["value"],
        "at": at,
        "curves": _curves(designs, asked.quantities, tell),
        "limits": _limits(solution),
        "sizes": list(sizes.values()),
    }


def _places(asked: SweepRequest, field: Field, solution: AnySolution) -> list[float]:
    """The values that the size takes."""
    count = asked.count
    first = field["min"] if asked.first is None else asked.first
    last = field["max"] if asked.last is None else asked.last
    if isinstance(solution, Solution) and isinstance(solution.cam.motion, MeasuredMotion):
        count = min(count, MAX_MEASURED_DESIGNS)
    return [round(value, 9) for value in np.linspace(first, last, count).tolist()]


def swept_fields(solution: AnySolution, tell: Tell) -> list[Field]:
    """The fields of the form that can be swept, with what was found for open ones, and the angles of the phases.

    >>> import graphcam as gc
    >>> [field["name"] for field in swept_fields(gc.solve(gc.builtin_task("flat")), str)][:2]
    ['Lift h', 'Prime radius r₀']
    """
    fields: list[Field] = [
        {**field, "value": field.get("adopted") if field["value"] is None else field["value"]}
        for field in form_of(solution, tell)
        if field.get("min", 0.0) < field.get("max", 0.0) and not field["path"].startswith(UNSWEPT_PATHS)
    ]
    if isinstance(solution, Solution):
        return [*fields, *_phase_angles(solution, tell)]
    # A point of the arcs on both sides of where it is: few places make a cam.
    points = [field for field in fields if field["path"].endswith("]")]
    for point, near in zip(points, [(each["max"] - each["min"]) / 2 for each in points], strict=True):
        point |= {"min": round(point["value"] - near, 1), "max": round(point["value"] + near, 1)}
    return fields


def _phase_angles(solution: Solution, tell: Tell) -> Iterator[Field]:
    """Each phase's angle, which the next one pays for."""
    phases = solution.task.motion.phases or ()
    for k, phase in enumerate(phases):
        other = (k + 1) % len(phases)
        total = phase.angle + phases[other].angle
        least, most = max(MIN_PHASE_ANGLE, phase.angle / PHASE_FACTOR), min(total - 1.0, phase.angle * PHASE_FACTOR)
        yield {
            "path": f"motion.phases[{k}].angle",
            "name": tell(say("Angle of the {phase}", phase=phase_title(solution.cam.motion, k))),
            "unit": "°",
            "value": phase.angle,
            **SizeRange(round(least), round(most), 1.0).plain(),
            "sum": {"path": f"motion.phases[{other}].angle", "total": total},
        }


def _curves(designs: Sequence[Design], wanted: Sequence[Any], tell: Tell) -> list[dict[str, Any]]:
    """The quantities that some design has."""
    return [
        {
            "id": name,
            "title": tell(title),
            "unit": tell(UNITS.get(unit, unit)),
            "values": [None if (x := each.get(name)) is None else round(x, 6) for each in designs],
        }
        for name, (title, unit) in CURVE_TITLES.items()
        if name in wanted and any(each.get(name) is not None for each in designs)
    ]


def _limits(solution: AnySolution) -> dict[str, float | None]:
    """What the curves must keep to, by their names."""
    if isinstance(solution, ArcsSolution):
        return {}
    limits = solution.task.limits
    if not has_angles(solution.task):
        return {"curvature_radius": limits.min_curvature_radius or 0.0}
    permitted, sharpest = limits(), limits.min_curvature_radius
    back, roller = permitted.return_, solution.chain.board.roller_radius
    profile = {} if sharpest is None or roller is None else {"curvature_radius": roller + sharpest}
    return profile | {
        "pressure_angle_rise": math.degrees(permitted.rise),
        "pressure_angle_return": None if back is None else math.degrees(back),
    }

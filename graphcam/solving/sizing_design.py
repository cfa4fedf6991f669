"""Sizing a task: the best cam in the ranges of its table ``[sizing]``, the front beside it, and round sizes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from pathlib import Path
from typing import Any

from graphcam import __version__
from graphcam.constructions.adoption import multiple, steps_up, usual_rounding
from graphcam.errors import DesignError, check_kind
from graphcam.given.follower import Translating
from graphcam.given.spring_load import SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.contact import spring_preload
from graphcam.mechanism.sizing import Objective, SizedCam, best_cam, pareto_front, sized_cam
from graphcam.mechanism.sizing_limits import Measure, Sizes, SizingLimits, SizingProblem
from graphcam.showing import higher_function, value_text
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.sizing_table import SizingTable
from graphcam.tasks.spring_tables import SpringTable
from graphcam.tasks.task import CamTable, Task
from graphcam.words import Words, say

ROUNDING_LEVELS = 4
"""How often sizes are rounded more finely (tenths, hundredths, ...) where no round sizes keep the limits."""
MAX_TRIED_RADII = 50
"""Round radii that are tried, from the minimum one upwards."""


@dataclass(frozen=True, eq=False)
class Sizing:
    """The best cam of a task, by exact arithmetic, and a cam of round sizes that also satisfies the limits.

    task : with its ranges;  objective : "size" or "stress"
    best : the best cam, unrounded;  adopted : that of round sizes
    """

    task: Task
    objective: Objective
    best: SizedCam
    adopted: SizedCam

    def __repr__(self) -> str:
        problem, round_ = self.best.problem, self.adopted
        sizes = zip(problem.ranges, problem.values(round_.sizes), strict=True)
        rows = [
            ", ".join(f"{name} {value:g} mm" for name, value in sizes),
            f"contact stress {round_.stress:.4g} MPa",
            f"active at the unrounded best: {', '.join(self.best.active)}",
        ]
        last = ".best, .front, .sized_task, .to_dict(); .write(folder) writes the files"
        return value_text(f"Sizing of {self.task.title.name!r}", rows, last)

    @cached_property
    def front(self) -> tuple[SizedCam, ...]:
        """Cams with the widest face none of which is both smaller and under less stress than another."""
        return tuple(pareto_front(self.best.problem))

    @property
    def sized_task(self) -> Task:
        """The task with the adopted sizes in place of the ranges."""
        material, sizes = self.task.material, self.adopted.sizes
        assert material is not None
        of_follower = dict(zip(self.task.follower.sought, (sizes.offset, sizes.roller), strict=True))
        return replace(
            self.task,
            cam=CamTable(sizes.radius),
            follower=replace(self.task.follower, **of_follower),
            material=replace(material, width=sizes.width),
            sizing=None,
        )

    def to_dict(self) -> dict[str, Any]:
        """The results as plain data: mm, degrees and MPa."""
        problem, limits = self.best.problem, self.best.problem.limits
        back = None if limits.return_ is None else math.degrees(limits.return_)
        return {
            "graphcam": __version__,
            "task": self.task.to_dict(),
            "objective": self.objective,
            "measure": problem.measure,
            "ranges": {name: list(ends) for name, ends in problem.ranges.items()},
            "limits": {
                "pressure_angle_rise_deg": math.degrees(limits.rise),
                "pressure_angle_return_deg": back,
                "roller_rule": [term.text for term in limits.rule],
                "permitted_stress": limits.stress,
            },
            "binding": list(self.best.binding),
            "best": plain_cam(self.best),
            "adopted": plain_cam(self.adopted),
            "front": [plain_cam(cam) for cam in self.front],
        }

    def write(
        self, folder: Path | str, language: str | None = None, progress: Callable[[Words], None] | None = None
    ) -> dict[str, str]:
        """Write the chart, the front, the results and the sized task into a folder: all of them, or none.

        language : of the chart, by default the task's;  progress : called with what is being done
        returns : the files' names in the folder by kind

        Raises
        ------
        DesignError : there is no such language
        OutputError : the folder cannot be written
        """
        return higher_function("report.sizing_files.write")(self, folder, language, progress)


def size_task(task: Task | ArcsTask, objective: Objective | None = None) -> Sizing:
    """The best cam in the ranges of a task's table ``[sizing]``.

    objective : in place of the task's

    Raises
    ------
    DesignError : the task has no such table, or no cam in its ranges satisfies its limits

    >>> import graphcam as gc
    >>> gc.size_task(gc.builtin_task("sizing"))
    Sizing of 'Cam sized between limits'
      base radius 79 mm, offset 20 mm, roller radius 15 mm, face width 23 mm
      contact stress 1493 MPa
      active at the unrounded best: pressure angle on the rise, stress
    .best, .front, .sized_task, .to_dict(); .write(folder) writes the files
    """
    check_kind("task", task, (Task, ArcsTask))
    if isinstance(task, ArcsTask) or task.sizing is None:
        remedy = say("give the ranges of the sizes; the task 'sizing' that comes with graphcam is an example")
        raise DesignError("sizing", say("missing"), say("a table of the task"), remedy)
    problem, goal = _problem(task, task.sizing), objective or task.sizing.objective
    best = best_cam(problem, goal)
    rounding = task.drawing.rounding or usual_rounding(best.cam.prime_radius)
    return Sizing(task, goal, best, adopted(best, goal, rounding))


def plain_cam(cam: SizedCam) -> dict[str, float]:
    """A cam's sizes and what is limited of it: mm, degrees and MPa."""
    return {
        "prime_radius": cam.cam.prime_radius,
        "base_radius": cam.cam.prime_radius - cam.cam.roller_radius,
        "offset": cam.offset + 0.0,
        "roller_radius": cam.cam.roller_radius,
        "width": cam.width,
        "least_width": cam.min_width,
        "max_pressure_angle_deg": math.degrees(cam.max_pressure_angle),
        "min_pitch_curvature_radius": cam.min_convex_radius,
        "stress": cam.stress,
    }


def adopted(best: SizedCam, objective: Objective, step: float) -> SizedCam:
    """The best cam of sizes that are multiples of a step [mm] and keeps all limits; of a finer step where none does."""
    for finer in range(ROUNDING_LEVELS):
        rounded = list(_rounded_sizes(best, objective, step / 10**finer))
        kept = [sizes for sizes in rounded if best.problem.keeps(sizes, slack=0.0)]
        if kept:
            cams = [sized_cam(best.problem, sizes) for sizes in kept]
            if objective == "stress":
                return min(cams, key=lambda cam: cam.stress)
            return min(cams, key=lambda cam: (cam.radius, cam.width))
    return best


def _rounded_sizes(best: SizedCam, objective: Objective, step: float) -> list[Sizes]:
    """Cams of round sizes about the best one; of the smallest ones every radius is raised until the limits are kept."""
    problem = best.problem
    radius, offset, roller, _ = problem.values(best.sizes)
    ranges = list(problem.ranges.values())
    others = product(_nearest_multiples(offset, ranges[1], step), _nearest_multiples(roller, ranges[2], step))
    if objective == "stress":
        near, widest = _nearest_multiples(radius, ranges[0], step), problem.width[1]
        return [problem.sizes(each, e, r, widest) for e, r in others for each in near]
    found = [_smallest(problem, radius, e, r, step) for e, r in others]
    return [sizes for sizes in found if sizes is not None]


def _nearest_multiples(value: float, within: tuple[float, float], step: float) -> list[float]:
    """The multiples below and above a value in its range; the value itself where no multiple is in it."""
    low, high = within
    if low == high:
        return [low]
    count = steps_up(value, step)
    near = {multiple(k, step) for k in (count - 1, count)}
    return sorted(x for x in near if low <= x <= high) or [value]


def _smallest(problem: SizingProblem, radius: float, offset: float, roller: float, step: float) -> Sizes | None:
    """The minimum round radius that keeps the limits with an offset and a roller, and the minimum round width."""
    low, high = problem.radius
    widest, narrowest = problem.width[1], problem.width[0]
    first = steps_up(radius, step)
    tried = (
        [low] if low == high else [x for k in range(MAX_TRIED_RADII) if low <= (x := multiple(first + k, step)) <= high]
    )
    for each in tried:
        wide = problem.sizes(each, offset, roller, widest)
        if problem.keeps(wide, slack=0.0):
            width = multiple(steps_up(problem.exact_width(wide), step), step)
            return replace(wide, width=min(max(width, narrowest), widest))
    return None


def _problem(task: Task, table: SizingTable) -> SizingProblem:
    """The sizing problem that a task asks for."""
    follower, material, spring, speed = task.follower, task.material, task.spring, task.speed_rpm
    assert isinstance(spring, SpringTable)
    assert material is not None
    assert material.permitted_stress is not None
    assert speed is not None
    asked, given = task.limits(), table.ranges()
    limits = SizingLimits(
        material.permitted_stress, asked.rise, asked.return_, task.roller_terms, material(), spring.friction
    )
    measure: Measure = "base radius" if table.prime_radius is None else "prime radius"
    offset, roller = (getattr(follower, name) or 0.0 for name in follower.sought)
    motion, radius = task.motion(), given[measure.replace(" ", "_")]
    return SizingProblem(
        motion,
        _load(Cam(motion, Translating(), radius[1], task.rotation), spring(speed), spring),
        limits,
        radius,
        given.get("offset", (offset, offset)),
        given.get("roller_radius", (roller, roller)),
        given.get("width", (material.width, material.width)),
        task.rotation,
        measure,
    )


def _load(cam: Cam, load: SpringLoad, spring: SpringTable) -> SpringLoad:
    """The load; a preload that is left open is the minimum one, which is the same on every cam of the motion."""
    if spring.preload is not None:
        return load
    return replace(load, preload=max(spring_preload(cam, load).preload, 0.0))

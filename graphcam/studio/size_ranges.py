"""From where to where the sizes of a task can sensibly be moved: for sliders and number fields, handles and sweeps."""

import math
from dataclasses import fields
from functools import singledispatch
from typing import Any, NamedTuple

from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solution import Solution
from graphcam.studio.task_paths import value_at
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.sheet_tables import plain_data
from graphcam.tasks.spring_tables import ArmSpringTable, SpringTable
from graphcam.tasks.task import Task

STEPS_PER_LIFT = 60
"""A lift has about so many steps; a step is a round number."""
ROUND_FACTORS = 1.0, 2.0, 5.0
ANGLE_RANGE = 15.0, 60.0
"""Permitted pressure angles [degrees]; beyond, a follower jams or needs no limit."""
DEFAULT_STRESS = 1200.0
"""Permitted of hardened steel [MPa]; a slider begins there where no stress is judged."""
MAX_PHASES = 36
TRIANGLE_MARGIN_STEPS = 4
"""How many steps a triangle stays from a flat one."""
ARC_POINTS = "D", "G", "A", "C2"
"""The points of a cam of three arcs that can be moved; C1 goes with D and the radius of its arc."""
POINT_MOVE_SHARE = 0.15
"""A slider moves a point of the arcs by so much of the outer circle's radius: few places make a sound cam."""
MIN_PHASE_ANGLE = 1.0
"""The minimum angle of a phase [degrees]."""


class SizeRange(NamedTuple):
    """The least and the greatest value of a size, and the steps between.

    >>> SizeRange(-10.0, 10.0, 0.5).nearest_step(3.26), SizeRange(-10.0, 10.0, 0.5).nearest_step(12.0)
    (3.5, 10.0)
    """

    least: float
    most: float
    step: float

    def nearest_step(self, value: float, *, fine: bool = False) -> float:
        """The nearest step inside; a fifth of a step where it is to be fine."""
        step = self.step / 5 if fine else self.step
        inside = min(max(round(value / step) * step, self.least), self.most)
        # What is a decimal number shall look like one.
        return round(inside, 9)

    def plain(self) -> dict[str, float]:
        """The range as plain data for the page."""
        return {"min": self.least, "max": self.most, "step": self.step}

    def widened_to(self, value: float | None) -> "SizeRange":
        """The range, wide enough for a value that stands there."""
        if value is None:
            return self
        return SizeRange(min(self.least, value), max(self.most, value), self.step)


def round_up(value: float) -> float:
    """The next 1, 2 or 5 times a power of ten.

    >>> round_up(37.0), round_up(0.4), round_up(5.0)
    (50.0, 0.5, 5.0)
    """
    power = 10.0 ** math.floor(math.log10(value))
    return next((n * power for n in ROUND_FACTORS if value <= n * power * (1 + 1e-12)), 10 * power)


def step_for(length: float) -> float:
    """A round part of a length: 0.5 of a lift of 30.

    >>> step_for(30.0), step_for(0.3)
    (0.5, 0.005)
    """
    return round_up(length / STEPS_PER_LIFT)


def multiple_below(limit: float, step: float) -> float:
    """The last multiple of a step that is less than a limit.

    >>> multiple_below(44.0, 0.5), multiple_below(44.2, 0.5)
    (43.5, 44.0)
    """
    return round((math.ceil(limit / step - 1e-9) - 1) * step, 9)


def multiple_above(limit: float, step: float) -> float:
    """The first multiple of a step that is greater than a limit.

    >>> multiple_above(10.0, 0.5), multiple_above(10.2, 0.5)
    (10.5, 10.5)
    """
    return round((math.floor(limit / step + 1e-9) + 1) * step, 9)


@singledispatch
def ranges(solution: AnySolution) -> dict[str, SizeRange]:
    """The ranges of all numbers of a task but those of its phases, by their paths.

    >>> import graphcam as gc
    >>> ranges(gc.solve(gc.builtin_task()))["follower.offset"]
    SizeRange(least=-50.0, most=50.0, step=0.5)
    """
    raise TypeError(solution)


@ranges.register
def _(solution: Solution) -> dict[str, SizeRange]:
    found = {**_of_follower(solution), **_of_limits(solution.task), **_of_drawing(solution)}
    found["speed_rpm"] = _usual_range(solution.task.speed_rpm or 300.0)
    if (spring := solution.task.spring) is not None:
        found |= _of_spring(solution, spring)
    if (material := solution.task.material) is not None:
        sized = {"permitted_stress": DEFAULT_STRESS} | {
            key: value for key, value in plain_data(material).items() if value
        }
        found |= {f"material.{name}": _usual_range(value) for name, value in sized.items()}
        found |= {f"material.poisson_{body}": SizeRange(0.0, 0.5, 0.01) for body in ("cam", "follower")}
    for path, size in given_radii(solution.task):
        usual = SizeRange(0.0, 180.0, 1.0) if path.endswith(("ascent", "dwell")) else _usual_range(abs(size))
        found[path] = usual if size >= 0 else SizeRange(-usual.most, -usual.least, usual.step)
    if solution.task.motion.table is not None:
        found["motion.tolerance"] = SizeRange(0.002, 0.2, 0.001)
    return _widened_ranges(found, solution.task)


@ranges.register
def _(solution: ArcsSolution) -> dict[str, SizeRange]:
    outer = math.hypot(*solution.task.arcs.D)
    step, near = step_for(outer), POINT_MOVE_SHARE * outer
    found: dict[str, SizeRange] = {}
    for name in ARC_POINTS:
        for axis, value in enumerate(map(float, getattr(solution.cam, name))):
            # It stays while the point is moved a little.
            middle = round(value / near) * near
            room = SizeRange(
                math.ceil((middle - near) / step) * step, math.floor((middle + near) / step) * step, step / 5
            )
            found[f"arcs.{name}[{axis}]"] = SizeRange(*(round(each, 9) for each in room))
    found["arcs.rho1"] = SizeRange(step, multiple_below(outer, step), step)
    found["arcs.dwell"] = SizeRange(0.0, 180.0, 1.0)
    found["follower.roller_radius"] = SizeRange(0.0, multiple_below(outer, step), step)
    found["drawing.divisions"] = SizeRange(2, 12, 1)
    found["speed_rpm"] = _usual_range(solution.task.speed_rpm or 300.0)
    return _widened_ranges(found, solution.task)


def point_reach(solution: ArcsSolution) -> SizeRange:
    """From where to where a point of the arcs is dragged, which goes on to the last sound cam on its way."""
    arcs = solution.task.arcs
    reach = round_up(1.25 * max(abs(x) for name in (*ARC_POINTS, "C1") for x in getattr(arcs, name) or ()))
    return SizeRange(-reach, reach, step_for(math.hypot(*arcs.D)) / 5)


def _widened_ranges(found: dict[str, SizeRange], task: Task | ArcsTask) -> dict[str, SizeRange]:
    """The ranges with the values that stand in the task, though they lie outside what is usual."""
    said = task.to_dict()
    return {path: each.widened_to(value_at(said, path)) for path, each in found.items()}


class LiftSize(NamedTuple):
    """The lift of the first rise, with which those of all phases go in proportion.

    path, value, range : of it [mm, or degrees of an arm];  shares : the other lifts as parts of it, by their paths
    """

    path: str
    value: float
    range: SizeRange
    shares: dict[str, float]


def lift_size(task: Task) -> LiftSize | None:
    """The lift of the phases; None for a motion that is given otherwise.

    >>> import graphcam as gc
    >>> lift_size(gc.builtin_task()).shares
    {'motion.phases[2].lift': 1.0}
    """
    lifts = {
        f"motion.phases[{k}].lift": phase.lift
        for k, phase in enumerate(task.motion.phases or ())
        if phase.kind != "dwell"
    }
    rises = (f"motion.phases[{k}].lift" for k, phase in enumerate(task.motion.phases or ()) if phase.kind == "rise")
    if (path := next(rises, None)) is None:
        return None
    lift = lifts.pop(path)
    step = step_for(lift)
    room = SizeRange(step, round_up(1.6 * lift), step)
    return LiftSize(path, lift, room, {other: each / lift for other, each in lifts.items()})


def _usual_range(value: float) -> SizeRange:
    most = round_up(1.6 * value)
    return SizeRange(most / 100, most, most / 100)


def _of_spring(solution: Solution, spring: SpringTable | ArmSpringTable) -> dict[str, SizeRange]:
    """The ranges of what presses the follower on the cam."""
    preload = spring.preload if spring.preload is not None else _preload(solution)
    found = {
        "spring.stiffness": _usual_range(spring.stiffness),
        "spring.preload": _usual_range(preload or 100.0)._replace(least=0.0),
        "spring.friction": SizeRange(0.0, 0.5, 0.01),
        "spring.acceleration": SizeRange(-500.0, 500.0, 5.0),
        "spring.damping": _usual_range(spring.damping or 100.0)._replace(least=0.0),
    }
    if not isinstance(spring.load, tuple):
        found["spring.load"] = _usual_range(abs(spring.load) or 100.0)._replace(least=0.0)
    if isinstance(spring, SpringTable):
        return found | {"spring.mass": _usual_range(spring.mass)}
    found["spring.inertia"] = _usual_range(spring.inertia)
    if spring.at is not None:
        reach = round_up(2.0 * max(abs(spring.at.arm), *map(abs, spring.at.anchor)))
        step = step_for(reach)
        found["spring.at.arm"] = SizeRange(step, reach, step)
        found |= {f"spring.at.anchor[{axis}]": SizeRange(-reach, reach, step) for axis in (0, 1)}
    return found


def _preload(solution: Solution) -> float | None:
    return None if solution.spring is None else solution.spring.load.preload


def sizes_of(task: Task) -> dict[str, Any]:
    """The keys of the task's follower with their values, None for what is open.

    >>> import graphcam as gc
    >>> sizes_of(gc.builtin_task("flat"))
    {'face_margin': None, 'kind': 'flat-faced'}
    """
    return {field.name: getattr(task.follower, field.name) for field in fields(task.follower)}


def given_radii(task: Task) -> list[tuple[str, float]]:
    """The sizes of a given cam that are numbers, by their paths; a straight flank is none.

    >>> import graphcam as gc
    >>> given_radii(gc.builtin_task())
    []
    """
    said = plain_data(task.motion.radii) if task.motion.radii else {}
    return [(f"motion.radii.{name}", size) for name, size in said.items() if isinstance(size, float | int)]


def has_angles(task: Task) -> bool:
    """Whether the follower has a pressure angle; if not, the curvature of the profile limits the cam."""
    return "pressure_angle_rise" not in task.follower.without


def lift_of(solution: Solution) -> float:
    """The greatest lift along the path of the follower [mm]: of what swings an arc, on a face below the pivot's end."""
    sizes = sizes_of(solution.task)
    lever = sizes.get("arm") or (sizes["distance"] if "face_offset" in sizes else 1.0)
    return solution.cam.motion.lift * lever


def _of_follower(solution: Solution) -> dict[str, SizeRange]:
    """The sizes of cam and follower: all that leave room for one another."""
    follower, given = sizes_of(solution.task), solution.task.prime_radius
    radius, step = solution.chain.prime_radius, step_for(lift_of(solution))
    roller = (
        {"follower.roller_radius": SizeRange(0.0, multiple_below(radius, step), step)}
        if "roller_radius" in follower
        else {}
    )
    if "arm" in follower:
        return roller | _of_arm(solution, step)
    if "face_offset" in follower:
        return _of_swinging_face(solution, step)
    most = round_up(max(1.6 * radius, 2 * lift_of(solution)))
    least = max(abs(follower.get("offset") or 0.0), follower.get("roller_radius") or 0.0)
    sizes = roller | {"cam.prime_radius": SizeRange(multiple_above(least, step), most, step)}
    if "offset" not in follower:
        return sizes
    # Where the prime radius is given the follower must stay on its circle; else the radius follows the offset.
    aside = multiple_below(given, step) if given is not None else round_up(lift_of(solution))
    return sizes | {"follower.offset": SizeRange(-aside, aside, step)}


def third_side(first: float, second: float, step: float) -> SizeRange:
    """The third side of a triangle of arm, centre distance and prime radius, a few steps from a flat one.

    >>> third_side(125.0, 150.0, 1.0)
    SizeRange(least=29.0, most=271.0, step=1.0)
    """
    least = math.ceil(abs(first - second) / step + TRIANGLE_MARGIN_STEPS) * step
    most = math.floor((first + second) / step - TRIANGLE_MARGIN_STEPS) * step
    return SizeRange(round(max(least, step), 9), round(most, 9), step)


def _of_arm(solution: Solution, step: float) -> dict[str, SizeRange]:
    """An arm must reach the prime circle; what is found follows the other sizes."""
    follower = sizes_of(solution.task)
    arm, distance, radius = follower["arm"], solution.chain.place, solution.chain.prime_radius
    closed = solution.task.prime_radius is not None and follower["distance"] is not None
    free = SizeRange(step, round_up(2.5 * arm), step)
    arms, distances, radii = (
        third_side(*sides, step) if closed else free for sides in ((distance, radius), (arm, radius), (arm, distance))
    )
    least = max(radii.least, multiple_above(follower["roller_radius"] or 0.0, step))
    return {
        "follower.arm": arms,
        "follower.distance": distances,
        "cam.prime_radius": SizeRange(least, radii.most, step),
    }


def _of_swinging_face(solution: Solution, step: float) -> dict[str, SizeRange]:
    """The line of the face passes the cam centre on its side, and its pivot lies beyond it, a few steps away."""
    distance, radius, f = solution.chain.place, solution.chain.prime_radius, sizes_of(solution.task)["face_offset"]
    room = TRIANGLE_MARGIN_STEPS * step
    # Up to where the face at the end of its swing is square to the line of centres.
    highest = distance * math.cos(solution.cam.motion.lift)
    steepest = abs(radius + f) / math.cos(solution.cam.motion.lift)
    return {
        "follower.distance": SizeRange(multiple_above(steepest + room, step), round_up(2.5 * distance), step),
        "follower.face_offset": SizeRange(
            multiple_above(room - radius, step), multiple_below(highest - radius - room, step), step
        ),
        "cam.prime_radius": SizeRange(
            multiple_above(max(0.0, room - f), step), multiple_below(highest - f - room, step), step
        ),
    }


def _of_limits(task: Task) -> dict[str, SizeRange]:
    profile = {"limits.min_curvature_radius": SizeRange(0.5, 50.0, 0.5)}
    if not has_angles(task):
        return profile
    return profile | {f"limits.pressure_angle_{way}": SizeRange(*ANGLE_RANGE, 1.0) for way in ("rise", "return")}


def _of_drawing(solution: Solution) -> dict[str, SizeRange]:
    """The ranges of the draughtsman's choices."""
    board = solution.chain.board
    most = round_up(1.25 * board.ordinate)
    step = min(1.0, step_for(most))
    return {
        "drawing.divisions": SizeRange(4, 36, 1),
        "drawing.ordinate": SizeRange(step, most, step),
        **{f"drawing.poles[{k}]": SizeRange(10.0, 80.0, 1.0).widened_to(pole) for k, pole in enumerate(board.poles)},
    }

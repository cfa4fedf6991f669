"""From where to where the sizes of a task can sensibly be moved: for sliders and number fields, handles and sweeps."""

import math
from dataclasses import fields
from functools import lru_cache
from typing import Any, NamedTuple

from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solution import Solution
from graphcam.studio.task_paths import value_at
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.declared_numbers import About, Fixed, Ruled, numbers_of
from graphcam.tasks.task import Task

STEPS_PER_LIFT = 60
"""A lift has about so many steps; a step is a round number."""
ROUND_FACTORS = 1.0, 2.0, 5.0
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


@lru_cache(maxsize=8)
def ranges(solution: AnySolution) -> dict[str, SizeRange]:
    """The ranges of all numbers of a task but those of its phases, by their paths.

    >>> import graphcam as gc
    >>> ranges(gc.solve(gc.builtin_task()))["follower.offset"]
    SizeRange(least=-50.0, most=50.0, step=0.5)
    """
    said, open_ = _known_sizes(solution)
    found = ruled_ranges(solution)
    for path, number in numbers_of(solution.task).items():
        value = value_at(said, path)
        if number.name is None or isinstance(value, str | list) or (value is None and _is_absent(solution.task, path)):
            continue
        value = open_.get(path) if value is None else value
        if not isinstance(number.range, Ruled):
            found[path] = marked_range(number.range, value)
        found[path] = found[path].widened_to(value)
    return found


@lru_cache(maxsize=8)
def _known_sizes(solution: AnySolution) -> tuple[dict[str, Any], dict[str, float | None]]:
    return solution.task.to_dict(), adopted(solution)


def present_value(solution: AnySolution, path: str) -> float | None:
    """The value of a number of the task, found where the task leaves it open.

    >>> import graphcam as gc
    >>> present_value(gc.solve(gc.builtin_task()), "cam.prime_radius")
    44.0
    """
    said, open_ = _known_sizes(solution)
    given = value_at(said, path)
    return open_.get(path) if given is None else given


def _is_absent(task: Task | ArcsTask, path: str) -> bool:
    """Whether a number that is left out makes no sense in the task, so that no form asks for it."""
    if not isinstance(task, Task):
        return False
    lacking = () if has_angles(task) else ("limits.pressure_angle",)
    return path.startswith(("motion.radii", *lacking)) or (path == "motion.tolerance" and task.motion.table is None)


def adopted(solution: AnySolution) -> dict[str, float | None]:
    """What a solution found for the numbers that its task may leave open, by their paths.

    >>> import graphcam as gc
    >>> adopted(gc.solve(gc.builtin_task()))["follower.roller_radius"]
    17.0
    """
    if isinstance(solution, ArcsSolution):
        # A may be left out only where the centre tells where the rise begins, and the other way round.
        points = {"A": solution.task.arcs.C2, "C2": solution.task.arcs.A}
        found = {name: getattr(solution.cam, name) for name, other in points.items() if other is not None}
        return {f"arcs.{name}[{k}]": round(float(x), 6) for name, at in found.items() for k, x in enumerate(at)}
    chain, spring = solution.chain, solution.spring
    return {
        "follower.offset": chain.place,
        "follower.distance": chain.place,
        "follower.roller_radius": chain.roller_radius,
        "cam.prime_radius": chain.prime_radius,
        "spring.preload": None if spring is None else spring.load.preload,
        "drawing.divisions": chain.board.divisions,
        "drawing.ordinate": chain.board.ordinate,
        **{f"drawing.poles[{k}]": pole for k, pole in enumerate(chain.board.poles)},
    }


def marked_range(mark: Fixed | About, value: float | None) -> SizeRange:
    """The range of a number by the mark of its declaration.

    >>> marked_range(About(100.0, from_zero=True), 30.0), marked_range(About(60.0), -30.0)
    (SizeRange(least=0.0, most=50.0, step=0.5), SizeRange(least=-50.0, most=-0.5, step=0.5))
    """
    if isinstance(mark, Fixed):
        return SizeRange(*mark)
    most = round_up(1.6 * abs(value or mark.value))
    if (value or 0.0) < 0 and not mark.from_zero:
        return SizeRange(-most, -most / 100, most / 100)
    return SizeRange(0.0 if mark.from_zero else most / 100, most, most / 100)


def ruled_ranges(solution: AnySolution) -> dict[str, SizeRange]:
    """The ranges that follow from other sizes, by the paths of the numbers.

    >>> import graphcam as gc
    >>> list(ruled_ranges(gc.solve(gc.builtin_task("flat"))))
    ['cam.prime_radius', 'drawing.ordinate']
    """
    if isinstance(solution, ArcsSolution):
        return _of_arcs(solution)
    most = round_up(1.25 * solution.chain.board.ordinate)
    step = min(1.0, step_for(most))
    found = {**_of_follower(solution), "drawing.ordinate": SizeRange(step, most, step)}
    if (place := getattr(solution.task.spring, "at", None)) is not None:
        reach = round_up(2.0 * max(abs(place.arm), *map(abs, place.anchor)))
        step = step_for(reach)
        found["spring.at.arm"] = SizeRange(step, reach, step)
        found |= {f"spring.at.anchor[{axis}]": SizeRange(-reach, reach, step) for axis in (0, 1)}
    return found


def _of_arcs(solution: ArcsSolution) -> dict[str, SizeRange]:
    outer = math.hypot(*solution.task.arcs.D)
    step, near = step_for(outer), POINT_MOVE_SHARE * outer
    found: dict[str, SizeRange] = {}
    for name in ARC_POINTS:
        for axis, value in enumerate(map(float, getattr(solution.cam, name))):
            # It stays while the point is moved a little.
            middle = round(value / near) * near
            least, most = math.ceil((middle - near) / step) * step, math.floor((middle + near) / step) * step
            given = (getattr(solution.task.arcs, name) or {axis: None})[axis]
            room = SizeRange(round(least, 9), round(most, 9), round(step / 5, 9))
            found[f"arcs.{name}[{axis}]"] = room.widened_to(given)
    found["arcs.rho1"] = SizeRange(step, multiple_below(outer, step), step)
    found["follower.roller_radius"] = SizeRange(0.0, multiple_below(outer, step), step)
    return found


def point_reach(solution: ArcsSolution) -> SizeRange:
    """From where to where a point of the arcs is dragged, which goes on to the last sound cam on its way."""
    arcs = solution.task.arcs
    reach = round_up(1.25 * max(abs(x) for name in (*ARC_POINTS, "C1") for x in getattr(arcs, name) or ()))
    return SizeRange(-reach, reach, step_for(math.hypot(*arcs.D)) / 5)


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
    moving = {f"motion.phases[{k}].lift": p for k, p in enumerate(task.motion.phases or ()) if p.kind != "dwell"}
    lifts = {path: phase.lift for path, phase in moving.items()}
    if (path := next((path for path, phase in moving.items() if phase.kind == "rise"), None)) is None:
        return None
    lift = lifts.pop(path)
    step = step_for(lift)
    room = SizeRange(step, round_up(1.6 * lift), step)
    return LiftSize(path, lift, room, {other: each / lift for other, each in lifts.items()})


def sizes_of(task: Task) -> dict[str, Any]:
    """The keys of the task's follower with their values, None for what is open.

    >>> import graphcam as gc
    >>> sizes_of(gc.builtin_task("flat"))
    {'face_margin': None, 'kind': 'flat-faced'}
    """
    return {field.name: getattr(task.follower, field.name) for field in fields(task.follower)}


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

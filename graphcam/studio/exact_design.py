"""What the exact side says of one design: the curves of "what if", without a drawing."""

import math
from dataclasses import replace
from typing import Any

from graphcam.errors import DesignError
from graphcam.given.follower import Follower
from graphcam.given.roller_rule import roller_rule
from graphcam.mechanism.arcs import three_arc_cam
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.solving.shown_solution import plain_number
from graphcam.studio.size_ranges import has_angles, sizes_of
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.words import Caption, say

CURVES: dict[str, tuple[Caption, str]] = {
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
    """The quantities of a design by the names of :data:`CURVES`; None for what it does not have.

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
    motion, given = task.motion(), task.follower
    least, place = _least(task)
    r0 = least if task.cam.prime_radius is None else task.cam.prime_radius
    # The pitch curve does not depend on the roller, which the rule takes from it.
    cam = Cam(motion, _follower(task, place), r0, task.rotation)
    extremes = cam.extremes()
    found: dict[str, float | None] = {"least_prime_radius": least, "prime_radius": r0}
    rho = found["curvature_radius"] = extremes.min_convex_radius[0]
    if not has_angles(task):
        return found
    rise, back = (math.degrees(abs(each)) for each, _ in (extremes.pressure_angle_rise, extremes.pressure_angle_return))
    by_rule = min(term(rho=rho, r0=r0) for term in roller_rule(given.roller_rule))
    roller = by_rule if given.roller_radius is None else given.roller_radius
    return found | {"pressure_angle_rise": rise, "pressure_angle_return": back, "roller_radius": roller}


def _least(task: Task) -> tuple[float, float]:
    """The least prime radius and the place that goes with it [mm]; NaN where a given place keeps the limits nowhere."""
    limits = task.limits()
    asked: dict[str, Any] = {"rise": limits.rise, "return_": limits.return_, "rest": limits.rest, **_condition(task)}
    try:
        least = minimum_radius(task.motion(), task.follower(), task.rotation, **asked)
    except DesignError:
        if task.cam.prime_radius is None:
            raise
        return math.nan, math.nan
    return least.prime_radius, least.place


def _follower(task: Task, place: float) -> Follower:
    """The follower without its roller, at the place that was found if the task leaves it open."""
    sizes = sizes_of(task)
    found = {name: place for name in ("offset", "distance") if name in sizes and sizes[name] is None}
    return replace(task.follower(), **found, **({"roller_radius": 0.0} if "roller_radius" in sizes else {}))


def _condition(task: Task) -> dict[str, float | None]:
    """What the least radius is asked for besides the angles."""
    if not has_angles(task):
        return {"curvature": task.limits.min_curvature_radius or 0.0}
    return {name: size for name, size in sizes_of(task).items() if name == "offset"}


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

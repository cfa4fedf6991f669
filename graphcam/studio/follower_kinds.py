"""Another kind of follower for a task: a sensible table of each, and what else must change with it."""

import math
from typing import Any

from graphcam.solving.solution import Solution
from graphcam.studio.size_ranges import lift_of, round_up
from graphcam.tasks.sheet_tables import plain
from graphcam.tasks.spring_tables import ArmSpringTable, SpringTable
from graphcam.words import Caption, Tell, say_in

KINDS: dict[str, Caption] = {
    "translating": say_in("a kind of follower", "translating"),
    "oscillating": say_in("a kind of follower", "oscillating"),
    "flat-faced": say_in("a kind of follower", "flat-faced"),
}
ARM_OVER_LIFT = 4.0
"""An arm about so many times as long as its tip's path swings by some 14 degrees."""
ARM = 100.0
"""One whose lifts are angles [mm]."""
PLACES = 4
"""Digits of the sizes of a spring that goes with another kind of follower."""


def kind_choices(solution: Solution, tell: Tell) -> list[dict[str, Any]]:
    """The kinds that the task's motion goes with; ``table`` is a follower of that kind, ``changes`` all that changes.

    >>> import graphcam as gc
    >>> [choice["value"] for choice in kind_choices(gc.solve(gc.builtin_task()), str)]
    ['translating', 'oscillating', 'flat-faced']
    """
    tables = {kind: _table(solution, kind) for kind in KINDS}
    return [
        {"value": kind, "name": tell(KINDS[kind]), "table": table, "changes": _changes(solution, table)}
        for kind, table in tables.items()
        if _follows(solution, table)
    ]


def _table(solution: Solution, kind: str) -> dict[str, Any]:
    """The present follower if it is of that kind; else one whose place and roller are found."""
    present = plain(solution.task.follower)
    if kind == present["kind"]:
        return present
    # Lifts in mm stay what they are: they are the arc that the tip of the arm describes.
    in_mm = solution.task.follower.column == "s_mm"
    arm = round_up(ARM_OVER_LIFT * lift_of(solution)) if in_mm else ARM
    return {"kind": kind, **{"oscillating": {"arm": arm, "lift": "arc"}}.get(kind, {})}


def _follows(solution: Solution, table: dict[str, Any]) -> bool:
    """Whether a follower can do what was measured: angles of an arm are nothing for a stem."""
    measured = solution.task.motion.table
    in_mm = table.get("lift") != "angle"
    return measured is None or measured.column == "a" or (measured.column == "s_mm") == in_mm


def _changes(solution: Solution, follower: dict[str, Any]) -> dict[str, Any]:
    """The follower, sizes of the cam found anew, its spring, and no limits, ranges or tolerances that it lacks."""
    if follower == plain(solution.task.follower):
        return {"follower": follower}
    angles = dict.fromkeys(("limits.pressure_angle_rise", "limits.pressure_angle_return"))
    other: dict[str, Any] = {"follower": follower, "cam.prime_radius": None, **angles}
    fixed = {"limits.min_curvature_radius": None, "tolerances": None, "sizing": None}
    return other | fixed | _spring(solution, follower)


def _spring(solution: Solution, follower: dict[str, Any]) -> dict[str, Any]:
    """The spring as the other kind has it; what presses besides, the friction and the material stay as they are.

    At the end of an arm a mass m and a spring c do what the moment of inertia m l^2 and the torsion spring c l^2 do.
    """
    spring, swings = solution.task.spring, follower["kind"] == "oscillating"
    if spring is None or spring.swings == swings:
        return {}
    present = plain(solution.task.follower)
    lever = float((follower if swings else present)["arm"])
    said = plain(spring)
    kept = {key: said[key] for key in ("acceleration", "friction", "load")}
    if isinstance(spring, SpringTable):
        turned = {"inertia": spring.mass * lever**2, "stiffness": spring.stiffness * lever**2}
        turned |= {} if spring.preload is None else {"preload": spring.preload * lever}
    else:
        turned = _straightened(spring, lever)
    return {"spring": {**{key: float(f"{value:.{PLACES}g}") for key, value in turned.items()}, **kept}}


def _straightened(spring: ArmSpringTable, lever: float) -> dict[str, float]:
    """The spring of an arm of that length [mm] as that of a stem; one at a point is taken as it is."""
    square = lever**2 if spring.at is None else 1.0
    straight = {"mass": spring.inertia / lever**2, "stiffness": spring.stiffness / square}
    return straight | ({} if spring.preload is None else {"preload": spring.preload / math.sqrt(square)})

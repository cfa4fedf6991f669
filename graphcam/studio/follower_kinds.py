"""Another kind of follower for a task: a sensible table of each, and what else must change with it."""

from typing import Any

from graphcam.solving.solution import Solution
from graphcam.studio.size_ranges import lift_of, round_up
from graphcam.tasks.sheet_tables import plain
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
    """The follower, sizes of the cam that are found anew, and no limits, spring, material or ranges that it lacks."""
    if follower == plain(solution.task.follower):
        return {"follower": follower}
    angles = dict.fromkeys(("limits.pressure_angle_rise", "limits.pressure_angle_return"))
    other: dict[str, Any] = {"follower": follower, "cam.prime_radius": None, **angles}
    return other | {"limits.min_curvature_radius": None, "spring": None, "material": None, "sizing": None}

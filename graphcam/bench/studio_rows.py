"""The time that you wait while you drag a handle of the studio: one view, solved and drawn anew."""

from collections.abc import Callable, Iterator
from itertools import count
from typing import Any

from graphcam.bench.rows import BenchRow, Gauge, Section
from graphcam.studio.engine import answer
from graphcam.studio.task_paths import changed, value_at
from graphcam.studio.task_text import plain_task
from graphcam.tasks.task_file import BUILT_IN, builtin_arcs_task, builtin_task

PX_PER_MM = 1.9
"""How large a view is shown."""
MOST = 30
"""Milliseconds for a view."""
STEP = 1e-3
"""How much a size grows from one picture to the next [mm or degrees]."""


def studio_rows(gauge: Gauge) -> Iterator[BenchRow]:
    """Every view of every built-in task while one of its sizes is dragged."""
    for name in (*BUILT_IN, "arcs"):
        task = plain_task(builtin_arcs_task() if name == "arcs" else builtin_task(name))
        for view in answer({"task": task, "views": []})["names"]:
            seconds = gauge.timer.seconds(dragging(task, view["name"]))
            yield BenchRow(
                "view while dragged", f"{name}, {view['name']}", 1e3 * seconds, "ms", f"<= {MOST}", None, seconds
            )


def dragging(task: dict[str, Any], view: str) -> Callable[[], dict[str, Any]]:
    """What answers the next picture of a drag: each time with the size a little farther on.

    >>> again = dragging(plain_task(builtin_task()), "profile")
    >>> again()["ok"], again()["sizes"]["offset"]
    (True, -9.998)
    """
    path = dragged_size(task)
    asked = [{"name": view, "px_per_mm": PX_PER_MM}]
    hold, steps = answer({"task": task, "views": asked})["hold"], count(1)

    def next_picture() -> dict[str, Any]:
        """The answer to the next request."""
        moved = changed(task, {path: value_at(task, path) + STEP * next(steps)})
        return answer({"task": moved, "views": asked, "hold": hold})

    return next_picture


def dragged_size(task: dict[str, Any]) -> str:
    """The size that is dragged: the first of some that a task gives, on which every view depends."""
    sizes = ("follower.offset", "arcs.rho1", "cam.prime_radius", "limits.min_curvature_radius")
    return next(path for path in sizes if value_at(task, path) is not None)


STUDIO = Section(
    "studio",
    "Waiting times in the studio",
    "One view, solved and drawn anew while a size is dragged, with its labels and scales held; in milliseconds of "
    "processor time on this machine.",
    studio_rows,
)

"""Solving a task, of whichever kind."""

from __future__ import annotations

from typing import overload

from graphcam.drafting.pencil import Pencil
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution, solve_arcs
from graphcam.solving.solution import Solution, solve_motion
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task


@overload
def solve(task: Task, pencil: Pencil | None = None) -> Solution: ...
@overload
def solve(task: ArcsTask, pencil: Pencil | None = None) -> ArcsSolution: ...
@overload
def solve(task: Task | ArcsTask, pencil: Pencil | None = None) -> AnySolution: ...
def solve(task: Task | ArcsTask, pencil: Pencil | None = None) -> AnySolution:
    """Solve a task: draw its constructions with the pencil (default: a perfect one) and compute the same cam exactly.

    Raises
    ------
    DesignError : there is no such cam

    >>> from graphcam.tasks.task_file import builtin_arcs_task, builtin_task
    >>> list(solve(builtin_arcs_task()).drawn)
    ['three_arcs', 'arc_roller', 'arc_diagrams']
    >>> solve(builtin_task()).cam.prime_radius
    44.0
    """
    return solve_arcs(task, pencil) if isinstance(task, ArcsTask) else solve_motion(task, pencil)

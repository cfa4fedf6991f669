"""Solving a task, of whichever kind."""

from __future__ import annotations

from typing import overload

from graphcam.drafting.pencil import Pencil
from graphcam.errors import check_kind
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution, solve_arcs
from graphcam.solving.solution import Solution, solved_on
from graphcam.solving.task_board import board_of
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.words import say


@overload
def solve(task: Task, pencil: Pencil | None = None) -> Solution: ...
@overload
def solve(task: ArcsTask, pencil: Pencil | None = None) -> ArcsSolution: ...
@overload
def solve(task: Task | ArcsTask, pencil: Pencil | None = None) -> AnySolution: ...
def solve(task: Task | ArcsTask, pencil: Pencil | None = None) -> AnySolution:
    """Solve a task: draw its constructions with the pencil (by default an ideal one) and compute the cam exactly.

    Raises
    ------
    DesignError : there is no such cam

    >>> import graphcam as gc
    >>> list(gc.solve(gc.builtin_arcs_task()).drawn)
    ['three_arcs', 'arc_roller', 'arc_diagrams']
    >>> gc.solve(gc.builtin_task())
    Solution of 'Cam mechanism'
      Cam that turns cw, prime radius 44 mm
      translating follower, offset -10 mm, roller radius 17 mm
      rise 80°, dwell 45°, return 60°, dwell 175°
      drawn: scheme, acceleration, integration, minimum_radius, pressure_angle, angle_diagram, inversion,
      curvature, roller, working_profile
    .drawn[name], .comparison, .to_dict(); .plot() draws the sheet, .write(folder) writes the files
    """
    check_kind("task", task, (Task, ArcsTask), remedy=say("load_task(file) reads one; a Cam is exact already"))
    if pencil is not None:
        check_kind("pencil", pencil, Pencil, remedy=say("write graphcam.Pencil.of(0.2) for errors of 0.2 mm"))
    return solve_arcs(task, pencil) if isinstance(task, ArcsTask) else solved_on(board_of(task), task, pencil)

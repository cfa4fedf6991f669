"""The kinds of tasks: how each is solved, and the papers that its solution gets."""

from __future__ import annotations

from typing import overload

from graphcam.arcs_task import ArcsTask
from graphcam.drafting.pencil import Pencil
from graphcam.main_job import solution as motion_job
from graphcam.main_job.arcs import AnySolution, ArcsSolution, solve_arcs
from graphcam.main_job.arcs_papers import arcs_contents, arcs_note
from graphcam.main_job.contents import Contents, drawing
from graphcam.main_job.note import note
from graphcam.main_job.sheet import contents
from graphcam.main_job.solution import Solution
from graphcam.sheets.model import Drawing
from graphcam.task import Task


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

    >>> from graphcam.task_file import builtin_arcs_task, builtin_task
    >>> list(solve(builtin_arcs_task()).drawn)
    ['three_arcs', 'arc_roller', 'arc_diagrams']
    >>> solve(builtin_task()).cam.prime_radius
    44.0
    """
    return solve_arcs(task, pencil) if isinstance(task, ArcsTask) else motion_job.solve(task, pencil)


def sheet_of(solution: AnySolution, upto: int | str | None = None, *, per_construction: bool = False) -> Drawing:
    """The sheets: finished, or drawn up to a step.

    upto : number of the last step that is drawn, or name of the construction that it ends; None draws all
    per_construction : every construction on sheets of its own

    Raises
    ------
    DesignError : there is no such step or construction
    """
    return drawing(contents_of(solution), upto, per_construction=per_construction)


def contents_of(solution: AnySolution) -> Contents:
    """What stands on the sheets."""
    return arcs_contents(solution) if isinstance(solution, ArcsSolution) else contents(solution)


def worksheet(solution: AnySolution, *, per_construction: bool = False) -> Drawing:
    """The blank sheet for students: frame, title block, what the task gives, scales and axes, and room to draw.

    Everything stands where it stands on the finished sheet, so that one may be laid over the other.

    >>> from graphcam.task_file import builtin_task
    >>> blank, finished = worksheet(solve(builtin_task())), sheet_of(solve(builtin_task()))
    >>> len(blank.pages) == len(finished.pages), len(blank.pages[0].groups) < len(finished.pages[0].groups)
    (True, True)
    """
    return sheet_of(solution, 0, per_construction=per_construction)


def note_of(solution: AnySolution) -> str:
    """The note in Markdown."""
    return arcs_note(solution) if isinstance(solution, ArcsSolution) else note(solution)

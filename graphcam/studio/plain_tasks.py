"""Tasks as the page has them: plain data with the keys of a task file, a measured table in them and not beside them."""

from functools import cache
from typing import Any

from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import BUILT_IN, builtin_arcs_task, builtin_task

ARCS = "arcs"
"""The built-in task of a cam of three circular arcs."""


def plain_task(task: Task | ArcsTask) -> dict[str, Any]:
    """The task as plain data, from which :func:`~graphcam.tasks.task_file.task_from` makes it again.

    >>> import graphcam as gc
    >>> table = plain_task(gc.builtin_task("measured"))["motion"]["table"]
    >>> table["file"], table["column"], table["rows"][0]
    ('measured.csv', 's_mm', [0.0, 0.0])
    """
    plain = task.to_dict()
    if isinstance(task, Task) and (table := task.motion.table) is not None:
        rows = [list(row) for row in table.rows]
        plain["motion"]["table"] = {"file": table.file, "column": table.column, "rows": rows}
    return plain


@cache
def built_in_tasks() -> dict[str, dict[str, Any]]:
    """The tasks that come with graphcam, by their names; nobody changes them.

    >>> list(built_in_tasks())
    ['coursework', 'arm', 'flat', 'measured', 'arcs']
    """
    return {name: plain_task(builtin_task(name)) for name in BUILT_IN} | {ARCS: plain_task(builtin_arcs_task())}


def nearest_built_in(task: Task | ArcsTask) -> str:
    """The built-in task that is most like another: of the same kind of motion and follower.

    >>> import graphcam as gc
    >>> nearest_built_in(gc.builtin_task("flat")), nearest_built_in(gc.builtin_arcs_task())
    ('flat', 'arcs')
    """
    if isinstance(task, ArcsTask):
        return ARCS
    alike = {name: builtin_task(name) for name in BUILT_IN}
    kind, measured = task.follower.kind, task.motion.table is not None

    def likeness(name: str) -> int:
        """How much is the same."""
        other = alike[name]
        same = other == task, (other.motion.table is not None) == measured, other.follower.kind == kind
        return sum(2**k * part for k, part in enumerate(reversed(same)))

    return max(alike, key=likeness)

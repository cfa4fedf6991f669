"""The built-in tasks as the page holds them, and back again."""

import dataclasses
from functools import cache

import graphcam as gc
from graphcam.tasks import task_file

BUILT_IN = (*task_file.BUILTIN_TASK_NAMES, "arcs")


def builtin(name):
    return gc.builtin_arcs_task() if name == "arcs" else gc.builtin_task(name)


def plain_task(name):
    """A built-in task as plain data; the table of a measured motion stands in it."""
    task = builtin(name)
    said = task.to_dict()
    if name == "measured":
        said["motion"]["table"] = plain_table(task.motion.table)
    return said


def plain_table(table):
    return dataclasses.asdict(table) | {"rows": [list(row) for row in table.rows]}


def rebuilt(said):
    """The task that plain data say."""
    return task_file._task("the task", said, said)


@cache
def solved(name):
    return gc.solve(builtin(name))

"""A task as the files from which it can be read again."""

from collections.abc import Mapping
from pathlib import PurePath
from typing import Any

import tomli_w

from graphcam.errors import DesignError
from graphcam.given.motion_law import Law
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.words import say

TASK_FILE = "task.toml"


def task_files(task: Task | ArcsTask) -> dict[str, str]:
    """The contents of a task's files by their names: TOML, and the table of a motion or of points of a cam.

    Raises
    ------
    DesignError : a phase follows a law of your own, which no file can name

    >>> import graphcam as gc
    >>> list(task_files(gc.builtin_task("measured")))
    ['task.toml', 'measured.csv']
    """
    if isinstance(task, Task):
        for k, phase in enumerate(task.motion.phases or ()):
            if isinstance(own := getattr(phase, "law", ""), Law):
                remedy = say("a law of one's own stands in Python only")
                raise DesignError(f"motion.phases[{k}].law", own.name, say("a built-in law in a file"), remedy)
    said = _without_defaults(task.to_dict())
    table = task.motion.table if isinstance(task, Task) else None
    tables: dict[str, str] = {}
    if table is not None:
        outlined = table.column == "outline"
        # The points of a drawing are written as a table.
        file = PurePath(table.file).with_suffix(".csv") if outlined else PurePath(table.file)
        name = said["motion"]["table"] = file.name
        rows = "".join(f"{phi!r},{value!r}\n" for phi, value in table.rows)
        head = "x_mm,y_mm" if outlined else f"phi_deg,{table.column}"
        tables[name] = f"{head}\n{rows}"
    return {TASK_FILE: tomli_w.dumps(said), **tables}


def _without_defaults(table: Mapping[str, Any]) -> dict[str, Any]:
    """A table of a task without its empty texts and tables, which are defaults."""
    filled = {key: _without_defaults(value) if isinstance(value, Mapping) else value for key, value in table.items()}
    return {key: value for key, value in filled.items() if value not in ("", {})}

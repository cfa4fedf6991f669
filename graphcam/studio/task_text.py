"""Tasks as the page has them, in plain data, and as task files: TOML text, no file of this machine."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from graphcam.given.table_file import CurveTable, Turn, table_from_text
from graphcam.studio.task_paths import table_in
from graphcam.studio.views_request import TaskRequest, read_request, task_in
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.motion_tables import tolerance_in
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import BUILTIN_TASK_NAMES, builtin_arcs_task, builtin_task, parse_toml
from graphcam.tasks.task_writer import TASK_FILE, task_files

Plain = dict[str, Any]
MAX_LENGTH = 500_000
"""Characters of a task file."""


ARCS_TASK = "arcs"
"""The built-in task of a cam of three circular arcs."""


@cache
def built_in_tasks() -> dict[str, dict[str, Any]]:
    """The tasks that come with graphcam, by their names; nobody changes them.

    >>> list(built_in_tasks())
    ['coursework', 'arm', 'flat', 'swinging-face', 'measured', 'arcs']
    """
    return {name: plain_task(builtin_task(name)) for name in BUILTIN_TASK_NAMES} | {
        ARCS_TASK: plain_task(builtin_arcs_task())
    }


def nearest_built_in(task: Task | ArcsTask) -> str:
    """The built-in task that is most like another: of the same kind of motion and follower.

    >>> import graphcam as gc
    >>> nearest_built_in(gc.builtin_task("flat")), nearest_built_in(gc.builtin_arcs_task())
    ('flat', 'arcs')
    """
    if isinstance(task, ArcsTask):
        return ARCS_TASK
    alike = {name: builtin_task(name) for name in BUILTIN_TASK_NAMES}
    kind, measured = task.follower.kind, task.motion.table is not None

    def likeness(name: str) -> tuple[bool, bool, bool]:
        """Whether all of it is alike, the kind of motion, and the follower; what comes first counts most."""
        other = alike[name]
        return other == task, (other.motion.table is not None) == measured, other.follower.kind == kind

    return max(alike, key=likeness)


def plain_task(task: Task | ArcsTask) -> Plain:
    """A task as the page holds it: with the keys of its file, the table of a measured motion in place of its name.

    >>> import graphcam as gc
    >>> plain_task(gc.builtin_task("measured"))["motion"]["table"]["rows"][:2]
    [[0.0, 0.0], [1.0, 0.0]]
    """
    said = task.to_dict()
    table = task.motion.table if isinstance(task, Task) else None
    if table is not None:
        said["motion"]["table"] = plain_table(table)
    return said


def page_config(task: Task | ArcsTask, language: str, **more: Any) -> Plain:
    """What every page of the studio must know of the task with which it opens, and more."""
    named = {"task": plain_task(task), "name": nearest_built_in(task), "builtin": built_in_tasks()}
    return {**named, "language": language, **more}


def plain_table(table: CurveTable) -> Plain:
    """The table of a measured motion as plain data."""
    return {"file": table.file, "column": table.column, "rows": [list(row) for row in table.rows]}


def task_file(request: Mapping[str, Any]) -> Plain:
    """The answer to "task_file": the text of a task's file, and the others that it names.

    Raises
    ------
    GraphcamError : it is no task

    >>> import graphcam as gc
    >>> found = task_file({"task": plain_task(gc.builtin_task())})
    >>> found["name"], found["text"].splitlines()[0]
    ('task.toml', 'rotation = "cw"')
    """
    asked = read_request(TaskRequest, request)
    files = task_files(task_in(asked.task, asked.language))
    return {"name": TASK_FILE, "text": files.pop(TASK_FILE), "files": files}


@dataclass(frozen=True, eq=False)
class OpenedFile:
    """The text of a task's file, and by their names those of the files that it names."""

    text: str = ""
    files: Mapping[str, Any] = field(default_factory=dict[str, Any])


def opened_task(request: Mapping[str, Any]) -> Plain:
    """The answer to "open": the task that the text of a file says.

    A file that names a table is given the table's text under ``files``, by its name.

    Raises
    ------
    GraphcamError : it is no TOML, or no task

    >>> import graphcam as gc
    >>> task = plain_task(gc.builtin_task("measured"))
    >>> files = task_file({"task": task})
    >>> opened_task({"text": files["text"], "files": files["files"]})["task"] == task
    True
    """
    opened = read_request(OpenedFile, request)
    data = parse_toml(TASK_FILE, opened.text[:MAX_LENGTH].encode())
    spoken = table_in(data, "drawing").get("language")
    data = _with_table(data, opened.files)
    return {"task": plain_task(task_in(data, spoken if isinstance(spoken, str) else "en"))}


def _with_table(data: Plain, files: Mapping[str, Any]) -> Plain:
    """The data with the table of a measured motion in place of its name, where its text is given."""
    motion = table_in(data, "motion")
    name = motion.get("table")
    if not isinstance(name, str) or not isinstance(files.get(name), str):
        return data
    table = table_from_text(files[name], name, name, tolerance_in(motion), Turn.given_in(motion))
    return {**data, "motion": {**motion, "table": plain_table(table)}}

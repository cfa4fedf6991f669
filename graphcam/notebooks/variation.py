"""A task with something changed: what a slider does, and what a reader tries out."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, TypeVar

from graphcam.errors import DesignError, nearest

AnyTask = TypeVar("AnyTask")


def changed(task: AnyTask, values: Mapping[str, Any]) -> AnyTask:
    """The task with other values, named as in its file: "drawing.divisions", "follower.offset", "rotation".

    >>> import graphcam as gc
    >>> changed(gc.builtin_task(), {"follower.offset": 12.0, "rotation": "ccw"}).follower.offset
    12.0

    Raises
    ------
    DesignError : the task has no such key, or its value cannot be
    """
    for name, value in values.items():
        task = _replaced(task, name, name.split("."), value)
    return task


def _replaced(table: Any, name: str, path: list[str], value: Any) -> Any:
    known = [field.name for field in dataclasses.fields(table) if field.init]
    if path[0] not in known:
        raise DesignError("key", name, "one of the task", nearest(path[0], known))
    if path[1:]:
        value = _replaced(getattr(table, path[0]), name, path[1:], value)
    return dataclasses.replace(table, **{path[0]: value})

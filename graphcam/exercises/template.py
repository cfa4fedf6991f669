"""A task with open places, and the parameters that fill them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from graphcam.errors import TaskError, nearest
from graphcam.exercises.exercise import Exercise, Value
from graphcam.task import Task
from graphcam.task_file import task_of

PLACE = re.compile(r"^\{(-?)([a-z_0-9]+)\}$")
"""A whole value of the template: a parameter's name in braces, perhaps with a minus."""
REST = "rest"
"""The angle that is missing of 360 degrees."""


def fill_in(exercise: Exercise, parameters: Mapping[str, Value], path: str = "") -> Task:
    """The task with these parameters.

    Raises
    ------
    TaskError : the template names a parameter that there is not, or no such task can be
    """
    path = path or f"exercise {exercise.name}"
    table = _filled(exercise.task, {**parameters, REST: f"{{{REST}}}"}, path)
    phases = table.get("motion", {}).get("phases", [])
    taken = sum(phase["angle"] for phase in phases if isinstance(phase.get("angle"), int | float))
    return task_of(path, _filled(table, {REST: 360 - taken}, path))


def sentence(text: str, parameters: Mapping[str, Value]) -> str:
    """A text of the exercise with its parameters.

    >>> sentence("A lift of {lift} mm.", {"lift": 30})
    'A lift of 30 mm.'
    """
    return re.sub(r"\{([a-z_0-9]+)\}", lambda place: _said(parameters.get(place[1], place[0])), text)


def _said(value: Value) -> str:
    return {"cw": "clockwise", "ccw": "counter-clockwise"}.get(str(value), str(value))


def _filled(node: Any, parameters: Mapping[str, Value], path: str) -> Any:
    if isinstance(node, Mapping):
        return {key: _filled(value, parameters, path) for key, value in node.items()}
    if isinstance(node, list | tuple):
        return [_filled(value, parameters, path) for value in node]
    place = PLACE.match(node) if isinstance(node, str) else None
    if place is None:
        return node
    sign, name = place.groups()
    if name not in parameters:
        raise TaskError(path, "task", node, "a parameter in braces", nearest(name, parameters))
    value = parameters[name]
    return -value if sign and not isinstance(value, str) else value

"""What one student gets of an exercise: a task with open places, and the parameters that fill them.

They are drawn from the course's secret and the student's name.
"""

import hmac
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphcam.constructions.axes import sense_caption
from graphcam.constructions.law_names import LAW_TITLES
from graphcam.errors import TaskError, nearest_word_remedy
from graphcam.exercises.definition.exercise import Exercise, Value
from graphcam.exercises.definition.marked_scale import MarkedDrawing
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import task_of
from graphcam.words import Tell, Words, say

PLACEHOLDER_PATTERN = re.compile(r"^(-?)\{(-?)([a-z_0-9]+)\}$")
"""A whole value of the template: a parameter's name in braces, perhaps with a minus."""
PARAMETER_PATTERN = re.compile(r"\{([a-z_0-9]+)\}")
"""A parameter's name in braces within a text."""
REMAINING_ANGLE = "rest"
"""The angle that is missing of 360 degrees."""


def fill_in(exercise: Exercise, parameters: Mapping[str, Value], path: str = "") -> Task:
    """The task with these parameters, its sheets in the language of the exercise.

    Raises
    ------
    TaskError : the template names a parameter that there is not, or no such task can be
    """
    path = path or f"exercise {exercise.name}"
    table = _filled_template(exercise.task, {**parameters, REMAINING_ANGLE: f"{{{REMAINING_ANGLE}}}"}, path)
    phases = table.get("motion", {}).get("phases", [])
    taken = sum(phase["angle"] for phase in phases if isinstance(phase.get("angle"), int | float))
    task = task_of(path, _filled_template(table, {REMAINING_ANGLE: 360 - taken}, path))
    # A photograph is read by the scale of the cam angle.
    drawing = replace(task.drawing, language=exercise.language, whole_turn=True)
    return replace(task, drawing=MarkedDrawing.of(drawing) if exercise.paper else drawing)


def sentence(text: str, parameters: Mapping[str, Value], tell: Tell = str) -> str:
    """A text of the exercise with its parameters, said in the language of the text.

    >>> sentence("A lift of {lift} mm; it turns {sense}.", {"lift": 0.5, "sense": "cw"})
    'A lift of 0.5 mm; it turns clockwise.'
    """
    return PARAMETER_PATTERN.sub(lambda place: tell(_value_text(parameters.get(place[1], place[0]))), text)


def _value_text(value: Value) -> Words:
    return {"cw": sense_caption("cw"), "ccw": sense_caption("ccw"), **LAW_TITLES}.get(
        str(value), say("{value}", value=value)
    )


def _filled_template(node: Any, parameters: Mapping[str, Value], path: str) -> Any:
    if isinstance(node, Mapping):
        return {key: _filled_template(value, parameters, path) for key, value in node.items()}
    if isinstance(node, list | tuple):
        return [_filled_template(value, parameters, path) for value in node]
    if not isinstance(node, str):
        return node

    def value_of(name: str) -> Value:
        """The value of a parameter, which must be one of the variant."""
        if name not in parameters:
            raise TaskError(path, "task", node, say("a parameter in braces"), nearest_word_remedy(name, parameters))
        return parameters[name]

    if place := PLACEHOLDER_PATTERN.match(node):
        *signs, name = place.groups()
        value = value_of(name)
        return -value if signs[0] != signs[1] and not isinstance(value, str) else value
    return PARAMETER_PATTERN.sub(lambda each: str(value_of(each[1])), node)


@dataclass(frozen=True)
class Variant:
    """One student's exercise, with the parameters that were drawn.

    draw : how often the parameters were drawn until every mistake could be told
    """

    exercise: Exercise
    student: str
    draw: int
    parameters: Mapping[str, Value]

    @cached_property
    def task(self) -> Task:
        """The task with these parameters."""
        return fill_in(self.exercise, self.parameters)


def drawn(exercise: Exercise, student: str, secret: bytes, draw: int) -> Variant:
    """The parameters of one draw, which only the secret's owner can tell beforehand.

    They are whole numbers out of HMAC-SHA256, so they are the same on every machine and with every version.
    """
    # JSON in ASCII keeps texts apart that a mere join would run together, and takes any text at all.
    message = json.dumps([exercise.name, exercise.version, student, draw]).encode("ascii")
    number = int.from_bytes(hmac.digest(secret, message, "sha256"))
    parameters: dict[str, Value] = {}
    for name in sorted(exercise.parameters):
        values = exercise.parameters[name].values
        number, place = divmod(number, len(values))
        parameters[name] = values[place]
    return Variant(exercise, student, draw, parameters)

"""What one student gets of an exercise: parameters drawn from the course's secret and the student's name."""

from __future__ import annotations

import hmac
import json
from collections.abc import Mapping
from dataclasses import dataclass

from graphcam.exercises.definition.exercise import Exercise, Value
from graphcam.exercises.definition.template import fill_in
from graphcam.tasks.task import Task


@dataclass(frozen=True)
class Variant:
    """One student's exercise.

    draw : how often the parameters were drawn until every mistake could be told
    """

    exercise: Exercise
    student: str
    draw: int
    parameters: Mapping[str, Value]

    @property
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

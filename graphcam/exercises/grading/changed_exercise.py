"""Whether an exercise still draws the variants that were handed out."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import AnswerKeys, KeysAsNeeded
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.words import say

COMPARED_KEYS = 5
"""Answer keys that are compared; one that somebody has changed alone is made again."""
CHANGED_EXERCISE_REMEDY = say("put the file back as it was; marks, caps and texts may change")


def check_unchanged(exercise: Exercise, kept: AnswerKeys, students: Iterable[str], secret: bytes) -> None:
    """Refuse an exercise that was changed so that every student would have another variant than that on the handout.

    Raises
    ------
    TaskError : the kept answer keys are of other parameters or of another version than the exercise draws
    """
    place = str(Path(kept.exercise() or exercise.name))
    others: list[str] = []
    for known in _comparable_keys(kept, students, exercise.name):
        now = drawn(exercise, known.student, secret, known.draw).parameters
        if known.version != exercise.version:
            others.append("version")
        elif dict(known.parameters) != dict(now):
            changed = [name for name in {**known.parameters, **now} if known.parameters.get(name) != now.get(name)]
            others.append(f"parameters.{min(changed)}")
        else:
            return
    if others:
        raise TaskError(
            place, others[0], say("changed"), say("as it was when the handouts were made"), CHANGED_EXERCISE_REMEDY
        )


def _comparable_keys(kept: AnswerKeys, students: Iterable[str], name: str) -> list[AnswerKey]:
    """The first answer keys that are kept, are of the exercise, and can be read."""
    found: list[AnswerKey] = []
    keys = KeysAsNeeded(kept, ())
    for student in students:
        known = keys.get(student)
        if known is not None and (known.exercise, known.student) == (name, student):
            found.append(known)
        if len(found) == COMPARED_KEYS:
            break
    return found

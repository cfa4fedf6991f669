"""Marking: arithmetic on the certificate, the same result whenever and wherever it is done."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from graphcam.exercises.definition.answers import Answers, Given
from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.expectation import Expected, Off
from graphcam.exercises.marking.diagnosis import Seen, diagnose
from graphcam.exercises.marking.feedback import feedback
from graphcam.exercises.marking.record import Marked, Outcome, Record

FEWEST_DRAWN = 3
"""So many drawn answers it takes to remark that they are too exact."""
SMALL = 8.0
"""A key of fewer tolerances is no length that grows with a scale: its tolerance would grow without bounds."""


def mark(exercise: Exercise, answer_key: AnswerKey, answers: Answers, *, level: str = "L0") -> Record:
    """Mark one hand-in.

    An answer is right within the tolerance of the key.  Else it earns its marks as follow-through where it lies within
    the tolerance of what follows from the student's own earlier answers, or where the diagnosed mistake was made in an
    earlier step and everything since was done right: one slip costs its own step only.  From an absurd earlier answer
    nothing follows, and nought follows from nothing.

    answers : untrusted data; whatever it holds, there is one record
    level : how the answers were come by, for the record

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.key.issuing import issue
    >>> exercise = find_exercise("acceleration-and-scales")
    >>> variant, answer_key = issue(exercise, "Anna", b"secret")
    >>> mark(exercise, answer_key, Answers({"mu_s": float("nan")})).total
    0.0
    """
    keys = [answer_key.keys[asked.name].expected for asked in exercise.answers]
    readable = {asked.name: _readable(asked, answers) for asked in exercise.answers}
    seen = [(k, a, given) for k, a in enumerate(exercise.answers) if (given := readable[a.name]) is not None]
    found = {k: keys[k].off(given, asked.kind, answer_key.bound) for k, asked, given in seen}
    off = {k: each.deviation for k, each in found.items()}
    wrong = {k for k in off if not abs(off[k]) <= answer_key.bound}
    diagnosed = diagnose(answer_key, keys, seen, off, wrong) if wrong else None
    diagnosis, explained = diagnosed or (None, frozenset[int]())
    following = _following(answer_key, keys, seen, wrong, explained) if wrong else set[int]()
    marked = tuple(
        _marked(asked, readable[asked.name], _outcome(k, asked, answers, off, wrong, following), found.get(k))
        for k, asked in enumerate(exercise.answers)
    )
    exact = _too_exact(answer_key, exercise, off)
    return Record(
        student=answer_key.student,
        exercise=answer_key.exercise,
        version=answer_key.version,
        draw=answer_key.draw,
        parameters=answer_key.parameters,
        answers=marked,
        total=sum(each.marks for each in marked),
        of=exercise.marks,
        diagnosis=diagnosis,
        too_exact=exact,
        feedback=feedback(exercise, marked, answers, diagnosis),
        notes=tuple(map(exercise.tell, answers.notes)),
        level=level,
    )


def _readable(asked: Asked, answers: Answers) -> Given | None:
    """The answer as a finite number or as points, None where it is neither."""
    given = answers.values.get(asked.name)
    if asked.kind == "number":
        if isinstance(given, bool) or not isinstance(given, int | float):
            return None
        return float(given) if abs(given) <= _LARGEST else None
    if not isinstance(given, np.ndarray) or given.ndim != 1 or not 0 < given.size <= _MOST_POINTS:
        return None
    # Compared this way round, for a NaN is not less than anything.
    fits = np.issubdtype(given.dtype, np.number) and bool((np.abs(given) <= _LARGEST).all())
    return given.astype(np.complex128) if fits else None


_MOST_POINTS = 20_000
"""No curve by hand has more, and no hand-in shall keep the marking busy."""
_LARGEST = 1e15
"""No reading is larger, and no number up to here makes the arithmetic overflow."""


def _outcome(
    k: int, asked: Asked, answers: Answers, off: Mapping[int, float], wrong: set[int], following: set[int]
) -> Outcome:
    if k not in off:
        unread = asked.name in answers.values or asked.name in answers.problems
        return "unreadable" if unread else "missing"
    if k not in wrong:
        return "right"
    return "follow-through" if k in following else "wrong"


def _following(
    answer_key: AnswerKey,
    keys: Sequence[Expected],
    seen: Seen,
    wrong: set[int],
    explained: frozenset[int],
) -> set[int]:
    """The wrong answers that follow from the student's own earlier ones.

    explained : those that the diagnosed mistake brings
    """
    found: set[int] = set()
    own: dict[str, float] = {}
    first = min(wrong)
    shown = min(explained, default=len(keys))
    for k, asked, given in seen:
        # Once the mistake has shown in the student's own answers, what it brings with it is a consequence.
        caused = k > shown and k in explained
        if k in wrong and k > first and (caused or _follows(answer_key, keys[k], asked, given, own)):
            found.add(k)
        if isinstance(given, float):
            own[asked.name] = given
    return found


def _follows(answer_key: AnswerKey, key: Expected, asked: Asked, given: Given, own: Mapping[str, float]) -> bool:
    dependence = answer_key.dependences.get(asked.name)
    if dependence is None or not isinstance(given, float) or not isinstance(key.value, float):
        return False
    expected = dependence.expected(key.value, own)
    tolerance = answer_key.bound * float(key.scatter)
    # Nought follows from too much that was never drawn.
    if abs(given) <= tolerance < abs(key.value):
        return False
    if dependence.together == "product" and not asked.unit.startswith("deg"):
        # A hand's error grows with the lengths that a wrong scale makes, and does not shrink with them.
        tolerance *= max(1.0, abs(expected) / max(abs(key.value), SMALL * tolerance))
    return abs(given - expected) <= tolerance


def _marked(asked: Asked, given: Given | None, outcome: Outcome, off: Off | None) -> Marked:
    earned = asked.marks if outcome in ("right", "follow-through") else 0.0
    deviation, station, paper = off or (None, None, None)
    points: list[Any] | None = [[z.real, z.imag] for z in given.tolist()] if isinstance(given, np.ndarray) else None
    said = given if points is None else points
    return Marked(asked.name, outcome, earned, asked.marks, said, deviation, station, paper)


def _too_exact(answer_key: AnswerKey, exercise: Exercise, off: Mapping[int, float]) -> bool:
    drawn = [off[k] for k, asked in enumerate(exercise.answers) if answer_key.keys[asked.name].drawn and k in off]
    if len(drawn) < FEWEST_DRAWN:
        return False
    return math.sqrt(sum(each**2 for each in drawn) / len(drawn)) < answer_key.too_exact

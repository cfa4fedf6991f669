"""What a group's records have in common: errors per step, mistakes, and what was lost by what."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from graphcam.exercises.definition.exercise import Asked, Exercise

EDGE = 8.0
"""Pencil units that the diagrams show; what is farther off is counted in the last bar."""
BARS = 32


@dataclass(frozen=True)
class StepErrors:
    """One answer over all students.

    outcomes : how many of each kind that there are
    bars : of every outcome that has a deviation, how many lie in each of the bars from -EDGE to EDGE pencil units
    earned : part of the marks that were earned
    """

    asked: Asked
    outcomes: Counter[str]
    bars: dict[str, list[int]]
    earned: float


@dataclass(frozen=True)
class Mistake:
    """A catalogued mistake: who made it, and what it cost."""

    name: str
    students: tuple[str, ...]
    lost: float


def step_errors(exercise: Exercise, records: Sequence[dict[str, Any]]) -> list[StepErrors]:
    """The errors of every step, in the order of the construction."""
    answers = [answer for record in records for answer in record["answers"]]
    return [_step(asked, [each for each in answers if each["name"] == asked.name]) for asked in exercise.answers]


def _step(asked: Asked, answers: list[dict[str, Any]]) -> StepErrors:
    bars = {outcome: [0] * BARS for outcome in ("right", "follow-through", "wrong")}
    for answer in answers:
        if answer["outcome"] in bars:
            bars[answer["outcome"]][bar_of(answer["deviation"])] += 1
    possible = sum(answer["of"] for answer in answers)
    earned = sum(answer["marks"] for answer in answers) / possible if possible else 0.0
    return StepErrors(asked, Counter(answer["outcome"] for answer in answers), bars, earned)


def bar_of(deviation: float | None) -> int:
    """The bar for a deviation in pencil units; one that cannot be said is beyond all others.

    >>> bar_of(0.1), bar_of(-100.0), bar_of(None)
    (16, 0, 31)
    """
    if deviation is None or not math.isfinite(deviation):
        return BARS - 1
    return min(max(int((deviation + EDGE) / (2 * EDGE) * BARS), 0), BARS - 1)


def mistakes(records: Sequence[dict[str, Any]]) -> list[Mistake]:
    """The diagnosed mistakes, the costliest first."""
    found: dict[str, list[dict[str, Any]]] = {}
    for record in records:
        if record["diagnosis"]:
            found.setdefault(record["diagnosis"]["misconception"], []).append(record)
    listed = [
        Mistake(name, tuple(each["student"] for each in made), sum(each["of"] - each["total"] for each in made))
        for name, made in found.items()
    ]
    return sorted(listed, key=lambda mistake: (-len(mistake.students), -mistake.lost, mistake.name))

"""What the marks of a group say of the questions: difficulty, discrimination, reliability, whose variant was harder.

Source: Cronbach 1951, Coefficient alpha and the internal structure of tests.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.exercises.definition.exercise import Value

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ItemStatistics:
    """One answer over a group.

    difficulty : part of its marks that the group earned; small where it is hard
    discrimination : correlation of its marks with those of all other answers together; NaN where either never differs
    alpha_without : Cronbach's alpha of the other answers; near or above that of all, the answer adds nothing to it
    """

    name: str
    answered: int
    difficulty: float
    discrimination: float
    alpha_without: float


@dataclass(frozen=True)
class VariantGroup:
    """The students whose variants agree in one parameter: its value, or the half of its values that theirs is in.

    earned : part of all marks
    """

    parameter: str
    values: str
    students: int
    earned: float


def earned_parts(records: Sequence[dict[str, Any]]) -> Floats:
    """The part of its marks that every answer earned (students, answers)."""
    rows = [[answer["marks"] / answer["of"] for answer in record["answers"]] for record in records]
    return np.array(rows, dtype=np.float64).reshape(len(rows), -1)


def cronbach_alpha(marks: Floats) -> float:
    """Cronbach's alpha of marks (students, answers): 1 where all measure one thing; NaN for one answer or equal totals.

    >>> round(cronbach_alpha(np.array([[1.0, 1], [2, 2], [3, 3]])), 6)
    1.0
    """
    students, items = marks.shape if marks.ndim == 2 else (0, 0)
    total = float(np.var(marks.sum(axis=1))) if students else 0.0
    if items < 2 or total <= _rounding_of_sum(marks):
        return math.nan
    return items / (items - 1) * (1 - float(np.var(marks, axis=0).sum()) / total)


def item_statistics(records: Sequence[dict[str, Any]]) -> list[ItemStatistics]:
    """The statistics of every answer, in the order of the exercise; of no record nothing."""
    if not records:
        return []
    parts = earned_parts(records)
    marks = parts * [answer["of"] for answer in records[0]["answers"]]
    answered = [sum(record["answers"][k]["given"] is not None for record in records) for k in range(parts.shape[1])]
    found: list[ItemStatistics] = []
    for k, answer in enumerate(records[0]["answers"]):
        others = np.delete(marks, k, axis=1)
        told = _correlation(marks[:, k], others.sum(axis=1))
        found.append(
            ItemStatistics(answer["name"], answered[k], float(parts[:, k].mean()), told, cronbach_alpha(others))
        )
    return found


def variant_groups(records: Sequence[dict[str, Any]], spelled: Callable[[Value], str]) -> list[VariantGroup]:
    """What the students earned by the parameters of their variants, a parameter after the other.

    Words are told one by one; numbers in a lower and an upper half, each about as large, where they differ at all.

    spelled : how a value is written
    """
    known = [record for record in records if record["parameters"]]
    earned = np.array([record["total"] / record["of"] for record in known])
    found: list[VariantGroup] = []
    for name in known[0]["parameters"] if known else ():
        values = [record["parameters"][name] for record in known]
        for said, chosen in _groups_by_value(values, spelled):
            found.append(VariantGroup(name, said, int(chosen.sum()), float(earned[chosen].mean())))
    return found


def _groups_by_value(values: list[Value], spelled: Callable[[Value], str]) -> list[tuple[str, NDArray[np.bool_]]]:
    words = sorted({value for value in values if isinstance(value, str)})
    steps = sorted({value for value in values if not isinstance(value, str)})
    single: list[Value] = [*steps, *words]
    if len(single) < 2:
        return []
    if words or len(steps) == 2:
        return [(spelled(value), np.array([each == value for each in values])) for value in single]
    numbers = np.array([value for value in values if not isinstance(value, str)], dtype=np.float64)
    below = np.array([np.count_nonzero(numbers <= step) for step in steps[:-1]])
    last = int(np.argmin(np.abs(below - numbers.size / 2)))
    lower = numbers <= steps[last]
    parts = ((steps[: last + 1], lower), (steps[last + 1 :], ~lower))
    return [(f"{spelled(part[0])} … {spelled(part[-1])}", chosen) for part, chosen in parts]


def _correlation(a: Floats, b: Floats) -> float:
    a, b = a - a.mean(), b - b.mean()
    size = math.sqrt(float(a @ a) * float(b @ b))
    return float(a @ b) / size if size > _rounding_of_sum(a) + _rounding_of_sum(b) else math.nan


def _rounding_of_sum(values: Floats) -> float:
    """What rounding may leave of a sum of squares that is nought."""
    return 1e-12 * float(1 + np.sum(values * values))

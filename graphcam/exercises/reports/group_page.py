"""The report on a group: how far off each step was, which mistakes were made, and what to teach again."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from statistics import median
from typing import Any

import numpy as np

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.misconceptions import misconception
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.charts import Chart, stacked
from graphcam.exercises.reports.curves import CurvePicture, picture, points_of, worst_place
from graphcam.exercises.reports.statistics import EDGE, StepErrors, mistakes, step_errors
from graphcam.exercises.reports.web_pages import page
from graphcam.words import say

WEAK = 0.8
"""A step that earned less than this part of its marks is taught again."""
COMMON = 0.05
"""A mistake that at least this part of the group made is taught again."""
LARGEST_PICTURES = 6
"""Drawings that are shown singly for each curve: those farthest off."""


def group_page(exercise: Exercise, records: Sequence[dict[str, Any]], answer_keys: Mapping[str, AnswerKey]) -> str:
    """The report as one HTML page, for the teacher alone: it shows keys.

    answer_keys : by student, as far as they are known
    """
    steps, found = step_errors(exercise, records), mistakes(records)
    bound = median(each.bound for each in answer_keys.values()) if answer_keys else 0.0
    return page(
        "group.html",
        exercise,
        records=records,
        average=sum(record["total"] for record in records) / len(records) if records else math.nan,
        levels=sorted({record["level"] for record in records}) or ["–"],
        # What most lost marks by: mistakes that several made, then steps that stay weak.
        common=[mistake for mistake in found if len(mistake.students) >= max(1, COMMON * len(records))],
        weak=sorted((step for step in steps if step.earned < WEAK), key=lambda step: step.earned),
        marks=_marks(exercise, records),
        steps=[(step, _chart(step, bound)) for step in steps],
        mistakes=found,
        said={mistake.name: misconception(mistake.name).said for mistake in found},
        pictures=_pictures(exercise, records, answer_keys),
    )


def _marks(exercise: Exercise, records: Sequence[dict[str, Any]]) -> Chart:
    bars = [0] * 21
    for record in records:
        bars[round(20 * record["total"] / record["of"])] += 1
    ticks = [(part, exercise.tell(say("{marks:g}", marks=part * exercise.marks))) for part in (0.0, 0.5, 1.0)]
    return stacked({"right": bars}, ticks)


def _chart(step: StepErrors, bound: float) -> Chart:
    ticks = [((k + EDGE) / (2 * EDGE), f"{k:+g}".replace("-", "−") if k else "0") for k in range(-6, 7, 2)]
    ends = [(0.0, f"< −{EDGE:g}"), (1.0, f"> {EDGE:g}")]
    inside = min(bound / EDGE, 1.0) / 2
    return stacked(step.bars, [*ends, *ticks], (0.5 - inside, 0.5 + inside))


def _pictures(
    exercise: Exercise, records: Sequence[dict[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> list[tuple[str, dict[str, Any], CurvePicture]]:
    """Of every answer that is drawn those farthest off: the student, the answer, and how it looks."""
    known = [record for record in records if record["student"] in answer_keys]
    answers = [(record["student"], answer) for record in known for answer in record["answers"]]
    drawn = [(student, answer) for student, answer in answers if answer["off_paper"] is not None]
    drawn.sort(key=lambda each: -each[1]["off_paper"])
    shown: list[tuple[str, dict[str, Any], CurvePicture]] = []
    for asked in exercise.answers:
        for student, answer in [each for each in drawn if each[1]["name"] == asked.name][:LARGEST_PICTURES]:
            key = answer_keys[student].keys[asked.name].expected
            # The key knows the stations; what lies between them is not straight.
            stations = np.atleast_1d(np.asarray(key.value))
            curves = [("key", stations, False), ("own", points_of(answer), asked.kind == "curve")]
            shown.append((student, answer, picture(curves, worst_place(key, answer, asked.kind))))
    return shown

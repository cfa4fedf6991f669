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
from graphcam.exercises.reports.phrases import spoken
from graphcam.exercises.reports.statistics import EDGE, Mistake, StepErrors, mistakes, step_errors
from graphcam.exercises.reports.web_pages import page
from graphcam.words import Caption, Tell, say

WORDS = {
    "again": say("What to teach again"), "nothing": say("Nothing: every step earned most of its marks."),
    "marks": say("Marks"), "steps": say("Errors, step by step"),
    "steps_note": say("In pencil units: 1 is the standard deviation of a careful hand. Shaded: what is accepted."),
    "mistakes": say("Mistakes that explain the answers"), "mistake": say("Mistake"), "students": say("Students"),
    "lost": say("Marks lost"), "who": say("Who"), "no_mistakes": say("No catalogued mistake was found."),
    "pictures": say("Drawings over the key"), "look": say("To be looked at"),
}  # fmt: skip
WEAK = 0.8
"""A step that earned less than this part of its marks is taught again."""
COMMON = 0.05
"""A mistake that at least this part of the group made is taught again."""
LARGEST_PICTURES = 6
"""Drawings that are shown singly for each curve: those farthest off."""


def group_page(exercise: Exercise, records: Sequence[dict[str, Any]], answer_keys: Mapping[str, AnswerKey]) -> str:
    """The report as one HTML page, for the teacher alone: it shows keys.

    certificates : by student, as far as they are known
    """
    steps, found, tell = step_errors(exercise, records), mistakes(records), exercise.tell
    bound = median(each.bound for each in answer_keys.values()) if answer_keys else 0.0
    return page(
        "group.html", language=exercise.language, title=exercise.title, summary=tell(_summary(records)),
        words=spoken(WORDS, tell), again=[tell(caption) for caption in _again(exercise, steps, found, len(records))],
        marks=_marks(exercise, records), steps=[_step(step, bound, len(records), tell) for step in steps],
        mistakes=[_mistake(mistake, tell) for mistake in found],
        pictures=[(tell(caption), drawn) for caption, drawn in _pictures(exercise, records, answer_keys)],
        advised=[tell(caption) for caption in _advised(records)],
    )  # fmt: skip


def _summary(records: Sequence[dict[str, Any]]) -> Caption:
    levels = ", ".join(sorted({record["level"] for record in records})) or "–"
    mean = sum(record["total"] for record in records) / len(records) if records else math.nan
    of = max((record["of"] for record in records), default=0.0)
    return say("{count} hand-ins, {mean:.1f} of {of:g} marks on average; graded at level {levels}.",
               count=len(records), mean=mean, of=of, levels=levels)  # fmt: skip


def _again(exercise: Exercise, steps: list[StepErrors], found: list[Mistake], count: int) -> list[Caption]:
    """What most lost marks by: mistakes that several made, then steps that stay weak."""
    said = [
        say("{count} of {all}: {mistake}", count=len(mistake.students), all=count,
            mistake=misconception(mistake.name).said)
        for mistake in found if len(mistake.students) >= max(1, COMMON * count)
    ]  # fmt: skip
    weak = sorted((step for step in steps if step.earned < WEAK), key=lambda step: step.earned)
    said += [
        say("{part:.0f} % of the marks for: {step}", part=100 * step.earned, step=step.asked.text) for step in weak
    ]
    return said


def _marks(exercise: Exercise, records: Sequence[dict[str, Any]]) -> Chart:
    bars = [0] * 21
    for record in records:
        bars[round(20 * record["total"] / record["of"])] += 1
    ticks = [(part, exercise.tell(say("{marks:g}", marks=part * exercise.marks))) for part in (0.0, 0.5, 1.0)]
    return stacked({"right": bars}, ticks)


def _step(step: StepErrors, bound: float, count: int, tell: Tell) -> dict[str, Any]:
    ticks = [((k + EDGE) / (2 * EDGE), f"{k:+g}".replace("-", "−") if k else "0") for k in range(-6, 7, 2)]
    ends = [(0.0, f"< −{EDGE:g}"), (1.0, f"> {EDGE:g}")]
    inside = min(bound / EDGE, 1.0) / 2
    shown = say("{right} right, {follow} followed from own values, {wrong} off, {rest} not given or not readable",
                right=step.outcomes["right"], follow=step.outcomes["follow-through"], wrong=step.outcomes["wrong"],
                rest=step.outcomes["unreadable"] + step.outcomes["missing"])  # fmt: skip
    chart = stacked(step.bars, [*ends, *ticks], (0.5 - inside, 0.5 + inside))
    return {"text": f"{step.asked.name}. {step.asked.text}", "summary": tell(shown), "chart": chart}


def _mistake(mistake: Mistake, tell: Tell) -> dict[str, Any]:
    who = ", ".join(mistake.students[:12]) + (" …" if len(mistake.students) > 12 else "")
    return {"text": tell(misconception(mistake.name).said), "count": len(mistake.students),
            "lost": tell(say("{marks:g}", marks=mistake.lost)), "who": who}  # fmt: skip


def _pictures(
    exercise: Exercise, records: Sequence[dict[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> list[tuple[Caption, CurvePicture]]:
    shown: list[tuple[Caption, CurvePicture]] = []
    for asked in exercise.answers:
        drawn = [
            (record["student"], answer) for record in records if record["student"] in answer_keys
            for answer in record["answers"] if answer["name"] == asked.name and answer["off_paper"] is not None
        ]  # fmt: skip
        drawn.sort(key=lambda one: -one[1]["off_paper"])
        for student, answer in drawn[:LARGEST_PICTURES]:
            key = answer_keys[student].keys[asked.name].expected
            # The key knows the stations; what lies between them is not straight.
            stations = np.atleast_1d(np.asarray(key.value))
            curves = [("key", stations, False), ("own", points_of(answer), asked.kind == "curve")]
            caption = say("{name}, {student}: {off:.2f} mm off at most (key blue, drawing red).", name=asked.name,
                          student=student, off=answer["off_paper"])  # fmt: skip
            shown.append((caption, picture(curves, worst_place(key, answer, asked.kind))))
    return shown


def _advised(records: Sequence[dict[str, Any]]) -> list[Caption]:
    exact = [say("{student}: the answers are nearer to the key than a hand can draw.", student=record["student"])
             for record in records if record["too_exact"]]  # fmt: skip
    noted = [say("{student}: {note}", student=record["student"], note=note)
             for record in records for note in record["notes"]]  # fmt: skip
    return exact + noted

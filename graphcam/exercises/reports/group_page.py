"""The report on a group: how far off each step was, which mistakes were made, and what to teach again."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np

from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.curves import CurvePicture, picture, points_of, worst_place
from graphcam.exercises.reports.web_pages import page
from graphcam.words import say

WIDTH, HEIGHT, LETTERS = 640, 70, 18
"""Pixels: of the chart, and of the line of labels under it."""
EDGE = 8.0
"""Pencil units that the diagrams show; what is farther off is counted in the last bar."""
BARS = 32
WEAK = 0.8
"""A step that earned less than this part of its marks is taught again."""
COMMON = 0.05
"""A mistake that at least this part of the group made is taught again."""
LARGEST_PICTURES = 6
"""Drawings that are shown singly for each curve: those farthest off."""


@dataclass(frozen=True)
class Bar:
    """One box, in pixels from the upper left corner; ``kind`` is its class for a colour."""

    kind: str
    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True)
class Chart:
    """Stacked bars over a base line; labels are (x, anchor, text); ``band`` (x, width) is shaded."""

    bars: tuple[Bar, ...]
    labels: tuple[tuple[float, str, str], ...]
    band: tuple[float, float] | None = None
    width: int = WIDTH
    height: int = HEIGHT + LETTERS
    base: int = HEIGHT


def stacked(
    counts: Mapping[str, Sequence[int]], labels: Sequence[tuple[float, str]], band: tuple[float, float] | None = None
) -> Chart:
    """A chart of counts a bar, of several kinds one on the other.

    labels : (part of the width, text);  band : from, to as parts of the width

    >>> chart = stacked({"right": [1, 2]}, [(0.5, "0")])
    >>> chart.bars[1].height, chart.labels
    (64.0, ((320.0, 'middle', '0'),))
    """
    size = len(next(iter(counts.values())))
    highest = max([sum(column) for column in zip(*counts.values(), strict=True)] + [1])
    unit, step = (HEIGHT - 6) / highest, WIDTH / size
    bars: list[Bar] = []
    for k in range(size):
        top = float(HEIGHT)
        for kind, column in counts.items():
            if column[k]:
                height = unit * column[k]
                top -= height
                bars.append(Bar(kind, *(round(length, 2) for length in (k * step + 1, top, step - 2, height))))
    anchors = {0.0: "start", 1.0: "end"}
    placed = tuple((part * WIDTH, anchors.get(part, "middle"), text) for part, text in labels)
    return Chart(tuple(bars), placed, band and (band[0] * WIDTH, (band[1] - band[0]) * WIDTH))


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

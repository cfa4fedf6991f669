"""The report on a group: how far off each step was, which mistakes were made, and what to teach again."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Any

import numpy as np

from graphcam.exercises.course.submissions import Refused
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise, Kind
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.key.answer_key import AnswerKey, Key
from graphcam.exercises.key.expected_answers import Floats
from graphcam.exercises.marking.copy_detection import FALSE_ALARM_RATE, AlikePair
from graphcam.exercises.marking.exactness import REMARK_RATE
from graphcam.exercises.marking.record import is_handed_in
from graphcam.exercises.reports.item_statistics import cronbach_alpha, earned_parts, item_statistics, variant_groups
from graphcam.exercises.reports.unrolled_drawings import (
    Bundle,
    CurvePicture,
    bundle,
    deviations_along,
    over_key,
    points_of,
    worst_place,
)
from graphcam.exercises.reports.web_pages import page
from graphcam.words import Caption, Words, say, sequence


@dataclass(frozen=True)
class StudentRow:
    """The row of one student in the table of a group.

    marks : None of one who has not handed in;  of : possible
    remarks : what a teacher should look at;  link : the student's page; empty where there is none
    """

    student: str
    name: str
    marks: float | None
    of: float
    by_hand: bool = False
    remarks: tuple[Words, ...] = ()
    link: str = ""


NOTHING: Caption = say("not handed in")
UNREADABLE_REMARK: Caption = say("no answer can be read; the student's page says why")
UNANSWERED_OUTCOMES = ("missing", "unreadable")
"""Outcomes of an answer of which nothing can be marked."""


def student_rows(
    records: Sequence[Mapping[str, Any]], names: Mapping[str, str], links: Mapping[str, str], of: float
) -> list[StudentRow]:
    """A row a student: of the records, and of those who have a name and no record, by their ids.

    of : the possible marks
    """
    rows = {one["student"]: _row(one, names.get(one["student"], ""), links.get(one["student"], "")) for one in records}
    missing = {student: StudentRow(student, name, None, of, remarks=(NOTHING,)) for student, name in names.items()}
    return [row for _, row in sorted((missing | rows).items())]


def _row(record: Mapping[str, Any], name: str, link: str) -> StudentRow:
    remarks: list[Words] = list(record["notes"])
    if not is_handed_in(record):
        # The last one says that there is no answer; those before it say why.
        why = tuple(remarks[:-1]) or (NOTHING,)
        return StudentRow(record["student"], name, None, record["of"], remarks=why, link=link)
    if record["too_exact"]:
        remarks.append(say("as exact as a program"))
    if is_unanswered(record):
        remarks.insert(0, UNREADABLE_REMARK)
    by_hand = "overrides" in record
    return StudentRow(record["student"], name, record["total"], record["of"], by_hand, tuple(remarks), link)


def is_unanswered(record: Mapping[str, Any]) -> bool:
    """Whether something was handed in and no answer of it can be marked, nor is anything given by hand."""
    nothing = all(answer["outcome"] in UNANSWERED_OUTCOMES for answer in record["answers"])
    return is_handed_in(record) and nothing and "overrides" not in record


CHART_WIDTH, CHART_HEIGHT, LABEL_LINE_HEIGHT = 640, 70, 18
"""Pixels: of the chart, and of the line of labels under it."""
CHART_LIMIT = 8.0
"""Pencil units that the diagrams show; what is farther off is counted in the last bar."""
BAR_COUNT = 32
WEAK_SHARE = 0.8
"""A step that earned less than this part of its marks is taught again."""
COMMON_MISTAKE_SHARE = 0.05
"""A mistake that at least this part of the group made is taught again."""
SHOWN_PICTURES = 6
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
    width: int = CHART_WIDTH
    height: int = CHART_HEIGHT + LABEL_LINE_HEIGHT
    base: int = CHART_HEIGHT


def stacked_chart(
    counts: Mapping[str, Sequence[int]], labels: Sequence[tuple[float, str]], band: tuple[float, float] | None = None
) -> Chart:
    """A chart of counts a bar, of several kinds one on the other.

    labels : (part of the width, text);  band : from, to as parts of the width

    >>> chart = stacked_chart({"right": [1, 2]}, [(0.5, "0")])
    >>> chart.bars[1].height, chart.labels
    (64.0, ((320.0, 'middle', '0'),))
    """
    size = len(next(iter(counts.values())))
    highest = max([sum(column) for column in zip(*counts.values(), strict=True)] + [1])
    unit, step = (CHART_HEIGHT - 6) / highest, CHART_WIDTH / size
    bars: list[Bar] = []
    for k in range(size):
        top = float(CHART_HEIGHT)
        for kind, column in counts.items():
            if column[k]:
                height = unit * column[k]
                top -= height
                bars.append(Bar(kind, *(round(length, 2) for length in (k * step + 1, top, step - 2, height))))
    anchors = {0.0: "start", 1.0: "end"}
    placed = tuple((part * CHART_WIDTH, anchors.get(part, "middle"), text) for part, text in labels)
    return Chart(tuple(bars), placed, band and (band[0] * CHART_WIDTH, (band[1] - band[0]) * CHART_WIDTH))


@dataclass(frozen=True)
class StepErrors:
    """One answer over all students.

    outcomes : how many of each kind that there are
    bars : of every outcome that has a deviation, how many lie in each of the bars from -CHART_LIMIT to CHART_LIMIT
        pencil units
    earned : part of the marks that were earned
    """

    asked: AskedAnswer
    outcomes: Counter[str]
    bars: dict[str, list[int]]
    earned: float


@dataclass(frozen=True)
class Mistake:
    """A catalogued mistake, or several that were named together: who made it, and what it cost."""

    names: tuple[str, ...]
    students: tuple[str, ...]
    lost: float


@dataclass(frozen=True, eq=False)
class HandedInDrawing:
    """What a student drew as an answer, as its record has it, and what was right."""

    student: str
    kind: Kind
    answer: dict[str, Any]
    key: Key


def step_errors(exercise: Exercise, records: Sequence[dict[str, Any]]) -> list[StepErrors]:
    """The errors of every step, in the order of the construction."""
    answers = [answer for record in records for answer in record["answers"]]
    return [_step(asked, [each for each in answers if each["name"] == asked.name]) for asked in exercise.answers]


def _step(asked: AskedAnswer, answers: list[dict[str, Any]]) -> StepErrors:
    bars = {outcome: [0] * BAR_COUNT for outcome in ("right", "follow-through", "partial", "wrong")}
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
        return BAR_COUNT - 1
    return min(max(int((deviation + CHART_LIMIT) / (2 * CHART_LIMIT) * BAR_COUNT), 0), BAR_COUNT - 1)


def mistakes(records: Sequence[dict[str, Any]]) -> list[Mistake]:
    """The diagnosed mistakes, the costliest first."""
    found: dict[tuple[str, ...], list[dict[str, Any]]] = {}
    for record in records:
        if diagnosis := record["diagnosis"]:
            found.setdefault(tuple(sorted([diagnosis["misconception"], *diagnosis["alike"]])), []).append(record)
    listed = [
        Mistake(names, tuple(each["student"] for each in made), sum(each["of"] - each["total"] for each in made))
        for names, made in found.items()
    ]
    return sorted(listed, key=lambda mistake: (-len(mistake.students), -mistake.lost, mistake.names))


def _mistake_caption(names: Sequence[str]) -> Caption:
    """What is said of a mistake; of several that were named together, that it is one of them."""
    said = [misconception(name).said for name in names]
    return said[0] if len(said) == 1 else say("One of these: {mistakes}", mistakes=sequence(said, " "))


def group_page(
    exercise: Exercise,
    records: Sequence[dict[str, Any]],
    answer_keys: Mapping[str, AnswerKey],
    pairs: Sequence[AlikePair] = (),
    refused: Sequence[Refused] = (),
    rows: Sequence[StudentRow] = (),
) -> str:
    """The report as one HTML page, for the teacher alone: it shows keys.

    answer_keys : by student, as far as they are known
    pairs : whose numbers agree beyond chance
    refused : what is not graded
    rows : all students of the course, those who handed nothing in too
    """
    steps, found = step_errors(exercise, records), mistakes(records)
    bounds, drawn = _compared_drawings(exercise, records, answer_keys)
    bound = median(bounds) if bounds else 0.0
    return page(
        "group.html",
        exercise,
        records=records,
        rows=rows,
        absent=[row for row in rows if row.marks is None],
        refused=[(one.place, exercise.tell(one.why)) for one in refused],
        average=sum(record["total"] for record in records) / len(records) if records else math.nan,
        levels=sorted({record["level"] for record in records}) or ["–"],
        memory=sorted({limit for record in records if (limit := record.get("memory"))}),
        # What most lost marks by: mistakes that several made, then steps that stay weak.
        common=[mistake for mistake in found if len(mistake.students) >= max(1, COMMON_MISTAKE_SHARE * len(records))],
        weak=sorted((step for step in steps if step.earned < WEAK_SHARE), key=lambda step: step.earned),
        marks=_marks_chart(exercise, records),
        policies=_policies(records),
        steps=[(step, _step_chart(step, bound)) for step in steps],
        items=item_statistics(records),
        alpha=cronbach_alpha(earned_parts(records) * [asked.marks for asked in exercise.answers])
        if records
        else math.nan,
        groups=variant_groups(records, lambda value: sentence("{value}", {"value": value}, exercise.tell)),
        mistakes=found,
        said={mistake.names: _mistake_caption(mistake.names) for mistake in found},
        pairs=pairs,
        copies_by_chance=100 * 2 * FALSE_ALARM_RATE,
        false_alarms=REMARK_RATE,
        drawn=[(each.asked, each.bundle(), each.pictures()) for each in drawn if each.off],
    )


def _policies(records: Sequence[dict[str, Any]]) -> list[tuple[Caption, float]]:
    """The average marks as they are, and as they would be by another policy, where that pays anyone otherwise."""
    own = [record["total"] for record in records]
    others = [
        (say("Without follow-through"), [record["without_follow_through"] for record in records]),
        (say("Without caps on mistakes"), [record["without_caps"] for record in records]),
    ]
    # Marks under a cap are rounded to hundredths.
    paying = [(said, marks) for said, marks in others if not np.allclose(marks, own, rtol=0, atol=0.01)]
    rows = [(say("This policy"), own), *paying] if paying else []
    return [(said, sum(marks) / len(marks)) for said, marks in rows]


def _marks_chart(exercise: Exercise, records: Sequence[dict[str, Any]]) -> Chart:
    bars = [0] * 21
    for record in records:
        bars[round(20 * record["total"] / record["of"])] += 1
    ticks = [(part, exercise.tell(say("{marks:g}", marks=part * exercise.marks))) for part in (0.0, 0.5, 1.0)]
    return stacked_chart({"right": bars}, ticks)


def _step_chart(step: StepErrors, bound: float) -> Chart:
    ticks = [
        ((k + CHART_LIMIT) / (2 * CHART_LIMIT), f"{k:+g}".replace("-", "−") if k else "0") for k in range(-6, 7, 2)
    ]
    ends = [(0.0, f"< −{CHART_LIMIT:g}"), (1.0, f"> {CHART_LIMIT:g}")]
    inside = min(bound / CHART_LIMIT, 1.0) / 2
    return stacked_chart(step.bars, [*ends, *ticks], (0.5 - inside, 0.5 + inside))


@dataclass(eq=False)
class _Drawings:
    """What is shown of all drawings of one answer; the keys of thousands would fill the memory.

    off : how far each lies off along its key;  tolerances : of their keys;  farthest : those farthest off
    """

    asked: AskedAnswer
    off: list[Floats] = field(default_factory=list[Floats])
    tolerances: list[float] = field(default_factory=list[float])
    farthest: list[HandedInDrawing] = field(default_factory=list[HandedInDrawing])

    def add(self, drawing: HandedInDrawing) -> None:
        self.off.append(deviations_along(drawing.key.expected, points_of(drawing.answer), drawing.kind))
        self.tolerances.append(drawing.key.tolerance)
        # Of two that are equally far off the former stays the first.
        ranked = sorted([*self.farthest, drawing], key=lambda each: -each.answer["off_paper"])
        self.farthest = ranked[:SHOWN_PICTURES]

    def bundle(self) -> Bundle:
        """The drawings, all in one picture."""
        return bundle(self.off, median(self.tolerances))

    def pictures(self) -> list[tuple[HandedInDrawing, CurvePicture]]:
        """The drawings farthest off, each in a picture of its own."""
        return [(each, _picture(each)) for each in self.farthest]


def _compared_drawings(
    exercise: Exercise, records: Sequence[dict[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> tuple[list[float], list[_Drawings]]:
    """The bounds of all keys, and the drawings of every answer that is drawn, in one way through the keys."""
    bounds: list[float] = []
    # The answers of a record stand in the order of the exercise.
    drawn = {place: _Drawings(asked) for place, asked in enumerate(exercise.answers) if asked.kind != "number"}
    for record in records:
        answer_key = answer_keys.get(record["student"])
        if answer_key is None:
            continue
        bounds.append(answer_key.bound)
        for place, each in drawn.items():
            answer, key = record["answers"][place], answer_key.keys[each.asked.name]
            if answer["off_paper"] is not None:
                each.add(HandedInDrawing(record["student"], each.asked.kind, answer, key))
    return bounds, list(drawn.values())


def _picture(drawing: HandedInDrawing) -> CurvePicture:
    key = drawing.key.expected
    return over_key(key, drawing.answer, drawing.kind, worst_place(key, drawing.answer, drawing.kind))

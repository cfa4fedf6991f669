"""What is drawn for each answer in the views of a page; the key is not known here."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.exercises.photographs.photographed_page import SeenPage
from graphcam.exercises.photographs.read_photo import ReadAnswer
from graphcam.photo.drawn_curves import read_curve
from graphcam.photo.pencil_ink import Ink
from graphcam.photo.pictures import PhotographError
from graphcam.photo.plotted_points import PointReading, read_points
from graphcam.photo.printed_page import Points, PrintedView
from graphcam.photo.straight_lines import Segment, crossing, read_lines
from graphcam.words import Tell, Words, say

MAX_MISS = 1.0
"""mm by which two lines may miss each other that cross all the same."""
SAME_CROSSING = 0.5
"""Crossings nearer than so many mm are one: three lines through a point make three."""
FAINT_SCORE_DROP = 0.18
"""How much less than sure ones plotted points are like their shapes that are taken where one should be."""
MARK_SHAPES: Mapping[str, tuple[str, ...]] = {
    "cross": ("cross", "dot"),
    "circle": ("ring",),
    "length": ("cross", "dot"),
}
"""How the reader calls the marks of an answer; a small cross may be seen as a dot."""


def answers_on(seen: SeenPage, asked: Mapping[str, Sequence[AskedAnswer]], tell: Tell) -> dict[str, ReadAnswer]:
    """What is drawn on a page, by the answer's name.

    asked : by the view, the answers that are drawn in it;  tell : says why one is not read
    """
    answers: dict[str, ReadAnswer] = {}
    # View by view: one at a time fills the memory enough.
    for name, here in asked.items():
        view = seen.page.views[name]
        ink = seen.ink(view)
        answers |= {one.name: _read_answer(one, name, ink, view, tell) for one in here}
    return answers


def _read_answer(asked: AskedAnswer, place: str, ink: Ink, view: PrintedView, tell: Tell) -> ReadAnswer:
    try:
        if asked.mark_form == "curve":
            return _read_curve(place, ink, view, tell)
        if asked.mark_form == "crossing":
            return _points(ReadAnswer(place, _crossings(read_lines(ink, view))), tell)
        return _read_marks(asked, place, read_points(ink, view, less=FAINT_SCORE_DROP), tell)
    except PhotographError as error:
        return _refused_answer(ReadAnswer(place, None, share=0.0, confidence=0.0), (error.why, error.advice), tell)


def _read_curve(place: str, ink: Ink, view: PrintedView, tell: Tell) -> ReadAnswer:
    reading = read_curve(ink, view)
    refusal = reading.refusal()
    measures = reading.measures
    # What was not seen stays away; a curve with a long piece of that is refused.
    points = reading.points[np.isfinite(reading.points)]
    answer = ReadAnswer(
        place,
        points if points.size > 1 else None,
        closed=view.closed,
        share=min(1.0, measures.share),
        confidence=min(1.0, max(0.0, measures.share * measures.coherence)),
        measures={name: round(float(value), 4) for name, value in vars(measures).items()},
    )
    return answer if refusal is None else _refused_answer(answer, refusal, tell)


def _refused_answer(answer: ReadAnswer, refusal: tuple[Words, Words], tell: Tell) -> ReadAnswer:
    why, remedy = map(tell, refusal)
    return replace(answer, why=why, remedy=remedy)


def _read_marks(asked: AskedAnswer, place: str, reading: PointReading, tell: Tell) -> ReadAnswer:
    wanted = np.array([kind in MARK_SHAPES[asked.mark_form] for kind in reading.kinds], np.bool_)
    sure = wanted & reading.sure
    least = float(reading.scores[sure].min(initial=1.0))
    faint = reading.points[wanted & ~sure]
    return _points(ReadAnswer(place, reading.points[sure], faint=faint, confidence=least), tell)


def _points(answer: ReadAnswer, tell: Tell) -> ReadAnswer:
    if answer.points is not None and answer.points.size:
        return answer
    refusal = (
        say("no points can be seen"),
        say(
            "mark them more clearly, with crosses of 3 mm that do not touch one another, and photograph the page again"
        ),
    )
    return _refused_answer(replace(answer, points=None, share=0.0, confidence=0.0), refusal, tell)


def _crossings(lines: Sequence[Segment]) -> Points:
    """The places where lines meet, each place once."""
    found: list[complex] = []
    for one, other in combinations(lines, 2):
        try:
            place = crossing(one, other)
        except PhotographError:
            continue
        if (
            _line_reaches(one, place)
            and _line_reaches(other, place)
            and all(abs(place - z) > SAME_CROSSING for z in found)
        ):
            found.append(place)
    return np.array(found, dtype=np.complex128)


def _line_reaches(line: Segment, place: complex) -> bool:
    ahead = (line.end - line.start) / line.length
    along = ((place - line.start) * ahead.conjugate()).real
    return -MAX_MISS <= along <= line.length + MAX_MISS

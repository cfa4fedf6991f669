"""The page a student gets: what was right, where to look again, the own curve; the key only where that is asked for."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.record import is_handed_in
from graphcam.exercises.reports.first_wrong_step import first_step_off
from graphcam.exercises.reports.unrolled_drawings import CurvePicture, over_key, picture, points_of, worst_place
from graphcam.exercises.reports.web_pages import page
from graphcam.report.markdown import number
from graphcam.words import Caption, Words, say

OUTCOME_CAPTIONS = {
    "right": say("right"),
    "follow-through": say("correct follow-through from your values"),
    "partial": say("partly right"),
    "wrong": say("wrong"),
    "unreadable": say("cannot be read"),
    "missing": say("not answered"),
}
PLAIN_OUTCOMES = ("right", "missing")
"""Outcomes of which a sentence would say no more."""


@dataclass(frozen=True)
class AnswerRow:
    """One answer as the page tells it.

    text : what was asked, with the variant's numbers
    said : what is to be said of the answer, in place of its outcome alone
    outcome : that of the answer, or "right" where a teacher gives all marks
    right : what would have been right; empty where that is not shown
    """

    asked: AskedAnswer
    answer: dict[str, Any]
    text: str
    said: Words
    right: Words
    outcome: str


def student_page(
    exercise: Exercise,
    record: dict[str, Any],
    answer_key: AnswerKey | None,
    *,
    right: bool = False,
    photographs: Sequence[str] = (),
) -> str:
    """The feedback on one record as HTML.

    answer_key : tells where on the student's own curve it is farthest off
    right : whether what would have been right is shown; without it nothing of the key is
    photographs : addresses of pictures that answers were read off, with what is right drawn in only if that is shown
    """
    marked = list(zip(exercise.answers, record["answers"], strict=True))
    shown = answer_key if right else None
    rows = [
        AnswerRow(
            asked,
            answer,
            sentence(asked.text, record["parameters"], exercise.tell),
            _answer_sentence(answer, record),
            _right_answer(asked, shown),
            "right" if _is_settled(answer, record) else answer["outcome"],
        )
        for asked, answer in marked
    ]
    drawn = [(asked, answer) for asked, answer in marked if isinstance(answer["given"], list)]
    pictures = [
        (
            _drawing_caption(answer, told=shown is not None),
            _own_drawing(asked, answer, answer_key, told=shown is not None),
        )
        for asked, answer in drawn
    ]
    return page(
        "feedback.html",
        exercise,
        record=record,
        rows=rows,
        remarks=_remarks(record),
        pictures=pictures,
        photographs=photographs,
        told=right,
        handed_in=is_handed_in(record),
        step=first_step_off(exercise, _unsettled(record), right=shown is not None) if is_handed_in(record) else None,
    )


def _answer_sentence(answer: dict[str, Any], record: dict[str, Any]) -> Words:
    """What is said of an answer: its own sentence of the record, but where the outcome says all."""
    given = next((one for one in record.get("overrides", []) if one["answer"] == answer["name"]), None)
    if given is not None:
        if given["comment"]:
            return say("by your teacher: {comment}", comment=given["comment"])
        return say("by your teacher")
    if answer["outcome"] != "right" and _is_settled(answer, record):
        return say("by your teacher: all marks")
    begin = _sentence_start(answer)
    said = next((each.removeprefix(begin) for each in record["feedback"] if each.startswith(begin)), "")
    return (
        OUTCOME_CAPTIONS[answer["outcome"]]
        if answer["outcome"] in PLAIN_OUTCOMES or not said
        else said[0].upper() + said[1:]
    )


def _is_settled(answer: dict[str, Any], record: dict[str, Any]) -> bool:
    """Whether a teacher gives an answer all of its marks, alone or with all others."""
    if answer.get("by_hand"):
        return bool(answer["marks"] == answer["of"])
    return bool(record["total"] == record["of"]) and "overrides" in record


def _unsettled(record: dict[str, Any]) -> dict[str, Any]:
    """The record without the mistakes for which a teacher gives all marks."""
    answers: list[dict[str, Any]] = [
        {**answer, "outcome": "follow-through"} if _is_settled(answer, record) else answer
        for answer in record["answers"]
    ]
    return {**record, "answers": answers}


def _remarks(record: dict[str, Any]) -> list[str]:
    """The sentences that stand nowhere else on the page; of an answer the first one stands in its row."""
    feedback: list[str] = list(record["feedback"])
    for answer in record["answers"]:
        in_row = next((said for said in feedback if said.startswith(_sentence_start(answer))), None)
        if in_row is not None:
            feedback.remove(in_row)
    return [said for said in feedback if said not in record["notes"]]


def _sentence_start(answer: dict[str, Any]) -> str:
    """The words with which the sentence on an answer begins."""
    return f"{answer['name']}: "


def _right_answer(asked: AskedAnswer, answer_key: AnswerKey | None) -> Words:
    """What would have been right, and within what it counts as right."""
    if answer_key is None:
        return ""
    key = answer_key.keys[asked.name]
    if not isinstance(key.expected.value, float):
        return say("right: see the drawing")
    value, tolerance = number(key.expected.value, asked.decimals), number(key.tolerance, asked.decimals + 1)
    return say("right: {value} ± {tolerance}", value=value, tolerance=tolerance)


def _drawing_caption(answer: dict[str, Any], *, told: bool) -> Caption:
    name, off = answer["name"], answer["outcome"] in ("wrong", "partial") and answer["station"] is not None
    if told and off:
        return say("{name}: your drawing is red, the right one blue; the largest deviation is circled.", name=name)
    if told:
        return say("{name}: your drawing is red, the right one blue.", name=name)
    if off:
        return say("{name}: your drawing; check it near the circle, which is shown enlarged beside it.", name=name)
    return say("{name}: your drawing.", name=name)


def _own_drawing(
    asked: AskedAnswer, answer: dict[str, Any], answer_key: AnswerKey | None, *, told: bool
) -> CurvePicture:
    """The student's drawing, circled where it is farthest off, and over the key where that is told."""
    key = None if answer_key is None else answer_key.keys[asked.name].expected
    spot = None
    if key is not None and answer["outcome"] in ("wrong", "partial"):
        spot = worst_place(key, answer, asked.kind)
    if key is not None and told:
        return over_key(key, answer, asked.kind, spot)
    return picture([("own", points_of(answer), asked.kind == "curve")], spot)

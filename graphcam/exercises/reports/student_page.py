"""The page a student gets: what was right, where to look again, the own curve; never the key."""

from dataclasses import dataclass
from typing import Any

from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.curves import CurvePicture, picture, points_of, worst_place
from graphcam.exercises.reports.first_step_off import first_step_off
from graphcam.exercises.reports.web_pages import page
from graphcam.words import Caption, Words, say

OUTCOMES = {
    "right": say("right"),
    "follow-through": say("follows from your own values"),
    "partial": say("right in part"),
    "wrong": say("off"),
    "unreadable": say("cannot be read"),
    "missing": say("not answered"),
}
PLAIN = ("right", "missing")
"""Outcomes of which a sentence would say no more."""


@dataclass(frozen=True)
class AnswerRow:
    """One answer as the page tells it.

    text : what was asked, with the variant's numbers
    said : what is to be said of the answer, in place of its outcome alone
    """

    asked: Asked
    answer: dict[str, Any]
    text: str
    said: Words


def student_page(exercise: Exercise, record: dict[str, Any], answer_key: AnswerKey | None) -> str:
    """The feedback on one record as HTML.

    answer_key : tells where on the student's own curve it is farthest off; of the key nothing is shown
    """
    marked = list(zip(exercise.answers, record["answers"], strict=True))
    rows = [
        AnswerRow(asked, answer, sentence(asked.text, record["parameters"], exercise.tell), _about(answer, record))
        for asked, answer in marked
    ]
    drawn = [(asked, answer) for asked, answer in marked if isinstance(answer["given"], list)]
    pictures = [(_caption(answer), _own(asked, answer, answer_key)) for asked, answer in drawn]
    return page(
        "feedback.html",
        exercise,
        record=record,
        rows=rows,
        remarks=_remarks(record),
        pictures=pictures,
        step=first_step_off(exercise, record),
    )


def _about(answer: dict[str, Any], record: dict[str, Any]) -> Words:
    """What is said of an answer: its own sentence of the record, but where the outcome says all."""
    begin = _begin(answer)
    said = next((each.removeprefix(begin) for each in record["feedback"] if each.startswith(begin)), "")
    return OUTCOMES[answer["outcome"]] if answer["outcome"] in PLAIN or not said else said[0].upper() + said[1:]


def _remarks(record: dict[str, Any]) -> list[str]:
    """The sentences that stand nowhere else on the page; of an answer the first one stands in its row."""
    feedback: list[str] = list(record["feedback"])
    for answer in record["answers"]:
        in_row = next((said for said in feedback if said.startswith(_begin(answer))), None)
        if in_row is not None:
            feedback.remove(in_row)
    return [said for said in feedback if said not in record["notes"]]


def _begin(answer: dict[str, Any]) -> str:
    """With what the sentence on an answer begins."""
    return f"{answer['name']}: "


def _caption(answer: dict[str, Any]) -> Caption:
    if answer["outcome"] in ("wrong", "partial") and answer["station"] is not None:
        return say(
            "{name}: your drawing; look again about the circle, which stands enlarged beside it.", name=answer["name"]
        )
    return say("{name}: your drawing.", name=answer["name"])


def _own(asked: Asked, answer: dict[str, Any], answer_key: AnswerKey | None) -> CurvePicture:
    spot = None
    if answer_key is not None and answer["outcome"] in ("wrong", "partial"):
        spot = worst_place(answer_key.keys[asked.name].expected, answer, asked.kind)
    return picture([("own", points_of(answer), asked.kind == "curve")], spot)

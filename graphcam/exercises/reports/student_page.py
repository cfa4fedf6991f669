"""The page a student gets: what was right, where to look again, the own curve; never the key."""

from typing import Any

from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.curves import CurvePicture, picture, points_of, worst_place
from graphcam.exercises.reports.web_pages import page
from graphcam.words import Caption, say

OUTCOMES = {
    "right": say("right"),
    "follow-through": say("follows from your own values"),
    "wrong": say("off"),
    "unreadable": say("cannot be read"),
    "missing": say("not answered"),
}


def student_page(exercise: Exercise, record: dict[str, Any], answer_key: AnswerKey | None) -> str:
    """The feedback on one record as HTML.

    answer_key : tells where on the student's own curve it is farthest off; of the key nothing is shown
    """
    marked = list(zip(exercise.answers, record["answers"], strict=True))
    rows = [
        (asked, answer, sentence(asked.text, record["parameters"], exercise.tell), OUTCOMES[answer["outcome"]])
        for asked, answer in marked
    ]
    drawn = [(asked, answer) for asked, answer in marked if isinstance(answer["given"], list)]
    pictures = [(_caption(answer), _own(asked, answer, answer_key)) for asked, answer in drawn]
    return page("feedback.html", exercise, record=record, rows=rows, pictures=pictures)


def _caption(answer: dict[str, Any]) -> Caption:
    if answer["outcome"] in ("wrong", "follow-through") and answer["station"] is not None:
        return say("{name}: your drawing; look again about the circle.", name=answer["name"])
    return say("{name}: your drawing.", name=answer["name"])


def _own(asked: Asked, answer: dict[str, Any], answer_key: AnswerKey | None) -> CurvePicture:
    spot = None
    if answer_key is not None and answer["outcome"] == "wrong":
        spot = worst_place(answer_key.keys[asked.name].expected, answer, asked.kind)
    return picture([("own", points_of(answer), asked.kind == "curve")], spot)

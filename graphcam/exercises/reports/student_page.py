"""The page a student gets: what was right, where to look again, the own curve; never the key."""

from __future__ import annotations

from typing import Any

from graphcam.drafting.ink import Caption, Words, say
from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.definition.template import sentence
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.curves import CurvePicture, picture, points_of, worst_place
from graphcam.exercises.reports.phrases import OUTCOMES, given_text, spoken
from graphcam.exercises.reports.web_pages import page

WORDS = {
    "asked": say("Asked"), "given": say("Your answer"), "outcome": say("Result"), "marks": say("Marks"),
    "remarks": say("Remarks"), "notes": say("On your hand-in"),
}  # fmt: skip


def student_page(exercise: Exercise, record: dict[str, Any], answer_key: AnswerKey | None) -> str:
    """The feedback on one record as HTML.

    certificate : tells where on the student's own curve it is farthest off; of the key nothing is shown
    """
    asked, tell = {one.name: one for one in exercise.answers}, exercise.tell
    rows = [
        {
            "text": f"{answer['name']}. {sentence(asked[answer['name']].text, record['parameters'], tell)}",
            "given": f"{given_text(answer, tell)} {tell(_unit(asked[answer['name']], answer))}".strip(),
            "kind": answer["outcome"], "outcome": tell(OUTCOMES[answer["outcome"]]),
            "marks": tell(say("{marks:g} of {of:g}", marks=answer["marks"], of=answer["of"])),
        }
        for answer in record["answers"]
    ]  # fmt: skip
    return page(
        "feedback.html", language=exercise.language, title=exercise.title, student=record["student"], rows=rows,
        total=tell(say("{marks:g} of {of:g} marks", marks=record["total"], of=record["of"])),
        words=spoken(WORDS, tell), feedback=list(record["feedback"]), notes=list(record["notes"]),
        pictures=[(tell(_caption(answer)), _own(asked[answer["name"]], answer, answer_key))
                  for answer in record["answers"] if isinstance(answer["given"], list)],
    )  # fmt: skip


def _unit(asked: Asked, answer: dict[str, Any]) -> Words:
    return "" if answer["given"] is None or isinstance(answer["given"], list) else asked.unit_said


def _caption(answer: dict[str, Any]) -> Caption:
    if answer["outcome"] in ("wrong", "follow-through") and answer["station"] is not None:
        return say("{name}: your drawing; look again about the circle.", name=answer["name"])
    return say("{name}: your drawing.", name=answer["name"])


def _own(asked: Asked, answer: dict[str, Any], answer_key: AnswerKey | None) -> CurvePicture:
    own = points_of(answer)
    spot = None
    if answer_key is not None and answer["outcome"] == "wrong":
        spot = worst_place(answer_key.keys[asked.name].expected, answer, asked.kind)
    return picture([("own", own, asked.kind == "curve")], spot)

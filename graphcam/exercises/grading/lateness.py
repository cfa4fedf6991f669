"""Lateness in the records: when each hand-in came, and what is left of the marks that it earned."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any

from graphcam.drafting.ink import Caption, say
from graphcam.exercises.course.hand_in_times import HandInTime, shown_time
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.grading.deadlines import Deadlines, LatePenalty
from graphcam.exercises.grading.overrides import TOTAL
from graphcam.exercises.marking.record import is_handed_in

NO_PENALTY = LatePenalty(0.0)
"""Lateness is told and costs nothing."""


@dataclass(frozen=True)
class LateRules:
    """The deadline, and what is lost after it."""

    deadlines: Deadlines
    penalty: LatePenalty = NO_PENALTY


def timed(record: dict[str, Any], time: HandInTime, rules: LateRules) -> dict[str, Any]:
    """The record with "late": the times as ISO 8601 has them in the deadline's zone, and the part of the marks left."""
    student = record["student"]
    deadline = rules.deadlines.of(student)
    late = rules.deadlines.late(student, time.at) if time.at else timedelta()
    found = {
        "submitted": _iso(time.at, deadline),
        "time_from": time.source,
        "deadline": _iso(deadline, deadline),
        "hours": late / timedelta(hours=1),
        "part": rules.penalty.left(late),
    }
    return {**record, "late": found}


def _iso(at: datetime | None, deadline: datetime) -> str:
    """A time to the second in the deadline's zone, so that the two compare at a glance; empty where none is known."""
    return at.astimezone(deadline.tzinfo).isoformat(" ", timespec="seconds") if at else ""


def penalised(exercise: Exercise, records: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """The records with what is left of their marks; what was earned stands under "late".

    The marks of the answers stay what the drawing earned.  Who was given a total by hand keeps it.
    """
    # Who handed nothing in was not late with it.
    return [_penalised(exercise, record) if "late" in record and is_handed_in(record) else record for record in records]


def _penalised(exercise: Exercise, record: dict[str, Any]) -> dict[str, Any]:
    late, earned = record["late"], record["total"]
    told = {**record, "late": {**late, "earned": earned}}
    if not late["hours"]:
        return told
    by_hand = any(one["answer"] == TOTAL for one in record.get("overrides", []))
    left = earned if by_hand else round(earned * late["part"], 2)
    said = exercise.tell(_said(late, earned, left, by_hand=by_hand))
    return {**told, "total": left, "feedback": [*record["feedback"], said]}


def _said(late: dict[str, Any], earned: float, left: float, *, by_hand: bool) -> Caption:
    times = {"submitted": shown_time(late["submitted"]), "deadline": shown_time(late["deadline"])}
    if times["submitted"] == times["deadline"]:
        times = {"submitted": late["submitted"], "deadline": late["deadline"]}
    if by_hand or late["part"] == 1:
        return say("Handed in late: {submitted}, but the deadline was {deadline}.", **times)
    return say(
        "Handed in late: {submitted}, but the deadline was {deadline}. Of the {earned:g} marks earned, "
        "{part:.3g} % count: {marks:g}.",
        **times,
        earned=earned,
        part=100 * late["part"],
        marks=left,
    )

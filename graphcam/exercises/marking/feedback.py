"""What the student is told: where to look again, never what is right."""

from collections.abc import Sequence

from graphcam.drafting.ink import Caption, say
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.marking.record import Diagnosis, MarkedAnswer

REDUCED_MARKS_NOTE = say(
    "To keep within that, the marks of all answers, also of right ones, are reduced in the same proportion."
)
"""A sentence on why a right answer may earn only a part of its marks."""


def feedback(
    exercise: Exercise,
    marked: Sequence[MarkedAnswer],
    answers: Answers,
    explained: Diagnosis | Caption | None,
    most: float | None = None,
) -> tuple[str, ...]:
    """Sentences for the student: about every answer, then about the mistake behind them.

    explained : the mistake that explains the answers, or what is said of a slip in one of them
    most : the marks that were left with that mistake, where it would have earned more
    """
    curves = {asked.name for asked in exercise.answers if asked.kind == "curve"}
    captions = [
        _near_remark(each) if each.outcome == "partial" and each.name not in curves else _answer_remark(each, answers)
        for each in marked
    ]
    if isinstance(explained, Diagnosis):
        captions += _mistake_remarks(explained)
        if most is not None:
            said = say(
                "With this mistake a submission earns at most {most:g} of {of:g} marks.", most=most, of=exercise.marks
            )
            captions += [said, REDUCED_MARKS_NOTE]
    elif explained:
        captions.append(explained)
    elif any(each.outcome in ("wrong", "partial") for each in marked):
        captions.append(say("No usual mistake explains these answers; go through the wrong steps again."))
    return tuple(map(exercise.tell, captions))


def _answer_remark(answer: MarkedAnswer, answers: Answers) -> Caption:
    name = answer.name
    match answer.outcome:
        case "right":
            return say("{name}: right.", name=name)
        case "missing":
            return say("{name}: no answer was given.", name=name)
        case "unreadable" if name in answers.problems:
            return say("{name}: the answer cannot be read: {reason}.", name=name, reason=answers.problems[name])
        case "unreadable":
            return say("{name}: the answer cannot be read.", name=name)
        case "follow-through" if answer.marks < answer.of:
            return say(
                "{name}: it follows correctly from your earlier answers and earns {marks:g} of {of:g} marks.",
                name=name,
                marks=answer.marks,
                of=answer.of,
            )
        case "follow-through":
            return say("{name}: it follows correctly from your earlier answers, so you get the marks.", name=name)
        case "partial":
            return _partial_remark(answer)
        case "wrong":
            return _wrong_remark(answer)


def _partial_remark(answer: MarkedAnswer) -> Caption:
    assert answer.station is not None
    return say(
        "{name}: part of the curve is right and earns its share of the marks. The rest is wrong or missing, most "
        "of all at point {number}. Count the first station as point 1; the arcs of the dwells have a point every "
        "15°.",
        name=answer.name,
        number=answer.station + 1,
    )


def _near_remark(answer: MarkedAnswer) -> Caption:
    return say(
        "{name}: your answer is slightly farther off than careful drawing and calculation allow; it earns "
        "{marks:g} of {of:g} marks.",
        name=answer.name,
        marks=answer.marks,
        of=answer.of,
    )


def _wrong_remark(answer: MarkedAnswer) -> Caption:
    name, number = answer.name, answer.station
    if number is not None:
        return say(
            "{name}: your drawing is farther off than careful drawing allows, most of all at point {number}. "
            "Count the first station as point 1.",
            name=name,
            number=number + 1,
        )
    if isinstance(answer.given, list):
        return say(
            "{name}: points read: {count}; another number is required. Mark each required point once, and "
            "nothing else.",
            name=name,
            count=len(answer.given),
        )
    return say("{name}: your answer is farther off than careful drawing and calculation allow.", name=name)


def _mistake_remarks(diagnosis: Diagnosis) -> list[Caption]:
    said = [misconception(diagnosis.misconception).said]
    if diagnosis.alike:
        said.append(say("These answers do not distinguish this mistake from another one, which is also possible:"))
        said += [misconception(name).said for name in diagnosis.alike]
    return said

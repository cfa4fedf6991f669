"""What the student is told: where to look again, never what is right."""

from collections.abc import Sequence

from graphcam.drafting.ink import Caption, say
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.marking.record import Diagnosis, Marked


def feedback(
    exercise: Exercise,
    marked: Sequence[Marked],
    answers: Answers,
    diagnosis: Diagnosis | None,
    most: float | None = None,
) -> tuple[str, ...]:
    """Sentences for the student: about every answer, then about the mistake behind them.

    most : the marks that were left with that mistake, where it would have earned more
    """
    curves = {asked.name for asked in exercise.answers if asked.kind == "curve"}
    captions = [
        _near(each) if each.outcome == "partial" and each.name not in curves else _about(each, answers)
        for each in marked
    ]
    if diagnosis:
        captions += _mistake(diagnosis)
        if most is not None:
            said = say(
                "With this mistake a hand-in earns at most {most:g} of {of:g} marks.", most=most, of=exercise.marks
            )
            captions.append(said)
    elif any(each.outcome in ("wrong", "partial") for each in marked):
        captions.append(say("No usual mistake explains these answers; go through the wrong steps once more."))
    return tuple(map(exercise.tell, captions))


def _about(answer: Marked, answers: Answers) -> Caption:
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
                "{name}: it follows rightly from your own earlier answers and earns {marks:g} of {of:g} marks.",
                name=name,
                marks=answer.marks,
                of=answer.of,
            )
        case "follow-through":
            return say("{name}: it follows rightly from your own earlier answers, so it earns its marks.", name=name)
        case "partial":
            return _partial(answer)
        case "wrong":
            return _wrong(answer)


def _partial(answer: Marked) -> Caption:
    assert answer.station is not None
    return say(
        "{name}: a part of the curve is right and earns its part of the marks. The rest is off or missing, most of all "
        "at point {number}, the first station being point one and the arcs of the dwells having points every 15°.",
        name=answer.name,
        number=answer.station + 1,
    )


def _near(answer: Marked) -> Caption:
    return say(
        "{name}: a little farther off than a careful hand draws or calculates; it earns {marks:g} of {of:g} marks.",
        name=answer.name,
        marks=answer.marks,
        of=answer.of,
    )


def _wrong(answer: Marked) -> Caption:
    name, number = answer.name, answer.station
    if number is not None:
        return say(
            "{name}: farther off than a careful hand draws, most of all at point {number}, the first station being "
            "point one.",
            name=name,
            number=number + 1,
        )
    if isinstance(answer.given, list):
        return say(
            "{name}: points read: {count}; another number is asked. Mark every place once, and nothing else.",
            name=name,
            count=len(answer.given),
        )
    return say("{name}: farther off than a careful hand draws or calculates.", name=name)


def _mistake(diagnosis: Diagnosis) -> list[Caption]:
    said = [misconception(diagnosis.misconception).said]
    if diagnosis.alike:
        said.append(say("These answers do not tell this mistake from another one; that may be it as well:"))
        said += [misconception(name).said for name in diagnosis.alike]
    return said

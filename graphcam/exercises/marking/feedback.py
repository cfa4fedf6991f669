"""What the student is told: where to look again, never what is right."""

from collections.abc import Sequence

from graphcam.drafting.ink import Caption, say
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.marking.record import Diagnosis, Marked


def feedback(
    exercise: Exercise, marked: Sequence[Marked], answers: Answers, diagnosis: Diagnosis | None
) -> tuple[str, ...]:
    """Sentences for the student: about every answer, then about the mistake behind them."""
    captions = [_about(each, answers) for each in marked]
    if diagnosis:
        captions += _mistake(diagnosis)
    elif any(each.outcome == "wrong" for each in marked):
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
        case "follow-through":
            return say("{name}: it follows rightly from your own earlier answers, so it earns its marks.", name=name)
        case "wrong":
            return _wrong(answer)


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

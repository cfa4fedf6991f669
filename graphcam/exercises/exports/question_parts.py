"""What the questions of all systems are made of: variants, what is asked and how, worksheets, what mistakes answer."""

import json
import math
import uuid
from collections.abc import Iterator
from fractions import Fraction
from io import BytesIO
from typing import NamedTuple

from graphcam.errors import TaskError
from graphcam.exercises.course.handouts import worksheet
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.variant import Variant, sentence
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.words import Caption, say

RIGHT_FEEDBACK = say("Right.")
WRONG_FEEDBACK = say("The deviation is larger than careful drawing and calculation allow.")
"""The feedback on an answer that is neither right nor a catalogued mistake's."""
PRINT_ADVICE = say("The worksheet: print it true to scale and draw on it.")
SEPARATE_HAND_IN = say("Hand it in separately: its marks are not part of this question.")
NAMESPACE = uuid.uuid5(uuid.NAMESPACE_DNS, "graphcam.exercise")


class IssuedVariant(NamedTuple):
    """A student's variant with its key."""

    student: Student
    variant: Variant
    answer_key: AnswerKey


class MistakenAnswers(NamedTuple):
    """What a student with a catalogued mistake answers, how far about it, and what the student is told."""

    value: float
    tolerance: float
    said: Caption


def check_numbers(exercise: Exercise) -> None:
    """See that there is a number to ask for.

    Raises
    ------
    TaskError : no answer of the exercise is a number
    """
    if all(asked.kind != "number" for asked in exercise.answers):
        remedy = say("export with --format moodle, which asks for drawings")
        raise TaskError(
            say("exercise {name}", name=exercise.name), "answers", say("all drawn"), say("one or more numbers"), remedy
        )


def question_body(exercise: Exercise, answer_key: AnswerKey, asked: AskedAnswer) -> str:
    """What an answer's question says: of a number with its unit, of a drawing with how it is handed in."""
    tell = exercise.tell
    text = sentence(asked.text, answer_key.parameters, tell)
    if asked.kind == "number":
        return f"{text} [{tell(asked.unit_caption)}]" if asked.unit else text
    how = say("Hand in a DXF, drawn in mm on the layer {layer}.", layer=asked.layer)
    return f"{text} {tell(how)}"


def mistaken(exercise: Exercise, answer_key: AnswerKey, asked: AskedAnswer) -> Iterator[MistakenAnswers]:
    """What the catalogued mistakes answer where a number is asked, none of it within the key's tolerance."""
    key, place = answer_key.keys[asked.name], exercise.answers.index(asked)
    for name, values in answer_key.hypotheses.items():
        value, scatter = values[place].value, values[place].scatter
        assert isinstance(value, float)
        assert isinstance(scatter, float)
        # A mistake made elsewhere leaves this answer right.
        room = abs(value - float(str(key.expected.value))) - key.tolerance
        if room > 0:
            yield MistakenAnswers(value, min(answer_key.bound * scatter, room), misconception(name).said)


def whole_marks(exercise: Exercise) -> dict[str, int]:
    """The marks of all answers that are numbers, by name, times the least number by which all become whole.

    >>> from dataclasses import replace
    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> exercise = find_exercise("acceleration-and-scales")
    >>> answers = [replace(asked, marks=marks) for asked, marks in zip(exercise.answers, (0.5, 0.75, 2.0))]
    >>> whole_marks(replace(exercise, answers=tuple(answers)))
    {'return_ordinate': 2, 'third_middle': 3, 'v_6_return': 8}
    """
    # Of the shortest decimal, not of the binary fraction behind it.
    marks = {asked.name: Fraction(repr(asked.marks)) for asked in exercise.answers if asked.kind == "number"}
    times = math.lcm(*(each.denominator for each in marks.values()))
    return {name: int(each * times) for name, each in marks.items()}


def worksheet_pdf(issued: IssuedVariant) -> bytes:
    """The variant's worksheet, true to scale."""
    from graphcam.sheets.matplotlib_renderer import write_pdf

    file = BytesIO()
    write_pdf(worksheet(issued.variant, issued.student), file)
    return file.getvalue()


def identifier_of(*said: object) -> uuid.UUID:
    """An identifier that is the same whenever the same is said.

    >>> identifier_of("whole-cam", 2) == identifier_of("whole-cam", 2) != identifier_of("whole-cam", 3)
    True
    """
    return uuid.uuid5(NAMESPACE, json.dumps(said))


def short_identifier(letter: str, *said: object) -> str:
    """An identifier for a name: a letter first, as XML wants it, and 32 characters, which every QTI system takes.

    >>> len(short_identifier("v", "whole-cam"))
    32
    """
    return letter + identifier_of(*said).hex[:31]


def variant_identifier(issued: IssuedVariant) -> str:
    """A name of the variant: of the exercise, the student and the parameters, with nothing of the key."""
    answer_key = issued.answer_key
    said = (answer_key.exercise, answer_key.version, answer_key.student, dict(answer_key.parameters))
    return short_identifier("v", *said)

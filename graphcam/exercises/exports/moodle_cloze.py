"""Moodle's cloze questions: one a variant, with the worksheet as its file and a blank for every number.

A blank is ``{2:NUMERICAL:=12.3:0.4#Right.~%0%15.1:0.4#feedback}``: the marks, the key with its tolerance, then what the
catalogued mistakes answer, without marks.  Moodle takes the first that matches.  The marks must be whole, so all of a
question are multiplied alike.
"""

import math
from base64 import b64encode
from collections.abc import Sequence
from fractions import Fraction
from html import escape
from io import BytesIO
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from graphcam.errors import TaskError
from graphcam.exercises.course.handouts import instructions, worksheet
from graphcam.exercises.course.roster import Student, folder_name
from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.definition.variant import Variant, sentence
from graphcam.exercises.exports.moodle import FAR_OFF, RIGHT, add_category, add_text, mistaken
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.words import say

WORKSHEET = "worksheet.pdf"
ANYTHING = "0:1e12"
"""All numbers that a student may give; a cloze question's "*" has no tolerance, which Moodle complains about."""
ENTITIES = {ord(sign): f"&#{ord(sign)};" for sign in '{}#~/\\"'}
"""Signs that mean something in a blank.

Moodle decodes entities in feedback; behind a backslash it finds only ``}`` and ``#`` again.
"""


class Issued(NamedTuple):
    """A student's variant with its key."""

    student: Student
    variant: Variant
    answer_key: AnswerKey


def cloze_xml(exercise: Exercise, issued: Sequence[Issued]) -> str:
    """The questions of several variants, all in one category, so that a quiz can draw one of them at random.

    Raises
    ------
    TaskError : no answer of the exercise is a number

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> cloze_xml(find_exercise("acceleration-and-scales"), []).count("question")
    2
    """
    if all(asked.kind != "number" for asked in exercise.answers):
        remedy = "export with --format moodle, which asks for drawings"
        raise TaskError(f"exercise {exercise.name}", "answers", "all drawn", "one or more numbers", remedy)
    quiz = Element("quiz")
    add_category(quiz, exercise.title)
    for each in issued:
        question = SubElement(quiz, "question", type="cloze")
        add_text(question, "name", f"{exercise.title}: {folder_name(each.student.id)}")
        text = add_text(question, "questiontext", question_text(exercise, each), format="html")
        file = SubElement(text, "file", name=WORKSHEET, path="/", encoding="base64")
        file.text = b64encode(_pdf(each)).decode("ascii")
        add_text(question, "generalfeedback", "", format="html")
        SubElement(question, "penalty").text = "0"
    indent(quiz)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(quiz, encoding="unicode") + "\n"


def question_text(exercise: Exercise, issued: Issued) -> str:
    """What the question says, in HTML: the task, the worksheet, and every answer with its blank."""
    tell, answer_key = exercise.tell, issued.answer_key
    print_it = _shown(tell(say("The worksheet: print it true to scale and draw on it.")))
    lines = [
        f"<h4>{_shown(exercise.title)}</h4>",
        f"<p>{_shown(instructions(issued.variant))}</p>",
        f'<p><a href="@@PLUGINFILE@@/{WORKSHEET}">{print_it}</a></p>',
    ]
    times = whole_number_factor(exercise)
    for asked in exercise.answers:
        said = sentence(asked.text, answer_key.parameters, tell)
        if asked.kind == "number":
            said += f" [{tell(asked.unit_said)}]" if asked.unit else ""
            lines.append(f"<p>{_shown(said)} {_blank(exercise, answer_key, asked, times)}</p>")
        else:
            how = say("Hand in a DXF, drawn in mm on the layer {layer}.", layer=asked.layer)
            apart = say("Hand it in separately: its marks are not part of this question.")
            lines.append(f"<p>{_shown(f'{said} {tell(how)} {tell(apart)}')}</p>")
    return "\n".join(lines)


def whole_number_factor(exercise: Exercise) -> int:
    """The least number by which the marks of all answers that are numbers become whole.

    >>> from dataclasses import replace
    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> exercise = find_exercise("acceleration-and-scales")
    >>> answers = [replace(asked, marks=marks) for asked, marks in zip(exercise.answers, (0.5, 0.75, 2.0))]
    >>> whole_number_factor(replace(exercise, answers=tuple(answers)))
    4
    """
    # Of the shortest decimal, not of the binary fraction behind it.
    marks = [Fraction(repr(asked.marks)) for asked in exercise.answers if asked.kind == "number"]
    return math.lcm(*(each.denominator for each in marks))


def _blank(exercise: Exercise, answer_key: AnswerKey, asked: Asked, times: int) -> str:
    key = answer_key.keys[asked.name]
    tell = exercise.tell
    answers = [f"={key.expected.value!r}:{key.tolerance!r}#{_feedback(tell(RIGHT))}"]
    answers += [
        f"%0%{wrong.value!r}:{wrong.tolerance!r}#{_feedback(tell(wrong.said))}"
        for wrong in mistaken(exercise, answer_key, asked)
    ]
    answers.append(f"%0%{ANYTHING}#{_feedback(tell(FAR_OFF))}")
    weight = Fraction(repr(asked.marks)) * times
    return f"{{{weight}:NUMERICAL:{'~'.join(answers)}}}"


def _feedback(text: str) -> str:
    """Text as HTML, and that with no sign which ends an answer; Moodle decodes the outer entities only.

    >>> _feedback("a < b} ~ c")
    'a &amp;lt; b&#125; &#126; c'
    """
    return escape(escape(text, quote=False), quote=False).translate(ENTITIES)


def _shown(text: str) -> str:
    """Text as HTML that holds no blank."""
    return escape(text, quote=False).translate(ENTITIES)


def _pdf(issued: Issued) -> bytes:
    from graphcam.sheets.matplotlib_renderer import write_pdf

    file = BytesIO()
    write_pdf(worksheet(issued.variant, issued.student), file)
    return file.getvalue()

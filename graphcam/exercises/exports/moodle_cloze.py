"""Moodle's cloze questions: one a variant, with the worksheet as its file and a blank for every number.

A blank is ``{2:NUMERICAL:=12.3:0.4#Right.~%0%15.1:0.4#feedback}``: the marks, the key with its tolerance, then what the
catalogued mistakes answer, without marks.  Moodle takes the first that matches.  The marks must be whole, so all of a
question are multiplied alike.
"""

from base64 import b64encode
from collections.abc import Sequence
from html import escape
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from graphcam.exercises.course.handouts import instructions
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.exports.moodle import add_category, add_text
from graphcam.exercises.exports.question_parts import (
    APART,
    FAR_OFF,
    PRINT_IT,
    RIGHT,
    Issued,
    asked_text,
    check_numbers,
    mistaken,
    whole_marks,
    worksheet_pdf,
)
from graphcam.exercises.key.answer_key import AnswerKey

WORKSHEET = "worksheet.pdf"
ANYTHING = "0:1e12"
"""All numbers that a student may give; a cloze question's "*" has no tolerance, which Moodle complains about."""
ENTITIES = {ord(sign): f"&#{ord(sign)};" for sign in '{}#~/\\"'}
"""Signs that mean something in a blank.

Moodle decodes entities in feedback; behind a backslash it finds only ``}`` and ``#`` again.
"""


def cloze_xml(exercise: Exercise, issued: Sequence[Issued]) -> str:
    """The questions of several variants, all in one category, so that a quiz can draw one of them at random.

    Raises
    ------
    TaskError : no answer of the exercise is a number

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> cloze_xml(find_exercise("acceleration-and-scales"), []).count("question")
    2
    """
    check_numbers(exercise)
    quiz = Element("quiz")
    add_category(quiz, exercise.title)
    for each in issued:
        question = SubElement(quiz, "question", type="cloze")
        add_text(question, "name", f"{exercise.title}: {folder_name(each.student.id)}")
        text = add_text(question, "questiontext", question_text(exercise, each), format="html")
        file = SubElement(text, "file", name=WORKSHEET, path="/", encoding="base64")
        file.text = b64encode(worksheet_pdf(each)).decode("ascii")
        add_text(question, "generalfeedback", "", format="html")
        SubElement(question, "penalty").text = "0"
    indent(quiz)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(quiz, encoding="unicode") + "\n"


def question_text(exercise: Exercise, issued: Issued) -> str:
    """What the question says, in HTML: the task, the worksheet, and every answer with its blank."""
    tell, answer_key = exercise.tell, issued.answer_key
    lines = [
        f"<h4>{_shown(exercise.title)}</h4>",
        f"<p>{_shown(instructions(issued.variant))}</p>",
        f'<p><a href="@@PLUGINFILE@@/{WORKSHEET}">{_shown(tell(PRINT_IT))}</a></p>',
    ]
    weights = whole_marks(exercise)
    for asked in exercise.answers:
        said = asked_text(exercise, answer_key, asked)
        if asked.kind == "number":
            lines.append(f"<p>{_shown(said)} {_blank(exercise, answer_key, asked, weights[asked.name])}</p>")
        else:
            lines.append(f"<p>{_shown(f'{said} {tell(APART)}')}</p>")
    return "\n".join(lines)


def _blank(exercise: Exercise, answer_key: AnswerKey, asked: Asked, weight: int) -> str:
    key = answer_key.keys[asked.name]
    tell = exercise.tell
    answers = [f"={key.expected.value!r}:{key.tolerance!r}#{_feedback(tell(RIGHT))}"]
    answers += [
        f"%0%{wrong.value!r}:{wrong.tolerance!r}#{_feedback(tell(wrong.said))}"
        for wrong in mistaken(exercise, answer_key, asked)
    ]
    answers.append(f"%0%{ANYTHING}#{_feedback(tell(FAR_OFF))}")
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

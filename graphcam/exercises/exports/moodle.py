"""Moodle's question XML: for each variant a description and a numerical question for every answer, or one of cloze.

The first answer is the key with its tolerance and all marks; those after it are what the catalogued mistakes answer,
with no marks and the feedback that belongs to them.  Moodle takes the first that matches.  Numbers are written so that
they are read back exactly.

A cloze question has the worksheet as its file and a blank for every number, which is written
``{2:NUMERICAL:=12.3:0.4#Right.~%0%15.1:0.4#feedback}``.  Its marks must be whole, so all of a question are multiplied
alike.
"""

from base64 import b64encode
from collections.abc import Sequence
from html import escape
from xml.etree.ElementTree import Element, SubElement

from graphcam.exercises.course.handouts import instructions
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.exports.content_package import xml_bytes
from graphcam.exercises.exports.question_parts import (
    PRINT_ADVICE,
    RIGHT_FEEDBACK,
    SEPARATE_HAND_IN,
    WRONG_FEEDBACK,
    IssuedVariant,
    check_numbers,
    mistaken,
    question_body,
    whole_marks,
    worksheet_pdf,
)
from graphcam.exercises.key.answer_key import AnswerKey

WORKSHEET_FILE = "worksheet.pdf"
ANY_NUMBER = "0:1e12"
"""All numbers that a student may give; a cloze question's "*" has no tolerance, which Moodle complains about."""
CLOZE_ENTITIES = {ord(sign): f"&#{ord(sign)};" for sign in '{}#~/\\"'}
"""Signs that mean something in a blank.

Moodle decodes entities in feedback; behind a backslash it finds only ``}`` and ``#`` again.
"""


def cloze_xml(exercise: Exercise, issued: Sequence[IssuedVariant]) -> str:
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
        file = SubElement(text, "file", name=WORKSHEET_FILE, path="/", encoding="base64")
        file.text = b64encode(worksheet_pdf(each)).decode("ascii")
        add_text(question, "generalfeedback", "", format="html")
        SubElement(question, "penalty").text = "0"
    return xml_bytes(quiz).decode()


def question_text(exercise: Exercise, issued: IssuedVariant) -> str:
    """What the question says, in HTML: the task, the worksheet, and every answer with its blank."""
    tell, answer_key = exercise.tell, issued.answer_key
    lines = [
        f"<h4>{_shown(exercise.title)}</h4>",
        f"<p>{_shown(instructions(issued.variant))}</p>",
        f'<p><a href="@@PLUGINFILE@@/{WORKSHEET_FILE}">{_shown(tell(PRINT_ADVICE))}</a></p>',
    ]
    weights = whole_marks(exercise)
    for asked in exercise.answers:
        said = question_body(exercise, answer_key, asked)
        if asked.kind == "number":
            lines.append(f"<p>{_shown(said)} {_blank(exercise, answer_key, asked, weights[asked.name])}</p>")
        else:
            lines.append(f"<p>{_shown(f'{said} {tell(SEPARATE_HAND_IN)}')}</p>")
    return "\n".join(lines)


def _blank(exercise: Exercise, answer_key: AnswerKey, asked: AskedAnswer, weight: int) -> str:
    key = answer_key.keys[asked.name]
    tell = exercise.tell
    answers = [f"={key.expected.value!r}:{key.tolerance!r}#{_feedback(tell(RIGHT_FEEDBACK))}"]
    answers += [
        f"%0%{wrong.value!r}:{wrong.tolerance!r}#{_feedback(tell(wrong.said))}"
        for wrong in mistaken(exercise, answer_key, asked)
    ]
    answers.append(f"%0%{ANY_NUMBER}#{_feedback(tell(WRONG_FEEDBACK))}")
    return f"{{{weight}:NUMERICAL:{'~'.join(answers)}}}"


def _feedback(text: str) -> str:
    """Text as HTML, and that with no sign which ends an answer; Moodle decodes the outer entities only.

    >>> _feedback("a < b} ~ c")
    'a &amp;lt; b&#125; &#126; c'
    """
    return escape(escape(text, quote=False), quote=False).translate(CLOZE_ENTITIES)


def _shown(text: str) -> str:
    """Text as HTML that holds no blank."""
    return escape(text, quote=False).translate(CLOZE_ENTITIES)


DXF_ESSAY_OPTIONS = {
    "responseformat": "noinline",
    "responserequired": "0",
    "attachments": "1",
    "attachmentsrequired": "1",
    "filetypeslist": ".dxf",
}
"""What an essay's question takes."""


def moodle_xml(exercise: Exercise, answer_keys: Sequence[AnswerKey]) -> str:
    """The questions of several variants, each in a category of its own.

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> moodle_xml(find_exercise("acceleration-and-scales"), []).splitlines()[1]
    '<quiz />'
    """
    quiz = Element("quiz")
    for answer_key in answer_keys:
        add_category(quiz, exercise.title, folder_name(answer_key.student))
        told = sentence(exercise.text, answer_key.parameters, exercise.tell)
        _question(quiz, "description", exercise.title, told, defaultgrade="0")
        for asked in exercise.answers:
            _add_question(quiz, exercise, answer_key, asked)
    return xml_bytes(quiz).decode()


def _add_question(quiz: Element, exercise: Exercise, answer_key: AnswerKey, asked: AskedAnswer) -> None:
    title, tell = f"{exercise.title}: {asked.name}", exercise.tell
    text = question_body(exercise, answer_key, asked)
    if asked.kind != "number":
        # Points and curves are handed in as a drawing, which Moodle keeps and graphcam grades.
        _question(quiz, "essay", title, text, defaultgrade=repr(asked.marks), penalty="0", **DXF_ESSAY_OPTIONS)
        return
    question = _question(quiz, "numerical", title, text, defaultgrade=repr(asked.marks), penalty="0", hidden="0")
    key = answer_key.keys[asked.name]
    _answer(question, 100, repr(key.expected.value), repr(key.tolerance), tell(RIGHT_FEEDBACK))
    for wrong in mistaken(exercise, answer_key, asked):
        _answer(question, 0, repr(wrong.value), repr(wrong.tolerance), tell(wrong.said))
    _answer(question, 0, "*", "0", tell(WRONG_FEEDBACK))
    _settings(question, unitgradingtype="0", showunits="3")


def add_category(quiz: Element, *names: str) -> None:
    """The category, below the course's, into which Moodle puts the questions that follow."""
    category = SubElement(quiz, "question", type="category")
    # Of two slashes Moodle makes one that separates nothing.
    add_text(category, "category", "/".join(["$course$", *(name.replace("/", "//") for name in names)]))


def add_text(parent: Element, name: str, text: str, **attributes: str) -> Element:
    """A new element with a text, as Moodle nests it."""
    element = SubElement(parent, name, attributes)
    SubElement(element, "text").text = text
    return element


def _question(quiz: Element, kind: str, name: str, text: str, **settings: str) -> Element:
    question = SubElement(quiz, "question", type=kind)
    add_text(question, "name", name)
    add_text(question, "questiontext", text, format="plain_text")
    add_text(question, "generalfeedback", "", format="plain_text")
    _settings(question, **settings)
    return question


def _answer(question: Element, fraction: int, value: str, tolerance: str, feedback: str) -> None:
    answer = SubElement(question, "answer", fraction=str(fraction), format="moodle_auto_format")
    _settings(answer, text=value)
    add_text(answer, "feedback", feedback, format="plain_text")
    _settings(answer, tolerance=tolerance)


def _settings(parent: Element, **settings: str) -> None:
    for name, value in settings.items():
        SubElement(parent, name).text = value

"""Moodle's question XML: for each variant a description and a numerical question for every answer.

The first answer is the key with its tolerance and all marks; those after it are what the catalogued mistakes answer,
with no marks and the feedback that belongs to them.  Moodle takes the first that matches.  Numbers are written so that
they are read back exactly.
"""

from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.exports.question_parts import FAR_OFF, RIGHT, asked_text, mistaken
from graphcam.exercises.key.answer_key import AnswerKey

ONE_DXF = {
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
            _ask(quiz, exercise, answer_key, asked)
    indent(quiz)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(quiz, encoding="unicode") + "\n"


def _ask(quiz: Element, exercise: Exercise, answer_key: AnswerKey, asked: Asked) -> None:
    title, tell = f"{exercise.title}: {asked.name}", exercise.tell
    text = asked_text(exercise, answer_key, asked)
    if asked.kind != "number":
        # Points and curves are handed in as a drawing, which Moodle keeps and graphcam grades.
        _question(quiz, "essay", title, text, defaultgrade=repr(asked.marks), penalty="0", **ONE_DXF)
        return
    question = _question(quiz, "numerical", title, text, defaultgrade=repr(asked.marks), penalty="0", hidden="0")
    key = answer_key.keys[asked.name]
    _answer(question, 100, repr(key.expected.value), repr(key.tolerance), tell(RIGHT))
    for wrong in mistaken(exercise, answer_key, asked):
        _answer(question, 0, repr(wrong.value), repr(wrong.tolerance), tell(wrong.said))
    _answer(question, 0, "*", "0", tell(FAR_OFF))
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

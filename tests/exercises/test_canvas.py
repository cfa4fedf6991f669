"""Quizzes for Canvas, read by a small reader of its own after IMS QTI 1.2 and Canvas's own numerical questions."""

from __future__ import annotations

import re
import zipfile
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import pytest
from issued_variants import SECRET, issued, key
from russian import english_words

from graphcam.errors import TaskError
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.exports import LearningSystem
from graphcam.exercises.exports.canvas import quiz_xml, write_quizzes
from graphcam.exercises.exports.export import export
from graphcam.exercises.exports.question_parts import IssuedVariant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.marking import mark

NAME, DRAWN = "acceleration-and-scales", "inversion-translating"
QTI = "{http://www.imsglobal.org/xsd/ims_qtiasiv1p2}"
CONTENT = "{http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1}"
CANVAS = "{http://canvas.instructure.com/xsd/cccv1p0}"
MODEL = {
    "questestinterop": "assessment ",
    "assessment": "section ",
    "section": "(item )*",
    "item": "itemmetadata presentation (resprocessing )?",
    "itemmetadata": "qtimetadata ",
    "qtimetadata": "(qtimetadatafield )+",
    "qtimetadatafield": "fieldlabel fieldentry ",
    "presentation": "material (response_str )?",
    "material": "mattext ",
    "response_str": "render_fib ",
    "render_fib": "response_label ",
    "resprocessing": "outcomes (respcondition )+",
    "outcomes": "decvar ",
    "respcondition": "conditionvar setvar ",
    "conditionvar": "or ",
    "or": "varequal and ",
    "and": "vargte varlte ",
}
"""Children in order, as far as they are used; of ims_qtiasiv1p2p1.dtd."""


class Shown(HTMLParser):
    """The text of a question's HTML, its elements and its links."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.text, self.tags, self.links = "", list[str](), list[str]()
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.links += [value or "" for name, value in attrs if name == "href"]

    def handle_data(self, data: str) -> None:
        self.text += data


class Question:
    """One item of a quiz."""

    def __init__(self, item: Element) -> None:
        self.title = item.attrib["title"]
        fields = item.findall(f".//{QTI}qtimetadatafield")
        said = {each.findtext(f"{QTI}fieldlabel"): each.findtext(f"{QTI}fieldentry") or "" for each in fields}
        self.kind, self.points = said["question_type"], float(said["points_possible"])
        text = item.find(f".//{QTI}mattext")
        assert text is not None
        assert text.attrib["texttype"] == "text/html"
        self.shown = Shown(text.text or "")
        self.item = item

    def earns(self, value: float) -> float:
        """The points for a number: the score of the condition that holds, of 100."""
        score = 0.0
        for condition in self.item.iter(f"{QTI}respcondition"):
            if holds(condition[0][0], value):
                assert condition[1].attrib == {"action": "Set", "varname": "SCORE"}
                score = float(condition[1].text or "nan")
        return self.points * score / 100


def holds(test: Element, value: float) -> bool:
    name = test.tag.removeprefix(QTI)
    if name in {"or", "and"}:
        return {"or": any, "and": all}[name](holds(part, value) for part in test)
    assert test.attrib == {"respident": "response1"}
    bound = float(test.text or "nan")
    return {"varequal": value == bound, "vargte": value >= bound, "varlte": value <= bound}[name]


def questions(xml: bytes) -> list[Question]:
    root = ElementTree.fromstring(xml)
    for element in root.iter():
        name = element.tag.removeprefix(QTI)
        children = "".join(child.tag.removeprefix(QTI) + " " for child in element)
        assert re.fullmatch(MODEL.get(name, ""), children), (name, children)
    items = list(root.iter(f"{QTI}item"))
    assert len({item.attrib["ident"] for item in items}) == len(items)
    return [Question(item) for item in items]


def of(exercise: Exercise, answer_key: AnswerKey) -> IssuedVariant:
    """A variant as it is exported."""
    variant = Variant(exercise, answer_key.student, answer_key.draw, answer_key.parameters)
    return IssuedVariant(Student(answer_key.student), variant, answer_key)


def quiz_of(name: str, student: str = "Anna") -> tuple[Exercise, AnswerKey, list[Question]]:
    exercise, answer_key = issued(name, student)
    return exercise, answer_key, questions(quiz_xml(exercise, of(exercise, answer_key)))


@pytest.mark.parametrize("name", [NAME, DRAWN])
def test_the_key_has_all_points_of_a_quiz_and_every_mistake_loses_some(name: str):
    exercise, answer_key, (told, *asked_for) = quiz_of(name)
    numbers = [(place, asked) for place, asked in enumerate(exercise.answers) if asked.kind == "number"]
    assert (told.kind, told.points) == ("text_only_question", 0.0)
    assert [question.title for question in asked_for] == [asked.name for _, asked in numbers]
    assert {question.kind for question in asked_for} == {"numerical_question"}
    right = [float(str(answer_key.keys[asked.name].expected.value)) for _, asked in numbers]
    earned = [question.earns(value) for question, value in zip(asked_for, right, strict=True)]
    assert earned == [asked.marks for _, asked in numbers]
    for mistake, values in answer_key.hypotheses.items():
        for question, (place, asked), value in zip(asked_for, numbers, right, strict=True):
            wrong = float(str(values[place].value))
            near = abs(wrong - value) <= answer_key.keys[asked.name].tolerance
            assert question.earns(wrong) == (asked.marks if near else 0.0), (mistake, asked.name)


def test_a_question_marks_a_number_as_graphcam_does():
    exercise, answer_key, (_, *asked_for) = quiz_of(NAME)
    for place, (asked, question) in enumerate(zip(exercise.answers, asked_for, strict=True)):
        keyed = answer_key.keys[asked.name]
        for part in (-30.0, -1 - 1e-6, -1 + 1e-6, -0.3, 0.0, 0.999, 1.001, 4.0):
            value = float(str(keyed.expected.value)) + part * keyed.tolerance
            ours = mark(exercise, answer_key, Answers(key(answer_key) | {asked.name: value})).answers[place]
            assert question.earns(value) == (asked.marks if ours.outcome == "right" else 0.0), (asked.name, part)


def test_a_package_has_a_quiz_with_its_worksheet_and_settings_for_every_variant(tmp_path: Path):
    exercise = issued(NAME)[0]
    names = ("Anna", "Иван & <Co>")
    students = [of(exercise, issued(NAME, name)[1]) for name in names]
    write_quizzes(tmp_path / "one.zip", exercise, students)
    write_quizzes(tmp_path / "two.zip", exercise, students)
    assert (tmp_path / "one.zip").read_bytes() == (tmp_path / "two.zip").read_bytes()
    package = zipfile.ZipFile(tmp_path / "one.zip")
    manifest = ElementTree.fromstring(package.read("imsmanifest.xml"))
    files = [each.attrib["href"] for each in manifest.iter(f"{CONTENT}file")]
    assert sorted([*files, "imsmanifest.xml"]) == sorted(package.namelist())
    resources = {each.attrib["identifier"]: each for each in manifest.iter(f"{CONTENT}resource")}
    quizzes = [each for each in resources.values() if each.attrib["type"] == "imsqti_xmlv1p2"]
    for resource, shown, each in zip(quizzes, ("Anna", "Иван & %3CCo%3E"), students, strict=True):
        xml = package.read(resource.attrib["href"])
        assessment = ElementTree.fromstring(xml)[0]
        assert assessment.attrib == {"ident": resource.attrib["identifier"], "title": f"{exercise.title}: {shown}"}
        told = questions(xml)[0].shown
        assert f"{each.answer_key.parameters['lift']} mm" in told.text
        (link,) = told.links
        place, _, path = unquote(link).partition("/")
        assert place == "$IMS-CC-FILEBASE$"
        assert package.read(path).startswith(b"%PDF")
        (needed,) = resource.iter(f"{CONTENT}dependency")
        settings = ElementTree.fromstring(package.read(resources[needed.attrib["identifierref"]].attrib["href"]))
        assert settings.attrib["identifier"] == resource.attrib["identifier"]
        said = {child.tag.removeprefix(CANVAS): child.text for child in settings}
        assert said["show_correct_answers"] == "false"
        assert said["quiz_type"] == "assignment"
        assert float(said["points_possible"] or "nan") == exercise.marks


def test_texts_of_any_signs_are_shown_as_they_are():
    hostile = 'a/b <b>&amp;</b> ]]> & "d" {e}'
    exercise, answer_key = issued(NAME)
    answers = [replace(asked, text=hostile, unit="") for asked in exercise.answers]
    named = replace(exercise, title=hostile, answers=tuple(answers))
    told, *asked_for = questions(quiz_xml(named, of(named, answer_key)))
    assert told.title == hostile
    assert told.shown.tags == ["p", "p", "a"]
    assert [(question.shown.text, question.shown.tags) for question in asked_for] == [(hostile, ["p"])] * len(answers)


def test_a_drawing_is_handed_in_separately_and_an_exercise_of_drawings_alone_is_refused(tmp_path: Path):
    exercise, _, (told, *_) = quiz_of(DRAWN)
    drawn = [asked for asked in exercise.answers if asked.kind != "number"]
    assert told.shown.text.count("Hand it in separately") == len(drawn) > 0
    assert all(f"layer {asked.layer}" in told.shown.text for asked in drawn)
    only = replace(exercise, answers=tuple(drawn))
    with pytest.raises(TaskError, match="all drawn"):
        write_quizzes(tmp_path / "package.zip", only, [])
    assert list(tmp_path.iterdir()) == []


def test_a_package_is_in_the_language_of_the_course(tmp_path: Path):
    export(DRAWN, LearningSystem.CANVAS, [Student("Анна")], tmp_path / "out", SECRET, language="ru")
    package = zipfile.ZipFile(tmp_path / "out" / f"{DRAWN}.zip")
    (name,) = (name for name in package.namelist() if re.fullmatch(r"(v\w+)/\1\.xml", name))
    names = [asked.name for asked in find_exercise(DRAWN, "ru").answers]
    found = questions(package.read(name))
    assert len(found) == len(names)
    for question in found:
        for text in (question.title, question.shown.text):
            assert english_words(text, ["DXF", "PITCH", *names]) == set()

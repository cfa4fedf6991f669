"""Packages of QTI 2.1, read by a small reader of its own after the information model of IMS.

Items and tests are checked with the content models below, which are those of imsqti_v2p1.xsd as far as they are used,
and items are marked by the rules that the specification gives for expressions and response rules.
"""

from __future__ import annotations

import re
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import cast
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import pytest
from issued_variants import SECRET, issued, key
from russian import english_words

from graphcam.errors import TaskError
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.exports import LearningSystem
from graphcam.exercises.exports.export import export
from graphcam.exercises.exports.qti import assessment_xml, item_xml, write_package
from graphcam.exercises.exports.question_parts import IssuedVariant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.marking import mark

NAME, DRAWN = "acceleration-and-scales", "inversion-translating"
QTI = "{http://www.imsglobal.org/xsd/imsqti_v2p1}"
CONTENT = "{http://www.imsglobal.org/xsd/imscp_v1p1}"
DECLARED = {"identifier", "cardinality", "baseType"}
RULES = "((setOutcomeValue|responseCondition) )*"
MODEL: dict[str, tuple[str, set[str], set[str]]] = {
    "assessmentItem": (
        "(responseDeclaration )*(outcomeDeclaration )*(itemBody )?(responseProcessing )?(modalFeedback )*",
        {"identifier", "title", "adaptive", "timeDependent"},
        {"lang"},
    ),
    "responseDeclaration": ("(correctResponse )?", DECLARED, set()),
    "outcomeDeclaration": ("(defaultValue )?", DECLARED, {"normalMaximum", "normalMinimum"}),
    "correctResponse": ("(value )+", set(), set()),
    "defaultValue": ("(value )+", set(), set()),
    "value": ("", set(), set()),
    "itemBody": ("(p )*", set(), set()),
    "p": ("((a|textEntryInteraction) )*", set(), set()),
    "a": ("", {"href"}, {"type"}),
    "textEntryInteraction": ("", {"responseIdentifier"}, {"expectedLength"}),
    "responseProcessing": (RULES, set(), set()),
    "responseCondition": ("responseIf (responseElseIf )*(responseElse )?", set(), set()),
    "responseIf": (f"(equal|not|isNull) {RULES}", set(), set()),
    "responseElseIf": (f"(equal|not|isNull) {RULES}", set(), set()),
    "setOutcomeValue": ("(sum|multiple) ", {"identifier"}, set()),
    "equal": ("((variable|correct|baseValue) ){2}", {"toleranceMode"}, {"tolerance"}),
    "not": ("(equal|isNull) ", set(), set()),
    "isNull": ("variable ", set(), set()),
    "sum": ("((variable|baseValue|testVariables) )+", set(), set()),
    "multiple": ("((variable|baseValue) )*", set(), set()),
    "variable": ("", {"identifier"}, set()),
    "correct": ("", {"identifier"}, set()),
    "baseValue": ("", {"baseType"}, set()),
    "modalFeedback": ("", {"outcomeIdentifier", "showHide", "identifier"}, {"title"}),
    "assessmentTest": ("(outcomeDeclaration )*(testPart )+(outcomeProcessing )?", {"identifier", "title"}, set()),
    "testPart": ("(assessmentSection )+", {"identifier", "navigationMode", "submissionMode"}, set()),
    "assessmentSection": ("(selection )?(assessmentItemRef )*", {"identifier", "title", "visible"}, set()),
    "selection": ("", {"select"}, {"withReplacement"}),
    "assessmentItemRef": ("", {"identifier", "href"}, set()),
    "outcomeProcessing": ("(setOutcomeValue )*", set(), set()),
    "testVariables": ("", {"variableIdentifier"}, set()),
}
"""By element: children in order, attributes that must be there, and others that may be."""


def checked(xml: bytes) -> Element:
    """A document of QTI whose elements and attributes are those of the information model."""
    root = ElementTree.fromstring(xml)
    identifiers = [each.get("identifier", "") for each in root.iter() if each.tag.endswith(("Declaration", "Item"))]
    assert len(set(identifiers)) == len(identifiers)
    assert all(re.fullmatch(r"[^\W\d][\w.-]{0,31}", identifier) for identifier in identifiers)
    for element in root.iter():
        name = element.tag.removeprefix(QTI)
        children, required, optional = MODEL[name]
        found = "".join(child.tag.removeprefix(QTI) + " " for child in element)
        assert re.fullmatch(children, found), (name, found)
        attributes = {attribute.split("}")[-1] for attribute in element.attrib} - {"schemaLocation"}
        assert required <= attributes <= required | optional, (name, attributes)
    return root


class Marked:
    """An item after response processing: non-adaptive, so every outcome begins with its default."""

    def __init__(self, item: Element, responses: dict[str, float]) -> None:
        self.item, self.responses = item, responses
        self.outcomes: dict[str, object] = {}
        for declared in item.iter(f"{QTI}outcomeDeclaration"):
            value = declared.findtext(f"{QTI}defaultValue/{QTI}value")
            self.outcomes[declared.attrib["identifier"]] = float(value) if value else None
        for condition in item.iter(f"{QTI}responseCondition"):
            self.take(condition)

    @property
    def feedback(self) -> list[str]:
        shown = cast("list[str]", self.outcomes["FEEDBACK"] or [])
        texts = {each.attrib["identifier"]: each.text or "" for each in self.item.iter(f"{QTI}modalFeedback")}
        return [texts[identifier] for identifier in shown]

    def take(self, condition: Element) -> None:
        """The first branch whose condition is true, and not only not false."""
        for branch in condition:
            if self.value(branch[0]) is True:
                for rule in branch[1:]:
                    self.outcomes[rule.attrib["identifier"]] = self.value(rule[0])
                return

    def value(self, expression: Element) -> object:
        name = expression.tag.removeprefix(QTI)
        parts = [self.value(part) for part in expression]
        if name == "variable":
            found = self.responses | self.outcomes
            return found.get(expression.attrib["identifier"])
        if name == "correct":
            path = f"{QTI}responseDeclaration[@identifier='{expression.attrib['identifier']}']//{QTI}value"
            return float(self.item.findtext(path) or "nan")
        if name == "baseValue":
            text = expression.text or ""
            return float(text) if expression.attrib["baseType"] == "float" else text
        if name == "equal":
            return None if None in parts else self.equal(expression, *parts)
        if name == "sum":
            return None if None in parts else sum(float(str(part)) for part in parts)
        if name == "multiple":
            return [one for part in parts if part is not None for one in (part if isinstance(part, list) else [part])]
        return {"isNull": lambda: parts[0] is None, "not": lambda: not parts[0]}[name]()

    def equal(self, expression: Element, first: object, second: object) -> bool:
        assert expression.attrib["toleranceMode"] == "absolute"
        bounds = [float(part) for part in expression.attrib["tolerance"].split()]
        x, y = float(str(first)), float(str(second))
        return x - bounds[0] <= y <= x + bounds[-1]


def of(exercise: Exercise, answer_key: AnswerKey) -> IssuedVariant:
    """A variant as it is exported."""
    variant = Variant(exercise, answer_key.student, answer_key.draw, answer_key.parameters)
    return IssuedVariant(Student(answer_key.student), variant, answer_key)


def item_of(name: str) -> tuple[Exercise, AnswerKey, Element]:
    exercise, answer_key = issued(name)
    return exercise, answer_key, checked(item_xml(exercise, of(exercise, answer_key)))


def response(item: Element, place: int) -> str:
    return item.findall(f".//{QTI}textEntryInteraction")[place].attrib["responseIdentifier"]


@pytest.mark.parametrize("name", [NAME, DRAWN, "pressure-angle"])
def test_the_key_has_all_marks_of_an_item_and_every_mistake_is_named_and_loses_some(name: str):
    exercise, answer_key, item = item_of(name)
    numbers = [(place, asked) for place, asked in enumerate(exercise.answers) if asked.kind == "number"]
    marks = sum(asked.marks for _, asked in numbers)
    named = [response(item, place) for place in range(len(numbers))]
    right = {blank: float(str(answer_key.keys[asked.name].expected.value))
             for blank, (_, asked) in zip(named, numbers, strict=True)}  # fmt: skip
    score = item.find(f"{QTI}outcomeDeclaration[@identifier='SCORE']")
    assert score is not None
    assert Marked(item, right).outcomes["SCORE"] == float(score.attrib["normalMaximum"]) == marks
    assert Marked(item, right).feedback == [f"{asked.name}: Right." for _, asked in numbers]
    for mistake, values in answer_key.hypotheses.items():
        wrong = {blank: float(str(values[place].value)) for blank, (place, _) in zip(named, numbers, strict=True)}
        off = [blank for blank, (_, asked) in zip(named, numbers, strict=True)
               if abs(wrong[blank] - right[blank]) > answer_key.keys[asked.name].tolerance]  # fmt: skip
        found = Marked(item, wrong)
        lost = sum(asked.marks for blank, (_, asked) in zip(named, numbers, strict=True) if blank in off)
        assert found.outcomes["SCORE"] == marks - lost, mistake
        # Of mistakes that the answers do not tell from one another any may be named.
        told = [str(misconception(one).said) for one in (mistake, *answer_key.inseparable_from(mistake))]
        assert any(one in said for one in told for said in found.feedback) or not off


def test_nothing_earns_nothing_and_is_told_nothing():
    exercise, _, item = item_of(NAME)
    empty = Marked(item, {})
    assert (empty.outcomes["SCORE"], empty.feedback) == (0.0, [])
    far = Marked(item, {response(item, place): 1e7 for place in range(len(exercise.answers))})
    assert far.outcomes["SCORE"] == 0.0
    assert [("careful drawing" in said) for said in far.feedback] == [True] * len(exercise.answers)


def test_an_item_marks_a_number_as_graphcam_does():
    exercise, answer_key, item = item_of(NAME)
    for place, asked in enumerate(exercise.answers):
        keyed = answer_key.keys[asked.name]
        for part in (-30.0, -1 - 1e-6, -1 + 1e-6, -0.3, 0.0, 0.999, 1.001, 4.0):
            value = float(str(keyed.expected.value)) + part * keyed.tolerance
            ours = mark(exercise, answer_key, Answers(key(answer_key) | {asked.name: value})).answers[place]
            score = Marked(item, {response(item, place): value}).outcomes["SCORE"]
            assert score == (asked.marks if ours.outcome == "right" else 0.0), (asked.name, part)


def test_a_package_holds_what_its_manifest_says_and_a_test_that_draws_one_variant(tmp_path: Path):
    exercise = issued(NAME)[0]
    students = [of(exercise, issued(NAME, student)[1]) for student in ("Anna", "Иван & <Co>")]
    write_package(tmp_path / "one.zip", exercise, students)
    write_package(tmp_path / "two.zip", exercise, students)
    assert (tmp_path / "one.zip").read_bytes() == (tmp_path / "two.zip").read_bytes()
    package = zipfile.ZipFile(tmp_path / "one.zip")
    manifest = ElementTree.fromstring(package.read("imsmanifest.xml"))
    parts = [child.tag.removeprefix(CONTENT) for child in manifest]
    assert parts == ["metadata", "organizations", "resources"]
    assert manifest.findtext(f"{CONTENT}metadata/{CONTENT}schema") == "QTIv2.1 Package"
    resources = {each.attrib["identifier"]: each for each in manifest.iter(f"{CONTENT}resource")}
    files = [each.attrib["href"] for each in manifest.iter(f"{CONTENT}file")]
    assert sorted([*files, "imsmanifest.xml"]) == sorted(package.namelist())
    assert all(need.attrib["identifierref"] in resources for need in manifest.iter(f"{CONTENT}dependency"))
    kinds = [each.attrib["type"] for each in resources.values()]
    assert kinds == ["imsqti_test_xmlv2p1", *["imsqti_item_xmlv2p1", "webcontent"] * 2]
    test = checked(package.read(next(iter(resources.values())).attrib["href"]))
    section = test.find(f".//{QTI}assessmentSection")
    assert section is not None
    assert [each.attrib for each in section.iter(f"{QTI}selection")] == [{"select": "1"}]
    for each, student in zip(section.iter(f"{QTI}assessmentItemRef"), ("Anna", "Иван & %3CCo%3E"), strict=True):
        assert resources[each.attrib["identifier"]].attrib["href"] == each.attrib["href"]
        item = checked(package.read(each.attrib["href"]))
        assert item.attrib["identifier"] == each.attrib["identifier"]
        assert item.attrib["title"] == f"{exercise.title}: {student}"
        (link,) = item.iter(f"{QTI}a")
        assert package.read(link.attrib["href"]).startswith(b"%PDF")


def test_texts_of_any_signs_stay_as_they_are():
    hostile = 'a/b <b>&amp;</b> ]]> & "d" {e}'
    exercise, answer_key = issued(NAME)
    named = replace(exercise, title=hostile)
    item = checked(item_xml(named, of(named, answer_key)))
    assert item.attrib["title"] == f"{hostile}: Anna"
    assert checked(assessment_xml(named, ["v1"])).attrib["title"] == hostile


def test_a_drawing_is_handed_in_separately_and_an_exercise_of_drawings_alone_is_refused(tmp_path: Path):
    exercise, _, item = item_of(DRAWN)
    drawn = [asked for asked in exercise.answers if asked.kind != "number"]
    texts = "".join(item.itertext())
    assert texts.count("Hand it in separately") == len(drawn) > 0
    assert all(f"layer {asked.layer}" in texts for asked in drawn)
    only = replace(exercise, answers=tuple(drawn))
    with pytest.raises(TaskError, match="all drawn"):
        write_package(tmp_path / "package.zip", only, [])
    assert list(tmp_path.iterdir()) == []


def test_a_package_is_in_the_language_of_the_course(tmp_path: Path):
    export(DRAWN, LearningSystem.QTI, [Student("Анна")], tmp_path / "out", SECRET, language="ru")
    package = zipfile.ZipFile(tmp_path / "out" / f"{DRAWN}.zip")
    (name,) = (name for name in package.namelist() if re.fullmatch(r"v\w+\.xml", name))
    item = checked(package.read(name))
    assert item.attrib["{http://www.w3.org/XML/1998/namespace}lang"] == "ru"
    names = [asked.name for asked in find_exercise(DRAWN, "ru").answers]
    said = [each.text or "" for tag in ("p", "a", "modalFeedback") for each in item.iter(f"{QTI}{tag}")]
    assert len(said) > len(names)
    for text in [item.attrib["title"], *said]:
        assert english_words(text, ["DXF", "PITCH", *names]) == set()

"""Moodle's cloze questions, read by a small reader of its own after the syntax that Moodle documents."""

from __future__ import annotations

import base64
import math
import re
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace
from typing import NamedTuple
from xml.etree import ElementTree

import pytest
from issued_variants import SECRET, issued, key
from russian import english_words

from graphcam.errors import TaskError
from graphcam.exercises.course.handouts import worksheet
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.exports import LearningSystem
from graphcam.exercises.exports.export import export
from graphcam.exercises.exports.moodle import cloze_xml, question_text
from graphcam.exercises.exports.question_parts import IssuedVariant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.marking import mark
from graphcam.sheets.matplotlib_renderer import write_pdf
from graphcam.words import say

NAME, DRAWN = "acceleration-and-scales", "inversion-translating"
HOSTILE = 'a/b <b>}~%100%5:9#c{2:NUMERICAL:=1}</b> & "d" \\'
"""A text with every sign that means something in a question."""


class Alternative(NamedTuple):
    """One answer of a blank."""

    fraction: float
    value: float
    tolerance: float
    feedback: str


class Blank(NamedTuple):
    """One blank of a question."""

    weight: int
    alternatives: list[Alternative]

    def says(self, value: float) -> tuple[float, str]:
        """Fraction and feedback by Moodle's rule: the first answer within whose tolerance the value is."""
        for one in self.alternatives:
            if abs(value - one.value) <= one.tolerance:
                return one.fraction, one.feedback
        return 0.0, ""


class Shown(HTMLParser):
    """The text of a page, and the names of its elements."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.text, self.tags, self.links = "", list[str](), list[str | None]()
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.links += [value for name, value in attrs if name == "href"]

    def handle_data(self, data: str) -> None:
        self.text += data


def split(text: str, sign: str) -> list[str]:
    """Parts between signs that have no backslash before them."""
    return re.split(rf"(?<!\\){sign}", text)


def parsed(text: str) -> tuple[str, list[Blank]]:
    """The text of a question with "_" for each blank, and the blanks."""
    around, blanks = "", list[Blank]()
    while start := re.search(r"\{([0-9]*):(NUMERICAL|NM):", text):
        inside = split(text[start.end() :], "}")[0]
        around += text[: start.start()] + "_"
        text = text[start.end() + len(inside) + 1 :]
        blanks.append(Blank(int(start[1] or 1), [alternative(one) for one in split(inside, "~")]))
    return around + text, blanks


def alternative(text: str) -> Alternative:
    found = re.fullmatch(r"(=|%(-?[0-9]+)%)?([^#]+?)(?:#(.*))?", text, flags=re.DOTALL)
    assert found is not None, text
    number = r"-?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
    answer = re.fullmatch(f"({number}):({number})", found[3])
    assert answer is not None, found[3]
    fraction = 1.0 if found[1] == "=" else int(found[2] or 0) / 100
    # Feedback is HTML whose entities Moodle decodes once.
    shown = Shown(unescape(found[4] or ""))
    assert shown.tags == []
    return Alternative(fraction, float(answer[1]), float(answer[2]), shown.text)


def of(exercise: Exercise, answer_key: AnswerKey) -> IssuedVariant:
    """A variant as it is exported."""
    variant = Variant(exercise, answer_key.student, answer_key.draw, answer_key.parameters)
    return IssuedVariant(Student(answer_key.student), variant, answer_key)


def blanks_of(exercise: Exercise, answer_key: AnswerKey) -> list[Blank]:
    return parsed(question_text(exercise, of(exercise, answer_key)))[1]


@pytest.mark.parametrize("name", [NAME, DRAWN, "pressure-angle"])
def test_every_number_is_a_blank_with_key_tolerance_marks_and_the_mistakes(name: str):
    exercise, answer_key = issued(name)
    numbers = [(place, asked) for place, asked in enumerate(exercise.answers) if asked.kind == "number"]
    blanks = blanks_of(exercise, answer_key)
    told = 0
    for blank, (place, asked) in zip(blanks, numbers, strict=True):
        keyed = answer_key.keys[asked.name]
        assert blank.weight == asked.marks
        assert blank.alternatives[0] == (1.0, keyed.expected.value, keyed.tolerance, "Right.")
        assert all(one.fraction == 0 for one in blank.alternatives[1:])
        wrong = {(one.value, one.feedback) for one in blank.alternatives[1:]}
        for mistake, values in answer_key.hypotheses.items():
            value = float(str(values[place].value))
            if abs(value - float(str(keyed.expected.value))) > keyed.tolerance:
                assert (value, str(misconception(mistake).said)) in wrong
                told += 1
        assert "careful drawing" in blank.says(1e7)[1]
    assert told >= len(answer_key.hypotheses)


def test_a_blank_marks_as_graphcam_does():
    exercise, answer_key = issued(NAME)
    for asked, blank in zip(exercise.answers, blanks_of(exercise, answer_key), strict=True):
        keyed = answer_key.keys[asked.name]
        for part in (-30.0, -1 - 1e-6, -1 + 1e-6, -0.3, 0.0, 0.999, 1.001, 4.0):
            value = float(str(keyed.expected.value)) + part * keyed.tolerance
            record = mark(exercise, answer_key, Answers(key(answer_key) | {asked.name: value}))
            ours = next(one for one in record.answers if one.name == asked.name)
            assert blank.says(value)[0] == (1.0 if ours.outcome == "right" else 0.0), (asked.name, part)


def test_no_mistakes_answer_reaches_into_the_keys_tolerance():
    """Not even where every mistake scatters twenty times as far."""
    exercise, answer_key = issued(NAME)
    touching = 0
    for blank in blanks_of(exercise, replace(answer_key, bound=20 * answer_key.bound)):
        right, *wrong, _ = blank.alternatives
        for one in wrong:
            gap = abs(one.value - right.value) - right.tolerance
            assert 0 < one.tolerance <= gap
            touching += math.isclose(one.tolerance, gap)
    assert touching > 0


def test_marks_become_whole_in_their_proportions():
    exercise, answer_key = issued(NAME)
    marks = (0.5, 0.75, 1.0, 0.1, 2.0, 1.5, 3.0, 0.25)
    answers = tuple(replace(asked, marks=each) for asked, each in zip(exercise.answers, marks, strict=True))
    weights = [blank.weight for blank in blanks_of(replace(exercise, answers=answers), answer_key)]
    assert weights == [10, 15, 20, 2, 40, 30, 60, 5]


def test_texts_of_any_signs_are_shown_as_they_are(monkeypatch: pytest.MonkeyPatch):
    def hostile_misconception(_: str) -> SimpleNamespace:
        """One whose sentence has every sign."""
        return SimpleNamespace(said=say("{text}", text=HOSTILE))

    monkeypatch.setattr("graphcam.exercises.exports.question_parts.misconception", hostile_misconception)
    exercise, answer_key = issued(NAME)
    answers = tuple(replace(asked, text=HOSTILE) for asked in exercise.answers)
    hostile = replace(exercise, title=HOSTILE, answers=answers)
    around, blanks = parsed(question_text(hostile, of(hostile, answer_key)))
    assert len(blanks) == len(answers)
    assert {one.feedback for blank in blanks for one in blank.alternatives[1:-1]} == {HOSTILE}
    assert [blank.alternatives[0] for blank in blanks] == [
        blank.alternatives[0] for blank in blanks_of(exercise, answer_key)
    ]
    page = Shown(around)
    assert page.text.count(HOSTILE) == 1 + len(answers)
    assert set(page.tags) == {"h4", "p", "a"}
    xml = ElementTree.fromstring(cloze_xml(hostile, [of(hostile, answer_key)]).encode())
    category, name = xml.findtext("question/category/text"), xml.findtext("question/name/text")
    # Moodle parts a category's path at single slashes.
    assert [part.replace("//", "/") for part in re.split(r"(?<!/)/(?!/)", category or "")] == ["$course$", HOSTILE]
    assert name == f"{HOSTILE}: Anna"


def test_the_question_brings_the_variants_worksheet(tmp_path: Path):
    exercise, answer_key = issued(DRAWN)
    one = of(exercise, answer_key)
    (question,) = ElementTree.fromstring(cloze_xml(exercise, [one]).encode()).findall("question[@type='cloze']")
    file = question.find("questiontext/file")
    assert file is not None
    assert file.attrib == {"name": "worksheet.pdf", "path": "/", "encoding": "base64"}
    write_pdf(worksheet(one.variant, one.student), tmp_path / "sheet.pdf")
    assert base64.b64decode(file.text or "", validate=True) == (tmp_path / "sheet.pdf").read_bytes()
    page = Shown(parsed(question.findtext("questiontext/text") or "")[0])
    assert page.links == ["@@PLUGINFILE@@/worksheet.pdf"]
    lift = f"{answer_key.parameters['lift']} mm"
    assert lift in page.text


def test_a_drawing_is_handed_in_separately():
    exercise, answer_key = issued(DRAWN)
    around, blanks = parsed(question_text(exercise, of(exercise, answer_key)))
    drawn = [asked for asked in exercise.answers if asked.kind != "number"]
    assert len(blanks) == len(exercise.answers) - len(drawn) > 0
    assert around.count("Hand it in separately") == len(drawn) > 0
    assert all(f"layer {asked.layer}" in around for asked in drawn)
    only = replace(exercise, answers=tuple(drawn))
    with pytest.raises(TaskError, match="all drawn"):
        cloze_xml(only, [])


@pytest.mark.slow
def test_an_export_has_a_question_a_variant_in_the_courses_language(tmp_path: Path):
    students = [Student("Анна"), Student("Борис")]
    export(DRAWN, LearningSystem.MOODLE_CLOZE, students, tmp_path / "out", SECRET, language="ru")
    questions = ElementTree.parse(tmp_path / "out" / f"{DRAWN}.xml").findall("question[@type='cloze']")
    exercise = find_exercise(DRAWN, "ru")
    assert [question.findtext("name/text") for question in questions] == [
        f"{exercise.title}: {student.id}" for student in students
    ]
    for question, student in zip(questions, students, strict=True):
        around, blanks = parsed(question.findtext("questiontext/text") or "")
        numbers = [value for value in key(issued(DRAWN, student.id)[1]).values() if isinstance(value, float)]
        assert [blank.alternatives[0].value for blank in blanks] == numbers
        said = [Shown(around).text, *(one.feedback for blank in blanks for one in blank.alternatives)]
        for text in said:
            assert english_words(text, ["DXF", "PITCH"]) == set()

"""Questions of PrairieLearn: page and ``server.py`` are run by a stand-in for PrairieLearn, after its documentation.

It fills in the page's template, marks numbers as ``pl-number-input`` documents it (NumPy's allclose with the element's
rtol and atol, scores weighted), and calls the functions of ``server.py`` in the documented order.
"""

from __future__ import annotations

import json
import re
import runpy
from collections.abc import Mapping
from dataclasses import replace
from html import escape
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from uuid import UUID

import numpy as np
import pytest
from issued_variants import SECRET, issued, key
from russian import english_words

from graphcam.errors import TaskError
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.exports import LearningSystem
from graphcam.exercises.exports.export import export
from graphcam.exercises.exports.prairielearn import question_html, write_question
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.marking import mark

NAME, DRAWN = "acceleration-and-scales", "inversion-translating"
IDS = ("Anna", "Иван & <Co>", "=cmd")
INFO = {
    "comment": object, "uuid": str, "type": str, "title": str, "topic": str, "tags": list, "gradingMethod": str,
    "singleVariant": bool, "showCorrectAnswer": bool, "partialCredit": bool, "options": dict, "dependencies": dict,
}  # fmt: skip
"""Fields of info.json by PrairieLearn's schema infoQuestion.json, which permits no others, but for those that no
question here may need (code graders, workspaces, sharing)."""
INPUT = {
    "answers-name", "weight", "correct-answer", "label", "suffix", "display", "comparison", "rtol", "atol", "digits",
    "allow-complex", "show-help-text", "size", "show-correct-answer", "show-placeholder", "allow-fractions",
    "allow-blank", "blank-value", "custom-format", "initial-value", "placeholder", "show-score", "aria-label",
}  # fmt: skip
"""Attributes that pl-number-input documents; any other is an error there."""


class Page(HTMLParser):
    """The page of a question as a student has it: its text, its links and its number inputs."""

    def __init__(self, template: str, data: Mapping[str, Any]) -> None:
        super().__init__()
        self.text, self.tags = "", list[str]()
        self.links, self.inputs = list[str](), list[dict[str, str]]()
        self.feed(re.sub(r"\{\{([\w.]+)\}\}", lambda found: escape(looked_up(data, found[1])), template))
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        said = {name: value or "" for name, value in attrs}
        self.tags.append(tag)
        if tag == "a":
            self.links.append(said["href"])
        if tag == "pl-number-input":
            assert set(said) <= INPUT
            self.inputs.append(said)

    def handle_data(self, data: str) -> None:
        self.text += data


def looked_up(data: Any, path: str) -> str:
    for name in path.split("."):
        data = data[name]
    return str(data)


class Stand:
    """A question's folder, as PrairieLearn runs it for one student."""

    def __init__(self, folder: Path, seed: int) -> None:
        self.server = runpy.run_path(str(folder / "server.py"))
        self.data: dict[str, Any] = {
            "params": {}, "correct_answers": {}, "variant_seed": seed,
            "options": {"question_path": str(folder), "client_files_question_url": "/files"},
        }  # fmt: skip
        self.server["generate"](self.data)
        # Everything is kept as JSON.
        self.data = json.loads(json.dumps(self.data, allow_nan=False))
        self.page = Page((folder / "question.html").read_text(encoding="utf-8"), self.data)

    def graded(self, submitted: Mapping[str, float | str]) -> tuple[float, dict[str, str]]:
        """Score of a submission, from 0 to 1, and the feedback by answer."""
        marked: dict[str, dict[str, Any]] = {}
        data: dict[str, Any] = {**self.data, "submitted_answers": dict(submitted), "partial_scores": marked}
        for one in self.page.inputs:
            name, weight = one["answers-name"], int(one["weight"])
            assert one["comparison"] == "relabs"
            relative, absolute = float(one["rtol"]), float(one["atol"])
            given, right = submitted[name], False
            if isinstance(given, str):
                # A blank is permitted where the element says so, and then it is no right answer.
                assert (given, one["allow-blank"], one["blank-value"]) == ("", "true", "")
            else:
                right = np.allclose(given, data["correct_answers"][name], rtol=relative, atol=absolute)
            marked[name] = {"score": int(right), "weight": weight}
        self.server["grade"](data)
        earned = sum(one["score"] * one["weight"] for one in marked.values())
        told = {name: one["feedback"] for name, one in marked.items() if "feedback" in one}
        return earned / sum(one["weight"] for one in marked.values()), told


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("prairielearn")
    export(NAME, LearningSystem.PRAIRIELEARN, [Student(student) for student in IDS], place / "out", SECRET)
    return place / "out" / "questions" / NAME


def student_of(stand: Stand) -> tuple[str, AnswerKey]:
    """Whose variant it is, by its parameters in the text."""
    keys = {student: issued(NAME, student)[1] for student in IDS}
    found = [name for name, each in keys.items() if key(each) == stand.data["correct_answers"]]
    assert len(found) == 1
    return found[0], keys[found[0]]


@pytest.mark.slow
def test_seeds_give_every_variant_and_one_seed_the_same(folder: Path):
    assert {student_of(Stand(folder, seed))[0] for seed in range(len(IDS))} == set(IDS)
    assert Stand(folder, 2**32 - 5).data == Stand(folder, 2**32 - 5).data


@pytest.mark.slow
def test_the_key_has_all_marks_and_every_mistake_is_named_and_loses_some(folder: Path):
    exercise = issued(NAME)[0]
    stand = Stand(folder, 7)
    _, answer_key = student_of(stand)
    right = {name: float(str(value)) for name, value in key(answer_key).items()}
    assert stand.graded(right) == (1.0, {})
    for mistake, values in answer_key.hypotheses.items():
        wrong = {asked.name: float(str(values[place].value)) for place, asked in enumerate(exercise.answers)}
        off = {name for name in wrong if abs(wrong[name] - right[name]) > answer_key.keys[name].tolerance}
        score, told = stand.graded(wrong)
        lost = sum(asked.marks for asked in exercise.answers if asked.name in off)
        assert score == pytest.approx(1 - lost / exercise.marks), mistake
        assert set(told) == off
        assert off == set() or str(misconception(mistake).said) in told.values()
    score, told = stand.graded(dict.fromkeys(right, 1e7))
    assert score == 0
    assert len(told) == len(right)
    assert all("careful drawing" in said for said in told.values())
    assert stand.graded(dict.fromkeys(right, "")) == (0.0, {})


def test_a_number_is_marked_as_graphcam_does(folder: Path):
    stand = Stand(folder, 1)
    student, answer_key = student_of(stand)
    exercise = issued(NAME, student)[0]
    right = {name: float(str(value)) for name, value in key(answer_key).items()}
    for place, asked in enumerate(exercise.answers):
        for part in (-30.0, -1 - 1e-6, -1 + 1e-6, -0.3, 0.999, 1.001, 4.0):
            given = right | {asked.name: right[asked.name] + part * answer_key.keys[asked.name].tolerance}
            ours = mark(exercise, answer_key, Answers(given)).answers[place].outcome == "right"
            expected = 1.0 if ours else 1 - asked.marks / exercise.marks
            assert stand.graded(given)[0] == pytest.approx(expected), (asked.name, part)


def test_the_page_has_the_task_with_its_parameters_the_worksheet_and_an_input_an_answer(folder: Path):
    exercise = issued(NAME)[0]
    for seed in range(len(IDS)):
        stand = Stand(folder, seed)
        _, answer_key = student_of(stand)
        assert f"{answer_key.parameters['lift']} mm" in stand.page.text
        assert [one["answers-name"] for one in stand.page.inputs] == [asked.name for asked in exercise.answers]
        for one in stand.page.inputs:
            assert float(one["atol"]) == answer_key.keys[one["answers-name"]].tolerance
        (link,) = stand.page.links
        file = folder / "clientFilesQuestion" / link.removeprefix("/files/")
        assert file.read_bytes().startswith(b"%PDF")


def test_students_can_load_nothing_that_tells_a_key(folder: Path):
    values = [float(str(value)) for student in IDS for value in key(issued(NAME, student)[1]).values()]
    loadable = [path for path in folder.rglob("*") if path.is_file() and "clientFilesQuestion" in path.parts]
    assert [path.suffix for path in loadable] == [".pdf"] * len(IDS)
    page = (folder / "question.html").read_text(encoding="utf-8")
    shown = "".join(Stand(folder, seed).page.text for seed in range(len(IDS)))
    served = (folder / "variants.json").read_text(encoding="utf-8")
    assert all(repr(value) in served for value in values)
    assert not any(repr(value) in page + shown for value in values)
    info = json.loads((folder / "info.json").read_text(encoding="utf-8"))
    assert info["showCorrectAnswer"] is False
    # An input tells its tolerance in its help, and the key to whoever is right, unless it is told not to.
    silent = {"show-help-text", "show-placeholder", "show-correct-answer"}
    assert all({one[name] for name in silent} == {"false"} for one in Stand(folder, 0).page.inputs)


@pytest.mark.slow
def test_the_question_has_the_fields_of_prairielearns_schema_and_the_same_bytes_again(folder: Path, tmp_path: Path):
    info = json.loads((folder / "info.json").read_text(encoding="utf-8"))
    assert {"uuid", "type", "title", "topic"} <= set(info) <= set(INFO)
    assert all(isinstance(value, INFO[name]) for name, value in info.items())
    assert str(UUID(info["uuid"])) == info["uuid"]
    assert info["type"] == "v3"
    # A variant is drawn on paper: the student keeps it.
    assert info["singleVariant"] is True
    export(NAME, LearningSystem.PRAIRIELEARN, [Student(student) for student in IDS], tmp_path / "out", SECRET)
    again = tmp_path / "out" / "questions" / NAME
    files = sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    assert files == sorted(path.relative_to(again) for path in again.rglob("*") if path.is_file())
    for path in files:
        assert (folder / path).read_bytes() == (again / path).read_bytes(), path


def test_texts_of_any_signs_are_shown_as_they_are():
    hostile = '<b>{{params.tolerance}}</b> & "d"'
    exercise = issued(DRAWN)[0]
    data = {
        "params": {
            "task": hostile, "worksheet": "one.pdf", "asked": {asked.name: hostile for asked in exercise.answers},
            "tolerance": {asked.name: 0.5 for asked in exercise.answers},
        },
        "options": {"client_files_question_url": "/files"},
    }  # fmt: skip
    page = Page(question_html(exercise), data)
    assert page.text.count(hostile) == 1 + len(exercise.answers)
    assert set(page.tags) == {"pl-question-panel", "p", "a", "pl-number-input"}


def test_a_drawing_is_handed_in_separately_and_an_exercise_of_drawings_alone_is_refused(tmp_path: Path):
    exercise = issued(DRAWN)[0]
    drawn = [asked for asked in exercise.answers if asked.kind != "number"]
    assert question_html(exercise).count("Hand it in separately") == len(drawn) > 0
    only = replace(exercise, answers=tuple(drawn))
    with pytest.raises(TaskError, match="all drawn"):
        write_question(tmp_path / "question", only, [])
    assert list(tmp_path.iterdir()) == []


def test_a_question_is_in_the_language_of_the_course(tmp_path: Path):
    export(DRAWN, LearningSystem.PRAIRIELEARN, [Student("Анна")], tmp_path / "out", SECRET, language="ru")
    stand = Stand(tmp_path / "out" / "questions" / DRAWN, 0)
    names = [asked.name for asked in find_exercise(DRAWN, "ru").answers]
    info = json.loads((tmp_path / "out" / "questions" / DRAWN / "info.json").read_text(encoding="utf-8"))
    wrong = dict.fromkeys(stand.data["correct_answers"], 1e7)
    for text in [info["title"], info["topic"], stand.page.text, *stand.graded(wrong)[1].values()]:
        assert english_words(text, ["DXF", "PITCH", *names]) == set()
        assert re.search("[а-я]", text)

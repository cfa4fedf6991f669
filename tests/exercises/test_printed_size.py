"""A worksheet that was printed too small or too large: what its rule measures is told, and the answers go by it."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from issued_variants import SECRET, answer_lines, issued, key
from other_students import on_printed_sheet
from over_all import over_all

from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError
from graphcam.exercises.course.handouts import answer_file
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Answers, AskedAnswer, Exercise
from graphcam.exercises.definition.exercise_file import find_exercise, library
from graphcam.exercises.definition.variant import Variant, drawn
from graphcam.exercises.grading.grade_one import Assignment, Submission, grade
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import answer_of
from graphcam.exercises.key.printed_size import drawn_on_print, on_true_print
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.record import Record

NAME = "integration"


def graded(files: dict[str, str]) -> Record:
    exercise, answer_key = issued(NAME)
    handed_in = {name: text.encode() for name, text in files.items()}
    submission = Submission("Anna", "anna", handed_in, (), answer_key.to_json())
    return grade(Assignment(exercise, SECRET), submission).record


def as_drawn(exercise: Exercise, answer_key: AnswerKey, size: float) -> dict[str, float]:
    """What a perfect hand reads on such a print, by the tests' own model of it."""
    right = board_chain(Variant(exercise, answer_key.student, answer_key.draw, answer_key.parameters).task)
    chain = on_printed_sheet(exercise, right, Pencil(), size)
    return {asked.name: round(float(answer_of(chain, asked)), asked.decimals) for asked in exercise.answers}


@over_all(("name", "size"), [(name, size) for name in library() for size in (0.9, 0.98, 1.05)])
def test_a_perfect_hand_draws_on_a_print_what_the_tests_think_it_does(name: str, size: float):
    exercise = find_exercise(name)
    right = board_chain(drawn(exercise, "Anna", SECRET, 0).task)
    ours, theirs = drawn_on_print(exercise, right, size), on_printed_sheet(exercise, right, Pencil(), size)
    for asked in exercise.answers:
        assert np.allclose(answer_of(ours, asked), answer_of(theirs, asked), rtol=1e-6, atol=1e-6), asked.name


@over_all("size", [0.9, 0.98, 1.05])
def test_every_answer_has_a_factor_of_its_own(size: float):
    """Printed ordinates and axis go into v twice and into s three times; the scale of s is the lift over its height."""
    exercise, answer_key = issued(NAME)
    right = board_chain(Variant(exercise, "Anna", answer_key.draw, answer_key.parameters).task)
    small = drawn_on_print(exercise, right, size)
    found = {asked.name: answer_of(small, asked) / answer_of(right, asked) for asked in exercise.answers}
    powers = {"v_2": 2, "v_3_return": 2, "s_5": 3, "s_max": 3, "s_3_return": 3, "mu_v": -3, "mu_a": -3, "v_max": -1}
    assert found == pytest.approx({name: size**power for name, power in powers.items()})


def files_of(lines: dict[str, object]) -> list[dict[str, str]]:
    text = answer_lines(lines)
    cell = {"cell_type": "code", "metadata": {"tags": ["answers"]}, "source": text}
    rows = "".join(f"{name},{value}\n" for name, value in lines.items())
    return [{"answers.toml": text}, {"answers.csv": rows}, {"answers.ipynb": json.dumps({"cells": [cell]})}]


@over_all("place", range(3))
def test_right_work_on_a_print_at_95_percent_is_right_where_the_length_is_told(place: int):
    read = as_drawn(*issued(NAME), 0.95)
    told, silent = (graded(files_of(lines)[place]) for lines in ({**read, "bar": 95.0}, read))
    assert told.total == told.of > silent.total
    assert [note for note in told.notes if "print of 95 %" in note] == list(told.notes)
    assert silent.notes == ()


@over_all("line", ["bar = 95,0", "Bar = 95.0 mm", "# bar = 95", 'bar = "95 mm"'])
def test_the_length_is_typed_as_answers_are(line: str):
    record = graded({"answers.toml": answer_lines(as_drawn(*issued(NAME), 0.95)) + line + "\n"})
    assert record.total == record.of


@over_all(
    ("bar", "why"),
    [
        ("50", "bar is 50 mm"),
        ("89.9", "bar is 89.9 mm"),
        ("106", "bar is 106 mm"),
        ("9.8 cm", "bar has the unit cm, but is asked in mm"),
        ('"abc"', "bar is abc, which is not a number"),
        ("[1, 2]", "bar is a list"),
        ("", "answers.toml: line 9 is not valid TOML"),
    ],
)
def test_a_length_that_no_print_can_have_is_told_and_changes_nothing(bar: str, why: str):
    lines = answer_lines(key(issued(NAME)[1]))
    record, plain = graded({"answers.toml": f"{lines}bar = {bar}\n"}), graded({"answers.toml": lines})
    assert record.notes[0].startswith(why)
    assert "measures from 90 to 105 mm on a print: measure it again" in record.notes[0]
    assert replace(record, notes=()) == plain
    assert plain.total == plain.of


def test_without_a_length_or_with_one_that_is_true_nothing_is_drawn(monkeypatch: pytest.MonkeyPatch):
    lines = answer_lines(key(issued(NAME)[1]))
    plain = graded({"answers.toml": lines})
    monkeypatch.setattr("graphcam.exercises.key.printed_size.board_chain", None)
    assert graded({"answers.toml": f"{lines}bar = 100.2\n"}) == graded({"answers.toml": f"{lines}bar = ''\n"}) == plain


def test_a_length_alone_answers_nothing():
    record = graded({"answers.toml": "bar = 100\n"})
    assert {answer.outcome for answer in record.answers} == {"missing"}
    assert record.notes == ("none of the answers is given",)


@over_all("name", ["integration", "least-radius"])
def test_no_mistake_becomes_right_by_a_length_that_is_not_true(name: str):
    exercise, answer_key = issued(name)
    for mistake, hypothesis in answer_key.hypotheses.items():
        wrong = {
            asked.name: round(float(np.real(each.value)), asked.decimals)
            for asked, each in zip(exercise.answers, hypothesis, strict=True)
        }
        for bar in range(95, 106):
            answers = on_true_print(exercise, answer_key, Answers({**wrong, "bar": float(bar)}))
            assert mark(exercise, answer_key, answers).total < exercise.marks, (mistake, bar)


def test_a_drawn_curve_is_brought_back_point_by_point():
    """However its points are numbered, and between the stations too."""
    exercise, answer_key = issued("inversion-translating")
    right = board_chain(Variant(exercise, "Anna", answer_key.draw, answer_key.parameters).task)
    asked = next(each for each in exercise.answers if each.kind == "curve")
    small = on_printed_sheet(exercise, right, Pencil(), 0.98)
    line, true = answer_of(small, asked), answer_of(right, asked)
    middle = (line + np.roll(line, -1)) / 2
    given = Answers({asked.name: np.concatenate([line[::-1], middle]), "bar": 98.0})
    found = np.asarray(on_true_print(exercise, answer_key, given).values[asked.name])
    assert np.abs(found[: line.size] - true[::-1]).max() < 1e-6
    assert np.abs(found[line.size :] - (true + np.roll(true, -1)) / 2).max() < 0.1
    assert np.abs(line - true).max() > 0.5


def test_a_value_near_nought_is_moved_as_far_as_the_print_moves_it():
    """It has no factor: on another print it may lie on the other side of nought."""
    exercise, answer_key = issued("inversion-translating")
    asked, found = next(each for each in exercise.answers if each.name == "y_8"), 0
    for draw in range(40):
        variant = drawn(exercise, "Anna", SECRET, draw)
        right = board_chain(variant.task)
        true, small = (float(answer_of(chain, asked)) for chain in (right, drawn_on_print(exercise, right, 0.98)))
        if abs(small / true - 1) > 0.1:
            known = replace(answer_key, draw=draw, parameters=variant.parameters)
            read = on_true_print(exercise, known, Answers({"y_8": small - 0.7, "bar": 98.0}))
            assert read.values["y_8"] == pytest.approx(true - 0.7)
            found += 1
    assert found


def test_a_sheet_that_is_photographed_has_bars_of_its_own():
    assert "# bar =" in answer_file(find_exercise("inversion-arm"))
    assert "# bar =" not in answer_file(find_exercise("inversion-arm", paper="A4"))


def test_no_answer_of_an_exercise_is_called_so():
    exercise = find_exercise(NAME)
    other = AskedAnswer("Bar", "A length.", "integration", reading="v")
    with pytest.raises(DesignError, match="another name: with bar students tell"):
        replace(exercise, answers=(*exercise.answers, other))

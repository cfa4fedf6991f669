"""A file of corrections is read strictly: what is not understood is said, and nothing is taken of it."""

from __future__ import annotations

import json
import math
import os
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st

from graphcam.errors import TaskError
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.photographs.corrections import (
    Correction,
    StudentCorrections,
    read_corrections,
    student_data,
    to_json,
)

EXERCISE = find_exercise("inversion-translating", paper="A3")
WHOLE = {
    "format": 1,
    "exercise": EXERCISE.name,
    "students": {
        "Anna": {
            "answers": {
                "pitch": {"verdict": "corrected", "value": [[1, 2], [3, 4.5]], "photo": "ab-0"},
                "s_8": {"verdict": "corrected", "value": 12.5, "photo": ""},
            },
            "bars": {"2": [250.5, None]},
            "reviewed": True,
        }
    },
}


def read(tmp_path, said: Any, students=("Anna",)):
    path = tmp_path / "corrections.json"
    path.write_text(said if isinstance(said, str) else json.dumps(said))
    return read_corrections(path, EXERCISE, students)


def test_what_is_written_is_read(tmp_path):
    found = read(tmp_path, WHOLE)
    assert student_data(found["Anna"]) == WHOLE["students"]["Anna"]
    assert json.loads(to_json(EXERCISE, found)) == WHOLE


@given(st.lists(st.complex_numbers(max_magnitude=1999), min_size=1, max_size=9), st.booleans())
def test_any_points_come_back(tmp_path_factory, points, reviewed):
    kept = {"Anna": StudentCorrections({"pitch": Correction("corrected", np.array(points), "x")}, {}, reviewed)}
    found = read(tmp_path_factory.mktemp("any"), to_json(EXERCISE, kept))["Anna"]
    assert found.reviewed is reviewed
    assert np.allclose(np.asarray(found.answers["pitch"].value), points, atol=1e-3)


def changed(path: list[Any], value: Any) -> Any:
    said = json.loads(json.dumps(WHOLE))
    place = said
    for name in path[:-1]:
        place = place[name]
    place[path[-1]] = value
    return said


ANNA = ["students", "Anna"]
PITCH = [*ANNA, "answers", "pitch"]


@pytest.mark.parametrize(
    ("path", "value", "where"),
    [
        (["format"], 2, "format is 2, but must be one of 1"),
        (["format"], True, "format is True"),
        (["exercise"], "whole-cam", "exercise is 'whole-cam', but must be one of inversion-translating"),
        (["more"], 1, "the file is 'format, exercise, students, more'"),
        (["students"], [], "students is a list, but must be a table"),
        (["students", "Zoe"], {}, "students is 'Zoe', but must be ids of this course"),
        ([*ANNA, "reviewed"], "yes", "students.Anna.reviewed"),
        ([*ANNA, "answers", "pitsch"], {}, "one of the answers a_4_return_paper"),
        ([*PITCH, "verdict"], "right", "students.Anna.answers.pitch.verdict is 'right'"),
        ([*PITCH, "verdict"], "confirmed", "students.Anna.answers.pitch.value"),
        ([*PITCH, "photo"], 3, "students.Anna.answers.pitch.photo"),
        ([*PITCH, "value"], [], "students.Anna.answers.pitch.value"),
        ([*PITCH, "value"], [[1, 2, 3]], "students.Anna.answers.pitch.value"),
        ([*PITCH, "value"], [[1, math.nan]], "students.Anna.answers.pitch.value"),
        ([*PITCH, "value"], [[1, math.inf]], "students.Anna.answers.pitch.value"),
        ([*PITCH, "value"], [[1e7, 0]], "but must be within 2000 mm"),
        ([*ANNA, "answers", "s_8", "value"], "12", "students.Anna.answers.s_8.value"),
        ([*ANNA, "answers", "s_8", "verdict"], "confirmed", "one of corrected"),
        ([*ANNA, "bars", "0"], [1, 2], "the number of a page"),
        ([*ANNA, "bars", "²"], [1, 2], "the number of a page"),
        ([*ANNA, "bars", "2"], [1], "two lengths"),
        ([*ANNA, "bars", "2"], [True, None], "a length in mm"),
        ([*ANNA, "bars", "2"], [-5, None], "a length in mm"),
        ([*ANNA, "bars", "2"], [math.nan, None], "a length in mm"),
    ],
)
def test_what_cannot_be_is_refused_with_its_place_and_a_remedy(tmp_path, path, value, where):
    with pytest.raises(TaskError) as caught:
        read(tmp_path, changed(path, value))
    assert where in str(caught.value)
    assert str(caught.value).endswith(("export the corrections from the review page again", "of this course"))


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "\x00", "[" * 100_000, '{"format": 1}'])
def test_what_is_no_file_of_corrections_is_refused(tmp_path, text):
    with pytest.raises(TaskError):
        read(tmp_path, text)


def test_a_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for name in ("pipe", "nothing"):
        with pytest.raises(TaskError, match="check the name"):
            read_corrections(tmp_path / name, EXERCISE, ["Anna"])

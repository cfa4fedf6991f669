"""What a student is told is about the answers that were given, and a record is plain data."""

from __future__ import annotations

import json
import math

import numpy as np
from issued_variants import issued, key, marked, outcomes

from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.marking.feedback import feedback
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.record import Diagnosis, MarkedAnswer

NO_MISTAKE = "No usual mistake explains these answers; go through the wrong steps again."
NOT_TOLD = "These answers do not distinguish this mistake from another one, which is also possible:"


def test_it_is_said_that_no_usual_mistake_explains_what_is_wrong_and_only_then():
    _, answer_key = issued("pressure-angle")
    right = key(answer_key)
    assert NO_MISTAKE not in marked("pressure-angle").feedback
    one_wrong = marked("pressure-angle", D_4=right["D_4"] + 1e6)
    assert one_wrong.diagnosis is None
    assert one_wrong.feedback[-1] == NO_MISTAKE
    assert one_wrong.feedback.count(NO_MISTAKE) == 1
    all_wrong = marked("pressure-angle", **{name: value + 1e6 for name, value in right.items()})
    assert all_wrong.feedback[-1] == NO_MISTAKE
    assert NO_MISTAKE not in mark(*issued("pressure-angle"), Answers({})).feedback


def test_a_mistake_that_is_told_is_said_alone_and_others_are_named_only_where_they_are_alike():
    exercise, _ = issued("pressure-angle")
    told = feedback(exercise, (), Answers({}), Diagnosis("offset-sign", 0.99))
    assert told == (str(misconception("offset-sign").said),)
    in_doubt = feedback(exercise, (), Answers({}), Diagnosis("offset-sign", 0.5, ("rotation-sense", "base-circle")))
    others = [str(misconception(name).said) for name in ("rotation-sense", "base-circle")]
    assert in_doubt == (*told, NOT_TOLD, *others)


def test_the_point_that_is_farthest_off_is_named_as_stations_are_counted():
    _, answer_key = issued("inversion-translating")
    pitch = key(answer_key)["pitch"].copy()
    pitch[7] *= 1.1
    record = marked("inversion-translating", pitch=pitch)
    (said,) = (each for each in record.feedback if each.startswith("pitch"))
    assert "most of all at point 8." in said


def test_how_many_points_were_read_is_said_where_another_number_is_asked():
    exercise, _ = issued("inversion-arm")
    answers = Answers({"rollers": np.array([1j, 2, 3])})
    record = mark(exercise, issued("inversion-arm")[1], answers)
    assert outcomes(record)["rollers"] == "wrong"
    (said,) = (each for each in record.feedback if each.startswith("rollers"))
    assert said.startswith("rollers: points read: 3;")


def test_every_answer_has_its_sentence_first():
    exercise, answer_key = issued("integration")
    right = key(answer_key)
    answers = Answers(
        {"v_2": right["v_2"], "s_5": [], "s_max": right["s_max"] + 1e6, "v_3_return": "x"},
        {"v_3_return": "It says x"},
    )
    said = mark(exercise, answer_key, answers).feedback
    assert said[:4] == (
        "v_2: right.",
        "v_3_return: the answer cannot be read: It says x.",
        "s_5: the answer cannot be read.",
        "s_max: your answer is farther off than careful drawing and calculation allow.",
    )
    assert said[4:8] == tuple(f"{name}: no answer was given." for name in ("s_3_return", "mu_v", "mu_a", "v_max"))


def test_a_record_is_strict_json_all_the_way_down():
    answers = (
        MarkedAnswer("v", "wrong", 0.0, 1.0, given=[[1.0, math.nan]], deviation=math.inf, station=3, off_paper=0.5),
    )
    record = mark(*issued("integration"), Answers({}))
    said = type(record)(**{**vars(record), "answers": answers, "diagnosis": Diagnosis("pole", 0.75, ("other",))})
    found = json.loads(json.dumps(said.to_dict(), allow_nan=False))
    assert found["answers"] == [
        {"name": "v", "outcome": "wrong", "marks": 0.0, "of": 1.0, "given": [[1.0, None]], "deviation": None,
         "station": 3, "off_paper": 0.5},
    ]  # fmt: skip
    assert found["diagnosis"] == {"misconception": "pole", "confidence": 0.75, "alike": ["other"]}
    assert found["total"] == 0.0
    assert found["level"] == "L0"

"""Variants: the same for everybody who knows the secret, different for every student, never a path."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, strategies as st
from issued_variants import SECRET

from graphcam.errors import DesignError, TaskError
from graphcam.exercises.course.roster import MAX_FOLDER_BYTES, folder_name, student_of
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import AskedAnswer, Parameter
from graphcam.exercises.definition.exercise_file import find_exercise, library
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.key.answer_scatter import answers_of, torn
from graphcam.exercises.key.key_making import issue
from graphcam.exercises.key.mistake_separation import forbidden, perfect_hands, plainly_alike
from graphcam.tasks.task import CamTable
from graphcam.tasks.task_file import builtin_task

GOLDEN = {
    "acceleration-and-scales": {
        "back": 68,
        "dwell": 30,
        "law_down": "triangular",
        "law_up": "rectangular",
        "lift": 26,
        "ordinate": 38,
        "pole_1": 31,
        "pole_2": 43,
        "rise": 137,
    },
    "curvature-and-roller": {
        "back": 70,
        "dwell": 20,
        "factor": 0.25,
        "law_down": "3-4-5",
        "law_up": "modified-sine",
        "lift": 43,
        "offset": -21,
        "ordinate": 39,
        "pole_s": 46,
        "pole_v": 35,
        "r0": 53.5,
        "rise": 86,
        "rotation": "ccw",
    },
    "differentiation": {
        "back": 84,
        "dwell": 41,
        "law_down": "modified-sine",
        "law_up": "3-4-5",
        "lift": 21.5,
        "pole_1": 48,
        "pole_2": 37,
        "rise": 137,
    },
    "given-cam": {
        "ascent": 61,
        "base": 35,
        "lift": 14,
        "offset": -13,
        "pole_1": 55,
        "pole_2": 15,
        "roller": 12,
        "rotation": "cw",
        "scale": "2:1",
    },
    "given-cam-positions": {"ascent": 75, "base": 30, "lift": 14, "offset": 12, "roller": 13, "rotation": "cw"},
    "integration": {
        "back": 83,
        "dwell": 32,
        "law_down": "cosine",
        "law_up": "cosine",
        "lift": 40,
        "ordinate": 65,
        "pole_1": 48,
        "pole_2": 21,
        "rise": 107,
    },
    "inversion-arm": {
        "arm": 98,
        "back": 90,
        "distance": 114,
        "dwell": 57,
        "law_down": "cosine",
        "law_up": "modified-sine",
        "lift": 20,
        "r0": 52,
        "rise": 91,
        "roller": 15,
        "rotation": "ccw",
    },
    "inversion-translating": {
        "back": 130,
        "dwell": 49,
        "law_down": "3-4-5",
        "law_up": "cosine",
        "lift": 24.5,
        "offset": 23,
        "r0": 55,
        "rise": 81,
        "roller": 16,
        "rotation": "cw",
    },
    "least-radius": {
        "back": 108,
        "dwell": 40,
        "law_down": "cycloidal",
        "law_up": "cosine",
        "lift": 27.5,
        "limit_down": 46,
        "limit_up": 29,
        "pole": 46,
        "rise": 105,
        "rotation": "cw",
    },
    "least-radius-offset": {
        "back": 85,
        "dwell": 32,
        "law_down": "3-4-5",
        "law_up": "cycloidal",
        "lift": 31,
        "limit_down": 39,
        "limit_up": 26,
        "offset": -18,
        "ordinate": 49,
        "pole_s": 38,
        "pole_v": 38,
        "rise": 77,
        "rotation": "ccw",
    },
    "pressure-angle": {
        "back": 77,
        "dwell": 24,
        "law_down": "cosine",
        "law_up": "modified-sine",
        "lift": 45.5,
        "offset": -21,
        "r0": 59.5,
        "rise": 115,
        "roller": 14,
        "rotation": "ccw",
    },
    "whole-cam": {
        "back": 73,
        "dwell": 20,
        "law_down": "modified-sine",
        "law_up": "cosine",
        "lift": 37,
        "offset": -20,
        "ordinate": 40,
        "pole": 39,
        "r0": 62,
        "rise": 141,
        "roller": 15,
        "rotation": "ccw",
    },
}
"""What Anna gets at the first draw.  A change here gives every student of every running course another task."""


def test_parameters_are_the_same_on_every_machine_and_version():
    assert set(GOLDEN) == set(library())
    for name, parameters in GOLDEN.items():
        assert drawn(find_exercise(name), "Anna", SECRET, 0).parameters == parameters


ISSUED = {
    "acceleration-and-scales": [0, 11, 4],
    "curvature-and-roller": [1, 1, 4],
    "differentiation": [6, 1, 1],
    "given-cam": [0, 1, 0],
    "given-cam-positions": [0, 0, 0],
    "integration": [8, 7, 3],
    "inversion-arm": [9, 0, 0],
    "inversion-translating": [2, 0, 2],
    "least-radius": [7, 3, 1],
    "least-radius-offset": [6, 4, 4],
    "pressure-angle": [13, 5, 2],
    "whole-cam": [1, 0, 0],
}
"""The draws that students a, b and c get."""


@pytest.mark.slow
@pytest.mark.parametrize("name", library())
def test_the_draw_that_is_issued_stays_the_same(name):
    # The choice among draws rests on sampled scatters; their random numbers are those that NumPy keeps for ever.
    exercise = find_exercise(name)
    assert [issue(exercise, student, SECRET)[0].draw for student in "abc"] == ISSUED[name]


def test_exercise_version_student_secret_and_draw_each_matter():
    from dataclasses import replace

    exercise = find_exercise("whole-cam")
    base = drawn(exercise, "Anna", SECRET, 0).parameters
    others = [
        drawn(exercise, "anna", SECRET, 0), drawn(exercise, "Anna", b"other", 0), drawn(exercise, "Anna", SECRET, 1),
        drawn(replace(exercise, version=0), "Anna", SECRET, 0), drawn(replace(exercise, name="x"), "Anna", SECRET, 0),
    ]  # fmt: skip
    assert all(other.parameters != base for other in others)


@pytest.mark.parametrize("student", ["", "=1+1", "../../etc", "\ud800", "a\x00b", "Ж" * 5000, '["a", 1]'])
def test_any_text_is_a_student(student):
    exercise = find_exercise("integration")
    parameters = drawn(exercise, student, SECRET, 0).parameters
    for name, value in parameters.items():
        assert value in exercise.parameters[name].values


def test_every_value_of_a_parameter_is_drawn_about_equally_often():
    exercise = find_exercise("integration")
    counts = dict.fromkeys(exercise.parameters["law_up"].values, 0)
    for k in range(2000):
        counts[drawn(exercise, f"{k}", SECRET, 0).parameters["law_up"]] += 1
    expected = 2000 / len(counts)
    assert sum((n - expected) ** 2 / expected for n in counts.values()) < 16.3  # chi-square, 3 degrees, 0.1 %


def test_variants_of_a_course_differ():
    exercise = find_exercise("pressure-angle")
    seen = {tuple(drawn(exercise, f"{k}", SECRET, 0).parameters.items()) for k in range(300)}
    assert len(seen) == 300


def test_what_cannot_be_told_apart_is_not_promising():
    # Equal laws and equal phases: exchanging the laws changes nothing.
    from dataclasses import replace

    exercise = find_exercise("acceleration-and-scales")
    same = {**exercise.parameters, "law_up": Parameter(choices=("cosine",)), "law_down": Parameter(choices=("cosine",))}
    task = drawn(replace(exercise, parameters=same), "Anna", SECRET, 0).task
    assert forbidden(exercise, plainly_alike(exercise, perfect_hands(exercise, board_chain(task))))


def test_an_exercise_without_a_diagnosable_variant_says_so(monkeypatch):
    from dataclasses import replace

    monkeypatch.setattr("graphcam.exercises.key.key_making.MAX_DRAWS", 2)
    exercise = find_exercise("acceleration-and-scales")
    same = {**exercise.parameters, "law_up": Parameter(choices=("cosine",)), "law_down": Parameter(choices=("cosine",))}
    with pytest.raises(DesignError, match=r"in \d of them '.*' cannot be told from"):
        issue(replace(exercise, parameters=same), "Anna", SECRET)


@given(st.text(max_size=300))
def test_a_folder_is_one_name_and_leads_back_to_the_student(student):
    name = folder_name(student)
    assert name
    assert not set(name) & set('/\\\0\n<>:"|?*')
    assert not name.startswith((".", " "))
    assert not name.endswith((".", " "))
    assert len(name.encode()) <= MAX_FOLDER_BYTES
    if "%~" not in name:
        assert student_of(name) == student


def test_devices_and_paths_are_no_folders():
    for student in ("con", "NUL.txt", "..", ".", "/", "a/../b", "lpt1"):
        name = folder_name(student)
        assert name != student
        assert student_of(name) == student


@given(st.text(alphabet="ab%25EF/.", max_size=8), st.text(alphabet="ab%25EF/.", max_size=8))
def test_two_students_never_share_a_folder(a, b):
    assert a == b or folder_name(a) != folder_name(b)


def test_a_greatest_angle_that_careful_hands_find_on_either_side_is_not_asked_for():
    """At such an offset the angle at the low rest is as great as the one on the rise."""
    exercise = find_exercise("pressure-angle")
    greatest = AskedAnswer("most", "The greatest pressure angle.", "angle_diagram", "max_rise", unit="deg")
    only = replace(exercise, answers=(greatest,))
    for offset, either in ((-18.4, True), (-10.0, False), (-30.0, False)):
        task = builtin_task()
        follower = replace(task.follower, offset=offset, roller_radius=12.0)
        chain = board_chain(replace(task, cam=CamTable(50.0), follower=follower))
        hands = answers_of(only, chain.by(exercise.hand.pencil(200)))
        assert torn(only, chain, hands) is either, offset
        assert torn(exercise, chain, answers_of(exercise, chain.by(exercise.hand.pencil(200)))) is False


def test_a_parameter_stands_within_a_text_too_and_one_that_is_none_is_told():
    exercise = find_exercise("curvature-and-roller")
    variant = drawn(exercise, "Anna", SECRET, 0)
    assert variant.task.follower.roller_rule == f"{variant.parameters['factor']} rho"
    follower = {**exercise.task["follower"], "roller_rule": "{facto} rho"}
    wrong = replace(variant, exercise=replace(exercise, task={**exercise.task, "follower": follower}))
    with pytest.raises(TaskError, match="factor"):
        _ = wrong.task

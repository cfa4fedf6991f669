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
        "back": 81,
        "dwell": 34,
        "law_down": "3-4-5",
        "law_up": "3-4-5",
        "lift": 44,
        "ordinate": 39,
        "pole_1": 34,
        "pole_2": 57,
        "rise": 86,
    },
    "curvature-and-roller": {
        "back": 108,
        "dwell": 50,
        "factor": 0.35,
        "law_down": "3-4-5",
        "law_up": "cycloidal",
        "lift": 27.5,
        "offset": -19,
        "ordinate": 50,
        "pole_s": 38,
        "pole_v": 30,
        "r0": 79.5,
        "rise": 76,
        "rotation": "ccw",
    },
    "differentiation": {
        "back": 65,
        "dwell": 31,
        "law_down": "modified-sine",
        "law_up": "3-4-5",
        "lift": 21.5,
        "pole_1": 29,
        "pole_2": 53,
        "rise": 97,
    },
    "given-cam": {
        "ascent": 59,
        "base": 33.5,
        "lift": 16.5,
        "offset": -11,
        "pole_1": 38,
        "pole_2": 19,
        "roller": 13,
        "rotation": "cw",
        "scale": "2:1",
    },
    "given-cam-positions": {"ascent": 75, "base": 30, "lift": 14, "offset": 12, "roller": 13, "rotation": "cw"},
    "integration": {
        "back": 69,
        "dwell": 36,
        "law_down": "modified-sine",
        "law_up": "modified-sine",
        "lift": 38.5,
        "ordinate": 33,
        "pole_1": 28,
        "pole_2": 60,
        "rise": 115,
    },
    "inversion-arm": {
        "arm": 103,
        "back": 104,
        "distance": 121,
        "dwell": 41,
        "law_down": "cycloidal",
        "law_up": "modified-sine",
        "lift": 19,
        "r0": 55,
        "rise": 84,
        "roller": 18,
        "rotation": "cw",
    },
    "inversion-translating": {
        "back": 63,
        "dwell": 60,
        "law_down": "cosine",
        "law_up": "cosine",
        "lift": 38,
        "offset": -26,
        "r0": 50,
        "rise": 92,
        "roller": 12,
        "rotation": "ccw",
    },
    "least-radius": {
        "back": 75,
        "dwell": 45,
        "law_down": "cycloidal",
        "law_up": "3-4-5",
        "lift": 49,
        "limit_down": 64,
        "limit_up": 32,
        "pole": 44,
        "rise": 121,
        "rotation": "ccw",
    },
    "least-radius-offset": {
        "back": 76,
        "dwell": 33,
        "law_down": "cosine",
        "law_up": "3-4-5",
        "lift": 33.5,
        "limit_down": 50,
        "limit_up": 27,
        "offset": 16,
        "ordinate": 38,
        "pole_s": 42,
        "pole_v": 55,
        "rise": 102,
        "rotation": "cw",
    },
    "pressure-angle": {
        "back": 115,
        "dwell": 22,
        "law_down": "cosine",
        "law_up": "cycloidal",
        "lift": 47,
        "offset": 17,
        "r0": 60,
        "rise": 147,
        "roller": 14,
        "rotation": "ccw",
    },
    "whole-cam": {
        "back": 82,
        "dwell": 43,
        "law_down": "3-4-5",
        "law_up": "cycloidal",
        "lift": 25.5,
        "offset": 17,
        "ordinate": 54,
        "pole": 41,
        "r0": 51.5,
        "rise": 109,
        "roller": 17,
        "rotation": "cw",
    },
}
"""What Anna gets at the first draw.  A change here gives every student of every running course another task."""


def test_parameters_are_the_same_on_every_machine_and_version():
    assert set(GOLDEN) == set(library())
    for name, parameters in GOLDEN.items():
        assert drawn(find_exercise(name), "Anna", SECRET, 0).parameters == parameters


ISSUED = {
    "acceleration-and-scales": [5, 7, 2],
    "curvature-and-roller": [0, 1, 2],
    "differentiation": [3, 0, 5],
    "given-cam": [0, 1, 0],
    "given-cam-positions": [0, 0, 0],
    "integration": [6, 1, 3],
    "inversion-arm": [4, 0, 2],
    "inversion-translating": [1, 0, 7],
    "least-radius": [3, 12, 0],
    "least-radius-offset": [2, 15, 12],
    "pressure-angle": [2, 1, 12],
    "whole-cam": [0, 2, 1],
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

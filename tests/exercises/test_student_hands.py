"""The hands of students: some fine and some coarse, on paper that stretches; whose they are, the lecturer says."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from issued_variants import SECRET
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.drafting.acts import Kind
from graphcam.errors import DesignError, TaskError
from graphcam.exercises.course.course_making import make
from graphcam.exercises.definition.drawn_answers import board_chain, is_length
from graphcam.exercises.definition.exercise_file import find_exercise, load_exercise
from graphcam.exercises.definition.student_hands import HANDS, HandTable
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import answers_of
from graphcam.exercises.key.key_making import issue, key_or_reason

MANY = 400
"""Students, and acts of each: their standard deviations are known within some percent."""


def slips(hand: HandTable, kind: Kind, what: str) -> np.ndarray:
    """The standard deviation of what is off in an act of every student."""
    pencil = hand.pencil(MANY, seed=3)
    return pencil.slips(kind, what, pencil.stream("test"), (MANY, MANY)).std(axis=1)


@pytest.mark.parametrize("name", HANDS)
@pytest.mark.parametrize(
    ("kind", "what", "field", "unit"),
    [
        (Kind.ERECT, "across", "line", 1.0),
        (Kind.LAY_OFF, "along", "dividers", 1.0),
        (Kind.PROTRACTOR, "turn", "protractor_deg", math.radians(1)),
    ],
)
def test_every_student_errs_by_an_own_deviation_between_the_finest_and_the_coarsest(name, kind, what, field, unit):
    own, said = slips(HandTable(name), kind, what) / unit, getattr(HANDS[name], field)
    assert own.min() == pytest.approx(said.least, rel=0.12)
    assert own.max() == pytest.approx(said.greatest, rel=0.12)
    # Evenly between: a quarter of them lies in each quarter.
    quarters, _ = np.histogram(own, np.linspace(said.least, said.greatest, 5))
    assert quarters.min() >= 0.15 * MANY


def test_who_draws_finely_need_not_set_the_dividers_or_the_protractor_finely():
    lines, settings = slips(HandTable(), Kind.ERECT, "across"), slips(HandTable(), Kind.LAY_OFF, "along")
    angles = slips(HandTable(), Kind.PROTRACTOR, "turn")
    together = np.corrcoef([lines, settings, angles])
    assert np.abs(together - np.eye(3)).max() < 3 / math.sqrt(MANY)


def test_some_read_to_half_a_millimetre_and_the_others_to_a_whole_one():
    read = HandTable("usual").pencil(MANY, seed=5).read_off(np.tile(np.linspace(10, 12, 40), (MANY, 1)))
    assert np.all(2 * read == np.round(2 * read))
    whole = np.all(read == np.round(read), axis=1)
    assert 0.4 < whole.mean() < 0.6
    exact = HandTable(division=0.0).pencil(2)
    assert exact.read_off(np.array([[1.23], [4.56]])).tolist() == [[1.23], [4.56]]


def test_stretched_paper_makes_lengths_longer_and_leaves_angles_and_scales():
    """Of hands that err in nothing else: their lengths are off by the paper's part, and by no more than it may be."""
    exercise = find_exercise("whole-cam")
    _, answer_key = issue(exercise, "Anna", SECRET)
    task = drawn(exercise, "Anna", SECRET, answer_key.draw).task
    nothing = HandTable(line=0.0, dividers=0.0, division=0.0, protractor_deg=0.0, stretch=0.01)
    right, hands = board_chain(task), board_chain(task, nothing.pencil(50))
    perfect, given = answers_of(exercise, right), answers_of(exercise, hands)
    for asked, value, read in zip(exercise.answers, perfect, given, strict=True):
        rounding = 0.51 * 10.0**-asked.decimals
        most = 0.01 * abs(float(value)) if is_length(right, asked) else 0.0
        assert np.abs(read - value).max() <= most + rounding
        assert np.abs(read - value).max() >= 0.8 * most - rounding
    lengths = [is_length(right, asked) for asked in exercise.answers]
    assert any(lengths)
    assert not all(lengths)


def test_one_number_is_every_students():
    own = slips(HandTable(line=0.2), Kind.ERECT, "across")
    assert own.std() < 0.05 * own.mean()
    assert own.mean() == pytest.approx(0.2, rel=0.01)


def test_the_same_hands_draw_the_same_again():
    first, again, other = (HandTable().pencil(20, seed=seed) for seed in (1, 1, 2))
    assert first == again
    assert first.stretch_factors.tolist() == again.stretch_factors.tolist() != other.stretch_factors.tolist()


def test_coarser_hands_are_given_wider_tolerances():
    exercise = find_exercise("pressure-angle")
    variant, _ = issue(replace(exercise, hand=HandTable("first-year")), "Anna", SECRET)
    keys = [key_or_reason(replace(variant, exercise=replace(exercise, hand=HandTable(name)))) for name in HANDS]
    found = [each for each in keys if isinstance(each, AnswerKey)]
    careful, usual, first_year = ([key.tolerance for name, key in each.keys.items() if name != "s0"] for each in found)
    assert all(a < b < c for a, b, c in zip(careful, usual, first_year, strict=True))
    # It is calculated from sizes of the text: nothing but its rounding is allowed for.
    calculated = [each.keys["s0"].tolerance for each in found]
    assert calculated == pytest.approx([calculated[0]] * 3, rel=0.05)


@pytest.mark.parametrize(
    ("table", "field"),
    [
        ('name = "clumsy"', "hand.name"),
        ("line = [0.3, 0.1]", "hand.line"),
        ("protractor_deg = -1", "hand.protractor_deg"),
        ("stretch = 1.0", "hand.stretch"),
        ("pen = 1", "pen"),
    ],
)
def test_a_wrong_hand_is_told_by_its_field(tmp_path, table, field):
    text = (find_exercise_text("pressure-angle")).replace("[parameters]", f"[hand]\n{table}\n\n[parameters]", 1)
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    with pytest.raises(TaskError) as caught:
        load_exercise(tmp_path / "mine.toml")
    assert field in str(caught.value)


def find_exercise_text(name: str) -> str:
    """The file of an exercise of the library."""
    from graphcam.exercises.definition.exercise_file import exercise_path

    return exercise_path(name).read_text(encoding="utf-8")


def test_a_file_says_the_finest_and_the_coarsest_student(tmp_path):
    said = '[hand]\nname = "careful"\nline = [0.1, 0.25]\nstretch = 0.001\n\n[parameters]'
    text = find_exercise_text("pressure-angle").replace("[parameters]", said, 1)
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    errors = load_exercise(tmp_path / "mine.toml").hand.errors
    assert errors == HANDS["careful"]._replace(line=(0.1, 0.25), stretch=0.001)


@pytest.mark.slow
def test_a_course_keeps_the_hands_it_was_made_for(tmp_path):
    """Whoever gets a key later, such as one who was not on the roster, gets it by the same hands."""
    roster, secret = tmp_path / "roster.csv", tmp_path / "secret"
    roster.write_text("id\nAnna\n", encoding="utf-8")
    secret.write_bytes(SECRET)
    make("acceleration-and-scales", roster, secret, tmp_path / "course", hand="first-year")
    noted = json.loads((tmp_path / "course/teacher/course.json").read_text(encoding="utf-8"))
    assert noted["hand"] == "first-year"
    exercise = find_exercise("acceleration-and-scales", hand="first-year")
    kept = next((tmp_path / "course/teacher/certificates").iterdir()).read_text(encoding="utf-8")
    assert kept == issue(exercise, "Anna", SECRET)[1].to_json()
    assert kept != issue(find_exercise("acceleration-and-scales"), "Anna", SECRET)[1].to_json()


def test_an_unknown_hand_is_told_on_the_command_line():
    result = CliRunner().invoke(app, ["exercise", "simulate", "integration", "--hand", "usaul"])
    assert result.exit_code == 2
    assert "careful, usual, first-year" in " ".join(result.output.split())
    with pytest.raises(DesignError):
        HandTable("usaul")

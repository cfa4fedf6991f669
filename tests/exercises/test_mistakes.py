"""What is drawn with a mistake is what a student draws who makes it, and which mistakes may be named together."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphcam.constructions.chain import Chain
from graphcam.errors import DesignError
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.key_making import issue
from graphcam.exercises.marking.simulate import key_without, simulate

RISE, BACK, LIFT = 100.0, 80.0, 36.0
PARAMETERS = {
    "whole-cam": {
        "lift": LIFT,
        "rise": RISE,
        "dwell": 40,
        "back": BACK,
        "law_up": "cosine",
        "law_down": "cosine",
        "r0": 60,
        "offset": 14,
        "roller": 15,
        "rotation": "ccw",
        "pole": 40,
        "ordinate": 50,
    },
    "differentiation": {
        "lift": LIFT,
        "rise": RISE,
        "dwell": 40,
        "back": BACK,
        "law_up": "cosine",
        "law_down": "cycloidal",
        "pole_1": 50,
        "pole_2": 30,
    },
}


def right(name: str = "whole-cam", **poles: float) -> Chain:
    """A task of an exercise drawn by a perfect hand."""
    chain = board_chain(Variant(find_exercise(name), "Anna", 0, PARAMETERS[name]).task)
    return replace(chain, board=replace(chain.board, poles=tuple(poles.values()))) if poles else chain


def wrong(name: str, chain: Chain) -> Chain:
    """The same with a mistake."""
    return misconception(name).change(chain)


def test_with_exchanged_angles_the_ordinates_are_in_the_inverse_ratio():
    chain = right()
    drawn = wrong("angles-swapped", chain)
    ratios = [np.divide(*each.acceleration.readings["greatest"].paper) for each in (chain, drawn)]
    assert ratios == pytest.approx([(BACK / RISE) ** 2, (RISE / BACK) ** 2], rel=1e-9)


def test_half_the_lift_is_drawn_alike_and_read_with_half_the_scale():
    chain = right()
    for name in ("s", "v"):
        own, half = (each.integration.readings[name] for each in (chain, wrong("lift-halved", chain)))
        assert half.paper == pytest.approx(own.paper)
        assert half.scale == pytest.approx(own.scale / 2)


def test_exchanged_poles_draw_another_velocity_and_the_same_displacement():
    chain = right(velocity=50.0, displacement=30.0)
    drawn = wrong("poles-swapped: integration", chain).integration.readings
    own = chain.integration.readings
    # The ordinate of v is an area over the pole distance; that of s the same over both.
    assert drawn["v"].paper == pytest.approx(own["v"].paper * 50 / 30)
    assert drawn["s"].paper == pytest.approx(own["s"].paper)
    for name in ("s", "v", "a", "max_v"):
        assert drawn[name].scale == pytest.approx(own[name].scale)


def test_exchanged_poles_of_a_differentiation_draw_the_velocity_with_the_pole_of_the_acceleration():
    chain = right("differentiation")
    drawn, own = (each.differentiation.readings for each in (wrong("poles-swapped: differentiation", chain), chain))
    # A chord's slope times the pole distance: 30 mm where 50 mm are given.
    assert drawn["v"].paper == pytest.approx(own["v"].paper * 30 / 50)
    assert drawn["a"].paper == pytest.approx(own["a"].paper)
    assert drawn["v"].scale == pytest.approx(own["v"].scale)


@pytest.mark.parametrize(("name", "readings"), [("integration", ("s", "v")), ("differentiation", ("rise", "v"))])
def test_a_place_too_late_every_ordinate_is_the_next_one(name, readings):
    chain = right("whole-cam" if name == "integration" else "differentiation")
    late, own = (getattr(each, name).readings for each in (wrong(f"station-too-late: {name}", chain), chain))
    for reading in readings:
        assert late[reading].paper[:-1].tolist() == own[reading].paper[1:].tolist()


@pytest.mark.parametrize(
    ("name", "radius"), [("base-circle", 60 - 15), ("roller-added", 60 + 15), ("prime-diameter", 60 / 2)]
)
def test_the_pitch_curve_starts_on_the_circle_that_is_taken_for_the_prime_circle(name, radius):
    chain = right()
    drawn = wrong(name, chain)
    scale = chain.profile_scale.per_mm
    assert abs(drawn.inversion.points["pitch"][0]) * scale == pytest.approx(radius)
    # The pressure angle is drawn about the same circle: s0 = sqrt(r² - e²).
    assert float(drawn.pressure_angle.readings["s0"].value) == pytest.approx((radius**2 - 14**2) ** 0.5)


@pytest.mark.parametrize(("name", "radius"), [("", 60 - 15), ("roller-outside", 60 + 15), ("roller-diameter", 60 - 30)])
def test_at_rest_the_profile_lies_a_roller_from_the_pitch_curve(name, radius):
    chain = right()
    drawn = wrong(name, chain) if name else chain
    assert float(drawn.working_profile.readings["radius"].value[0]) == pytest.approx(radius)


@pytest.mark.slow
def test_pairs_that_the_exercise_lets_be_alike_are_issued_and_named_together():
    exercise = find_exercise("curvature-and-roller")
    _, answer_key = issue(exercise, "Anna", b"alike")
    assert answer_key.alike == (("numbering-sense", "rotation-sense"),)
    assert answer_key.inseparable_from("rotation-sense") == {"numbering-sense"}
    assert answer_key.inseparable_from("offset-sign") == frozenset()
    assert {"numbering-sense", "rotation-sense"}.isdisjoint(key_without(answer_key, "rotation-sense").hypotheses)
    found = simulate(exercise, b"alike", 2, 10)
    for name in ("numbering-sense", "rotation-sense"):
        assert found.rows[name].named == {name: 20}


def test_what_the_exercise_does_not_let_be_alike_is_not_issued(monkeypatch):
    monkeypatch.setattr("graphcam.exercises.key.key_making.MAX_DRAWS", 2)
    exercise = replace(find_exercise("curvature-and-roller"), alike=())
    with pytest.raises(DesignError, match="diagnosable in 2 draws"):
        issue(exercise, "Anna", b"alike")


def test_only_listed_mistakes_may_be_alike():
    exercise = find_exercise("curvature-and-roller")
    with pytest.raises(DesignError, match=r"alike is 'offset-sgn'.*did you mean 'offset-sign'"):
        replace(exercise, alike=(("rotation-sense", "offset-sgn"),))


def test_a_forgotten_pole_leaves_the_scale_of_either_diagram_without_its_own_pole():
    chain = right("differentiation")
    own, drawn = (each.differentiation.readings for each in (chain, wrong("pole-forgotten: differentiation", chain)))
    # v is drawn with 50 mm and a with 30 mm: mu_v = mu_s/(mu_phi H1), mu_a = mu_v/(mu_phi H2).
    assert drawn["v"].scale == pytest.approx(own["v"].scale * 50)
    assert drawn["a"].scale == pytest.approx(own["a"].scale * 50 * 30)
    chain = right(velocity=45.0, displacement=25.0)
    own, drawn = (each.integration.readings for each in (chain, wrong("pole-forgotten: integration", chain)))
    assert drawn["v"].scale == pytest.approx(own["v"].scale * 25)
    assert drawn["a"].scale == pytest.approx(own["a"].scale * 25 * 45)


def test_the_offset_is_forgotten_or_subtracted():
    chain = right()
    assert float(wrong("offset-forgotten", chain).pressure_angle.readings["s0"].value) == pytest.approx(60)
    assert float(wrong("offset-subtracted", chain).pressure_angle.readings["s0"].value) == pytest.approx(60 - 14)

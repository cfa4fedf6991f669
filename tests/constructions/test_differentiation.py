"""Graphical differentiation by chords and by tangents: its order, its exact cases, and what a hand does to it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from boards import board_of, coursework_motion, order
from numpy.testing import assert_allclose
from over_all import over_all

from graphcam.constructions.chain import Chain
from graphcam.constructions.differentiation import differentiation
from graphcam.constructions.fitted_differentiation import measured_differentiation
from graphcam.drafting.marks import Line, Segments
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.drafting.slips import SQUARE_LENGTH
from graphcam.errors import DesignError
from graphcam.given.boundary_motion import boundary_motion
from graphcam.given.boundary_parts import MotionPoint, PolynomialPart, SplinePart
from graphcam.given.measured import measured_motion
from graphcam.given.motion import FULL_TURN
from graphcam.given.roller_rule import roller_rule

TURN = 360.0
"""One revolution, mm of paper."""
MU_PHI = Scale(FULL_TURN / TURN, "rad")
MU_S = Scale(0.5, "mm")
POLES = (40.0, 50.0)
PARTS = (12, 24, 48, 96)


def displacement(phi):
    """A smooth cyclic motion with no symmetry in which errors could cancel [mm], and its derivatives."""
    s = 20 - 12 * np.cos(phi - 0.3) + 3 * np.sin(2 * phi)
    return s, 12 * np.sin(phi - 0.3) + 6 * np.cos(2 * phi), 12 * np.cos(phi - 0.3) - 12 * np.sin(2 * phi)


def drawn(n: int, by="chords", pencil: Pencil | None = None, x=None):
    x = np.arange(n) * TURN / n if x is None else x
    s = displacement(x * MU_PHI.per_mm)[0] / MU_S.per_mm
    return differentiation(x, s, MU_PHI, MU_S, POLES, pencil or Pencil(), turn=TURN, by=by)


def error(c, name: str) -> float:
    derivative = {"v": 1, "a": 2}[name]
    return np.max(np.abs(c.value(name) - displacement(c.value(f"{name}_at"))[derivative]))


@over_all("by", ["chords", "tangents"])
@over_all("name", ["v", "a"])
def test_the_derivatives_are_of_second_order(name, by):
    assert order(PARTS, [error(drawn(n, by), name) for n in PARTS]) == pytest.approx(2.0, abs=0.1)


def test_chords_are_of_second_order_at_the_middles_and_of_first_at_the_ends():
    """What the textbook warns of: the value of a chord set at the end of its interval is only of first order."""
    at_ends = []
    for n in PARTS:
        c = drawn(n)
        ends = c.value("v_at") + FULL_TURN / n / 2
        at_ends.append(np.max(np.abs(c.value("v") - displacement(ends)[1])))
    assert order(PARTS, at_ends) == pytest.approx(1.0, abs=0.1)


@over_all("by", ["chords", "tangents"])
def test_the_greatest_values_are_of_second_order(by):
    """The greatest values of the closed curve are found by dense points."""
    phi = np.linspace(0, FULL_TURN, 100_001)
    for name, derivative in (("max_v", 1), ("max_a", 2)):
        exact = np.max(np.abs(displacement(phi)[derivative]))
        errors = [abs(float(drawn(n, by).value(name)) - exact) * n**2 for n in PARTS]
        assert max(errors[1:]) < 1.5 * max(errors[0], 20)


UNEQUAL = np.array([0.0, 7.0, 11.0, 26.0, 30.0, 41.0, 60.0, 62.0])


@over_all("x", [np.arange(8) * 10.0, UNEQUAL])
def test_parabolas_are_differentiated_exactly(x):
    y = 3 + 0.4 * x - 0.02 * x**2
    chords, tangents = (differentiation(x, y, MU_PHI, MU_S, POLES, Pencil(), by=by) for by in ("chords", "tangents"))
    for c in (chords, tangents):
        at = c.readings["v_at"].paper
        assert_allclose(c.readings["v"].paper, POLES[0] * (0.4 - 0.04 * at), atol=1e-12)
        assert_allclose(c.readings["a"].paper, POLES[0] * POLES[1] * -0.04, atol=1e-10)
    assert_allclose(chords.readings["v_at"].paper, (x[:-1] + x[1:]) / 2)
    assert_allclose(tangents.readings["v_at"].paper, x)


@over_all("by", ["chords", "tangents"])
def test_unequal_intervals_are_permitted(by):
    """Stations set at random: v is right to second order in the widest interval."""
    errors = []
    for n in (24, 48, 96, 192):
        x = (np.arange(n) + np.random.default_rng(n).uniform(0, 0.5, n)) * TURN / n
        errors.append(error(drawn(n, by, x=x), "v"))
    assert order((24, 48, 96, 192), errors) == pytest.approx(2.0, abs=0.35)


@over_all("by", ["chords", "tangents"])
def test_a_cyclic_diagram_wraps_round(by):
    """Where a turn is begun changes nothing, and the velocity comes to nothing over it."""
    c = drawn(24, by)
    s = c.givens.x, c.points["s"].imag
    shifted = differentiation(s[0], np.roll(s[1], 7), MU_PHI, MU_S, POLES, Pencil(), turn=TURN, by=by)
    for name in ("v", "a"):
        assert c.readings[name].paper.size == 24
        assert_allclose(shifted.readings[name].paper, np.roll(c.readings[name].paper, 7), atol=1e-10)
        assert np.sum(c.readings[name].paper) == pytest.approx(0, abs=1e-10)
        # The greatest ordinate is read over the end of the turn too, wherever that lies.
        turned = [
            differentiation(s[0], np.roll(s[1], k), MU_PHI, MU_S, POLES, Pencil(), turn=TURN, by=by) for k in range(24)
        ]
        assert_allclose([each.value(f"max_{name}") for each in turned], c.value(f"max_{name}"), rtol=1e-9)


@over_all(("by", "v", "a"), [("chords", 11, 10), ("tangents", 12, 12)])
def test_a_diagram_that_ends_has_no_chord_over_its_end(by, v, a):
    x = np.arange(12) * 10.0
    c = differentiation(x, np.sin(x / 40), MU_PHI, MU_S, POLES, Pencil(), by=by)
    assert (c.readings["v"].paper.size, c.readings["a"].paper.size) == (v, a)


def test_the_scales_are_those_of_the_integration():
    """mu_v = mu_s/(mu_phi H1), mu_a = mu_v/(mu_phi H2): differentiation turns the integration round."""
    c = drawn(24)
    assert c.readings["v"].scale == pytest.approx(0.5 / (math.radians(1) * 40))
    assert c.readings["a"].scale == pytest.approx(0.5 / (math.radians(1) ** 2 * 40 * 50))
    assert (c.readings["v"].unit, c.readings["a"].unit) == ("mm/rad", "mm/rad²")


def test_the_integration_of_the_chords_gives_the_displacement_back():
    """Chord by chord, without rounding: the polygon of the integration is that of the differentiation."""
    c = drawn(24)
    x, s = np.append(c.givens.x, TURN), c.points["s"].imag
    rises = c.readings["v"].paper / POLES[0] * np.diff(x)
    assert_allclose(s[0] + np.append(0, np.cumsum(rises)[:-1]), s, atol=1e-10)
    assert_allclose(c.readings["rise"].paper, rises, atol=1e-12)


# --- a hand ----------------------------------------------------------------------------------------------------------

SIGMA, HANDS = 0.1, 2000


def scatter(n: int, name: str, **errors: float) -> float:
    by = "tangents" if "protractor" in errors else "chords"
    c = drawn(n, by, Pencil(samples=HANDS, **(errors or {"line": SIGMA, "dividers": SIGMA})))
    return float(np.mean(np.std(c.readings[name].paper, axis=0)))


def test_the_scatter_of_a_chord_is_the_textbook_s():
    """A chord between two plotted ends that err by sigma: sqrt(2) H sigma/dx; then pole, ray and projection.

    With the slope m the ends err in x as well, by m as much; so does the pole.  The ray's offset is cut slanting, its
    small turn moves the height by H (1 + m^2), and the height errs once more where it is carried over.
    """
    for n in PARTS:
        m = drawn(n).readings["v"].paper / POLES[0]
        ends = 2 * (1 + m**2) * (POLES[0] / (TURN / n)) ** 2
        ray = (1 + m**2) * (1 + (1 + m**2) * (POLES[0] / SQUARE_LENGTH) ** 2)
        expected = SIGMA * np.mean(np.sqrt(ends + m**2 + ray + 1))
        assert scatter(n, "v") == pytest.approx(expected, rel=0.03)


@pytest.mark.slow
def test_the_scatter_grows_as_the_parts_become_finer():
    """As n in the velocity, as n^2 in the acceleration: more parts lower the method's error and raise the hand's.

    The dividers err by much less than the finest part is wide: a run that errs by a good part of itself is no longer
    one whose error counts in proportion.
    """
    fine, much_less = (96, 192, 384), SIGMA / 10
    assert order(fine, [scatter(n, "v", dividers=much_less) for n in fine]) == pytest.approx(-1.0, abs=0.05)
    assert order(fine, [scatter(n, "a", dividers=much_less) for n in fine]) == pytest.approx(-2.0, abs=0.1)


def test_there_is_a_best_number_of_parts():
    hands = {
        n: float(np.mean(np.abs(c.value("v") - displacement(c.value("v_at"))[1])))
        for n in (6, 12, 24, 48, 96)
        for c in [drawn(n, "chords", Pencil(line=0.1, dividers=0.1, seed=4))]
    }
    best = min(hands, key=lambda n: hands[n])
    assert best not in (6, 96)


def test_a_mirror_s_error_does_not_depend_on_the_parts():
    assert scatter(24, "v", protractor=0.01) == pytest.approx(scatter(96, "v", protractor=0.01), rel=0.05)


# --- what cannot be, and the steps -----------------------------------------------------------------------------------


@over_all(
    ("x", "turn"), [([0, 1, 2], None), ([0, 2, 1, 3, 4], None), ([0, 1, 1, 3, 4], None), ([0, 90, 180, 270, 360], 360)]
)
def test_stations_that_cannot_be_are_refused(x, turn):
    with pytest.raises(DesignError, match="stations of the displacement"):
        differentiation(np.array(x, float), np.zeros(len(x)), MU_PHI, MU_S, POLES, Pencil(), turn=turn)


@over_all("by", ["chords", "tangents"])
def test_every_step_is_a_sentence_with_its_marks(by):
    steps = drawn(24, by).steps()
    assert [step.view.name.split()[-1] for step in steps] == [
        *(["displacement"] * 2 + ["velocity"] * 3 + ["acceleration"] * 2 + ["velocity", "acceleration"])
    ]
    for step in steps:
        assert str(step.caption).endswith(".")
        assert "{" not in str(step.caption)
    assert "μᵥ" not in str(steps[0].view.title)
    assert "(mm/rad)/mm" in str(steps[2].view.title)


def test_rays_are_parallel_to_what_they_were_drawn_from():
    c = drawn(24)
    steps = c.steps()
    chords = next(mark for mark in steps[1].marks if isinstance(mark, Line)).points
    rays = next(mark for mark in steps[2].own_marks if isinstance(mark, Segments))
    slopes = np.diff(chords).imag / np.diff(chords).real
    drawn_slopes = (rays.ends - rays.starts).imag / (rays.ends - rays.starts).real
    assert_allclose(np.unique(np.round(slopes * POLES[0], 3)), np.round(drawn_slopes * POLES[0], 3), atol=2e-3)


# --- on the sheet of a measured motion -------------------------------------------------------------------------------


def measured_board(**changes):
    phi = np.radians(np.arange(0, 360))
    motion = measured_motion(phi, np.round(coursework_motion("3-4-5")(phi)[0], 3))
    return board_of(motion, roller_rule=roller_rule("0.4 r0"), **changes)


def test_a_measured_motion_is_differentiated_beside_the_chain():
    chain = Chain(measured_board())
    assert list(chain)[-1] == "differentiation"
    c, integrated = chain["differentiation"], chain["integration"]
    for name in ("s", "v", "a"):
        scale = c.givens.mu_s.per_mm if name == "s" else c.readings[name].scale
        assert scale == pytest.approx(float(integrated.readings[name].scale))
    assert "differentiation" not in Chain(board_of(coursework_motion("3-4-5")))


def test_both_ways_come_to_the_same_motion():
    """Differentiated or integrated: the greatest velocity within the parts' error of either."""
    differences = []
    for n in (12, 24, 48):
        chain = Chain(measured_board(divisions=n))
        values = [float(chain[name].value("max_v")) for name in ("differentiation", "integration")]
        differences.append(abs(values[0] / values[1] - 1))
    assert differences[0] < 0.02
    assert differences[2] < 0.002


def conditioned_motion():
    """A motion by conditions: a polynomial of degree 6 up, back and at rest, and a spline in one part of the turn."""
    low, top = {"s": 0.0, "v": 0.0, "a": 0.0}, MotionPoint(1.4, s=20.0)
    polynomial = PolynomialPart([MotionPoint(0.0, **low), top, MotionPoint(2.6, **low)])
    values = ((3.4, 5.0), (3.9, 12.0), (4.6, 6.0))
    between_ = [MotionPoint(phi, s=s) for phi, s in values]
    return boundary_motion([polynomial, SplinePart([MotionPoint(2.9, **low), *between_, MotionPoint(5.3, **low)], 5)])


@over_all("by", ["chords", "tangents"])
@over_all("name", ["v", "a"])
def test_a_motion_by_conditions_is_differentiated_to_second_order(name, by):
    """Of a motion whose jerk jumps at its joints, away from these; the exact values are its own polynomials'."""
    motion, derivative, errors = conditioned_motion(), {"v": 1, "a": 2}[name], []
    for n in (48, 96, 192, 384):
        x = np.arange(n) * TURN / n
        s = motion(x * MU_PHI.per_mm)[0] / MU_S.per_mm
        c = differentiation(x, s, MU_PHI, MU_S, POLES, Pencil(), turn=TURN, by=by)
        at = c.value(f"{name}_at")
        gaps = np.abs(at[:, None] - np.append(motion.breaks, FULL_TURN)).min(axis=1)
        off = np.abs(c.value(name) - motion(at)[derivative])
        errors.append(np.max(off[gaps > 0.15]))
    assert order((48, 96, 192, 384), errors) == pytest.approx(2.0, abs=0.15)


def test_what_is_differentiated_of_a_motion_by_conditions_is_what_the_chain_integrates():
    """Both of second order: they come together as the parts become finer."""
    differences = []
    for n in (12, 24, 48):
        chain = Chain(board_of(conditioned_motion(), divisions=n))
        integrated, motion = chain["integration"], conditioned_motion()
        mu_s = Scale(float(integrated.readings["s"].scale), "mm")
        parts = n * len(motion.phases)
        drawn_ = measured_differentiation(motion, parts, chain.board.mu_phi, mu_s, POLES, chain.board.paper, Pencil())
        differences.append(abs(float(drawn_.value("max_v")) / float(integrated.value("max_v")) - 1))
    assert differences[-1] < 0.005
    assert differences[-1] < 0.5 * differences[0]


def test_many_hands_differentiate_at_once():
    board = measured_board()
    c = Chain(board, Pencil(line=0.1, samples=50))["differentiation"]
    assert c.readings["v"].paper.shape == (50, 48)
    alone = Chain(board)["differentiation"].readings["v"].value
    assert_allclose(np.mean(c.readings["v"].value, axis=0), alone, atol=1.5)
    assert len(replace(c, draw=c.draw).steps()) == 9

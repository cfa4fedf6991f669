"""The jerk by differentiation of the drawn acceleration: order, exact cases, jumps, and the diagrams over time."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from boards import board_of, coursework, coursework_motion, motion_of, order
from numpy.testing import assert_allclose
from over_all import over_all
from replay import followed, off

import graphcam as gc
from graphcam.comparison.quantities import Comparison
from graphcam.constructions.chain import Chain
from graphcam.constructions.graduation import SYMBOLS, scale_at_speed, time_scale
from graphcam.constructions.jerk import curve_pieces
from graphcam.constructions.working_profile import low_dwells
from graphcam.drafting.marks import AngleMark, Arrow, Label
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.boundary_motion import boundary_motion
from graphcam.given.boundary_parts import MotionPoint, PolynomialPart
from graphcam.given.impact import acceleration_jumps
from graphcam.given.laws import DWELL_TO_DWELL_LAWS, law
from graphcam.given.motion import FULL_TURN

PARTS = (12, 24, 48, 96)
SMOOTH = ("cosine", "cycloidal", "3-4-5", "4-5-6-7", "modified-sine", "modified-trapezoidal")
ROUNDING = 1e-9


def chain_of(motion, divisions=12, pole=10.0, pencil=None, **changes) -> Chain:
    return Chain(board_of(motion, divisions=divisions, jerk_pole=pole, **changes), pencil or Pencil())


def test_the_formula_of_its_scale_names_the_third_pole():
    drawn = chain_of(coursework_motion("cycloidal"))["jerk"]
    (formula,) = drawn.meaning.formulas
    (told,) = formula.values(drawn)
    assert (told["name"], told["source"], told["pole"], told["distance"]) == ("j", "a", "3", 10.0)


def exact(chain: Chain):
    """The jerk in the middle of every part, of the law itself."""
    stations, left = chain.board.stations, chain.board.stations.left
    return chain.board.motion.at(stations.phase[left], (stations.u[left] + stations.u[left + 1]) / 2)[3]


@over_all("name", SMOOTH)
def test_the_jerk_and_its_greatest_value_are_of_second_order(name):
    """Chords between jumps and corners, and a curve carried on straight to their ends, both err as 1/n^2."""
    middles, peaks = [], []
    for n in PARTS:
        chain = chain_of(coursework_motion(name), n)
        middles.append(float(np.max(np.abs(chain["jerk"].value("j") - exact(chain)))))
        top = max(law(name).peak_jerk * phase.lift / phase.angle**3 for phase in chain.board.motion.phases[::2])
        peaks.append(abs(float(chain["jerk"].value("max_j")) - top) / top)
    # Of few parts a stretch between corners has one or two; the cosine keeps its shape under the pole method.
    assert order(PARTS[1:], middles[1:]) == pytest.approx(4.0 if name == "cosine" else 2.0, abs=0.1)
    assert order(PARTS[1:], peaks[1:]) > 1.85


@over_all("name", ["rectangular", "2-3", "triangular", "trapezoidal"])
def test_a_straight_acceleration_is_differentiated_exactly(name):
    """The scale alone is off, by what two integrations leave of the lift; of a part no chord runs across a corner."""
    chain = chain_of(coursework_motion(name))
    drawn, integrated = chain["jerk"], chain["integration"]
    ratio = integrated.readings["a"].per_mm * chain.board.ordinate
    rise = chain.board.motion.phases[0]
    true = rise.normalised.peak_acceleration * rise.lift / rise.angle**2
    assert_allclose(
        drawn.value("j"), exact(chain) * ratio / true, rtol=1e-9, atol=1e-9 * np.abs(exact(chain)).max() + 1e-9
    )


@over_all("name", DWELL_TO_DWELL_LAWS)
def test_the_peak_of_a_law_s_jerk_is_that_of_dense_places(name):
    u = np.linspace(0, 1, 200_001)
    dense = max(np.abs(law(name)(u, side=side)[3]).max() for side in ("left", "right"))
    assert law(name).peak_jerk == pytest.approx(dense, rel=1e-8)


def test_the_published_peak_factors_of_the_jerk():
    """Of the polynomial and the cycloidal law: 60 h/F^3, 52.5, and 4 pi^2."""
    assert law("3-4-5").peak_jerk == pytest.approx(60)
    assert law("4-5-6-7").peak_jerk == pytest.approx(52.5)
    assert law("cycloidal").peak_jerk == pytest.approx(4 * math.pi**2)


def test_the_scale_follows_from_the_pole():
    """mu_j = mu_a/(mu_phi H3)."""
    chain = chain_of(coursework_motion("3-4-5"), pole=12.5)
    mu_a = chain["integration"].readings["a"].per_mm
    assert chain["jerk"].readings["j"].per_mm == pytest.approx(mu_a / (chain.board.mu_phi.per_mm * 12.5))
    assert chain["jerk"].readings["j"].unit == "mm/rad³"
    longer = chain_of(coursework_motion("3-4-5"), pole=25.0)
    assert_allclose(longer["jerk"].value("j"), chain["jerk"].value("j"), rtol=1e-12)


@over_all("name", ["cosine", "rectangular", "3-4-5", "triangular"])
def test_where_the_acceleration_jumps_an_arrow_stands_for_infinity(name):
    chain = chain_of(coursework_motion(name))
    motion, joined = chain.board.motion, chain["jerk"].steps()[2]
    arrows = [mark for mark in joined.marks if isinstance(mark, Arrow)]
    jumps = acceleration_jumps(motion)
    assert len(arrows) == len(jumps) == sum(isinstance(m, Label) and m.text == "∞" for m in joined.marks)
    for arrow, jump in zip(arrows, jumps, strict=True):
        assert arrow.start.real * chain.board.mu_phi.per_mm == pytest.approx(jump.phi or FULL_TURN)
        assert np.sign(arrow.end.imag) == np.sign(jump.size)
    assert ("infinite" in str(joined.caption)) == bool(jumps)


def test_corners_fall_on_stations_only_where_the_jerk_is_drawn():
    plain, asked = coursework("triangular"), coursework("triangular", jerk_pole=10.0)
    assert len(plain.stations.stretches) == 2
    assert len(asked.stations.stretches) == len(curve_pieces(asked.stations)) == 6
    assert "jerk" not in Chain(plain)
    assert list(Chain(asked))[3] == "jerk"


@over_all("divisions", [2, 3])
@over_all("name", ["cycloidal", "modified-trapezoidal"])
def test_few_parts_are_drawn_too(name, divisions):
    """Of a stretch of one part the curve is level: no slope of the jerk is known there."""
    chain = chain_of(coursework_motion(name), divisions)
    assert np.isfinite(chain["jerk"].value("j")).all()
    assert len(chain["jerk"].steps()) == 4


def test_a_motion_by_conditions_has_its_jerk_drawn():
    low = {"s": 0.0, "v": 0.0, "a": 0.0}
    points = [MotionPoint(0.0, **low), MotionPoint(1.2, s=20.0), MotionPoint(2.5, **low)]
    errors = []
    for n in PARTS:
        chain = chain_of(boundary_motion([PolynomialPart(points)]), n)
        errors.append(float(np.max(np.abs(chain["jerk"].value("j") - exact(chain)))))
    assert order(PARTS, errors) == pytest.approx(2.0, abs=0.2)


def test_a_second_board_comes_to_the_same_readings():
    """The acts alone, replayed by other code, give what was read."""
    drawn = chain_of(coursework_motion("modified-trapezoidal"))["jerk"]
    readings, _ = followed(drawn)
    for name, reading in drawn.readings.items():
        assert off(reading.paper, readings[name]) < ROUNDING, name


def test_every_part_tells_what_it_draws():
    for step in chain_of(coursework_motion("cosine"), omega=12.0)["jerk"].steps():
        assert str(step.caption).endswith(".")
        assert not str(step.why).startswith("Because")
        assert step.parts


def test_chords_and_rays_are_runs_with_a_worked_part():
    chords, rays, joined, scale = chain_of(coursework_motion("cosine"), omega=12.0)["jerk"].steps()
    ways = [complex(place.draws[0].directions.item()) for place in chords.places]
    heights = [place.draws[1].place.imag for place in rays.places]
    k = int(np.argmax(np.abs(heights)))
    for step, noun, settings in (
        (chords, "Chord", [f"{way.real:.2f} mm across, {updown(way.imag)}" for way in ways]),
        (rays, "Ray", [updown(height) for height in heights]),
    ):
        (part,) = step.parts
        assert [str(row.setting) for row in part.rows] == settings
        assert {str(row.name).split()[0] for row in part.rows} == {noun}
        assert str(part.rows[k].name).lower() in str(part.caption).lower()
        assert f"{settings[k]}." in str(part.caption)
    assert [str(row.name) for row in joined.parts[0].rows] == ["From 0 to 12", "From 0′ to 12′"]
    assert "m/s³" in str(scale.caption)
    constant = chain_of(coursework_motion("rectangular"))["jerk"].steps()[-1]
    assert "0.00 mm" not in str(constant.caption)
    assert str(constant.caption).endswith("so the finite jerk is zero.")


def updown(mm: float) -> str:
    return f"{abs(mm):.2f} mm {'up' if mm > 0 else 'down'}"


def test_a_hand_scatters_the_jerk_more_than_the_acceleration():
    """Differentiation enlarges: relative to the greatest value, a part's jerk scatters more than v does."""
    hand = Pencil(line=0.1, dividers=0.1, samples=200, seed=3)
    chain = chain_of(coursework_motion("cycloidal"), pencil=hand)
    j, v = chain["jerk"].readings["j"].value, chain["integration"].readings["v"].value
    assert j.shape[0] == 200
    scatter = [float(np.std(x, axis=0).max() / np.abs(x.mean(axis=0)).max()) for x in (j, v)]
    assert scatter[0] > 2 * scatter[1]


def test_the_greatest_jerk_is_compared_and_keeps_its_bound():
    task = gc.builtin_task()
    solution = gc.solve(replace(task, drawing=replace(task.drawing, jerk=True)))
    assert "max_j" in solution.comparison.quantities
    chain = chain_of(coursework_motion("3-4-5"))
    follower = chain.board.follower.built(chain.place, chain.roller_radius)
    cam = gc.Cam(chain.board.motion, follower, chain.prime_radius, chain.board.rotation)
    quantity = Comparison(chain, cam).quantities["max_j"]
    assert abs(quantity.error_paper) <= quantity.tolerance_paper
    assert quantity.exact == pytest.approx(60 * 30 / math.radians(60) ** 3)


# --- over time -------------------------------------------------------------------------------------------------------


def test_the_scales_over_time_are_those_of_differences():
    """With s(t) = s(phi), t = phi/omega, the derivatives by t are those by phi times powers of omega; mm become m."""
    omega, motion, step = 12.0, coursework_motion("4-5-6-7"), 1e-4
    phi = np.array([0.4, 0.7, 1.1])
    _, *rates = motion(phi)
    for symbol, per_radian, order_ in zip(SYMBOLS, rates, (1, 2, 3), strict=True):
        at = scale_at_speed(1.0, symbol, omega, "mm")
        t = step / omega
        sides = [motion(phi + k * step)[order_ - 1] for k in (-1, 1)]
        below = scale_at_speed(1.0, SYMBOLS[order_ - 2], omega, "mm").per_mm if order_ > 1 else 1e-3
        assert_allclose(per_radian * at.per_mm, (sides[1] - sides[0]) * below / (2 * t), rtol=1e-5, atol=1e-4)
    assert time_scale(Scale(math.radians(1), "rad"), omega).per_mm * 360 == pytest.approx(2 * math.pi / omega)


def test_published_speeds_are_read_in_the_second_scale():
    """A solved textbook problem: harmonic, lift 50, 120 and 60 degrees, 100 rpm: 0.39, 0.785 m/s, 6.17, 24.67 m/s^2."""
    motion, omega = motion_of((50, 120, "cosine"), (0, 30), (-50, 60, "cosine")), 100 * math.tau / 60
    integrated = Chain(board_of(motion, omega=omega))["integration"]
    v, a = (scale_at_speed(integrated.readings[n].per_mm, n, omega, "mm").per_mm for n in "va")
    assert float(integrated.first("max_v")) * v == pytest.approx(0.785, rel=0.01)
    assert float(integrated.first("max_a")) * a == pytest.approx(24.67, rel=0.01)


def test_without_a_speed_no_time_is_drawn_and_with_one_every_diagram_has_it():
    def texts(chain):
        marks = (mark for drawn in chain.values() for step in drawn.steps() for mark in (*step.marks, *step.under))
        return [str(mark.text) for mark in marks if hasattr(mark, "text")]

    motion = coursework_motion("3-4-5")
    assert not [text for text in texts(Chain(board_of(motion))) if "m/s" in text or text.startswith("t, ")]
    timed = texts(Chain(board_of(motion, omega=4 * math.pi, jerk_pole=4.0)))
    for said in ("v, m/s", "a, m/s²", "j, m/s³", "t, s", "μₜ = 0.001389 s/mm"):
        assert said in timed
    assert "0.5" in timed  # the end of the turn


# --- the arc of the lower dwell --------------------------------------------------------------------------------------


@over_all("rotation", ["cw", "ccw"])
@over_all("dwell", [5.0, 100.0, 175.0, 181.0, 215.0])
def test_the_arc_of_the_lower_dwell_has_the_dwell_s_angle(rotation, dwell):
    """At rest the normal goes through the cam centre, so that the touch point turns with the roller's centre."""
    rest = 360 - dwell
    motion = motion_of((20, 0.5 * rest, "3-4-5"), (-20, 0.5 * rest, "3-4-5"))
    chain = Chain(board_of(motion, rotation=rotation, prime_radius=60.0, roller_radius=10.0))
    assert_allclose(np.degrees(chain["working_profile"].value("low_dwells")), [dwell], rtol=1e-12)
    last = chain["working_profile"].steps()[-2]
    (mark,) = [mark for mark in last.marks if isinstance(mark, AngleMark)]
    assert math.degrees(mark.end - mark.start) == pytest.approx(dwell)
    assert str(mark.text) == f"δ₃ = {dwell:.1f}°"


def test_a_cam_without_a_lower_dwell_has_no_such_arc():
    motion = motion_of((20, 120, "cycloidal"), (0, 60), (-20, 180, "cycloidal"))
    chain = Chain(board_of(motion, prime_radius=60.0, roller_radius=10.0))
    assert low_dwells(chain["inversion"]) == []
    assert "low_dwells" not in chain["working_profile"].readings

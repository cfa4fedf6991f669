"""Drawings at the edge of what can be drawn: few parts, many, lines that hardly cross, phases that hardly last."""

from __future__ import annotations

import math

import numpy as np
import pytest
from boards import SIZES, board_of, coursework, coursework_motion, limits, motion_of
from over_all import over_all

import graphcam as gc
from graphcam.constructions.chain import Chain
from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError
from graphcam.given.laws import LAWS
from graphcam.given.roller_rule import roller_rule


def all_finite(chain: Chain, *names: str) -> bool:
    return all(np.isfinite(kept.value).all() for name in names for kept in chain[name].readings.values())


# --- few parts -------------------------------------------------------------------------------------------------------


@over_all("law", [law for law in LAWS if law != "rectangular"])
def test_a_phase_of_one_part_has_nothing_at_its_middle(law):
    """A symmetrical law crosses zero there: the drawing stays flat, and no lift can fix its scale."""
    with pytest.raises(DesignError, match=r"maximum displacement on paper .* divide into more parts"):
        _ = Chain(coursework(law, divisions=1))["integration"]


@over_all("law", LAWS)
def test_two_parts_a_phase_are_drawn_to_the_end(law):
    chain = Chain(coursework(law, divisions=2))
    names = [name for name in chain if name != "curvature"]
    assert all_finite(chain, *names)
    assert chain["integration"].readings["s"].value.tolist() == pytest.approx([0, 15, 30, 30, 15, 0], abs=1e-12)


def test_parts_too_few_for_three_points_leave_the_dwells_alone():
    """Constant acceleration in two parts has no triple that does not cross the jump."""
    chain = Chain(coursework("rectangular", divisions=2, offset=0.0), decided=SIZES)
    moving, resting = chain["curvature"].readings["rho_candidates"].value
    assert np.isnan(moving)
    assert resting == pytest.approx(46, rel=1e-12)
    assert chain["curvature"].readings["rho"].value == resting


def test_where_no_bend_is_readable_the_rule_rests_on_the_prime_radius_alone():
    motion = motion_of((30, 180, "rectangular"), (-30, 180, "rectangular"))
    chain = Chain(board_of(motion, divisions=2, offset=0.0, prime_radius=50.0))
    assert np.isnan(chain["curvature"].readings["rho"].value)
    assert "The curvature cannot be read" in str(chain["curvature"].steps()[0].caption)
    assert chain["roller"].readings["roller_radius"].value == pytest.approx(20.0, rel=1e-12)
    assert "0.7 ρ, which cannot be read" in str(chain["roller"].steps()[0].caption)
    with pytest.raises(DesignError, match="roller radius by the rule"):
        _ = Chain(
            board_of(motion, divisions=2, offset=0.0, prime_radius=50.0, roller_rule=roller_rule("rho - 4"))
        ).roller_radius


# --- many parts ------------------------------------------------------------------------------------------------------


@over_all("law", LAWS)
def test_96_parts_a_phase_are_drawn_to_the_end(law):
    chain = Chain(coursework(law, divisions=96))
    assert all_finite(chain, *chain)
    exact = chain.board.motion.at(chain.board.stations.phase, chain.board.stations.u)[0]
    assert np.abs(chain["integration"].readings["s"].value - exact).max() < 30 * 1e-4


# --- lines that hardly cross -----------------------------------------------------------------------------------------


@over_all(("offset", "degrees"), [(None, 0.4), (-10.0, 0.9)])
@over_all("rounding", [None, 1.0])
def test_lines_that_cross_below_one_degree_leave_no_radius_to_adopt(offset, degrees, rounding):
    chain = Chain(coursework("3-4-5", offset=offset, limits=limits(degrees), rounding=rounding))
    region = chain["minimum_radius"]
    assert np.isnan(region.readings["prime_radius"].value)
    last = region.steps()[-1]
    assert "at less than a degree" in str(last.caption)
    assert last.marks == ()
    with pytest.raises(DesignError, match=r"permitted pressure angle on the rise .* give .*cam.prime_radius"):
        _ = chain.prime_radius
    with pytest.raises(DesignError, match="permitted pressure angle on the rise"):
        _ = chain["inversion"]


def test_a_given_prime_radius_does_without_a_readable_region():
    chain = Chain(coursework("3-4-5", limits=limits(0.4), prime_radius=60.0))
    assert np.isnan(chain["minimum_radius"].readings["prime_radius"].value)
    assert all_finite(chain, "pressure_angle", "angle_diagram", "inversion", "working_profile")


def test_lines_that_cross_just_above_one_degree_are_read():
    motion = coursework_motion("rectangular")
    exact = gc.minimum_radius(motion, gc.Translating(), "cw", math.radians(0.51))
    region = Chain(board_of(motion, offset=None, limits=limits(0.51)))["minimum_radius"]
    assert region.readings["prime_radius"].value == pytest.approx(exact.prime_radius, rel=1e-10)


# --- phases that hardly last -----------------------------------------------------------------------------------------


@over_all("degrees", [1.0, 0.01])
def test_a_steep_phase_is_drawn_by_a_perfect_hand(degrees):
    motion = motion_of((30, degrees, "3-4-5"), (0, 100), (-30, degrees, "cosine"))
    chain = Chain(board_of(motion, offset=0.0, prime_radius=50.0, roller_radius=1.0))
    exact = motion.at(chain.board.stations.phase, chain.board.stations.u)[0]
    readings = chain["integration"].readings
    assert np.abs(readings["s"].value - exact).max() / 30 == pytest.approx(0.0041, abs=1e-4)
    peak = 1.875 * 30 / math.radians(degrees)
    assert readings["max_v"].value == pytest.approx(peak, rel=0.01)


DOWNWARDS = 1
"""The seed of a hand that draws this lift downwards."""


def test_a_diagram_too_narrow_for_the_hand_is_an_error_and_a_miss_in_the_samples_it_spoils():
    """Over 0.3 degrees the lift is far below a hand's error: some samples do not rise at all."""
    board = coursework("cosine", prime_radius=50.0)
    narrow = board_of(motion_of((30, 0.3, "cosine"), (0, 100), (-30, 0.3, "cosine")), prime_radius=50.0)
    hands = Chain(narrow, Pencil(line=0.2, samples=200, seed=1))
    scale = hands["integration"].readings["s"].scale
    spoilt = np.isnan(scale)
    assert 0 < spoilt.sum() < 200
    assert np.all(scale[~spoilt] > 0)
    assert np.isnan(hands["integration"].readings["s"].value).any(axis=1).tolist() == spoilt.tolist()
    with pytest.raises(DesignError, match="maximum displacement on paper"):  # one drawing has no other sample to show
        _ = Chain(narrow, Pencil(line=0.2, seed=DOWNWARDS))["integration"]
    assert not np.isnan(Chain(board, Pencil(line=0.2, samples=200))["integration"].readings["s"].value).any()


@over_all("lift", [1e-6, 1e6])
def test_very_small_and_very_large_lifts_are_only_a_matter_of_scale(lift):
    chain = Chain(board_of(motion_of((lift, 80, "cosine"), (0, 45), (-lift, 60, "cosine")), offset=None))
    unit = Chain(board_of(motion_of((1, 80, "cosine"), (0, 45), (-1, 60, "cosine")), offset=None))
    radius = chain["minimum_radius"].readings["prime_radius"].value / lift
    assert radius == pytest.approx(unit["minimum_radius"].readings["prime_radius"].value, rel=1e-12)
    assert chain.prime_radius >= radius * lift
    assert all_finite(chain, "inversion", "curvature")


# --- phases in any order ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "phases",
    [
        ((-30, 80, "rectangular"), (0, 40), (30, 100, "rectangular", 2.0)),
        ((0, 30), (30, 80, "rectangular"), (-30, 100, "rectangular")),
        ((10, 40, "rectangular"), (-30, 100, "rectangular"), (20, 80, "rectangular")),
        ((10, 40, "rectangular"), (0, 20), (20, 80, "rectangular"), (-5, 60, "rectangular"), (-25, 100, "rectangular")),
    ],
    ids=["return first", "dwell first", "below the start", "in stages"],
)
def test_phases_in_any_order_are_set_one_on_the_end_of_the_other(phases):
    chain = Chain(board_of(motion_of(*phases)))
    stations = chain.board.stations
    s, v, a, _ = chain.board.motion.at(stations.phase, stations.u)
    readings = chain["integration"].readings
    for name, exact in (("s", s), ("v", v), ("a", a)):
        assert np.abs(readings[name].value - exact).max() < 1e-12 * np.abs(exact).max()
    cam = gc.Cam(chain.board.motion, gc.Translating(-10.0, chain.roller_radius), chain.prime_radius, "cw")
    drawn = np.stack([chain["inversion"].readings[key].value for key in "xy"], axis=-1)
    assert np.abs(drawn - cam.pitch_curve(stations.phi)).max() < 1e-11

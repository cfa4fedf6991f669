"""The error budget: shares of the variance by kind of act, which add up where errors are passed on in proportion."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from boards import SIZES, coursework

import graphcam as gc
from graphcam.comparison.bounds import ErrorBudget
from graphcam.constructions.chain import Chain
from graphcam.drafting.acts import Kind
from graphcam.drafting.slips import SLIPS

HANDS = gc.Pencil.of(0.02, samples=2000, seed=3)
"""Errors so small that they are passed on in proportion."""
WITHIN = 6 / math.sqrt(HANDS.samples or 1)
"""Of a variance, what the errors of 2000 hands may have in common by chance."""


# First those that draw for themselves: what the others share is large too, and kept until the last of them.


@pytest.mark.slow
def test_what_errors_bring_only_together_is_told_apart():
    """Where the sharpest place is told from its neighbours by less than the hand errs, no kind alone is to blame."""
    chain = gc.solve(gc.builtin_task()).chain
    coarse = ErrorBudget(chain, gc.Pencil.of(0.2, samples=1000)).of("curvature", "rho")
    assert coarse.together > 0.2
    assert sum(coarse.of.values()) + coarse.together == pytest.approx(1.0)
    fine = ErrorBudget(chain, gc.Pencil.of(0.0002, samples=1000)).of("curvature", "rho")
    assert fine.together < 0.01
    assert fine.of[Kind.BISECT] > 0.01


def test_an_angle_next_to_the_half_turn_scatters_by_what_it_is_off():
    """Hands read 179 and -179 degrees of one place: they differ by two."""
    chain = gc.solve(gc.builtin_task("flat")).chain
    read = chain["inversion"].readings["polar_angle"].paper
    assert np.abs(np.pi - np.abs(read)).min() < 0.05
    assert ErrorBudget(chain, gc.Pencil.of(0.2)).of("inversion", "polar_angle").deviation < 0.03


def test_the_scatter_is_in_mm_of_paper_and_follows_the_pencil():
    chain = Chain(coursework("3-4-5"), decided=SIZES)
    of: list[list[float]] = []
    for sigma in (0.01, 0.02):
        # One after the other: all drawings of 2000 hands fill hundreds of MB.
        budget = ErrorBudget(chain, replace(HANDS, line=sigma, dividers=sigma, protractor=0))
        of.append([budget.of(*reading).deviation for reading in LINEAR[:4]])
    one, two = of
    assert np.divide(two, one) == pytest.approx(np.full(4, 2.0), rel=0.01)


@pytest.fixture(scope="module")
def budget() -> ErrorBudget:
    return ErrorBudget(Chain(coursework("3-4-5"), decided=SIZES), HANDS)


LINEAR = [
    ("acceleration", "middles"),
    ("integration", "s"),
    ("integration", "closing_v"),
    ("minimum_radius", "prime_radius"),
    ("pressure_angle", "s0"),
    ("inversion", "radius"),
    ("inversion", "x"),
    ("inversion", "polar_angle"),
]


def variance(hands, construction: str, reading: str) -> np.ndarray:
    return np.atleast_1d(hands[construction].readings[reading].value.var(axis=0))


@pytest.mark.parametrize(("construction", "reading"), LINEAR)
def test_the_variances_of_all_kinds_of_acts_add_up_to_that_of_the_whole(budget, construction, reading):
    whole, *alone = (variance(hands, construction, reading) for hands in budget.hands.values())
    most = int(np.argmax(whole))
    assert sum(part[most] for part in alone) == pytest.approx(whole[most], rel=WITHIN)
    shares = budget.of(construction, reading)
    assert sum(shares.of.values()) + shares.together == pytest.approx(1.0)
    assert shares.together < 1e-3  # nothing but what is small of second order
    per_mm = budget.perfect[construction].readings[reading].per_mm
    assert shares.deviation == pytest.approx(math.sqrt(whole[most]) / per_mm, rel=1e-9)
    for kind, part in zip(list(budget.hands)[1:], alone, strict=True):
        assert kind is not None
        assert shares.of[kind] == pytest.approx(part[most] / whole[most], rel=WITHIN, abs=1e-12)


@pytest.mark.parametrize(
    ("construction", "reading", "kind"),
    [("acceleration", "base", Kind.LAY_OFF), ("acceleration", "greatest", Kind.LAY_OFF)],
)
def test_the_only_act_of_a_reading_brings_all_of_its_scatter(budget, construction, reading, kind):
    shares = budget.of(construction, reading)
    assert shares.of[kind] == pytest.approx(1.0, abs=1e-12)
    assert all(share == 0 for other, share in shares.of.items() if other is not kind)
    assert shares.deviation == pytest.approx(HANDS.dividers, rel=WITHIN)


def test_a_pencil_that_errs_in_one_way_has_only_those_acts_in_its_budget():
    chain = Chain(coursework("3-4-5"), decided=SIZES)
    for error in ("line", "dividers", "protractor"):
        pencil = gc.Pencil(**{error: 0.01}, samples=50)
        kinds = {kind for kind in ErrorBudget(chain, pencil).hands if kind}
        assert kinds == {kind for kind, slips in SLIPS.items() if error in {slip.of for slip in slips.values()}}

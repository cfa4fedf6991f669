"""The hand: sizes of its errors, and streams that do not disturb each other."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError

MANY = 40_000
FOUR_SIGMA = 4 / math.sqrt(2 * MANY)
"""Four standard errors of a standard deviation from that many draws, relative."""


def test_the_default_pencil_is_perfect():
    pencil = Pencil()
    assert pencil.perfect
    hand = pencil.hand("integration")
    for errors in (hand.line(3), hand.dividers(3), hand.protractor(3), hand.point(3)):
        assert errors.tolist() == [0, 0, 0]
    assert hand.read(np.array([1.23456])).tolist() == [1.23456]


@pytest.mark.parametrize("kind", ["line", "dividers", "division", "protractor"])
def test_a_pencil_with_any_error_is_not_perfect(kind):
    assert not Pencil(**{kind: 0.1}).perfect


@pytest.mark.parametrize("kind", ["line", "dividers", "protractor"])
def test_the_scatter_of_each_move_is_its_own_sigma(kind):
    hand = Pencil(**{kind: 0.3}).hand("integration")
    others = [name for name in ("line", "dividers", "protractor") if name != kind]
    errors = getattr(hand, kind)(MANY)
    assert errors.std() == pytest.approx(0.3, rel=FOUR_SIGMA)
    assert abs(errors.mean()) < 4 * 0.3 / math.sqrt(MANY)
    assert all(not getattr(hand, name)(5).any() for name in others)


def test_a_point_scatters_alike_in_every_direction():
    errors = Pencil(line=0.2).hand("inversion").point(MANY)
    for turn in (0, 0.7, math.pi / 2):
        assert (errors * np.exp(1j * turn)).real.std() == pytest.approx(0.2, rel=FOUR_SIGMA)
    assert abs(np.corrcoef(errors.real, errors.imag)[0, 1]) < 4 / math.sqrt(MANY)


def test_samples_come_first():
    pencil = Pencil(line=0.2, samples=5)
    assert pencil.hand("integration").line(7).shape == (5, 7)
    assert pencil.sheets([[1.0, 2.0]]).shape == (5, 1, 2)
    assert pencil.sheets(3.0).shape == (5,)
    assert Pencil(samples=1).sheets([1.0]).shape == (1, 1)
    assert Pencil().sheets([1.0]).shape == (1,)


def test_samples_are_independent():
    errors = Pencil(line=1.0, samples=2).hand("integration").line(MANY)
    assert abs(np.corrcoef(errors)[0, 1]) < 4 / math.sqrt(MANY)


def test_a_stream_depends_on_the_seed_and_the_construction_alone():
    def drawn(name: str, seed: int) -> list[float]:
        return Pencil(line=0.2, seed=seed).hand(name).line(4).tolist()

    alone = drawn("roller", 7)
    pencil = Pencil(line=0.2, seed=7)
    pencil.hand("curvature").line(1000)
    assert pencil.hand("roller").line(4).tolist() == alone
    assert pencil.hand("roller").line(4).tolist() == alone  # taken up again, it starts again
    assert drawn("curvature", 7) != alone
    assert drawn("roller", 8) != alone


def test_the_errors_of_the_same_move_grow_with_the_pencil():
    thin, thick = (Pencil(line=sigma, seed=3).hand("integration").line(9) for sigma in (0.1, 0.4))
    assert_allclose(thick, 4 * thin, rtol=1e-14)


def test_readings_are_rounded_to_the_division():
    hand = Pencil(division=0.5).hand("integration")
    assert hand.read(np.array([0.24, 0.26, -3.3, 10.76])).tolist() == [0.0, 0.5, -3.5, 11.0]
    paper = np.linspace(0, 50, 1001)
    read = hand.read(paper)
    assert np.abs(read - paper).max() <= 0.25
    assert_allclose(read * 2, np.round(read * 2))


@pytest.mark.parametrize(
    ("wrong", "quantity"),
    [
        ({"line": -0.1}, "pencil line"),
        ({"dividers": math.nan}, "pencil dividers"),
        ({"division": math.inf}, "pencil division"),
        ({"protractor": -1}, "pencil protractor"),
        ({"samples": 0}, "pencil samples"),
        ({"seed": -1}, "pencil seed"),
    ],
)
def test_a_pencil_that_cannot_be_says_what_is_wrong(wrong, quantity):
    with pytest.raises(DesignError) as caught:
        Pencil(**wrong)
    assert caught.value.quantity == quantity
    assert str(next(iter(wrong.values()))) in str(caught.value)

"""The pencil: what it may be, and streams of random numbers that do not disturb each other."""

from __future__ import annotations

import math

import numpy as np
import pytest

from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError

MANY = 40_000


def test_the_default_pencil_is_perfect():
    assert Pencil().perfect


@pytest.mark.parametrize("kind", ["line", "dividers", "division", "protractor"])
def test_a_pencil_with_any_error_is_not_perfect(kind):
    assert not Pencil(**{kind: 0.1}).perfect


def test_samples_come_first():
    pencil = Pencil(line=0.2, samples=5)
    assert pencil.sheets([[1.0, 2.0]]).shape == (5, 1, 2)
    assert pencil.sheets(3.0).shape == (5,)
    assert Pencil(samples=1).sheets([1.0]).shape == (1, 1)
    assert Pencil().sheets([1.0]).shape == (1,)


def test_a_stream_depends_on_the_seed_and_the_construction_alone():
    def drawn(name: str, seed: int) -> list[float]:
        return Pencil(line=0.2, seed=seed).stream(name).standard_normal(4).tolist()

    alone = drawn("roller", 7)
    pencil = Pencil(line=0.2, seed=7)
    pencil.stream("curvature").standard_normal(1000)
    assert pencil.stream("roller").standard_normal(4).tolist() == alone
    assert pencil.stream("roller").standard_normal(4).tolist() == alone  # taken up again, it starts again
    assert drawn("curvature", 7) != alone
    assert drawn("roller", 8) != alone


def test_two_streams_are_independent():
    pencil = Pencil(line=0.2, seed=7)
    streams = [pencil.stream(name).standard_normal(MANY) for name in ("roller", "curvature")]
    assert abs(np.corrcoef(streams)[0, 1]) < 4 / math.sqrt(MANY)


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

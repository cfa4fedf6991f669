"""Scales: mu machine units for a millimetre of paper."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings, strategies as st

from graphcam.drafting.scale import STANDARD_RATIOS, Scale, ratio_text, standard_scale
from graphcam.errors import DesignError

same_every_time = settings(derandomize=True, deadline=None, max_examples=150)


@same_every_time
@given(st.floats(1e-6, 1e6), st.floats(-1e3, 1e3))
def test_paper_is_the_inverse_of_value(mu, length):
    scale = Scale(mu, "mm")
    assert scale.paper(scale.value(length)) == pytest.approx(length, rel=1e-15)
    assert scale.value(length) == mu * length


@pytest.mark.parametrize("mu", [0.0, -1.0, math.nan, math.inf])
def test_a_scale_that_cannot_be_says_so(mu):
    with pytest.raises(DesignError, match="scale"):
        Scale(mu, "mm")


@same_every_time
@given(st.floats(1e-2, 1e4), st.floats(10, 1e3))
def test_the_standard_scale_is_the_largest_that_fits(size, room):
    mu = standard_scale(size, room).per_mm
    assert size / mu <= room * (1 + 1e-12)
    larger = [ratio for ratio in STANDARD_RATIOS if ratio > 1 / mu * (1 + 1e-12)]
    assert all(size * ratio > room for ratio in larger)


@pytest.mark.parametrize("size", [1e5, 3e6, 1e9])
def test_beyond_the_standard_series_powers_of_ten_go_on(size):
    mu = standard_scale(size, 100).per_mm
    assert math.log10(mu) == round(math.log10(mu))
    assert size / mu <= 100 < size / mu * 10


@pytest.mark.parametrize(("mu", "text"), [(0.5, "2:1"), (0.4, "2.5:1"), (1.0, "1:1"), (2.5, "1:2.5"), (10.0, "1:10")])
def test_ratios_are_written_paper_to_machine(mu, text):
    assert str(ratio_text(mu)) == text

"""Scales: mu machine units for a millimetre of paper."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings, strategies as st

from graphcam.drafting.scale import (
    GOST_2_302,
    ISO_5455,
    STANDARD_RATIOS,
    Paper,
    Ratios,
    Scale,
    coarsest_scale,
    ratio_text,
    standard_scale,
)
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
@given(st.floats(1e-2, 1e4), st.floats(10, 1e3), st.sampled_from([GOST_2_302, ISO_5455]))
def test_the_standard_scale_is_the_largest_that_fits(size, room, ratios):
    mu = standard_scale(size, room, ratios).per_mm
    assert size / mu <= room * (1 + 1e-12)
    larger = [ratio for ratio in ratios if ratio > 1 / mu * (1 + 1e-12)]
    assert all(size * ratio > room for ratio in larger)


def written(ratios: Ratios) -> list[str]:
    return [str(ratio_text(1 / ratio)) for ratio in ratios]


def test_the_scales_of_iso_5455_and_of_gost_2_302_are_those_of_their_tables():
    """ISO 5455, table 1, and 100:1 and 1:1000 as it goes on; GOST 2.302-68, table 1."""
    assert written(STANDARD_RATIOS["iso"]) == [
        *("100:1", "50:1", "20:1", "10:1", "5:1", "2:1", "1:1"),
        *("1:2", "1:5", "1:10", "1:20", "1:50", "1:100", "1:200", "1:500", "1:1000"),
    ]
    assert written(STANDARD_RATIOS["gost"]) == [
        *("100:1", "50:1", "40:1", "20:1", "10:1", "5:1", "4:1", "2.5:1", "2:1", "1:1"),
        *("1:2", "1:2.5", "1:4", "1:5", "1:10", "1:15", "1:20", "1:25", "1:40", "1:50", "1:75", "1:100"),
        *("1:200", "1:400", "1:500", "1:800", "1:1000"),
    ]


def test_a_view_fits_its_paper_both_ways():
    paper = Paper(100, 50, GOST_2_302)
    assert [paper.scale(size).per_mm for size in (40 + 20j, 40 + 40j, 60 + 1j)] == [0.4, 1.0, 1.0]
    # What stands beside it takes room, and does not grow.
    assert paper.scale(40 + 20j, beside=30 + 5j).per_mm == 1.0
    assert coarsest_scale(Scale(2, "mm"), Scale(5, "mm"), Scale(0.1, "mm")).per_mm == 5


@pytest.mark.parametrize("size", [1.5e5, 3e6, 1e9])
def test_beyond_the_standard_series_powers_of_ten_go_on(size):
    mu = standard_scale(size, 100, GOST_2_302).per_mm
    assert math.log10(mu) == round(math.log10(mu))
    assert size / mu <= 100 < size / mu * 10


@pytest.mark.parametrize(("mu", "text"), [(0.5, "2:1"), (0.4, "2.5:1"), (1.0, "1:1"), (2.5, "1:2.5"), (10.0, "1:10")])
def test_ratios_are_written_paper_to_machine(mu, text):
    assert str(ratio_text(mu)) == text

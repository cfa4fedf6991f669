"""Keyways and tolerances against values as they are published."""

from __future__ import annotations

import math

import numpy as np
import pytest

from graphcam.given.limits_and_fits import KeySection, key_section, standard_diameters, tolerance

DIN_6885 = {
    8: (2, 2, 1.0), 10: (3, 3, 1.4), 12: (4, 4, 1.8), 17: (5, 5, 2.3), 22: (6, 6, 2.8), 30: (8, 7, 3.3),
    38: (10, 8, 3.3), 44: (12, 8, 3.3), 50: (14, 9, 3.8), 58: (16, 10, 4.3), 65: (18, 11, 4.4), 75: (20, 12, 4.9),
    85: (22, 14, 5.4), 95: (25, 14, 5.4), 110: (28, 16, 6.4), 130: (32, 18, 7.4),
}  # fmt: skip
"""Bore up to [mm]: width and height of the key, depth in the hub, of DIN 6885-1 form A and of GOST 23360-78."""


@pytest.mark.parametrize(("bore", "published"), DIN_6885.items())
def test_keyways_are_those_of_the_standards(bore: float, published: tuple[float, float, float]) -> None:
    assert key_section(bore) == KeySection(*published)
    # A bore beyond the range has the next larger key.
    larger = key_section(bore + 0.001)
    assert larger is not None
    assert larger.width > published[0]


def test_depths_may_be_greater_by_what_the_standards_say() -> None:
    found = [key_section(bore) for bore in (12, 22, 30, 130, 150)]
    assert [key.depth_over for key in found if key] == [0.1, 0.1, 0.2, 0.2, 0.3]


@pytest.mark.parametrize("bore", [6.0, 3.0, 501.0])
def test_beyond_the_standards_there_is_no_key(bore: float) -> None:
    assert key_section(bore) is None


@pytest.mark.parametrize("bore", [8.0, 22.0, 50.0, 110.0])
def test_area_of_a_keyway_by_a_sum_over_strips(bore: float) -> None:
    section = key_section(bore)
    assert section
    count = 200_000
    x = (np.arange(count) + 0.5) / count * section.width - section.width / 2
    strips = bore / 2 + section.depth - np.sqrt(bore**2 / 4 - x**2)
    assert section.area(bore) == pytest.approx(strips.sum() * section.width / count, rel=1e-8)


@pytest.mark.parametrize(
    ("size", "grade", "micrometres"),
    [(3, 7, 10), (10, 6, 9), (18, 7, 18), (20, 7, 21), (25, 8, 33), (40, 7, 25), (50, 9, 62), (80, 7, 30), (6, 9, 30)],
)
def test_tolerances_are_those_of_iso_286(size: float, grade: int, micrometres: float) -> None:
    found = tolerance(size, grade)
    assert found is not None
    assert 1000 * found == pytest.approx(micrometres)
    assert tolerance(501.0, grade) is None


def test_standard_diameters_grow_by_a_twentieth_of_a_decade() -> None:
    diameters = standard_diameters()
    assert diameters == sorted(diameters)
    ratios = np.diff(np.log10(diameters))
    assert np.all(np.abs(ratios - 0.05) < 0.02)
    assert {20.0, 25.0, 32.0, 0.5} <= {round(d, 9) for d in diameters}
    assert math.isclose(diameters[0], 1e-11)

"""Hatching against shapely: it lies inside the polygon, and it covers the whole of it."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, strategies as st

from graphcam.sheets.labels import interrupted
from graphcam.sheets.mark_entities import HATCHING_SPACING, MAX_HATCHING_LINES, hatch
from graphcam.sheets.model import Strokes, Text
from graphcam.sheets.sampling import corners

ROUNDING = 1e-6


def lines(strokes: Strokes) -> shapely.MultiLineString:
    return shapely.MultiLineString(
        [((a.real, a.imag), (b.real, b.imag)) for a, b in zip(strokes.starts, strokes.ends, strict=True)]
    )


@given(st.lists(st.floats(5, 60), min_size=5, max_size=25))
def test_hatching_stays_inside_a_star(radii: list[float]) -> None:
    """A star about the origin with any radii has notches of every kind."""
    star = np.array(radii) * np.exp(2j * np.pi * np.arange(len(radii)) / len(radii))
    polygon = shapely.Polygon(np.column_stack([star.real, star.imag]))
    drawn = lines(hatch(star))
    assert drawn.difference(polygon.buffer(ROUNDING)).length == pytest.approx(0, abs=ROUNDING)
    inside = drawn.intersection(polygon).length
    assert inside == pytest.approx(drawn.length, abs=ROUNDING)


def test_hatching_covers_its_region() -> None:
    """Lines a spacing apart have the length of the area over the spacing."""
    square = np.array([0, 300, 300 + 200j, 100 + 50j, 200j])
    polygon = shapely.Polygon(np.column_stack([square.real, square.imag]))
    assert lines(hatch(square)).length * HATCHING_SPACING == pytest.approx(polygon.area, rel=0.01)


def test_a_region_larger_than_any_sheet_has_no_more_lines_than_a_sheet_could_hold() -> None:
    assert len(hatch(np.array([0, 1e9, 1e9 + 1e9j, 1e9j])).starts) <= MAX_HATCHING_LINES + 1


def test_hatching_runs_at_45_degrees() -> None:
    drawn = hatch(np.array([0, 50, 50 + 30j]))
    assert np.allclose(np.angle(drawn.ends - drawn.starts), np.pi / 4)


def test_interrupted_hatching_spares_the_text() -> None:
    drawn = hatch(np.array([0, 60, 60 + 60j, 60j]))
    text = Text(20 + 30j, "α = 30°", 3.5, angle=0.4)
    box = shapely.Polygon([(p.real, p.imag) for p in corners(text)])
    broken = interrupted(drawn, [text])
    assert isinstance(broken, Strokes)
    assert lines(drawn).intersection(box).length > 10
    assert lines(broken).intersection(box).length == 0
    margin = box.buffer(0.8, join_style="mitre")
    assert lines(broken).length == pytest.approx(lines(drawn).difference(margin).length, rel=1e-9)


@pytest.mark.parametrize("spacing", [HATCHING_SPACING, 1.3])
@pytest.mark.parametrize(
    "outline",
    [
        [1, 50, 50 + 31j],
        [1 + 100j, 5 + 100j, 4 + 160j, 161j],
        [-40 - 90j, -30 - 100j, -5 - 20j],
        [1, 12, 12 + 12j, 15j],
    ],
)
def test_the_lines_of_hatching_are_a_spacing_apart_from_the_origin_on(outline: list[complex], spacing: float) -> None:
    """So those of two neighbouring regions run into each other."""
    polygon = shapely.Polygon([(z.real, z.imag) for z in map(complex, outline)])
    drawn = hatch(np.array(outline), spacing)
    upwards = np.exp(0.75j * np.pi)
    levels, reach = (drawn.starts / upwards).real / spacing, (np.array(outline) / upwards).real / spacing
    np.testing.assert_allclose(levels, np.round(levels), atol=1e-9)
    # Every multiple that crosses the convex region is there once.
    assert np.round(levels).tolist() == list(range(int(np.ceil(reach.min())), int(np.floor(reach.max())) + 1))
    assert lines(drawn).within(polygon.buffer(ROUNDING))
    assert drawn.role == "hatch"
    assert HATCHING_SPACING == 3.0


def test_lines_are_broken_off_beside_a_text_and_others_are_left() -> None:
    text = Text(0j, "A", 3.5)
    box = corners(text)
    wide, low, high = np.ptp(box.real), box.imag.min(), box.imag.max()
    through = Strokes(np.array([-10 + 1j, 1 + 1j, -10 + 1j]), np.array([20 + 1j, 20 + 1j, 1 + 1j]), "hatch")
    broken = interrupted(through, [text])
    assert broken.starts.tolist() == pytest.approx([-10 + 1j, -10 + 1j, wide + 0.8 + 1j, wide + 0.8 + 1j])
    assert broken.ends.tolist() == pytest.approx([-0.8 + 1j, -0.8 + 1j, 20 + 1j, 20 + 1j])
    assert broken.role == "hatch"
    inside = Strokes(np.array([0.1 + 1j]), np.array([0.2 + 1j]), "hatch")
    assert len(interrupted(inside, [text]).starts) == 0
    for y, parts in ((high + 0.79, 2), (high + 0.81, 1), (low - 0.79, 2), (low - 0.81, 1)):
        beside = Strokes(np.array([-10 + 1j * y]), np.array([20 + 1j * y]), "hatch")
        assert len(interrupted(beside, [text]).starts) == parts
    assert interrupted(text, [text]) is text

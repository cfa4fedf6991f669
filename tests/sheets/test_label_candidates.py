"""Where a text could stand: never on its own point or line, near it first, readable from below or from the right."""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

import numpy as np
import pytest

from graphcam.sheets.label_candidates import LabelText, label_along, label_along_arc, label_around, label_over, unit
from graphcam.sheets.model import Length
from graphcam.sheets.sampling import corners
from graphcam.sheets.text_measures import extent, points_size, width, wrap
from graphcam.sheets.typefaces import lettering_file

TEXT, HEIGHT = "φ₁ = 80°", 3.5
WIDE, BELOW, ABOVE = extent(TEXT, HEIGHT)
HIGH = BELOW + ABOVE
TURNS = [cmath.rect(1.0, angle) for angle in (0.0, 0.5, 1.4, 2.0, 3.0, -0.4, -2.2)] + [1j, -1j, -1 + 0j]


def boxes(writing: LabelText) -> np.ndarray:
    """Corners (k, 4) of the text in all its places."""
    return np.array([corners(writing.set_at(k)) for k in range(len(writing.centres))])


def reach(writing: LabelText, anchor: complex) -> np.ndarray:
    """How far each level place of the text is from a point."""
    away = writing.centres - anchor
    beyond = np.maximum(np.abs(away.real) - WIDE / 2, 0) + 1j * np.maximum(np.abs(away.imag) - HIGH / 2, 0)
    return np.abs(beyond)


def led(writing: LabelText) -> np.ndarray:
    return np.isfinite(writing.anchors)


def test_a_text_stands_with_its_box_about_the_centre_of_its_place():
    of = Length(0j, 1j, 2j, ())
    at = np.array([10 + 5j, -3j])
    writing = LabelText(TEXT, HEIGHT, at, np.array([0.0, 0.7]), np.zeros(2), np.full(2, np.nan), of=of)
    assert writing.size == complex(WIDE, HIGH)
    for k, angle in enumerate((0.0, 0.7)):
        text = writing.set_at(k)
        assert corners(text).mean() == pytest.approx(at[k])
        assert (text.text, text.height, text.align, text.angle, text.of) == (TEXT, HEIGHT, "center", angle, of)


@pytest.mark.parametrize("towards", [1, 1j, -1, -1j, 3 + 4j, 0j])
def test_a_label_stands_about_its_point_nearest_first_in_the_direction_that_is_asked(towards):
    writing = label_around(20 + 10j, TEXT, HEIGHT, towards)
    assert not writing.bound
    assert not writing.angles.any()
    assert np.all(np.diff(writing.cost) >= 0)
    # Twelve distances, each in the direction asked and in sixteen others.
    assert len(writing.centres) == 12 * 17
    first = writing.centres[0] - (20 + 10j)
    asked = unit(towards)
    side = np.clip(1.6 * asked.real, -1, 1) * WIDE / 2 + 1j * np.clip(1.6 * asked.imag, -1, 1) * HIGH / 2
    assert writing.cost[0] == 0
    assert first == pytest.approx(1.2 * asked + side)


def test_a_label_goes_away_by_twelve_steps_and_from_6_mm_on_it_has_a_leader():
    writing = label_around(20 + 10j, TEXT, HEIGHT, 1j)
    # Straight above, the distance is that of the box.
    above = np.isclose(writing.centres.real, 20) & (writing.centres.imag > 10)
    gaps = np.unique(np.round((writing.centres.imag - 10 - HIGH / 2)[above], 9))
    assert gaps.tolist() == [1.2, 1.8, 2.5, 3.4, 4.6, 6.5, 9.0, 12.0, 16.0, 21.0, 27.0, 35.0]
    assert np.array_equal(led(writing)[above], (writing.centres.imag - 10 - HIGH / 2)[above] > 6.0)
    assert np.all(writing.anchors[led(writing)] == 20 + 10j)
    assert reach(writing, 20 + 10j).min() > 0.8
    assert reach(writing, 20 + 10j)[led(writing)].min() > 4.0


def test_a_label_costs_more_the_farther_away_and_the_more_it_is_turned_away():
    """0.9 a millimetre, 4 for a leader; 1.5 for another direction than the one asked, 9.5 for the opposite one."""
    writing = label_around(0j, TEXT, HEIGHT, 1j)

    def cost(gap: float, direction: complex) -> list[float]:
        side = np.clip(1.6 * direction.real, -1, 1) * WIDE / 2 + 1j * np.clip(1.6 * direction.imag, -1, 1) * HIGH / 2
        return sorted(writing.cost[np.isclose(writing.centres, gap * direction + side)])

    for gap, far in ((1.2, 0.0), (4.6, 3.06), (6.5, 4.77 + 4.0), (35.0, 30.42 + 4.0)):
        # The direction asked is one of the sixteen, too.
        assert cost(gap, 1j) == pytest.approx([far, far + 1.5])
        assert cost(gap, -1j) == pytest.approx([far + 9.5])
        assert cost(gap, 1 + 0j) == pytest.approx([far + 5.5])
        turned = cmath.rect(1.0, math.radians(112.5))
        assert cost(gap, turned) == pytest.approx([far + 1.5 + 4 * (1 - math.cos(math.radians(22.5)))])


@pytest.mark.parametrize("turn", TURNS)
def test_the_text_of_a_dimension_stands_along_its_line_above_it_before_below(turn):
    start, end = 30 + 20j, 30 + 20j + 50 * turn
    writing = label_along(start, end, TEXT, HEIGHT)
    assert writing.bound
    places, angles, cost = writing.centres[:14], writing.angles[:14], writing.cost[:14]
    # Readable from below or from the right: never on its head.
    (angle,) = np.unique(angles)
    assert -math.pi / 2 < angle <= math.pi / 2 + 1e-9
    up = 1j * cmath.rect(1.0, angle)
    assert abs((turn / (up / 1j)).imag) < 1e-9
    beside = ((places - start) / turn).real
    off = ((places - start) / up).real
    # A clear millimetre above the line, then below.
    np.testing.assert_allclose(off[:7], HIGH / 2 + 1.0)
    np.testing.assert_allclose(off[7:], -HIGH / 2 - 1.0)
    shares = beside / 50 if (turn / (up / 1j)).real > 0 else 1 - beside / 50
    np.testing.assert_allclose(shares[:7], [0.5, 0.42, 0.58, 0.3, 0.7, 0.18, 0.82], atol=1e-9)
    np.testing.assert_allclose(shares[7:], shares[:7])
    np.testing.assert_allclose(cost[:7], 4 * np.abs(shares[:7] - 0.5), atol=1e-9)
    np.testing.assert_allclose(cost[7:], 3 + cost[:7])
    assert not led(writing)[:14].any()
    # Elsewhere only at a price, level and about the middle.
    free = label_around(30 + 20j + 25 * turn, TEXT, HEIGHT, up)
    np.testing.assert_allclose(writing.cost[14:], 12 + free.cost)
    np.testing.assert_allclose(np.sort_complex(writing.centres[14:]), np.sort_complex(free.centres))
    assert not writing.angles[14:].any()


@pytest.mark.parametrize("turn", TURNS)
def test_a_text_longer_than_its_line_stands_over_or_under_its_middle_or_clear_of_it_on_a_leader(turn):
    start, end = 30 + 20j, 30 + 20j + 5 * turn
    line, writing = label_along(start, end, TEXT, HEIGHT), label_over(start, end, TEXT, HEIGHT)
    assert writing.bound
    middle = start + 2.5 * turn
    direction = cmath.rect(1.0, writing.angles[0])
    np.testing.assert_allclose(writing.centres[:2] - middle, np.array([1j, -1j]) * direction * (HIGH / 2 + 1.0))
    assert writing.cost[:2].tolist() == [0.0, 3.0]
    rest = boxes(writing)[2:]
    assert led(writing)[2:].all()
    np.testing.assert_allclose(writing.anchors[2:], middle)
    assert not writing.angles[2:].any()
    # No corner comes nearer to the line than 2 mm, and all that keep clear are offered.
    apart = ((rest - middle) / direction).imag
    assert np.abs(apart).min() >= 2.0 - 1e-9
    assert np.all(np.sign(apart).std(axis=1) == 0)
    clear = np.abs(((boxes(line)[14:] - middle) / direction).imag).min(axis=1) >= 2.0 - 1e-9
    one_side = np.abs(np.sign(((boxes(line)[14:] - middle) / direction).imag).sum(axis=1)) == 4
    assert len(rest) == (clear & one_side & led(line)[14:]).sum()


@pytest.mark.parametrize(("start", "end"), [(0.2, 1.4), (2.0, 4.0), (-1.0, 0.5)])
def test_the_text_of_an_angle_stands_outside_its_arc_before_inside(start, end):
    writing = label_along_arc(10 + 5j, 40.0, start, end, TEXT, HEIGHT)
    assert writing.bound
    assert not writing.angles.any()
    away = writing.centres[:14] - (10 + 5j)
    shares = np.array([0.5, 0.42, 0.58, 0.34, 0.66, 0.25, 0.75])
    rays = np.exp(1j * (start + shares * (end - start)))
    np.testing.assert_allclose(away[:7] / np.abs(away[:7]), rays)
    np.testing.assert_allclose(away[7:] / np.abs(away[7:]), rays)
    box = np.abs(rays.real) * WIDE / 2 + np.abs(rays.imag) * HIGH / 2
    np.testing.assert_allclose(np.abs(away[:7]), 40 + box + 1.2)
    np.testing.assert_allclose(np.abs(away[7:]), 40 - box - 1.2)
    np.testing.assert_allclose(writing.cost[:7], 6 * np.abs(shares - 0.5))
    np.testing.assert_allclose(writing.cost[7:14], 2 + 6 * np.abs(shares - 0.5))
    assert not led(writing)[:14].any()
    free = label_around(10 + 5j + 40 * rays[0], TEXT, HEIGHT, rays[0])
    np.testing.assert_allclose(writing.cost[14:], 3 + free.cost)
    np.testing.assert_allclose(writing.centres[14:], free.centres)


def test_letters_are_measured_by_their_outlines():
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath

    for text in ("H", "gj", "Ø", "quantity", "Щё"):
        outline = TextPath((0, 0), text, size=points_size(3.5), prop=FontProperties(fname=lettering_file()))
        low, high = outline.vertices[:, 1].min() * 25.4 / 72, outline.vertices[:, 1].max() * 25.4 / 72
        _, below, above = extent(text, 3.5)
        assert below == pytest.approx(max(0.0, -low), abs=0.02)
        assert above == pytest.approx(high, abs=0.02)
    assert extent("", 3.5) == (0.0, 0.0, 0.0)
    assert extent("quantity", 7.0) == pytest.approx([2 * each for each in extent("quantity", 3.5)])
    # What nothing has is as wide as the box that stands for it.
    assert width("\ufffe", 3.5) == width("□", 3.5)


def test_lines_are_broken_where_the_next_word_does_not_fit():
    words = ["one", "two", "three", "four"]
    for room in (width("one two", 3.5), width("one two three", 3.5), 1.0):
        lines = wrap(" ".join(words), 3.5, room)
        assert " ".join(lines) == " ".join(words)
        assert all(width(line, 3.5) <= room for line in lines if " " in line)
        for line, following in pairwise(lines):
            assert width(f"{line} {following.split()[0]}", 3.5) > room
    assert wrap("one two", 3.5, width("one two", 3.5)) == ["one two"]

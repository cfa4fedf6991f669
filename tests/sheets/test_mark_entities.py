"""Marks become lines: dimensions measure what they say, arrows point where they should, at every reduction."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from graphcam.drafting.marks import AngleMark, Arc, Arrow, Circle, Dimension, Dots, Label, Line, Mark, Role, Segments
from graphcam.sheets.formats import Lettering
from graphcam.sheets.label_candidates import LabelText, label_along, label_along_arc, label_around, label_over
from graphcam.sheets.mark_entities import Placement, arrow, expand, head
from graphcam.sheets.model import Angle, ArcEntity, Circles, Curve, Entity, Heads, Length, Stroke, Strokes
from graphcam.sheets.styles import STYLES_BY_ROLE
from graphcam.sheets.text_measures import extent

LETTERS = Lettering(5.0, 3.5, 2.5)
HERE, THERE = Placement(0j), Placement(100 + 50j, 0.5)


def drawn(mark: Mark, place: Placement = HERE) -> tuple[list[Entity], list[LabelText]]:
    return expand([mark], place, LETTERS)


def same(one: LabelText, other: LabelText) -> bool:
    """The same text with the same places at the same costs."""
    places = [(w.centres, w.angles, w.cost, np.nan_to_num(w.anchors)) for w in (one, other)]
    return (one.text, one.height) == (other.text, other.height) and all(map(np.allclose, *places))


def triangle(heads: Heads) -> tuple[complex, complex, float]:
    """Tip, direction and length of one head, which is as slim on both sides."""
    ((tip, left, right),) = heads.corners.tolist()
    foot = (left + right) / 2
    assert abs(((left - foot) / (tip - foot)).real) < 1e-9, "as long on both sides"
    assert abs(left - right) / abs(tip - foot) == pytest.approx(0.32)
    return tip, (tip - foot) / abs(tip - foot), abs(tip - foot)


@pytest.mark.parametrize("role", [Role.DIMENSION, Role.CURVE, Role.RESULT])
def test_a_head_points_where_it_should_and_is_longer_on_bolder_lines(role):
    tip, direction, length = triangle(head(3 + 4j, 5j, role))
    assert (tip, direction) == (3 + 4j, pytest.approx(1j))
    assert length == pytest.approx(3.0 + 3.0 * STYLES_BY_ROLE[role].width)


@pytest.mark.parametrize("role", [Role.DIMENSION, Role.RESULT])
def test_an_arrow_ends_with_its_tip_and_its_line_stops_before_it(role):
    way = 30 * cmath.rect(1.0, 0.7)
    line, point = arrow(10 + 5j, 10 + 5j + way, role)
    assert triangle(point)[:2] == (pytest.approx(10 + 5j + way), pytest.approx(way / 30))
    assert line.starts.tolist() == [10 + 5j]
    # One and a half widths behind the tip.
    assert line.ends[0] == pytest.approx(10 + 5j + way * (1 - 1.5 * STYLES_BY_ROLE[role].width / 30))
    assert {line.role, point.role} == {role}


@pytest.mark.parametrize("end", [0j, complex("inf"), complex("nan")])
def test_an_arrow_without_length_is_nothing(end):
    assert drawn(Arrow(0j, end, Role.CURVE)) == ([], [])


def test_marks_stand_where_the_view_stands_reduced_with_it():
    (line,), _ = drawn(Line(np.array([0, 10 + 20j]), Role.CURVE), THERE)
    assert (line.points.tolist(), line.role, line.closed) == ([100 + 50j, 105 + 60j], Role.CURVE, False)
    (lines,), _ = drawn(Segments(np.array([0j, 2]), np.array([4j, 2]), Role.AXIS), THERE)
    assert (lines.starts.tolist(), lines.ends.tolist(), lines.role) == ([100 + 50j], [100 + 52j], Role.AXIS)
    (circle,), _ = drawn(Circle(2j, 8.0, Role.HIDDEN), THERE)
    assert (circle.centres.tolist(), circle.radius, circle.role, circle.opaque) == (
        [100 + 51j],
        4.0,
        Role.HIDDEN,
        False,
    )
    (dots,), _ = drawn(Dots(np.array([2j, 4])), THERE)
    assert (dots.centres.tolist(), dots.radius, dots.opaque) == ([100 + 51j, 102 + 50j], 0.75, True)
    # What a curve is drawn through does not break it; pivots and centres hide the ends of their lines.
    assert [drawn(Dots(np.array([0j]), role))[0][0].opaque for role in (Role.CONSTRUCTION, Role.RESULT)] == [
        False,
        True,
    ]
    line, point = drawn(Arrow(0j, 20 + 0j, Role.CURVE), THERE)[0]
    assert (line.starts[0], triangle(point)[:2]) == (100 + 50j, (110 + 50j, 1.0))


def test_segments_without_length_are_left_out():
    assert drawn(Segments(np.array([1j, 2]), np.array([1j, 2]), Role.CURVE)) == ([], [])
    (lines,), _ = drawn(Segments(np.array([0j, 0]), np.array([1.1e-6, 0.9e-6]) + 0j, Role.CURVE))
    assert lines.ends.tolist() == [1.1e-6]


def test_repeated_points_are_drawn_once():
    corner = np.array([0, 0, 10, 10, 10 + 10j, 0])
    (line,), _ = drawn(Line(corner, Role.CURVE))
    assert line.points.tolist() == [0, 10, 10 + 10j, 0]
    # The last point of a closed line is joined to the first, which it may not repeat.
    (line,), _ = drawn(Line(corner, Role.CURVE, closed=True))
    assert (line.points.tolist(), line.closed) == ([0, 10, 10 + 10j], True)
    assert drawn(Line(np.array([1j, 1j]), Role.CURVE)) == ([], [])
    assert len(drawn(Line(np.array([0, 0.9e-6, 1]) + 0j, Role.CURVE))[0][0].points) == 2
    assert len(drawn(Line(np.array([0, 1.1e-6, 1]) + 0j, Role.CURVE))[0][0].points) == 3


@pytest.mark.parametrize(
    ("count", "role", "closed", "kind"),
    [
        (40, Role.RESULT, True, Curve),
        (39, Role.RESULT, True, Stroke),
        (40, Role.CURVE, True, Stroke),
        (40, Role.RESULT, False, Stroke),
    ],
)
def test_a_closed_bold_line_through_forty_points_is_a_smooth_curve(count, role, closed, kind):
    points = 30 * np.exp(2j * np.pi * np.arange(count) / count)
    (line,), _ = drawn(Line(points, role, closed))
    assert type(line) is kind
    np.testing.assert_array_equal(line.points, points)


@pytest.mark.parametrize("factor", [1.0, 0.5])
def test_the_head_of_an_arc_lies_on_its_end_along_the_chord(factor):
    place = Placement(5j, factor)
    for end, at, sense in (("end", 2.0, 1), ("start", 0.5, -1)):
        arc, point = drawn(Arc(1j, 20.0, 0.5, 2.0, Role.CURVE, arrow=end), place)[0]
        radius = 20 * factor
        assert (arc.centre, arc.radius, arc.start, arc.end) == (5j + factor * 1j, radius, 0.5, 2.0)
        tip, direction, length = triangle(point)
        assert tip == pytest.approx(arc.centre + cmath.rect(radius, at))
        # Behind the tip by the length of the head, the arc is where the head is.
        assert direction * -1j * sense == pytest.approx(cmath.rect(1.0, at - sense * length / (2 * radius)))
    assert len(drawn(Arc(1j, 20.0, 0.5, 2.0, Role.CURVE))[0]) == 1
    # On a tiny arc it turns back by one radian at the most.
    _, point = drawn(Arc(0j, 0.1, 0.5, 2.0, Role.CURVE, arrow="end"))[0]
    assert triangle(point)[1] == pytest.approx(1j * cmath.rect(1.0, 1.0))


def test_labels_stand_about_their_point_large_and_small():
    _, (large,) = drawn(Label(2j, "A", towards=1j), THERE)
    _, (small,) = drawn(Label(2j, "A", towards=-1j, small=True), THERE)
    assert same(large, label_around(100 + 51j, "A", 3.5, 1j))
    assert same(small, label_around(100 + 51j, "A", 2.5, -1j))


TURNS = [1.0 + 0j, cmath.rect(1.0, 0.6), -1j]


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("aside", [10.0, -10.0])
def test_a_dimension_measures_between_its_extension_lines(turn, aside):
    start, end = 3 + 2j, 3 + 2j + 40 * turn
    (extension, line, first, second), (text,) = drawn(Dimension(start, end, "40", aside=aside))
    side = 1j * turn * math.copysign(1.0, aside)
    # A gap of 1 mm at what is measured, 2 mm beyond the dimension line, perpendicular to it.
    np.testing.assert_allclose(extension.starts, np.array([start, end]) + side)
    np.testing.assert_allclose(extension.ends, np.array([start, end]) + 12 * side)
    # The line is parallel to what it measures and as long, its heads touch the extension lines from inside.
    np.testing.assert_allclose([line.starts[0], line.ends[0]], np.array([start, end]) + 10 * side)
    assert triangle(first)[:2] == (pytest.approx(start + 10 * side), pytest.approx(-turn))
    assert triangle(second)[:2] == (pytest.approx(end + 10 * side), pytest.approx(turn))
    assert {each.role for each in (extension, line, first, second)} == {Role.DIMENSION}
    assert same(text, label_along(start + 10 * side, end + 10 * side, "40", 3.5))
    assert isinstance(text.of, Length)
    assert (text.of.start, text.of.end, text.of.foot) == (start, end, pytest.approx(start + 10 * side))
    assert text.of.lines == (extension, line, first, second)


@pytest.mark.parametrize("turn", TURNS)
def test_a_short_dimension_has_its_heads_outside_on_tails(turn):
    start = 3 + 2j
    for length, tail, outwards in ((9.0, 0.0, 1), (8.99, 6.0, -1)):
        (_, line, first, second), (text,) = drawn(Dimension(start, start + length * turn, "a long text", aside=10.0))
        foot, tip = start + 10j * turn, start + 10j * turn + length * turn
        np.testing.assert_allclose([line.starts[0], line.ends[0]], [foot - tail * turn, tip + tail * turn])
        assert triangle(first)[:2] == (pytest.approx(foot), pytest.approx(-outwards * turn))
        assert triangle(second)[:2] == (pytest.approx(tip), pytest.approx(outwards * turn))
        assert same(text, label_over(foot, tip, "a long text", 3.5))


def test_a_text_stands_along_its_dimension_line_if_that_is_a_millimetre_longer():
    for text in ("40", "a long text"):
        longer = extent(text, 3.5)[0] + 1.0
        assert same(drawn(Dimension(0j, longer + 0j, text))[1][0], label_along(0j, longer + 0j, text, 3.5))
        shorter = math.nextafter(longer, 0.0)
        assert same(drawn(Dimension(0j, shorter + 0j, text))[1][0], label_over(0j, shorter + 0j, text, 3.5))


def test_a_dimension_has_no_extension_lines_where_it_lies_on_what_it_measures():
    for aside, drawn_lines in ((0.0, 1), (1.0, 1), (1.01, 2), (-1.0, 1), (-1.01, 2)):
        entities, _ = drawn(Dimension(0j, 40 + 0j, "40", aside=aside))
        assert sum(isinstance(e, Strokes) for e in entities) == drawn_lines


@pytest.mark.parametrize(
    ("aside", "factor", "distance"),
    # It comes nearer with the view, but not nearer than 6 mm, unless it was nearer to begin with.
    [(20.0, 0.5, 10.0), (20.0, 0.25, 6.0), (-20.0, 0.25, -6.0), (4.0, 0.5, 4.0), (-4.0, 1.0, -4.0), (20.0, 1.0, 20.0)],
)
def test_a_dimension_of_a_reduced_view_comes_nearer_to_it(aside, factor, distance):
    (*_, line, _, _), (text,) = drawn(Dimension(0j, 80 + 0j, "80", aside=aside), Placement(0j, factor))
    assert (line.starts[0], line.ends[0]) == (1j * distance, 80 * factor + 1j * distance)
    assert text.of.end == 80 * factor


@pytest.mark.parametrize(("start", "end"), [(0.3, 1.5), (1.5, 0.3)])
def test_an_angle_is_drawn_between_its_directions(start, end):
    (arc, first, second), (text,) = drawn(AngleMark(1j, 40.0, start, end, "69°"), THERE)
    centre = 100 + 50.5j
    assert isinstance(arc, ArcEntity)
    assert (arc.centre, arc.radius, arc.start, arc.end) == (centre, 20.0, 0.3, 1.5)
    half = triangle(first)[2] / 40
    assert triangle(first)[:2] == (
        pytest.approx(centre + cmath.rect(20.0, 0.3)),
        pytest.approx(-1j * cmath.rect(1.0, 0.3 + half)),
    )
    assert triangle(second)[:2] == (
        pytest.approx(centre + cmath.rect(20.0, 1.5)),
        pytest.approx(1j * cmath.rect(1.0, 1.5 - half)),
    )
    assert same(text, label_along_arc(centre, 20.0, 0.3, 1.5, "69°", 3.5))
    assert isinstance(text.of, Angle)
    assert (text.of.centre, text.of.radius, text.of.start, text.of.end) == (centre, 20.0, 0.3, 1.5)
    assert text.of.lines == (arc, first, second)
    assert {each.role for each in (arc, first, second)} == {Role.DIMENSION}


def test_an_arc_of_nine_millimetres_has_room_for_its_heads():
    (arc, *_), _ = drawn(AngleMark(0j, 40.0, 0.0, 0.225, "12°"))
    assert (arc.end - arc.start) * arc.radius == 9.0


def test_a_small_angle_has_its_heads_outside_on_tails():
    for angle, tail in ((0.225, 0.0), (0.2249, 0.15)):
        (arc, first, second), _ = drawn(AngleMark(0j, 40.0, 1.0, 1.0 + angle, "12°"))
        assert (arc.start, arc.end) == (pytest.approx(1.0 - tail), pytest.approx(1.0 + angle + tail))
        sense = 1 if tail else -1
        # From outside they point at each other.
        for point, at, way in ((first, 1.0, sense), (second, 1.0 + angle, -sense)):
            tip, direction, length = triangle(point)
            assert tip == pytest.approx(cmath.rect(40.0, at))
            assert direction == pytest.approx(way * 1j * cmath.rect(1.0, at - way * length / 80))


def test_every_mark_keeps_its_place_in_the_order():
    entities, texts = expand(
        [Label(0j, "A"), Circle(0j, 5.0, Role.CURVE), Dots(np.array([0j])), Label(1j, "B")], THERE, LETTERS
    )
    assert [type(e) for e in entities] == [Circles, Circles]
    assert [w.text for w in texts] == ["A", "B"]

"""Entities in straight pieces: they follow the line, from end to end, as shapely measures it."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from programs import count

from graphcam.sheets.model import (
    ArcEntity,
    Circles,
    Curve,
    Entity,
    Group,
    Heads,
    Stroke,
    Strokes,
    Text,
    moved_entity,
)
from graphcam.sheets.sampling import FLATNESS, box_of, corners, pieces, sampled
from graphcam.sheets.smooth_curves import bezier, clamped_spline, smooth
from graphcam.sheets.text_measures import extent

SQUARE = np.array([0, 10, 10 + 10j, 10j])
ENTITIES: list[Entity] = [
    Strokes(np.array([1j, 2]), np.array([5j, 7 + 1j]), "curve"),
    Stroke(SQUARE, "curve"),
    Stroke(SQUARE, "curve", closed=True),
    Curve(SQUARE, "result"),
    Circles(np.array([5j, 20]), 3.0, "curve"),
    ArcEntity(5 + 5j, 8.0, 0.5, 2.5, "curve"),
    Heads(np.array([[0, 3 + 1j, 3 - 1j], [5j, 6 + 1j, 7]]), "curve"),
    Text(2 + 3j, "graphcam", 3.5, "center", 0.4),
]


def linework(starts: np.ndarray, ends: np.ndarray) -> shapely.MultiLineString:
    return shapely.MultiLineString([((a.real, a.imag), (b.real, b.imag)) for a, b in zip(starts, ends, strict=True)])


def test_lines_are_their_own_pieces():
    first, second, closed = (linework(*pieces(entity)) for entity in ENTITIES[:3])
    assert first.length == pytest.approx(4 + abs(5 + 1j))
    assert (second.length, closed.length) == (30, 40)
    assert shapely.LinearRing([(z.real, z.imag) for z in SQUARE]).equals(shapely.line_merge(closed))
    assert linework(*pieces(ENTITIES[3])).equals(closed)
    assert linework(*pieces(ENTITIES[6])).length == pytest.approx(
        sum(shapely.Polygon([(z.real, z.imag) for z in head]).length for head in ENTITIES[6].corners)
    )


@pytest.mark.parametrize("radius", [0.01, 0.02, 0.5, 3.0, 200.0])
@pytest.mark.parametrize(("start", "end"), [(0.0, 2 * np.pi), (0.5, 2.5), (-1.0, 0.1), (1.0, 1.001)])
def test_chords_of_a_circle_keep_so_close_to_it_and_are_no_more_than_it_takes(radius, start, end):
    starts, ends = pieces(ArcEntity(5 + 5j, radius, start, end, "curve"))
    for at, way in ((starts[0], start), (ends[-1], end)):
        assert at == pytest.approx(5 + 5j + radius * np.exp(1j * way))
    np.testing.assert_array_equal(starts[1:], ends[:-1])
    np.testing.assert_allclose(np.abs(np.append(starts, ends) - 5 - 5j), radius)
    # The middle of a chord is where it is farthest from the arc.
    sag = radius - np.abs((starts + ends) / 2 - 5 - 5j)
    assert sag.max() <= FLATNESS * (1 + 1e-9)
    half = (end - start) / len(starts) / 2
    assert half * 2 <= np.pi / 2
    fewer = (end - start) / max(1, len(starts) - 1) / 2
    assert len(starts) == 1 or radius * (1 - np.cos(min(fewer, np.pi))) > FLATNESS or 2 * fewer > np.pi / 2
    assert FLATNESS == 0.02


def test_every_circle_is_a_closed_ring():
    starts, ends = pieces(ENTITIES[4])
    for first, ring in zip(np.split(starts, 2), np.split(ends, 2), strict=True):
        np.testing.assert_allclose(np.roll(first, -1), ring)
    for centre, ring in zip((5j, 20), np.split(starts, 2), strict=True):
        assert ring.mean() == pytest.approx(centre)
        np.testing.assert_allclose(np.abs(ring - centre), 3.0)
        assert shapely.LinearRing(np.column_stack([ring.real, ring.imag])).length == pytest.approx(6 * np.pi, rel=0.01)


@pytest.mark.parametrize("spacing", [0.3, 1.0, 100.0])
def test_samples_are_at_most_a_spacing_apart_with_both_ends_and_no_more_than_needed(spacing):
    starts, ends = np.array([0j, 5 + 5j, 1j, np.nan]), np.array([10 + 0j, 5 + 5j, 1j + 3, 1 + 0j])
    points = sampled(starts, ends, spacing)
    expected = []
    for a, b in zip(starts[:3], ends[:3], strict=True):
        parts = max(1, int(np.ceil(abs(b - a) / spacing)))
        expected += [a + (b - a) * k / parts for k in range(parts + 1)]
    np.testing.assert_allclose(points, expected)
    assert len(sampled(np.array([np.nan + 0j]), np.array([0j]), 1.0)) == 0
    assert len(sampled(np.array([0j]), np.array([complex("inf")]), 1.0)) == 0


@pytest.mark.parametrize("align", ["left", "center", "right"])
@pytest.mark.parametrize("angle", [0.0, 0.7, -2.0])
def test_the_box_of_a_text_stands_on_its_base_line(align, angle):
    wide, below, above = extent("jump", 3.5)
    assert below > 0
    begins = {"left": 0.0, "center": -wide / 2, "right": -wide}[align]
    level = [begins - 1j * below, begins + wide - 1j * below, begins + wide + 1j * above, begins + 1j * above]
    text = Text(3 + 4j, "jump", 3.5, align, angle)
    np.testing.assert_allclose(corners(text), 3 + 4j + np.array(level) * np.exp(1j * angle))
    starts, ends = pieces(text)
    assert shapely.polygonize(list(linework(starts, ends).geoms)).area == pytest.approx(wide * (below + above))


@pytest.mark.parametrize("entity", ENTITIES, ids=lambda entity: type(entity).__name__)
def test_what_is_moved_is_all_moved(entity):
    there = moved_entity(entity, 3 - 2j)
    for before, after in zip(pieces(entity), pieces(there), strict=True):
        np.testing.assert_allclose(after, before + 3 - 2j)
    assert type(there) is type(entity)
    box = box_of([entity])
    points = np.concatenate(pieces(entity))
    assert (box.left, box.right) == (points.real.min(), points.real.max())
    assert (box.bottom, box.top) == (points.imag.min(), points.imag.max())


def test_the_box_of_what_cannot_be_seen_is_none():
    assert box_of([]) is None
    assert box_of([Strokes(np.array([np.nan + 0j]), np.array([complex("nan")]), "curve")]) is None
    both = box_of([Strokes(np.array([np.nan + 0j, 1j]), np.array([0j, 2 + 5j]), "curve")])
    assert (both.corner, both.width, both.height) == (0, 2, 5)


def test_entities_are_counted_as_a_program_shows_them():
    assert [count(entity) for entity in ENTITIES] == [2, 1, 1, 1, 2, 1, 2, 1]
    runs = [(kind, role, len(run)) for kind, role, run in Group("step-01 a", tuple(ENTITIES)).runs()]
    assert runs[:3] == [("line", "curve", 3), ("line", "result", 1), ("line", "curve", 2)]
    assert runs[3:] == [("filled", "curve", 1), ("text", "text", 1)]
    opaque = Group("a", (Circles(np.array([0j]), 1.0, "curve", opaque=True), ENTITIES[4]))
    assert [kind for kind, _, _ in opaque.runs()] == ["opaque", "line"]


def closed_curve(n: int, uneven: float = 0.3) -> np.ndarray:
    t = 2 * np.pi * (np.arange(n) + uneven * np.sin(np.arange(n))) / n
    return (50 + 10 * np.cos(2 * t)) * np.exp(1j * t)


def test_pieces_leave_and_arrive_with_one_tangent_through_every_point():
    points = closed_curve(90)
    curve = smooth(points)
    np.testing.assert_allclose(curve.chords, np.abs(np.roll(points, -1) - points))
    np.testing.assert_allclose(np.roll(curve.arriving, 1), curve.leaving)
    assert not curve.corner.any()
    control = bezier(points)
    np.testing.assert_array_equal(control[::3], np.append(points, points[0]))
    np.testing.assert_allclose(control[1::3], points + curve.leaving * curve.chords / 3)
    np.testing.assert_allclose(control[2::3], np.roll(points, -1) - curve.arriving * curve.chords / 3)


def test_the_tangent_is_that_of_the_quartic_through_five_points():
    """As numpy fits it by the lengths of the chords."""
    points = closed_curve(60)
    leaving = smooth(points).leaving
    for k in (0, 1, 7, 58, 59):
        five = points[np.arange(k - 2, k + 3) % 60]
        along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(five)))])
        along -= along[2]
        slope = [np.polyfit(along, part, 4)[-2] for part in (five.real, five.imag)]
        assert leaving[k] == pytest.approx(complex(*slope), abs=1e-9)


def test_beside_a_corner_the_tangent_is_that_of_the_parabola_through_three_points():
    side = np.linspace(0, 40, 21)[:-1]
    bow = 40 + 1j * np.linspace(0, 40, 21)[:-1] + 8 * np.sin(np.linspace(0, np.pi, 21)[:-1])
    points = np.concatenate([side, bow, (40 + 40j) - side, 40j - 1j * side])
    curve = smooth(points)
    assert np.flatnonzero(curve.corner).tolist() == [0, 20, 40, 60]
    for k in (21, 39):
        three = points[k - 1 : k + 2]
        along = np.array([-abs(three[1] - three[0]), 0.0, abs(three[2] - three[1])])
        slope = [np.polyfit(along, part, 2)[-2] for part in (three.real, three.imag)]
        assert curve.leaving[k] == pytest.approx(complex(*slope), abs=1e-9)
    # At the corner itself each side leaves along its own chord.
    assert curve.leaving[20] == pytest.approx((points[21] - points[20]) / abs(points[21] - points[20]))
    assert curve.arriving[19] == pytest.approx((points[20] - points[19]) / abs(points[20] - points[19]))


@pytest.mark.parametrize(("degrees", "corner"), [(19.0, False), (21.0, True)])
def test_the_curve_has_a_corner_where_it_turns_by_more_than_20_degrees(degrees, corner):
    turn = np.exp(1j * np.radians(degrees))
    straight = np.concatenate([-np.arange(10, 0, -1), turn * np.arange(0, 11)])
    far = np.concatenate([straight, 10 * turn + 30j + 30 * np.exp(1j * np.linspace(-1.2, 3.5, 80))])
    assert smooth(far).corner[10] == corner


@pytest.mark.parametrize("cornered", [False, True])
def test_the_spline_is_the_same_curve_as_the_bezier_chain(cornered):
    from scipy.interpolate import BSpline

    points = closed_curve(40)
    if cornered:
        points = np.concatenate([points[:20], points[:20].conjugate()[::-1] * 0.8])
    control, knots = clamped_spline(points)
    spline = BSpline(np.array(knots), control, 3)
    chain, ends = bezier(points), np.concatenate([[0.0], np.cumsum(smooth(points).chords)])
    for k in range(len(points)):
        a, b, c, d = chain[3 * k : 3 * k + 4]
        for u in (0.0, 0.25, 0.8):
            there = (1 - u) ** 3 * a + 3 * u * (1 - u) ** 2 * b + 3 * u * u * (1 - u) * c + u**3 * d
            assert spline(ends[k] + u * (ends[k + 1] - ends[k])) == pytest.approx(there, abs=1e-9)
    assert knots[:4] == [0.0] * 4
    assert knots[-4:] == [ends[-1]] * 4
    # Where it has no corner a knot is double, for the tangents agree.
    interior = np.unique(knots[4:-4], return_counts=True)[1]
    assert set(interior.tolist()) == ({2, 3} if cornered else {2})
    assert smooth(points).corner[1:].sum() == (interior == 3).sum()

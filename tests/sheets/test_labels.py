"""Lettering keeps off bold lines and off itself; the check on it finds every fault that is put in."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
import shapely
from over_all import over_seeds
from overlaps import overlaps, place

from graphcam.drafting.marks import Role
from graphcam.sheets import labels
from graphcam.sheets.label_candidates import label_along, label_around, label_over
from graphcam.sheets.model import ArcEntity, Box, Circles, Drawing, Entity, Group, Page, Stroke, Strokes, Text
from graphcam.sheets.sampling import corners, spans_in_box

FRAME = Box(0.0, 0.0, 200.0, 150.0)


def page(*entities: Entity) -> Drawing:
    return Drawing("", (Page(220.0, 170.0, FRAME, (Group("step-01", entities),)),))


def kinds(*entities: Entity) -> list[str]:
    return [overlap.kind for overlap in overlaps(page(*entities))]


@over_seeds(3)
def test_many_labels_find_free_places(seed: int) -> None:
    """120 labels on points among bold curves, thin lines and circles."""
    random = np.random.default_rng(seed)
    points = random.uniform(10, 190, 120) + 1j * random.uniform(10, 140, 120)
    x = np.linspace(5, 195, 80)
    drawn: list[Entity] = [
        Stroke(x + 1j * (75 + 50 * np.sin(x / 25 + seed)), Role.RESULT),
        Circles(np.array([100 + 75j]), 40.0, Role.CURVE),
        Strokes(points[:-1], points[1:], Role.CONSTRUCTION),
    ]
    writings = [label_around(complex(at), f"{k}′", 2.5, 1j) for k, at in enumerate(points)]
    placed = [entity for group in place(writings, drawn, FRAME) for entity in group]
    assert overlaps(page(*drawn, *placed)) == []


def test_label_takes_the_preferred_side_of_an_empty_paper() -> None:
    for towards in (1, 1j, -1, -1j, 1 - 1j):
        ((text,),) = place([label_around(100 + 75j, "A", 3.5, towards)], [], FRAME)
        assert isinstance(text, Text)
        middle = complex(corners(text).mean()) - (100 + 75j)
        assert abs(np.angle(middle / towards)) < np.radians(15)
        assert abs(middle) < 6


def crossings(seed: int) -> int:
    """How often leaders of labels cross whose points stand close together among bold lines."""
    random = np.random.default_rng(seed)
    points = 100 + 75j + random.uniform(-9, 9, 14) + 1j * random.uniform(-9, 9, 14)
    y = np.arange(60, 91, 2.0)
    walls = Strokes(80 + 1j * y, 120 + 1j * y, Role.RESULT)
    placed = place([label_around(complex(at), f"{k}", 2.5, 1j) for k, at in enumerate(points)], [walls], FRAME)
    leaders = [shapely.LineString([(z.real, z.imag) for z in (e.starts[0], e.ends[0])])
               for group in placed for e in group if isinstance(e, Strokes)]  # fmt: skip
    return sum(a.crosses(b) for a, b in combinations(leaders, 2))


def test_labels_whose_leaders_cross_choose_once_more(monkeypatch: pytest.MonkeyPatch) -> None:
    again = [crossings(seed) for seed in range(6)]
    monkeypatch.setattr(labels, "ORDERS_OF_CROSSED", ())
    once = [crossings(seed) for seed in range(6)]
    assert all(new <= old for new, old in zip(again, once, strict=True))
    assert sum(again) <= 0.5 * sum(once)


def test_label_in_a_crowd_goes_far_and_gets_a_leader() -> None:
    # Bold lines 2 mm apart all around leave no room for a letter.
    y = np.arange(50, 101, 2.0)
    walls = Strokes(60 + 1j * y, 140 + 1j * y, Role.RESULT)
    ((text, leader),) = place([label_around(100 + 90j, "A", 3.5, 1j)], [walls], FRAME)
    assert isinstance(leader, Strokes)
    assert kinds(walls, text) == []
    assert leader.starts[0] == 100 + 90j


def test_text_of_a_dimension_lies_along_its_line() -> None:
    for start, end in ((20 + 20j, 80 + 60j), (80 + 60j, 20 + 20j), (50 + 20j, 50 + 90j)):
        line = Strokes(np.array([start]), np.array([end]), Role.DIMENSION)
        ((text,),) = place([label_along(start, end, "63.2", 3.5)], [line], FRAME)
        assert isinstance(text, Text)
        # Readable from below or from the right.
        assert -np.pi / 2 < text.angle <= np.pi / 2 + 1e-9
        assert abs(np.sin(text.angle - np.angle(end - start))) < 1e-9


@pytest.mark.parametrize("turn", [1, 1j, -1, np.exp(0.6j)])
def test_text_wider_than_its_dimension_keeps_to_its_span(turn: complex) -> None:
    """It stands over or under the middle, or on a leader from there; its neighbours in the chain do not move it."""
    start, end = 100 + 75j - 5 * turn, 100 + 75j + 5 * turn
    writing = label_over(start, end, "φ₂ = 10°", 3.5)
    assert writing.size.real > 10
    led = np.isfinite(writing.anchors)
    assert np.allclose(writing.anchors[led], 100 + 75j)
    assert np.allclose(((writing.centres[~led] - 100 - 75j) / turn).real, 0.0)
    # Nothing stands beside the span, on the line of the neighbours.
    assert np.abs(((writing.centres - 100 - 75j) / turn).imag).min() >= 3.5 / 2
    chain = [
        label_along(start - 40 * turn, start, "φ₁ = 40°", 3.5),
        writing,
        label_along(end, end + 40 * turn, "φ₃ = 40°", 3.5),
    ]
    line = Strokes(np.array([start - 40 * turn]), np.array([end + 40 * turn]), Role.DIMENSION)
    placed = [entity for group in place(chain, [line], FRAME) for entity in group]
    assert overlaps(page(line, *placed)) == []


def test_check_finds_overlapping_texts() -> None:
    assert kinds(Text(50 + 50j, "first", 3.5), Text(53 + 51j, "second", 3.5)) == ["text"]
    assert kinds(Text(50 + 50j, "first", 3.5, angle=0.7), Text(52 + 55j, "second", 3.5)) == ["text"]
    assert kinds(Text(50 + 50j, "first", 3.5), Text(50 + 58j, "second", 3.5)) == []


@pytest.mark.parametrize(
    "line",
    [
        Stroke(np.array([40 + 51j, 80 + 52j]), Role.RESULT),
        Strokes(np.array([52 + 0j]), np.array([52 + 100j]), Role.RESULT),
        ArcEntity(52 + 31j, 21.0, 1.0, 2.0, Role.RESULT),
        Circles(np.array([52 + 31j]), 21.0, Role.RESULT),
    ],
)
def test_check_finds_a_text_on_a_bold_line(line: Entity) -> None:
    assert kinds(Text(50 + 50j, "text", 3.5), line) == ["line"]
    thin = type(line)(**{**line.__dict__, "role": Role.CONSTRUCTION})
    assert kinds(Text(50 + 50j, "text", 3.5), thin) == []


def test_check_finds_a_text_outside_the_frame() -> None:
    assert kinds(Text(197 + 50j, "text", 3.5)) == ["frame"]
    assert kinds(Text(50 - 0.1j, "text", 3.5)) == ["frame"]


def test_lines_clipped_to_a_box_agree_with_shapely() -> None:
    random = np.random.default_rng(7)
    starts, ends = random.uniform(-20, 20, (2, 200)) + 1j * random.uniform(-20, 20, (2, 200))
    box = corners(Text(-5 - 2j, "graphcam", 5.0, angle=0.6))
    polygon = shapely.Polygon([(p.real, p.imag) for p in box])
    low, high = spans_in_box(starts, ends, box, 0.0)
    clipped = np.maximum(0.0, high - low) * np.abs(ends - starts)
    expected = [
        shapely.LineString([(a.real, a.imag), (b.real, b.imag)]).intersection(polygon).length
        for a, b in zip(starts, ends, strict=True)
    ]
    assert np.allclose(clipped, expected, atol=1e-9)
    assert np.count_nonzero(clipped) > 30

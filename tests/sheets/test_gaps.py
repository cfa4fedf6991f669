"""A thin line is parted where a text stands on it; what measures and what was found is not."""

from __future__ import annotations

import math

import numpy as np
import pytest
from overlaps import overlaps

from graphcam.drafting.acts import Act, Kind
from graphcam.drafting.marks import Role
from graphcam.sheets.labels import TEXT_GAP, parted_steps
from graphcam.sheets.model import (
    ArcEntity,
    Box,
    Circles,
    Drawing,
    Entity,
    Group,
    Length,
    Page,
    Source,
    Stroke,
    Strokes,
    Text,
)
from graphcam.sheets.sampling import corners, pieces

TEXT = Text(100 + 100j, "12′", 2.5)
MIDDLE = complex(corners(TEXT).mean())
ACT = Act(Kind.PARALLEL, "a", "lines", {}, 3)


def places(entity: Entity) -> list[int]:
    """Which places of the act it shows."""
    assert entity.source is not None
    assert entity.source.index is not None
    return entity.source.index.tolist()


def through(*entities: Entity, text: Text = TEXT) -> list[Entity]:
    """What becomes of lines beside a text of a later step."""
    first, second = parted_steps([entities, [text]])
    assert second == [text]
    drawing = Drawing("", (Page(300, 300, Box(0, 0, 300, 300), (Group("a", tuple(first)), Group("b", (text,)))),))
    assert overlaps(drawing, width=0.0) == []
    return first


@pytest.mark.parametrize("turn", [1, 1j, np.exp(0.7j), np.exp(2.5j)])
@pytest.mark.parametrize("slope", [0.0, 0.5])
def test_a_straight_line_ends_beside_the_text_and_goes_on_behind_it(turn: complex, slope: float) -> None:
    text = Text(100 + 100j, "12′", 2.5, angle=slope)
    middle = complex(corners(text).mean())
    ends = middle - 30 * turn, middle + 30 * turn
    for line in (Stroke(np.array(ends), Role.CONSTRUCTION), Strokes(np.array(ends[:1]), np.array(ends[1:]), Role.AXIS)):
        (left,) = through(line, text=text)
        starts, stops = pieces(left)
        assert left.role == line.role
        assert (starts[0], stops[1]) == pytest.approx(ends)
        # Both ends of the gap lie on the line, at least as far from the text as is usual.
        for end in (stops[0], starts[1]):
            assert ((end - middle) / turn).imag == pytest.approx(0, abs=1e-9)
        assert abs(starts[1] - stops[0]) > 2 * TEXT_GAP


def test_a_circle_becomes_an_arc_and_the_others_stay_whole() -> None:
    centres, source = np.array([MIDDLE - 20, MIDDLE + 50]), Source(ACT, np.array([4, 7]))
    circles = Circles(centres, 20.0, Role.CONSTRUCTION, source=source)
    arcs = [e for e in through(circles) if isinstance(e, ArcEntity)]
    (whole,) = [e for e in through(circles) if isinstance(e, Circles)]
    assert whole.centres.tolist() == [MIDDLE + 50]
    assert places(whole) == [7]
    assert all(arc.centre == MIDDLE - 20 and arc.radius == 20 for arc in arcs)
    assert [places(arc) for arc in arcs] == [[4]] * len(arcs)
    # The rest of the circle is there: about so much is missing as the text with its margins is high.
    missing = 20 * (2 * math.pi - sum(arc.end - arc.start for arc in arcs))
    assert missing == pytest.approx(np.ptp(corners(TEXT).imag) + 2 * TEXT_GAP, abs=0.3)


def test_every_part_keeps_its_place_of_the_act() -> None:
    starts = MIDDLE + np.array([-30 + 20j, -30, -30 - 20j])
    lines = Strokes(starts, starts + 60, Role.CONSTRUCTION, Source(ACT, np.array([0, 1, 2])))
    (left,) = through(lines)
    assert places(left) == [0, 1, 1, 2]
    corners_of = MIDDLE + np.array([-30 + 20j, -30, 30, 30 - 20j])
    (left,) = through(Stroke(corners_of, Role.CONSTRUCTION, False, Source(ACT, np.array([0, 1, 2, 3]))))
    assert places(left) == [1, 2, 2, 3], "a side belongs to the corner to which it leads"


def test_what_is_not_crossed_is_the_same() -> None:
    beside = Stroke(MIDDLE + np.array([-30 + 5j, 30 + 5j]), Role.CONSTRUCTION)
    (left,) = through(beside)
    assert left is beside


@pytest.mark.parametrize("role", [Role.CURVE, Role.RESULT, Role.LIMIT, Role.SCALE, "frame"])
def test_what_is_not_thin_is_not_parted(role: str) -> None:
    line = Stroke(MIDDLE + np.array([-30, 30]), role)
    ((left,), _) = parted_steps([[line], [TEXT]])
    assert left is line


def test_a_leader_is_parted_and_a_dimension_is_not() -> None:
    """Else its lines would not be known for those of the dimension, which a CAD program measures."""
    line, leader = (Strokes(MIDDLE - np.array([30]), MIDDLE + np.array([30]), Role.DIMENSION) for _ in range(2))
    measuring = Text(10 + 10j, "60", 3.5, of=Length(MIDDLE - 30, MIDDLE + 30, MIDDLE - 30, (line,)))
    ((first, second), _) = parted_steps([[line, leader], [TEXT, measuring]])
    assert first is line
    assert isinstance(second, Strokes)
    assert len(second.starts) == 2

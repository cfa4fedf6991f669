"""The raster of a page: what a letter costs in a cell, and that every text takes its cheapest place."""

from __future__ import annotations

import numpy as np
import pytest
from overlaps import place

from graphcam.drafting.marks import Role
from graphcam.sheets.label_candidates import LabelText, label_around
from graphcam.sheets.labels import Occupancy, lettered_steps, shading_parted
from graphcam.sheets.model import Box, Circles, Heads, Stroke, Strokes, Text
from graphcam.sheets.sampling import corners

FRAME = Box(10.0, 20.0, 60.0, 50.0)
FORBIDDEN = 200.0


def cost(paper: Occupancy, *points: complex) -> list[float]:
    """Of a letter in the cell of each point."""
    return paper.cost(np.array(points)[:, None]).tolist()


def test_a_letter_may_stand_in_the_frame_only():
    paper = Occupancy(FRAME)
    inside = [10.1 + 20.1j, 59.9 + 20.1j, 10.1 + 49.9j, 59.9 + 49.9j, 30 + 30j]
    beyond = [9.9 + 30j, 60.1 + 30j, 30 + 19.9j, 30 + 50.1j, -500 + 0j, 30 + 999j]
    assert cost(paper, *inside) == [0.0] * 5
    assert cost(paper, *beyond) == [FORBIDDEN] * 6
    # A frame that is no whole number of cells loses nothing of its last ones.
    assert cost(Occupancy(Box(0, 0, 10.2, 10.2)), 10.1 + 10.1j) == [0.0]


def test_a_cell_is_half_a_millimetre_wide_and_keeps_its_highest_cost():
    paper = Occupancy(FRAME)
    paper.take(np.array([20.2 + 30.2j]), 7.0)
    near = [20.01 + 30.01j, 20.49 + 30.49j, 19.99 + 30.2j, 20.51 + 30.2j, 20.2 + 29.99j, 20.2 + 30.51j]
    assert cost(paper, *near) == [7.0, 7.0, 0.0, 0.0, 0.0, 0.0]
    paper.take(np.array([20.2 + 30.2j]), 3.0)
    assert cost(paper, 20.2 + 30.2j) == [7.0]
    paper.take(np.array([20.2 + 30.2j]), 9.0)
    # All letters of a text together.
    assert paper.cost(np.array([[20.2 + 30.2j, 20.3 + 30.3j, 30 + 30j]])).tolist() == [18.0]


@pytest.mark.parametrize(
    ("role", "worth"),
    [
        (Role.RESULT, 200.0), (Role.CURVE, 80.0), (Role.LIMIT, 80.0), (Role.CONSTRUCTION, 2.0), (Role.AXIS, 2.0),
        (Role.DIMENSION, 80.0), (Role.HATCH, 0.4), ("frame", 200.0), ("table", 80.0), ("ruling", 2.0),
    ],
)  # fmt: skip
def test_a_line_costs_by_its_width_in_every_cell_that_it_crosses(role, worth):
    paper = Occupancy(FRAME)
    paper.take_entities([Strokes(np.array([12.1 + 22.1j]), np.array([50.1 + 40.1j]), role)])
    along = 12.1 + 22.1j + np.linspace(0, 1, 2000) * (38 + 18j)
    assert np.mean(np.isclose(cost(paper, *along), worth)) > 0.9
    beside = along + (18 - 38j) / 42 * 1.2
    assert not any(cost(paper, *beside))


@pytest.mark.parametrize(("angle", "part"), [(0.0, 1.0), (0.5, 0.85)])
def test_a_text_forbids_the_cells_of_its_box(angle, part):
    """All of them where it lies level, else so many that no letter has room between."""
    paper, text, turn = Occupancy(FRAME), Text(20 + 30j, "graphcam", 5.0, angle=angle), np.exp(1j * angle)
    paper.take_entities([text])
    a, b, _, d = corners(text)
    shares = np.random.default_rng(2).random((2, 500))
    assert np.mean(cost(paper, *(a + shares[0] * (b - a) + shares[1] * (d - a)))) >= part * FORBIDDEN
    # Not beyond it by more than a cell.
    assert cost(paper, a - 1.5 * turn, b + 1.5 * turn, a - 1.5j * turn, d + 1.5j * turn) == [0.0] * 4


def test_round_and_filled_entities_take_their_lines():
    paper = Occupancy(FRAME)
    paper.take_entities([Circles(np.array([35 + 35j]), 8.0, Role.RESULT)])
    ring = 35 + 35j + 8 * np.exp(1j * np.linspace(0, 6, 300))
    assert np.mean(np.array(cost(paper, *ring)) == FORBIDDEN) > 0.9
    assert cost(paper, 35 + 35j) == [0.0]
    paper.take_entities([Heads(np.array([[15 + 25j, 20 + 25j, 20 + 27j]]), Role.RESULT)])
    assert cost(paper, 17.2 + 25.1j) == [FORBIDDEN]


def writing(*places: complex, price: list[float], anchor: complex | None = None) -> LabelText:
    anchors = np.full(len(places), complex("nan") if anchor is None else anchor)
    return LabelText("HHH", 3.5, np.array(places), np.zeros(len(places)), np.array(price), anchors)


def chosen(candidate: LabelText, *drawn: Strokes) -> complex:
    """The centre of the place that the text takes."""
    ((text, *_),) = place([candidate], drawn, FRAME)
    return complex(corners(text).mean())


def test_the_cheapest_place_is_taken_also_where_it_is_not_among_the_first():
    places = [20 + 30j + k * 0.01 for k in range(60)]
    for best in (0, 23, 24, 30, 59):
        price = [50.0 - k * 0.1 for k in range(60)]
        price[best] = 1.0
        assert chosen(writing(*places, price=price)) == pytest.approx(places[best])
    # Of two at the same price it is the first.
    assert chosen(writing(*places[:30], price=[5.0] * 30)) == pytest.approx(places[0])


def test_a_free_place_is_worth_more_than_a_near_one_by_what_lies_there():
    bold = Strokes(np.array([15 + 30j]), np.array([30 + 30j]), Role.RESULT)
    thin = Strokes(np.array([15 + 30j]), np.array([30 + 30j]), Role.CONSTRUCTION)
    places = 22 + 30j, 45 + 30j
    assert chosen(writing(*places, price=[0.0, 1000.0]), bold) == pytest.approx(places[1])
    # Across a thin line it costs the cells of the line: two for each half of a millimetre of the letters' width.
    cells = corners(Text(0j, "HHH", 3.5)).real.max() / 0.5
    assert chosen(writing(*places, price=[0.0, 2.0 * cells + 10]), thin) == pytest.approx(places[0])
    assert chosen(writing(*places, price=[0.0, 2.0 * cells - 5]), thin) == pytest.approx(places[1])


@pytest.mark.parametrize(("gap", "free"), [(0.3, False), (1.2, True)])
@pytest.mark.parametrize("side", [1, -1, 1j, -1j])
def test_a_text_keeps_a_margin_from_a_bold_line(gap, free, side):
    half = complex(np.ptp(corners(Text(0j, "HHH", 3.5)).real), np.ptp(corners(Text(0j, "HHH", 3.5)).imag)) / 2
    near, far = 35 + 35j, 35 + 35j - 10 * side
    beside = near + side * (abs(half.real * side.real + half.imag * side.imag) + gap)
    line = Strokes(np.array([beside - 12j * side]), np.array([beside + 12j * side]), Role.RESULT)
    assert chosen(writing(near, far, price=[0.0, 5.0]), line) == pytest.approx(near if free else far)


def test_a_leader_ends_at_the_nearer_end_of_a_shelf_along_its_text():
    wide, high = np.ptp(corners(Text(0j, "HHH", 3.5)).real), np.ptp(corners(Text(0j, "HHH", 3.5)).imag)
    half = wide / 2 + 0.6, high / 2 + 0.6
    for centre, (across, up) in (
        (36 + 45j, (-1, -1)),
        (50 + 35j, (-1, -1)),
        (50 + 45j, (-1, -1)),
        (20 + 24j, (1, 1)),
        (20 + 35j, (1, -1)),
    ):
        end, other = centre + complex(across * half[0], up * half[1]), centre + complex(-across * half[0], up * half[1])
        ((text, leader),) = place([writing(centre, price=[1.0], anchor=35 + 35j)], [], FRAME)
        assert corners(text).mean() == pytest.approx(centre)
        assert leader.role == Role.DIMENSION
        assert leader.starts == pytest.approx(np.array([35 + 35j, end]))
        assert leader.ends == pytest.approx(np.array([end, other]))
    ((text,),) = place([writing(35 + 45j, price=[1.0])], [], FRAME)
    assert isinstance(text, Text)


def test_a_leader_crosses_lines_at_a_small_cost_but_no_text():
    line = Strokes(np.array([12 + 38j]), np.array([45 + 38j]), Role.CONSTRUCTION)
    # Above it crosses the line: a tenth of one and a half for each of its 24 places in the line.
    candidate = writing(35 + 45j, 35 + 25j, price=[0.0, 0.1], anchor=35 + 35j)
    assert chosen(candidate, line) == pytest.approx(35 + 25j)
    assert chosen(writing(35 + 45j, 35 + 25j, price=[0.0, 2.0], anchor=35 + 35j), line) == pytest.approx(35 + 45j)
    text = Text(31 + 37j, "HHHH", 2.5)
    ((found, _),) = place([writing(35 + 45j, 35 + 25j, price=[0.0, 15.0], anchor=35 + 35j)], [text], FRAME)
    assert corners(found).mean() == pytest.approx(35 + 25j)


def test_texts_of_dimensions_choose_first():
    free, bound = (writing(30 + 35j, 30 + 25j, price=[0.0, 5.0]) for _ in range(2))
    bound = LabelText(**{**vars(bound), "bound": True})
    (first,), (second,) = place([free, bound], [], FRAME)
    assert corners(second).mean() == pytest.approx(30 + 35j)
    assert corners(first).mean() == pytest.approx(30 + 25j)


def test_the_texts_of_steps_keep_off_all_steps_and_come_back_to_their_own():
    wall = Stroke(np.array([12 + 36j, 58 + 36j]), Role.RESULT)
    steps = [([], [label_around(30 + 35j, "first", 3.5, 1j)]), ([wall], [label_around(45 + 35j, "second", 3.5, 1j)])]
    table = Strokes(np.array([12 + 33j]), np.array([40 + 33j]), Role.RESULT)
    first, second = lettered_steps(steps, [table], FRAME)
    assert [e.text for e in first if isinstance(e, Text)] == ["first"]
    assert second[0] is wall
    assert [e.text for e in second if isinstance(e, Text)] == ["second"]
    assert corners(first[0]).imag.max() < 36 or corners(first[0]).imag.min() > 36
    assert not (corners(first[0]).imag.min() < 33 < corners(first[0]).imag.max())


def test_shading_is_interrupted_by_the_texts_of_every_step_and_nothing_else_is():
    shade, thin = (
        Strokes(np.array([15 + 35j]), np.array([55 + 35j]), role) for role in (Role.HATCH, Role.CONSTRUCTION)
    )
    parted, other = shading_parted([[shade, thin], [Text(30 + 34j, "A", 3.5)]])
    assert len(parted[0].starts) == 2
    assert parted[1] is thin
    assert isinstance(other[0], Text)

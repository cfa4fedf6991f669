"""Boxes, rooms and preferences, against the same thing done point by point."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from graphcam.sheets.model import Box, bounding_box
from graphcam.sheets.packing import (
    Room,
    at_left,
    least_weighted,
    middle,
    prefer_bottom_left,
    prefer_bottom_right,
    prefer_high,
    prefer_top,
    prefer_top_left,
    prefer_top_right,
)

WHOLE = st.integers(0, 6)
BOXES = st.builds(lambda x, y, wide, up: Box(x, y, x + 1 + wide, y + 1 + up), WHOLE, WHOLE, WHOLE, WHOLE)


def cells(box: Box) -> set[tuple[int, int]]:
    """The unit squares that a box of whole numbers consists of."""
    return {(x, y) for x in range(box.left, box.right) for y in range(box.bottom, box.top)}


@given(BOXES, BOXES)
def test_boxes_meet_where_they_share_a_square_and_hold_what_has_no_other(one, other):
    assert one.meets(other) == bool(cells(one) & cells(other))
    assert one.holds(other) == (cells(other) <= cells(one))
    both = bounding_box([one, other])
    assert both.holds(one)
    assert both.holds(other)
    assert (both.left, both.top) == (min(one.left, other.left), max(one.top, other.top))
    assert (both.right, both.bottom) == (max(one.right, other.right), min(one.bottom, other.bottom))


@given(BOXES)
def test_the_parts_of_a_box(box):
    assert box.width * box.height == len(cells(box))
    assert box.corner == complex(box.left, box.bottom)
    a, b, c, d = box.corners
    assert (a, c) == (box.corner, complex(box.right, box.top))
    # Counter-clockwise, along the sides.
    assert (b - a, c - b, d - c, a - d) == (box.width, 1j * box.height, -box.width, -1j * box.height)
    moved = box.moved(3 - 2j)
    assert moved.corners == tuple(corner + 3 - 2j for corner in box.corners)
    grown = box.grown(2)
    assert (grown.corner, grown.width, grown.height) == (box.corner - 2 - 2j, box.width + 4, box.height + 4)


def taken(room: Room) -> set[tuple[int, int]]:
    """The full cells, column and row."""
    return {(int(x), int(y)) for y, x in np.argwhere(room.full)}


def test_a_room_has_whole_cells_of_2_mm_only():
    assert Room(Box(5, 5, 26, 16.9)).full.shape == (5, 10)
    assert Room(Box(0, 0, 3.99, 4)).full.shape == (2, 1)


def test_a_box_takes_the_cells_that_it_touches_but_not_those_it_only_borders():
    def cells_of(*box: float) -> set[tuple[int, int]]:
        return taken(Room(Box(10, 20, 30, 40), [Box(*box)]))

    assert cells_of(12, 24, 16, 26) == {(1, 2), (2, 2)}
    assert cells_of(11.9, 24, 16.1, 26) == {(0, 2), (1, 2), (2, 2), (3, 2)}
    assert cells_of(12, 23.9, 14, 26.1) == {(1, 1), (1, 2), (1, 3)}
    # Rounding does not make it touch the next cell.
    assert cells_of(12 - 1e-7, 24 - 1e-7, 16 + 1e-7, 26 + 1e-7) == {(1, 2), (2, 2)}
    # What lies outside takes nothing of the other side.
    assert cells_of(2, 12, 12, 22) == {(0, 0)}
    assert cells_of(28, 38, 50, 60) == {(9, 9)}
    assert cells_of(0, 0, 9, 60) == set()
    assert cells_of(0, 0, 60, 19) == set()


@pytest.mark.parametrize("margin", [0.0, 2.0, 3.0])
def test_points_take_the_squares_about_them(margin):
    room = Room(Box(10, 20, 40, 60))
    random = np.random.default_rng(1)
    points = random.uniform(0, 50, 12) + 1j * random.uniform(10, 70, 12)
    room.take_points(points, margin)
    at = np.floor((points - room.corner).real / 2), np.floor((points - room.corner).imag / 2)
    reach = int(np.ceil(margin / 2))
    inside = [(x, y) for x, y in zip(*at, strict=True) if 0 <= x < 15 and 0 <= y < 20]
    assert 0 < len(inside) < 12
    steps = range(-reach, reach + 1)
    near = {(int(x) + i, int(y) + j) for x, y in inside for i in steps for j in steps}
    assert taken(room) == {(x, y) for x, y in near if 0 <= x < 15 and 0 <= y < 20}


def test_a_copy_of_a_room_is_filled_by_itself():
    room = Room(Box(0, 0, 10, 10), [Box(0, 0, 2, 2)])
    other = room.copy()
    other.take(Box(4, 4, 6, 6))
    assert taken(other) - taken(room) == {(2, 2)}
    assert other.corner == room.corner
    aside = room.copy(100 + 50j)
    assert (aside.corner, taken(aside)) == (100 + 50j, taken(room))


def test_room_is_found_about_all_that_was_taken_in_whatever_order():
    """What is full is counted again only above what has been taken, in copies too."""
    room = Room(Box(0, 0, 20, 60))
    side = Box(0, 0, 10, 10)

    def lowest(some: Room) -> complex | None:
        return some.find([side], lambda x, y: y + 0.01 * x)

    assert lowest(room) == 0j
    room.take(Box(0, 40, 20, 60))
    assert lowest(room) == 0j
    other = room.copy()
    other.take(Box(0, 0, 20, 10))
    assert (lowest(other), lowest(room)) == (10j, 0j)
    other.take(Box(0, 24, 2, 26))
    room.take(Box(0, 0, 4, 2))
    assert (lowest(other), lowest(room)) == (10j, 4 + 0j)
    other.take(Box(0, 10, 20, 12))
    assert lowest(other) == 12j
    other.take(Box(0, 0, 20, 40))
    assert lowest(other) is None


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10**6))
def test_the_room_that_is_found_is_the_best_that_is_free(seed):
    """Every move on the grid is tried."""
    random = np.random.default_rng(seed)
    inside = Box(6, 4, 6 + 2 * random.integers(4, 12), 4 + 2 * random.integers(4, 12))
    full = [Box(*low, *(low + random.integers(1, 6, 2))) for low in random.integers(2, 20, (3, 2))]
    room = Room(inside, [Box(*map(float, (b.left, b.bottom, b.right, b.top))) for b in full])
    shape = [Box(*low, *(low + random.integers(1, 7, 2))) for low in random.integers(-8, 8, (2, 2))]
    across, up = random.normal(size=2)
    found = room.find(shape, lambda x, y: across * x + up * y)

    def free(by: complex) -> bool:
        probe = Room(inside)
        covered = [box.moved(by) for box in shape]
        probe.full[:] = False
        for box in covered:
            probe.take(box)
        whole = all(cell_inside(box, inside) for box in covered)
        return whole and not (probe.full & room.full).any()

    moves = [2 * complex(x, y) for x in range(-14, 22) for y in range(-14, 22)]
    possible = [by for by in moves if free(by)]
    if not possible:
        assert found is None
        return
    cost = [across * by.real + up * by.imag for by in possible]
    assert found in possible
    assert across * found.real + up * found.imag == pytest.approx(min(cost), abs=1e-9)


def cell_inside(box: Box, inside: Box) -> bool:
    """Whether all cells that a box touches lie inside."""
    cells = np.array([np.floor(box.left / 2), np.floor(box.bottom / 2), np.ceil(box.right / 2), np.ceil(box.top / 2)])
    return Box(inside.left, inside.bottom, inside.right, inside.top).holds(Box(*(2 * cells)))


GRID_X, GRID_Y = (grid.ravel().astype(float) for grid in np.meshgrid(np.arange(7), np.arange(5)))


@pytest.mark.parametrize(
    ("preference", "first", "second"),
    [
        (prefer_top_left, (0, 4), (0, 3)),
        (prefer_top_right, (6, 4), (5, 4)),
        (prefer_bottom_left, (0, 0), (1, 0)),
        (prefer_bottom_right, (6, 0), (6, 1)),
        (prefer_high, (0, 4), (1, 4)),
        (at_left, (0, 2), (0, 1)),
        (prefer_top, (3, 4), (2, 4)),
        (middle, (3, 2), (3, 1)),
        (least_weighted(-1, -2), (6, 4), (5, 4)),
    ],
)
def test_preferences_take_first_and_next_what_they_say(preference, first, second):
    order = np.argsort(preference(GRID_X, GRID_Y), kind="stable")
    assert [(GRID_X[k], GRID_Y[k]) for k in order[:2]] == [first, second]


@pytest.mark.parametrize(
    ("preference", "edge"),
    [
        *[
            (prefer_top_left, GRID_X == 0),
            (at_left, GRID_X == 0),
            (prefer_high, GRID_Y == 4),
            (prefer_top_right, GRID_Y == 4),
        ],
        *[(prefer_bottom_left, GRID_Y == 0), (prefer_top, GRID_Y == 4)],
    ],
)
def test_an_edge_is_taken_from_end_to_end_before_the_next_cells(preference, edge):
    order = np.argsort(preference(GRID_X, GRID_Y), kind="stable")
    assert edge[order[: edge.sum()]].all()


def test_at_the_lower_right_a_cell_to_the_right_is_worth_three_upwards():
    costs = prefer_bottom_right(np.array([6.0, 5.0, 6.0]), np.array([2.0, 0.0, 4.0]))
    assert costs[0] < costs[1] < costs[2]

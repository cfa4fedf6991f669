"""The region of the cam centre, as plane geometry: against a search over all its corners and edges."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from scipy.optimize import minimize

from graphcam.constructions.region import (
    Boundary,
    binding_boundaries,
    boundary,
    highest_on,
    nearest_for_many,
    nearest_permitted,
    permitted_part,
)
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP
from graphcam.drafting.hand import Hand
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.pencil import Pencil
from graphcam.plane_vectors import dot
from graphcam.words import say

same_every_time = settings(derandomize=True, deadline=None, max_examples=60)
leanings = st.floats(np.radians(2), np.radians(80))


def a_hand(samples: int | None = None) -> Hand:
    return Hand(Pencil(samples=samples), Meaning("region", say("Region"), say("Lines bound it.")))


def leaning(hand: Hand, name: str, angle: float, side: int, depth: float | np.ndarray) -> Drawn:
    """A line at an angle to the vertical that permits what lies below it, away from ``side``."""
    return hand.given(name, -UP * np.asarray(depth), -UP * side * np.exp(1j * side * angle))


def nearest_place(hand: Hand, lines: list[Drawn]) -> np.ndarray:
    """The one that is nearest to the origin."""
    return nearest_permitted(hand, "centre", lines, hand.given("start")).points


@same_every_time
@given(leanings, leanings, leanings, st.floats(1, 50), st.floats(-10, 50), st.floats(-10, 50))
def test_the_nearest_place_is_the_least_distance_over_the_region(a, b, c, first, second, third):
    """Against quadratic programming."""
    hand, given_lines = a_hand(), [(a, 1, first), (b, -1, second), (c, -1, third)]
    drawn = [leaning(hand, f"{k}", *each) for k, each in enumerate(given_lines)]
    assume(min(abs(a - other) for other in (b, c)) > 0 and abs(b - c) > np.radians(1))  # readable crossings
    place, lines = complex(nearest_place(hand, drawn)), [boundary(line) for line in drawn]
    assert all(line.clearance(np.asarray(place)) > -1e-8 for line in lines)
    found = least_distance(lines)
    assert abs(place) == pytest.approx(found, rel=1e-5, abs=1e-5)
    assert {line.name for line in binding_boundaries(lines, place)} or abs(place) < 1e-9


def least_distance(lines: list[Boundary]) -> float:
    """By quadratic programming, from a place deep inside."""
    inside = [
        {"type": "ineq", "fun": lambda xy, line=line: float(line.clearance(np.asarray(complex(*xy))))} for line in lines
    ]
    found = minimize(
        lambda xy: xy @ xy, [0.0, -200.0], jac=lambda xy: 2 * xy, constraints=inside, method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 500},
    )  # fmt: skip
    return float(np.hypot(*found.x))


@same_every_time
@given(leanings, leanings, st.floats(1, 50), st.floats(-10, 50), st.floats(-40, 40))
def test_the_highest_place_on_a_vertical_is_permitted_and_no_higher_one_is(a, b, first, second, x):
    hand = a_hand()
    lines = [leaning(hand, "one", a, 1, first), leaning(hand, "other", b, -1, second)]
    place = highest_on(hand, "centre", lines, hand.given("upright", x, UP), hand.given("level", along=1)).points
    assert place.real == pytest.approx(x, abs=1e-9)
    assert all(boundary(line).clearance(place) > -1e-9 for line in lines)
    above = place + UP * 1e-3
    assert place.imag == 0 or any(boundary(line).clearance(above) < 0 for line in lines)


def test_every_sample_has_its_own_region():
    depths, tilt = np.array([10.0, 20.0, 30.0]), np.pi / 6
    many = a_hand(3)
    # What lies on the board is alike for all hands; what they drew is not.
    rise = Drawn(many.given("rise").act, -UP * depths, np.full(3, -UP * np.exp(1j * tilt)), sampled=True)
    together = nearest_place(many, [rise, leaning(many, "rest", tilt, -1, 0.0)])
    for depth, found in zip(depths, together, strict=True):
        one = a_hand()
        alone = nearest_place(one, [leaning(one, "rise", tilt, 1, depth), leaning(one, "rest", tilt, -1, 0.0)])
        assert found == pytest.approx(complex(alone), rel=1e-14)


def test_where_only_an_unreadable_corner_is_left_no_place_is_read():
    """Two lines that cross at less than a degree, and each cuts off the other's foot."""
    hand, flat = a_hand(), np.radians(89.6)
    lines = [leaning(hand, "one", flat, 1, 5.0), leaning(hand, "other", flat, -1, 5.0)]
    assert np.isnan(nearest_place(hand, lines))


def test_the_permitted_part_of_a_square():
    square = [0j, 2 + 0j, 2 + 2j, 2j]
    diagonal = Boundary("diagonal", np.asarray(0j), np.asarray(1 - 1j))
    part = permitted_part([diagonal], square)
    x, y = part.real, part.imag
    assert np.all(y <= x + 1e-15)
    area = abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2
    assert area == pytest.approx(2.0)
    assert permitted_part([], square).tolist() == square


# --- many lines ------------------------------------------------------------------------------------------------------


def random_lines(seed: int) -> tuple[np.ndarray, np.ndarray, complex]:
    """Up to 40 lines: at random, from one side, or a family that hardly turns from one line to the next."""
    random = np.random.default_rng(seed)
    count = int(random.integers(1, 41))
    spread = (np.pi, 2.0, 0.3, 1.4)[seed % 4]
    inwards = np.exp(1j * np.sort(random.uniform(-spread, spread, count)))
    touches = random.uniform(-50, 50, (count, 2)) @ [1, 1j]
    if spread < 2:
        touches = inwards * random.uniform(20, 21, count)
    return touches, inwards, complex(*random.uniform(-10, 10, 2))


def nearest_by_search(touches, inwards, start: complex) -> complex:
    """Over the start itself, all feet and all corners; NaN where no line permits any of them."""
    depth = dot(inwards, touches - start)
    i, j = np.triu_indices(touches.size, 1)
    turn = (np.conj(inwards[i]) * inwards[j]).imag
    with np.errstate(all="ignore"):
        corners = 1j * (depth[j] * inwards[i] - depth[i] * inwards[j]) / turn
    places = start + np.concatenate([[0], depth * inwards, corners[np.isfinite(corners)]])
    permitted = np.all(dot(inwards[:, None], places - touches[:, None]) >= -1e-8, axis=0)
    places = places[permitted]
    return places[np.argmin(np.abs(places - start))] if places.size else complex(np.nan, np.nan)


SEEDS = range(400)


def test_the_nearest_place_among_many_lines_is_the_one_that_a_search_finds():
    empty = 0
    for seed in SEEDS:
        touches, inwards, start = random_lines(seed)
        place, lines = nearest_for_many(touches, inwards, np.asarray(start))
        found = nearest_by_search(touches, inwards, start)
        empty += bool(np.isnan(found))
        np.testing.assert_allclose(place, found, rtol=1e-9, atol=1e-9, err_msg=str(seed))
        if np.isfinite(found) and abs(place - start) > 1e-9:
            on = dot(inwards[lines], place - touches[lines])
            assert np.abs(on).max() < 1e-7 * (1 + abs(place - start))  # the place lies on the lines that are named
    assert 20 < empty < len(SEEDS) / 2


def test_the_nearest_place_among_many_lines_is_the_least_of_quadratic_programming():
    for seed in range(2, 42, 4):  # families: one side, so that there always is a place
        touches, inwards, start = random_lines(seed)
        place, _ = nearest_for_many(touches, inwards, np.asarray(start))
        depth = dot(inwards, touches - start)
        found = minimize(
            lambda xy: xy @ xy, [100.0, 0.0], jac=lambda xy: 2 * xy, method="SLSQP", options={"ftol": 1e-14},
            constraints={
                "type": "ineq", "fun": lambda xy, n=inwards, h=depth: dot(n, np.asarray(complex(*xy))) - h,
                "jac": lambda xy, n=inwards: np.stack([n.real, n.imag], -1),
            },
        )  # fmt: skip
        assert abs(place - start) == pytest.approx(np.hypot(*found.x), rel=1e-7)


def test_a_start_that_no_line_cuts_off_is_the_nearest_place():
    place, _ = nearest_for_many(np.array([0j, -3j]), np.array([1 + 0j, 1j]), np.asarray(2 + 1j))
    assert complex(place) == 2 + 1j


def test_every_sample_of_many_lines_has_its_own_place():
    """Some have a place, some have none, and each takes its own number of steps."""
    random = np.random.default_rng(5)
    inwards = np.exp(1j * random.uniform(-np.pi, np.pi, (100, 6)))
    touches = random.uniform(-50, 50, (100, 6, 2)) @ np.array([1, 1j])
    start = random.uniform(-10, 10, (100, 2)) @ np.array([1, 1j])
    together, lines = nearest_for_many(touches, inwards, start)
    assert lines.shape == (100, 2)
    assert 5 < np.isnan(together).sum() < 95
    for k in range(100):
        alone, _ = nearest_for_many(touches[k], inwards[k], start[k])
        np.testing.assert_array_equal(together[k], alone)

"""Ruler and compass: every operation by the theorem it rests on."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from mpmath import mp, mpf
from numpy.testing import assert_allclose

from graphcam.drafting.euclid import (
    READABLE_CROSSING,
    UP,
    centre_of_circle,
    circle_crossing,
    foot,
    perpendicular_bisector,
    ray_to_circle,
    readable_crossing,
    tangent_of_circle,
    turned_direction,
    unit,
)
from graphcam.plane_vectors import cross, dot

BOARD = 100.0
"""Points lie within this distance of the origin, in x and in y [mm]."""
ROUNDING = 1e-11
"""What rounding may leave of a length on such a board [mm]."""

same_every_time = settings(derandomize=True, deadline=None, max_examples=150)
lengths = st.floats(-BOARD, BOARD)
angles = st.floats(-math.pi, math.pi)
points = st.builds(lambda x, y: np.asarray(complex(x, y)), lengths, lengths)
directions = st.builds(lambda r, t: np.asarray(r * np.exp(1j * t)), st.floats(0.1, BOARD), angles)


@same_every_time
@given(points, points)
def test_scalar_and_vector_product_make_up_the_lengths(a, b):
    """Lagrange's identity."""
    assert_allclose(dot(a, b) ** 2 + cross(a, b) ** 2, np.abs(a) ** 2 * np.abs(b) ** 2, rtol=1e-13, atol=1e-300)


@same_every_time
@given(directions, angles)
def test_a_turn_keeps_the_length_and_adds_to_the_angle(direction, angle):
    after = turned_direction(direction, angle)
    assert_allclose(np.abs(after), np.abs(direction), rtol=1e-14)
    assert_allclose(np.angle(after / direction * np.exp(-1j * angle)), 0, atol=1e-14)


@same_every_time
@given(points, points, directions)
def test_the_foot_of_the_perpendicular_is_the_nearest_point_of_the_line(p, q, d):
    """Euclid I.12 and I.19."""
    at = foot(p, q, d)
    assert abs(dot(unit(d), p - at)) < ROUNDING
    assert abs(cross(unit(d), at - q)) < ROUNDING
    others = at + unit(d) * np.linspace(-BOARD, BOARD, 41)
    assert np.all(np.abs(others - p) >= np.abs(at - p) - ROUNDING)


@same_every_time
@given(points, points, lengths)
def test_every_point_of_the_bisector_is_as_far_from_either_end(a, b, t):
    """Euclid I.10 and I.11."""
    middle, direction = perpendicular_bisector(a, b)
    place = middle + direction * t / BOARD
    assert_allclose(np.abs(place - a), np.abs(place - b), rtol=1e-13, atol=ROUNDING)


@same_every_time
@given(points, directions, points, directions)
def test_the_meeting_point_lies_on_both_lines(p, d, q, e):
    at = readable_crossing(p, d, q, e)
    if abs(cross(unit(d), unit(e))) < math.sin(READABLE_CROSSING):
        assert np.isnan(at)
    else:
        far = 1 + abs(at)
        assert abs(cross(unit(d), at - p)) < ROUNDING * far
        assert abs(cross(unit(e), at - q)) < ROUNDING * far


def test_lines_that_cross_below_one_degree_have_no_readable_point_and_spoil_no_other():
    crossing = np.radians([-90.0, -1.01, -0.99, 0.0, 0.99, 1.01, 45.0, 179.01, 178.99])
    at = readable_crossing(np.asarray(0j), np.asarray(2 + 0j), np.asarray(3 + 0j), turned_direction(0.5 + 0j, crossing))
    unreadable = [False, False, True, True, True, False, False, True, False]
    assert np.isnan(at).tolist() == unreadable
    assert_allclose(at[~np.array(unreadable)], 3)


@same_every_time
@given(points, st.floats(1, BOARD), angles, st.floats(0.1, 3), st.floats(0.1, 3))
def test_the_centre_of_a_circle_is_found_from_three_of_its_points(centre, radius, start, first, second):
    """Euclid III.1 and III.25."""
    a, b, c = (centre + radius * np.exp(1j * (start + turn)) for turn in (0, first, first + second))
    assert_allclose(centre_of_circle(a, b, c), centre, atol=1e-9)


def test_three_points_on_a_straight_line_have_no_circle():
    a = np.array([0j, 0j])
    assert np.isnan(centre_of_circle(a, a + 1, a + np.array([2, 2 + 1j]))).tolist() == [True, False]


@same_every_time
@given(points, st.floats(1, BOARD), angles, st.floats(0.01, 3), st.floats(0.01, 3), st.booleans())
def test_the_tangent_is_perpendicular_to_the_radius(centre, radius, start, first, second, clockwise):
    """Euclid III.18; found by the angle in the alternate segment, III.32."""
    sense = -1 if clockwise else 1
    a, b, c = (centre + radius * np.exp(1j * (start + sense * turn)) for turn in (0, first, first + second))
    along = tangent_of_circle(a, b, c)
    ray = (b - centre) / radius
    assert_allclose(along / (sense * UP * ray), 1, atol=1e-10)  # square to the radius, from a to c


def test_the_tangent_of_three_points_on_a_straight_line_is_the_line():
    along = 3 - 4j
    at = tangent_of_circle(*(np.asarray(1j + along * t) for t in (0.0, 0.3, 2.0)))
    assert_allclose(at, along / 5, rtol=1e-15)


@same_every_time
@given(points, st.floats(1, BOARD), angles, directions, st.floats(-0.999, 0.999))
def test_a_ray_leaves_the_circle_on_the_circle_and_on_its_line(centre, radius, angle, d, share):
    p = centre + share * radius * np.exp(1j * angle)  # inside
    at = ray_to_circle(p, d, centre, radius)
    assert_allclose(np.abs(at - centre), radius, rtol=1e-12)
    assert abs(cross(unit(d), at - p)) < ROUNDING
    assert dot(d, at - p) > 0


def test_a_line_that_misses_the_circle_is_a_miss_in_that_element_alone():
    at = ray_to_circle(np.array([4.0, 5.0, 5.1]) + 0j, np.asarray(1j), 0j, 5.0)
    assert_allclose(at[:2], [4 + 3j, 5])
    assert np.isnan(at[2])


@same_every_time
@given(points, st.floats(1, BOARD), points, st.floats(1, BOARD))
def test_two_circles_meet_on_both_and_to_the_left_of_the_way_between_their_centres(p, radius_p, q, radius_q):
    """Euclid I.1 and III.10."""
    distance = abs(q - p)
    assume(distance == 0 or distance > ROUNDING)
    at = circle_crossing(p, radius_p, q, radius_q)
    if np.isnan(at):  # apart, one inside the other, or hardly crossing
        sine = crossing_sine(float(distance), radius_p, radius_q)
        assert sine < math.sin(READABLE_CROSSING) * (1 + 1e-6)
    else:
        assert_allclose([np.abs(at - p), np.abs(at - q)], [radius_p, radius_q], rtol=1e-9)
        assert cross(q - p, at - p) > 0


def crossing_sine(distance: float, a: float, b: float) -> float:
    """The sine of the angle at which two circles cross, by Heron's formula; negative when they do not meet."""
    product = (distance + a + b) * (-distance + a + b) * (distance - a + b) * (distance + a - b)
    return math.copysign(math.sqrt(abs(product)) / (2 * a * b), product)


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
def test_a_line_that_almost_touches_the_circle_keeps_its_digits(gap):
    radius, distance = 50.0, 50.0 * (1 - gap)
    with mp.workdps(40):
        half_chord = float(mp.sqrt(mpf(radius) ** 2 - mpf(distance) ** 2))
    at = ray_to_circle(np.asarray(distance + 0j), np.asarray(UP), 0j, radius)
    assert float(at.imag) == pytest.approx(half_chord, rel=1e-15)

"""Curves faired through plotted points."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.testing import assert_allclose

from graphcam.drafting.curve import faired_line, farthest_on_pieces
from graphcam.drafting.euclid import UP, turned_direction
from graphcam.plane_vectors import dot

same_every_time = settings(derandomize=True, deadline=None, max_examples=150)


def farthest_point(points, direction):
    """That of one smooth piece."""
    points = np.asarray(points)
    return farthest_on_pieces(points, [slice(0, points.shape[-1])], direction)


@same_every_time
@given(st.floats(0.05, 5), st.floats(-2, 2), st.floats(-0.5, 0.5), st.floats(-math.pi, math.pi))
def test_the_farthest_point_of_a_parabola_is_found_exactly(bend, slope, shift, turn):
    x = np.arange(-6.0, 7.0) + shift
    curve = turned_direction(x + UP * (slope * x - bend * x**2), turn)
    top = slope / (2 * bend)
    if abs(top) > 5:  # the top lies beyond the plotted points
        return
    expected = turned_direction(top + UP * slope * top / 2, turn)
    assert_allclose(farthest_point(curve, complex(turned_direction(UP, turn))), expected, atol=1e-12 * (1 + bend) * 100)


@same_every_time
@given(st.floats(0.05, 5), st.floats(-0.8, 0.8))
def test_a_tangent_at_any_angle_touches_a_parabola_exactly(bend, lean):
    """In the direction (sin, cos) the parabola y = -k x^2 reaches farthest at x = tan/(2k)."""
    touch = math.tan(lean) / (2 * bend)
    x = np.linspace(-1, 1, 9) * max(1.0, 2 * abs(touch))
    curve = x - UP * bend * x**2
    assert_allclose(
        farthest_point(curve, complex(math.sin(lean), math.cos(lean))), touch - UP * bend * touch**2, atol=1e-11
    )


def test_nothing_is_read_beyond_an_end():
    x = np.arange(4.0)
    for curve in (x + UP * np.sqrt(x + 1), x + UP * x**2, x + UP * x):
        assert farthest_point(curve, UP) == curve[-1]
        assert farthest_point(curve[::-1], UP) == curve[-1]


def test_nothing_is_read_across_a_corner():
    x = np.arange(9.0)
    roof = x + UP * np.where(x <= 4, 0.2 * x**2, 3.2 - 0.3 * (x - 4))
    pieces = [slice(0, 5), slice(4, 9)]
    assert farthest_on_pieces(roof, pieces, UP) == roof[4]
    assert abs(farthest_point(roof, UP) - roof[4]) > 0.01  # a curve faired over the corner would reach elsewhere


def test_the_farthest_of_pieces_is_farther_than_each():
    x = np.linspace(0, 3, 10)
    curve = x + UP * np.sin(2 * x)
    pieces = [slice(0, 4), slice(3, 10)]
    direction = turned_direction(UP, 0.3)
    best = farthest_on_pieces(curve, pieces, direction)
    reach = [float(dot(direction, farthest_point(curve[piece], direction))) for piece in pieces]
    assert float(dot(direction, best)) == max(reach)


def test_a_smooth_curve_is_read_to_second_order_and_its_height_to_third():
    parts = np.array([16, 32, 64, 128, 256])
    errors = np.zeros((2, parts.size))
    for k, n in enumerate(parts):
        for shift in np.linspace(0, 1, 21):  # wherever the top falls between the points
            x = (np.arange(-n, n + 1) + shift) / n
            top = complex(farthest_point(x + UP * np.exp(x) * np.cos(2 * x), UP))
            place = math.atan(0.5) / 2
            height = math.exp(place) * math.cos(2 * place)
            errors[:, k] = np.maximum(errors[:, k], [abs(top.real - place), abs(top.imag - height)])
    orders = -np.polyfit(np.log(parts), np.log(errors).T, 1)[0]
    assert orders[0] == pytest.approx(2.0, abs=0.1)
    assert orders[1] == pytest.approx(3.0, abs=0.15)


def test_a_plotted_point_is_never_farther_than_the_faired_curve():
    """So what is read from plotted points alone is never more than what the curve reads."""
    x = np.linspace(0, 2, 12) + np.linspace(0, 0.1, 20)[:, None]
    curves = x + UP * np.sin(x) * np.exp(-x)
    assert np.all(farthest_point(curves, UP).imag >= curves.imag.max(axis=-1))


def test_a_point_that_is_missing_spoils_its_own_sample_only():
    x = np.arange(-3.0, 4.0)
    curves = np.stack([x + UP * (9 - x**2)] * 2)
    curves[1, 0] = np.nan
    assert farthest_point(curves, UP).tolist() == [9j, 9j]
    curves[1, :] = np.nan
    tops = farthest_point(curves, UP)
    assert tops[0] == 9j
    assert np.isnan(tops[1])


def test_two_points_are_their_own_curve():
    pair = np.array([0j, 1 + 2j])
    assert farthest_point(pair, UP) == 1 + 2j
    assert faired_line(pair).tolist() == pair.tolist()


@pytest.mark.parametrize("between", [1, 2, 8])
def test_the_faired_line_passes_through_its_points(between):
    random = np.random.default_rng(5)
    points = np.cumsum(random.uniform(1, 3, 9)) + UP * random.normal(0, 4, 9)
    line = faired_line(points, between)
    assert line.size == (points.size - 1) * between + 1
    assert_allclose(line[::between], points, atol=1e-13)


@pytest.mark.parametrize("count", [3, 4, 7])
def test_the_faired_line_of_a_parabola_is_the_parabola(count):
    x = np.arange(count) - 1.3
    line = faired_line(x + UP * (0.4 * x**2 - x + 2))
    assert_allclose(line.imag, 0.4 * line.real**2 - line.real + 2, atol=1e-13)


def test_the_faired_line_has_no_corner():
    x = np.linspace(0, 4, 9)
    line = faired_line(x + UP * np.sin(x), between=400)
    turns = np.abs(np.angle(np.diff(line)[1:] / np.diff(line)[:-1]))
    assert turns.max() < 0.005  # a corner of the polygon turns by 0.25

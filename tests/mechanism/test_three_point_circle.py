"""The circle through three points against circles, an ellipse, and its own orders of convergence."""

from __future__ import annotations

import math

import numpy as np
import pytest
from over_all import over_all
from reference import EPS

from graphcam.mechanism.three_point_circle import circumradius

A, B = 50.0, 30.0


def ellipse(t) -> np.ndarray:
    return np.stack([A * np.cos(t), B * np.sin(t)], axis=-1)


def radius(t: float) -> float:
    return (A**2 * math.sin(t) ** 2 + B**2 * math.cos(t) ** 2) ** 1.5 / (A * B)


def at_distance(t: float, chord: np.ndarray) -> np.ndarray:
    """The parameters of the ellipse at a chord's distance from that of t, by fixed point iteration."""
    step = chord / radius(t) ** (1 / 3) / (A * B) ** (1 / 3)
    for _ in range(60):
        step *= np.abs(chord) / np.linalg.norm(ellipse(t + step) - ellipse(t), axis=-1)
    return t + step


def test_three_points_of_an_ellipse():
    """Computed independently at 50 digits: semi-axes 50 and 30, at pi/3 and 0.1 to both sides."""
    t = math.pi / 3
    assert circumradius(ellipse(t - 0.1), ellipse(t), ellipse(t + 0.1)) == pytest.approx(64.060168370900792, rel=1e-13)
    assert radius(t) == pytest.approx(64.156059729381760, rel=4 * EPS)


@over_all(("unequal", "order"), [(1.0, 2.0), (1.5, 1.0)])
def test_orders_of_convergence(unequal, order):
    """Second order for equal chords, first for unequal ones."""
    t, h = math.pi / 3, 2.0 / 2.0 ** np.arange(6)
    found = circumradius(ellipse(at_distance(t, -h)), ellipse(t), ellipse(at_distance(t, unequal * h)))
    slope = np.polyfit(np.log(h), np.log(np.abs(1 / found - 1 / radius(t))), 1)[0]
    assert slope == pytest.approx(order, abs=0.05)


@over_all("far", [0.0, 1e3, 1e6])
@over_all("h", [1e-1, 1e-3, 1e-5])
def test_rounding_far_from_the_origin_is_that_of_the_points_alone(far, h):
    r, t = 20.0, np.array([-1.0, 0.0, 1.0]) * h
    points = far + r * np.stack([np.cos(1 + t), np.sin(1 + t)], axis=-1)
    rounding_of_the_points = 4 * EPS * (far + r) / (r * h * h)
    assert circumradius(*points) == pytest.approx(r, rel=rounding_of_the_points + h**4)


def test_sides_lines_and_points_that_coincide():
    up = np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]])
    assert circumradius(*up) == pytest.approx(-1)
    assert circumradius(*up[::-1]) == pytest.approx(1)
    assert np.isinf(circumradius([0, 0], [1, 1], [3, 3]))
    assert np.isnan(circumradius([1, 1], [1, 1], [3, 3]))
    assert circumradius(np.zeros((4, 3, 2)), np.ones((3, 2)), np.array([2.0, 0.0])).shape == (4, 3)

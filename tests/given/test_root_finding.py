"""Roots kept in their brackets, against roots at 50 digits."""

from __future__ import annotations

import mpmath
import numpy as np
from hypothesis import given, strategies as st
from over_all import over_all
from reference import EPS

from graphcam.given.root_finding import roots


@given(st.lists(st.floats(1e-12, 1.0), min_size=1, max_size=5), st.floats(0.1, 50.0))
def test_every_function_has_its_own_root(wanted, steepness):
    targets = np.array(wanted)
    found = roots(lambda x: np.expm1(steepness * x) - np.expm1(steepness * targets), 0 * targets, 1 + targets)
    # A root is known no better than the difference of the two exponentials tells it.
    lost = (1 - np.exp(-steepness * targets)) / steepness
    assert np.all(np.abs(found - targets) <= 8 * EPS * (targets + lost + steepness * targets**2))


@over_all(
    ("function", "exact", "low", "high", "steps"),
    [
        (np.cos, mpmath.cos, 1.0, 2.0, 8),
        (lambda x: x * x * x - 2 * x - 5, lambda x: x**3 - 2 * x - 5, 2.0, 3.0, 10),
        (lambda x: np.exp(x) - 1e6, lambda x: mpmath.exp(x) - 10**6, 0.0, 20.0, 16),
        (lambda x: 1 / x - 1e9, lambda x: 1 / x - 10**9, 1e-12, 1.0, 50),
    ],
)
def test_to_the_last_digits_in_few_steps(function, exact, low, high, steps):
    calls = []
    found = float(roots(lambda x: calls.append(x) or function(x), low, high))
    with mpmath.workdps(50):
        root = mpmath.findroot(exact, found)
        assert abs(found - root) <= 4 * EPS * root
    assert len(calls) <= steps
    assert all(low <= x <= high for x in calls)


def test_a_flat_root_and_a_jump_are_found_by_halving():
    flat, jump = roots(lambda x: np.array([(x[0] - 0.3) ** 9, np.where(x[1] < 0.7, -1.0, 1.0)]), [0, 0], [1, 1])
    assert abs(flat - 0.3) <= 4 * EPS
    assert abs(jump - 0.7) <= 4 * EPS


def test_a_root_at_an_end_and_no_function_at_all():
    assert roots(lambda x: x - 1, [0, 1], [1, 2]).tolist() == [1, 1]
    assert roots(lambda x: x, [], []).shape == (0,)

"""The bounds hold for arms and flat faces as they do for translating followers."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from over_all import over_all, over_seeds
from random_tasks import flips, random_arm_task, random_flat_task, random_task
from test_bounds import outside, stations_outside

from graphcam.errors import DesignError
from graphcam.solving.solution import Solution
from graphcam.solving.solve import solve

TASKS = 16
FOLLOWERS = {"arm": random_arm_task, "flat": random_flat_task}
OWN = {"arm": {"minimum_distance"}, "flat": {"face_left", "face_right"}}
"""The quantities that other followers do not have."""
each_follower = pytest.mark.parametrize("follower", FOLLOWERS)


@cache
def solved(follower: str) -> list[Solution]:
    """The solutions of as many tasks; one that cannot be, of an arm with a given distance, is passed over."""
    found: list[Solution] = []
    for seed in range(2 * TASKS):
        try:
            found.append(solve(FOLLOWERS[follower](seed)))
        except DesignError as why:
            assert why.quantity in {"minimum prime radius", "roller radius"}, why  # noqa: PT017
        if len(found) == TASKS:
            return found
    raise AssertionError("too few of the tasks can be solved")


@each_follower
def test_every_quantity_of_a_perfect_pencil_lies_within_its_bound(follower):
    for solution in solved(follower):
        missed = outside(solution.comparison)
        assert not missed, (solution.task, missed)


@each_follower
def test_what_is_compared_is_finite_and_said_within_millimetres(follower):
    """A bound of metres would hold, and say nothing."""
    tolerances: dict[str, list[float]] = {}
    for solution in solved(follower):
        for name, quantity in solution.comparison.quantities.items():
            if np.isfinite(quantity.drawn) and np.isfinite(quantity.exact):
                tolerances.setdefault(name, []).append(quantity.tolerance_paper)
    assert set(tolerances) >= OWN[follower] | {"max_v", "max_a", "minimum_prime_radius"}
    for name, values in tolerances.items():
        assert np.isfinite(values).all(), name
        assert np.median(values) < 5.0, name


ANGLES = ("max_pressure_angle_rise_deg", "max_pressure_angle_return_deg")
SHARP = ("min_pitch_curvature_radius", "roller_radius")


def test_no_angle_is_compared_with_the_other_side_and_no_bound_of_a_radius_loses_it():
    """Nor is a rest's exact radius bounded by what the moving phases, which hardly bend, are off."""
    for solution in solved("arm"):
        quantities = solution.comparison.quantities
        assert not any(flips(quantities[name]) for name in ANGLES), solution.task
        for q in (quantities[name] for name in SHARP):
            assert q.tolerance_paper * q.per_mm <= 1.5 * abs(q.exact) + 1e-6, (q.name, solution.task)


@pytest.mark.slow
@over_seeds(12)
@over_all("random", [random_task, random_arm_task])
def test_no_random_task_flips(random, seed):
    try:
        quantities = solve(random(60 + seed)).comparison.quantities
    except DesignError as why:
        assert why.quantity in {"minimum prime radius", "roller radius"}, why  # noqa: PT017
        return
    assert not any(flips(quantities[name]) for name in ANGLES)
    assert all(q.tolerance_paper * q.per_mm <= 2 * abs(q.exact) + 1e-6 for q in map(quantities.get, SHARP))


@each_follower
def test_every_station_of_a_perfect_pencil_lies_within_its_bound(follower):
    for solution in solved(follower)[:20]:
        assert set(stations_outside(solution.comparison).values()) == {0.0}, solution.task

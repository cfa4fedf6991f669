"""No estimated bound is exceeded by a hand without error, whatever the task; what does not settle says so.

``python tests/random_cases.py tests/comparison/test_estimated_bounds.py --cases 1000 --seed 5000`` tries other tasks.
"""

from __future__ import annotations

import numpy as np
import pytest
from over_all import over_seeds
from random_tasks import random_arm_task, random_coursework, random_flat_task, random_task
from test_bounds import outside, told_against_exact

import graphcam as gc
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import LimitsTable, OscillatingTable, Task

KINDS = (random_coursework, random_coursework, random_task, random_arm_task, random_flat_task)
IMPOSSIBLE = {"minimum prime radius", "roller radius", "centre distance"}
"""What a task at random may ask that no cam gives."""


@pytest.mark.slow
@over_seeds(100)
def test_no_bound_is_exceeded(seed):
    try:
        comparison = gc.solve(KINDS[seed % len(KINDS)](seed)).comparison
    except gc.DesignError as why:
        assert why.quantity in IMPOSSIBLE, why  # noqa: PT017
        return
    assert outside(comparison) == set()


def the_arm_whose_centre_jumps() -> Task:
    """The distance of its cam centre hardly moves from 12 to 60 parts, and then jumps."""
    phases = (RiseTable(51.5, 22.3, "4-5-6-7"), DwellTable(80.4), ReturnTable(103.8, 22.3, "2-3"), DwellTable(124.3))
    limits = LimitsTable(pressure_angle_rise=45.0, pressure_angle_return=55.0)
    return Task(rotation="cw", motion=MotionTable(phases), follower=OscillatingTable(98.0), limits=limits)


def test_a_place_may_move_as_far_along_one_of_its_coordinates_as_along_another():
    solution = gc.solve(the_arm_whose_centre_jumps())
    quantities = solution.comparison.quantities
    distance, radius = quantities["minimum_distance"], quantities["minimum_prime_radius"]
    assert abs(distance.error_paper) < distance.tolerance_paper
    assert distance.tolerance_paper == radius.tolerance_paper
    assert not distance.settled
    assert radius.settled
    note = told_against_exact(solution)
    assert "do not settle" in note
    assert "centre distance" in note.partition("rough estimates:")[2].partition(".")[0]


class Readings:
    """Drawings with more and more parts in which one value is read."""

    pencil = gc.Pencil()
    spans = (slice(None),)

    def __init__(self, values, refine=1):
        self.values, self.refine = values, refine

    def redrawn(self, refine=1, pencil=None):
        return Readings(self.values, refine)

    def __getitem__(self, name):
        value = np.asarray(self.values(self.refine))
        return type("Drawn", (), {"value": lambda self, reading: value})()


@pytest.mark.parametrize("order", [1, 1.5, 2, 3, 4])
def test_an_error_of_any_order_settles(order):
    settled = gc_bounds(lambda n: 5 + 0.3 / n**order).settled("c", "r")
    assert settled


@pytest.mark.parametrize(
    "values", [{1: 79.5713, 2: 79.5708, 3: 79.5726, 5: 79.5734}, {1: 0.333, 2: 0.362, 3: 0.359, 5: 0.26}]
)
def test_what_wanders_does_not_settle(values):
    assert not gc_bounds(values.__getitem__).settled("c", "r")


def gc_bounds(values):
    from graphcam.comparison.bounds import Bounds

    return Bounds(Readings(values))

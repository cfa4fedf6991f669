"""Sizes of an arm that are adopted together: cams that broke their limits when they were rounded one by one."""

from __future__ import annotations

import math
from typing import Any

import pytest
from boards import arm_board, arm_motion_of, limits
from over_all import over_all

import graphcam as gc
from graphcam.constructions.chain import Chain
from graphcam.given.follower import Limits, Rotation
from graphcam.given.motion import Motion

AS_DRAWN = math.radians(0.1)
"""With 24 parts the drawn region and the exact one differ by less."""


def slow_rise(lift: float, *degrees: float, law: str) -> Motion:
    """Up, rest, down and rest."""
    up, rest, down = degrees
    return arm_motion_of((lift, up, law), (0, rest), (-lift, down, law))


# All were found among 300 random tasks of seed 1 each: motion, arm [mm], rotation, permitted angles.
Task = tuple[Motion, float, Rotation, Limits]
OPEN: list[tuple[Task, tuple[float, float], float]] = [
    # With them what rounding one by one adopts: the distance, then the radius above the least one there; and what the
    # sizes are multiples of that go with one another.
    ((slow_rise(44, 113, 44, 90, law="cycloidal"), 72, "ccw", limits(25, 31)), (146.0, 186.0), 1.0),
    ((slow_rise(35, 96, 23, 101, law="cosine"), 63, "cw", limits(20, 42)), (119.0, 147.0), 0.1),
]
GIVEN: list[tuple[Task, float]] = [
    ((slow_rise(35, 58, 24, 58, law="2-3"), 47, "ccw", limits(48, 21)), 126.4),
    ((slow_rise(36, 97, 51, 104, law="cosine"), 44, "ccw", limits(49, 20)), 90.1),
    ((slow_rise(31, 132, 33, 59, law="cycloidal"), 158, "ccw", limits(29, 24)), 383.1),
    ((slow_rise(32, 69, 2, 123, law="3-4-5"), 192, "ccw", limits(44, 44)), 316.5),
]
FIXED: list[tuple[Task, float]] = [
    ((slow_rise(44, 113, 44, 90, law="cycloidal"), 72, "ccw", limits(25, 31)), 186.0),
    ((slow_rise(35, 58, 24, 58, law="2-3"), 47, "ccw", limits(48, 21)), 144.0),
]


def chain_of(task: Task, distance: float | None = None, **changes: Any) -> Chain:
    motion, arm, rotation, permitted = task
    choices = {"limits": permitted, "rotation": rotation, "divisions": 24, "roller_radius": 0.0} | changes
    return Chain(arm_board(motion, distance, arm, **choices))


def over(task: Task, prime_radius: float, distance: float) -> float:
    """By how much the exact pressure angle exceeds its limits [rad]; negative where it keeps them."""
    motion, arm, rotation, permitted = task
    extremes = gc.Cam(motion, gc.Oscillating(arm, distance), prime_radius, rotation).extremes()
    beyond = [abs(extremes.pressure_angle_rise[0]) - permitted.rise]
    if permitted.return_ is not None:
        beyond.append(abs(extremes.pressure_angle_return[0]) - permitted.return_)
    return max(beyond)


@over_all(("task", "one_by_one", "step"), OPEN)
def test_radius_and_distance_left_open_are_round_and_keep_the_limits_together(task, one_by_one, step):
    chain = chain_of(task)
    assert chain.rounding == 1.0
    assert chain.rounded == (step == 1.0)
    for size in (chain.prime_radius, chain.place):
        assert size / step == pytest.approx(round(size / step), rel=1e-12)
    assert over(task, chain.prime_radius, chain.place) < AS_DRAWN
    assert over(task, *one_by_one) > 5 * AS_DRAWN
    least, found = (float(chain["minimum_radius"].value(name)) for name in ("prime_radius", "distance"))
    assert least < chain.prime_radius < least + 5
    assert abs(chain.place - found) < 5


@over_all(("task", "radius"), GIVEN)
def test_for_a_given_radius_the_nearest_distance_is_taken_that_the_region_permits(task, radius):
    chain = chain_of(task, prime_radius=radius)
    found = float(chain["minimum_radius"].value("distance"))
    assert chain.prime_radius == radius
    assert over(task, radius, chain.place) < AS_DRAWN
    assert over(task, radius, round(found)) > 5 * AS_DRAWN  # what the least radius proposes is not permitted here
    # Nearest: one step back towards the proposal the drawn region ends.
    step = chain.rounding if chain.rounded else chain.rounding / 10
    nearer = chain.place - math.copysign(step, chain.place - found)
    assert over(task, radius, nearer) > -AS_DRAWN


@over_all(("task", "distance"), FIXED)
def test_at_a_distance_whose_arc_holds_no_round_radius_a_less_round_one_is_adopted(task, distance):
    chain = chain_of(task, distance)
    least = float(chain["minimum_radius"].value("prime_radius"))
    assert not chain.rounded
    assert least <= chain.prime_radius < least + chain.rounding / 10
    assert over(task, chain.prime_radius, distance) < AS_DRAWN
    assert over(task, math.ceil(least), distance) > AS_DRAWN


@over_all("task", [task for task, *_ in (*OPEN, *GIVEN)])
@over_all("larger", [1.02, 1.5])
def test_at_the_ends_of_the_permitted_distances_the_drawn_region_ends(task, larger):
    """Half a millimetre inside every stretch the exact angles are kept, half a millimetre outside they are not."""
    chain = chain_of(task, divisions=96)
    radius = larger * float(chain["minimum_radius"].value("prime_radius"))
    stretches = chain.board.follower.places(chain["minimum_radius"], radius)
    assert len(stretches)
    for low, high in stretches:
        assert over(task, radius, (low + high) / 2) < 0
        for end, outwards in ((low, -0.5), (high, 0.5)):
            if abs(end + outwards - task[1]) < radius:
                assert over(task, radius, end + outwards) > 0


def test_below_the_least_radius_no_distance_is_permitted():
    chain = chain_of(OPEN[0][0])
    least = float(chain["minimum_radius"].value("prime_radius"))
    assert chain.board.follower.places(chain["minimum_radius"], 0.99 * least).shape == (0, 2)

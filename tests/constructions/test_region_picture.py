"""The shaded region as it is drawn: its own lines bound it, and every cam centre that is taken lies in it."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from over_all import over_all
from random_tasks import random_arm_task, random_task

import graphcam as gc
from graphcam.constructions.region import PICTURE_MARGIN
from graphcam.drafting.ink import Construction
from graphcam.drafting.marks import Dots, Line, Region, Role
from graphcam.errors import DesignError
from graphcam.tasks.task import Task

ON_AN_EDGE = 1e-6
"""mm of paper."""


def near_the_prime_radius(seed: int, share: float) -> Task:
    """A task whose offset is nearly the radius that the cam needs, to one side or the other."""
    task = random_task(seed)
    free = replace(task, follower=replace(task.follower, offset=None), cam=replace(task.cam, prime_radius=None))
    least = float(gc.solve(free).chain["minimum_radius"].value("prime_radius"))
    return replace(free, follower=replace(free.follower, offset=round(share * least, 1)))


def far_away(seed: int) -> Task:
    """A task that gives a prime radius far greater than the least one."""
    task = random_task(seed)
    return replace(task, cam=replace(task.cam, prime_radius=200.0))


TASKS = {
    **{f"random {seed}": random_task(seed) for seed in range(8)},
    **{f"offset near r₀ {seed}": near_the_prime_radius(seed, (-1.2, 0.95, -0.8, 1.5)[seed % 4]) for seed in range(8)},
    **{f"far away {seed}": far_away(seed) for seed in range(4)},
}
ARMS = {f"arm {seed}": random_arm_task(seed) for seed in range(12)}


@cache
def solved(name: str) -> gc.Solution | None:
    """None where no cam solves it."""
    try:
        solution = gc.solve((TASKS | ARMS)[name])
        _ = solution.chain.prime_radius
    except DesignError:
        return None
    return solution


def arm_on_paper(solution: gc.Solution) -> float:
    """The adopted prime radius on the drawing of the arm positions [mm]."""
    return solution.chain.prime_radius / solution.drawn["minimum_radius"].givens.mu_l.per_mm


def hatched(region: Construction) -> np.ndarray:
    return next(mark.boundary for step in region.steps() for mark in step.marks if isinstance(mark, Region))


def adopted_centre(solution: gc.Solution) -> complex:
    """Where the compass finds it in the same picture."""
    steps = solution.drawn["pressure_angle"].steps()
    (step,) = (step for step in steps if str(step.title) in {"The cam centre", "The cam centre at the adopted radius"})
    return complex(next(m for m in step.marks if isinstance(m, Dots) and m.role is Role.RESULT).points[0])


def inside(polygon: np.ndarray, place: complex) -> float:
    """How far inside a convex polygon, whose corners go round anticlockwise, a place lies."""
    corners = polygon[np.abs(np.roll(polygon, -1) - polygon) > ON_AN_EDGE]
    sides = np.roll(corners, -1) - corners
    if np.sum((corners.conjugate() * np.roll(corners, -1)).imag) < 0:
        sides = -sides
    return float(np.min(((place - corners) * (sides / np.abs(sides)).conjugate()).imag))


def keeps_the_limits(solution: gc.Solution) -> bool:
    """Whether nothing is said of a limit that is broken, or of a given radius that is too small."""
    return not any(re.search("pressure angle|minimum permitted", str(warning)) for warning in solution.warnings)


@over_all("name", [*TASKS, *ARMS])
def test_the_cam_centre_found_lies_on_the_edge_of_the_hatching_and_the_adopted_one_in_it(name):
    solution = solved(name)
    if solution is None or not np.isfinite(solution.drawn["minimum_radius"].points["centre"]).all():
        return
    region = solution.drawn["minimum_radius"]
    polygon = hatched(region)
    found, adopted = complex(np.ravel(region.first("centre"))[0]), adopted_centre(solution)
    assert abs(inside(polygon, found)) < ON_AN_EDGE
    assert polygon.imag.min() <= min(found.imag, adopted.imag) - PICTURE_MARGIN + ON_AN_EDGE
    assert not keeps_the_limits(solution) or inside(polygon, adopted) > -ON_AN_EDGE


def greatest_angles(solution: gc.Solution, r0: float, e: float) -> tuple[float, float, float]:
    """The exact cam's angle on the rise, on the return and at zero lift [rad], each to the side that is limited."""
    motion, sigma = solution.chain.board.motion, 1 if solution.task.rotation == "ccw" else -1
    phi = np.linspace(0, 2 * np.pi, 4001)
    s, v, *_ = motion(phi)
    alpha = np.arctan2(v - sigma * e, np.sqrt((r0 - e) * (r0 + e)) + s)
    return float(alpha[v > 0].max()), float(-alpha[v < 0].min()), float(np.arctan2(sigma * e, np.sqrt(r0**2 - e**2)))


@over_all("name", TASKS)
def test_from_every_corner_of_the_hatching_the_exact_cam_keeps_the_limits(name):
    """But for the error of the drawing: a corner on the drawn tangent may miss by what the drawn curves do."""
    solution = solved(name)
    if solution is None:
        return
    region, limits = solution.drawn["minimum_radius"], solution.chain.board.limits
    mu, drawn = float(region.readings["prime_radius"].per_mm), solution.drawn["integration"]
    motion, stations = solution.chain.board.motion, solution.chain.board.stations
    s, v, *_ = motion(stations.phi)
    off = max(np.abs(drawn.value("s") - s).max(), np.abs(drawn.value("v")[:-1] - v[:-1]).max(), 0.02 * np.abs(v).max())
    for corner in hatched(region).tolist():
        r0, e = abs(corner) * mu, -corner.real * mu
        if r0 - abs(e) < mu or -corner.imag < 3 * off / mu:  # level with the start of the lift any error is an angle
            continue
        rise, back, rest = greatest_angles(solution, r0, e)
        slack = 4 * off / (-corner.imag * mu)
        assert rise <= limits.rise + slack
        assert limits.return_ is None or back <= limits.return_ + slack
        assert not limits.rest or rest <= limits.rise + 1e-9


@over_all("name", TASKS)
def test_the_edges_of_the_hatching_lie_on_the_drawn_lines_or_cut_it_off_below(name):
    solution = solved(name)
    if solution is None:
        return
    steps, polygon = solution.drawn["minimum_radius"].steps(), hatched(solution.drawn["minimum_radius"])
    lines = [mark.points for mark in steps[2].marks if isinstance(mark, Line) and mark.role is Role.LIMIT]
    below = polygon.imag.min()
    marked = [complex(np.ravel(m.points)[0]) for step in steps for m in step.marks if isinstance(m, Dots)]
    for start, end in zip(polygon, np.roll(polygon, -1), strict=True):
        if abs(end - start) < ON_AN_EDGE or start.imag == end.imag in {below, 0.0}:
            continue
        ways = [(line[1] - line[0], np.array([start, end]) - line[0]) for line in lines]
        on = [np.abs((place * way.conjugate()).imag / abs(way)).max() < ON_AN_EDGE for way, place in ways]
        if not any(on):
            # Only where what bounds it leans at more than 45 degrees, or nothing does, the picture's side cuts it off.
            assert start.real == end.real
            assert abs(start.real) >= max(abs(place.real) for place in marked) + PICTURE_MARGIN


def test_most_of_the_tasks_are_solved_within_the_limits():
    """So the tests above look at something."""
    for names in (TASKS, ARMS):
        keep = [name for name in names if (solution := solved(name)) is not None and keeps_the_limits(solution)]
        assert len(keep) > 0.7 * len(names), keep


def is_small(name: str) -> bool:
    solution = solved(name)
    return solution is not None and arm_on_paper(solution) < 30


@over_all("name", ARMS)
def test_a_cam_centre_near_the_end_of_the_arm_is_shown_enlarged_with_the_region_the_lines_and_both_centres(name):
    solution = solved(name)
    if solution is None or not is_small(name):
        return
    region, measured = solution.drawn["minimum_radius"], solution.drawn["pressure_angle"]
    found, adopted = (
        next(step for step in each.steps() if step.view.name == "cam centre") for each in (region, measured)
    )
    b, a = (mark.points[0] for mark in found.marks if isinstance(mark, Dots))
    centre, start = complex(np.ravel(region.first("centre"))[0]), region.acts["start"].place
    times = abs(a) / abs(centre - start)
    assert b == 0
    assert times > 1
    assert a == pytest.approx((centre - start) * times)
    (polygon,) = (mark.boundary for mark in found.marks if isinstance(mark, Region))
    assert abs(inside(polygon, a)) < ON_AN_EDGE * times
    (own,) = (complex(mark.points[0]) for mark in adopted.marks if isinstance(mark, Dots))
    assert own == pytest.approx((adopted_centre(solution) - start) * times)
    assert not keeps_the_limits(solution) or inside(polygon, own) > -ON_AN_EDGE * times
    for line in (mark.points for mark in found.marks if isinstance(mark, Line)):
        share = (a - line[0]) / (line[1] - line[0])
        assert abs(share.imag) < 1e-6
        assert 0 < share.real < 1


def test_only_a_small_prime_radius_is_shown_enlarged():
    assert sum(map(is_small, ARMS)) >= 3
    for name in ARMS:
        if not is_small(name) and (solution := solved(name)) is not None:
            assert all(step.view.name != "cam centre" for each in solution.drawn.values() for step in each.steps())

"""A bore that the task gives: a prime radius that is left open leaves room for the shaft, its keyway and a wall."""

from dataclasses import replace

import numpy as np
import pytest
from over_all import over_all

import graphcam as gc
from graphcam.given.limits_and_fits import shaft_radius
from graphcam.report.note import note
from graphcam.report.sheet_data import data
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.task import CamTable, Task, TranslatingTable
from graphcam.workshop.part_contents import PartContents


def bored(name: str, bore: float, **changes: object) -> Task:
    """A built-in task with a bore, and its prime radius left open."""
    task = gc.builtin_task(name)
    part = PartTable(bore=bore, **{key: value for key, value in changes.items() if key == "keyway"})
    follower = {key: value for key, value in changes.items() if key != "keyway"}
    return replace(task, cam=CamTable(), part=part, follower=replace(task.follower, **follower))


@over_all(
    "task",
    [
        bored("coursework", 50.0),
        bored("coursework", 70.0, keyway="none", offset=None),
        bored("coursework", 60.0, roller_radius=12.0),
        bored("coursework", 90.0, roller_radius=0.0, offset=None),
        bored("arm", 60.0, distance=None),
        bored("flat", 110.0),
        bored("swinging-face", 140.0),
    ],
)
def test_an_open_radius_leaves_room_for_the_shaft_and_no_smaller_round_one_does(task):
    solution = gc.solve(task)
    free = gc.solve(replace(task, part=None))
    needed = shaft_radius(task.part.bore, task.part.keyway != "none")
    base = solution.cam.prime_radius - solution.cam.roller_radius
    assert free.cam.prime_radius - free.cam.roller_radius < needed <= base
    # The roller may grow with the radius by its rule; where it is given one step less would not do.
    if task.follower.roller_radius is not None:
        assert base - solution.chain.rounding < needed
    assert np.hypot(*solution.cam.trimmed_profile(720).T).min() >= needed - 1e-9
    # The workshop can make it.
    assert PartContents(solution).part.bore == task.part.bore
    assert "the shaft, its keyway and a wall take" in note(solution)
    assert ("bore", f"{task.part.bore:g} mm", "given") in [tuple(map(str, row)) for row in data(solution).rows]


def test_a_small_bore_changes_nothing_and_a_given_radius_stays():
    task = gc.builtin_task("coursework")
    small = gc.solve(replace(task, part=PartTable(bore=16)))
    assert small.cam.prime_radius == gc.solve(task).cam.prime_radius
    given = gc.solve(replace(task, cam=CamTable(45.0), part=PartTable(bore=80)))
    assert (given.cam.prime_radius, given.chain.trials) == (45.0, ())


def test_what_no_radius_at_a_centre_distance_leaves_is_refused():
    with pytest.raises(gc.DesignError, match=r"part\.bore is .* mm with keyway and wall, but must be so small"):
        gc.solve(bored("arm", 400.0, distance=150.0))


def test_a_radius_that_leaves_just_what_the_shaft_takes_suffices_but_for_rounding():
    """25.5 - 12.8 is less than 12.7 by rounding alone: no radius was ever found."""
    phases = DwellTable(23), RiseTable(212, 11, "4-5-6-7"), DwellTable(58), ReturnTable(67, 11, "rectangular")
    task = Task("cw", MotionTable(phases), TranslatingTable(None, 12.8), part=PartTable(bore=16))
    assert shaft_radius(16, keyed=True) > 25.5 - 12.8
    assert gc.solve(task).cam.prime_radius == 25.5

"""What a perfect pencil reads in random tasks is what it read in them before.

A change that is meant is made as :mod:`golden_random` says, and the difference is read before it is committed.
"""

from __future__ import annotations

import copy
import json
import math
from dataclasses import replace

import golden
import numpy as np
import pytest
from golden_random import FILE, TASKS, differences, read
from over_all import over_all

BEFORE = json.loads(FILE.read_text(encoding="utf-8"))
REFUSED = {"arm 60", "flat 38"}
each_kind = pytest.mark.parametrize("name", ["translating 0", "arm 0", "flat 0", "arcs 0", "spring 20"])
DWELLS = {"working_profile.low_dwells", "working_profile.angles of the radii"}
"""What is read only where a follower rests at the bottom."""


def damaged(readings, name, part, value, at=0):
    """The readings of a task with another value at a place of one of them."""
    found = copy.deepcopy(readings)
    found[name][part][at] = value
    return found


@over_all("name", TASKS)
def test_every_reading_is_the_one_that_was_read_before(name):
    assert differences(BEFORE[name], read(TASKS[name])) == []


def test_the_file_holds_every_task_and_two_that_no_cam_solves():
    assert list(BEFORE) == list(TASKS)
    assert {name for name, found in BEFORE.items() if isinstance(found, str)} == REFUSED


@each_kind
def test_the_tasks_of_a_kind_give_every_reading_that_the_built_in_one_gives(name):
    kind = name.split()[0]
    like = {"translating": "coursework", "spring": "coursework"}.get(kind, kind)
    built_in = json.loads(golden.FILE.read_text(encoding="utf-8"))[like]["constructions"]
    wanted = {f"{one}.{key}" for one, drawn in built_in.items() for key in drawn["readings"]}
    for found in (BEFORE[task] for task in TASKS if task.startswith(kind) and task not in REFUSED):
        assert {key for key in found if not key.startswith("force_plan.")} | DWELLS == wanted | DWELLS


def test_the_force_plan_of_every_spring_is_read():
    read_off = [found["force_plan.normal"][0] for name, found in BEFORE.items() if name.startswith("spring")]
    assert len(read_off) == 6
    assert np.all(np.array(read_off) > 0)


@each_kind
def test_any_number_that_moves_by_more_than_rounding_is_found(name):
    """Rounding is 1e-12 of the greatest number of the reading or of a millimetre, and of a scale itself."""
    for key, reading in BEFORE[name].items():
        before = {key: reading}
        for part, least in ((0, 1.0), (1, 0.0)):
            hair = 1e-12 * max(least, *map(abs, reading[part]))
            for at, value in enumerate(reading[part]):
                for hairs, count in ((2, 1), (-2, 1), (0.5, 0)):
                    now = damaged(before, key, part, value + hairs * hair, at)
                    assert len(differences(before, now)) == count, (key, part, at)


def test_a_reading_that_cannot_be_read_any_more_or_has_another_unit_or_is_gone_is_found():
    before, key = BEFORE["arm 0"], "pressure_angle.alpha"
    for wrong in (
        damaged(before, key, 0, math.nan),
        damaged(before, key, 0, math.inf),
        {**before, key: [*before[key][:2], "°"]},
        {**before, key: [before[key][0][:-1], *before[key][1:]]},
        {name: reading for name, reading in before.items() if name != key},
    ):
        (found,) = differences(before, wrong)
        assert found.startswith(key)


def test_a_number_appears_where_nothing_could_be_read_and_is_found():
    before = {"curvature.rho": [[math.nan, math.inf], [1.0], "mm"]}
    assert differences(before, copy.deepcopy(before)) == []
    assert len(differences(before, damaged(before, "curvature.rho", 0, 5.0, 0))) == 1
    assert len(differences(before, damaged(before, "curvature.rho", 0, 5.0, 1))) == 1


def test_the_order_of_readings_and_new_ones_make_no_difference():
    before = BEFORE["flat 0"]
    assert differences(before, {**dict(reversed(before.items())), "inversion.new": [[1.0], [1.0], "mm"]}) == []


def test_another_reason_and_another_end_are_found():
    assert len(differences(BEFORE["arm 60"], BEFORE["flat 38"])) == 1
    assert len(differences(BEFORE["arm 60"], BEFORE["arm 0"])) == 1
    assert len(differences(BEFORE["arm 0"], BEFORE["arm 60"])) == 1


def test_a_task_that_is_a_hair_different_is_found_where_it_is_read():
    task = TASKS["translating 0"]
    limits = replace(task.limits, pressure_angle_rise=task.limits.pressure_angle_rise * (1 + 1e-9))
    found = differences(BEFORE["translating 0"], read(replace(task, limits=limits)))
    assert found
    assert all(line.startswith("minimum_radius.") for line in found), found

"""What the built-in tasks read and draw is what they read and drew before: readings, marks, captions, sheets.

A change that is meant is made with ``python tests/golden.py``, and the difference is read before it is committed.
"""

from __future__ import annotations

import copy
import json
from dataclasses import dataclass, field

import numpy as np
import pytest
from golden import FILE, TASKS, differences, solved, summary

from graphcam.drafting import marks

READINGS, MARKS = 1e-12, 1e-9
"""Permitted differences, of a value or of 1.  The sums over marks gather the rounding of many points."""
BEFORE = json.loads(FILE.read_text(encoding="utf-8"))


@pytest.fixture(scope="module", params=sorted(TASKS))
def task(request):
    return request.param, json.loads(json.dumps(solved(request.param)))


def readings(found):
    return {name: [drawn["readings"], drawn["points"]] for name, drawn in found["constructions"].items()}


def values(found):
    """The quantities without their bounds, which come from redrawings with chords a fifth as long: three points so near
    to one another enlarge the rounding of their places to more than is permitted here, not to more than of a mark."""
    return [
        {key: kept for key, kept in found["quantities"][name].items() if not key.startswith("tolerance")}
        for name in sorted(found["quantities"])
    ]


def test_every_reading_is_the_one_that_was_read_before(task):
    name, now = task
    assert differences(readings(BEFORE[name]), readings(now), READINGS) == []
    assert differences(values(BEFORE[name]), values(now), READINGS) == []


def test_every_mark_and_every_sheet_is_the_one_that_was_drawn_before(task):
    name, now = task
    assert differences(BEFORE[name], now, MARKS) == []


def test_constructions_quantities_and_groups_of_the_sheet_come_in_the_order_in_which_they_came(task):
    def orders(found):
        return [list(found["constructions"]), list(found["quantities"]), *map(list, found["sheet"])]

    name, now = task
    assert orders(BEFORE[name]) == orders(now)


def test_what_a_mark_belongs_to_is_no_part_of_how_it_looks():
    @dataclass(frozen=True, eq=False)
    class Line(marks.Line):
        of: str = field(default="a ray", kw_only=True)

    points = np.array([0j, 1 + 2j])
    assert summary(Line(points, marks.Role.CURVE)) == summary(marks.Line(points, marks.Role.CURVE))
    assert summary(Line(points, marks.Role.CURVE)) != summary(Line(points + 1, marks.Role.CURVE))


def test_a_reading_that_moves_by_more_than_rounding_is_found():
    now = copy.deepcopy(BEFORE["arm"])
    paper = now["constructions"]["pressure_angle"]["readings"]["alpha"][0]
    paper[3] *= 1 + 1e-11
    assert len(differences(BEFORE["arm"], now, READINGS)) == 1


def test_a_mark_that_moves_or_bears_another_word_is_found():
    now = copy.deepcopy(BEFORE["flat"])
    step = now["constructions"]["inversion"]["steps"][1]
    step[0] += "."
    line = next(mark for mark in step[3] if mark[0] == "Line")
    line[1][2] += 1e-6
    found = differences(BEFORE["flat"], now, MARKS)
    assert len(found) == 2
    assert all("/inversion/steps/1/" in line for line in found)

"""Axes of the cam angle whose long dwells are broken: one map from angles to places that changes nothing that is read.

What moves is drawn to scale, and the second integration starts anew in every phase, so a dwell needs no room.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from over_all import over_all
from replay import followed, off

import graphcam as gc
from graphcam.constructions.axes import BROKEN_DWELL, break_strokes, broken_angles, broken_axis, degrees_below
from graphcam.constructions.chain import Chain
from graphcam.drafting.marks import Label, Line, Role
from graphcam.drafting.pencil import Pencil
from graphcam.given.motion import FULL_TURN
from graphcam.solving.task_board import board_of
from graphcam.tasks.task_file import builtin_task

ROUNDING = 1e-9


def coursework(*, whole: bool, **changes) -> Chain:
    """The built-in coursework at twice its usual scale, with broken dwells or on an axis twice as long."""
    task = builtin_task("coursework")
    board = board_of(replace(task, speed_rpm=120.0))
    half = board.mu_phi.per_mm / 2
    mu_phi = gc.Scale(half, "rad") if whole else broken_axis(board.motion, half)
    return Chain(replace(board, mu_phi=mu_phi, **changes), Pencil())


def test_moving_phases_keep_the_scale_and_dwells_take_what_is_said():
    axis, motion = coursework(whole=False).board.mu_phi, builtin_task("coursework").motion()
    ends = axis.paper(np.append(motion.starts, FULL_TURN))
    assert_allclose(np.diff(ends), [160.0, BROKEN_DWELL, 120.0, BROKEN_DWELL])
    phi = np.linspace(0.0, FULL_TURN, 1001)
    assert_allclose(axis.value(axis.paper(phi)), phi, atol=ROUNDING)
    assert axis.left_out == pytest.approx(FULL_TURN - axis.per_mm * ends[-1])


@over_all("jerk", [None, 12.0])
def test_a_broken_axis_changes_no_reading(jerk):
    whole, broken = (coursework(whole=each, jerk_pole=jerk) for each in (True, False))
    assert broken.names == whole.names
    for name in whole.names:
        for read, value in whole[name].readings.items():
            if (name, read) != ("acceleration", "base"):  # the length of the axis itself
                assert_allclose(broken[name].readings[read].value, value.value, rtol=1e-8, atol=1e-8, err_msg=read)


@over_all("name", ["acceleration", "integration", "angle_diagram", "curvature"])
def test_a_second_board_follows_the_acts_over_a_broken_axis_to_every_reading(name):
    drawn = coursework(whole=False)[name]
    readings, _ = followed(drawn)
    for read, value in drawn.readings.items():
        assert off(np.atleast_1d(value.paper), readings[read]) < 1e-6


def test_the_curve_and_the_graduation_are_broken_at_the_same_places():
    chain = coursework(whole=False)
    motion, axis = chain.board.motion, chain.board.mu_phi
    middles = axis.middles
    starts, ends = break_strokes(axis)
    assert_allclose((starts + ends).real / 2, np.repeat(middles, 2) + np.tile([-0.75, 0.75], 2))
    for step in chain["integration"].steps():
        # No bold line runs through a break, but for the axis itself.
        for mark in step.marks:
            if isinstance(mark, Line) and mark.role is Role.RESULT and np.ptp(mark.points.imag) < 1e-9:
                left, right = mark.points.real.min(), mark.points.real.max()
                assert not any(left < x < right for x in middles)
    _, _, *labels, scale = degrees_below(axis.places[-1], axis, -20.0)
    assert str(scale.text) == "μᵩ = 0.008727 rad/mm (0.5°/mm)"
    angles = [float(str(label.text)[:-1]) for label in labels]
    assert_allclose([label.at.real for label in labels], axis.paper(np.radians(angles)))
    assert axis.shows(np.radians(angles)).all()
    named = broken_angles(motion, axis, -20.0)
    assert [str(mark.text) for mark in named if isinstance(mark, Label)] == ["45°", "175°"]
    assert [mark.at.real for mark in named if isinstance(mark, Label)] == middles


def width(board) -> float:
    """Of the narrowest part [mm of paper]."""
    stations = board.stations
    return float(np.diff(board.mu_phi.paper(stations.phi))[stations.left].min())


@over_all(("paper", "least"), [("A1", 5.0), ("A2", 5.0), ("A3", 4.0), ("A4", 2.0)])
def test_parts_are_wide_enough_to_be_drawn(paper, least):
    """The rise of 21 degrees that was drawn on A3 with parts of 0.88 mm."""
    task = builtin_task("sizing")
    board = board_of(replace(task, drawing=task.drawing.on(paper)))
    assert width(board) >= least
    whole = board_of(replace(task, drawing=replace(task.drawing.on(paper), whole_turn=True)))
    assert width(whole) < least
    assert whole.mu_phi.paper(math.tau) == pytest.approx(math.tau / whole.mu_phi.per_mm)
    assert not whole.mu_phi.middles


def test_a_given_ordinate_that_suits_the_whole_turn_alone_keeps_it():
    task = builtin_task("sizing")
    drawn = board_of(replace(task, drawing=replace(task.drawing, ordinate=4.0)))
    assert drawn.mu_phi.middles
    given = board_of(replace(task, drawing=replace(task.drawing, ordinate=60.0, poles=(12.0, 12.0))))
    assert (given.mu_phi.middles, given.ordinate, given.poles) == ([], 60.0, (12.0, 12.0))


def test_the_solution_tells_where_a_broken_axis_has_its_angles():
    solution = gc.solve(builtin_task("sizing"))
    ends = solution.to_dict()["scales"]["phi"]["broken_axis"]
    axis = solution.chain.board.mu_phi
    assert [end["phi_deg"] for end in ends] == [0.0, 21.0, 81.0, 141.0, 360.0]
    assert_allclose([end["paper"] for end in ends], axis.paper(np.radians([end["phi_deg"] for end in ends])))
    assert "broken_axis" not in gc.solve(builtin_task("coursework")).to_dict()["scales"]["phi"]


def test_an_axis_whose_parts_are_wide_stays_whole():
    board = board_of(builtin_task("coursework"))
    assert (board.mu_phi.middles, width(board)) == ([], pytest.approx(5.0))

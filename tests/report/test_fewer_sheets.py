"""The line after ``graphcam solve`` on sizes of diagrams with which fewer sheets would do: what it says is so."""

from __future__ import annotations

from dataclasses import replace

import pytest

import graphcam as gc
from graphcam.report.documents import contents_of, drawing_of
from graphcam.report.fewer_sheets import (
    FEWER_PARTS_NOTE,
    FEWER_SHEETS_NOTE,
    LONGER_POLES_NOTE,
    ONE_SHEET_NOTE,
    fewer_sheets,
    larger_paper,
)
from graphcam.solving.diagram_sizes import narrowest_part
from graphcam.solving.task_board import board_of
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import DrawingTable, LimitsTable, Task, TranslatingTable
from graphcam.tasks.task_file import builtin_task

ROLLER = Task(
    rotation="ccw",
    speed_rpm=240,
    motion=MotionTable(
        (
            RiseTable(110, 36, "cosine"),
            DwellTable(25),
            ReturnTable(95, 36, "rectangular", ratio=2),
            DwellTable(130),
        )
    ),
    follower=TranslatingTable(roller_rule="min(0.7 rho, 0.4 r0)"),
    limits=LimitsTable(pressure_angle_rise=28),
    drawing=DrawingTable("A1", "gost", language="ru"),
)
FLAT = builtin_task("flat")
FLAT = replace(FLAT, drawing=FLAT.drawing.on("A3"))


def laid_out(task):
    contents = contents_of(gc.solve(task))
    return contents, [set(page.origins) for page in drawing_of(contents).pages]


def taken(task, hint):
    """The task with the sizes that the line suggests."""
    values = hint.values
    poles = values["first"], values["second"]
    return replace(task, drawing=replace(task.drawing, ordinate=values["ordinate"], poles=poles))


@pytest.mark.slow
def test_smaller_diagrams_that_save_a_sheet_are_told():
    contents, pages = laid_out(ROLLER)
    assert len(pages) == 2
    hint = fewer_sheets(contents, 2)
    assert hint is not None
    assert (hint.template, hint.values["after"]) == (FEWER_SHEETS_NOTE.template, 1)
    suggested = taken(ROLLER, hint)
    contents, pages = laid_out(suggested)
    assert len(pages) == 1
    # Who gives the sizes is not told of others.
    assert fewer_sheets(contents, 2) is None


def test_diagrams_that_belong_together_are_brought_onto_one_sheet():
    carried = {"acceleration", "velocity", "displacement", "combined"}
    contents, pages = laid_out(FLAT)
    assert sum(bool(page & carried) for page in pages) == 2
    hint = fewer_sheets(contents, len(pages))
    assert hint is not None
    assert hint.template == ONE_SHEET_NOTE.template
    _, smaller = laid_out(taken(FLAT, hint))
    assert len(smaller) == len(pages)
    assert any(carried <= page for page in smaller)


@pytest.mark.parametrize("name", ["coursework", "arm"])
def test_one_sheet_is_never_too_many(name):
    assert fewer_sheets(contents_of(gc.solve(gc.builtin_task(name))), 1) is None


def narrow(drawing: DrawingTable) -> Task:
    """A task with a return that is short and divided into many parts."""
    phases = RiseTable(150, 20, "3-4-5"), ReturnTable(24, 4, "3-4-5"), DwellTable(36), ReturnTable(150, 16, "3-4-5")
    return replace(ROLLER, motion=MotionTable(phases), drawing=drawing)


def test_fewer_parts_are_told_where_no_format_has_room_for_wide_ones():
    task = narrow(DrawingTable("A1", divisions=36))
    hint = next(larger_paper(gc.solve(task)))
    assert hint.template == FEWER_PARTS_NOTE.template
    board = board_of(replace(task, drawing=DrawingTable("A1", divisions=hint.values["divisions"])))
    assert narrowest_part(board.stations) / board.mu_phi.per_mm == pytest.approx(hint.values["wider"])
    assert hint.values["width"] < 4 <= hint.values["wider"]


def test_the_format_on_which_poles_are_long_enough_is_told():
    task = replace(ROLLER, drawing=DrawingTable("A4"))
    hint = list(larger_paper(gc.solve(task)))[-1]
    assert hint.template == LONGER_POLES_NOTE.template
    assert min(board_of(task).poles) == hint.values["pole"] < 30
    assert min(board_of(replace(task, drawing=DrawingTable(hint.values["larger"]))).poles) >= 30
    given = replace(task, drawing=DrawingTable("A4", poles=(15, 15)))
    assert all(each.template != LONGER_POLES_NOTE.template for each in larger_paper(gc.solve(given)))

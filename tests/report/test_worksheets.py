"""Worksheets agree with the finished sheet line for line, show what is given, and hold no answers."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from over_all import fast_first
from overlaps import overlaps
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.report.documents import contents_of, sheet_of
from graphcam.report.sheet_data import comparison
from graphcam.sheets.model import Drawing, Entity, Group, Text
from graphcam.sheets.sampling import pieces
from graphcam.sheets.view_panels import BLANK_FIELD
from graphcam.solving.solution import Solution
from graphcam.tasks.task import SpringTable
from graphcam.tasks.task_file import builtin_task


@cache
def solution(paper: str = "A3") -> Solution:
    task = builtin_task()
    return gc.solve(replace(task, drawing=replace(task.drawing, format=paper)))


@cache
def finished() -> Drawing:
    return sheet_of(solution())


def place(entity: Entity) -> tuple[object, ...]:
    starts, ends = pieces(entity)
    text = entity.text if isinstance(entity, Text) else ""
    return entity.role, text, tuple(np.round(starts, 6).tolist()), tuple(np.round(ends, 6).tolist())


def groups(drawing: Drawing) -> dict[tuple[int, str], Group]:
    return {(number, group.name): group for number, page in enumerate(drawing.pages) for group in page.groups}


def texts(drawing: Drawing) -> list[str]:
    return [e.text for g in groups(drawing).values() for e in g.entities if isinstance(e, Text)]


def test_a_worksheet_can_be_laid_over_the_finished_sheet() -> None:
    whole = groups(finished())
    for key, group in groups(sheet_of(solution(), 0)).items():
        # A blank stands in the place of a number.
        blank = [e for e in group.entities if isinstance(e, Text) and BLANK_FIELD in e.text]
        assert {place(e) for e in group.entities if e not in blank} <= {place(e) for e in whole[key].entities}
        assert {e.at for e in blank} <= {e.at for e in whole[key].entities if isinstance(e, Text)}


@pytest.mark.slow
def test_scales_are_left_blank_until_they_are_found() -> None:
    """Whoever reads mu_s off the sheet need not integrate."""
    scales = [text for text in texts(finished()) if text.startswith("μ") and "mm/mm" in text]
    assert len(scales) == 2  # of the displacement and of the least radius
    for upto, known in ((0, False), ("acceleration", False), ("integration", True), ("minimum_radius", True)):
        said = texts(sheet_of(solution(), upto))
        assert [text for text in said if text in scales] == scales * known
        assert f"μₛ = {BLANK_FIELD} mm/mm" in said or known
    assert any(text.startswith("μ_α = 2") for text in texts(sheet_of(solution(), 0))), (
        "the axis is laid off at a given scale"
    )


def test_the_diagrams_of_a_measured_motion_do_not_tell_the_scales_either() -> None:
    """They are drawn at the scales that the integrations find; that of the region is blank as a whole."""
    said = [text for text in texts(sheet_of(gc.solve(builtin_task("measured")), 0)) if text.startswith("μ")]
    assert [BLANK_FIELD in text for text in said if "°" not in text] == [True] * 6


def test_a_worksheet_shows_the_givens_and_no_answers() -> None:
    said, whole = texts(sheet_of(solution(), 0)), texts(finished())
    quantities = solution().comparison.quantities
    table = comparison(quantities)
    read = {str(row[1]).replace("-", "−") for row in table.rows if not str(row[0]).startswith("its offset")}
    assert len(read) > 5
    assert read <= set(whole)
    assert not read & set(said)
    assert {"H₁ = 40", "P₂", "12′", "360°", "φ₁ = 80°", "−10 mm", "maximum v, mm/rad"} <= set(said)
    names = {group.name.split(" ")[1] for _, group in groups(sheet_of(solution(), 0)).items() if "step" in group.name}
    assert {"scheme", "acceleration", "integration", "minimum_radius", "inversion"} <= names
    assert not names & {"pressure_angle", "curvature", "working_profile"}, "what is only found leaves no line"


VARIANTS = {
    "another limit": replace(builtin_task(), limits=replace(builtin_task().limits, pressure_angle_rise=22.0)),
    "the other way round": replace(builtin_task(), rotation="ccw"),
}


def shapes(task: gc.Task, drawn: Drawing) -> Counter[tuple[object, ...]]:
    """How often each line and text stands in the views, wherever on the page; without the sketch, which is given.

    The centre lines of the profile are as long as the cam needs.
    """
    views = {f"step-{number:02d}": step.view.name for number, _, step in contents_of(gc.solve(task)).steps}
    found = Counter[tuple[object, ...]]()
    for (_, name), group in groups(drawn).items():
        view = views.get(name.split(" ")[0], "title" if name == "titles" else "")
        for entity in group.entities if view not in ("", "scheme", "profile") else ():
            if isinstance(entity, Text):
                # The scale of the profile is chosen for the page.
                found[view, re.sub(r"^[\d.]+:[\d.]+$", "scale", entity.text)] += 1
                continue
            starts, ends = pieces(entity)
            found[view, entity.role, *(np.round(np.append(starts, ends) - starts[0], 6) + 0).tolist()] += 1
    return found


@pytest.mark.parametrize("variant", fast_first(VARIANTS))
def test_two_worksheets_that_differ_in_their_answers_show_the_same(variant: str) -> None:
    """Neither the place of the cam centre nor sign and range of the pressure angle, nor the station of the plan."""
    one, other = builtin_task(), VARIANTS[variant]
    blanks, wholes = ([shapes(task, sheet_of(gc.solve(task), upto)) for task in (one, other)] for upto in (0, None))
    assert blanks[0] == blanks[1]
    assert blanks[0].total() > 100
    assert wholes[0] != wholes[1]


@pytest.mark.parametrize("upto", [3, "1.1", "2.2", "integration"])
def test_a_half_done_sheet_is_the_finished_one_up_to_its_step(upto: int | str) -> None:
    whole, half = groups(finished()), groups(sheet_of(solution(), upto))
    last = {"integration": 12, "1.1": 1, "2.2": 3}.get(upto, upto)
    done = {key for key in whole if key[1].startswith("step") and int(key[1][5:7]) <= last}
    assert done <= set(half)
    assert all(len(half[key].entities) == len(whole[key].entities) for key in done)
    later = [len(half[key].entities) < len(whole[key].entities) for key in half if key[1][5:7] > f"{last:02d}"]
    assert any(later)


@pytest.mark.parametrize("upto", [-1, 99, "integral", "2.9", "2"])
def test_a_step_that_is_not_there_is_refused_with_those_that_are(upto: int | str) -> None:
    with pytest.raises(
        gc.DesignError, match=r"from 0 to \d+, or one of scheme, acceleration, integration, minimum_radius"
    ):
        sheet_of(solution(), upto)


@pytest.mark.parametrize(("choice", "known"), [("--upto=integral", "integration"), ("--dxf=cda", "cad")])
def test_a_wrong_choice_is_refused_where_only_json_is_asked_for(choice: str, known: str) -> None:
    result = CliRunner().invoke(app, ["solve", "--json", choice])
    assert result.exit_code == 2
    assert choice.split("=")[1] in result.stderr
    assert known in result.stderr
    assert result.stdout == ""


def test_every_construction_that_draws_has_its_sheets() -> None:
    drawing = sheet_of(solution(), per_construction=True)
    assert overlaps(drawing) == []
    lasts = [max(g.name for g in page.groups if g.key.startswith("step")).split(" ")[1] for page in drawing.pages]
    assert list(dict.fromkeys(lasts)) == list(solution().drawn)
    count = len(drawing.pages)
    assert [f"Sheet {k}" in texts(Drawing("", (page,))) for k, page in enumerate(drawing.pages, 1)] == [True] * count
    # By GOST 2.104 the first sheet alone says how many there are.
    assert [f"Sheets {count}" in texts(Drawing("", (page,))) for page in drawing.pages] == [True] + [False] * (
        count - 1
    )


def test_a_worksheet_and_a_half_done_sheet_exclude_each_other() -> None:
    result = CliRunner().invoke(app, ["solve", "--worksheet", "--upto", "3"])
    assert result.exit_code == 2


def test_a_springs_views_take_a_second_sheet_of_a1() -> None:
    task = replace(builtin_task(), spring=SpringTable(mass=0.2, stiffness=3.0))
    drawing = sheet_of(gc.solve(task))
    assert len(drawing.pages) == 2
    assert overlaps(drawing) == []

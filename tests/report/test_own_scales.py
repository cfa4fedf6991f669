"""The region of the minimum radius and the profile in the largest standard scales for which the sheets have room."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import graphcam as gc
from graphcam.drafting.scale import GOST_2_302
from graphcam.report.documents import contents_of, drawing_of
from graphcam.report.own_scales import INTEGRATED_VIEWS
from graphcam.report.sheet_contents import Contents, motion_contents
from graphcam.solving.solution import Solution
from graphcam.tasks.task_file import builtin_task


@cache
def solved() -> Solution:
    return gc.solve(builtin_task("measured"))


@cache
def contents() -> Contents:
    return contents_of(solved())


def of_sheets(contents: Contents) -> Solution:
    assert isinstance(contents.solution, Solution)
    return contents.solution


def test_the_region_takes_the_largest_standard_scale_that_needs_no_further_page() -> None:
    before, after = motion_contents(solved()).pages()[0], contents().pages()[0]
    own, mu_s = of_sheets(contents()).chain.board.paper.held["combined"], solved().scales["s"]["per_mm"]
    assert 1 / own in GOST_2_302
    assert mu_s / own > 2
    assert len(after.filled) == len(before.filled)
    larger = min(ratio for ratio in GOST_2_302 if ratio > 1 / own)
    assert before.have_room({"combined": mu_s / own})
    assert not before.have_room({"combined": mu_s * larger}, INTEGRATED_VIEWS)
    # It stands by itself, and its title tells its scale.
    (title,) = {str(step.view.title) for _, _, step in contents().steps if step.view.name == "combined"}
    assert title == f"Minimum radius, {1 / own:g}:1"


def test_what_is_read_is_the_same_in_any_scale() -> None:
    usual, larger = solved().drawn["minimum_radius"], of_sheets(contents()).drawn["minimum_radius"]
    times = usual.readings["s0"].per_mm / larger.readings["s0"].per_mm
    for name in ("prime_radius", "offset", "s0"):
        assert float(larger.value(name)) == pytest.approx(float(usual.value(name)), rel=1e-9)
        assert float(larger.first(name)) == pytest.approx(times * float(usual.first(name)), rel=1e-9)
    assert np.allclose(larger.points["ends"], times * usual.points["ends"])
    assert np.allclose(
        of_sheets(contents()).drawn["pressure_angle"].value("alpha"), solved().drawn["pressure_angle"].value("alpha")
    )
    assert of_sheets(contents()).chain.sizes == solved().chain.sizes


def test_the_steps_tell_by_what_displacement_and_velocity_are_multiplied() -> None:
    chain = of_sheets(contents()).chain
    step, own = chain["minimum_radius"].steps()[0], chain.board.paper.held["combined"]
    factors = [chain["integration"].readings[name].per_mm / own for name in "sv"]
    said = str(step.parts[1].caption)
    assert f"μₛ/{own:g} = {factors[0]:.5g}" in said
    assert f"μᵥ/{own:g} = {factors[1]:.5g}" in said
    s, v = (chain["integration"].first(name)[1] * factor for name, factor in zip("sv", factors, strict=True))
    assert chain["minimum_radius"].points["ends"][1] == pytest.approx(complex(-v, s))


def test_a_profile_is_larger_where_its_page_has_room_and_never_where_the_task_gives_its_scale() -> None:
    task = gc.load_task(Path(__file__).parents[1] / "sheets" / "coursework" / "k_23_undercut.toml")
    for given, chosen in ((None, 0.5), ("1:1", 1.0)):
        solution = gc.solve(replace(task, drawing=replace(task.drawing, profile_scale=given)))
        assert solution.chain.profile_scale.per_mm == 1.0
        assert of_sheets(contents_of(solution)).chain.profile_scale.per_mm == chosen


@pytest.mark.parametrize("name", ["coursework", "flat", "arm"])
def test_where_there_is_no_room_all_stays_as_it_was(name: str) -> None:
    solution = gc.solve(builtin_task(name))
    assert contents_of(solution).solution is solution


def test_nothing_is_sought_again_on_a_solution_that_has_its_scales() -> None:
    again = contents_of(of_sheets(contents()))
    assert again.solution is contents().solution
    assert len(drawing_of(again).pages) == len(drawing_of(contents()).pages)

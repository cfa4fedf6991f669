"""The velocity plan names its station and its scales, and one value is the same in drawing, caption, table and note."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import pytest
from golden_random import TASKS as RANDOM
from over_all import over_all

import graphcam as gc
from graphcam.constructions.axes import station_names
from graphcam.constructions.pressure_angle import shown_station
from graphcam.drafting.ink import Step
from graphcam.drafting.marks import Arrow, Dimension, Label
from graphcam.report.documents import contents_of

COURSEWORK, ARM = gc.builtin_task(), replace(gc.builtin_task("arm"), speed_rpm=150.0)
AT_A_SPEED = over_all("task", [COURSEWORK, ARM])
SPEED = r"(v₂?₁?) = ([\d.]+) m/s"


def plan_of(solution: gc.Solution) -> Step:
    (step,) = (s for s in solution.drawn["pressure_angle"].steps() if str(s.title).startswith("Velocity plan"))
    return step


@AT_A_SPEED
def test_the_sides_of_the_plan_bear_the_speeds_of_their_lengths_and_close_as_vectors(task):
    solution = gc.solve(task)
    step = plan_of(solution)
    station, mu = re.search(r"at station (\S+), .*, μᵥ = ([\d.]+) \(m/s\)/mm$", str(step.view.title)).groups()
    measured = solution.drawn["pressure_angle"]
    k = shown_station(measured)
    assert station == station_names(solution.chain.board.stations)[k]
    arrows = [mark for mark in step.marks if isinstance(mark, Arrow)]
    lengths = dict(zip(("v₁", "v₂", "v₂₁"), (abs(arrow.end - arrow.start) for arrow in arrows), strict=True))
    labels = [str(mark.text) for mark in step.marks if isinstance(mark, Label)]
    said = dict(re.fullmatch(SPEED, text).groups() for text in labels if text != "p")
    assert {name: float(speed) for name, speed in said.items()} == pytest.approx(
        {name: length * float(mu) for name, length in lengths.items()}, rel=6e-3
    )
    # v₂ is ω ds/dφ, of an arm times its length: the value at this station of the table of the note.
    v, arm = float(solution.drawn["integration"].value("v")[k]), getattr(task.follower, "arm", 1.0)
    omega = task.speed_rpm * math.tau / 60
    assert float(said["v₂"]) == pytest.approx(v * arm * omega / 1000, rel=6e-3)
    # One value one station: drawing and caption, and with it the player, say the same.
    assert dict(re.findall(SPEED, str(step.caption))) == said
    assert dict(re.findall(SPEED, str(step.parts[-1].caption))) == said


@over_all("task", [replace(COURSEWORK, speed_rpm=None), gc.builtin_task("arm")])
def test_without_a_speed_the_plan_is_one_of_velocities_divided_by_the_cams(task):
    step = plan_of(gc.solve(task))
    assert re.search(r"at station \S+, [\d.:]+, μᵥ = [\d.]+ \(mm/rad\)/mm$", str(step.view.title))
    assert {str(mark.text) for mark in step.marks if isinstance(mark, Label)} == {"v₁", "v₂", "v₂₁", "p"}
    assert "m/s" not in str(step.caption)


def test_all_steps_in_the_view_of_a_plan_have_one_title():
    for task in (COURSEWORK, ARM):
        titles = {str(s.view.title) for s in gc.solve(task).drawn["pressure_angle"].steps() if s.view.name == "plan"}
        assert len(titles) == 1


@over_all("speed", [None, 150.0])
def test_the_plan_of_a_cam_of_arcs_names_its_station_and_its_scales(speed):
    solution = gc.solve(replace(gc.builtin_arcs_task(), speed_rpm=speed))
    views = {step.view.name: str(step.view.title) for step in solution.drawn["arc_roller"].steps()}
    plans = [step for step in solution.drawn["arc_roller"].steps() if step.view.name == "plan"]
    assert views["plan"].startswith("v and a at station 10, 1:1, μᵥ = ")
    assert views["accelerations"].endswith(", 1:1")
    named = [str(mark.text) for mark in plans[0].marks if isinstance(mark, Label)]
    if speed is None:
        assert views["plan"].endswith("μᵥ = 1 (mm/rad)/mm, μₐ = 1 (mm/rad²)/mm")
        assert not any("m/s" in text for text in named)
    else:
        v = float(re.search(r"([\d.]+) mm/rad is the velocity", str(plans[0].caption)).group(1))
        assert f"v = {v * speed * math.tau / 60 / 1000:.3g} m/s" in named


def test_the_tables_of_a_cam_of_arcs_are_told_apart():
    titles = [str(table.title) for table in contents_of(gc.solve(gc.builtin_arcs_task())).results]
    assert titles == ["Sizes of the arcs: drawn and exact", "Motion: drawn and exact"]


ROUND = [gc.builtin_task(name) for name in ("coursework", "arm", "flat", "measured")]
ROUND += [task for name, task in list(RANDOM.items())[:4] if isinstance(task, gc.Task)]


@over_all("task", ROUND)
def test_degrees_and_phases_stand_under_the_lowest_diagram_alone_whichever_it_is(task):
    solution = gc.solve(task)
    below: dict[str, list[str]] = {}
    for construction in solution.drawn.values():
        for step in construction.steps():
            if step.view.across == "phi":
                found = (mark for mark in step.given if isinstance(mark, Label | Dimension))
                said = [str(mark.text) for mark in found]
                below.setdefault(step.view.name, []).extend(t for t in said if re.fullmatch(r"\d+°|φ.+ = .*°", t))
    lowest = list(below)[-1]
    assert lowest == ("displacement" if solution.task.follower.kind == "flat-faced" else "angle")
    assert [name for name, said in below.items() if said] == [lowest]
    phases = [text for text in below[lowest] if text.startswith("φ")]
    angles = [float(text.split("= ")[1].rstrip("°")) for text in phases]
    assert angles == pytest.approx(
        [math.degrees(phase.angle) for phase in solution.chain.board.motion.phases], rel=1e-5
    )
    assert {"0°", "360°"} <= set(below[lowest])

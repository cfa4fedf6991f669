"""What if: every curve is what the exact side says of each design by itself, with nothing where there is none."""

import json
import math

import numpy as np
import pytest
from studio_tasks import BUILT_IN, plain_task, rebuilt, solved

import graphcam as gc
from graphcam.studio.engine import answer
from graphcam.studio.handle import changes_with
from graphcam.studio.task_paths import changed_task
from graphcam.studio.what_if import (
    DEFAULT_DESIGNS,
    MAX_MEASURED_DESIGNS,
    exact_design,
    sweep_answer,
    swept_fields,
)


def swept(name, path, **asked):
    return sweep_answer({"task": plain_task(name), "path": path, **asked})


def curve(found, name):
    values = next(each for each in found["curves"] if each["id"] == name)["values"]
    return np.array([math.nan if value is None else value for value in values])


@pytest.mark.parametrize("name", BUILT_IN)
def test_every_size_can_be_swept(name):
    for field in swept_fields(solved(name), str):
        found = swept(name, field["path"], count=5)
        json.dumps(found, allow_nan=False)
        assert found["at"][0] == pytest.approx(field["min"])
        assert found["at"][-1] == pytest.approx(field["max"])
        assert all(len(each["values"]) == len(found["at"]) for each in found["curves"])
        # In the middle of its range stands a design, or near what is given.
        assert found["curves"]


def test_the_least_radius_over_the_offset_is_that_of_each_offset():
    found = swept("coursework", "follower.offset", **{"from": -20.0, "to": 20.0, "count": 9})
    task = gc.builtin_task()
    for offset, least in zip(found["at"], curve(found, "least_prime_radius"), strict=True):
        exact = gc.minimum_radius(task.motion(), task.follower(), task.rotation, math.radians(30), offset=offset)
        assert least == pytest.approx(exact.prime_radius, abs=1e-6)
    # What is open follows: the cam is the least one, so its rise uses up the limit.
    assert curve(found, "pressure_angle_rise") == pytest.approx(np.full(9, 30.0), abs=1e-6)
    assert found["limits"] == {"pressure_angle_rise": pytest.approx(30.0), "pressure_angle_return": None}
    assert found["now"] == -10.0


def test_curves_agree_with_a_sweep_of_designs():
    """The vectorised sweep is another way to the same extremes."""
    found = swept("coursework", "cam.prime_radius", **{"from": 30.0, "to": 80.0, "count": 11})
    designs = gc.Designs(
        lift=30,
        rise_angle=math.radians(80),
        dwell_angle=math.radians(45),
        return_angle=math.radians(60),
        prime_radius=found["at"],
        offset=-10,
        rise_law="rectangular",
        return_law="rectangular",
        rotation="cw",
    )
    other = gc.sweep(designs)
    for way in ("rise", "return"):
        degrees = np.degrees(np.abs(other[f"max_pressure_angle_{way}"]))
        assert curve(found, f"pressure_angle_{way}") == pytest.approx(degrees, abs=1e-5)
    # The sweep looks at the moving phases alone; a dwell's arc may be sharper.
    assert (curve(found, "curvature_radius") <= other["min_pitch_curvature_radius"] + 1e-6).all()


@pytest.mark.parametrize("name", ["coursework", "arm", "flat"])
def test_the_present_design_has_the_values_of_its_solution(name):
    exact = solved(name).comparison.exact
    adopted = solved(name).chain
    task = changed_task(plain_task(name), {"cam.prime_radius": adopted.prime_radius})
    found = exact_design(rebuilt(task))
    assert found["least_prime_radius"] == pytest.approx(exact["minimum_prime_radius"])
    assert found["curvature_radius"] == pytest.approx(exact["min_pitch_curvature_radius"])
    if name != "flat":
        assert found["pressure_angle_rise"] == pytest.approx(abs(exact["max_pressure_angle_rise_deg"]))


def test_where_there_is_no_cam_there_is_no_value():
    found = swept("arm", "cam.prime_radius", **{"from": 10.0, "to": 300.0, "count": 30})
    reached = (np.array(found["at"]) > 25) & (np.array(found["at"]) < 275)
    assert (np.isfinite(curve(found, "pressure_angle_rise")) <= reached).all()
    assert np.isfinite(curve(found, "pressure_angle_rise")).sum() > 20


def test_phases_stay_closed():
    solution = solved("coursework")
    for field in swept_fields(solution, str):
        if field["path"].startswith("motion"):
            changes = changes_with(field, field["path"], 40.0)
            task = rebuilt(changed_task(plain_task("coursework"), changes))
            assert math.fsum(phase.angle for phase in task.motion.phases) == pytest.approx(360)


def test_counts():
    assert len(swept("coursework", "follower.offset")["at"]) == DEFAULT_DESIGNS
    assert len(swept("measured", "follower.offset", quantities=["least_prime_radius"])["at"]) == MAX_MEASURED_DESIGNS


def test_only_what_is_asked_for_is_told():
    found = swept("flat", "cam.prime_radius", count=3, quantities=["curvature_radius", "max_v", 7])
    assert [each["id"] for each in found["curves"]] == ["curvature_radius"]


@pytest.mark.parametrize(
    "wrong",
    [
        {"path": "drawing.divisions"},
        {"path": "motion.tolerance"},
        {"path": "__class__"},
        {"path": 7},
        {"count": 1},
        {"count": 1e9},
        {"from": "left"},
        {"to": math.inf},
        {"task": {}},
        {"task": None},
        {"quantities": "all"},
    ],
)
def test_a_senseless_sweep_is_an_error(wrong):
    asked = {"ask": "sweep", "seq": 3, "task": plain_task("coursework"), "path": "follower.offset", **wrong}
    found = answer(asked)
    assert (found["seq"], found["ok"]) == (3, False)
    assert found["error"]["message"]


def test_the_engine_sweeps():
    asked = {"ask": "sweep", "seq": 9, "task": plain_task("coursework"), "path": "cam.prime_radius", "count": 4}
    found = answer(asked)
    assert found["ok"], found
    assert found["seq"] == 9
    assert len(found["curves"]) == 6

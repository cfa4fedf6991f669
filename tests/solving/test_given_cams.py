"""A task file that gives a cam by its radii: its motion is drawn, compared, written, opened in the studio."""

import tomllib

import pytest
from over_all import over_all

import graphcam as gc
from graphcam.report.documents import contents_of
from graphcam.report.sheet_data import data
from graphcam.studio.engine import answer
from graphcam.tasks.task_file import task_from
from graphcam.tasks.task_writer import task_files

TANGENT = {"base_radius": 28, "ascent": 70, "lift": 15, "flank_radius": "straight"}
ROUNDED = {"base_radius": 30, "flank_radius": 120, "nose_radius": 10, "lift": 12}
ROLLER = {"kind": "translating", "offset": 0, "roller_radius": 16}
CASES = [
    ({"speed_rpm": 600, "arcs": TANGENT, "follower": ROLLER}),
    (
        {
            "arcs": {"base_radius": 12, "flank_radius": 36, "nose_radius": 1.2, "lift": 7},
            "follower": {"kind": "flat-faced"},
        }
    ),
    (
        {
            "rotation": "cw",
            "arcs": ROUNDED | {"dwell": 20},
            "follower": {"kind": "oscillating", "arm": 80, "distance": 95, "roller_radius": 10},
        }
    ),
    ({"arcs": ROUNDED, "follower": {"kind": "translating", "offset": 8, "roller_radius": 0}}),
    ({"arcs": {"base_radius": 30, "lift": 12}, "follower": {"kind": "translating", "roller_radius": 8}}),
    (
        {
            "speed_rpm": 300,
            "arcs": {"base_radius": 30, "flank_radius": -80, "nose_radius": 8, "lift": 15},
            "follower": {"kind": "translating", "roller_radius": 12},
            "spring": {"mass": 1.0, "stiffness": 20},
        }
    ),
]


@over_all("given", CASES)
def test_a_given_cam_is_drawn_within_its_bounds_and_opens_everywhere(given):
    task = task_from(given)
    solution = gc.solve(task)
    beyond = [name for name, each in solution.comparison.quantities.items() if each.exists and each.is_beyond_bound]
    assert beyond == []
    assert "differentiation" in solution.drawn
    assert contents_of(solution).steps
    assert task_from(tomllib.loads(task_files(task)["task.toml"])) == task
    shown = answer({"seq": 1, "task": task.to_dict(), "views": [{"name": "profile", "px_per_mm": 2}], "form": True})
    assert shown["ok"]
    paths = {field["path"] for field in shown["form"]}
    assert "motion.radii.base_radius" in paths
    assert "cam.prime_radius" not in paths


def test_the_profile_is_the_given_one():
    """The envelope of the roller on its pitch curve: base circle, straight flanks and the nose of 20.2029 mm."""
    solution = gc.solve(task_from(CASES[0]))
    radius = solution.cam.prime_radius - solution.cam.roller_radius
    assert radius == 28
    assert solution.cam.extremes().min_convex_radius[0] - 16 == pytest.approx(20.2029, abs=5e-5)
    rows = {str(name): (str(value), str(by)) for name, value, by in data(solution).rows}
    assert rows["flank radius"] == ("straight", "given")
    assert rows["nose radius"] == ("20.2029 mm", "found")


@over_all(
    ("change", "field"),
    [
        ({"arcs": TANGENT | {"nose_radius": 20}}, "arcs"),
        ({"arcs": TANGENT | {"flank_radius": "bent"}}, "arcs.flank_radius"),
        ({"arcs": TANGENT | {"base_radius": -1}}, "arcs.base_radius"),
        ({"arcs": TANGENT | {"rho": 2}}, "arcs.rho"),
        ({"follower": ROLLER | {"offset": 50}}, "follower.offset"),
        ({"follower": {"kind": "translating"}}, "follower.roller_radius"),
        ({"follower": {"kind": "flat-faced"}}, "arcs.flank_radius"),
        ({"follower": {"kind": "oscillating", "arm": 80, "roller_radius": 5}}, "follower.distance"),
        ({"follower": {"kind": "oscillating-flat", "distance": 80}}, "follower.kind"),
        ({"cam": {"prime_radius": 50}}, "cam.prime_radius"),
        ({"arcs": TANGENT | {"D": [1, 2]}}, "arcs"),
    ],
)
def test_what_is_wrong_is_told_by_its_field(change, field):
    with pytest.raises(gc.TaskError) as caught:
        task_from(CASES[0] | change)
    assert str(caught.value.field).startswith(field)

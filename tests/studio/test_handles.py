"""Handles: a dragged one lies under the hand, on a step, in its range, and never leads to what cannot be."""

import json
import math
import random
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from over_all import over_all, over_seeds
from studio_tasks import BUILT_IN, plain_task, rebuilt, solved

import graphcam as gc
from graphcam.constructions.adoption import BLUNT_FACTOR
from graphcam.studio import task_text
from graphcam.studio.address import StudioPlace, address_of
from graphcam.studio.engine import answer
from graphcam.studio.handle import changes_with
from graphcam.studio.handles import dragged as dragged_to, handles_of
from graphcam.studio.held_solutions import hold_of
from graphcam.studio.task_paths import changed_task, value_at
from graphcam.studio.views_answer import moved_task
from graphcam.studio.views_request import views_request
from graphcam.tasks.task import CamTable

VIEWS = ("acceleration", "velocity", "displacement", "combined", "region", "angle", "profile", "arcs", "roller")
PHI = 39.0
STATE = "phi", "station"
REACH = 40.0
"""So far a hand goes [mm of paper]."""


@cache
def at_rest(name):
    """What the page has before a hand takes hold."""
    views = [{"name": view, "px_per_mm": 0.5} for view in VIEWS]
    found = answer({"task": plain_task(name), "views": views, "phi": PHI, "mechanism": True})
    assert found["ok"], found
    return found


def dragged(solution, drag, phi=0.0):
    """What a drag changes where everything can be drawn."""
    return dragged_to(solution, drag, dict, phi)[0]


def handles(name):
    return [handle for handle in at_rest(name)["handles"] if handle["view"] != "mechanism"]


def moved(name, handle, to, *, fine=False):
    """What is drawn while a hand drags."""
    drag = {"handle": handle["id"], "to": list(to), "fine": fine}
    request = views_request({"task": plain_task(name), "views": [], "phi": PHI, "drag": drag})
    return moved_task(request, hold_of(at_rest(name)["hold"]))


def there(drawn, handle):
    """The same handle on the drawing that followed it."""
    found = handles_of(drawn.solution, [handle["view"]], str, drawn.phi)
    return next(each for each in found if each["id"] == handle["id"])


def apart(handle, other, to):
    """How far a handle lies from the hand, along the way that it goes."""
    if handle["id"] == "profile/l":  # it goes round the prime circle
        to = [x * math.hypot(*other["at"]) / math.hypot(*to) for x in to]
    dx, dy = (a - b for a, b in zip(other["at"], to, strict=True))
    if handle["shape"] == "along":
        return abs(dx * other["along"][0] + dy * other["along"][1])
    return {"x": abs(dx), "y": abs(dy), "xy": math.hypot(dx, dy)}[handle["shape"]]


def pointers(handle, count, seed=17):
    stream = random.Random(f"{handle['id']} {seed}")
    for _ in range(count):
        yield tuple(x + stream.uniform(-REACH, REACH) for x in handle["at"])


def each_handle(fast=1):
    """All handles of the built-in tasks, those of the cam angle alike in every diagram; one in ``fast`` is quick."""
    every = [(name, handle) for name in BUILT_IN for handle in handles(name)]
    marks = [[] if k % fast == 0 else [pytest.mark.slow] for k in range(len(every))]
    return [
        pytest.param(name, handle, id=f"{name}-{handle['id']}", marks=own)
        for (name, handle), own in zip(every, marks, strict=True)
    ]


@pytest.mark.parametrize(("name", "handle"), each_handle(fast=3))
def test_a_handle_follows_the_hand(name, handle):
    """After a drag it lies within a step of the hand, unless the range or the design ends before."""
    followed = 0
    for to in pointers(handle, 4):
        if followed == 2:
            break
        drawn = moved(name, handle, to, fine=True)
        other = there(drawn, handle)
        if any(path in STATE for path in drawn.changes) and handle["shape"] == "xy":
            assert_nearest_station(name, handle, drawn, other, to)
            followed += 1
        elif handle["id"].startswith("displacement/point"):
            assert_row_moved(handle, drawn, to)
            followed += 1
        elif within(handle, other, drawn):
            assert apart(handle, other, to) <= a_step(name, handle, drawn, other), (to, drawn.changes)
            followed += 1
    assert followed or name == "arcs"


def within(handle, other, drawn):
    """Whether the sizes lie inside of their ranges, and no design was in the way."""
    ranges = [(old, new, new) for old, new in zip(handle["axes"], other["axes"], strict=True)]
    free = all(max(a["min"], b["min"]) < c["value"] < min(a["max"], b["max"]) for a, b, c in ranges)
    return free and bool(drawn.changes) and handle["view"] != "arcs"


def assert_row_moved(handle, drawn, to):
    """The row of a table lies where the hand is, by the scale at which it took hold, or not so far."""
    (axis,), (_, y), start = handle["axes"], handle["at"], dict(drawn.changes)
    moved, asked = (
        start[axis["path"]] - axis["value"],
        (y - to[1]) * at_rest("measured")["views"][2]["ordinate"]["per_mm"],
    )
    assert 0 <= moved / asked <= 1 + axis["fine"] / abs(asked)


def a_step(name, handle, drawn, other):
    """How far the handle moves for half a fine step of every size it has, and a little for the curve between."""
    total = 0.0
    for axis, grabbed in zip(other["axes"], handle["axes"], strict=True):
        if axis["path"] in STATE:
            return axis["fine"]
        half = axis["value"] + grabbed["fine"] / 2
        sizes = {path: value for path, value in drawn.changes.items() if path not in STATE}
        task = changed_task(plain_task(name), sizes)
        task = changed_task(task, changes_with(axis, axis["path"], half))
        request = views_request({"task": task, "views": [], "phi": PHI})
        nudged = there(moved_task(request, hold_of(at_rest(name)["hold"])), handle)
        total += apart(handle, nudged, other["at"])
    return 1.2 * total + 0.02


def assert_nearest_station(name, handle, drawn, other, to):
    """A point of a curve goes to its station that is nearest to the hand."""
    stations = (
        solved(name).chain.board.stations.phi if name != "arcs" else solved(name).chain["arc_roller"].value("phi")
    )
    places = [
        complex(
            *next(h for h in handles_of(drawn.solution, [handle["view"]], str, phi) if h["id"] == handle["id"])["at"]
        )
        for phi in np.degrees(stations)
    ]
    assert np.isclose(np.degrees(stations), drawn.phi, atol=1e-5).any()
    nearest = min(abs(place - complex(*to)) for place in places)
    assert apart(handle, other, to) <= nearest + 0.01


@over_all("name", BUILT_IN)
def test_values_keep_to_steps_and_ranges(name):
    solution = solved(name)
    for handle in handles(name):
        axes = {axis["path"]: axis for axis in handle["axes"]}
        for to in pointers(handle, 60):
            changes = dragged(solution, {"handle": handle["id"], "to": to}, PHI)
            json.dumps(changes, allow_nan=False)
            for path in axes.keys() & changes.keys():
                axis = axes[path]
                assert axis["min"] - 1e-9 <= changes[path] <= axis["max"] + 1e-9 or len(axes) == 2
                steps = changes[path] / axis["fine"]
                assert path in STATE or abs(steps - round(steps)) < 1e-6


@pytest.mark.parametrize("name", ["coursework", "arm", "flat"])
def test_borders_keep_the_turn(name):
    task = plain_task(name)
    for handle in handles(name):
        if "border" not in handle["id"]:
            continue
        for to in [*pointers(handle, 40), (-1e5, 0.0), (1e5, 0.0)]:
            new = changed_task(task, dragged(solved(name), {"handle": handle["id"], "to": to}, PHI))
            angles = [phase["angle"] for phase in new["motion"]["phases"]]
            assert math.fsum(angles) == pytest.approx(360, abs=1e-9)
            assert min(angles) >= 1


def test_a_border_is_drawn_to_round_angles():
    to_84 = dragged(solved("coursework"), {"handle": "velocity/border 1", "to": [84.4, 0]})
    assert to_84 == {"motion.phases[0].angle": 85.0, "motion.phases[1].angle": 40.0}
    fine = dragged(solved("coursework"), {"handle": "velocity/border 1", "to": [84.4, 0], "fine": True})
    assert fine["motion.phases[0].angle"] == pytest.approx(84.4)


def test_the_cam_centre_is_drawn_to_the_edge_of_the_region():
    """Near the edge the least radius of the place is taken, so that it keeps the limits and is hardly larger."""
    solution = solved("coursework")
    mu = solution.chain["minimum_radius"].readings["prime_radius"].per_mm
    for offset in (-12.0, -5.0, 3.0, 8.0):
        least = solution.chain._least_radius(offset).value("prime_radius").item()
        below = complex(offset / mu, math.sqrt(least**2 - offset**2) / mu)
        for aside in (-1.5, 1.5):
            changes = dragged(solution, {"handle": "combined/A", "to": [-below.real, below.imag + aside]})
            assert changes["follower.offset"] == offset
            assert least <= changes["cam.prime_radius"] <= least + 0.1 + 1e-9


def test_the_cam_centre_of_an_arm_is_drawn_to_the_edge_of_the_region():
    solution = solved("arm")
    for distance in (140.0, 150.0):
        least = solution.chain._least_radius(distance).value("prime_radius").item()
        place = centre_of(125.0, distance, least + 1.0)
        changes = dragged(solution, {"handle": "region/A", "to": place})
        assert changes["follower.distance"] == distance
        assert least <= changes["cam.prime_radius"] <= least + 0.2 + 1e-9


def centre_of(arm, distance, radius):
    """A triangle with its pivot in the origin and its arm to the left, on the page."""
    x = (radius**2 - distance**2 - arm**2) / (2 * arm)
    return [x, math.sqrt(distance**2 - x**2)]


def test_outside_of_the_region_the_centre_has_the_colour_of_a_limit():
    handle = next(each for each in handles("coursework") if each["id"] == "combined/A")
    x, y = handle["at"]
    assert not handle["limit"]
    for to, outside in (((x, y + 20), False), ((x, y - 20), True), ((x - 40, y), True)):
        assert there(moved("coursework", handle, to), handle)["limit"] == outside


def test_the_tangent_goes_through_the_place_that_gives_its_angle():
    """Seen from any place of a tangent the curve of the ends appears under the permitted angle at most."""
    solution = solved("coursework")
    ends = solution.chain["pressure_angle"].first("ends")
    for to in ((20.0, 50.0), (30.0, 50.0), (45.0, 50.0)):
        found = dragged(solution, {"handle": "combined/tangent rise", "to": to, "fine": True})
        x, y = to
        # Of a clockwise cam the ends of the rise lie to the right.
        seen = np.degrees(np.arctan2(ends.real - x, ends.imag + y)).max()
        assert found["limits.pressure_angle_rise"] == pytest.approx(np.clip(seen, 15, 60), abs=0.15)


def test_the_roller_is_drawn_to_the_least_radius_of_curvature():
    """Where the prime radius is given; else it is found by a larger roller, and a hand goes no farther than that."""
    solution = gc.solve(replace(gc.builtin_task(), cam=CamTable(44.0)))
    rho = solution.chain["curvature"].value("rho").item()
    rim = next(each for each in handles_of(solution, ["profile"], str, PHI) if each["id"] == "profile/r")
    mu = solution.chain["inversion"].readings["x"].per_mm
    out = [rim["at"][k] + rim["along"][k] * (rho + 0.4 - 17.0) / mu for k in (0, 1)]
    taken = dragged(solution, {"handle": "profile/r", "to": out}, PHI)["follower.roller_radius"]
    assert rho - 0.1 <= taken <= rho
    taken = dragged(solved("coursework"), {"handle": "profile/r", "to": out}, PHI)["follower.roller_radius"]
    assert rho / BLUNT_FACTOR - 1 <= taken <= rho / BLUNT_FACTOR


@pytest.mark.parametrize("name", ["coursework", "arm"])
def test_the_plan_goes_to_the_station_under_the_hand(name):
    """The end of its triangle, drawn at another station, lies where the hand has to be for that station."""
    task, hold = plain_task(name), hold_of(answer({"task": plain_task(name), "views": [{"name": "plan"}]})["hold"])
    for station in (3, 5, 8):
        request = views_request({"task": task, "views": [], "station": station})
        (handle,) = handles_of(moved_task(request, hold).solution, ["plan"], str)
        assert handle["axes"][0]["value"] == station
        drag = {"handle": "plan/station", "to": handle["at"]}
        followed = moved_task(views_request({"task": task, "views": [], "drag": drag}), hold)
        assert followed.changes == {"station": station}
        assert followed.station == station


def test_both_sizes_of_the_centre_are_one_drag():
    changes = dragged(solved("coursework"), {"handle": "combined/A", "to": [0.0, 90.0]})
    assert set(changes) == {"follower.offset", "cam.prime_radius"}


@pytest.mark.parametrize("name", BUILT_IN)
def test_every_axis_names_a_path_of_the_task(name):
    """What a key changes, with what has to be put there before, is a task again."""
    task = plain_task(name)
    for handle in at_rest(name)["handles"]:
        for axis in handle["axes"]:
            assert axis["min"] <= axis["value"] <= axis["max"]
            if axis["path"] in STATE:
                continue
            value = min(axis["value"] + axis["step"], axis["max"])
            new = rebuilt(changed_task(task, changes_with(axis, axis["path"], value)))
            assert value_at(task_text.plain_task(new), axis["path"]) == pytest.approx(value)


@pytest.mark.parametrize(
    "drag",
    [
        {},
        {"handle": "combined/none", "to": [0, 0]},
        {"handle": "nowhere/A", "to": [0, 0]},
        {"handle": "combined/A"},
        {"handle": "combined/A", "to": [1]},
        {"handle": "combined/A", "to": "xy"},
        {"handle": "combined/A", "to": [math.nan, 0]},
        {"handle": "combined/A", "to": [1e300, 0]},
        {"handle": ["A"], "to": [0, 0]},
    ],
)
def test_a_drag_of_nothing_is_an_error(drag):
    with pytest.raises(gc.DesignError, match="drag"):
        dragged(solved("coursework"), drag)
    assert not answer({"task": plain_task("coursework"), "views": [], "drag": drag})["ok"]


def draws(name, count, seed):
    """Every handle of a task dragged anywhere, and all that the page may ask for drawn."""
    for handle in handles(name):
        for to in pointers(handle, count, seed):
            request = {
                "task": plain_task(name),
                "views": [{"name": handle["view"], "px_per_mm": 0.5}],
                "phi": PHI,
                "hold": at_rest(name)["hold"],
                "drag": {"handle": handle["id"], "to": to},
            }
            found = answer(request)
            assert found["ok"], (handle["id"], to, found.get("error"))
            sizes = {path: value for path, value in found["changes"].items() if path not in STATE}
            released = answer(
                {
                    "task": changed_task(plain_task(name), sizes),
                    "values": True,
                    "warnings": True,
                    "form": True,
                    "views": [],
                }
            )
            assert released["ok"], (handle["id"], to, sizes, released.get("error"))


@pytest.mark.slow
@over_seeds(1)
@over_all("name", BUILT_IN)
def test_a_drag_never_leads_to_an_error(name, seed):
    draws(name, 1, 5 + seed)


LOWER, UPPER = {"s": 0, "v": 0, "a": 0}, {"s": 30, "v": 0, "a": 0}
RISE = {"kind": "polynomial", "points": [{"angle": 0, **LOWER}, {"angle": 120, **UPPER}]}
RETURN = {"kind": "spline", "points": [{"angle": 160, **UPPER}, {"angle": 220, "s": 12}, {"angle": 280, **LOWER}]}


def test_points_of_a_motion_by_conditions_are_dragged():
    """One within a part in both ways, one between two parts upwards with the other; the motion goes through it."""
    task = plain_task("coursework") | {"motion": {"parts": [RISE, RETURN]}}
    view = {"name": "displacement", "px_per_mm": 2.0}
    found = answer({"task": task, "views": [view]})
    points = {each["id"]: each for each in found["handles"] if "/point" in each["id"]}
    assert {id_: each["shape"] for id_, each in points.items()} == {
        "displacement/point 0.1": "y",
        "displacement/point 1.1": "xy",
    }
    scale = found["views"][0]["ordinate"]["per_mm"]
    for each in points.values():
        assert -each["at"][1] * scale == pytest.approx(each["axes"][-1]["value"], abs=1e-2)
    drag = {"handle": "displacement/point 1.1", "to": [230.2, -10.0 / scale]}
    moved_ = answer({"task": task, "views": [view], "drag": drag, "hold": found["hold"]})
    assert moved_["changes"] == {"motion.parts[1].points[1].angle": 230.0, "motion.parts[1].points[1].s": 10.0}
    drag = {"handle": "displacement/point 0.1", "to": [120.0, -35.0 / scale]}
    both = {"motion.parts[0].points[1].s": 35.0, "motion.parts[1].points[0].s": 35.0}
    assert answer({"task": task, "views": [view], "drag": drag, "hold": found["hold"]})["changes"] == both


def test_an_edited_table_says_so_and_fits_in_the_address():
    """Rows beside the dragged one go with it, the file is called edited, and few letters tell it."""
    task = plain_task("measured")
    drag = {"handle": "displacement/point 90", "to": [90.0, -50.0]}
    changes = answer({"task": task, "views": [], "drag": drag})["changes"]
    edited = changed_task(task, changes)
    assert edited["motion"]["table"]["file"] == "measured-edited.csv"
    before, after = (np.array(each["motion"]["table"]["rows"]) for each in (task, edited))
    moved_rows = np.flatnonzero(before[:, 1] != after[:, 1])
    assert 45 <= moved_rows.min() < 60 < 120 < moved_rows.max() <= 135
    assert np.argmax(np.abs(after - before)[:, 1]) == 90
    assert len(address_of(StudioPlace(edited, "measured"), {"measured": task})) < 2000

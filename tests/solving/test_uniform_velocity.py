"""A velocity that jumps at the ends of a phase: the uniform velocity with which every first course begins."""

from __future__ import annotations

import math
from contextlib import nullcontext, suppress
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.random import default_rng

import graphcam as gc
from graphcam.constructions.axes import station_names
from graphcam.drafting.marks import Arrow, Label
from graphcam.drafting.pencil import Pencil
from graphcam.given.impact import velocity_jumps
from graphcam.given.motion_law import JUMP_BLEND
from graphcam.solving.solution import Solution
from graphcam.tasks.task_file import task_from

UNIFORM = gc.constant_velocity_law(0, 0)
KNIFE_EDGE = {"kind": "translating", "offset": 0.0, "roller_radius": 0.0}
ROLLER = {"kind": "translating", "offset": 0.0, "roller_radius": 10.0}
ARM = {"kind": "oscillating", "arm": 80.0, "distance": 100.0, "roller_radius": 8.0}
FLAT = {"kind": "flat-faced"}


def moving(kind: str, angle: float, lift: float, law: str = "uniform velocity", **more: Any) -> dict[str, Any]:
    blends = {"blends": [0.0, 0.0]} if law == "uniform velocity" else {}
    return {"kind": kind, "angle": angle, "lift": lift, "law": law, **blends, **more}


def task(*phases: Any, follower: dict[str, Any] = KNIFE_EDGE, radius: float | None = 50.0, **more: Any) -> gc.Task:
    tables = [{"kind": "dwell", "angle": phase} if isinstance(phase, float) else phase for phase in phases]
    cam = {} if radius is None else {"cam": {"prime_radius": radius}}
    made = task_from({"rotation": "ccw", "motion": {"phases": tables}, "follower": follower, **cam, **more})
    assert isinstance(made, gc.Task)
    return made


def solved(*phases: Any, **more: Any) -> Solution:
    found = gc.solve(task(*phases, **more))
    assert isinstance(found, Solution)
    return found


RISE, RETURN = moving("rise", 120.0, 30.0), moving("return", 120.0, 30.0)
TEXTBOOK: dict[str, tuple[tuple[Any, ...], dict[str, Any]]] = {
    "a knife edge, up and down": ((RISE, 60.0, RETURN, 60.0), {}),
    "a roller, back by harmonic motion": (
        (RISE, 60.0, moving("return", 120.0, 30.0, "SHM"), 60.0),
        {"follower": ROLLER},
    ),
    "back alone, an offset roller": (
        (moving("rise", 120.0, 30.0, "SHM"), 60.0, RETURN, 60.0),
        {"follower": {**ROLLER, "offset": 12.0}},
    ),
    "a heart cam": ((moving("rise", 180.0, 30.0), moving("return", 180.0, 30.0)), {"radius": 30.0}),
    "a heart cam for a roller": (
        (moving("rise", 180.0, 30.0), moving("return", 180.0, 30.0)),
        {"radius": 30.0, "follower": {**ROLLER, "roller_radius": 6.0}},
    ),
    "sizes that are sought": (
        (RISE, 60.0, moving("return", 120.0, 30.0, "3-4-5"), 60.0),
        {"follower": {"kind": "translating"}, "radius": None},
    ),
    "a flat face on which no velocity falls at once": (
        (moving("rise", 120.0, 20.0, blends=[0.0, 0.3]), 60.0, moving("return", 120.0, 20.0, "UARM"), 60.0),
        {"follower": FLAT, "radius": 40.0},
    ),
    "an arm with a roller": (
        (moving("rise", 120.0, 20.0), 60.0, moving("return", 120.0, 20.0), 60.0),
        {"follower": ARM, "radius": 40.0},
    ),
    "one jump alone": (
        (moving("rise", 120.0, 30.0, "2-3"), 60.0, moving("return", 120.0, 30.0, blends=[0.2, 0.0]), 60.0),
        {"follower": ROLLER},
    ),
}


@pytest.mark.parametrize("name", TEXTBOOK)
def test_a_cam_of_a_first_course_is_drawn_within_its_bounds_and_warned_of(name):
    phases, more = TEXTBOOK[name]
    found = solved(*phases, **more)
    assert [q.name for q in found.comparison.quantities.values() if q.is_beyond_bound] == []
    assert "the velocity jumps" in found.warnings[0]
    jumps = velocity_jumps(found.cam.motion)
    assert len({round(jump.phi, 9) for jump in jumps}) == len(jumps) > 0
    # Every step is told, and an arrow stands for each jump.
    steps = [step for each in found.drawn.values() for step in each.steps()]
    assert all(str(part.caption) for step in steps for part in step.parts)
    marks = [mark for step in found.drawn["acceleration"].steps() for mark in step.marks]
    feet = {round(mark.start.real, 6) for mark in marks if isinstance(mark, Arrow) and mark.start.real >= 0}
    mu_phi = found.chain.board.mu_phi
    assert {round(mu_phi.paper(jump.phi), 6) for jump in jumps} <= feet
    assert sum(isinstance(mark, Label) and mark.text == "∞" for mark in marks) >= len(jumps)
    assert found.to_dict()["warnings"]


@pytest.mark.parametrize("sigma", [1, -1])
def test_the_exact_cam_has_the_velocity_of_the_whole_phase_up_to_its_ends(sigma):
    # v = h/beta everywhere on the phase, so tan(alpha) = (v - sigma e)/(s0 + s) there.
    h, beta, r0, e = 30.0, math.radians(120), 50.0, 7.0
    motion = gc.Motion([gc.Rise(h, beta, UNIFORM), gc.Return(h, 2 * math.pi - beta, "cosine")])
    cam = gc.Cam(motion, gc.Translating(e), r0, "ccw" if sigma == 1 else "cw")
    u = np.linspace(JUMP_BLEND, 1 - JUMP_BLEND, 1001)
    at = cam.at(np.zeros(u.size, dtype=int), u)
    s, v, a, _ = at.values
    np.testing.assert_allclose(v, h / beta, rtol=2 * JUMP_BLEND)
    np.testing.assert_allclose(s, h * u, atol=2 * h * JUMP_BLEND)
    assert np.all(a == 0)
    s0 = math.sqrt(r0**2 - e**2)
    np.testing.assert_allclose(np.tan(at.pressure_angle), (h / beta - sigma * e) / (s0 + h * u), rtol=1e-6)
    highest = max(abs(h / beta - sigma * e) / s0, abs(0 - sigma * e) / s0)
    assert math.tan(abs(cam.extremes().pressure_angle_rise[0])) == pytest.approx(highest, rel=4 * JUMP_BLEND)
    assert motion.phases[0].normalised.peak_acceleration == math.inf


def test_the_least_radius_is_that_of_the_velocity_at_the_start():
    # tan(30) = v/r0 at the start of the rise, where the follower is lowest, and v = h/beta there.
    found = solved(RISE, 60.0, RETURN, 60.0)
    exact = 30 / math.radians(120) / math.tan(math.radians(30))
    least = found.comparison.quantities["minimum_prime_radius"]
    assert (least.drawn, least.exact) == (
        pytest.approx(exact, rel=4 * JUMP_BLEND),
        pytest.approx(exact, rel=4 * JUMP_BLEND),
    )


def test_a_roller_rolls_over_the_edge_in_which_both_sides_of_a_corner_meet():
    # The edge is on the profile of both sides, at the roller's radius from two pitch points, never nearer to a third.
    found = solved(*TEXTBOOK["a heart cam for a roller"][0], **TEXTBOOK["a heart cam for a roller"][1])
    (lost,) = found.cam.undercuts()
    start, end, *edge = lost.crossing
    pitch = found.cam.pitch_curve(np.array([start, end]))
    np.testing.assert_allclose(np.hypot(*(pitch - edge).T), 6.0, rtol=1e-7)
    assert math.degrees(start) == pytest.approx(360 - math.degrees(end), abs=1e-6)
    everywhere = found.cam.pitch_curve(np.linspace(0, 2 * np.pi, 20001))
    assert np.hypot(*(everywhere - edge).T).min() > 6.0 - 1e-6
    # As drawn: the tangents at both contact points meet there, but for the bend of the profile.
    drawn = found.drawn["working_profile"].value("radius")
    corner = station_names(found.chain.board.stations).index("12⁻")
    assert drawn[corner] == pytest.approx(math.hypot(*edge), abs=0.3)
    assert "rounds the corner" in found.warnings[1]


def test_in_a_hollow_corner_the_profile_is_an_arc_of_the_roller():
    found = solved(RISE, 60.0, moving("return", 120.0, 30.0, "SHM"), 60.0, follower=ROLLER)
    corner = found.cam.pitch_curve(0.0)
    inside = found.cam.at(np.zeros(50, dtype=int), np.linspace(0, 1, 50) * JUMP_BLEND).profile
    np.testing.assert_allclose(np.hypot(*(inside - corner).T), 10.0, atol=1e-6)
    # A polygon of the profile that can be cut follows it: no side is far from the arc.
    points = found.cam.trimmed_profile(1440)
    beside = points[np.hypot(*(points - corner).T) < 10.0 + 1e-6]
    turned = np.ptp(np.arctan2(*(beside - corner).T))
    assert len(beside) > 5
    assert turned == pytest.approx(math.atan(30 / math.radians(120) / 50), abs=0.02)


@pytest.mark.parametrize("follower", [ROLLER, ARM])
def test_short_blends_come_to_what_no_blends_are(follower):
    def values(blend: float) -> dict[str, tuple[float, float]]:
        rise = moving("rise", 120.0, 20.0, blends=[blend, blend])
        found = solved(rise, 60.0, moving("return", 120.0, 20.0, "3-4-5"), 60.0, follower=follower)
        told = found.comparison.quantities
        assert not any(q.is_beyond_bound for q in told.values())
        return {name: (q.drawn, q.exact) for name, q in told.items() if name != "max_a"}

    none = values(0.0)
    for blend in (1e-8, 1e-6, 1e-4, 5e-4):
        for name, pair in values(blend).items():
            np.testing.assert_allclose(pair, none[name], atol=max(1e-6, 1000 * blend), rtol=3 * blend, err_msg=name)


def test_drawn_values_of_random_blends_keep_to_their_bounds():
    random, blends = default_rng(36), (0.0, 0.0, 1e-7, 1e-6, 1e-4, 1e-3, 0.003, 0.01, 0.05, 0.2, 0.4)
    laws = ("uniform velocity", "uniform velocity", "SHM", "3-4-5", "UARM")
    drawn = list[tuple[gc.Task, Solution]]()
    while len(drawn) < 10:

        def one(kind: str, lift: float, law: str) -> dict[str, Any]:
            own = {"blends": random.choice(blends, 2).tolist()} if law == "uniform velocity" else {}
            return moving(kind, float(random.integers(60, 170)), lift, law, **own)

        lift = float(random.integers(5, 40))
        rise, back = (one(kind, lift, str(random.choice(laws))) for kind in ("rise", "return"))
        rest = 360.0 - rise["angle"] - back["angle"]
        follower = ({**ROLLER, "offset": float(random.integers(-10, 10))}, KNIFE_EDGE, ARM)[int(random.integers(3))]
        upper = float(random.integers(1, int(rest)))
        given = task(rise, upper, back, rest - upper, follower=follower, radius=60.0)
        given = replace(given, rotation=str(random.choice(["cw", "ccw"])))  # type: ignore[arg-type]
        with suppress(gc.DesignError) if follower is ARM else nullcontext():  # an arm may not close
            found = gc.solve(given)
            assert isinstance(found, Solution)
            drawn.append((given, found))
    for given, found in drawn:
        beyond = [q.name for q in found.comparison.quantities.values() if q.is_beyond_bound]
        assert beyond == [] or any("too long for the acceleration" in said for said in found.warnings), given
        blends = [getattr(phase, "blends", None) or () for phase in given.motion.phases or ()]
        assert any("the velocity jumps" in said for said in found.warnings) == any(0.0 in each for each in blends)


def test_a_hand_that_errs_draws_it_too():
    found = gc.solve(task(RISE, 60.0, moving("return", 120.0, 30.0, "SHM"), 60.0, follower=ROLLER), Pencil.of(0.1))
    assert isinstance(found, Solution)
    for name in ("max_v", "minimum_prime_radius", "max_pressure_angle_rise_deg"):
        quantity = found.comparison.quantities[name]
        assert quantity.drawn == pytest.approx(quantity.exact, rel=0.1)


def test_two_stations_stand_where_the_velocity_jumps():
    names = station_names(solved(RISE, 60.0, moving("return", 120.0, 30.0, "SHM"), 60.0).chain.board.stations)
    assert names[:3] + names[12:16] == ["0", "0⁺", "1", "11", "12⁻", "12", "0′"]


REFUSED = {
    "a spring": (
        (RISE, 60.0, RETURN, 60.0),
        {"speed_rpm": 100.0, "spring": {"mass": 0.2, "stiffness": 3.0}},
        "spring.*velocity jumps.*infinite, and with it every force",
    ),
    "the jerk": ((RISE, 60.0, RETURN, 60.0), {"drawing": {"jerk": True}}, "jerk.*velocity jumps.*infinite"),
    "a flat face": (
        (RISE, 60.0, RETURN, 60.0),
        {"follower": FLAT},
        "falls at once at 120 degrees.*flat-faced.*give law blends, or take a roller",
    ),
    "a face on a pivot": (
        (RISE, 60.0, RETURN, 60.0),
        {"follower": {"kind": "oscillating-flat", "distance": 100.0}},
        "falls at once at 120 degrees.*oscillating-flat",
    ),
    "blends below 0": ((moving("rise", 120.0, 30.0, blends=[-0.1, 0.0]), 60.0, RETURN, 60.0), {}, "from 0 to less"),
    "blends of another law": (
        (moving("rise", 120.0, 30.0, "SHM", blends=[0.0, 0.0]), 60.0, RETURN, 60.0),
        {},
        "blends",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_jump_leaves_no_sense_is_refused(name):
    phases, more, message = REFUSED[name]
    with pytest.raises(gc.GraphcamError, match=message):
        task(*phases, **more)


def test_no_force_is_told_of_a_motion_whose_velocity_jumps():
    motion = task(RISE, 60.0, RETURN, 60.0).motion()
    cam = gc.Cam(motion, gc.Translating(roller_radius=5.0), 50.0)
    load = gc.SpringLoad(0.2, 100, 3)
    for told in (
        lambda: gc.spring_preload(motion, 0.2, 100, 3),
        lambda: gc.Contact(motion, load),
        lambda: gc.CamForces(cam, load),
        lambda: gc.shock_spectrum(motion, [2.0]),
        lambda: gc.shock_spectrum(UNIFORM, [2.0]),
    ):
        with pytest.raises(gc.DesignError, match="every force"):
            told()

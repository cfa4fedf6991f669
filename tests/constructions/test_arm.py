"""The oscillating follower on the drawing board: published arms, orders of convergence, theorems, what cannot be."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from boards import ARM, arm_board, arm_motion, arm_motion_of, limits, order
from numpy.testing import assert_allclose
from over_all import over_all
from test_convergence import distance_from_profile

import graphcam as gc
from graphcam.constructions.arm_minimum_radius import arm_least_radius
from graphcam.constructions.chain import AdoptedSizes, Chain
from graphcam.constructions.region import nearest_for_many
from graphcam.drafting.euclid import UP, unit
from graphcam.drafting.marks import Arc, Arrow, Line, Role
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import GOST_2_302, Paper, Scale
from graphcam.errors import DesignError
from graphcam.given.follower import sense
from graphcam.plane_vectors import dot

PARTS = (12, 24, 48, 96)
FINER = (12, 19, 26, 40, 54, 75, 96)
EXACT = 1e-12
SIZES = AdoptedSizes(prime_radius=45.0, place=120.0, roller_radius=12.0)
"""A cam for every division, so that what converges is one cam's drawing."""
each_rotation = over_all("rotation", ["ccw", "cw"])


def drawn(law: str, rotation: str = "ccw", n: int = 12, **changes) -> Chain:
    return Chain(arm_board(arm_motion(law), rotation=rotation, divisions=n, **changes), decided=SIZES)


@cache
def cam_of(law: str, rotation: str = "ccw") -> gc.Cam:
    follower = gc.Oscillating(ARM, SIZES.place, SIZES.roller_radius)
    return gc.Cam(arm_motion(law), follower, SIZES.prime_radius, rotation)


# --- published arms --------------------------------------------------------------------------------------------------


def published(rotation: str, n: int) -> Chain:
    """The case arm: swing 15 degrees in 75, rest 10, back in 75; arm 125, distance 150, prime radius 61."""
    motion = arm_motion_of((15, 75, "rectangular"), (0, 10), (-15, 75, "rectangular"))
    board = arm_board(motion, 150.0, 125.0, prime_radius=61.0, roller_radius=15.0, rotation=rotation, divisions=n)
    return Chain(board)


@over_all(("rotation", "greatest"), [("ccw", 31.00), ("cw", -34.82)])
@over_all("n", [12, 48])
def test_the_angles_of_a_published_arm(rotation, greatest, n):
    """Cam and arm turning in opposite senses on the rise and in the same."""
    chain = published(rotation, n)
    assert np.degrees(chain["pressure_angle"].readings["psi0"].value) == pytest.approx(23.45, abs=0.005)
    assert np.degrees(chain["angle_diagram"].readings["max_rise"].value) == pytest.approx(greatest, abs=0.005)


@each_rotation
def test_a_law_that_is_drawn_without_error_gives_the_exact_arm(rotation):
    """Constant acceleration: angles at all stations and pitch points to rounding, so both sides share a frame."""
    chain = published(rotation, 12)
    stations = chain.board.stations
    exact = gc.Cam(chain.board.motion, gc.Oscillating(125, 150, 15), 61, rotation).at(stations.phase, stations.u)
    assert_allclose(chain["pressure_angle"].readings["alpha"].value, exact.pressure_angle, atol=1e-14)
    pitch = np.stack([chain["inversion"].readings[key].value for key in "xy"], axis=-1)
    assert_allclose(pitch, exact.pitch, atol=1e-12)


# --- convergence -----------------------------------------------------------------------------------------------------


def error_of_angles(chain: Chain, cam: gc.Cam) -> float:
    stations = chain.board.stations
    exact = cam.at(stations.phase, stations.u).pressure_angle
    return float(np.abs(chain["pressure_angle"].readings["alpha"].value - exact).max())


def error_of_pitch_points(chain: Chain, cam: gc.Cam) -> float:
    readings, stations = chain["inversion"].readings, chain.board.stations
    return float(np.abs(readings["x"].value + UP * readings["y"].value - cam.pitch_curve(stations.phi) @ [1, 1j]).max())


def error_of_profile(chain: Chain, cam: gc.Cam) -> float:
    touch = chain["working_profile"].points["touch"] * chain["inversion"].givens.mu_l.per_mm
    return float(distance_from_profile(cam, touch, chain.board.stations.phi).max())


@each_rotation
@over_all("error", [error_of_angles, error_of_pitch_points, error_of_profile])
def test_the_error_of_a_cycloidal_arm_falls_with_the_second_order(error, rotation):
    errors = [error(drawn("cycloidal", rotation, n), cam_of("cycloidal", rotation)) for n in PARTS]
    assert order(PARTS, errors) == pytest.approx(2.0, abs=0.15)


def test_the_profile_of_an_arm_with_constant_acceleration_is_drawn_to_the_fourth_order():
    """Its pitch points are exact, so only the direction of the touch errs."""
    errors = [error_of_profile(drawn("rectangular", n=n), cam_of("rectangular")) for n in PARTS]
    assert order(PARTS, errors) == pytest.approx(4.0, abs=0.2)


# --- the least radius ------------------------------------------------------------------------------------------------

PROBLEMS = {
    "free, force": (None, limits(45)),
    "free, form": (None, limits(45, 35)),
    "fixed, force": (120.0, limits(45, rest=False)),  # with it the rest binds here alone, which is drawn exactly
    "fixed, form": (120.0, limits(45, 45)),
}
CONSTANTS = {
    # The greatest n^2 |error| of the least radius [mm] for an arm of 100 mm, over both rotations.
    "triangular": (8.2, 13.6, 12.7, 12.7),
    "cosine": (18.9, 35.7, 13.6, 16.0),
    "cycloidal": (8.6, 14.2, 13.7, 13.7),
    "trapezoidal": (29.2, 57.8, 41.7, 41.7),
    "modified-trapezoidal": (37.0, 46.0, 29.8, 29.8),
    "modified-sine": (24.6, 44.5, 23.3, 25.5),
    "2-3": (23.7, 44.3, 18.8, 21.7),
    "3-4-5": (21.8, 38.0, 22.5, 23.3),
    "4-5-6-7": (30.1, 53.8, 30.7, 20.4),
    "double-harmonic": (29.0, 54.8, 17.0, 17.2),
    "eighth-degree": (5.7, 11.9, 4.2, 4.2),
    # Its s and v are drawn without error; the lines faired between the stations still err where they bind.
    "rectangular": (0.0, 0.4, 0.32, 1.25),
}


def region_of(law: str, problem: str, rotation: str, n: int):
    distance, permitted = PROBLEMS[problem]
    board = arm_board(arm_motion(law), distance, limits=permitted, rotation=rotation, divisions=n)
    return Chain(board)["minimum_radius"]


@cache
def exact_least(law: str, problem: str, rotation: str):
    distance, permitted = PROBLEMS[problem]
    return gc.minimum_radius(
        arm_motion(law), gc.Oscillating(ARM, distance), rotation, permitted.rise, permitted.return_, rest=permitted.rest
    )


@over_all("problem", PROBLEMS)
@over_all("law", CONSTANTS)
def test_the_least_radius_of_an_arm_is_within_its_constant_over_n_squared(law, problem):
    constant = CONSTANTS[law][list(PROBLEMS).index(problem)]
    scaled = [
        n * n * abs(region_of(law, problem, rotation, n).readings["prime_radius"].value - exact.prime_radius)
        for rotation in ("ccw", "cw")
        for exact in [exact_least(law, problem, rotation)]
        for n in FINER
    ]
    assert 0.8 * constant <= max(scaled) < constant + 1e-8  # the constant is one, not merely a large number


@over_all("law", ["cosine", "cycloidal", "3-4-5", "2-3"])
def test_where_one_line_binds_the_distance_is_found_to_the_first_order(law):
    """The place nearest to the start is the foot on one of the lines, and the next line stands a fixed step apart."""
    assert exact_least(law, "free, force", "cw").active == ("rise",)
    exact = exact_least(law, "free, force", "cw").distance
    scaled = [n * abs(region_of(law, "free, force", "cw", n).readings["distance"].value - exact) for n in FINER]
    assert 0.6 < max(scaled) < 1.4


@over_all("law", ["rectangular", "cycloidal", "3-4-5"])
@each_rotation
def test_from_the_plotted_lines_alone_the_least_radius_of_an_arm_is_too_small(law, rotation):
    """Fewer lines cut off less, so the lines at the stations alone permit too small a cam, by an erratic amount."""
    exact = exact_least(law, "free, form", rotation).prime_radius
    missing = []
    for n in FINER:
        region = region_of(law, "free, form", rotation, n)
        alone = plotted_alone(region)
        assert alone <= float(region.readings["prime_radius"].value) + EXACT
        missing.append(exact - alone)
    assert min(missing) > -1e-9  # none is safe; where the switch is plotted and binds it is just the least one
    if law != "rectangular":
        scaled = np.array(missing) * np.square(FINER)
        assert scaled.max() > 1.5 * scaled.min() > 0


def plotted_alone(region) -> float:
    """The least radius [mm] from the lines at the stations, without fairing between them."""
    names = [name.removeprefix("touch of ") for name in region.points if name.startswith("touch of ")]
    step = {name: 1 if name.startswith("rest") else 8 for name in names}
    touches, inwards = (
        np.concatenate([region.points[f"{part} of {name}"][:: step[name]] for name in names])
        for part in ("touch", "inward")
    )
    place, _ = nearest_for_many(touches, inwards, region.points["start"])
    return float(np.abs(place - region.points["start"])) * region.givens.mu_l.per_mm


# --- theorems --------------------------------------------------------------------------------------------------------


@each_rotation
@over_all("law", ["cycloidal", "rectangular", "2-3"])
def test_the_plans_closing_side_is_perpendicular_to_da(rotation, law):
    """Plan and mechanism are similar with perpendicular sides: V_B - V_Bx is square to D A, which is the normal."""
    steps = {str(step.title).split(" at ")[0]: step for step in drawn(law, rotation)["pressure_angle"].steps()}
    across, along, closing = (m.end - m.start for m in steps["Velocity plan"].marks if isinstance(m, Arrow))
    lines = {m.role: m.points for m in steps["The mechanism"].marks if isinstance(m, Line)}
    b, d = lines[Role.RESULT]
    pivot = lines[Role.AXIS][1]
    assert closing == pytest.approx(along - across, rel=1e-14)  # V_B = V_Bx + V_BBx
    assert abs(dot(closing, d)) < 1e-9 * abs(closing) * abs(d)
    assert abs(dot(across, b)) < 1e-9  # across the radius A B
    assert abs(dot(along, b - pivot)) < 1e-9  # across the arm
    assert abs(along) == pytest.approx(abs(d - b), rel=1e-12)
    assert d - b == pytest.approx(1j * sense(rotation) * along, rel=1e-9)  # V_B turned in the sense of the rotation


@each_rotation
def test_on_a_rise_the_segments_point_outward_only_when_cam_and_arm_turn_in_opposite_senses(rotation):
    region = drawn("cycloidal", rotation)["minimum_radius"]
    ends, tips, rise = region.points["ends"], region.points["tips"], drawn("cycloidal").board.stations.phases[0]
    outward = (np.abs(tips) - np.abs(ends))[rise]
    assert np.all(sense(rotation) * outward[1:-1] > 0)
    side = " ".join(str(step.caption) for step in region.steps())
    assert ("on the rise away from C" if rotation == "ccw" else "on the rise towards C") in side


@each_rotation
def test_start_points_lie_on_the_prime_circle_at_the_arms_length_from_their_pivots(rotation):
    chain = drawn("3-4-5", rotation)
    inverted, phi = chain["inversion"], chain.board.stations.phi
    pivots, starts, pitch = (inverted.points[name] for name in ("pivots", "starts", "pitch"))
    mu = inverted.givens.mu_l.per_mm
    assert_allclose(np.abs(pivots), 120 / mu, rtol=1e-14)
    assert_allclose(np.abs(starts), 45 / mu, rtol=1e-14)
    assert_allclose(np.abs(starts - pivots), ARM / mu, rtol=1e-14)
    assert_allclose(np.abs(pitch - pivots), ARM / mu, rtol=1e-14)
    # Turned by the displacement, away from the cam.
    turn = np.angle((pitch - pivots) / (starts - pivots))
    assert_allclose(turn, -chain["integration"].readings["s"].value, atol=1e-14)
    # Numbered against the rotation, by the cam angle.
    assert_allclose(np.unwrap(np.angle(pivots / pivots[0])), -sense(rotation) * phi, atol=1e-13)


def test_cam_angles_are_no_polar_angles_of_an_arms_pitch_curve():
    """The common mistake: the polar angles of the points differ from the cam angles by degrees."""
    chain = drawn("3-4-5")
    polar = np.unwrap(chain["inversion"].readings["polar_angle"].value)
    shift = np.degrees(np.abs((polar - polar[0]) + chain.board.stations.phi))
    assert shift[0] == 0
    assert shift[:-1].max() > 2.9


@each_rotation
@over_all("problem", PROBLEMS)
@over_all("law", ["cosine", "rectangular", "4-5-6-7"])
def test_no_line_cuts_the_cam_centre_off(law, problem, rotation):
    """Seen from every D, A makes no more than the permitted angle with the arm's normal."""
    region = region_of(law, problem, rotation, 24)
    ends, tips, centre = (region.points[name] for name in ("ends", "tips", "centre"))
    seen = (centre - tips) / (UP * unit(ends))  # against the arm's normal, towards the cam
    motion, stations = region.givens.integrated.givens.motion, region.givens.integrated.givens.stations
    direction = np.array([motion.phases[k].direction for k in stations.phase])
    drives = sense(rotation) * direction
    alpha = drives * np.angle(seen)
    _, permitted = PROBLEMS[problem]
    assert np.max(alpha[direction > 0]) <= permitted.rise + 1e-9
    if permitted.return_ is not None:
        assert np.max(alpha[direction < 0]) <= permitted.return_ + 1e-9
    touches, inwards = (
        np.concatenate([np.ravel(points) for name, points in region.points.items() if name.startswith(part)])
        for part in ("touch of", "inward of")
    )
    clearance = dot(inwards, complex(centre) - touches)
    assert clearance.min() == pytest.approx(0, abs=1e-8)  # and one line at least just touches it


def test_the_region_of_a_longer_arm_is_the_same_region_enlarged():
    region = region_of("3-4-5", "free, form", "ccw", 12)
    board = arm_board(arm_motion("3-4-5"), None, 2.5 * ARM, limits=limits(45, 35))
    longer = Chain(board)["minimum_radius"]
    for name in ("prime_radius", "distance"):
        assert longer.readings[name].value == pytest.approx(2.5 * float(region.readings[name].value), rel=1e-12)


@over_all("law", ["cosine", "cycloidal", "3-4-5", "rectangular"])
def test_a_cam_that_turns_the_other_way_gives_the_motion_backwards(law):
    """An arm has no mirror image, but the same cam turned the other way runs through its motion backwards."""
    forwards = arm_motion_of((20, 90, law), (0, 40), (-20, 80, law), (0, 150))
    backwards = arm_motion_of((20, 80, law), (0, 40), (-20, 90, law), (0, 150))
    ccw = Chain(arm_board(forwards, rotation="ccw"), decided=SIZES)
    cw = Chain(arm_board(backwards, rotation="cw"), decided=SIZES)
    alpha, backwards_alpha = (chain["pressure_angle"].readings["alpha"].value for chain in (ccw, cw))
    assert_allclose(backwards_alpha[::-1], alpha, atol=1e-12)
    # The motion backwards begins where the return ended, at 210 degrees.
    ahead = np.exp(1j * math.radians(210))
    for name, point in (("inversion", "pitch"), ("working_profile", "touch")):
        # At a jump the touch is found from the piece before it, which backwards is the other one.
        atol = 0.02 if (law, point) == ("rectangular", "touch") else 1e-9
        assert_allclose(cw[name].points[point][::-1], ccw[name].points[point] * ahead, atol=atol)
    rise, back = limits(40, 35), limits(35, 40)
    least = [
        float(Chain(arm_board(motion, None, rotation=rotation, limits=permitted))["minimum_radius"].value(name))
        for motion, rotation, permitted in ((forwards, "ccw", rise), (backwards, "cw", back))
        for name in ("prime_radius", "distance")
    ]
    assert least[:2] == pytest.approx(least[2:], rel=1e-9)


def test_without_the_rest_condition_the_arm_still_has_to_reach_the_cam():
    """A large swing and a small limit: the place nearest to the start lies on the arm's own line, so r0 = c - l."""
    motion, permitted = arm_motion_of((60, 90, "cosine"), (0, 40), (-60, 80, "cosine")), limits(15, rest=False)
    exact = gc.minimum_radius(motion, gc.Oscillating(ARM), "ccw", permitted.rise, rest=False)
    chain = Chain(arm_board(motion, None, limits=permitted, divisions=48))
    region = chain["minimum_radius"]
    assert region.points["centre"].imag == pytest.approx(0, abs=1e-9)
    assert region.readings["prime_radius"].value == pytest.approx(exact.prime_radius, abs=150 / 48**2)
    assert exact.prime_radius == pytest.approx(exact.distance - ARM, rel=1e-12)
    assert chain.prime_radius > chain.place - ARM  # adopted so that the mechanism closes


@over_all(
    ("lift", "rotation", "permitted"),
    [(11.5, "ccw", limits(28.455, 27.937)), (20.0, "cw", limits(45, 35)), (42.5, "cw", limits(38.7))],
)
def test_the_distance_is_adopted_so_that_some_radius_goes_with_it(lift, rotation, permitted):
    """The least radius lies at the end of the region: at the next round number below there may be none of it."""
    motion = arm_motion("cycloidal", lift)
    for rounding in (None, 1.0, 5.0, 20.0):
        chain = Chain(arm_board(motion, None, limits=permitted, rotation=rotation, divisions=48, rounding=rounding))
        proposed = float(chain["minimum_radius"].value("distance"))
        # One further where the radius, rounded up, would leave the arc that the limits permit at the nearest distance.
        assert abs(chain.place - proposed) < 2 * chain.rounding
        least = gc.minimum_radius(
            motion, gc.Oscillating(ARM, chain.place), rotation, permitted.rise, permitted.return_
        ).prime_radius
        assert least - 60 / 48**2 < chain.prime_radius < least + chain.rounding + 60 / 48**2


# --- what cannot be --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("motion", "distance", "permitted"),
    [
        (arm_motion("rectangular"), 120.0, limits(45, 35)),
        (arm_motion("cosine"), 30.0, limits(20)),
        (arm_motion("cosine", lift=40.0), None, limits(15)),
    ],
    ids=["no arc", "pivot inside", "swing too large"],
)
def test_limits_that_no_cam_keeps_leave_no_radius_to_adopt(motion, distance, permitted):
    with pytest.raises(DesignError):
        gc.minimum_radius(motion, gc.Oscillating(ARM, distance), "cw", permitted.rise, permitted.return_)
    board = arm_board(motion, distance, limits=permitted, rotation="cw")
    region = Chain(board)["minimum_radius"]
    assert np.isnan(region.readings["prime_radius"].value)
    last = region.steps()[-1]
    where = "At this centre distance no" if distance is not None else "No"
    arc = (
        ""
        if distance is None
        else f"Draw an arc of {distance:.1f} mm about C with the compass, for c = {distance:g} mm. "
    )
    assert str(last.caption) == f"{arc}{where} cam centre satisfies all the limits."
    assert [type(mark) for mark in last.marks] == ([Arc] if distance is not None else [])  # it misses the hatching
    with pytest.raises(DesignError, match=r"minimum prime radius .* give .*cam.prime_radius"):
        _ = Chain(board).prime_radius
    with pytest.raises(DesignError, match="minimum prime radius"):
        _ = Chain(board)["inversion"]


def test_a_given_arm_is_drawn_though_no_radius_keeps_the_limits():
    board = arm_board(arm_motion("rectangular"), 120.0, limits=limits(45, 35), rotation="cw", prime_radius=45.0)
    chain = Chain(board)
    assert np.isnan(chain["minimum_radius"].readings["prime_radius"].value)
    for name in ("pressure_angle", "angle_diagram", "inversion", "working_profile"):
        assert all(np.isfinite(kept.value).all() for kept in chain[name].readings.values()), name


def test_a_miss_of_one_hand_is_its_own():
    """At a distance that hardly keeps the limits some hands find a centre and some do not."""
    motion, hands = arm_motion("rectangular"), Pencil(line=0.2, dividers=0.2, samples=200, seed=1)
    least = gc.minimum_radius(motion, gc.Oscillating(ARM), "cw", math.radians(45), math.radians(35))
    board = arm_board(motion, least.distance, limits=limits(45, 35), rotation="cw")
    found = Chain(board, hands)["minimum_radius"].readings["prime_radius"].value
    assert 5 <= np.isnan(found).sum() <= 195
    assert np.nanmedian(found) == pytest.approx(least.prime_radius, rel=0.05)


# --- hands -----------------------------------------------------------------------------------------------------------


def test_the_scatter_of_an_arm_is_proportional_to_the_pencil():
    scatter = []
    for sigma in (0.05, 0.1):
        hands = Pencil(line=sigma, dividers=sigma, protractor=sigma / 100, samples=1000)
        chain = Chain(arm_board(arm_motion("3-4-5"), None, limits=limits(45, 35)), hands)
        scatter.append(
            [chain["minimum_radius"].readings[name].value.std() for name in ("prime_radius", "distance")]
            + [chain["inversion"].readings[name].value.std(axis=0).max() for name in ("x", "y", "radius")]
            + [chain["angle_diagram"].readings["max_rise"].value.std()]
        )
    assert np.array(scatter[1]) / scatter[0] == pytest.approx(np.full(6, 2.0), rel=0.1)


def test_many_hands_agree_on_the_arm_within_their_scatter():
    hands = Pencil(line=0.05, dividers=0.05, samples=1000)
    exact = exact_least("cycloidal", "free, form", "ccw")
    readings = region_by(hands).readings
    for name in ("prime_radius", "distance"):
        values = readings[name].value
        assert values.mean() == pytest.approx(getattr(exact, name), abs=14.2 / 24**2 + values.std())
        assert 0.1 < values.std() < 1.0  # of an arm of 100 mm, by a hand of 0.05 mm


def region_by(pencil: Pencil):
    integrated = Chain(arm_board(arm_motion("cycloidal"), divisions=24), pencil)["integration"]
    return arm_least_radius(integrated, "ccw", limits(45, 35), ARM, None, Scale(1.0, "mm"), pencil)


def test_the_scale_of_the_drawing_changes_no_angle_and_no_size():
    """Similar figures: at 1:2 and at 2:1 the same cam is read."""
    board = arm_board(arm_motion("3-4-5"))
    small, large = (Chain(replace(board, paper=Paper(room, room, GOST_2_302))) for room in (150.0, 700.0))
    assert small["inversion"].givens.mu_l.per_mm >= 2 * large["inversion"].givens.mu_l.per_mm
    for name in ("minimum_radius", "pressure_angle", "inversion", "curvature", "working_profile"):
        for key, read in small[name].readings.items():
            assert_allclose(
                read.value, large[name].readings[key].value, rtol=1e-10, atol=1e-10, err_msg=f"{name}.{key}"
            )

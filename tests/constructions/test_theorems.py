"""What must hold in every drawing, whatever the cam: the geometry that the textbooks prove."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from boards import SIZES, board_of, coursework, coursework_motion, motion_of
from numpy.testing import assert_allclose
from over_all import over_all

import graphcam as gc
from graphcam.constructions.chain import AdoptedSizes, Chain
from graphcam.constructions.profile_view import piecewise_curve
from graphcam.drafting.hand import errorless_hand
from graphcam.drafting.marks import Arrow, Line, Role
from graphcam.drafting.scale import Scale
from graphcam.given.follower import sense

SIDES = [("ccw", 10.0), ("ccw", -10.0), ("cw", 10.0), ("cw", -10.0), ("ccw", 0.0), ("cw", 0.0)]
every_side = over_all(("rotation", "offset"), SIDES)


def chain_of(rotation: str, offset: float, law: str = "3-4-5", n: int = 12, **changes) -> Chain:
    board = coursework(law, rotation=rotation, offset=offset, divisions=n, **changes)
    return Chain(board, decided=AdoptedSizes(46.0, offset, 12.0))


# --- acceleration and integration ------------------------------------------------------------------------------------


@over_all(("first", "second"), [("rectangular", "cosine"), ("cycloidal", "2-3"), ("cosine", "3-4-5")])
def test_the_ordinate_of_the_return_follows_from_closure(first, second):
    """y_rise/y_return = (C_rise/C_return)(F_return/F_rise)^2 for equal lifts."""
    board = board_of(motion_of((30, 80, first), (0, 45), (-30, 60, second)))
    rise, return_ = Chain(board)["acceleration"].readings["greatest"].paper
    assert rise == 50.0
    ratio = gc.law(first).peak_acceleration / gc.law(second).peak_acceleration * (60 / 80) ** 2
    assert rise / return_ == pytest.approx(ratio, rel=1e-14)


def test_every_chord_is_parallel_to_its_ray():
    board = replace(coursework("modified-sine"), poles=(40.0, 30.0))
    stations, points = board.stations, Chain(board)["integration"].points
    for projected, chords, pole in (("a_projected", "v_chords", 40.0), ("v_projected", "s_chords", 30.0)):
        chord = points[chords][stations.left + 1] - points[chords][stations.left]
        ray = pole + 1j * points[projected].imag
        assert_allclose(np.angle(chord / ray), 0, atol=1e-14)


def test_the_scales_follow_through_the_poles():
    board = replace(coursework("cosine"), poles=(35.0, 45.0), mu_phi=Scale(math.radians(2), "rad"))
    readings = Chain(board)["integration"].readings
    mu_s, mu_v, mu_a = (float(readings[name].scale) for name in "sva")
    assert mu_v == pytest.approx(mu_s / (math.radians(2) * 45), rel=1e-15)
    assert mu_a == pytest.approx(mu_v / (math.radians(2) * 35), rel=1e-15)
    assert readings["s"].value.max() == pytest.approx(30, rel=1e-15)  # the known lift fixes the scale


@over_all("choice", [{"ordinate": 23.0}, {"poles": (57.3, 31.0)}, {"mu_phi": Scale(math.radians(2), "rad")}])
def test_the_draughtsmans_choices_change_the_paper_but_no_machine_value(choice):
    before = Chain(coursework("cycloidal"), decided=SIZES)
    after = Chain(coursework("cycloidal", **choice), decided=SIZES)
    for name in ("integration", "minimum_radius", "pressure_angle", "angle_diagram", "inversion", "curvature"):
        for key, kept in before[name].readings.items():
            if not key.startswith("closing"):
                assert_allclose(after[name].readings[key].value, kept.value, rtol=1e-11, atol=1e-11, err_msg=key)
    assert not np.allclose(before["integration"].readings["s"].paper, after["integration"].readings["s"].paper)


def test_the_closing_error_is_shown_and_shared_out_along_the_returns():
    phases = (30, 80, "3-4-5"), (0, 45), (-10, 40, "cosine"), (0, 20), (-20, 60, "cycloidal")
    drawn = Chain(board_of(motion_of(*phases), divisions=4))["integration"]
    stations, closing = drawn.givens.stations, float(drawn.readings["closing_s"].paper)
    assert abs(closing) > 0.5  # four parts are few
    chords, curve = drawn.points["s_chords"].imag, drawn.points["s_curve"].imag
    assert chords[-1] == pytest.approx(closing, rel=1e-12)
    assert curve[-1] == pytest.approx(0, abs=1e-12)
    x = drawn.points["s_curve"].real
    slopes = [np.polyfit(x[span], (chords - curve)[span], 1)[0] for span in stations.phases]
    assert slopes == pytest.approx([0, closing / 100, closing / 100], abs=1e-12)  # 40 + 60 mm of returns
    # The follower rests at one height in a dwell.
    assert curve[stations.phases[1].stop - 1] == pytest.approx(curve[stations.phases[2].start], rel=1e-12)


def test_a_velocity_left_at_the_end_of_a_phase_is_taken_up_by_its_base_line():
    drawn = Chain(board_of(motion_of((30, 80, "trapezoidal"), (-30, 60, "2-3")), divisions=5), gc.Pencil(line=0.3))
    readings, points = drawn["integration"].readings, drawn["integration"].points
    stations = drawn.board.stations
    closing = readings["closing_v"].paper
    assert np.abs(closing).min() > 0.05
    assert_allclose(points["v_chords"].imag[stations.last], closing, rtol=1e-14)
    assert_allclose(points["v_curve"].imag[stations.last], 0, atol=1e-14)


# --- velocity plan ---------------------------------------------------------------------------------------------------


@every_side
@over_all("law", ["cycloidal", "rectangular"])
def test_the_plans_closing_side_is_perpendicular_to_da(rotation, offset, law):
    """The plan and the triangle of the mechanism have perpendicular sides."""
    _, _, mechanism, plan, normal, angle, _ = chain_of(rotation, offset, law)["pressure_angle"].steps()
    across, along, closing = (m.end - m.start for m in plan.marks if isinstance(m, Arrow))
    drawn = (m for step in (mechanism, normal) for m in step.marks)
    lines = [m.points for m in drawn if isinstance(m, Line) and m.role is Role.CURVE]
    ab, ac = (line[1] - line[0] for line in lines)
    bd, da = (line.points[1] - line.points[0] for line in angle.marks[:2])
    assert closing == pytest.approx(along - across, rel=1e-14)  # V_B = V_Bx + V_BBx
    assert abs((closing * np.conj(da)).real) < 1e-9
    assert abs((across * np.conj(ab)).real) < 1e-9  # across the radius
    assert abs(along.real) < 1e-12  # along the guide
    assert abs(along) == pytest.approx(abs(ac), rel=1e-12)  # AC = ds/dphi
    assert bd == pytest.approx(1j * sense(rotation) * along, rel=1e-9)  # V_B turned in the sense of the rotation


@every_side
def test_the_angle_of_the_plan_is_the_angle_on_the_profile(rotation, offset):
    """The normal through the contact point has the angle that the plan gave without a profile."""
    chain = chain_of(rotation, offset, "4-5-6-7", n=96)
    pitch, feet = chain["inversion"].points["pitch"], chain["inversion"].points["feet"]
    towards = pitch - feet if offset else pitch  # along the follower's line
    normal = pitch - chain["working_profile"].points["touch"]
    on_profile = sense(rotation) * np.angle(normal / towards)
    assert np.degrees(np.abs(on_profile - chain["pressure_angle"].readings["alpha"].value)).max() < 0.05


@every_side
def test_the_angle_at_rest_is_that_of_the_cam_centre(rotation, offset):
    """tan(alpha) = -sigma e/s0 where the follower rests below."""
    measured = chain_of(rotation, offset)["pressure_angle"]
    expected = math.atan2(-sense(rotation) * offset, math.sqrt(46**2 - offset**2))
    assert_allclose(measured.readings["alpha"].value[[0, -1]], expected, atol=1e-12)
    assert measured.readings["s0"].value == pytest.approx(math.sqrt(46**2 - offset**2), rel=1e-14)


def test_the_angle_at_rest_of_a_published_cam():
    """Tran Minh Quang, Nguyen Quang Hung 2015: prime radius 95, offset 20: 12.15 degrees."""
    board = board_of(motion_of((12, 120, "cosine"), (0, 60), (-12, 120, "cosine")), rotation="ccw", offset=20.0)
    alpha = Chain(board, decided=AdoptedSizes(95.0, 20.0, 15.0))["pressure_angle"].readings["alpha"].value
    assert math.degrees(alpha[0]) == pytest.approx(-12.153197469007869, rel=1e-12)


@over_all(("offset", "greatest"), [(10.0, 22.79), (-10.0, 37.04)])
def test_the_greatest_angles_of_a_lecture_script(offset, greatest):
    """The case offset-roller: cosine rise, constant-acceleration return; the second is the offset on the wrong side."""
    motion = motion_of((50, 120, "cosine"), (0, 90), (-50, 90, "rectangular"))
    chain = Chain(
        board_of(motion, rotation="ccw", offset=offset, divisions=96), decided=AdoptedSizes(45.0, offset, 6.0)
    )
    diagram = chain["angle_diagram"]
    assert np.degrees(diagram.readings["max_rise"].value) == pytest.approx(greatest, abs=0.01)
    if offset > 0:
        assert np.degrees(diagram.readings["max_return"].value) == pytest.approx(-46.92, abs=0.01)
        assert diagram.points["max_rise"].real == pytest.approx(49.6, abs=0.1)  # 1 mm is 1 degree
        assert diagram.points["max_return"].real == pytest.approx(255, abs=0.01)


# --- inversion, roller -----------------------------------------------------------------------------------------------


@every_side
def test_the_inverted_line_touches_the_circle_of_the_offset(rotation, offset):
    inverted = chain_of(rotation, offset)["inversion"]
    feet, starts, pitch = (inverted.points[name] for name in ("feet", "starts", "pitch"))
    mu = inverted.givens.mu_l.per_mm
    assert_allclose(np.abs(feet), abs(offset) / mu, rtol=1e-14)
    assert_allclose((feet * np.conj(pitch - feet)).real, 0, atol=1e-11)
    assert_allclose(np.abs(starts), 46 / mu, rtol=1e-14)
    # Numbered against the rotation, by the cam angle.
    turn = np.unwrap(np.angle(starts / starts[0]))
    assert_allclose(turn, -sense(rotation) * inverted.givens.integrated.givens.stations.phi, atol=1e-13)


@over_all("rotation", ["ccw", "cw"])
def test_pitch_points_of_a_central_follower_lie_at_the_prime_radius_and_the_displacement(rotation):
    chain = chain_of(rotation, 0.0)
    s, inverted = chain["integration"].readings["s"].value, chain["inversion"].readings
    assert_allclose(inverted["radius"].value, 46 + s, rtol=1e-14)
    expected = np.exp(1j * (math.pi / 2 - sense(rotation) * chain.board.stations.phi))
    assert_allclose(np.exp(1j * inverted["polar_angle"].value), expected, atol=1e-14)


@over_all("law", ["rectangular", "3-4-5"])
@over_all("offset", [10.0, -7.0, None])
def test_a_cam_that_turns_the_other_way_with_the_opposite_offset_is_the_mirror_image(law, offset):
    opposite = None if offset is None else -offset
    ccw = Chain(coursework(law, rotation="ccw", offset=offset))
    cw = Chain(coursework(law, rotation="cw", offset=opposite))
    assert cw.sizes == replace(ccw.sizes, place=-ccw.sizes.place)
    changed = {"offset": lambda e: -e, "x": lambda x: -x, "polar_angle": lambda t: math.pi - t}
    for name in ccw:
        for key, kept in ccw[name].readings.items():
            mirrored, value = cw[name].readings[key].value, changed.get(key, lambda same: same)(kept.value)
            if key == "polar_angle":
                mirrored, value = np.exp(1j * mirrored), np.exp(1j * value)
            assert_allclose(mirrored, value, rtol=1e-12, atol=1e-11, err_msg=f"{name} {key}")


@every_side
def test_touch_points_lie_at_the_roller_radius_from_their_centres_towards_the_cam(rotation, offset):
    profile = chain_of(rotation, offset)["working_profile"]
    pitch, touch = profile.givens.inverted.points["pitch"], profile.points["touch"]
    assert_allclose(np.abs(touch - pitch), 12 / profile.givens.inverted.givens.mu_l.per_mm, rtol=1e-13)
    assert np.all(np.abs(touch) < np.abs(pitch))


def test_a_knife_edge_runs_on_the_pitch_curve():
    chain = Chain(coursework("cosine", roller_radius=0.0))
    assert_allclose(chain["working_profile"].points["touch"], chain["inversion"].points["pitch"], rtol=1e-15)


@over_all("n", [12, 24, 48, 96])
@over_all("law", ["rectangular", "cycloidal", "3-4-5"])
def test_no_touch_point_of_a_sound_roller_is_covered(n, law):
    chain = Chain(coursework(law, divisions=n))
    assert np.isnan(chain["working_profile"].points["covered"]).all()


@over_all("n", [24, 36, 48, 96])
def test_touch_points_of_an_undercut_roller_are_covered_between_the_crossings(n):
    """The case undercut: the two branches cross at phi = 36.66 and 58.62, and at 93.83 and 107.08 degrees."""
    motion = motion_of((30, 60, "3-4-5"), (0, 30), (-30, 60, "3-4-5"))
    board = board_of(motion, rotation="ccw", offset=5.0, prime_radius=30.0, roller_radius=20.0, divisions=n)
    profile = Chain(board)["working_profile"]
    covered = ~np.isnan(profile.points["covered"])
    phi = np.degrees(board.stations.phi)
    part = 60 / n
    inside = ((phi > 36.66) & (phi < 58.62)) | ((phi > 93.83) & (phi < 107.08))
    edge = np.abs(phi[:, None] - [36.66, 58.62, 93.83, 107.08]).min(axis=1) < part
    assert covered[inside & ~edge].all()
    assert not covered[~inside & ~edge].any()
    assert np.isnan(profile.readings["radius"].value[covered]).all()
    _, _, envelope, *_ = profile.steps()
    assert "undercut" in str(envelope.caption)


@over_all("missing", [[12], [13], [12, 13]])
def test_a_dwells_arc_is_drawn_from_the_end_that_was_touched(missing):
    profile = chain_of("cw", -10.0)["working_profile"]
    touch, nowhere = profile.acts["touch"], np.arange(profile.points["touch"].size)
    radius = abs(profile.points["touch"][12])
    nowhere[missing] = nowhere.size
    hand = errorless_hand(profile)
    touched = hand.take("touched", touch, hand.given("nowhere", [np.nan]), which=nowhere)
    line = piecewise_curve("profile", profile.givens.inverted, touched).whole.points
    assert np.isfinite(line).all()
    on_the_arc = line[np.abs(np.abs(line) - radius) < 1e-9]
    if len(missing) == 2:
        assert on_the_arc.size == 0
    else:
        assert np.degrees(np.ptp(np.unwrap(np.angle(on_the_arc)))) == pytest.approx(45.0)


def test_the_circle_of_curvature_passes_through_its_three_points():
    curved = Chain(coursework("3-4-5"))["curvature"]
    triple, centre = curved.points["triple"], curved.points["centre"]
    scale = curved.readings["rho"].scale
    assert_allclose(np.abs(triple - centre) * scale, float(curved.readings["rho"].value), rtol=1e-12)


def test_where_the_cam_rests_the_circle_of_curvature_is_about_its_centre():
    """A dwell's arc may be sharper than every bend of the moving phases."""
    board = board_of(motion_of((2, 120, "3-4-5"), (0, 60), (-2, 120, "3-4-5")), offset=0.0)
    curved = Chain(board, decided=AdoptedSizes(46.0, 0.0, 12.0))["curvature"]
    moving, resting = curved.readings["rho_candidates"].value
    assert resting == pytest.approx(46.0, rel=1e-12)
    assert curved.readings["rho"].value == min(moving, resting)


def test_exact_and_drawn_curve_are_the_same_curve():
    """Points of a law that is drawn without error lie on the exact curve: the two sides share a frame."""
    for rotation, offset in SIDES:
        chain = chain_of(rotation, offset, "rectangular")
        cam = gc.Cam(coursework_motion("rectangular"), gc.Translating(offset, 12), 46, rotation)
        readings = chain["inversion"].readings
        drawn = np.stack([readings["x"].value, readings["y"].value], axis=-1)
        assert_allclose(drawn, cam.pitch_curve(chain.board.stations.phi), atol=1e-11)

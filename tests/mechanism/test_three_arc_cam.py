"""Cams of three arcs: the published examples, tangency, both roots at 50 digits, and the motion of a roller on them."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from mpmath import mpf
from over_all import over_all
from three_arcs import CASE, EXAMPLE, given, sound_data

import graphcam as gc
from graphcam.mechanism.three_arc_cam import three_arc_cam

COMPUTED = 1e-12
"""mm, of the digits computed for the printed data"""
EPS = 2.0**-52
SOUND = list(sound_data(40))
IN_CASES = {1: (), 2: ("C2",), 3: ("C1",), 4: ("C1", "C2")}


# --- published examples ----------------------------------------------------------------------------------------------


def test_example_1_to_all_computed_digits():
    cam, other = three_arc_cam(**EXAMPLE)
    assert pytest.approx(CASE["computed_F"], abs=COMPUTED) == cam.F
    assert pytest.approx(CASE["computed_C3"], abs=COMPUTED) == cam.C3
    assert pytest.approx(CASE["computed_unsound_C3"], abs=COMPUTED) == other.C3
    assert (cam.sound, other.sound) == (True, False)
    # What is printed follows from data with more digits than are printed.
    off_f, off_c3 = np.abs(cam.F - CASE["F"]).max(), np.abs(cam.C3 - CASE["C3"]).max()
    assert 0.01 < off_f < CASE["printed_rounding"][0]
    assert 0.01 < off_c3 < CASE["printed_rounding"][1]


def test_example_2_finds_c2_on_the_line_oa():
    cam, _ = three_arc_cam(**given(EXAMPLE, "C2"))
    assert cam.C2[0] == 0
    assert cam.C2[1] == pytest.approx(CASE["computed_C2y"], abs=COMPUTED)
    assert np.abs(cam.F - CASE["F"]).max() < CASE["printed_rounding"][0]
    assert np.abs(cam.C3 - CASE["C3"]).max() < CASE["printed_rounding"][1]


def test_the_examples_give_the_printed_lift_base_circle_and_phases():
    half_a_hundredth = 0.005
    for left_out in IN_CASES.values():
        motion = three_arc_cam(**given(EXAMPLE, *left_out))[0].motion(roller_radius=10, dwell=math.radians(40))
        assert motion.prime_radius - 10 == pytest.approx(CASE["base_radius"], abs=half_a_hundredth)
        assert motion.lift == pytest.approx(CASE["lift"], abs=2 * half_a_hundredth)  # a difference of two radii
        assert math.degrees(motion.rise) == pytest.approx(CASE["phases"][0], abs=half_a_hundredth)


def test_the_reason_of_the_other_root_names_both_orders_and_what_would_happen():
    assert three_arc_cam(**EXAMPLE)[1].why == (
        "On the line of F, C₁ and C₃ the order is C₁, F, C₃ instead of F, C₁, C₃: "
        "the profile would turn back in a cusp at F."
    )


# --- geometry --------------------------------------------------------------------------------------------------------


def test_a_cam_built_forwards_is_found_again_in_every_design_case():
    for data in SOUND:
        size = math.hypot(*data["C2"]) + math.hypot(*data["D"])
        for case, left_out in IN_CASES.items():
            cam, _ = three_arc_cam(**given(data, *left_out))
            assert cam.given.design_case == case
            assert cam.sound
            for name in ("A", "D", "C1", "C2", "C3", "F"):
                assert np.abs(getattr(cam, name) - data[name]).max() < 1e-11 * size, name


def conditions(data: dict, k) -> tuple:
    """t and F at 50 digits from the tangency alone: |G + t n - C1| = |t - k|, by squaring nothing but the distances."""
    with mpmath.workdps(50):
        g, c1, c2 = (mpmath.mpc(*data[name]) for name in ("G", "C1", "C2"))
        n, k = (c2 - g) / abs(c2 - g), mpf(k)
        # The difference of the squares is linear in t: two values of it tell the root.
        at = [abs(g + t * n - c1) ** 2 - (t - k) ** 2 for t in (mpf(0), mpf(1))]
        t = at[0] / (at[0] - at[1])
        c3 = g + t * n
        f = c1 - k * (c3 - c1) / (t - k)
        assert abs(abs(c3 - c1) - abs(t - k)) < mpf(10) ** -40 * (1 + abs(t))
        return t, c3, f


def random_data(count: int, seed: int = 3):
    random = np.random.default_rng(seed)
    for _ in range(count):
        D, G, C1, C2 = random.uniform(-100, 100, (4, 2)).tolist()
        yield {"D": D, "G": G, "C1": C1, "C2": C2, "rho1": random.uniform(1, 60)}


def test_both_roots_against_50_digits():
    for data in [*random_data(300), *(given(data) for data in SOUND)]:
        for cam, k in zip(three_arc_cam(**data), (data["rho1"], -data["rho1"]), strict=True):
            t, c3, f = conditions(data, k)
            # What the lengths' rounding does to t, through the angle at which bisector and line cross.
            bend = float(abs((k - abs(mpmath.mpc(*data["G"]) - mpmath.mpc(*data["C1"]))) / t)) + 1e-300
            amplified = 1e3 * EPS * max(200.0, float(abs(t))) * max(1.0, 1 / bend)
            assert abs(complex(*cam.C3) - complex(c3)) < amplified
            assert cam.rho3 == pytest.approx(float(abs(t)), abs=amplified)
            # P near C1 is what F is sensitive to.
            g, c1, c2 = (complex(*data[name]) for name in ("G", "C1", "C2"))
            near = abs(g - c1 + k * (c2 - g) / abs(c2 - g))
            assert abs(complex(*cam.F) - complex(f)) < 1e2 * EPS * 200 * max(1.0, 200 / near)


def test_circles_touch_where_their_centres_and_the_point_lie_on_a_line():
    """Euclid III.11 and III.12: the line of centres passes through the point of touching."""
    for data in random_data(300, seed=4):
        for cam in three_arc_cam(**data):
            scale = max(200.0, cam.rho3)
            assert math.dist(cam.F, cam.C1) == pytest.approx(cam.rho1, abs=1e-11 * scale)
            assert math.dist(cam.F, cam.C3) == pytest.approx(cam.rho3, abs=1e-11 * scale)
            between = math.dist(cam.C1, cam.C3)
            inside, outside = abs(cam.rho3 - cam.rho1), cam.rho3 + cam.rho1
            assert min(abs(between - inside), abs(between - outside)) < 1e-11 * scale
            assert math.dist(cam.G, cam.C3) == pytest.approx(cam.rho3, abs=1e-11 * scale)


def test_what_is_sound_is_decided_by_the_orders_on_the_lines_of_centres():
    def ordered(a, b, c) -> bool:
        return bool(np.dot(b - a, c - b) > 0 and math.dist(a, c) > max(math.dist(a, b), math.dist(b, c)))

    found = 0
    for data in [*random_data(2000, seed=5), *(given(data) for data in SOUND)]:
        roots = three_arc_cam(**data)
        assert len(roots) == 2
        for cam in roots:
            assert cam.sound == (ordered(cam.F, cam.C1, cam.C3) and ordered(cam.G, cam.C3, cam.C2)), data
            assert ("instead of" in cam.why) != cam.sound
            found += cam.sound
        assert not roots[1].sound
    assert found > 50


REASONS = {
    # w.n and the lengths by hand: G = (0, 30), C2 straight below, rho1 = 5.
    "hollow": ({"C1": (20, 29), "C2": (0, -50)}, "hollow"),
    "sharper than the first": ({"C1": (4, 20), "C2": (0, -50), "rho1": 12}, "more sharply than the first"),
    "flatter than the second": ({"C1": (20, 22), "C2": (0, -20)}, "flatter than the second"),
    "the straight flank": ({"C1": (20, 25), "C2": (0, -50)}, "straight"),
    "two arcs are enough": ({"C1": (0, 25), "C2": (0, -50)}, "nothing for a third"),
}


@over_all("name", REASONS)
def test_why_the_first_root_is_not_sound(name):
    change, reason = REASONS[name]
    cam, _ = three_arc_cam(**({"D": (40, 20), "G": (0, 30), "rho1": 5} | change))
    assert not cam.sound
    assert reason in cam.why
    with pytest.raises(gc.DesignError, match="root is not sound"):
        cam.motion()


def test_a_straight_flank_is_the_common_tangent():
    cam, _ = three_arc_cam(D=(40, 20), G=(0, 30), rho1=5, C1=(20, 25), C2=(0, -50))
    assert cam.straight
    assert cam.rho3 == math.inf
    assert np.isnan(cam.C3).all()
    assert cam.F.tolist() == [20, 30]


@over_all("tilt", [1e-3, 1e-6, 1e-9, 1e-12, -1e-12, -1e-6])
def test_a_flank_that_is_almost_straight_keeps_its_f_and_its_curvature(tilt):
    data = {"D": (40, 20), "G": (0, 30), "rho1": 5, "C1": (20, 25 - tilt), "C2": (0, -50)}
    cam, _ = three_arc_cam(**data)
    t, _, f = conditions(data, data["rho1"])
    # C1 is given to half a unit of its last digit, and so is the bend.
    last_digit = np.spacing(25.0)
    assert abs(complex(*cam.F) - complex(f)) < 4 * last_digit
    assert 1 / cam.rho3 == pytest.approx(float(1 / abs(t)), rel=last_digit / abs(tilt) + 8 * EPS)
    assert cam.hollow == (t < 0) == (tilt < 0)


# --- the roller on it ------------------------------------------------------------------------------------------------

KINEMATICS = list(sound_data(12, seed=9))


def runnable(data: dict, roller: float, dwell: float = 0.3):
    try:
        return three_arc_cam(**given(data))[0].motion(roller, dwell)
    except gc.DesignError as error:
        if error.quantity == "pressure angle":
            return None
        raise


MOTIONS = [m for data in KINEMATICS for roller in (0.0, 7.5) if (m := runnable(data, roller))]


def distance(data: dict, roller: float, arc: int, direction) -> mpf:
    """How far from the cam centre the ray in a direction leaves the circle of an arc, grown by the roller's radius."""
    centre = mpmath.mpc(*data[("C2", "C3", "C1")[arc]])
    point = mpmath.mpc(*data[("G", "F", "F")[arc]])
    along = (centre * mpmath.conj(direction)).real
    across = (centre * mpmath.conj(direction)).imag
    return along + mpmath.sqrt((abs(point - centre) + mpf(roller)) ** 2 - across**2)


def reference(motion, arc: int, phi, order: int) -> mpf:
    data = {name: getattr(motion.cam, name) for name in ("A", "G", "F", "C1", "C2", "C3")}
    start = mpmath.mpc(*data["A"]) / abs(mpmath.mpc(*data["A"]))

    def r(angle):
        return distance(data, motion.roller_radius, arc, start * mpmath.expj(-motion.sigma * angle))

    return mpmath.diff(r, mpf(phi), order) if order else r(mpf(phi)) - motion.prime_radius


def test_some_cams_can_be_run_on():
    assert len(MOTIONS) > 15
    assert {m.sigma for m in MOTIONS} == {-1, 1}


def test_lift_velocity_acceleration_and_jerk_against_differentiated_distances():
    for motion in MOTIONS:
        for arc in range(3):
            for share in (0.0, 0.3, 0.8, 1.0):
                start, end = motion.edges[arc : arc + 2]
                phi = start + share * (end - start)
                values = motion(phi, side="left" if share == 1 else "right")
                steep = 1 / math.cos(float(motion.max_pressure_angle()[0]))
                for order, value in enumerate(values):
                    expected = reference(motion, arc, phi, order)
                    tolerance = 2e-12 * steep ** (2 * order + 1) * motion.prime_radius * 10**order
                    assert float(value) == pytest.approx(float(expected), abs=tolerance), (arc, share, order)


def test_the_return_mirrors_the_rise_and_rests_are_at_rest():
    for motion in MOTIONS:
        phi = np.linspace(0, motion.rise, 50)
        up, down = motion(phi), motion(motion.edges[-1] - phi, side="left")
        for order, (a, b) in enumerate(zip(up, down, strict=True)):
            rounding = 1e-11 * max(1.0, float(np.abs(a).max()))
            # Beside an arc's change, the angle of the return is rounded to one side or the other.
            inside = np.min(np.abs(phi[:, None] - motion.edges[:4]), axis=1) > 1e-9
            assert np.allclose(a[inside], (-1) ** order * b[inside], atol=10**order * rounding)
        dwell = motion(motion.rise + np.array([0.0, 0.15, 0.29]))
        rest = motion((motion.edges[-1] + 2 * math.pi) / 2)
        assert dwell[0].tolist() == [motion.lift] * 3
        assert rest[0] == 0
        assert not np.any(dwell[1:])
        assert not np.any(rest[1:])


def test_arcs_that_touch_leave_the_velocity_continuous_and_the_acceleration_jumps_with_the_curvature():
    """Across a change from curvature kappa to kappa*, the acceleration jumps by r^2 (kappa - kappa*)/cos^3(alpha)."""
    for motion in MOTIONS:
        phi = motion.breaks
        s, v = (motion(phi, "left")[k] - motion(phi, "right")[k] for k in (0, 1))
        scale = motion.prime_radius / math.cos(motion.max_pressure_angle()[0]) ** 3
        assert np.abs(s).max() < 1e-12 * scale
        assert np.abs(v).max() < 1e-11 * scale
        radii = motion.roller_radius + np.array([motion.cam.rho2, motion.cam.rho3, motion.cam.rho1])
        circles = motion.prime_radius, *radii, motion.prime_radius + motion.lift
        for jump, before, after in zip(motion.jumps[:4], circles, circles[1:], strict=False):
            r = motion.prime_radius + motion(jump.phi)[0]
            expected = r**2 * (1 / before - 1 / after) / math.cos(motion.pressure_angle(jump.phi)) ** 3
            assert jump.size == pytest.approx(float(expected), rel=1e-9)
        assert len(motion.jumps) == 8


def test_the_pitch_curve_lies_a_roller_radius_outside_the_arcs():
    for motion in MOTIONS:
        cam, arcs = motion.cam, (("C2", "rho2"), ("C3", "rho3"), ("C1", "rho1"))
        for k, (centre, radius) in enumerate(arcs):
            phi = np.linspace(*motion.edges[k : k + 2], 20)[1:-1]
            away = np.linalg.norm(motion.pitch_curve(phi) - getattr(cam, centre), axis=-1)
            assert away == pytest.approx(getattr(cam, radius) + motion.roller_radius, rel=1e-12)


def test_extremes_are_not_exceeded_and_are_reached():
    for motion in MOTIONS:
        phi = np.concatenate([np.linspace(0, 2 * math.pi, 20001), motion.breaks])
        for (value, at), all_values in (
            (motion.max_velocity(), np.abs(motion(phi)[1])),
            (motion.max_acceleration(), np.maximum(np.abs(motion(phi)[2]), np.abs(motion(phi, "left")[2]))),
            (motion.max_pressure_angle(), np.abs(motion.pressure_angle(phi))),
        ):
            assert all_values.max() <= value * (1 + 1e-9)
            assert all_values.max() >= value * (1 - 1e-3)
            assert 0 <= at <= motion.rise


def test_an_ordinary_cam_with_the_same_motion_has_the_same_pitch_curve_and_curvature():
    """What the roller does on the arcs, given to a cam by inversion, is those arcs again: kappa = 1/(rho + R)."""
    from graphcam.mechanism.followers import kinematics

    motion = three_arc_cam(**EXAMPLE)[0].motion(10.0, math.radians(40))
    inverted = kinematics(gc.Translating(0, 10), motion.prime_radius, motion.sigma, motion.lift)
    for k, rho in enumerate((motion.cam.rho2, motion.cam.rho3, motion.cam.rho1)):
        phi = np.linspace(*motion.edges[k : k + 2], 20)[1:-1]
        assert inverted.curvature(motion(phi)) == pytest.approx(1 / (rho + 10), rel=1e-12)


def test_an_arc_that_is_almost_straight_still_gives_all_digits():
    """C2 a thousand kilometres away: G lies almost on the base circle's tangent at A."""
    flat = 1e9
    g = (20.0, 40 - 20.0**2 / (2 * flat))
    # From G a common tangent would lead to C1; a little above it there is room for a third arc.
    cam, _ = three_arc_cam(D=(51.68, 25), G=g, rho1=14, A=(0, 40))
    assert cam.rho2 > 0.9 * flat
    assert cam.sound
    motion = cam.motion(roller_radius=10)
    phi = np.linspace(0.05, 0.95, 10) * motion.edges[1]
    # The roller's centre keeps to a line 50 mm from the cam centre, but for 2e-7 mm.
    bend = (50 * np.tan(phi)) ** 2 / (2 * cam.rho2)
    assert np.abs(motion(phi)[0] - (50 / np.cos(phi) - 50 - bend / np.cos(phi))).max() < 1e-11


# --- what cannot be --------------------------------------------------------------------------------------------------

WRONG = {
    "no radius": ({"rho1": 0}, "rho1 is 0"),
    "an infinite radius": ({"rho1": math.inf}, "rho1 is inf"),
    "a point of three numbers": ({"G": (1, 2, 3)}, "two numbers"),
    "a point that is a number": ({"G": 3}, "two numbers"),
    "a point with NaN": ({"C1": (math.nan, 1)}, "two finite numbers"),
    "D in the cam centre": ({"D": (0, 0)}, "away from the cam centre"),
    "neither A nor C2": ({"A": None, "C2": None}, "C2 is left out"),
    "C2 in G": ({"C2": EXAMPLE["G"]}, "away from G"),
    "a first arc beyond the cam centre": ({"C1": None, "rho1": 60}, "rho1 is 60"),
    "G on the tangent at A": ({"C2": None, "G": (10, 40)}, "off the tangent"),
}
NO_PROFILE = {
    "A off its arc": ({"A": (0, 41)}, r"A is .*\(0, 41\).* must be \(0, 39.9988\)"),
    "D off its arc": ({"D": (50, 18.81)}, r"D is .*\(50, 18.81\)"),
    "an arc that runs backwards": ({"C2": (0, -75.64), "G": (-10, 39.56), "C1": None}, "angle of the arc"),
    "a cam centre outside the second arc": ({"C2": (0, 50), "G": (12, 42), "A": None, "rho1": 1}, "root|C2"),
}


@over_all("name", WRONG)
def test_data_that_cannot_be(name):
    change, words = WRONG[name]
    with pytest.raises(gc.DesignError, match=words):
        three_arc_cam(**(EXAMPLE | change))


@over_all("name", NO_PROFILE)
def test_data_that_give_no_profile(name):
    change, words = NO_PROFILE[name]
    cam, _ = three_arc_cam(**(EXAMPLE | change))
    with pytest.raises(gc.DesignError, match=words):
        cam.motion()


@over_all(
    ("arguments", "words"),
    [
        ({"roller_radius": -1}, "roller radius is -1"),
        ({"dwell": math.nan}, "dwell is nan"),
        ({"dwell": 4}, "rise, dwell and return is 369.176"),
    ],
)
def test_what_the_motion_cannot_be_asked(arguments, words):
    with pytest.raises(gc.DesignError, match=words):
        three_arc_cam(**EXAMPLE)[0].motion(**arguments)


def test_a_return_that_ends_with_the_turn_leaves_no_rest():
    cam = three_arc_cam(**given(EXAMPLE, "C1", "C2"))[0]
    rise = cam.motion().rise
    motion = cam.motion(5.0, dwell=2 * (math.pi - rise))
    assert motion.breaks.size == 7
    assert motion(0.0, "left")[2] == pytest.approx(motion(0.0, "right")[2], rel=1e-9)
    with pytest.raises(gc.DesignError, match="'up'"):
        motion(1.0, side="up")

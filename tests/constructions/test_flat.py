"""The flat-faced follower on the drawing board: s over a, the faces and their envelope, orders of convergence."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from boards import flat_board, flat_motion, motion_of, order
from numpy.testing import assert_allclose
from over_all import over_all
from test_convergence import distance_from_profile

import graphcam as gc
from graphcam.comparison.bounds import Bounds
from graphcam.constructions.chain import AdoptedSizes, Chain
from graphcam.constructions.drawn_flat_face import DrawnFlatFaced
from graphcam.drafting.euclid import UP
from graphcam.drafting.marks import AngleMark, Line, Role
from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError
from graphcam.given.follower import sense
from graphcam.mechanism.flat_faced import face_width
from graphcam.plane_vectors import dot

PARTS = (12, 24, 48, 96)
EXACT = 1e-12
SIZES = AdoptedSizes(prime_radius=60.0, place=0.0, roller_radius=0.0)
LEAST_CURVATURE = 8.0
FACES = ("face_left", "face_right")
each_rotation = over_all("rotation", ["ccw", "cw"])


def drawn(law: str, rotation: str = "ccw", n: int = 12, ratio: float = 1.0) -> Chain:
    return Chain(flat_board(flat_motion(law, ratio), LEAST_CURVATURE, rotation=rotation, divisions=n), decided=SIZES)


@cache
def cam_of(law: str, rotation: str = "ccw") -> gc.Cam:
    return gc.Cam(flat_motion(law), gc.FlatFaced(), SIZES.prime_radius, rotation)


def exact_least(motion: gc.Motion, curvature: float = LEAST_CURVATURE) -> float:
    return gc.minimum_radius(motion, gc.FlatFaced(), curvature=curvature).prime_radius


def profile_of(chain: Chain):
    readings = chain["inversion"].readings
    return readings["x"].value + UP * readings["y"].value


# --- the computed case -----------------------------------------------------------------------------------------------


def test_the_radius_of_the_cusp_and_the_width_of_the_face_in_the_limit():
    """The case flat: 30 mm up in 120 degrees by 3-4-5; the cusp radius is where the least curvature radius is zero.

    Errors of the second order vanish from 4 times the value of twice as many parts less the value, over three.
    """
    motion = motion_of((30, 120, "3-4-5"), (0, 30), (-30, 120, "3-4-5"))

    def drawn_with(n: int) -> np.ndarray:
        chain = Chain(flat_board(motion, 0.0, divisions=n), decided=SIZES)
        width = chain["inversion"].readings
        return np.array([chain["minimum_radius"].readings["prime_radius"].value, *(width[key].value for key in FACES)])

    exact = np.array([11.752953153077656, 26.857396646757338, 26.857396646757338])
    coarse, fine = drawn_with(384), drawn_with(768)
    assert_allclose(coarse, exact, atol=140 / 384**2)
    assert_allclose((4 * fine - coarse) / 3, exact, atol=1e-5)


# --- convergence -----------------------------------------------------------------------------------------------------

LEAST_RADIUS = {
    # n^2 |error| of the least radius [mm], at its greatest over the parts named.
    "triangular": (47.0, range(12, 97)),  # corners at quarters
    "cosine": (20.4, range(12, 97, 3)),
    "cycloidal": (95.0, range(12, 97, 3)),
    "trapezoidal": (42.5, range(12, 97)),  # corners at eighths
    "modified-trapezoidal": (667.0, range(12, 97, 3)),  # the third derivative of a jumps
    "modified-sine": (385.0, range(12, 97, 3)),
    "2-3": (60.1, range(12, 97, 3)),
    "3-4-5": (146.0, range(12, 97, 3)),
    "4-5-6-7": (20.0, range(12, 97, 3)),
    "double-harmonic": (40.4, range(12, 97, 3)),
    "eighth-degree": (42.3, range(12, 97, 3)),
}


def least_radius(law: str, n: int) -> float:
    return float(drawn(law, n=n)["minimum_radius"].readings["prime_radius"].value)


@over_all("law", LEAST_RADIUS)
def test_the_least_radius_under_a_flat_face_is_within_its_constant_over_n_squared(law):
    constant, parts = LEAST_RADIUS[law]
    exact = exact_least(flat_motion(law))
    scaled = [n * n * abs(least_radius(law, n) - exact) for n in parts]
    assert 0.8 * constant < max(scaled) < constant  # the constant is one, not merely a large number


@over_all("law", LEAST_RADIUS)
def test_the_least_radius_under_a_flat_face_is_of_the_second_order(law):
    exact = exact_least(flat_motion(law))
    parts = PARTS[1:] if law == "eighth-degree" else PARTS  # with twelve parts its sharp bend is hardly seen
    assert order(parts, [abs(least_radius(law, n) - exact) for n in parts]) >= 1.9


@over_all("law", ["triangular", "trapezoidal"])
@over_all("n", [7, 10, 12, 13, 18])
def test_where_corners_fall_off_the_equal_divisions_the_least_radius_keeps_its_bound(law, n):
    chain = drawn(law, n=n)
    reading = chain["minimum_radius"].readings["prime_radius"]
    bound = Bounds(chain).of("minimum_radius", "prime_radius") * float(np.ravel(reading.scale)[0])
    assert abs(float(reading.value) - exact_least(flat_motion(law))) < bound < 0.1 * SIZES.prime_radius


class EquallyDivided(DrawnFlatFaced):
    """A flat face whose phases are divided without regard to corners."""

    divides_at_corners = False


@over_all("parts", [(10, 18, 34, 66), (14, 26, 50, 98)])
def test_corners_of_the_acceleration_between_two_divisions_would_cost_an_order_on_the_unsafe_side(parts):
    """A triangle has its corner at a quarter: with 4 k + 2 equal parts nothing is plotted where s + a is least."""
    exact = exact_least(flat_motion("triangular"))

    def errors(follower: DrawnFlatFaced) -> np.ndarray:
        boards = [flat_board(flat_motion("triangular"), LEAST_CURVATURE, divisions=n) for n in parts]
        chains = [Chain(replace(board, follower=follower), decided=SIZES) for board in boards]
        return np.array([float(chain["minimum_radius"].readings["prime_radius"].value) - exact for chain in chains])

    equal = errors(EquallyDivided(LEAST_CURVATURE))
    assert equal.max() < 0
    assert order(parts, -equal) == pytest.approx(1.0, abs=0.1)
    at_corners = errors(DrawnFlatFaced(LEAST_CURVATURE))
    assert (np.abs(at_corners) * np.square(parts) < LEAST_RADIUS["triangular"][0]).all()


@each_rotation
@over_all("ratio", [0.4, 1.0, 2.5])
@over_all("n", [1, 2, 3, 12, 25])
def test_constant_acceleration_of_any_ratio_is_exact_at_the_jumps(n, ratio, rotation):
    """Both one-sided accelerations count: the least of s + a lies just after the switch of the rise."""
    chain = drawn("rectangular", rotation, n, ratio)
    motion = chain.board.motion
    assert chain["minimum_radius"].readings["prime_radius"].value == pytest.approx(exact_least(motion), rel=EXACT)
    need = -min(values for k in (0, 2) for values in sums_at_the_ends(motion, k))
    assert chain["minimum_radius"].readings["need"].value == pytest.approx(need, rel=EXACT)
    exact = gc.Cam(motion, gc.FlatFaced(), SIZES.prime_radius, rotation)
    rho = float(chain["curvature"].readings["rho"].value)
    assert rho == pytest.approx(exact.extremes().min_convex_radius[0], rel=EXACT, abs=EXACT)
    width, inverted = face_width(motion, rotation), chain["inversion"].readings
    assert [float(inverted[key].value) for key in FACES] == pytest.approx([width.left, width.right], rel=EXACT)
    assert_allclose(np.stack([profile_of(chain).real, profile_of(chain).imag], -1),
                    exact.at(chain.board.stations.phase, chain.board.stations.u).profile, atol=1e-11)  # fmt: skip


def sums_at_the_ends(motion: gc.Motion, k: int) -> list[float]:
    """s + a on both sides of a phase's switch and at its ends, by hand: the acceleration is constant on each side."""
    phase = motion.phases[k]
    switch = 1 / (1 + phase.ratio)
    first = 2 * phase.lift * (1 + phase.ratio) / phase.angle**2
    a = np.array([first, first, -first / phase.ratio, -first / phase.ratio])
    s = phase.lift * np.array([0, switch, switch, 1])
    return list(s + a if phase.direction > 0 else phase.lift - s - a)


def error_of_touch_points(chain: Chain, cam: gc.Cam) -> float:
    return float(np.abs(profile_of(chain) - cam.profile(chain.board.stations.phi) @ [1, 1j]).max())


def error_of_profile(chain: Chain, cam: gc.Cam) -> float:
    return float(distance_from_profile(cam, profile_of(chain), chain.board.stations.phi).max())


@each_rotation
@over_all("law", ["cycloidal", "3-4-5"])
@over_all("error", [error_of_touch_points, error_of_profile])
def test_the_error_of_the_profile_falls_with_the_second_order(error, law, rotation):
    errors = [error(drawn(law, rotation, n), cam_of(law, rotation)) for n in PARTS]
    assert order(PARTS, errors) == pytest.approx(2.0, abs=0.15)


@over_all(("law", "rho", "width"), [("cycloidal", 89.0, 0.0), ("3-4-5", 160.0, 16.3), ("cosine", 20.4, 22.5)])
def test_curvature_and_width_are_within_their_constants_over_n_squared(law, rho, width):
    exact, faces = cam_of(law).extremes().min_convex_radius[0], face_width(flat_motion(law))
    scaled = {"rho": [], "width": []}
    for n in PARTS:
        chain = drawn(law, n=n)
        read = [float(chain["inversion"].readings[key].value) for key in FACES]
        scaled["rho"].append(n * n * abs(float(chain["curvature"].readings["rho"].value) - exact))
        scaled["width"].append(n * n * max(abs(read[0] - faces.left), abs(read[1] - faces.right)))
    assert 0.8 * rho < max(scaled["rho"]) < rho
    assert 0.8 * width <= max(scaled["width"]) < width + 1e-8


# --- theorems --------------------------------------------------------------------------------------------------------


@each_rotation
@over_all("law", ["cycloidal", "2-3"])
def test_every_face_touches_the_profile_square_to_its_ray_at_the_displacement(law, rotation):
    chain = drawn(law, rotation)
    inverted, phi = chain["inversion"], chain.board.stations.phi
    feet, touch, along = (inverted.points[name] for name in ("feet", "pitch", "motion"))
    mu = inverted.givens.mu_l.per_mm
    assert_allclose(along, 1j * np.exp(-1j * sense(rotation) * phi), atol=1e-14)  # numbered against the rotation
    assert_allclose(feet, along * (60 + chain["integration"].readings["s"].value) / mu, rtol=1e-13)
    assert np.abs(dot(along, touch - feet)).max() < 1e-12  # on the face, square to the ray
    # ds/dphi to the right of a cam that turns counter-clockwise, seen along the ray.
    contact = dot(touch - feet, along / UP) * mu
    assert_allclose(contact, sense(rotation) * chain["integration"].readings["v"].value, atol=1e-11)
    assert_allclose(inverted.readings["contact"].value, contact, atol=1e-11)


@each_rotation
def test_no_face_cuts_into_the_profile(rotation):
    """The profile is the envelope: all of it lies below every face."""
    chain = drawn("cycloidal", rotation, 24)
    feet, touch, along = (chain["inversion"].points[name] for name in ("feet", "pitch", "motion"))
    above = dot(along[:, None], touch[None, :] - feet[:, None])
    assert above.max() < 0.05  # the second-order error of the drawn velocities


def test_a_cam_that_turns_the_other_way_is_the_mirror_image():
    ccw, cw = (drawn("3-4-5", rotation) for rotation in ("ccw", "cw"))
    assert_allclose(profile_of(cw), -np.conj(profile_of(ccw)), atol=1e-12)
    left, right = ([float(c["inversion"].readings[key].value) for key in FACES] for c in (ccw, cw))
    assert left == pytest.approx(right[::-1], rel=1e-14)
    for name in ("prime_radius", "need"):
        assert cw["minimum_radius"].value(name) == ccw["minimum_radius"].value(name)


@over_all("law", ["3-4-5", "rectangular", "trapezoidal"])
def test_the_tangent_leans_by_45_degrees_and_no_place_of_the_curve_lies_below_it(law):
    region = drawn(law, n=24)["minimum_radius"]
    curve, touch, zero = region.points["curve"], region.points["touch"], region.points["zero"]
    assert zero.real == pytest.approx(0, abs=1e-12)
    assert zero.imag == pytest.approx(touch.real + touch.imag, rel=1e-12)  # places of equal s + a
    assert np.all(curve.real + curve.imag >= zero.imag - 1e-9)
    limit = next(m for m in region.steps()[2].marks if isinstance(m, Line) and m.role is Role.LIMIT)
    assert np.degrees(np.angle(limit.points[1] - limit.points[0])) == pytest.approx(-45)
    angle = next(m for m in region.steps()[2].marks if isinstance(m, AngleMark))
    assert angle.end - angle.start == pytest.approx(math.pi / 4)


def test_with_unequal_scales_the_tangent_leans_by_the_arctangent_of_their_ratio():
    """The remark of the caption: drawn in the scale of the acceleration diagram, the touch is at the same place."""
    chain = drawn("cosine", n=48)
    region, readings = chain["minimum_radius"], chain["integration"].readings
    assert "arctan(μₐ/μₛ)" in str(region.steps()[2].caption)
    mu_s, mu_a = (float(readings[name].scale) for name in "sa")
    assert mu_a / mu_s != pytest.approx(1, abs=0.1)
    # On paper a/mu_a to the right and s/mu_s upwards; lines of equal s + a fall by mu_a/mu_s.
    paper = readings["a"].value / mu_a + UP * readings["s"].value / mu_s
    lean = math.atan(mu_a / mu_s)
    lowest = np.argmin(dot(math.sin(lean) + UP * math.cos(lean), paper))
    curve = region.points["curve"]  # in equal scales, its stations in the same order
    assert lowest == np.argmin(curve.real + curve.imag)


@over_all("prime_radius", [40.0, 60.0, 20.0])
def test_the_least_curvature_is_what_the_radius_exceeds_the_need_by(prime_radius):
    chain = Chain(flat_board(flat_motion("3-4-5"), LEAST_CURVATURE, prime_radius=prime_radius))
    need = float(chain["minimum_radius"].value("need"))
    assert chain["curvature"].value("rho") == pytest.approx(prime_radius - need, rel=EXACT)
    assert chain["minimum_radius"].value("prime_radius") == pytest.approx(LEAST_CURVATURE + need, rel=EXACT)


# --- slow motions ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("phases", "need"),
    [
        (((2, 170, "cosine"), (0, 20), (-2, 170, "cosine")), -0.878892733564013),
        (((2, 150, "cosine"), (0, 20), (-2, 150, "cosine")), 0.0),
        (((0, 60), (2, 150, "cosine"), (-2, 150, "cosine")), 0.0),
    ],
    ids=["no dwell below", "dwell below", "dwell first"],
)
def test_of_a_slow_motion_a_dwell_below_is_the_sharpest_place(phases, need):
    """s + a is nowhere negative; where the follower rests below it is zero, and the profile an arc of radius r0."""
    motion = motion_of(*phases)
    exact = gc.minimum_radius(motion, gc.FlatFaced(), curvature=8.0).prime_radius
    assert exact == pytest.approx(8.0 + need, rel=1e-9)
    region = Chain(flat_board(motion, 8.0, divisions=24))["minimum_radius"]
    assert region.value("need") == pytest.approx(need, abs=1e-3)
    assert region.value("prime_radius") == pytest.approx(exact, abs=1e-3)
    chain = Chain(flat_board(motion, 8.0, divisions=24, prime_radius=20.0))
    sharpest = gc.Cam(motion, gc.FlatFaced(), 20.0).extremes().min_convex_radius[0]
    assert chain["curvature"].value("rho") == pytest.approx(sharpest, abs=1e-3)
    assert "-0.000" not in " ".join(str(step.caption) for step in region.steps())


def test_where_any_radius_will_do_there_is_none_to_adopt():
    motion = motion_of((1, 180, "2-3"), (-1, 180, "2-3"))
    assert gc.minimum_radius(motion, gc.FlatFaced()).prime_radius == 0
    chain = Chain(flat_board(motion, 0.0, divisions=24))
    assert chain["minimum_radius"].value("prime_radius") == 0
    assert chain["minimum_radius"].value("need") < 0
    for rounding in (None, 1.0):
        with pytest.raises(DesignError, match=r"minimum prime radius is 0 mm.* give cam.prime_radius"):
            _ = Chain(flat_board(motion, 0.0, rounding=rounding)).prime_radius
    assert Chain(flat_board(motion, 0.0, prime_radius=20.0))["curvature"].value("rho") > 20


# --- hands -----------------------------------------------------------------------------------------------------------


def test_hands_scatter_the_least_radius_in_proportion_and_keep_the_decisions_of_the_perfect_pencil():
    board = flat_board(flat_motion("3-4-5"))
    scatter = []
    for sigma in (0.05, 0.1):
        chain = Chain(board, Pencil(line=sigma, dividers=sigma, samples=1000))
        assert chain.sizes == Chain(board).sizes
        scatter.append([chain["minimum_radius"].readings["prime_radius"].value.std(), *(
            chain["inversion"].readings[key].value.std(axis=0).max() for key in ("x", "contact", *FACES)
        )])  # fmt: skip
        assert np.isfinite(chain["curvature"].readings["rho"].value).all()
    assert np.array(scatter[1]) / scatter[0] == pytest.approx(np.full(5, 2.0), rel=0.1)

"""The least radius against its definition at 50 digits (see ``reference``), and against the cam that it promises."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import diff, findroot, mpf
from over_all import over_all, pairs
from reference import EPS, least_radius, lift

from graphcam.errors import DesignError
from graphcam.given.follower import FlatFaced, Oscillating, Translating
from graphcam.given.laws import LAWS, law
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.mechanism.least_radius_lines import steepest_tangent

DEG = math.pi / 180


def motion_of(
    name: str, h: float = 30, rise: float = 80, dwell: float = 45, back: float = 60, ratio: float = 1.0
) -> Motion:
    rest = 360 - rise - dwell - back
    return Motion(
        [Rise(h, rise * DEG, name, ratio), Dwell(dwell * DEG), Return(h, back * DEG, name, ratio), Dwell(rest * DEG)]
    )


def stairs() -> Motion:
    """Levels above zero, several rises and returns, different laws; it begins on its way down."""
    angles = [0.9, 0.5, 0.8, 0.4, 1.3]
    return Motion(
        [
            Return(12, angles[0], "cycloidal"), Rise(20, angles[1], "trapezoidal"), Dwell(angles[2]),
            Return(25, angles[3], "rectangular", 3.0), Rise(17, angles[4], "modified-sine"),
            Dwell(FULL_TURN - math.fsum(angles)),
        ]
    )  # fmt: skip


MOTIONS = [*(motion_of(name) for name in LAWS), motion_of("rectangular", ratio=2.5), stairs()]


FREE = [(30, None, True), (30, None, False), (30, 40, True), (35, 70, False), (55, 20, True), (50, 50, False)]
GIVEN = [(e, return_) for e in (0.0, 10.0, -10.0, 60.0) for return_ in (None, 45)]


@over_all(("motion", "limits"), pairs(MOTIONS, FREE, 2))
def test_least_radius_of_the_free_offset(motion, limits):
    rise, return_, rest = limits
    back = None if return_ is None else return_ * DEG
    least = minimum_radius(motion, Translating(), rise=rise * DEG, return_=back, rest=rest)
    exact = least_radius(motion, rise * DEG, back, rest)
    assert abs(mpf(least.prime_radius) / exact - 1) <= 1e-13
    mirrored = minimum_radius(motion, Translating(), "cw", rise * DEG, back, rest=rest)
    assert (mirrored.prime_radius, mirrored.offset) == (least.prime_radius, -least.offset)
    # The offset that is reported is the one that belongs to the radius.
    fixed = minimum_radius(motion, Translating(), rise=rise * DEG, return_=back, rest=rest, offset=least.offset)
    assert fixed.prime_radius == pytest.approx(least.prime_radius, rel=8 * EPS)


@over_all(("motion", "given"), pairs(MOTIONS, GIVEN))
def test_least_radius_of_a_given_offset(motion, given):
    """Favourable, unfavourable, and so large that the angle at rest decides."""
    e, return_ = given
    back = None if return_ is None else return_ * DEG
    least = minimum_radius(motion, Translating(offset=1.5), "cw", return_=back, offset=e)
    assert abs(mpf(least.prime_radius) / least_radius(motion, 30 * DEG, back, True, offset=-e) - 1) <= 1e-13
    assert least.offset == e


@over_all("motion", MOTIONS)
@over_all("rotation", ["ccw", "cw"])
@over_all("limits", [(30, 40), (45, 30), (60, 20)])
def test_a_cam_of_the_least_radius_reaches_its_limit_and_keeps_it(motion, rotation, limits):
    """Sizing for 30 and 40 degrees delivers them, not 30.44; for 45 and 30 not 34.98 where the return ends."""
    rise, back = limits
    follower = Translating(roller_radius=3)
    for offset in (None, 4.0, -4.0):
        least = minimum_radius(motion, follower, rotation, rise=rise * DEG, return_=back * DEG, offset=offset)
        cam = Cam(motion, Translating(least.offset, 3), least.prime_radius, rotation)
        extremes = cam.extremes()
        at_rest = cam.pressure_angle(motion.starts[np.argmin(motion.levels[:-1])])
        reached = {
            "rise": abs(extremes.pressure_angle_rise[0]) / (rise * DEG),
            "return": abs(extremes.pressure_angle_return[0]) / (back * DEG),
            "rest": abs(float(at_rest)) / (min(rise, back) * DEG),
        }
        assert max(reached.values()) <= 1 + 1e-13
        for line in least.active:
            assert reached[line] == pytest.approx(1, abs=1e-13)


def test_the_names_of_the_lines_that_bind():
    motion, any_follower = motion_of("cycloidal", rise=60, dwell=10, back=240), Translating()
    assert minimum_radius(motion, any_follower).active == ("rise", "rest")
    assert minimum_radius(motion, any_follower, rest=False).active == ("rise",)
    assert minimum_radius(motion, any_follower, offset=0).active == ("rise",)
    assert minimum_radius(motion, any_follower, offset=200).active == ("rest",)
    assert minimum_radius(motion, any_follower, return_=5 * DEG, offset=0).active == ("return",)
    two_sided = motion_of("3-4-5", rise=120, dwell=30, back=90)
    assert minimum_radius(two_sided, any_follower, return_=40 * DEG).active == ("rise", "return")


def test_the_foot_of_the_perpendicular_never_keeps_the_rest_condition_under_45_degrees():
    for limit in (5, 30, 44.9):
        motion = motion_of("cosine")
        foot = minimum_radius(motion, Translating(), rise=limit * DEG, rest=False)
        cam = Cam(motion, Translating(foot.offset), foot.prime_radius)
        assert abs(float(cam.pressure_angle(0))) == pytest.approx((90 - limit) * DEG, rel=1e-9)
    assert minimum_radius(motion_of("cosine"), Translating(), rise=50 * DEG).active == ("rise",)


def test_the_follower_s_own_offset_does_not_count():
    motion = motion_of("2-3")
    radii = {minimum_radius(motion, Translating(offset=e, roller_radius=5)).prime_radius for e in (-20, 0, 30)}
    assert len(radii) == 1


@over_all(("name", "limit"), pairs(LAWS, [1e-6, 1e-3, 0.1, 89.0, 89.999, 90 - 1e-6]))
def test_limits_near_0_and_90_degrees(name, limit):
    motion = motion_of(name)
    for rest in (True, False):
        least = minimum_radius(motion, Translating(), rise=limit * DEG, rest=rest)
        assert abs(mpf(least.prime_radius) / least_radius(motion, limit * DEG, None, rest) - 1) <= 1e-13


def test_without_the_rest_condition_a_large_given_offset_needs_no_height():
    least = minimum_radius(motion_of("3-4-5"), Translating(), offset=500.0, rest=False)
    assert (least.prime_radius, least.offset, least.active) == (500.0, 500.0, ())


@over_all("name", LAWS)
@over_all("k", [1e-9, 1e-3, 0.05, 0.3, 1.0, 50.0])
def test_the_tangent_point_is_where_f_prime_less_f_over_k_is_greatest(name, k):
    the_law = law(name, ratio=0.6 if name == "rectangular" else 1.0)
    u, _ = steepest_tangent(the_law, k)
    around = u + np.array([-1e-4, -1e-6, 0, 1e-6, 1e-4]) * min(u, 0.1)
    f, df = the_law(around, derivatives=1)
    assert np.argmax(df - f / k) == 2
    fastest = {"double-harmonic": 2 / 3, "eighth-degree": 0.5327}.get(name, the_law.middle)
    assert 0 < u <= fastest


@over_all("name", ["rectangular", "cosine", "cycloidal", "2-3", "3-4-5", "4-5-6-7", "double-harmonic"])
@over_all("k", [1e-6, 0.05, 0.3, 0.31832, 0.4, 1.0, 50.0, 1e6])
def test_the_closed_forms_of_the_steepest_line_to_four_eps(name, k):
    ratio = 0.6 if name == "rectangular" else 1.0
    the_law, best = law(name, ratio), mpf(0)
    u = mpf(steepest_tangent(the_law, k)[0])
    for x in (u, *findroot_of_the_slope(name, ratio, u, k)):
        best = max(best, diff(lambda y: lift(name, y, ratio), x) - lift(name, x, ratio) / mpf(k))
    assert abs(mpf(steepest_tangent(the_law, k)[1]) / best - 1) <= 4 * EPS


def test_the_closed_forms_of_the_double_harmonic_law_pass_the_check_of_laws():
    law("double-harmonic")._check()
    law("double-harmonic").reversed._check()


def findroot_of_the_slope(name: str, ratio: float, u, k: float) -> list:
    """The tangent's place to 50 digits; none for the rectangular law, whose place is exact."""
    if name == "rectangular":
        return []
    return [
        findroot(lambda y: diff(lambda z: k * diff(lambda t: lift(name, t, ratio), z) - lift(name, z, ratio), y), u)
    ]


@over_all("limit", [0.0, 90 * DEG, -0.1, 2.0, math.nan, math.inf])
@over_all("name", ["rise", "return"])
def test_limits_lie_strictly_between_0_and_90_degrees(limit, name):
    with pytest.raises(DesignError, match=rf"{name} is .* between 0 and 90 degrees"):
        minimum_radius(motion_of("cosine"), Translating(), **{"rise" if name == "rise" else "return_": limit})


@over_all(
    ("make", "message"),
    [
        (lambda m: minimum_radius(m, Translating(), offset=math.nan), "offset is nan"),
        (lambda m: minimum_radius(m, Translating(), "up"), "rotation is 'up'"),
        (lambda m: minimum_radius(m, Translating(), curvature=8.0), "curvature is 8.0, but must be left out"),
        (lambda m: minimum_radius(m, FlatFaced(), offset=5.0), "offset is 5.0, but must be left out"),
        (lambda m: minimum_radius(m, Oscillating(80, 100), offset=5.0), "offset is 5.0, but must be left out"),
    ],
)
def test_what_cannot_be_is_refused_with_reason(make, message):
    with pytest.raises(DesignError, match=message):
        make(motion_of("cosine"))

"""Every law is tested for content: against the printed displacement and its derivatives, not at the end points only."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import diff, mpf
from numpy.testing import assert_allclose
from over_all import over_all
from reference import EPS, lift

from graphcam.errors import DesignError
from graphcam.given.laws import LAWS, law

POLYNOMIAL = ("rectangular", "2-3", "3-4-5", "4-5-6-7")
SAMPLES = np.concatenate([np.random.default_rng(1).random(60), [1e-9, 1e-4, 0.3, 0.5, 0.7, 1 - 2.0**-14, 1 - 2.0**-30]])


def reference(name: str, u: float, ratio: float = 1.0) -> list:
    return [diff(lambda x: lift(name, x, ratio), mpf(u), order) for order in range(4)]


def off_the_breaks(name: str, ratio: float = 1.0) -> np.ndarray:
    breaks = np.array([*law(name, ratio).breaks, -1.0])
    return np.array([u for u in SAMPLES if np.abs(u - breaks).min() > 1e-12])


@over_all("name", LAWS)
def test_value_and_derivatives_are_those_of_the_printed_displacement(name):
    u = off_the_breaks(name)
    computed = np.array(law(name)(u))
    exact = np.array([reference(name, x) for x in u]).T
    greatest = [1, law(name).peak_velocity, law(name).peak_acceleration, float(max(abs(exact[3])))]
    error = np.array(
        [[float(abs(mpf(c) - e)) for c, e in zip(*rows, strict=True)] for rows in zip(computed, exact, strict=True)]
    )
    assert np.all(error.max(axis=1) <= 4 * EPS * np.array(greatest))


@over_all("ratio", [0.25, 2.0, 7.3])
def test_rectangular_law_with_unequal_parts(ratio):
    u = off_the_breaks("rectangular", ratio)
    exact = np.array([[float(x) for x in reference("rectangular", v, ratio)] for v in u]).T
    assert_allclose(np.array(law("rectangular", ratio)(u)), exact, rtol=1e-14, atol=1e-60)
    ddf = law("rectangular", ratio)([0.0, 1.0])[2]
    assert ddf[0] / -ddf[1] == pytest.approx(ratio, rel=4 * EPS)


@pytest.mark.parametrize("name", ["triangular", "cycloidal", "modified-trapezoidal", "modified-sine"])
@pytest.mark.parametrize("ratio", [0.25, 2.0, 7.3])
def test_skewed_laws_have_parts_in_the_ratio_of_their_accelerations(name, ratio):
    u = off_the_breaks(name, ratio)
    exact = np.array([[float(x) for x in reference(name, v, ratio)] for v in u]).T
    assert_allclose(np.array(law(name, ratio)(u)), exact, rtol=1e-11, atol=1e-12)
    unequal, dense = law(name, ratio), law(name, ratio)(np.linspace(0, 1, 20_001))[2]
    assert dense.max() / -dense.min() == pytest.approx(ratio, rel=1e-3)
    assert unequal.peak_acceleration == pytest.approx(np.abs(dense).max(), rel=1e-3)
    assert unequal.peak_velocity == law(name).peak_velocity  # at the end of the accelerating part
    assert float(unequal(1 / (1 + ratio))[1]) == pytest.approx(unequal.peak_velocity)
    assert unequal.reversed.ratio == pytest.approx(1 / ratio)
    for k in (0.05, 0.5, 5.0):
        for tangent, seen in zip(unequal.tangents, (unequal, unequal.reversed), strict=True):
            if tangent is not None:
                f, f1 = seen(np.linspace(0, 1, 20_001), 1)
                assert tangent(k)[1] == pytest.approx((f1 - f / k).max(), rel=1e-6)


RATIOS = [10.0**k for k in range(-12, 13)] + (10 ** np.random.default_rng(12).uniform(-12, 12, 500)).tolist()


def test_the_parts_of_the_rectangular_law_meet_in_lift_and_velocity_at_every_ratio():
    """At the break, and a place of the machine to either side, it is the law whose parts meet there, to 1e-14."""
    for ratio in RATIOS:
        unequal = law("rectangular", ratio)
        (at,) = unequal.breaks
        middle = mpf(at)
        for u, side in ((np.nextafter(at, 0), "right"), (at, "left"), (at, "right"), (np.nextafter(at, 1), "right")):
            f, df, ddf, _ = (mpf(float(x)) for x in unequal(u, side=side))
            x = mpf(float(u))
            first = x < middle or (x == middle and side == "left")
            lift_there = x**2 / middle if first else 1 - (1 - x) ** 2 / (1 - middle)
            velocity = 2 * x / middle if first else 2 * (1 - x) / (1 - middle)
            assert max(abs(f - lift_there), abs(df - velocity)) <= 1e-14, ratio
            assert abs(ddf * (middle if first else middle - 1) / 2 - 1) <= 1e-15, ratio
        # The break is where the ratio asks for it, as nearly as there is a number of the machine.
        assert abs(middle - 1 / (1 + mpf(ratio))) <= EPS


@over_all("name", POLYNOMIAL)
def test_polynomial_laws_keep_their_digits_to_the_very_end(name):
    """The lift and the missing lift, each of its own size: what 1 - f(u) would lose."""
    w = np.concatenate([2.0 ** -np.arange(1, 60), SAMPLES[SAMPLES < 0.5]])
    missing, df, *_ = law(name).pieces[-1].formula(w)
    exact = [(lift(name, x), diff(lambda y: lift(name, y), mpf(x))) for x in w]
    assert max(abs(mpf(m) / e - 1) for m, (e, _) in zip(missing, exact, strict=True)) <= 4 * EPS
    assert max(abs(mpf(v) / e - 1) for v, (_, e) in zip(df, exact, strict=True)) <= 4 * EPS


@over_all("name", ["cycloidal", "modified-sine", "modified-trapezoidal", "cosine"])
def test_trigonometric_laws_keep_their_digits_near_the_start(name):
    u = 2.0 ** -np.arange(4, 60)
    exact = [lift(name, mpf(x)) for x in u]
    assert max(abs(mpf(f) / e - 1) for f, e in zip(law(name)(u)[0], exact, strict=True)) <= 8 * EPS


@over_all(
    ("name", "velocity", "acceleration"),
    [  # as printed by Norton, table 2-3 and chapters 2 to 4, and by Chen, table 3-1
        ("rectangular", 2.0, 4.0),
        ("triangular", 2.0, 8.0),
        ("cosine", 1.5708, 4.9348),
        ("cycloidal", 2.0, 6.2832),
        ("trapezoidal", 2.0, 5.3333),
        ("modified-trapezoidal", 2.0, 4.8881),
        ("modified-sine", 1.7596, 5.5280),
        ("2-3", 1.5, 6.0),
        ("3-4-5", 1.875, 5.7735),
        ("4-5-6-7", 2.1875, 7.5132),
    ],
)
def test_published_peak_factors(name, velocity, acceleration):
    u = np.linspace(0, 1, 100_001)
    _, df, ddf, _ = law(name)(u)
    last_printed_digit = 0.5e-4
    assert law(name).peak_velocity == pytest.approx(velocity, abs=last_printed_digit)
    assert law(name).peak_acceleration == pytest.approx(acceleration, abs=last_printed_digit)
    assert df.max() == pytest.approx(law(name).peak_velocity, rel=1e-9)
    assert np.abs(ddf).max() == pytest.approx(law(name).peak_acceleration, rel=1e-9)


@over_all("name", LAWS)
def test_velocity_integrates_to_the_lift_and_acceleration_to_nothing(name):
    nodes, weights = np.polynomial.legendre.leggauss(20)
    ends = np.array([0.0, *law(name).breaks, 1.0])
    half = np.diff(ends) / 2
    u = ends[:-1] + half * (nodes[:, None] + 1)
    _, df, ddf, dddf = (weights @ rows for rows in law(name)(u))
    assert half @ df == pytest.approx(1, abs=1e-13)
    assert half @ ddf == pytest.approx(0, abs=1e-12)
    f, df, ddf, _ = law(name)([0.0, 1.0])
    assert (f.tolist(), df.tolist()) == ([0, 1], [0, 0])
    jumps = sum(np.diff([law(name)(u, side=side)[2] for side in ("left", "right")], axis=0)[0] for u in law(name).jumps)
    assert half @ dddf == pytest.approx(ddf[1] - ddf[0] - jumps, abs=1e-11)


@over_all("name", LAWS)
def test_lift_and_velocity_never_jump_and_acceleration_only_where_the_law_says(name):
    the_law = law(name)
    places = np.array(the_law.edges)
    left, right = np.array(the_law(places, side="left")), np.array(the_law(places, side="right"))
    assert_allclose(left[:2], right[:2], atol=4 * EPS)
    smooth = ~np.isin(places, the_law.jumps)
    assert_allclose(left[2, smooth], right[2, smooth], atol=16 * EPS * the_law.peak_acceleration)
    assert set(the_law.breaks) <= set(the_law.edges)
    for u in the_law.jumps:
        assert the_law(u, side="left")[2] > 0 > the_law(u, side="right")[2]


@over_all("name", LAWS)
def test_some_derivative_jumps_at_every_break_and_none_elsewhere(name):
    """A missing break would spoil the root finding between breaks, an idle one would say a jump where none is."""
    the_law, h = law(name), 1e-5
    for u in the_law.edges:
        left = np.array([*the_law(u, side="left"), np.diff(the_law([u - 2 * h, u - h])[3])[0] / h])
        right = np.array([*the_law(u, side="right"), np.diff(the_law([u + h, u + 2 * h])[3])[0] / h])
        # The first four by value, the fifth by differences.
        jumps = np.any(np.abs(left - right) > [1e-9, 1e-9, 1e-9, 1e-9, 1.0])
        assert jumps == (u in the_law.breaks)


@over_all("name", LAWS)
def test_reversed_law_runs_backwards(name):
    ratio = 3.0 if name == "rectangular" else 1.0
    the_law = law(name, ratio)
    u = np.arange(1, 32) / 32
    f, df, ddf, dddf = the_law(1 - u, side="left")
    assert_allclose(np.array(the_law.reversed(u)), [1 - f, df, -ddf, dddf], atol=1e-12)


def test_outside_the_phase_and_for_nan_a_law_is_nan():
    values = np.array(law("modified-sine")([-1e-9, 1 + 1e-9, np.nan, np.inf, 0.5]))
    assert np.isnan(values[:, :4]).all()
    assert np.isfinite(values[:, 4]).all()


def test_shapes_follow_u_and_derivatives_are_as_many_as_asked():
    assert [x.shape for x in law("cosine")(0.5, derivatives=1)] == [(), ()]
    assert [x.shape for x in law("cosine")(np.zeros((2, 3)))] == [(2, 3)] * 4


@over_all(
    ("name", "ratio", "message"),
    [
        ("cicloidal", 1.0, "law is 'cicloidal'.*did you mean 'cycloidal'"),
        ("3-4-5", 2.0, "ratio is 2.0, but must be 1 for the 3-4-5 law"),
        ("rectangular", 0.0, "ratio is 0.0, but must be a finite number greater than 0"),
        ("rectangular", float("nan"), "ratio is nan"),
        ("rectangular", -1.0, "ratio is -1.0"),
        ("rectangular", 1e-13, "ratio is 1e-13, but must be .* from 1e-12 to 1e\\+12; leave it out for equal parts"),
    ],
)
def test_wrong_laws_are_named(name, ratio, message):
    with pytest.raises(DesignError, match=message):
        law(name, ratio)

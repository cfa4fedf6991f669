"""Shock spectra: zeros and amplitudes in closed form, Fourier integrals at 40 digits, asymptotes, and any motion."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import expj, linspace, mp, mpf
from over_all import over_all
from reference import EPS, lift

import graphcam as gc
from graphcam.given.laws import RISE_FALL_LAWS
from graphcam.mechanism.shock_response import MAX_RATIO, event_of

DEG = math.pi / 180
SYMMETRIC = ("rectangular", "triangular", "cycloidal", "trapezoidal", "modified-trapezoidal")
"""Laws whose second half is the first one with the other sign: f''(u + 1/2) = -f''(u)."""
JUMPING = {"rectangular": 2, "cosine": 2, "2-3": 2, "triangular": 3, "cycloidal": 3, "trapezoidal": 3,
           "modified-trapezoidal": 3, "modified-sine": 3, "3-4-5": 3, "4-5-6-7": 4,
           "double-harmonic": 2, "eighth-degree": 2}  # fmt: skip
"""The first derivative of each law that jumps."""


def by_fourier(name: str, n: float) -> float:
    """Omega |integral of f'' exp(i Omega u)|, by parts until only the textbook's displacement is left, at 40 digits."""
    with mp.workdps(40):
        omega = 2 * mp.pi * mpf(n)
        places = linspace(0, 1, 9)
        integral = mp.quad(lambda u: lift(name, u) * expj(omega * u), places)
        return float(omega * abs(1j * omega * expj(omega) + omega**2 * integral))


@over_all("name", gc.LAWS)
def test_what_is_left_is_the_fourier_transform_of_the_acceleration(name):
    n = np.array([0.05, 1.7])
    found = gc.shock_spectrum(name, n)
    exact = [by_fourier(name, value) for value in n]
    np.testing.assert_allclose(found.residual, exact, rtol=1e-13, atol=1e-14)
    np.testing.assert_allclose(found.amplitude, exact / (math.tau * n) ** 2, rtol=1e-13, atol=1e-14)


@over_all(
    ("name", "closed"),
    [
        ("rectangular", lambda n: 16 * np.sin(np.pi * n / 2) ** 2),
        ("cosine", lambda n: 4 * np.pi**2 * n**2 * np.abs(np.cos(np.pi * n) / (4 * n**2 - 1))),
        ("cycloidal", lambda n: 4 * np.pi * n * np.abs(np.sin(np.pi * n) / (n**2 - 1))),
    ],
)
def test_closed_forms_of_the_residual_spectrum(name, closed):
    """Those of the module's docstring, over four decades."""
    n = np.geomspace(0.0103, 99.7, 300)
    np.testing.assert_allclose(gc.shock_spectrum(name, n).residual, closed(n), rtol=1e-9, atol=1e-11)


@over_all(
    ("name", "zeros"),
    [
        ("cycloidal", [2, 3, 4, 5, 10, 100]),  # not 1: there it is in resonance
        ("cosine", [1.5, 2.5, 3.5, 10.5, 99.5]),  # not 1/2
        ("rectangular", [2, 4, 6, 10, 100]),
        ("triangular", [2, 4, 6, 10, 100]),
        ("trapezoidal", [2, 4, 6, 10, 100]),
        ("modified-trapezoidal", [2, 4, 6, 10, 100]),
    ],
)
def test_known_ratios_leave_no_vibration(name, zeros):
    found = gc.shock_spectrum(name, zeros)
    # Rounding of the phase, 2 pi n, is what is left.
    assert np.all(found.residual <= 1e-14 * np.array(zeros) * found.peak)


@over_all("name", SYMMETRIC)
def test_a_law_whose_second_half_turns_the_first_leaves_nothing_at_even_ratios(name):
    """Its transform has the factor 1 - exp(i Omega/2), which is 2 at odd n: there the two halves add up."""
    law, u = gc.law(name), np.linspace(0.001, 0.499, 97)
    np.testing.assert_allclose(law(u + 0.5)[2], -law(u)[2], atol=1e-12)
    assert gc.shock_spectrum(name, [2, 4, 6]).residual.max() < 1e-13


def test_values_at_the_resonances():
    """Limits of the closed forms: cycloidal 2 pi^2 at n = 1, cosine pi^3/4 at 1/2; rectangular 16 at odd n."""
    assert gc.shock_spectrum("cycloidal", 1.0).residual.item() == pytest.approx(2 * math.pi**2, rel=1e-14)
    assert gc.shock_spectrum("cosine", 0.5).residual.item() == pytest.approx(math.pi**3 / 4, rel=1e-14)
    assert gc.shock_spectrum("rectangular", [1, 3, 7]).residual == pytest.approx([16, 16, 16], rel=1e-13)


@over_all("name", gc.LAWS)
def test_the_vibration_falls_with_the_order_of_the_first_jump(name):
    """What is left, times n^(k - 2), reaches the same height at all n; the k-th derivative is the first to jump.

    The fitted order of the envelope over two windows of eight ratios.
    """
    order = JUMPING[name] - 2
    windows = [start + np.linspace(0, 8, 33) for start in (60, 480)]
    heights = [max(left(name, n) * n**order for n in window) for window in windows]
    assert math.log(heights[1] / heights[0]) / math.log(480 / 60) == pytest.approx(0, abs=0.02)


def left(name: str, n: float) -> float:
    return gc.follower_response(name, n).residual


@over_all(("name", "jump"), [("cosine", math.pi**2 / 2), ("3-4-5", 60), ("4-5-6-7", 840), ("2-3", 6)])
def test_the_asymptote_is_that_of_the_jumps_at_both_ends(name, jump):
    """At a ratio where both ends add up: 2 |jump of the k-th derivative| Omega^(2 - k), to the next order in 1/n."""
    greatest = max(left(name, n) for n in 400 + np.linspace(0, 1, 51))
    assert greatest * (math.tau * 400.5) ** (JUMPING[name] - 2) == pytest.approx(2 * jump, rel=0.005)


def test_a_very_soft_follower_stays_behind_and_swings_by_the_whole_lift():
    for name in gc.LAWS:
        found = gc.shock_spectrum(name, 1e-6)
        assert found.amplitude.item() == pytest.approx(1, abs=1e-9)
        assert found.residual.item() == pytest.approx((math.tau * 1e-6) ** 2, rel=1e-9)


@over_all(("name", "jump"), [("double-harmonic", math.pi**2), ("eighth-degree", 5.2683)])
def test_a_dwell_behind_a_law_for_none_leaves_the_vibration_of_its_last_acceleration(name, jump):
    """It is taken off at once; what jumps at the start, the third derivative at the lowest, adds 0.4 % here at most."""
    assert gc.shock_spectrum(name, [300.0, 300.25, 300.5]).residual == pytest.approx([jump] * 3, rel=5e-3)


def test_a_stiff_follower_is_strained_as_the_rigid_one_by_smooth_laws_only():
    for name, jumps in JUMPING.items():
        (factor,) = gc.shock_spectrum(name, MAX_RATIO).factor
        if jumps > 2 or name in RISE_FALL_LAWS:  # a force that is only taken off at once, at the end, strains no more
            assert factor == pytest.approx(1, abs=0.02), name
        else:
            assert factor > 1.9, name  # a force that is put on at once strains a spring twice


# --- during the rise -------------------------------------------------------------------------------------------------


@over_all("zeta", [0.0, 0.08, 1.3])
@over_all("name", gc.LAWS)
def test_no_sample_of_the_response_exceeds_the_spectrum(name, zeta):
    u, after = np.linspace(0, 1, 4001), np.linspace(1, 31, 8001)
    ratios = [0.3, 1.1, 6.4]
    spectrum = gc.shock_spectrum(name, ratios, zeta)
    for k, n in enumerate(ratios):
        response = gc.follower_response(name, n, zeta)
        sampled = np.abs(response(u)[2]).max(), np.abs(response(after)[2]).max(), np.abs(response(after)[0] - 1).max()
        found = spectrum.primary[k], spectrum.residual[k], spectrum.amplitude[k]
        assert (response.primary, response.residual, response.amplitude) == pytest.approx(found, rel=1e-12)
        for least, greatest in zip(sampled, found, strict=True):
            assert least <= greatest * (1 + 1e-12) + 4 * EPS
            assert least == pytest.approx(greatest, rel=4e-3)


@over_all("n", [0.4, 2.7, 11.3])
def test_the_cycloidal_response_is_the_known_one(n):
    """x'' = 2 pi Omega^2/(Omega^2 - 4 pi^2) (sin 2 pi u - sin(Omega u)/n), by undetermined coefficients."""
    u, omega = np.linspace(0, 1, 101), math.tau * n
    factor = math.tau * omega**2 / (omega**2 - math.tau**2)
    x, x1, x2 = gc.follower_response("cycloidal", n)(u)
    np.testing.assert_allclose(x2, factor * (np.sin(math.tau * u) - np.sin(omega * u) / n), rtol=0, atol=2e-13)
    f = gc.law("cycloidal")(u)[0]
    np.testing.assert_allclose(omega**2 * (f - x), x2, rtol=0, atol=1e-12)
    assert x[0] == x1[0] == x2[0] == 0


def test_the_step_of_a_constant_acceleration_doubles_the_strain():
    """4 (1 - cos Omega u) in the first half: twice the cam's own; and 16 at most in all, once both jumps add up."""
    n = np.arange(1, 40) + 0.31
    spectrum = gc.shock_spectrum("rectangular", n)
    assert np.all(spectrum.primary[1:] >= 8)
    assert np.all(spectrum.maximum <= 16 * (1 + 1e-12))
    u = np.linspace(0, 0.5, 51)
    x2 = gc.follower_response("rectangular", 7.3)(u)[2]
    np.testing.assert_allclose(x2, 4 * (1 - np.cos(math.tau * 7.3 * u)), atol=1e-12)


def test_in_the_dwell_it_vibrates_freely_and_before_the_rise_it_rests():
    response = gc.follower_response("cosine", 1.2)
    u = np.array([1.0, 1.4, 2.9])
    period = 1 / 1.2
    for now, later in zip(response(u), response(u + 3 * period), strict=True):
        np.testing.assert_allclose(later, now, rtol=1e-12, atol=1e-13)
    damped = gc.follower_response("cosine", 1.2, 0.1)
    shrunk = math.exp(-0.1 * math.tau * 1.2 * period / math.sqrt(1 - 0.01))
    (x, *_), (later, *_) = damped(u), damped(u + period / math.sqrt(1 - 0.01))
    np.testing.assert_allclose(later - 1, shrunk * (x - 1), rtol=1e-12)
    assert [float(each) for each in response(-0.5)] == [0, 0, 0]
    assert np.isnan(response([math.nan, 0.5])[0]).tolist() == [True, False]
    assert response(0.5)[0].shape == ()


# --- any law, any motion ---------------------------------------------------------------------------------------------


def test_a_law_of_ones_own_is_taken_piece_by_piece():
    """The mirrored parabola: its first half's mirror image does not go on as the first half does."""
    own = gc.Law("constant acceleration", lambda u: (2 * u**2, 4 * u, 4, 0), mirrored=True)
    n = np.linspace(0.2, 9, 50)
    np.testing.assert_allclose(
        gc.shock_spectrum(own, n).residual, gc.shock_spectrum("rectangular", n).residual, rtol=1e-12, atol=1e-13
    )
    unequal = gc.law("rectangular", ratio=2.7)
    middle = 1 / 3.7
    for n in (0.8, 3.3):
        omega = math.tau * n
        # f'' is 2/middle up to the middle and -2/(1 - middle) from there on: three jumps.
        up, down = 2 / middle, 2 / (1 - middle)
        exact = abs(up - (up + down) * np.exp(1j * omega * middle) + down * np.exp(1j * omega))
        assert gc.shock_spectrum(unequal, n).residual.item() == pytest.approx(exact, rel=1e-12)


def test_a_law_through_samples_comes_to_the_law_itself():
    u = np.linspace(0, 1, 41)
    own = gc.sampled_law("sampled", u, gc.law("cycloidal")(u, 0)[0])
    n = np.array([0.7, 1.6, 3.4])
    for name in ("primary", "residual"):
        sampled, exact = (getattr(gc.shock_spectrum(law, n), name) for law in (own, "cycloidal"))
        np.testing.assert_allclose(sampled, exact, rtol=2e-3)


def test_the_rise_of_a_motion_is_that_of_its_law():
    motion = gc.Motion(
        [gc.Rise(30, 1.3, "modified-sine"), gc.Dwell(1), gc.Return(30, 0.9, "2-3"), gc.Dwell(math.tau - 3.2)]
    )
    n = np.array([0.6, 2.2, 5.1])
    of_motion, of_law = gc.shock_spectrum(motion, n), gc.shock_spectrum("modified-sine", n)
    for name in ("primary", "residual", "amplitude"):
        np.testing.assert_allclose(getattr(of_motion, name), getattr(of_law, name), rtol=1e-11)
    assert of_motion.peak == pytest.approx(of_law.peak, rel=1e-14)


def test_a_rise_and_a_return_without_a_dwell_are_one_event_wherever_the_turn_begins():
    """Two pulses, the second one a shifted and turned one: |1 - exp(i Omega)| times what each alone leaves."""
    phases = [gc.Return(30, 1.0, "cycloidal"), gc.Dwell(math.tau - 2), gc.Rise(30, 1.0, "cycloidal")]
    motion = gc.Motion(phases)
    event = event_of(motion)
    assert event.end == pytest.approx(2)
    assert event.name == "rise and return"
    assert event.level == pytest.approx(0, abs=1e-12)
    n = np.array([0.8, 1.4, 2.75])
    alone = gc.shock_spectrum("cycloidal", n).residual
    together = gc.shock_spectrum(motion, n).residual
    np.testing.assert_allclose(together, np.abs(1 - np.exp(2j * math.pi * n)) * alone, rtol=1e-10)
    response = gc.follower_response(motion, 2.75)
    assert response([2.0, 5.0])[0] == pytest.approx([0, 0], abs=response.amplitude)


def test_a_cam_of_arcs_leaves_its_fourier_transform_too():
    arcs = gc.three_arc_cam(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, A=(0, 40))[0]
    motion = gc.ArcMotion(arcs, 10.0, 0.5)
    rise, lifted = motion.rise, motion.lift
    ends = motion.edges[:4]
    places, weights = np.polynomial.legendre.leggauss(60)
    phi = (ends[:-1] + ends[1:])[:, None] / 2 + np.diff(ends)[:, None] / 2 * places
    for n in (0.9, 3.7):
        wave = np.exp(1j * math.tau * n * phi / rise)
        integral = np.sum(np.diff(ends)[:, None] / 2 * weights * motion(phi.ravel())[2].reshape(phi.shape) * wave)
        exact = math.tau * n * abs(integral) * rise / lifted
        assert gc.shock_spectrum(motion, n).residual.item() == pytest.approx(exact, rel=1e-9)


def test_a_measured_motion_has_a_spectrum():
    motion = gc.builtin_task("measured").motion()
    found = gc.shock_spectrum(motion, [0.5, 2, 8])
    assert np.all(found.maximum > 0)
    assert found.law == "measured"


# --- what cannot be --------------------------------------------------------------------------------------------------


@over_all(
    ("asked", "message"),
    [
        (
            {"n": 0.0},
            "n is 0.0, but must be greater than 0 and at most 1000; n is the rise time over the natural period",
        ),
        ({"n": -1.5}, "n is -1.5"),
        ({"n": math.nan}, "n is nan"),
        ({"n": 1e4}, "n is 10000.0, .*; so stiff a follower follows the cam"),
        ({"damping": -0.1}, "damping is -0.1, but must be a ratio to the critical damping from 0 to 10; 2 % is 0.02"),
        ({"damping": math.nan}, "damping is nan"),
        ({"damping": 20}, "damping is 20"),
        ({"law": "cicloid"}, "did you mean 'cycloidal'?"),
    ],
)
def test_what_cannot_be_is_refused_with_reason(asked, message):
    given = {"law": "cycloidal", "n": 2.0, "damping": 0.0} | asked
    for function in (gc.shock_spectrum, gc.follower_response):
        with pytest.raises(gc.DesignError, match=message.replace("?", r"\?")):
            function(**given)


def test_a_spectrum_of_no_ratio_and_a_motion_without_a_dwell_are_refused():
    with pytest.raises(gc.DesignError, match="n is empty, but must be one ratio or more"):
        gc.shock_spectrum("cosine", [])
    restless = gc.Motion([gc.Rise(30, 3, "cosine"), gc.Return(30, math.tau - 3, "cosine")])
    with pytest.raises(gc.DesignError, match=r"motion is without a dwell before a rise.*gc\.VibratingFollower"):
        gc.shock_spectrum(restless, 2.0)


def test_few_lines_tell_what_was_found():
    assert repr(gc.shock_spectrum("cycloidal", [1, 2.0])).splitlines() == [
        "ShockSpectrum, cycloidal",
        "  n from 1 to 2, 2 in all; damping ratio 0",
        "  greatest dynamic factor 3.142 at n = 1, of C_a = 6.28319",
        "primary, residual, amplitude, factor: of each n; .plot() draws them",
    ]
    assert "amplitude after it 0.0242522 lifts" in repr(gc.follower_response("cycloidal", 2.5))

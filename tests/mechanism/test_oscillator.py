"""The oscillator: closed forms at 40 digits for any damping and stiffness, scipy's steps, the theorems of energy."""

from __future__ import annotations

import math
import tracemalloc
from itertools import pairwise

import numpy as np
import pytest
from mpmath import expj, mp, mpc, mpf
from over_all import over_all
from reference import EPS
from scipy.integrate import solve_ivp

import graphcam as gc
from graphcam.mechanism.oscillator import Drive, Oscillator, driven, steady

DAMPINGS = (0.0, 0.02, 0.5, 1 - 1e-13, 1 - 1e-6, 1.0, 1 + 1e-13, 1 + 1e-6, 1.5, 3.0, 10.0)
PERIODS = (1e-9, 1e-6, 1e-3, 0.3, 2.2, 7.3, 30.3, 300.3, 1e4 + 0.3, 1e6 + 0.3, 1e9)
"""Natural periods in the time of the forcing, from very soft to very stiff."""
TIMES = np.array([1e-3, 0.11, 0.25, 0.37, 0.5, 0.62, 0.75, 0.93, 1.0])
SINE = Drive(np.array([0.0, 0.5, 1.0]), lambda t: -math.tau * np.sin(math.tau * t))


def under_a_sine(nu: float, zeta: float, t: float) -> mpf:
    """From rest under -2 pi sin(2 pi t), by undetermined coefficients at 40 digits."""
    nu, zeta, t, omega = mpf(nu), mpf(zeta), mpf(t), 2 * mp.pi
    wave = -omega / (nu**2 - omega**2 + 2j * zeta * nu * omega)
    forced, start, speed = (wave * expj(omega * t)).imag, wave.imag, (1j * omega * wave).imag
    root = mp.sqrt(mpc(zeta * zeta - 1))
    slow, fast = nu * (-zeta + root), nu * (-zeta - root)
    if root == 0:
        return forced - (start + (speed - slow * start) * t) * mp.exp(slow * t)
    first = (fast * start - speed) / (slow - fast)
    return (forced + first * mp.exp(slow * t) - (start + first) * mp.exp(fast * t)).real


@over_all("zeta", DAMPINGS)
def test_soft_or_stiff_and_with_any_damping_every_digit_is_right(zeta):
    """Rounding alone, 40 eps of the greatest value, from a billionth of a natural period to a billion of them."""
    with mp.workdps(40):
        for periods in PERIODS:
            nu = math.tau * periods
            y, _ = driven(Oscillator(np.array([nu]), zeta), SINE).at(TIMES)
            exact = [under_a_sine(nu, zeta, t) for t in TIMES]
            off = max(abs(mpf(found) - there) for found, there in zip(y[0].tolist(), exact, strict=True))
            assert off <= 40 * EPS * max(map(abs, exact)), periods


def test_many_oscillators_at_once_are_the_same_one_by_one():
    nu = math.tau * np.array([1.2, 1.35, 1.5])
    together = driven(Oscillator(nu, 0.1), SINE)
    for k in range(3):
        alone = driven(Oscillator(nu[k : k + 1], 0.1), SINE)
        np.testing.assert_allclose(
            np.array(together.at(TIMES))[:, k], np.array(alone.at(TIMES))[:, 0], rtol=1e-12, atol=1e-14
        )


def test_errors_do_not_grow_over_hundreds_of_stretches():
    """Undamped, over 100 turns of the forcing: what is off at last is the phase, eps times all that it has turned."""
    turns = 100
    drive = Drive(np.arange(2.0 * turns + 1) / 2, SINE.forcing)
    nu = math.tau * 1.37
    with mp.workdps(40):
        for t in (1.0, 10.3, 99.3):
            (y,), _ = driven(Oscillator(np.array([nu]), 0.0), drive).at(np.array([t]))
            assert abs(float(y[0]) - float(under_a_sine(nu, 0.0, t))) <= 4 * EPS * (1 + nu * t)


@over_all(("name", "zeta", "periods"), [("modified-trapezoidal", 0.07, 5.3), ("rectangular", 1.4, 3.3)])
def test_steps_of_scipy_come_to_the_same(name, zeta, periods):
    """DOP853 from break to break, which steps and does not know the solution."""
    law, nu = gc.law(name), math.tau * periods
    edges = [0.0, *law.edges, 1.0]
    solved = driven(Oscillator(np.array([nu]), zeta), Drive(np.array(edges), lambda u: -law(u)[2]))
    state = np.zeros(2)
    for start, end in pairwise(edges):

        def slope(u, z, start=start, end=end):
            inside = np.clip(u, np.nextafter(start, 1), np.nextafter(end, 0))
            return [z[1], -float(law(inside)[2]) - 2 * zeta * nu * z[1] - nu * nu * z[0]]

        state = solve_ivp(slope, (start, end), state, "DOP853", rtol=1e-11, atol=1e-13).y[:, -1]
        y, y1 = solved.at([end])
        assert [y.item(), y1.item()] == pytest.approx(state, abs=1e-9)


@over_all("zeta", [0.0, 0.05, 1.0, 2.0])
@over_all("periods", [0.7, 12.3, 150.2])
def test_the_work_of_the_forcing_is_stored_or_lost_in_the_damper(zeta, periods):
    """g y' integrates to the energy (y'^2 + nu^2 y^2)/2 at the end and the loss 2 zeta nu y'^2: energy balance."""
    nu = math.tau * periods
    solved = driven(Oscillator(np.array([nu]), zeta), SINE)
    places, weights = np.polynomial.legendre.leggauss(16)
    ends = np.linspace(0, 1, 40 + round(8 * periods) + 1)
    t = (ends[:-1] + ends[1:])[:, None] / 2 + np.diff(ends)[:, None] / 2 * places
    _, (y1,) = solved.at(t.ravel())
    work, lost = (
        float(np.sum(np.diff(ends)[:, None] / 2 * weights * power.reshape(t.shape)))
        for power in (SINE.forcing(t.ravel()) * y1, 2 * zeta * nu * y1**2)
    )
    (y,), (y1,) = solved.final
    stored = (y1**2 + (nu * y) ** 2) / 2
    assert work == pytest.approx(stored + lost, rel=1e-11, abs=1e-13 * float(np.abs(y1)))


@over_all("zeta", DAMPINGS)
def test_free_vibrations_follow_one_another(zeta):
    """Free for t1 and then for t2 is free for t1 + t2: the semigroup; at 0 nothing has changed."""
    oscillator = Oscillator(np.array([0.3, 2.0, 11.0]), zeta)
    y, y1 = np.array([1.0, -0.2, 0.5]), np.array([0.3, 1.0, -4.0])
    t1, t2 = np.full(3, 0.37), np.full(3, 0.81)
    np.testing.assert_array_equal(oscillator.free(0 * t1, y, y1), (y, y1))
    twice = oscillator.free(t2, *oscillator.free(t1, y, y1))
    np.testing.assert_allclose(oscillator.free(t1 + t2, y, y1), twice, rtol=1e-11, atol=1e-13)


@over_all("zeta", DAMPINGS)
@over_all("seed", range(3))
def test_no_sample_of_a_free_vibration_exceeds_its_peak(zeta, seed):
    rng = np.random.default_rng(seed)
    oscillator = Oscillator(rng.uniform(0.5, 5, 20), zeta)
    y, y1 = rng.normal(size=(2, 20)) * [[1], [3]]
    peak = oscillator.free_peak(y, y1)
    sampled = np.abs(oscillator.free(np.linspace(0, 30, 20_001)[None], y[:, None], y1[:, None])[0]).max(axis=1)
    assert np.all(sampled <= peak * (1 + 1e-12))
    np.testing.assert_allclose(sampled, peak, rtol=1e-4)


def test_a_free_vibration_without_damping_has_the_amplitude_of_its_energy():
    peak = Oscillator(np.array([3.0]), 0.0).free_peak(np.array([0.4]), np.array([-1.5]))
    assert peak.item() == pytest.approx(math.hypot(0.4, 0.5), rel=1e-14)


@over_all("nu", [0.5, 17.0, 90.0, 400.0, 1300.0])
def test_a_forcing_that_is_sharp_is_divided_until_it_is_resolved(nu):
    """A peak that one series of 20 terms cannot follow; against the convolution at 30 digits, soft, stiff, between."""
    drive = Drive(np.array([0.0, 1.0]), lambda t: 1 / (1 + 400 * (t - 0.4) ** 2))
    assert drive.resolved[0] > 4
    (y,), (y1,) = driven(Oscillator(np.array([nu]), 0.0), drive).at([1.0])
    with mp.workdps(30):
        places = sorted({*mp.linspace(0, 1, 3 + round(nu / 10)), mpf("0.35"), mpf("0.4"), mpf("0.45")})
        wave = mp.quad(lambda t: expj(nu * (1 - t)) / (1 + 400 * (t - mpf("0.4")) ** 2), places)
    size = float(abs(wave)) + 1 / nu
    assert nu * y.item() == pytest.approx(float(wave.imag), abs=2e-13 * size)
    assert y1.item() == pytest.approx(float(wave.real), abs=2e-13 * size)


def test_polynomials_are_followed_by_one_series():
    for name in ("rectangular", "trapezoidal", "2-3", "3-4-5", "4-5-6-7", "cycloidal", "modified-sine"):
        law = gc.law(name)
        drive = Drive(np.array([0.0, *law.edges, 1.0]), lambda u, law=law: -law(u)[2])
        assert set(drive.resolved) <= {0, 1}, name
    # A stiff oscillator takes no more cells than the forcing does.
    assert drive.counts(Oscillator(np.array([1e9]), 0.0)).tolist() == [[-1] * len(drive.resolved)]


@over_all("zeta", [0.0, 0.03, 1.0, 4.0])
def test_the_steady_motion_under_a_sine_is_the_known_one(zeta):
    """Amplitude and phase of the forced vibration: S. S. Rao, Mechanical Vibrations, chapter 3."""
    nu = 3.5
    y, y1 = steady(Oscillator(np.array([nu]), zeta), SINE).at(TIMES)
    wave = -math.tau / (nu**2 - math.tau**2 + 2j * zeta * nu * math.tau) * np.exp(1j * math.tau * TIMES)
    np.testing.assert_allclose(y[0], wave.imag, rtol=0, atol=1e-14)
    np.testing.assert_allclose(y1[0], (1j * math.tau * wave).imag, rtol=0, atol=1e-13)


def test_the_heaviest_damping_takes_bounded_memory():
    """Between short and long the cells are 400 times as many as without damping; few oscillators are solved at once."""
    tracemalloc.start()
    gc.shock_spectrum("modified-trapezoidal", np.linspace(40, 42, 9), damping=10.0)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 100e6


def test_in_resonance_there_is_no_steady_motion():
    assert steady(Oscillator(np.array([3 * math.tau]), 0.0), SINE) is None
    assert steady(Oscillator(np.array([3 * math.tau]), 1e-4), SINE) is not None

"""Random motions, sampled with noise and measured: no false leg, ends as far as noise lets them be told, true peaks."""

from __future__ import annotations

import math
from math import radians

import numpy as np
import pytest
from measured_tables import lobe, lobe_outcome, outcomes
from numpy.testing import assert_allclose
from over_all import fast_first, over_all, over_seeds

from graphcam.bench.measured_rows import (
    NOISE_DEVIATIONS,
    PEAK_GOALS,
    Sampled,
    best_scatter,
    random_motion,
    sampled_motions,
)
from graphcam.errors import DesignError
from graphcam.given.leg_detection import _slow_rows, find_legs
from graphcam.given.measured import measured_motion
from graphcam.given.monotone_spline import LinearForms
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.given.motion_law import Law

DEGREES = np.radians(np.arange(0.0, 360.0))
MOTION = Motion([Rise(30, radians(80)), Dwell(radians(45)), Return(30, radians(60)), Dwell(radians(175))])
A_JUMP_BETWEEN_ROWS = 0.06
"""Part of the tables without noise in which a jump or a corner between two rows takes max |a| beyond its goal ..."""
BETWEEN_ROWS = 0.04, 0.13
"""... and by how much at most: where in 1 degree it lies, a spline that cannot jump has to guess."""
HIDDEN_BY_CHANCE = 0.001
"""Part of the ends that may lie beyond what the best test tells, which knows all the rest of the motion ..."""
FURTHER = 1.5
"""... and how much further."""

pytestmark = pytest.mark.filterwarnings("error")


def check(sampled: list[Sampled]) -> None:
    """The goals, by noise."""
    for noise in NOISE_DEVIATIONS:
        some = [one for one in sampled if one.noise == noise]
        assert all(one.phases_right for one in some)
        ends = [one.end_error for one in some]
        assert max(ends) <= FURTHER
        assert np.mean(np.array(ends) > 1) <= HIDDEN_BY_CHANCE * 2 * len(NOISE_DEVIATIONS)
        for jumps, goal in enumerate(PEAK_GOALS[noise]):
            off = np.array([abs(one.peak_error) for one in some if one.jumps == bool(jumps) and one.motion.lift >= 10])
            if noise:
                assert np.all(off <= goal)
            else:
                assert np.sum(off > goal) <= max(1, A_JUMP_BETWEEN_ROWS * off.size)
                assert np.all(off <= BETWEEN_ROWS[jumps])


def test_random_motions_are_told_from_their_tables():
    check(list(sampled_motions(10)))


@over_seeds(4)
def test_a_table_of_any_noise_and_tolerance_gives_a_motion_or_a_message(seed):
    random = np.random.default_rng([7, seed])
    motion, rows = random_motion(random), int(random.choice([8, 12, 24, 36, 72]))
    noise = 10 ** random.uniform(-4, 0.5)
    tolerance = noise * 10 ** random.uniform(-1, 2)
    phi = np.arange(rows) * FULL_TURN / rows
    s = motion(phi)[0] + noise * random.standard_normal(rows)
    try:
        measured = measured_motion(phi, s, tolerance)
    except DesignError:
        return
    assert measured.max_residual <= tolerance
    assert min(phase.angle for phase in measured.phases) >= 0.999 * FULL_TURN / rows


def test_rows_that_do_not_climb_between_two_flats_are_no_way_on_which_to_rest():
    assert _slow_rows(np.arange(12.0), np.linspace(1.0, 0.0, 12), 0.01, 0.02) == []


NOISY = np.random.default_rng(11).standard_normal(72)


@over_all("sigmas", [2, 3, 4.5, 20])
def test_round_phases_come_out_round_though_the_tolerance_is_that_of_few_sigmas(sigmas):
    """5-degree rows that scatter by 0.009 mm, and what a student may take for the tolerance: 2 or 3 sigma, or more."""
    parts = [Rise(12, radians(130)), Dwell(radians(50)), Return(12, radians(120)), Dwell(radians(60))]
    s = Motion(parts)(DEGREES[::5])[0] + 0.009 * NOISY
    measured = measured_motion(DEGREES[::5], s, sigmas * 0.009)
    assert [phase.kind for phase in measured.phases] == ["rise", "dwell", "return", "dwell"]
    assert_allclose(np.degrees(measured.angles), [130, 50, 120, 60], atol=5.01)
    assert measured.max_residual <= measured.tolerance


@pytest.mark.parametrize("law", fast_first(["3-4-5", "cycloidal", "rectangular"]))
def test_dense_rows_with_noise_keep_their_dwells(law):
    """Slow rows beside a rest look like one of their own where rows are dense, and must not hide it."""
    parts = [Rise(30, radians(80), law), Dwell(radians(45)), Return(30, radians(60), law), Dwell(radians(175))]
    phi = np.radians(np.arange(0, 360, 0.1))
    s = Motion(parts)(phi)[0] + 0.01 * np.random.default_rng(1).standard_normal(phi.size)
    measured = measured_motion(phi, s, 0.06)
    moving = [phase for phase in measured.phases if phase.angle > radians(1)]
    assert [phase.kind for phase in moving] == ["rise", "dwell", "return", "dwell"]
    assert_allclose(np.degrees([phase.angle for phase in moving]), [80, 45, 60, 175], atol=1.0)
    assert measured.max_residual <= 0.06


@over_all("tolerance", [0.0005, 0.001, 0.002])
def test_a_tolerance_below_the_noise_is_told_with_one_that_is_enough(tolerance):
    s = MOTION(DEGREES[::5])[0] + 0.009 * NOISY
    with pytest.raises(DesignError, match=r"give a greater tolerance, as [\d.e-]+, or a table") as caught:
        measured_motion(DEGREES[::5], s, tolerance)
    enough = float(caught.value.remedy.split(" as ")[1].split(",")[0])
    assert measured_motion(DEGREES[::5], s, enough).max_residual <= enough


@pytest.mark.slow
def test_more_random_motions_are_told_from_their_tables():
    check(list(sampled_motions(80)))


@pytest.mark.slow
def test_the_peaks_scatter_little_more_than_in_the_best_linear_estimate():
    """Which knows the place of the peak, and no bounds; what is reached knows neither, and has a bias besides."""
    for noise in NOISE_DEVIATIONS[1:]:
        some = [one for one in sampled_motions(100, seed=1) if one.noise == noise]
        reached, best = (np.array([(one.peak_error, one.least_scatter) for one in some]) ** 2).mean(axis=0) ** 0.5
        assert best < reached < 3.2 * best


def test_every_phase_is_a_law_by_all_that_a_law_must_keep_to():
    noisy = MOTION(DEGREES)[0] + 0.01 * np.random.default_rng(0).standard_normal(360)
    for phase in measured_motion(DEGREES, noisy, 0.045).phases:
        if not isinstance(phase, Dwell):
            law = phase.normalised
            Law("checked", law.formulas, law.edges, middle=law.middle, peaks=law.peaks)


def test_noise_and_not_a_wide_tolerance_sets_the_smoothing():
    s = MOTION(DEGREES)[0]
    fits = [measured_motion(DEGREES, s, tolerance) for tolerance in (0.1, 0.01, 0.001)]
    for fit in fits:
        assert fit.max_residual <= fit.tolerance / 5
        assert_allclose(fit(DEGREES), fits[0](DEGREES), rtol=1e-9, atol=1e-9)


def test_a_row_beyond_the_noise_is_kept_to_the_tolerance_or_refused():
    s = MOTION(DEGREES)[0] + 0.002 * np.random.default_rng(2).standard_normal(360)
    s[40] += 0.01
    assert measured_motion(DEGREES, s, 0.009).max_residual <= 0.009
    s[40] += 0.1
    with pytest.raises(DesignError, match="as the rows on both sides say"):
        measured_motion(DEGREES, s, 0.009)


@over_all("bump", [0.0, 0.005, 0.012])
def test_two_rests_on_a_level_that_noise_cannot_tell_apart_are_one(bump):
    """A bump of less than the tolerance hides, in the middle of a rest, is no leg."""
    s = MOTION(DEGREES)[0]
    s[250:260] += bump
    s[80:125] += np.where(np.arange(45) < 20, 0.0, bump / 2)
    measured = measured_motion(DEGREES, s, 0.01)
    assert [phase.kind for phase in measured.phases if not isinstance(phase, Dwell)] == ["rise", "return"]
    assert_allclose([phase.angle for phase in measured.phases], np.radians([80, 45, 60, 175]), atol=radians(2))


@over_seeds(4)
def test_rests_are_found_under_waves_that_are_no_noise_of_rows(seed):
    """Waves of a third of the tolerance, as an integration leaves: neighbouring rows do not scatter by them."""
    random = np.random.default_rng(seed)
    waves = sum(random.standard_normal() * np.sin(k * DEGREES + random.uniform(0, 6)) for k in range(3, 12))
    s = MOTION(DEGREES)[0] + 0.007 * waves / np.max(np.abs(waves)) + 2e-4 * random.standard_normal(360)
    measured = measured_motion(DEGREES, s, 0.02)
    assert [phase.kind for phase in measured.phases if phase.direction] == ["rise", "return"]
    assert sum(phase.kind == "dwell" for phase in measured.phases) >= 2


@over_all("power", ["2-3", "3-4-5", "4-5-6-7"])
def test_rests_end_at_the_row_where_the_law_does(power):
    motion = Motion(
        [Rise(30, radians(80), power), Dwell(radians(45)), Return(30, radians(60), power), Dwell(radians(175))]
    )
    legs, misfit = find_legs(DEGREES, motion(DEGREES)[0], 0.01, 1e-5)
    # Where the acceleration jumps the leg begins and ends half a row outside, so that its ramp lies about the jump.
    outside = 0.5 if power == "2-3" else 0.0
    ends = np.degrees([(leg.start, leg.end) for leg in legs]) % 360
    wanted = np.array([[-outside, 80 + outside], [125 - outside, 185 + outside]]) % 360
    assert_allclose(ends[np.argsort(ends[:, 1])], wanted, atol=0.3)
    assert misfit < 2


@over_all("rows", [8, 12, 18, 36, 72])
def test_few_rows_are_enough_for_an_eccentric(rows):
    phi = np.arange(rows) * FULL_TURN / rows
    measured = measured_motion(phi, 10 - 10 * np.cos(phi - 0.3), 0.05)
    assert [phase.kind for phase in measured.phases] == ["rise", "return"]
    assert measured.max_residual <= 0.05


def test_the_best_linear_estimate_is_that_of_least_squares_for_a_cubic():
    x = np.radians(np.linspace(-10, 12, 23))
    cubic = np.linalg.inv(np.vander(x, 4, increasing=True).T @ np.vander(x, 4, increasing=True))
    assert best_scatter(x, 0.01, 0.0) == pytest.approx(0.02 * math.sqrt(cubic[2, 2]), rel=1e-6)


def test_the_best_linear_estimate_is_that_of_a_state_estimator():
    """R. E. Kalman's filter, forward to the place and backward to it, with the covariances of an integrated jerk."""
    x, noise, q = np.radians(np.linspace(-10, 10, 21)), 0.01, 3e4
    information = [_filtered(x[x <= 0], noise, q), _filtered(-x[x > 0][::-1], noise, q, to=0.0)]
    flip = np.diag([1.0, -1.0, 1.0, -1.0])
    together = information[0] + flip @ information[1] @ flip
    assert best_scatter(x, noise, q) == pytest.approx(math.sqrt(np.linalg.inv(together)[2, 2]), rel=1e-3)


def _filtered(x: np.ndarray, noise: float, q: float, to: float | None = None) -> np.ndarray:
    """The information on (s, v, a, j) at the last of the places, or at ``to``, from displacements at all of them."""
    covariance = np.diag([1e2, 1e4, 1e6, 1e8])
    for k, here in enumerate(x):
        gain = covariance[:, 0] / (covariance[0, 0] + noise**2)
        covariance = covariance - np.outer(gain, covariance[0])
        h = (x[k + 1] if k + 1 < x.size else here if to is None else to) - here
        ahead = np.array(
            [[h ** (j - i) / math.factorial(j - i) if j >= i else 0.0 for j in range(4)] for i in range(4)]
        )
        power = 3 - np.arange(4)
        grown = h ** (power[:, None] + power + 1) / (power[:, None] + power + 1)
        factorials = np.array([math.factorial(p) for p in power])
        covariance = ahead @ covariance @ ahead.T + q * grown / np.outer(factorials, factorials)
    return np.linalg.inv(covariance)


def test_the_band_is_that_of_the_squares():
    random = np.random.default_rng(4)
    forms = LinearForms(random.integers(0, 7, (12, 3)), random.standard_normal((12, 3)))
    dense = np.zeros((12, 7))
    np.add.at(dense, (np.arange(12)[:, None], forms.unknowns), forms.factors)
    weights = random.uniform(1, 2, 12)
    matrix = dense.T @ (weights[:, None] * dense)
    band = forms.normal_matrix(weights, 7, 7)
    assert_allclose(band, [[matrix[i + k, i] if i + k < 7 else 0.0 for i in range(7)] for k in range(7)], atol=1e-12)
    assert_allclose(forms.transposed(weights, 7), dense.T @ weights)


def test_of_random_tables_with_noise_and_run_out_no_dwell_is_lost_or_false():
    """A sample of ``python tests/given/measured_tables.py``."""
    for table, count in outcomes(14, seed=2):
        assert not count["lost"] + count["false"] + count["refused"], (table.law, table.kind, table.step)
        assert count["found"] == len(table.dwells)


@over_all("law", ["rectangular", "cosine", "3-4-5", "cycloidal"])
def test_a_dwell_is_found_under_noise_of_a_hundredth_of_the_lift(law):
    motion = Motion([Rise(20, radians(112), law), Return(20, radians(186), law), Dwell(radians(62))])
    for seed in range(3):
        noise = np.random.default_rng(seed).normal(0, 0.2, 360)
        measured = measured_motion(DEGREES, motion(DEGREES)[0] + noise, 6.75 * 0.2)
        kinds = [phase.kind for phase in measured.phases]
        assert "dwell" in kinds
        assert [kind for kind in kinds if kind != "dwell"] == ["rise", "return"]


@over_all("tolerance", [0.03, 0.1, 0.5])
def test_a_run_out_of_less_than_the_tolerance_is_no_motion(tolerance):
    """An eccentricity of 10 micrometres over the whole turn, in rows of four decimals."""
    motion = Motion([Rise(30, radians(100)), Dwell(radians(60)), Return(30, radians(100)), Dwell(radians(100))])
    for phase in (0.0, 1.0, 2.5, 4.0):
        rows = np.round(motion(DEGREES)[0] + 0.01 * np.sin(DEGREES + phase), 4)
        measured = measured_motion(DEGREES, rows, tolerance)
        # A dwell may reach over the beginning of the turn.
        dwells = [np.degrees([a, b]) % 360 for kind, a, b in measured.timing if kind == "dwell" and b - a > 0.1]
        assert_allclose(dwells[0] + np.degrees(measured.zero), [100, 160], atol=4)
        assert [p.kind for p in measured.phases if p.direction] == ["rise", "return"]
        assert_allclose(np.degrees([p.angle for p in measured.phases if p.direction]), 100, atol=3)


def test_of_lobes_of_arcs_none_is_said_to_be_undercut_but_those_that_are():
    counts = [lobe_outcome(3, k) for k in range(8)]
    assert sum(count["smoothed"] for count in counts) > 0
    assert sum(count["false"] for count in counts) == 0
    assert sum(count["told"] for count in counts) >= 6


def test_the_radii_of_curvature_of_a_lobe_are_those_of_its_arcs():
    phi = np.radians(np.arange(0, 360, 0.01))
    s = lobe(phi, 11.0, 0.5, 14.0, 40.0)
    rho = 11 + s + np.gradient(np.gradient(s, phi), phi)
    off = np.abs(rho[:, None] - [11.0, 0.5, 40.0]).min(axis=1)
    # But for the rows beside the four joints.
    assert np.sum(off > 1e-3) < 30
    assert all(np.sum(np.abs(rho - radius) < 1e-3) > 1000 for radius in (11.0, 0.5, 40.0))

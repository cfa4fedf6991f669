"""Motions through tables: sampled from known motions, with noise, and what no motion can be made of."""

from __future__ import annotations

import copy
import math
import os
import pickle
import subprocess
import sys
from itertools import pairwise
from math import radians

import numpy as np
import pytest
from numpy.testing import assert_allclose
from over_all import over_all

from graphcam.errors import DesignError
from graphcam.given.follower import Translating
from graphcam.given.measured import RowError, integrated_motion, measured_motion
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.given.reproducible_sums import column_sums, ordered_sum
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import minimum_radius

DEGREES = np.radians(np.arange(0.0, 360.0))
DENSE = np.linspace(0, FULL_TURN, 20_001)[:-1]


def motion_of(*phases: tuple) -> Motion:
    """Phases as (signed lift [mm], degrees, law); without a lift, a dwell."""
    kinds = {1: Rise, -1: Return}
    return Motion([
        kinds[int(math.copysign(1, lift))](abs(lift), radians(angle), *law) if lift else Dwell(radians(angle))
        for lift, angle, *law in phases
    ])  # fmt: skip


LAWS = {
    "3-4-5": motion_of((30, 80, "3-4-5"), (0, 45), (-30, 60, "3-4-5"), (0, 175)),
    "4-5-6-7": motion_of((20, 120, "4-5-6-7"), (0, 30), (-20, 110, "4-5-6-7"), (0, 100)),
    "cycloidal": motion_of((30, 100, "cycloidal"), (0, 40), (-30, 120, "cycloidal"), (0, 100)),
}


def table(motion: Motion, phi=DEGREES, decimals: int = 3):
    return np.round(motion(phi)[0], decimals)


@over_all("law", LAWS)
def test_a_table_of_a_law_gives_the_cam_of_the_law(law):
    """1 degree steps, rounded to 0.001 mm: the pitch curve lies within the tolerance of the exact one."""
    exact = LAWS[law]
    measured = measured_motion(DEGREES, table(exact), tolerance=0.01)
    cams = [Cam(motion, Translating(offset=10, roller_radius=12), 50) for motion in (measured, exact)]
    points, curve = (cam.pitch_curve(DENSE) for cam in cams)
    # The way to the nearest of dense points: between them the curve strays from its chord by h^2/8 rho, 1e-5 mm.
    for k in range(0, DENSE.size, 97):
        near = curve[np.arange(k - 200, k + 200) % DENSE.size]
        assert np.min(np.hypot(*(near - points[k]).T)) <= measured.tolerance + 1e-4
    assert np.max(np.abs(measured(DENSE)[0] - exact(DENSE)[0])) <= measured.tolerance
    # Where a rest ends cannot be told from rows that are rounded: at 0 it may not have ended yet.
    kinds = [phase.kind for phase in measured.phases]
    assert kinds[kinds[0] == "dwell" :] == [phase.kind for phase in exact.phases]
    assert measured.zero == 0
    assert measured.max_residual <= measured.tolerance


@over_all("law", LAWS)
def test_the_derivatives_are_the_law_s_as_far_as_a_table_can_tell(law):
    exact, measured = LAWS[law], measured_motion(DEGREES, table(LAWS[law]), tolerance=0.003)
    errors = [np.max(np.abs(m - e)) / np.max(np.abs(e)) for m, e in zip(measured(DENSE), exact(DENSE), strict=True)]
    assert errors[1] < 0.0015
    assert errors[2] < 0.03


@over_all("law", LAWS)
@over_all("step", [1.0, 0.25])
def test_noise_of_a_tenth_of_the_tolerance_stays_out_of_the_acceleration(law, step):
    phi = np.radians(np.arange(0, 360, step))
    noise = 0.001 * np.random.default_rng(3).standard_normal(phi.size)
    exact, measured = LAWS[law], measured_motion(phi, LAWS[law](phi)[0] + noise, tolerance=0.01)
    error = np.max(np.abs(measured(DENSE - measured.zero)[2] - exact(DENSE)[2]))
    assert error < 0.06 * np.max(np.abs(exact(DENSE)[2]))


def test_the_motion_is_smooth_to_the_third_derivative():
    measured = measured_motion(DEGREES, table(LAWS["3-4-5"]))
    breaks = measured.breaks
    assert breaks.size > 10
    for left, right, size in zip(measured(breaks, "left"), measured(breaks, "right"), (1, 1, 1, 1), strict=True):
        scale = np.max(np.abs(right)) * size
        assert_allclose(left, right, atol=1e-11 * scale)
    at_rests = [k for k, phase in enumerate(measured.phases) if phase.kind == "dwell"]
    for k in at_rests:
        for values in measured.at([k - 1, (k + 1) % len(measured.phases)], [1.0, 0.0])[1:]:
            assert_allclose(values, 0.0, atol=1e-9)


@over_all("law", LAWS)
def test_the_derivatives_are_derivatives(law):
    """By the theorem of the calculus: from knot to knot v, a, j integrate to s, v, a (Gauss, exact for a quintic)."""
    measured = measured_motion(DEGREES, table(LAWS[law]))
    nodes, weights = np.polynomial.legendre.leggauss(4)
    scales = np.max(np.abs(measured(DENSE)), axis=1)
    for start, end in pairwise([*measured._piecewise.starts, FULL_TURN]):
        phi = (start + end) / 2 + (end - start) / 2 * nodes
        inside = measured(phi)
        begin, finish = measured(start), measured(end, "left")
        for k in range(3):
            change = (end - start) / 2 * weights @ inside[k + 1]
            assert float(finish[k] - begin[k]) == pytest.approx(change, abs=1e-12 * scales[k])


def test_no_phase_turns_on_its_way():
    noisy = LAWS["3-4-5"](DEGREES)[0] + 0.002 * np.random.default_rng(5).standard_normal(DEGREES.size)
    measured = measured_motion(DEGREES, noisy, tolerance=0.02)
    assert [phase.kind for phase in measured.phases if phase.kind != "dwell"] == ["rise", "return"]
    for k, phase in enumerate(measured.phases):
        velocity = measured.at(k, np.linspace(0, 1, 1000))[1]
        assert np.all(phase.direction * velocity >= -1e-9)


def test_peaks_are_those_of_the_law_s_pieces():
    for phase in measured_motion(DEGREES, table(LAWS["3-4-5"])).phases:
        if isinstance(phase, Dwell):
            continue
        law = phase.normalised
        _, f1, f2, _ = law(np.linspace(0, 1, 100_001))
        assert np.max(f1) == pytest.approx(law.peak_velocity, rel=1e-7)
        assert np.max(np.abs(f2)) == pytest.approx(law.peak_acceleration, rel=1e-4)
        assert np.max(np.abs(f2)) <= law.peak_acceleration * (1 + 1e-12)


def test_without_rests_the_spline_is_periodic_and_turns_where_the_motion_does():
    """An eccentric, s = 10 (1 - cos(phi - 40 deg)): counted from the turning point next to 0."""
    measured = measured_motion(DEGREES, np.round(10 - 10 * np.cos(DEGREES - radians(40)), 4), tolerance=0.001)
    assert [phase.kind for phase in measured.phases] == ["rise", "return"]
    assert measured.zero == pytest.approx(radians(40), abs=1e-4)
    assert_allclose(measured(DENSE - measured.zero)[0], 10 - 10 * np.cos(DENSE - radians(40)), atol=0.001)
    assert_allclose(measured(DENSE - measured.zero)[2], 10 * np.cos(DENSE - radians(40)), atol=0.2)


def test_several_rises_with_a_rest_between():
    exact = motion_of((10, 80, "3-4-5"), (0, 20), (20, 60, "cycloidal"), (-30, 120, "3-4-5"), (0, 80))
    measured = measured_motion(DEGREES, table(exact))
    assert [phase.kind for phase in measured.phases] == ["rise", "dwell", "rise", "return", "dwell"]
    assert_allclose(measured.levels, [0, 10, 10, 30, 0, 0], atol=0.01)
    assert_allclose(measured(DENSE - measured.zero)[0], exact(DENSE)[0], atol=0.02)


@over_all("turned", [0, 17, 100, 211, 300])
def test_where_a_table_begins_does_not_matter(turned):
    motion = LAWS["cycloidal"]
    phi = DEGREES + radians(turned)
    shifted = measured_motion(phi, table(motion, phi))
    plain = measured_motion(DEGREES, table(motion))
    assert shifted.zero == pytest.approx(plain.zero)
    assert_allclose(shifted(DENSE)[0], plain(DENSE)[0], atol=1e-9)


def test_a_row_that_closes_the_turn_changes_nothing():
    s = table(LAWS["3-4-5"])
    closed = measured_motion([*DEGREES, FULL_TURN], [*s, s[0]])
    assert_allclose(closed(DENSE), measured_motion(DEGREES, s)(DENSE))


def test_unequal_steps_are_as_good():
    random = np.random.default_rng(2)
    phi = np.sort(np.radians(np.arange(0, 360, 1.0) + random.uniform(-0.3, 0.3, 360)))
    measured = measured_motion(phi, table(LAWS["cycloidal"], phi))
    assert_allclose(measured(DENSE - measured.zero)[0], LAWS["cycloidal"](DENSE)[0], atol=0.01)


def test_the_least_radius_is_the_law_s():
    exact, measured = LAWS["3-4-5"], measured_motion(DEGREES, table(LAWS["3-4-5"]), tolerance=0.003)
    for limits in ((radians(30), None), (radians(30), radians(40)), (radians(70), None)):
        one, other = (minimum_radius(m, Translating(), rise=limits[0], return_=limits[1]) for m in (exact, measured))
        assert other.active == one.active
        assert other.prime_radius == pytest.approx(one.prime_radius, abs=0.02)


def test_the_tangent_is_found_on_the_highest_of_several_humps():
    """A rise with two humps of velocity: the line at the limit touches the one that dense points show."""
    phi = DEGREES
    u = np.clip(phi / radians(160), 0, 1)
    rise = u - np.sin(4 * np.pi * u) / (4 * np.pi)
    back = np.clip((phi - radians(200)) / radians(140), 0, 1)
    s = 30 * rise - 30 * (back - np.sin(2 * np.pi * back) / (2 * np.pi))
    measured = measured_motion(phi, s)
    for limit in (20, 30, 45, 60):
        slope = math.tan(radians(limit))
        values = measured(DENSE)
        dense = np.max(values[1] - slope * values[0])
        found = minimum_radius(measured, Translating(), rise=radians(limit), offset=0.0, rest=False)
        assert found.prime_radius == pytest.approx(dense / slope, rel=1e-6)


# --- accelerations ---------------------------------------------------------------------------------------------------


def test_accelerations_of_an_eccentric_integrate_to_it_in_second_order():
    errors = []
    for n in (45, 90, 180, 360):
        phi = np.arange(n) * FULL_TURN / n
        motion = integrated_motion(phi, 10 * np.cos(phi), tolerance=1e-3 * (45 / n) ** 2)
        # The fit's own tolerance goes as the square of the step too.
        errors.append(np.max(np.abs(motion.measured - (10 - 10 * np.cos(motion.phi)) - motion.measured[0])))
    order = -np.polyfit(np.log([45, 90, 180, 360]), np.log(errors), 1)[0]
    assert order == pytest.approx(2.0, abs=0.05)


def test_the_mean_acceleration_is_taken_for_the_closure():
    phi = DEGREES
    plain, off = (integrated_motion(phi, 10 * np.cos(phi) + mean) for mean in (0.0, 0.7))
    assert off.closing == pytest.approx(0.7)
    assert plain.closing == pytest.approx(0.0, abs=1e-12)
    assert_allclose(off(DENSE), plain(DENSE), atol=1e-6)


def test_accelerations_of_a_law_give_its_cam():
    exact = LAWS["4-5-6-7"]
    motion = integrated_motion(DEGREES, np.round(exact(DEGREES)[2], 3), tolerance=0.02)
    assert [phase.kind for phase in motion.phases if phase.direction] == ["rise", "return"]
    assert motion.lift == pytest.approx(20, abs=0.02)
    assert np.max(np.abs(motion(DENSE - motion.zero)[0] - exact(DENSE)[0])) < 0.04


# --- what cannot be --------------------------------------------------------------------------------------------------

S = table(LAWS["3-4-5"])


@over_all(
    ("phi", "s", "row", "words"),
    [
        (DEGREES[::60], S[::60], 5, "number of rows is 6, but must be from 8 to 10000"),
        (np.append(DEGREES[:9], math.nan), S[:10], 9, "row is nan, "),
        (DEGREES[:9], np.append(S[:8], math.inf), 8, "finite numbers"),
        (DEGREES, np.where(DEGREES[7] == DEGREES, -1e300, S), 7, "numbers up to 1e+100"),
        (np.insert(DEGREES, 5, DEGREES[4]), np.insert(S, 5, S[4]), 5, "greater than the one before, 4 degrees; give"),
        (np.roll(DEGREES, 3), S, 3, "sort the rows"),
        (DEGREES[:300], S[:300], 299, "299 degrees, but must be 360 degrees, or a step less"),
        (DEGREES * 1.01, S, 359, "360 degrees"),
        ([*DEGREES, FULL_TURN], [*S, 0.5], 360, "0.5, but must be 0 as in the first"),
        (
            DEGREES[:81],
            S[:81],
            80,
            "from 0 degrees to 80 degrees the rows only rise or only fall: add those of the way",
        ),
        (DEGREES[:360:10], np.linspace(0, 30, 36), 35, "last row is 30, but must be 0 as in the first"),
        (DEGREES, np.where(DEGREES[40] == DEGREES, S + 1, S), 40, "as the rows on both sides say; measure it again"),
        (DEGREES, np.where(DEGREES[250] == DEGREES, S - 0.1, S), 250, "row is -0.1, but must be about 0, as the rows"),
    ],
)
def test_a_row_that_cannot_be_is_named(phi, s, row, words):
    with pytest.raises(RowError) as caught:
        measured_motion(phi, s)
    assert caught.value.row == row
    assert words in str(caught.value)


@over_all(
    ("phi", "s", "tolerance", "words"),
    [
        (DEGREES, S, 0.0, "tolerance is 0.0"),
        (DEGREES, S, math.nan, "tolerance is nan"),
        (DEGREES, S * 1e-150, 1e-152, "at least 1e-100"),
        (DEGREES, S[:-1], 0.01, "one number for each cam angle"),
        (DEGREES, 0 * S, 0.01, "lift is 0, but must be more than 0.02"),
        (DEGREES, np.random.default_rng(1).standard_normal(360), 0.01, "greater than the noise that turns the table"),
    ],
)
def test_a_table_that_cannot_be_is_refused(phi, s, tolerance, words):
    with pytest.raises(DesignError) as caught:
        measured_motion(phi, s, tolerance)
    assert words in str(caught.value)


@over_all(("noise", "step"), [(0.005, 1.0), (0.02, 1.0), (0.02, 5.0), (0.15, 5.0)])
def test_the_tolerance_that_a_message_names_is_enough(noise, step):
    phi = np.radians(np.arange(0, 360, step))
    rows = LAWS["cycloidal"](phi)[0] + noise * np.random.default_rng(3).standard_normal(phi.size)
    with pytest.raises(DesignError, match=r"give a greater tolerance, as (?P<enough>[\d.e-]+),") as caught:
        measured_motion(phi, rows, noise / 5)
    enough = float(str(caught.value).partition("tolerance, as ")[2].partition(",")[0])
    assert measured_motion(phi, rows, enough).max_residual <= enough


@over_all("row", [1, 2, 3])
def test_a_row_that_lies_too_low_at_the_foot_of_a_rise_is_no_rest(row):
    rows = np.round(S, 3)
    rows[row] = 0.0
    motion = measured_motion(DEGREES, rows)
    assert [phase.kind for phase in motion.phases if phase.kind != "dwell"] == ["rise", "return"]
    assert motion.max_residual <= motion.tolerance


@over_all("size", [1e-90, 1e-30, 1e6, 1e90])
def test_the_unit_of_a_table_does_not_matter(size):
    motion = measured_motion(DEGREES, S * size, 0.01 * size)
    assert motion.lift / size == pytest.approx(measured_motion(DEGREES, S).lift, rel=1e-6)


def test_a_measured_motion_travels():
    motion = measured_motion(DEGREES, table(LAWS["3-4-5"]))
    for other in (pickle.loads(pickle.dumps(motion)), copy.deepcopy(motion)):
        assert_allclose(other(DENSE), motion(DENSE), rtol=0, atol=0)


FITTED_ROWS = """
import numpy as np
import graphcam as gc
degrees = np.arange(360.0)
up, down = np.clip(degrees / 100, 0, 1), np.clip((degrees - 150) / 90, 0, 1)
rows = np.round(30 * (up * up * (3 - 2 * up) - down * down * (3 - 2 * down)), 3)
motion = gc.measured_motion(np.radians(degrees), rows)
print(np.array(motion(np.radians(degrees + 0.5))).tobytes().hex())
"""


@pytest.mark.slow
@over_all("other", [{"OPENBLAS_CORETYPE": "Prescott"}, {"NPY_DISABLE_CPU_FEATURES": "FMA3 AVX2 X86_V3"}])
def test_every_digit_is_that_of_another_processor(other):
    def fitted(**settings: str) -> str:
        command = [sys.executable, "-W", "ignore", "-c", FITTED_ROWS]
        environment = {**os.environ, **settings}
        return subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout

    assert fitted(**other) == fitted()


def test_sums_of_many_columns_have_the_digits_of_sums_of_one():
    random = np.random.default_rng(8)
    for shape in ((1, 3), (7, 1), (9, 2), (130, 1), (1000, 13), (2000, 117)):
        values = random.standard_normal(shape) * 10.0 ** random.integers(-9, 9, shape)
        assert column_sums(values).tolist() == [ordered_sum(column) for column in values.T.copy()]

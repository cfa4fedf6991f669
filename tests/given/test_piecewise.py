"""One arithmetic for every value, however the values are ordered, cut into chunks, or asked for."""

from __future__ import annotations

import math

import mpmath
import numpy as np
from numpy.testing import assert_array_equal
from over_all import over_all
from reference import EPS

from graphcam.given.laws import LAWS, law
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.given.piecewise import CHUNK_SIZE, SLICING_SIZE, sine_cosine

LONG_ENOUGH = 5 * CHUNK_SIZE + 37
"""So many angles over a turn are cut into slices, a piece each."""


def motion_of(name: str) -> Motion:
    return Motion([Rise(30, 1.4, name), Dwell(0.8), Return(30, 1.1, name), Dwell(FULL_TURN - 3.3)])


@over_all("name", LAWS)
@over_all("side", ["right", "left"])
def test_values_do_not_depend_on_order_number_or_chunks(name, side):
    """Bit for bit: sliced, gathered, backwards, in parts that straddle the chunks, and one by one."""
    motion, rng = motion_of(name), np.random.default_rng(1)
    phi = np.sort(np.concatenate([rng.random(LONG_ENOUGH) * FULL_TURN, np.repeat(motion.breaks, 3)]))
    sliced = np.array(motion(phi, side))
    order = rng.permutation(phi.size)
    assert_array_equal(np.array(motion(phi[order], side)), sliced[:, order])
    assert_array_equal(np.array(motion(phi[::-1], side)), sliced[:, ::-1])
    parts = np.split(phi, [1, 700, CHUNK_SIZE - 1, CHUNK_SIZE + 3, 3 * CHUNK_SIZE + 5])
    assert_array_equal(np.concatenate([motion(part, side) for part in parts], axis=1), sliced)
    for k in rng.integers(phi.size, size=40):
        assert_array_equal(np.array(motion(phi[k], side)), sliced[:, k])


@over_all("name", LAWS)
def test_a_law_too(name):
    u, the_law = np.linspace(-0.1, 1.1, 2 * CHUNK_SIZE), law(name)
    order = np.random.default_rng(2).permutation(u.size)
    assert_array_equal(np.array(the_law(u[order])), np.array(the_law(u))[:, order])


@over_all("name", LAWS)
def test_what_is_outside_of_a_phase_has_no_value_whatever_its_order(name):
    """Constants of a piece too: the acceleration of the rectangular law, the jerk of many others."""
    u = np.random.default_rng(3).permutation(np.linspace(-0.1, 1.1, 2 * CHUNK_SIZE))
    u[::1000] = np.nan
    inside = (u >= 0) & (u <= 1)
    for row in law(name)(u):
        assert_array_equal(np.isfinite(row), inside)
        assert_array_equal(np.isnan(row), ~inside)


@over_all("phases", [4, 2 * CHUNK_SIZE // SLICING_SIZE])
@over_all("side", ["right", "left"])
def test_of_few_pieces_and_of_many_each_place_has_its_own(phases, side):
    """Places in any order, breaks among them, against every one alone; two laws, or one in dozens of phases."""
    names = ("trapezoidal", "cosine") if phases == 4 else ("cosine",)
    parts = [(Rise, Return)[k % 2](1.0, FULL_TURN / phases, names[k % len(names)]) for k in range(phases)]
    motion, rng = Motion(parts), np.random.default_rng(4)
    phi = rng.permutation(np.concatenate([rng.random(CHUNK_SIZE) * FULL_TURN, np.repeat(motion.breaks, 3)]))
    values = np.array(motion(phi, side))
    for k in [*rng.integers(phi.size, size=40), *np.flatnonzero(np.isin(phi, motion.breaks))[:80]]:
        assert_array_equal(values[:, k], np.array(motion(phi[k], side)))


def test_many_turns_in_growing_order_are_wrapped_one_by_one():
    motion, phi = motion_of("modified-sine"), np.linspace(-20, 60, 3 * CHUNK_SIZE)
    assert_array_equal(np.array(motion(phi))[:, ::-1], motion(phi[::-1]))


def test_nan_among_many_stays_nan_and_disturbs_no_neighbour():
    motion, phi = motion_of("trapezoidal"), np.linspace(0, 6, 2 * CHUNK_SIZE)
    gaps = np.arange(5, phi.size, 1000)
    holed = phi.copy()
    holed[gaps] = np.nan
    values, whole = np.array(motion(holed)), np.array(motion(phi))
    assert np.isnan(values[:, gaps]).all()
    assert_array_equal(np.delete(values, gaps, axis=1), np.delete(whole, gaps, axis=1))


def test_five_hundred_phases():
    angle, moves = FULL_TURN / 500, [Rise, Return]
    motion = Motion([moves[k % 2](1.0, angle, "cycloidal") for k in range(500)])
    s, v, _, _ = motion(np.arange(1000) * angle / 2)
    assert np.abs(s - np.tile([0, 0.5, 1, 0.5], 250)).max() <= 2000 * EPS * math.pi / angle
    assert np.abs(v[1::4] - 2.0 / angle).max() <= 1e-9 * 2.0 / angle


def test_no_zero_is_negative():
    motion = motion_of("2-3")
    for phase in range(4):
        values = np.array(motion.at(phase, [0.0, 1.0]))
        assert not np.signbit(values[values == 0]).any()


def test_sine_and_cosine_to_two_eps():
    x = np.concatenate(
        [np.random.default_rng(3).random(2000) * FULL_TURN, 2.0 ** -np.arange(40), [math.pi / 2, math.pi]]
    )
    s, c = sine_cosine(x)
    exact = [(mpmath.sin(mpmath.mpf(float(a))), mpmath.cos(mpmath.mpf(float(a)))) for a in x]
    assert max(abs(mpmath.mpf(float(a)) - e) for a, (e, _) in zip(s, exact, strict=True)) <= 2 * EPS
    assert max(abs(mpmath.mpf(float(a)) - e) for a, (_, e) in zip(c, exact, strict=True)) <= 2 * EPS
    assert max(abs(mpmath.mpf(float(a)) / e - 1) for a, (e, _) in zip(s, exact, strict=True) if e > 0) <= 2 * EPS

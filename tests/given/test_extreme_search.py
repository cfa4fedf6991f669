"""The search for stationary places misses none, wherever they lie between the places that it looks at."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from over_all import over_all

from graphcam.given.extreme_search import SmoothPieces

ONE = SmoothPieces(np.array([0.0]), np.array([1.0]))


def close_to(found, wanted, within) -> bool:
    """Whether every wanted place is among those found."""
    return bool(np.abs(np.asarray(found)[:, None] - np.asarray(wanted)).min(axis=0).max() <= within)


@over_all("waves", [1, 7, 60, 300, 997])
def test_all_crests_and_troughs_of_waves_are_found(waves):
    _, x = ONE.stationary(lambda _, x: np.sin(2 * np.pi * waves * x))
    wanted = (np.arange(2 * waves) + 0.5) / (2 * waves)
    assert close_to(x, wanted, 1e-11)
    assert np.abs(np.cos(2 * np.pi * waves * x)).max() < 1e-7 * waves


def test_every_root_of_the_slope_of_random_polynomials_is_found():
    rng = np.random.default_rng(3)
    for _ in range(200):
        roots = rng.random(int(rng.integers(1, 12)))
        curve = Polynomial.fromroots(roots).integ()
        _, x = ONE.stationary(lambda _, x, curve=curve: curve(x))
        apart = np.array([root for root in roots if np.sum(np.abs(roots - root) < 1e-3) == 1])
        # Where the slope is nearly nothing all about a root, rounding decides where it vanishes.
        steep = apart[np.abs(curve.deriv(2)(apart)) > 1e-6] if apart.size else apart
        assert not steep.size or close_to(x, steep, 1e-6)


@over_all("gap", [1e-3, 1e-5, 1e-7])
def test_two_extremes_beside_one_another_are_both_reached(gap):
    """A crest and a trough of (x - m)^3/3 - gap^2 x."""
    place = 0.377
    _, x = ONE.stationary(lambda _, x: (x - place) ** 3 / 3 - gap**2 * (x - place))
    crest, trough = 2 / 3 * gap**3, -2 / 3 * gap**3
    heights = (x - place) ** 3 / 3 - gap**2 * (x - place)
    assert np.abs(heights - crest).min() < 1e-17
    assert np.abs(heights - trough).min() < 1e-17


@over_all(("place", "width"), [(1e-6, 1e-7), (0.3, 0.01), (1 - 1e-6, 1e-7)])
def test_a_sharp_peak_is_found_wherever_it_is(place, width):
    _, x = ONE.stationary(lambda _, x: 1 / (1 + ((x - place) / width) ** 2))
    assert close_to(x, [place], 1e-11)


@over_all("place", [1e-9, 1e-6, 0.3, 1 - 1e-6])
def test_a_corner_that_nobody_declared_is_told_to_a_part_in_a_thousand_million(place):
    _, corner = ONE.stationary(lambda _, x: -np.abs(x - place))
    assert close_to(corner, [place], 1e-9)


def test_pieces_do_not_look_into_one_another():
    pieces = SmoothPieces(np.array([0.0, 1.0]), np.array([1.0, 2.0]))
    piece, x = pieces.stationary(lambda piece, x: np.where(piece == 0, (x - 0.25) ** 2, -((x - 1.5) ** 2)))
    assert np.unique(piece).tolist() == [0, 1]
    assert x[piece == 0] == pytest.approx(0.25, abs=1e-11)
    assert x[piece == 1] == pytest.approx(1.5, abs=1e-11)


def test_of_maxima_only_those_that_may_be_highest_are_sought():
    """Two groups, each with a height that it reaches elsewhere."""
    pieces, group = SmoothPieces(np.array([0.0, 1.0]), np.array([1.0, 2.0])), np.array([0, 1])
    piece, x = pieces.stationary(lambda _, x: np.sin(np.pi * x), group, np.array([0.5, 0.5]))
    assert np.unique(piece).tolist() == [0]
    assert x == pytest.approx(0.5)
    piece, x = pieces.stationary(lambda _, x: np.sin(np.pi * x), group, np.array([2.0, 0.5]), np.abs)
    assert np.unique(piece).tolist() == [1]


def test_what_is_the_same_all_over_or_nowhere_a_number_ends_the_search():
    assert ONE.stationary(lambda _, x: 0 * x + 7)[1].tolist() == [0.5]
    assert ONE.stationary(lambda _, x: np.nan * x)[1].size == 0
    _, x = ONE.stationary(lambda _, x: np.where(x < 0.4, np.nan, -((x - 0.7) ** 2)))
    assert close_to(x, [0.7], 1e-10)


def test_noise_is_not_divided_without_end():
    rng, looked_at = np.random.default_rng(1), []

    def noisy(_, x):
        looked_at.append(x.size)
        return 1 + 1e-10 * rng.random(x.shape)

    ONE.stationary(noisy)
    assert sum(looked_at) < 3000


@over_all("root", [1 / 3, 0.5, 0.25, 1e-9])
def test_a_zero_is_found_once_at_least_at_a_seam_too(root):
    _, x = ONE.zeros(lambda _, x: np.exp(3 * x) - np.exp(3 * root))
    assert x == pytest.approx(root, abs=1e-12)

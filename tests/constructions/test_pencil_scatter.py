"""What a hand of 0.2 mm does to the readings, in many samples at once."""

from __future__ import annotations

import math

import numpy as np
import pytest
from boards import SIZES, board_of, coursework, motion_of

from graphcam.constructions.chain import Chain
from graphcam.drafting.euclid import centre_of_circle
from graphcam.drafting.pencil import Pencil

SIGMA = 0.2
SAMPLES = 2000


def one_rise(law: str, n: int = 12, pencil: Pencil | None = None) -> tuple[Chain, slice]:
    """A rise over 120 mm of paper, ordinate 50 mm, poles 40 mm, and its stations."""
    board = board_of(motion_of((30, 120, law), (-30, 120, law)), divisions=n)
    return Chain(board, pencil or Pencil(line=SIGMA, samples=SAMPLES), decided=SIZES), board.stations.phases[0]


def shape_errors(law: str, n: int = 12) -> np.ndarray:
    """The greatest error of s on the rise in every sample, in percent of the lift."""
    chain, rise = one_rise(law, n)
    stations = chain.board.stations
    exact = chain.board.motion.at(stations.phase[rise], stations.u[rise])[0]
    drawn = chain["integration"].readings["s"].value[:, rise]
    return 100 * np.abs(drawn - exact).max(axis=1) / 30


@pytest.mark.parametrize(("law", "percent"), [("rectangular", 0.46), ("cosine", 0.57), ("cycloidal", 0.85)])
def test_the_shape_errors_of_a_hand_are_those_of_the_textbooks(law, percent):
    assert shape_errors(law).mean() == pytest.approx(percent, rel=0.15)


@pytest.mark.parametrize("law", ["rectangular", "cosine", "cycloidal", "3-4-5"])
def test_the_greatest_velocity_of_a_hand_scatters_by_about_one_percent(law):
    chain, rise = one_rise(law)
    greatest = chain["integration"].readings["v"].value[:, rise].max(axis=1)
    assert 0.7 / 1.15 < 100 * greatest.std() / greatest.mean() < 1.0 * 1.15


def test_more_parts_lower_the_error_of_the_method_and_raise_that_of_the_hand():
    few, best, many = (shape_errors("cycloidal", n).mean() for n in (4, 12, 96))
    assert best < few
    assert best < many


def test_the_scatter_of_s_is_proportional_to_the_pencil():
    scatter = []
    for sigma in (0.05, 0.2):
        chain, rise = one_rise("3-4-5", pencil=Pencil(line=sigma, samples=SAMPLES))
        scatter.append(chain["integration"].readings["s"].value[:, rise].std(axis=0)[1:-1])
    assert scatter[1] / scatter[0] == pytest.approx(np.full(scatter[0].size, 4.0), rel=0.03)


AMPLIFICATION = {
    # Scatter on paper over the pencil's, for the built-in task with 3-4-5 phases in 12 parts and r0 = 46 mm.
    # The chords of a phase add up, so by their lines s scatters about as the root of twice its parts does, by 4.1; the
    # settings of dividers (divisions, middle ordinates, poles, v above its base line) bring 2.1 beside: their root is
    # 4.6.  Of v the lines bring 1.7, the settings 2.7.
    ("integration", "s"): 4.8, ("integration", "v"): 3.3, ("integration", "max_v"): 3.1,
    ("integration", "closing_v"): 4.5, ("integration", "closing_s"): 6.4,
    # On the line at the given e, which is laid off and drawn, the place of s0 goes down by 1/sin 30 when the tangent is
    # moved by 1, and by 1/tan 30 when that line is: the root of 2^2 + 2 * 1.73^2, 3.2, beside what v and s bring, 6.1.
    ("minimum_radius", "prime_radius"): 6.4, ("minimum_radius", "s0"): 6.9, ("minimum_radius", "offset"): 2.15,
    ("angle_diagram", "max_rise"): 4.4, ("angle_diagram", "max_return"): 4.05,
    ("inversion", "radius"): 2.5, ("inversion", "x"): 2.2, ("inversion", "y"): 2.4,
    ("curvature", "rho"): 39.0, ("working_profile", "radius"): 3.1,
}  # fmt: skip


@pytest.mark.parametrize(("name", "reading"), AMPLIFICATION)
def test_every_reading_scatters_within_its_bound(name, reading):
    sigma = 0.05
    chain = Chain(coursework("3-4-5"), Pencil(line=sigma, dividers=sigma, samples=SAMPLES), decided=SIZES)
    scatter = np.nanstd(chain[name].readings[reading].paper, axis=0).max() / sigma
    bound = AMPLIFICATION[name, reading]
    assert 0.8 * bound < scatter < bound


def test_the_whole_chain_is_drawn_by_many_hands_at_once():
    hands = Pencil(line=SIGMA, dividers=SIGMA, division=0.5, protractor=math.radians(0.5), samples=SAMPLES, seed=2)
    for name, construction in Chain(coursework("cycloidal"), hands).items():
        for key, kept in construction.readings.items():
            assert kept.value.shape[0] == SAMPLES, (name, key)
            if (name, key) != ("working_profile", "radius"):  # where another circle covers a touch point
                assert np.isfinite(kept.value).all(), (name, key)


def test_a_trembling_hand_does_not_make_a_sound_profile_undercut():
    hands = Pencil(line=SIGMA, dividers=SIGMA, samples=SAMPLES)
    profile = Chain(coursework("cycloidal"), hands)["working_profile"]
    assert np.isnan(profile.points["touch"]).mean() < 0.001


def test_no_hand_covers_a_touch_point_by_its_own_circle():
    """Of two parts a phase, far apart, no circle reaches the touch point of another."""
    hands = Pencil(line=SIGMA, samples=SAMPLES)
    profile = Chain(coursework("cycloidal", divisions=2), hands, decided=SIZES)["working_profile"]
    assert not np.isnan(profile.points["touch"]).any()


@pytest.mark.parametrize("offset", [-10.0, None])
def test_decisions_are_those_of_the_perfect_pencil(offset):
    board = coursework("3-4-5", offset=offset)
    perfect = Chain(board).sizes
    for pencil in (Pencil(line=1.0, dividers=1.0, seed=3), Pencil(line=1.0, samples=5), Pencil(samples=3)):
        assert Chain(board, pencil).sizes == perfect


def test_samples_of_a_perfect_pencil_are_all_the_perfect_drawing():
    board = coursework("3-4-5")
    alone, many = Chain(board), Chain(board, Pencil(samples=3))
    for name in Chain(coursework()):
        for key, kept in alone[name].readings.items():
            sampled = many[name].readings[key].value
            np.testing.assert_allclose(sampled, np.broadcast_to(kept.value, (3, *kept.value.shape)), rtol=1e-12)


# --- curvature by three points ---------------------------------------------------------------------------------------


def radii(rho: float, h: float, sigma: float) -> np.ndarray:
    """Radii of the circles through three points, plotted by a hand on a circle at chords h."""
    turn = 2 * math.asin(h / (2 * rho))
    across, up = sigma * np.random.default_rng(1).standard_normal((2, 40_000, 3))
    a, b, c = (rho * np.exp(1j * turn * np.array([-1, 0, 1])) + across + 1j * up).T
    return np.abs(centre_of_circle(a, b, c) - b)


@pytest.mark.parametrize(
    ("rho", "h", "sigma"), [(40.0, 20.0, 0.2), (40.0, 20.0, 0.1), (60.0, 25.0, 0.2), (25, 12, 0.1)]
)
def test_three_points_of_a_hand_scatter_the_radius_as_the_textbook_says(rho, h, sigma):
    """sqrt(6) sigma rho/h^2, relative, where the points are not too near to one another; the bias is its square."""
    noise = sigma * rho / h**2
    assert noise <= 0.025
    found = radii(rho, h, sigma) / rho
    # The circle's own arc adds (h/2 rho)^2 to the chord's formula.
    assert found.std() == pytest.approx(math.sqrt(6) * noise, rel=0.08)
    assert found.mean() - 1 == pytest.approx(6 * noise**2, abs=0.5 * 6 * noise**2 + 4 * found.std() / 200)


def test_the_radius_through_three_points_of_an_ellipse_is_right_to_second_order():
    """The case circumradius: half axes of 50 and 30 mm, t = pi/3 +- 0.1."""

    def radius(step: float) -> float:
        t = math.pi / 3 + np.array([-step, 0, step])
        a, b, c = 50 * np.cos(t) + 30j * np.sin(t)
        return float(abs(centre_of_circle(a, b, c) - b))

    exact = 64.156059729381760
    assert radius(0.1) == pytest.approx(64.060168370900792, rel=1e-12)
    assert (radius(0.1) - exact) / (radius(0.05) - exact) == pytest.approx(4.0, rel=0.01)

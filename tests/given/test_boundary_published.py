"""Published motions by boundary conditions.

No book was at hand.  How far a source is trusted: "identity" follows from the conditions alone, whatever the book
prints; "recalled" is a printed number, and the number of its example, written down from memory of the book.  Every
recalled number is also an identity, or closes by itself to the last printed digit.
"""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from over_all import over_all

import graphcam as gc
from graphcam.given.exact_conditions import PI, value_at
from graphcam.given.laws import law_of_return

P = gc.MotionPoint
DEG = math.pi / 180


def coefficients(part: gc.PolynomialPart) -> list[float]:
    [(_, _, p)] = part.solution
    return [float(c) for c in p]


@over_all(
    ("ends", "printed"),
    [  # Norton, Cam Design and Manufacturing Handbook (2009), chapter 4, and Rothbart, Cams (1956), chapter 3: identity
        ({"v": 0}, [0, 0, 3, -2]),
        ({"v": 0, "a": 0}, [0, 0, 0, 10, -15, 6]),
        ({"v": 0, "a": 0, "j": 0}, [0, 0, 0, 0, 35, -84, 70, -20]),
    ],
)
def test_the_polynomials_of_a_rise_between_dwells(ends, printed):
    part = gc.PolynomialPart([P(0, s=0, **ends), P(120 * DEG, s=1, **ends)])
    assert coefficients(part) == printed
    for computed, known in zip(gc.boundary_law([part])(U), gc.law(NAMES[len(printed)])(U), strict=True):
        np.testing.assert_allclose(computed, known, rtol=0, atol=8 * EPS * np.abs(known).max())


NAMES = {4: "2-3", 6: "3-4-5", 8: "4-5-6-7"}
U, EPS = np.linspace(0, 1, 501), 2.0**-52


def test_a_symmetrical_rise_and_fall_in_one_polynomial():
    """Norton, Design of Machinery, example 8-7: 1 in up and down in 180 degrees, at 15 rad/s.

    s = 64 u^3 - 192 u^4 + 192 u^5 - 64 u^6, a = -547 in/s^2 at the top; recalled, and 64 (u (1 - u))^3 is an identity.
    """
    rest = {"s": 0, "v": 0, "a": 0}
    part = gc.PolynomialPart([P(0, **rest), P(90 * DEG, s=1), P(180 * DEG, **rest)])
    assert coefficients(part) == [0, 0, 0, 64, -192, 192, -64]
    motion = gc.boundary_motion([part])
    assert motion(90 * DEG)[2] * 15**2 == pytest.approx(-547, abs=0.5)
    assert [phase.kind for phase in motion.phases] == ["rise", "return", "dwell"]


def test_an_unsymmetrical_rise_and_fall_in_one_polynomial_swings():
    """Norton, Design of Machinery, example 8-8: up in 45, down in 135 degrees.

    The polynomial is 151.704 u^3 (1 - u)^3; it rises to 2.37 in in place of 1; recalled, and 4096/27/64 is an identity.
    With v = 0 at the top it falls below the start instead.
    """
    rest = {"s": 0, "v": 0, "a": 0}
    points = [P(0, **rest), P(45 * DEG, s=1), P(180 * DEG, **rest)]
    with pytest.raises(gc.DesignError, match=r"s behind it\) is 2.37037 between 45 degrees and 180 degrees.*swings"):
        gc.PolynomialPart(points)
    points[1] = P(45 * DEG, s=1, v=0)
    with pytest.raises(gc.DesignError, match=r"s behind it\) is -.*swings"):
        gc.PolynomialPart(points)


def test_an_unsymmetrical_rise_and_fall_in_two_polynomials():
    """Norton, Design of Machinery, example 8-9: the fall first, then the rise, with the fall's acceleration at the top.

    fall: 1 - 6 u^2 + 8 u^3 - 3 u^4; rise: 9.333 u^3 - 13.667 u^4 + 5.333 u^5; recalled, and identities.
    """
    rest = {"s": 0, "v": 0, "a": 0}
    fall = gc.PolynomialPart([P(45 * DEG, s=1, v=0), P(180 * DEG, **rest)])
    assert coefficients(fall) == [1, 0, -6, 8, -3]
    top = float(value_at(fall.solution[0][2], Fraction(0), 2) / (fall.end - fall.start) ** 2)
    rise = gc.PolynomialPart([P(0, **rest), P(45 * DEG, s=1, v=0, a=top)])
    assert coefficients(rise) == pytest.approx([0, 0, 0, 28 / 3, -41 / 3, 16 / 3], abs=1e-14)
    motion = gc.boundary_motion([rise, fall])
    before, after = (motion(45 * DEG, side)[2] for side in ("left", "right"))
    assert before == pytest.approx(after, rel=1e-14)


def test_constant_velocity_between_polynomials():
    """Norton, Design of Machinery, example 8-11: 10 in/s for 0.5 s at 2 pi rad/s, speeding up over 30 degrees.

    At the end of the first part s = 0.417 in, of the second 5.417 in; recalled, and 10/12/2 and 5 more are identities.
    """
    v = 10 / (2 * math.pi)
    up = gc.PolynomialPart([P(0, s=0, v=0, a=0), P(30 * DEG, v=v, a=0)])
    s1 = up.at_ends[1][0]
    assert s1 == pytest.approx(0.417, abs=5e-4)
    line = gc.PolynomialPart([P(30 * DEG, s=s1, v=v), P(210 * DEG, v=v)])
    s2 = line.at_ends[1][0]
    assert s2 == pytest.approx(5.417, abs=5e-4)
    back = gc.PolynomialPart([P(210 * DEG, s=s2, v=v, a=0), P(2 * math.pi, s=0, v=0, a=0)])
    motion = gc.boundary_motion([up, line, back])
    np.testing.assert_allclose(motion(np.radians([30, 100, 209.9]))[1], v, rtol=1e-14)
    assert motion.lift > 5.417


def test_the_law_of_constant_velocity_with_parabolic_blends():
    """Shigley, Theory of Machines (1961), chapter 6, and Rothbart, Cams (1956), chapter 2: identity.

    Blends of a quarter each make 4/3 of the mean velocity, and begin with 16/3 of lift over angle squared.
    """
    law = gc.constant_velocity_law(0.25, 0.25, smooth=1)
    assert law.peak_velocity == pytest.approx(4 / 3, rel=1e-15)
    assert law.peak_acceleration == pytest.approx(16 / 3, rel=1e-15)
    assert law.jumps == (0.25, 0.75)
    f, f1, *_ = law([0.25, 0.5, 0.75])
    np.testing.assert_allclose([f, f1], [[1 / 6, 1 / 2, 5 / 6], [4 / 3] * 3], rtol=1e-15)


def test_the_double_harmonic_law():
    """Rothbart, Cams (1956), table of basic curves, and Norton (2009), chapter 3: v 2.04, a 5.55 and -9.87; recalled.

    9 pi^2/16 where cos(pi u) = 1/4, and -pi^2 at the end, are identities.
    """
    law = gc.law("double-harmonic")
    assert law.peak_velocity == pytest.approx(2.04, abs=5e-3)
    accelerations = law(np.linspace(0, 1, 100_001))[2]
    assert accelerations.max() == pytest.approx(9 * math.pi**2 / 16, rel=1e-9) == pytest.approx(5.55, abs=5e-3)
    assert accelerations[-1] == pytest.approx(-(math.pi**2), rel=1e-15) == pytest.approx(-9.87, abs=5e-3)


def test_the_eighth_degree_polynomial():
    """Kloomok and Muffley, Product Engineering 26 (February 1955), and Shigley and Uicker, Theory of Machines and
    Mechanisms, chapter 6: 6.09755 u^3 - 20.78040 u^5 + 26.73155 u^6 - 13.60965 u^7 + 2.56095 u^8; recalled.

    Printed digits close to the last one: f(1) = 1, f'(1) = 0, f'''(1) = 0, and both peaks of the acceleration are
    equal, which is what the polynomial was made for.
    """
    c = dict(
        zip((3, 5, 6, 7, 8), map(Fraction, ["6.09755", "-20.7804", "26.73155", "-13.60965", "2.56095"]), strict=True)
    )
    ends = [sum(math.perm(n, k) * value for n, value in c.items()) for k in range(4)]
    assert ends == [1, 0, Fraction("-5.2683"), 0]
    law = gc.law("eighth-degree")
    assert law(0.3)[0] == pytest.approx(float(sum(value * Fraction("0.3") ** n for n, value in c.items())), rel=4 * EPS)
    accelerations = law(np.linspace(0, 1, 20_001))[2]
    assert accelerations[0] == 0
    assert (accelerations.max(), accelerations.min()) == pytest.approx((5.2683, -5.2683), rel=1e-6)
    assert law.peak_velocity == pytest.approx(1.7767, abs=5e-5)


def test_its_return_is_the_mirrored_rise():
    """1 - 2.63415 u^2 + 2.78055 u^5 + 3.17060 u^6 - 6.87795 u^7 + 2.56095 u^8: an identity of the rise.

    Shigley and Uicker print this return; no page was at hand, and the sixth power as it was recalled, 3.21370, does not
    lead to rest, so these coefficients are worked out and not printed ones.
    """
    f = law_of_return("eighth-degree")(U)[0]
    mirrored = 1 - 2.63415 * U**2 + 2.78055 * U**5 + 3.1706 * U**6 - 6.87795 * U**7 + 2.56095 * U**8
    np.testing.assert_allclose(1 - f, mirrored, atol=1e-14)


def test_a_polynomial_with_zero_jerk_and_snap_at_its_ends():
    """5-6-7-8-9: the fourth derivative cannot be asked for, but twelve conditions on s, v, a, j at three places can.

    f' = 630 (u (1 - u))^4 of the how-to page meets them, so it is found again: identity.
    """

    def nine(u: float) -> list[float]:
        p = u * (1 - u)
        f = u**5 * (126 - u * (420 - u * (540 - u * (315 - 70 * u))))
        return [f, 630 * p**4, 2520 * p**3 * (1 - 2 * u), 2520 * p**2 * (3 - 14 * p)]

    law = gc.boundary_law([P(u, *nine(u)) for u in (0.0, 0.5, 1.0)])
    for k, row in enumerate(zip(*map(nine, U.tolist()), strict=True)):
        np.testing.assert_allclose(law(U)[k], row, atol=1e-12 * max(map(abs, row)))


def test_pi_is_known_to_60_digits():
    from mpmath import mp, workdps

    with workdps(70):
        assert abs(mp.mpf(PI.numerator) / PI.denominator - mp.pi) < mp.mpf(10) ** -59

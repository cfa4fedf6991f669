"""The laws that are polynomials: 2-3, 3-4-5, 4-5-6-7, and that of the eighth degree.

Each formula takes x, the distance from the nearer end of the phase, and returns f, f', f'', f'''.

Sources: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapters 2 and 3; R. L. Norton, *Cam Design and
Manufacturing Handbook* (2009), chapters 2 to 4; M. Kloomok and R. V. Muffley, *Plate Cam Design*, Product Engineering
26 (February 1955), the eighth-degree polynomial.
"""

import math
from fractions import Fraction
from functools import partial

from graphcam.given.declared_law import DeclaredLaw
from graphcam.given.exact_conditions import as_series
from graphcam.given.motion_law import Law
from graphcam.given.piecewise import Floats, Formula
from graphcam.given.polynomial_law import leg_law
from graphcam.words import say

_EIGHTH_COEFFICIENTS = tuple(
    map(Fraction, ("0", "0", "0", "6.09755", "0", "-20.7804", "26.73155", "-13.60965", "2.56095"))
)
"""The coefficients of the eighth-degree polynomial, as they were published."""


def _poly_2_3(x: Floats):
    return x * x * (3 - 2 * x), 6 * x * (1 - x), 6 - 12 * x, 0 * x - 12


def _poly_3_4_5(x: Floats):
    p = x * (1 - x)
    return x * x * x * (10 - x * (15 - 6 * x)), 30 * p * p, 60 * p * (1 - 2 * x), 60 - 360 * p


def _poly_4_5_6_7(x: Floats):
    p, q = x * (1 - x), x * x
    square = p * p
    f = q * q * (35 - x * (84 - x * (70 - 20 * x)))
    return f, 140 * p * square, 420 * square * (1 - 2 * x), 840 * p * (1 - 5 * p)


def _polynomial_tangent(k: float, *, n: int, rest: tuple[float, ...]) -> tuple[float, float]:
    """The tangent of f' = C (u (1 - u))^n: there n k (1 - 2u) = u (1 - u), and f' and f/k have u^n/(1 - u) in common.

    rest : coefficients of what is left, C (1 - u)^(n + 1) - n (1 - 2u) f/u^(n + 1), without the cancellation of the two
    """
    q = 2 * n * k
    u = q / (1 + q + math.hypot(1, q))
    height = 0.0
    for coefficient in reversed(rest):
        height = coefficient + u * height
    return u, u**n / (1 - u) * height


def _polynomial(name: str, formula: Formula, peaks: tuple[float, float], n: int, rest: tuple[float, ...]) -> Law:
    """A law whose velocity is C (u (1 - u))^n; ``rest`` as its tangent takes it."""
    tangent = partial(_polynomial_tangent, n=n, rest=rest)
    return Law(name, formula, (), True, 1.0, 1.0, peaks, (tangent, tangent), trusted=True)


POLYNOMIAL_2_3 = DeclaredLaw(
    title=say("2-3"),
    make=lambda _: _polynomial("2-3", _poly_2_3, (1.5, 6.0), 1, (3, -4, 2)),
    printed=lambda u, _: 3 * u**2 - 2 * u**3,
    fifth_derivatives=((0.0,), ()),
)
POLYNOMIAL_3_4_5 = DeclaredLaw(
    title=say("3-4-5"),
    make=lambda _: _polynomial("3-4-5", _poly_3_4_5, (1.875, 10 / math.sqrt(3)), 2, (10, -20, 18, -6)),
    printed=lambda u, _: 10 * u**3 - 15 * u**4 + 6 * u**5,
    fifth_derivatives=((720.0,), ()),
)
POLYNOMIAL_4_5_6_7 = DeclaredLaw(
    title=say("4-5-6-7"),
    make=lambda _: _polynomial("4-5-6-7", _poly_4_5_6_7, (2.1875, 84 / (5 * math.sqrt(5))), 3, (35, -98, 126, -80, 20)),
    printed=lambda u, _: 35 * u**4 - 84 * u**5 + 70 * u**6 - 20 * u**7,
    fifth_derivatives=((10080.0,), ()),
)
EIGHTH_DEGREE = DeclaredLaw(
    title=say("eighth-degree"),
    make=lambda _: leg_law("eighth-degree", as_series([(Fraction(0), Fraction(1), _EIGHTH_COEFFICIENTS)]))[1],
    printed=lambda u, _: sum(c.numerator * u**k / c.denominator for k, c in enumerate(_EIGHTH_COEFFICIENTS)),
    fifth_derivatives=((2493.648,), ()),
    rise_fall=True,
)

"""The laws that graphcam knows by their names: made of straight lines, of sines, and polynomials.

Each formula takes x, the distance from its end of the phase, and returns f, f', f'', f''' (from the end: the missing
lift).  Each tangent takes k and returns the place u where f' - f/k is greatest, the root of k f'' = f', and that
value; with k = cot(A)/F it is where the line at the permitted pressure angle A touches the s - v diagram, and its
height there.

A law whose parts are of unequal length is made from the one with equal parts.  Both halves of a law g that mirror each
other are stretched, to the parts p and 1 - p of the phase: f = 2 p g(u/2p) in the first, and so from the other end.
The velocity, g' at the middle, is the same for both, so they join; the accelerations are as 1 - p to p, their ratio is
nu = (1 - p)/p, and p = 1/(1 + nu).

Sources: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapters 2 and 3, skewed (unsymmetrical) curves
among them; R. L. Norton, *Cam Design and Manufacturing Handbook* (2009), chapters 2 to 4; M. Kloomok and
R. V. Muffley, *Plate Cam Design*, Product Engineering 26 (February 1955), the eighth-degree polynomial.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from graphcam.given.exact_conditions import as_series
from graphcam.given.motion_law import Law, Tangent
from graphcam.given.piecewise import Floats, Formula, sine_cosine
from graphcam.given.polynomial_law import leg_law
from graphcam.words import Caption, say

Printed = Callable[[Any, Any], Any]
"""f(u), of a number of any kind and of the functions for it: pi, sin and cos, of ``math`` or of ``mpmath.mp``."""


@dataclass(frozen=True, kw_only=True)
class DeclaredLaw:
    """A law with a name, which :mod:`graphcam.given.laws` lists.

    title : what it is called; the English title is the name
    make : the law, of the ratio |a1|/|a2| of its two parts, which is 1 of a law without such parts
    printed : the displacement as the books print it, which the bench and the tests hold the law against
    fifth_derivatives : the greatest |f'''''| of each piece of the first half, and by how much f'''' jumps between
        these; so in the second half.  The bound of double integration is proved with them; None if there is none
    rise_fall : whether it is for a rise without a dwell behind it; a return by its name then runs backwards
    has_ratio : whether it has two parts whose accelerations may differ
    """

    title: Caption
    make: Callable[[float], Law]
    printed: Printed
    fifth_derivatives: tuple[tuple[float, ...], tuple[float, ...]] | None
    rise_fall: bool = False
    has_ratio: bool = False

    @property
    def name(self) -> str:
        """The name in task files and in Python."""
        return str(self.title)


def mirrored_print(first_half: Printed) -> Printed:
    """The displacement of a law of which the second half mirrors the first: 1 - f(1 - u).

    >>> import math
    >>> mirrored_print(lambda u, _: 2 * u**2)(0.75, math)
    0.875
    """

    def printed(u: Any, functions: Any) -> Any:
        return first_half(u, functions) if 2 * u <= 1 else 1 - first_half(1 - u, functions)

    return printed


# --- laws of unequal parts -------------------------------------------------------------------------------------------


def skewed(law: Law, ratio: float) -> Law:
    """The law with the ratio |a1|/|a2| of the accelerations of its two parts.

    law : one whose second half mirrors the first

    >>> import graphcam as gc
    >>> law = gc.law("cycloidal", ratio=3.0)
    >>> [round(float(x), 6) for x in law(0.25)[:2]], law.peak_acceleration / gc.law("cycloidal").peak_acceleration
    ([0.25, 2.0], 2.0)
    """
    if ratio == 1:
        return law
    first = 1 / (1 + ratio)
    halves = [piece.formula for piece in law.pieces if piece.start < law.middle]
    edges = [u for u in law.edges if u < law.middle]
    parts = first, 1 - first
    formulas = [
        partial(_stretched, formula=formula, part=part)
        for part, run in zip(parts, (halves, halves[::-1]), strict=True)
        for formula in run
    ]
    ends = [2 * first * u for u in edges], [1 - 2 * parts[1] * u for u in edges[::-1]]
    ahead, back = (
        None if tangent is None else partial(_stretched_tangent, tangent=tangent, part=part)
        for tangent, part in zip(law.tangents, parts, strict=True)
    )
    peaks = law.peak_velocity, law.peak_acceleration / (2 * min(parts))
    inner = (*ends[0], first, *ends[1])
    return Law(law.name, formulas, inner, False, first, ratio, peaks, (ahead, back), trusted=True)


def _stretched(x: Floats, *, formula: Formula, part: float) -> tuple[Floats | float, ...]:
    """The half of a law over a part of the phase, at the distance x from its end."""
    f, f1, f2, f3 = formula(x / (2 * part))
    return 2 * part * f, f1, f2 / (2 * part), f3 / (2 * part) ** 2


def _stretched_tangent(k: float, *, tangent: Tangent, part: float) -> tuple[float, float]:
    """The place where f' - f/k is greatest, which lies where the acceleration is positive, and that value."""
    u, height = tangent(k / (2 * part))
    return 2 * part * u, height


# --- laws of sines ---------------------------------------------------------------------------------------------------

_PI = math.pi
_SINE_SERIES = tuple(1 / math.factorial(n) for n in range(17, 1, -2))
"""t - sin(t) = t^3 (1/3! - t^2 (1/5! - t^2 (1/7! - ...))), from the last term that counts for t < 1."""
_MODIFIED_TRAPEZOIDAL_PEAK = 8 * _PI / (2 + _PI)
_MODIFIED_SINE_PEAK = 4 * _PI / (4 + _PI)


def _sine_up(x: Floats, *, height: float, k: float):
    """Acceleration height * sin(k x) from rest."""
    s, c = sine_cosine(k / 2 * x)
    sine = 2 * s * c
    return (
        height / k**2 * _less_sine(k * x, sine),
        2 * height / k * s * s,
        height * sine,
        height * k * (c - s) * (c + s),
    )


def _sine_down(x: Floats, *, height: float, k: float, peak: float):
    """Acceleration height * sin(k y) with y = 1/2 - x: zero at the middle, where f = 1/2 and f' = peak."""
    y = 0.5 - x
    s, c = sine_cosine(k / 2 * y)
    sine = 2 * s * c
    return (
        0.5 - (peak - height / k) * y - height / k**2 * sine,
        peak - 2 * height / k * s * s,
        height * sine,
        -height * k * (c - s) * (c + s),
    )


def _sine_top(x: Floats, *, height: float):
    """The flat of the modified trapezoidal law after a sine ramp over 1/8."""
    k, y = 4 * math.pi, x - 1 / 8
    return (
        height / k * (1 / 8 - 1 / k) + y * (height / k + height / 2 * y),
        height / k + height * y,
        np.full_like(x, height),
        np.zeros_like(x),
    )


def _cosine(x: Floats):
    pi = math.pi
    s, c = sine_cosine(pi / 2 * x)
    product = s * c
    return s * s, pi * product, pi**2 / 2 * (c - s) * (c + s), -(pi**3) * product


def _double_harmonic(x: Floats):
    """f = (1 - cos(pi x))/2 - (1 - cos(2 pi x))/8 is the fourth power of the sine s of half the angle pi x."""
    s, c = sine_cosine(_PI / 2 * x)
    square, product = s * s, s * c
    return (
        square * square,
        2 * _PI * square * product,
        _PI**2 * square * (3 - 4 * square),
        _PI**3 * product * (3 - 8 * square),
    )


def _double_harmonic_end(x: Floats):
    """1 - f at the distance x from the end: 1 - (1 - s^2)^2."""
    s, c = sine_cosine(_PI / 2 * x)
    square, product = s * s, s * c
    return (
        square * (2 - square),
        2 * _PI * (1 - square) * product,
        _PI**2 * (1 - square) * (1 - 4 * square),
        _PI**3 * product * (8 * square - 5),
    )


def _less_sine(t: Floats, sine: Floats) -> Floats:
    """t - sin(t).  Below 1 by its series, because the difference of two nearly equal numbers keeps no digits."""
    difference = t - sine
    if isinstance(t, float):
        return _of_series(t) if t < 1 else difference
    small = np.flatnonzero(t < 1)  # as numbers, which cost less than a mask where they lie scattered
    if small.size:
        difference[small] = _of_series(t[small])
    return difference


def _of_series(t: Floats) -> Floats:
    square = t * t
    series = 0 * t
    for coefficient in _SINE_SERIES:
        series = coefficient - square * series
    return t * square * series


def _cosine_tangent(k: float) -> tuple[float, float]:
    q = _PI * k
    return math.atan(q) / _PI, _PI / 2 * q / (1 + math.hypot(1, q))


def _cycloidal_tangent(k: float) -> tuple[float, float]:
    q = 2 * _PI * k
    return math.atan(q) / _PI, 2 * _less_atan(q) / q


def _less_atan(q: float) -> float:
    """q - atan(q) for q > 0, to its own last digits."""
    if q > 2:
        return q - math.atan(q)
    if q > 0.3:
        # atan(q) = 2 atan(t) with q = 2t/(1 - t^2), and both terms are positive.
        t = q / (1 + math.hypot(1, q))
        return 2 * (t**3 / ((1 - t) * (1 + t)) + _less_atan(t))
    series = 0.0
    for n in range(33, 1, -2):
        series = 1 / n - q * q * series
    return q**3 * series


def _double_harmonic_tangent(k: float) -> tuple[float, float]:
    q = _PI * k
    root = math.sqrt(1 + 3 * q * q)
    t = 3 * q / (1 + root)  # the tangent of pi u/2
    square = t * t / (1 + t * t)
    return 2 * math.atan(t) / _PI, square * square * (2 * root - 1) / (3 * k)


def _reversed_double_harmonic_tangent(k: float) -> tuple[float, float]:
    q = _PI * k
    t = q / (1 + math.sqrt(1 + 3 * q * q))
    c2 = 1 / (1 + t * t)
    return 2 * math.atan(t) / _PI, t * c2 * (2 * _PI * c2 - t * (1 + c2) / k)


def _cosine_law(_: float) -> Law:
    return Law(
        "cosine", _cosine, (), True, 1.0, 1.0, (_PI / 2, _PI**2 / 2), (_cosine_tangent, _cosine_tangent), trusted=True
    )


def _cycloidal_law(ratio: float) -> Law:
    formula = partial(_sine_up, height=2 * _PI, k=2 * _PI)
    tangents = _cycloidal_tangent, _cycloidal_tangent
    return skewed(Law("cycloidal", formula, (), True, 1.0, 1.0, (2.0, 2 * _PI), tangents, trusted=True), ratio)


def _modified_trapezoidal_law(ratio: float) -> Law:
    height, k = _MODIFIED_TRAPEZOIDAL_PEAK, 4 * _PI
    up, down = partial(_sine_up, height=height, k=k), partial(_sine_down, height=height, k=k, peak=2.0)
    formulas = up, partial(_sine_top, height=height), down
    equal = Law("modified-trapezoidal", formulas, (1 / 8, 3 / 8), True, peaks=(2.0, height), trusted=True)
    return skewed(equal, ratio)


def _modified_sine_law(ratio: float) -> Law:
    height, peak = _PI * _MODIFIED_SINE_PEAK, _MODIFIED_SINE_PEAK
    rising, falling = (
        partial(_sine_up, height=height, k=4 * _PI),
        partial(_sine_down, height=height, k=4 * _PI / 3, peak=peak),
    )
    equal = Law("modified-sine", (rising, falling), (1 / 8,), True, peaks=(peak, height), trusted=True)
    return skewed(equal, ratio)


def _double_harmonic_law(_: float) -> Law:
    formulas, peaks = (_double_harmonic, _double_harmonic_end), (3 * math.sqrt(3) * _PI / 8, _PI**2)
    tangents, seams = (_double_harmonic_tangent, _reversed_double_harmonic_tangent), (0.5,)
    return Law("double-harmonic", formulas, seams, False, 0.5, 1.0, peaks, tangents, trusted=True, seams=seams)


def _printed_modified_trapezoidal(u: Any, m: Any) -> Any:
    pi, sin = m.pi, m.sin
    if 8 * u <= 1:
        return (2 * u - sin(4 * pi * u) / (2 * pi)) / (2 + pi)
    if 8 * u <= 3:
        y = u - 1 / 8
        return (1 / 4 - 1 / (2 * pi) + 2 * y + 4 * pi * y**2) / (2 + pi)
    return (-pi / 2 + 2 * (1 + pi) * u - sin(4 * pi * (u - 1 / 4)) / (2 * pi)) / (2 + pi)


def _printed_modified_sine(u: Any, m: Any) -> Any:
    pi, sin = m.pi, m.sin
    if 8 * u <= 1:
        return (pi * u - sin(4 * pi * u) / 4) / (4 + pi)
    if 8 * u <= 7:
        return (2 + pi * u - 9 * sin(4 * pi * u / 3 + pi / 3) / 4) / (4 + pi)
    return (4 + pi * u - sin(4 * pi * u) / 4) / (4 + pi)


_RAMP, _SINE = 128 * _PI**3 / (2 + _PI), 64 * _PI**4 / (4 + _PI)


# --- laws whose acceleration is made of straight lines ---------------------------------------------------------------


def _constant(x: Floats, *, height: float):
    """Constant acceleration from rest."""
    return height / 2 * x * x, height * x, np.full_like(x, height), np.zeros_like(x)


def _linear_up(x: Floats, *, slope: float):
    """Acceleration growing from zero along a straight line."""
    square = x * x
    return slope / 6 * square * x, slope / 2 * square, slope * x, np.full_like(x, slope)


def _linear_down(x: Floats, *, slope: float):
    """Acceleration falling along a straight line to zero at the middle, where f = 1/2 and f' = 2."""
    y = 0.5 - x
    square = y * y
    return 0.5 - y * (2 - slope / 6 * square), 2 - slope / 2 * square, slope * y, np.full_like(x, -slope)


def _trapezoid_top(x: Floats, *, height: float):
    """The flat of a trapezoidal acceleration after a linear ramp of 1/8."""
    y = x - 1 / 16
    return height / 2 * y * y + height / 1536, height * y, np.full_like(x, height), np.zeros_like(x)


def _rectangular_tangent(k: float, *, middle: float) -> tuple[float, float]:
    """The place u where f' - f/k is greatest, and that value."""
    u = min(k, middle)
    return u, 2 / middle * u * (1 - u / k / 2)


def _rectangular(ratio: float) -> Law:
    # The accelerations follow from the break as the machine has it: else the velocities, both 2 there, would miss each
    # other by what the break is rounded by over the shorter part.
    middle = 1 / (1 + ratio)
    parts = middle, 1 - middle
    first = partial(_constant, height=2 / middle)
    second = first if middle == 0.5 else partial(_constant, height=2 / (1 - middle))
    ahead, back = (partial(_rectangular_tangent, middle=part) for part in parts)
    peaks = 2.0, 2 / min(parts)
    return Law("rectangular", (first, second), (middle,), False, middle, ratio, peaks, (ahead, back), trusted=True)


def _triangular(ratio: float) -> Law:
    formulas = partial(_linear_up, slope=32.0), partial(_linear_down, slope=32.0)
    return skewed(Law("triangular", formulas, (1 / 4,), True, peaks=(2.0, 8.0), trusted=True), ratio)


def _trapezoidal(_: float) -> Law:
    formulas = (
        partial(_linear_up, slope=128 / 3),
        partial(_trapezoid_top, height=16 / 3),
        partial(_linear_down, slope=128 / 3),
    )
    return Law("trapezoidal", formulas, (1 / 8, 3 / 8), True, peaks=(2.0, 16 / 3), trusted=True)


def _printed_triangular(u: Any, _: Any) -> Any:
    return 16 * u**3 / 3 if 4 * u <= 1 else (1 - 12 * u + 48 * u**2 - 32 * u**3) / 6


def _printed_trapezoidal(u: Any, _: Any) -> Any:
    if 8 * u <= 1:
        return 64 * u**3 / 9
    if 8 * u <= 3:
        return (192 * u**2 - 24 * u + 1) / 72
    return (7 - 60 * u + 192 * u**2 - 128 * u**3) / 18


# --- laws that are polynomials ---------------------------------------------------------------------------------------

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


TEXTBOOK_LAWS = (
    DeclaredLaw(
        title=say("rectangular"),
        make=_rectangular,
        printed=mirrored_print(lambda u, _: 2 * u**2),
        fifth_derivatives=((0.0,), ()),
        has_ratio=True,
    ),
    DeclaredLaw(
        title=say("triangular"),
        make=_triangular,
        printed=mirrored_print(_printed_triangular),
        fifth_derivatives=((0.0, 0.0), (0.0,)),
        has_ratio=True,
    ),
    DeclaredLaw(
        title=say("cosine"),
        make=_cosine_law,
        printed=lambda u, m: (1 - m.cos(m.pi * u)) / 2,
        fifth_derivatives=((_PI**5 / 2,), ()),
    ),
    DeclaredLaw(
        title=say("cycloidal"),
        make=_cycloidal_law,
        printed=lambda u, m: u - m.sin(2 * m.pi * u) / (2 * m.pi),
        fifth_derivatives=((16 * _PI**4,), ()),
        has_ratio=True,
    ),
    DeclaredLaw(
        title=say("trapezoidal"),
        make=_trapezoidal,
        printed=mirrored_print(_printed_trapezoidal),
        fifth_derivatives=((0.0, 0.0, 0.0), (0.0, 0.0)),
    ),
    DeclaredLaw(
        title=say("modified-trapezoidal"),
        make=_modified_trapezoidal_law,
        printed=mirrored_print(_printed_modified_trapezoidal),
        fifth_derivatives=((4 * _PI * _RAMP, 0.0, 4 * _PI * _RAMP), (_RAMP, _RAMP)),
        has_ratio=True,
    ),
    DeclaredLaw(
        title=say("modified-sine"),
        make=_modified_sine_law,
        printed=_printed_modified_sine,
        fifth_derivatives=((4 * _PI * _SINE, 4 * _PI * _SINE / 27), (8 / 9 * _SINE,)),
        has_ratio=True,
    ),
    DeclaredLaw(
        title=say("2-3"),
        make=lambda _: _polynomial("2-3", _poly_2_3, (1.5, 6.0), 1, (3, -4, 2)),
        printed=lambda u, _: 3 * u**2 - 2 * u**3,
        fifth_derivatives=((0.0,), ()),
    ),
    DeclaredLaw(
        title=say("3-4-5"),
        make=lambda _: _polynomial("3-4-5", _poly_3_4_5, (1.875, 10 / math.sqrt(3)), 2, (10, -20, 18, -6)),
        printed=lambda u, _: 10 * u**3 - 15 * u**4 + 6 * u**5,
        fifth_derivatives=((720.0,), ()),
    ),
    DeclaredLaw(
        title=say("4-5-6-7"),
        make=lambda _: _polynomial(
            "4-5-6-7", _poly_4_5_6_7, (2.1875, 84 / (5 * math.sqrt(5))), 3, (35, -98, 126, -80, 20)
        ),
        printed=lambda u, _: 35 * u**4 - 84 * u**5 + 70 * u**6 - 20 * u**7,
        fifth_derivatives=((10080.0,), ()),
    ),
    DeclaredLaw(
        title=say("double-harmonic"),
        make=_double_harmonic_law,
        printed=lambda u, m: (1 - m.cos(m.pi * u)) / 2 - (1 - m.cos(2 * m.pi * u)) / 8,
        fifth_derivatives=((4.5 * _PI**5,), ()),
        rise_fall=True,
    ),
    DeclaredLaw(
        title=say("eighth-degree"),
        make=lambda _: leg_law("eighth-degree", as_series([(Fraction(0), Fraction(1), _EIGHTH_COEFFICIENTS)]))[1],
        printed=lambda u, _: sum(c.numerator * u**k / c.denominator for k, c in enumerate(_EIGHTH_COEFFICIENTS)),
        fifth_derivatives=((2493.648,), ()),
        rise_fall=True,
    ),
)
"""The declarations of this file, which :mod:`graphcam.given.laws` lists."""

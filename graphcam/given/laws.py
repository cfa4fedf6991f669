"""The twelve normalised motion laws, and what else textbooks call them.

Every law is written as it looks from the nearer end of the phase: the first half as a function of the distance
x = u from the start, the second half as a function of the distance x = w = 1 - u from the end.  The formulas are
factored, because a product costs less than a power and rounds less than a sum.

Two of them are for a rise and a fall without a dwell between: the acceleration they end with is no jump where the fall
begins with the same.

Sources: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapters 2 and 3; R. L. Norton, *Cam Design and
Manufacturing Handbook* (2009), chapters 2 to 4; M. Kloomok and R. V. Muffley, *Plate Cam Design*, Product Engineering
26 (February 1955), the eighth-degree polynomial.
"""

import math
from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache, partial

import numpy as np

from graphcam.errors import DesignError, nearest_word_remedy
from graphcam.given.exact_polynomials import ExactPiece
from graphcam.given.motion_law import Fourth, Law
from graphcam.given.piecewise import Floats, Formula, Side, sine_cosine
from graphcam.given.polynomial_law import CONSTANT_VELOCITY, constant_velocity_law, leg_law
from graphcam.words import say

__all__ = ["LAWS", "Floats", "Side", "law"]

_PI = math.pi
RISE_FALL_LAWS = "double-harmonic", "eighth-degree"
"""The laws of a rise without a dwell behind it; a return by them runs backwards, from the same acceleration to rest."""
MAX_PART_RATIO = 1e12
"""Greatest ratio of the rectangular law's parts: of more, the shorter is lost beside the longer."""

# --- the pieces ------------------------------------------------------------------------------------------------------
# Each takes x, the distance from its end of the phase, and returns f, f', f'', f''' (from the end: the missing lift).


LAW_SYNONYMS: Mapping[str, tuple[str, ...]] = {
    "rectangular": (
        *("constant acceleration", "uniform acceleration", "parabolic", "parabola"),
        *("прямоугольный (постоянного ускорения)", "прямоугольный", "постоянного ускорения", "параболический"),
        *("gia tốc không đổi", "等加速等减速", "等加速"),
    ),
    "triangular": ("треугольный", "tam giác", "三角形加速度"),
    "cosine": (
        *("simple harmonic", "simple harmonic motion", "SHM", "harmonic", "cosine acceleration"),
        *("косинусоидальный", "косинусный", "гармонический", "cosin", "điều hòa"),
        *("余弦加速度", "余弦加速度(简谐)", "余弦", "简谐", "简谐运动"),
    ),
    "cycloidal": (
        *("cycloid", "sine", "sine acceleration", "sinusoidal"),
        *("синусоидальный", "синусный", "циклоидальный", "xyclôit", "sin", "正弦加速度", "正弦", "摆线"),
    ),
    "trapezoidal": ("trapezoid", "трапецеидальный", "трапециевидный", "hình thang", "梯形加速度", "梯形"),
    "modified-trapezoidal": (
        "modtrap",
        "mod-trapezoid",
        "MT",
        "видоизменённый трапецеидальный",
        "hình thang cải tiến",
        "改进梯形",
        "修正梯形",
    ),
    "modified-sine": (
        "modsine",
        "mod-sine",
        "MS",
        "видоизменённый синусоидальный",
        "sin cải tiến",
        "改进正弦",
        "修正正弦",
    ),
    "2-3": ("cubic", "полином 2-3", "đa thức 2-3", "2-3 多项式"),
    "3-4-5": ("quintic", "polynomial 3-4-5", "полином 3-4-5", "đa thức 3-4-5", "3-4-5 多项式", "五次多项式"),
    "4-5-6-7": ("polynomial 4-5-6-7", "полином 4-5-6-7", "đa thức 4-5-6-7", "4-5-6-7 多项式", "七次多项式"),
    "double-harmonic": ("двойной гармонический", "điều hòa kép", "双简谐"),
    "eighth-degree": ("полином восьмой степени", "đa thức bậc tám", "八次多项式"),
    "constant-velocity": ("uniform velocity", "постоянная скорость", "vận tốc không đổi", "等速"),
}
"""Other names of the laws by the law's name; those of the catalogs among them."""


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


_SINE_SERIES = tuple(1 / math.factorial(n) for n in range(17, 1, -2))
"""t - sin(t) = t^3 (1/3! - t^2 (1/5! - t^2 (1/7! - ...))), from the last term that counts for t < 1."""


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


# --- the fourth derivatives ------------------------------------------------------------------------------------------
# Each takes x and returns f there, and a bound on |f'| over the piece.


def _no_fourth(x: Floats) -> tuple[Floats, float]:
    return np.zeros_like(x), 0.0


def _fourth_of_sine(x: Floats, *, formula: Formula, height: float, k: float) -> tuple[Floats, float]:
    """The fourth derivative f'''' of an acceleration height * sin(k x + c)."""
    return -(k**2) * np.asarray(formula(x)[2]), height * k**3


def _fourth_3_4_5(x: Floats) -> tuple[Floats, float]:
    return 720 * x - 360, 720.0


def _fourth_4_5_6_7(x: Floats) -> tuple[Floats, float]:
    return 840 * (1 - 2 * x) * (1 - 10 * x * (1 - x)), 10080.0


def _fourth_of_double_harmonic(x: Floats, *, sign: int) -> tuple[Floats, float]:
    """f'''' from the start with the sign -1, from the end +1: only the second wave changes sign."""
    return _PI**4 * (-np.cos(_PI * x) / 2 - sign * 2 * np.cos(2 * _PI * x)), 4.5 * _PI**5


# --- the tangents ----------------------------------------------------------------------------------------------------
# Each takes k and returns the place u where f' - f/k is greatest, the root of k f'' = f', and that value; with
# k = cot(A)/F it is where the line at the permitted pressure angle A touches the s - v diagram, and its height there.


def _rectangular_tangent(k: float, *, middle: float) -> tuple[float, float]:
    u = min(k, middle)
    return u, 2 / middle * u * (1 - u / k / 2)


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


# --- the laws --------------------------------------------------------------------------------------------------------

_MODIFIED_TRAPEZOIDAL_PEAK = 8 * _PI / (2 + _PI)
_MODIFIED_SINE_PEAK = 4 * _PI / (4 + _PI)

_TRAPEZOID_SINE = {"height": _MODIFIED_TRAPEZOIDAL_PEAK, "k": 4 * _PI}
_SINE_RISE = {"height": _PI * _MODIFIED_SINE_PEAK, "k": 4 * _PI}
_SINE_FALL = {"height": _PI * _MODIFIED_SINE_PEAK, "k": 4 * _PI / 3}

_TRIANGULAR_PIECES = partial(_linear_up, slope=32.0), partial(_linear_down, slope=32.0)
_CYCLOIDAL_FORMULA = partial(_sine_up, height=2 * _PI, k=2 * _PI)
_TRAPEZOIDAL_PIECES = (
    partial(_linear_up, slope=128 / 3),
    partial(_trapezoid_top, height=16 / 3),
    partial(_linear_down, slope=128 / 3),
)
_MODIFIED_TRAPEZOIDAL_PIECES = (
    partial(_sine_up, **_TRAPEZOID_SINE),
    partial(_sine_top, height=_MODIFIED_TRAPEZOIDAL_PEAK),
    partial(_sine_down, **_TRAPEZOID_SINE, peak=2.0),
)
_MODIFIED_SINE_PIECES = partial(_sine_up, **_SINE_RISE), partial(_sine_down, **_SINE_FALL, peak=_MODIFIED_SINE_PEAK)
_TANGENT_2_3 = partial(_polynomial_tangent, n=1, rest=(3, -4, 2))
_TANGENT_3_4_5 = partial(_polynomial_tangent, n=2, rest=(10, -20, 18, -6))
_TANGENT_4_5_6_7 = partial(_polynomial_tangent, n=3, rest=(35, -98, 126, -80, 20))

_EIGHTH_COEFFICIENTS = tuple(
    map(Fraction, ("0", "0", "0", "6.09755", "0", "-20.7804", "26.73155", "-13.60965", "2.56095"))
)
"""The coefficients of the eighth-degree polynomial, as they were published."""


def _sines(*pieces: tuple[Formula, dict[str, float]]) -> tuple[Fourth, ...]:
    """The fourth derivatives of pieces whose accelerations are sines."""
    return tuple(partial(_fourth_of_sine, formula=formula, **sizes) for formula, sizes in pieces)


_FOURTH_DERIVATIVES = {
    "triangular": (_no_fourth, _no_fourth),
    "cosine": _sines((_cosine, {"height": _PI**2 / 2, "k": _PI})),
    "cycloidal": _sines((_CYCLOIDAL_FORMULA, {"height": 2 * _PI, "k": 2 * _PI})),
    "trapezoidal": (_no_fourth, _no_fourth, _no_fourth),
    "modified-trapezoidal": (
        *_sines((_MODIFIED_TRAPEZOIDAL_PIECES[0], _TRAPEZOID_SINE)),
        _no_fourth,
        *_sines((_MODIFIED_TRAPEZOIDAL_PIECES[2], _TRAPEZOID_SINE)),
    ),
    "modified-sine": _sines(*zip(_MODIFIED_SINE_PIECES, (_SINE_RISE, _SINE_FALL), strict=True)),
    "2-3": (_no_fourth,),
    "3-4-5": (_fourth_3_4_5,),
    "4-5-6-7": (_fourth_4_5_6_7,),
}

# The formulas of the first half and where one takes over from another, the peaks, the tangent in closed form.
_MIRRORED_LAWS = {
    "triangular": (_TRIANGULAR_PIECES, (1 / 4,), (2.0, 8.0), None),
    "cosine": (_cosine, (), (_PI / 2, _PI**2 / 2), _cosine_tangent),
    "cycloidal": (_CYCLOIDAL_FORMULA, (), (2.0, 2 * _PI), _cycloidal_tangent),
    "trapezoidal": (_TRAPEZOIDAL_PIECES, (1 / 8, 3 / 8), (2.0, 16 / 3), None),
    "modified-trapezoidal": (_MODIFIED_TRAPEZOIDAL_PIECES, (1 / 8, 3 / 8), (2.0, _MODIFIED_TRAPEZOIDAL_PEAK), None),
    "modified-sine": (_MODIFIED_SINE_PIECES, (1 / 8,), (_MODIFIED_SINE_PEAK, _PI * _MODIFIED_SINE_PEAK), None),
    "2-3": (_poly_2_3, (), (1.5, 6.0), _TANGENT_2_3),
    "3-4-5": (_poly_3_4_5, (), (1.875, 10 / math.sqrt(3)), _TANGENT_3_4_5),
    "4-5-6-7": (_poly_4_5_6_7, (), (2.1875, 84 / (5 * math.sqrt(5))), _TANGENT_4_5_6_7),
}

DWELL_TO_DWELL_LAWS: tuple[str, ...] = ("rectangular", *_MIRRORED_LAWS)
"""The laws that look the same from both ends."""
LAWS: tuple[str, ...] = (*DWELL_TO_DWELL_LAWS, *RISE_FALL_LAWS)


def law(name: str | Law, ratio: float = 1.0) -> Law:
    """The normalised motion law of that name; a law of your own is returned as it is.

    Parameters
    ----------
    name : one of :data:`LAWS`, or "constant-velocity" with blends of a quarter, or a
        :class:`~graphcam.given.motion_law.Law`
    ratio : nu = |a1|/|a2|, first part's acceleration over the second's; only the rectangular law has one.  It is kept
        as nearly as the place u = 1/(1 + nu) between the parts is a number of the machine

    Raises
    ------
    DesignError : the name is unknown, the ratio is not positive or out of range, or the law has no ratio

    >>> import graphcam as gc
    >>> gc.law("cycloidal").peak_velocity
    2.0
    >>> f, df, ddf, dddf = gc.law("rectangular", ratio=3.0)(1 / 4)
    >>> float(f), float(df), round(float(ddf), 12)
    (0.25, 2.0, -2.666666666667)
    >>> gc.law("trapezoidal").corners, gc.law("modified-trapezoidal").corners
    ((0.125, 0.375, 0.625, 0.875), ())
    """
    if name == CONSTANT_VELOCITY:
        name = constant_velocity_law()
    own = isinstance(name, Law)
    if not own and name not in LAWS:
        known = (*LAWS, CONSTANT_VELOCITY)
        remedy = nearest_word_remedy(f"{name}", known, LAW_SYNONYMS)
        if callable(name):
            remedy = say("a law of your own is gc.Law(name, formula)")
        raise DesignError("law", name, say("a motion law that graphcam knows"), remedy)
    if not 1 / MAX_PART_RATIO <= ratio <= MAX_PART_RATIO:
        limit = say(
            "a finite number greater than 0, from {value:g} to {most:g}", value=1 / MAX_PART_RATIO, most=MAX_PART_RATIO
        )
        raise DesignError("ratio", ratio, limit, say("leave it out for equal parts"))
    if name != "rectangular" and ratio != 1:
        called = name.name if own else name
        limit = say("1 for the {called} law", called=called)
        raise DesignError("ratio", ratio, limit, say("only the rectangular law has unequal parts"))
    return name if own else _built_law(name, ratio)


def law_of_return(name: str | Law, ratio: float = 1.0) -> Law:
    """The law of a return, of that name: one of :data:`RISE_FALL_LAWS` runs backwards there.

    >>> law_of_return("eighth-degree")(0.0)[2].item(), law_of_return("cosine") == law("cosine")
    (5.2683, True)
    """
    found = law(name, ratio)
    return found.reversed if name in RISE_FALL_LAWS else found


@lru_cache(maxsize=256)
def _built_law(name: str, ratio: float) -> Law:
    # Cached, so that phases of the same law share their formulas and are computed together.
    if name == "eighth-degree":
        _, made = leg_law(name, [ExactPiece(Fraction(0), Fraction(1), _EIGHTH_COEFFICIENTS)])
        return made
    if name == "double-harmonic":
        formulas, peaks = (_double_harmonic, _double_harmonic_end), (3 * math.sqrt(3) * _PI / 8, _PI**2)
        fourths = tuple(partial(_fourth_of_double_harmonic, sign=sign) for sign in (-1, 1))
        tangents, seams = (_double_harmonic_tangent, _reversed_double_harmonic_tangent), (0.5,)
        return Law(name, formulas, seams, False, 0.5, 1.0, peaks, tangents, fourths, trusted=True, seams=seams)
    if name != "rectangular":
        formulas, edges, peaks, tangent = _MIRRORED_LAWS[name]
        tangents = tangent, tangent
        return Law(
            name, formulas, edges, True, 1.0, 1.0, peaks, tangents, _FOURTH_DERIVATIVES.get(name, ()), trusted=True
        )
    # The accelerations follow from the break as the machine has it: else the velocities, both 2 there, would miss each
    # other by what the break is rounded by over the shorter part.
    middle = 1 / (1 + ratio)
    parts = middle, 1 - middle
    first = partial(_constant, height=2 / middle)
    second = first if middle == 0.5 else partial(_constant, height=2 / (1 - middle))
    ahead, back = (partial(_rectangular_tangent, middle=part) for part in parts)
    peaks = 2.0, 2 / min(parts)
    fourths = _no_fourth, _no_fourth
    return Law(name, (first, second), (middle,), False, middle, ratio, peaks, (ahead, back), fourths, trusted=True)

"""The laws of sines: cosine, cycloidal, modified trapezoidal, modified sine, double harmonic.

Each formula takes x, the distance from its end of the phase, and returns f, f', f'', f''' (from the end: the missing
lift).  Each tangent takes k and returns the place u where f' - f/k is greatest, the root of k f'' = f', and that
value; with k = cot(A)/F it is where the line at the permitted pressure angle A touches the s - v diagram, and its
height there.

Sources: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapters 2 and 3; R. L. Norton, *Cam Design and
Manufacturing Handbook* (2009), chapters 2 to 4.
"""

import math
from functools import partial
from typing import Any

import numpy as np

from graphcam.given.declared_law import DeclaredLaw, mirrored_print
from graphcam.given.motion_law import Law
from graphcam.given.piecewise import Floats, sine_cosine
from graphcam.given.skewed_law import skewed
from graphcam.words import say

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
COSINE = DeclaredLaw(
    title=say("cosine"),
    make=_cosine_law,
    printed=lambda u, m: (1 - m.cos(m.pi * u)) / 2,
    fifth_derivatives=((_PI**5 / 2,), ()),
)
CYCLOIDAL = DeclaredLaw(
    title=say("cycloidal"),
    make=_cycloidal_law,
    printed=lambda u, m: u - m.sin(2 * m.pi * u) / (2 * m.pi),
    fifth_derivatives=((16 * _PI**4,), ()),
    has_ratio=True,
)
MODIFIED_TRAPEZOIDAL = DeclaredLaw(
    title=say("modified-trapezoidal"),
    make=_modified_trapezoidal_law,
    printed=mirrored_print(_printed_modified_trapezoidal),
    fifth_derivatives=((4 * _PI * _RAMP, 0.0, 4 * _PI * _RAMP), (_RAMP, _RAMP)),
    has_ratio=True,
)
MODIFIED_SINE = DeclaredLaw(
    title=say("modified-sine"),
    make=_modified_sine_law,
    printed=_printed_modified_sine,
    fifth_derivatives=((4 * _PI * _SINE, 4 * _PI * _SINE / 27), (8 / 9 * _SINE,)),
    has_ratio=True,
)
DOUBLE_HARMONIC = DeclaredLaw(
    title=say("double-harmonic"),
    make=_double_harmonic_law,
    printed=lambda u, m: (1 - m.cos(m.pi * u)) / 2 - (1 - m.cos(2 * m.pi * u)) / 8,
    fifth_derivatives=((4.5 * _PI**5,), ()),
    rise_fall=True,
)

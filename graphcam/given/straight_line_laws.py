"""The laws whose acceleration is made of straight lines: rectangular, triangular, trapezoidal.

Each formula takes x, the distance from its end of the phase, and returns f, f', f'', f''' (from the end: the missing
lift).

Sources: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapters 2 and 3; R. L. Norton, *Cam Design and
Manufacturing Handbook* (2009), chapters 2 to 4.
"""

from functools import partial
from typing import Any

import numpy as np

from graphcam.given.declared_law import DeclaredLaw, mirrored_print
from graphcam.given.motion_law import Law
from graphcam.given.piecewise import Floats
from graphcam.given.skewed_law import skewed
from graphcam.words import say


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


RECTANGULAR = DeclaredLaw(
    title=say("rectangular"),
    make=_rectangular,
    printed=mirrored_print(lambda u, _: 2 * u**2),
    fifth_derivatives=((0.0,), ()),
    has_ratio=True,
)
TRIANGULAR = DeclaredLaw(
    title=say("triangular"),
    make=_triangular,
    printed=mirrored_print(_printed_triangular),
    fifth_derivatives=((0.0, 0.0), (0.0,)),
    has_ratio=True,
)
TRAPEZOIDAL = DeclaredLaw(
    title=say("trapezoidal"),
    make=_trapezoidal,
    printed=mirrored_print(_printed_trapezoidal),
    fifth_derivatives=((0.0, 0.0, 0.0), (0.0, 0.0)),
)

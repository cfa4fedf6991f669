"""The ten normalised motion laws: a lift f from 0 to 1 while u runs from 0 to 1.

Every law is written as it looks from the nearer end of the phase: the first half as a function of the distance
x = u from the start, the second half as a function of the distance x = w = 1 - u from the end.  So what is small
near an end (the lift just begun, the lift still missing, the velocity) keeps all its digits there, which
1 - f(u) would lose.  The formulas are factored, because a product costs less than a power and rounds less than a sum.

Sources: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapters 2 and 3; R. L. Norton, *Cam Design and
Manufacturing Handbook* (2009), chapters 2 to 4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, partial

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError, nearest
from graphcam.given.circular import sine_cosine
from graphcam.given.pieces import Floats, Formula, Piece, Piecewise, Side, chunks

__all__ = ["LAWS", "Floats", "Half", "Law", "Side", "law"]

SHARP = 1e-6
"""Where the slope of the acceleration jumps by more than this part of the greatest acceleration, there is a corner."""


@dataclass(frozen=True)
class Half:
    """One half of a law, seen from its end: its pieces of x and the places where one piece takes over from another."""

    pieces: tuple[Formula, ...]
    breaks: tuple[float, ...] = ()


@dataclass(frozen=True)
class Law:
    """A normalised motion law; call it with u in [0, 1] for (f, f', f'', f''').

    Attributes
    ----------
    name, ratio : as given to :func:`law`
    middle : the u at which the second half begins
    halves : the pieces seen from the start and from the end
    peak_velocity, peak_acceleration : C_v = max f' and C_a = max |f''|, so v_max = C_v h/F and a_max = C_a h/F^2
    """

    name: str
    ratio: float
    middle: float
    halves: tuple[Half, Half]
    peak_velocity: float
    peak_acceleration: float

    @property
    def edges(self) -> tuple[float, ...]:
        """The inner places u where one piece takes over from another, in order; the middle is one of them."""
        first, second = self.halves
        return (*first.breaks, self.middle, *(1.0 - x for x in reversed(second.breaks)))

    @property
    def breaks(self) -> tuple[float, ...]:
        """The inner places u where a derivative may jump, in order."""
        return tuple(u for u in self.edges if u != self.middle or u in self.jumps)

    @property
    def jumps(self) -> tuple[float, ...]:
        """The inner places u where the acceleration itself jumps."""
        return (self.middle,) if self.name == "rectangular" else ()

    @property
    def corners(self) -> tuple[float, ...]:
        """The inner places u where the acceleration turns a corner: it is continuous, its slope jumps.

        >>> law("trapezoidal").corners, law("modified-trapezoidal").corners
        ((0.125, 0.375, 0.625, 0.875), ())
        """
        breaks = np.array([u for u in self.breaks if u not in self.jumps])
        before, after = (self(breaks, side=side)[3] for side in ("left", "right"))
        return tuple(breaks[np.abs(after - before) > SHARP * self.peak_acceleration].tolist())

    @property
    def reversed(self) -> Law:
        """The law that runs backwards: 1 - f(1 - u).

        >>> law("rectangular", ratio=4.0).reversed.ratio
        0.25
        """
        if self.halves[0] is self.halves[1]:
            return self
        return replace(self, ratio=1 / self.ratio, middle=1 - self.middle, halves=(self.halves[1], self.halves[0]))

    def __call__(self, u: ArrayLike, derivatives: int = 3, side: Side = "right") -> tuple[Floats, ...]:
        """The lift f and its first ``derivatives`` derivatives at u, each shaped like u; NaN outside [0, 1].

        At a break the value of the named side is returned; u = 0 and u = 1 have only one.

        >>> [float(x) for x in law("3-4-5")(0.5)]
        [0.5, 1.875, 0.0, -30.0]
        """
        u = np.asarray(u, dtype=np.float64)
        flat = u.ravel()
        out = np.empty((4, flat.size))
        for here in chunks(flat.size):
            inside = np.where((flat[here] >= 0) & (flat[here] <= 1), flat[here], np.nan)
            self._piecewise.fill(inside, side, out[:, here])
        return tuple(out.reshape(4, *u.shape)[: derivatives + 1])

    @cached_property
    def _piecewise(self) -> Piecewise:
        return Piecewise(self.pieces)

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The pieces between 0, the edges and 1."""
        first, second = self.halves
        starts = (0.0, *self.edges)
        n = len(first.pieces)
        return (
            *(Piece(f, u, 0.0, 1.0, 0.0, (1, 1, 1, 1)) for f, u in zip(first.pieces, starts[:n], strict=True)),
            # Seen from the end the lift is the missing lift and the acceleration its negative.
            *(
                Piece(g, u, 1.0, -1.0, 1.0, (-1, 1, -1, 1))
                for g, u in zip(second.pieces[::-1], starts[n:], strict=True)
            ),
        )


# --- the pieces ------------------------------------------------------------------------------------------------------
# Each takes x, the distance from its end of the phase, and returns f, f', f'', f''' (from the end: the missing lift).


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
    k = 4 * math.pi
    y = x - 1 / 8
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


_SINE_SERIES = tuple(1 / math.factorial(n) for n in range(17, 1, -2))
"""t - sin(t) = t^3 (1/3! - t^2 (1/5! - t^2 (1/7! - ...))), from the last term that counts for t < 1."""


def _less_sine(t: Floats, sine: Floats) -> Floats:
    """t - sin(t).  Below 1 by its series, because the difference of two nearly equal numbers keeps no digits."""
    difference = t - sine
    small = t < 1
    if small.any():
        below = t[small]
        square = below * below
        series = np.zeros_like(below)
        for coefficient in _SINE_SERIES:
            series = coefficient - square * series
        difference[small] = below * square * series
    return difference


# --- the laws --------------------------------------------------------------------------------------------------------

_PI = math.pi
_MODIFIED_TRAPEZOIDAL = 8 * _PI / (2 + _PI)
_MODIFIED_SINE = 4 * _PI / (4 + _PI)

_SYMMETRIC: dict[str, tuple[Half, float, float]] = {
    "triangular": (
        Half((partial(_linear_up, slope=32.0), partial(_linear_down, slope=32.0)), (1 / 4,)), 2.0, 8.0,
    ),
    "cosine": (Half((_cosine,)), _PI / 2, _PI**2 / 2),
    "cycloidal": (Half((partial(_sine_up, height=2 * _PI, k=2 * _PI),)), 2.0, 2 * _PI),
    "trapezoidal": (
        Half(
            (
                partial(_linear_up, slope=128 / 3),
                partial(_trapezoid_top, height=16 / 3),
                partial(_linear_down, slope=128 / 3),
            ),
            (1 / 8, 3 / 8),
        ), 2.0, 16 / 3,
    ),
    "modified-trapezoidal": (
        Half(
            (
                partial(_sine_up, height=_MODIFIED_TRAPEZOIDAL, k=4 * _PI),
                partial(_sine_top, height=_MODIFIED_TRAPEZOIDAL),
                partial(_sine_down, height=_MODIFIED_TRAPEZOIDAL, k=4 * _PI, peak=2.0),
            ),
            (1 / 8, 3 / 8),
        ), 2.0, _MODIFIED_TRAPEZOIDAL,
    ),
    "modified-sine": (
        Half(
            (
                partial(_sine_up, height=_PI * _MODIFIED_SINE, k=4 * _PI),
                partial(_sine_down, height=_PI * _MODIFIED_SINE, k=4 * _PI / 3, peak=_MODIFIED_SINE),
            ),
            (1 / 8,),
        ), _MODIFIED_SINE, _PI * _MODIFIED_SINE,
    ),
    "2-3": (Half((_poly_2_3,)), 1.5, 6.0),
    "3-4-5": (Half((_poly_3_4_5,)), 1.875, 10 / math.sqrt(3)),
    "4-5-6-7": (Half((_poly_4_5_6_7,)), 2.1875, 84 / (5 * math.sqrt(5))),
}  # fmt: skip

LAWS: tuple[str, ...] = (
    "rectangular", "triangular", "cosine", "cycloidal", "trapezoidal",
    "modified-trapezoidal", "modified-sine", "2-3", "3-4-5", "4-5-6-7",
)  # fmt: skip


def law(name: str, ratio: float = 1.0) -> Law:
    """The normalised motion law of that name.

    Parameters
    ----------
    name : one of :data:`LAWS`
    ratio : nu = |a1|/|a2|, first part's acceleration over the second's; only the rectangular law has one

    Raises
    ------
    DesignError : the name is unknown, the ratio is not positive, or the law has no ratio

    >>> law("cycloidal").peak_velocity
    2.0
    >>> f, df, ddf, dddf = law("rectangular", ratio=2.0)(1 / 3)
    >>> round(float(f), 12), float(df), float(ddf)
    (0.333333333333, 2.0, -3.0)
    """
    if name not in LAWS:
        raise DesignError("law", name, "a motion law that graphcam knows", nearest(name, LAWS))
    if not (math.isfinite(ratio) and ratio > 0):
        raise DesignError("ratio", ratio, "a finite number greater than 0", "leave it out for equal parts")
    if name != "rectangular" and ratio != 1:
        raise DesignError("ratio", ratio, f"1 for the {name} law", "only the rectangular law has unequal parts")
    return _built(name, ratio)


@lru_cache(maxsize=256)
def _built(name: str, ratio: float) -> Law:
    # Cached, so that phases of the same law share their formulas and are computed together.
    if name == "rectangular":
        first = Half((partial(_constant, height=2 * (1 + ratio)),))
        second = first if ratio == 1 else Half((partial(_constant, height=2 * (1 + 1 / ratio)),))
        peak = 2 * (1 + max(ratio, 1 / ratio))
        return Law(name, ratio, 1 / (1 + ratio), (first, second), 2.0, peak)
    half, peak_velocity, peak_acceleration = _SYMMETRIC[name]
    return Law(name, 1.0, 0.5, (half, half), peak_velocity, peak_acceleration)

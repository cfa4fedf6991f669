"""Quantities over intervals, enclosed to the second order: what they can be anywhere inside, not at places alone.

Over an interval with the middle c and half the width h a quantity is

    q(c + t) = value + slope t + q''(c + t*) t^2/2,    |q'' - bend| <= spread  anywhere inside,

so it is off its value by no more than |slope| h + (|bend| + spread) h^2/2, and its slope by (|bend| + spread) h.  The
rules by which sums, products, quotients, roots and tangents inherit this are those of Leibniz, with every factor as far
off as it may be.  A function of numpy's operations takes such quantities as it takes arrays; so what is proved of a
formula is proved of the formula that is computed, up to the rounding of its values.

Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, *Introduction to Interval Analysis* (2009), chapters 6 and 9.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from graphcam.given.laws import Floats

Constant = Floats | float


@dataclass(eq=False, repr=False)
class Taylor(NDArrayOperatorsMixin):
    """A quantity over n intervals, as the module's docstring says; every part is (n,).

    >>> x = Taylor(np.array([0.5]), np.array([2.0]), np.array([1.0]), np.array([0.0]), np.array([0.0]))
    >>> square = x * x  # over [1.5, 2.5]
    >>> square.value.item(), square.slope.item(), square.bend.item(), square.half_range.item()
    (4.0, 4.0, 2.0, 2.25)
    """

    half: Floats
    value: Floats
    slope: Floats
    bend: Floats
    spread: Floats

    @cached_property
    def slope_off(self) -> Floats:
        """How far the slope may be from that in the middle."""
        return (np.abs(self.bend) + self.spread) * self.half

    @cached_property
    def half_range(self) -> Floats:
        """How far the quantity may be from its value in the middle."""
        return (np.abs(self.slope) + self.slope_off / 2) * self.half

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any) -> Any:
        rule = _UFUNC_RULES.get(ufunc)
        return NotImplemented if rule is None or method != "__call__" else rule(*inputs)


def _scaled_taylor(f: Taylor, by: Constant) -> Taylor:
    return Taylor(f.half, by * f.value, by * f.slope, by * f.bend, np.abs(by) * f.spread)


def _negative(f: Taylor) -> Taylor:
    return Taylor(f.half, -f.value, -f.slope, -f.bend, f.spread)


def _add(f: Taylor | Constant, g: Taylor | Constant) -> Taylor:
    if not isinstance(f, Taylor):
        f, g = g, f
    assert isinstance(f, Taylor)
    if not isinstance(g, Taylor):
        return Taylor(f.half, f.value + g, f.slope, f.bend, f.spread)
    return Taylor(f.half, f.value + g.value, f.slope + g.slope, f.bend + g.bend, f.spread + g.spread)


def _subtract(f: Taylor | Constant, g: Taylor | Constant) -> Taylor:
    return _add(f, _negative(g) if isinstance(g, Taylor) else -g)


def _multiply(f: Taylor | Constant, g: Taylor | Constant) -> Taylor:
    if not isinstance(f, Taylor):
        f, g = g, f
    assert isinstance(f, Taylor)
    if not isinstance(g, Taylor):
        return _scaled_taylor(f, g)
    slopes = f.slope * g.slope
    return Taylor(
        f.half,
        f.value * g.value,
        f.slope * g.value + f.value * g.slope,
        f.bend * g.value + 2 * slopes + f.value * g.bend,
        _times(f.bend, f.spread, g.value, g.half_range)
        + 2 * _times(f.slope, f.slope_off, g.slope, g.slope_off)
        + _times(g.bend, g.spread, f.value, f.half_range),
    )


def _times(a: Floats, a_off: Floats, b: Floats, b_off: Floats) -> Floats:
    """How far the product of two numbers may be off."""
    return np.abs(a) * b_off + a_off * (np.abs(b) + b_off)


def _divide(f: Taylor | Constant, g: Taylor | Constant) -> Taylor:
    if not isinstance(g, Taylor):
        assert isinstance(f, Taylor)
        return _scaled_taylor(f, 1 / g)
    quotient = (f.value if isinstance(f, Taylor) else f) / g.value
    # What is left of f = quotient g, divided by g, vanishes in the middle.
    left = f - quotient * g
    least = _lower_bound(np.abs(g.value), g.half_range)
    slope = left.slope / g.value
    bend = (left.bend - 2 * slope * g.slope) / g.value
    off = left.half_range / least
    slope_off = (left.slope_off + np.abs(slope) * g.half_range + off * (np.abs(g.slope) + g.slope_off)) / least
    spread = left.spread + 2 * _times(slope, slope_off, g.slope, g.slope_off)
    spread = (spread + off * (np.abs(g.bend) + g.spread) + np.abs(bend) * g.half_range) / least
    return Taylor(g.half, quotient, slope, bend, spread)


def _sqrt(f: Taylor) -> Taylor:
    root = np.sqrt(f.value)
    least = np.sqrt(_lower_bound(f.value, f.half_range))
    slope = f.slope / (2 * root)
    bend = (f.bend - 2 * slope * slope) / (2 * root)
    off = f.half_range / (least + root)
    slope_off = (f.slope_off + 2 * np.abs(slope) * off) / (2 * least)
    spread = (f.spread + 2 * _times(slope, slope_off, slope, slope_off) + 2 * np.abs(bend) * off) / (2 * least)
    return Taylor(f.half, root, slope, bend, spread)


def _tan(f: Taylor) -> Taylor:
    tangent = np.tan(f.value)
    greatest = np.tan(np.minimum(np.abs(f.value) + f.half_range, np.pi / 2))
    rate = 1 + tangent * tangent
    # t' = (1 + t^2) f' and t'' = (1 + t^2)(f'' + 2 t f'^2)
    off = np.where(np.abs(f.value) + f.half_range < np.pi / 2, (1 + greatest * greatest) * f.half_range, np.inf)
    rate_off = _times(tangent, off, tangent, off)
    square, square_off = f.slope * f.slope, _times(f.slope, f.slope_off, f.slope, f.slope_off)
    turn = f.bend + 2 * tangent * square
    turn_off = f.spread + 2 * _times(tangent, off, square, square_off)
    return Taylor(f.half, tangent, rate * f.slope, rate * turn, _times(rate, rate_off, turn, turn_off))


def _lower_bound(value: Floats, off: Floats) -> Floats:
    """The least that a positive quantity may be; 0 where it may have any sign, which leaves what it divides open."""
    return np.maximum(value - off, 0.0)


_UFUNC_RULES: dict[np.ufunc, Callable[..., Taylor]] = {
    np.add: _add,
    np.subtract: _subtract,
    np.multiply: _multiply,
    np.divide: _divide,
    np.negative: _negative,
    np.sqrt: _sqrt,
    np.tan: _tan,
}
"""How each of numpy's operations treats such quantities."""

"""Quantities that carry their first two derivatives by phi along, by the rules of Leibniz.

A function of numpy's four operations, square roots and tangents takes such quantities as it takes arrays.

Source: A. Griewank, A. Walther, *Evaluating Derivatives* (2008), chapter 13.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from graphcam.given.laws import Floats

Constant = Floats | float


@dataclass(eq=False, repr=False)
class Jet(NDArrayOperatorsMixin):
    """A quantity with its first two derivatives, arrays of one shape.

    >>> x = Jet(np.array([2.0]), np.array([1.0]), np.array([0.0]))
    >>> square = x * x
    >>> square.value.item(), square.slope.item(), square.bend.item()
    (4.0, 4.0, 2.0)
    """

    value: Floats
    slope: Floats
    bend: Floats

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any) -> Any:
        rule = _UFUNC_RULES.get(ufunc)
        return NotImplemented if rule is None or method != "__call__" else rule(*inputs)


def _jet(f: Jet | Constant) -> Jet:
    return f if isinstance(f, Jet) else Jet(np.asarray(f), _ZERO, _ZERO)


_ZERO = np.zeros(())


def _negative(f: Jet) -> Jet:
    return Jet(-f.value, -f.slope, -f.bend)


def _add(f: Jet | Constant, g: Jet | Constant) -> Jet:
    f, g = _jet(f), _jet(g)
    return Jet(f.value + g.value, f.slope + g.slope, f.bend + g.bend)


def _subtract(f: Jet | Constant, g: Jet | Constant) -> Jet:
    return _add(f, -g)


def _multiply(f: Jet | Constant, g: Jet | Constant) -> Jet:
    f, g = _jet(f), _jet(g)
    bend = f.bend * g.value + 2 * (f.slope * g.slope) + f.value * g.bend
    return Jet(f.value * g.value, f.slope * g.value + f.value * g.slope, bend)


def _divide(f: Jet | Constant, g: Jet | Constant) -> Jet:
    f, g = _jet(f), _jet(g)
    value = f.value / g.value
    slope = (f.slope - value * g.slope) / g.value
    return Jet(value, slope, (f.bend - value * g.bend - 2 * slope * g.slope) / g.value)


def _sqrt(f: Jet) -> Jet:
    root = np.sqrt(f.value)
    slope = f.slope / (2 * root)
    return Jet(root, slope, (f.bend - 2 * slope * slope) / (2 * root))


def _tan(f: Jet) -> Jet:
    tangent = np.tan(f.value)
    rate = 1 + tangent * tangent
    return Jet(tangent, rate * f.slope, rate * (f.bend + 2 * tangent * f.slope * f.slope))


_UFUNC_RULES: dict[np.ufunc, Callable[..., Jet]] = {
    np.add: _add,
    np.subtract: _subtract,
    np.multiply: _multiply,
    np.divide: _divide,
    np.negative: _negative,
    np.sqrt: _sqrt,
    np.tan: _tan,
}
"""How each of numpy's operations treats such quantities."""

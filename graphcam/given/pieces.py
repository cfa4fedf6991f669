"""Functions made of pieces: a formula a piece, written as the piece looks from the nearer end of its phase.

Angles that grow, as a turn's do, are cut at the breaks into slices of one piece each, which cost a dozen passes of the
processor and no sorting.  Angles in any other order, and few of them, are gathered by their formula, which many pieces
share: both halves of a law, and the same law's rise and return.  Both ways do the same arithmetic to every value.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.floating[Any]]
Side = Literal["right", "left"]
Formula = Callable[[Floats], Sequence[Floats | float]]
"""f, f', f'', f''' of the distance x from an end of a phase, as a fraction of the phase."""

CHUNK = 16_384
"""Values that are computed at a time: their arrays stay in the processor's cache, and bound the memory."""
LONG = 512
"""From so many values a piece on it is quicker to slice than to gather."""


class Piece(NamedTuple):
    """A piece from ``start`` on: (base + c0 f(x), c1 f'(x), c2 f''(x), c3 f'''(x)) with x = (t - origin)/length.

    ``length`` is negative where the piece is seen from the end of its phase.
    """

    formula: Formula
    start: float
    origin: float
    length: float
    base: float
    factors: tuple[float, float, float, float]


def chunks(n: int) -> Iterator[slice]:
    """Slices of :data:`CHUNK` values that make up n.

    >>> [(here.start, here.stop) for here in chunks(20_000)]
    [(0, 16384), (16384, 32768)]
    """
    return (slice(k, k + CHUNK) for k in range(0, n, CHUNK))


@dataclass(frozen=True, eq=False)
class Piecewise:
    """A function of t and its first three derivatives, made of pieces in order; it begins at the first one's start.

    >>> def line(x):
    ...     return x, np.ones_like(x), 0 * x, 0 * x
    >>> rising = Piece(line, 0.0, 0.0, 1.0, 0.0, (1, 1, 1, 1))
    >>> falling = Piece(line, 1.0, 2.0, -1.0, 0.0, (1, -1, 1, -1))
    >>> values = np.empty((4, 3))
    >>> Piecewise([rising, falling]).fill(np.array([0.5, 1.0, 1.75]), "left", values)
    >>> values[:2].tolist()
    [[0.5, 1.0, 0.25], [1.0, 1.0, -1.0]]
    """

    pieces: Sequence[Piece]
    starts: Floats = field(init=False)
    """(p,) where each piece begins"""
    _formulas: tuple[Formula, ...] = field(init=False)
    """those that differ"""
    _formula_of: NDArray[np.intp] = field(init=False)
    """(p,) the number of each piece's formula"""
    _places: Floats = field(init=False)
    """(2, p) origins and lengths"""
    _units: Floats = field(init=False)
    """(5, p) bases and factors"""

    def __post_init__(self) -> None:
        formulas, starts, origins, lengths, bases, factors = zip(*self.pieces, strict=True)
        distinct = tuple(dict.fromkeys(formulas))
        number = {formula: k for k, formula in enumerate(distinct)}
        object.__setattr__(self, "starts", np.array(starts))
        object.__setattr__(self, "_formulas", distinct)
        object.__setattr__(self, "_formula_of", np.array([number[formula] for formula in formulas]))
        object.__setattr__(self, "_places", np.array([origins, lengths]))
        object.__setattr__(self, "_units", np.array([bases, *zip(*factors, strict=True)], dtype=np.float64))

    def fill(self, t: Floats, side: Side, out: Floats) -> None:
        """Write the function and its derivatives at t, (n,), into the rows of ``out``, (4, n); NaN stays NaN.

        At a break the value of the named side is written.
        """
        # Whether t lies before or after a break is decided among the t: x, a quotient, is rounded.
        if t.size >= LONG and np.all(t[1:] >= t[:-1]):
            cuts = np.searchsorted(t, self.starts, side="left" if side == "right" else "right").tolist()
            slices = [slice(*ends) for ends in pairwise([0, *cuts[1:], t.size])]
            met = [k for k, here in enumerate(slices) if here.start < here.stop]
            if t.size >= LONG * len(met):
                for k in met:
                    formula, _, origin, length, base, factors = self.pieces[k]
                    _store(out, slices[k], formula((t[slices[k]] - origin) / length), (base, *factors))
                out += 0.0  # so that zero is +0
                return
        number = self.starts[1:].searchsorted(t, side=side)
        origins, lengths = self._places
        self.gather(number, (t - origins[number]) / lengths[number], out)

    def gather(self, number: NDArray[np.intp], x: Floats, out: Floats) -> None:
        """Write the values at the distances x in the pieces of those numbers, (n,) each, into ``out``, (4, n)."""
        formula_of = self._formula_of[number]
        for k, count in enumerate(np.bincount(formula_of).tolist()):
            if count:
                here = slice(None) if count == number.size else (formula_of == k).nonzero()[0]
                units = self._units.take(number[here], axis=1)
                _store(out, here, self._formulas[k](x[here]), list(units))
        out += 0.0 * x  # so that zero is +0, and NaN stays NaN even where a constant takes its place


def _store(
    out: Floats, here: slice | NDArray[np.intp], values: Sequence[Floats | float], units: Sequence[Floats | float]
) -> None:
    """Write the values, in those units, to some columns: s = base + factor f, and the derivatives."""
    base, *factors = units
    for row, value, factor in zip(out, values, factors, strict=True):
        row[here] = factor * value
    out[0, here] += base


def sine_cosine(x: Floats) -> tuple[Floats, Floats]:
    """sin(x) and cos(x) of angles x [rad], each to 2 eps of 1; a sine near 0 to 2 eps of itself.

    With t = tan(x/2): sin(x) = 2 t/(1 + t^2), cos(x) = (1 - t)(1 + t)/(1 + t^2).  One tangent costs a third of what
    numpy takes for a sine and a cosine, and at t = 1, where the cosine is zero, 1 - t keeps the digits.

    >>> s, c = sine_cosine(np.radians([0.0, 30.0, 90.0, 180.0]))
    >>> s.round(15).tolist(), c.round(15).tolist()
    ([0.0, 0.5, 1.0, 0.0], [1.0, 0.866025403784439, 0.0, -1.0])
    """
    t = np.tan(0.5 * x)
    q = 1 / (1 + t * t)
    return 2 * t * q, (1 - t) * (1 + t) * q

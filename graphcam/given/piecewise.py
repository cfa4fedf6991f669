"""Functions made of pieces: a formula a piece, written as the piece looks from the nearer end of its phase.

Angles that grow, as a turn's do, are cut at the breaks into slices of one piece each, which cost a dozen passes of the
processor and no sorting.  Few angles are gathered by their formula, which many pieces share: both halves of a law, and
the same law's rise and return.  Of many in any other order comparing them with every start tells the pieces.  Where all
that moves has one formula they are computed as they stand, with the sizes of each one's piece beside it; else a radix
sort of the pieces' numbers brings them into order, and back.  Every way does the same arithmetic to every value.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.floating[Any]]
Side = Literal["right", "left"]
Formula = Callable[[Floats], Sequence[Floats | float]]
"""f, f', f'', f''' of the distance x from an end of a phase, as a fraction of the phase."""
CHUNK_SIZE = 16_384
"""Values that are computed at a time: their arrays stay in the processor's cache, and bound the memory."""
SLICING_SIZE = 512
"""The number of values on a piece from which it is quicker to slice than to gather."""


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
    """Slices of :data:`CHUNK_SIZE` values that make up n.

    >>> [(here.start, here.stop) for here in chunks(20_000)]
    [(0, 16384), (16384, 32768)]
    """
    return (slice(k, k + CHUNK_SIZE) for k in range(0, n, CHUNK_SIZE))


def in_phase(u: Floats) -> Floats:
    """The fractions of a phase, with NaN in place of those outside [0, 1].

    >>> in_phase(np.array([-0.1, 0.5, 1.0])).tolist()
    [nan, 0.5, 1.0]
    """
    if u.size and u.min() >= 0 and u.max() <= 1:
        return u  # the usual case, and to choose one by one is dear
    return np.where((u >= 0) & (u <= 1), u, np.nan)


def dwell_formula(x: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """The formula of a dwell, which stays at its base; it is known by its name and not computed."""
    still = np.zeros_like(x)
    return still, still, still, still


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
    """The formulas that differ from one another."""
    _formula_of: NDArray[np.intp] = field(init=False)
    """(p,) the number of each piece's formula"""
    _moves: NDArray[np.bool_] = field(init=False)
    """(p,) whether a piece is not at rest"""
    _alike: Formula | None = field(init=False)
    """that of all pieces that move, if they have one"""
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
        moving = [formula for formula in distinct if formula is not dwell_formula]
        object.__setattr__(self, "_moves", np.array([formula is not dwell_formula for formula in formulas]))
        object.__setattr__(self, "_alike", moving[0] if len(moving) == 1 else None)
        object.__setattr__(self, "_places", np.array([origins, lengths]))
        object.__setattr__(self, "_units", np.array([bases, *zip(*factors, strict=True)], dtype=np.float64))

    def fill(self, t: Floats, side: Side, out: Floats) -> None:
        """Write the function and its derivatives at t, (n,), into the rows of ``out``, (4, n); NaN stays NaN.

        At a break the value of the named side is written.
        """
        # Whether t lies before or after a break is decided among the t: x, a quotient, is rounded.
        if t.size >= SLICING_SIZE and np.all(t[1:] >= t[:-1]):
            met = self._pieces_met(
                np.searchsorted(t, self.starts[1:], side="left" if side == "right" else "right"), t.size
            )
            if t.size >= SLICING_SIZE * len(met):
                _slice(met, t, out)
                return
        if t.size < SLICING_SIZE * len(self.pieces):
            number = self.starts[1:].searchsorted(t, side=side)
            origins, lengths = self._places
            self.gather(number, (t - origins[number]) / lengths[number], out)
        else:
            number, compare = np.zeros(t.shape, dtype=np.uint8), np.greater_equal if side == "right" else np.greater
            for start in self.starts[1:].tolist():
                number += compare(t, start).view(np.uint8)
            if self._alike:
                self._look_up(self._alike, number.astype(np.intp), t, out)
            else:
                self._bring_in_order(number, t, out)
            if np.isnan(np.min(t)):
                out[:, np.isnan(t)] = np.nan  # even where a constant took its place

    def gather(self, number: NDArray[np.intp], x: Floats, out: Floats) -> None:
        """Write the values at the distances x in the pieces of those numbers, (n,) each, into ``out``, (4, n)."""
        formula_of = self._formula_of[number]
        for k, count in enumerate(np.bincount(formula_of).tolist()):
            if count:
                here = slice(None) if count == number.size else (formula_of == k).nonzero()[0]
                base, *factors = self._units.take(number[here], axis=1)
                for row, value, factor in zip(out, self._formulas[k](x[here]), factors, strict=True):
                    row[here] = factor * value
                out[0, here] += base
        out += 0.0 * x  # so that zero is +0, and NaN stays NaN even where a constant takes its place

    def _look_up(self, formula: Formula, number: NDArray[np.intp], t: Floats, out: Floats) -> None:
        if self._moves.all():
            self._write_alike(formula, number, t, out)
            return
        self._units[0].take(number, out=out[0], mode="clip")
        out[1:] = 0.0
        moving = np.flatnonzero(self._moves.take(number))
        part = np.empty((4, moving.size))
        self._write_alike(formula, number.take(moving), t.take(moving), part)
        for row, values in zip(out, part, strict=True):
            row[moving] = values

    def _write_alike(self, formula: Formula, number: NDArray[np.intp], t: Floats, out: Floats) -> None:
        """Write the values of one formula, each in the units of its own piece."""
        origins, lengths = self._places
        # Pieces of one length may be seen from either end; what all have in common need not be looked up.
        x = np.abs(t - origins.take(number))
        x /= _looked_up(np.abs(lengths), number)
        _write(out, formula(x), (_looked_up(unit, number) for unit in self._units))

    def _bring_in_order(self, number: NDArray[np.uint8], t: Floats, out: Floats) -> None:
        """Write the values at t, a piece at a time."""
        order = np.argsort(number, kind="stable")
        place, ordered = np.empty_like(order), np.empty_like(out)
        place[order] = np.arange(t.size)
        cuts = np.searchsorted(number.take(order), np.arange(1, len(self.pieces)))
        _slice(self._pieces_met(cuts, t.size), t.take(order), ordered)
        for row, values in zip(out, ordered, strict=True):
            values.take(place, out=row, mode="clip")

    def _pieces_met(self, cuts: NDArray[np.intp], n: int) -> list[tuple[Piece, slice]]:
        """The pieces that n values in order lie in, and which of them lie in each."""
        ends = pairwise([0, *cuts.tolist(), n])
        return [(piece, slice(*here)) for piece, here in zip(self.pieces, ends, strict=True) if here[0] < here[1]]


def _looked_up(sizes: Floats, number: NDArray[np.intp]) -> Floats | float:
    """The sizes of the pieces of those numbers; of sizes that are all alike the one."""
    first = sizes.item(0)
    return first if (sizes == first).all() else sizes.take(number)


def _slice(met: list[tuple[Piece, slice]], t: Floats, out: Floats) -> None:
    """Write the values at t, which lie in the order of the pieces."""
    for (formula, _, origin, length, base, factors), here in met:
        if formula is dwell_formula:
            out[:, here] = [[base], [0.0], [0.0], [0.0]]
        else:
            x = t[here] - origin
            x /= length
            _write(out[:, here], formula(x), (base, *factors))


def _write(out: Floats, values: Sequence[Floats | float], units: Iterable[Floats | float]) -> None:
    """Write the values in those units: s = base + factor f, and the derivatives."""
    base, *factors = units
    for row, value, factor in zip(out, values, factors, strict=True):
        np.multiply(factor, value, out=row)
    out[0] += base
    out[1:] += 0.0  # so that zero is +0


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
    cosine = 1 - t
    cosine *= 1 + t
    cosine *= q
    t *= 2
    t *= q
    return t, cosine

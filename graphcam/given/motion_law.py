"""A motion law: the lift f from 0 to 1 while u runs from 0 to 1, with all that is the law's own.

A law is made of pieces.  Those of its first part are functions of u; those after its ``middle`` are written as they
look from the end, as functions of w = 1 - u for the lift still missing, 1 - f.  So what is small near an end (the lift
just begun, the lift still missing, the velocity) keeps all its digits there, which 1 - f(u) would lose.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Sequence
from dataclasses import InitVar, dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError
from graphcam.given.extreme_search import SmoothPieces
from graphcam.given.piecewise import Floats, Formula, Piece, Piecewise, Side, chunks, in_phase
from graphcam.words import Words, bare_caption, say

Tangent = Callable[[float], tuple[float, float]]
"""Where f' - f/k is largest, and how great, as a function of k: a closed form."""
_OfNumber = Callable[[float], Sequence[Any]]
JUMP_SHARE = 1e-6
"""A jump of the acceleration, or of its slope, is reported that exceeds this part of the maximum acceleration."""
JUMP_BLEND = 2.0**-24
"""A velocity that jumps is computed with a blend over this part of the phase: so the cam has its corner, as an arc, and
no value but the acceleration differs from that of the jump by more than about this part."""
ACCURACY = 1e-9
"""What a law gives of itself is true to this; intervals around a maximum value are narrowed to it."""
DERIVATIVE_ACCURACY = 1e-7
"""The derivatives are one another's, over a part of a piece, to this fraction of the maximum."""
CHECKED_PARTS = 17
"""Parts of a piece that are checked: a prime, so that no usual fraction, where a formula may bend, ends one."""
GAUSS_NODES, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(12)
DERIVATIVE_NAMES = "f", "f'", "f''", "f'''"


@dataclass(frozen=True)
class Law:
    """A normalised motion law; call it with u in [0, 1] for (f, f', f'', f''').

    Parameters
    ----------
    name : what it is called on the sheet
    formulas : a function that returns f, f', f'', f''' at an array of u; or several, one for every piece
    edges : the inner places u where one formula takes over from another, in order
    mirrored : whether the second half mirrors the first, 1 - f(1 - u); formulas and edges are then those of the first
    middle : from here on formulas are functions of w = 1 - u that return 1 - f and its derivatives by w
    ratio : |a1|/|a2|, first part's acceleration over the second's, if the law has two such parts
    peaks : max f' and max |f''|; None has them found
    tangents : closed forms of the place u where f' - f/k is largest, and of that value, for any k > 0; the second one
        is that of the law seen from its end.  None has the place found
    trusted : it is known to be a law, so the check is omitted, which takes some milliseconds
    seams : those edges at which no derivative jumps: the formulas of either side only look from different ends
    blows : the fractions of the phase at its start and its end in which the velocity jumps, or as good as jumps; they
        are too short to be drawn.  0 is none

    Raises
    ------
    DesignError : the law does not lead from rest to rest, falls, has a velocity that jumps, or something that it gives
        of itself is wrong: a derivative, a peak, a tangent

    >>> import graphcam as gc
    >>> def formula(u):
    ...     return u**2 * (3 - 2 * u), 6 * u * (1 - u), 6 - 12 * u, 0 * u - 12
    >>> law = gc.Law("my own", formula)
    >>> [float(x) for x in law(0.5)], law.peak_velocity
    ([0.5, 1.5, 0.0, -12.0], 1.5)
    >>> gc.Law("constant acceleration", lambda u: (2 * u**2, 4 * u, 4, 0), mirrored=True).jumps
    (0.5,)
    """

    name: str
    formulas: Formula | Sequence[Formula] = field(repr=False)
    edges: Sequence[float] = field(default=(), repr=False)
    mirrored: InitVar[bool] = False
    middle: float = field(default=1.0, repr=False)
    ratio: float = 1.0
    peaks: tuple[float, float] | None = field(default=None, repr=False)
    tangents: tuple[Tangent | None, Tangent | None] = field(default=(None, None), repr=False)
    trusted: InitVar[bool] = False
    seams: tuple[float, ...] = field(default=(), repr=False)
    blows: tuple[float, float] = field(default=(0.0, 0.0), repr=False)
    pieces: tuple[Piece, ...] = field(init=False, repr=False)
    """the pieces between 0, the edges and 1"""

    def __post_init__(self, mirrored: bool, trusted: bool) -> None:
        formulas = (self.formulas,) if callable(self.formulas) else tuple(self.formulas)
        starts, middle = (0.0, *map(float, self.edges)), self.middle
        if mirrored:
            formulas, middle = (*formulas, *formulas[::-1]), 0.5
            starts = (*starts, middle, *(1.0 - u for u in starts[:0:-1]))
        if not all(a < b for a, b in pairwise((*starts, 1.0))):
            raise self._error("edges", list(starts[1:]), say("between 0 and 1, in order"))
        if len(formulas) != len(starts):
            limit = say("{starts}, one for each piece between 0, the edges and 1", starts=len(starts))
            remedy = say("at an edge another formula takes over")
            raise self._error(say("number of formulas"), len(formulas), limit, remedy)
        # Seen from the end the lift is the missing lift and the acceleration its negative.
        pieces = (
            Piece(formula, u, 0.0, 1.0, 0.0, (1, 1, 1, 1))
            if u < middle
            else Piece(formula, u, 1.0, -1.0, 1.0, (-1, 1, -1, 1))
            for formula, u in zip(formulas, starts, strict=True)
        )
        made = {"formulas": formulas, "edges": starts[1:], "middle": middle, "pieces": tuple(pieces)}
        for name, value in made.items():
            object.__setattr__(self, name, value)
        if not trusted:
            self._check()

    def __call__(self, u: ArrayLike, derivatives: int = 3, side: Side = "right") -> tuple[Floats, ...]:
        """The lift f and its first ``derivatives`` derivatives at u, each shaped like u; NaN outside [0, 1].

        At a break the value of the named side is returned; u = 0 and u = 1 have only one.
        """
        u = np.asarray(u, dtype=np.float64)
        flat = u.ravel()
        out = np.empty((4, flat.size))
        for here in chunks(flat.size):
            self._piecewise.fill(in_phase(flat[here]), side, out[:, here])
        return tuple(out.reshape(4, *u.shape)[: derivatives + 1])

    def at(self, u: float, side: Side = "right") -> list[float]:
        """f, f', f'' and the third derivative at one place in [0, 1], faster than from an array of one.

        >>> import graphcam as gc
        >>> gc.law("3-4-5").at(0.5)
        [0.5, 1.875, 0.0, -30.0]
        """
        k = (bisect_right if side == "right" else bisect_left)(self.edges, u)
        _, _, origin, length, base, (c0, c1, c2, c3) = self.pieces[k]
        f, f1, f2, f3 = self._of_number[k]((u - origin) / length)
        # Added to 0, so that zero is +0.
        return [base + c0 * float(f), 0.0 + c1 * float(f1), 0.0 + c2 * float(f2), 0.0 + c3 * float(f3)]

    @cached_property
    def _of_number(self) -> list[_OfNumber]:
        ends = pairwise((*(piece.start for piece in self.pieces), 1.0))
        return [
            _of_number(piece.formula, abs((low + high) / 2 - piece.origin))
            for piece, (low, high) in zip(self.pieces, ends, strict=True)
        ]

    @cached_property
    def _piecewise(self) -> Piecewise:
        return Piecewise(self.pieces)

    @cached_property
    def peak_velocity(self) -> float:
        """C_v = max f', so v_max = C_v h/F."""
        return self.peaks[0] if self.peaks else self._max_derivative(1)

    @cached_property
    def peak_acceleration(self) -> float:
        """C_a = max |f''|, so a_max = C_a h/F^2; infinite where the velocity jumps."""
        if any(self.velocity_jumps):
            return math.inf
        return self.peaks[1] if self.peaks else self._max_derivative(2)

    @property
    def steady(self) -> tuple[float, float]:
        """The fractions between which the acceleration can be drawn: 0 and 1 but for blows."""
        return self.blows[0], 1 - self.blows[1]

    @property
    def velocity_jumps(self) -> tuple[bool, bool]:
        """Whether the velocity jumps at the start, and at the end: the acceleration is infinite there."""
        start, end = (0 < blow <= JUMP_BLEND for blow in self.blows)
        return start, end

    @cached_property
    def steady_acceleration(self) -> float:
        """The maximum |f''| between the blows; that of the whole law where there are none.

        >>> import graphcam as gc
        >>> gc.constant_velocity_law(0, 0).steady_acceleration, gc.law("3-4-5").steady_acceleration
        (0.0, 5.773502691896258)
        """
        return self._max_derivative(2, self.steady) if any(self.blows) else self.peak_acceleration

    @cached_property
    def peak_jerk(self) -> float:
        """C_j = max |f'''| between the jumps of the acceleration, so j_max = C_j h/F^3."""
        return self._max_derivative(3)

    @cached_property
    def breaks(self) -> tuple[float, ...]:
        """The inner places u where a derivative may jump, in order."""
        # Where a formula meets its own mirror image, only the acceleration can jump.
        met = zip(self.edges, pairwise(self.pieces), strict=True)
        mirrors = [u for u, (a, b) in met if a.formula is b.formula and a.length != b.length]
        return tuple(u for u in self.edges if u not in self.seams and (u not in mirrors or u in self.jumps))

    @cached_property
    def jumps(self) -> tuple[float, ...]:
        """The inner places u where the acceleration itself jumps."""
        return self._jumping(2)

    @cached_property
    def corners(self) -> tuple[float, ...]:
        """The inner places u where the acceleration turns a corner: it is continuous, its slope jumps."""
        return tuple(u for u in self._jumping(3) if u not in self.jumps)

    def _jumping(self, order: int) -> tuple[float, ...]:
        edges = np.array(self.edges)
        before, after = (self(edges, side=side)[order] for side in ("left", "right"))
        return tuple(edges[np.abs(after - before) > JUMP_SHARE * self.steady_acceleration].tolist())

    @cached_property
    def reversed(self) -> Law:
        """The law that runs backwards: 1 - f(1 - u).

        >>> import graphcam as gc
        >>> gc.law("rectangular", ratio=4.0).reversed.ratio
        0.25
        """
        formulas, edges = [piece.formula for piece in self.pieces], tuple(1 - u for u in reversed(self.edges))
        if (formulas[::-1], edges, self.middle) == (formulas, self.edges, 0.5):
            return self
        ahead, back = self.tangents
        turned, ratio = (formulas[::-1], edges, False, 1 - self.middle), 1 / self.ratio
        seams = tuple(1 - u for u in self.seams)
        first, last = self.blows
        blows, tangents = (last, first), (back, ahead)
        return Law(self.name, *turned, ratio, self.peaks, tangents, trusted=True, seams=seams, blows=blows)

    # --- what a law must keep to --------------------------------------------------------------------------------------

    def _max_derivative(self, order: int, between: tuple[float, float] = (0.0, 1.0)) -> float:
        """The maximum magnitude of a derivative, of both sides of a jump, to full precision."""
        low, high = between
        ends = np.array([low, *(u for u in self.edges if low < u < high), high])
        at_ends = np.abs([*self(ends[:-1])[order], *self(ends[1:], side="left")[order]])
        pieces = SmoothPieces(ends[:-1], ends[1:])
        _, u = pieces.stationary(lambda _, u: self(u)[order], None, at_ends.max(keepdims=True), np.abs)
        return float(np.abs(self(u)[order]).max(initial=at_ends.max()))

    def _parts(self) -> tuple[Floats, Floats]:
        ends = np.array([0.0, *self.edges, 1.0])
        places = np.linspace(ends[:-1], ends[1:], CHECKED_PARTS + 1)
        return places[:-1].T.ravel(), places[1:].T.ravel()

    def _error(self, what: Words, value: object, limit: Words, remedy: Words = "") -> DesignError:
        shown = bare_caption(value) if isinstance(value, str) else value
        return DesignError(say("{what} of the law '{name}'", what=what, name=self.name), shown, limit, remedy)

    def _check(self) -> None:
        """Refuse what is no law.

        first, inside, last : f, f', f'', f''' where each part of a piece begins, at Gauss's places in it, at its end
        """
        self._check_formulas()
        low, high = self._parts()
        u = low + (high - low) * (GAUSS_NODES[:, None] + 1) / 2
        first, inside, last = (np.array(x) for x in (self(low), self(u), self(high, side="left")))
        for order, name in enumerate(DERIVATIVE_NAMES):
            if not np.isfinite(inside[order]).all():
                raise self._error(name, say("not finite"), say("a finite number everywhere"))
        for name, value, limit in (
            *(("f(0)", first[0, 0], 0), ("f(1)", last[0, -1], 1)),
            *(("f'(0)", first[1, 0], 0), ("f'(1)", last[1, -1], 0)),
        ):
            if not abs(value - limit) <= ACCURACY:
                raise self._error(name, value, f"{limit}", say("a law leads from rest to rest"))
        for order in (0, 1):
            k = int(np.argmax(np.abs(jump := first[order, 1:] - last[order, :-1])))
            if abs(jump[k]) > ACCURACY:
                what = say("jump of {derivatives} at u = {high:g}", derivatives=DERIVATIVE_NAMES[order], high=high[k])
                raise self._error(what, jump[k], "0", say("lift and velocity are continuous"))
        self._check_derivatives(low, high, last - first, inside)
        if inside[1].min() < -ACCURACY:
            at = u.ravel()[inside[1].argmin()]
            remedy = say("what falls on its way is a motion of several phases")
            raise self._error(say("f' at u = {at:.3g}", at=at), inside[1].min(), say("0 or more"), remedy)
        self._check_closed_forms(inside)

    def _check_formulas(self) -> None:
        limit = say("one that takes an array of u and returns f, f', f'', f''' there")
        remedy = say("use numpy's functions")
        for piece in self.pieces:
            try:
                values = piece.formula(np.full(2, abs(piece.start - piece.origin)))
                count = len(values)
                np.broadcast_arrays(np.empty(2), *values)
            except (TypeError, ValueError) as error:
                raise self._error(
                    "formula", say("one with the error: {error}", error=str(error)), limit, remedy
                ) from error
            if count != len(DERIVATIVE_NAMES):
                raise self._error("formula", say("one that returns {count} values", count=count), limit)
        if self.peaks is not None and len(self.peaks) != 2:
            limit = say("two numbers, max f' and max |f''|")
            raise self._error("peaks", self.peaks, limit, say("leave them out to be found"))
        if not self.ratio > 0:
            raise self._error("ratio", self.ratio, say("greater than 0"))

    def _check_derivatives(self, low: Floats, high: Floats, change: Floats, inside: Floats) -> None:
        """Check that over every part of a piece each derivative integrates to what the one before changes by."""
        integrals = (high - low) / 2 * np.einsum("n,dnp->dp", GAUSS_WEIGHTS, inside)
        for order in range(3):
            off = np.abs(integrals[order + 1] - change[order])
            if off.max() > DERIVATIVE_ACCURACY * np.abs(inside[order]).max():
                k, name = int(off.argmax()), DERIVATIVE_NAMES[order]
                what = say("integral of {derivatives} from u = {low:.3g} to {high:.3g}")
                what = what.with_values(derivatives=DERIVATIVE_NAMES[order + 1], low=low[k], high=high[k])
                remedy = say("correct the derivative; if one jumps there, give an edge and a formula for either side")
                limit = say("{change:.6g}, the change of {name}", change=change[order, k], name=name)
                raise self._error(what, integrals[order + 1, k], limit, remedy)

    def _check_closed_forms(self, inside: Floats) -> None:
        for name, peak, order in zip(("max f'", "max |f''|"), self.peaks or (), (1, 2), strict=False):
            if abs(peak - (found := self._max_derivative(order))) > ACCURACY * found:
                raise self._error(say("given {name}", name=name), peak, f"{found:.10g}")
        for tangent, lift, at_end in zip(self.tangents, (inside[0], 1 - inside[0]), (False, True), strict=True):
            if tangent is None:
                continue
            for k in (0.05, 0.5, 5.0):
                u, height = tangent(k)
                f, f1 = self(1 - u if at_end else u, 1)
                there = f1 - (1 - f if at_end else f) / k
                best = (inside[1] - lift / k).max()
                if not (abs(height - there) <= ACCURACY * (1 + 1 / k) and height >= best - ACCURACY * (1 + 1 / k)):
                    limit = say("at least {best:.6g}, and f' - f/k at the place", best=best)
                    raise self._error(say("tangent for k = {k}", k=k), height, limit)


def _of_number(formula: Formula, x: float) -> _OfNumber:
    """A formula of numbers: most take them as they are, the others are given arrays of one.

    x : a place at which both are tried
    """

    def of_array(x: float) -> Sequence[Any]:
        return [np.ravel(value)[0] for value in formula(np.array([x]))]

    untyped: Any = formula
    try:
        takes_numbers = np.allclose([float(value) for value in untyped(x)], of_array(x), rtol=ACCURACY, atol=ACCURACY)
    except (AttributeError, IndexError, TypeError, ValueError):
        takes_numbers = False
    return untyped if takes_numbers else of_array

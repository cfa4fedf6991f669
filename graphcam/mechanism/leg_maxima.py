"""Where a quantity is highest on the rises and on the returns of a motion: sought where it can be, and nowhere missed.

Over every cell of a motion the quantity is enclosed (:mod:`graphcam.mechanism.taylor_intervals`), with what the laws
say of their fourth derivative.  A cell cannot hold the highest place inside

- if the quantity stays below what it is known to reach elsewhere, or
- if its slope keeps its sign all over the cell;

it holds one stationary place at most if the quantity is bent one way all over it.  What is none of these is divided.
So no second extreme hides beside the one that is found, be they as near to one another as they like: branch and bound
(R. E. Moore, R. B. Kearfott, M. J. Cloud, *Introduction to Interval Analysis*, 2009, chapter 11).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from graphcam.given.laws import Floats
from graphcam.given.motion import Motion, MovingPhase
from graphcam.given.motion_law import Law
from graphcam.given.root_finding import roots
from graphcam.mechanism.kinematics import Values
from graphcam.mechanism.taylor_intervals import Taylor
from graphcam.mechanism.turn_extremes import VALUE_ROUNDING, Places, at_places, smooth_pieces

PHASE_CELLS, MIN_PIECE_CELLS = 32, 4
"""Cells of a whole phase at first, and of a piece of it, however short."""
UNPROVED_LAW_FACTOR = 4
"""How many times as many cells a law takes that says nothing of its fourth derivative."""
END_RATIO, MIN_END_DISTANCE = 1 / 32, 1e-12
"""Near the phase's ends, where a small prime radius moves the extremes to, they follow at this ratio, so near."""
CELL_DIVISIONS = np.arange(5) / 4
"""The ends of the parts into which a cell is divided, as fractions."""
FLATNESS = 1e-12
"""A cell over which a quantity differs by no more than this part of its greatest value is told by its middle."""
STATIONARY_MARGIN = 1e-6
"""How far rounding may put a stationary place aside, in half cells."""
MAX_CELLS = 100_000
"""Cells at a time: a quantity that stays the same over whole phases is not followed further."""


class Cells(NamedTuple):
    """Parts of phases: (n,) index of the phase, and the fractions of it where each begins and ends."""

    phase: NDArray[np.intp]
    low: Floats
    high: Floats

    def selected(self, chosen: NDArray[np.bool_]) -> "Cells":
        """The cells that a mask chooses."""
        return Cells(self.phase[chosen], self.low[chosen], self.high[chosen])

    def divided(self) -> "Cells":
        """The cells divided into equal parts."""
        ends = self.low[:, None] + (self.high - self.low)[:, None] * CELL_DIVISIONS
        ends[:, -1] = self.high
        return Cells(np.repeat(self.phase, CELL_DIVISIONS.size - 1), ends[:, :-1].ravel(), ends[:, 1:].ravel())


@dataclass(frozen=True, eq=False)
class MaximumSearch:
    """The search for the highest places of quantities of one motion."""

    motion: Motion

    @cached_property
    def _ends(self) -> tuple[tuple[NDArray[np.intp], Floats, Values], ...]:
        """The beginnings of the smooth pieces and their ends, with the values from inside."""
        phase, u0, u1 = smooth_pieces(self.motion)
        return (phase, u0, self.motion.at(phase, u0, "right")), (phase, u1, self.motion.at(phase, u1, "left"))

    @cached_property
    def _groups(self) -> NDArray[np.intp]:
        """(k,) what each phase counts among: 0 for dwells, 1 for rises, 2 for returns."""
        return self.motion.directions.astype(np.intp) % 3

    @cached_property
    def _initial_cells(self) -> tuple[Cells, Values]:
        phases = [(k, phase.normalised) for k, phase in enumerate(self.motion.phases) if isinstance(phase, MovingPhase)]
        low, high = zip(*(_cells_of(law) for _, law in phases), strict=True)
        number = np.repeat([k for k, _ in phases], [part.size for part in low])
        cells = Cells(number, np.concatenate(low), np.concatenate(high))
        return cells, self._values_over(cells)

    def _values_over(self, cells: Cells) -> Values:
        """(s, v, a, 0) over cells, by phi."""
        u, half_u = (cells.low + cells.high) / 2, (cells.high - cells.low) / 2
        s, v, a, j = self.motion.at(cells.phase, u)
        fourth, off = self.motion.fourth(cells.phase, u, half_u)
        half = half_u * self.motion.angles[cells.phase]
        j_off = (np.abs(fourth) + off) * half
        a_off = (np.abs(j) + j_off / 2) * half
        over = Taylor(half, s, v, a, a_off), Taylor(half, v, a, j, j_off), Taylor(half, a, j, fourth, off)
        return cast(Values, (*over, 0.0))

    def highest(
        self, quantity: Callable[[Values], Floats], slope: Callable[[Values], Floats], *, signed: bool = False
    ) -> Places:
        """Both ends of every smooth piece, and where inside the quantity is highest on the rises, and on the returns.

        Places that are as high, or nearly so, are among them; others may be.

        quantity : of (s, v, a, j) but for j, made of numpy's four operations, square roots and tangents
        slope : its derivative by phi, or anything of its sign
        signed : whether a negative value counts as much as a positive one

        >>> from math import pi
        >>> import graphcam as gc
        >>> motion = gc.Motion([gc.Rise(30, pi, "cosine"), gc.Return(30, pi, "cosine")])
        >>> places = MaximumSearch(motion).highest(lambda values: values[1], lambda values: values[2], signed=True)
        >>> places.u.round(12).tolist()
        [0.0, 0.0, 1.0, 1.0, 0.5, 0.5, 0.5, 0.5]
        """
        height = np.abs if signed else np.positive
        at_ends = np.full(3, -np.inf)
        for phase, _, values in self._ends:
            np.fmax.at(at_ends, self._groups[phase], height(quantity(values)))
        cells, middle = self._contenders(quantity, height, at_ends.copy())
        # Of cells that are flat, those count in which it is higher than at the ends.
        known = at_ends[self._groups[cells.phase]]
        phase, low, high = cells.selected(middle > known + VALUE_ROUNDING * np.abs(known))
        u = roots(lambda u: slope(self.motion.at(phase, u)), low, high)
        return at_places(self.motion, *self._ends, (phase, u, self.motion.at(phase, u)))

    def _contenders(
        self, quantity: Callable[[Values], Floats], height: Callable[[Floats], Floats], top: Floats
    ) -> tuple[Cells, Floats]:
        """The places where each group may be highest, and the height in the middle where it is flat, else infinity.

        top : for each group a height that is reached; it is raised to the greatest that is met
        """
        (cells, values), found = self._initial_cells, list[tuple[Cells, Floats, Floats]]()
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            while True:
                over, group = cast(Taylor, quantity(values)), self._groups[cells.phase]
                middle = height(over.value)
                np.fmax.at(top, group, middle)
                size = np.abs(top[group])
                may = ~(middle + over.half_range < top[group] - VALUE_ROUNDING * size) & ~(
                    np.abs(over.slope) > over.slope_off
                )
                alone = np.abs(over.bend) > over.spread
                narrow = cells.high - cells.low <= VALUE_ROUNDING * cells.high
                settled = may & (alone | narrow | (over.half_range <= FLATNESS * size) | (cells.phase.size > MAX_CELLS))
                ceiling, middle = middle + over.half_range, np.where(alone, np.inf, middle)
                found.append((_narrowed(cells, over, alone).selected(settled), ceiling[settled], middle[settled]))
                cells = cells.selected(may & ~settled)
                if not cells.phase.size:
                    break
                cells = cells.divided()
                values = self._values_over(cells)
        parts, ceilings, middles = zip(*found, strict=True)
        phase, low, high = (np.concatenate(part) for part in zip(*parts, strict=True))
        ceiling, middle = np.concatenate(ceilings), np.concatenate(middles)
        reached = top[self._groups[phase]]
        may = ~(ceiling < reached - VALUE_ROUNDING * np.abs(reached))
        return Cells(phase, low, high).selected(may), middle[may]


def _narrowed(cells: Cells, over: Taylor, alone: NDArray[np.bool_]) -> Cells:
    """The one stationary place that each cell can have: Newton's step with every bend that the quantity may have.

    A cell without a single one is left as it is.
    """
    steps = -over.slope / np.array([over.bend - over.spread, over.bend + over.spread])
    shares = np.sort(steps, axis=0) / over.half + np.array([[-STATIONARY_MARGIN], [STATIONARY_MARGIN]])
    ends = (cells.low + cells.high) / 2 + (cells.high - cells.low) / 2 * shares
    low, high = np.where(alone & (np.abs(shares) < 1), ends, [cells.low, cells.high])
    return Cells(cells.phase, low, high)


@lru_cache(maxsize=64)
def _cells_of(law: Law) -> tuple[Floats, Floats]:
    """The ends of the cells of a phase by this law: none reaches from one formula of it to another.

    At a break the last one ends before it, because the break belongs to the formula that begins there.
    """
    ends = np.array([0.0, *law.edges, 1.0])
    parts = PHASE_CELLS if law.fourths else UNPROVED_LAW_FACTOR * PHASE_CELLS
    inner = [np.linspace(a, b, max(MIN_PIECE_CELLS, round(parts * (b - a))), endpoint=False) for a, b in pairwise(ends)]
    near = MIN_END_DISTANCE / END_RATIO ** np.arange(1 + np.log(MIN_END_DISTANCE * parts) / np.log(END_RATIO))
    places = np.unique(np.concatenate([*inner, near[near < ends[1]], 1 - near[near < 1 - ends[-2]], [1.0]]))
    return places[:-1], np.where(np.isin(places[1:], law.edges), np.nextafter(places[1:], 0), places[1:])

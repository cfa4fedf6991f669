"""The rises, or the returns, of many cams, which follow one law: a table of the law serves them all.

A return is a rise seen backwards: with w the distance from the low end, as a fraction of the phase, both have
s = h f(w), of a return with f of the law reversed, and its odd derivatives change their sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.given.motion_law import Law
from graphcam.given.pieces import Floats
from graphcam.mechanism.kinematics import Values

INSIDE = 40
"""Places on a whole phase between which a quantity is taken to have one extreme at most."""
FEWEST = 10
"""Places on a smooth piece of it, however short."""
CLOSER = 1 / 32
"""Nearer the phase's ends the places follow at this ratio, for small prime radii move the extremes there ..."""
CLOSEST = 1e-12
"""... down to this distance."""


@dataclass(frozen=True, eq=False)
class LawTable:
    """A law at fixed places; where its acceleration or jerk jumps there are two places, one for either side.

    w : (m,) fractions of the phase;  values : (4, m) f, f', f'', f'''
    first, last : (m,) the first and last place on the same smooth piece
    """

    w: Floats
    values: Floats
    first: NDArray[np.intp]
    last: NDArray[np.intp]

    @cached_property
    def seams(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The first place of each smooth piece, and the last one."""
        return np.unique(self.first), np.unique(self.last)

    @cached_property
    def inner(self) -> NDArray[np.intp]:
        """(m,) the nearest place that has a neighbour on either side."""
        return np.clip(np.arange(self.w.size), self.first + 1, self.last - 1)


@lru_cache(maxsize=64)
def law_table(law: Law) -> LawTable:
    """The table of a law.

    >>> import graphcam as gc
    >>> table = law_table(gc.law("rectangular"))
    >>> first, last = table.seams
    >>> table.w[first].tolist(), table.w[last].tolist(), table.values[2, first].tolist()
    ([0.0, 0.5], [0.5, 1.0], [4.0, -4.0])
    """
    pieces = [_places(*ends) for ends in pairwise((0.0, *law.breaks, 1.0))]
    values = np.hstack([np.array(law(w)) for w in pieces])
    ends = np.cumsum([len(w) for w in pieces])
    starts = np.concatenate([[0], ends[:-1]])
    values[:, ends - 1] = np.array(law(np.array([w[-1] for w in pieces]), side="left"))
    sizes = np.diff(ends, prepend=0)
    return LawTable(np.concatenate(pieces), values, np.repeat(starts, sizes), np.repeat(ends - 1, sizes))


def _places(begin: float, end: float) -> Floats:
    n = max(FEWEST, round(INSIDE * (end - begin)))
    share = np.sin(np.linspace(0, np.pi / 2, n + 2)[1:-1]) ** 2
    near = share[0] * CLOSER ** np.arange(1, np.log(CLOSEST / share[0]) / np.log(CLOSER))[::-1]
    share = np.concatenate([near if begin == 0 else [], share, 1 - near[::-1] if end == 1 else []])
    return np.concatenate([[begin], begin + (end - begin) * share, [end]])


@dataclass(frozen=True, eq=False)
class Legs:
    """Rises (direction +1) or returns (-1) by one law.

    lift : (n,) mm;  angle : (n,) rad
    """

    law: Law
    direction: int
    lift: Floats
    angle: Floats

    def part(self, which: NDArray[np.intp] | slice) -> Legs:
        """Those of some of the cams."""
        return Legs(self.law, self.direction, self.lift[which], self.angle[which])

    def at(self, w: Floats) -> Values:
        """(s, v, a, j), one place w for each cam."""
        return self.values(self.law(w))

    def values(self, f: Floats | Sequence[Floats]) -> Values:
        """(s, v, a, j) from f, f', f'', f''', (4, n), or (4, m, 1) for m places on every cam.

        Without f''', whose cost counts where the places are many, j is NaN.
        """
        rate = self.direction / self.angle
        first = self.lift * rate
        second = first * rate
        j = second * rate * f[3] if len(f) > 3 else np.asarray(np.nan)
        return self.lift * f[0], first * f[1], second * f[2], j

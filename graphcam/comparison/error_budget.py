"""The error budget of a drawing: how much of a reading's scatter comes from each kind of act.

The same hands draw once with all their errors, and once for every kind of act with those of that kind alone.  What a
hand is off in these drawings adds up to what it is off in the first, as far as a reading follows its errors in
proportion.  The acts err independently of one another, so then the variances add up too; what the sum leaves is what
errors do together, such as making the eye choose another place.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from graphcam.comparison.bounds import HANDS, Redrawable
from graphcam.drafting.acts import Kind
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.slips import SLIPS
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.showing import by_parts


@dataclass(frozen=True)
class Shares:
    """What makes one reading scatter; of several values, that which scatters most.

    deviation : standard deviation [mm of paper; an angle that was measured itself: rad]
    of : parts of the variance by the kind of act
    together : the part that errors of several kinds bring together only; with the others it makes 1
    """

    deviation: float
    of: Mapping[Kind, float]
    together: float


@dataclass(frozen=True, eq=False)
class ErrorBudget:
    """The error budget of one drawing, of the sizes that were adopted.

    drawn : the constructions
    pencil : the hand whose errors are told

    >>> import graphcam as gc
    >>> budget = ErrorBudget(gc.solve(gc.builtin_task()).chain, gc.Pencil.of(0.2))
    >>> shares = budget.of("integration", "max_v")
    >>> max(shares.of, key=shares.of.get).value
    'parallel'
    """

    drawn: Redrawable
    pencil: Pencil
    __repr__ = by_parts

    @cached_property
    def perfect(self) -> Redrawable:
        """The drawing by a hand without error."""
        return self.drawn.redrawn()

    @cached_property
    def hands(self) -> Mapping[Kind | None, Redrawable]:
        """The drawings by many hands: with all their errors, and with those of every kind of act in which they err."""
        erring = [kind for kind, slips in SLIPS.items() if any(self.pencil.deviation(kind, what) for what in slips)]
        by = replace(self.pencil, samples=self.pencil.samples or HANDS)
        alone = {kind: self.drawn.redrawn(pencil=replace(by, only=frozenset({kind}))) for kind in erring}
        return {None: self.drawn.redrawn(pencil=by), **alone}

    def of(self, construction: str, reading: str) -> Shares:
        """What makes a reading scatter; NaN where no hand can read it, or it does not scatter."""
        off = np.ma.masked_invalid([self._off(by, construction, reading) for by in self.hands.values()])
        off = np.ma.array(off.data, mask=np.broadcast_to(off.mask.any(axis=0), off.shape))  # in any of its drawings
        variances, rest = off.var(axis=1).filled(0.0), (off[0] - off[1:].sum(axis=0)).var(axis=0).filled(0.0)
        most = int(np.argmax(variances[0]))
        kinds, left = variances[1:, most], rest[most]
        with np.errstate(invalid="ignore"):
            parts, together = kinds / (kinds.sum() + left), left / (kinds.sum() + left)
        deviation = float(np.sqrt(variances[0, most])) / self.perfect[construction].readings[reading].per_mm
        alone = [kind for kind in self.hands if kind]
        return Shares(deviation, dict(zip(alone, parts.tolist(), strict=True)), float(together))

    def _off(self, hands: Redrawable, construction: str, reading: str) -> Floats:
        """How far every hand is off (samples, m), in machine units; of angles the turn that is less than half a one."""
        here, read = (each[construction].readings[reading] for each in (self.perfect, hands))
        with np.errstate(invalid="ignore"):
            off: Any = read.value - here.value
        off = off.reshape(len(off), -1)
        return np.remainder(off + FULL_TURN / 2, FULL_TURN) - FULL_TURN / 2 if here.unit == "rad" else off

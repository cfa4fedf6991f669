"""How tight the bounds of the double integration are: the proved one and the estimate, over the error that is made."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphcam.bench.convergence import EXACT
from graphcam.bench.scenes import scene
from graphcam.comparison.double_integration import chords
from graphcam.comparison.quantities import Comparison
from graphcam.given.laws import LAWS, Floats, law as law_of


@dataclass(frozen=True)
class BoundRow:
    """The greatest error of displacement, velocity and acceleration at the stations, and the bounds over it.

    error : of the lift, and of its derivatives over the phase
    proved, estimated : how many times as great the greatest bound is; None where the drawing is exact
    """

    law: str
    quantity: str
    parts: int
    error: float
    proved: float | None
    estimated: float | None


def bound_rows(parts: Sequence[int] = (12, 48), laws: Sequence[str] = LAWS) -> list[BoundRow]:
    """The rows of the rise of the translating follower, by law, quantity and number of parts a phase.

    >>> for row in bound_rows((12,), ("3-4-5",)):
    ...     print(row.quantity, f"{row.error:.1e}", round(row.proved, 2), round(row.estimated, 2))
    s 4.1e-03 1.32 2.4
    v 6.1e-03 1.42 2.39
    a 9.5e-02 1.05 2.4
    """
    return [row for name in laws for n in parts for row in _rows(name, n)]


def _rows(name: str, parts: int) -> list[BoundRow]:
    where = scene("translating", name)
    comparison = Comparison(where.chain(parts), where.cam)
    board = comparison.drawn.board
    rise = board.motion.phases[0]
    span = board.stations.phases[0]
    exact, rows = comparison.exact_stations.values, list[BoundRow]()
    for power, (quantity, bound) in enumerate(
        zip("sva", chords(law_of(name), board.stations.u[span]).read(), strict=True)
    ):
        per_unit = rise.angle**power / board.motion.lift
        error = _greatest(comparison.drawn_stations[quantity] - exact[power], span) * per_unit
        estimate = _greatest(comparison.bounds.at_stations("integration", quantity), span) * per_unit
        drawn_exactly = error < EXACT * max(1.0, float(np.abs(exact[power]).max()) * per_unit)
        tight = (None, None) if drawn_exactly else (float(bound.max()) / error, estimate / error)
        rows.append(BoundRow(name, quantity, parts, error, *tight))
    return rows


def _greatest(values: Floats, span: slice) -> float:
    return float(np.abs(values[span]).max())

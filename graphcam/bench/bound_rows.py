"""How tight the bounds of the double integration are: the proved one and the estimate, over the error that is made."""

from collections.abc import Iterator

import numpy as np

from graphcam.bench.convergence import EXACT
from graphcam.bench.rows import BenchRow, Section
from graphcam.bench.scenes import scene
from graphcam.comparison.double_integration import chords
from graphcam.comparison.quantities import Comparison
from graphcam.given.laws import LAWS, law as law_of
from graphcam.words import say


def rows_of_law(name: str, parts: int) -> Iterator[BenchRow]:
    """The rows of one law and number of parts, by quantity; not where the drawing is exact.

    >>> for row in rows_of_law("3-4-5", 12):
    ...     print(row.what, round(row.ratio, 2))
    s in 12 parts: off by 4.1e-03, estimate 2.40 times it 1.32
    v in 12 parts: off by 6.1e-03, estimate 2.39 times it 1.42
    a in 12 parts: off by 9.5e-02, estimate 2.40 times it 1.05
    """
    where = scene("translating", name)
    comparison = Comparison(where.chain(parts), where.cam)
    board = comparison.drawn.board
    rise, span = board.motion.phases[0], board.stations.phases[0]
    exact, bounds = comparison.exact_stations.values, chords(law_of(name), board.stations.u[span]).read()
    for power, (quantity, bound) in enumerate(zip("sva", bounds, strict=True)):
        off = comparison.drawn_stations[quantity] - exact[power]
        per_unit = rise.angle**power / board.motion.lift
        error, estimate, peak = (
            float(np.abs(values).max()) * per_unit
            for values in (off[span], comparison.bounds.at_stations("integration", quantity)[span], exact[power])
        )
        if error >= EXACT * max(1.0, peak):
            what = f"{quantity} in {parts} parts: off by {error:.1e}, estimate {estimate / error:.2f} times it"
            tight = round(float(bound.max()) / error, 9)  # where it is the error itself, both are rounded
            yield BenchRow(f"proved bound, {name}", what, tight, "times the error", ">= 1")


BOUNDS = Section(
    "bounds",
    say("Bounds of the double integration"),
    "The maximum proved bound for a rise's displacement, velocity or acceleration, over the maximum error of the "
    "construction; errors are relative to the lift, and to its derivatives over the phase. Beside it is the estimate "
    "from redrawings. Values that are drawn exactly are omitted.",
    lambda _: [row for name in LAWS for parts in (12, 48) for row in rows_of_law(name, parts)],
)

"""The error budget as a table: a row for every reading, a column for every kind of act that brings anything."""

from collections.abc import Mapping

import numpy as np

from graphcam.comparison.error_budget import ErrorBudget, Shares
from graphcam.constructions.arc_chain import ArcChain
from graphcam.constructions.chain import Chain
from graphcam.drafting.acts import Kind
from graphcam.drafting.ink import Construction
from graphcam.drafting.pencil import Pencil
from graphcam.report.markdown import number, numbers
from graphcam.words import Caption, Words, say

BROUGHT_BY: Mapping[Kind | None, Caption] = {
    Kind.DIVIDE: say("divisions"),
    Kind.ERECT: say("verticals"),
    Kind.PROJECT: say("projections"),
    Kind.LAY_OFF: say("lengths laid off"),
    Kind.PARALLEL: say("parallels"),
    Kind.PERPENDICULAR: say("perpendiculars"),
    Kind.TANGENT: say("tangents"),
    Kind.BISECT: say("bisectors"),
    Kind.CIRCLE: say("circles"),
    Kind.PROTRACTOR: say("protractor"),
    Kind.READ: say("readings"),
    None: say("together"),
}
"""What brings a share: the acts of a kind, or those of several kinds together only."""
NOTHING = 0.005
"""A share of less is not shown."""


def budget_table(drawn: Chain | ArcChain, pencil: Pencil) -> tuple[tuple[Words, ...], list[tuple[Words, ...]]]:
    """Header and rows: of every reading its scatter, then the shares in percent.

    >>> import graphcam as gc
    >>> header, rows = budget_table(gc.solve(gc.builtin_arcs_task()).chain, gc.Pencil.of(0.2))
    >>> [str(cell) for cell in header][:4], str(rows[0][1])
    (['reading', 'scatter', 'verticals', 'lengths laid off'], '0.32 mm')
    """
    budget = ErrorBudget(drawn, pencil)
    told = [
        (construction, reading, budget.of(construction.name, reading))
        for construction in drawn.values()
        for reading in construction.meaning.readings
    ]
    kinds = [kind for kind in BROUGHT_BY if any(_share(shares, kind) >= NOTHING for *_, shares in told)]
    header = (say("reading"), say("scatter"), *(BROUGHT_BY[kind] for kind in kinds))
    return header, [
        (
            say("{construction}: {reading}", construction=c.meaning.title, reading=c.meaning.reading(reading).title),
            _scatter(c, reading, shares.deviation),
            *(number(100 * share, 0) if (share := _share(shares, kind)) >= NOTHING else "" for kind in kinds),
        )
        for c, reading, shares in told
        if shares.deviation > 0
    ]


def _share(shares: Shares, kind: Kind | None) -> float:
    return shares.together if kind is None else shares.of.get(kind, 0.0)


def _scatter(construction: Construction, reading: str, deviation: float) -> Caption:
    """As a length on the paper, or the angle that was measured itself."""
    read = construction.readings[reading]
    if read.unit == "rad" and read.per_mm == 1:
        return say("{angle:.2f}°", angle=np.degrees(deviation))
    return say("{length} mm", **numbers(length=deviation))

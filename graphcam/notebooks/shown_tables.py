"""Tables of a notebook, in Markdown."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import unit
from graphcam.given.laws import Floats
from graphcam.report import markdown
from graphcam.report.markdown import number
from graphcam.report.note_tables import budget_table
from graphcam.solving.arcs_solution import AnySolution
from graphcam.words import say

if TYPE_CHECKING:
    from IPython.display import Markdown


def table(header: Sequence[str], rows: Iterable[Sequence[object]], digits: int = 3) -> Markdown:
    """A table: texts stay as they are, numbers get ``digits`` decimals.

    >>> print(table(("law", "C"), [("2-3", 6.0)], digits=1).data)
    | law |   C |
    | :-- | --: |
    | 2-3 | 6.0 |
    """
    from IPython.display import Markdown

    return Markdown(markdown.table(header, [[_cell(cell, digits) for cell in row] for row in rows]))


def _cell(cell: object, digits: int) -> str:
    return str(cell) if isinstance(cell, str | int) else str(number(float(cell), digits))  # pyright: ignore[reportArgumentType]


def compared(solution: AnySolution, *names: str) -> Markdown:
    """The table of values by an ideal pencil, by careful hands and exact; without names of all quantities.

    names : as in ``solution.json``

    >>> import graphcam as gc
    >>> print(compared(gc.solve(gc.builtin_task()), "max_v").data.splitlines()[2].split("|")[1:3])
    [' maximum v, mm/rad ', '       57.296 ']
    """
    from IPython.display import Markdown

    quantities = solution.comparison.quantities
    chosen = [quantities[name] for name in names] or [q for q in quantities.values() if q.drawn == q.drawn]
    titles = [say("{title}, {unit}", title=q.title, unit=unit(q.unit)) for q in chosen]
    figures = [(q.drawn, *scatter(q.by_hands, q.exact), q.exact) for q in chosen]
    rows = [(title, *(number(value, 3) for value in row)) for title, row in zip(titles, figures, strict=True)]
    hands = (say("careful drawings"), say("their bias"), say("their scatter"))
    header = (say("quantity"), say("ideal pencil"), *hands, say("exact"))
    return Markdown(markdown.table(header, rows, solution.tell))


def scatter(values: Floats, exact: float) -> tuple[float, float, float]:
    """The mean of values, how far it is from the exact one, and their standard deviation; NaN of none.

    >>> scatter(np.array([9.0, 11.0, np.nan]), 9.5)
    (10.0, 0.5, 1.0)
    """
    found = values[np.isfinite(values)]
    if not found.size:
        return math.nan, math.nan, math.nan
    mean = float(found.mean())
    return mean, mean - exact, float(found.std())


def error_budget(solution: AnySolution, pencil: Pencil) -> Markdown:
    """The table of the share that each kind of act has in the scatter of every reading, in percent of its variance.

    >>> import graphcam as gc
    >>> print(error_budget(gc.solve(gc.builtin_task()), gc.Pencil.of(0.2)).data.splitlines()[2].split("|")[1:3])
    [' Acceleration diagram: maximum ordinates                    ', ' 0.21 mm ']
    """
    from IPython.display import Markdown

    return Markdown(markdown.table(*budget_table(solution.chain, pencil), solution.tell))

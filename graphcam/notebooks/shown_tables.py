"""Tables of a notebook, in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import unit
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
    """The table of drawn and exact values, of quantities named as in ``solution.json``; without names of all.

    >>> import graphcam as gc
    >>> print(compared(gc.solve(gc.builtin_task()), "max_v").data.splitlines()[2].split("|")[1:4])
    [' maximum v, mm/rad ', ' 57.296 ', ' 57.296 ']
    """
    from IPython.display import Markdown

    quantities = solution.comparison.quantities
    chosen = [quantities[name] for name in names] or [q for q in quantities.values() if q.drawn == q.drawn]
    titles = [say("{title}, {unit}", title=q.title, unit=unit(q.unit)) for q in chosen]
    figures = [(q.drawn, q.exact, q.error, q.error_paper, q.tolerance_paper) for q in chosen]
    rows = [(title, *(number(value, 3) for value in row)) for title, row in zip(titles, figures, strict=True)]
    errors = (say("error"), say("on paper, mm"), say("bound, mm"))
    header = (say("quantity"), say("drawn"), say("exact"), *errors)
    return Markdown(markdown.table(header, rows, solution.tell))


def error_budget(solution: AnySolution, pencil: Pencil) -> Markdown:
    """The table of the share that each kind of act has in the scatter of every reading, in percent of its variance.

    >>> import graphcam as gc
    >>> print(error_budget(gc.solve(gc.builtin_task()), gc.Pencil.of(0.2)).data.splitlines()[2].split("|")[1:3])
    [' Acceleration diagram: maximum ordinates                    ', ' 0.21 mm ']
    """
    from IPython.display import Markdown

    return Markdown(markdown.table(*budget_table(solution.chain, pencil), solution.tell))

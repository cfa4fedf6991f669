"""Values that show themselves: in few lines of text, and as a drawing made in a room above the value's own.

Imports go down only, and importing graphcam loads no renderer: a motion stands in one of the lowest rooms, what draws
it in one of the highest.  So a value names the function that shows it, which is looked up when somebody wants to see
it.  This is the only place where that is done.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes
else:
    Axes = Any

LINES, WIDTH = 8, 100
"""Of a value's text at most: lines, and letters of a line that may be cut."""


def from_above(function: str) -> Callable[..., Any]:
    """The function of a room above, such as "report.output_folder.write".

    >>> from_above("plots.cam_outline.plot").__name__
    'plot'
    """
    module, _, name = function.rpartition(".")
    return getattr(import_module(f"graphcam.{module}"), name)


def in_lines(first: str, rows: Iterable[str], last: str) -> str:
    """The text of a value: what it is, its sizes, and how to go on.

    >>> print(in_lines("Cam", (f"radius {k}" for k in range(20)), ".plot()"))
    Cam
      radius 0
      radius 1
      radius 2
      radius 3
      radius 4
      and 15 more
    .plot()
    """
    rows, room = list(rows), LINES - 2
    if len(rows) > room:
        rows = [*rows[: room - 1], f"and {len(rows) - room + 1} more"]
    return "\n".join([first, *(f"  {row}" for row in rows), last])


class Shown:
    """A value that a notebook shows as a drawing: by ``svg`` of the module ``_drawn_in`` of :mod:`graphcam.plots`."""

    _drawn_in: ClassVar[str]

    def _repr_svg_(self) -> str | None:
        return from_above(f"plots.{self._drawn_in}.svg")(self)

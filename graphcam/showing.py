"""How values show themselves: in few lines of text, and as a drawing by a function of a higher room.

Imports go down only, and importing graphcam loads no renderer: a motion stands in one of the lowest rooms, what draws
it in one of the highest.  So a value names the function that shows it, which is looked up when somebody wants to see
it.  This is the only place where that is done.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import fields
from importlib import import_module
from textwrap import shorten
from typing import TYPE_CHECKING, Any, ClassVar

from graphcam.errors import DesignError
from graphcam.former_names import renamed

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes
    from matplotlib.figure import Figure as Figure

MAX_LINES, MAX_WIDTH = 8, 100
"""The maximum number of lines of a value's text, and of letters in a line."""


def higher_function(function: str) -> Callable[..., Any]:
    """The function of a higher room, by its path such as "report.output_folder.write".

    >>> higher_function("plots.cam_outline.plot").__name__
    'plot'
    """
    module, _, name = function.rpartition(".")
    return getattr(import_module(f"graphcam.{module}"), name)


def value_text(first: str, rows: Iterable[str], last: str) -> str:
    """The text of a value: its name, as many rows of sizes as fit, and its methods.

    >>> value_text("Cam", ["radius 20 mm"], ".plot()")
    'Cam\\n  radius 20 mm\\n.plot()'
    """
    rows, room = list(rows), MAX_LINES - 2
    if len(rows) > room:
        rows = [*rows[: room - 1], f"and {len(rows) - room + 1} more"]
    return "\n".join([first, *(f"  {row}" for row in rows), last])


def parts_text(self: Any) -> str:
    """The text of a dataclass whose fields are such values: the first line of each.

    >>> import graphcam as gc
    >>> gc.Contact(gc.builtin_task().motion(), gc.SpringLoad(0.2, 550, 3))
    Contact
      motion: Motion with a lift of 30 (mm; of an arm, rad)
      load: SpringLoad(mass=0.2, speed_rpm=550, stiffness=3, preload=0.0, acceleration=0.0, friction=0.0, ...
    """
    parts = {part.name: repr(getattr(self, part.name)).partition("\n")[0] for part in fields(self)}
    rows = (f"  {name}: {shorten(text, MAX_WIDTH, placeholder=' ...')}" for name, text in parts.items())
    return "\n".join([type(self).__name__, *rows])


class Plottable:
    """A value whose plot, also in notebooks, is drawn by the function ``_drawn_in`` of :mod:`graphcam.plots`."""

    _drawn_in: ClassVar[str]

    @renamed(axes="ax")
    def plot(self, ax: Axes | Figure | None = None, *, label: str = "", color: str | None = None) -> Axes:
        """Draw it on the given axes, on new ones in the given figure, or in a new figure; returns the axes.

        A second value of the kind may be drawn on the axes of the first, for comparison.

        label : its name in the legend, or of a drawing the title;  color : any that matplotlib knows

        Raises
        ------
        DesignError : the value has nothing to draw, or an array of axes is given

        >>> import graphcam as gc
        >>> motion = gc.builtin_task().motion()
        >>> [diagram.get_ylabel() for diagram in motion.plot().child_axes]
        ['lift s', 'v = ds/dφ', 'a = dv/dφ', 'j = da/dφ']
        """
        return higher_function(f"plots.{self._drawn_in}")(self, ax, label, color)

    def _repr_svg_(self) -> str | None:
        try:
            return higher_function("plots.figures.svg_of")(self)
        except DesignError:
            return None

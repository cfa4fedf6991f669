"""Figures of matplotlib: the axes that are drawn on, and a figure as SVG."""

from io import StringIO
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from graphcam.errors import DesignError
from graphcam.showing import Plottable
from graphcam.words import say

DIAGRAM_GAP = 0.03
"""The gap between diagrams one under the other, as a part of the axes."""
MAX_WIDTH = 12.0
"""The maximum width of a new figure [inches]: a larger drawing is shown reduced."""


def axes_on(on: object, width: float, height: float) -> Axes:
    """The given axes, or new ones in the given figure or in a new one of pyplot, which a notebook shows.

    width, height : of the figure [inches], unless axes are given

    Raises
    ------
    DesignError : it is an array of axes, or something else

    >>> axes_on(Figure().subplots(2), 6, 6)
    Traceback (most recent call last):
    graphcam.errors.DesignError: ax is an array of 2 axes, but must be one of them, or a figure; write ax=axes[0]
    """
    if isinstance(on, Axes):
        return on
    if on is not None and not isinstance(on, FigureBase):
        raise _no_axes(on)
    if on is None:
        from matplotlib import pyplot

        on = pyplot.figure(layout="tight")
    if isinstance(on, Figure):
        times = min(1.0, MAX_WIDTH / width, MAX_WIDTH / height)
        on.set_size_inches(times * width, times * height)
    return on.add_subplot()


def _no_axes(on: Any) -> DesignError:
    array = np.asarray(on, dtype=object)
    if not array.ndim:
        name = type(on).__name__
        return DesignError("ax", say("of the kind {name}", name=name), say("axes of matplotlib, or a figure"))
    found = say("an array of {count} axes", count=array.size)
    remedy = say("write ax=axes[{index}]", index=", ".join("0" * array.ndim))
    return DesignError("ax", found, say("one of them, or a figure"), remedy)


def diagrams_in(axes: Axes, count: int) -> list[Axes]:
    """Diagrams one under the other inside of axes, from the top; those of an earlier plot, if they are as many."""
    if len(axes.child_axes) == count:
        return [each for each in axes.child_axes if isinstance(each, Axes)]
    axes.set_axis_off()
    height = (1 + DIAGRAM_GAP) / count
    return [axes.inset_axes((0.0, k * height, 1.0, height - DIAGRAM_GAP)) for k in reversed(range(count))]


def svg_of(shown: Plottable) -> str:
    """A value's plot as SVG text, made without pyplot.

    >>> import graphcam as gc
    >>> svg_of(gc.builtin_task().motion()).startswith("<?xml")
    True
    """
    figure = Figure(layout="tight")
    shown.plot(ax=figure)
    return figure_svg(figure)


def figure_svg(figure: Figure) -> str:
    """A figure as SVG text, cropped to what is drawn."""
    text = StringIO()
    # Letters as letters, and nothing that changes from one run to the next.
    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": "graphcam"}):
        figure.savefig(text, format="svg", bbox_inches="tight", metadata={"Date": None, "Creator": "graphcam"})
    return text.getvalue()

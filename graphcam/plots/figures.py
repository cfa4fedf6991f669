"""Figures of matplotlib: the axes that are drawn on, and a figure as SVG."""

from __future__ import annotations

from io import StringIO

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from graphcam.showing import Plottable

MAX_WIDTH = 12.0
"""The maximum width of a new figure [inches]: a larger drawing is shown reduced."""


def axes_on(on: Axes | FigureBase | None, width: float, height: float) -> Axes:
    """The given axes, or new ones in the given figure or in a new one of pyplot, which a notebook shows.

    width, height : of the figure [inches], unless axes are given
    """
    if isinstance(on, Axes):
        return on
    if on is None:
        from matplotlib import pyplot

        on = pyplot.figure(layout="tight")
    if isinstance(on, Figure):
        times = min(1.0, MAX_WIDTH / width, MAX_WIDTH / height)
        on.set_size_inches(times * width, times * height)
    return on.add_subplot()


def svg_of(shown: Plottable) -> str:
    """A value's plot as SVG text, made without pyplot.

    >>> import graphcam as gc
    >>> svg_of(gc.builtin_task().motion()).startswith("<?xml")
    True
    """
    figure = Figure(layout="tight")
    shown.plot(axes=figure)
    return figure_svg(figure)


def figure_svg(figure: Figure) -> str:
    """A figure as SVG text, cropped to what is drawn."""
    text = StringIO()
    # Letters as letters, and nothing that changes from one run to the next.
    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": "graphcam"}):
        figure.savefig(text, format="svg", bbox_inches="tight", metadata={"Date": None, "Creator": "graphcam"})
    return text.getvalue()

"""Figures of matplotlib: the axes that are drawn on, and a figure as SVG."""

from __future__ import annotations

from collections.abc import Callable
from io import StringIO

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

WIDEST = 12.0
"""Of a new figure [inches]: a larger drawing is shown reduced."""


def given_or_new(axes: Axes | None, width: float, height: float) -> Axes:
    """The given axes, or those of a new figure of pyplot, so that a notebook shows it.

    width, height : of a new figure [inches]
    """
    if axes is not None:
        return axes
    from matplotlib import pyplot

    return pyplot.figure(figsize=_fitted(width, height)).add_subplot()


def svg_of(draw: Callable[[Axes], object], width: float, height: float) -> str:
    """What ``draw`` draws on axes, as SVG; pyplot hears nothing of it.

    >>> svg_of(lambda axes: axes.plot([0, 1], [0, 1]), 3.0, 2.0).startswith("<?xml")
    True
    """
    figure = Figure(_fitted(width, height))
    draw(figure.add_subplot())
    return figure_svg(figure)


def figure_svg(figure: Figure) -> str:
    """A figure as SVG, cut to what is drawn."""
    text = StringIO()
    # Letters as letters, and nothing that changes from one run to the next.
    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": "graphcam"}):
        figure.savefig(text, format="svg", bbox_inches="tight", metadata={"Date": None, "Creator": "graphcam"})
    return text.getvalue()


def _fitted(width: float, height: float) -> tuple[float, float]:
    times = min(1.0, WIDEST / width, WIDEST / height)
    return times * width, times * height

"""Figures of matplotlib: the axes that are drawn on, and a figure as SVG."""

from collections.abc import Sequence
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
ANGLE_LABEL = "cam angle φ, degrees"
NAME_OFFSET, SYMBOL_OFFSET, LETTER_WIDTH = -0.6, -0.48, 0.08
"""How far names and symbols of ordinates stand from their axis, and how wide the letters of names are [inches]."""
TURN_STEPS, MIN_STEP_WIDTH = (30, 60, 90), 0.36
"""Steps of the cam angle [degrees], and how wide one must be at least [inches]."""
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


def size_of(axes: Axes) -> tuple[float, float]:
    """Width and height of axes [inches]."""
    box, figure = axes.get_position(), axes.get_figure(root=True)
    width, height = figure.get_size_inches() if figure is not None else (0.0, 0.0)
    return float(box.width * width), float(box.height * height)


def divide_turn(axes: Axes, diagrams: Sequence[Axes], label: str) -> None:
    """Let diagrams inside of axes go over the turn, divided as finely as their width permits, the last one named."""
    width, _ = size_of(axes)
    step = next(step for step in TURN_STEPS if width * step / 360 >= MIN_STEP_WIDTH or step == TURN_STEPS[-1])
    for diagram in diagrams:
        diagram.set(xlim=(0, 360), xticks=range(0, 361, step))
        diagram.spines[["top", "right"]].set_visible(False)
        diagram.tick_params(labelbottom=diagram is diagrams[-1])
    diagrams[-1].set_xlabel(label)


def name_ordinates(axes: Axes, diagrams: Sequence[Axes], names: Sequence[str], symbols: Sequence[str]) -> None:
    """Name the ordinates of diagrams inside of axes; where there is no room for names, by their symbols."""
    width, height = size_of(axes)
    low = max(map(len, names)) * LETTER_WIDTH > height / len(diagrams)
    for diagram, name, symbol in zip(diagrams, names, symbols, strict=True):
        diagram.set_ylabel(symbol if low else name, rotation=0 if low else 90, va="center" if low else "bottom")
        # They stand one under the other, however wide the numbers are.
        diagram.yaxis.set_label_coords((SYMBOL_OFFSET if low else NAME_OFFSET) / width, 0.5)


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

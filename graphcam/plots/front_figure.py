"""The Pareto front of size and pressure angle that a sweep found, as a figure."""

import numpy as np
from matplotlib.figure import Figure

from graphcam.sheets.styles import ACCENT, BLACK, GREY
from graphcam.sweeps.pareto_front import ANGLE, SIZE_COLUMN
from graphcam.sweeps.sweep import Columns

FIGURE_SIZE = 6.4, 4.2
"""The size of the figure [inches]."""


def front_figure(front: Columns, limit: float) -> Figure:
    """The figure of a front: its designs, the region that no design reaches, and the permitted pressure angle.

    front : by column, with the pressure angle [degrees];  limit : of the pressure angle on the rise [degrees]
    """
    size, angle = front[SIZE_COLUMN], np.abs(front[ANGLE])
    figure = Figure(figsize=FIGURE_SIZE, layout="tight")
    axes = figure.add_subplot()
    axes.margins(0.12)
    axes.plot(size, angle, "o", color=ACCENT, markersize=5, zorder=3, clip_on=False)
    # A design of any size beside one of the front keeps the angle of the next smaller one at best.
    axes.plot(size, angle, drawstyle="steps-post", color=BLACK, linewidth=1.0)
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    high = max(high, limit + 0.08 * (limit - low))
    # Each twice: the corners of the steps.
    corners = np.concatenate(([left], np.repeat(size, 2), [right])), np.repeat(np.concatenate(([high], angle)), 2)
    axes.fill_between(*corners, low, color="#eeeeee", linewidth=0)
    axes.axhline(limit, color=GREY, linewidth=1.0, linestyle=(0, (6, 4)))
    axes.annotate("permitted", (right, limit), (-4, 3), textcoords="offset points", ha="right", color=GREY)
    axes.annotate("no design", (left, low), (8, 8), textcoords="offset points", color=GREY)
    axes.set(
        xlabel="prime radius, mm",
        ylabel="maximum pressure angle on the rise, °",
        xlim=(left, right),
        ylim=(low, high),
    )
    axes.set_title("No design is both smaller and of a smaller pressure angle", fontsize="medium")
    axes.spines[["top", "right"]].set_visible(False)
    return figure

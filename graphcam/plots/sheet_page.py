"""The sheet of a solution."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from graphcam.plots.figures import axes_on
from graphcam.report.documents import sheet_of
from graphcam.sheets.matplotlib_renderer import INCH, draw_on
from graphcam.solving.arcs_solution import AnySolution


def plot(solution: AnySolution, on: Axes | Figure | None = None) -> Axes:
    """Draw the first page of the finished sheet on axes in mm of paper, from its lower left corner."""
    page = sheet_of(solution).pages[0]
    axes = axes_on(on, page.width / INCH, page.height / INCH)
    draw_on(axes, page)
    axes.set_axis_off()  # the sheet has a frame of its own
    return axes

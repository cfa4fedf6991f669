"""The sheet of a solution."""

from __future__ import annotations

from matplotlib.axes import Axes

from graphcam.plots.figures import given_or_new
from graphcam.report.documents import sheet_of
from graphcam.sheets.matplotlib_renderer import INCH, draw_on
from graphcam.sheets.matplotlib_renderer import svg as page_svg
from graphcam.solving.arcs_solution import AnySolution


def plot(solution: AnySolution, axes: Axes | None = None) -> Axes:
    """Draw the first page of the finished sheet on axes in mm of paper, from its lower left corner."""
    page = sheet_of(solution).pages[0]
    axes = given_or_new(axes, page.width / INCH, page.height / INCH)
    draw_on(axes, page)
    axes.set_axis_off()  # the sheet has a frame of its own
    return axes


def svg(solution: AnySolution) -> str:
    """The first page of the finished sheet as SVG."""
    return page_svg(sheet_of(solution).pages[0])

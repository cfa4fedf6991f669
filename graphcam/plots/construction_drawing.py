"""Constructions as plots: one as a whole or up to a step, a single step, or all constructions of a cam."""

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from graphcam.drafting.ink import Construction, Step
from graphcam.errors import DesignError
from graphcam.plots.figures import axes_on
from graphcam.plots.step_board import StepBoard, board_of
from graphcam.report.documents import sheet_of
from graphcam.sheets.matplotlib_renderer import MM_PER_INCH, draw_on
from graphcam.solving.arcs_solution import AnySolution
from graphcam.words import say

FIGURE_MARGIN = 1.0
"""The margin of a new figure around the drawing [inches]."""


def plot(
    drawn: Construction | Step | Mapping[str, Construction],
    on: Axes | Figure | None = None,
    label: str = "",
    color: str | None = None,
    step: int | None = None,
) -> Axes:
    """Draw on axes in mm of paper from the origin of the first view; returns the axes.

    step : index of the last step that is drawn, which is in colour; by default all are

    Raises
    ------
    DesignError : there is no such step, or nothing is drawn
    """
    match drawn:
        case Construction():
            board = board_of(drawn)
        case Step():
            board = StepBoard((), (drawn,))
        case _:
            board = StepBoard((), tuple(step for construction in drawn.values() for step in construction.steps()))
    count = len(board.steps)
    if not board.views:
        limit = say("marks in a view")
        raise DesignError("drawing", say("empty"), limit, say("see the captions of the steps, and the readings"))
    if step is not None and step not in range(count):
        limit = say("an index of the steps, 0 to {value}, or None for all of them", value=count - 1)
        raise DesignError("step", step, limit, say("axes to draw on are given as ax=..."))
    page = board.page(step)
    axes = axes_on(on, page.width / MM_PER_INCH + FIGURE_MARGIN, page.height / MM_PER_INCH + FIGURE_MARGIN)
    draw_on(axes, page, board.origin, board.factor, color)
    axes.set(xlabel="mm of paper", ylabel="mm of paper")
    if label or len(board.views) == 1:
        axes.set_title(label or str(next(iter(board.views.values())).title), fontsize="medium")
    return axes


def plot_sheet(
    solution: AnySolution, on: Axes | Figure | None = None, label: str = "", color: str | None = None
) -> Axes:
    """Draw the first page of the finished sheet on axes in mm of paper from its lower left corner; returns them."""
    page = sheet_of(solution).pages[0]
    axes = axes_on(on, page.width / MM_PER_INCH, page.height / MM_PER_INCH)
    draw_on(axes, page, colour=color)
    axes.set_axis_off()  # the sheet has a frame of its own
    axes.set_title(label, fontsize="medium")
    return axes

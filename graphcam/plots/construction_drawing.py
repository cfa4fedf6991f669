"""A construction as it is drawn: all its views, or up to a step; and a step alone, and all constructions of a cam."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.axes import Axes

from graphcam.drafting.ink import Construction, Step
from graphcam.errors import DesignError
from graphcam.plots.figures import given_or_new
from graphcam.plots.step_board import StepBoard, board_of
from graphcam.sheets.matplotlib_renderer import INCH, draw_on
from graphcam.sheets.matplotlib_renderer import svg as page_svg

AROUND = 1.0
"""What the axes of a new figure need beside the drawing [inches]."""


def plot(construction: Construction, step: int | None = None, axes: Axes | None = None) -> Axes:
    """Draw a construction on axes in mm of paper from the origin of its first view.

    step : index of the last step that is drawn, which is in colour; by default all are

    Raises
    ------
    DesignError : there is no such step, or the construction draws nothing
    """
    board = board_of(construction)
    if not board.views:
        remedy = "see its readings, and the captions of its steps"
        raise DesignError(f"construction {construction.name}", "words alone", "one that draws something", remedy)
    if step is not None and not 0 <= step < len(board.steps):
        raise DesignError("step", step, f"an index of its steps, 0 to {len(board.steps) - 1}, or None for all of them")
    page = board.page(step)
    axes = given_or_new(axes, page.width / INCH + AROUND, page.height / INCH + AROUND)
    draw_on(axes, page, board.origin, board.factor)
    axes.set(xlabel="mm of paper", ylabel="mm of paper")
    if len(board.views) == 1:
        axes.set_title(str(*(view.title for view in board.views.values())), fontsize="medium")
    return axes


def svg(value: Construction | Step | Mapping[str, Construction]) -> str | None:
    """The finished drawing as SVG, None of what draws nothing."""
    match value:
        case Construction():
            board = board_of(value)
        case Step():
            board = StepBoard((), (value,))
        case _:
            board = StepBoard((), tuple(step for construction in value.values() for step in construction.steps()))
    return page_svg(board.page()) if board.views else None

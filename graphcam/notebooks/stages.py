"""A construction step by step: the drawing so far, the current step in colour, its caption and its readings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from graphcam.constructions.readings import ReadingRow, rows
from graphcam.drafting.ink import Construction, Step
from graphcam.errors import DesignError
from graphcam.notebooks.picture import Picture
from graphcam.plots.step_board import board_of
from graphcam.report.documents import sheet_of
from graphcam.report.step_player import player_of
from graphcam.sheets.model import Page
from graphcam.solving.arcs_solution import AnySolution
from graphcam.words import Tell, say

if TYPE_CHECKING:
    from IPython.display import HTML


@dataclass(frozen=True, eq=False)
class Stage:
    """One step of a construction, as a notebook shows it.

    number : of the step, from 1
    step : what is done, in words
    page : the drawing so far; None for a step of words alone
    reads : what is read off the paper with this step
    tell : says all texts
    """

    number: int
    step: Step
    page: Page | None
    reads: tuple[ReadingRow, ...]
    tell: Tell

    @property
    def picture(self) -> Picture | None:
        """The drawing so far with the current step in colour."""
        if self.page is None:
            return None
        # The renderer loads matplotlib.
        from graphcam.sheets.matplotlib_renderer import svg

        title, view = self.tell(self.step.title), self.tell(self.step.view.title)
        said = {"view": view, "number": self.number, "title": title, "caption": self.step.caption}
        alt = say("{view}. Drawn so far, with step {number} in colour: {title}. {caption}", **said)
        return Picture(svg(self.page), self.tell(alt), f"{view}: {title[0].lower()}{title[1:]}")

    @property
    def html(self) -> str:
        """Title, caption, drawing and readings."""
        title, caption = escape(self.tell(self.step.title)), escape(self.tell(self.step.caption))
        words = f"<h4>{self.number}. {title}</h4><p>{caption}</p>"
        shown = self.picture.html if self.picture else ""
        read = "".join(f"<li>{_reading(row, self.tell)}</li>" for row in self.reads)
        readings = f'<ul class="readings">{read}</ul>' if read else ""
        return f'<section class="step">{words}{shown}{readings}</section>'

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {
            "text/html": self.html,
            "text/plain": f"{self.number}. {self.tell(self.step.title)}: {self.tell(self.step.caption)}",
        }


def _reading(row: ReadingRow, tell: Tell) -> str:
    """A reading as mm x mu = value; of one at many stations the greatest, and all of them to be unfolded."""
    if not row.paper.ndim:
        return escape(tell(say("{title} = {said}", title=row.title, said=row.said())))
    greatest = int(np.nanargmax(np.abs(row.paper)))
    lines = "".join(f"<li>{place}: {escape(tell(row.said(k)))}</li>" for k, place in enumerate(row.places))
    place, said = row.places[greatest], row.said(greatest)
    first = say("{title}, the greatest at {place} = {said}", title=row.title, place=place, said=said)
    return f"<details><summary>{escape(tell(first))}</summary><ul>{lines}</ul></details>"


def stages(construction: Construction, tell: Tell = str, on: Construction | None = None) -> Iterator[Stage]:
    """The steps of a construction, each with the drawing so far; ``tell`` says all texts, ``on`` as for board_of."""
    of_view, drawn = board_of(construction, tell, on).by_view, Counter[str]()
    for number, step in enumerate(construction.steps(), 1):
        name = step.view.name
        page = of_view[name].page(drawn[name]) if name in of_view else None
        drawn[name] += 1
        yield Stage(number, step, page, tuple(rows(construction, step)), tell)


def drawing(construction: Construction, view: str | None = None, tell: Tell = str) -> Picture:
    """The finished drawing of a construction in one of its views, by default the first; ``tell`` says all texts.

    >>> import graphcam as gc
    >>> drawing(gc.solve(gc.builtin_task()).drawn["minimum_radius"]).caption
    'Displacement and velocity: the least radius'

    Raises
    ------
    DesignError : the construction draws nothing in that view
    """
    from graphcam.sheets.matplotlib_renderer import svg

    of_view = board_of(construction, tell).by_view
    if view is not None and view not in of_view:
        raise DesignError("view", view, f"one of {', '.join(of_view)}")
    board = of_view[view] if view is not None else next(iter(of_view.values()))
    title = str(board.steps[-1].view.title)
    return Picture(svg(board.page()), f"{title}. {board.steps[-1].caption}", title)


def show_steps(construction: Construction, *numbers: int, tell: Tell = str, on: Construction | None = None) -> None:
    """Show steps of a construction in a notebook, by their numbers from 1; without a number all of them.

    tell : says all texts, such as ``task.drawing.tell`` in the language of the task
    on : a construction that this one does not start from, but is drawn over: it is shown below it
    """
    from IPython.display import display

    for stage in stages(construction, tell, on):
        if not numbers or stage.number in numbers:
            display(stage)


HEIGHT = 720
"""Of the frame in which the player stands, in pixels of a page."""


def player(solution: AnySolution) -> HTML:
    """The step player of a solution as a frame that holds the whole page: nothing is fetched.

    >>> import graphcam as gc
    >>> player(gc.solve(gc.builtin_task())).data.startswith('<div class="player"><iframe')
    True
    """
    from IPython.display import HTML

    page = escape(player_of(solution, sheet_of(solution)))
    title = escape(solution.tell(say("Step player")))
    frame = f'<iframe title="{title}" style="width: 100%; height: {HEIGHT}px" srcdoc="{page}"></iframe>'
    return HTML(f'<div class="player">{frame}</div>')

"""The step player inside a notebook."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from graphcam.report.documents import sheet_of
from graphcam.report.step_player import player_of
from graphcam.solving.arcs_solution import AnySolution
from graphcam.words import say

if TYPE_CHECKING:
    from IPython.display import HTML

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

"""Notebooks: what a step-by-step notebook shows, and how one is written, executed and turned into pages.

In a notebook: :func:`~graphcam.notebooks.construction_stages.show_steps` and
:func:`~graphcam.notebooks.construction_stages.drawing`, :func:`~graphcam.notebooks.shown_tables.comparison_table`,
:func:`~graphcam.notebooks.construction_stages.chart`, :class:`~graphcam.notebooks.question.Question`,
:func:`~graphcam.notebooks.sliders.explore` and :func:`~graphcam.notebooks.sliders.changed_task`.

The drawings are those of :mod:`graphcam.sheets`: the same marks, the same renderer.
"""

from graphcam.notebooks.construction_stages import (
    Picture,
    chart,
    drawing,
    picture_of,
    picture_of_page,
    player,
    show_steps,
)
from graphcam.notebooks.question import Question
from graphcam.notebooks.shown_tables import comparison_table, error_budget, table
from graphcam.notebooks.sliders import Slider, changed_task, explore

__all__ = [
    "Picture",
    "Question",
    "Slider",
    "changed_task",
    "chart",
    "comparison_table",
    "drawing",
    "error_budget",
    "explore",
    "picture_of",
    "picture_of_page",
    "player",
    "show_steps",
    "table",
]

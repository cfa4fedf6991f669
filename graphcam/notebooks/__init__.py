"""Notebooks: what a step-by-step notebook shows, and how one is written, executed and turned into pages.

In a notebook: :func:`~graphcam.notebooks.construction_stages.show_steps` and
:func:`~graphcam.notebooks.construction_stages.drawing`, :func:`~graphcam.notebooks.shown_tables.compared`,
:func:`~graphcam.notebooks.construction_stages.chart`, :class:`~graphcam.notebooks.question.Question`,
:class:`~graphcam.notebooks.question.ArrayQuestion`,
:func:`~graphcam.notebooks.explore.explore`, :func:`~graphcam.notebooks.explore.changed` and
:func:`~graphcam.notebooks.explore.lesson_task`.

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
from graphcam.notebooks.explore import Slider, changed, explore, lesson_task
from graphcam.notebooks.question import ArrayQuestion, Question, kept_questions
from graphcam.notebooks.shown_tables import compared, error_budget, table

__all__ = [
    "ArrayQuestion",
    "Picture",
    "Question",
    "Slider",
    "changed",
    "chart",
    "compared",
    "drawing",
    "error_budget",
    "explore",
    "kept_questions",
    "lesson_task",
    "picture_of",
    "picture_of_page",
    "player",
    "show_steps",
    "table",
]

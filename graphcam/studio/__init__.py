"""The studio: a size is moved, and the construction is drawn anew beside the exact values.

The engine (:mod:`graphcam.studio.engine`) is one function from plain data to plain data; a local server, a worker of
WebAssembly and a widget carry it to the same page.

This room is a function too: ``gc.studio(task)`` is the widget of a notebook, so that the room and what one opens in it
bear one name.  ``graphcam.studio`` is the same object before and after a module of the room has been imported.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from types import ModuleType
from typing import TYPE_CHECKING, Any

from graphcam.errors import installed

if TYPE_CHECKING:
    from graphcam.studio.widget import StudioWidget
    from graphcam.tasks.arcs_task import ArcsTask
    from graphcam.tasks.task import Task


def open_studio(
    task: Task | ArcsTask | Mapping[str, Any] | None = None,
    view: str | None = None,
    stills: Mapping[str, Mapping[str, Any]] | None = None,
) -> StudioWidget:
    """``gc.studio(task)``: the studio as a widget of a notebook; move a size, and the construction follows.

    task : a task, or its plain data; by default the built-in coursework
    view : the name of the view that is shown first; by default the region, or the profile
    stills : what a page shows in its place where no kernel runs: pictures of the view with other values, by what is
        said of them; by default the task as it is

    Raises
    ------
    TaskError : the plain data are no task, or the extra ``notebooks`` is not installed

    >>> import graphcam as gc
    >>> widget = gc.studio(gc.builtin_task(), view="profile")
    >>> widget.changes = {"follower.offset": 5.0}
    >>> widget.task["follower"]["offset"], gc.solve(widget.given).cam.follower.offset
    (5.0, 5.0)
    """
    with installed("gc.studio", "anywidget", "notebooks"):
        from graphcam.studio.widget import StudioWidget
    from graphcam.tasks.task_file import builtin_task

    return StudioWidget(builtin_task() if task is None else task, view, stills or {})


class _Studio(ModuleType):
    """A room that can be called."""

    __call__ = staticmethod(open_studio)


if TYPE_CHECKING:
    studio = open_studio
else:
    studio = sys.modules[__name__]
    studio.__class__ = _Studio

"""The studio as a widget of a notebook: the page in a frame, the engine in the kernel, the task shared by both.

It needs the extra ``notebooks``.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files
from typing import Any

import anywidget
import traitlets

from graphcam.showing import from_above
from graphcam.studio.address import differences
from graphcam.studio.engine import answer
from graphcam.studio.page import WORDS, page
from graphcam.studio.plain_tasks import built_in_tasks, nearest_built_in, plain_task
from graphcam.studio.still_picture import still_picture
from graphcam.studio.task_paths import changed
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import task_from

HEIGHT = 720
"""The height of the frame, in pixels of a page."""
ID = "widget"
"""How the page and the frame around it know each other's messages."""
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
Plain = dict[str, Any]
AnyTask = Task | ArcsTask | Mapping[str, Any]


class _PlainTask(traitlets.Dict):
    """Plain data of a task, also where the task itself is set."""

    def validate(self, obj: Any, value: Any) -> Any:
        """The plain data of what was set."""
        return super().validate(obj, plain_task(value) if isinstance(value, Task | ArcsTask) else value)


class StudioWidget(anywidget.AnyWidget):
    """The studio in a notebook.

    task : the task as plain data, with the keys of a task file; set it and the page follows, move a size and it changes
    changes : what of the task has another value than in the beginning, by paths such as "follower.offset"; it may be
        set too
    view : the name of the view that is shown, None for the usual one
    """

    _esm = (files("graphcam") / "data" / "studio" / "widget.js").read_text(encoding="utf-8")
    task = _PlainTask().tag(sync=True)
    view = traitlets.Unicode(None, allow_none=True).tag(sync=True)
    page = traitlets.Unicode().tag(sync=True)
    title = traitlets.Unicode().tag(sync=True)
    height = traitlets.Int(HEIGHT).tag(sync=True)
    changes = traitlets.Dict()

    def __init__(self, task: AnyTask, view: str | None, stills: Mapping[str, Mapping[str, Any]]) -> None:
        given = task_from(dict(task)) if isinstance(task, Mapping) else task
        self._start, self._stills = plain_task(given), stills
        self._language = given.drawing.language
        config = {
            "transport": "parent",
            "id": ID,
            "task": self._start,
            "view": view,
            "name": nearest_built_in(given),
            "builtin": built_in_tasks(),
            "language": self._language,
        }
        # The page around this one settles what may be asked for.
        text = page(config, policy="")
        super().__init__(task=self._start, view=view, page=text, title=str(WORDS["studio"]))
        self.on_msg(self._asked)

    @property
    def given(self) -> Task | ArcsTask:
        """The task as it is now, to be solved: ``gc.solve(widget.given)``.

        Raises
        ------
        TaskError : the page shows a value that cannot be
        """
        return task_from(self.task)

    @property
    def html(self) -> str:
        """The still pictures that stand in its place where no kernel runs; without any the task as it is now."""
        if not self._stills:
            return self._still({}).html
        pictures = {says: self._still(changes) for says, changes in self._stills.items()}
        return from_above("notebooks.explore.side_by_side")(pictures)

    def _still(self, changes: Mapping[str, Any]) -> Any:
        """A picture of the task with other values."""
        still = still_picture(changed(self._start if changes else self.task, changes), self.view, self._language)
        return from_above("notebooks.picture.Picture")(still.svg, f"{still.title}. {still.caption}", still.title)

    def _repr_mimebundle_(self, **_: Any) -> tuple[Plain, Plain]:
        view = {"version_major": 2, "version_minor": 0, "model_id": self.model_id}
        return {WIDGET_VIEW: view, "text/html": self.html, "text/plain": f"Studio of {self.given!r}"}, {}

    @traitlets.observe("task")
    def _moved(self, _: Any) -> None:
        self.changes = dict(differences(self._start, self.task))

    @traitlets.observe("changes")
    def _changed(self, _: Any) -> None:
        # What was changed by moving is there already.
        if self.changes != dict(differences(self._start, self.task)):
            self.task = changed(self._start, self.changes)

    def _asked(self, _: Any, letter: Any, __: Any) -> None:
        """Answer a request of the page."""
        self.send({"frame": letter.get("frame"), "id": letter.get("id"), "response": answer(letter.get("request", {}))})

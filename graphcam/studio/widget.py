"""The studio as a widget of a notebook: the page in a frame, the engine in the kernel; a picture without one.

It needs the extra ``notebooks``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib.resources import files
from typing import Any

import anywidget
import traitlets

from graphcam.sheets.player_svg import roles_css
from graphcam.sheets.typefaces import FONT_FAMILY, font_faces
from graphcam.showing import higher_function
from graphcam.studio.address import differences
from graphcam.studio.engine import answer
from graphcam.studio.studio_page import PAGE_CAPTIONS, page
from graphcam.studio.task_paths import changed_task
from graphcam.studio.task_text import page_config, plain_task
from graphcam.studio.views_answer import views_answer
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import task_from

FRAME_HEIGHT = 720
"""The height of the frame, in pixels of a page."""
WIDGET_ID = "widget"
"""How the page and the frame around it know each other's messages."""
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
Plain = dict[str, Any]
AnyTask = Task | ArcsTask | Mapping[str, Any]


PX_PER_MM = 1.2
"""How large it is shown at least: two of them side by side on a page; it settles how large the letters are."""
DEFAULT_VIEWS = "combined", "profile"
"""The view that is shown if none is named; where there is none of these, the first."""
INK_STYLES = f"""
.line, .opaque {{ fill: none; stroke: var(--print); stroke-width: var(--width); stroke-linejoin: round }}
.page .opaque {{ fill: #fff }}
.filled, .text {{ fill: var(--print, #000); font-family: {FONT_FAMILY} }}
.middle {{ text-anchor: middle }}
.end {{ text-anchor: end }}
"""
"""Everything in print, as on a sheet."""


def still_picture(task: Mapping[str, Any], view: str | None = None, language: str = "en") -> Any:
    """The picture of a view, all of its steps drawn, as it stands in a notebook, described by its last step.

    task : as plain data
    view : its name; by default the region, or the profile

    Raises
    ------
    GraphcamError : the task has no cam, or no such view

    >>> import graphcam as gc
    >>> picture = still_picture(gc.builtin_task().to_dict(), "profile")
    >>> picture.caption, picture.image.startswith("<svg")
    ('Cam profile, 2:1', True)
    """
    asked = {"task": task, "language": language, "told": True}
    if view is None:
        names = [each["name"] for each in views_answer({**asked, "told": False})["names"]]
        view = next((name for name in DEFAULT_VIEWS if name in names), names[0])
    (drawn,) = views_answer({**asked, "views": [{"name": view, "px_per_mm": PX_PER_MM}]})["views"]
    steps = [drawn["steps"][name] for name in drawn["order"]]
    lines = "".join(step["svg"] for step in steps)
    frame = " ".join(f"{number:g}" for number in drawn["frame"])
    letters = font_faces(re.findall(r">([^<]+)<", lines))
    svg = (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="page" viewBox="{frame}">'
        f"<style>{letters}{roles_css()}{INK_STYLES}</style>{lines}</svg>"
    )
    described, title = f"{drawn['title']}. {steps[-1]['caption']}", drawn["title"]
    return higher_function("notebooks.construction_stages.Picture")(svg, described, title)


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
    height = traitlets.Int(FRAME_HEIGHT).tag(sync=True)
    changes = traitlets.Dict()

    def __init__(self, task: AnyTask, view: str | None, stills: Mapping[str, Mapping[str, Any]]) -> None:
        given = task_from(dict(task)) if isinstance(task, Mapping) else task
        self._start, self._stills = plain_task(given), stills
        self._language = given.drawing.language
        shown = {"transport": "parent", "id": WIDGET_ID, "view": view, "opening": "construction", "beside": ""}
        config = page_config(given, self._language, **shown)
        # The page around this one settles what may be asked for.
        text = page(config, policy="")
        super().__init__(task=self._start, view=view, page=text, title=str(PAGE_CAPTIONS["studio"]))
        self.on_msg(self._answer_request)

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
        """Still pictures for a page without a kernel: those that were asked for, else one of the task as it is now."""
        if not self._stills:
            return self._still_picture({}).html
        pictures = {says: self._still_picture(changes) for says, changes in self._stills.items()}
        return higher_function("notebooks.explore.side_by_side")(pictures)

    def _still_picture(self, changes: Mapping[str, Any]) -> Any:
        """A picture of the task with other values."""
        task = changed_task(self._start if changes else self.task, changes)
        return still_picture(task, self.view, self._language)

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
            self.task = changed_task(self._start, self.changes)

    def _answer_request(self, _: Any, letter: Any, __: Any) -> None:
        self.send({"frame": letter.get("frame"), "id": letter.get("id"), "response": answer(letter.get("request", {}))})

"""Sliders; where no kernel runs, pictures of a few positions stand side by side in their place."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any, Protocol, TypeVar

from graphcam.errors import DesignError, nearest_word_remedy
from graphcam.given.motion import MovingPhase, Rise
from graphcam.solving.solve import solve
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import builtin_task, load_task
from graphcam.words import say

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"


class ShownPosition(Protocol):
    """A picture, or several things under one another, for one position of the sliders."""

    @property
    def html(self) -> str:
        """The HTML of this position."""
        ...


@dataclass(frozen=True)
class Slider:
    """A quantity that the reader can change.

    label : the text beside the slider
    values : its positions
    start : the position at the beginning
    shown : the positions on a page without sliders; by default the start alone
    """

    label: str
    values: Sequence[Any]
    start: Any
    shown: Sequence[Any] = ()


@dataclass(frozen=True)
class Exploration:
    """The sliders of :func:`explore` in a running notebook; still pictures on a page."""

    draw: Callable[..., ShownPosition]
    sliders: dict[str, Slider]

    @property
    def html(self) -> str:
        """The pictures without a kernel: each slider's ``shown`` positions while the others stand at their start."""
        start = {name: slider.start for name, slider in self.sliders.items()}
        moved = [(name, value) for name, slider in self.sliders.items() for value in slider.shown]
        if not moved:
            return self.draw(**start).html
        return side_by_side(
            {f"{self.sliders[name].label}: {value}": self.draw(**{**start, name: value}) for name, value in moved}
        )

    def _repr_mimebundle_(self, **_: object) -> dict[str, Any]:
        still = {"text/html": self.html, "text/plain": "Sliders: " + ", ".join(s.label for s in self.sliders.values())}
        widget = self._widget()
        # A front end without sliders takes the page.
        return still if widget is None else {WIDGET_VIEW: _view(widget), **still}

    def _widget(self) -> Any:
        try:
            import ipywidgets
        except ImportError:  # an extra, and the stills say the same
            return None
        picture = ipywidgets.HTML(self.draw(**{name: slider.start for name, slider in self.sliders.items()}).html)
        shape = {"style": {"description_width": "initial"}, "layout": {"width": "32em"}, "continuous_update": False}
        controls = {
            name: ipywidgets.SelectionSlider(options=list(s.values), value=s.start, description=s.label, **shape)
            for name, s in self.sliders.items()
        }

        def redraw(_: Any) -> None:
            """Show the picture for the present positions of the sliders."""
            picture.value = self.draw(**{name: control.value for name, control in controls.items()}).html

        for control in controls.values():
            control.observe(redraw, "value")
        return ipywidgets.VBox([*controls.values(), picture])


def side_by_side(stills: Mapping[str, ShownPosition]) -> str:
    """Pictures side by side as HTML, each under its label.

    >>> from graphcam.notebooks.construction_stages import Picture
    >>> side_by_side({"4 parts": Picture("<svg/>", "a square")})[:47]
    '<div class="stills"><div class="still"><p>4 par'
    """
    cells = (f'<div class="still"><p>{escape(says)}</p>{shown.html}</div>' for says, shown in stills.items())
    return f'<div class="stills">{"".join(cells)}</div>'


def _view(widget: Any) -> dict[str, Any]:
    return {"version_major": 2, "version_minor": 0, "model_id": widget.model_id}


def explore(draw: Callable[..., ShownPosition], **sliders: Slider) -> Exploration:
    """Sliders, and the drawing that follows them.

    draw : makes the picture; its keyword arguments are the values of the sliders

    >>> from graphcam.notebooks.construction_stages import Picture
    >>> parts = Slider("parts", range(4, 25, 4), 12, shown=(4, 12))
    >>> shown = explore(lambda n: Picture("<svg/>", f"{n} parts"), n=parts)
    >>> shown.html.count("<img"), 'alt="4 parts"' in shown.html
    (2, True)
    """
    return Exploration(draw, sliders)


AnyTask = TypeVar("AnyTask")


def changed(task: AnyTask, values: Mapping[str, Any]) -> AnyTask:
    """The task with other values, named as in its file: "drawing.divisions", "follower.offset", "rotation".

    >>> import graphcam as gc
    >>> changed(gc.builtin_task(), {"follower.offset": 12.0, "rotation": "ccw"}).follower.offset
    12.0

    Raises
    ------
    DesignError : the task has no such key, or the value is impossible
    """
    for name, value in values.items():
        task = _replaced(task, name, name.split("."), value)
    return task


def _replaced(table: Any, name: str, path: list[str], value: Any) -> Any:
    known = [field.name for field in dataclasses.fields(table) if field.init]
    if path[0] not in known:
        raise DesignError("key", name, say("one of the task"), nearest_word_remedy(path[0], known))
    if path[1:]:
        value = _replaced(getattr(table, path[0]), name, path[1:], value)
    return dataclasses.replace(table, **{path[0]: value})


def _rises_first(task: Task) -> bool:
    first = next(phase for phase in task.motion().phases if isinstance(phase, MovingPhase))
    return task.motion.phases is not None and isinstance(first, Rise)


def _has_sound_roller(task: Task) -> bool:
    cam = solve(task).cam
    return 0 < cam.roller_radius < cam.extremes().min_convex_radius.value


def lesson_task(file: Path | str, *followers: str, by_laws: bool = False, roller: bool = False) -> Task:
    """The task of a lesson; where it is not what the lesson needs, the built-in cam by another law: a line says so.

    followers : the kinds of which one is needed, of none any
    by_laws, roller : whether a motion by laws is needed that rises first, and a roller that does not undercut
    """
    task = load_task(file)
    if (
        isinstance(task, Task)
        and not task.motion.gives_cam  # a lesson seeks the radius that such a cam has
        and (not followers or task.follower.kind in followers)
        and (not by_laws or _rises_first(task))
        and (not roller or _has_sound_roller(task))
    ):
        return task
    needed = say(
        "This lesson needs another follower, a motion by laws that rises first, a cam that is sought and not given, or "
        "a roller that does not undercut: it goes on with the built-in cam."
    )
    from IPython.display import Markdown, display

    display(Markdown(f"> {task.drawing.tell(needed)}"))
    cam = builtin_task()
    by_law = [changed(phase, {"law": "3-4-5"}) if phase.kind != "dwell" else phase for phase in cam.motion.phases or ()]
    return changed(cam, {"motion.phases": tuple(by_law)})

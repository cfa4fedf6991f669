"""What the page asks for, checked: senseless values become an error that names the field."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError
from graphcam.language import language
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import task_from
from graphcam.words import bare_caption, say

MAX_DIVISIONS, MAX_PHASES, MAX_ROWS, MAX_POINTS = 200, 36, 2000, 60
"""Maximum sizes of a task in the studio: more take too long to be drawn while a size is moved."""
MAX_VIEWS = 20
"""The maximum number of views in one request."""
MIN_LETTERED_SCALE = 0.8
"""A view shown smaller than this has no labels [px per mm]: it is a small picture, to be recognised and not read."""
MAX_PENCIL_ERROR = 1.0
"""Standard deviation of a line [mm]: with more nothing can be read."""
LETTER_PX = 10.0, 8.0, 40.0
"""The least height of letters on the screen [px]: usual, at least, at most."""
MAX_PX_PER_MM = 40.0
"""Pixels per mm at most."""

Data = Mapping[str, Any]
"""Plain data, as JSON has them."""


@dataclass(frozen=True)
class AskedView:
    """A view that is to be drawn.

    px_per_mm : how large it is shown
    letter_px : no letter is smaller
    lettered : whether letters of that height were asked for
    plain : whether its axes, results and limits are drawn alone, without the construction
    have : hashes of the steps that the page has already, by their identifiers
    """

    name: str
    px_per_mm: float
    letter_px: float
    lettered: bool
    plain: bool
    have: Mapping[str, str]

    @property
    def labelled(self) -> bool:
        """Whether it is large enough for labels, or has letters of a size that was asked for."""
        return self.plain or self.lettered or self.px_per_mm >= MIN_LETTERED_SCALE


@dataclass(frozen=True, eq=False)
class ViewsRequest:
    """What is asked of the views of a task.

    task : as plain data
    told, values, warnings, form, mechanism : what is wanted besides the drawing
    hold : plain data of an earlier answer, while the hand is down
    drag : plain data of a handle that is dragged
    phi : cam angle [degrees];  station : that the velocity plan shows
    upto : the last construction that is shown
    """

    task: dict[str, Any]
    views: tuple[AskedView, ...]
    language: str
    told: bool
    values: bool
    warnings: bool
    form: bool
    mechanism: bool
    hold: Data | None
    drag: Data | None
    phi: float
    station: int | None
    upto: str | None


def views_request(data: Data) -> ViewsRequest:
    """The request in plain data; unknown keys are ignored.

    Raises
    ------
    DesignError : a value of the wrong kind, or beyond the limits
    """
    wanted = {name: flag(data, name) for name in ("told", "values", "warnings", "form", "mechanism")}
    views = optional_value(data, "views", list, [])
    if len(views) > MAX_VIEWS:
        raise DesignError("views", len(views), say("at most {most} in a request", most=MAX_VIEWS))
    spoken = optional_value(data, "language", str, "en")
    language(spoken)
    return ViewsRequest(
        task=task_data(data),
        views=tuple(_asked_view(view) for view in views),
        language=spoken,
        **wanted,
        hold=optional_value(data, "hold", dict, None),
        drag=optional_value(data, "drag", dict, None),
        phi=number(data, "phi", 0.0, -360.0, 720.0),
        station=optional_whole_number(data, "station", None, 0, 10_000),
        upto=optional_value(data, "upto", str, None),
    )


def task_data(data: Data) -> dict[str, Any]:
    """The plain data of a request's task.

    Raises
    ------
    DesignError : there is none
    """
    if not isinstance(task := data.get("task"), dict) or not task:
        limit = say("a table with a task")
        raise DesignError("task", say("missing") if task is None else bare_caption(type(task).__name__), limit)
    return task


def pencil_in(data: Data) -> Pencil:
    """The hand that draws, by the error that a task's plain data give it under "pencil" [mm].

    >>> pencil_in({"pencil": 0.2}).line, pencil_in({}).perfect
    (0.2, True)
    """
    return Pencil.of(number(data, "pencil", 0.0, 0.0, MAX_PENCIL_ERROR))


def task_in(data: dict[str, Any], spoken: str = "en") -> Task | ArcsTask:
    """The task of plain data, no larger than the studio draws, its texts in a language; "pencil" is no part of it.

    Raises
    ------
    GraphcamError : it is none, or too large

    >>> import graphcam as gc
    >>> task_in({**gc.builtin_task().to_dict(), "drawing": {"divisions": 500}})
    Traceback (most recent call last):
    graphcam.errors.DesignError: drawing.divisions is 500, but must be at most 200 in the studio
    """
    _check_size(data)
    drawing = data.get("drawing", {})
    said = {**data, "drawing": {**drawing, "language": spoken} if isinstance(drawing, dict) else drawing}
    said.pop("pencil", None)
    return task_from(said)


def _check_size(data: Data) -> None:
    """Check, before anything is made of a task, that it is not too large."""
    motion, drawing = (part if isinstance(part := data.get(name), dict) else {} for name in ("motion", "drawing"))
    table = part if isinstance(part := motion.get("table"), dict) else {}
    divisions = drawing.get("divisions")
    sizes = {
        "drawing.divisions": (divisions if isinstance(divisions, int) else 0, MAX_DIVISIONS),
        "motion.phases": (_length(motion.get("phases")), MAX_PHASES),
        "motion.parts": (
            sum(map(_point_count, parts)) if isinstance(parts := motion.get("parts"), list) else 0,
            MAX_POINTS,
        ),
        "motion.table.rows": (_length(table.get("rows")), MAX_ROWS),
    }
    for name, (size, most) in sizes.items():
        if size > most:
            raise DesignError(name, size, say("at most {most} in the studio", most=most))


def _point_count(part: Any) -> int:
    """The number of points of a part by conditions, at least 1; 1 for what is no such part."""
    return max(1, _length(part.get("points"))) if isinstance(part, dict) else 1


def _length(value: Any) -> int:
    return len(value) if isinstance(value, list) else 0


def _asked_view(view: Any) -> AskedView:
    if not isinstance(view, dict):
        raise DesignError("views", type(view).__name__, say("tables with a name"))
    have = optional_value(view, "have", dict, {})
    name = optional_value(view, "name", str, None)
    if name is None:
        raise DesignError("views.name", say("missing"), say("given"))
    px_per_mm, letter_px = number(view, "px_per_mm", 2.0, 0.0, MAX_PX_PER_MM), number(view, "letter_px", *LETTER_PX)
    return AskedView(
        name, px_per_mm, letter_px, "letter_px" in view, flag(view, "plain"), {str(key): str(have[key]) for key in have}
    )


def flag(data: Data, name: str) -> bool:
    """Whether something is wanted."""
    return optional_value(data, name, bool, False)


def optional_value(data: Data, name: str, kind: type, otherwise: Any) -> Any:
    """A value of a kind, or another one where it is left out or null.

    Raises
    ------
    DesignError : it is of another kind

    >>> optional_value({"told": True}, "told", bool, False), optional_value({}, "told", bool, False)
    (True, False)
    """
    value = data.get(name)
    if value is None:
        return otherwise
    if not isinstance(value, kind):
        raise DesignError(name, _shown_value(value), say("{kinds} or left out", kinds=KIND_NAMES[kind]))
    return value


KIND_NAMES = {bool: "true or false", str: "text", list: "a list", dict: "a table"}
"""What the kinds of plain data are called."""


def number(data: Data, name: str, otherwise: float, low: float, high: float) -> float:
    """A number within limits.

    Raises
    ------
    DesignError : it is none, or beyond them
    """
    value = data.get(name)
    if value is None:
        return otherwise
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise DesignError(name, _shown_value(value), say("a number"))
    if not low <= value <= high:
        raise DesignError(name, _shown_value(value), say("from {low:g} to {high:g}", low=low, high=high))
    return float(value)


def optional_whole_number(data: Data, name: str, otherwise: int | None, low: int, high: int) -> int | None:
    """A whole number within limits.

    Raises
    ------
    DesignError : it is none, or beyond them
    """
    if data.get(name) is None:
        return otherwise
    value = number(data, name, 0.0, low, high)
    if value != int(value):
        raise DesignError(name, value, say("a whole number"))
    return int(value)


def _shown_value(value: Any) -> str:
    """A value of the wrong kind, in few letters."""
    return repr(value)[:40]

"""What the page asks for, checked: senseless values become an error that names the field."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Annotated, Any, TypeVar

from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError
from graphcam.language import ENGLISH, language
from graphcam.studio.size_ranges import MAX_PHASES
from graphcam.studio.task_paths import table_in
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.dataclass_reader import Misfit, WrongType, read_dataclass
from graphcam.tasks.number_limits import Within, check_limits
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import task_from
from graphcam.words import say

MAX_DIVISIONS, MAX_ROWS, MAX_POINTS = 200, 2000, 60
"""Maximum sizes of a task in the studio: more take too long to be drawn while a size is moved."""
MAX_VIEWS = 20
"""The maximum number of views in one request."""
MIN_LETTERED_SCALE = 0.8
"""A view shown smaller than this has no labels [px per mm]: it is a small picture, to be recognised and not read."""
MAX_PENCIL_ERROR = 1.0
"""Standard deviation of a line [mm]: with more nothing can be read."""
MIN_LETTER_PX, USUAL_LETTER_PX = 8.0, 10.0
"""The least height of letters on the screen [px]."""
MAX_PX_PER_MM = 40.0
"""Pixels per mm at most, and of a letter."""

Data = Mapping[str, Any]
"""Plain data, as JSON has them."""
Asked = TypeVar("Asked")


def read_request(kind: type[Asked], data: Data) -> Asked:
    """What a request asks for, as its class declares it; keys that this lacks are passed over, null is left out.

    Raises
    ------
    DesignError : a value of the wrong kind, or beyond the limits; it names the key

    >>> read_request(AskedView, {"name": "plan", "px_per_mm": 3, "colour": "red"}).px_per_mm
    3.0
    """
    found = read_dataclass(kind, known_keys(kind, data))
    if not isinstance(found, list):
        return found
    fault = found[0]
    if isinstance(fault, Misfit):
        raise fault.error
    name = ".".join(step for step in fault.place if isinstance(step, str))
    if isinstance(fault, WrongType):
        value: Any = data
        for step in fault.place:
            value = value[step]
        raise DesignError(name, repr(value)[:40], fault.expected)
    raise DesignError(name, say("missing"), say("given"))


def known_keys(kind: type, data: Any) -> Any:
    """A table without null and the keys that a class lacks; anything else as it is."""
    keys = {each.metadata.get("alias", each.name) for each in fields(kind)}
    return {key: data[key] for key in data if key in keys and data[key] is not None} if isinstance(data, dict) else data


@dataclass(frozen=True, eq=False)
class AskedView:
    """A view that is to be drawn.

    px_per_mm : how large it is shown
    letter_px : no letter is smaller; None where no height was asked for
    plain : whether its axes, results and limits are drawn alone, without the construction
    have : hashes of the steps that the page has already, by their identifiers
    """

    name: str
    px_per_mm: Annotated[float, Within(0.0, MAX_PX_PER_MM)] = 2.0
    letter_px: Annotated[float, Within(MIN_LETTER_PX, MAX_PX_PER_MM)] | None = None
    plain: bool = False
    have: Mapping[str, str] = field(default_factory=dict[str, str])

    def __post_init__(self) -> None:
        """Check the limits of its numbers."""
        check_limits(self)

    @property
    def labelled(self) -> bool:
        """Whether it is large enough for labels, or has letters of a size that was asked for."""
        return self.plain or self.letter_px is not None or self.px_per_mm >= MIN_LETTERED_SCALE


@dataclass(frozen=True, eq=False, kw_only=True)
class TaskRequest:
    """What is asked of a task, in plain data, and the language of the answer."""

    task: dict[str, Any]
    language: str = ENGLISH.name

    def __post_init__(self) -> None:
        """Check the limits of its numbers, and that there is such a language."""
        check_limits(self)
        language(self.language)


@dataclass(frozen=True, eq=False, kw_only=True)
class ViewsRequest(TaskRequest):
    """What is asked of the views of a task.

    told, values, warnings, form, mechanism : what is wanted besides the drawing
    hold : plain data of an earlier answer, while the hand is down
    drag : plain data of a handle that is dragged
    phi : cam angle [degrees];  station : that the velocity plan shows
    upto : the last construction that is shown
    """

    views: tuple[AskedView, ...] = ()
    told: bool = False
    values: bool = False
    warnings: bool = False
    form: bool = False
    mechanism: bool = False
    hold: dict[str, Any] | None = None
    drag: dict[str, Any] | None = None
    phi: Annotated[float, Within(-360.0, 720.0)] = 0.0
    station: Annotated[int, Within(0, 10_000)] | None = None
    upto: str | None = None

    def __post_init__(self) -> None:
        """Check that so many views are drawn in one answer."""
        super().__post_init__()
        if len(self.views) > MAX_VIEWS:
            raise DesignError("views", len(self.views), say("at most {most} in a request", most=MAX_VIEWS))


def views_request(data: Data) -> ViewsRequest:
    """The request in plain data; unknown keys are ignored.

    Raises
    ------
    DesignError : a value of the wrong kind, or beyond the limits
    """
    if isinstance(views := data.get("views"), list):
        data = {**data, "views": [known_keys(AskedView, view) for view in views]}
    return read_request(ViewsRequest, data)


@dataclass(frozen=True, eq=False)
class _HandData:
    """The hand that draws: the standard deviation of its lines [mm]."""

    pencil: Annotated[float, Within(0.0, MAX_PENCIL_ERROR)] = 0.0

    def __post_init__(self) -> None:
        """Check that something can be read of what it draws."""
        check_limits(self)


def pencil_in(data: Data) -> Pencil:
    """The hand that draws, by the error that a task's plain data give it under "pencil" [mm].

    >>> pencil_in({"pencil": 0.2}).line, pencil_in({}).perfect
    (0.2, True)
    """
    return Pencil.of(read_request(_HandData, data).pencil)


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
    motion, divisions = table_in(data, "motion"), table_in(data, "drawing").get("divisions")
    points = [
        len(_listed(part.get("points"))) if isinstance(part, dict) else 0 for part in _listed(motion.get("parts"))
    ]
    sizes = {
        "drawing.divisions": (divisions if isinstance(divisions, int) else 0, MAX_DIVISIONS),
        "motion.phases": (len(_listed(motion.get("phases"))), MAX_PHASES),
        "motion.parts": (sum(max(1, count) for count in points), MAX_POINTS),
        "motion.table.rows": (len(_listed(table_in(motion, "table").get("rows"))), MAX_ROWS),
    }
    for name, (size, most) in sizes.items():
        if size > most:
            raise DesignError(name, size, say("at most {most} in the studio", most=most))


def _listed(value: Any) -> list[Any]:
    """A list, empty in place of what is none."""
    return value if isinstance(value, list) else []

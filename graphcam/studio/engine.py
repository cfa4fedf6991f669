"""The engine of the studio: one function from plain data to plain data, the same on a server and in WebAssembly."""

import re
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

from graphcam.errors import DesignError, GraphcamError, TaskError, choice_limit
from graphcam.language import ENGLISH, Language, language, languages
from graphcam.studio.task_paths import PATH_PATTERN, steps_of, table_in, value_at
from graphcam.tasks.file_faults import EXAMPLE_REMEDY, path_of_key
from graphcam.tasks.task import table_of
from graphcam.words import message

Plain = dict[str, Any]
REQUEST_FUNCTIONS: Mapping[str, str] = {
    "views": "graphcam.studio.views_answer.views_answer",
    "predict": "graphcam.studio.predictions.prediction_answer",
    "tours": "graphcam.studio.tours.tours_answer",
    "exercise": "graphcam.studio.exercise_checks.exercise_answer",
    "sample_exercise": "graphcam.studio.sample_exercise.sample_exercise",
    "task_file": "graphcam.studio.task_text.task_file",
    "open": "graphcam.studio.task_text.opened_task",
    "sweep": "graphcam.studio.what_if.sweep_answer",
}
"""The functions that answer requests; the module is loaded when it is first asked."""


FIELDS_BY_QUANTITY: Mapping[str, str] = {
    "roller radius by the rule": "follower.roller_rule",
    "minimum prime radius": "cam.prime_radius",
    "undercut": "cam.prime_radius",
    "curvature": "limits.min_curvature_radius",
    "maximum displacement on paper": "drawing.ordinate",
    "angular velocity of the face": "motion.phases",
    **dict.fromkeys(("pencil", "pencil line"), "pencil"),
    "C1": "arcs.rho1",
    "rise, dwell and return": "arcs.dwell",
    **dict.fromkeys(("rise", "root", "three-arc cam", "pressure angle"), "arcs.G[0]"),
    **{f"angle of the arc {arc}": "arcs.G[0]" for arc in ("AG", "GF", "FD")},
}
"""The field of a quantity of a solution that is no key of the task; of several sizes the one that its remedy names."""
TABLES = "motion", "follower", "cam", "limits", "spring", "material", "tolerances", "drawing", "arcs", "title", "part"
"""The tables of a task file: what begins so is a place of it."""
ADDITION_PATTERN = re.compile(r" \(.*\)$")
"""What a message adds to a place in words, such as "(sum of the angles)"."""


def field_of(error: GraphcamError, task: Mapping[str, Any]) -> str:
    """The path of the field beside which an error is shown; empty where it belongs to none.

    task : plain data, whose follower decides what an open least radius asks for

    >>> field_of(DesignError("prime radius", -3, "greater than 0 mm"), {})
    'cam.prime_radius'
    >>> field_of(TaskError("task", "motion.phases (sum of the angles)", 350, "360 degrees"), {})
    'motion.phases'
    >>> field_of(DesignError("colour", "red", "blue"), {})
    ''
    """
    if isinstance(error, TaskError):
        return _place(error.field)
    if not isinstance(error, DesignError):
        return ""
    field = FIELDS_BY_QUANTITY.get(error.quantity) or _place(error.quantity)
    if error.quantity == "minimum prime radius" and value_at(task, "cam.prime_radius") is not None:
        return "follower.distance" if "distance" in table_of(task.get("follower", {})).made_to else "follower.offset"
    if field == "motion.phases" and value_at(task, "motion.table") is not None:
        return "motion.table"
    return field


def _place(words: str) -> str:
    """The place of the task file that words are, or whose key they are."""
    path = ADDITION_PATTERN.sub("", words)
    if PATH_PATTERN.fullmatch(path) and steps_of(path)[0] in TABLES:
        return path
    return path_of_key(path)


def answer(request: Mapping[str, Any]) -> Plain:
    """The answer to a request, plain data both ways; an error is an answer too.

    >>> import graphcam as gc
    >>> task = gc.builtin_task().to_dict()
    >>> found = answer({"seq": 1, "task": task, "views": [{"name": "combined", "px_per_mm": 2.0}]})
    >>> found["views"][0]["order"][-1], found["sizes"]["prime_radius"]
    ('pressure_angle/the-pressure-angle-at-every-station', 44.0)
    >>> task["follower"]["offset"] = "left"
    >>> answer({"seq": 2, "task": task})["error"]["field"]
    'follower.offset'
    """
    seq = number if isinstance(number := request.get("seq"), int) else None
    try:
        return {"seq": seq, "ok": True, **_function(request.get("ask") or "views")(request)}
    except GraphcamError as error:
        told = error_data(error, spoken_in(request))
        return {"seq": seq, "ok": False, "error": {**told, "field": _field(error, request)}}


def _field(error: GraphcamError, request: Mapping[str, Any]) -> str:
    """The field of the form, or the key of the request, that an error is about."""
    quantity = getattr(error, "quantity", "")
    if quantity in request:
        return quantity
    return field_of(error, table_in(request, "task")) or (quantity if PATH_PATTERN.fullmatch(quantity) else "")


def _function(ask: Any) -> Callable[[Mapping[str, Any]], Plain]:
    if not isinstance(ask, str) or ask not in REQUEST_FUNCTIONS:
        raise DesignError("ask", str(ask), *choice_limit(ask, REQUEST_FUNCTIONS))
    module, _, name = REQUEST_FUNCTIONS[ask].rpartition(".")
    return getattr(import_module(module), name)


def spoken_in(request: Mapping[str, Any]) -> Language:
    """The language that a request names; English where there is none of that name."""
    name = request.get("language")
    return language(name) if name in languages() else ENGLISH


def error_data(error: GraphcamError, spoken: Language) -> Plain:
    """An error as plain data: what is wrong, and apart from it what to do about it."""
    fault, advice = (spoken.text(message(words)) for words in (error.fault, error.advice))
    # The page has no files: what the message says of one is left out.
    path = f"{error.path}: " if isinstance(error, TaskError) else ""
    remedy = "" if error.advice == EXAMPLE_REMEDY else named_fields(advice, spoken)
    fault = fault.removeprefix(path)
    if isinstance(error, TaskError) and (phase := PHASE_NUMBER.match(error.field)):
        fault = _with_name(fault, error.field[phase.end() :], spoken)
    return {"message": named_fields(fault, spoken), "remedy": remedy}


def _with_name(fault: str, key: str, spoken: Language) -> str:
    """A message about a phase with the name of its field where it has the key."""
    from graphcam.studio.form_fields import PHASE_NAMES

    def named(found: re.Match[str]) -> str:
        name = spoken.text(PHASE_NAMES[key])
        return name if found.start() == 0 else name[0].lower() + name[1:]

    return re.sub(rf"(?<![\w.]){key}(?!\w)", named, fault, count=1) if key in PHASE_NAMES else fault


PHASE_NUMBER = re.compile(r"^motion\.phases\[\d+\]\.")
"""What stands before the key of a phase's number."""


def named_fields(text: str, spoken: Language) -> str:
    """A text with the names of the form's fields where it has their keys.

    >>> named_fields("follower.offset is -50, but must be less than 44; enlarge cam.prime_radius", ENGLISH)
    'Offset e is -50, but must be less than 44; enlarge Prime radius r₀'
    >>> named_fields("motion.phases[0].lift is -5", ENGLISH)
    'Lift is -5'
    """
    from graphcam.studio.form_fields import form_names

    names = form_names()

    def named(found: re.Match[str]) -> str:
        # A word of one part, such as "pencil", is a key only where the sentence is about it.
        key = PHASE_NUMBER.sub("motion.phases.", found[0])
        is_key = key in names and ("." in key or found.start() == 0)
        return spoken.text(names[key]) if is_key else found[0]

    return PATH_PATTERN.sub(named, text)

"""The engine of the studio: one function from plain data to plain data, the same on a server and in WebAssembly."""

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

from graphcam.errors import DesignError, GraphcamError, TaskError, among
from graphcam.language import ENGLISH, Language, language, languages
from graphcam.studio.error_fields import field_of
from graphcam.studio.task_paths import PATH
from graphcam.tasks.task_file import EXAMPLE
from graphcam.words import message

Plain = dict[str, Any]
ASKS: Mapping[str, str] = {
    "views": "graphcam.studio.views_answer.views_answer",
    "predict": "graphcam.studio.predictions.predicted",
    "tours": "graphcam.studio.tours.told_tours",
    "exercise": "graphcam.studio.exercise_checks.checked",
    "task_file": "graphcam.studio.task_text.task_file",
    "open": "graphcam.studio.task_text.opened",
    "sweep": "graphcam.studio.what_if.sweep_answer",
}
"""The functions that answer requests; the module is loaded when it is first asked."""


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
        told = told_error(error, spoken_in(request))
        return {"seq": seq, "ok": False, "error": {**told, "field": _field(error, request)}}


def _field(error: GraphcamError, request: Mapping[str, Any]) -> str:
    """The field of the form, or the key of the request, that an error is about."""
    task = given if isinstance(given := request.get("task"), dict) else {}
    quantity = getattr(error, "quantity", "")
    return field_of(error, task) or (quantity if PATH.fullmatch(quantity) else "")


def _function(ask: Any) -> Callable[[Mapping[str, Any]], Plain]:
    if not isinstance(ask, str) or ask not in ASKS:
        raise DesignError("ask", str(ask), *among(ask, ASKS))
    module, _, name = ASKS[ask].rpartition(".")
    return getattr(import_module(module), name)


def spoken_in(request: Mapping[str, Any]) -> Language:
    """The language that a request names; English where there is none of that name."""
    name = request.get("language")
    return language(name) if name in languages() else ENGLISH


def told_error(error: GraphcamError, spoken: Language) -> Plain:
    """An error as plain data: what is wrong, and apart from it what to do about it."""
    fault, advice = (spoken.text(message(words)) for words in (error.fault, error.advice))
    # The page has no files: what the message says of one is left out.
    path = f"{error.path}: " if isinstance(error, TaskError) else ""
    return {"message": fault.removeprefix(path), "remedy": "" if error.advice == EXAMPLE else advice}

"""Exercise files: TOML in, an exercise out, or one error that says which field is wrong."""

from __future__ import annotations

import dataclasses
import functools
import json
import tomllib
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphcam.errors import DesignError, TaskError, nearest
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.texts import in_language
from graphcam.language import ENGLISH

if TYPE_CHECKING:
    from pydantic import TypeAdapter

HOW_TO = "see exercises/README.md"
NO_KEYS = {"name", "language"}
"""What an exercise has and its file does not say."""
_EXPECTED = {
    "missing": "given",
    "float_type": "a number",
    "int_type": "a whole number",
    "finite_number": "a finite number",
    "string_type": "text in quotes",
    "tuple_type": "a list",
    "dict_type": "a table",
    "dataclass_type": "a table",
}


class _Word(str):
    """Shown without the quotes of a value."""

    __slots__ = ()
    __repr__ = str.__str__


def library() -> tuple[str, ...]:
    """The names of the exercises that come with graphcam.

    >>> "acceleration-and-scales" in library()
    True
    """
    return tuple(sorted(path.stem for path in _folder().glob("*.toml")))


def find_exercise(name: str, language: str = ENGLISH.name) -> Exercise:
    """An exercise by its name in the library, or by the path of its file; its texts in a language.

    Raises
    ------
    TaskError : there is none of that name, or its file is wrong
    """
    return load_exercise(exercise_path(name), language)


def exercise_path(name: str) -> Path:
    """The file of an exercise of the library by its name; or the path itself.

    Raises
    ------
    TaskError : the library has none of that name

    >>> exercise_path("integration").name, exercise_path("mine/cam.toml").name
    ('integration.toml', 'cam.toml')
    """
    if name.endswith(".toml") or "/" in name:
        return Path(name)
    if name not in library():
        known = "one that 'graphcam exercise list' names"
        raise TaskError(name, "the exercise", _Word("not there"), known, nearest(name, library()))
    return _folder() / f"{name}.toml"


def load_exercise(path: str | Path, language: str = ENGLISH.name) -> Exercise:
    """The exercise in a TOML file, its texts in a language.

    Raises
    ------
    TaskError : there is no such file, it is not TOML, or a field is missing, unknown or wrong
    """
    path = Path(path)
    try:
        data = tomllib.loads(path.read_bytes().decode("utf-8-sig"))
    except OSError as error:
        why = _Word(f"not readable ({error.strerror})")
        raise TaskError(str(path), "the exercise file", why, "a TOML file", "check the name") from None
    except (ValueError, RecursionError) as error:
        raise TaskError(str(path), "the text", _Word(f"not TOML ({error})"), "a TOML file", HOW_TO) from None
    if "motion" in data and "task" not in data:
        remedy = "begin with a copy of one that 'graphcam exercise list' names"
        expected = "an exercise, which has the task in its table [task]"
        raise TaskError(str(path), "the file", _Word("a task"), expected, remedy)
    for key in NO_KEYS & data.keys():
        raise TaskError(str(path), key, _Word("an unknown key"), "one that is known", HOW_TO)
    told = in_language(str(path), data, language)
    exercise = dataclasses.replace(_exercise(str(path), told), name=path.stem, language=language)
    _check(str(path), exercise)
    return exercise


def _folder() -> Path:
    """Where the library lies: installed beside the code, in a checkout at the top level."""
    installed = Path(str(resources.files("graphcam").joinpath("exercises", "library")))
    return installed if installed.is_dir() else Path(__file__).parents[3] / "exercises"


def _exercise(path: str, data: dict[str, Any]) -> Exercise:
    from pydantic import ValidationError

    try:
        return _reader().validate_json(json.dumps(data, default=str))
    except ValidationError as error:
        detail = error.errors(include_url=False)[0]
    field = ".".join(str(step) for step in detail["loc"]) or "the exercise"
    cause = detail.get("ctx", {}).get("error")
    if isinstance(cause, DesignError):
        raise TaskError(path, f"{field}.{cause.quantity}", cause.value, cause.limit, cause.remedy or HOW_TO)
    kind = detail["type"]
    if kind == "unexpected_keyword_argument":
        raise TaskError(path, field, _Word("an unknown key"), "one that is known", HOW_TO)
    found = _Word("missing") if kind == "missing" else detail["input"]
    raise TaskError(path, field, found, _EXPECTED.get(kind, detail["msg"]), HOW_TO)


@functools.cache
def _reader() -> TypeAdapter[Exercise]:
    from pydantic import TypeAdapter

    return TypeAdapter(Exercise)


def _check(path: str, exercise: Exercise) -> None:
    """What only a drawing shows: that the task, every answer and every mistake can be drawn."""
    from graphcam.exercises.definition.drawn_answers import ask, board_chain
    from graphcam.exercises.definition.misconceptions import misconception
    from graphcam.exercises.definition.template import fill_in

    for name in exercise.misconceptions:
        try:
            misconception(name)
        except DesignError as error:
            raise TaskError(path, "misconceptions", name, error.limit, error.remedy) from None
    task = fill_in(exercise, {name: parameter.values[0] for name, parameter in exercise.parameters.items()}, path)
    chain = board_chain(task)
    for k, asked in enumerate(exercise.answers):
        try:
            ask(chain, asked)
        except DesignError as error:
            place = f"answers[{k}].{error.quantity}"
            raise TaskError(path, place, error.value, error.limit, error.remedy or HOW_TO) from None

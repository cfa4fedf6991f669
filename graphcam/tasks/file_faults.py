"""Faults of a file's tables, told in the words of the file: place and line, value as written, limit and remedy."""

import dataclasses
import re
from collections.abc import Mapping
from typing import Any

from graphcam.errors import DesignError, TaskError
from graphcam.tasks import task as tables
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.dataclass_reader import (
    Classes,
    Fault,
    Misfit,
    MissingKey,
    Place,
    UnknownKey,
    UnknownKind,
    WrongType,
    classes_of,
)
from graphcam.tasks.declared_numbers import declared
from graphcam.tasks.task import Task
from graphcam.tasks.task_remedies import key_remedy, missing_remedy, value_remedy
from graphcam.words import Caption, Words, and_chain, bare_caption, say

EXAMPLE_REMEDY = say("'graphcam init FILE' writes a commented example")
_KEYS_BY_QUANTITY = {
    "sum of the phase angles": "phases",
    "sum of rises less returns": "phases",
    "motion": "phases",
    "centre distance": "distance",
    "permitted pressure angle on the rise": "pressure_angle_rise",
    "permitted pressure angle on the return": "pressure_angle_return",
    "minimum radius of curvature": "min_curvature_radius",
    "the table's lift": "table",
}
"""Keys of the file by the quantity of a design error, where the two differ by more than underscores."""
_LISTS = "phases", "parts"
"""The lists of tables in a file; an error about one of their keys from outside is shown beside the whole list."""
_MAX_SHOWN_LENGTH = 60
"""The maximum number of characters of a value in a message."""
_STEP_PATTERN = re.compile(r"[^.\[\] ]+|\[\d+\]")
_ENTRY_PATTERN = re.compile(r"^(?:\w+\.)?(phases|parts)\[(\d+)\](?:\.points\[(\d+)\])?\.?")
_ENTRY_NAMES = {"phases": say("phase {number}"), "parts": say("part {number}")}


def line_in(lines: Mapping[Place, int], named: str) -> int | None:
    """The line of a place by its written form, or of the innermost table around it that the file has."""
    steps = (step for step in _STEP_PATTERN.findall(named.partition(" (")[0]))
    place = tuple(int(step[1:-1]) if step[0] == "[" else step for step in steps)
    return next((lines[place[:k]] for k in range(len(place), 0, -1) if place[:k] in lines), None)


def place_words(named: Words, line: int | None) -> Words:
    """How a message tells a place: phases and parts are counted from 1, and the line is named."""
    if isinstance(named, str) and (entry := _ENTRY_PATTERN.match(named)):
        where: Words = _ENTRY_NAMES[entry[1]].with_values(number=int(entry[2]) + 1)
        if entry[3]:
            where = say("point {number} of {part}", number=int(entry[3]) + 1, part=where)
        key = named[entry.end() :]
        named = say("{key} of {entry}", key=key, entry=where) if key else where
    return say("line {line}: {place}", line=line, place=named) if line else named


def fault_error(path: str, data: dict[str, Any], classes: Classes, fault: Fault) -> TaskError:
    """The error for a fault that was found where a dataclass was read from the tables of a file."""
    place, value = _look_up(data, fault.place)
    match fault:
        case Misfit(table, error):
            return _misfit(path, data, table, error)
        case MissingKey((("spring" | "material"), *_)):
            return _missing_keys_error(path, place, data)
        case MissingKey():
            return TaskError(path, place, say("missing"), say("given"), missing_remedy(place, data) or EXAMPLE_REMEDY)
        case UnknownKey(where):
            return _unknown_key(path, place, value, classes, _table(where[:-1]), data)
        case UnknownKind(table):
            tags = [each[-1] for each in classes if each[:-1] == _table(table)]
            found = value.get("kind", say("missing"))
            remedy = value_remedy("kind", found, tags) or EXAMPLE_REMEDY
            return TaskError(
                path, f"{place}.kind", shown_value(found), say("one of {names}", names=", ".join(tags)), remedy
            )
        case WrongType((*where, key), expected, choices, known):
            needed = key in _needed_keys(classes.get(_table(tuple(where))))
            remedy = known or value_remedy("" if needed else f"{key}", value, choices) or EXAMPLE_REMEDY
            return TaskError(path, place, shown_value(value), expected, remedy)
        case WrongType(_, expected):
            return TaskError(path, place, shown_value(value), expected, EXAMPLE_REMEDY)


def _missing_keys_error(path: str, place: str, data: dict[str, Any]) -> TaskError:
    """The error for a missing key of a spring or a material, which names all others missing beside it."""
    remedy = EXAMPLE_REMEDY
    if place == "spring.mass" and _swings(data):
        place = "spring.inertia"
        remedy = say("in kg mm^2, about the arm's pivot")
    others = ", ".join(key for key in _missing_keys(data) if key != place)
    limit = say("given, and so must {others}", others=others) if others else say("given")
    return TaskError(path, place, say("missing"), limit, remedy)


def _missing_keys(data: dict[str, Any]) -> list[str]:
    """The missing keys of a material, which needs a spring, and of the spring, which needs a speed."""
    material, spring = data.get("material"), data.get("spring", {})
    found = ["material.width"] if isinstance(material, dict) and "width" not in material else []
    if isinstance(spring, dict):
        # A mass for an arm, or an inertia for another follower, is told by itself.
        found += [] if {"mass", "inertia"} & spring.keys() else [f"spring.{'inertia' if _swings(data) else 'mass'}"]
        found += [] if "stiffness" in spring else ["spring.stiffness"]
    return found if "speed_rpm" in data else [*found, "speed_rpm"]


def _swings(data: dict[str, Any]) -> bool:
    """Whether a file's follower turns about a pivot, and has a moment of inertia in place of a mass."""
    follower = data.get("follower")
    return isinstance(follower, dict) and tables.table_of(follower).swings


def _unknown_key(
    path: str, place: str, value: Any, classes: Classes, table: tuple[str, ...], data: dict[str, Any]
) -> TaskError:
    """The error for a key that its table does not have, or that only a table of another kind has."""
    key, known = place.split(".")[-1], _keys(classes[table])
    alike = [other for other in classes if table[:-1] and other[:-1] == table[:-1]]
    kinds = [other[-1] for other in alike if key in _keys(classes[other])]
    if kinds:
        left_out = say("left out where the kind is {table}", table=table[-1])
        return TaskError(path, place, shown_value(value), left_out, say("it is for {names}", names=and_chain(kinds)))
    remedy = key_remedy(key, value, known, data)
    return TaskError(path, place, say("an unknown key"), say("a key of this table"), remedy)


def _needed_keys(table: type | None) -> list[str]:
    """The keys without which a table of a file is not whole."""
    own = () if table is None else dataclasses.fields(table)
    return [field.name for field in own if field.default is field.default_factory is dataclasses.MISSING]


def _keys(table: type) -> list[str]:
    """The keys of a table in a file, without those that the loader sets itself."""
    return [field.name for field in dataclasses.fields(table) if field.init]


def _misfit(path: str, data: dict[str, Any], place: Place, error: DesignError) -> TaskError:
    """The error for a value that makes no design, named and shown as in the file where it stands there."""
    key = _KEYS_BY_QUANTITY.get(error.quantity, error.quantity)
    if " " in key and isinstance(_look_up(data, (*place, plain := key.replace(" ", "_")))[1], int | float | str):
        key = plain
    field, value = _look_up(data, (*place, *key.split(".")))
    # What follows from a table is no value that its key has.
    if not isinstance(value, int | float | str) or error.quantity == "the table's lift":
        value = bare_caption(error.value) if isinstance(error.value, str) else error.value
    if error.quantity == "sum of the phase angles":
        field = say("{field} (sum of the angles)", field=field)
    elif error.quantity == "sum of rises less returns":
        field = say("{field} (sum of rises less returns)", field=field)
    elif error.quantity == "the table's lift":
        field = say("{field} (lift)", field=field)
    limit, others = error.args[2], ", ".join(_missing_keys(data))
    if key == "spring" and data.get("spring") is None and others:
        limit = say("given where there is a material, and so must {others}", others=others)
    # How radians are written in Python is nothing for a file, which has degrees.
    remedy = "" if "math.radians" in error.remedy else error.advice
    return TaskError(path, field, shown_value(value), limit, remedy or EXAMPLE_REMEDY)


def path_of_key(quantity: str) -> str:
    """The path in a task of the key that a quantity of a design error has, of several tables the first; empty if none.

    >>> path_of_key("roller radius"), path_of_key("lift"), path_of_key("poles[1]"), path_of_key("colour")
    ('follower.roller_radius', 'motion.phases', 'drawing.poles[1]', '')
    """
    key, bracket, index = _KEYS_BY_QUANTITY.get(quantity, quantity.replace(" ", "_")).rpartition(".")[2].partition("[")
    for place, table in (*classes_of(Task).items(), *classes_of(ArcsTask).items()):
        if key not in _keys(table):
            continue
        if place[1:2] and place[1] in _LISTS:
            return ".".join(place[:2])
        # The kind of a follower is no step in the file.
        path = ".".join((*(place[:1] if place[:1] == ("follower",) else place), key))
        first = "[0]" if f"{key}[0]" in declared(table) else ""
        return path + (bracket + index or first)
    return ""


def _look_up(data: Any, place: Place) -> tuple[str, Any]:
    """The written form of a place, such as ``motion.phases[2].angle``, and the value there (None if there is none)."""
    name = ""
    if place[:2] == ("motion", "radii") and "arcs" in data:
        place = ("arcs", *place[2:])
    if place[:1] == ("motion",) and "outline" in data:
        place = ("outline", *("file" if key == "table" else key for key in place[1:2]))
    for step in place:
        if isinstance(step, int):
            name += f"[{step}]"
            data = data[step] if isinstance(data, list) and step < len(data) else None
        elif isinstance(data, dict) and step not in data and data.get("kind") == step:
            continue  # the choice among classes, which is no step in the file
        else:
            name += f".{step}"
            data = data.get(step) if isinstance(data, dict) else None
    return name.lstrip("."), data


def _table(place: Place) -> tuple[str, ...]:
    return tuple(step for step in place if isinstance(step, str))


def shown_value(value: Any) -> Any:
    """A value as TOML writes it where Python differs; tables and lists by name, long values cut."""
    if isinstance(value, Caption):
        return value
    if isinstance(value, bool):
        return bare_caption(str(value).lower())
    if isinstance(value, dict):
        return say("a table")
    if isinstance(value, list):
        return say("a list of {count}", count=len(value))  # pyright: ignore[reportUnknownArgumentType]
    text = repr(value)
    return bare_caption(text[:_MAX_SHOWN_LENGTH] + "...") if len(text) > _MAX_SHOWN_LENGTH else value

"""Places in a task as plain data, by paths such as ``motion.phases[0].angle``."""

import copy
import re
from collections.abc import Mapping
from typing import Any

from graphcam.errors import DesignError
from graphcam.words import say

STEP_PATTERN = re.compile(r"([A-Za-z_]\w*)|\[(\d+)\]")
PATH_PATTERN = re.compile(r"[A-Za-z_]\w*(\[\d+\])*(\.[A-Za-z_]\w*(\[\d+\])*)*")
PATH_REMEDY = say("the paths are those of the task file, such as motion.phases[0].angle")


def steps_of(path: str) -> tuple[str | int, ...]:
    """The keys and numbers of a path.

    Raises
    ------
    DesignError : the text is no path

    >>> steps_of("motion.phases[0].angle")
    ('motion', 'phases', 0, 'angle')
    """
    if not PATH_PATTERN.fullmatch(path):
        raise DesignError("path", path, say("keys with points between them, and numbers in brackets"), PATH_REMEDY)
    return tuple(key or int(number) for key, number in STEP_PATTERN.findall(path))


def value_at(task: Mapping[str, Any], path: str) -> Any:
    """What stands at a path; None where there is nothing.

    >>> value_at({"drawing": {"poles": [40, 60]}}, "drawing.poles[1]")
    60
    """
    found: Any = task
    for step in steps_of(path):
        if isinstance(step, int):
            found = found[step] if isinstance(found, list | tuple) and step < len(found) else None
        else:
            found = found.get(step) if isinstance(found, Mapping) else None
    return found


def table_in(data: Mapping[str, Any], key: str) -> dict[str, Any]:
    """The table under a key, an empty one in place of what is none.

    >>> table_in({"drawing": {"divisions": 12}}, "drawing"), table_in({"drawing": 12}, "drawing")
    ({'divisions': 12}, {})
    """
    return table if isinstance(table := data.get(key), dict) else {}


def changed_task(task: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """The task with other values at some paths; None leaves a key out, and so open.  The task itself stays as it is.

    Raises
    ------
    DesignError : a path leads through what is no table, or to an entry that its list does not have

    >>> changed_task({"cam": {"prime_radius": 40.0}}, {"cam.prime_radius": None, "follower.offset": -10.0})
    {'cam': {}, 'follower': {'offset': -10.0}}
    """
    new = copy.deepcopy(dict(task))
    for path, value in changes.items():
        *way, last = steps_of(path)
        table: Any = new
        for step in way:
            _check(table, step, path)
            if isinstance(step, str) and table.get(step) is None:
                table[step] = {}
            table = table[step]
        _check(table, last, path)
        if value is None and isinstance(last, str):
            table.pop(last, None)
        else:
            table[last] = copy.deepcopy(value)
    return new


def _check(table: Any, step: str | int, path: str) -> None:
    """Check that a step leads into a table, or to an entry that a list has."""
    fits = isinstance(table, dict) if isinstance(step, str) else isinstance(table, list) and step < len(table)
    if not fits:
        raise DesignError("path", path, say("one that the task has"), PATH_REMEDY)

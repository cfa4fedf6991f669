"""What a card of a tour asks to be done: a size that reaches a value, told as ``motion.phases[0].angle >= 90``."""

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from graphcam.errors import DesignError
from graphcam.studio.task_paths import steps_of, value_at
from graphcam.words import say

GOAL = re.compile(r"\s*([\w.\[\]]+)\s*(<=|>=|==|<|>)\s*(-?\d+(?:\.\d+)?)\s*")
SAME = 1e-9
"""Numbers that differ by less are equal."""
OPERATORS: Mapping[str, Callable[[float, float], bool]] = {
    "<=": lambda size, value: size <= value + SAME,
    ">=": lambda size, value: size >= value - SAME,
    "==": lambda size, value: math.isclose(size, value, abs_tol=SAME),
    "<": lambda size, value: size < value,
    ">": lambda size, value: size > value,
}


@dataclass(frozen=True)
class Goal:
    """A size at a path of the task, or ``phi``, compared with a number.

    >>> goal_of("follower.offset >= 0").reached({"follower": {"offset": -10.0}})
    False
    >>> goal_of("phi >= 40").reached({}, phi=40.0)
    True
    """

    path: str
    operator: str
    value: float

    def reached(self, task: Mapping[str, Any], phi: float = 0.0) -> bool:
        """Whether a task, or the cam angle [degrees], has reached it; what is open has not."""
        size = phi if self.path == "phi" else value_at(task, self.path)
        if isinstance(size, bool) or not isinstance(size, int | float):
            return False
        return OPERATORS[self.operator](float(size), self.value)

    @property
    def plain(self) -> dict[str, Any]:
        """The goal as plain data for the page."""
        return {"path": self.path, "operator": self.operator, "value": self.value}


def goal_of(text: str) -> Goal:
    """The goal that a text tells.

    Raises
    ------
    DesignError : it is not a path, an operator and a number

    >>> goal_of("__import__('os')")
    Traceback (most recent call last):
    graphcam.errors.DesignError: goal is "__import__('os')", but must be a path, one of <=, >=, ==, <, > and a number
    """
    found = GOAL.fullmatch(text)
    if found is None:
        raise DesignError("goal", text, say("a path, one of {names} and a number", names=", ".join(OPERATORS)))
    path, operator, value = found.groups()
    steps_of(path)
    return Goal(path, operator, float(value))

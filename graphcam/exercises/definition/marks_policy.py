"""How a lecturer wants answers that are not right to be paid."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from graphcam.errors import DesignError
from graphcam.words import say

CAP_FORM = say("a mistake and the part of all marks that is left, such as offset-sign=0.5")


@dataclass(frozen=True)
class MarksPolicy:
    """``[marks]``: what is earned by answers that are not right.

    follow_through : part of its marks that an answer earns which follows from the student's own earlier ones
    near : so many tolerances off an answer earns nothing; from one tolerance to there its marks fall linearly
    caps : by the misconception's name the part of all marks that a hand-in with that diagnosis earns at most

    >>> MarksPolicy(near=3.0).part(2.0), MarksPolicy().part(2.0)
    (0.5, 0.0)
    """

    follow_through: float = 1.0
    near: float = 1.0
    caps: Mapping[str, float] = field(default_factory=dict[str, float])

    def __post_init__(self) -> None:
        parts = {"follow_through": self.follow_through} | {f"caps.{name}": cap for name, cap in self.caps.items()}
        for name, part in parts.items():
            if not 0 <= part <= 1:
                raise DesignError(name, part, say("a part from 0 to 1"))
        if not 1 <= self.near < math.inf:
            raise DesignError("near", self.near, say("a number of tolerances, at least 1"))

    @cached_property
    def without_follow_through(self) -> MarksPolicy:
        """The policy that pays nothing for what follows from the student's own earlier answers."""
        return replace(self, follow_through=0.0)

    @cached_property
    def without_caps(self) -> MarksPolicy:
        """The policy under which no mistake limits the marks."""
        return replace(self, caps={})

    def part(self, tolerances: float) -> float:
        """The part of its marks that an answer earns which is so many tolerances off.

        >>> MarksPolicy(near=2.0).part(1.25)
        0.75
        """
        if tolerances <= 1:
            return 1.0
        # A NaN is not less than anything.
        return (self.near - tolerances) / (self.near - 1) if tolerances < self.near else 0.0

    def max_share(self, mistakes: Sequence[str]) -> float:
        """The part of all marks that is left with one of these mistakes, the benefit of the doubt given.

        >>> policy = MarksPolicy(caps={"offset-sign": 0.5})
        >>> policy.max_share(["offset-sign"]), policy.max_share(["offset-sign", "base-circle"]), policy.max_share([])
        (0.5, 1.0, 1.0)
        """
        return max((self.caps.get(name, 1.0) for name in mistakes), default=1.0)


def caps_of(texts: Sequence[str]) -> dict[str, float]:
    """Caps as they are written on the command line.

    Raises
    ------
    DesignError : one is no mistake with a part

    >>> caps_of(["offset-sign=0.5", "scale-forgotten: integration.v=0"])
    {'offset-sign': 0.5, 'scale-forgotten: integration.v': 0.0}
    """
    found: dict[str, float] = {}
    for text in texts:
        name, _, part = text.rpartition("=")
        try:
            found[name.strip()] = float(part)
        except ValueError:
            raise DesignError("caps", text, CAP_FORM) from None
        if not name.strip():
            raise DesignError("caps", text, CAP_FORM)
    return found

"""What answers earn under a policy: the one place where outcomes become marks."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from graphcam.exercises.definition.exercise import Asked
from graphcam.exercises.definition.marks_policy import MarksPolicy
from graphcam.exercises.marking.record import Outcome

ROUNDING = 1e-9
"""What the arithmetic may take from a whole number."""


class Judged(NamedTuple):
    """One answer, judged and not yet paid.

    outcome : never "partial", which is a matter of pay
    tolerances : how many it is off
    share : part of a curve that is right, 0 where that is too little to be paid
    """

    asked: Asked
    outcome: Outcome
    tolerances: float = math.inf
    share: float = 0.0


def earned(policy: MarksPolicy, judged: Sequence[Judged], mistakes: Sequence[str]) -> list[float]:
    """The marks of every answer.

    mistakes : the diagnosed one and those alike; where all are capped every answer is paid less, in one proportion

    >>> first, second = (Asked(name, "A length.", "integration", reading="v", marks=2) for name in "ab")
    >>> judged = [Judged(first, "right"), Judged(second, "follow-through")]
    >>> earned(MarksPolicy(follow_through=0.5, caps={"offset-sign": 0.5}), judged, ["offset-sign"])
    [1.33, 0.66]
    """
    marks = [_alone(policy, each) for each in judged]
    total, most = sum(marks), policy.most(mistakes) * sum(each.asked.marks for each in judged)
    if total <= most:
        return marks
    return [math.floor(100 * each * most / total + ROUNDING) / 100 for each in marks]


def _alone(policy: MarksPolicy, judged: Judged) -> float:
    """What an answer earns without regard to the others: the best of what it may be paid for."""
    marks = judged.asked.marks
    if judged.outcome == "right":
        return marks
    part = _part(marks, max(judged.share, policy.part(judged.tolerances)))
    return max(part, marks * policy.follow_through) if judged.outcome == "follow-through" else part


def _part(marks: float, share: float) -> float:
    """A part of the marks, in whole tenths of a mark, and never all.

    >>> _part(4.0, 0.71), _part(1.0, 1.0)
    (2.8, 0.9)
    """
    return max(0.0, min(math.floor(10 * marks * share), math.ceil(10 * marks) - 1) / 10)

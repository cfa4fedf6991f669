"""What marking finds: one record a submission, as plain data."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from graphcam.exercises.definition.exercise import Value

PLAIN_TYPES = (str, int, bool, type(None))
"""Types of values that are strict JSON as they are."""
Outcome = Literal["right", "follow-through", "partial", "wrong", "missing", "unreadable"]


@dataclass(frozen=True)
class MarkedAnswer:
    """One answer with its marks and its deviation from the key.

    given : the number as given, or a list of points [x, y] in mm of paper; None where there is none
    marks, of : earned and possible
    deviation : from the key, in pencil units; None where none can be said
    station : of points and curves, the place of the largest deviation, counted from 0
    off_paper : of points and curves, the largest deviation in mm of paper
    """

    name: str
    outcome: Outcome
    marks: float
    of: float
    given: Any = None
    deviation: float | None = None
    station: int | None = None
    off_paper: float | None = None


@dataclass(frozen=True)
class Diagnosis:
    """The catalogued mistake that explains the answers best.

    confidence : its probability among the catalogued ones and "something else"
    alike : other mistakes that these answers cannot tell from it
    """

    misconception: str
    confidence: float
    alike: tuple[str, ...] = ()


@dataclass(frozen=True)
class Record:
    """One submission with its marks, its diagnosis and the feedback.

    version, draw, parameters : of the variant
    total, of : marks earned and possible
    too_exact : advisory, for the teacher alone: the readings are as exact as a program's, by CAD or computed
    feedback : sentences for the student, which never disclose the key
    notes : for the teacher, such as what could not be read
    level : how the answers were come by, "L0" where nothing was run
    without_follow_through, without_caps : the total as it would be without that part of the exercise's policy
    memory : MiB that all processes of the code together were watched for; None at L0
    """

    student: str
    exercise: str
    version: int
    draw: int
    parameters: Mapping[str, Value]
    answers: tuple[MarkedAnswer, ...]
    total: float
    of: float
    diagnosis: Diagnosis | None
    too_exact: bool
    feedback: tuple[str, ...]
    notes: tuple[str, ...] = ()
    level: str = "L0"
    without_follow_through: float = 0.0
    without_caps: float = 0.0
    memory: int | None = None

    def to_dict(self) -> dict[str, Any]:
        """The record as strict JSON takes it.

        >>> _strict_json([[1.0, 2.0], [math.inf, -math.inf]])
        [[1.0, 2.0], [None, None]]
        >>> marked = MarkedAnswer("v", "right", 1.0, 1.0, given=2.0, deviation=math.inf)
        >>> Record("s", "e", 1, 0, {}, (marked,), 1.0, 1.0, None, False, ()).to_dict()["answers"][0]["deviation"]
        """
        return _strict_json(self)


def is_handed_in(record: Mapping[str, Any]) -> bool:
    """Whether a record, as plain data, is of something that was handed in, or got marks by hand.

    >>> is_handed_in({"total": 0.0}), is_handed_in({"total": 0.0, "handed_in": False})
    (True, False)
    """
    return bool(record.get("handed_in", True))


def _strict_json(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, (Record, MarkedAnswer, Diagnosis)):
        value = vars(value)
    if isinstance(value, dict):
        # Most fields are plain: a call each would take longest of making a record.
        return {key: each if type(each) in PLAIN_TYPES else _strict_json(each) for key, each in value.items()}
    if isinstance(value, list):
        # A drawn curve has a hundred numbers: one that is not finite makes their sum so.
        points: list[list[float]] = value
        return points if math.isfinite(sum(map(sum, points))) else [list(map(_strict_json, point)) for point in points]
    if isinstance(value, tuple):
        return [_strict_json(each) for each in value]
    return value

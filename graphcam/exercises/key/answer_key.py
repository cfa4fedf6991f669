"""All that marking needs of one variant: key, tolerances, what every mistake would answer.

It is made once, by :mod:`graphcam.exercises.key.key_making`, and stored as JSON beside the variant, for the teacher
only: marks must be the same whenever and wherever they are given.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

from graphcam.errors import TaskError
from graphcam.exercises.definition.exercise import Value
from graphcam.exercises.key.expected_answers import Expected, from_stored, stored
from graphcam.exercises.key.follow_through import Dependence
from graphcam.words import say

FORMAT_VERSION = 4
PLAIN_FIELDS = (
    *("exercise", "version", "student", "draw", "parameters"),
    *("bound", "careful", "alike"),
)
"""Fields of an answer key whose values are JSON's own."""
V = TypeVar("V")


class DeferredValues(Mapping[str, V]):
    """Values by name that stand there as one JSON text: most submissions are right and need none of them.

    read : makes a value of what the JSON says

    >>> dict(DeferredValues('{"a": [1, 2]}', sum))
    {'a': 3}
    """

    def __init__(self, text: str, read: Callable[[Any], V]) -> None:
        self._text = text
        self._read = read
        self._made: dict[str, V] = {}

    @cached_property
    def _values(self) -> dict[str, Any]:
        return json.loads(self._text)

    def __getitem__(self, name: str) -> V:
        if name not in self._made:
            self._made[name] = self._read(self._values[name])
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)


class Hypothesis:
    """The expected answers of a student with one mistake, in the order of the exercise.

    They are kept as the answer key says them: marking compares a wrong answer with every mistake of every student,
    and most of what is drawn, a text of its own, need not even be looked at.

    said : of a number the value and its scatter, of points the text of what :func:`stored` says

    >>> Hypothesis.of([Expected(10.0, 0.5)])[0].deviation(11.0, "number")
    2.0
    """

    def __init__(self, said: list[Any]) -> None:
        self.said = said

    @staticmethod
    def of(values: Iterable[Expected]) -> Hypothesis:
        """The hypothesis of these answers."""
        said = [stored(each) for each in values]
        return Hypothesis([each if len(each) == 2 else json.dumps(each) for each in said])

    def __getitem__(self, place: int) -> Expected:
        said = self.said[place]
        return from_stored(json.loads(said) if isinstance(said, str) else said)

    def __iter__(self) -> Iterator[Expected]:
        return (self[place] for place in range(len(self.said)))


@dataclass(frozen=True, eq=False)
class Key:
    """What is right for one answer.

    expected : value and scatter
    tolerance : what is accepted on either side, in the answer's unit (of points: mm of paper, at the loosest point)
    tolerance_paper : the same in mm of paper; NaN for what is not a length there
    drawn : whether a hand's errors are in it at all, not only rounding and calculating
    """

    expected: Expected
    tolerance: float
    tolerance_paper: float
    drawn: bool


@dataclass(frozen=True, eq=False)
class AnswerKey:
    """One student's key, and the evidence that it is fair.

    exercise, version, student, draw, parameters : as of the variant
    bound : pencil units within which every answer counts as right, for the whole set of answers
    careful : part of careful hands who lose any point by it
    keys : by the answer's name
    hypotheses : by the misconception's name, what a student with that mistake answers, in the order of the answers
    alike : pairs of misconceptions that these answers cannot tell apart, as the exercise permits
    dependences : by the answer's name, how it follows from the student's own earlier answers
    """

    exercise: str
    version: int
    student: str
    draw: int
    parameters: Mapping[str, Value]
    bound: float
    careful: float
    keys: Mapping[str, Key]
    hypotheses: Mapping[str, Hypothesis]
    alike: tuple[tuple[str, str], ...]
    dependences: Mapping[str, Dependence]

    def inseparable_from(self, name: str) -> frozenset[str]:
        """The other misconceptions that these answers cannot tell from that one."""
        return frozenset(other for pair in self.alike if name in pair for other in pair if other != name)

    def to_json(self) -> str:
        """The answer key as JSON text; numbers as short as they are exact."""
        said = {"format": FORMAT_VERSION} | {name: getattr(self, name) for name in PLAIN_FIELDS}
        said["keys"] = {
            name: [stored(key.expected), key.tolerance, _finite_or_none(key.tolerance_paper), key.drawn]
            for name, key in self.keys.items()
        }
        # As texts within the text: they are read only where an answer is wrong.
        said["hypotheses"] = json.dumps({name: each.said for name, each in self.hypotheses.items()})
        said["dependences"] = json.dumps({name: each.to_json() for name, each in self.dependences.items()})
        return json.dumps(said, allow_nan=False)

    @staticmethod
    def from_json(text: str, path: str = "certificate") -> AnswerKey:
        """An answer key out of its text.

        Raises
        ------
        TaskError : it is none, or of another format
        """
        try:
            return _answer_key(json.loads(text))
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            found = say("not readable ({error})", error=str(error))
            wanted = say("an answer key of format {format}", format=FORMAT_VERSION)
            remedy = say("make it again with 'graphcam exercise make'")
            raise TaskError(path, say("the answer key"), found, wanted, remedy) from None


def _answer_key(said: dict[str, Any]) -> AnswerKey:
    if said["format"] != FORMAT_VERSION:
        raise ValueError(f"format {said['format']}")
    keys = {
        name: Key(from_stored(expected), tolerance, math.nan if paper is None else paper, drawn)
        for name, (expected, tolerance, paper, drawn) in said["keys"].items()
    }
    hypotheses = DeferredValues(str(said["hypotheses"]), Hypothesis)
    dependences = DeferredValues(str(said["dependences"]), Dependence.from_json)
    as_they_are = {name: said[name] for name in PLAIN_FIELDS}
    as_they_are["alike"] = tuple((a, b) for a, b in said["alike"])
    return AnswerKey(keys=keys, hypotheses=hypotheses, dependences=dependences, **as_they_are)


def _finite_or_none(number: float) -> float | None:
    return number if math.isfinite(number) else None

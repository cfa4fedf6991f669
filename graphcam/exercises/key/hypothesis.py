"""What a student with one mistake answers, as it stands in an answer key."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from typing import Any

from pydantic_core import from_json

from graphcam.exercises.key.expectation import Expected, from_stored, stored


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
        return from_stored(from_json(said) if isinstance(said, str) else said)

    def __iter__(self) -> Iterator[Expected]:
        return (self[place] for place in range(len(self.said)))

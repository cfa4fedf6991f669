"""What a student with one mistake answers, as it stands in a certificate."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from typing import Any, overload

from pydantic_core import from_json

from graphcam.exercises.key.expectation import Expected, from_plain, plain


class Hypothesis(Sequence[Expected]):
    """The expected answers of a student with one mistake, in the order of the exercise.

    They are kept as the certificate says them: marking compares a wrong answer with every mistake of every student,
    and most of what is drawn, a text of its own, need not even be looked at.

    said : of a number the value and its scatter, of points the text of what :func:`plain` says

    >>> Hypothesis.of([Expected(10.0, 0.5)])[0].deviation(11.0, "number")
    2.0
    """

    def __init__(self, said: list[Any]) -> None:
        self.said = said

    @staticmethod
    def of(values: Iterable[Expected]) -> Hypothesis:
        """The hypothesis of these answers."""
        said = [plain(each) for each in values]
        return Hypothesis([each if len(each) == 2 else json.dumps(each) for each in said])

    @overload
    def __getitem__(self, place: int) -> Expected: ...
    @overload
    def __getitem__(self, place: slice) -> list[Expected]: ...
    def __getitem__(self, place: int | slice) -> Expected | list[Expected]:
        if isinstance(place, slice):
            return [_read(each) for each in self.said[place]]
        return _read(self.said[place])

    def __len__(self) -> int:
        return len(self.said)


def _read(said: list[Any] | str) -> Expected:
    return from_plain(from_json(said) if isinstance(said, str) else said)

"""What is read only when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import Any, TypeVar

from pydantic_core import from_json

V = TypeVar("V")


class Deferred(Mapping[str, V]):
    """Values by name that stand there as one JSON text: most submissions are right and need none of them.

    read : makes a value of what the JSON says

    >>> dict(Deferred('{"a": [1, 2]}', sum))
    {'a': 3}
    """

    def __init__(self, text: str, read: Callable[[Any], V]) -> None:
        self._text = text
        self._read = read
        self._made: dict[str, V] = {}

    @cached_property
    def _said(self) -> dict[str, Any]:
        return from_json(self._text)

    def __getitem__(self, name: str) -> V:
        if name not in self._made:
            self._made[name] = self._read(self._said[name])
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._said)

    def __len__(self) -> int:
        return len(self._said)

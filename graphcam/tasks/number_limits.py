"""Limits of the numbers of a task as marks on their types, and the check of a table by them."""

import dataclasses
import types
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from graphcam.errors import DesignError, check_number, choice_limit
from graphcam.given.plausible_ranges import bounded, check_positive
from graphcam.words import Words, say


@dataclass(frozen=True)
class Bounded:
    """Marks a number of any sign whose magnitude is sensible; ``unit`` is one of the table of plausible ranges."""

    unit: str

    def check(self, name: str, value: Any) -> None:
        """Refuse a number that is beyond what is sensible."""
        bounded(name, value, self.unit)


@dataclass(frozen=True)
class Positive:
    """Marks a number that is greater than 0 and sensible; with ``or_zero`` it may be 0."""

    unit: str
    or_zero: bool = False

    def check(self, name: str, value: Any) -> None:
        """Refuse a number that is not positive, or beyond what is sensible."""
        check_positive(name, (value or None) if self.or_zero else value, self.unit)


@dataclass(frozen=True)
class NotNegative(Bounded):
    """Marks a number of 0 or more whose magnitude is sensible."""

    def check(self, name: str, value: Any) -> None:
        """Refuse a negative number, or one that is beyond what is sensible."""
        check_number(name, value, say("a finite number of 0 {unit} or more", unit=self.unit), least=0)
        super().check(name, value)


@dataclass(frozen=True)
class Within:
    """Marks a number from ``least`` to ``most``; with ``open_end`` it is less than that.

    limit : what is allowed, in words; empty tells the two ends;  remedy : may be empty
    """

    least: float
    most: float
    limit: Words = ""
    remedy: Words = ""
    open_end: bool = False

    def check(self, name: str, value: Any) -> None:
        """Refuse a number out of the range."""
        if not self.least <= value <= self.most or (self.open_end and value == self.most):
            limit = self.limit or say("from {least:g} to {most:g}", least=self.least, most=self.most)
            raise DesignError(name, value, limit, self.remedy)


@dataclass(frozen=True)
class OneOf:
    """The limit of a field whose type is a ``Literal``."""

    choices: tuple[Any, ...]

    def check(self, name: str, value: Any) -> None:
        """Refuse what is not among the choices."""
        if value not in self.choices:
            raise DesignError(name, value, *choice_limit(value, map(str, self.choices)))


Limit = Bounded | Positive | Within


@cache
def field_types(kind: type) -> dict[str, Any]:
    """The types of the fields that a file gives for a table, with their marks."""
    hints = get_type_hints(kind, include_extras=True)
    return {each.name: hints[each.name] for each in dataclasses.fields(kind) if each.init}


def check_limits(table: Any) -> None:
    """Check the numbers and words of a table by the limits of their types; the tables in it check themselves.

    Raises
    ------
    DesignError : one of them cannot be; it carries the key, of a list with the place there

    >>> from graphcam.tasks.material_table import MaterialTable
    >>> MaterialTable(width=-15.0)
    Traceback (most recent call last):
    graphcam.errors.DesignError: width is -15.0, but must be a finite number greater than 0 mm
    """
    for name, hint in field_types(type(table)).items():
        for path, value, limit in _limited(hint, getattr(table, name), name):
            limit.check(path, value)


def _limited(
    hint: Any, value: Any, path: str, limits: tuple[Limit, ...] = (), *, alone: bool = True
) -> Iterator[tuple[str, Any, Limit | OneOf]]:
    """The numbers and words of a value with the limits of their types, the outermost first.

    alone : whether the type is the only one that the value may have
    """
    if hasattr(hint, "__metadata__"):
        own = [mark for mark in reversed(hint.__metadata__) if isinstance(mark, Limit)]
        hint, limits = hint.__origin__, (*limits, *own)
    parts = get_args(hint)
    if get_origin(hint) in (Union, types.UnionType):
        alone = len(parts) == 2 and types.NoneType in parts
        for part in parts if value is not None else ():
            yield from _limited(part, value, path, limits if alone else (), alone=alone)
    elif get_origin(hint) is tuple and isinstance(value, tuple | list):
        kinds = parts[:1] * len(value) if parts[1:] == (...,) else parts  # pyright: ignore[reportUnknownArgumentType]
        for k, (part, each) in enumerate(zip(kinds, value, strict=False)):  # pyright: ignore[reportUnknownArgumentType, reportUnknownVariableType]
            yield from _limited(part, each, f"{path}[{k}]")
    elif get_origin(hint) is Literal and alone:
        yield path, value, OneOf(parts)
    elif hint in (float, int) and not isinstance(value, str | tuple | list):
        yield from ((path, value, limit) for limit in limits)

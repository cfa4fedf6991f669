"""The numbers of a task as their tables declare them: unit, name in forms, and from where to where a slider moves them.

A number's name and range are marks on its type: ``Annotated[Damping, say("Damping d"), About(100.0, from_zero=True)]``.
"""

import dataclasses
import types
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple, Union, get_args, get_origin

from graphcam.tasks.number_limits import Limit, field_types
from graphcam.tasks.units import HeldIn
from graphcam.words import Caption


class Fixed(NamedTuple):
    """Marks a number that is moved from ``least`` to ``most`` in steps of ``step``, whatever the task."""

    least: float
    most: float
    step: float


@dataclass(frozen=True)
class About:
    """Marks a number that is moved around the value that it has, or around ``value`` where it has none or is zero.

    from_zero : whether down to 0, in place of a hundredth of the greatest value
    """

    value: float
    from_zero: bool = False


@dataclass(frozen=True)
class Ruled:
    """Marks a number whose range follows from other sizes, by a rule in the studio."""


@dataclass(frozen=True)
class DeclaredNumber:
    """A number of a table.

    name : in forms; None where no form has it
    range : from where to where it is moved there
    held : its unit; None for a plain number
    is_open : whether it may be left out
    limits : what it must keep to, the widest first
    """

    name: Caption | None
    range: Fixed | About | Ruled
    held: HeldIn | None
    is_open: bool
    limits: tuple[Limit, ...] = ()


Numbers = Mapping[str, DeclaredNumber]


@cache
def declared(kind: type) -> Numbers:
    """The numbers of a class of tables and of the tables in it, by their paths; of several kinds the first that has it.

    >>> from graphcam.tasks.spring_tables import ArmSpringTable
    >>> numbers = declared(ArmSpringTable)
    >>> str(numbers["damping"].name), numbers["damping"].held.own, "at.anchor[1]" in numbers
    ('Damping d', 'N mm s/rad', True)
    """
    found: dict[str, DeclaredNumber] = {}
    for name, hint in field_types(kind).items():
        for path, number in _numbers(hint, name):
            found.setdefault(path, number)
    return found


def numbers_of(table: Any) -> Numbers:
    """The numbers of a task or table, by their paths, those of the tables that it has.

    >>> from graphcam.tasks.task import OscillatingTable
    >>> list(numbers_of(OscillatingTable(arm=100)))
    ['arm', 'distance', 'roller_radius']
    """
    found: dict[str, DeclaredNumber] = {}
    for name, hint in field_types(type(table)).items():
        value = getattr(table, name)
        if dataclasses.is_dataclass(value):
            found |= {f"{name}.{path}": number for path, number in numbers_of(value).items()}
        else:
            found |= dict(_numbers(hint, name, within=False))
    return found


def _numbers(
    hint: Any, path: str, marks: tuple[Any, ...] = (), *, is_open: bool = False, within: bool = True
) -> Iterator[tuple[str, DeclaredNumber]]:
    """The numbers of a type; ``within`` tables too."""
    if hasattr(hint, "__metadata__"):
        hint, marks = hint.__origin__, (*hint.__metadata__, *marks)
    parts = get_args(hint)
    if get_origin(hint) in (Union, types.UnionType):
        is_open = is_open or types.NoneType in parts
        for part in parts:
            yield from _numbers(part, path, marks, is_open=is_open, within=within)
    elif get_origin(hint) is tuple and parts[1:] != (...,):
        for k, part in enumerate(parts):
            yield from _numbers(part, f"{path}[{k}]", is_open=is_open, within=within)
    elif hint in (float, int):
        name = next((mark for mark in marks if isinstance(mark, Caption)), None)
        held = next((mark for mark in marks if isinstance(mark, HeldIn)), None)
        room = next((mark for mark in marks if isinstance(mark, Fixed | About | Ruled)), Ruled())
        limits = tuple(mark for mark in marks if isinstance(mark, Limit))
        yield path, DeclaredNumber(name, room, held, is_open, limits)
    elif within and dataclasses.is_dataclass(hint) and isinstance(hint, type):
        yield from ((f"{path}.{name}", number) for name, number in declared(hint).items())

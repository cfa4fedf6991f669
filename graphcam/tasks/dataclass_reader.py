"""Dataclasses out of plain tables: each field is read as its type hint says, and every fault is told with its place.

It is strict: text stands for a number only with its unit, no number for a switch, nothing is infinite, nothing unknown
is passed over.
What a hint may be: ``float``, a type of :mod:`graphcam.tasks.units`, ``int``, ``str``, ``bool``, a ``Literal``,
``Any``, a dataclass, a tuple of fixed or of any length, a mapping of texts, one of several of these, and with
:class:`ByKind` or :class:`ByKeys` one of several dataclasses.
"""

import dataclasses
import math
import types
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache, reduce
from typing import Annotated, Any, Literal, TypeVar, Union, cast, get_args, get_origin, get_type_hints

from graphcam.errors import DesignError
from graphcam.tasks.number_limits import field_types
from graphcam.tasks.units import HeldIn, InUnit
from graphcam.words import Words, or_list, say

Place = tuple[int | str, ...]
"""A place in a file: keys, numbers of list entries, and the choices among classes by their kind."""
TABLE_FORM = say("a table")
_Read = TypeVar("_Read")


class ByKind:
    """Marks a union of dataclasses that is read by the key ``kind``, whose ``Literal`` each of them has."""


class ByKeys:
    """Marks a union of dataclasses that is read by its keys: the class that knows most of them is taken."""


class ByName:
    """Marks a field whose value is a name in a file, whatever other types it may have in Python."""


Classes = dict[tuple[str, ...], type]


@cache
def classes_of(kind: type) -> Classes:
    """The class of each table of a file that is read as a dataclass, by its place without numbers.

    Of several classes that are told apart by their keys the first stands for all.

    >>> from graphcam.tasks.arcs_task import ArcsTask
    >>> [*classes_of(ArcsTask)]
    [(), ('arcs',), ('follower',), ('title',), ('drawing',), ('part',)]
    """
    found: Classes = {(): kind}
    for name, hint in field_types(kind).items():
        for tag, table in _tables(hint):
            inner = {(name, *tag, *place): each for place, each in classes_of(table).items()}
            found |= {place: each for place, each in inner.items() if place not in found}
    return found


def _tables(hint: Any, *, by_kind: bool = False) -> Iterator[tuple[tuple[str, ...], type]]:
    """The dataclasses of a hint, each with its kind where that tells them apart."""
    if hasattr(hint, "__metadata__"):
        if any(isinstance(mark, ByName) for mark in hint.__metadata__):
            return
        by_kind, hint = any(isinstance(mark, ByKind) for mark in hint.__metadata__), hint.__origin__
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        yield (get_args(field_types(hint)["kind"]) if by_kind else ()), hint
    else:
        for part in get_args(hint):
            yield from _tables(part, by_kind=by_kind)


@dataclass(frozen=True)
class MissingKey:
    """The fault of a key that is required and missing."""

    place: Place


@dataclass(frozen=True)
class UnknownKey:
    """The fault of a key that its table does not have."""

    place: Place


@dataclass(frozen=True)
class UnknownKind:
    """The fault of a table whose key ``kind`` is missing or names none of its classes."""

    place: Place


@dataclass(frozen=True)
class WrongType:
    """The fault of a value that is not of the field's type; ``expected`` is what the file must give.

    choices : the permitted words, where these are few;  remedy : empty where nothing better is known
    """

    place: Place
    expected: Words
    choices: tuple[str, ...] = field(default=(), repr=False)
    remedy: Words = field(default="", repr=False)


@dataclass(frozen=True)
class Misfit:
    """The fault of a table whose values have the right types, but make no design."""

    place: Place
    error: DesignError


Fault = MissingKey | UnknownKey | UnknownKind | WrongType | Misfit
Reader = Callable[[Any, Place, list[Fault]], Any]
"""A reader of the value at a place; it appends faults to the list, and then its value is of no use."""


def read_dataclass(kind: type[_Read], said: Mapping[str, Any]) -> _Read | list[Fault]:
    """The dataclass that plain tables, lists, numbers and texts describe, or all that is wrong with them.

    Faults are in the order of the fields, of one table after those in its fields.

    >>> @dataclass(frozen=True)
    ... class Roller:
    ...     radius: float
    ...     material: Literal["steel", "bronze"] = "steel"
    >>> read_dataclass(Roller, {"radius": 17})
    Roller(radius=17.0, material='steel')
    >>> wrong, unknown = read_dataclass(Roller, {"radius": "17", "bore": 3})
    >>> print(wrong.place, wrong.expected, unknown)
    ('radius',) a number (without quotes) UnknownKey(place=('bore',))
    """
    faults: list[Fault] = []
    made = _dataclass_reader(kind)(said, (), faults)
    return faults or made


@cache
def _dataclass_reader(kind: type) -> Reader:
    """The reader of a table as a dataclass; a field's key in the file is its name, or its ``alias``."""
    hints = get_type_hints(kind, include_extras=True)
    fields = [each for each in dataclasses.fields(kind) if each.init]
    readers = {each.metadata.get("alias", each.name): (each.name, _reader(hints[each.name])) for each in fields}
    needed = {each.name for each in fields if each.default is each.default_factory is dataclasses.MISSING}

    def read(said: Any, place: Place, faults: list[Fault]) -> Any:
        if not isinstance(said, dict):
            return faults.append(WrongType(place, TABLE_FORM))
        table, before, values = cast(dict[str, Any], said), len(faults), dict[str, Any]()
        for key, (name, reader) in readers.items():
            if key in table:
                values[name] = reader(table[key], (*place, key), faults)
            elif name in needed:
                faults.append(MissingKey((*place, key)))
        faults.extend(UnknownKey((*place, key)) for key in table if key not in readers)
        if len(faults) > before:
            return None
        try:
            return kind(**values)
        except DesignError as error:
            return faults.append(Misfit(place, error))

    return read


def _reader(hint: Any) -> Reader:
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Annotated:
        if isinstance(parts[1], HeldIn):
            return _unit_reader(parts[1])
        marks = [type(mark) for mark in parts[1:]]
        return (
            _reader(str)
            if ByName in marks
            else _kind_reader(get_args(parts[0]))
            if ByKind in marks
            else _keys_reader(get_args(parts[0]))
            if ByKeys in marks
            else _reader(parts[0])
        )
    if origin in (Union, types.UnionType):
        return _union_reader(parts)
    if origin is Literal:
        return _literal_reader(parts)
    if origin is tuple:
        return _list_reader(parts[0]) if parts[1:] == (...,) else _tuple_reader(parts)
    if origin in (Mapping, dict):
        return _mapping_reader(parts[1])
    return _PLAIN_READERS[hint] if hint in _PLAIN_READERS else _dataclass_reader(hint)


def _number(said: Any, place: Place, faults: list[Fault]) -> Any:
    """A finite number; a whole one becomes a float."""
    if isinstance(said, bool) or not isinstance(said, int | float):
        return faults.append(WrongType(place, say("a number (without quotes)")))
    try:
        number = float(said)
    except OverflowError:
        number = math.inf
    return number if math.isfinite(number) else faults.append(WrongType(place, say("a finite number")))


def _unit_reader(unit: HeldIn) -> Reader:
    """The reader of a number that may be text with its unit."""

    def read(said: Any, place: Place, faults: list[Fault]) -> Any:
        if not isinstance(said, str):
            return _number(said, place, faults)
        number = unit.number(said)
        if isinstance(number, InUnit):
            return number
        return faults.append(WrongType(place, unit.expected, remedy=number))

    return read


def _whole_number(said: Any, place: Place, faults: list[Fault]) -> Any:
    whole = isinstance(said, int) and not isinstance(said, bool)
    return said if whole else faults.append(WrongType(place, say("a whole number (without quotes)")))


def _text(said: Any, place: Place, faults: list[Fault]) -> Any:
    return said if isinstance(said, str) else faults.append(WrongType(place, say("text in quotes")))


def _switch(said: Any, place: Place, faults: list[Fault]) -> Any:
    return said if isinstance(said, bool) else faults.append(WrongType(place, say("true or false")))


def _any_value(said: Any, _place: Place, _faults: list[Fault]) -> Any:
    return said


_PLAIN_READERS: dict[Any, Reader] = {float: _number, int: _whole_number, str: _text, bool: _switch, Any: _any_value}


def _literal_reader(choices: tuple[Any, ...]) -> Reader:
    expected = or_list([repr(choice) for choice in choices])
    words = tuple(choice for choice in choices if isinstance(choice, str))

    def read(said: Any, place: Place, faults: list[Fault]) -> Any:
        for choice in choices:
            if said == choice and not isinstance(said, bool):
                return choice
        return faults.append(WrongType(place, expected, words))

    return read


def _union_reader(hints: tuple[Any, ...]) -> Reader:
    """The reader of the first of several hints that fits; else it tells the faults of the choice that fits best."""
    readers = [_reader(hint) for hint in hints if hint is not type(None)]
    optional = type(None) in hints
    if len(readers) == 1 and not optional:
        return readers[0]

    def read(said: Any, place: Place, faults: list[Fault]) -> Any:
        if said is None and optional:
            return None
        found: list[list[Fault]] = []
        for reader in readers:
            wrong: list[Fault] = []
            value = reader(said, place, wrong)
            if not wrong:
                return value
            found.append(wrong)
        return faults.extend(_closest_faults(found, place))

    return read


def _closest_faults(found: list[list[Fault]], place: Place) -> list[Fault]:
    """The faults of the choice that fits best; where none fits at all, what each choice expected."""
    best = max(found, key=lambda faults: len(faults[0].place))
    if len(found) == 1 or best[0].place != place:
        return best
    wrong = [fault for faults in found if isinstance(fault := faults[0], WrongType)]
    expected = reduce(lambda first, last: or_list([first, last]), (fault.expected for fault in wrong))
    return [WrongType(place, expected, remedy=next((fault.remedy for fault in wrong if fault.remedy), ""))]


def _kind_reader(classes: tuple[type, ...]) -> Reader:
    tags = {kind: get_args(get_type_hints(kind)["kind"])[0] for kind in classes}
    readers: dict[Any, Reader] = {tag: _dataclass_reader(kind) for kind, tag in tags.items()}

    def read(said: Any, place: Place, faults: list[Fault]) -> Any:
        if not isinstance(said, dict):
            return faults.append(WrongType(place, TABLE_FORM))
        tag = cast(dict[str, Any], said).get("kind")
        if not isinstance(tag, str) or tag not in readers:
            return faults.append(UnknownKind(place))
        return readers[tag](said, (*place, tag), faults)

    return read


def _keys_reader(classes: tuple[type, ...]) -> Reader:
    """The reader of a table as the class that has most of its keys, the first of several."""
    known = {kind: {each.name for each in dataclasses.fields(kind) if each.init} for kind in classes}

    def read(said: Any, place: Place, faults: list[Fault]) -> Any:
        keys = set(cast(dict[str, Any], said)) if isinstance(said, dict) else set[str]()
        return _dataclass_reader(max(classes, key=lambda kind: len(keys & known[kind])))(said, place, faults)

    return read


def _list_reader(hint: Any) -> Reader:
    reader = _reader(hint)

    def read(said: Any, place: Place, faults: list[Fault]) -> Any:
        if not isinstance(said, list | tuple):
            return faults.append(WrongType(place, say("a list")))
        items = cast(list[Any], said)
        return tuple(reader(item, (*place, number), faults) for number, item in enumerate(items))

    return read


def _tuple_reader(hints: tuple[Any, ...]) -> Reader:
    readers = [_reader(hint) for hint in hints]

    def read(said: Any, place: Place, faults: list[Fault]) -> Any:
        if not isinstance(said, list | tuple):
            return faults.append(WrongType(place, say("a list of {readers}", readers=len(readers))))
        items = cast(list[Any], said)
        if len(items) > len(readers):
            return faults.append(WrongType(place, say("a list of {readers}", readers=len(readers))))
        # Of a list that is too short the places that lack are read no further.
        values = tuple(
            reader(item, (*place, number), faults)
            for number, (reader, item) in enumerate(zip(readers, items, strict=False))
        )
        faults.extend(MissingKey((*place, number)) for number in range(len(items), len(readers)))
        return values

    return read


def _mapping_reader(hint: Any) -> Reader:
    reader = _reader(hint)

    def read(said: Any, place: Place, faults: list[Fault]) -> Any:
        if not isinstance(said, dict):
            return faults.append(WrongType(place, TABLE_FORM))
        table = cast(dict[str, Any], said)
        return {key: reader(value, (*place, key), faults) for key, value in table.items()}

    return read

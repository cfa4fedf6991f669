"""The coursework task as a file in which every key is explained: by the docstrings of the tables, in any language."""

import dataclasses
import inspect
import json
import textwrap
import tomllib
import types
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib import resources
from typing import Any, cast, get_args, get_type_hints

from graphcam.help_texts import help_text, table_texts
from graphcam.language import ENGLISH, Language
from graphcam.tasks.declared_numbers import About, Fixed, declared
from graphcam.tasks.motion_tables import OutlineTable, RadiiTable
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import builtin_text
from graphcam.words import say

WIDTH, COLUMN, TAB = 120, 24, 8
"""The width of the file, and where the explanations stand [characters]."""
HEAD = (
    say("A task for graphcam.  Solve it with:  graphcam solve FILE"),
    say('Angles are in degrees, lengths in mm; a number may be text with its unit: "1.25 in", "0.5 rad", "12 lbf".'),
    say('Text after "#" is a comment; a key in a comment shows what else can be given.'),
)
ROOM = "graphcam.tasks"
IN_PLACE_OF_MOTION = {"arcs": RadiiTable, "outline": OutlineTable}
"""The tables of a file that stand for a motion."""


@cache
def table_docs(kind: type) -> tuple[str, dict[str, str]]:
    """What a table is, and what each of its fields is, those of the classes before it too.

    >>> from graphcam.tasks.spring_tables import SpringTable
    >>> about, fields = table_docs(SpringTable)
    >>> about, fields["damping"]
    ('what presses a translating or flat-faced follower on its cam; it needs speed_rpm', 'N s/m, against the motion')
    """
    classes = filter(dataclasses.is_dataclass, kind.__mro__)
    found = [table_texts(inspect.cleandoc(each.__doc__ or "")) for each in classes]
    return found[0][0], {name: text for _, fields in reversed(found) for name, text in fields.items()}


def commented_task(spoken: Language = ENGLISH) -> str:
    """The coursework task as the text of a task file, with every key and what it means.

    >>> print(*commented_task().splitlines()[4:6], sep="\\n")
    rotation = "cw"         # sense in which the cam turns, "cw" or "ccw"
    speed_rpm = 120         # rpm, speed of the cam; left out: velocities and accelerations per radian of the cam
    """
    return "\n".join(_Writer(spoken).lines()) + "\n"


def tables_of(hint: Any) -> list[type]:
    """The classes of tables in a type: of a field, of a list, of several kinds.

    >>> [kind.__name__ for kind in tables_of(tuple[RadiiTable | None, ...])]
    ['RadiiTable']
    """
    if isinstance(hint, type) and dataclasses.is_dataclass(hint):
        return [hint] if hint.__module__.startswith(ROOM) else []
    return [kind for part in get_args(hint) for kind in tables_of(part)]


class _Writer:
    """Writes the file in a language."""

    def __init__(self, spoken: Language) -> None:
        self.spoken = spoken
        self.given: dict[str, Any] = tomllib.loads(builtin_text("coursework"))
        self.given["drawing"]["language"] = spoken.name
        text = resources.files("graphcam").joinpath("data", "examples.toml").read_text(encoding="utf-8")
        self.examples = tomllib.loads(text)

    def lines(self) -> Iterator[str]:
        """The lines of the file."""
        yield from (f"# {self.spoken.text(words)}" for words in HEAD)
        yield ""
        hints = get_type_hints(Task, include_extras=True)
        tables = {name: found for name, hint in hints.items() if (found := tables_of(hint))}
        yield from self._keys(Task, self.given, {}, leave_out=tables.keys())
        for name, kinds in tables.items():
            yield ""
            yield from self._table(name, kinds, open_=types.NoneType not in get_args(hints[name]))
            for other in IN_PLACE_OF_MOTION if name == "motion" else ():
                yield ""
                yield from self._table(other, [IN_PLACE_OF_MOTION[other]], open_=False)

    def _table(self, name: str, kinds: list[type], *, open_: bool) -> Iterator[str]:
        """A table; of several kinds the first one is as the task has it, the others follow in comments."""
        given, examples = self.given.get(name, {}), self.examples.get(name, {})
        for k, kind in enumerate(kinds):
            text, tag = self._told(table_docs(kind)[0]), getattr(kind, "kind", "")
            if not k:
                yield from _line(f"[{name}]", "" if tag else text, open_=open_)
            if tag:
                yield from _line(f'kind = "{tag}"', text, open_=open_ and not k)
            elif k:
                yield from _wrapped(text)
            leave_out = ("kind", *IN_PLACE_OF_MOTION, "radii")
            yield from self._keys(kind, {} if k else given, examples, leave_out)

    def _keys(
        self, kind: type, given: Mapping[str, Any], examples: Mapping[str, Any], leave_out: Iterable[str]
    ) -> Iterator[str]:
        """The keys of a table with their values and texts; what is not given stands in a comment."""
        hints, (_, texts) = get_type_hints(kind, include_extras=True), table_docs(kind)
        for field in dataclasses.fields(kind):
            if not field.init or field.name in leave_out:
                continue
            value = given.get(field.name, examples.get(field.name))
            value = _usual_value(kind, field) if value is None else value
            text = self._told(texts.get(field.name, ""))
            if isinstance(value, list) and value and isinstance(value[0], dict):
                yield from _wrapped(f"{field.name}: {text}")
                yield from self._entries(tables_of(hints[field.name]))
                text = ""
            yield from _line(f"{field.name} = {toml_value(value)}", text, open_=field.name in given)

    def _entries(self, kinds: list[type]) -> Iterator[str]:
        """The keys that the tables of a list have, each once."""
        told: dict[str, str] = {}
        for kind in kinds:
            hints = get_type_hints(kind, include_extras=True)
            for name, text in table_docs(kind)[1].items():
                if name not in told:
                    told[name] = text
                    yield from _wrapped(f"  {name:<7} {self._told(text)}", 10)
                    yield from self._entries(tables_of(hints[name]))

    def _told(self, text: str) -> str:
        return self.spoken.text(help_text(text)) if text else ""


def _usual_value(kind: type, field: "dataclasses.Field[Any]") -> Any:
    """The value of a key for which there is no example: its default, or one from the middle of its range."""
    if field.default not in (None, dataclasses.MISSING):
        return field.default
    number = declared(kind).get(field.name)
    match number and number.range:
        case About(value):
            return value
        case Fixed(least, most, step):
            return least + round((most - least) / step / 2) * step
        case _:
            raise ValueError(f"data/examples.toml has no value for {kind.__name__}.{field.name}")


def toml_value(value: Any) -> str:
    """A value as TOML has it on one line; a list of tables has a line for each.

    >>> toml_value({"arm": 60.0, "anchor": [1.5, True]})
    '{ arm = 60, anchor = [1.5, true] }'
    """
    if isinstance(value, Mapping):
        said = cast(Mapping[str, Any], value)
        return "{ " + ", ".join(f"{key} = {toml_value(each)}" for key, each in said.items()) + " }"
    if isinstance(value, list | tuple):
        parts = [toml_value(each) for each in cast(Iterable[Any], value)]
        tables = len(parts) > 1 and parts[0].startswith("{ kind")
        return "[\n  " + ",\n  ".join(parts) + ",\n]" if tables else "[" + ", ".join(parts) + "]"
    if isinstance(value, float):
        return f"{value:.12g}"
    return json.dumps(value, ensure_ascii=False)


def _line(assigned: str, text: str, *, open_: bool) -> Iterator[str]:
    """A key or the head of a table, and its text beside it or below one another."""
    *before, last = [line if open_ else f"# {line}" for line in assigned.splitlines()]
    yield from before
    column = max(COLUMN, (len(last) // TAB + 1) * TAB)
    lines = textwrap.wrap(text, WIDTH - column - 2, break_on_hyphens=False)
    for k, line in enumerate(lines or [""]):
        yield f"{'' if k else last:<{column}}# {line}" if line else last


def _wrapped(text: str, hanging: int = 0) -> Iterator[str]:
    """A text over the whole width."""
    indent = " " * hanging
    lines = textwrap.wrap(text, WIDTH - 2, subsequent_indent=indent, break_on_hyphens=False)
    yield from (f"# {line}" for line in lines)

"""The page of the reference that has every key of a task file: by the tables that declare them."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterator
from typing import Any

from graphcam.tasks.commented_task import IN_PLACE_OF_MOTION, table_docs, tables_of, toml_value
from graphcam.tasks.declared_numbers import DeclaredNumber, declared
from graphcam.tasks.number_limits import NotNegative, Positive, Within, field_types
from graphcam.tasks.task import Task

HEAD = """# The task file

A task file is TOML; `graphcam init cam.toml` writes one in which every key is explained, with `--language ru` in Russian. A number
may be text with its unit: `offset = "1.25 in"`."""


def task_file_page() -> str:
    """The page as Markdown."""
    # What several lists have is told once.
    return "\n\n".join(dict.fromkeys([HEAD, *_sections(Task, "## Keys before all tables")])) + "\n"


def _sections(table: type, title: str) -> Iterator[str]:
    """The sections of a table and of the tables in it."""
    about, texts = table_docs(table)
    fields = {each.name: each for each in dataclasses.fields(table)}
    inner = {name: tables_of(hint) for name, hint in field_types(table).items()}
    keys = [name for name in inner if name != "kind" and (title.startswith("###") or name != "radii")]
    keys = [name for name in keys if texts.get(name)]
    said = [title] if table is Task else [title, f"{_plain(about[:1].upper() + about[1:])}."]
    if keys:
        rows = (f"| `{key}` | {_value(table, fields[key])} | {_plain(texts[key])} |" for key in keys)
        said.append("\n".join(["| key | value | meaning |", "|---|---|---|", *rows]))
    yield "\n\n".join(said)
    for name, kinds in inner.items():
        for kind in kinds if name != "radii" else ():
            tag = f', kind = "{kind.kind}"' if hasattr(kind, "kind") else ""
            level, head = ("##", f"[{name}]") if table is Task else ("###", name)
            yield from _sections(kind, f"{level} `{head}{tag}`")
        for other in IN_PLACE_OF_MOTION if name == "motion" else ():
            yield from _sections(IN_PLACE_OF_MOTION[other], f"## `[{other}]`")


def _value(table: type, field: dataclasses.Field[Any]) -> str:
    """The limits of a number, whose unit its meaning tells, and the default."""
    numbers = declared(table)
    number = numbers.get(field.name) or numbers.get(f"{field.name}[0]")
    told = [] if number is None else _limits(number)
    if field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING:
        told.append("must be given")
    elif field.default not in (None, dataclasses.MISSING, ()):
        told.append(f"`{toml_value(field.default)}` if left out")
    return ", ".join(told)


def _limits(number: DeclaredNumber) -> list[str]:
    told: list[str] = []
    for limit in number.limits:
        if isinstance(limit, Within):
            told.append(f"{limit.least:g} to {limit.most:g}")
        elif isinstance(limit, NotNegative) or (isinstance(limit, Positive) and limit.or_zero):
            told.append("0 or more")
        elif isinstance(limit, Positive):
            told.append("greater than 0")
    return told


def _plain(text: str) -> str:
    """A text in which nothing is markup."""
    return re.sub(r"([\\`*_\[\]<>|$#])", r"\\\1", text)

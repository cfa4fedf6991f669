"""Wrong options and arguments, told as wrong fields of a file are: name, value, what is allowed, remedy."""

import re
from collections.abc import Generator
from contextlib import contextmanager, suppress
from dataclasses import fields
from inspect import unwrap
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal, get_args, get_origin, get_type_hints

import typer
from typer.core import TyperGroup

from graphcam.cli.command_language import language_in, translated, voice
from graphcam.errors import DesignError, choice_limit
from graphcam.typed_words import meant
from graphcam.words import Words, bare_caption, say

INPUT_ERROR_STATUS = 2
"""Exit status when the input is wrong."""
USAGE_ERROR: type[Exception] = typer.BadParameter.__mro__[1]
"""The error of a wrong use, for which typer has no public name."""
_DECIMAL_COMMA_PATTERN = re.compile(r"([-+]?\d+),(\d+)")
_UNIT_PATTERN = re.compile(r"([-+]?\d+(?:\.\d+)?)\s*[^\W\d_]+")
_QUOTED_PATTERN = re.compile(r"'(.*?)'|\((?!s\))(.*)\)")


class CommandGroup(TyperGroup):
    """The commands; a wrong use of one ends with one message and status 2."""

    words: tuple[str, ...] = ()
    """What was typed behind the program's name."""

    def make_context(self, info_name: str | None, args: list[str], *rest: Any, **extra: Any) -> Any:
        """The context, with what was typed kept for messages."""
        self.words = tuple(args)
        with _told(self.words):
            return super().make_context(info_name, args, *rest, **extra)

    def invoke(self, ctx: Any) -> Any:
        """Run the command that was asked for."""
        with _told(self.words):
            return super().invoke(ctx)


@contextmanager
def _told(words: tuple[str, ...]) -> Generator[None]:
    try:
        yield
    except USAGE_ERROR as error:
        said: Any = error
        if type(said).__name__ == "NoArgsIsHelpError":
            raise
        _adopt_language(words)
        typer.echo(f"graphcam: {translated(_error(said, words))}", err=True)
        raise typer.Exit(INPUT_ERROR_STATUS) from None


def _adopt_language(words: tuple[str, ...]) -> None:
    """Speak the language that the options ask for, else that of the task that is named."""
    for option, value in pairwise(words):
        if option == "--language":
            voice().choose(value)
    for word in words:
        if Path(word).suffix == ".toml" and Path(word).is_file():
            voice().adopt_language(language_in(Path(word)))


def _error(error: Any, words: tuple[str, ...]) -> DesignError:
    """The error of a wrong use of the command line."""
    context = error.ctx
    path = context.command_path if context else "graphcam"
    hint = say("'{command} --help' explains it", command=path)
    kind, message = type(error).__name__, str(error.message)
    found = _QUOTED_PATTERN.search(message)
    named = (found[1] or found[2] or "") if found else ""
    if kind == "NoSuchOption":
        known = {option[2:]: option for each in context.command.params for option in each.opts if option[:2] == "--"}
        near = meant(error.option_name.lstrip("-"), known)
        told = say("did you mean '{close}'?", close=known[near]) if near else hint
        from graphcam.tasks.task import DrawingTable

        name = error.option_name.lstrip("-").replace("-", "_")
        if not near and name in (field.name for field in fields(DrawingTable)):
            told = say("write it into the task file: {name} = ... under [drawing]", name=name)
        return DesignError(
            error.option_name, say("an unknown option"), say("an option of {command}", command=path), told
        )
    if kind == "MissingParameter":
        return DesignError(_name_of(error.param), say("missing"), say("given"), hint)
    if kind == "BadOptionUsage":
        return DesignError(error.option_name, say("left without its value"), say("followed by it"), hint)
    if kind == "BadParameter" and error.param is not None:
        return _wrong_value(error, _typed(error.param, words), hint)
    if message.startswith("No such command"):
        limit, near = choice_limit(named, context.command.list_commands(context))
        is_task = Path(named).suffix == ".toml"
        told = say("write {word}", word=f"graphcam solve {named}") if is_task else near
        return DesignError(say("the command"), named, limit, told)
    return DesignError(named or say("the command"), say("one argument too many"), say("left out"), hint)


def _wrong_value(error: Any, typed: str, hint: Words) -> DesignError:
    """The error of a value that its option does not take."""
    parameter, name = error.param, _name_of(error.param)
    kind = _type_of(error.ctx.command, parameter.name)
    choices = get_args(kind) if get_origin(kind) is Literal else getattr(kind, "__members__", {}).values()
    if words := [str(getattr(each, "value", each)) for each in choices]:
        return DesignError(name, typed, *choice_limit(typed, words))
    if kind not in (int, float):
        return DesignError(name, typed, bare_caption(str(error.message)), hint)
    limit = say("a number") if kind is float else say("a whole number")
    # An older typer keeps the bounds at the parameter's type.
    holder = parameter if hasattr(parameter, "min") else getattr(parameter, "type", None)
    least, most = (getattr(holder, bound, None) for bound in ("min", "max"))
    if least is not None:
        limit = say("{number}, at least {least:g}", number=limit, least=least)
    if most is not None:
        limit = say("a number from {least:g} to {most:g}", least=least, most=most)
        with suppress(ValueError):
            float(typed)
            return DesignError(name, bare_caption(typed), limit, hint)
    unit = _UNIT_PATTERN.fullmatch(typed)
    if unit:
        return DesignError(name, typed, limit, say("write {word}", word=unit[1]))
    comma = _DECIMAL_COMMA_PATTERN.fullmatch(typed) if kind is float else None
    return DesignError(name, typed, limit, say("write {word}", word=f"{comma[1]}.{comma[2]}") if comma else hint)


def _type_of(command: Any, name: str) -> Any:
    """The type of a command's parameter, without None."""
    hint = get_type_hints(unwrap(command.callback)).get(name)
    parts = [part for part in get_args(hint) if part is not type(None)]
    return hint if get_origin(hint) is Literal or len(parts) != 1 else parts[0]


def _name_of(parameter: Any) -> str:
    """What a parameter is called on the command line."""
    if parameter.param_type_name == "option":
        return max(parameter.opts, key=len)
    return str(parameter.metavar or parameter.name.upper())


def _typed(parameter: Any, words: tuple[str, ...]) -> str:
    """What was typed for an option; empty where it is not found."""
    for word, after in zip(words, (*words[1:], ""), strict=True):
        name, equals, value = word.partition("=")
        if name in parameter.opts:
            return value if equals else after
    return ""

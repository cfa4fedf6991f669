"""The task that a command is given: read in the task's own language, and named where it is wrong."""

from __future__ import annotations

import re
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

import graphcam
from graphcam.cli.voice import voice
from graphcam.errors import DesignError, TaskError

if TYPE_CHECKING:
    from graphcam.tasks.arcs_task import ArcsTask
    from graphcam.tasks.task import Task

_LANGUAGE = re.compile(r"^[^#\n]*\blanguage\s*=\s*[\"']([\w-]+)[\"']", re.MULTILINE)
"""Where a task file names its language: the table ``[drawing]`` alone has such a key."""

OF_COMMAND = ("upto", "dxf", "files", "working_drawing")
"""What is wrong with a choice of the command line is no matter of the file."""


def read_task(path: Path | None, builtin: str = "coursework") -> Task | ArcsTask:
    """The task in a file, or without one the built-in task of that name.

    Raises
    ------
    TaskError : the file is no task; the language that it names is spoken by then
    """
    if path is None:
        return graphcam.builtin_task(builtin)
    voice().hear(language_in(path))
    return graphcam.load_task(path)


def language_in(path: Path) -> str:
    """The language that a file names, whether or not the rest of it is a task, or TOML; empty where it names none."""
    with suppress(OSError, ValueError):
        found = _LANGUAGE.search(path.read_bytes().decode("utf-8", errors="replace"))
        return found[1] if found else ""
    return ""


@contextmanager
def errors_name(path: Path | None) -> Generator[None]:
    """What is wrong with a task as a design is told with the name of its file too, where it has one."""
    try:
        yield
    except DesignError as error:
        if path is None or error.quantity in OF_COMMAND:
            raise
        raise TaskError(str(path), *error.args) from None

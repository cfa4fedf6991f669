"""``graphcam init``."""

from __future__ import annotations

import shlex
from importlib import resources
from pathlib import Path
from typing import Annotated

import typer
from typer import Argument

from graphcam.cli.shared import one_message
from graphcam.files import write_new


def init(
    file: Annotated[Path, Argument(metavar="FILE", help="Name of the task file to write; it must not be there yet.")],
) -> None:
    """Write a task file in which every key is explained: the coursework task, to be changed.

    [bold]Examples[/bold]

    graphcam init cam.toml
    """
    with one_message():
        write_new(file, resources.files("graphcam").joinpath("data", "commented.toml").read_text(encoding="utf-8"))
    typer.echo(f"{file} is written; solve it with: graphcam solve {shlex.quote(str(file))}")

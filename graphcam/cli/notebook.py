"""``graphcam notebook``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from typer import Option

import graphcam
from graphcam.cli.shared import DEFAULT_FOLDER, TaskFile, one_message, progress_lines

DEFAULT_NOTEBOOK = DEFAULT_FOLDER / "notebook"


def notebook(
    task: TaskFile = None,
    out: Annotated[Path, Option(metavar="DIR", help="Folder for the notebook and its task.")] = DEFAULT_NOTEBOOK,
    run: Annotated[bool, Option("--execute", help="Execute it, so that it holds its figures.")] = False,
    html: Annotated[bool, Option("--html", help="Execute it and make a page that stands alone.")] = False,
    pdf: Annotated[bool, Option("--pdf", help="Execute it and print it with the installed Chromium.")] = False,
    language: Annotated[str | None, Option(metavar="NAME", help="Of the captions, not the task's.")] = None,
) -> None:
    """Write the step-by-step notebook of a task.

    [bold]Examples[/bold]

    graphcam notebook

    graphcam notebook cam.toml --out lesson

    graphcam notebook cam.toml --out lesson --html --pdf

    Executing needs the extra: pip install 'graphcam\\[notebooks]'
    """
    with one_message():
        given = graphcam.builtin_task() if task is None else graphcam.load_task(task)
        if language is not None:
            given = replace(given, drawing=replace(given.drawing, language=language))
        # Loads nbconvert: only when the input has been found right.
        from graphcam.notebooks.notebook_folder import write_folder

        files = write_folder(given, out, run=run, html=html, pdf=pdf, progress=progress_lines(quiet=False))
    typer.echo(f"{out}: " + ", ".join(files))

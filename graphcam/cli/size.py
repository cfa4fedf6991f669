"""The command ``graphcam size``, which finds the best cam within ranges of its sizes."""

from __future__ import annotations

import json
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Option

import graphcam
from graphcam.cli.command_language import help_text_of, translated, voice
from graphcam.cli.shared import (
    DEFAULT_FOLDER,
    echo,
    errors_name,
    input_errors,
    path_argument,
    path_option,
    print_table,
    progress_lines,
    read_task,
    short_warnings,
)
from graphcam.language import languages
from graphcam.words import say, sequence

if TYPE_CHECKING:
    from graphcam.solving.sizing_design import Sizing

SIZE_FOLDER = DEFAULT_FOLDER / "size"
OUT_HELP = help_text_of(say("Folder for the files; the default is {folder}.", folder=str(SIZE_FOLDER)))
JSON_HELP = "Print only the result, as JSON; write files only with --out."
BEST_HELP = "size: the smallest cam; stress: the cam with the minimum contact stress.  The default is that of the task."
LANGUAGE_HELP = help_text_of(
    say("Language of the chart, instead of the task's: {names}.", names=", ".join(languages()))
)


class Objective(StrEnum):
    """The quantity that is minimal for the best cam."""

    SIZE = "size"
    STRESS = "stress"


def size(
    task: Annotated[
        Path | None,
        path_argument(metavar="TASK.toml", help="Task file with a table \\[sizing]; by default an example."),
    ] = None,
    out: Annotated[Path | None, path_option(metavar="DIR", help=OUT_HELP)] = None,
    as_json: Annotated[bool, Option("--json", help=JSON_HELP)] = False,
    objective: Annotated[Objective | None, Option(help=BEST_HELP)] = None,
    language: Annotated[str | None, Option(metavar="NAME", help=LANGUAGE_HELP)] = None,
) -> None:
    """Find the best cam within ranges of its sizes, chart the permitted cams, and write a task with the sizes found.

    The ranges are in the task's table \\[sizing], the limits in \\[limits], \\[follower] and \\[material].

    [bold]Examples[/bold]

    graphcam size

    graphcam size cam.toml --out sized

    graphcam size cam.toml --objective stress

    graphcam solve sized/sized.toml   (draw the cam that was found)
    """
    voice().choose(language)
    progress = progress_lines(quiet=as_json)
    folder = SIZE_FOLDER if out is None and not as_json else out
    with input_errors(), short_warnings():
        given = read_task(task, "sizing")
        progress(say("searching the ranges"))
        with errors_name(task):
            sizing = graphcam.size_task(given, None if objective is None else objective.value)
        document = sizing.to_dict()
        if folder is not None:
            document["files"] = sizing.write(folder, language, progress)
    if as_json:
        typer.echo(json.dumps(document, indent=2, allow_nan=False))
        return
    _print(sizing)
    typer.echo(f"{folder}: " + ", ".join(document["files"].values()))


def _print(sizing: Sizing) -> None:
    """Print the best cam with its active limits, and the front."""
    from graphcam.report.sizing_sheet import BINDING_CAPTIONS, TITLES_BY_OBJECTIVE, cam_table, front_table

    title = TITLES_BY_OBJECTIVE[sizing.objective]
    tables = [cam_table(sizing.best, sizing.adopted, title)]
    tables += [front_table(sizing.front)] if len(sizing.front) > 1 else []
    for table in tables:
        rows = [[translated(cell) for cell in row] for row in table.rows]
        # Of the front there is no column of words.
        words = 1 if table is tables[0] else 0
        print_table([translated(cell) for cell in table.header], rows, words, title=f"\n{translated(table.title)}")
    active = sequence([BINDING_CAPTIONS[name] for name in sizing.best.active]) if sizing.best.active else say("nothing")
    echo("")
    echo(say("active: {names}", names=active))

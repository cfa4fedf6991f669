"""``graphcam solve``."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import graphcam
from graphcam.cli.shared import DEFAULT_FOLDER, one_message, progress_lines

if TYPE_CHECKING:
    from graphcam.tasks.arcs_task import ArcsTask
    from graphcam.tasks.task import Task

LARGE = ("A1", "A2")
"""Formats that are too large for one construction."""
PerConstruction = Annotated[
    bool,
    typer.Option("--per-construction", help="Each construction on sheets of its own, A3 where the task has A1 or A2."),
]
Worksheet = Annotated[
    bool, typer.Option("--worksheet", help="A blank sheet to draw on: axes, divisions, and what the task gives.")
]
Upto = Annotated[
    str | None,
    typer.Option(metavar="K|NAME", help="A half-done sheet: up to step K, or to the end of the construction NAME."),
]
Sigma = Annotated[
    float | None,
    typer.Option(
        "--pencil",
        metavar="SIGMA_MM",
        help="Draw with a hand that errs by this standard deviation, in mm, in each line and each divider setting.",
    ),
]
Dxf = Annotated[
    str,
    typer.Option(metavar="KIND", help="plain: for every CAD program; cad: with true dimensions and attributes."),
]


def solve(
    task: Annotated[
        Path | None, typer.Argument(metavar="TASK.toml", help="Task file; without it the built-in coursework.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", metavar="DIR", help=f"Folder for the files, {DEFAULT_FOLDER} if left out.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the solution as JSON alone; write files only with --out.")
    ] = False,
    pencil: Sigma = None,
    divisions: Annotated[int | None, typer.Option(metavar="N", help="Parts per phase or arc, not the task's.")] = None,
    language: Annotated[
        str | None, typer.Option(metavar="NAME", help="Language of sheet and note, not the task's: en, ru.")
    ] = None,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the pencil's random errors.")] = 0,
    per_construction: PerConstruction = False,
    worksheet: Worksheet = False,
    upto: Upto = None,
    dxf: Dxf = "plain",
) -> None:
    """Solve a task: draw the sheet, write the note and the tables, compare with exact values.

    [bold]Examples[/bold]

    graphcam solve

    graphcam solve cam.toml --out cam

    graphcam solve cam.toml --json > solution.json

    graphcam solve cam.toml --pencil 0.2 --seed 7   (drawn by hand, 0.2 mm off)

    graphcam solve cam.toml --language ru

    graphcam solve cam.toml --divisions 24   (finer: see the errors shrink)

    graphcam solve cam.toml --worksheet   (blank, for students)

    graphcam solve cam.toml --per-construction --upto integration

    graphcam solve cam.toml --dxf cad   (dimensions and title block that a CAD program can edit)
    """
    say = progress_lines(quiet=as_json)
    folder = DEFAULT_FOLDER if out is None and not as_json else out
    with one_message():
        papers = {"upto": _upto(upto, worksheet=worksheet), "per_construction": per_construction, "dxf": dxf}
        read = _read(task, divisions, language, small=per_construction)
        document, files, warnings = _solve(read, _pencil(pencil, seed), folder, say, papers)
    if as_json:
        typer.echo(json.dumps(document, indent=2, allow_nan=False))
    else:
        _print_table(document["quantities"])
        typer.echo(f"{folder}: " + ", ".join(name for name in files.values() if name))
    for sentence in warnings:
        typer.echo(f"warning: {sentence}", err=True)


def _read(path: Path | None, divisions: int | None, language: str | None, *, small: bool) -> Task | ArcsTask:
    """The task with what the options change; ``small`` sheets are for one construction each."""
    task = graphcam.builtin_task() if path is None else graphcam.load_task(path)
    drawing = task.drawing
    asked = {"divisions": divisions, "language": language}
    drawing = replace(drawing, **{key: value for key, value in asked.items() if value is not None})
    if small and drawing.format in LARGE:
        drawing = drawing.on("A3")
    return replace(task, drawing=drawing)


def _upto(upto: str | None, *, worksheet: bool) -> int | str | None:
    """The last step that is drawn."""
    if worksheet and upto is not None:
        raise graphcam.DesignError("upto", upto, "left out with --worksheet", "a worksheet is the sheet up to step 0")
    if worksheet:
        return 0
    return int(upto) if upto is not None and upto.isdecimal() else upto


def _pencil(sigma: float | None, seed: int) -> graphcam.Pencil | None:
    return None if sigma is None else graphcam.Pencil(line=sigma, dividers=sigma, seed=seed)


def _solve(
    task: Task | ArcsTask,
    pencil: graphcam.Pencil | None,
    folder: Path | None,
    progress: Callable[[str], None],
    papers: dict[str, Any],
) -> tuple[dict[str, Any], dict[str, str | None], list[str]]:
    """The solution's document, the files that were written into the folder, if there is one, and the warnings."""
    # Loads the renderers: only when the input has been found right.
    from graphcam.report.output_folder import check_choices
    from graphcam.solving.solve import solve

    progress("drawing and computing")
    solution = solve(task, pencil)
    document = solution.to_dict()
    if folder is None:
        # A wrong choice is one even where nothing is drawn by it.
        check_choices(solution, papers["upto"], dxf=papers["dxf"])
        return document, {}, solution.warnings
    files = solution.write(folder, progress=progress, **papers)
    return document | {"files": files}, files, solution.warnings


def _print_table(quantities: dict[str, dict[str, Any]]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table("quantity", "unit", caption="error and bound in mm on paper")
    for column in ("drawn", "exact", "error", "bound"):
        table.add_column(column, justify="right")
    for name, row in quantities.items():
        numbers = (row[key] for key in ("drawn", "exact", "error_paper", "tolerance_paper"))
        # Adding zero makes a positive zero of what rounds to a negative one.
        table.add_row(name, row["unit"], *("-" if x is None else f"{round(x, 3) + 0:.3f}" for x in numbers))
    Console().print(table)

"""``graphcam exercise``: the commands about exercises."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Argument, Option

from graphcam.cli.exercise_export import export
from graphcam.cli.exercise_grade import grade
from graphcam.cli.exercise_speed import speed
from graphcam.cli.shared import DEFAULT_FOLDER, one_message, print_table, progress_lines

if TYPE_CHECKING:
    from graphcam.exercises.marking.simulate import Simulation

exercise = typer.Typer(
    name="exercise", no_args_is_help=True, help="Exercises that grade themselves: variants, marking, reports."
)

SECRET = b"simulation"
"""Of the simulated course."""
Name = Annotated[str, Argument(metavar="NAME", help="Name of an exercise, or its file NAME.toml.")]


@exercise.command("list")
def list_exercises() -> None:
    """List the exercises that come with graphcam."""
    from rich.console import Console
    from rich.table import Table

    from graphcam.exercises.definition.exercise_file import find_exercise, library

    table = Table()
    # The names are to be typed: none is cut short where the window is narrow.
    table.add_column("name", no_wrap=True, min_width=max(map(len, library())))
    table.add_column("title")
    for column in ("answers", "marks", "mistakes told"):
        table.add_column(column, justify="right")
    with one_message():
        for name in library():
            found = find_exercise(name)
            counts = (len(found.answers), f"{found.marks:g}", len(found.misconceptions))
            table.add_row(name, found.title, *map(str, counts))
    Console().print(table)


@exercise.command()
def simulate(
    name: Name,
    variants: Annotated[int, Option(min=1, metavar="N", help="Variants that are drawn.")] = 5,
    hands: Annotated[int, Option(min=1, metavar="N", help="Students a variant and mistake.")] = 400,
    as_json: Annotated[bool, Option("--json", help="Print the figures as JSON alone.")] = False,
    out: Annotated[Path | None, Option(metavar="FILE", help="Write the JSON into a new file.")] = None,
) -> None:
    """Let simulated students do an exercise: careful ones, and some with every catalogued mistake.

    [bold]Examples[/bold]

    graphcam exercise simulate pressure-angle

    graphcam exercise simulate whole-cam --variants 20 --json
    """
    from graphcam.exercises.definition.exercise_file import find_exercise
    from graphcam.exercises.marking.simulate import simulate as run
    from graphcam.files import check_new, write_new

    progress = progress_lines(quiet=as_json)
    with one_message():
        if out:
            check_new(out)
        found = run(find_exercise(name), SECRET, variants, hands, lambda k, n: progress(f"variant {k} of {n}"))
        text = json.dumps(found.to_dict(), indent=2, allow_nan=False)
        if out:
            write_new(out, text + "\n")
    if as_json:
        typer.echo(text)
    else:
        _print_matrix(found)


def _print_matrix(found: Simulation) -> None:
    rows: list[list[str]] = []
    for name, row in found.rows.items():
        most = sorted(row.named.items(), key=lambda pair: -pair[1])
        named = ", ".join(f"{other} {count}" for other, count in most)
        rows.append([name, named, str(row.hands), str(row.accepted), f"{row.right(name):.1%}"])
    columns = ("mistake made", "named", "hand-ins", "full marks", "named rightly")
    print_table(columns, rows, words=2, title=f"{found.exercise}: what was named")
    for counted, value in (
        (f"careful students who lose any point, of {found.careful}", f"{found.false_rejections:.2%}"),
        ("careful students remarked on as too exact", str(found.too_exact)),
        ("wrong work that earns full marks", f"{found.false_acceptances:.2%}"),
        ("mistakes named rightly", f"{found.right_diagnoses:.2%}"),
        (f"draws a variant, all {found.variants} separable", f"{found.draws:.2f}, at most {len(found.issued)}"),
    ):
        typer.echo(f"{counted}: {value}")


@exercise.command()
def make(
    name: Name,
    roster: Annotated[Path, Option(metavar="CSV", help="The students: their ids in a column 'id', or the first.")],
    secret_file: Annotated[Path, Option(metavar="F", help="The course's secret, any bytes, kept by you.")],
    out: Annotated[Path, Option(metavar="DIR", help="Folder for the papers.")] = DEFAULT_FOLDER / "exercise",
    language: Annotated[str, Option(metavar="en|ru", help="Of the papers and of the feedback.")] = "en",
    workers: Annotated[int, Option(min=1, metavar="N", help="Processes that draw.")] = 1,
) -> None:
    """Make every student's variant: notebook, worksheet, file for the answers; and the keys for you.

    [bold]Examples[/bold]

    graphcam exercise make pressure-angle --roster roster.csv --secret-file secret --out week-5
    """
    from graphcam.exercises.course.make import make as run

    progress = progress_lines(quiet=False)

    def step(done: int, total: int) -> None:
        """Tell whose turn it is."""
        progress(f"student {done} of {total}")

    with one_message():
        count = run(name, roster, secret_file, out, language=language, workers=workers, step=step)
    students = "1 student" if count == 1 else f"{count} students"
    typer.echo(f"{out}: {students}, papers for students in 'students', yours in 'teacher'")


for command in (grade, export, speed):
    exercise.command()(command)

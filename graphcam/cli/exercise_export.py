"""``graphcam exercise export``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from typer import Argument, Option

from graphcam.cli.shared import DEFAULT_FOLDER, one_message, progress_bar
from graphcam.exercises.exports.systems import LearningSystem

DEFAULT_EXPORT = DEFAULT_FOLDER / "export"


def export(
    name: Annotated[str, Argument(metavar="NAME", help="An exercise, or the path of its file.")],
    target: Annotated[LearningSystem, Option("--format", help="The system that it is for.")],
    count: Annotated[int, Option(min=1, max=1000, metavar="N", help="How many variants.")] = 1,
    roster: Annotated[Path | None, Option(metavar="CSV", help="A variant for each of these students instead.")] = None,
    secret_file: Annotated[
        Path | None, Option(metavar="F", help="The course's secret; without it a new one is made.")
    ] = None,
    language: Annotated[str, Option(metavar="en|ru", help="Of all that students read.")] = "en",
    out: Annotated[Path, Option(metavar="DIR", help="A new folder for the export.")] = DEFAULT_EXPORT,
) -> None:
    """Export variants of an exercise for Moodle, nbgrader or Gradescope.

    [bold]Examples[/bold]

    graphcam exercise export whole-cam --format moodle --count 20 --out moodle

    graphcam exercise export whole-cam --format nbgrader --roster roster.csv --secret-file secret --out course
    """
    from graphcam.exercises.course.course_folder import read_secret
    from graphcam.exercises.course.roster import read_roster
    from graphcam.exercises.exports.export import export as write

    with one_message(), progress_bar("variants") as step:
        secret = read_secret(secret_file) if secret_file else None
        students = [f"variant-{k:0{len(str(count))}d}" for k in range(1, count + 1)]
        if roster:
            students = [student.id for student in read_roster(roster)]
        write(name, target, students, out, secret, step, language)
    variants = "1 variant" if len(students) == 1 else f"{len(students)} variants"
    typer.echo(f"{variants} of {name} for {target} in {out}")

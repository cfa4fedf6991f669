"""``graphcam exercise grade``."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer
from typer import Argument, Option

from graphcam.cli.shared import one_message, progress_bar
from graphcam.exercises.running.levels import Level


def grade(
    folder: Annotated[Path, Argument(metavar="DIR", help="The folder with a folder for every student.")],
    secret_file: Annotated[Path, Option(metavar="F", help="The course's secret.")],
    out: Annotated[Path, Option(metavar="CSV", help="The grades; reports of that name go beside it.")],
    exercise: Annotated[str, Option(metavar="NAME", help="The exercise, if DIR was not made by 'exercise make'.")] = "",
    level: Annotated[Level, Option(help="Where the code of notebooks is run; at L0 nothing is run.")] = Level.L0,
    seconds: Annotated[float, Option(min=0.1, help="What a notebook's code may take.")] = 10.0,
    workers: Annotated[
        int, Option(min=1, metavar="N", help="Processes; one for each core if left out.")
    ] = os.cpu_count() or 1,
    cluster: Annotated[str, Option(metavar="ADDRESS", help="A dask scheduler, instead of processes here.")] = "",
    feedback: Annotated[Path | None, Option(metavar="DIR", help="A page for every student goes there.")] = None,
    gradebook: Annotated[str, Option(metavar="URL", help="Also enter the scores here, sqlite:///gradebook.db.")] = "",
) -> None:
    """Grade what a course handed in: answers.toml, .csv, .ipynb or .dxf in the folder of each student.

    An interrupted run goes on where it was when it is started again.

    [bold]Examples[/bold]

    graphcam exercise grade hand-ins --secret-file secret --out grades.csv

    graphcam exercise grade hand-ins --secret-file secret --out grades.csv --level L2 --feedback pages
    """
    from graphcam.exercises.grading.course_grading import Course, grade_course

    with one_message(), progress_bar("hand-ins") as step:
        course = Course(folder, secret_file, out, exercise, level, seconds, workers, cluster, feedback, gradebook)
        said = grade_course(course, step)
    typer.echo(said)

"""``graphcam exercise speed``."""

from __future__ import annotations

from typing import Annotated

import typer

from graphcam.cli.shared import one_message, progress_lines


def speed(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME]...", help="Exercises or their files; all if left out.")
    ] = None,
) -> None:
    """Measure how many hand-ins one core reads and marks in a second, simulated students' as answers.toml.

    [bold]Examples[/bold]

    graphcam exercise speed

    graphcam exercise speed inversion-translating
    """
    from rich.console import Console
    from rich.table import Table

    from graphcam.bench.timing import Timer
    from graphcam.exercises.definition.exercise_file import find_exercise, library
    from graphcam.exercises.grading.marking_speed import marking_speed

    progress, timer = progress_lines(quiet=False), Timer(budget=0.5)
    table = Table("hand-ins a second, one core")
    for column in ("careful", "with a mistake"):
        table.add_column(column, justify="right")
    with one_message():
        for name in names or library():
            progress(name)
            found = marking_speed(find_exercise(name), timer)
            table.add_row(found.exercise, f"{found.careful:.0f}", f"{found.wrong:.0f}")
    Console().print(table)

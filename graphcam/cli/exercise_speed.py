"""``graphcam exercise speed``."""

from __future__ import annotations

from typing import Annotated

from typer import Argument

from graphcam.cli.shared import one_message, print_table, progress_lines


def speed(
    names: Annotated[
        list[str] | None, Argument(metavar="[NAME]...", help="Exercises or their files; all if left out.")
    ] = None,
) -> None:
    """Measure how many hand-ins one core reads and marks in a second, simulated students' as answers.toml.

    [bold]Examples[/bold]

    graphcam exercise speed

    graphcam exercise speed inversion-translating
    """
    from graphcam.bench.timing import Timer
    from graphcam.exercises.definition.exercise_file import find_exercise, library
    from graphcam.exercises.grading.marking_speed import marking_speed

    progress, timer = progress_lines(quiet=False), Timer(budget=0.5)
    rows: list[list[str]] = []
    with one_message():
        for name in names or library():
            progress(name)
            found = marking_speed(find_exercise(name), timer)
            rows.append([found.exercise, f"{found.careful:.0f}", f"{found.wrong:.0f}"])
    print_table(("hand-ins a second, one core", "careful", "with a mistake"), rows)

"""What the commands share: how they end on wrong input, and how they say what they are doing."""

import sys
import time
from collections.abc import Callable, Generator, Iterable, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from graphcam.errors import GraphcamError

WRONG_INPUT = 2
"""Exit status when the input is wrong."""
REFRESHED = 0.1
"""Seconds between two looks of a bar."""
DEFAULT_FOLDER = Path("graphcam-out")
"""Where the files go if nothing is said."""
TaskFile = Annotated[
    Path | None, typer.Argument(metavar="TASK.toml", help="Task file; without it the built-in coursework.")
]


@contextmanager
def one_message() -> Generator[None]:
    """Wrong input ends with one message and status 2."""
    try:
        yield
    except (GraphcamError, OSError) as error:
        typer.echo(f"graphcam: {error}", err=True)
        raise typer.Exit(WRONG_INPUT) from None


def progress_lines(*, quiet: bool) -> Callable[[str], None]:
    """Lines on standard error; with ``quiet`` only for somebody who sits before it."""
    silent = quiet and not sys.stderr.isatty()
    return lambda line: None if silent else typer.echo(f"{line} ...", err=True)


def print_table(columns: Sequence[str], rows: Iterable[Sequence[str]], words: int = 1, **style: Any) -> None:
    """Print a table: the first columns are words, the others numbers, which stand to the right."""
    from rich.console import Console
    from rich.table import Table

    table = Table(**style)
    for k, column in enumerate(columns):
        table.add_column(column, justify="left" if k < words else "right")
    for row in rows:
        table.add_row(*row)
    Console().print(table)


@contextmanager
def progress_bar(things: str) -> Generator[Callable[[int, int], None]]:
    """A bar on standard error for somebody who sits before it; it hears how many of how many are done."""
    if not sys.stderr.isatty():
        yield lambda done, total: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    shown = -REFRESHED

    def step(done: int, total: int) -> None:
        """Move the bar, and show it when it is due."""
        nonlocal shown
        now = time.monotonic()
        due = now - shown >= REFRESHED
        shown = now if due else shown
        progress.update(bar, completed=done, total=total, refresh=due)

    columns = (TextColumn(things), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    # Without a thread that refreshes: a process with threads is better not forked.
    with Progress(*columns, console=Console(stderr=True), transient=True, auto_refresh=False) as progress:
        bar = progress.add_task(things, total=None)
        yield step

"""``graphcam sweep``."""

from __future__ import annotations

from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from multiprocessing import get_context
from pathlib import Path
from typing import Annotated

import typer

from graphcam.cli.shared import one_message


def sweep(
    space: Annotated[Path, typer.Argument(metavar="SPACE.toml", help="File with the values of every size.")],
    out: Annotated[Path, typer.Option("--out", metavar="FILE", help="Results, a row a design: .csv or .parquet.")],
    workers: Annotated[int, typer.Option("--workers", min=1, help="Processes that compute.")] = 1,
) -> None:
    """Compute the extremes of every combination of sizes, and which of the cams keep the limits.

    [bold]Examples[/bold]

    graphcam sweep space.toml --out results.csv

    graphcam sweep space.toml --out results.parquet --workers 8
    """
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    with one_message():
        from graphcam.sweeps.space_file import load_space
        from graphcam.sweeps.sweep_file import sweep_to_file

        designs = load_space(space)
        columns = TextColumn("designs"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
        bar = Progress(*columns, console=Console(stderr=True))
        with _executor(workers) as executor, bar:
            task = bar.add_task("", total=len(designs))
            sweep_to_file(designs, out, executor, lambda done: bar.update(task, completed=done))
    typer.echo(f"{out}: {len(designs)} designs")


def _executor(workers: int) -> AbstractContextManager[Executor | None]:
    # Spawned, which is the same on every system.
    return ProcessPoolExecutor(workers, get_context("spawn")) if workers > 1 else nullcontext()

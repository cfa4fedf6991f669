"""``graphcam sweep``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from typer import Argument, Option

from graphcam.cli.shared import one_message, progress_bar


def sweep(
    space: Annotated[Path, Argument(metavar="SPACE.toml", help="File with the values of every size.")],
    out: Annotated[Path, Option(metavar="FILE", help="Results, a row a design: .csv or .parquet.")],
    workers: Annotated[int, Option(min=1, help="Processes that compute.")] = 1,
) -> None:
    """Compute the extremes of every combination of sizes, and which of the cams keep the limits.

    [bold]Examples[/bold]

    graphcam sweep space.toml --out results.csv

    graphcam sweep space.toml --out results.parquet --workers 8
    """
    from graphcam.sweeps.space import load_space
    from graphcam.sweeps.sweep_file import sweep_to_file
    from graphcam.workers import executor_of

    with one_message(), progress_bar("designs") as step:
        designs = load_space(space)
        with executor_of(workers) as executor:
            sweep_to_file(designs, out, executor, lambda done: step(done, len(designs)))
    typer.echo(f"{out}: {len(designs)} designs")

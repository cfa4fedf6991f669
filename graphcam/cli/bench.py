"""``graphcam bench``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphcam.cli.shared import DEFAULT_FOLDER, one_message, progress_lines

if TYPE_CHECKING:
    from graphcam.bench.bench_tables import TextTable

DEFAULT_BENCH = DEFAULT_FOLDER / "bench"


def bench(
    quick: Annotated[bool, typer.Option("--quick", help="Fewer and shorter measurements: half a minute.")] = False,
    out: Annotated[
        Path, typer.Option("--out", metavar="DIR", help="Folder for the report and its figures.")
    ] = DEFAULT_BENCH,
) -> None:
    """Report speed against error: drawn, sampled and exact, beside what else one would use.

    [bold]Examples[/bold]

    graphcam bench --quick

    graphcam bench --out bench
    """
    from graphcam.bench import bench_report as report
    from graphcam.bench.bench_files import FILES
    from graphcam.bench.bench_files import bench as measure
    from graphcam.bench.bench_tables import tables

    with one_message():
        measured = measure(report.QUICK if quick else report.FULL, out, progress_lines(quiet=False))
    for table in tables(measured):
        if table.brief:
            _print_texts(table)
    typer.echo(f"{out}: " + ", ".join(FILES))


def _print_texts(texts: TextTable) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(title=texts.title, title_justify="left")
    for k, column in enumerate(texts.columns):
        table.add_column(column, justify="left" if k < texts.words else "right")
    for row in texts.rows:
        table.add_row(*row)
    Console().print(table)
